//! What is written is read back, for every value a field can carry.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::FixQuality;
use insd_base::units::{KNOT, wrap_pi};
use insd_wire::nmea::{
    CivilTime, Date, Gga, Hdt, HeadingMode, Line, MAX_LEN, Position, PositionMode, Rot, Sentence,
    Talker, Ths, TimeOfDay, Vtg, Zda, Zone,
};
use insd_wire::stream::{Cutter, Protocol};
use proptest::prelude::*;

/// Reads a line back after checking that it keeps the standard's length.
fn read(line: &Line) -> Sentence {
    assert!(line.as_bytes().len() <= MAX_LEN, "{line:?}");
    assert!(line.as_bytes().ends_with(b"\r\n"));
    Sentence::read(line.as_bytes()).unwrap_or_else(|fault| panic!("{line:?}: {fault}")).1
}

/// Whether both are unknown, or both known and as close as the last digit allows.
fn close(written: Option<f64>, read: Option<f64>, half_digit: f64) -> bool {
    match (written, read) {
        (Some(a), Some(b)) => (a - b).abs() <= half_digit * (1.0 + 1e-6) + 1e-12,
        (None, None) => true,
        _ => false,
    }
}

fn same_angle(written: Option<f64>, read: Option<f64>, half_digit: f64) -> bool {
    let difference = written.zip(read).map(|(a, b)| wrap_pi(a - b));
    match difference {
        Some(difference) => difference.abs() <= half_digit * (1.0 + 1e-6) + 1e-12,
        None => written.is_none() && read.is_none(),
    }
}

fn angle() -> impl Strategy<Value = Option<f64>> {
    prop::option::of(0.0..std::f64::consts::TAU)
}

fn time_of_day() -> impl Strategy<Value = TimeOfDay> {
    (0..24_u8, 0..60_u8, 0..=60_u8, 0..100_u32).prop_map(|(hour, minute, second, hundredths)| {
        TimeOfDay { hour, minute, second, nanosecond: hundredths * 10_000_000 }
    })
}

fn date() -> impl Strategy<Value = Date> {
    (0..=9999_u16, 1..=12_u8, 1..=31_u8)
        .prop_map(|(year, month, day)| Date { year, month, day })
        .prop_filter("the calendar has this day", |date| date.is_valid())
}

fn position() -> impl Strategy<Value = Position> {
    (-90.0..=90.0_f64, -180.0..=180.0_f64).prop_map(|(latitude, longitude)| Position {
        latitude: latitude.to_radians(),
        longitude: longitude.to_radians(),
    })
}

prop_compose! {
    fn gga()(
        time in prop::option::of(time_of_day()),
        position in prop::option::of(position()),
        quality in 0..=8_u8,
        satellites in prop::option::of(0..=99_u8),
        hdop in prop::option::of(0.0..=999.9_f64),
        altitude in prop::option::of(-99_999.0..=99_999.0_f64),
        geoid_separation in prop::option::of(-110.0..=90.0_f64),
        age in prop::option::of(0.0..=9999.0_f64),
        station in prop::option::of(0..=1023_u16),
    ) -> Gga {
        let quality = FixQuality::from_gga(quality).unwrap();
        Gga { time, position, quality, satellites, hdop, altitude, geoid_separation, age, station }
    }
}

