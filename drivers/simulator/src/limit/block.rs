//! Names for the places in the state vector.

/// A run of states that belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    start: usize,
    size: usize,
}

impl Block {
    /// The first `size` states.
    pub(super) const fn first(size: usize) -> Self {
        Block { start: 0, size }
    }

    /// The `size` states after these.
    pub(super) const fn then(self, size: usize) -> Self {
        Block { start: self.end(), size }
    }

    /// The place of state `index` of the block.
    pub(super) const fn at(self, index: usize) -> usize {
        self.start + index
    }

    /// The place after the last.
    pub(super) const fn end(self) -> usize {
        self.start + self.size
    }

    /// All places.
    pub(super) fn places(self) -> std::ops::Range<usize> {
        self.start..self.end()
    }
}
