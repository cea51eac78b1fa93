//! What is told of the alignment, and when: a status whenever the phase changes and every ten seconds
//! until the ship is aligned, and once that she has left her berth.
//!
//! It looks at the newest state once a second and is no part of what the time line takes back: what
//! was said stays said, and depends on nothing but the data. A forecast costs some seconds of
//! navigation, so it is made again after half a minute or a quarter of the time gone (all of it
//! where it found no end), whichever is longer, and when the sea has changed or a promise was not kept.

use insd_alignment::forecast;
use insd_base::alignment::{NO_HEADING, gyrocompass_sigma, heading_target};
use insd_base::units::DEG;
use insd_base::{
    AlignmentPhase, AlignmentStatus, AttitudeSigma, Event, Forecast, Geodetic, ImuSpec, Lack,
    Message, Received, Span, Time,
};
use insd_nav::{Estimator, Navigator};
use serde::{Deserialize, Serialize};

use crate::ship::Ship;

/// Spacing of looks.
const LOOK: Span = Span::from_nanos(1_000_000_000);
/// Least spacing of what is told unless the phase changes.
const TELL: Span = Span::from_nanos(10_000_000_000);
/// Least spacing of forecasts.
const THINK: Span = Span::from_nanos(30_000_000_000);
/// Heading sigma above which nothing is foreseen, rad.
const VAGUE: f64 = 25.0 * DEG;
/// Change of the sea, as ratio, after which the forecast is made again.
const CHANGE: f64 = 1.5;
/// An aid that was silent for this long is not there, s.
const SILENT: f64 = 15.0;

/// What was said, and what it takes to say the next.
#[derive(Clone, Debug)]
pub(crate) struct StatusTeller {
    imu: ImuSpec,
    accuracy: f64,
    start: Option<Time>,
    next_look: Option<Time>,
    next_telling: Option<Time>,
    phase: Option<AlignmentPhase>,
    forecast: Option<Thought>,
    reached: Option<Time>,
    was_moored: bool,
    told_departure: bool,
    heard: Heard,
}

/// What of it is kept for the next start of the program.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct StatusCheckpoint {
    reached: Option<Time>,
    was_moored: bool,
    told_departure: bool,
}

/// A forecast, when it was made and by what sea.
#[derive(Clone, Copy, Debug)]
struct Thought {
    at: Time,
    next: Time,
    forecast: Forecast,
    sea: Option<(f64, f64)>,
    shifts: u32,
}

/// When aids that tell a velocity were last heard.
#[derive(Clone, Copy, Debug, Default)]
struct Heard {
    gnss_velocity: Option<Time>,
    other: Option<Time>,
}

impl StatusTeller {
    pub(crate) fn new(imu: &ImuSpec, accuracy: f64) -> Self {
        StatusTeller {
            imu: *imu,
            accuracy,
            start: None,
            next_look: None,
            next_telling: None,
            phase: None,
            forecast: None,
            reached: None,
            was_moored: false,
            told_departure: false,
            heard: Heard::default(),
        }
    }

    pub(crate) fn kept(&self) -> StatusCheckpoint {
        let StatusTeller { reached, was_moored, told_departure, .. } = *self;
        StatusCheckpoint { reached, was_moored, told_departure }
    }

    /// Goes on from what was kept, on a time line that is later by a span.
    pub(crate) fn take_up(&mut self, kept: &StatusCheckpoint, by: Span) {
        self.reached = kept.reached.map(|time| time + by);
        self.was_moored = kept.was_moored;
        self.told_departure = kept.told_departure;
    }

    /// Notes which aids there are.
    pub(crate) fn hear(&mut self, received: &Received) {
        let time = received.message.time();
        let last = match &received.message {
            Message::Gnss(fix) if fix.quality.is_measured() && fix.velocity.is_some() => {
                &mut self.heard.gnss_velocity
            }
            Message::Log(_) | Message::Reference(_) => &mut self.heard.other,
            _ => return,
        };
        *last = Some(last.map_or(time, |last| last.max(time)));
    }

    /// The status of a ship that is still finding which way is down.
    pub(crate) fn levelling(
        &mut self,
        now: Time,
        moored: bool,
        place: Option<&Geodetic>,
    ) -> Option<AlignmentStatus> {
        self.start.get_or_insert(now);
        if !self.is_due(AlignmentPhase::Levelling, now) {
            return None;
        }
        let latitude = place.map(|place| place.latitude);
        let target = latitude.map(|latitude| heading_target(self.accuracy, latitude));
        let known = latitude.zip(target).filter(|_| moored);
        Some(AlignmentStatus {
            time: now,
            phase: AlignmentPhase::Levelling,
            moored,
            sigma: None,
            target,
            gyrocompass: latitude.map(|latitude| gyrocompass_sigma(&self.imu, latitude)),
            ready: known.map_or(Forecast::Unknown { lacks: Lack::Time }, |(latitude, target)| {
                forecast::of_the_gyros(&self.imu, latitude, target)
            }),
            sea: None,
            fit: None,
            shifts: 0,
        })
    }

