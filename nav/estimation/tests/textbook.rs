//! The kernel against the dense equations of the textbooks (Gelb, Applied Optimal Estimation, table 4.2-1; Brown and
//! Hwang, Introduction to Random Signals and Applied Kalman Filtering, section 4.2), on states drawn at random.

use approx::assert_relative_eq;
use insd_estimation::{Block, Covariance, Decay, Effects, Feed, Innovation, Jacobian, Transition};
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector1, Vector2, Vector3};
use proptest::prelude::*;

const HEAD: Block<3> = Block::new(0);
const A: Block<3> = Block::new(1);
const B: Block<3> = Block::new(2);
const C: Block<2> = Block::new(3);
const GONE: Block<1> = Block::new(4);
/// States of all blocks but the one that is not there.
const ALL: usize = 11;

/// A covariance of the four blocks, from numbers drawn at random.
fn covariance(numbers: &[f64]) -> Covariance {
    let root = DMatrix::from_column_slice(ALL, ALL, &numbers[..ALL * ALL]);
    let p = &root * root.transpose() + DMatrix::identity(ALL, ALL) * 0.1;
    let mut covariance = Covariance::none();
    for block in [HEAD, A, B] {
        covariance.join(block, &Matrix3::identity());
    }
    covariance.join(C, &SMatrix::identity());
    covariance.matrix_mut().copy_from(&p);
    covariance.symmetrise();
    covariance
}

/// Rows that depend on the head, on C, and on a state that is not there.
fn innovation(numbers: &[f64]) -> Innovation {
    let of = |at: usize| Vector2::new(numbers[at], numbers[at + 1]);
    let h = Jacobian::none(2)
        .with(C, &SMatrix::from_columns(&[of(0), of(2)]))
        .with(HEAD, &SMatrix::from_columns(&[of(4), of(6), of(8)]))
        .with(GONE, &of(10));
    let noise = SMatrix::<f64, 2, 2>::new(0.5, 0.1, 0.1, 0.3);
    Innovation::new(&of(12), h, &noise)
}

/// P and x after the update with a gain, by the equations: P (I - K H) ... in Joseph's form.
fn joseph(p: &DMatrix<f64>, one: &Innovation, h: &DMatrix<f64>, k: &DMatrix<f64>) -> DMatrix<f64> {
    let left = DMatrix::identity(ALL, ALL) - k * h;
    &left * p * left.transpose() + k * &one.r * k.transpose()
}

fn best_gain(p: &DMatrix<f64>, one: &Innovation, h: &DMatrix<f64>) -> DMatrix<f64> {
    let s = h * p * h.transpose() + &one.r;
    s.lu().solve(&(h * p)).unwrap_or_default().transpose()
}

fn numbers() -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(-1.0..1.0, 2 * ALL * ALL)
}

