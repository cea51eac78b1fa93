//! Measurements, corrected headings and integrity: what is written is read back; every approved
//! sentence keeps its 82 bytes, whatever the values.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::{angle, close, perhaps, read, same_angle, time_of_day};
use insd_base::FixQuality;
use insd_wire::nmea::{
    Date, Dtm, FixDimension, Gbs, Gga, Gll, Gns, Gsa, Gst, Gsv, Hcr, HeadingCorrections,
    HeadingMode, MAX_LEN, MAX_MEASUREMENTS, MAX_USED, NmeaFault, Position, PositionMode, Rmc,
    SatelliteInView, Sentence, Talker, Text, TimeOfDay, Xdr, XdrMeasurement, checksum,
};
use proptest::prelude::*;

fn framed(text: &str) -> Result<Sentence, NmeaFault> {
    let line = format!("${text}*{:02X}", checksum(text.as_bytes()));
    Sentence::read(line.as_bytes()).map(|(_, sentence)| sentence)
}

fn measurement() -> impl Strategy<Value = XdrMeasurement> {
    let letter = || prop::option::of(b'A'..=b'Z');
    (letter(), perhaps(-9999.0..9999.0), 0..=3_u8, letter(), "[ -~]{0,4}").prop_map(
        |(kind, value, decimals, unit, name)| XdrMeasurement {
            kind,
            value,
            decimals,
            unit,
            name: Text::new(&name).unwrap(),
        },
    )
}

#[test]
fn published_forms_of_gbs_are_read() {
    // Trimble, u-blox and NavCom
    let Ok(Sentence::Gbs(trimble)) =
        framed("GPGBS,015509.00,-0.031,-0.186,0.219,19,0.000,-0.354,6.972")
    else {
        panic!()
    };
    assert_eq!((trimble.longitude_error, trimble.bias), (Some(-0.186), Some(-0.354)));
    assert_eq!((trimble.satellite, trimble.system, trimble.signal), (Some(19), None, None));
    let Ok(Sentence::Gbs(ublox)) = framed("GPGBS,235458.00,1.4,1.3,3.1,03,,-21.4,3.8,1,0") else {
        panic!()
    };
    assert_eq!((ublox.missed_detection, ublox.system, ublox.signal), (None, Some(1), Some(0)));
    let Ok(Sentence::Gbs(none)) = framed("GPGBS,235503.00,1.6,1.4,3.2,,,,,,") else { panic!() };
    assert_eq!((none.satellite, none.bias_std, none.signal), (None, None, None));
    assert!(framed("GPGBS,161816.00,0.0,-0.0,-.0,13,0.8,0.0,0.0").is_ok());
}

#[test]
fn the_published_heading_with_its_corrections_is_read() {
    let Ok((_, Sentence::Hcr(hcr))) = Sentence::read(b"$MGHCR,348.7,A,A,-0.0*76") else { panic!() };
    assert_eq!((hcr.mode, hcr.corrections), (HeadingMode::Autonomous, HeadingCorrections::Both));
    assert_eq!((hcr.heading, hcr.correction), (Some(348.7_f64.to_radians()), Some(0.0)));
    assert!(hcr.write(Talker::HE).as_str().starts_with("$HEHCR,348.7,A,A,0.0*"));
}

#[test]
fn attitude_and_heave_are_written_in_degrees_and_metres() {
    let name = |text| Text::new(text).unwrap();
    let mut xdr = Xdr::default();
    xdr.measurements[..3].copy_from_slice(&[
        Some(XdrMeasurement::of_angle(name("PITCH"), Some(-1.2_f64.to_radians()), 1)),
        Some(XdrMeasurement::of_angle(name("ROLL"), None, 1)),
        Some(XdrMeasurement::of_displacement(name("HEAVE"), Some(0.25), 2)),
    ]);
    let line = xdr.write(Talker::IN);
    let text = "$INXDR,A,-1.2,D,PITCH,A,,D,ROLL,D,0.25,M,HEAVE*";
    assert!(line.as_str().starts_with(text), "{line:?}");
    let Sentence::Xdr(back) = read(&line) else { panic!() };
    let [Some(pitch), Some(roll), Some(heave), None, ..] = back.measurements else { panic!() };
    assert!(close(pitch.angle(), Some(-1.2_f64.to_radians()), 1e-12));
    assert_eq!((roll.angle(), pitch.displacement()), (None, None));
    assert_eq!((heave.displacement(), heave.angle()), (Some(0.25), None));
}

