//! Satellite compasses by sentences of their makers: published lines, and what is written comes back.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::units::DEG;
use insd_wire::nmea::{
    NmeaFault, PsatHpr, PsatSource, PtnlAvr, PtnlQuality, Sentence, Talker, TimeOfDay,
};
use proptest::option::of;
use proptest::prelude::*;

fn parsed(line: &str) -> Sentence {
    Sentence::read(line.as_bytes()).unwrap().1
}

fn degrees(angle: Option<f64>) -> f64 {
    angle.unwrap().to_degrees()
}

/// Of a Hemisphere compass on R/V Ronald H. Brown, CLIVAR 2010 (NOAA), and of others on public pages.
const PSAT: [(&str, f64, Option<f64>, Option<f64>); 7] = [
    ("$PSAT,HPR,235410.50,89.58,3.35,,N*01", 89.58, Some(3.35), None),
    ("$PSAT,HPR,235410.60,89.57,3.31,,N*09", 89.57, Some(3.31), None),
    ("$PSAT,HPR,235410.70,89.58,3.29,,N*0E", 89.58, Some(3.29), None),
    ("$PSAT,HPR,235410.80,89.58,3.26,,N*0E", 89.58, Some(3.26), None),
    ("$PSAT,HPR,235410.90,89.57,3.25,,N*03", 89.57, Some(3.25), None),
    ("$PSAT,HPR,044551.80,161.54,-2.84,1.4,N*3A", 161.54, Some(-2.84), Some(1.4)),
    ("$PSAT,HPR,102143.00,356.881,-0.387,-0.4,N*1E", 356.881, Some(-0.387), Some(-0.4)),
];

#[test]
fn lines_of_hemisphere_compasses_are_read() {
    for (line, heading, pitch, roll) in PSAT {
        let Sentence::PsatHpr(told) = parsed(line) else { panic!("{line}") };
        assert!((degrees(told.heading) - heading).abs() < 1e-9, "{line}");
        assert_eq!(told.source, PsatSource::Satellites);
        for (own, expected) in [(told.pitch, pitch), (told.roll, roll)] {
            assert_eq!(own.is_some(), expected.is_some(), "{line}");
            assert!(expected.is_none_or(|expected| (degrees(own) - expected).abs() < 1e-9));
        }
    }
    let gyro = parsed("$PSAT,HPR,235410.50,89.58,3.35,,G*08");
    assert!(matches!(gyro, Sentence::PsatHpr(told) if told.source == PsatSource::Gyro));
}

#[test]
fn the_published_lines_of_trimble_are_read_and_written_to_the_byte() {
    let tilted = "$PTNL,AVR,212405.20,+52.1531,Yaw,-0.0806,Tilt,,,12.575,3,1.4,16*39";
    let rolled = "$PTNL,AVR,212604.30,+52.1800,Yaw,,,-0.0807,Roll,12.579,3,1.4,16*21";
    for line in [tilted, rolled] {
        let read = parsed(line);
        let Sentence::PtnlAvr(told) = read else { panic!("{line}") };
        assert!((degrees(told.heading()) - 52.17).abs() < 0.02);
        assert_eq!((told.quality, told.satellites), (PtnlQuality::Fixed, Some(16)));
        assert_eq!(told.tilt.is_some(), line == tilted);
        assert_eq!(told.roll.is_some(), line == rolled);
        assert_eq!(read.write(Talker::IN).as_bytes(), format!("{line}\r\n").as_bytes());
        let float = PtnlAvr { quality: PtnlQuality::Float, ..told };
        assert_eq!(float.heading(), None);
    }
}

#[test]
fn other_sentences_of_the_same_makers_are_told_apart() {
    let check = |body: &str| format!("${body}*{:02X}", body.bytes().fold(0, |sum, own| sum ^ own));
    for body in ["PSAT,GBS,034509.00,1,1,1,,,,", "PTNL,GGK,102939.00,051910,5000.97,N"] {
        assert_eq!(Sentence::read(check(body).as_bytes()), Err(NmeaFault::OtherSentence));
    }
    for body in
        ["PTNL,AVR,212405.20,+52.1531,Yow,,,,,12.575,3,1.4,16", "PSAT,HPR,235410.50,89.58,3.35,,X"]
    {
        assert!(matches!(Sentence::read(check(body).as_bytes()), Err(NmeaFault::Malformed { .. })));
    }
}

proptest! {
    #[test]
    fn attitudes_of_satellite_compasses_come_back(
        heading in of(0.0..359.99), tilt in of(-89.0..89.0), length in of(0.0..9000.0),
        satellites in of(any::<u8>()), gyro: bool,
    ) {
        let (heading, tilt) = (heading.map(|own: f64| own * DEG), tilt.map(|own: f64| own * DEG));
        let time = Some(TimeOfDay { hour: 1, minute: 2, second: 3, nanosecond: 250_000_000 });
        let near = |own: Option<f64>, back: Option<f64>, step: f64| match (own, back) {
            (Some(own), Some(back)) => (own - back).abs() <= step * 0.5001,
            (own, back) => own == back,
        };
        let source = if gyro { PsatSource::Gyro } else { PsatSource::Satellites };
        let hpr = PsatHpr { time, heading, pitch: tilt, roll: None, source };
        let line = hpr.write();
        let Sentence::PsatHpr(back) = parsed(line.as_str()) else { panic!() };
        prop_assert!(near(heading, back.heading, 1e-3 * DEG) && near(tilt, back.pitch, 1e-3 * DEG));
        prop_assert_eq!(PsatHpr { heading, pitch: tilt, ..back }, hpr);
        prop_assert!(line.as_bytes().len() <= PsatHpr::LONGEST);
        let avr = PtnlAvr {
            time, yaw: heading, tilt, roll: None, length, quality: PtnlQuality::Fixed, pdop: None,
            satellites,
        };
        let line = avr.write();
        let Sentence::PtnlAvr(back) = parsed(line.as_str()) else { panic!() };
        prop_assert!(near(heading, back.yaw, 1e-4 * DEG) && near(tilt, back.tilt, 1e-4 * DEG));
        prop_assert!(near(length, back.length, 1e-3));
        prop_assert_eq!(PtnlAvr { yaw: heading, tilt, length, ..back }, avr);
        prop_assert!(line.as_bytes().len() <= PtnlAvr::LONGEST);
    }
}
