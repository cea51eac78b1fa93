//! An epoch as far as the policy lets it be told. Every value that leaves passes through here.

use insd_base::{FixQuality, Geodetic, Ned, Solution};
use insd_n2k::pgn::Sid;
use insd_wire::nmea::{HeadingMode, PositionMode};

use super::epoch::{Epoch, Receiver};
use super::voice::VoiceConfig;
use crate::policy::uses_gnss;

const SECOND: i64 = 1_000_000_000;
/// Resolution of times on the bus: 100 us.
const TICK: i64 = 100_000;
const TICKS_PER_SECOND: f64 = 1e4;

/// One epoch, ready to be told.
pub(crate) struct Said<'a> {
    pub(crate) sid: Sid,
    /// All that is known, for the one group that can say that it is simulated.
    whole: &'a Epoch,
    /// What groups without such a mark may tell.
    unmarked: Epoch,
    pub(crate) config: &'a VoiceConfig,
}

/// A horizontal velocity in the ship's level axes, m/s.
#[derive(Clone, Copy)]
pub(crate) struct Level {
    pub(crate) forward: f64,
    pub(crate) starboard: f64,
}

/// The ellipse of the horizontal error.
#[derive(Clone, Copy)]
pub(crate) struct Ellipse {
    /// 1-sigma along the major and the minor axis, m.
    pub(crate) major: f64,
    pub(crate) minor: f64,
    /// Direction of the major axis from true north, rad, 0 to pi.
    pub(crate) orientation: f64,
}

impl<'a> Said<'a> {
    pub(crate) fn new(sid: Sid, epoch: &'a Epoch, config: &'a VoiceConfig) -> Self {
        let silent = config.simulated && !config.unmarked_when_simulated;
        let clock =
            Epoch { utc: epoch.utc, time_source: epoch.time_source, ..Epoch::unknown(epoch.time) };
        Said { sid, whole: epoch, unmarked: if silent { clock } else { *epoch }, config }
    }

    /// True heading, rad.
    pub(crate) fn heading(&self) -> Option<f64> {
        let solution = self.unmarked.solution?;
        let valid = self.config.policy.heading(&solution) != HeadingMode::NotValid;
        finite(solution.attitude.heading).filter(|_| valid)
    }

    /// Roll, starboard side down positive, and pitch, bow up positive, rad.
    pub(crate) fn roll_and_pitch(&self) -> Option<(f64, f64)> {
        let solution = self.unmarked.solution?;
        let attitude = solution.attitude;
        self.config.policy.is_level(&solution).then_some((attitude.roll, attitude.pitch))
    }

    /// Rate of turn, rad/s, bow to starboard positive. It comes from the gyros, so it needs a navigating
    /// system but no good heading.
    pub(crate) fn rate_of_turn(&self) -> Option<f64> {
        let solution = self.unmarked.solution.filter(|solution| solution.mode.is_navigating())?;
        finite(solution.rate_of_turn())
    }

    /// Heave, m, up positive.
    pub(crate) fn heave(&self) -> Option<f64> {
        self.unmarked.heave
    }

    /// Magnetic variation.
    pub(crate) fn variation(&self) -> Option<super::Variation> {
        self.unmarked.variation.filter(|variation| variation.value.is_finite())
    }

    /// Latitude and longitude for a group without a mark.
    pub(crate) fn position(&self) -> Option<Geodetic> {
        self.position_of(self.unmarked.solution?)
    }

    /// Position for the group that says how it was made.
    pub(crate) fn marked_position(&self) -> Option<Geodetic> {
        self.position_of(self.whole.solution?)
    }

    /// Quality of that position.
    pub(crate) fn quality(&self) -> FixQuality {
        match (self.marked_position(), &self.whole.solution) {
            (Some(_), Some(solution)) => self.config.policy.quality(solution),
            _ => FixQuality::Invalid,
        }
    }

    /// Height of the geoid above the ellipsoid, m.
    pub(crate) fn geoid(&self) -> Option<f64> {
        self.whole.geoid.filter(|_| self.marked_position().is_some())
    }

