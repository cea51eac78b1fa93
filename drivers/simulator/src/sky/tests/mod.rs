//! Claims about the raw GNSS of whole voyages.

mod antennas;
mod ranges;
mod scenes;

use std::collections::{BTreeMap, BTreeSet};

use approx::assert_relative_eq;
use insd_base::earth::ecef;
use insd_base::satellites::{
    BroadcastRecord, Constellation, KeplerRecord, SPEED_OF_LIGHT, SatelliteEpoch, SatelliteId,
    SignalObservation,
};
use insd_base::{Body, GpsTime, Time};
use nalgebra::{Rotation3, Vector3};

use super::{RawGnss, kepler::EARTH_RATE};
use crate::track::Track;
use crate::{Scenario, raw_gnss, simulate};

/// All errors off.
const PERFECT: &str = "
code_std_m = 0.0
phase_std_m = 0.0
doppler_std_mps = 0.0
multipath_code_std_m = 0.0
multipath_phase_std_m = 0.0
clock_bias_walk_m_sqrt_s = 0.0
clock_drift_walk_mps_sqrt_s = 0.0
line_bias_walk_m_sqrt_s = 0.0
clock_offset_ms = 0.0
clock_drift_mps = 0.0
constellation_offset_std_m = 0.0
slips_per_hour = 0.0
frequencies = 2
";

/// The sky of a voyage without any error.
const CLEAR: &str = "
[raw.sky]
constellations = \"GEJC\"
orbit_std_m = 0.0
clock_std_m = 0.0
record_step_m = 0.0
ionosphere_factor = [0.0, 0.0]
ionosphere_std = 0.0
troposphere_factor = 0.0
";

fn scenario(raw: &str) -> Scenario {
    let text = format!(
        "name = \"raw\"\nmode = \"underway\"\n[start]\nlat_deg = 35.0\nlon_deg = 139.0\n[sea]\nstate = 4\n\
         [[route.legs]]\nheading_deg = 10.0\nspeed_kn = 8.0\nduration_s = 120.0\n[imu]\ngrade = \"mems\"\n[raw]\n{raw}"
    );
    Scenario::from_toml(&text).unwrap()
}

fn made(raw: &str, seed: u64) -> (Scenario, RawGnss) {
    let scenario = scenario(raw);
    let raw = raw_gnss(&scenario, seed).unwrap();
    (scenario, raw)
}

/// Time of an epoch since the start, s.
fn seconds(scenario: &Scenario, epoch: &SatelliteEpoch) -> f64 {
    let start = crate::feed::Calendar::new(&scenario.start_utc).unwrap().gps(Time::START);
    epoch.tag.since(start).as_seconds()
}

/// Position of a satellite by the formulas of IS-GPS-200N, table 20-IV, written out; and its clock without group delay, s.
fn by_the_book(record: &KeplerRecord, at: GpsTime, early: f64) -> (Vector3<f64>, f64) {
    let constellation = record.satellite.constellation;
    let beidou = constellation == Constellation::BeiDou;
    let mu = if beidou || constellation == Constellation::Galileo {
        3.986_004_418e14
    } else {
        3.986_005e14
    };
    let rate = if beidou { 7.292_115e-5 } else { 7.292_115_146_7e-5 };
    let k = &record.orbit;
    let a = k.sqrt_a.powi(2);
    let tk = at.since(k.reference).as_seconds() - early;
    let mean = k.m0 + ((mu / a.powi(3)).sqrt() + k.delta_n) * tk;
    let mut e = mean;
    for _ in 0..50 {
        e = mean + k.eccentricity * e.sin();
    }
    let nu = ((1.0 - k.eccentricity.powi(2)).sqrt() * e.sin()).atan2(e.cos() - k.eccentricity);
    let phi = nu + k.omega;
    let (s, c) = ((2.0 * phi).sin(), (2.0 * phi).cos());
    let u = phi + k.cus * s + k.cuc * c;
    let r = a * (1.0 - k.eccentricity * e.cos()) + k.crs * s + k.crc * c;
    let i = k.i0 + k.cis * s + k.cic * c + k.i_dot * tk;
    let (x, y) = (r * u.cos(), r * u.sin());
    let week = k.reference.to_week().1 as f64 * 1e-9 - if beidou { 14.0 } else { 0.0 };
    let o = k.omega0 + (k.omega_dot - rate) * tk - rate * week;
    let position = Vector3::new(
        x * o.cos() - y * i.cos() * o.sin(),
        x * o.sin() + y * i.cos() * o.cos(),
        y * i.sin(),
    );
    let dt = at.since(record.clock.reference).as_seconds() - early;
    let relativity = -2.0 * (mu * a).sqrt() * k.eccentricity * e.sin() / SPEED_OF_LIGHT.powi(2);
    (position, record.clock.a0 + record.clock.a1 * dt + relativity)
}

/// The record whose reference time is nearest.
fn nearest(raw: &RawGnss, id: SatelliteId, at: GpsTime) -> KeplerRecord {
    let own = raw.broadcast.iter().filter(|record| record.satellite() == id);
    let best = own.min_by_key(|record| at.since(record.reference()).as_nanos().abs());
    match best.unwrap() {
        BroadcastRecord::Kepler(record) => *record,
        BroadcastRecord::Glonass(_) => panic!(),
    }
}

/// What a code of one signal should be, m: everything in axes that do not turn, light time by bisection.
fn expected(raw: &RawGnss, signal: &SignalObservation, tag: GpsTime, antenna: Vector3<f64>) -> f64 {
    let record = nearest(raw, signal.satellite, tag);
    let miss = |travel: f64| {
        let (position, _) = by_the_book(&record, tag, travel);
        let inertial =
            Rotation3::from_axis_angle(&Vector3::z_axis(), -EARTH_RATE * travel) * position;
        (inertial - antenna).norm() - SPEED_OF_LIGHT * travel
    };
    let (mut low, mut high) = (0.05, 0.2);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if miss(middle) > 0.0 { low = middle } else { high = middle }
    }
    let gamma = (1575.42e6 * signal.wavelength().unwrap() / SPEED_OF_LIGHT).powi(2);
    let [first, second] = record.group_delays;
    let delay = match (signal.satellite.constellation, signal.signal.band) {
        (Constellation::Galileo, 1) => second,
        (Constellation::Galileo, _) => second - first + gamma * first,
        (Constellation::BeiDou, 2) => first,
        (Constellation::BeiDou, _) => 0.0,
        _ => gamma * first,
    };
    SPEED_OF_LIGHT * (low - by_the_book(&record, tag, low).1 + delay)
}

/// Observations of each satellite's signals, with the times of their epochs.
fn arcs(
    scenario: &Scenario,
    epochs: &[SatelliteEpoch],
) -> BTreeMap<(SatelliteId, u8), Vec<(f64, SignalObservation)>> {
    let mut arcs: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for epoch in epochs {
        for signal in &epoch.signals {
            let arc = arcs.entry((signal.satellite, signal.signal.band)).or_default();
            arc.push((seconds(scenario, epoch), *signal));
        }
    }
    arcs
}