#[test]
fn five_measurements_of_a_real_ship_are_read_and_written_so_again() {
    let line = "$IIXDR,C,,C,AIRTEMP,A,-1.0,D,HEEL,A,2.9,D,TRIM,P,,B,BARO,A,-3.9,D,RUDDER*29";
    let (talker, sentence) = Sentence::read(line.as_bytes()).unwrap();
    assert_eq!(sentence.write(talker.unwrap()).as_str(), line);
    assert_eq!(framed("IIXDR,A,1.0,D"), Err(NmeaFault::Missing { field: 4 }));
    assert_eq!(framed("IIXDR,A,1.0,D,X,"), Err(NmeaFault::Missing { field: 6 }));
    assert!(framed(&format!("IIXDR{}", ",A,1,D,X".repeat(MAX_MEASUREMENTS))).is_ok());
    assert!(framed(&format!("IIXDR{}", ",A,1,D,X".repeat(MAX_MEASUREMENTS + 1))).is_err());
}

#[test]
fn measurements_that_do_not_fit_lose_decimals_first_and_whole_measurements_next() {
    let name = Text::new("A long name here").unwrap();
    let one = XdrMeasurement::of_displacement(name, Some(1.234_567), 6);
    let with = |count: usize| {
        let mut xdr = Xdr::default();
        xdr.measurements.iter_mut().take(count).for_each(|place| *place = Some(one));
        let Sentence::Xdr(back) = read(&xdr.write(Talker::IN)) else { panic!() };
        let back: Vec<_> = back.measurements.iter().flatten().map(|one| one.decimals).collect();
        back
    };
    assert_eq!(with(2), [6; 2]);
    assert_eq!(with(3), [0; 3]);
    assert_eq!(with(4), [0; 3]);
}

#[test]
fn a_gga_of_82_bytes_keeps_its_station_and_a_longer_one_its_minutes() {
    let gga = Gga {
        time: Some(TimeOfDay { hour: 1, minute: 2, second: 3, nanosecond: 0 }),
        position: Some(Position { latitude: 0.5, longitude: -1.5 }),
        quality: FixQuality::RtkFixed,
        satellites: Some(12),
        altitude: Some(-999.99),
        geoid_separation: Some(-99.99),
        age: Some(1.0),
        station: Some(4095),
        ..Gga::default()
    };
    let full = gga.write(Talker::IN);
    assert_eq!(full.as_bytes().len(), MAX_LEN, "{full:?}");
    assert!(full.as_str().contains(",1.0,4095*"), "{full:?}");
    let longer = Gga { hdop: Some(0.9), ..gga }.write(Talker::IN);
    let text = "2838.87339,N,08556.62016,W,4,12,0.9,-999.99,M,-99.99,M,,*";
    assert!(longer.as_str().contains(text), "{longer:?}");
}

