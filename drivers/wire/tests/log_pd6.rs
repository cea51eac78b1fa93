//! PD6: lines of instruments, round trips, and any bytes.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod frames;

use std::f64::consts::TAU;

use frames::{cut_all, is_robust, is_split_anyhow};
use insd_base::units::DEG;
use insd_base::{LogReference, UtcTime};
use insd_wire::log::LogFrame;
use insd_wire::log::pd6::{Pd6, look};
use insd_wire::stream::{Look, Protocol};
use proptest::prelude::*;

/// Lines of two instruments that imitate PD6: one that pads with blanks, one that pads with zeros and
/// has I for bad velocities. The first three are of the one, the others of the other.
const LINES: &str = ":SA, -1.76, 0.07, 322.57\r\n\
                     :BE, -1532, 1945, -42, A\r\n\
                     :BD, 0.00, 0.00, 0.00, 39.08, 0.00\r\n\
                     :TS,00000000000000,35.0,+15.0,0000.0,1500.0,000\r\n\
                     :WI,+00000,+00000,+00000,+00000,I\r\n\
                     :BI,+00000,-02345,-00439,+00000,A\r\n\
                     :BD,+00000000.00,+00000000.00,+00000000.00,0000.40,000.00\r\n";

fn line(text: &str) -> Pd6 {
    Pd6::read(format!("{text}\r\n").as_bytes()).unwrap()
}

#[test]
fn lines_of_instruments_are_read() {
    let lines: Vec<Pd6> = cut_all(Protocol::Pd6, LINES.as_bytes())
        .iter()
        .map(|frame| Pd6::read(frame).unwrap())
        .collect();
    assert_eq!(lines.len(), 7);
    let Pd6::Attitude { pitch, roll, heading } = lines[0] else { unreachable!() };
    let degrees = [pitch, roll, heading].map(|angle| (angle / DEG * 100.0).round() / 100.0);
    assert_eq!(degrees, [-1.76, 0.07, 322.57]);
    let earth = lines[1].reading().unwrap();
    assert_eq!((earth.frame, earth.reference), (LogFrame::Earth, LogReference::Bottom));
    assert_eq!(earth.velocity, [Some(-1.532), Some(1.945), Some(-0.042), None]);
    assert!(matches!(lines[2], Pd6::Distance { range, .. } if range == 39.08));
    assert!(matches!(lines[3], Pd6::Scaling { clock: None, sound, .. } if sound == 1500.0));
    assert_eq!(lines[4].reading(), None);
    let instrument = lines[5].reading().unwrap();
    assert_eq!(instrument.velocity, [Some(0.0), Some(-2.345), Some(-0.439), None]);
}

#[test]
fn the_ship_is_told_forward_starboard_down() {
    let reading = line(":BS,+00123,+05000,-00010,A").reading().unwrap();
    assert_eq!(reading.frame, LogFrame::Ship);
    assert_eq!(reading.velocity, [Some(5.0), Some(0.123), Some(0.01), None]);
    let water = line(":WS,+00000,-00500,+00000,A").reading().unwrap();
    assert_eq!(water.reference, LogReference::Water);
    assert_eq!(water.velocity[0], Some(-0.5));
}

#[test]
fn what_is_marked_bad_is_none_whatever_the_numbers() {
    assert_eq!(line(":BS,+00123,+05000,-00010,V").reading(), None);
    assert_eq!(line(":BI,-32768,-32768,-32768,-32768,V").reading(), None);
    assert_eq!(line(":BE,-32768,-32768,-32768,A").reading(), None);
}

#[test]
fn a_line_of_the_wrong_shape_is_damage() {
    let wrong = [
        ":BS,+00123,+05000,A",
        ":BS,+00123,+05000,-00010,+00000,A",
        ":BI,+00123,+05000,-00010,A",
        ":BS,+00123,+05000,-00010,X",
        ":BS,+00123,+05000,-00010",
        ":BS,+00123,+05x00,-00010,A",
        ":BS,+00123,+99999,-00010,A",
        ":BS,,+05000,-00010,A",
        ":BS,+00123,inf,-00010,A",
        ":SA,+91.00,+00.00,000.00",
        ":TS,0000000000000,35.0,+15.0,0000.0,1500.0,000",
        ":BD,+0.00,+0.00,+0.00,0000.40",
    ];
    for text in wrong {
        let bytes = format!("{text}\r\n").into_bytes();
        assert_eq!(look(&bytes), Look::Damaged, "{text}");
        assert!(Pd6::read(&bytes).is_err(), "{text}");
    }
    for text in ["BS,", ":bs,1\r\n", ":BS1", ":BS,\x01", ":BS,:BS", ":BS,$", ":BS,1\rx"] {
        assert_eq!(look(text.as_bytes()), Look::Nothing, "{text}");
    }
    assert_eq!(look(format!(":BS,{}", "1".repeat(200)).as_bytes()), Look::Nothing);
}

#[test]
fn lines_of_other_kinds_are_taken_as_they_are() {
    let text = ":RA,0123.45,0040.10,0040.20,0040.30,0040.40";
    assert_eq!(line(text), Pd6::Other(text[1..].to_owned()));
    assert_eq!(line(text).write(), format!("{text}\r\n").into_bytes());
    assert_eq!(line(text).reading(), None);
}

