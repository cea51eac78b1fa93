//! The first seconds: levelling, and collecting where and how fast the ship is.

use insd_alignment::bank::Kinematics;
use insd_alignment::{Level, Levelling};
use insd_base::{Geodetic, GnssFix, Message, StartCondition, Time};
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
}

impl Coarse {
    pub(crate) fn new(config: &EngineConfig) -> Self {
        Coarse {
            moored: config.start == StartCondition::Moored,
            berth: config.initial,
            levelling: None,
            first: None,
            last: None,
        }
    }

    pub(crate) fn advance(&mut self, increment: &Increment) {
        self.levelling.get_or_insert_with(|| Levelling::new(increment.from)).advance(increment);
    }

    pub(crate) fn observe(&mut self, message: &Message) {
        match message {
            Message::Gnss(fix) if fix.quality.is_measured() && fix.position.is_some() => {
                // the mean acceleration belongs to the levelling window only
                if self.levelling.is_some() && fix.velocity.is_some() {
                    self.first.get_or_insert(*fix);
                }
                self.last = Some(*fix);
            }
            Message::Reference(reference) => self.berth = reference.position.or(self.berth),
            _ => {}
        }
    }

    /// Level and kinematics once both are known.
    pub(crate) fn ready(&self) -> Option<(Level, Kinematics)> {
        let levelling = self.levelling.as_ref()?;
        let elapsed = levelling.duration();
        if elapsed < WINDOW {
            return None;
        }
        let level = levelling.level()?;
        let by_gnss = self.by_gnss(levelling.now());
        let known = by_gnss.is_some() || self.moored || elapsed > PATIENCE;
        let kinematics = by_gnss.or_else(|| self.by_berth())?;
        known.then_some((level, kinematics))
    }

    fn by_gnss(&self, now: Time) -> Option<Kinematics> {
        let last = self.last.filter(|fix| (now - fix.time).as_seconds() < FRESH)?;
        let velocity = last.velocity;
        let acceleration = self.acceleration(&last).unwrap_or_else(Vector3::zeros);
        Some(Kinematics {
            position: last.position?,
            position_std: 100.0,
            velocity: velocity.map_or_else(Vector3::zeros, |v| v.0),
            velocity_std: if velocity.is_some() { 3.0 } else { 10.0 },
            acceleration,
            moored: self.moored,
        })
    }

    fn acceleration(&self, last: &GnssFix) -> Option<Vector3<f64>> {
        let first = self.first?;
        let elapsed = (last.time - first.time).as_seconds();
        (elapsed > 0.5 * WINDOW)
            .then_some(Some((last.velocity?.0 - first.velocity?.0) / elapsed))
            .flatten()
    }

    fn by_berth(&self) -> Option<Kinematics> {
        Some(Kinematics {
            position: self.berth?,
            position_std: 100.0,
            velocity: Vector3::zeros(),
            velocity_std: if self.moored { 1.0 } else { 10.0 },
            acceleration: Vector3::zeros(),
            moored: self.moored,
        })
    }
}
