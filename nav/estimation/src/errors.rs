//! A vector of errors.

use std::ops::{AddAssign, Neg, SubAssign};

use nalgebra::{DMatrix, DVector, SVector};

use crate::block::Block;
use crate::key::Key;
use crate::layout::Layout;
use crate::sums::axpy;

/// Errors, true minus estimated, of the states that there are. Of one that is not there the error is zero, so that
/// vectors of different states may be added: the sum has those of both.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Errors {
    layout: Layout,
    values: DVector<f64>,
}

impl Errors {
    /// None.
    #[must_use]
    pub fn none() -> Self {
        Errors::default()
    }

    /// None of these states.
    #[must_use]
    pub fn zeros(layout: &Layout) -> Self {
        Errors::new(layout.clone(), DVector::zeros(layout.states()))
    }

    /// Values in the order of a layout, of which there must be as many as states.
    #[must_use]
    pub(crate) fn new(layout: Layout, values: DVector<f64>) -> Self {
        debug_assert_eq!(layout.states(), values.len());
        Errors { layout, values }
    }

    /// Which states there are.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The values in that order.
    #[must_use]
    pub fn values(&self) -> &DVector<f64> {
        &self.values
    }

    /// Where a block of this width begins: what was kept may be another program's.
    fn start<const W: usize>(&self, block: Block<W>) -> Option<usize> {
        let place = self.layout.place(block.key())?;
        (place.width == W).then_some(place.start)
    }

    /// Of one block.
    #[must_use]
    pub fn of<const W: usize>(&self, block: Block<W>) -> SVector<f64, W> {
        match self.start(block) {
            Some(start) => self.values.fixed_rows::<W>(start).into_owned(),
            None => SVector::zeros(),
        }
    }

    /// Sets one block.
    pub fn set<const W: usize>(&mut self, block: Block<W>, value: &SVector<f64, W>) {
        self.extend(&self.layout.with(block.key(), W));
        if let Some(start) = self.start(block) {
            self.values.fixed_rows_mut::<W>(start).copy_from(value);
        }
    }

    /// Sets a block that is there, by its name.
    pub fn fill(&mut self, key: Key, values: impl IntoIterator<Item = f64>) {
        let Some(place) = self.layout.place(key) else { return };
        let own = &mut self.values.as_mut_slice()[place.start..place.start + place.width];
        own.iter_mut().zip(values).for_each(|(own, value)| *own = value);
    }

    /// Multiplies all by a factor.
    pub fn scale(&mut self, factor: f64) {
        self.values *= factor;
    }

    /// All multiplied by a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Errors::new(self.layout.clone(), &self.values * factor)
    }

    /// Multiplies one block by a factor.
    pub fn scale_block<const W: usize>(&mut self, block: Block<W>, factor: f64) {
        if let Some(start) = self.start(block) {
            self.values.fixed_rows_mut::<W>(start).scale_mut(factor);
        }
    }

    /// As the gain of one row.
    #[must_use]
    pub fn to_column(&self) -> DMatrix<f64> {
        DMatrix::from_column_slice(self.values.len(), 1, self.values.as_slice())
    }

    /// Takes on the states of a layout in its order: those that it has not are forgotten, new ones are zero.
    pub fn conform(&mut self, layout: &Layout) {
        if self.layout != *layout {
            *self = Errors::new(layout.clone(), self.in_order_of(layout));
        }
    }

    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        self.values.as_mut_slice()
    }

    /// Adds zeros for states at the end of a layout that begins as its own.
    fn extend(&mut self, layout: &Layout) {
        if layout.states() > self.values.len() {
            self.values.resize_vertically_mut(layout.states(), 0.0);
            self.layout = layout.clone();
        }
    }

    /// Each value in the order of another layout, zeros for states that it has more; what it has not is left out.
    #[must_use]
    pub(crate) fn in_order_of(&self, layout: &Layout) -> DVector<f64> {
        if self.layout == *layout {
            return self.values.clone();
        }
        let mut values = DVector::zeros(layout.states());
        for place in layout.places() {
            let Some(own) = self.layout.place(place.key) else { continue };
            let width = own.width.min(place.width);
            values.rows_mut(place.start, width).copy_from(&self.values.rows(own.start, width));
        }
        values
    }

    fn add_scaled(&mut self, other: &Errors, factor: f64) {
        if self.layout.states() == 0 {
            *self = other.scaled(factor);
            return;
        }
        if self.layout == other.layout {
            axpy(factor, other.values.as_slice(), self.values.as_mut_slice());
            return;
        }
        let places = other.layout.places().iter();
        let both = places.fold(self.layout.clone(), |all, p| all.with(p.key, p.width));
        self.extend(&both);
        self.values.axpy(factor, &other.in_order_of(&self.layout), 1.0);
    }
}

impl AddAssign<&Errors> for Errors {
    fn add_assign(&mut self, other: &Errors) {
        self.add_scaled(other, 1.0);
    }
}

impl SubAssign<&Errors> for Errors {
    fn sub_assign(&mut self, other: &Errors) {
        self.add_scaled(other, -1.0);
    }
}

impl Neg for &Errors {
    type Output = Errors;

    fn neg(self) -> Errors {
        Errors::new(self.layout.clone(), -&self.values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector1, Vector2};

    const A: Block<2> = Block::new(0);
    const B: Block<1> = Block::new(1);

    #[test]
    fn errors_of_different_states_are_added_by_their_names() {
        let (mut sum, mut more) = (Errors::none(), Errors::none());
        sum.set(A, &Vector2::new(1.0, 2.0));
        more.set(B, &Vector1::new(5.0));
        more.set(A, &Vector2::new(10.0, 20.0));
        sum += &more;
        sum -= &-&more;
        assert_eq!(sum.of(A), Vector2::new(21.0, 42.0));
        assert_eq!(sum.of(B), Vector1::new(10.0));
        assert_eq!(sum.of(Block::<1>::new(9)).x, 0.0);
        let wider: Block<3> = Block::new(1);
        assert_eq!(sum.of(wider).x, 0.0, "a block of another width is another");
    }
}
