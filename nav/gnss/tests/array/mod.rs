//! Four antennas under a made-up sky: satellites on random circles, noise, line biases, clocks and integers of its own.

#![allow(dead_code)] // each user needs some of it
#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use insd_base::satellites::{
    BroadcastKind, ClockPolynomial, KeplerOrbit, KeplerRecord, SPEED_OF_LIGHT,
};
use insd_base::{
    BroadcastRecord, Constellation, Ecef, Geodetic, GpsTime, SatelliteEpoch, SatelliteId,
    SignalCode, SignalObservation, Span, earth,
};
use insd_gnss::{Context, Sight};
use nalgebra::{Matrix3, Vector3};

use crate::random::Random;

/// Satellites below this are not heard, rad.
const LOWEST: f64 = 0.2;
/// A receiver's phase, m: `1.5 mm sqrt(1 + 1/sin^2 E)`.
const PHASE: f64 = 1.5e-3;
/// How line biases wander, m per root of a second.
const WALK: f64 = 5e-5;

/// Ten centimetres square, forward and starboard, with antenna 1 at the bow's port corner, on a mast.
pub(crate) fn square() -> Vec<Vector3<f64>> {
    let corner = |x: f64, y: f64| Vector3::new(-6.0 + x, -0.8 + y, -14.0);
    vec![corner(0.05, -0.05), corner(0.05, 0.05), corner(-0.05, 0.05), corner(-0.05, -0.05)]
}

/// A sky, and an array under it.
pub(crate) struct Made {
    pub(crate) random: Random,
    pub(crate) context: Context,
    pub(crate) place: Vector3<f64>,
    /// Satellites that are heard.
    pub(crate) heard: Vec<SatelliteId>,
    levers: Vec<Vector3<f64>>,
    lines: BTreeMap<(usize, Constellation), f64>,
    integers: BTreeMap<(usize, SatelliteId), f64>,
    /// Each receiver's clock ahead, m, and its drift, m/s.
    pub(crate) clocks: Vec<(f64, f64)>,
    /// By how many dB the signals of an antenna are weaker.
    pub(crate) weaker: Vec<f64>,
    /// Added to the phase of a satellite at an antenna, m.
    pub(crate) reflected: BTreeMap<(usize, SatelliteId), f64>,
    before: f64,
}

impl Made {
    /// A sky of GPS and Galileo, and receivers on one clock.
    pub(crate) fn new(seed: u64, levers: Vec<Vector3<f64>>) -> Self {
        let mut random = Random(seed.wrapping_mul(0x5851_F42D).wrapping_add(17));
        let latitude = 120.0 * random.uniform() - 60.0;
        let at = Geodetic::from_degrees(latitude, 360.0 * random.uniform() - 180.0, 20.0);
        let mut context = Context::default();
        for number in 1..=60 {
            for (constellation, kind, sqrt_a) in [
                (Constellation::Gps, BroadcastKind::Lnav, 5153.6),
                (Constellation::Galileo, BroadcastKind::Inav, 5440.6),
            ] {
                let satellite = SatelliteId { constellation, number };
                let record = record(&mut random, satellite, kind, sqrt_a);
                context.ephemerides.insert(BroadcastRecord::Kepler(record)).unwrap();
            }
        }
        let count = levers.len();
        let mut made = Self {
            random,
            context,
            place: earth::ecef(&at).0,
            heard: Vec::new(),
            levers,
            lines: BTreeMap::new(),
            integers: BTreeMap::new(),
            clocks: vec![(900.0, 0.3); count],
            weaker: vec![0.0; count],
            reflected: BTreeMap::new(),
            before: 0.0,
        };
        made.heard = made.risen();
        made
    }

    /// Satellites that have risen, in an order that has nothing to do with where they stand.
    pub(crate) fn risen(&mut self) -> Vec<SatelliteId> {
        let mut all: Vec<(f64, SatelliteId)> = Vec::new();
        for record in self.context.ephemerides.iter() {
            let elevation = Sight::new(record, start(), 2.4e7).direction(&self.place).elevation;
            if elevation > LOWEST + 0.02 {
                all.push((self.random.uniform(), record.satellite()));
            }
        }
        all.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        all.into_iter().map(|(_, satellite)| satellite).collect()
    }

    /// Unit vectors to the satellites that are heard, north, east, down, and the variance of a phase, m^2.
    pub(crate) fn directions(&self, after: f64) -> Vec<(Vector3<f64>, f64)> {
        let tag = start().plus(Span::from_seconds(after));
        let c_ne = earth::c_ne(&earth::geodetic(&Ecef(self.place)));
        let direction = |satellite: &SatelliteId| {
            let record = self.context.ephemerides.select(*satellite, tag).unwrap();
            let sight = Sight::new(record, tag, 2.4e7);
            let e = c_ne * sight.transmitter().line(&self.place);
            (e, PHASE * PHASE * (1.0 + 1.0 / (e.z * e.z)))
        };
        self.heard.iter().map(direction).collect()
    }

