//! The estimate itself: position, velocity, attitude and every sensor error, around which the error
//! state is linear.

use insd_base::earth;
use insd_base::{Ecef, Geodetic};
use nalgebra::{Matrix3, Rotation2, SVector, UnitQuaternion, Vector2, Vector3, Vector4};
use serde::{Deserialize, Serialize};

use crate::declaration::{declaration, no_errors};
use crate::error_state::{
    ANTENNA_ROWS, ATTITUDE, CAMERA_POSES, DECLARATIONS, Errors, LANDMARKS, LINES, ODOMETRY_POSES,
    POSE_STATES, POSITION, RANGING_MARKS, SATELLITES,
};

/// Estimated values of everything in the error state; units and axes as stated there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nominal {
    /// Position of the IMU, ECEF, m.
    pub position: Vector3<f64>,
    /// Velocity over the Earth, ECEF axes, m/s.
    pub velocity: Vector3<f64>,
    /// Rotation from body to ECEF axes.
    pub attitude: UnitQuaternion<f64>,
    /// Gyro turn-on bias, rad/s.
    pub gyro_bias: Vector3<f64>,
    /// Gyro in-run bias, rad/s.
    pub gyro_drift: Vector3<f64>,
    /// Gyro scale factor, ratio.
    pub gyro_scale: Vector3<f64>,
    /// Accelerometer turn-on bias, m/s^2.
    pub accel_bias: Vector3<f64>,
    /// Accelerometer in-run bias, m/s^2.
    pub accel_drift: Vector3<f64>,
    /// Accelerometer scale factor, ratio.
    pub accel_scale: Vector3<f64>,
    /// Slow GNSS position error, NED, sigmas.
    pub gnss_position_error: Vector3<f64>,
    /// Slow GNSS velocity error, NED, sigmas.
    pub gnss_velocity_error: Vector3<f64>,
    /// Correction of the stated lever arm of the GNSS antenna, body axes, m.
    pub gnss_lever: Vector3<f64>,
    /// Delay of GNSS epochs behind the IMU's time base, s.
    pub gnss_delay: f64,
    /// Delay of the GNSS velocity behind the position, s.
    pub gnss_velocity_delay: f64,
    /// Water current, north and east, m/s.
    pub current: Vector2<f64>,
    /// Mean place from the named berth, north and east, m.
    pub berth_offset: Vector2<f64>,
    /// Slow swaying about that place, north and east of each oscillator, m.
    pub sway: Vector4<f64>,
    /// Velocity of that swaying, m/s.
    pub sway_velocity: Vector4<f64>,
    /// Log scale factor, ratio.
    pub log_scale: f64,
    /// Log misalignment about starboard and down, rad.
    pub log_misalignment: Vector2<f64>,
    /// By what the scale factor of the log changes with the speed, 1/(m/s).
    pub log_by_speed: f64,
    /// What it adds to starboard while she turns, by the rate of turn, m.
    pub log_by_turn: f64,
    /// Mean height, m.
    pub sea_level: f64,
    /// Slow error of a reference's heading, sigmas.
    pub heading_error: f64,
    /// Clock of the receiver of ranges ahead, m, and its drift, m/s.
    pub receiver_clock: Vector2<f64>,
    /// What it adds for Galileo, BeiDou and GLONASS, m.
    pub system_offsets: Vector3<f64>,
    /// Share by which the ionosphere is more than its model.
    pub ionosphere: f64,
    /// Slow error of each satellite's code, sigmas.
    pub range_errors: SVector<f64, SATELLITES>,
    /// What reflections add to each satellite's code, sigmas.
    pub reflections: SVector<f64, SATELLITES>,
    /// Constant of each satellite's phase, m.
    pub phase_constants: SVector<f64, SATELLITES>,
    /// Its drift, m/s.
    pub phase_drifts: SVector<f64, SATELLITES>,
    /// By how much the place of some seconds before has been corrected since it was held against earlier ones, ECEF, m.
    pub earlier_place: Vector3<f64>,
    /// What the line of each antenna adds to its phases, m.
    pub antenna_lines: SVector<f64, LINES>,
    /// How antennas sit otherwise than configured, rotation about body axes, rad.
    pub antenna_axes: Vector3<f64>,
    /// What reflections add to each row of what antennas tell, sigmas.
    pub antenna_reflections: SVector<f64, ANTENNA_ROWS>,
    /// What the survey of each mark of docking aids is off by, sigmas.
    pub ranging_errors: SVector<f64, { 3 * RANGING_MARKS }>,
    /// By what each pose at the time of an image was corrected since it was first estimated, m and rad, ECEF axes.
    pub poses: SVector<f64, { POSE_STATES * CAMERA_POSES }>,
    /// The same of each landmark, m.
    pub landmarks: SVector<f64, { 3 * LANDMARKS }>,
    /// How a camera sits otherwise than configured, rotation about body axes, rad.
    pub camera_axes: Vector3<f64>,
    /// By how much images were taken later than they are stamped, s.
    pub camera_delay: f64,
    /// By what each pose at a keyframe of a visual odometry was corrected since it was first estimated, m and rad, ECEF axes.
    pub vo_poses: SVector<f64, { POSE_STATES * ODOMETRY_POSES }>,
    /// By how much the scale of its map is more than one.
    pub vo_scale: f64,
    /// By what its turns since the keyframe are off, sigmas.
    pub vo_attitude_drift: Vector3<f64>,
    /// By what its ways since the keyframe are off, sigmas.
    pub vo_trajectory_drift: Vector3<f64>,
}

