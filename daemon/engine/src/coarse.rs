//! The first seconds: levelling, and collecting where and how fast the ship is.

use insd_alignment::kinematics::Kinematics;
use insd_alignment::{Level, Levelling};
use insd_base::{Geodetic, GnssFix, Message, Received, StartCondition, Time};
use insd_nav::Increment;
use nalgebra::Vector3;

use crate::EngineConfig;

/// Levelling before the first solution, s.
const WINDOW: f64 = 10.0;
/// Wait for a fix of the ship's position or velocity before starting without, s.
const PATIENCE: f64 = 30.0;
/// A fix older than this is not where the ship is, s.
const FRESH: f64 = 3.0;

/// What is known so far.
#[derive(Clone, Debug)]
pub(crate) struct Coarse {
    moored: bool,
    berth: Option<Geodetic>,
    levelling: Option<Levelling>,
    first: Option<GnssFix>,
    last: Option<GnssFix>,
    increments: Vec<Increment>,
    messages: Vec<Received>,
}

impl Coarse {
    pub(crate) fn new(config: &EngineConfig) -> Self {
        Coarse {
            moored: config.start == StartCondition::Moored,
            berth: config.initial,
            levelling: None,
            first: None,
            last: None,
            increments: Vec::new(),
            messages: Vec::new(),
        }
    }

    pub(crate) fn advance(&mut self, increment: &Increment) {
        self.levelling.get_or_insert_with(|| Levelling::new(increment.from)).advance(increment);
        self.increments.push(*increment);
    }

    pub(crate) fn observe(&mut self, received: &Received) {
        match &received.message {
            Message::Gnss(fix) if fix.quality.is_measured() && fix.position.is_some() => {
                // the mean acceleration belongs to the levelling window only
                if self.levelling.is_some() && fix.velocity.is_some() {
                    self.first = earlier(self.first, *fix);
                }
                self.last = later(self.last, *fix);
            }
            Message::Reference(reference) => {
                // a horizontal position: the height is only known from elsewhere
                let height = self.berth.map_or(0.0, |berth| berth.height);
                let place = reference.position.map(|place| Geodetic { height, ..place });
                self.berth = place.or(self.berth);
            }
            _ => {}
        }
        self.messages.push(received.clone());
    }

    /// Level and kinematics of the window's start, once both are known.
    pub(crate) fn ready(&self) -> Option<(Level, Kinematics)> {
        let levelling = self.levelling.as_ref()?;
        let elapsed = levelling.duration();
        if elapsed < WINDOW {
            return None;
        }
        let by_gnss = self.by_gnss(levelling.now());
        let known = by_gnss.is_some() || self.moored || elapsed > PATIENCE;
        let kinematics = by_gnss.or_else(|| self.by_berth())?;
        known.then_some((levelling.level_at_start()?, kinematics))
    }

    /// Whether the ship lies at her berth.
    pub(crate) fn is_moored(&self) -> bool {
        self.moored
    }

    /// Where the ship is, as far as anybody said.
    pub(crate) fn place(&self) -> Option<Geodetic> {
        self.last.and_then(|fix| fix.position).or(self.berth)
    }

    /// Whether the window has grown useless, because nothing tells where the ship is.
    pub(crate) fn is_stale(&self) -> bool {
        self.levelling.as_ref().is_some_and(|levelling| levelling.duration() > 2.0 * PATIENCE)
    }

    /// Everything seen in the window: increments and messages.
    pub(crate) fn into_data(self) -> (Vec<Increment>, Vec<Received>) {
        (self.increments, self.messages)
    }

    fn by_gnss(&self, now: Time) -> Option<Kinematics> {
        let last = self.last.filter(|fix| (now - fix.time).as_seconds() < FRESH)?;
        let start = self.first.unwrap_or(last);
        Some(Kinematics {
            position: start.position?,
            position_std: 100.0,
            velocity: start.velocity.map_or_else(Vector3::zeros, |v| v.0),
            velocity_std: if start.velocity.is_some() { 3.0 } else { 10.0 },
            acceleration: self.acceleration(&last).unwrap_or_else(Vector3::zeros),
            moored: self.moored,
            gnss_position: true,
            gnss_velocity: start.velocity.is_some(),
        })
    }

    fn acceleration(&self, last: &GnssFix) -> Option<Vector3<f64>> {
        let first = self.first?;
        let elapsed = (last.time - first.time).as_seconds();
        let change = last.velocity?.0 - first.velocity?.0;
        (elapsed > 0.5 * WINDOW).then_some(change / elapsed)
    }

    fn by_berth(&self) -> Option<Kinematics> {
        Some(Kinematics {
            position: self.berth?,
            position_std: 100.0,
            velocity: Vector3::zeros(),
            velocity_std: if self.moored { 2.0 } else { 10.0 },
            acceleration: Vector3::zeros(),
            moored: self.moored,
            gnss_position: false,
            gnss_velocity: false,
        })
    }
}

/// The fix that was valid first; fixes may arrive in any order.
fn earlier(known: Option<GnssFix>, fix: GnssFix) -> Option<GnssFix> {
    Some(known.filter(|known| known.time <= fix.time).unwrap_or(fix))
}

/// The fix that was valid last.
fn later(known: Option<GnssFix>, fix: GnssFix) -> Option<GnssFix> {
    Some(known.filter(|known| known.time > fix.time).unwrap_or(fix))
}
