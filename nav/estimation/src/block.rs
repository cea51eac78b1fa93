//! Error states by name.

use crate::key::Key;

/// `W` error states that belong together. It is a name and says nothing of whether they are there, or where.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Block<const W: usize> {
    key: Key,
}

impl<const W: usize> Block<W> {
    /// The first instance of a declaration.
    #[must_use]
    pub const fn new(kind: u16) -> Self {
        Block { key: Key { kind, instance: 0 } }
    }

    /// Another instance of the same declaration.
    #[must_use]
    pub const fn instance(self, instance: u16) -> Self {
        Block { key: Key { kind: self.key.kind, instance } }
    }

    /// Its name.
    #[must_use]
    pub const fn key(self) -> Key {
        self.key
    }
}
