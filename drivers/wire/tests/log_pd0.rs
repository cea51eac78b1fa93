//! PD0: an ensemble of a real instrument, round trips, and any bytes.
//!
//! The ensemble is that of a 600 kHz Explorer on a glider that dives westward, from the tests of the
//! Ocean Observatories Initiative (`ooici/marine-integrations`, copyright 2009-2014 The Regents of the
//! University of California, BSD 2-clause).

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod frames;

use std::f64::consts::TAU;

use frames::{bytes_of_hex, cut_all, is_robust, is_split_anyhow};
use insd_base::units::DEG;
use insd_base::{LogReference, UtcTime};
use insd_wire::binary::BinaryFault;
use insd_wire::log::LogFrame;
use insd_wire::log::pd0::{
    BottomTrack, Coordinates, Ensemble, FixedLeader, Geometry, Transformation, VariableLeader,
    WaterLayer, look,
};
use insd_wire::stream::{Look, Protocol};
use proptest::prelude::*;

const EXPLORER: &str = include_str!("data/pd0_explorer.hex");

const GEOMETRY: Geometry = Geometry { angle: 30.0 * DEG, convex: true, up: false };

fn ensemble(coordinates: Coordinates, velocity: [Option<f64>; 4]) -> Ensemble {
    let bottom = BottomTrack { velocity, range: [Some(700.0); 4], ..BottomTrack::default() };
    Ensemble {
        fixed: FixedLeader {
            firmware: [50, 40],
            frequency: Some(600e3),
            geometry: Some(GEOMETRY),
            beams: 4,
            cells: 0,
            transformation: Transformation {
                coordinates,
                tilts: true,
                three_beams: true,
                mapped: false,
            },
            heading_alignment: 45.0 * DEG,
            heading_bias: 0.0,
        },
        variable: VariableLeader {
            number: 70_000,
            clock: UtcTime::from_civil((2026, 3, 1), (23, 59, 59), 990_000_000),
            self_test: 0,
            sound: 1485.0,
            depth: 4.2,
            heading: 270.0 * DEG,
            pitch: 1.0 * DEG,
            roll: -2.0 * DEG,
            salinity: 35.0,
            temperature: 8.25,
        },
        bottom: Some(bottom),
    }
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * (1.0 + 1e-9) + 1e-12
}

#[test]
fn the_ensemble_of_an_explorer_is_read() {
    let bytes = bytes_of_hex(EXPLORER);
    assert_eq!(look(&bytes), Look::Frame(529));
    let Ensemble { fixed, variable, bottom } = Ensemble::read(&bytes).unwrap();
    assert_eq!((fixed.firmware, fixed.frequency), ([34, 11], Some(600e3)));
    let geometry = fixed.geometry.unwrap();
    assert!(near(geometry.angle, 30.0 * DEG, 0.0) && geometry.convex && !geometry.up);
    assert_eq!((fixed.beams, fixed.cells), (4, 15));
    let earth = Coordinates::Earth;
    let all = Transformation { coordinates: earth, tilts: true, three_beams: true, mapped: true };
    assert_eq!(fixed.transformation, all);
    assert_eq!((variable.number, variable.sound), (107, 1486.0));
    let clock = UtcTime::from_civil((2012, 1, 10), (2, 8, 46), 630_000_000);
    assert_eq!(variable.clock, clock);
    assert!(near(variable.heading, 269.7 * DEG, 1e-9));
    assert!(near(variable.pitch, -17.09 * DEG, 1e-9));
    assert!(near(variable.roll, -1.3 * DEG, 1e-9));
    assert_eq!((variable.salinity, variable.depth), (32.0, 64.0));
    assert!(near(variable.temperature, 9.69, 0.0));
    let bottom = bottom.unwrap();
    assert!(is_same_set_of([18.7, 19.22, 18.45, 19.26].map(Some), bottom.range, 1e-9));
    assert!(is_same_set_of([0.451, 0.172, 0.159, 0.0].map(Some), bottom.velocity, 1e-9));
    assert_eq!(bottom.correlation, [251, 250, 254, 251]);
    assert_eq!(bottom.percent_good, [0, 0, 0, 100]);
}

#[test]
fn a_glider_that_dives_westward_is_said_to_go_west_and_down() {
    let ensemble = Ensemble::read(&bytes_of_hex(EXPLORER)).unwrap();
    let reading = ensemble.reading(LogReference::Bottom).unwrap();
    assert_eq!(reading.frame, LogFrame::Earth);
    let [Some(east), _, Some(up), None] = reading.velocity else { unreachable!() };
    assert!(near(east, -0.451, 1e-9) && near(up, -0.159, 1e-9));
    assert_eq!(ensemble.reading(LogReference::Water), None, "its water layer was not measured");
}

