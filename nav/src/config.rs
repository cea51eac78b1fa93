//! What the filter assumes of sensors and sea beyond the IMU's data sheet.

mod camera;

use insd_base::units::{DEG, DEG_PER_HOUR};
use insd_base::{Body, Estimate, ImuSpec, LeverArms, VesselKind};
use nalgebra::{Matrix3, Vector3};

use crate::disturbance::{PrefilterConfig, WhiteningConfig};
use crate::floors::Floors;
use crate::judge::docket::Docket;
use crate::protection::RiskModel;
use crate::smoothing::plan::SmoothingPlan;
use crate::thermal::ThermalModel;

pub use camera::{CameraAid, OdometryModel};

/// Gyros with a larger turn-on bias than this, rad/s, are coarse: they do not find north on their own, and are no judges
/// of a receiver.
pub const COARSE_GYRO: f64 = 1.0 * DEG_PER_HOUR;

/// A berth taken from a chart is off by so much, 1-sigma, m.
const MISPLACED: f64 = 10.0;

/// A lever arm of which so little is known, 1-sigma, m, was given up.
const VAGUE: f64 = 2.0;

/// A lever arm that was found to be otherwise than configured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeverFound {
    /// From the IMU, body axes, m.
    pub arm: Vector3<f64>,
    /// 1-sigma of each component, m.
    pub std: f64,
}

impl LeverFound {
    /// Only that it is not as configured.
    pub const UNKNOWN: Self = LeverFound { arm: Vector3::new(0.0, 0.0, 0.0), std: 50.0 };
}

/// Error model of GNSS positions and velocities.
///
/// A receiver states one sigma; part of its error is white and part varies slowly (atmosphere,
/// multipath, orbits). The shares are of the variance, the times are of a first-order Gauss-Markov
/// process. The values follow the usual split of code and carrier errors over minutes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GnssModel {
    /// Share of the position variance that varies slowly, for code solutions.
    pub position_slow_share: f64,
    /// Share of the position variance that varies slowly, for fixed carrier ambiguities.
    pub rtk_slow_share: f64,
    /// Time constant of the slow part of the position error, code solutions, s.
    pub position_time: f64,
    /// Time constant of the slow part of the position error, fixed carrier ambiguities, s.
    pub rtk_position_time: f64,
    /// Share of the velocity variance that varies slowly.
    pub velocity_slow_share: f64,
    /// Time constant of the slow part of the velocity error, s.
    pub velocity_time: f64,
    /// Delay of epochs behind the IMU's time base, 1-sigma, s.
    pub delay_std: f64,
    /// The part of it that the stamps of the IMU may be off by, 1-sigma, s.
    pub stamps_std: f64,
    /// Delay of the velocity behind the position, 1-sigma, s: receivers average or filter it.
    pub velocity_delay_std: f64,
    /// What was found of the lever arm of the antenna: it goes before what is configured.
    pub lever_found: Option<LeverFound>,
}

impl GnssModel {
    /// Time constant of the slow part of the position error for this kind of solution, s.
    #[must_use]
    pub fn position_time_for(&self, rtk: bool) -> f64 {
        if rtk { self.rtk_position_time } else { self.position_time }
    }

    /// Share of the position variance that varies slowly for this kind of solution.
    #[must_use]
    pub fn position_slow_share_for(&self, rtk: bool) -> f64 {
        if rtk { self.rtk_slow_share } else { self.position_slow_share }
    }
}

/// Error model of a velocity log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogModel {
    /// Scale factor, 1-sigma, ratio.
    pub scale_std: f64,
    /// Misalignment about each axis, 1-sigma, rad.
    pub misalignment_std: f64,
    /// Water current, 1-sigma of each component, m/s.
    pub current_std: f64,
    /// Time constant of the current, s.
    pub current_time: f64,
    /// Errors that depend on speed and rate of turn, where they are estimated as well.
    pub shape: Option<LogShape>,
}

/// Errors of a log that depend on speed and rate of turn, as they are known before they are estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogShape {
    /// Change of the scale factor and of the turn with the speed, forward and starboard, 1/(m/s).
    pub by_speed: [Estimate; 2],
    /// What is added forward by the size of the rate of turn, and to starboard by the rate, m.
    pub by_turn: [Estimate; 2],
}

impl LogShape {
    /// 1-sigma of both changes with the speed, that of the less certain one, 1/(m/s).
    #[must_use]
    pub fn by_speed_std(&self) -> f64 {
        self.by_speed[0].sigma.max(self.by_speed[1].sigma)
    }

    /// The same of what is added by the rate of turn, m.
    #[must_use]
    pub fn by_turn_std(&self) -> f64 {
        self.by_turn[0].sigma.max(self.by_turn[1].sigma)
    }
}