proptest! {
    #[test]
    fn headings_come_back(heading in angle(), letter in prop::sample::select(b"AEMSV".to_vec())) {
        let mode = HeadingMode::from_letter(letter).unwrap();
        let half_digit = 0.005_f64.to_radians();
        let Sentence::Hdt(hdt) = read(&Hdt { heading }.write(Talker::HE)) else { panic!() };
        prop_assert!(same_angle(heading, hdt.heading, half_digit));
        let Sentence::Ths(ths) = read(&Ths { heading, mode }.write(Talker::HE)) else { panic!() };
        prop_assert!(same_angle(heading, ths.heading, half_digit));
        prop_assert_eq!(ths.mode, mode);
    }

    #[test]
    fn rates_of_turn_come_back(rate in prop::option::of(-20.0..20.0_f64), valid: bool) {
        let Sentence::Rot(rot) = read(&Rot { rate, valid }.write(Talker::TI)) else { panic!() };
        prop_assert!(close(rate, rot.rate, (0.05_f64 / 60.0).to_radians()));
        prop_assert_eq!(rot.valid, valid && rate.is_some());
    }

    #[test]
    fn courses_and_speeds_come_back(
        course in angle(), course_magnetic in angle(),
        speed in prop::option::of(0.0..1000.0_f64),
        letter in prop::sample::select(b"ADEFMNPRS".to_vec()),
    ) {
        let mode = PositionMode::from_letter(letter);
        let vtg = Vtg { course, course_magnetic, speed, mode };
        let Sentence::Vtg(back) = read(&vtg.write(Talker::IN)) else { panic!() };
        prop_assert!(same_angle(course, back.course, 0.005_f64.to_radians()));
        prop_assert!(same_angle(course_magnetic, back.course_magnetic, 0.005_f64.to_radians()));
        prop_assert!(close(speed, back.speed, 0.005 * KNOT));
        prop_assert_eq!(back.mode, mode);
    }

    #[test]
    fn dates_and_times_come_back_exactly(
        date in date(), time in time_of_day(), known: bool,
        zone in prop::option::of((-13..=13_i8, -59..=59_i8)),
    ) {
        let utc = known.then_some(CivilTime { date, time });
        let zone = zone.map(|(hours, minutes)| Zone { hours, minutes });
        let zda = Zda { utc, zone };
        prop_assert_eq!(read(&zda.write(Talker::IN)), Sentence::Zda(zda));
    }

    #[test]
    fn fixes_come_back_and_only_age_and_station_may_be_lost(gga in gga()) {
        let Sentence::Gga(back) = read(&gga.write(Talker::IN)) else { panic!() };
        let half_digit = (0.000_005_f64 / 60.0).to_radians();
        let latitude = |gga: &Gga| gga.position.map(|position| position.latitude);
        let longitude = |gga: &Gga| gga.position.map(|position| position.longitude);
        prop_assert!(close(latitude(&gga), latitude(&back), half_digit));
        prop_assert!(same_angle(longitude(&gga), longitude(&back), half_digit));
        prop_assert_eq!((gga.time, gga.quality, gga.satellites),
            (back.time, back.quality, back.satellites));
        prop_assert!(close(gga.hdop, back.hdop, 0.05));
        prop_assert!(close(gga.altitude, back.altitude, 0.005));
        prop_assert!(close(gga.geoid_separation, back.geoid_separation, 0.005));
        if back.station.is_some() || back.age.is_some() {
            prop_assert_eq!(gga.station, back.station);
            prop_assert!(close(gga.age, back.age, 0.05));
        }
    }

    #[test]
    fn no_value_whatever_makes_a_line_too_long_or_unreadable(
        a: f64, b: f64, c: f64, d: f64, small: u8, wide: u16, nanosecond: u32,
    ) {
        let time = TimeOfDay { hour: small, minute: small, second: small, nanosecond };
        let position = Some(Position { latitude: a, longitude: b });
        let date = Date { year: wide, month: small, day: small };
        let gga = Gga {
            time: Some(time), position, satellites: Some(small), hdop: Some(c), altitude: Some(d),
            geoid_separation: Some(a), age: Some(b), station: Some(wide), ..Gga::default()
        };
        let vtg = Vtg { course: Some(a), course_magnetic: Some(b), speed: Some(c), mode: None };
        let zone = Some(Zone { hours: small as i8, minutes: small as i8 });
        for line in [
            Hdt { heading: Some(a) }.write(Talker::HE),
            Rot { rate: Some(a), valid: true }.write(Talker::TI),
            gga.write(Talker::IN),
            vtg.write(Talker::IN),
        ] {
            read(&line);
        }
        let zda = Zda { utc: Some(CivilTime { date, time }), zone }.write(Talker::IN);
        prop_assert!(zda.as_bytes().len() <= MAX_LEN);
    }

    #[test]
    fn arbitrary_bytes_never_panic_the_reader(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = Sentence::read(&bytes);
        let mut cutter = Cutter::new(&[Protocol::Nmea]);
        cutter.push(&bytes);
        while let Some(cut) = cutter.cut() {
            let _ = Sentence::read(cut.bytes);
        }
    }

    #[test]
    fn arbitrary_fields_under_a_good_checksum_never_panic_the_reader(
        formatter in prop::sample::select(vec!["GGA", "HDT", "ROT", "THS", "VTG", "ZDA"]),
        fields in prop::collection::vec("[ -)+-~]{0,12}|[0-9.,+-]{0,12}|[A-Z]|", 0..18),
    ) {
        let text = format!("IN{formatter},{}", fields.join(","));
        let sum = insd_wire::nmea::checksum(text.as_bytes());
        let _ = Sentence::read(format!("${text}*{sum:02X}\r\n").as_bytes());
    }
}