#[test]
fn the_wire_has_the_bottom_moving_and_a_reading_the_ship() {
    let wire = [Some(-0.25), Some(-5.0), Some(0.125), Some(0.01)];
    let reading = |coordinates| {
        let frame = ensemble(coordinates, wire).write();
        Ensemble::read(&frame).unwrap().reading(LogReference::Bottom).unwrap()
    };
    let ship = reading(Coordinates::Ship);
    assert_eq!(ship.frame, LogFrame::Ship);
    assert_eq!(ship.velocity, [Some(5.0), Some(0.25), Some(0.125), None]);
    let instrument = reading(Coordinates::Instrument);
    assert_eq!(instrument.velocity, [Some(0.25), Some(5.0), Some(-0.125), None]);
    let earth = reading(Coordinates::Earth);
    assert_eq!((earth.frame, earth.velocity), (LogFrame::Earth, instrument.velocity));
    let beam = reading(Coordinates::Beam);
    assert_eq!((beam.frame, beam.velocity), (LogFrame::Beam, wire));
    assert_eq!((beam.reference, beam.utc), (LogReference::Bottom, None));
}

#[test]
fn beams_become_the_velocity_of_the_ship_in_the_axes_of_the_instrument() {
    // going ahead at 2 m/s with beam 3 forward: the bottom comes towards beam 3
    let beams = [Some(0.0), Some(0.0), Some(1.0), Some(-1.0)];
    let frame = ensemble(Coordinates::Beam, beams).write();
    let read = Ensemble::read(&frame).unwrap();
    let beam = read.reading(LogReference::Bottom).unwrap();
    let reading = read.fixed.geometry.unwrap().instrument_reading(&beam).unwrap();
    assert_eq!(reading.frame, LogFrame::Instrument);
    let [Some(x), Some(y), Some(z), None] = reading.velocity else { unreachable!() };
    assert!(near(x, 0.0, 1e-12) && near(y, 2.0, 1e-9) && near(z, 0.0, 1e-12));
    assert_eq!(GEOMETRY.instrument_reading(&reading), None);
}

#[test]
fn bad_velocities_are_none_and_an_ensemble_of_them_gives_no_reading() {
    let all_bad = ensemble(Coordinates::Ship, [None; 4]);
    let frame = all_bad.write();
    let read = Ensemble::read(&frame).unwrap();
    assert_eq!(read.bottom.unwrap().velocity, [None; 4]);
    assert_eq!(read.reading(LogReference::Bottom), None);
    assert_eq!(Ensemble { bottom: None, ..all_bad }.reading(LogReference::Bottom), None);
}

#[test]
fn a_water_layer_without_a_good_ping_gives_no_reading() {
    let velocity = [Some(0.0), Some(-1.0), Some(0.0), Some(0.0)];
    let reading = |percent_good| {
        let water = WaterLayer { velocity, percent_good, ..WaterLayer::default() };
        let bottom = Some(BottomTrack { water, ..BottomTrack::default() });
        let ensemble = Ensemble { bottom, ..ensemble(Coordinates::Ship, [None; 4]) };
        ensemble.reading(LogReference::Water)
    };
    assert_eq!(reading([0; 4]), None);
    assert_eq!(reading([0, 0, 0, 100]).unwrap().velocity[0], Some(1.0));
}

#[test]
fn ranges_of_more_than_655_metres_take_a_third_byte() {
    let frame = ensemble(Coordinates::Ship, [None; 4]).write();
    assert_eq!(Ensemble::read(&frame).unwrap().bottom.unwrap().range, [Some(700.0); 4]);
}

#[test]
fn a_bottom_track_that_ends_before_the_water_layer_is_read() {
    let whole = ensemble(Coordinates::Ship, [Some(1.0); 4]).write();
    let short = &whole[..whole.len() - 2 - 2 - (85 - 44)];
    let mut frame = [short, &[0, 0]].concat();
    let length = frame.len() as u16;
    frame[2..4].copy_from_slice(&length.to_le_bytes());
    let sum = frame.iter().fold(0_u16, |sum, byte| sum.wrapping_add(u16::from(*byte)));
    frame.extend(sum.to_le_bytes());
    let bottom = Ensemble::read(&frame).unwrap().bottom.unwrap();
    assert_eq!(bottom.velocity, [Some(1.0); 4]);
    assert_eq!(bottom.water.velocity, [None; 4]);
}

