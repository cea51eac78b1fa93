//! The covariance of the errors.

use nalgebra::{DMatrix, Matrix2, SMatrix};

use crate::block::Block;
use crate::effects::Effects;
use crate::errors::Errors;
use crate::key::Key;
use crate::layout::Layout;
use crate::trail::ErrorTrail;

/// A covariance of error states that join and leave. It may keep a [`ErrorTrail`] of what becomes of the errors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Covariance {
    layout: Layout,
    p: DMatrix<f64>,
    trail: Option<Box<ErrorTrail>>,
}

impl Covariance {
    /// Of no state.
    #[must_use]
    pub fn none() -> Self {
        Covariance::default()
    }

    /// Of these states, and every error known to be zero.
    #[must_use]
    pub fn zeros(layout: &Layout) -> Self {
        let states = layout.states();
        Covariance::new(layout.clone(), DMatrix::zeros(states, states))
    }

    pub(crate) fn new(layout: Layout, p: DMatrix<f64>) -> Self {
        Covariance { layout, p, trail: None }
    }

    /// Keeps a trail from now on; gives the one that was kept until now, if nothing has broken it off.
    pub fn begin_trail(&mut self) -> Option<ErrorTrail> {
        let begun = ErrorTrail::new(&self.layout);
        self.trail.replace(Box::new(begun)).map(|trail| *trail)
    }

    /// Keeps no trail from now on: that of what becomes of the errors is broken off.
    pub fn break_trail(&mut self) {
        self.trail = None;
    }

    pub(crate) fn trail_mut(&mut self) -> Option<&mut ErrorTrail> {
        self.trail.as_deref_mut()
    }

    /// Which states there are.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Number of states.
    #[must_use]
    pub fn states(&self) -> usize {
        self.layout.states()
    }

