//! A sound sky, and what orders make of it.

use std::f64::consts::{PI, TAU};

use insd_base::satellites::{
    BroadcastKind, ClockPolynomial, GlonassRecord, KeplerOrbit, KeplerRecord, SPEED_OF_LIGHT,
};
use insd_base::{
    BroadcastRecord, Constellation, Geodetic, GpsTime, IonosphereModel, SatelliteEpoch,
    SatelliteId, SignalCode, SignalObservation, Span, earth,
};
use insd_gnss::{Context, Sight};
use nalgebra::{Rotation3, Vector3};

use super::Orders;

/// The receiver's clock is ahead by this much, s.
const CLOCK: f64 = 3e-4;

fn start() -> GpsTime {
    GpsTime::from_week(2381, 100_000_000_000_000)
}

/// Where the receiver is, ECEF, m.
pub(crate) fn berth() -> Vector3<f64> {
    earth::ecef(&Geodetic::from_degrees(54.0, 10.0, 40.0)).0
}

/// Records of all satellites, those that are ordered damaged.
pub(crate) fn context(orders: &mut Orders<'_>) -> Context {
    let mut context = Context::default();
    let mut records = records();
    for _ in 0..orders.byte() % 32 {
        let which = usize::from(orders.byte()) % records.len();
        match &mut records[which] {
            BroadcastRecord::Kepler(record) => damage_orbit(record, orders),
            BroadcastRecord::Glonass(record) => damage_state(record, orders),
        }
    }
    for record in records {
        let _ = context.ephemerides.insert(record);
    }
    if orders.byte() % 2 == 1 {
        let mut coefficient = |sound: f64| match orders.byte() {
            0 => orders.number(sound),
            _ => sound,
        };
        let model = IonosphereModel::Klobuchar {
            alpha: [1e-8, 7e-9, -6e-8, -1e-7].map(&mut coefficient),
            beta: [9e4, 1e5, -6e4, -5e5].map(&mut coefficient),
        };
        context.ionosphere.insert(Constellation::Gps, model);
    }
    context
}

fn records() -> Vec<BroadcastRecord> {
    let mut records = Vec::new();
    for (constellation, kind, planes, sqrt_a) in [
        (Constellation::Gps, BroadcastKind::Lnav, 6, 5153.6),
        (Constellation::Galileo, BroadcastKind::Inav, 3, 5440.6),
        (Constellation::BeiDou, BroadcastKind::D1, 3, 5282.6),
    ] {
        for number in 6..=29_u8 {
            let satellite = SatelliteId { constellation, number };
            records.push(BroadcastRecord::Kepler(kepler(satellite, kind, planes, sqrt_a)));
        }
    }
    records.extend((1..=24).map(|number| BroadcastRecord::Glonass(glonass(number))));
    records
}

fn kepler(satellite: SatelliteId, kind: BroadcastKind, planes: u8, sqrt_a: f64) -> KeplerRecord {
    let place = f64::from(satellite.number);
    let plane = f64::from(satellite.number % planes);
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
        clock: ClockPolynomial { reference: start(), a0: 1e-5 * place, a1: 1e-12, a2: 0.0 },
        transmitted: None,
    }
}

fn glonass(number: u8) -> GlonassRecord {
    let place = f64::from(number);
    let turned = Rotation3::from_euler_angles(1.13, 0.0, f64::from(number % 3) * TAU / 3.0)
        * Rotation3::from_euler_angles(0.0, 0.0, place * 0.8);
    GlonassRecord {
        satellite: SatelliteId { constellation: Constellation::Glonass, number },
        channel: number as i8 % 7,
        reference: start(),
        position: (turned * Vector3::new(25.5e6, 0.0, 0.0)).into(),
        velocity: (turned * Vector3::new(0.0, 3.5e3, 0.0)).into(),
        acceleration: [1e-6, -2e-6, 0.0],
        clock_offset: 1e-6 * place,
        clock_drift: 1e-12,
        health: 0,
        age_days: 0.0,
    }
}

