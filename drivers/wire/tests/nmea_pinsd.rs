//! insd's own sentences: to the byte, there and back, and never longer than the standard allows.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::{perhaps, read, time_of_day};
use insd_base::units::DEG;
use insd_base::{FixQuality, HeaveQuality, Mode, Ned, Parties, Party, SolutionSigma};
use insd_wire::nmea::{
    HeadingMode, MAX_LEN, NmeaFault, Pinsd, PinsdAlignment, PinsdIntegrity, PinsdMode, PinsdPhase,
    PinsdProtection, PinsdSigma, PinsdSource, PinsdStatus, PinsdTime, ProtectionState, Sentence,
    Talker, TimeOfDay, checksum,
};
use proptest::prelude::*;
use std::f64::consts::PI;

const TIME: Option<TimeOfDay> =
    Some(TimeOfDay { hour: 23, minute: 59, second: 59, nanosecond: 990_000_000 });

fn back(pinsd: Pinsd) -> Pinsd {
    let line = pinsd.write();
    assert!(line.as_bytes().len() <= MAX_LEN, "{line:?}");
    let Sentence::Pinsd(back) = read(&line) else { panic!("{line:?}") };
    back
}

/// Whether both are unknown, or agree to three digits and to the last decimal.
fn alike(written: Option<f64>, read: Option<f64>, half_digit: f64) -> bool {
    match (written, read) {
        (Some(a), Some(b)) => (a - b).abs() <= (0.005_1 * a).max(half_digit * 1.001),
        (None, None) => true,
        _ => false,
    }
}

fn all_alike(written: &[Option<f64>], read: &[Option<f64>], half_digit: f64) -> bool {
    written.iter().zip(read).all(|(written, read)| alike(*written, *read, half_digit))
}

fn full_status() -> PinsdStatus {
    PinsdStatus {
        time: TIME,
        mode: PinsdMode::DeadReckoning,
        seconds_in_mode: Some(999_999_999),
        heading: HeadingMode::Estimated,
        position: FixQuality::Estimated,
        heave: Some(HeaveQuality::Settled),
        time_source: PinsdTime::Messages,
        simulated: false,
        alerts: Some(999),
        integrity: Some(PinsdIntegrity::Agreed),
        excluded: Some(Party::ALL.into_iter().collect()),
        source: Some(PinsdSource::Carrier),
        seconds_of_source: Some(999_999_999),
    }
}

#[test]
fn each_of_our_sentences_is_written_as_its_page_says() {
    let excluded: Parties = [Party::Heading, Party::Gnss].into_iter().collect();
    let status = PinsdStatus {
        seconds_in_mode: Some(4210),
        alerts: Some(2),
        excluded: Some(excluded),
        source: Some(PinsdSource::DeadReckoning),
        seconds_of_source: Some(4212),
        ..full_status()
    };
    let sigma = SolutionSigma {
        position: Ned::new(0.42, 0.38, 1.17),
        velocity: Ned::new(0.012, 0.011, 0.02),
        roll: 0.011 * DEG,
        pitch: 0.011 * DEG,
        heading: 0.043 * DEG,
    };
    let protection = PinsdProtection {
        time: TIME,
        radius_95: Some(0.98),
        horizontal: Some(2.02),
        vertical: Some(5.17),
        exponent: Some(5),
        alert_limit: Some(10.0),
        state: ProtectionState::of(Some(2.02), Some(10.0)),
    };
    let alignment = PinsdAlignment {
        time: TIME,
        phase: PinsdPhase::Fine,
        moored: true,
        sigma: Some(0.5 * DEG),
        target: Some(0.1 * DEG),
        seconds_left: Some(160),
        gyrocompass: Some(12.5 * DEG),
    };
    for (pinsd, text) in [
        (Pinsd::Status(status), "STA,235959.99,D,4210,E,6,2,M,0,2,A,GH,N,4212"),
        (
            Pinsd::Sigma(PinsdSigma::of(TIME, &sigma, Some(0.05))),
            "SIG,235959.99,0.42,0.38,1.17,0.012,0.011,0.020,0.011,0.011,0.043,0.05",
        ),
        (Pinsd::Alignment(alignment), "ALI,235959.99,F,1,0.500,0.100,160,12.5"),
        (Pinsd::Protection(protection), "PRO,235959.99,0.98,2.02,5.17,5,10.00,A"),
    ] {
        let line = pinsd.write();
        assert_eq!(line.as_str().split('*').next(), Some(format!("$PINSD,{text}").as_str()));
        back(pinsd);
    }
}

#[test]
fn the_examples_of_the_page_are_read_and_written_byte_for_byte() {
    let page = include_str!("../../../docs/pinsd.md");
    let examples: Vec<&str> = page
        .lines()
        .map(str::trim)
        .filter(|line| line.starts_with("$PINSD,") && !line.ends_with("*hh"))
        .collect();
    assert_eq!(examples.len(), 6);
    for line in examples {
        let (_, sentence) = Sentence::read(line.as_bytes()).unwrap();
        assert_eq!(sentence.write(Talker::IN).as_str(), line);
    }
}

