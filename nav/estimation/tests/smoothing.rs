//! The smoother against the least-squares fit of a whole voyage at once: every state at every instant, and all that was measured, in one
//! normal distribution (Gelb, Applied Optimal Estimation, eq. (4.2-6), (4.2-7)), on systems drawn at random.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use approx::assert_relative_eq;
use insd_estimation::{
    Block, Covariance, Decay, Errors, Feed, Hindsight, Innovation, Jacobian, KeptCovariance,
    KeptTrail, Layout, Transition,
};
use nalgebra::{DMatrix, DVector, Matrix1, Matrix2, Matrix3, SMatrix, Vector1, Vector2, Vector3};
use proptest::prelude::*;

const HEAD: Block<3> = Block::new(0);
const A: Block<3> = Block::new(1);
const C: Block<2> = Block::new(3);
const ALL: usize = 8;
const STEPS: usize = 5;
const NUMBERS: usize = ALL * ALL + STEPS * 10 + 9 + 9;

struct System {
    p: Covariance,
    head: Matrix3<f64>,
    feed: Matrix3<f64>,
    noise: f64,
    told: Vec<(SMatrix<f64, 2, 3>, SMatrix<f64, 2, 2>)>,
    measured: Vec<Vector2<f64>>,
}

/// A covariance of blocks that hang together, from numbers drawn at random.
fn beginning(numbers: &[f64]) -> Covariance {
    let mut p = Covariance::none();
    p.join(HEAD, &Matrix3::identity());
    p.join(A, &Matrix3::identity());
    p.join(C, &Matrix2::identity());
    let root = DMatrix::from_column_slice(ALL, ALL, numbers);
    p.matrix_mut().copy_from(&(&root * root.transpose() + DMatrix::identity(ALL, ALL) * 0.1));
    p.symmetrise();
    p
}

fn system(numbers: &[f64]) -> System {
    let (square, rest) = numbers.split_at(ALL * ALL);
    let (steps, rest) = rest.split_at(STEPS * 10);
    let told = |own: &[f64]| {
        (
            SMatrix::from_column_slice(&own[..6]),
            SMatrix::from_column_slice(&[own[6], 0.3, 0.1, own[7]]),
        )
    };
    System {
        p: beginning(square),
        head: Matrix3::identity() + Matrix3::from_column_slice(&rest[..9]) * 0.3,
        feed: Matrix3::from_column_slice(&rest[9..18]),
        noise: 0.2,
        told: steps.chunks(10).map(told).collect(),
        measured: steps.chunks(10).map(|own| Vector2::new(own[8], own[9]) * 2.0).collect(),
    }
}

