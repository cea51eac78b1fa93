//! The satellites that there are, and the orbits and clocks that they keep to.
//!
//! Nominal constellations: slots in their planes with the eccentricities, inclinations and corrections that real ones have. Where the planes
//! stand, and in which slot which number flies, is drawn.

use std::f64::consts::TAU;

use insd_base::GpsTime;
use insd_base::satellites::{
    ClockPolynomial, Constellation, KeplerOrbit, SPEED_OF_LIGHT, SatelliteId,
};
use insd_base::units::DEG;
use rand_pcg::Pcg64;

use super::kepler::{earth_rate, gm, week_seconds};
use crate::random::{Purpose, normal, numbered, uniform};

/// A satellite as its operator means it to be.
#[derive(Clone, Debug)]
pub(crate) struct Nominal {
    /// Its name.
    pub(crate) id: SatelliteId,
    /// Its orbit.
    pub(crate) orbit: KeplerOrbit,
    /// Its clock.
    pub(crate) clock: ClockPolynomial,
    /// Group delays as its constellation broadcasts them, s.
    pub(crate) group_delays: [f64; 2],
}

/// A kind of orbit.
struct Kind {
    constellation: Constellation,
    semi_major: f64,
    inclination: f64,
    /// Lowest and highest eccentricity.
    eccentricity: [f64; 2],
    /// Rate of the node, rad/s.
    node_rate: f64,
}

/// Satellites in planes evenly about the pole, and evenly within each: number of planes, numbers of the satellites.
const GPS: (usize, &[u8]) = (
    6,
    &[
        1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25,
        26, 27, 28, 29, 30,
    ],
);
const GALILEO: (usize, &[u8]) =
    (3, &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 15, 16, 19, 21, 23, 24, 25, 26, 27, 30, 31]);
const BEIDOU: (usize, &[u8]) = (
    3,
    &[
        19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 32, 33, 34, 35, 36, 37, 41, 42, 43, 44, 45,
        46,
    ],
);
/// Inclined geosynchronous ones of BeiDou: number and longitude of the crossing, degrees.
const BEIDOU_SYNCHRONOUS: [(u8, f64); 6] =
    [(6, 118.0), (7, 118.0), (8, 118.0), (38, 112.0), (39, 112.0), (40, 112.0)];
/// Those of QZSS: number, longitude of the crossing, degrees; the third stands over the equator.
const QZSS: [(u8, f64); 4] = [(1, 139.0), (2, 139.0), (3, 127.0), (4, 139.0)];

/// The satellites of one voyage whose elements are valid at `reference`, the reference time of GPS.
pub(crate) fn satellites(letters: &str, reference: GpsTime, seed: u64) -> Vec<Nominal> {
    let all =
        [Constellation::Gps, Constellation::Galileo, Constellation::BeiDou, Constellation::Qzss];
    let wanted = all.into_iter().filter(|constellation| letters.contains(constellation.letter()));
    wanted.flat_map(|constellation| of(constellation, reference, seed)).collect()
}

fn of(constellation: Constellation, reference: GpsTime, seed: u64) -> Vec<Nominal> {
    let mut rng = numbered(seed, Purpose::Constellation, constellation.letter() as u64);
    match constellation {
        Constellation::Gps => {
            let kind = Kind::medium(constellation, 26_559_700.0, 55.0, [0.001, 0.015], -8e-9);
            walker(&kind, GPS, reference, &mut rng)
        }
        Constellation::Galileo => {
            let kind = Kind::medium(constellation, 29_600_300.0, 56.0, [1e-4, 5e-4], -5.6e-9);
            walker(&kind, GALILEO, reference, &mut rng)
        }
        Constellation::BeiDou => {
            let kind = Kind::medium(constellation, 27_906_100.0, 55.0, [5e-4, 2e-3], -6.9e-9);
            let mut all = walker(&kind, BEIDOU, reference, &mut rng);
            let kind = Kind::synchronous(constellation, 55.0, [0.002, 0.006]);
            all.extend(figure_eights(&kind, &BEIDOU_SYNCHRONOUS, reference, &mut rng));
            all
        }
        _ => {
            let kind = Kind::synchronous(constellation, 41.0, [0.074, 0.076]);
            let mut all = figure_eights(&kind, &QZSS, reference, &mut rng);
            // over the equator, but for a tenth of a degree
            let still = all.iter_mut().filter(|satellite| satellite.id.number == 3);
            still.for_each(|satellite| satellite.orbit.i0 = 0.1 * DEG);
            all
        }
    }
}

