//! An epoch as far as the policy lets it be told. Every value that leaves passes through here.

use insd_base::geoid::undulation;
use insd_base::{
    AlignmentStatus, Attitude, Body, DelayedHeave, FixQuality, Geodetic, Heave, HeaveQuality,
    Judgement, Mode, Ned, Protection, Solution, SolutionSigma, SolutionSource, Span, Time, UtcTime,
};
use insd_n2k::pgn::{Sid, TimeSource};
use insd_wire::nmea::{AlertEntry, CivilTime, HeadingMode, PositionMode};

use crate::alerts::Announcement;
use crate::docking::{Docking, DockingState, NotDocking};
use crate::epoch::{Distance, OutputEpoch, SatelliteGeometry, Variation};
use crate::manner::Manner;
use crate::policy::{mode_of, uses_gnss};

/// One epoch, ready to be told.
#[derive(Clone, Copy)]
pub(crate) struct RedactedEpoch<'a> {
    pub(crate) sid: Sid,
    /// How many of this message have been sent before.
    pub(crate) count: u64,
    /// Time to the next of this message.
    pub(crate) period: Option<Span>,
    /// What there is to tell of an alert, for the message that does.
    pub(crate) announcement: Option<&'a Announcement>,
    /// All alerts that are not normal, if anyone watches over them.
    pub(crate) alerts: Option<&'a [AlertEntry]>,
    /// All that is known, for messages that can say that it is simulated.
    whole: &'a OutputEpoch,
    /// What may be told.
    told: OutputEpoch,
    manner: &'a Manner,
}

/// A horizontal velocity in the ship's level axes, m/s.
#[derive(Clone, Copy)]
pub(crate) struct Level {
    pub(crate) forward: f64,
    pub(crate) starboard: f64,
}

/// The ellipse of the horizontal error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// 1-sigma along the major axis, m.
    pub major: f64,
    /// The same along the minor axis.
    pub minor: f64,
    /// Direction of the major axis from true north, rad, 0 to pi.
    pub orientation: f64,
}

impl Ellipse {
    /// That of a position with these 1-sigma, m, and this covariance of north and east, m^2; `None` where
    /// that is not finite.
    #[must_use]
    pub fn new(sigma: &Ned, covariance_north_east: f64) -> Option<Self> {
        let (north, east) = (sigma.0.x * sigma.0.x, sigma.0.y * sigma.0.y);
        let shared = finite(covariance_north_east)?;
        let (mean, half) = ((north + east) / 2.0, (north - east) / 2.0);
        let radius = half.hypot(shared);
        Some(Ellipse {
            major: (mean + radius).sqrt(),
            minor: (mean - radius).max(0.0).sqrt(),
            orientation: shared.atan2(half).rem_euclid(std::f64::consts::TAU) / 2.0,
        })
    }
}

impl<'a> RedactedEpoch<'a> {
    /// For messages without a mark for simulated data: from a simulator they are told the time alone.
    pub(crate) fn new(epoch: &'a OutputEpoch, manner: &'a Manner) -> Self {
        let silent = manner.simulated && !manner.unmarked_when_simulated;
        let clock = OutputEpoch {
            utc: epoch.utc,
            time_source: epoch.time_source,
            ..OutputEpoch::unknown(epoch.time)
        };
        let told = if silent { clock } else { *epoch };
        let (sid, period, announcement, alerts) = (None, None, None, None);
        RedactedEpoch { sid, count: 0, period, announcement, alerts, whole: epoch, told, manner }
    }

    /// The same, tied to other messages of one epoch by a sequence identifier.
    pub(crate) fn with_sid(self, sid: Sid) -> Self {
        RedactedEpoch { sid, ..self }
    }

    /// The same for a message of which so many have been sent.
    pub(crate) fn with_count(self, count: u64) -> Self {
        RedactedEpoch { count, ..self }
    }

    /// The same for a message that is sent so often.
    pub(crate) fn with_period(self, period: Span) -> Self {
        RedactedEpoch { period: Some(period), ..self }
    }

    /// The same where alerts are watched over.
    pub(crate) fn with_alerts(self, alerts: Option<&'a [AlertEntry]>) -> Self {
        RedactedEpoch { alerts, ..self }
    }

    /// The same for the message that tells this of an alert.
    pub(crate) fn with_announcement(self, announcement: &'a Announcement) -> Self {
        RedactedEpoch { announcement: Some(announcement), ..self }
    }

    /// For messages that can say that their data are simulated.
    pub(crate) fn marked(&self) -> Self {
        RedactedEpoch { told: *self.whole, ..*self }
    }

