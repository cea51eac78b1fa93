//! The error state: which errors the filter estimates, in which axes and units.
//!
//! Errors are true minus estimated; the attitude error is the small rotation phi in
//! C_true = (I + [phi x]) C_estimated, resolved in ECEF axes. Blocks 1-15 of JAE's hybrid filter
//! (systems.md S2) are position, velocity, attitude, gyro and accelerometer errors; the others make
//! the sensors honest.

use nalgebra::{SMatrix, SVector};

use crate::block::Block;

/// Position, ECEF, m.
pub const POSITION: Block<3> = Block::first();
/// Velocity over the Earth, ECEF axes, m/s.
pub const VELOCITY: Block<3> = Block::after(POSITION);
/// Attitude, small rotation in ECEF axes, rad.
pub const ATTITUDE: Block<3> = Block::after(VELOCITY);
/// Gyro turn-on bias, body axes, rad/s, constant.
pub const GYRO_BIAS: Block<3> = Block::after(ATTITUDE);
/// Gyro in-run bias, body axes, rad/s, Gauss-Markov.
pub const GYRO_DRIFT: Block<3> = Block::after(GYRO_BIAS);
/// Gyro scale factor, body axes, ratio, constant.
pub const GYRO_SCALE: Block<3> = Block::after(GYRO_DRIFT);
/// Accelerometer turn-on bias, body axes, m/s^2, constant.
pub const ACCEL_BIAS: Block<3> = Block::after(GYRO_SCALE);
/// Accelerometer in-run bias, body axes, m/s^2, Gauss-Markov.
pub const ACCEL_DRIFT: Block<3> = Block::after(ACCEL_BIAS);
/// Accelerometer scale factor, body axes, ratio, constant.
pub const ACCEL_SCALE: Block<3> = Block::after(ACCEL_DRIFT);
/// Slowly varying part of the GNSS position error, NED, in units of its own sigma, Gauss-Markov.
pub const GNSS_POSITION_ERROR: Block<3> = Block::after(ACCEL_SCALE);
/// Slowly varying part of the GNSS velocity error, NED, in units of its own sigma, Gauss-Markov.
pub const GNSS_VELOCITY_ERROR: Block<3> = Block::after(GNSS_POSITION_ERROR);
/// Delay of the GNSS velocity behind the position of the same epoch, s, constant.
pub const GNSS_VELOCITY_DELAY: Block<1> = Block::after(GNSS_VELOCITY_ERROR);
/// Delay of GNSS epochs behind the IMU's time base, s, constant.
pub const GNSS_DELAY: Block<1> = Block::after(GNSS_VELOCITY_DELAY);
/// Lever arm from the IMU to the GNSS antenna, body axes, m, constant.
pub const GNSS_LEVER: Block<3> = Block::after(GNSS_DELAY);
/// Water current, north and east, m/s, Gauss-Markov.
pub const CURRENT: Block<2> = Block::after(GNSS_LEVER);
/// Mean place of a moored ship from her named berth, north and east, m, constant but for shifts.
pub const BERTH_OFFSET: Block<2> = Block::after(CURRENT);
/// Slow swaying of a moored ship about that place, north and east of each of two oscillators, m.
pub const SWAY: Block<4> = Block::after(BERTH_OFFSET);
/// Velocity of that swaying, m/s.
pub const SWAY_VELOCITY: Block<4> = Block::after(SWAY);
/// Log scale factor, ratio, constant.
pub const LOG_SCALE: Block<1> = Block::after(SWAY_VELOCITY);
/// Log misalignment about the starboard and down axes, rad, constant.
pub const LOG_MISALIGNMENT: Block<2> = Block::after(LOG_SCALE);
/// Mean height of the IMU over the ellipsoid (sea level plus mounting height), m, random walk.
pub const SEA_LEVEL: Block<1> = Block::after(LOG_MISALIGNMENT);

/// Slowly varying part of the error of a reference's heading, in units of the sigma it states, Gauss-Markov.
pub const HEADING_ERROR: Block<1> = Block::after(SEA_LEVEL);

/// Number of error states.
pub const STATES: usize = HEADING_ERROR.end();

/// Number of states at the head that the strapdown integrates: position, velocity, attitude.
pub const STRAPDOWN_STATES: usize = ATTITUDE.end();

/// An error vector.
pub type ErrorState = SVector<f64, STATES>;

/// Covariance of the error vector.
pub type Covariance = SMatrix<f64, STATES, STATES>;