proptest! {
    #[test]
    fn an_update_is_that_of_the_textbook(numbers in numbers()) {
        let (p, one) = (covariance(&numbers), innovation(&numbers[ALL * ALL..]));
        let h = one.h.to_matrix(p.layout());
        let k = best_gain(p.matrix(), &one, &h);
        let weighed = one.weigh(&p).expect("positive definite");
        let mut updated = p.clone();
        let x = weighed.update(&mut updated);
        assert_relative_eq!(updated.matrix(), &joseph(p.matrix(), &one, &h, &k), epsilon = 1e-9);
        assert_relative_eq!(x.values(), &(&k * &one.z), epsilon = 1e-9);
        assert_relative_eq!(weighed.gain(), k, epsilon = 1e-9);
        prop_assert_eq!(updated.matrix(), &updated.matrix().transpose());
        let s = &h * p.matrix() * h.transpose() + &one.r;
        let inverse = s.clone().try_inverse().expect("positive definite");
        assert_relative_eq!(weighed.nis(), one.z.dot(&(inverse * &one.z)), epsilon = 1e-9);
        assert_relative_eq!(weighed.log_root_determinant(), s.determinant().ln() / 2.0, epsilon = 1e-9);
        assert_relative_eq!(weighed.sigma().map(|sigma| sigma * sigma), s.diagonal(), epsilon = 1e-9);
    }

    #[test]
    fn an_update_with_any_gain_is_josephs(numbers in numbers()) {
        let (p, one) = (covariance(&numbers), innovation(&numbers[ALL * ALL..]));
        let h = one.h.to_matrix(p.layout());
        let k = DMatrix::from_column_slice(ALL, 2, &numbers[..2 * ALL]);
        let mut updated = p.clone();
        let x = one.weigh(&p).expect("positive definite").update_with(&mut updated, &k);
        assert_relative_eq!(updated.matrix(), &joseph(p.matrix(), &one, &h, &k), epsilon = 1e-9);
        assert_relative_eq!(x.values(), &(k * &one.z), epsilon = 1e-9);
    }

    #[test]
    fn considered_states_stay_as_they_are_and_the_others_know_of_them(numbers in numbers()) {
        let (p, one) = (covariance(&numbers), innovation(&numbers[ALL * ALL..]));
        let h = one.h.to_matrix(p.layout());
        let mut k = best_gain(p.matrix(), &one, &h);
        k.rows_mut(3, 3).fill(0.0);
        k.rows_mut(9, 2).fill(0.0);
        let mut updated = p.clone();
        let weighed = one.weigh(&p).expect("positive definite");
        let x = weighed.update_considering(&mut updated, &[A.key(), C.key(), GONE.key()]);
        assert_relative_eq!(updated.matrix(), &joseph(p.matrix(), &one, &h, &k), epsilon = 1e-9);
        assert_relative_eq!(x.values(), &(&k * &one.z), epsilon = 1e-9);
        assert_relative_eq!(A.covariance(&updated), A.covariance(&p), epsilon = 1e-9);
        assert_relative_eq!(C.covariance_with(A, &updated), C.covariance_with(A, &p), epsilon = 1e-9);
    }

    #[test]
    fn rows_one_by_one_tell_what_they_do_together(numbers in numbers()) {
        let (p, mut one) = (covariance(&numbers), innovation(&numbers[ALL * ALL..]));
        one.r[(0, 1)] = 0.0;
        one.r[(1, 0)] = 0.0;
        let mut together = p.clone();
        let x = one.weigh(&p).expect("positive definite").update(&mut together);
        let (mut apart, mut sum) = (p.clone(), DVector::zeros(ALL));
        for row in [1, 0] {
            let mut single = one.select(&[row]);
            single.z -= single.h.to_matrix(p.layout()) * &sum;
            let weighed = single.weigh(&apart).expect("positive definite");
            sum += weighed.update(&mut apart).values();
        }
        assert_relative_eq!(apart.matrix(), together.matrix(), epsilon = 1e-8);
        assert_relative_eq!(&sum, x.values(), epsilon = 1e-8);
        let both = one.select(&[0]).beside(&one.select(&[1]));
        prop_assert_eq!(both.h.to_matrix(p.layout()), one.h.to_matrix(p.layout()));
        prop_assert_eq!((both.z, both.r), (one.z, one.r));
    }

    #[test]
    fn a_propagation_is_that_of_the_textbook(numbers in numbers()) {
        let mut p = covariance(&numbers);
        let drawn = &numbers[ALL * ALL..];
        let head = Matrix3::from_column_slice(&drawn[..9]);
        let by = Matrix3::from_column_slice(&drawn[9..18]);
        let scale = Vector3::from_column_slice(&drawn[18..21]);
        let from = [(3, Vector3::repeat(1.0)), (6, scale)];
        let feeds = [Feed { by, from: &from }];
        let decays = [Decay { start: 9, width: 2, left: 0.8, steady: 2.0 }];
        let transition = Transition { head, feeds: &feeds, decays: &decays };

        let mut phi = DMatrix::<f64>::identity(ALL, ALL);
        phi.fixed_view_mut::<3, 3>(0, 0).copy_from(&head);
        phi.fixed_view_mut::<3, 3>(0, 3).copy_from(&by);
        phi.fixed_view_mut::<3, 3>(0, 6).copy_from(&(by * Matrix3::from_diagonal(&scale)));
        let mut q = DMatrix::<f64>::zeros(ALL, ALL);
        for i in 9..ALL {
            phi[(i, i)] = 0.8;
            q[(i, i)] = 2.0 * (1.0 - 0.64);
        }
        let expected = &phi * p.matrix() * phi.transpose() + q;
        transition.propagate(&mut p);
        assert_relative_eq!(p.matrix(), &expected, epsilon = 1e-9);
        prop_assert_eq!(p.matrix(), &p.matrix().transpose());

        let mut effects = Effects::none(20);
        effects.conform(p.layout());
        let drawn = SMatrix::<f64, 20, 3>::from_column_slice(&drawn[21..81]);
        effects.set(0, HEAD, &drawn);
        effects.set(0, A, &drawn);
        effects.set(0, B, &(drawn * 0.3));
        effects.set(0, C, &drawn.fixed_columns::<2>(1).into_owned());
        let carried = effects.matrix() * phi.transpose();
        transition.carry(&mut effects);
        assert_relative_eq!(effects.matrix(), &carried, epsilon = 1e-12);
    }

    #[test]
    fn what_an_update_takes_from_a_cause_is_what_it_takes_from_an_error(numbers in numbers()) {
        let (p, one) = (covariance(&numbers), innovation(&numbers[ALL * ALL..]));
        let h = one.h.to_matrix(p.layout());
        let weighed = one.weigh(&p).expect("positive definite");
        let mut effects = Effects::none(3);
        effects.conform(p.layout());
        effects.set(0, A, &Matrix3::identity());
        effects.set(0, HEAD, &Matrix3::from_column_slice(&numbers[..9]));
        let direct = DMatrix::from_column_slice(3, 2, &numbers[9..15]);
        let u = effects.matrix().transpose();
        let told = (&h * &u + direct.transpose()).transpose();
        let effect = weighed.effect_of(&effects, direct);
        assert_relative_eq!(&effect, &weighed.whiten(told.clone()), epsilon = 1e-12);
        let s = &h * p.matrix() * h.transpose() + &one.r;
        let information = &told * s.try_inverse().unwrap_or_default() * told.transpose();
        assert_relative_eq!(&effect * effect.transpose(), information, epsilon = 1e-9);
        for gain in [weighed.gain(), DMatrix::from_column_slice(ALL, 2, &numbers[..2 * ALL])] {
            let expected = &u - &gain * told.transpose();
            let mut passed = effects.clone();
            weighed.pass_on_by(&mut passed, &effect, &gain);
            assert_relative_eq!(passed.matrix(), &expected.transpose(), epsilon = 1e-12);
        }
        let expected = &u - weighed.gain() * told.transpose();
        weighed.pass_on(&mut effects, &effect);
        assert_relative_eq!(effects.matrix(), &expected.transpose(), epsilon = 1e-12);
    }

    #[test]
    fn who_leaves_takes_nothing_from_what_is_known_of_the_others(numbers in numbers()) {
        let p = covariance(&numbers);
        let mut rest = p.clone();
        rest.leave(A.key());
        prop_assert_eq!(rest.states(), ALL - 3);
        prop_assert_eq!(B.covariance_with(C, &rest), B.covariance_with(C, &p));
        prop_assert_eq!(HEAD.covariance(&rest), HEAD.covariance(&p));
        rest.conform(p.layout());
        prop_assert_eq!(rest.layout(), p.layout());
        prop_assert_eq!(A.covariance(&rest), Matrix3::zeros());
        prop_assert_eq!(C.covariance(&rest), C.covariance(&p));
    }

    #[test]
    fn a_clone_is_what_the_original_was(numbers in numbers()) {
        let mut p = covariance(&numbers);
        let then = C.instance(1);
        p.clone_block(C, then);
        prop_assert_eq!(then.covariance(&p), C.covariance(&p));
        prop_assert_eq!(then.covariance_with(C, &p), C.covariance(&p));
        prop_assert_eq!(then.covariance_with(A, &p), C.covariance_with(A, &p));
        // what is measured of their difference is noise: it tells nothing
        let turn = SMatrix::<f64, 2, 2>::identity();
        let h = Jacobian::none(2).with(C, &turn).with(then, &-turn);
        let one = Innovation::new(&Vector2::new(0.3, -0.1), h, &turn);
        let before = p.clone();
        let x = one.weigh(&p).expect("positive definite").update(&mut p);
        assert_relative_eq!(p.matrix(), before.matrix(), epsilon = 1e-9);
        prop_assert!(x.values().amax() < 1e-9);
    }
}