    /// Looks at the ship, if it is time to.
    pub(crate) fn look(
        &mut self,
        ship: &Ship,
        now: Time,
    ) -> (Option<Event>, Option<AlignmentStatus>) {
        let start = *self.start.get_or_insert(now);
        if self.next_look.is_some_and(|next| now < next) {
            return (None, None);
        }
        self.next_look = Some(now + LOOK);
        let departed = self.has_departed(ship).then_some(Event::LeftBerth { time: now });
        if self.phase == Some(AlignmentPhase::Aligned) {
            return (departed, None);
        }
        (departed, self.status(ship, start, now))
    }

    fn has_departed(&mut self, ship: &Ship) -> bool {
        let moored = ship.is_moored();
        let departed = self.was_moored && !moored && !self.told_departure;
        self.was_moored |= moored;
        self.told_departure |= departed;
        departed
    }

    fn status(&mut self, ship: &Ship, start: Time, now: Time) -> Option<AlignmentStatus> {
        let solution = ship.solution();
        let sigma = solution.sigma;
        let latitude = solution.position.latitude;
        let target = heading_target(self.accuracy, latitude);
        if ship.has_one_heading() && sigma.heading < target {
            self.reached.get_or_insert(now);
        }
        let phase = self.phase_of(ship);
        let navigator = ship.likeliest();
        let ready = self.forecast(
            ship,
            navigator,
            &Aim { start, now, latitude, target, sigma: sigma.heading },
        );
        if !self.is_due(phase, now) {
            return None;
        }
        Some(AlignmentStatus {
            time: now,
            phase,
            moored: ship.is_moored(),
            sigma: Some(AttitudeSigma {
                roll: sigma.roll,
                pitch: sigma.pitch,
                heading: sigma.heading,
            }),
            target: Some(target),
            gyrocompass: Some(gyrocompass_sigma(&self.imu, latitude)),
            ready,
            sea: navigator.and_then(Navigator::sea),
            fit: navigator.and_then(Navigator::sea_fit),
            shifts: navigator.map_or(0, Navigator::shifts),
        })
    }

    /// Whether there is something to tell: another phase, or time gone.
    fn is_due(&mut self, phase: AlignmentPhase, now: Time) -> bool {
        let due = self.phase != Some(phase) || self.next_telling.is_none_or(|next| now >= next);
        if due {
            self.phase = Some(phase);
            self.next_telling = Some(now + TELL);
        }
        due
    }

    fn phase_of(&self, ship: &Ship) -> AlignmentPhase {
        let moored = ship.is_moored();
        if self.reached.is_some() || (!moored && ship.is_steerable()) {
            AlignmentPhase::Aligned
        } else if !moored {
            AlignmentPhase::InMotion
        } else if ship.has_one_heading() {
            AlignmentPhase::Fine
        } else {
            AlignmentPhase::Searching
        }
    }

    fn forecast(&mut self, ship: &Ship, navigator: Option<&Navigator>, aim: &Aim) -> Forecast {
        if let Some(at) = self.reached {
            return Forecast::Reached { at };
        }
        let by_gyros = forecast::of_the_gyros(&self.imu, aim.latitude, aim.target);
        let can_gyrocompass = gyrocompass_sigma(&self.imu, aim.latitude) < NO_HEADING;
        match navigator.filter(|_| ship.is_moored()) {
            None => Forecast::Unknown { lacks: self.heard.lack(aim.now) },
            Some(_) if !can_gyrocompass => by_gyros,
            Some(navigator) if aim.sigma < VAGUE => self.think(navigator, aim),
            Some(_) => by_gyros,
        }
    }

    /// The last forecast, or a new one if it is time to.
    fn think(&mut self, navigator: &Navigator, aim: &Aim) -> Forecast {
        if let Some(last) = self.forecast.filter(|last| !last.is_stale(aim.now, navigator)) {
            return last.forecast;
        }
        let (sea, shifts) = (navigator.sea_std(), navigator.shifts());
        let forecast = forecast::at_the_berth(navigator, &self.imu, aim.target);
        let next = forecast::next_look(aim.start, aim.now, forecast);
        self.forecast = Some(Thought { at: aim.now, next, forecast, sea, shifts });
        forecast
    }
}

/// What a forecast is for.
struct Aim {
    start: Time,
    now: Time,
    latitude: f64,
    target: f64,
    sigma: f64,
}

impl Thought {
    fn is_stale(&self, now: Time, navigator: &Navigator) -> bool {
        let is_broken = self.forecast.ready_at().is_some_and(|at| at <= now);
        let is_other =
            || is_broken || navigator.shifts() != self.shifts || self.is_changed(navigator);
        now >= self.next || (now - self.at >= THINK && is_other())
    }

    /// Whether the sea has changed; to ask costs a fit of its model.
    fn is_changed(&self, navigator: &Navigator) -> bool {
        let differs = |a: f64, b: f64| a > CHANGE * b || b > CHANGE * a;
        match (self.sea, navigator.sea_std()) {
            (Some(then), Some(now)) => differs(then.0, now.0) || differs(then.1, now.1),
            (then, now) => then.is_some() != now.is_some(),
        }
    }
}

impl Heard {
    /// What a ship under way lacks to know when her heading will be good.
    fn lack(&self, now: Time) -> Lack {
        let fresh =
            |last: Option<Time>| last.is_some_and(|last| (now - last).as_seconds() < SILENT);
        if fresh(self.gnss_velocity) {
            Lack::Manoeuvres
        } else if fresh(self.other) {
            Lack::GnssVelocity
        } else {
            Lack::Aid
        }
    }
}