#[test]
fn what_an_old_leader_does_not_have_is_not_taken_from_the_next_data_type() {
    // leaders of 58 and 57 bytes: what follows must pass neither for an angle nor for a century
    let whole = ensemble(Coordinates::Ship, [Some(1.0); 4]).write();
    let (fixed, variable) = (&whole[12..12 + 58], &whole[12 + 59..12 + 59 + 57]);
    let types = [fixed, variable, &[20, 30, 20, 20, 5, 5, 5, 5, 5, 5, 0, 0]].concat();
    let mut frame = vec![0x7F, 0x7F, 12 + types.len() as u8, 0, 0, 3, 12, 0, 70, 0, 127, 0];
    frame.extend(types);
    let sum = frame.iter().fold(0_u16, |sum, byte| sum.wrapping_add(u16::from(*byte)));
    frame.extend(sum.to_le_bytes());
    let read = Ensemble::read(&frame).unwrap();
    assert!(near(read.fixed.geometry.unwrap().angle, 30.0 * DEG, 0.0));
    assert_eq!(read.variable.clock, ensemble(Coordinates::Ship, [None; 4]).variable.clock);
}

#[test]
fn absurd_headers_are_refused_at_once() {
    assert_eq!(look(b"\x7F\x7E"), Look::Nothing);
    assert_eq!(look(b"\x7F\x7F"), Look::More(6));
    assert_eq!(look(b"\x7F\x7F\xFF\xFF\x00\x03"), Look::Nothing);
    assert_eq!(look(b"\x7F\x7F\x40\x00\x00\x00"), Look::Nothing);
    assert_eq!(look(b"\x7F\x7F\x40\x00\x00\x01\xFF\x00"), Look::Nothing);
    assert_eq!(look(b"\x7F\x7F\x40\x00\x00\x01\x08\x00"), Look::More(66));
    let mut frame = ensemble(Coordinates::Ship, [None; 4]).write();
    frame[30] ^= 4;
    assert_eq!(look(&frame), Look::Damaged);
    assert_eq!(Ensemble::read(&frame), Err(BinaryFault::Frame));
}

fn velocities() -> impl Strategy<Value = [Option<f64>; 4]> {
    prop::array::uniform4(prop::option::of(-32.767..32.767))
}

prop_compose! {
    fn bottoms()(
        pings: u16,
        range in prop::array::uniform4(prop::option::of(0.01..167_772.0)),
        velocity in velocities(), water_velocity in velocities(),
        near_end in 0.0..6553.0, far_end in 0.0..6553.0,
        counts in prop::array::uniform6(any::<[u8; 4]>()),
    ) -> BottomTrack {
        let [correlation, amplitude, percent_good, a, b, c] = counts;
        let water = WaterLayer {
            bounds: [near_end, far_end], velocity: water_velocity, correlation: a, intensity: b,
            percent_good: c,
        };
        BottomTrack { pings, range, velocity, correlation, amplitude, percent_good, water }
    }
}

prop_compose! {
    fn ensembles()(
        bottom in prop::option::of(bottoms()),
        degrees in 5_u8..=45, convex: bool, up: bool, code in 0..6, frame in 0_usize..4,
        flags: [bool; 3], firmware: [u8; 2], cells: u8, number in 0_u32..1 << 24,
        angles in prop::array::uniform4(-327.0 * DEG..327.0 * DEG), heading in 0.0..TAU,
        centiseconds in 31_553_280_000_i64..347_129_280_000,
        rest in (1400_u16..1600, 0.0..6500.0, 0_u16..40, -5.0..45.0, any::<u16>()),
    ) -> Ensemble {
        use Coordinates::{Beam, Earth, Instrument, Ship};
        let [tilts, three_beams, mapped] = flags;
        let (sound, depth, salinity, temperature, self_test) = rest;
        let [heading_alignment, heading_bias, pitch, roll] = angles;
        Ensemble {
            fixed: FixedLeader {
                firmware,
                frequency: Some(75e3 * f64::from(1 << code)),
                geometry: Some(Geometry { angle: f64::from(degrees) * DEG, convex, up }),
                beams: 4,
                cells,
                transformation: Transformation {
                    coordinates: [Beam, Instrument, Ship, Earth][frame], tilts, three_beams, mapped,
                },
                heading_alignment,
                heading_bias,
            },
            variable: VariableLeader {
                number,
                clock: Some(UtcTime::from_nanos(centiseconds * 10_000_000)),
                self_test, sound: sound.into(), depth, heading, pitch, roll,
                salinity: salinity.into(), temperature,
            },
            bottom,
        }
    }
}

fn is_same_set_of(written: [Option<f64>; 4], read: [Option<f64>; 4], half: f64) -> bool {
    written.iter().zip(read).all(|pair| match pair {
        (Some(a), Some(b)) => near(*a, b, half),
        (None, None) => true,
        _ => false,
    })
}