#[test]
fn all_but_perfect_measurements_leave_a_covariance() {
    let mut p = Covariance::none();
    p.join(HEAD, &Matrix3::new(1e8, 9e7, 0.0, 9e7, 1e8, 0.0, 0.0, 0.0, 1e-6));
    for noise in [1e-4, 1e-8, 0.0] {
        for row in [Vector3::new(1.0, 0.0, 0.0), Vector3::new(1.0, 1.0, 1.0)] {
            let h = Jacobian::none(1).with(HEAD, &row.transpose());
            let one = Innovation::new(&Vector1::new(0.1), h, &Vector1::new(noise));
            let Some(weighed) = one.weigh(&p) else { continue };
            let _ = weighed.update(&mut p);
            let least = p.matrix().clone().symmetric_eigenvalues().min();
            assert!(least > -1e-9, "{noise}: {least}");
        }
    }
}

#[test]
fn what_is_not_finite_or_has_no_covariance_is_never_weighed() {
    let mut p = Covariance::none();
    p.join(HEAD, &Matrix3::identity());
    let of = |z: f64, r: f64| {
        let h = Jacobian::none(1).with(HEAD, &Vector3::x().transpose());
        Innovation::new(&Vector1::new(z), h, &Vector1::new(r))
    };
    assert!(of(f64::NAN, 1.0).weigh(&p).is_none());
    assert!(of(0.0, -2.0).weigh(&p).is_none());
    assert!(of(0.0, f64::NAN).weigh(&p).is_none());
    assert!(Innovation::silent(0).weigh(&p).is_none());
    assert!(Innovation::silent(4).weigh(&Covariance::none()).is_some());
}
