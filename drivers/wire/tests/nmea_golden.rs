//! Sentences of published manuals, with checksums recomputed.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_wire::nmea::{
    Fault, Frame, Gga, HeadingMode, PositionMode, Rot, Sentence, Talker, Ths, Vtg, Zda,
};

const GOOD: [&str; 15] = [
    "$HETHS,316.70,E*1A",
    "$PSXN,20,0,0,0,0*3B",
    "$PSXN,23,1.28,1.93,104.68,-0.24*18",
    "$PASHR,123816.80,312.95,T,-000.83,-000.42,-000.01,0.234,0.224,0.298,1,0*09",
    "$PHTRO,1.72,M,0.34,T*4B",
    "$PHLIN,0.335,0.407,0.542*54",
    "$PHSPD,0.016,0.309,0.001*51",
    "$PHCMP,3956.11,N,2.01,N*7C",
    "$PHINF,20000000*77",
    "$PRDID,-012.39,+002.14,366.91*7A",
    "$GPGST,220932.45,0.49,0.206,0.193,32,0.202,0.197,0.439*42",
    "$GPGBS,220932.45,0.06,-0.03,0.44,19,0.00,0.46,0.51*40",
    "$MGROT,0.1,A*2D",
    "$IIXDR,A,-0.3,D,PTCH,A,-3.4,D,ROLL*58",
    "$GPVBW,0.312,0.910,A,0.410,0.950,A*55",
];

fn read(line: &str) -> Sentence {
    Sentence::read(line.as_bytes()).unwrap().1
}

#[test]
fn published_sentences_pass_the_frame_check() {
    for line in GOOD {
        assert!(Frame::parse(line.as_bytes()).is_ok(), "{line}");
    }
}

#[test]
fn sentences_that_manuals_print_with_a_wrong_checksum_are_refused() {
    for (line, computed) in
        [("$GPROT,31.61,A*55", 0x34), ("$GPROT,,V*55", 0x08), ("$PHLIN,0.03,0.22,-0.15*68", 0x4B)]
    {
        match Frame::parse(line.as_bytes()) {
            Err(Fault::WrongChecksum { computed: ours, .. }) => assert_eq!(ours, computed),
            other => panic!("{line}: {other:?}"),
        }
    }
}

#[test]
fn the_published_ths_is_written_byte_for_byte() {
    let ths = Ths { heading: Some(316.7_f64.to_radians()), mode: HeadingMode::Estimated };
    assert_eq!(ths.write(Talker::HE).as_bytes(), b"$HETHS,316.70,E*1A\r\n");
}

#[test]
fn the_published_rot_is_written_byte_for_byte() {
    let rot = Rot { rate: Some((0.1_f64 / 60.0).to_radians()), valid: true };
    let talker = Talker::new("MG").unwrap();
    assert_eq!(rot.write(talker).as_bytes(), b"$MGROT,0.1,A*2D\r\n");
}

#[test]
fn a_turn_to_port_is_negative() {
    let rot = Rot { rate: Some((-30.0_f64 / 60.0).to_radians()), valid: true };
    assert!(rot.write(Talker::TI).as_str().starts_with("$TIROT,-30.0,A*"));
}

#[test]
fn unknown_values_are_empty_fields_and_never_zeros() {
    let ths = Ths { heading: None, mode: HeadingMode::NotValid };
    let rot = Rot { rate: Some(f64::NAN), valid: true };
    let vtg = Vtg { course: None, course_magnetic: None, speed: None, mode: None };
    let zda = Zda { utc: None, zone: None };
    for (line, text) in [
        (ths.write(Talker::HE), "$HETHS,,V*"),
        (rot.write(Talker::TI), "$TIROT,,V*"),
        (vtg.write(Talker::IN), "$INVTG,,T,,M,,N,,K,N*"),
        (zda.write(Talker::IN), "$INZDA,,,,,,*"),
        (Gga::default().write(Talker::IN), "$INGGA,,,,,,0,,,,,,,,*"),
    ] {
        assert!(line.as_str().starts_with(text), "{line:?}");
    }
}

#[test]
fn an_old_vtg_without_mode_and_one_with_km_per_hour_alone_are_read() {
    let Sentence::Vtg(old) = read("$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K*48") else {
        panic!("not a VTG")
    };
    assert_eq!(old.mode, None);
    assert!((old.speed.unwrap() - 5.5 * 1852.0 / 3600.0).abs() < 1e-12);
    let Sentence::Vtg(metric) = read("$IIVTG,,T,,M,,N,36.0,K,A*2F") else { panic!("not a VTG") };
    assert_eq!(metric.mode, Some(PositionMode::Autonomous));
    assert!((metric.speed.unwrap() - 10.0).abs() < 1e-12);
}

#[test]
fn a_malformed_field_is_named_by_its_number() {
    for (line, field) in [
        ("$HEHDT,361.0,T", 1),
        ("$HEHDT,36x,T", 1),
        ("$HEHDT,36.0,M", 2),
        ("$HETHS,36.0,", 2),
        ("$HETHS,36.0,Q", 2),
        ("$TIROT,1.0,B", 2),
        ("$INGGA,,3500.0,N,,,1,,,,,,,,", 5),
        ("$INGGA,,3500.0,X,,,1,,,,,,,,", 3),
        ("$INGGA,,9000.1,N,13900.0,E,1,,,,,,,,", 2),
        ("$INGGA,,,,,,9,,,,,,,,", 6),
        ("$INZDA,120000,30,02,2026,00,00", 4),
        ("$INZDA,120000,28,02,2026,14,00", 5),
    ] {
        let sum = insd_wire::nmea::checksum(&line.as_bytes()[1..]);
        let framed = format!("{line}*{sum:02X}");
        assert_eq!(Sentence::read(framed.as_bytes()), Err(Fault::Malformed { field }), "{line}");
    }
}

#[test]
fn a_line_cut_between_fields_names_the_missing_one() {
    let sum = insd_wire::nmea::checksum(b"HEHDT,36.0");
    let framed = format!("$HEHDT,36.0*{sum:02X}");
    assert_eq!(Sentence::read(framed.as_bytes()), Err(Fault::Missing { field: 2 }));
}
