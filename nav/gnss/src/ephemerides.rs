//! The records that are known, which of them holds at an instant, and why none does.

use std::collections::BTreeMap;

pub use insd_base::satellites::OrbitRefusal;
use insd_base::satellites::{BroadcastKind, GlonassRecord, KeplerRecord};
use insd_base::{BroadcastRecord, Constellation, GpsTime, SatelliteId};

/// Records kept of one satellite: a day's of Galileo's two messages, which change every ten minutes.
const KEPT: usize = 300;

/// Records of all satellites.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ephemerides {
    records: BTreeMap<SatelliteId, Vec<BroadcastRecord>>,
}

impl Ephemerides {
    /// Takes a record; one for the same satellite, message and reference time gives way. Returns whether it says anything new.
    ///
    /// # Errors
    /// [`OrbitRefusal::Implausible`] for elements that no satellite has.
    pub fn insert(&mut self, record: BroadcastRecord) -> Result<bool, OrbitRefusal> {
        plausible(&record)?;
        let known = self.records.entry(record.satellite()).or_default();
        if known.contains(&record) {
            return Ok(false);
        }
        known.retain(|other| slot(other) != slot(&record));
        let place = known.partition_point(|other| slot(other) <= slot(&record));
        known.insert(place, record);
        if known.len() > KEPT {
            known.remove(0);
        }
        Ok(true)
    }

    /// The healthy record whose reference time is nearest; of Galileo's two messages I/NAV where it holds.
    ///
    /// # Errors
    /// Why there is none.
    pub fn select(
        &self,
        satellite: SatelliteId,
        time: GpsTime,
    ) -> Result<&BroadcastRecord, OrbitRefusal> {
        let known = self.records.get(&satellite).map_or(&[][..], Vec::as_slice);
        let nearest = |kind: BroadcastKind| {
            known
                .iter()
                .filter(|record| slot(record).1 == kind)
                .min_by_key(|record| time.since(record.reference()).as_nanos().unsigned_abs())
                .ok_or(OrbitRefusal::NoRecord)
                .and_then(|record| usable(record, time).map(|()| record))
        };
        match satellite.constellation {
            Constellation::Galileo => nearest(BroadcastKind::Inav)
                .or_else(|refusal| nearest(BroadcastKind::Fnav).map_err(|_| refusal)),
            Constellation::Glonass => nearest(BroadcastKind::Fdma),
            Constellation::BeiDou if satellite.is_geostationary() => nearest(BroadcastKind::D2),
            Constellation::BeiDou => nearest(BroadcastKind::D1),
            _ => nearest(BroadcastKind::Lnav),
        }
    }

    /// Every record, by satellite and time.
    pub fn iter(&self) -> impl Iterator<Item = &BroadcastRecord> {
        self.records.values().flatten()
    }
}

/// What two records of the same thing share, in order of time.
fn slot(record: &BroadcastRecord) -> (GpsTime, BroadcastKind) {
    let kind = match record {
        BroadcastRecord::Kepler(record) => record.kind,
        BroadcastRecord::Glonass(_) => BroadcastKind::Fdma,
    };
    (record.reference(), kind)
}

fn usable(record: &BroadcastRecord, time: GpsTime) -> Result<(), OrbitRefusal> {
    let age = time.since(record.reference()).as_seconds();
    let limit = limit(record.satellite().constellation);
    if age.abs() > limit {
        return Err(OrbitRefusal::Stale { age, limit });
    }
    match health(record) {
        0 => Ok(()),
        health => Err(OrbitRefusal::Unhealthy(health)),
    }
}

/// How far from its reference time a record holds, s: half its interval of fit and the wait for the next.
fn limit(constellation: Constellation) -> f64 {
    const MINUTE: f64 = 60.0;
    match constellation {
        Constellation::Glonass => 15.0 * MINUTE,
        Constellation::Galileo => 240.0 * MINUTE,
        Constellation::BeiDou => 360.0 * MINUTE,
        // 7200 s and a little, as files have records whose reference time lies 16 s off the hour
        _ => 121.0 * MINUTE,
    }
}

/// The bits of health that concern the signals whose clock the record tells.
fn health(record: &BroadcastRecord) -> u16 {
    match record {
        BroadcastRecord::Glonass(record) => u16::from(record.health),
        BroadcastRecord::Kepler(record) => {
            record.health
                & match (record.satellite.constellation, record.kind) {
                    // RINEX 3.05, table A8: E1-B and E5b, or E5a
                    (Constellation::Galileo, BroadcastKind::Fnav) => 0b000_111_000,
                    (Constellation::Galileo, _) => 0b111_000_111,
                    // the last bit is of L1C/B alone (IS-QZSS-PNT-005, 4.1.2.3)
                    (Constellation::Qzss, _) => !1,
                    _ => !0,
                }
        }
    }
}

fn plausible(record: &BroadcastRecord) -> Result<(), OrbitRefusal> {
    let fault = match record {
        BroadcastRecord::Kepler(record) => implausible_orbit(record),
        BroadcastRecord::Glonass(record) => implausible_state(record),
    };
    fault.map_or(Ok(()), |what| Err(OrbitRefusal::Implausible(what)))
}

fn implausible_orbit(record: &KeplerRecord) -> Option<&'static str> {
    let orbit = &record.orbit;
    let angles = [orbit.m0, orbit.omega, orbit.omega0, orbit.i0];
    let rates = [orbit.delta_n, orbit.omega_dot, orbit.i_dot];
    let corrections = [orbit.cuc, orbit.cus, orbit.cic, orbit.cis];
    let clock = &record.clock;
    let week_apart = clock.reference.since(orbit.reference).as_seconds().abs() > 86_400.0;
    // medium orbits have 5153 (GPS) to 5441 (Galileo), inclined and geostationary ones 6493 m^1/2
    [
        (!(4_900.0..6_700.0).contains(&orbit.sqrt_a), "semi-major axis"),
        // Galileo's E14 and E18 have 0.16, QZSS 0.075
        (!(0.0..0.5).contains(&orbit.eccentricity), "eccentricity"),
        (!angles.iter().all(|angle| angle.abs() < 7.0), "angle"),
        (!rates.iter().all(|rate| rate.abs() < 1e-6), "rate of an angle"),
        (!corrections.iter().all(|term| term.abs() < 1e-3), "harmonic correction"),
        (!(orbit.crc.abs() < 5e4 && orbit.crs.abs() < 5e4), "harmonic correction of the radius"),
        (!(clock.a0.abs() < 0.1 && clock.a1.abs() < 1e-6 && clock.a2.abs() < 1e-9), "clock"),
        (!record.group_delays.iter().all(|delay| delay.abs() < 1e-6), "group delay"),
        (week_apart, "orbit and clock refer to times more than a day apart"),
    ]
    .into_iter()
    .find_map(|(fault, what)| fault.then_some(what))
}

fn implausible_state(record: &GlonassRecord) -> Option<&'static str> {
    let radius = record.position.iter().map(|x| x * x).sum::<f64>().sqrt();
    let speed = record.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
    [
        // 25 510 km, and up to 3.95 km/s less the Earth's rotation
        (!(24e6..27e6).contains(&radius), "distance from the Earth"),
        (!(1e3..5e3).contains(&speed), "speed"),
        (!record.acceleration.iter().all(|a| a.abs() < 1e-4), "acceleration of sun and moon"),
        (!(record.clock_offset.abs() < 0.1 && record.clock_drift.abs() < 1e-6), "clock"),
        (!(-7..=13).contains(&record.channel), "frequency channel"),
    ]
    .into_iter()
    .find_map(|(fault, what)| fault.then_some(what))
}
