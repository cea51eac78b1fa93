//! Telegrams of motion sensors that the tests start from.

#![allow(dead_code)] // not every test uses all of them

use insd_base::UtcTime;
use insd_base::units::DEG;
use insd_wire::motion::em::{EmAttitude, EmStatus};
use insd_wire::motion::kmb::{Kmb, KmbSigma};
use insd_wire::motion::seapath::{Seapath23, Seapath26};
use insd_wire::motion::tss1::{Tss1, Tss1Aiding};
use insd_wire::motion::{Rated, SensorDelayedHeave, SensorPlace, Tilt, Vertical};

pub(crate) const SECOND: i64 = 1_000_000_000;
/// 2026-03-01T12:00:00 UTC.
pub(crate) const NOON: i64 = 1_772_366_400;

pub(crate) fn full<T>(value: T) -> Option<Rated<T>> {
    Some(Rated { value, reduced: false })
}

pub(crate) fn reduced<T>(value: T) -> Option<Rated<T>> {
    Some(Rated { value, reduced: true })
}

pub(crate) fn near(left: f64, right: f64, tolerance: f64) -> bool {
    (left - right).abs() <= tolerance
}

pub(crate) const LEVEL: Tss1 = Tss1 {
    horizontal_acceleration: 0.0,
    vertical_acceleration: 0.0,
    heave: 0.0,
    aiding: Tss1Aiding::Full,
    settled: true,
    roll: 0.0,
    pitch: 0.0,
};

pub(crate) const EM: EmAttitude = EmAttitude {
    status: Some(EmStatus::Normal),
    roll: Some(0.0),
    pitch: Some(0.0),
    heave: Some(0.0),
    heading: Some(0.0),
};

/// What the computed telegrams say.
pub(crate) fn oslo_fjord() -> Kmb {
    Kmb {
        time: UtcTime::from_nanos(NOON * SECOND + 123_456_789),
        place: full(SensorPlace {
            latitude: 59.9139 * DEG,
            longitude: -10.7522 * DEG,
            height: 45.5,
            north_velocity: 5.25,
            east_velocity: -1.5,
        }),
        tilt: full(Tilt { roll: 2.5 * DEG, pitch: -1.25 * DEG }),
        heading: full(359.5 * DEG),
        vertical: reduced(Vertical { heave: 0.75, down_velocity: 0.125 }),
        rates: [1.5 * DEG, -0.5 * DEG, 3.0 * DEG],
        acceleration: full([0.5, -0.25, 0.125]),
        delayed_heave: None,
        sigma: KmbSigma {
            north: Some(0.5),
            east: Some(0.625),
            height: None,
            roll: Some(0.015_625 * DEG),
            pitch: Some(0.031_25 * DEG),
            heading: Some(0.0625 * DEG),
            heave: Some(0.25),
        },
    }
}

pub(crate) fn oslo_fjord_23() -> Seapath23 {
    let Kmb { time, place, tilt, heading, vertical, rates, .. } = oslo_fjord();
    Seapath23 { time, place, tilt, heading, vertical, rates }
}

pub(crate) fn oslo_fjord_26() -> Seapath26 {
    let time = UtcTime::from_nanos((NOON - 3) * SECOND + 987_600_000);
    let delayed_heave = Some(SensorDelayedHeave { time, heave: 0.6 });
    Seapath26 { motion: oslo_fjord_23(), delayed_heave }
}