fn damage_orbit(record: &mut KeplerRecord, orders: &mut Orders<'_>) {
    let KeplerRecord { orbit, clock, group_delays: [first, second], .. } = record;
    let number = match orders.byte() % 24 {
        0 => &mut orbit.sqrt_a,
        1 => &mut orbit.eccentricity,
        2 => &mut orbit.m0,
        3 => &mut orbit.delta_n,
        4 => &mut orbit.omega,
        5 => &mut orbit.omega0,
        6 => &mut orbit.omega_dot,
        7 => &mut orbit.i0,
        8 => &mut orbit.i_dot,
        9 => &mut orbit.cuc,
        10 => &mut orbit.cus,
        11 => &mut orbit.crc,
        12 => &mut orbit.crs,
        13 => &mut orbit.cic,
        14 => &mut orbit.cis,
        15 => &mut clock.a0,
        16 => &mut clock.a1,
        17 => &mut clock.a2,
        18 => first,
        19 => second,
        20 => return orbit.reference = orders.instant(orbit.reference),
        21 => return clock.reference = orders.instant(clock.reference),
        22 => return record.health = u16::from(orders.byte()),
        _ => return record.accuracy = Some(orders.number(2.0)),
    };
    *number = orders.number(*number);
}

fn damage_state(record: &mut GlonassRecord, orders: &mut Orders<'_>) {
    let axis = usize::from(orders.byte()) % 3;
    let number = match orders.byte() % 8 {
        0 => &mut record.position[axis],
        1 => &mut record.velocity[axis],
        2 => &mut record.acceleration[axis],
        3 => &mut record.clock_offset,
        4 => &mut record.clock_drift,
        5 => &mut record.age_days,
        6 => return record.reference = orders.instant(record.reference),
        _ => return record.channel = orders.byte() as i8,
    };
    *number = orders.number(*number);
}

/// What the receiver measures so many seconds after the start, damaged as ordered.
pub(crate) fn epoch(context: &Context, after: f64, orders: &mut Orders<'_>) -> SatelliteEpoch {
    let tag = start().plus(Span::from_seconds(after));
    let mut signals: Vec<SignalObservation> = Vec::new();
    for record in context.ephemerides.iter() {
        signals.extend(observations(record, tag));
    }
    for _ in 0..orders.byte() % 48 {
        if !signals.is_empty() {
            damage_signal(&mut signals, orders);
        }
    }
    let tag = if orders.byte() == 1 { orders.instant(tag) } else { tag };
    SatelliteEpoch { tag, signals, leap_seconds: Some(18), clock_reset: orders.byte() == 1 }
}

/// Two signals of a satellite above the horizon.
fn observations(record: &BroadcastRecord, tag: GpsTime) -> Vec<SignalObservation> {
    let antenna = berth();
    let mut code = 2.2e7;
    for _ in 0..4 {
        let sight = Sight::new(record, tag, code);
        let clocks = SPEED_OF_LIGHT * (CLOCK - sight.satellite.clock);
        code = sight.transmitter().range(&antenna) + clocks;
    }
    let sight = Sight::new(record, tag, code);
    // whoever was damaged so that it is nowhere is heard nevertheless
    if sight.direction(&antenna).elevation < 0.18 {
        return Vec::new();
    }
    let satellite = record.satellite();
    let channel = match record {
        BroadcastRecord::Kepler(_) => None,
        BroadcastRecord::Glonass(record) => Some(record.channel),
    };
    let bands = match satellite.constellation {
        Constellation::BeiDou => [(2, b'I'), (6, b'I')],
        Constellation::Glonass => [(1, b'C'), (2, b'C')],
        _ => [(1, b'C'), (5, b'Q')],
    };
    let rate = sight.transmitter().range_rate(&antenna, &Vector3::zeros());
    let observed = bands.map(|(band, attribute)| {
        let own = SignalObservation::unknown(satellite, SignalCode::new(band, attribute));
        let wavelength = SignalObservation { channel, ..own }.wavelength().unwrap_or(0.19);
        SignalObservation {
            channel,
            code: Some(code),
            phase: Some(code / wavelength),
            doppler: Some(-rate / wavelength),
            cn0: Some(45.0),
            lock: Some(100.0),
            ..own
        }
    });
    observed.to_vec()
}

fn damage_signal(signals: &mut Vec<SignalObservation>, orders: &mut Orders<'_>) {
    let which = usize::from(orders.byte()) % signals.len();
    let other = usize::from(orders.byte()) % signals.len();
    let own = &mut signals[which];
    let field = match orders.byte() % 12 {
        0 => &mut own.code,
        1 => &mut own.phase,
        2 => &mut own.doppler,
        3 => &mut own.cn0,
        4 => &mut own.lock,
        5 => return own.half_cycle = true,
        6 => return own.slip = true,
        7 => return own.channel = Some(orders.byte() as i8),
        8 => return own.signal = SignalCode::new(orders.byte(), orders.byte()),
        9 => return own.satellite.number = orders.byte(),
        10 => return signals.swap(which, other),
        _ => return signals.truncate(which),
    };
    *field = match orders.byte() % 4 {
        0 => None,
        _ => Some(orders.number(field.unwrap_or(2.2e7))),
    };
}
