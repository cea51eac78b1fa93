//! Sentences of published manuals, with checksums recomputed.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::units::KNOT;
use insd_wire::nmea::{
    Frame, Gga, HeadingMode, NmeaFault, PositionMode, Psxn, Rmc, Rot, Sentence, Talker, Ths, Vtg,
    Zda,
};

/// Published sentences that are no sentences of this crate's writers, or whose dialect has to be told.
const FRAMED: [&str; 7] = [
    "$PASHR,123816.80,312.95,T,-000.83,-000.42,-000.01,0.234,0.224,0.298,1,0*09",
    "$PHTRO,1.72,M,0.34,T*4B",
    "$PHLIN,0.335,0.407,0.542*54",
    "$PHSPD,0.016,0.309,0.001*51",
    "$PHCMP,3956.11,N,2.01,N*7C",
    "$PHINF,20000000*77",
    "$PRDID,-012.39,+002.14,366.91*7A",
];

/// Published sentences that are read, and written so again.
const WRITTEN: [&str; 20] = [
    "$HETHS,316.70,E*1A",
    "$PSXN,20,0,0,0,0*3B",
    "$PSXN,23,1.28,1.93,104.68,-0.24*18",
    "$GPGST,220932.45,0.49,0.206,0.193,32,0.202,0.197,0.439*42",
    "$GPGBS,220932.45,0.06,-0.03,0.44,19,0.00,0.46,0.51*40",
    "$MGROT,0.1,A*2D",
    "$IIXDR,A,-0.3,D,PTCH,A,-3.4,D,ROLL*58",
    "$GPVBW,0.312,0.910,A,0.410,0.950,A*55",
    // sbgECom
    "$GPGST,,,,,,,,*57",
    "$GPGST,172814.00,,0.023,0.020,273.62,0.023,0.015,0.031*46",
    "$GPHDT,191.94,T*01",
    "$GPHDT,,T*1B",
    "$GPZDA,,,,,,*48",
    "$GPZDA,201530.00,04,07,2002,00,00*60",
    // Kongsberg MGC R3
    "$MGHDT,348.67,T*16",
    "$MGTHS,348.67,A*14",
    "$PSXN,20,2,2,0,0*3B",
    // Navis
    "$HEHDM,311.40,M*18",
    // Koden CVR-010: a list of alerts
    "$SDALC,01,01,32,1,JMC,230,1,4*19",
    // go-nmea
    "$HCHBT,1.5,A,1*23",
];

fn read(line: &str) -> Sentence {
    Sentence::read(line.as_bytes()).unwrap().1
}

#[test]
fn published_sentences_pass_the_frame_check() {
    for line in FRAMED {
        assert!(Frame::parse(line.as_bytes()).is_ok(), "{line}");
    }
}

#[test]
fn published_sentences_are_read_and_written_byte_for_byte() {
    for line in WRITTEN {
        let (talker, sentence) =
            Sentence::read(line.as_bytes()).unwrap_or_else(|fault| panic!("{line}: {fault}"));
        let written = sentence.write(talker.unwrap_or(Talker::IN));
        assert_eq!(written.as_bytes(), format!("{line}\r\n").as_bytes());
    }
}

