//! How the ship moves at an instant: a solution and what carries it on for a moment, or to another point
//! of the hull.

use nalgebra::{Matrix3, Rotation3, SMatrix, Vector3};

use crate::attitude::{Attitude, skew};
use crate::earth;
use crate::frames::{Body, Geodetic, Ned};
use crate::solution::{Solution, SolutionSigma};
use crate::time::Time;

/// Covariance of the errors of position (north, east, down, m), velocity (the same, m/s) and roll, pitch, heading (rad), in this
/// order.
pub type MotionCovariance = SMatrix<f64, 9, 9>;

/// A solution with its covariance and its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Where the ship is, how she moves and lies.
    pub solution: Solution,
    /// Acceleration over the Earth, m/s^2: the derivative of the velocity. `None` while there is no full
    /// filter to tell it.
    pub acceleration: Option<Ned>,
    /// How the errors of the solution hang together; `None` as for the acceleration. The sigmas of the solution may be larger:
    /// they cover what speaks against the filter, too.
    pub covariance: Option<MotionCovariance>,
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

    /// North-east element of the covariance of the position, m^2.
    #[must_use]
    pub fn covariance_north_east(&self) -> Option<f64> {
        self.covariance.map(|covariance| covariance[(0, 1)])
    }

    /// The motion of another point of the hull, `lever` from this one: Groves, 2nd ed., section 2.5.5. What
    /// is not known of the attitude counts in its position and velocity as the covariance has it, and where there is none as
    /// if it were independent of theirs; the angular acceleration is not known, and left out of its acceleration.
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
        let arms = [offset, c_nb * swing];
        let inverse = from.attitude.jacobian_of_ned_rotation().try_inverse();
        let covariance = self.covariance.zip(inverse).map(|(own, by_angles)| {
            let beyond = Beyond::new(&from.sigma, &own);
            let seen = seen_from(&own, &arms, &by_angles);
            solution.sigma =
                beyond.turned(&arms).hypot(&SolutionSigma::of_variances(&seen.diagonal()));
            seen
        });
        if covariance.is_none() {
            solution.sigma = Beyond(from.sigma).turned(&arms);
        }
        let swung = c_nb * from.rate.0.cross(&swing);
        let acceleration = self.acceleration.map(|acceleration| Ned(acceleration.0 + swung));
        Motion { solution, acceleration, covariance, ..*self }
    }
}

/// What a solution claims beyond its covariance: of that nothing is known but its size.
struct Beyond(SolutionSigma);

impl Beyond {
    fn new(claimed: &SolutionSigma, covariance: &MotionCovariance) -> Self {
        Beyond(claimed.zip(&SolutionSigma::of_variances(&covariance.diagonal()), |all, own| {
            (all * all - own * own).max(0.0).sqrt()
        }))
    }

    /// The same at the end of an arm, of which position and velocity are that of the point less that of the solution, NED, m
    /// and m/s. Tilt and heading errors about north, east and down turn the arm; roll and pitch count alike.
    fn turned(&self, arms: &[Vector3<f64>; 2]) -> SolutionSigma {
        let mut sigma = self.0;
        let (tilt, heading) = (sigma.roll.max(sigma.pitch), sigma.heading);
        for (part, arm) in [&mut sigma.position, &mut sigma.velocity].into_iter().zip(arms) {
            part.0.x = part.0.x.hypot(heading * arm.y).hypot(tilt * arm.z);
            part.0.y = part.0.y.hypot(heading * arm.x).hypot(tilt * arm.z);
            part.0.z = part.0.z.hypot(tilt * arm.x.hypot(arm.y));
        }
        sigma
    }
}

/// The covariance at the end of an arm; `by_angles` is the rotation about NED axes that a change of roll, pitch and heading makes.
fn seen_from(
    own: &MotionCovariance,
    arms: &[Vector3<f64>; 2],
    by_angles: &Matrix3<f64>,
) -> MotionCovariance {
    let mut moved = MotionCovariance::identity();
    for (row, arm) in [0, 3].into_iter().zip(arms) {
        moved.fixed_view_mut::<3, 3>(row, 6).copy_from(&(-skew(arm) * by_angles));
    }
    moved * own * moved.transpose()
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
                source: None,
                hidden: crate::Protection::default(),
            },
            acceleration: Some(Ned::new(-3.0, 0.0, 0.0)),
            covariance: None,
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

    #[test]
    fn an_antenna_that_is_known_better_than_the_imu_is_claimed_so() {
        // nothing but the heading is unsure, and the position is that of an antenna 40 m ahead of the IMU, to a centimetre
        let ship = turning();
        let (arm, heading) = (40.0, 0.01);
        let mut covariance = MotionCovariance::zeros();
        // heading for the east, a turn to starboard takes what is ahead to the south: the IMU is as much to the north
        covariance[(0, 0)] = 1e-4 + (arm * heading) * (arm * heading);
        covariance[(8, 8)] = heading * heading;
        covariance[(0, 8)] = arm * heading * heading;
        covariance[(8, 0)] = covariance[(0, 8)];
        let sigma = SolutionSigma::of_variances(&covariance.diagonal());
        let ship = Motion {
            covariance: Some(covariance),
            solution: Solution { sigma, ..ship.solution },
            ..ship
        };
        let antenna = ship.at_point(&Body::new(arm, 0.0, 0.0)).solution.sigma.position;
        assert_relative_eq!(antenna.0.x, 0.01, epsilon = 1e-9);
        let stern = ship.at_point(&Body::new(-arm, 0.0, 0.0)).solution.sigma.position;
        assert_relative_eq!(stern.0.x, 0.8, epsilon = 1e-3);
    }

    #[test]
    fn what_is_claimed_beyond_the_covariance_is_claimed_of_every_point() {
        let ship = turning();
        let doubted = SolutionSigma { position: Ned::new(300.0, 0.0, 0.0), ..ship.solution.sigma };
        let solution = Solution { sigma: doubted, ..ship.solution };
        let covariance = Some(MotionCovariance::identity() * 1e-6);
        let bow = Motion { solution, covariance, ..ship }.at_point(&Body::new(40.0, 0.0, 0.0));
        assert!(bow.solution.sigma.position.0.x >= 300.0);
        assert_relative_eq!(bow.solution.sigma.heading, 0.01, epsilon = 1e-6);
    }
}