/// Ship and sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeaModel {
    /// Random walk of the mean height (tide, draught), m/sqrt(s).
    pub level_walk: f64,
    /// Least heave averaged over the sea-level window, 1-sigma, m.
    pub least_mean_heave: f64,
    /// Averaged heave before any has been seen, 1-sigma, m.
    pub initial_mean_heave: f64,
}

/// Gates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GateModel {
    /// Probability that a good measurement passes the chi-square gate.
    pub probability: f64,
    /// Base GNSS position error at 99 % for DOP 1, m: dP_GNSS of docs/systems.md (5), code solutions.
    pub code_base_error: f64,
    /// The same for RTK solutions, m.
    pub rtk_base_error: f64,
    /// Growth of the INS position error since the last fix at 99 %, m/s: dP_INS of (5).
    pub ins_growth: f64,
    /// After a receiver was found in error, seconds of agreement before it is believed again.
    pub suspect_time: f64,
    /// After this many seconds without any use of a receiver that sends fixes, the filter takes
    /// itself as lost and starts again from the receiver's word, s.
    pub reset_time: f64,
    /// The same where another sensor or good gyros vouch for the filter, s.
    pub judged_reset_time: f64,
}

/// What is assumed of sensors and sea, and what is believed of them: all of it may be chosen, and each default stands here
/// or with its type.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Models {
    /// GNSS errors.
    pub gnss: GnssModel,
    /// Log errors.
    pub log: LogModel,
    /// Ship and sea.
    pub sea: SeaModel,
    /// Gates.
    pub gate: GateModel,
    /// Which sigmas are believed.
    pub floors: Floors,
    /// How the sea is taken out of the velocity at the berth, where that is the method.
    pub prefilter: PrefilterConfig,
    /// How the displacement at the berth is whitened, where that is the method.
    pub whitening: WhiteningConfig,
    /// The receiver of ranges.
    pub ranges: RangeModel,
    /// Antennas that are a compass.
    pub antennas: AntennaModel,
    /// A camera, if there is one.
    pub camera: Option<CameraAid>,
    /// The risk of protection levels.
    pub risk: RiskModel,
}

/// The receiver that ranges of satellites come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeModel {
    /// Random walk of its clock, m per root of a second: the white frequency noise of a compensated crystal.
    pub clock_walk: f64,
    /// Random walk of the clock's drift, m/s per root of a second.
    pub drift_walk: f64,
}

/// Antennas that together are a compass.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct AntennaModel {
    /// How well it is known how they sit, small rotations about body axes, 1-sigma, rad.
    pub axes_std: Vector3<f64>,
}

impl AntennaModel {
    /// Of antennas at these lever arms, body axes, m, each known to so much, 1-sigma, m: the covariance of the rotation that fits points best,
    /// `std^2 (sum (r . r I - r r^T))^-1`, r from their middle (Horn, Closed-form solution of absolute orientation, JOSA A 4, 1987, for small angles). About the line of two it is not known.
    #[must_use]
    pub fn of(levers: &[Vector3<f64>], std: f64) -> Self {
        /// About what no antenna is off the axis of, rad.
        const UNKNOWN: f64 = 0.5;
        let middle = levers.iter().sum::<Vector3<f64>>() / levers.len().max(1) as f64;
        let spread = |lever: &Vector3<f64>| {
            let r = lever - middle;
            Matrix3::from_diagonal_element(r.norm_squared()) - r * r.transpose()
        };
        let all: Matrix3<f64> = levers.iter().map(spread).sum();
        let variance = std * std;
        let known = all + Matrix3::from_diagonal_element(variance / (UNKNOWN * UNKNOWN));
        let inverse = known.try_inverse().unwrap_or_else(Matrix3::zeros);
        AntennaModel { axes_std: inverse.diagonal().map(|own| (own * variance).max(0.0).sqrt()) }
    }
}

impl Default for RangeModel {
    fn default() -> Self {
        RangeModel { clock_walk: 0.03, drift_walk: 0.03 }
    }
}

impl Default for GnssModel {
    fn default() -> Self {
        GnssModel {
            position_slow_share: 0.72,
            rtk_slow_share: 0.5,
            position_time: 300.0,
            rtk_position_time: 60.0,
            velocity_slow_share: 0.1,
            velocity_time: 100.0,
            delay_std: SLOPPY,
            stamps_std: SLOPPY,
            velocity_delay_std: 0.1,
            lever_found: None,
        }
    }
}

impl Default for LogModel {
    fn default() -> Self {
        LogModel {
            scale_std: 0.005,
            misalignment_std: 0.3 * DEG,
            current_std: 0.5,
            current_time: 7200.0,
            shape: None,
        }
    }
}