#[test]
fn sentences_that_manuals_print_with_a_wrong_checksum_are_refused() {
    for (line, computed) in [
        ("$GPROT,31.61,A*55", 0x34),
        ("$GPROT,,V*55", 0x08),
        ("$PHLIN,0.03,0.22,-0.15*68", 0x4B),
        ("$HEHDG,311.2,1.7,W,0.0,E*50", 0x51),
    ] {
        match Frame::parse(line.as_bytes()) {
            Err(NmeaFault::WrongChecksum { computed: ours, .. }) => assert_eq!(ours, computed),
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
    ] {
        let sum = insd_wire::nmea::checksum(&line.as_bytes()[1..]);
        let framed = format!("{line}*{sum:02X}");
        assert_eq!(
            Sentence::read(framed.as_bytes()),
            Err(NmeaFault::Malformed { field }),
            "{line}"
        );
    }
}

#[test]
fn a_line_cut_between_fields_names_the_missing_one() {
    let sum = insd_wire::nmea::checksum(b"HEHDT,36.0");
    let framed = format!("$HEHDT,36.0*{sum:02X}");
    assert_eq!(Sentence::read(framed.as_bytes()), Err(NmeaFault::Missing { field: 2 }));
}

/// Frames a sentence with its checksum and reads it.
fn framed(text: &str) -> Result<Sentence, NmeaFault> {
    let sum = insd_wire::nmea::checksum(&text.as_bytes()[1..]);
    Sentence::read(format!("{text}*{sum:02X}").as_bytes()).map(|(_, sentence)| sentence)
}

#[test]
fn short_and_blank_forms_of_vbw_are_read() {
    let Sentence::Vbw(short) = read("$GPVBW,0.312,0.910,A,0.410,0.950,A*55") else { panic!() };
    assert!((short.ground.transverse.unwrap() - 0.95 * KNOT).abs() < 1e-12);
    assert!(short.water.valid && short.ground.valid && !short.stern_water.valid);
    let Sentence::Vbw(blank) = read("$VDVBW,-0.08,,A,,,V,,V,,V*7D") else { panic!() };
    assert!((blank.water.longitudinal.unwrap() + 0.08 * KNOT).abs() < 1e-12);
    assert_eq!((blank.water.transverse, blank.ground.longitudinal), (None, None));
    assert!(blank.water.valid && !blank.ground.valid);
}

#[test]
fn distances_of_both_editions_of_vlw_are_read() {
    let Sentence::Vlw(new) = read("$SDVLW,,N,545.6,N,1109.4,N,393.6,N*44") else { panic!() };
    assert!((new.water_trip.unwrap() - 545.6 * 1852.0).abs() < 1e-6);
    assert!((new.ground_trip.unwrap() - 393.6 * 1852.0).abs() < 1e-6);
    assert_eq!(new.water, None);
    let Ok(Sentence::Vlw(old)) = framed("$VMVLW,10.0,N,2.0,N") else { panic!() };
    assert_eq!((old.water, old.ground), (Some(18_520.0), None));
}

#[test]
fn the_published_psxn_sentences_are_read_with_their_signs() {
    let Sentence::Psxn(Psxn::Motion { roll, heave, .. }) =
        read("$PSXN,23,1.28,1.93,104.68,-0.24*18")
    else {
        panic!()
    };
    assert!((roll.unwrap() - 1.28_f64.to_radians()).abs() < 1e-12);
    assert_eq!(heave, Some(-0.24));
    assert_eq!(framed("$PSXN,26,0,44.5000,0.7800,-0.9000,NRP"), Err(NmeaFault::OtherSentence));
}

#[test]
fn the_examples_of_nortek_bottom_tracks_are_read() {
    // examples of pynmea2, whose checksums of PNORBT0, 7 and 9 are good
    let Sentence::NortekBottomTrack(track) = read(
        "$PNORBT9,1452244916.7508,1.234,-1.234,0.1234,0.1234,0.1234,12.34,23.45,23.45,23.45,23.45,\
         23.4,1567.8,1.2,12.3,0x000FFFFF*1E",
    ) else {
        panic!()
    };
    assert_eq!(track.time.unwrap().as_nanos(), 1_452_244_916_750_800_000);
    assert_eq!((track.velocity[2], track.distances[3]), (Some(0.1234), Some(23.45)));
    assert_eq!(track.sensors.unwrap().status, Some(0xF_FFFF));
    let Sentence::NortekBeam(beam) =
        read("$PNORBT0,1,040721,131335.3341,23.961,-48.122,-32.76800,10.00000,0.00,0x00000000*48")
    else {
        panic!()
    };
    assert_eq!((beam.velocity, beam.figure_of_merit, beam.distance), (None, None, None));
    let tagged = "$PNORBT6,TIME=1452244916.7508,DT1=1.234,DT2=-1.234,VX=-32.768,VY=0.1,VZ=0.1,\
                  FOM=10.0,D1=0.00,D2=23.45,D3=23.45,D4=23.45";
    let Ok(Sentence::NortekBottomTrack(tagged)) = framed(tagged) else { panic!() };
    assert_eq!((tagged.velocity[0], tagged.figure_of_merit), (None, None));
    assert_eq!(tagged.distances[..2], [None, Some(23.45)]);
    assert_eq!(framed("$PNORBT6,TIME=1.0,DT2=1.0"), Err(NmeaFault::Malformed { field: 2 }));
}

#[test]
fn a_line_cut_short_that_passes_its_checksum_is_refused_or_loses_its_last_value_alone() {
    let whole = "$GPGGA,083723.00,5155.55442,N,00434.65873,E,1,06,2.51,-4.0,M,46.0,M,7.0,0138";
    let Ok(Sentence::Gga(all)) = framed(whole) else { panic!() };
    for end in 7..whole.len() {
        match framed(&whole[..end]) {
            Ok(Sentence::Gga(cut)) => {
                assert_eq!(Gga { age: all.age, station: all.station, ..cut }, all);
            }
            Ok(_) => panic!(),
            Err(_) => assert!(end < whole.len() - 3),
        }
    }
    let rmc = "$GPRMC,043539.00,A,4333.190206,N,00127.618380,E,0.0,12.5,040925,1.7,W";
    let Ok(Sentence::Rmc(all)) = framed(rmc) else { panic!() };
    for end in 7..rmc.len() {
        match framed(&rmc[..end]) {
            Ok(Sentence::Rmc(cut)) => assert_eq!(Rmc { variation: None, ..all }, cut),
            Ok(_) => panic!(),
            Err(_) => assert!(end < rmc.len() - 1),
        }
    }
}

#[test]
fn what_is_no_position_is_unknown_in_a_void_sentence_and_a_fault_in_any_other() {
    let Sentence::Gga(gga) =
        read("$GPGGA,071733.929,8960.0000,N,00000.0000,E,0,0,,137.0,M,13.0,M,,*40")
    else {
        panic!()
    };
    assert_eq!(gga.position, None);
    let Sentence::Rmc(rmc) =
        read("$GPRMC,000416.984,V,36000.0000,N,72000.0000,E,0.000000,,260120,,*3B")
    else {
        panic!()
    };
    assert!(rmc.position.is_none() && !rmc.valid);
    assert_eq!(
        framed("$GPGGA,071733,8960.0000,N,00000.0000,E,1,4,,137.0,M,13.0,M,,"),
        Err(NmeaFault::Malformed { field: 2 })
    );
    let Ok(Sentence::Rmc(dateless)) =
        framed("$GPRMC,000231.099,A,4829.0005,N,00022.0015,E,0.15,212.28,2208-1,,,A")
    else {
        panic!()
    };
    assert!(dateless.date.is_none() && dateless.position.is_some());
}

#[test]
fn real_forms_that_stray_from_the_standard_are_read() {
    for line in [
        // Motorola: the mode stands in the place of the variation's sign
        "$GPRMC,212618.000,A,4839.9411,N,00214.9065,E,0.00,,181207,0,A*69",
        // Saab R4: no station, and a datum without offsets
        "$GPGGA,130711,5012.790800,N,00806.879600,W,2,,,,,,,*6A",
        "$GPDTM,W84,C*52",
        // SiRF-III: 24 satellites
        "$GPGSA,A,3,23,13,07,25,,,,,,,,,,,,,,,,,,,,,09.2,07.2,05.7*0D",
        // BeiDou satellites above 200; a signal at the end
        "$GBGSV,3,3,11,209,36,317,,214,36,147,,205,11,257,*67",
        "$GBGSV,4,4,14,44,59,199,40,46,03,052,,1*7C",
        "$GNGNS,043539.00,4333.190206,N,00127.618380,E,AAAAN,14,1.3,250.8,50.0,,,V*62",
        "$GPZDA,120213.000,31,07,2022,+00,00*79",
    ] {
        read(line);
    }
}
