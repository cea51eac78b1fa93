//! Error states by name.

use nalgebra::{SMatrix, SVector};

use crate::covariance::Covariance;
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

    /// Covariance of this block with itself; zero where it is not there.
    #[must_use]
    pub fn covariance(self, p: &Covariance) -> SMatrix<f64, W, W> {
        self.covariance_with(self, p)
    }

    /// Covariance of this block (rows) with another (columns); zero where one of them is not there.
    #[must_use]
    pub fn covariance_with<const V: usize>(
        self,
        other: Block<V>,
        p: &Covariance,
    ) -> SMatrix<f64, W, V> {
        match (p.layout().start(self.key), p.layout().start(other.key)) {
            (Some(row), Some(column)) => p.matrix().fixed_view::<W, V>(row, column).into_owned(),
            _ => SMatrix::zeros(),
        }
    }

    /// Covariance of this block as other axes see it: of A x, with x the block.
    #[must_use]
    pub fn covariance_in<const M: usize>(
        self,
        p: &Covariance,
        axes: &SMatrix<f64, M, W>,
    ) -> SMatrix<f64, M, M> {
        axes * self.covariance(p) * axes.transpose()
    }

    /// 1-sigma of a component, on the mean of all.
    #[must_use]
    pub fn std(self, p: &Covariance) -> f64 {
        (self.covariance(p).trace() / W as f64).max(0.0).sqrt()
    }

    /// 1-sigma of each component.
    #[must_use]
    pub fn stds(self, p: &Covariance) -> SVector<f64, W> {
        self.covariance(p).diagonal().map(|variance| variance.max(0.0).sqrt())
    }

    /// 1-sigma of each component of the sum of this block and another.
    #[must_use]
    pub fn std_of_sum(self, other: Self, p: &Covariance) -> SVector<f64, W> {
        let both = self.covariance(p) + other.covariance(p);
        let variance = both.diagonal() + self.covariance_with(other, p).diagonal() * 2.0;
        variance.map(|variance| variance.max(0.0).sqrt())
    }

    /// Forgets what is known of this block: new covariance, no correlation with the rest. It joins where it is not there.
    pub fn renew(self, p: &mut Covariance, covariance: &SMatrix<f64, W, W>) {
        let Some(start) = p.layout().start(self.key) else { return p.join(self, covariance) };
        let matrix = p.p_mut();
        matrix.fixed_rows_mut::<W>(start).fill(0.0);
        matrix.fixed_columns_mut::<W>(start).fill(0.0);
        matrix.fixed_view_mut::<W, W>(start, start).copy_from(covariance);
        if let Some(trail) = p.trail_mut() {
            trail.forget(start, W);
        }
    }

    /// Adds to the covariance of this block, if it is there.
    pub fn add(self, p: &mut Covariance, covariance: &SMatrix<f64, W, W>) {
        let Some(start) = p.layout().start(self.key) else { return };
        let mut own = p.p_mut().fixed_view_mut::<W, W>(start, start);
        own += (covariance + covariance.transpose()) * 0.5;
    }

    /// Another block has an error by this one as well from now on, y <- y + A x; the columns of A are those of this block.
    pub fn add_to<const V: usize>(
        self,
        other: Block<V>,
        p: &mut Covariance,
        by: &SMatrix<f64, V, W>,
    ) {
        let (from, to) = (p.layout().start(self.key), p.layout().start(other.key));
        let Some((from, to)) = from.zip(to) else { return };
        let matrix = p.p_mut();
        let more = by * matrix.fixed_rows::<W>(from);
        let mut rows = matrix.fixed_rows_mut::<V>(to);
        rows += more;
        let more = matrix.fixed_columns::<W>(from) * by.transpose();
        let mut columns = matrix.fixed_columns_mut::<V>(to);
        columns += more;
        if let Some(trail) = p.trail_mut() {
            trail.add_to(from, to, by);
        }
    }

    /// Adds to the covariance of this block (rows) with another (columns), and of that with this, if both are there.
    pub fn add_between<const V: usize>(
        self,
        other: Block<V>,
        p: &mut Covariance,
        covariance: &SMatrix<f64, W, V>,
    ) {
        let (row, column) = (p.layout().start(self.key), p.layout().start(other.key));
        let Some((row, column)) = row.zip(column) else { return };
        let mut own = p.p_mut().fixed_view_mut::<W, V>(row, column);
        own += covariance;
        let mut transposed = p.p_mut().fixed_view_mut::<V, W>(column, row);
        transposed += covariance.transpose();
    }

    /// Adds a variance to each component, if it is there.
    pub fn inflate(self, p: &mut Covariance, variance: f64) {
        p.inflate(self.key, variance);
    }

    /// Transforms this block of the error by a matrix, x <- A x.
    pub fn transform(self, p: &mut Covariance, by: &SMatrix<f64, W, W>) {
        let Some(start) = p.layout().start(self.key) else { return };
        let (states, matrix) = (p.states(), p.p_mut());
        let columns = &mut matrix.as_mut_slice()[start * states..(start + W) * states];
        for state in 0..states {
            let turned = by * SVector::<f64, W>::from_fn(|k, _| columns[k * states + state]);
            (0..W).for_each(|k| columns[k * states + state] = turned[k]);
        }
        let own = by * matrix.fixed_view::<W, W>(start, start);
        matrix.fixed_view_mut::<W, W>(start, start).copy_from(&own);
        for state in (0..states).filter(|state| !(start..start + W).contains(state)) {
            (start..start + W).for_each(|k| matrix[(k, state)] = matrix[(state, k)]);
        }
        if let Some(trail) = p.trail_mut() {
            trail.transform(start, by);
        }
    }

    /// Tells this block in another unit: its numbers become what they were times a factor. What is told in units of its
    /// own sigma has become larger where the factor is below one, and is not known by that much: its variance tends to one.
    pub fn rescale(self, p: &mut Covariance, factor: f64) {
        self.transform(p, &SMatrix::from_diagonal_element(factor));
        self.inflate(p, (1.0 - factor * factor).max(0.0));
    }
}
