//! Our sentences as another parser reads them: the `nmea` crate.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::FixQuality;
use insd_wire::nmea::{
    CivilTime, Date, Gga, Hdt, NmeaLine, Position, PositionMode, Talker, TimeOfDay, Vtg, Zda, Zone,
};
use nmea::ParseResult;

fn parsed(line: &NmeaLine) -> ParseResult {
    nmea::parse_bytes(line.as_bytes()).unwrap_or_else(|error| panic!("{line:?}: {error:?}"))
}

const TIME: TimeOfDay = TimeOfDay { hour: 9, minute: 8, second: 7, nanosecond: 250_000_000 };

#[test]
fn another_parser_reads_our_gga() {
    let gga = Gga {
        time: Some(TIME),
        position: Some(Position {
            latitude: (-35.5_f64).to_radians(),
            longitude: (-139.25_f64).to_radians(),
        }),
        quality: FixQuality::Simulated,
        altitude: Some(12.34),
        geoid_separation: Some(-30.5),
        ..Gga::default()
    };
    let ParseResult::GGA(read) = parsed(&gga.write(Talker::IN)) else { panic!() };
    assert!((read.latitude.unwrap() + 35.5).abs() < 1e-9);
    assert!((read.longitude.unwrap() + 139.25).abs() < 1e-9);
    assert!((read.altitude.unwrap() - 12.34).abs() < 1e-5);
    assert!((read.geoid_separation.unwrap() + 30.5).abs() < 1e-5);
    assert_eq!(read.fix_type, Some(nmea::sentences::FixType::Simulation));
}

#[test]
fn another_parser_reads_our_hdt_and_vtg() {
    let hdt = Hdt { heading: Some(271.25_f64.to_radians()) };
    let ParseResult::HDT(read) = parsed(&hdt.write(Talker::HE)) else { panic!() };
    assert!((read.heading.unwrap() - 271.25).abs() < 1e-4);
    let vtg = Vtg {
        course: Some(12.5_f64.to_radians()),
        course_magnetic: None,
        speed: Some(10.0 * 1852.0 / 3600.0),
        mode: Some(PositionMode::Autonomous),
    };
    let ParseResult::VTG(read) = parsed(&vtg.write(Talker::IN)) else { panic!() };
    assert!((read.true_course.unwrap() - 12.5).abs() < 1e-4);
    assert!((read.speed_over_ground.unwrap() - 10.0).abs() < 1e-4);
}

#[test]
fn another_parser_reads_our_zda() {
    let date = Date { year: 2026, month: 2, day: 28 };
    let zone = Some(Zone { hours: -9, minutes: 0 });
    let zda = Zda { utc: Some(CivilTime { date, time: TIME }), zone };
    let ParseResult::ZDA(read) = parsed(&zda.write(Talker::IN)) else { panic!() };
    assert_eq!((read.year, read.month, read.day), (Some(2026), Some(2), Some(28)));
}