#[test]
fn what_is_unknown_is_empty() {
    let status = PinsdStatus {
        time: None,
        mode: PinsdMode::from(Mode::Fault),
        seconds_in_mode: None,
        heading: HeadingMode::NotValid,
        position: FixQuality::Invalid,
        heave: None,
        time_source: PinsdTime::Unknown,
        simulated: true,
        alerts: None,
        integrity: None,
        excluded: None,
        source: None,
        seconds_of_source: None,
    };
    let alignment = PinsdAlignment {
        time: None,
        phase: PinsdPhase::Levelling,
        moored: false,
        sigma: None,
        target: None,
        seconds_left: None,
        gyrocompass: None,
    };
    for (pinsd, text) in [
        (Pinsd::Status(status), "STA,,X,,V,0,,U,1,,,,,"),
        (Pinsd::Sigma(PinsdSigma::default()), "SIG,,,,,,,,,,,"),
        (Pinsd::Alignment(alignment), "ALI,,L,0,,,,"),
        (Pinsd::Protection(PinsdProtection::default()), "PRO,,,,,,,N"),
    ] {
        let line = pinsd.write();
        assert_eq!(line.as_str().split('*').next(), Some(format!("$PINSD,{text}").as_str()));
        assert_eq!(back(pinsd), pinsd);
    }
}

#[test]
fn the_greatest_lengths_are_those_that_are_stated_and_within_the_standard() {
    let degrees = Some(0.123 * DEG);
    let sigma = PinsdSigma {
        time: TIME,
        position: [Some(9999.0); 3],
        velocity: [Some(0.123); 3],
        attitude: [degrees; 3],
        heave: Some(0.12),
    };
    let alignment = PinsdAlignment {
        time: TIME,
        phase: PinsdPhase::Searching,
        moored: true,
        sigma: degrees,
        target: degrees,
        seconds_left: Some(999_999),
        gyrocompass: degrees,
    };
    let metres = Some(99_999.99);
    let protection = PinsdProtection {
        time: TIME,
        radius_95: metres,
        horizontal: metres,
        vertical: metres,
        exponent: Some(9),
        alert_limit: metres,
        state: ProtectionState::Above,
    };
    const { assert!(Pinsd::LONGEST <= MAX_LEN) };
    let lengths = [
        (Pinsd::Status(full_status()), PinsdStatus::LONGEST),
        (Pinsd::Sigma(sigma), PinsdSigma::LONGEST),
        (Pinsd::Alignment(alignment), PinsdAlignment::LONGEST),
        (Pinsd::Protection(protection), PinsdProtection::LONGEST),
    ];
    for (pinsd, longest) in lengths {
        let line = pinsd.write();
        assert_eq!(line.as_bytes().len(), longest, "{line:?}");
        assert!(longest <= Pinsd::LONGEST);
    }
}

#[test]
fn every_letter_comes_back() {
    for letter in b"SCFMADIX" {
        let mode = PinsdMode::from_letter(*letter).unwrap();
        let status = PinsdStatus { mode, ..full_status() };
        assert_eq!(back(Pinsd::Status(status)), Pinsd::Status(status));
    }
    for letter in b"PMU" {
        let time_source = PinsdTime::from_letter(*letter).unwrap();
        let status = PinsdStatus { time_source, simulated: true, ..full_status() };
        assert_eq!(back(Pinsd::Status(status)), Pinsd::Status(status));
    }
    for digit in 0..=8 {
        let position = FixQuality::from_gga(digit).unwrap();
        let status = PinsdStatus { position, ..full_status() };
        assert_eq!(back(Pinsd::Status(status)), Pinsd::Status(status));
    }
    for letter in b"AUVN" {
        let integrity = PinsdIntegrity::from_letter(*letter);
        let status = PinsdStatus { integrity, ..full_status() };
        assert!(integrity.is_some());
        assert_eq!(back(Pinsd::Status(status)), Pinsd::Status(status));
    }
    let each = Party::ALL.map(|party| Parties::default().with(party));
    for excluded in each.into_iter().chain([Parties::default()]) {
        let status = PinsdStatus { excluded: Some(excluded), ..full_status() };
        assert_eq!(back(Pinsd::Status(status)), Pinsd::Status(status));
    }
    for heave in [HeaveQuality::Unsettled, HeaveQuality::Reduced, HeaveQuality::Settled] {
        let status = PinsdStatus { heave: Some(heave), ..full_status() };
        assert_eq!(back(Pinsd::Status(status)), Pinsd::Status(status));
    }
}