proptest! {
    #[test]
    fn what_is_written_is_read_within_half_a_step(ensemble in ensembles()) {
        let frame = ensemble.write();
        prop_assert_eq!(look(&frame), Look::Frame(frame.len()));
        let read = Ensemble::read(&frame).unwrap();
        let (f, g) = (ensemble.fixed, read.fixed);
        prop_assert!(near(f.heading_alignment, g.heading_alignment, 0.005 * DEG));
        prop_assert!(near(f.heading_bias, g.heading_bias, 0.005 * DEG));
        let (heading_alignment, heading_bias) = (f.heading_alignment, f.heading_bias);
        prop_assert_eq!(f, FixedLeader { heading_alignment, heading_bias, ..g });
        let (v, w) = (ensemble.variable, read.variable);
        prop_assert!(near(v.heading, w.heading, 0.005 * DEG) || v.heading - w.heading > 6.0);
        prop_assert!(near(v.pitch, w.pitch, 0.005 * DEG) && near(v.roll, w.roll, 0.005 * DEG));
        prop_assert!(near(v.depth, w.depth, 0.05) && near(v.temperature, w.temperature, 0.005));
        prop_assert_eq!((v.number, v.clock, v.self_test), (w.number, w.clock, w.self_test));
        prop_assert_eq!((v.sound, v.salinity), (w.sound, w.salinity));
        prop_assert_eq!(ensemble.bottom.is_some(), read.bottom.is_some());
        if let (Some(a), Some(b)) = (ensemble.bottom, read.bottom) {
            prop_assert!(is_same_set_of(a.velocity, b.velocity, 0.0005));
            prop_assert!(is_same_set_of(a.range, b.range, 0.005));
            prop_assert!(is_same_set_of(a.water.velocity, b.water.velocity, 0.0005));
            prop_assert!(near(a.water.bounds[1], b.water.bounds[1], 0.05));
            prop_assert_eq!(a.correlation, b.correlation);
            prop_assert_eq!(a.percent_good, b.percent_good);
            prop_assert_eq!(a.water.intensity, b.water.intensity);
        }
    }

    #[test]
    fn frames_are_the_same_in_any_splitting(ensemble in ensembles(), sizes in frames::sizes()) {
        let frame = ensemble.write();
        let bytes = [&b"\x7F\x7F\x7F"[..], &frame, b"\x7F", &frame].concat();
        is_split_anyhow(Protocol::Pd0, &bytes, &sizes);
        prop_assert_eq!(cut_all(Protocol::Pd0, &bytes).len(), 2);
    }

    #[test]
    fn no_bytes_make_it_panic(
        ensemble in ensembles(), flips in frames::flips(), noise in frames::noise(),
    ) {
        is_robust(Protocol::Pd0, &ensemble.write(), &flips, &noise, |bytes| {
            if let Ok(ensemble) = Ensemble::read(bytes) {
                let _ = (ensemble.reading(LogReference::Water), ensemble.write());
            }
        });
    }
}

#[test]
fn an_ensemble_of_many_data_types_is_read() {
    // WinRiver II writes some eighty types into one ensemble, with its notes among them
    let whole = ensemble(Coordinates::Ship, [Some(0.1), Some(-2.0), Some(0.0), Some(0.0)]);
    for others in [30_u8, 65, 200] {
        let frame = with_others(&whole.write(), others);
        assert_eq!(look(&frame), Look::Frame(frame.len()), "{others}");
        assert_eq!(Ensemble::read(&frame).unwrap(), Ensemble::read(&whole.write()).unwrap());
    }
}

/// An ensemble with so many types of four bytes behind its own.
fn with_others(frame: &[u8], others: u8) -> Vec<u8> {
    let own = frame[5];
    let start = 6 + 2 * usize::from(own);
    let shift = 2 * u16::from(others);
    let body = &frame[start..frame.len() - 4];
    let length = u16::try_from(start + body.len() + 2).unwrap() + shift + 4 * u16::from(others);
    let mut longer = vec![0x7F, 0x7F];
    longer.extend(length.to_le_bytes());
    longer.extend([0, own + others]);
    for pair in frame[6..start].chunks(2) {
        longer.extend((u16::from_le_bytes([pair[0], pair[1]]) + shift).to_le_bytes());
    }
    let mut offset = u16::try_from(start + body.len()).unwrap() + shift;
    for _ in 0..others {
        longer.extend(offset.to_le_bytes());
        offset += 4;
    }
    longer.extend(body);
    (0..others).for_each(|_| longer.extend([0x22, 0x20, 1, 2]));
    longer.extend([0, 0]);
    let sum = longer.iter().fold(0_u16, |sum, byte| sum.wrapping_add(u16::from(*byte)));
    longer.extend(sum.to_le_bytes());
    longer
}