impl Kind {
    fn medium(
        constellation: Constellation,
        semi_major: f64,
        inclination_deg: f64,
        eccentricity: [f64; 2],
        node_rate: f64,
    ) -> Self {
        Kind {
            constellation,
            semi_major,
            inclination: inclination_deg * DEG,
            eccentricity,
            node_rate,
        }
    }

    /// One revolution in the time in which the Earth turns once.
    fn synchronous(
        constellation: Constellation,
        inclination_deg: f64,
        eccentricity: [f64; 2],
    ) -> Self {
        let rate = earth_rate(constellation);
        let semi_major = (gm(constellation) / (rate * rate)).cbrt();
        Kind {
            constellation,
            semi_major,
            inclination: inclination_deg * DEG,
            eccentricity,
            node_rate: -2e-9,
        }
    }

    /// A satellite with its node at the longitude `node`, rad, and so far, `latitude`, rad, beyond it at the reference time.
    fn satellite(
        &self,
        number: u8,
        reference: GpsTime,
        way: [f64; 3],
        rng: &mut Pcg64,
    ) -> Option<Nominal> {
        let [node, latitude, perigee] = way;
        let constellation = self.constellation;
        let start = earth_rate(constellation) * week_seconds(constellation, reference);
        let mut some = |std: f64| std * normal(rng);
        let orbit = KeplerOrbit {
            reference,
            sqrt_a: (self.semi_major + some(300.0)).sqrt(),
            eccentricity: 0.0,
            m0: latitude - perigee,
            delta_n: 4e-9 + some(5e-10),
            omega: perigee,
            omega0: (node + start) % TAU,
            omega_dot: self.node_rate + some(1e-10),
            i0: self.inclination + some(0.5 * DEG),
            i_dot: some(2e-10),
            cuc: some(2e-6),
            cus: 6e-6 + some(2e-6),
            crc: 230.0 + some(50.0),
            crs: some(50.0),
            cic: some(1e-7),
            cis: some(1e-7),
        };
        let [low, high] = self.eccentricity;
        let eccentricity = uniform(rng, low, high);
        Some(Nominal {
            id: SatelliteId::new(constellation, number)?,
            orbit: KeplerOrbit { eccentricity, ..orbit },
            clock: clock(reference, rng),
            group_delays: std::array::from_fn(|_| 4e-9 * normal(rng)),
        })
    }
}

fn clock(reference: GpsTime, rng: &mut Pcg64) -> ClockPolynomial {
    ClockPolynomial { reference, a0: uniform(rng, -5e-4, 5e-4), a1: 5e-12 * normal(rng), a2: 0.0 }
}

/// Satellites evenly in planes, those of neighbouring planes shifted against each other; slots kept to 3 degrees.
fn walker(
    kind: &Kind,
    (planes, numbers): (usize, &[u8]),
    reference: GpsTime,
    rng: &mut Pcg64,
) -> Vec<Nominal> {
    let (first_node, first) = (uniform(rng, 0.0, TAU), uniform(rng, 0.0, TAU));
    let each = numbers.len() / planes;
    let one = |(index, number): (usize, &u8)| {
        let (plane, slot) = (index % planes, index / planes);
        let node = first_node + TAU * plane as f64 / planes as f64;
        let shift = plane as f64 / numbers.len() as f64;
        let latitude = first + TAU * (slot as f64 / each as f64 + shift) + 3.0 * DEG * normal(rng);
        let perigee = uniform(rng, -std::f64::consts::PI, std::f64::consts::PI);
        kind.satellite(*number, reference, [node, latitude, perigee], rng)
    };
    numbers.iter().enumerate().filter_map(one).collect()
}

/// Satellites one after the other on a figure of eight over its longitude; highest in the north.
fn figure_eights(
    kind: &Kind,
    list: &[(u8, f64)],
    reference: GpsTime,
    rng: &mut Pcg64,
) -> Vec<Nominal> {
    let first = uniform(rng, 0.0, TAU);
    let one = |(index, (number, longitude)): (usize, &(u8, f64))| {
        let latitude = first + TAU * index as f64 / 3.0;
        let node = longitude * DEG - latitude;
        kind.satellite(*number, reference, [node, latitude, -TAU / 4.0], rng)
    };
    list.iter().enumerate().filter_map(one).collect()
}

/// A number of its own for every satellite, below 1000.
pub(crate) fn number(id: SatelliteId) -> u64 {
    id.constellation as u64 * 100 + u64::from(id.number)
}

/// The offset of a clock polynomial `dt`, s, after its reference time, m.
pub(crate) fn clock_offset(clock: &ClockPolynomial, dt: f64) -> f64 {
    (clock.a0 + clock.a1 * dt + clock.a2 * dt * dt) * SPEED_OF_LIGHT
}
