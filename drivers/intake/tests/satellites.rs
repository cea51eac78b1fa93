//! Raw messages of recorded receivers, whole, cut and damaged.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Arrival, GpsTime, Input, PortId, Stamp, Time, UtcTime};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::Refusal;
use insd_intake::port::Link;
use insd_intake::satellites::{RawReading, RawUse, SatelliteFollower, SatelliteNews, WordsFault};
use insd_intake::status::SensorStatus;
use insd_intake::{Intake, Intaken};
use insd_wire::gnss::navigation::Broadcast;
use insd_wire::stream::{Cutter, Protocol};
use proptest::prelude::*;

/// A walk with a u-blox receiver, an epoch of a mosaic, and messages of a base (their licences are beside them).
const UBX: &[u8] = include_bytes!("../../wire/tests/data/walk_1730.ubx");
const SBF: &[u8] = include_bytes!("../../wire/tests/data/x5_measurements.sbf");
const RTCM: &[u8] = include_bytes!("../../wire/tests/data/rtcm3.bin");

/// Epochs, broadcast records and what is refused of a recording.
fn followed(protocol: Protocol, bytes: &[u8], about: Option<GpsTime>) -> [usize; 3] {
    let (mut cutter, mut follower) = (Cutter::new(&[protocol]), SatelliteFollower::default());
    cutter.push(bytes);
    let mut counts = [0; 3];
    while let Some(cut) = cutter.cut() {
        let Some(reading) = RawReading::of_frame(protocol, cut.bytes) else { continue };
        for told in follower.take(&reading, about) {
            counts[match told {
                Ok(SatelliteNews::Epoch { epoch, .. }) => {
                    let names = epoch.signals.iter().map(|own| (own.satellite, own.signal));
                    assert!(names.is_sorted() && !epoch.signals.is_empty());
                    0
                }
                Ok(SatelliteNews::Broadcast(Broadcast::Record(_))) => 1,
                Ok(SatelliteNews::Broadcast(_)) => continue,
                Err(_) => 2,
            }] += 1;
        }
    }
    counts
}

#[test]
fn recorded_receivers_of_three_formats_become_epochs_and_orbits() {
    assert_eq!(followed(Protocol::Ubx, UBX, None), [7, 4, 0]);
    assert_eq!(followed(Protocol::Sbf, SBF, None), [1, 0, 0]);
    let about = UtcTime::from_civil((2023, 1, 3), (12, 0, 0), 0).unwrap().to_gps();
    assert_eq!(followed(Protocol::Rtcm, RTCM, Some(about)), [1, 0, 0]);
}

#[test]
fn what_tells_no_date_waits_for_one_or_is_refused() {
    let mut cutter = Cutter::new(&[Protocol::Rtcm]);
    cutter.push(RTCM);
    let mut refused = 0;
    while let Some(cut) = cutter.cut() {
        let Some(reading) = RawReading::of_frame(Protocol::Rtcm, cut.bytes) else { continue };
        let told = SatelliteFollower::default().take(&reading, None);
        assert_eq!(told, [Err(WordsFault::NoTime)]);
        refused += 1;
    }
    assert!(refused > 0);
}

/// What a receiver's bytes make when they come in pieces of a size.
fn status(kind: Kind, raw: RawUse, bytes: &[u8], size: usize) -> (SensorStatus, usize) {
    let port = "port".to_owned();
    let mut config = IntakeConfig::default();
    config.ports.push(PortSpec { name: port.clone(), link: Link::Stream });
    config.sensors.push(SensorConfig { raw, ..SensorConfig::new("gnss", &port, kind) });
    let mut intake = Intake::new(&config);
    let system = UtcTime::from_civil((2025, 8, 28), (17, 30, 40), 0).unwrap();
    let mut ranges = 0;
    for (number, piece) in bytes.chunks(size).enumerate() {
        let monotonic = Time::from_seconds(number as f64 * 1e-4 * size as f64);
        let input = Input::Bytes(piece.to_vec());
        intake.handle(&Arrival { stamp: Stamp { monotonic, system }, port: PortId(0), input });
        while let Some(out) = intake.poll_output() {
            let is_ranges =
                |own: &insd_base::Received| matches!(own.message, insd_base::Message::Ranges(_));
            ranges += usize::from(matches!(&out, Intaken::Measured(own) if is_ranges(own)));
        }
    }
    (intake.status().sensors[0].clone(), ranges)
}

#[test]
fn an_epoch_without_an_orbit_is_counted_and_one_that_is_not_wanted_is_not() {
    let (own, ranges) = status(Kind::Ubx, RawUse::Tight, UBX, 100);
    assert_eq!((own.refused.get(&Refusal::NoOrbit), ranges), (Some(&7), 0), "{own:?}");
    let (own, _) = status(Kind::Ubx, RawUse::Off, UBX, 100);
    assert_eq!(own.refused.get(&Refusal::NoOrbit), None, "{own:?}");
}

#[test]
fn raw_messages_are_switched_off_only_where_there_is_something_else() {
    for (kind, faults) in [(Kind::Ubx, 0), (Kind::Sbf, 0), (Kind::Rtcm, 1), (Kind::NmeaGnss, 1)] {
        let mut config = IntakeConfig::default();
        config.ports.push(PortSpec { name: "port".to_owned(), link: Link::Stream });
        let own = SensorConfig { raw: RawUse::Off, ..SensorConfig::new("gnss", "port", kind) };
        config.sensors.push(own);
        let of_raw = config.faults().into_iter().filter(|fault| fault.key == "raw").count();
        assert_eq!(of_raw, faults, "{kind:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn damaged_bytes_of_receivers_are_counted_and_nothing_panics(
        which in 0_usize..3,
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..40),
        cut in any::<prop::sample::Index>(),
        size in 1_usize..3000,
    ) {
        let (kind, bytes) = [(Kind::Ubx, UBX), (Kind::Sbf, SBF), (Kind::Rtcm, RTCM)][which];
        let mut bytes = bytes.to_vec();
        for (at, byte) in flips {
            let at = at.index(bytes.len());
            bytes[at] ^= byte;
        }
        bytes.drain(..cut.index(bytes.len()));
        let _ = status(kind, RawUse::Tight, &bytes, size);
    }
}
