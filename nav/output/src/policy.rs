//! How a standard deviation becomes a letter.
//!
//! Bridge equipment trusts position only with GGA 1 to 5 and heading only with THS A; 6 to 8, E and
//! S are shown in yellow or not used. So the limits are an open choice for each port, and the
//! letter always follows from the solution's own sigma and mode, never from that of a GNSS fix.

use insd_base::units::DEG;
use insd_base::{FixQuality, Integrity, Mode, Solution, SolutionSource};
use insd_wire::nmea::{HeadingMode, PositionMode};

/// Horizontal 1-sigma (root sum square of north and east), m, below which a quality is claimed.
///
/// Defaults as SBG Systems publish for their own INS (sbgECom doc/nmeaMessages.md): consumers know
/// them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionLimits {
    /// RTK fixed, 4.
    pub rtk_fixed: f64,
    /// RTK float, 5.
    pub rtk_float: f64,
    /// Differential, 2.
    pub differential: f64,
    /// Autonomous, 1.
    pub autonomous: f64,
    /// Estimated, 6; beyond it the position is invalid, 0.
    pub estimated: f64,
}

/// The limits of one port, all of them 1-sigma.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Policy {
    /// Position.
    pub position: PositionLimits,
    /// Call a position estimated (6, E) at best while no GNSS is in use. It is honest and turns the
    /// bridge's displays yellow.
    pub estimated_without_gnss: bool,
    /// Heading for THS A, rad. Default 0.5 deg: at 95 % the +-1.0 deg that IMO MSC.116(73) allows a
    /// heading device.
    pub heading_autonomous: f64,
    /// Heading for THS E, rad; beyond it THS V, and HDT stops. Default 2.5 deg.
    pub heading_estimated: f64,
    /// Roll and pitch, each, rad; beyond it they are not available. They need no heading, so they are
    /// told before the system navigates. Default 0.5 deg, as for the heading.
    pub level: f64,
    /// Horizontal velocity (root sum square of north and east), m/s; beyond it VTG N. Default
    /// 1 m/s.
    pub velocity: f64,
    /// Course over ground, rad; beyond it the course is left empty. Default 5 deg.
    pub course: f64,
    /// Whether the status of GLL, GNS, RMC and the like is A also for estimated and simulated data.
    /// IEC 61162-1 has it V for all modes but A, D, F, P and R, and consumers then show nothing at all of a
    /// ship that sails by dead reckoning. Default no.
    pub estimated_is_valid: bool,
    /// Speed, m/s, below which there is no course, however well the velocity is known: a ship that
    /// sways at her berth goes nowhere. Default 0.1 m/s.
    pub least_speed: f64,
    /// Alert limit of the horizontal error of the position, m, with which a protection level is compared.
    /// Default none, as it depends on the waters and on what the position is for.
    pub alert_limit: Option<f64>,
    /// Protection levels are of a risk of 10 to minus this, 1 to 9. Default 5.
    pub risk_exponent: u8,
}

impl Default for PositionLimits {
    fn default() -> Self {
        PositionLimits {
            rtk_fixed: 0.1,
            rtk_float: 0.3,
            differential: 1.2,
            autonomous: 10.0,
            estimated: 100.0,
        }
    }
}

impl Default for Policy {
    fn default() -> Self {
        Policy {
            position: PositionLimits::default(),
            estimated_without_gnss: true,
            heading_autonomous: 0.5 * DEG,
            heading_estimated: 2.5 * DEG,
            level: 0.5 * DEG,
            velocity: 1.0,
            course: 5.0 * DEG,
            estimated_is_valid: false,
            least_speed: 0.1,
            alert_limit: None,
            risk_exponent: 5,
        }
    }
}

