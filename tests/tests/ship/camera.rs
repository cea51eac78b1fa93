//! Going alongside with a camera that sees the quay, and no satellites.

use std::collections::BTreeMap;
use std::sync::Arc;

use insd_base::{
    Body, CameraFrame, CameraModel, ImagePoint, Message, Received, Source, Truth, Voyage, earth,
};
use insd_engine::EngineConfig;
use insd_nav::camera::sight::{Eye, Pose};
use insd_nav::config::CameraAid;
use insd_simulator::simulate;
use insd_tests::sailing::sail_messages;
use nalgebra::{Matrix3, UnitQuaternion, Vector2, Vector3};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::figure;
use crate::rangings::{Dice, GONE, berthing};
use crate::satellites::errors;

/// The camera works from this time on, s, twice a second.
const FROM: f64 = 400.0;
const POINTS: usize = 300;
/// Most points in an image.
const SEEN: usize = 40;

/// One on the starboard wing, which looks to starboard.
fn model() -> CameraModel {
    CameraModel {
        lever: Body::new(20.0, 9.0, -12.0),
        c_bc: Matrix3::new(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0),
        focal: Vector2::new(800.0, 800.0),
        centre: Vector2::new(640.0, 360.0),
        size: [1280, 720],
        pixel_std: 0.5,
    }
}

fn pose(truth: &Truth) -> Pose {
    let c_en = earth::c_ne(&truth.position).transpose();
    let c_nb = truth.attitude.unwrap().c_nb();
    Pose {
        position: earth::ecef(&truth.position).0,
        attitude: UnitQuaternion::from_matrix(&(c_en * c_nb)),
        velocity: Vector3::zeros(),
        rate: Vector3::zeros(),
    }
}

/// Sheds, cranes and bollards south of where she stops, ECEF, m.
fn port(voyage: &Voyage, dice: &mut Dice) -> Vec<Vector3<f64>> {
    let last = voyage.truth.last().unwrap();
    let (here, c_en) = (earth::ecef(&last.position).0, earth::c_ne(&last.position).transpose());
    let mut point = || {
        let along = -250.0 + 500.0 * dice.uniform();
        let (across, up) = (20.0 + 60.0 * dice.uniform(), -5.0 + 30.0 * dice.uniform());
        here + c_en * Vector3::new(-across, along, -up)
    };
    (0..POINTS).map(|_| point()).collect()
}

/// What the camera sees; one point of a hundred is a mismatch. A point that comes back is another track.
fn images(voyage: &Voyage, seed: u64) -> Vec<Received> {
    let mut dice = Dice::new(seed);
    let points = port(voyage, &mut dice);
    let eye = Eye::new(&model(), &Vector3::zeros(), 0.0);
    let (mut tracks, mut next) = (BTreeMap::new(), 0);
    let is_due = |truth: &&Truth| {
        let seconds = truth.time.as_seconds();
        seconds > FROM && (2.0 * seconds).fract().abs() < 1e-6
    };
    let mut all = Vec::new();
    for truth in voyage.truth.iter().filter(is_due) {
        let own = pose(truth);
        let seen = points.iter().enumerate().filter_map(|(index, point)| {
            let at = eye.sight(&own, point)?.at;
            model().sees(&at).then_some((index, at))
        });
        let seen: Vec<(usize, Vector2<f64>)> = seen.take(SEEN).collect();
        tracks.retain(|index, _| seen.iter().any(|(own, _)| own == index));
        let mut frame = CameraFrame { time: truth.time, points: Vec::new() };
        for (index, at) in seen {
            let track = *tracks.entry(index).or_insert_with(|| {
                next += 1;
                next
            });
            let noise = Vector2::new(dice.normal(), dice.normal()) * model().pixel_std;
            let is_mismatch = dice.uniform() < 0.01;
            let anywhere = Vector2::new(1280.0 * dice.uniform(), 720.0 * dice.uniform());
            let at = if is_mismatch { anywhere } else { at + noise };
            frame.points.push(ImagePoint { track, at });
        }
        let message = Message::Camera(Arc::new(frame));
        all.push(Received { receipt: truth.time, source: Source::Camera(0), message });
    }
    all
}

/// How far she goes astray while satellites are gone, RMS, m, and the mean normalised square of her place.
fn astray(voyage: &Voyage, images: Vec<Received>) -> (f64, f64) {
    let mut all = voyage.received();
    all.retain(|received| !matches!(received.source, Source::Log(_)));
    all.extend(images);
    all.sort_by_key(|received| received.receipt);
    let mut config = EngineConfig::for_voyage(&voyage.header, 10.0);
    config.models.camera = Some(CameraAid::new(model()));
    let log = sail_messages(&config, &all, 7);
    let mut off = errors(&log.solutions, &voyage.truth);
    off.retain(|(time, ..)| (GONE[0] + 1.0..=GONE[1]).contains(time));
    let first = off[0].1;
    let count = off.len() as f64;
    let square: f64 = off.iter().map(|(_, own, _)| (own - first).norm_squared()).sum();
    let nees: f64 =
        off.iter().map(|(_, own, sigma)| own.component_div(sigma).norm_squared() / 2.0).sum();
    ((square / count).sqrt(), nees / count)
}

#[test]
fn a_camera_holds_a_ship_alongside_without_satellites_and_log() {
    let sailed = |seed: u64| {
        let voyage = simulate(&berthing(), seed);
        let images = images(&voyage, seed);
        (astray(&voyage, images), astray(&voyage, Vec::new()))
    };
    let all: Vec<_> = (1..9).into_par_iter().map(sailed).collect();
    let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / all.len() as f64;
    let with = mean(&mut all.iter().map(|own| own.0.0.powi(2))).sqrt();
    let without = mean(&mut all.iter().map(|own| own.1.0.powi(2))).sqrt();
    let nees = mean(&mut all.iter().map(|own| own.0.1));
    figure!(
        "a minute without satellites: {with:.3} m with a camera, {without:.3} m without; NEES {nees:.2}"
    );
    assert!(with < 0.15 && with < 0.3 * without, "{with} {without}");
    assert!(nees < 1.5, "{nees}");
}
