//! What the camera sees.

use std::collections::BTreeMap;

use insd_base::units::DEG;
use insd_base::{Body, CameraFrame, CameraModel, ImagePoint};
use nalgebra::{Matrix3, UnitQuaternion, Vector2, Vector3};

use super::*;
use crate::scenario::Override;
use crate::{raw_gnss, shipped, simulate};

/// The berthing with a camera, cut short, with some keys set otherwise.
fn scenario(seconds: f64, sets: &[&str]) -> Scenario {
    let text = shipped().iter().find(|(file, _)| file.starts_with("30")).unwrap().1;
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
    Scenario::with_overrides(text, &sets).unwrap().with_duration(seconds)
}

fn seen(seconds: f64, sets: &[&str]) -> Footage {
    crate::footage(&scenario(seconds, sets), 1).unwrap()
}

const SHARP: [&str; 2] = ["camera.pixel_std=0", "camera.mismatched=0"];

/// Where the vocabulary's camera, as it is told, has the points at rest of all images, and where they are seen.
fn expected_and_seen(sets: &[&str]) -> Vec<(Vector2<f64>, Vector2<f64>)> {
    let scenario = scenario(20.0, sets);
    let footage = crate::footage(&scenario, 1).unwrap();
    let (camera, track) = (scenario.camera.as_ref().unwrap(), Track::new(&scenario, 1));
    let (sightings, _) = sightings(&scenario, camera, &track, 1).unwrap();
    let spec = &footage.spec;
    let model = CameraModel {
        lever: Body(Vector3::from(spec.lever_arm_m)),
        c_bc: Matrix3::from_fn(|row, column| spec.rotation_body_from_camera[row][column]),
        focal: Vector2::new(spec.k[0][0], spec.k[1][1]),
        centre: Vector2::new(spec.k[0][2], spec.k[1][2]),
        size: spec.size_px,
        pixel_std: spec.pixel_std,
    };
    let mut pairs = Vec::new();
    for (sighting, frame) in sightings.iter().zip(&footage.frames) {
        let ship = track.at(sighting.t);
        for (id, point) in &sighting.points {
            let Some(own) = frame.points.iter().find(|own| own.track == *id) else { continue };
            let from_imu = ship.c_eb.tr_mul(&(point - ship.position));
            let h = model.c_bc.tr_mul(&(from_imu - model.lever.0));
            pairs.push((model.project(&h).unwrap(), own.at));
        }
    }
    pairs
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// How far points are from where they are expected, median, px.
fn off(sets: &[&str]) -> f64 {
    median(
        expected_and_seen(sets).iter().map(|(expected, seen)| (expected - seen).norm()).collect(),
    )
}

#[test]
fn a_point_is_seen_where_the_camera_of_the_vocabulary_has_it() {
    let pairs = expected_and_seen(&SHARP);
    assert!(pairs.len() > 2000, "{}", pairs.len());
    assert!(pairs.iter().all(|(expected, seen)| (expected - seen).norm() < 1e-6));
}

#[test]
fn noise_is_as_stated_and_one_row_in_a_hundred_is_a_mismatch() {
    let pairs = expected_and_seen(&[]);
    let far = pairs.iter().filter(|(expected, seen)| (expected - seen).norm() > 4.0).count();
    let share = far as f64 / pairs.len() as f64;
    assert!((0.005..0.015).contains(&share), "{share}");
    // the median of a Rayleigh distribution of 0.5 px
    assert!((off(&[]) - 0.589).abs() < 0.03, "{}", off(&[]));
}

#[test]
fn a_mounting_that_is_not_as_told_turns_the_image_and_a_late_image_is_that_of_a_later_time() {
    let turned = off(&["camera.mounting_error_deg=[0.0, 0.0, 1.0]", SHARP[0], SHARP[1]]);
    assert!((turned / (800.0 * DEG) - 1.0).abs() < 0.2, "{turned}");
    let late = seen(20.0, &["camera.time_offset_s=0.5", SHARP[0], SHARP[1], "camera.lost_per_s=0"]);
    let on_time = seen(20.5, &[SHARP[0], SHARP[1], "camera.lost_per_s=0"]);
    // the same points, by where they are
    let first = |frame: &CameraFrame| frame.points.iter().map(|own| own.at).collect::<Vec<_>>();
    let (late, on_time) = (first(&late.frames[0]), first(&on_time.frames[1]));
    let again = late.iter().filter(|at| on_time.iter().any(|own| (*at - own).norm() < 1e-6));
    assert!(again.count() > 5);
}

#[test]
fn errors_of_the_installer_are_drawn_by_the_seed_and_told_to_nobody_on_board() {
    let scenario = scenario(5.0, &["camera.mounting_std_deg=1", "camera.time_offset_std_s=0.02"]);
    let truth = |seed| raw_gnss(&scenario, seed).unwrap().truth.camera.unwrap();
    let errors: Vec<f64> = (1..=20).flat_map(|seed| truth(seed).mounting_error_deg).collect();
    let mean_square = errors.iter().map(|error| error * error).sum::<f64>() / 60.0;
    assert!((0.6..1.5).contains(&mean_square), "{mean_square}");
    assert!((1..=20).all(|seed| (1e-6..0.1).contains(&truth(seed).time_offset_s.abs())));
    let told = |seed| crate::footage(&scenario, seed).unwrap().spec;
    assert_eq!(told(1), told(2));
}

#[test]
fn the_same_seed_sees_the_same_and_another_does_not() {
    let scenario = scenario(10.0, &[]);
    let of = |seed| crate::footage(&scenario, seed).unwrap();
    assert_eq!(of(3), of(3));
    assert_ne!(of(3).frames, of(4).frames);
}

#[test]
fn a_camera_leaves_all_other_sensors_as_they_are() {
    let with = scenario(10.0, &[]);
    let mut without = with.clone();
    without.camera = None;
    assert_eq!(simulate(&with, 2), simulate(&without, 2));
    let (with, without) = (raw_gnss(&with, 2).unwrap(), raw_gnss(&without, 2).unwrap());
    assert_eq!(with.antennas, without.antennas);
    assert!(with.truth.camera.is_some() && without.truth.camera.is_none());
}

#[test]
fn a_track_is_unbroken_and_there_are_no_more_than_asked_for() {
    let footage = seen(60.0, &["camera.tracks=50", "camera.lost_per_s=0.05"]);
    let mut images: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for (index, frame) in footage.frames.iter().enumerate() {
        assert!(frame.points.len() <= 50);
        frame.points.iter().for_each(|own| images.entry(own.track).or_default().push(index));
    }
    // a mismatch may be beyond the edge of the image
    let broken = images.values().filter(|own| own[own.len() - 1] - own[0] >= own.len()).count();
    assert!(images.len() > 100 && broken * 20 < images.len(), "{} {broken}", images.len());
}

/// The images of 20 s, with a fault in the second half.
fn with_fault(fault: &str) -> Vec<CameraFrame> {
    let fault = format!("camera.fault=[{{ t0_s = 10.0, {fault} }}]");
    seen(20.0, &[&fault, SHARP[0], SHARP[1]]).frames
}

/// How far each track has moved between two images, px.
fn moves(before: &CameraFrame, after: &CameraFrame) -> Vec<f64> {
    let of = |own: &ImagePoint| {
        let then = before.points.iter().find(|then| then.track == own.track)?;
        Some((own.at - then.at).norm())
    };
    after.points.iter().filter_map(of).collect()
}

#[test]
fn a_blinded_camera_sees_nothing_and_a_frozen_one_always_the_same() {
    let blinded = with_fault("t1_s = 15.0, blinded = true");
    assert!(blinded.iter().all(|frame| {
        let t = frame.time.as_seconds();
        frame.points.is_empty() == (10.0..15.0).contains(&t)
    }));
    let frozen = with_fault("frozen = true");
    let after: Vec<_> = frozen.iter().filter(|own| own.time.as_seconds() >= 9.5).collect();
    assert!(after.len() > 10 && after.iter().all(|own| own.points == after[0].points));
    assert_ne!(frozen[0].points, frozen[1].points);
}

#[test]
fn drops_stand_still_while_the_quay_goes_by() {
    let frames = with_fault("wet_lens = 0.25");
    let moved = moves(&frames[frames.len() - 5], &frames[frames.len() - 1]);
    let still = moved.iter().filter(|own| **own < 1e-9).count() as f64 / moved.len() as f64;
    assert!((0.2..0.3).contains(&still), "{still}");
}

#[test]
fn what_is_on_the_water_or_on_a_ship_or_nothing_at_all_is_not_at_rest() {
    for (fault, low, high) in [
        ("water = true", 0.99, 1.0),
        ("ship_passing = 0.4", 0.38, 0.42),
        ("noise = true", 0.99, 1.0),
        ("mounting_knocked_deg = [0.0, 0.0, 5.0]", 0.0, 0.0),
    ] {
        let set = format!("camera.fault=[{{ t0_s = 10.0, {fault} }}]");
        let scenario = scenario(20.0, &[&set]);
        let (camera, track) = (scenario.camera.as_ref().unwrap(), Track::new(&scenario, 1));
        let (sightings, _) = sightings(&scenario, camera, &track, 1).unwrap();
        let frames = crate::footage(&scenario, 1).unwrap().frames;
        let (resting, all) =
            (sightings.last().unwrap().points.len(), frames.last().unwrap().points.len());
        let share = 1.0 - resting as f64 / all as f64;
        assert!(
            all > 40 && (low - 0.03..=high + 0.03).contains(&share),
            "{fault}: {share} of {all}"
        );
    }
}

#[test]
fn a_knock_turns_the_image_once() {
    let frames = with_fault("mounting_knocked_deg = [0.0, 0.0, 5.0]");
    let at = frames.iter().position(|own| own.time.as_seconds() >= 10.0).unwrap();
    let jump = median(moves(&frames[at - 1], &frames[at]));
    assert!((jump / (800.0 * (5.0 * DEG).tan()) - 1.0).abs() < 0.3, "{jump}");
    assert!(median(moves(&frames[at], &frames[at + 1])) < 10.0);
}

#[test]
fn a_step_of_the_odometry_is_how_the_camera_moved_in_the_scale_of_its_map() {
    let sets = ["camera.maps_per_hour=0", "camera.log_scale_walk_sqrt_s=0"];
    let scenario = scenario(60.0, &sets);
    let footage = crate::footage(&scenario, 1).unwrap();
    assert_eq!(footage.odometry.len(), 119);
    let (camera, track) = (scenario.camera.as_ref().unwrap(), Track::new(&scenario, 1));
    let quay = Quay::new(&scenario, &camera.quay, &track, 1).unwrap();
    let rig = Rig::new(camera, &quay.axes, &track);
    let mut scales = Vec::new();
    for step in &footage.odometry {
        let [before, now] = [step.since, step.time].map(|time| rig.view(time.as_seconds()));
        let turn = UnitQuaternion::from_matrix(&before.c_qc.tr_mul(&now.c_qc));
        assert!(step.rotation.angle_to(&turn) < 5.0 * 1.732 * step.rotation_std);
        let way = before.c_qc.tr_mul(&(now.place - before.place));
        scales.push(step.translation.norm() / way.norm());
        let scale = step.translation_std / (0.01 + 0.02 * way.norm());
        assert!((step.translation - way * scale).norm() < 5.0 * 1.732 * step.translation_std);
        assert_eq!(step.map, 0);
    }
    assert!((median(scales) - 1.0).abs() > 0.01);
}

#[test]
fn a_map_ends_where_nothing_is_seen() {
    let fault = "camera.fault=[{ t0_s = 20.0, t1_s = 30.0, blinded = true }]";
    let footage = seen(60.0, &[fault, "camera.maps_per_hour=0"]);
    assert!(footage.odometry.iter().all(|step| {
        let t = step.time.as_seconds();
        !(20.0..30.0).contains(&t) && step.map == u32::from(t >= 30.0)
    }));
}

#[test]
fn what_cannot_be_is_told_with_its_key() {
    let text = shipped().iter().find(|(file, _)| file.starts_with("30")).unwrap().1;
    for (set, key) in [
        ("camera.rate_hz=0", "camera.rate_hz"),
        ("camera.fault=[{ t0_s = 1.0 }]", "camera.fault[0]"),
        ("camera.fault=[{ blinded = true, noise = true }]", "camera.fault[0]"),
        ("camera.fault=[{ wet_lens = 2.0 }]", "camera.fault[0].wet_lens"),
        ("camera.quay.depth_m=[50.0, 30.0]", "camera.quay.depth_m[1]"),
    ] {
        let fault = Scenario::with_overrides(text, &[set.parse().unwrap()]).unwrap_err();
        assert!(fault.to_string().starts_with(&format!("{key}: ")), "{fault}");
    }
}
