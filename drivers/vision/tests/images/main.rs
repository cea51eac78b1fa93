//! Rendered images with a truth: how well points are followed, and that nothing bad disturbs.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod bad;
mod scene;

use std::collections::BTreeMap;

use insd_vision::{CameraCalibration, Eyesight, FrontEnd, FrontEndConfig, Hints, Lens, Tracked};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector2, Vector3};
use rand::SeedableRng;
use rand_pcg::Pcg64;

use scene::{Wall, camera, carried, picture};

pub(crate) const BENT: Lens =
    Lens::RadialTangential { k: [-0.2, 0.05, 0.0, 0.0, 0.0, 0.0], p: [1e-3, -5e-4] };

/// A camera in a seaway, 10 images a second: it rolls by 3 deg, pitches by 1.5 deg, and goes to the side at 1 m/s.
fn pose(i: usize) -> Isometry3<f64> {
    let t = i as f64 / 10.0;
    let [roll, pitch, yaw] = [3.0 * (1.1 * t).sin(), 1.5 * (1.7 * t).sin(), 1.0 * (0.5 * t).sin()];
    let turn =
        UnitQuaternion::from_euler_angles(pitch.to_radians(), yaw.to_radians(), roll.to_radians());
    Isometry3::from_parts(Translation3::new(1.0 * t, 0.1 * t, 0.0), turn)
}

fn hints(now: &Isometry3<f64>, before: &Isometry3<f64>) -> Hints {
    let rotation = (now.rotation.inverse() * before.rotation).to_rotation_matrix();
    Hints { rotation: Some(rotation), down: None }
}

/// Images of some poses taken one after the other.
fn sail(camera: &CameraCalibration, poses: &[Isometry3<f64>], gyro: bool) -> Vec<Tracked> {
    let (wall, mut rng) = (Wall::new(7), Pcg64::seed_from_u64(8));
    let mut eyes = FrontEnd::new(*camera, FrontEndConfig::default()).unwrap();
    let take = |i: usize| {
        let pixels = wall.image(camera, &poses[i], 1.5, &mut rng);
        let known =
            if gyro { hints(&poses[i], &poses[i.saturating_sub(1)]) } else { Hints::default() };
        eyes.take(&picture(camera, i as f64 / 10.0, &pixels), &known).unwrap()
    };
    (0..poses.len()).map(take).collect()
}

/// Errors of all steps from one image to the next, px, by what the truth makes of the point before.
fn step_errors(camera: &CameraCalibration, poses: &[Isometry3<f64>], seen: &[Tracked]) -> Vec<f64> {
    let mut errors = Vec::new();
    for i in 1..seen.len() {
        let before: BTreeMap<u64, Vector2<f64>> =
            seen[i - 1].frame.points.iter().map(|point| (point.track, point.at)).collect();
        for point in &seen[i].frame.points {
            let Some(at) = before.get(&point.track) else { continue };
            errors.push((carried(camera, &poses[i - 1], &poses[i], at) - point.at).norm());
        }
    }
    errors.sort_by(f64::total_cmp);
    errors
}

fn assert_well_followed(camera: &CameraCalibration, gyro: bool) {
    let poses: Vec<_> = (0..25).map(pose).collect();
    let seen = sail(camera, &poses, gyro);
    let errors = step_errors(camera, &poses, &seen);
    let median = errors[errors.len() / 2];
    let wrong = errors.iter().filter(|error| **error > 0.5).count() as f64 / errors.len() as f64;
    println!("{} steps, median {median:.3} px, wrong {:.2} %", errors.len(), 100.0 * wrong);
    assert!(errors.len() > 24 * 100, "{} steps", errors.len());
    assert!(median < 0.05 && wrong < 0.01, "median {median} px, {wrong} wrong");
    assert!(seen.iter().all(|tracked| tracked.sight == Eyesight::Sees));
}

#[test]
fn points_are_followed_to_a_twentieth_of_a_pixel() {
    assert_well_followed(&camera(Lens::STRAIGHT), true);
}

#[test]
fn points_are_followed_through_a_lens_that_bends() {
    assert_well_followed(&camera(BENT), true);
}

#[test]
fn points_are_followed_without_a_gyro() {
    assert_well_followed(&camera(Lens::STRAIGHT), false);
}

#[test]
fn a_gyro_carries_points_over_a_jump_that_they_cannot_be_found_across_alone() {
    // 10 deg of yaw between two images: 53 px
    let turned = |i: usize| Isometry3::rotation(Vector3::y() * (i as f64 * 10.0_f64.to_radians()));
    let poses = [turned(0), turned(1)];
    let kept = |gyro| {
        sail(&camera(Lens::STRAIGHT), &poses, gyro)[1].seen.iter().filter(|t| t.length > 1).count()
    };
    let (with, without) = (kept(true), kept(false));
    assert!(with > 80 && with > 2 * without, "{with} with a gyro, {without} without");
}

#[test]
fn a_number_is_one_unbroken_track() {
    let poses: Vec<_> = (0..12).map(pose).collect();
    let seen = sail(&camera(Lens::STRAIGHT), &poses, true);
    let mut images: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for (i, tracked) in seen.iter().enumerate() {
        tracked
            .frame
            .points
            .iter()
            .for_each(|point| images.entry(point.track).or_default().push(i));
        assert!(tracked.seen.len() <= 200);
    }
    for (track, images) in images {
        assert!(images.windows(2).all(|pair| pair[1] == pair[0] + 1), "{track}: {images:?}");
    }
}

#[test]
fn what_moves_by_itself_is_left_out() {
    let camera = camera(Lens::STRAIGHT);
    let (wall, ship) = (Wall::new(7), Wall::new(99));
    let mut rng = Pcg64::seed_from_u64(8);
    let mut eyes = FrontEnd::new(camera, FrontEndConfig::default()).unwrap();
    let (mut aboard, mut all) = (0, 0);
    for i in 0..15 {
        let now = pose(i);
        let mut pixels = wall.image(&camera, &now, 1.0, &mut rng);
        // another ship fills a sixth of the image and goes upwards by 3 px an image
        let other = Isometry3::translation(0.0, 0.2 * i as f64, 0.0);
        let hull = ship.image(&camera, &other, 1.0, &mut rng);
        for row in 80..160 {
            pixels[row * 320 + 100..row * 320 + 260]
                .copy_from_slice(&hull[row * 320 + 100..row * 320 + 260]);
        }
        let seen = eyes
            .take(
                &picture(&camera, i as f64 / 10.0, &pixels),
                &hints(&now, &pose(i.saturating_sub(1))),
            )
            .unwrap();
        let old = seen.seen.iter().filter(|track| track.length > 2);
        let inside = old
            .clone()
            .filter(|t| (110.0..250.0).contains(&t.at[0]) && (90.0..150.0).contains(&t.at[1]));
        (aboard, all) = (aboard + inside.count(), all + old.count());
    }
    assert!(all > 1000 && aboard * 50 < all, "{aboard} of {all}");
}

#[test]
fn the_same_images_give_the_same_tracks() {
    let poses: Vec<_> = (0..6).map(pose).collect();
    let once = sail(&camera(BENT), &poses, false);
    assert_eq!(once, sail(&camera(BENT), &poses, false));
}