impl Default for SeaModel {
    fn default() -> Self {
        SeaModel { level_walk: 0.002, least_mean_heave: 0.02, initial_mean_heave: 0.3 }
    }
}

impl Default for GateModel {
    fn default() -> Self {
        GateModel {
            probability: 0.9999,
            code_base_error: 5.0,
            rtk_base_error: 0.5,
            ins_growth: 1.0,
            suspect_time: 3.0,
            reset_time: 5.0,
            judged_reset_time: 300.0,
        }
    }
}

/// Everything the filter is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NavConfig {
    /// The IMU's error model.
    pub imu: ImuSpec,
    /// Where the sensors sit.
    pub lever_arms: LeverArms,
    /// What carries them.
    pub vessel: VesselKind,
    /// GNSS errors.
    pub gnss: GnssModel,
    /// Log errors.
    pub log: LogModel,
    /// Ship and sea.
    pub sea: SeaModel,
    /// Gates.
    pub gate: GateModel,
    /// Which sigmas are believed.
    pub floors: Floors,
    /// How the sea is taken out of the velocity at the berth, where that is the method.
    pub prefilter: PrefilterConfig,
    /// How the displacement at the berth is whitened, where that is the method.
    pub whitening: WhiteningConfig,
    /// The receiver of ranges.
    pub ranges: RangeModel,
    /// Antennas that are a compass.
    pub antennas: AntennaModel,
    /// A camera, if there is one.
    pub camera: Option<CameraAid>,
    /// The risk of protection levels.
    pub risk: RiskModel,
    /// Longest interval between propagations of the covariance, s.
    pub covariance_interval: f64,
    /// How far everybody is believed at the begin.
    pub docket: Docket,
    /// How the biases of the IMU follow its temperature, where earlier voyages told.
    pub thermal: Option<ThermalModel>,
    /// What is kept of the way for smoothing, where that is wanted.
    pub smoothing: Option<SmoothingPlan>,
}

impl NavConfig {
    /// Defaults for a ship with this IMU and these lever arms.
    #[must_use]
    pub fn new(imu: ImuSpec, lever_arms: LeverArms) -> Self {
        NavConfig::with_models(imu, lever_arms, &Models::default())
    }

    /// The same with models of one's own. How well GNSS and IMU agree in time is by the grade of the IMU.
    #[must_use]
    pub fn with_models(imu: ImuSpec, lever_arms: LeverArms, models: &Models) -> Self {
        NavConfig {
            imu,
            lever_arms,
            vessel: VesselKind::default(),
            gnss: GnssModel {
                delay_std: synchronisation_std(&imu),
                stamps_std: synchronisation_std(&imu),
                ..models.gnss
            },
            log: models.log,
            sea: models.sea,
            gate: models.gate,
            floors: models.floors,
            prefilter: models.prefilter,
            whitening: models.whitening,
            ranges: models.ranges,
            antennas: models.antennas,
            camera: models.camera,
            risk: models.risk,
            covariance_interval: 0.1,
            docket: Docket::default(),
            thermal: None,
            smoothing: None,
        }
    }
}

/// How well the stamps of a consumer unit agree with GNSS time, 1-sigma, s.
const SLOPPY: f64 = 0.1;

/// How well an IMU's time base agrees with GNSS time where nobody states it, 1-sigma, s.
///
/// Navigation-grade units are driven by the receiver's pulse per second; consumer units are stamped
/// when the host reads them, tens of milliseconds late. The gyros tell the one from the other.
fn synchronisation_std(imu: &ImuSpec) -> f64 {
    const SECONDS_PER_RATE: f64 = 1e-4 / DEG_PER_HOUR;
    (imu.gyro.bias_std * SECONDS_PER_RATE).clamp(1e-6, SLOPPY)
}

/// How many times worse than its data sheet an IMU is taken to be with each step.
pub const WORSE: f64 = 3.5;
/// Most steps.
pub const WORST: u8 = 4;

impl NavConfig {
    /// With everybody believed so far: an IMU that was found to be worse than its data sheet is so.
    #[must_use]
    pub fn with_docket(mut self, docket: Docket) -> Self {
        let steps = i32::from(docket.worse()) - i32::from(self.docket.worse());
        let factor = WORSE.powi(steps);
        for triad in [&mut self.imu.gyro, &mut self.imu.accel] {
            triad.instability_std *= factor;
            triad.scale_std *= factor;
        }
        self.docket = docket;
        self
    }

    /// With an IMU that is a step worse.
    #[must_use]
    pub fn with_worse_imu(&self) -> Self {
        self.with_docket(self.docket.with_worse_imu())
    }
}