    /// Whether the data come from a simulator, and must be marked.
    pub(crate) fn is_simulated(&self) -> bool {
        self.manner.simulated
    }

    /// Whether only the time may be told, because the message has no mark for simulated data.
    pub(crate) fn is_muted(&self) -> bool {
        self.told.solution.is_none() && self.whole.solution.is_some()
    }

    /// Whether it is being found which way is down, before there is any solution.
    pub(crate) fn is_levelling(&self) -> bool {
        self.whole.is_levelling()
    }

    /// What the system is doing.
    pub(crate) fn mode(&self) -> Option<Mode> {
        self.told.solution.map(|solution| solution.mode)
    }

    /// What is made of the sensors' words.
    pub(crate) fn judgement(&self) -> Option<Judgement> {
        self.told.solution.map(|solution| solution.judgement)
    }

    /// True heading, rad.
    pub(crate) fn heading(&self) -> Option<f64> {
        let solution = self.told.solution?;
        let valid = self.manner.policy.heading(&solution) != HeadingMode::NotValid;
        finite(solution.attitude.heading).filter(|_| valid)
    }

    /// Heading from magnetic north, rad; not from a simulator unless it is marked.
    pub(crate) fn magnetic_heading(&self) -> Option<f64> {
        Some(self.heading()? - self.variation()?.value)
    }

    /// How the heading may be used.
    pub(crate) fn heading_mode(&self) -> HeadingMode {
        match (self.heading(), &self.told.solution) {
            (Some(_), Some(_)) if self.manner.simulated => HeadingMode::Simulator,
            (Some(_), Some(solution)) => self.manner.policy.heading(solution),
            _ => HeadingMode::NotValid,
        }
    }

    /// Whether a heading that is told is an estimate only, simulated or not.
    pub(crate) fn is_heading_estimated(&self) -> bool {
        let mode = self.told.solution.map(|solution| self.manner.policy.heading(&solution));
        self.heading().is_some() && mode == Some(HeadingMode::Estimated)
    }

    /// Roll, starboard side down positive, and pitch, bow up positive, rad.
    pub(crate) fn roll_and_pitch(&self) -> Option<(f64, f64)> {
        let Attitude { roll, pitch, .. } = self.level_solution()?.attitude;
        Some((finite(roll)?, finite(pitch)?))
    }

    /// Rates about forward, starboard and down of the hull with respect to the horizon, rad/s.
    pub(crate) fn rates(&self) -> Option<Body> {
        self.level_solution().map(|solution| solution.rate)
    }

    /// The same for messages that cannot do without, level or not: what the horizon has to do with them
    /// is the rotation of the Earth, 15 deg an hour.
    pub(crate) fn any_rates(&self) -> Option<Body> {
        let measured = |solution: &Solution| !matches!(solution.mode, Mode::Fault | Mode::Standby);
        let solution = self.told.solution.filter(measured)?;
        Some(solution.rate).filter(|rate| rate.0.iter().all(|part| part.is_finite()))
    }

    /// Rate of turn, rad/s, bow to starboard positive. It comes from the gyros, so it needs a navigating
    /// system but no good heading.
    pub(crate) fn rate_of_turn(&self) -> Option<f64> {
        let solution = self.told.solution.filter(|solution| solution.mode.is_navigating())?;
        finite(self.told.rate_of_turn.unwrap_or_else(|| solution.rate_of_turn()))
    }

    /// Heave that a message without a mark of its quality may tell.
    pub(crate) fn heave(&self) -> Option<Heave> {
        self.any_heave().filter(|heave| heave.quality > HeaveQuality::Unsettled)
    }

    /// Heave of any quality, for messages that tell it.
    pub(crate) fn any_heave(&self) -> Option<Heave> {
        self.sound_heave().filter(|heave| heave.heave.is_finite() && heave.rate.is_finite())
    }

    /// The delayed heave, once it has settled, and the instant at which it was valid.
    pub(crate) fn delayed_heave(&self) -> Option<(UtcTime, DelayedHeave)> {
        let delayed = self.sound_heave()?.delayed?;
        let settled = delayed.heave.is_finite() && delayed.quality > HeaveQuality::Unsettled;
        let valid = self.utc()?.plus(delayed.time - self.whole.time);
        settled.then_some((valid, delayed))
    }

    /// Acceleration over the Earth, m/s^2.
    pub(crate) fn acceleration(&self) -> Option<Ned> {
        self.level_solution()?;
        self.told.acceleration.filter(all_finite)
    }

    /// Acceleration along the ship's level axes, m/s^2.
    pub(crate) fn level_acceleration(&self) -> Option<Level> {
        let heading = self.told.solution?.attitude.heading;
        Some(levelled(&self.acceleration()?, heading))
    }

