//! A ship that has nothing but an IMU and a camera, along a quay: what the camera tells, and what it must not seem to tell.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod scene;

use insd_nav::error_state::{ATTITUDE, CAMERA_AXES, POSITION, VELOCITY};
use insd_nav::timeline::Estimator;
use nalgebra::{SMatrix, SVector, Vector3};
use scene::{Scene, Trouble};

/// Mean of the normalised squares of position, velocity and attitude, per degree of freedom.
fn nees(scene: &Scene) -> f64 {
    let filter = scene.filter();
    let error = filter.nominal().error_to(scene.truth());
    let (mut e, mut p) = (SVector::<f64, 9>::zeros(), SMatrix::<f64, 9, 9>::zeros());
    let blocks = [POSITION, VELOCITY, ATTITUDE];
    for (i, row) in blocks.iter().enumerate() {
        e.fixed_rows_mut::<3>(3 * i).copy_from(&error.of(*row));
        for (j, column) in blocks.iter().enumerate() {
            let own = row.covariance_with(*column, filter.covariance());
            p.fixed_view_mut::<3, 3>(3 * i, 3 * j).copy_from(&own);
        }
    }
    e.dot(&p.cholesky().unwrap().solve(&e)) / 9.0
}

/// What is found beside what is claimed, over twelve seeds: of the ship, and of how the camera sits.
fn honesty(trouble: Trouble) -> [f64; 2] {
    let (mut sum, mut count) = (0.0, 0.0);
    let mut axes = 0.0;
    let seeds = 12;
    for seed in 0..seeds {
        let mut scene = Scene::new(seed, trouble);
        for second in 1..=40 {
            scene.sail(1.0);
            if second % 5 == 0 {
                sum += nees(&scene);
                count += 1.0;
            }
        }
        let error = scene.filter().nominal().error_to(scene.truth());
        let own = CAMERA_AXES.covariance(scene.filter().covariance());
        let off = scene.axes() + error.of(CAMERA_AXES);
        axes += off.dot(&own.cholesky().unwrap().solve(&off)) / 3.0;
    }
    [sum / count, axes / f64::from(seeds as u32)]
}

#[test]
fn what_is_claimed_is_what_is_found_over_many_seeds() {
    for trouble in [Trouble::Usual, Trouble::Odometry] {
        let [nees, axes] = honesty(trouble);
        assert!((0.7..1.5).contains(&nees), "{trouble:?}: {nees}");
        assert!((0.4..1.8).contains(&axes), "{trouble:?}, how it sits: {axes}");
    }
}

/// How far a ship is carried off within 55 s, m.
fn carried_off(trouble: Trouble) -> f64 {
    let mut scene = Scene::new(3, trouble);
    scene.sail(5.0);
    let before = scene.off();
    scene.sail(55.0);
    (scene.off() - before).norm()
}

#[test]
fn a_camera_holds_a_ship_that_has_nothing_else() {
    let [tracks, steps, without] =
        [Trouble::Usual, Trouble::Odometry, Trouble::Blind].map(carried_off);
    assert!(tracks < 0.1 * without, "{tracks} and {without} m");
    assert!(steps < 0.2 * without, "{steps} and {without} m");
}

#[test]
fn an_odometry_that_goes_by_a_passing_ship_is_no_worse_than_none() {
    let [mut misled, mut without] = [Trouble::Misled, Trouble::Odometry].map(|own| {
        let mut scene = Scene::new(3, own);
        scene.sail(5.0);
        scene
    });
    without.be_blind();
    [&mut misled, &mut without].into_iter().for_each(|scene| scene.sail(15.0));
    assert!(misled.refused() > 25, "{}", misled.refused());
    let [misled, without] = [misled, without].map(|scene| scene.off().norm());
    assert!(misled < 1.05 * without, "{misled} and {without} m");
}

