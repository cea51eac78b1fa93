//! Docking aids: the distance of a point of the ship to a line ashore, and its range to a point ashore.
//!
//! With a = r + C_eb l the point of the ship, n the horizontal unit across the line towards the water, tau the one along it,
//! and o its first end:
//!
//! - across the line: d = n . (a - o) - e(s), with s = tau . (a - o) / L;
//! - from a head ashore, at s L metres along the line, to the flat side through a, which runs along x = C_eb (1, 0, 0):
//!   d = n . (a + lambda x - o) - e(s), lambda = (s L - tau . (a - o)) / (tau . x);
//! - from a head aboard along u = C_eb u_b to the upright face of the line: d such that n . (a + d u - o) = e(s);
//! - to a point q ashore: d = |q + C_en diag(sigma) x - a|.
//!
//! What the survey of the line is off by, e(s) = sigma ((1 - s) x_0 + s x_1), and of the point, is the same for all readings, and is
//! estimated in units of its sigma: readings however many do not make the quay any better known than it is, and satellites do.
//! Groves, 2nd ed., section 10.1 and eq. (14.103) for the lever arm; state augmentation: Brown and Hwang, 4th ed., section 5.2.
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::attitude::skew;
use insd_base::{Geodetic, RangingBeam, RangingLine, RangingReading, RangingTarget, earth};
use nalgebra::{SMatrix, Vector1, Vector3};

use super::View;
use crate::error_state::{ATTITUDE, Innovation, Jacobian, POSITION, RANGING_ERRORS, RANGING_MARKS};

/// A beam is not used that is farther from straight across than this: cosine of 60 degrees.
const SLANT: f64 = 0.5;

/// A predicted distance and what it depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangingPrediction {
    /// Distance, m.
    pub distance: f64,
    /// Its gradient by the place of the ship, ECEF axes.
    pub gradient: Vector3<f64>,
    /// From the IMU to where the beam ends or begins, as far as it turns with the ship, ECEF axes, m.
    pub arm: Vector3<f64>,
    /// Its derivative by the three errors of the survey, m for each sigma.
    pub by_survey: Vector3<f64>,
}

/// Predicts a distance; `mark` is the number of what it is measured to among the error states. `None` where there is none:
/// a beam that does not meet the line, or grazes it.
#[must_use]
pub fn predict(view: &View, reading: &RangingReading, mark: usize) -> Option<RangingPrediction> {
    let arm = view.c_eb * reading.lever.0;
    let errors = view.nominal.ranging_errors.fixed_rows::<3>(3 * mark).into_owned();
    match &reading.target {
        RangingTarget::Line(line) => Face::of(line).predict(view, (line, &arm), &errors),
        RangingTarget::Point { place, std } => to_point(view, (place, std), &arm, &errors),
    }
}

/// Innovation of a reading; `more` is a variance beyond that of the reading, m^2.
#[must_use]
pub fn innovation(
    prediction: &RangingPrediction,
    reading: &RangingReading,
    mark: usize,
    more: f64,
) -> Innovation {
    let row = prediction.gradient.transpose();
    let mut h = Jacobian::none(1);
    h.set(POSITION, &row);
    h.set(ATTITUDE, &(-row * skew(&prediction.arm)));
    let mut survey = SMatrix::<f64, 1, { 3 * RANGING_MARKS }>::zeros();
    survey.fixed_columns_mut::<3>(3 * mark).copy_from(&prediction.by_survey.transpose());
    h.set(RANGING_ERRORS, &survey);
    let z = Vector1::new(reading.distance - prediction.distance);
    Innovation::new(&z, h, &Vector1::new(reading.std * reading.std + more))
}

fn to_point(
    view: &View,
    (place, [level, down]): (&Geodetic, &[f64; 2]),
    arm: &Vector3<f64>,
    errors: &Vector3<f64>,
) -> Option<RangingPrediction> {
    let to_ned = earth::c_ne(place);
    let std = Vector3::new(*level, *level, *down);
    let off = to_ned.tr_mul(&std.component_mul(errors));
    let away = earth::ecef(place).0 + off - view.nominal.position - arm;
    let distance = away.norm();
    let unit = away.try_normalize(f64::EPSILON)?;
    let by_survey = (to_ned * unit).component_mul(&std);
    Some(RangingPrediction { distance, gradient: -unit, arm: *arm, by_survey })
}

/// The upright face above a line, ECEF axes.
struct Face {
    origin: Vector3<f64>,
    along: Vector3<f64>,
    across: Vector3<f64>,
    length: f64,
}

impl Face {
    fn of(line: &RangingLine) -> Self {
        let [from, to] = line.ends.map(|end| earth::ecef(&end).0);
        let up = -earth::c_ne(&line.ends[0]).row(2).transpose();
        let way = to - from;
        let level = way - up * up.dot(&way);
        let length = level.norm();
        let along = level / length;
        let right = along.cross(&up);
        Face { origin: from, along, across: if line.water_right { right } else { -right }, length }
    }

    fn predict(
        &self,
        view: &View,
        (line, arm): (&RangingLine, &Vector3<f64>),
        errors: &Vector3<f64>,
    ) -> Option<RangingPrediction> {
        let from_origin = view.nominal.position + arm - self.origin;
        // the line as it is taken to be is a plane, too: its ends are off by these
        let [at_first, at_second] = [errors.x, errors.y].map(|error| error * line.std);
        let normal = self.across - self.along * ((at_second - at_first) / self.length);
        let by_survey = |at: f64, factor: f64| {
            let share = at / self.length;
            Vector3::new(1.0 - share, share, 0.0) * (-line.std * factor)
        };
        match line.beam {
            RangingBeam::Across => Some(RangingPrediction {
                distance: normal.dot(&from_origin) - at_first,
                gradient: normal,
                arm: *arm,
                by_survey: by_survey(self.along.dot(&from_origin), 1.0),
            }),
            RangingBeam::Ashore(at) => {
                let side = view.c_eb.column(0).into_owned();
                let with = self.along.dot(&side);
                let ahead = (at - self.along.dot(&from_origin)) / with;
                let share = at / self.length;
                let off = at_first * (1.0 - share) + at_second * share;
                (with.abs() > SLANT).then(|| RangingPrediction {
                    distance: self.across.dot(&(from_origin + side * ahead)) - off,
                    gradient: self.across - self.along * (self.across.dot(&side) / with),
                    arm: arm + side * ahead,
                    by_survey: by_survey(at, 1.0),
                })
            }
            RangingBeam::Aboard(direction) => {
                let beam = view.c_eb * direction.0;
                let towards = -normal.dot(&beam);
                let distance = (normal.dot(&from_origin) - at_first) / towards;
                let hit = from_origin + beam * distance;
                (towards > SLANT && distance > 0.0).then(|| RangingPrediction {
                    distance,
                    gradient: normal / towards,
                    arm: arm + beam * distance,
                    by_survey: by_survey(self.along.dot(&hit), 1.0 / towards),
                })
            }
        }
    }
}