/// 1-sigma of each component of a lever arm that was measured, m.
const SURVEYED: f64 = 0.002;
/// Random walk of one that is found by motion, m per root of a second. In a car with consumer gyros, time stamps of a host and an antenna beside the IMU
/// one that was taken to be constant was found 0.35 m off, with 0.04 m claimed.
const FOUND: f64 = 0.04;
/// The ends of the longest ships, and the tops of their masts, from an IMU anywhere on board, m.
const ON_BOARD: Vector3<f64> = Vector3::new(400.0, 70.0, 90.0);
/// An antenna of which no more is known may be anywhere on a ship, 1-sigma of each component, m.
const ANYWHERE: f64 = 20.0;

/// Whether an antenna can sit there, from the IMU.
pub(crate) fn is_on_board(arm: &Vector3<f64>) -> bool {
    (0..3).all(|i| arm[i].abs() < ON_BOARD[i])
}

impl NavConfig {
    /// The visual odometry, as it is or would be.
    #[must_use]
    pub fn odometry(&self) -> OdometryModel {
        self.camera.and_then(|camera| camera.odometry).unwrap_or_default()
    }

    /// Whether the gyros are coarse.
    #[must_use]
    pub fn has_coarse_gyros(&self) -> bool {
        self.imu.gyro.bias_std > COARSE_GYRO
    }

    /// How well the lever arm of the antenna is known, 1-sigma of each component, m.
    #[must_use]
    pub fn gnss_lever_std(&self) -> f64 {
        let configured =
            if self.is_gnss_lever_measured() { SURVEYED } else { self.vessel.unmeasured_lever() };
        self.gnss.lever_found.map_or(configured, |found| found.std)
    }

    /// Random walk of the lever arm, m per root of a second: `None` of one that was measured. One that is found by how the antenna moves is as good as
    /// what is known of that motion, and so no better than to a decimetre or two however long it is looked for.
    #[must_use]
    pub fn gnss_lever_walk(&self) -> Option<f64> {
        (self.gnss_lever_std() > SURVEYED).then_some(FOUND)
    }

    /// The lever arm of the antenna to begin with, body axes, m.
    #[must_use]
    pub fn gnss_lever(&self) -> Vector3<f64> {
        let configured =
            if self.is_gnss_lever_measured() { self.lever_arms.gnss.0 } else { Vector3::zeros() };
        self.gnss.lever_found.map_or(configured, |found| found.arm)
    }

    /// Whether the configured lever arm of the antenna can be one: none sits inside the IMU, zeros are a lever arm that was
    /// not measured, nor does any sit beyond the ship.
    fn is_gnss_lever_measured(&self) -> bool {
        let arm = self.lever_arms.gnss.0;
        arm.norm() > 0.0 && is_on_board(&arm)
    }

    /// Takes the lever arm of the antenna that speaks now; tells whether it is another than before, of which
    /// nothing was found yet.
    pub fn hear_antenna(&mut self, arm: Body) -> bool {
        let is_other = arm != self.lever_arms.gnss;
        if is_other {
            self.lever_arms.gnss = arm;
            self.gnss.lever_found = self.gnss.lever_found.filter(|_| self.is_gnss_lever_unknown());
        }
        is_other
    }

    /// By how much a place that a reference names may be off beyond what it says, 1-sigma, m: where the level components of the
    /// lever arm were given up, as the receiver contradicted them, the berth may as well be elsewhere than it was said to be.
    #[must_use]
    pub fn berth_doubt(&self) -> f64 {
        if self.gnss.lever_found.is_some_and(|found| found.std > VAGUE) { MISPLACED } else { 0.0 }
    }

    /// Whether the antenna may be anywhere on board.
    #[must_use]
    pub fn is_gnss_lever_unknown(&self) -> bool {
        self.gnss_lever_std() >= ANYWHERE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn antennas_sit_as_well_as_their_places_are_known() {
        let corner = |x: f64, y: f64| Vector3::new(x - 6.0, y, -14.0);
        let square =
            [corner(0.05, 0.05), corner(0.05, -0.05), corner(-0.05, -0.05), corner(-0.05, 0.05)];
        let own = AntennaModel::of(&square, 0.001).axes_std;
        // each is 71 mm from the middle, and 50 mm from the axes forward and to starboard
        let expected = Vector3::new(0.001 / 0.1, 0.001 / 0.1, 0.001 / 0.02_f64.sqrt());
        assert!((own - expected).norm() < 1e-5, "{own}");
        let two = AntennaModel::of(&square[..2], 0.001).axes_std;
        assert!(
            (two.y - 0.5).abs() < 1e-3 && (two.z - 0.001 / 0.005_f64.sqrt()).abs() < 1e-4,
            "{two}"
        );
        assert_eq!(AntennaModel::of(&[], 0.0).axes_std, AntennaModel::of(&square, 0.0).axes_std);
    }
}