impl Policy {
    /// Quality of the position.
    #[must_use]
    pub fn quality(&self, solution: &Solution) -> FixQuality {
        let sigma = solution.sigma.position.0.xy().norm();
        let limits = &self.position;
        let by_sigma = [
            (limits.rtk_fixed, FixQuality::RtkFixed),
            (limits.rtk_float, FixQuality::RtkFloat),
            (limits.differential, FixQuality::Differential),
            (limits.autonomous, FixQuality::Autonomous),
            (limits.estimated, FixQuality::Estimated),
        ];
        let quality =
            by_sigma.iter().find(|(limit, _)| sigma < *limit).map(|(_, quality)| *quality);
        match quality {
            None => FixQuality::Invalid,
            Some(_) if solution.mode == Mode::Fault => FixQuality::Invalid,
            Some(_) if is_doubted(solution) => FixQuality::Estimated,
            Some(_) if self.estimated_without_gnss && !uses_gnss(solution.mode) => {
                FixQuality::Estimated
            }
            // however well she knows her place, no integers are fixed
            Some(FixQuality::RtkFixed) if solution.source == Some(SolutionSource::Carrier) => {
                FixQuality::RtkFloat
            }
            Some(quality) => quality,
        }
    }

    /// Mode of the heading.
    #[must_use]
    pub fn heading(&self, solution: &Solution) -> HeadingMode {
        let sigma = solution.sigma.heading;
        if solution.mode == Mode::Standby && sigma <= self.heading_estimated {
            // a compass's word, which nobody has compared with anything
            HeadingMode::Estimated
        } else if !solution.mode.is_navigating() {
            HeadingMode::NotValid
        } else if sigma <= self.heading_autonomous && !is_contradicted(solution) {
            HeadingMode::Autonomous
        } else if sigma <= self.heading_estimated {
            HeadingMode::Estimated
        } else {
            HeadingMode::NotValid
        }
    }

    /// Whether roll and pitch are good enough to be told.
    #[must_use]
    pub fn is_level(&self, solution: &Solution) -> bool {
        let sigma = &solution.sigma;
        solution.mode != Mode::Fault && sigma.roll <= self.level && sigma.pitch <= self.level
    }

    /// Mode of course and speed: that of the position, and none if the velocity is too uncertain.
    #[must_use]
    pub fn velocity(&self, solution: &Solution) -> PositionMode {
        let certain = solution.sigma.velocity.0.xy().norm() <= self.velocity;
        match self.quality(solution) {
            _ if !certain => PositionMode::NotValid,
            FixQuality::Invalid => PositionMode::NotValid,
            FixQuality::Estimated => PositionMode::Estimated,
            FixQuality::Autonomous => PositionMode::Autonomous,
            // VTG of older editions knows no RTK letters
            _ => PositionMode::Differential,
        }
    }

    /// Whether the status that goes with a mode is A.
    #[must_use]
    pub fn is_valid(&self, mode: PositionMode) -> bool {
        match mode {
            PositionMode::NotValid => false,
            PositionMode::Estimated | PositionMode::Simulator | PositionMode::Manual => {
                self.estimated_is_valid
            }
            _ => true,
        }
    }

    /// Whether the ship moves fast enough, also for what is known of her velocity, to have a
    /// course: to first order its sigma is that of the velocity across the track over the speed.
    #[must_use]
    pub fn has_course(&self, solution: &Solution) -> bool {
        let sigma = solution.sigma.velocity.0.xy().max();
        let speed = solution.speed();
        speed >= self.least_speed && sigma <= speed * self.course
    }
}

/// Whether something speaks against the position.
fn is_doubted(solution: &Solution) -> bool {
    matches!(solution.judgement.integrity, Integrity::Unproven | Integrity::Contradiction)
}

/// Whether sensors contradict each other.
fn is_contradicted(solution: &Solution) -> bool {
    solution.judgement.integrity == Integrity::Contradiction
}

/// The letter of a quality.
pub(crate) fn mode_of(quality: FixQuality) -> PositionMode {
    match quality {
        FixQuality::Invalid => PositionMode::NotValid,
        FixQuality::Autonomous => PositionMode::Autonomous,
        FixQuality::Differential => PositionMode::Differential,
        FixQuality::Precise => PositionMode::Precise,
        FixQuality::RtkFixed => PositionMode::RtkFixed,
        FixQuality::RtkFloat => PositionMode::RtkFloat,
        FixQuality::Estimated => PositionMode::Estimated,
        FixQuality::Manual => PositionMode::Manual,
        FixQuality::Simulated => PositionMode::Simulator,
    }
}

/// Whether the position rests on satellites.
pub(crate) fn uses_gnss(mode: Mode) -> bool {
    matches!(mode, Mode::Aided | Mode::InMotionAlignment | Mode::Standby)
}