    /// What the receiver says, as long as the position rests on it.
    pub(crate) fn marked_receiver(&self) -> Receiver {
        let used = self.whole.solution.is_some_and(|solution| uses_gnss(solution.mode));
        self.whole.receiver.filter(|_| used && self.marked_position().is_some()).unwrap_or_default()
    }

    /// The same for a group without a mark.
    pub(crate) fn receiver(&self) -> Receiver {
        self.unmarked.solution.map(|_| self.marked_receiver()).unwrap_or_default()
    }

    /// 1-sigma of the position, m.
    pub(crate) fn position_sigma(&self) -> Option<Ned> {
        self.position()?;
        self.unmarked.solution.map(|solution| solution.sigma.position)
    }

    /// The ellipse of the horizontal error, if the covariance is known.
    pub(crate) fn ellipse(&self) -> Option<Ellipse> {
        let sigma = self.position_sigma()?.0;
        let (north, east) = (sigma.x * sigma.x, sigma.y * sigma.y);
        let shared = finite(self.unmarked.covariance_north_east?)?;
        let (mean, half) = ((north + east) / 2.0, (north - east) / 2.0);
        let radius = half.hypot(shared);
        Some(Ellipse {
            major: (mean + radius).sqrt(),
            minor: (mean - radius).max(0.0).sqrt(),
            orientation: shared.atan2(half).rem_euclid(std::f64::consts::TAU) / 2.0,
        })
    }

    /// Speed over ground, m/s, and course over ground where she has one, rad, 0 to 2 pi.
    pub(crate) fn course_and_speed(&self) -> Option<(Option<f64>, f64)> {
        let solution = self.moving()?;
        let course = self.config.policy.has_course(&solution).then(|| solution.course());
        Some((course, solution.speed()))
    }

    /// Velocity over ground in the ship's level axes.
    pub(crate) fn over_ground(&self) -> Option<Level> {
        self.level(self.moving()?.velocity)
    }

    /// Velocity through the water in the ship's level axes.
    pub(crate) fn through_water(&self) -> Option<Level> {
        self.level(Ned(self.moving()?.velocity.0 - self.current()?.0))
    }

    /// Velocity of the water over ground.
    pub(crate) fn current(&self) -> Option<Ned> {
        self.unmarked.current.filter(|current| current.0.xy().iter().all(|part| part.is_finite()))
    }

    /// Days since 1970-01-01 and seconds of the day, UTC. Rounded to the resolution of the bus before
    /// it is taken apart, so that no day has a second 86400.
    pub(crate) fn utc(&self) -> Option<(u16, f64)> {
        let ticks = self.whole.utc?.as_nanos().saturating_add(TICK / 2).div_euclid(TICK);
        let day = 86_400 * SECOND / TICK;
        let date = u16::try_from(ticks.div_euclid(day)).ok()?;
        Some((date, ticks.rem_euclid(day) as f64 / TICKS_PER_SECOND))
    }

    /// What UTC is known from.
    pub(crate) fn time_source(&self) -> Option<insd_n2k::pgn::TimeSource> {
        self.whole.time_source.filter(|_| self.utc().is_some())
    }

    /// A speed, or `None` if it is too small to have a direction.
    pub(crate) fn directed(&self, speed: f64) -> Option<f64> {
        Some(speed).filter(|speed| speed.abs() >= self.config.policy.least_speed)
    }

    fn position_of(&self, solution: Solution) -> Option<Geodetic> {
        let place = solution.position;
        let finite = place.latitude.is_finite() && place.longitude.is_finite();
        let valid = self.config.policy.quality(&solution) != FixQuality::Invalid;
        (finite && valid).then_some(place)
    }

    /// The solution, if its velocity is good enough to be told.
    fn moving(&self) -> Option<Solution> {
        let solution = self.unmarked.solution?;
        let valid = self.config.policy.velocity(&solution) != PositionMode::NotValid;
        (valid && solution.speed().is_finite()).then_some(solution)
    }

    fn level(&self, velocity: Ned) -> Option<Level> {
        let (sin, cos) = self.heading()?.sin_cos();
        let (north, east) = (velocity.0.x, velocity.0.y);
        Some(Level { forward: north * cos + east * sin, starboard: east * cos - north * sin })
    }
}

fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|value| value.is_finite())
}
