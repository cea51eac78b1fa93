//! How the ship moves at an instant: a solution and what carries it on for a moment, or to another point
//! of the hull.

use nalgebra::Rotation3;

use crate::attitude::Attitude;
use crate::earth;
use crate::frames::{Body, Geodetic, Ned};
use crate::solution::Solution;
use crate::time::Time;

/// A solution with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Where the ship is, how she moves and lies.
    pub solution: Solution,
    /// Acceleration over the Earth, m/s^2: the derivative of the velocity. `None` while there is no full
    /// filter to tell it.
    pub acceleration: Option<Ned>,
    /// North-east element of the covariance of the position, m^2; `None` as for the acceleration.
    pub covariance_north_east: Option<f64>,
    /// Velocity of the water over the Earth, if a log tells it.
    pub current: Option<Current>,
}

/// Velocity of the water over the Earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Current {
    /// Velocity, m/s; nothing is known of the down component, which is zero.
    pub velocity: Ned,
    /// 1-sigma, m/s.
    pub sigma: Ned,
}

impl Motion {
    /// The motion at an instant close by: velocity changes with the acceleration, attitude with the rate.
    /// The sigmas stay, which is right for tenths of a second.
    #[must_use]
    pub fn at(&self, time: Time) -> Self {
        let from = &self.solution;
        let dt = (time - from.time).as_seconds();
        let change = self.acceleration.unwrap_or_default().0 * dt;
        let travelled = (from.velocity.0 + 0.5 * change) * dt;
        let turned = from.attitude.c_nb() * Rotation3::new(from.rate.0 * dt).into_inner();
        let solution = Solution {
            time,
            position: moved(&from.position, &Ned(travelled)),
            velocity: Ned(from.velocity.0 + change),
            attitude: Attitude::from_c_nb(&turned),
            ..*from
        };
        Motion { solution, ..*self }
    }

    /// The motion of another point of the hull, `lever` from this one: Groves, 2nd ed., section 2.5.5. What
    /// is not known of the attitude counts in its position and velocity as if it were independent of
    /// theirs; the angular acceleration is not known, and left out of its acceleration.
    #[must_use]
    pub fn at_point(&self, lever: &Body) -> Self {
        let from = &self.solution;
        let c_nb = from.attitude.c_nb();
        let offset = c_nb * lever.0;
        let swing = from.rate.0.cross(&lever.0);
        let mut solution = Solution {
            position: moved(&from.position, &Ned(offset)),
            velocity: Ned(from.velocity.0 + c_nb * swing),
            ..*from
        };
        let (sigma, angles) = (&mut solution.sigma, &from.sigma);
        // tilt and heading errors about north, east and down turn the lever; roll and pitch count alike
        let tilt = angles.roll.max(angles.pitch);
        for (part, arm) in [(&mut sigma.position, offset), (&mut sigma.velocity, c_nb * swing)] {
            part.0.x = part.0.x.hypot(angles.heading * arm.y).hypot(tilt * arm.z);
            part.0.y = part.0.y.hypot(angles.heading * arm.x).hypot(tilt * arm.z);
            part.0.z = part.0.z.hypot(tilt * arm.x.hypot(arm.y));
        }
        let turn = angles.heading * angles.heading * offset.x * offset.y;
        let shared = self.covariance_north_east.map(|covariance| covariance - turn);
        let swung = c_nb * from.rate.0.cross(&swing);
        let acceleration = self.acceleration.map(|acceleration| Ned(acceleration.0 + swung));
        Motion { solution, acceleration, covariance_north_east: shared, ..*self }
    }
}

/// A point some metres away, at any latitude.
fn moved(from: &Geodetic, by: &Ned) -> Geodetic {
    let c_en = earth::c_ne(from).transpose();
    let mut to = earth::ecef(from);
    to.0 += c_en * by.0;
    earth::geodetic(&to)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solution::{Mode, SolutionSigma};
    use approx::assert_relative_eq;

    fn turning() -> Motion {
        Motion {
            solution: Solution {
                time: Time::START,
                position: Geodetic::from_degrees(54.0, 8.0, 10.0),
                velocity: Ned::new(0.0, 10.0, 0.0),
                attitude: Attitude { roll: 0.0, pitch: 0.0, heading: 90_f64.to_radians() },
                rate: Body::new(0.0, 0.0, 20_f64.to_radians()),
                sigma: SolutionSigma { heading: 0.01, ..SolutionSigma::default() },
                mode: Mode::Aided,
                judgement: crate::Judgement::default(),
            },
            acceleration: Some(Ned::new(-3.0, 0.0, 0.0)),
            covariance_north_east: Some(0.0),
            current: None,
        }
    }

    #[test]
    fn a_turning_ship_is_carried_on_along_her_turn() {
        let later = turning().at(Time::from_seconds(0.1)).solution;
        assert_relative_eq!(later.attitude.heading.to_degrees(), 92.0, epsilon = 1e-9);
        assert_relative_eq!(later.velocity.0.x, -0.3, epsilon = 1e-12);
        let moved = earth::ecef(&later.position).0 - earth::ecef(&turning().solution.position).0;
        assert_relative_eq!(moved.norm(), (1.0_f64 + 0.015 * 0.015).sqrt(), epsilon = 1e-6);
    }

    #[test]
    fn a_point_ahead_of_the_imu_is_ahead_on_the_chart_and_swings_with_the_turn() {
        let bow = turning().at_point(&Body::new(40.0, 0.0, -5.0));
        let (here, there) = (turning().solution.position, bow.solution.position);
        let offset = earth::c_ne(&here) * (earth::ecef(&there).0 - earth::ecef(&here).0);
        assert_relative_eq!(offset.y, 40.0, epsilon = 1e-6);
        assert_relative_eq!(there.height, 15.0, epsilon = 1e-3);
        assert_relative_eq!(bow.solution.velocity.0.x, -40.0 * 20_f64.to_radians(), epsilon = 1e-9);
        assert_relative_eq!(bow.solution.sigma.position.0.x, 0.4, epsilon = 1e-9);
        assert!(bow.acceleration.unwrap().0.y < -4.8, "towards the centre: {:?}", bow.acceleration);
    }
}
