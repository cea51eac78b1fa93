//! What the satellites broadcast.

use insd_base::satellites::{
    BroadcastKind, BroadcastRecord, ClockPolynomial, Constellation, IonosphereModel, KeplerOrbit,
    KeplerRecord, SPEED_OF_LIGHT,
};
use insd_base::units::wrap_pi;
use insd_base::{GpsTime, Span};
use rand_pcg::Pcg64;

use super::constellation::{Nominal, number};
use super::kepler::{BEIDOU_BEHIND, earth_rate, gm, week_seconds};
use crate::random::{Purpose, normal, numbered};

/// Time from record to record, s.
const INTERVAL: f64 = 7200.0;

/// Coefficients of the broadcast ionosphere, steps of IS-GPS-200N, table 20-X: 12 m of delay at the most.
pub(crate) const ALPHA: [f64; 4] =
    [11.0 / 1_073_741_824.0, 2.0 / 134_217_728.0, -1.0 / 16_777_216.0, -2.0 / 16_777_216.0];
/// See [`ALPHA`].
pub(crate) const BETA: [f64; 4] = [43.0 * 2048.0, 6.0 * 16_384.0, -65_536.0, -131_072.0];

/// The broadcast model of the ionosphere.
pub(crate) const IONOSPHERE: IonosphereModel =
    IonosphereModel::Klobuchar { alpha: ALPHA, beta: BETA };

/// The reference time of GPS records at or before an instant.
pub(crate) fn reference_before(start: GpsTime) -> GpsTime {
    let (week, nanos) = start.to_week();
    let interval = Span::from_seconds(INTERVAL).as_nanos();
    GpsTime::from_week(week as u16, nanos - nanos % interval)
}

/// All records of some satellites that are of use from `reference` on for `duration`, s, satellite by satellite.
/// `stale` says from which time after `reference`, s, on a satellite broadcasts none.
pub(crate) fn records(
    satellites: &[Nominal],
    (reference, duration): (GpsTime, f64),
    step: f64,
    seed: u64,
    stale: impl Fn(&Nominal) -> f64,
) -> Vec<BroadcastRecord> {
    let last = (duration / INTERVAL).ceil() as i64 + 1;
    let of = |satellite: &Nominal| {
        let mut rng = numbered(seed, Purpose::OrbitError, 1000 + number(satellite.id));
        let until = stale(satellite);
        let all = (-1..=last).map(|index| record(satellite, reference, index, step, &mut rng));
        let all: Vec<KeplerRecord> = all.collect();
        let is_sent = move |record: &KeplerRecord| {
            record.orbit.reference.since(reference).as_seconds() <= until
        };
        all.into_iter().filter(is_sent).map(BroadcastRecord::Kepler).collect::<Vec<_>>()
    };
    satellites.iter().flat_map(of).collect()
}

/// The record `index` intervals after `reference`: the very orbit and clock, carried on to its reference time, but for `step`, m, 1-sigma
/// each, along the track and in the clock.
fn record(
    satellite: &Nominal,
    reference: GpsTime,
    index: i64,
    step: f64,
    rng: &mut Pcg64,
) -> KeplerRecord {
    let constellation = satellite.id.constellation;
    let ahead = if constellation == Constellation::BeiDou { BEIDOU_BEHIND } else { 0.0 };
    let dt = index as f64 * INTERVAL + ahead;
    let at = reference.plus(Span::from_seconds(dt));
    let mut orbit = carried_on(&satellite.orbit, constellation, at);
    orbit.m0 += step * normal(rng) / (orbit.sqrt_a * orbit.sqrt_a);
    let own = satellite.clock;
    let since = at.since(own.reference).as_seconds();
    let a0 = own.a0 + own.a1 * since + step * normal(rng) / SPEED_OF_LIGHT;
    let issue = at.to_week().1 / Span::from_seconds(INTERVAL).as_nanos() + 1;
    KeplerRecord {
        satellite: satellite.id,
        kind: match constellation {
            Constellation::Galileo => BroadcastKind::Inav,
            Constellation::BeiDou => BroadcastKind::D1,
            _ => BroadcastKind::Lnav,
        },
        issue: issue as u16,
        clock_issue: issue as u16,
        health: 0,
        accuracy: Some(if constellation == Constellation::Galileo { 3.12 } else { 2.0 }),
        group_delays: satellite.group_delays,
        orbit,
        clock: ClockPolynomial { reference: at, a0, ..own },
        transmitted: Some(at.plus(Span::from_seconds(-3600.0))),
    }
}