#[test]
fn lines_have_the_widths_of_the_manual() {
    let clock = UtcTime::from_civil((2004, 8, 11), (11, 56, 36), 440_000_000);
    let scaling = Pd6::Scaling {
        clock,
        salinity: 35.0,
        temperature: 21.0,
        depth: 0.0,
        sound: 1524.0,
        self_test: 0,
    };
    assert_eq!(scaling.write(), b":TS,04081111563644,35.0,+21.0,0000.0,1524.0,000\r\n");
    let velocity = [Some(-0.017), Some(0.018), Some(0.001), Some(0.001)];
    let (reference, frame) = (LogReference::Bottom, LogFrame::Instrument);
    let instrument = Pd6::Velocity { reference, frame, velocity };
    assert_eq!(instrument.write(), b":BI,-00017,+00018,+00001,+00001,A\r\n");
    let made_good = [-1.25, 2.5, 1e6];
    let distance = Pd6::Distance { reference, made_good, range: 40.1, age: 0.25 };
    let expected = b":BD,-00000001.25,+00000002.50,+01000000.00,0040.10,000.25\r\n";
    assert_eq!(distance.write(), expected);
    let attitude = Pd6::Attitude { pitch: 1.5 * DEG, roll: -2.25 * DEG, heading: 359.999 * DEG };
    assert_eq!(attitude.write(), b":SA,+01.50,-02.25,000.00\r\n");
}

fn near(a: f64, b: f64, half: f64) -> bool {
    (a - b).abs() <= half * (1.0 + 1e-6) + 1e-9
}

fn velocity_lines() -> impl Strategy<Value = (LogReference, LogFrame, [Option<f64>; 4])> {
    let references = prop_oneof![Just(LogReference::Bottom), Just(LogReference::Water)];
    let frames =
        prop_oneof![Just(LogFrame::Instrument), Just(LogFrame::Ship), Just(LogFrame::Earth)];
    (references, frames, prop::array::uniform4(-32.76..32.76), any::<bool>()).prop_map(
        |(reference, frame, values, good)| {
            let mut velocity = values.map(|value| good.then_some(value));
            if frame != LogFrame::Instrument {
                velocity[3] = None;
            }
            (reference, frame, velocity)
        },
    )
}

proptest! {
    #[test]
    fn a_velocity_is_read_within_half_a_millimetre_per_second(
        (reference, frame, velocity) in velocity_lines(),
    ) {
        let bytes = Pd6::Velocity { reference, frame, velocity }.write();
        prop_assert_eq!(look(&bytes), Look::Frame(bytes.len()));
        let Pd6::Velocity { reference: r, frame: f, velocity: v } = Pd6::read(&bytes).unwrap() else {
            unreachable!()
        };
        prop_assert_eq!((r, f), (reference, frame));
        for (written, read) in velocity.iter().zip(v) {
            prop_assert_eq!(written.is_some(), read.is_some());
            prop_assert!(near(written.unwrap_or(0.0), read.unwrap_or(0.0), 0.0005));
        }
    }

    #[test]
    fn other_lines_are_read_within_half_a_digit(
        pitch in -90.0 * DEG..90.0 * DEG, roll in -99.0 * DEG..99.0 * DEG, heading in 0.0..TAU,
        centiseconds in 31_553_280_000_i64..347_129_280_000,
        made_good in prop::array::uniform3(-9e6..9e6), range in 0.0..9999.0, age in 0.0..999.0,
        temperature in -5.0..45.0, depth in 0.0..6000.0, sound in 1400.0..1600.0, self_test in 0_u16..0x1000,
    ) {
        let read = |line: &Pd6| Pd6::read(&line.write()).unwrap();
        let Pd6::Attitude { pitch: p, roll: r, heading: h } =
            read(&Pd6::Attitude { pitch, roll, heading }) else { unreachable!() };
        prop_assert!(near(pitch, p, 0.005 * DEG) && near(roll, r, 0.005 * DEG));
        prop_assert!(near(heading, h, 0.005 * DEG) || heading - h > 6.0);
        let reference = LogReference::Water;
        let Pd6::Distance { made_good: m, range: g, age: a, .. } =
            read(&Pd6::Distance { reference, made_good, range, age }) else { unreachable!() };
        prop_assert!(made_good.iter().zip(m).all(|(a, b)| near(*a, b, 0.005)));
        prop_assert!(near(range, g, 0.005) && near(age, a, 0.005));
        let clock = Some(UtcTime::from_nanos(centiseconds * 10_000_000));
        let scaling = Pd6::Scaling { clock, salinity: 35.0, temperature, depth, sound, self_test };
        let Pd6::Scaling { clock: c, temperature: t, depth: d, sound: s, self_test: b, .. } =
            read(&scaling) else { unreachable!() };
        prop_assert_eq!((clock, self_test), (c, b));
        prop_assert!(near(temperature, t, 0.05) && near(depth, d, 0.05) && near(sound, s, 0.05));
    }

    #[test]
    fn frames_are_the_same_in_any_splitting(sizes in frames::sizes()) {
        let bytes = [b"x:B:BS,\r\r\n", LINES.as_bytes(), b"[BREAK]\r\n:BS,1\r\n", LINES.as_bytes()];
        is_split_anyhow(Protocol::Pd6, &bytes.concat(), &sizes);
    }

    #[test]
    fn no_bytes_make_it_panic(
        start in 0_usize..LINES.len(), flips in frames::flips(), noise in frames::noise(),
    ) {
        is_robust(Protocol::Pd6, &LINES.as_bytes()[start..], &flips, &noise, |bytes| {
            if let Ok(line) = Pd6::read(bytes) {
                let _ = (line.reading(), line.write());
            }
        });
    }
}
