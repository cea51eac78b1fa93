//! What is written is read back, for every value a field can carry.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::{angle, close, date, position, read, same_angle, time_of_day};
use insd_base::FixQuality;
use insd_base::units::KNOT;
use insd_wire::nmea::{
    CivilTime, Date, Gga, Hdt, HeadingMode, MAX_LEN, Position, PositionMode, Rot, Sentence, Talker,
    Ths, TimeOfDay, Vtg, Zda, Zone,
};
use proptest::prelude::*;

prop_compose! {
    fn gga()(
        time in prop::option::of(time_of_day()),
        position in prop::option::of(position()),
        quality in 0..=8_u8,
        satellites in prop::option::of(0..=99_u8),
        hdop in prop::option::of(0.0..=99.9_f64),
        altitude in prop::option::of(-9999.0..=9999.0_f64),
        geoid_separation in prop::option::of(-110.0..=90.0_f64),
        age in prop::option::of(0.0..=9999.0_f64),
        station in prop::option::of(0..=4095_u16),
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
}
