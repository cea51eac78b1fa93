//! The error states: which errors the filter estimates, in which axes and units.
//!
//! Errors are true minus estimated; the attitude error is the small rotation phi in
//! C_true = (I + [phi x]) C_estimated, resolved in ECEF axes. Blocks 1-15 of JAE's hybrid filter
//! (docs/systems.md, S2) are position, velocity, attitude, gyro and accelerometer errors; the others make
//! the sensors honest.

use std::slice::from_mut;

pub use insd_estimation::{Block, Covariance, Effects, Errors, Innovation, Jacobian, Weighed};

use insd_estimation::{Key, Layout};

use crate::declaration::{Carried, Correction, Declaration, Process, StateAxes};
pub use crate::dimensions::{
    ANTENNA_ROWS, CAMERA_POSES, LANDMARKS, LINES, ODOMETRY_POSES, POSE_STATES, RANGING_MARKS,
    SATELLITES,
};

/// How long reflections of phases go on between antennas, s.
const ANTENNA_REFLECTION_TIME: f64 = 180.0;
/// 1-sigma of a line before anything is known of it, m: so much more than a phase is worth that it tells nothing.
pub(crate) const LINE_UNKNOWN: f64 = 1.0;
/// By what it wanders, m per root of a second.
const LINE_WALK: f64 = 5e-5;
/// 1-sigma of a receiver's clock before anything is known of it, m and m/s: a millisecond.
const CLOCK_UNKNOWN: f64 = 3e5;
/// 1-sigma of the offset between two systems in a receiver, m.
pub(crate) const OFFSET_UNKNOWN: f64 = 100.0;
/// Its random walk, m per root of a second.
const OFFSET_WALK: f64 = 1e-3;
/// By what share the ionosphere is other than its model, 1-sigma (IS-GPS-200N, 20.3.3.5.2.5: the model takes half of it away), and for how long, s.
pub(crate) const IONOSPHERE_UNKNOWN: f64 = 0.5;
const IONOSPHERE_TIME: f64 = 7200.0;
/// How long orbits, clocks and the ionosphere go on to be wrong by the same, s.
const RANGE_ERROR_TIME: f64 = 3600.0;
/// How long reflections go on, s: a ship passes through their pattern within a minute.
const REFLECTION_TIME: f64 = 300.0;
/// By what a phase drifts for an hour, 1-sigma, m/s: sums of differences of real phases drift by as much (docs/satellites.md).
pub const PHASE_DRIFT: f64 = 5e-4;
/// By what its reflections walk beside that, m per root of a second.
const PHASE_WALK: f64 = 5e-4;

/// How long their surveys, and the zeros of their instruments, go on to be off by the same, s.
const SURVEY_TIME: f64 = 7200.0;

/// By what the delay of a camera wanders, s per root of a second.
const CAMERA_DELAY_WALK: f64 = 1e-5;

/// How long the slow part of the error of a reference's heading lasts, s.
const HEADING_ERROR_TIME: f64 = 600.0;
/// Time of what stays of a reference's position, s: with the weather and the season, and as she sails on.
const POSITION_ERROR_TIME: f64 = 10_800.0;
/// 1-sigma of the mean height before anything is known of it, m.
pub(crate) const SEA_LEVEL_UNKNOWN: f64 = 30.0;