impl Nominal {
    /// An estimate of place, motion and attitude with all sensor errors taken as zero.
    #[must_use]
    pub fn at(position: &Geodetic, v_n: &Vector3<f64>, c_nb: &Matrix3<f64>) -> Self {
        let c_en = earth::c_ne(position).transpose();
        Nominal {
            position: earth::ecef(position).0,
            velocity: c_en * v_n,
            attitude: UnitQuaternion::from_matrix(&(c_en * c_nb)),
            gyro_bias: Vector3::zeros(),
            gyro_drift: Vector3::zeros(),
            gyro_scale: Vector3::zeros(),
            accel_bias: Vector3::zeros(),
            accel_drift: Vector3::zeros(),
            accel_scale: Vector3::zeros(),
            gnss_position_error: Vector3::zeros(),
            gnss_velocity_error: Vector3::zeros(),
            gnss_lever: Vector3::zeros(),
            gnss_delay: 0.0,
            gnss_velocity_delay: 0.0,
            current: Vector2::zeros(),
            berth_offset: Vector2::zeros(),
            sway: Vector4::zeros(),
            sway_velocity: Vector4::zeros(),
            log_scale: 0.0,
            log_misalignment: Vector2::zeros(),
            log_by_speed: 0.0,
            log_by_turn: 0.0,
            sea_level: position.height,
            heading_error: 0.0,
            receiver_clock: Vector2::zeros(),
            system_offsets: Vector3::zeros(),
            range_errors: SVector::zeros(),
            ionosphere: 0.0,
            reflections: SVector::zeros(),
            phase_constants: SVector::zeros(),
            phase_drifts: SVector::zeros(),
            earlier_place: Vector3::zeros(),
            antenna_lines: SVector::zeros(),
            antenna_axes: Vector3::zeros(),
            antenna_reflections: SVector::zeros(),
            ranging_errors: SVector::zeros(),
            poses: SVector::zeros(),
            landmarks: SVector::zeros(),
            camera_axes: Vector3::zeros(),
            camera_delay: 0.0,
            vo_poses: SVector::zeros(),
            vo_scale: 0.0,
            vo_attitude_drift: Vector3::zeros(),
            vo_trajectory_drift: Vector3::zeros(),
        }
    }