fn status_of(fields: &str) -> Result<PinsdStatus, NmeaFault> {
    let body = format!("PINSD,STA,235959.99,D,4210,E,6,2,M,0,2{fields}");
    let line = format!("${body}*{:02X}", checksum(body.as_bytes()));
    match Sentence::read(line.as_bytes())? {
        (_, Sentence::Pinsd(Pinsd::Status(status))) => Ok(status),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_status_of_a_version_that_did_not_tell_integrity_or_source_is_read() {
    let old = status_of("").unwrap();
    assert_eq!((old.alerts, old.integrity, old.excluded), (Some(2), None, None));
    let nobody = status_of(",A,N").unwrap();
    assert_eq!(nobody.excluded, Some(Parties::default()));
    assert_eq!((nobody.source, nobody.seconds_of_source), (None, None));
    let newer = status_of(",V,IG,R,9,whatever,2").unwrap();
    assert_eq!((newer.source, newer.seconds_of_source), (Some(PinsdSource::Rtk), Some(9)));
    assert_eq!(newer.integrity, Some(PinsdIntegrity::Contradicted));
    assert_eq!(newer.excluded, Some([Party::Gnss, Party::Imu].into_iter().collect()));
    for bad in [",X,N", ",AA,N", ",A,GX", ",A,NG", ",A,N,X,1", ",A,N,R,x"] {
        assert!(matches!(status_of(bad), Err(NmeaFault::Malformed { .. })), "{bad}");
    }
}

proptest! {
    #[test]
    fn sigmas_come_back_to_three_digits(
        time in prop::option::of(time_of_day()), position in prop::array::uniform3(perhaps(0.0..9999.0)),
        velocity in prop::array::uniform3(perhaps(0.0..999.0)),
        attitude in prop::array::uniform3(perhaps(0.0..PI)), heave in perhaps(0.0..99.9),
    ) {
        let sigma = PinsdSigma { time, position, velocity, attitude, heave };
        let Pinsd::Sigma(read) = back(Pinsd::Sigma(sigma)) else { panic!() };
        prop_assert_eq!(read.time, time);
        prop_assert!(all_alike(&position, &read.position, 0.005));
        prop_assert!(all_alike(&velocity, &read.velocity, 0.000_5));
        prop_assert!(all_alike(&attitude, &read.attitude, 0.000_5 * DEG));
        prop_assert!(alike(heave, read.heave, 0.005));
    }

    #[test]
    fn alignment_and_protection_come_back(
        time in prop::option::of(time_of_day()), moored: bool,
        letter in prop::sample::select(b"LSFMA".to_vec()),
        angles in prop::array::uniform3(perhaps(0.0..PI)),
        seconds_left in prop::option::of(0..=999_999_u32),
        metres in prop::array::uniform4(perhaps(0.0..99_999.99)),
        exponent in prop::option::of(1..=9_u8),
    ) {
        let [sigma, target, gyrocompass] = angles;
        let phase = PinsdPhase::from_letter(letter).unwrap();
        let alignment =
            PinsdAlignment { time, phase, moored, sigma, target, seconds_left, gyrocompass };
        let Pinsd::Alignment(read) = back(Pinsd::Alignment(alignment)) else { panic!() };
        prop_assert_eq!((read.time, read.phase, read.moored), (time, phase, moored));
        prop_assert_eq!(read.seconds_left, seconds_left);
        let read = [read.sigma, read.target, read.gyrocompass];
        prop_assert!(all_alike(&angles, &read, 0.000_5 * DEG));
        let [radius_95, horizontal, vertical, alert_limit] = metres;
        let state = ProtectionState::of(horizontal, alert_limit);
        let protection = PinsdProtection {
            time, radius_95, horizontal, vertical, exponent, alert_limit, state,
        };
        let Pinsd::Protection(read) = back(Pinsd::Protection(protection)) else { panic!() };
        prop_assert_eq!((read.time, read.exponent, read.state), (time, exponent, state));
        let read = [read.radius_95, read.horizontal, read.vertical, read.alert_limit];
        prop_assert!(all_alike(&metres, &read, 0.005));
    }

    #[test]
    fn no_value_whatever_makes_a_line_too_long_or_unreadable(
        a: f64, b: f64, c: f64, small: u8, wide: u32,
    ) {
        let (x, y, z) = (Some(a), Some(b), Some(c));
        let time = Some(TimeOfDay { hour: small, minute: small, second: small, nanosecond: wide });
        let status = PinsdStatus {
            time, seconds_in_mode: Some(wide), alerts: Some(wide), seconds_of_source: Some(wide),
            ..full_status()
        };
        back(Pinsd::Status(status));
        let (position, velocity, attitude) = ([x, y, z], [y, z, x], [z, x, y]);
        back(Pinsd::Sigma(PinsdSigma { time, position, velocity, attitude, heave: x }));
        let alignment = PinsdAlignment {
            time, phase: PinsdPhase::Aligned, moored: true, sigma: x, target: y,
            seconds_left: Some(wide), gyrocompass: z,
        };
        back(Pinsd::Alignment(alignment));
        let protection = PinsdProtection {
            time, radius_95: x, horizontal: y, vertical: z, exponent: Some(small), alert_limit: x,
            state: ProtectionState::of(y, x),
        };
        back(Pinsd::Protection(protection));
    }
}
