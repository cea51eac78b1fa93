//! A sky for tests: circular orbits, a still receiver, no noise.

use std::f64::consts::{PI, TAU};

use insd_base::satellites::{
    BroadcastKind, ClockPolynomial, KeplerOrbit, KeplerRecord, SPEED_OF_LIGHT,
};
use insd_base::{
    BroadcastRecord, Constellation, Geodetic, GpsTime, SatelliteEpoch, SatelliteId, SignalCode,
    SignalObservation, Span, earth,
};
use nalgebra::Vector3;

use crate::context::Context;
use crate::sight::Sight;
use crate::signals::{dispersion, group_delay};

/// The receiver's clock is ahead by this much, s.
pub(crate) const CLOCK: f64 = 3e-4;

/// An instant with satellites all around.
pub(crate) fn start() -> GpsTime {
    GpsTime::from_week(2381, 100_000_000_000_000)
}

/// Where the receiver is, ECEF, m.
pub(crate) fn berth() -> Vector3<f64> {
    earth::ecef(&Geodetic::from_degrees(54.0, 10.0, 40.0)).0
}

/// Orbits of 24 satellites of GPS in six planes and as many of Galileo in three.
pub(crate) fn context() -> Context {
    let mut context = Context::default();
    for (constellation, kind, planes, sqrt_a) in [
        (Constellation::Gps, BroadcastKind::Lnav, 6, 5153.6),
        (Constellation::Galileo, BroadcastKind::Inav, 3, 5440.6),
    ] {
        for number in 1..=24_u8 {
            let satellite = SatelliteId { constellation, number };
            let record = record(satellite, kind, planes, sqrt_a);
            context.ephemerides.insert(BroadcastRecord::Kepler(record)).unwrap();
        }
    }
    context
}

fn record(satellite: SatelliteId, kind: BroadcastKind, planes: u8, sqrt_a: f64) -> KeplerRecord {
    let place = f64::from(satellite.number - 1);
    let plane = f64::from((satellite.number - 1) % planes);
    KeplerRecord {
        satellite,
        kind,
        issue: 7,
        clock_issue: 7,
        health: 0,
        accuracy: Some(2.0),
        group_delays: [-5e-9, 3e-9],
        orbit: KeplerOrbit {
            reference: start().plus(Span::from_seconds(1800.0)),
            sqrt_a,
            eccentricity: 0.005,
            m0: (place * 1.1).rem_euclid(TAU) - PI,
            delta_n: 4e-9,
            omega: 0.5,
            omega0: plane * TAU / f64::from(planes) - PI,
            omega_dot: -8e-9,
            i0: 0.96,
            i_dot: 1e-10,
            cuc: 1e-6,
            cus: 5e-6,
            crc: 200.0,
            crs: 20.0,
            cic: 1e-7,
            cis: -1e-7,
        },
        clock: ClockPolynomial { reference: start(), a0: 1e-5 * place - 1e-4, a1: 1e-12, a2: 0.0 },
        transmitted: None,
    }
}

/// What a receiver measures `after` seconds, by whose clock, at a place with a velocity over the Earth, m/s; on L1 and L5. Satellites above 10 degrees.
pub(crate) fn epoch(
    context: &Context,
    after: f64,
    antenna: &Vector3<f64>,
    velocity: &Vector3<f64>,
) -> SatelliteEpoch {
    let tag = start().plus(Span::from_seconds(after));
    let mut signals = Vec::new();
    for record in context.ephemerides.iter() {
        let sight = sight(record, tag, antenna);
        if sight.direction(antenna).elevation < 0.18 {
            continue;
        }
        for signal in [SignalCode::new(1, b'C'), SignalCode::new(5, b'Q')] {
            signals.push(observation(context, record, &sight, signal, (tag, antenna, velocity)));
        }
    }
    SatelliteEpoch { tag, signals, leap_seconds: Some(18), clock_reset: false }
}

/// Solves for the code that a receiver at a place has.
fn sight(record: &BroadcastRecord, tag: GpsTime, antenna: &Vector3<f64>) -> Sight {
    let mut code = 2.2e7;
    for _ in 0..8 {
        let sight = Sight::new(record, tag, code);
        code =
            sight.transmitter().range(antenna) + SPEED_OF_LIGHT * (CLOCK - sight.satellite.clock);
    }
    Sight::new(record, tag, code)
}

fn observation(
    context: &Context,
    record: &BroadcastRecord,
    sight: &Sight,
    signal: SignalCode,
    (tag, antenna, velocity): (GpsTime, &Vector3<f64>, &Vector3<f64>),
) -> SignalObservation {
    let satellite = record.satellite();
    let place = earth::geodetic(&insd_base::Ecef(*antenna));
    let delays = context.delays(&place, sight.direction(antenna), tag);
    let ionosphere = delays.ionosphere * dispersion(satellite, signal).unwrap();
    let clock = CLOCK - sight.satellite.clock + group_delay(record, signal).unwrap();
    let range = sight.transmitter().range(antenna) + delays.troposphere + SPEED_OF_LIGHT * clock;
    let drift = SPEED_OF_LIGHT * -sight.satellite.clock_drift;
    let rate = sight.transmitter().range_rate(antenna, velocity) + drift;
    let unknown = SignalObservation::unknown(satellite, signal);
    let wavelength = unknown.wavelength().unwrap();
    SignalObservation {
        code: Some(range + ionosphere),
        phase: Some((range - ionosphere) / wavelength + 1000.0 * f64::from(satellite.number)),
        doppler: Some(-rate / wavelength),
        cn0: Some(45.0),
        lock: Some(100.0),
        ..unknown
    }
}
