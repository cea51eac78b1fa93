//! Where an array may point when nobody knows: poses on a grid, by how well phases agree in them whatever the integers are.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::align::Coherence;
use super::lines::LineBiases;
use super::model::Model;
use super::pose::CompassPose;
use super::prior::CompassPrior;
use super::settings::CompassShape;
use insd_base::satellites::CompassRefusal;

/// How well phases agree at the least at the point of the grid that is nearest to the true pose.
const AGREEING: f64 = 0.8;
/// Poses that are tried at the most.
const MOST: usize = 400_000;
/// The headings of the grid are no further apart, rad: 5 degrees.
const HEADINGS: f64 = 0.0873;
/// By what share of a wavelength neighbours of the grid may move an antenna.
const FINE: f64 = 0.2;
/// Poses in which antennas are less than this share of a wavelength apart lead to the same integers.
const APART: f64 = 0.15;
/// Where phases agree less than this nothing is looked for, once so many poses have been found.
const HARDLY: f64 = 0.5;
const FEWEST: usize = 12;
/// Beyond so many 1-sigmas nothing is looked for.
const SIGMAS: f64 = 3.0;
/// Nobody sails with more list than this, rad: 80 degrees.
const LIST: f64 = 1.4;

/// What is known of a pose beforehand: about where, and its 1-sigmas about north, east and down, rad.
pub(super) struct Region {
    pub(super) about: Matrix3<f64>,
    pub(super) std: Vector3<f64>,
}

impl Region {
    /// By a prior, or any heading and any list that a ship may have. Where the prior has come to nothing, its heading and what is left of its level are not believed.
    pub(super) fn of(prior: &CompassPrior, is_lost: bool) -> Self {
        const DOUBTED: f64 = 3.0;
        let Some(own) = prior.attitude.filter(|own| own.c_nb.iter().all(|x| x.is_finite())) else {
            return Self { about: Matrix3::identity(), std: Vector3::repeat(f64::INFINITY) };
        };
        let mut std = own.std.map(|x| if x.is_nan() { f64::INFINITY } else { x.abs() });
        if is_lost {
            std = Vector3::new(DOUBTED * std.x, DOUBTED * std.y, f64::INFINITY);
        }
        Self { about: own.c_nb, std }
    }

    /// Its covariance, rad^2; of what is not known that of a radian.
    pub(super) fn covariance(&self) -> Matrix3<f64> {
        Matrix3::from_diagonal(&self.std.map(|x| x.min(1.0).powi(2)))
    }
}

/// Poses that may be it.
pub(super) struct Candidates {
    pub(super) poses: Vec<CompassPose>,
    /// Whether these are all in which phases agree as well as they do near the true one.
    pub(super) is_complete: bool,
}

/// Poses in which phases agree best, apart from each other, `most` at the most.
pub(super) fn candidates(
    model: &Model<'_>,
    lines: &LineBiases,
    region: &Region,
    most: usize,
) -> Result<Candidates, CompassRefusal> {
    let span = model.array.span().unwrap_or(0.0);
    let shortest = model.shortest();
    let step = FINE * shortest / span.max(1e-3);
    let poses = match model.shape() {
        CompassShape::Body(_) => attitudes(region, step),
        CompassShape::Baseline { length } => {
            length.map_or_else(|| Some(Vec::new()), |(length, _)| directions(length, step))
        }
    };
    let poses = poses.ok_or(CompassRefusal::TooFarApart { span })?;
    let prepared = Coherence::new(*model, lines).prepared();
    let scored = poses.into_iter().map(|pose| (prepared.score(&model.offsets(&pose)), pose));
    let mut scored: Vec<(f64, CompassPose)> = scored.collect();
    scored.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut poses: Vec<CompassPose> = Vec::new();
    for (score, pose) in scored {
        if score < HARDLY && poses.len() >= FEWEST {
            break;
        }
        if poses.iter().any(|other| pose.apart(other, model.shape()) <= APART * shortest) {
            continue;
        }
        if poses.len() >= most {
            return Ok(Candidates { poses, is_complete: score < AGREEING });
        }
        poses.push(pose);
    }
    Ok(Candidates { poses, is_complete: true })
}

/// Attitudes all over a region; `None` where they are too many.
fn attitudes(region: &Region, step: f64) -> Option<Vec<CompassPose>> {
    let tilt = region.std.x.max(region.std.y) * SIGMAS;
    let tilts = disc(tilt.min(LIST), step)?;
    let yaw = region.std.z * SIGMAS;
    let headings = if yaw < PI {
        let steps = (yaw / step.min(HEADINGS)).ceil();
        let count = 2 * countable(steps)? + 1;
        (0..count).map(|k| (k as f64 - steps) * yaw / steps.max(1.0)).collect()
    } else {
        let count = countable((TAU / step.min(HEADINGS)).ceil())?;
        (0..count).map(|k| k as f64 * TAU / count as f64).collect::<Vec<_>>()
    };
    if headings.len() * tilts.len() > MOST {
        return None;
    }
    let turned = |heading: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), heading);
    let pose = |heading: f64, tilt: &Vector3<f64>| {
        let c_nb = Rotation3::from_scaled_axis(*tilt) * turned(heading) * region.about;
        CompassPose::Attitude(c_nb)
    };
    let all = headings.iter().flat_map(|heading| tilts.iter().map(|tilt| pose(*heading, tilt)));
    Some(all.collect())
}

/// Tilts about level axes up to an angle.
fn disc(greatest: f64, step: f64) -> Option<Vec<Vector3<f64>>> {
    let mut all = vec![Vector3::zeros()];
    for ring in 1..=countable((greatest / step).ceil())? {
        let angle = greatest * ring as f64 / (greatest / step).ceil();
        let count = countable((TAU * angle / step).ceil())?;
        if all.len() + count > MOST {
            return None;
        }
        all.extend((0..count).map(|k| {
            let (sin, cos) = (k as f64 * TAU / count as f64).sin_cos();
            Vector3::new(cos, sin, 0.0) * angle
        }));
    }
    Some(all)
}

/// Vectors of a length in all directions.
fn directions(length: f64, step: f64) -> Option<Vec<CompassPose>> {
    let rings = countable((PI / step).ceil())?;
    let mut all = Vec::new();
    for ring in 0..=rings {
        let (sin, cos) = (ring as f64 * PI / rings.max(1) as f64).sin_cos();
        let count = countable((TAU * sin / step).ceil())?.max(1);
        if all.len() + count > MOST {
            return None;
        }
        all.extend((0..count).map(|k| {
            let (east, north) = (k as f64 * TAU / count as f64).sin_cos();
            let direction = Vector3::new(sin * north, sin * east, cos);
            CompassPose::Baseline(direction * length)
        }));
    }
    Some(all)
}

fn countable(count: f64) -> Option<usize> {
    (count.is_finite() && (0.0..=MOST as f64).contains(&count)).then_some(count as usize)
}
