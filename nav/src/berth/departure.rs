//! Whether a ship that was moored has left her berth, from the estimate alone.

use crate::Filter;
use crate::error_state::{POSITION, VELOCITY};
use insd_base::{Geodetic, Span, Time, earth};
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// Watches how far and how fast the estimate moves away.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    from: Vector3<f64>,
    speed: f64,
    certain: bool,
    fast: bool,
    /// Mean velocity that a receiver tells who is left out, north and east, m/s.
    told: Vector2<f64>,
    start: Time,
    next: Time,
}

/// Spacing of looks, s.
const SPACING: f64 = 1.0;
/// Time over which the speed is averaged: longer than any wave, s.
const AVERAGE: f64 = 15.0;
/// Mean speed that moorings do not allow, m/s; a gust of 5 m in 20 s stays below.
const SPEED: f64 = 0.6;
/// The same by the word of a receiver that is left out, m/s: who doubts the moorings may be wrong, too.
const TOLD: f64 = 0.3;
/// Displacement before a speed counts as leaving, m.
const WAY: f64 = 4.0;
/// Displacement that moorings do not allow, m.
const FAR: f64 = 20.0;
/// Before this a motion of the estimate may well be its own tilt, s.
const SETTLING: f64 = 60.0;
/// Nominal, m/s^2.
const GRAVITY: f64 = 9.8;
/// Sigmas of its own error by which the estimate must be sure.
const SURE: f64 = 5.0;

impl Departure {
    /// Watches from where the filter is.
    #[must_use]
    pub fn new(filter: &Filter) -> Self {
        Departure {
            from: filter.nominal().position,
            speed: 0.0,
            certain: false,
            fast: false,
            told: Vector2::zeros(),
            start: filter.time(),
            next: filter.time(),
        }
    }

    /// The same on a time line that is later by a span.
    #[must_use]
    pub fn shifted(self, by: Span) -> Self {
        Departure { start: self.start + by, next: self.next + by, ..self }
    }

    /// Looks at the estimate, if it is time to.
    pub fn watch(&mut self, filter: &Filter) {
        if filter.time() < self.next {
            return;
        }
        self.next = filter.time() + Span::from_seconds(SPACING);
        let place: Geodetic = filter.nominal().geodetic();
        let c_ne = earth::c_ne(&place);
        let away = c_ne * (filter.nominal().position - self.from);
        let distance = away.xy().norm();
        let velocity = (c_ne * filter.nominal().velocity).xy();
        let along = if distance > 0.0 { velocity.dot(&away.xy()) / distance } else { 0.0 };
        self.speed += (along - self.speed) * SPACING / AVERAGE;
        let position_std = POSITION.std(filter.covariance());
        let velocity_std = VELOCITY.std(filter.covariance());
        let leaves = distance > WAY && self.speed > SPEED.max(SURE * velocity_std);
        let is_far = distance > FAR;
        let settled = (filter.time() - self.start).as_seconds() > SETTLING;
        self.fast = settled && leaves;
        self.certain = settled && distance > SURE * position_std && (leaves || is_far);
    }

    /// Hears the velocity, north and east, m/s, of a receiver that is left out: nobody navigates by it, but a ship of which anybody says
    /// that she sails is not held at her berth. `interval` since the last, s.
    pub fn hear(&mut self, velocity: &Vector2<f64>, interval: f64) {
        let weight = (interval / AVERAGE).clamp(0.0, 1.0);
        self.told += (velocity - self.told) * weight;
    }

    /// Whether a receiver that is left out says so.
    #[must_use]
    pub fn is_told(&self) -> bool {
        self.told.norm() > TOLD
    }

    /// What an estimate that was held at the berth while she may have left it is off by: position, m, velocity, m/s, and tilt, rad, as her
    /// acceleration was taken for one.
    #[must_use]
    pub fn missed(&self) -> [f64; 3] {
        let speed = 2.0 * self.told.norm();
        [speed * AVERAGE, speed, speed / AVERAGE / GRAVITY]
    }

    /// Whether the ship is on her way at a speed that moorings do not allow, wherever she is by now.
    #[must_use]
    pub fn is_fast(&self) -> bool {
        self.fast
    }

    /// Whether the ship has left.
    #[must_use]
    pub fn is_certain(&self) -> bool {
        self.certain
    }
}