    /// What all receivers measure when the hull stands so.
    pub(crate) fn epochs(&mut self, after: f64, c_nb: &Matrix3<f64>) -> Vec<SatelliteEpoch> {
        let step = WALK * (after - self.before).max(0.0).sqrt();
        self.before = after;
        for line in self.lines.values_mut() {
            *line += step * self.random.gauss();
        }
        let antennas = 0..self.levers.len();
        antennas.map(|antenna| self.epoch(antenna, after, c_nb)).collect()
    }

    fn epoch(&mut self, antenna: usize, after: f64, c_nb: &Matrix3<f64>) -> SatelliteEpoch {
        let tag = start().plus(Span::from_seconds(after));
        let c_ne = earth::c_ne(&earth::geodetic(&Ecef(self.place)));
        let at = self.place + c_ne.transpose() * (c_nb * (self.levers[antenna] - self.levers[0]));
        let (ahead, drift) = self.clocks[antenna];
        let clock = ahead + drift * after;
        let heard = self.heard.clone();
        let signals = heard.iter().map(|satellite| {
            let record = *self.context.ephemerides.select(*satellite, tag).unwrap();
            self.observed(antenna, &record, (tag, clock, &at))
        });
        SatelliteEpoch { tag, signals: signals.collect(), leap_seconds: None, clock_reset: false }
    }

    fn observed(
        &mut self,
        antenna: usize,
        record: &BroadcastRecord,
        (tag, clock, at): (GpsTime, f64, &Vector3<f64>),
    ) -> SignalObservation {
        let satellite = record.satellite();
        let mut range = 2.4e7;
        for _ in 0..8 {
            let sight = Sight::new(record, tag, range);
            let clocks = clock - SPEED_OF_LIGHT * sight.satellite.clock;
            range = sight.transmitter().range(at) + clocks;
        }
        let elevation = Sight::new(record, tag, range).direction(at).elevation;
        let weaker = self.weaker[antenna];
        let noise = (1.0 + 1.0 / elevation.sin().powi(2)).sqrt() * 10_f64.powf(weaker / 20.0);
        let random = &mut self.random;
        let constellation = satellite.constellation;
        let line = self.lines.entry((antenna, constellation)).or_insert_with(|| random.uniform());
        let line = *line;
        let cycles = self.integers.entry((antenna, satellite));
        let cycles = *cycles.or_insert_with(|| (1e5 * random.uniform()).round());
        let own = SignalObservation::unknown(satellite, SignalCode::new(1, b'C'));
        let wavelength = own.wavelength().unwrap();
        let reflected = self.reflected.get(&(antenna, satellite)).copied().unwrap_or(0.0);
        let phase = range + line + reflected + PHASE * noise * random.gauss();
        SignalObservation {
            code: Some(range + 0.3 * noise * random.gauss()),
            phase: Some(phase / wavelength + cycles),
            cn0: Some(45.0 - weaker),
            ..own
        }
    }
}

/// The covariance of roll, pitch and heading that no estimator is better than in one epoch, line biases known, rad^2: about north, east and down. `None` where it is singular.
pub(crate) fn bound(
    directions: &[(Vector3<f64>, f64)],
    levers: &[Vector3<f64>],
    c_nb: &Matrix3<f64>,
) -> Option<Matrix3<f64>> {
    let mean = levers.iter().sum::<Vector3<f64>>() / levers.len() as f64;
    let mut information = Matrix3::zeros();
    for (e, variance) in directions {
        for lever in levers {
            let row = (c_nb * (lever - mean)).cross(e);
            information += row * row.transpose() / *variance;
        }
    }
    information.try_inverse()
}

fn start() -> GpsTime {
    GpsTime::from_week(2381, 100_000_000_000_000)
}

fn record(
    random: &mut Random,
    satellite: SatelliteId,
    kind: BroadcastKind,
    sqrt_a: f64,
) -> KeplerRecord {
    let mut angle = || TAU * random.uniform() - PI;
    KeplerRecord {
        satellite,
        kind,
        issue: 7,
        clock_issue: 7,
        health: 0,
        accuracy: Some(2.0),
        group_delays: [0.0; 2],
        orbit: KeplerOrbit {
            reference: start().plus(Span::from_seconds(1800.0)),
            sqrt_a,
            eccentricity: 0.0,
            m0: angle(),
            delta_n: 0.0,
            omega: 0.0,
            omega0: angle(),
            omega_dot: 0.0,
            i0: 0.96,
            i_dot: 0.0,
            cuc: 0.0,
            cus: 0.0,
            crc: 0.0,
            crs: 0.0,
            cic: 0.0,
            cis: 0.0,
        },
        clock: ClockPolynomial { reference: start(), a0: 1e-6, a1: 0.0, a2: 0.0 },
        transmitted: None,
    }
}