    /// Magnetic variation.
    pub(crate) fn variation(&self) -> Option<Variation> {
        self.told.variation.filter(|variation| variation.value.is_finite())
    }

    /// Latitude, longitude and height above the ellipsoid.
    pub(crate) fn position(&self) -> Option<Geodetic> {
        let solution = self.told.solution?;
        let place = solution.position;
        let finite = place.latitude.is_finite() && place.longitude.is_finite();
        let valid = self.manner.policy.quality(&solution) != FixQuality::Invalid;
        (finite && valid).then_some(place)
    }

    /// Quality of that position by the policy, whether it is simulated or not.
    pub(crate) fn quality(&self) -> FixQuality {
        match (self.position(), &self.told.solution) {
            (Some(_), Some(solution)) => self.manner.policy.quality(solution),
            _ => FixQuality::Invalid,
        }
    }

    /// Quality of that position with the mark of a simulator.
    pub(crate) fn marked_quality(&self) -> FixQuality {
        match self.quality() {
            FixQuality::Invalid => FixQuality::Invalid,
            _ if self.manner.simulated => FixQuality::Simulated,
            quality => quality,
        }
    }

    /// The same as a letter.
    pub(crate) fn position_mode(&self) -> PositionMode {
        mode_of(self.marked_quality())
    }

    /// Whether a sentence's status says that its data are valid.
    pub(crate) fn is_valid(&self, mode: PositionMode) -> bool {
        self.manner.policy.is_valid(mode)
    }

    /// Height of the geoid above the ellipsoid, m: that which is configured, else that of EGM96.
    pub(crate) fn geoid(&self) -> Option<f64> {
        let place = self.position()?;
        self.told.geoid.or_else(|| undulation(&place))
    }

    /// Height above mean sea level, m.
    pub(crate) fn altitude(&self) -> Option<f64> {
        finite(self.position()?.height - self.geoid()?)
    }

    /// What the receiver says, as long as the position rests on it.
    pub(crate) fn receiver(&self) -> SatelliteGeometry {
        let used = self.told.solution.is_some_and(|solution| uses_gnss(solution.mode));
        self.told.receiver.filter(|_| used && self.position().is_some()).unwrap_or_default()
    }

    /// 1-sigma of the position, m.
    pub(crate) fn position_sigma(&self) -> Option<Ned> {
        self.position()?;
        self.told.solution.map(|solution| solution.sigma.position)
    }

    /// What faults that nobody has found add to the protection levels of the position, m.
    pub(crate) fn hidden(&self) -> Option<Protection> {
        self.position()?;
        self.told.solution.map(|solution| solution.hidden)
    }

    /// 1-sigma of everything, of whatever quality it is.
    pub(crate) fn sigma(&self) -> Option<SolutionSigma> {
        self.told.solution.map(|solution| solution.sigma)
    }

    /// The ellipse of the horizontal error, if the covariance is known.
    pub(crate) fn ellipse(&self) -> Option<Ellipse> {
        Ellipse::new(&self.position_sigma()?, self.told.covariance_north_east?)
    }

    /// Mode of course and speed.
    pub(crate) fn velocity_mode(&self) -> PositionMode {
        match self.moving() {
            None => PositionMode::NotValid,
            Some(_) if self.manner.simulated => PositionMode::Simulator,
            Some(solution) => self.manner.policy.velocity(&solution),
        }
    }

    /// Velocity over the Earth, m/s.
    pub(crate) fn velocity(&self) -> Option<Ned> {
        self.moving().map(|solution| solution.velocity).filter(all_finite)
    }