impl System {
    fn transition<T>(&self, with: impl FnOnce(&Transition<'_, 3>) -> T) -> T {
        let from = [(3, Vector3::new(1.0, 0.5, -0.3))];
        let feeds = [Feed { by: self.feed, from: &from }];
        let decays = [Decay { start: 6, width: 2, left: 0.8, steady: 1.5 }];
        with(&Transition { head: self.head, feeds: &feeds, decays: &decays })
    }

    /// Phi and Q, dense.
    fn dense(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let unit = |state: usize| {
            let mut errors = Errors::zeros(self.p.layout());
            let place = *self.p.layout().places().iter().rfind(|own| own.start <= state).unwrap();
            let own = (0..place.width).map(|i| f64::from(u8::from(place.start + i == state)));
            errors.fill(place.key, own);
            self.transition(|by| by.carry_errors(&mut errors));
            errors.values().clone()
        };
        let mut q = DMatrix::zeros(ALL, ALL);
        (0..3).for_each(|i| q[(i, i)] = self.noise);
        (6..8).for_each(|i| q[(i, i)] = 1.5 * (1.0 - 0.8 * 0.8));
        (DMatrix::from_columns(&(0..ALL).map(unit).collect::<Vec<_>>()), q)
    }

    fn jacobian(&self, step: usize) -> Jacobian {
        Jacobian::none(2).with(HEAD, &self.told[step].0).with(C, &self.told[step].1)
    }

    /// Filters, and gives estimate and covariance before each measurement with the trail since the one before.
    fn filtered(&self, wanted: &Layout) -> Vec<(Errors, KeptCovariance, Option<KeptTrail>)> {
        let (mut p, mut estimate) = (self.p.clone(), Errors::zeros(self.p.layout()));
        let mut kept = Vec::new();
        for step in 0..STEPS {
            let trail = p.begin_trail().map(|trail| trail.kept());
            kept.push((estimate.clone(), KeptCovariance::of(&p, wanted), trail));
            let h = self.jacobian(step);
            let z = self.measured[step] - h.to_matrix(p.layout()) * estimate.values();
            let noise = Matrix2::new(0.4, 0.1, 0.1, 0.3);
            let z = Vector2::new(z[0], z[1]);
            estimate += &Innovation::new(&z, h, &noise).weigh(&p).unwrap().update(&mut p);
            self.transition(|by| {
                by.propagate(&mut p);
                by.carry_errors(&mut estimate);
            });
            HEAD.inflate(&mut p, self.noise);
        }
        let trail = p.begin_trail().map(|trail| trail.kept());
        kept.push((estimate, KeptCovariance::of(&p, wanted), trail));
        kept
    }

    /// Mean and covariance of all states of all instants, given all that was measured.
    fn fitted(&self) -> (DVector<f64>, DMatrix<f64>) {
        let (phi, q) = self.dense();
        let count = (STEPS + 1) * ALL;
        let mut joint = DMatrix::zeros(count, count);
        joint.view_mut((0, 0), (ALL, ALL)).copy_from(self.p.matrix());
        for step in 0..STEPS {
            let (at, next) = (step * ALL, (step + 1) * ALL);
            let cross = &phi * joint.view((at, 0), (ALL, next));
            joint.view_mut((next, 0), (ALL, next)).copy_from(&cross);
            joint.view_mut((0, next), (next, ALL)).copy_from(&cross.transpose());
            let own = &phi * joint.view((at, at), (ALL, ALL)) * phi.transpose() + &q;
            joint.view_mut((next, next), (ALL, ALL)).copy_from(&own);
        }
        let mut h = DMatrix::zeros(2 * STEPS, count);
        let mut r = DMatrix::zeros(2 * STEPS, 2 * STEPS);
        let mut y = DVector::zeros(2 * STEPS);
        for step in 0..STEPS {
            let own = self.jacobian(step).to_matrix(self.p.layout());
            h.view_mut((2 * step, step * ALL), (2, ALL)).copy_from(&own);
            let noise = Matrix2::new(0.4, 0.1, 0.1, 0.3);
            r.view_mut((2 * step, 2 * step), (2, 2)).copy_from(&noise);
            y.rows_mut(2 * step, 2).copy_from(&self.measured[step]);
        }
        let s = (&h * &joint * h.transpose() + r).cholesky().unwrap();
        let cross = &joint * h.transpose();
        (&cross * s.solve(&y), &joint - &cross * s.solve(&cross.transpose()))
    }
}

proptest! {
    #[test]
    fn smoothing_is_the_least_squares_fit_of_all_that_was_measured(
        numbers in proptest::collection::vec(-1.0..1.0_f64, NUMBERS)
    ) {
        let system = system(&numbers);
        let wanted = Layout::of_blocks([(C.key(), 2), (HEAD.key(), 3)]);
        let kept = system.filtered(&wanted);
        let (mean, covariance) = system.fitted();
        let mut hindsight = Hindsight::none();
        for step in (0..=STEPS).rev() {
            let (estimate, p, trail) = &kept[step];
            let (error, smoothed) = hindsight.of(p);
            for (block, start, width) in [(HEAD.key(), 0, 3), (C.key(), 6, 2)] {
                let at = wanted.start(block).unwrap();
                let own = estimate.values().rows(start, width) + error.values().rows(at, width);
                let dense = step * ALL + start;
                assert_relative_eq!(own, mean.rows(dense, width).into_owned(), epsilon = 1e-6);
                let own = smoothed.matrix().view((at, at), (width, width)).into_owned();
                let fitted = covariance.view((dense, dense), (width, width)).into_owned();
                assert_relative_eq!(own, fitted, epsilon = 1e-6);
            }
            if let Some(trail) = trail {
                hindsight = hindsight.before(trail);
            }
        }
    }
}

/// A place and its speed, 1-sigma one each, and an offset of what is measured that is there from the beginning or joins later.
fn told(z: f64, offset: Block<1>, of: Block<1>) -> Innovation {
    let h = Jacobian::none(1).with(of, &Matrix1::new(1.0)).with(offset, &Matrix1::new(1.0));
    Innovation::new(&Vector1::new(z), h, &Vector1::new(0.1))
}

#[test]
fn what_joins_leaves_and_is_cloned_is_smoothed_as_if_it_had_always_been_there() {
    const PLACE: Block<1> = Block::new(0);
    const OFFSET: Block<1> = Block::new(1);
    const EARLIER: Block<1> = Block::new(2);
    let run = |is_there: bool| {
        let mut p = Covariance::none();
        p.join(PLACE, &Matrix1::new(4.0));
        if is_there {
            p.join(OFFSET, &Matrix1::new(0.5));
            p.join(EARLIER, &Matrix1::new(0.0));
        }
        let start = p.clone();
        p.begin_trail();
        let _ = told(0.7, Block::new(9), PLACE).weigh(&p).unwrap().update(&mut p);
        p.clone_block(PLACE, EARLIER);
        PLACE.inflate(&mut p, 0.3);
        if !is_there {
            p.join(OFFSET, &Matrix1::new(0.5));
        }
        let first = p.begin_trail().unwrap().kept();
        for (z, of) in [(0.4, PLACE), (-0.2, EARLIER), (0.3, PLACE)] {
            let _ = told(z, OFFSET, of).weigh(&p).unwrap().update(&mut p);
        }
        if !is_there {
            p.leave(EARLIER.key());
            p.leave(OFFSET.key());
        }
        let second = p.begin_trail().unwrap().kept();
        let wanted = Layout::of_blocks([(PLACE.key(), 1)]);
        Hindsight::none().before(&second).before(&first).of(&KeptCovariance::of(&start, &wanted))
    };
    let ((error, p), (other, other_p)) = (run(true), run(false));
    assert_relative_eq!(error.values(), other.values(), epsilon = 1e-12);
    assert_relative_eq!(p.matrix(), other_p.matrix(), epsilon = 1e-12);
    assert!(p.matrix()[(0, 0)] < 0.2);
}

#[test]
fn a_change_that_is_not_told_breaks_the_trail_off() {
    let mut p = beginning(&[0.5; ALL * ALL]);
    p.begin_trail();
    p.matrix_mut().fill_diagonal(1.0);
    assert!(p.begin_trail().is_none());
    assert!(p.begin_trail().is_some());
}
