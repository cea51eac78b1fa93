//! The estimate itself: position, velocity, attitude and every sensor error, around which the error
//! state is linear.

use insd_base::earth;
use insd_base::{Ecef, Geodetic};
use nalgebra::{Matrix3, SVector, UnitQuaternion, Vector2, Vector3, Vector4};
use serde::{Deserialize, Serialize};

use crate::dimensions::{
    ANTENNA_ROWS, CAMERA_POSES, LANDMARKS, LINES, ODOMETRY_POSES, POSE_STATES, RANGING_MARKS,
    SATELLITES,
};

/// How warm the IMU is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ThermalReading {
    /// Temperature at which changes with it are none, degrees Celsius.
    pub reference: Option<f64>,
    /// How much warmer it is, K; zero while nothing is made of it.
    pub above: f64,
}

impl ThermalReading {
    /// What a slope, unit per K, and a bend, unit per K^2, come to at this temperature.
    #[must_use]
    pub fn change(&self, slope: &Vector3<f64>, bend: &Vector3<f64>) -> Vector3<f64> {
        (slope + bend * self.above) * self.above
    }
}

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
    /// By what gyro biases change with the temperature, rad/s/K.
    pub gyro_thermal: Vector3<f64>,
    /// The bend of that change, rad/s/K^2.
    pub gyro_thermal_bend: Vector3<f64>,
    /// By what accelerometer biases change with the temperature, m/s^2/K.
    pub accel_thermal: Vector3<f64>,
    /// The bend of that change, m/s^2/K^2.
    pub accel_thermal_bend: Vector3<f64>,
    /// What the temperature is against which they count: felt, not estimated.
    pub warmth: ThermalReading,
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
    /// By what the scale factor of the log and its turn change with the speed, 1/(m/s).
    pub log_by_speed: Vector2<f64>,
    /// What it adds while she turns, forward by the size of the rate of turn and to starboard by the rate, m.
    pub log_by_turn: Vector2<f64>,
    /// Mean height, m.
    pub sea_level: f64,
    /// Slow error of a reference's heading, sigmas.
    pub heading_error: f64,
    /// What stays of the error of a reference's position, north and east, in units of the sigma it states for that.
    pub position_error: Vector2<f64>,
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
    /// What reflections add to a heading that several antennas tell, sigmas.
    pub antenna_heading_error: f64,
    /// By how much more the antennas sit turned than configured, rad.
    pub antenna_heading_offset: f64,
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
            gyro_thermal: Vector3::zeros(),
            gyro_thermal_bend: Vector3::zeros(),
            accel_thermal: Vector3::zeros(),
            accel_thermal_bend: Vector3::zeros(),
            warmth: ThermalReading::default(),
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
            log_by_speed: Vector2::zeros(),
            log_by_turn: Vector2::zeros(),
            sea_level: position.height,
            heading_error: 0.0,
            position_error: Vector2::zeros(),
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
            antenna_heading_error: 0.0,
            antenna_heading_offset: 0.0,
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
}