proptest! {
    #[test]
    fn measurements_come_back(all in prop::collection::vec(measurement(), 1..=3)) {
        let mut xdr = Xdr::default();
        xdr.measurements.iter_mut().zip(&all).for_each(|(place, one)| *place = Some(*one));
        let Sentence::Xdr(back) = read(&xdr.write(Talker::IN)) else { panic!() };
        prop_assert_eq!(back.measurements.iter().flatten().count(), all.len());
        for (written, back) in all.iter().zip(back.measurements.iter().flatten()) {
            let half_digit = 0.5 / 10_f64.powi(i32::from(back.decimals));
            prop_assert!(back.decimals <= written.decimals);
            prop_assert!(close(written.value, back.value, half_digit));
            prop_assert_eq!((written.kind, written.unit), (back.kind, back.unit));
            prop_assert_eq!(written.name, back.name);
        }
    }

    #[test]
    fn headings_with_their_corrections_come_back(
        heading in angle(), mode in prop::sample::select(b"AEMSV".to_vec()),
        corrections in prop::sample::select(b"ADSNV".to_vec()), correction in perhaps(-3.1..3.1),
    ) {
        let mode = HeadingMode::from_letter(mode).unwrap();
        let corrections = HeadingCorrections::from_letter(corrections).unwrap();
        let hcr = Hcr { heading, mode, corrections, correction };
        let Sentence::Hcr(back) = read(&hcr.write(Talker::HE)) else { panic!() };
        let half_digit = 0.05_f64.to_radians();
        prop_assert!(same_angle(heading, back.heading, half_digit));
        prop_assert!(close(correction, back.correction, half_digit));
        prop_assert_eq!((mode, corrections), (back.mode, back.corrections));
    }

    #[test]
    fn expected_errors_come_back(
        time in prop::option::of(time_of_day()),
        errors in prop::array::uniform4(perhaps(-9999.0..9999.0)), bias_std in perhaps(0.0..999.0),
        satellite in prop::option::of(1..=999_u16), missed_detection in perhaps(0.0..1.0),
        system in prop::option::of(0..16_u8), signal in prop::option::of(0..16_u8),
    ) {
        let [latitude_error, longitude_error, altitude_error, bias] = errors;
        let gbs = Gbs {
            time, latitude_error, longitude_error, altitude_error, satellite, missed_detection, bias,
            bias_std, system, signal,
        };
        let Sentence::Gbs(back) = read(&gbs.write(Talker::GP)) else { panic!() };
        let errors_back =
            [back.latitude_error, back.longitude_error, back.altitude_error, back.bias];
        for (written, back) in errors.into_iter().zip(errors_back) {
            prop_assert!(close(written, back, 0.005));
        }
        prop_assert!(close(bias_std, back.bias_std, 0.005));
        prop_assert!(close(missed_detection, back.missed_detection, 0.005));
        prop_assert_eq!((back.time, back.satellite), (time, satellite));
        prop_assert_eq!((back.system, back.signal), (system, signal));
    }

    #[test]
    fn no_value_whatever_makes_a_line_too_long_or_unreadable(
        a: f64, b: f64, c: f64, d: f64, small: u8, wide: u16, text in "[ -~é]{16}",
    ) {
        let (w, x, y, z) = (Some(a), Some(b), Some(c), Some(d));
        let time = Some(TimeOfDay {
            hour: small, minute: small, second: small, nanosecond: u32::from(wide) << 16,
        });
        let position = Some(Position { latitude: a, longitude: b });
        let (small, wide) = (Some(small), Some(wide));
        let mode = Some(PositionMode::Precise);
        let gns = Gns {
            time, position, modes: [mode; 8], satellites: small, hdop: w, altitude: x,
            geoid_separation: y, age: z, station: wide, nav_status: None,
        };
        let satellite = SatelliteInView { id: wide, elevation: w, azimuth: x, noise_density: y };
        let one = XdrMeasurement {
            kind: small, value: w, decimals: small.unwrap(), unit: small,
            name: Text::new(&text).unwrap(),
        };
        for line in [
            gns.write(Talker::IN),
            Gll { position, time, valid: true, mode }.write(Talker::IN),
            Rmc {
                time, valid: true, position, speed: w, course: x, variation: y,
                date: Some(Date { year: wide.unwrap(), month: 1, day: 1 }), mode, nav_status: None,
            }.write(Talker::IN),
            Gst {
                time, range_rms: w, major_std: x, minor_std: y, orientation: z, latitude_std: w,
                longitude_std: x, altitude_std: y,
            }.write(Talker::IN),
            Gbs {
                time, latitude_error: w, longitude_error: x, altitude_error: y, satellite: wide,
                missed_detection: z, bias: w, bias_std: x, system: small, signal: small,
            }.write(Talker::IN),
            Gsa {
                automatic: None, dimension: FixDimension::None, satellites: [wide; MAX_USED], pdop: w,
                hdop: x, vdop: y, system: small,
            }.write(Talker::IN),
            Gsv {
                sentences: 1, number: 1, in_view: wide, satellites: [Some(satellite); 4],
                signal: small,
            }.write(Talker::IN),
            Dtm {
                datum: None, subdivision: small, latitude_offset: w, longitude_offset: x,
                altitude_offset: y, reference: None,
            }.write(Talker::IN),
            Hcr {
                heading: w, mode: HeadingMode::Simulator, corrections: HeadingCorrections::Unknown,
                correction: x,
            }.write(Talker::IN),
            Xdr { measurements: [Some(one); MAX_MEASUREMENTS] }.write(Talker::IN),
        ] {
            read(&line);
        }
    }
}