/// The same orbit with its elements at another reference time.
fn carried_on(orbit: &KeplerOrbit, constellation: Constellation, at: GpsTime) -> KeplerOrbit {
    let dt = at.since(orbit.reference).as_seconds();
    let a = orbit.sqrt_a * orbit.sqrt_a;
    let motion = (gm(constellation) / a).sqrt() / a + orbit.delta_n;
    // the node counts from the start of the week that the reference time is in
    let weeks = week_seconds(constellation, at) - week_seconds(constellation, orbit.reference) - dt;
    let node = orbit.omega0 + orbit.omega_dot * dt + earth_rate(constellation) * weeks;
    KeplerOrbit {
        reference: at,
        m0: wrap_pi(orbit.m0 + motion * dt),
        omega0: wrap_pi(node),
        i0: orbit.i0 + orbit.i_dot * dt,
        ..*orbit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sky::constellation::{clock_offset, satellites};
    use crate::sky::kepler::place;
    use approx::assert_relative_eq;

    /// An hour before the end of a week.
    fn reference() -> GpsTime {
        reference_before(GpsTime::from_week(2398, 601_200_000_000_000))
    }

    #[test]
    fn every_record_reproduces_the_orbit_and_the_clock_that_are_used_even_in_another_week() {
        let all = satellites("GEJC", reference(), 5);
        assert_eq!(all.len(), 30 + 24 + 4 + 30);
        let records = records(&all, (reference(), 7200.0), 0.0, 5, |_| f64::INFINITY);
        for satellite in &all {
            let own = records.iter().filter(|record| record.satellite() == satellite.id);
            let mut count = 0;
            for record in own {
                let BroadcastRecord::Kepler(record) = record else { panic!() };
                let constellation = satellite.id.constellation;
                let later = record.orbit.reference.since(satellite.orbit.reference).as_seconds();
                let expected = place(&satellite.orbit, constellation, 1000.0 + later).position;
                let found = place(&record.orbit, constellation, 1000.0).position;
                assert!(
                    (found - expected).norm() < 2e-3,
                    "{} {}",
                    satellite.id,
                    (found - expected).norm()
                );
                let clock = clock_offset(&satellite.clock, 1000.0 + later);
                assert_relative_eq!(clock_offset(&record.clock, 1000.0), clock, epsilon = 1e-7);
                count += 1;
            }
            assert_eq!(count, 4);
        }
    }

    #[test]
    fn a_stale_satellite_broadcasts_no_newer_record() {
        let all = satellites("G", reference(), 5);
        let stale =
            |satellite: &Nominal| if satellite.id.number == 7 { 100.0 } else { f64::INFINITY };
        let records = records(&all, (reference(), 7200.0), 0.2, 5, stale);
        let of = |number: u8| records.iter().filter(|r| r.satellite().number == number).count();
        assert_eq!((of(7), of(8)), (2, 4));
    }

    #[test]
    fn the_geosynchronous_satellites_stay_over_their_longitudes() {
        for satellite in satellites("J", reference(), 9) {
            for hour in 0..24 {
                let orbit = &satellite.orbit;
                let position = place(orbit, Constellation::Qzss, f64::from(hour) * 3600.0).position;
                let longitude = position.y.atan2(position.x).to_degrees();
                assert!((longitude - 134.0).abs() < 30.0, "{} {longitude}", satellite.id);
            }
        }
    }
}