    /// Whether it can be a ship's: numbers only, on the Earth, a rotation that is one.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let far = (self.position.norm() / earth::SEMI_MAJOR - 1.0).abs();
        let rotation = (self.attitude.as_ref().norm() - 1.0).abs();
        let none = Nominal { attitude: UnitQuaternion::identity(), ..*self };
        let zero = Nominal::at(
            &Geodetic::from_degrees(0.0, 0.0, 0.0),
            &Vector3::zeros(),
            &Matrix3::identity(),
        );
        far < 0.01 && rotation < 1e-6 && zero.error_to(&none).values().iter().all(|x| x.is_finite())
    }

    /// Slow swaying, both oscillators together, north and east, m.
    #[must_use]
    pub fn swaying(&self) -> Vector2<f64> {
        self.sway.fixed_rows::<2>(0) + self.sway.fixed_rows::<2>(2)
    }

    /// Geodetic position of the IMU.
    #[must_use]
    pub fn geodetic(&self) -> Geodetic {
        earth::geodetic(&Ecef(self.position))
    }

    /// Rotation from body to ECEF axes.
    #[must_use]
    pub fn c_eb(&self) -> Matrix3<f64> {
        self.attitude.to_rotation_matrix().into_inner()
    }

    /// Moves the estimate by an error vector: estimated + error = true. The swaying of a moored ship
    /// is held in the axes of the computed heading and turns with it ([`crate::aids::berth`]).
    pub fn inject(&mut self, error: &Errors) {
        let rotation = error.of(ATTITUDE);
        self.attitude = UnitQuaternion::new(rotation) * self.attitude;
        self.position += error.of(POSITION);
        let turn = turn_about_down(&rotation, &self.position);
        for place in error.layout().places().iter().filter(|place| place.key != POSITION.key()) {
            let Some(declared) = declaration(place.key) else { continue };
            let value = declared.value(self);
            if declared.turns_with_heading() {
                turn_pairs(&turn, value);
            }
            let own = &error.values().as_slice()[place.start..place.start + place.width];
            value.iter_mut().zip(own).for_each(|(value, error)| *value += error);
        }
    }

    /// The error vector that moves this estimate onto another: the inverse of [`Self::inject`]. It has all states that there may
    /// be.
    #[must_use]
    pub fn error_to(&self, other: &Nominal) -> Errors {
        let mut error = no_errors();
        let rotation = (other.attitude * self.attitude.inverse()).scaled_axis();
        let turn = turn_about_down(&rotation, &other.position);
        let (mut here, mut there) = (*self, *other);
        for declared in &DECLARATIONS {
            let own = declared.value(&mut here);
            if declared.turns_with_heading() {
                turn_pairs(&turn, own);
            }
            let difference = declared.value(&mut there).iter_mut().zip(own).map(|(a, b)| *a - *b);
            error.fill(declared.key, difference);
        }
        error.set(ATTITUDE, &rotation);
        error
    }
}

/// The part of a small rotation, ECEF axes, that turns the horizontal axes at a place.
///
/// Down is minus the normal of the ellipsoid, which is along (x/a^2, y/a^2, z/b^2).
fn turn_about_down(rotation: &Vector3<f64>, place: &Vector3<f64>) -> Rotation2<f64> {
    let flat = 1.0 - earth::ECCENTRICITY_SQ;
    let up = Vector3::new(place.x, place.y, place.z / flat).normalize();
    Rotation2::new(-rotation.dot(&up))
}

/// Turns pairs of north and east.
fn turn_pairs(turn: &Rotation2<f64>, pairs: &mut [f64]) {
    for pair in pairs.chunks_exact_mut(2) {
        let turned = turn * Vector2::new(pair[0], pair[1]);
        pair.copy_from_slice(turned.as_slice());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declaration::all_states;
    use approx::assert_relative_eq;

    #[test]
    fn injecting_the_error_to_another_estimate_reaches_it() {
        let here = Geodetic::from_degrees(35.0, 139.0, 10.0);
        let start = Nominal::at(&here, &Vector3::new(1.0, 2.0, 0.1), &Matrix3::identity());
        let mut error = Errors::zeros(&all_states());
        let count = all_states().states() as f64;
        for (i, place) in all_states().places().iter().enumerate() {
            let own = |k: usize| 1e-3 * ((i + k) as f64 + 1.0) / count;
            error.fill(place.key, (0..place.width).map(own));
        }
        let mut moved = start;
        moved.inject(&error);
        assert_relative_eq!(start.error_to(&moved).values(), error.values(), epsilon = 1e-9);
    }
}
