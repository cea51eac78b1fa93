//! Satellites as they truly are.

use insd_base::GpsTime;
use insd_base::satellites::{SPEED_OF_LIGHT, SatelliteId};
use nalgebra::Vector3;

use super::constellation::{Nominal, clock_offset, number};
use super::kepler::place;
use super::wander::Wander;
use crate::random::{Purpose, numbered};

/// How far truth is from what is broadcast.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Departure {
    /// 1-sigma of the length of the error of the orbit, m.
    pub(crate) orbit: f64,
    /// 1-sigma of the error of the clock, m.
    pub(crate) clock: f64,
    /// Mean period of both, s.
    pub(crate) period: f64,
}

/// A satellite with its errors.
#[derive(Clone, Debug)]
pub(crate) struct Satellite {
    nominal: Nominal,
    /// From the reference times of orbit and clock to the start of the voyage, s.
    since: f64,
    /// Radial, along the track, across, m.
    orbit: [Wander; 3],
    clock: Wander,
    /// From when on, s, it leaves its orbit along the track, and how it is accelerated, m/s^2.
    leaves: Option<(f64, f64)>,
}

/// Position and clock of a satellite at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SatelliteState {
    /// Earth-fixed axes of that instant, m.
    pub(crate) position: Vector3<f64>,
    /// Its clock ahead of the time of GPS, m.
    pub(crate) clock: f64,
}

impl Satellite {
    /// A satellite in a voyage that begins at `start`.
    pub(crate) fn new(nominal: Nominal, start: GpsTime, departure: Departure, seed: u64) -> Self {
        let mut rng = numbered(seed, Purpose::OrbitError, number(nominal.id));
        let Departure { orbit, clock, period } = departure;
        let axis = orbit / 3.0_f64.sqrt();
        let since = start.since(nominal.orbit.reference).as_seconds();
        Satellite {
            nominal,
            since,
            orbit: std::array::from_fn(|_| Wander::new(axis, period, &mut rng)),
            clock: Wander::new(clock, period, &mut rng),
            leaves: None,
        }
    }

    /// Its name.
    pub(crate) fn id(&self) -> SatelliteId {
        self.nominal.id
    }

    /// Its group delays, s.
    pub(crate) fn group_delays(&self) -> [f64; 2] {
        self.nominal.group_delays
    }

    /// From `t`, s, on it is accelerated along its track, m/s^2, and nobody is told.
    pub(crate) fn leave(&mut self, t: f64, acceleration: f64) {
        self.leaves = Some((t, acceleration));
    }

    /// The satellite at time `t`, s.
    pub(crate) fn at(&self, t: f64) -> SatelliteState {
        let dt = self.since + t;
        let place = place(&self.nominal.orbit, self.nominal.id.constellation, dt);
        let radial = place.position.normalize();
        let along = place.normal.cross(&radial);
        let [r, a, c] = &self.orbit;
        let left = self.leaves.map_or(0.0, |(from, rate)| 0.5 * rate * (t - from).max(0.0).powi(2));
        let error = radial * r.at(t) + along * (a.at(t) + left) + place.normal * c.at(t);
        let clock = clock_offset(&self.nominal.clock, dt) + place.relativity * SPEED_OF_LIGHT;
        SatelliteState { position: place.position + error, clock: clock + self.clock.at(t) }
    }
}