    /// Speed over ground, m/s, and course over ground where she has one, rad, 0 to 2 pi.
    pub(crate) fn course_and_speed(&self) -> Option<(Option<f64>, f64)> {
        let solution = self.moving()?;
        let course = self.manner.policy.has_course(&solution).then(|| solution.course());
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

    /// How the ship stands to a berth: only where heading and position may be told.
    pub(crate) fn docking(&self) -> Option<Docking> {
        let docking = self.told.docking?;
        let is_told = self.heading().is_some() && self.position().is_some();
        let which = (docking.berth, docking.choice);
        let none = || Docking::not_valid(docking.time, which, NotDocking::NotNavigating);
        let is_not = matches!(docking.state, DockingState::NotValid(_));
        Some(if is_told || is_not { docking } else { none() })
    }

    /// Velocity of the stern over ground in the ship's level axes.
    pub(crate) fn stern_over_ground(&self) -> Option<Level> {
        self.moving()?;
        self.level(self.told.stern.filter(all_finite)?)
    }

    /// The same through the water.
    pub(crate) fn stern_through_water(&self) -> Option<Level> {
        self.moving()?;
        self.level(Ned(self.told.stern.filter(all_finite)?.0 - self.current()?.0))
    }

    /// Velocity of the water over ground.
    pub(crate) fn current(&self) -> Option<Ned> {
        self.told.current.filter(|current| current.0.xy().iter().all(|part| part.is_finite()))
    }

    /// Distance run since the start.
    pub(crate) fn distance(&self) -> Distance {
        self.told.distance
    }

    /// How the alignment stands.
    pub(crate) fn alignment(&self) -> Option<AlignmentStatus> {
        self.told.alignment
    }

    /// The instant, UTC.
    pub(crate) fn utc(&self) -> Option<UtcTime> {
        self.whole.utc
    }

    /// The instant as date and time of day, UTC.
    pub(crate) fn civil(&self) -> Option<CivilTime> {
        self.whole.utc.and_then(CivilTime::from_utc)
    }

    /// What UTC is known from.
    pub(crate) fn time_source(&self) -> Option<TimeSource> {
        self.whole.time_source.filter(|_| self.whole.utc.is_some())
    }

    /// The instant on the ship's time line.
    pub(crate) fn time(&self) -> Time {
        self.whole.time
    }

    /// How long the system has been doing what it does, s.
    pub(crate) fn seconds_in_mode(&self) -> Option<f64> {
        Some((self.whole.time - self.told.mode_since?).as_seconds())
    }

    /// What the position lives by, and how long it has, s.
    pub(crate) fn source(&self) -> Option<(SolutionSource, Option<f64>)> {
        let source = self.told.solution?.source?;
        let since = self.told.source_since.map(|since| (self.whole.time - since).as_seconds());
        Some((source, since))
    }

    /// Whether the heading is still being found.
    pub(crate) fn is_aligning(&self) -> bool {
        self.mode().is_some_and(|mode| !mode.is_navigating() && mode != Mode::Fault)
    }

    /// Whether the solution rests on satellites.
    pub(crate) fn uses_gnss(&self) -> bool {
        self.mode().is_some_and(uses_gnss)
    }

    /// 1-sigma of roll, pitch and heading, rad, of those that are told.
    pub(crate) fn attitude_sigma(&self) -> [Option<f64>; 3] {
        let level = self.sigma().filter(|_| self.roll_and_pitch().is_some());
        let heading = self.sigma().filter(|_| self.heading().is_some());
        let (roll, pitch) = level.map(|sigma| (sigma.roll, sigma.pitch)).unzip();
        [roll, pitch, heading.map(|sigma| sigma.heading)]
    }

    /// Alert limit of the horizontal error, m.
    pub(crate) fn alert_limit(&self) -> Option<f64> {
        self.manner.policy.alert_limit
    }

    /// Protection levels are of a risk of 10 to minus this.
    pub(crate) fn risk_exponent(&self) -> u8 {
        self.manner.policy.risk_exponent.clamp(1, 9)
    }

    /// A speed, or `None` if it is too small to have a direction.
    pub(crate) fn directed(&self, speed: f64) -> Option<f64> {
        Some(speed).filter(|speed| speed.abs() >= self.manner.policy.least_speed)
    }

    /// The solution, if roll and pitch are good enough to be told.
    fn level_solution(&self) -> Option<Solution> {
        self.told.solution.filter(|solution| self.manner.policy.is_level(solution))
    }

    /// Heave, unless the system has a fault: it comes from the same IMU as all else.
    fn sound_heave(&self) -> Option<Heave> {
        self.told.heave.filter(|_| self.mode() != Some(Mode::Fault))
    }

    /// The solution, if its velocity is good enough to be told.
    fn moving(&self) -> Option<Solution> {
        let solution = self.told.solution?;
        let valid = self.manner.policy.velocity(&solution) != PositionMode::NotValid;
        (valid && solution.speed().is_finite()).then_some(solution)
    }

    fn level(&self, velocity: Ned) -> Option<Level> {
        Some(levelled(&velocity, self.heading()?))
    }
}

fn levelled(vector: &Ned, heading: f64) -> Level {
    let ((sin, cos), (north, east)) = (heading.sin_cos(), (vector.0.x, vector.0.y));
    Level { forward: north * cos + east * sin, starboard: east * cos - north * sin }
}

fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|value| value.is_finite())
}

fn all_finite(vector: &Ned) -> bool {
    vector.0.iter().all(|part| part.is_finite())
}