#[test]
fn neither_north_nor_the_place_on_the_earth_is_learnt_by_looking() {
    not_learnt_by(Trouble::Usual);
    not_learnt_by(Trouble::Odometry);
}

fn not_learnt_by(trouble: Trouble) {
    let mut scene = Scene::new(1, trouble);
    let of = |scene: &Scene| {
        let (p, c_ne) = (scene.filter().covariance(), scene.filter().view().c_ne);
        let place = POSITION.covariance_in(p, &c_ne).diagonal().map(f64::sqrt);
        let turn = ATTITUDE.covariance_in(p, &c_ne).diagonal().map(f64::sqrt);
        Vector3::new(place.x, place.y, turn.z)
    };
    scene.sail(0.2);
    let before = of(&scene);
    scene.sail(60.0);
    let after = of(&scene);
    for axis in 0..3 {
        assert!(after[axis] > 0.995 * before[axis], "{axis}: {before} {after}");
    }
}

#[test]
fn a_stream_of_noise_moves_nobody() {
    let (mut blind, mut noisy) = (Scene::new(5, Trouble::Blind), Scene::new(5, Trouble::Noise));
    blind.sail(20.0);
    noisy.sail(20.0);
    let apart = blind.filter().nominal().position - noisy.filter().nominal().position;
    assert_eq!(apart.norm(), 0.0);
    assert!(noisy.refused() > 4, "{}", noisy.refused());
}

#[test]
fn the_same_image_again_and_again_tells_nothing() {
    let mut scene = Scene::new(7, Trouble::Frozen);
    scene.sail(20.0);
    assert!(scene.refused() > 20, "{}", scene.refused());
    assert!(scene.filter().solution().position.height.is_finite());
}

#[test]
fn who_looks_on_is_told_what_is_held_of_a_camera_and_that_it_is_doubted() {
    let mut scene = Scene::new(5, Trouble::Usual);
    assert_eq!(scene.filter().camera_sight(), None);
    scene.sail(20.0);
    let sight = scene.filter().camera_sight().unwrap();
    assert!(!sight.is_doubted && sight.points.unwrap() > 15, "{sight:?}");
    assert!(sight.poses > 2 && (scene.filter().time() - sight.time).as_seconds() < 1.0);
    assert!(sight.turned_sigma.0.min() > 0.0 && sight.delay.sigma > 0.0);
    let mut noise = Scene::new(5, Trouble::Noise);
    noise.sail(20.0);
    assert!(noise.filter().camera_sight().unwrap().is_doubted);
    let mut steps = Scene::new(5, Trouble::Odometry);
    steps.sail(20.0);
    let sight = steps.filter().camera_sight().unwrap();
    assert_eq!((sight.points, sight.landmarks), (None, 0));
}

#[test]
fn a_place_that_was_given_up_is_not_brought_back_by_what_was_seen_from_there() {
    for trouble in [Trouble::Usual, Trouble::Odometry] {
        let mut scene = Scene::new(4, trouble);
        scene.sail(10.0);
        let level_std = |scene: &Scene| {
            let (p, c_ne) = (scene.filter().covariance(), scene.filter().view().c_ne);
            POSITION.covariance_in(p, &c_ne)[(0, 0)].sqrt()
        };
        assert!(level_std(&scene) < 2.0);
        scene.hear_range();
        let unknown = level_std(&scene);
        assert!(unknown > 20.0, "{unknown}");
        scene.sail(20.0);
        let after = level_std(&scene);
        assert!(after > 0.999 * unknown, "{trouble:?}: {unknown} and {after} m");
    }
}

#[test]
fn states_of_a_camera_leave_a_minute_after_it() {
    let mut scene = Scene::new(2, Trouble::Usual);
    let before = scene.filter().covariance().states();
    scene.sail(3.0);
    let with = scene.filter().covariance().states();
    assert!(with > before);
    scene.be_blind();
    scene.sail(70.0);
    assert_eq!(scene.filter().covariance().states(), before);
}