    /// The matrix, in the order of the layout.
    #[must_use]
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.p
    }

    /// The same to be changed; whoever does keeps it symmetric. What it does to the errors is not known, which breaks a trail off.
    pub fn matrix_mut(&mut self) -> &mut DMatrix<f64> {
        self.break_trail();
        &mut self.p
    }

    /// The same for who tells the trail himself.
    pub(crate) fn p_mut(&mut self) -> &mut DMatrix<f64> {
        &mut self.p
    }

    /// Whether a block is there.
    #[must_use]
    pub fn has<const W: usize>(&self, block: Block<W>) -> bool {
        self.layout.start(block.key()).is_some()
    }

    /// A block joins with a covariance of its own and no correlation with the rest; one that is there begins anew.
    pub fn join<const W: usize>(&mut self, block: Block<W>, covariance: &SMatrix<f64, W, W>) {
        if !self.has(block) {
            self.append(block.key(), W);
        }
        block.renew(self, covariance);
    }

    /// A block of a width that is known at run time joins, each state with this variance and no correlation; one that is there
    /// stays as it is.
    pub fn join_diagonal(&mut self, key: Key, width: usize, variance: f64) {
        if self.layout.start(key).is_none() {
            let first = self.states();
            self.append(key, width);
            (first..first + width).for_each(|i| self.p[(i, i)] = variance);
        }
    }

    /// A block leaves: of the others stays known what was (the marginal of a normal distribution).
    pub fn leave(&mut self, key: Key) {
        let Some(place) = self.layout.place(key) else { return };
        let p = std::mem::take(&mut self.p);
        let p = p.remove_rows(place.start, place.width);
        self.p = p.remove_columns(place.start, place.width);
        self.layout = self.layout.without(key);
        self.follow();
    }

    /// A block joins as it is at this moment, and stays so: as another instance, with all that the original has to do with
    /// the rest and with itself (stochastic cloning: Roumeliotis and Burdick, ICRA 2002, eq. (8)).
    pub fn clone_block<const W: usize>(&mut self, original: Block<W>, copy: Block<W>) {
        if original == copy || !self.has(original) {
            return;
        }
        if !self.has(copy) {
            self.append(copy.key(), W);
        }
        self.clone_into(original, copy.key(), 0);
    }

    /// The same into some states of a block that is there, from `first` of its states on: what they were is forgotten.
    pub fn clone_into<const W: usize>(&mut self, original: Block<W>, copy: Key, first: usize) {
        let (from, to) = (self.layout.start(original.key()), self.layout.place(copy));
        let Some((from, to)) = from.zip(to.filter(|to| first + W <= to.width)) else { return };
        let to = to.start + first;
        let columns = self.p.fixed_columns::<W>(from).into_owned();
        self.p.fixed_columns_mut::<W>(to).copy_from(&columns);
        let rows = self.p.fixed_rows::<W>(from).into_owned();
        self.p.fixed_rows_mut::<W>(to).copy_from(&rows);
        if let Some(trail) = self.trail_mut() {
            trail.copy::<W>(from, to);
        }
    }

    /// Some states of a block, from `first` of them on, are known otherwise: `cross` is their covariance with all states, a row for each of
    /// them, `own` that among themselves. Of what they are made is not said, which breaks a trail off.
    pub fn replace(&mut self, key: Key, first: usize, cross: &DMatrix<f64>, own: &DMatrix<f64>) {
        let count = cross.nrows();
        let Some(place) = self.layout.place(key).filter(|place| first + count <= place.width)
        else {
            return;
        };
        self.break_trail();
        let at = place.start + first;
        self.p.rows_mut(at, count).copy_from(cross);
        self.p.columns_mut(at, count).copy_from(&cross.transpose());
        self.p.view_mut((at, at), (count, count)).copy_from(&((own + own.transpose()) * 0.5));
    }

    fn append(&mut self, key: Key, width: usize) {
        self.layout = self.layout.with(key, width);
        let states = self.layout.states();
        self.p.resize_mut(states, states, 0.0);
        self.follow();
    }

    /// The trail has the states that there are: of those that are new nothing was there before.
    fn follow(&mut self) {
        if let Some(trail) = &mut self.trail {
            trail.conform(&self.layout);
        }
    }

    /// Neighbours of a process carry on by themselves: x <- A x + w, of two states by their places in the layout.
    pub fn carry_pair(&mut self, (x, v): (usize, usize), by: &Matrix2<f64>, noise: &Matrix2<f64>) {
        let carried = |old_x: f64, old_v: f64| {
            (by[(0, 0)] * old_x + by[(0, 1)] * old_v, by[(1, 0)] * old_x + by[(1, 1)] * old_v)
        };
        let p = &mut self.p;
        for i in 0..p.nrows() {
            (p[(i, x)], p[(i, v)]) = carried(p[(i, x)], p[(i, v)]);
        }
        for i in 0..p.nrows() {
            (p[(x, i)], p[(v, i)]) = carried(p[(x, i)], p[(v, i)]);
        }
        p[(x, x)] += noise[(0, 0)];
        p[(v, v)] += noise[(1, 1)];
        p[(x, v)] += noise[(0, 1)];
        p[(v, x)] += noise[(0, 1)];
        if let Some(trail) = self.trail_mut() {
            trail.carry_pair((x, v), by);
        }
    }

    /// Takes on the states of a layout in its order: those that it has not leave, new ones are known to be zero.
    pub fn conform(&mut self, layout: &Layout) {
        if self.layout == *layout {
            return;
        }
        let mut other = Covariance::zeros(layout);
        other.trail = self.trail.take();
        let both = layout.places().iter().filter_map(|to| Some((to, self.layout.place(to.key)?)));
        let both: Vec<_> = both.map(|(to, from)| (to.start, from.start, to.width)).collect();
        for (to_row, from_row, rows) in &both {
            for (to_column, from_column, columns) in &both {
                let from = self.p.view((*from_row, *from_column), (*rows, *columns));
                let mut to = other.p.view_mut((*to_row, *to_column), (*rows, *columns));
                to.copy_from(&from);
            }
        }
        *self = other;
        self.follow();
    }

    /// Forgets what is known of one state of a block, if that is there: a new variance, no correlation with the rest.
    pub fn renew_state(&mut self, key: Key, state: usize, variance: f64) {
        let Some(place) = self.layout.place(key).filter(|place| state < place.width) else {
            return;
        };
        let index = place.start + state;
        self.p.row_mut(index).fill(0.0);
        self.p.column_mut(index).fill(0.0);
        self.p[(index, index)] = variance;
        if let Some(trail) = self.trail_mut() {
            trail.forget(index, 1);
        }
    }

    /// Adds a variance to each state of a block, by its name, if it is there.
    pub fn inflate(&mut self, key: Key, variance: f64) {
        let Some(place) = self.layout.place(key) else { return };
        (place.start..place.start + place.width).for_each(|i| self.p[(i, i)] += variance);
    }

    /// All multiplied by a factor.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.break_trail();
        self.p *= factor;
        self
    }

    /// Adds another covariance, of which only the states that are here count.
    pub fn add(&mut self, other: &Covariance) {
        if self.layout == other.layout {
            self.p += &other.p;
        } else {
            let mut other = other.clone();
            other.conform(&self.layout);
            self.p += &other.p;
        }
    }

    /// The errors may be off by this one as well: P <- P + x x^T.
    pub fn spread(&mut self, error: &Errors) {
        let x = error.in_order_of(&self.layout);
        self.p.ger(1.0, &x, &x, 1.0);
    }

    /// The same by causes that are known to a covariance, a row and column for each: P <- P + U C U^T.
    pub fn spread_by(&mut self, effects: &Effects, covariance: &DMatrix<f64>) {
        let mut effects = effects.clone();
        effects.conform(&self.layout);
        let wide = effects.matrix().transpose() * covariance * effects.matrix();
        self.p += (&wide + wide.transpose()) * 0.5;
    }

    /// Makes the matrix symmetric again, where one half was worked out otherwise than the other.
    pub fn symmetrise(&mut self) {
        let n = self.states();
        for column in 0..n {
            for row in 0..column {
                let mean = 0.5 * (self.p[(row, column)] + self.p[(column, row)]);
                self.p[(row, column)] = mean;
                self.p[(column, row)] = mean;
            }
        }
    }
}
