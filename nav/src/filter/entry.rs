//! What the gates said, entered in the report of a message.

use insd_base::{Source, Time};

use crate::error_state::Weighed;
use crate::report::{AidReport, Outcome, Report};

/// Aids by which the source of a solution is told.
pub(super) const POSITION_AID: &str = "gnss_position";
pub(super) const VELOCITY_AID: &str = "gnss_velocity";
pub(super) const CODE_AID: &str = "satellite_code";
pub(super) const RATE_AID: &str = "satellite_rate";
pub(super) const PHASE_AID: &str = "satellite_phase";
pub(super) const RTK_AID: &str = "rtk_position";
pub(super) const COMPASS_AID: &str = "antenna_phases";
/// That of docking aids.
pub(super) const RANGING_AID: &str = "ranging";

/// That of a camera.
pub(super) const CAMERA_AID: &str = "camera";
/// That of a visual odometry.
pub(super) const ODOMETRY_AID: &str = "odometry";

/// What the gates said of an innovation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// Whether it was absorbed, or why not.
    pub outcome: Outcome,
    /// Logarithm of its likelihood, bounded by the gate.
    pub log_likelihood: f64,
    /// Value and expected sigma of each component; NaN where there is none.
    pub innovation: [(f64, f64); 3],
}

/// Where there is no innovation to tell of.
pub(crate) const NO_INNOVATION: [(f64, f64); 3] = [(f64::NAN, f64::NAN); 3];

/// Value and expected sigma of each component.
pub(super) fn detail(weighed: &Weighed) -> [(f64, f64); 3] {
    let (z, sigma) = (weighed.z(), weighed.sigma());
    std::array::from_fn(|i| if i < z.len() { (z[i], sigma[i]) } else { (f64::NAN, f64::NAN) })
}

/// Enters a judgement in the report of a message.
pub(super) fn enter(
    report: &mut Report,
    time: Time,
    source: Source,
    aid: &'static str,
    judged: &Judged,
) -> Outcome {
    report.log_likelihood += judged.log_likelihood;
    report.aids.push(AidReport {
        time,
        source,
        aid,
        outcome: judged.outcome,
        innovation: judged.innovation,
    });
    judged.outcome
}