/// One row for each block of error states, in the order in which they stand when all are carried.
macro_rules! declare {
    ($($(#[$doc:meta])+ $block:ident: $width:expr, $name:literal, $unit:literal, $axes:ident, $carried:ident,
        first: $first:expr, process: $process:expr, correction: $correction:expr;)+) => {
        #[allow(non_camel_case_types, clippy::upper_case_acronyms)] // named as the blocks are
        enum Kind { $($block),+ }
        $($(#[$doc])+ pub const $block: Block<{ $width }> = Block::new(Kind::$block as u16);)+
        /// What is known of each, by the number of its kind.
        pub static DECLARATIONS: [Declaration; [$($width),+].len()] = [$(Declaration {
            key: $block.key(),
            width: $width,
            name: $name,
            unit: $unit,
            axes: StateAxes::$axes,
            carried: Carried::$carried,
            first: $first,
            process: $process,
            correction: $correction,
        }),+];
    };
}

declare! {
    /// Position, ECEF, m.
    POSITION: 3, "position", "m", Ecef, Always,
        first: |_| 0.0, process: |_, _| Process::Mechanised,
        correction: Correction::Adds(|nominal| nominal.position.as_mut_slice());
    /// Velocity over the Earth, ECEF axes, m/s.
    VELOCITY: 3, "velocity", "m/s", Ecef, Always,
        first: |_| 0.0, process: |_, _| Process::Mechanised,
        correction: Correction::Adds(|nominal| nominal.velocity.as_mut_slice());
    /// Attitude, small rotation in ECEF axes, rad.
    ATTITUDE: 3, "attitude", "rad", Ecef, Always,
        first: |_| 0.0, process: |_, _| Process::Mechanised,
        correction: Correction::Turns;
    /// Gyro turn-on bias, body axes, rad/s, constant.
    GYRO_BIAS: 3, "gyro_bias", "rad/s", Body, Always,
        first: |config| config.imu.gyro.bias_std, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.gyro_bias.as_mut_slice());
    /// Gyro in-run bias, body axes, rad/s, Gauss-Markov.
    GYRO_DRIFT: 3, "gyro_drift", "rad/s", Body, Always,
        first: |config| config.imu.gyro.instability_std,
        process: |config, _| Process::in_run(&config.imu.gyro),
        correction: Correction::Adds(|nominal| nominal.gyro_drift.as_mut_slice());
    /// Gyro scale factor, body axes, ratio, constant.
    GYRO_SCALE: 3, "gyro_scale", "ratio", Body, Always,
        first: |config| config.imu.gyro.scale_std, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.gyro_scale.as_mut_slice());
    /// Accelerometer turn-on bias, body axes, m/s^2, constant.
    ACCEL_BIAS: 3, "accel_bias", "m/s^2", Body, Always,
        first: |config| config.imu.accel.bias_std, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.accel_bias.as_mut_slice());
    /// Accelerometer in-run bias, body axes, m/s^2, Gauss-Markov.
    ACCEL_DRIFT: 3, "accel_drift", "m/s^2", Body, Always,
        first: |config| config.imu.accel.instability_std,
        process: |config, _| Process::in_run(&config.imu.accel),
        correction: Correction::Adds(|nominal| nominal.accel_drift.as_mut_slice());
    /// Accelerometer scale factor, body axes, ratio, constant.
    ACCEL_SCALE: 3, "accel_scale", "ratio", Body, Always,
        first: |config| config.imu.accel.scale_std, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.accel_scale.as_mut_slice());
    /// Slowly varying part of the GNSS position error, NED, in units of its own sigma, Gauss-Markov.
    GNSS_POSITION_ERROR: 3, "gnss_position_error", "sigma", Ned, Always,
        first: |_| 1.0,
        process: |config, regime| Process::of_sigmas(config.gnss.position_time_for(regime.rtk)),
        correction: Correction::Adds(|nominal| nominal.gnss_position_error.as_mut_slice());
    /// Slowly varying part of the GNSS velocity error, NED, in units of its own sigma, Gauss-Markov.
    GNSS_VELOCITY_ERROR: 3, "gnss_velocity_error", "sigma", Ned, Always,
        first: |_| 1.0, process: |config, _| Process::of_sigmas(config.gnss.velocity_time),
        correction: Correction::Adds(|nominal| nominal.gnss_velocity_error.as_mut_slice());
    /// Delay of the GNSS velocity behind the position of the same epoch, s, constant.
    GNSS_VELOCITY_DELAY: 1, "gnss_velocity_delay", "s", Scalar, Always,
        first: |config| config.gnss.velocity_delay_std, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.gnss_velocity_delay));
    /// Delay of GNSS epochs behind the IMU's time base, s, constant.
    GNSS_DELAY: 1, "gnss_delay", "s", Scalar, Always,
        first: |config| config.gnss.delay_std, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.gnss_delay));
    /// Lever arm from the IMU to the GNSS antenna, body axes, m, constant if it was measured, else a random walk.
    GNSS_LEVER: 3, "gnss_lever", "m", Body, Always,
        first: |config| config.gnss_lever_std(),
        process: |config, _| config.gnss_lever_walk().map_or(Process::Constant, Process::Walk),
        correction: Correction::Adds(|nominal| nominal.gnss_lever.as_mut_slice());
    /// Mean height of the IMU over the ellipsoid (sea level plus mounting height), m, random walk.
    SEA_LEVEL: 1, "sea_level", "m", Scalar, Always,
        first: |_| SEA_LEVEL_UNKNOWN, process: |config, _| Process::Walk(config.sea.level_walk),
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.sea_level));
    /// Water current, north and east, m/s, Gauss-Markov.
    CURRENT: 2, "current", "m/s", Ned, WithLog,
        first: |config| config.log.current_std,
        process: |config, _| Process::Markov { std: config.log.current_std, time: config.log.current_time },
        correction: Correction::Adds(|nominal| nominal.current.as_mut_slice());
    /// Log scale factor, ratio, constant.
    LOG_SCALE: 1, "log_scale", "ratio", Scalar, WithLog,
        first: |config| config.log.scale_std, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.log_scale));
    /// Log misalignment about the starboard and down axes, rad, constant.
    LOG_MISALIGNMENT: 2, "log_misalignment", "rad", Body, WithLog,
        first: |config| config.log.misalignment_std, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.log_misalignment.as_mut_slice());
    /// By what the scale factor of a log and its turn change with the speed, forward and starboard, 1/(m/s), constant.
    LOG_BY_SPEED: 2, "log_by_speed", "s/m", Body, WithLearning,
        first: |config| config.log.shape.map_or(0.0, |shape| shape.by_speed_std()), process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.log_by_speed.as_mut_slice());
    /// What a log adds while she turns, forward by the size of the rate of turn and to starboard by the rate, m, constant.
    LOG_BY_TURN: 2, "log_by_turn", "m", Body, WithLearning,
        first: |config| config.log.shape.map_or(0.0, |shape| shape.by_turn_std()), process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.log_by_turn.as_mut_slice());
    /// By what the biases of gyros change with the temperature of the IMU, body axes, rad/s/K, constant.
    GYRO_THERMAL: 3, "gyro_thermal", "rad/s/K", Body, WithTemperature,
        first: |config| config.thermal.map_or(config.imu.gyro.thermal_slope_std(), |known| known.gyro.slope_std()),
        process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.gyro_thermal.as_mut_slice());
    /// The bend of that change: by the square of how much warmer it is, body axes, rad/s/K^2, constant.
    GYRO_THERMAL_BEND: 3, "gyro_thermal_bend", "rad/s/K^2", Body, WithTemperature,
        first: |config| config.thermal.map_or(config.imu.gyro.thermal_bend_std(), |known| known.gyro.bend_std()),
        process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.gyro_thermal_bend.as_mut_slice());
    /// By what the biases of accelerometers change with it, body axes, m/s^2/K, constant.
    ACCEL_THERMAL: 3, "accel_thermal", "m/s^2/K", Body, WithTemperature,
        first: |config| config.thermal.map_or(config.imu.accel.thermal_slope_std(), |known| known.accel.slope_std()),
        process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.accel_thermal.as_mut_slice());
    /// The bend of that change, body axes, m/s^2/K^2, constant.
    ACCEL_THERMAL_BEND: 3, "accel_thermal_bend", "m/s^2/K^2", Body, WithTemperature,
        first: |config| config.thermal.map_or(config.imu.accel.thermal_bend_std(), |known| known.accel.bend_std()),
        process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.accel_thermal_bend.as_mut_slice());
    /// Slowly varying part of the error of a reference's heading, in units of the sigma it states, Gauss-Markov.
    HEADING_ERROR: 1, "heading_error", "sigma", Scalar, WithHeading,
        first: |_| 1.0, process: |_, _| Process::of_sigmas(HEADING_ERROR_TIME),
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.heading_error));
    /// What stays for hours of the error of a reference's position, north and east, in units of the sigma it states for that, Gauss-Markov.
    POSITION_ERROR: 2, "position_error", "sigma", Ned, WithPosition,
        first: |_| 1.0, process: |_, _| Process::of_sigmas(POSITION_ERROR_TIME),
        correction: Correction::Adds(|nominal| nominal.position_error.as_mut_slice());
    /// Clock of the receiver of ranges against GPS time and its drift, m and m/s.
    RECEIVER_CLOCK: 2, "receiver_clock", "m, m/s", Scalar, WithRanges,
        first: |_| CLOCK_UNKNOWN, process: |_, _| Process::Clock,
        correction: Correction::Adds(|nominal| nominal.receiver_clock.as_mut_slice());
    /// What it adds for Galileo, BeiDou and GLONASS, m, random walk.
    SYSTEM_OFFSETS: 3, "system_offsets", "m", Scalar, WithRanges,
        first: |_| OFFSET_UNKNOWN, process: |_, _| Process::Walk(OFFSET_WALK),
        correction: Correction::Adds(|nominal| nominal.system_offsets.as_mut_slice());
    /// Share by which the ionosphere as a whole is more than its model, Gauss-Markov.
    IONOSPHERE: 1, "ionosphere", "ratio", Scalar, WithRanges,
        first: |_| IONOSPHERE_UNKNOWN,
        process: |_, _| Process::Markov { std: IONOSPHERE_UNKNOWN, time: IONOSPHERE_TIME },
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.ionosphere));
    /// Slowly varying error of the code of each satellite in use, in units of its own sigma, Gauss-Markov.
    RANGE_ERRORS: SATELLITES, "range_errors", "sigma", Scalar, WithRanges,
        first: |_| 1.0, process: |_, _| Process::of_sigmas(RANGE_ERROR_TIME),
        correction: Correction::Adds(|nominal| nominal.range_errors.as_mut_slice());
    /// What reflections add to the code of each, in units of its sigma, Gauss-Markov.
    REFLECTIONS: SATELLITES, "reflections", "sigma", Scalar, WithRanges,
        first: |_| 1.0, process: |_, _| Process::of_sigmas(REFLECTION_TIME),
        correction: Correction::Adds(|nominal| nominal.reflections.as_mut_slice());
    /// Constant of the phase of each, m, random walk.
    PHASE_CONSTANTS: SATELLITES, "phase_constants", "m", Scalar, WithRanges,
        first: |_| 1.0, process: |_, _| Process::Walk(PHASE_WALK),
        correction: Correction::Adds(|nominal| nominal.phase_constants.as_mut_slice());
    /// What orbit, clock and ionosphere make each constant drift by, m/s, Gauss-Markov.
    PHASE_DRIFTS: SATELLITES, "phase_drifts", "m/s", Scalar, WithRanges,
        first: |_| PHASE_DRIFT,
        process: |_, _| Process::Markov { std: PHASE_DRIFT, time: RANGE_ERROR_TIME },
        correction: Correction::Adds(|nominal| nominal.phase_drifts.as_mut_slice());
    /// Where the IMU was some seconds before, ECEF, m, constant: a copy of the position as it was then.
    EARLIER_PLACE: 3, "earlier_place", "m", Ecef, WithRanges,
        first: |_| 0.0, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.earlier_place.as_mut_slice());
    /// What cables and receivers add to the phases of antennas beside the first, m, random walk.
    ANTENNA_LINES: LINES, "antenna_lines", "m", Scalar, WithAntennas,
        first: |_| LINE_UNKNOWN, process: |_, _| Process::Walk(LINE_WALK),
        correction: Correction::Adds(|nominal| nominal.antenna_lines.as_mut_slice());
    /// How the antennas that are a compass sit otherwise than configured, small rotation about body axes, rad, constant.
    ANTENNA_AXES: 3, "antenna_axes", "rad", Body, WithAntennas,
        first: |config| config.antennas.axes_std.max(), process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.antenna_axes.as_mut_slice());
    /// What reflections add to each row of what antennas tell, in units of the row's sigma, Gauss-Markov.
    ANTENNA_REFLECTIONS: ANTENNA_ROWS, "antenna_reflections", "sigma", Scalar, WithAntennas,
        first: |_| 1.0, process: |_, _| Process::of_sigmas(ANTENNA_REFLECTION_TIME),
        correction: Correction::Adds(|nominal| nominal.antenna_reflections.as_mut_slice());
    /// What reflections add to a heading that several antennas tell, in units of its sigma, Gauss-Markov.
    ANTENNA_HEADING_ERROR: 1, "antenna_heading_error", "sigma", Scalar, WithAntennaHeading,
        first: |_| 1.0, process: |_, _| Process::of_sigmas(ANTENNA_REFLECTION_TIME),
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.antenna_heading_error));
    /// By how much more the antennas sit turned than configured, rad, constant.
    ANTENNA_HEADING_OFFSET: 1, "antenna_heading_offset", "rad", Scalar, WithAntennaHeading,
        first: |config| config.antennas.axes_std.z, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.antenna_heading_offset));
    /// What the survey of each line and point ashore that a docking aid measures to is off by, in units of its sigma, Gauss-Markov: of a line
    /// across it at its first end and at its second; of a point north, east and down.
    RANGING_ERRORS: 3 * RANGING_MARKS, "ranging_errors", "sigma", Scalar, WithRanging,
        first: |_| 1.0, process: |_, _| Process::of_sigmas(SURVEY_TIME),
        correction: Correction::Adds(|nominal| nominal.ranging_errors.as_mut_slice());
    /// Position, ECEF, m, and attitude, small rotation in ECEF axes, rad, at times of images ([`crate::camera`]).
    POSES: POSE_STATES * CAMERA_POSES, "poses", "m, rad", Ecef, WithTracks,
        first: |_| 0.0, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.poses.as_mut_slice());
    /// Points of the world that a camera sees, ECEF, m.
    LANDMARK_POINTS: 3 * LANDMARKS, "landmarks", "m", Ecef, WithTracks,
        first: |_| 0.0, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.landmarks.as_mut_slice());
    /// How a camera sits otherwise than configured, small rotation about body axes, rad, constant.
    CAMERA_AXES: 3, "camera_axes", "rad", Body, WithCamera,
        first: |config| config.camera.map_or(0.0, |camera| camera.axes_std),
        process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.camera_axes.as_mut_slice());
    /// By how much images were taken later than they are stamped, s, random walk.
    CAMERA_DELAY: 1, "camera_delay", "s", Scalar, WithCamera,
        first: |config| config.camera.map_or(0.0, |camera| camera.delay_std),
        process: |_, _| Process::Walk(CAMERA_DELAY_WALK),
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.camera_delay));
    /// Position, ECEF, m, and attitude, small rotation in ECEF axes, rad, at times of keyframes of a visual odometry ([`crate::camera::step`]).
    VO_POSES: POSE_STATES * ODOMETRY_POSES, "vo_poses", "m, rad", Ecef, WithOdometry,
        first: |_| 0.0, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.vo_poses.as_mut_slice());
    /// By how much the scale of a map of a visual odometry is more than one, ratio, random walk.
    VO_SCALE: 1, "vo_scale", "ratio", Scalar, WithOdometry,
        first: |config| config.odometry().scale_std,
        process: |config, _| Process::Walk(config.odometry().scale_walk),
        correction: Correction::Adds(|nominal| from_mut(&mut nominal.vo_scale));
    /// By what all turns of a visual odometry since one keyframe are off, camera axes, in units of the sigma of the step, constant.
    VO_ATTITUDE_DRIFT: 3, "vo_attitude_drift", "sigma", Scalar, WithOdometry,
        first: |_| 1.0, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.vo_attitude_drift.as_mut_slice());
    /// By what all ways of a visual odometry since one keyframe are off, camera axes, in units of the sigma of the step, constant.
    VO_TRAJECTORY_DRIFT: 3, "vo_trajectory_drift", "sigma", Scalar, WithOdometry,
        first: |_| 1.0, process: |_, _| Process::Constant,
        correction: Correction::Adds(|nominal| nominal.vo_trajectory_drift.as_mut_slice());
    /// Mean place of a moored ship from her named berth, north and east, m, constant but for shifts.
    BERTH_OFFSET: 2, "berth_offset", "m", ComputedNed, AtBerth,
        first: |_| 0.0, process: |_, _| Process::Constant,
        correction: Correction::AddsTurned(|nominal| nominal.berth_offset.as_mut_slice());
    /// Slow swaying of a moored ship about that place, north and east of each of two oscillators, m.
    SWAY: 4, "sway", "m", ComputedNed, AtBerth,
        first: |_| 0.0, process: |_, _| Process::Swaying,
        correction: Correction::AddsTurned(|nominal| nominal.sway.as_mut_slice());
    /// Velocity of that swaying, m/s.
    SWAY_VELOCITY: 4, "sway_velocity", "m/s", ComputedNed, AtBerth,
        first: |_| 0.0, process: |_, _| Process::Swaying,
        correction: Correction::AddsTurned(|nominal| nominal.sway_velocity.as_mut_slice());
}

/// Number of states at the head that the strapdown integrates: position, velocity, attitude.
pub const STRAPDOWN_STATES: usize = 9;

/// The declaration of a kind.
#[must_use]
pub fn declaration(key: Key) -> Option<&'static Declaration> {
    DECLARATIONS.get(usize::from(key.kind))
}

/// All that are carried at such a time.
pub fn carried(when: Carried) -> impl Iterator<Item = &'static Declaration> {
    DECLARATIONS.iter().filter(move |declaration| declaration.carried == when)
}

/// All states that there may be, in the order of their declarations.
#[must_use]
pub fn all_states() -> Layout {
    Layout::of_blocks(DECLARATIONS.iter().map(|own| (own.key, own.width)))
}

/// All of them known.
#[must_use]
pub fn no_covariance() -> Covariance {
    Covariance::zeros(&all_states())
}

/// No error of any of them.
#[must_use]
pub fn no_errors() -> Errors {
    Errors::zeros(&all_states())
}
