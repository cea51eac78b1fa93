//! Makers' own sentences as their manuals and published records have them, with checksums recomputed;
//! what a ship that leans looks like in each; and their greatest lengths.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::read;
use insd_base::units::{DEG, KNOT};
use insd_base::utm::Utm;
use insd_wire::nmea::{
    ChecksumPolicy, Frame, InsUserStatus, Marked, NmeaFault, NmeaLine, OctansStatus, Pashr,
    PashrDialect, PfecAttitude, Phcmp, Phinf, Phlin, Phoct, PhoctState, Phspd, Phtro, Pixse,
    PixseAlgorithmStatus, PixseHighLevelStatus, PixseSystemStatus, Position, Prdid, PrdidForm,
    Psxn, Ptnthtm, Sentence, SurgeSwayHeave, Talker, TimeOfDay, checksum,
};

/// Sentences that are written to the byte as they are published, but for their checksums, which are
/// computed.
const GOLDEN: [&str; 42] = [
    // Octans set: R/V records and manuals
    "$PHTRO,1.72,M,0.34,T*4B",
    "$PHTRO,0.03,P,0.22,T*56",
    "$PHTRO,0.09,M,0.12,B*54",
    "$PHTRO,7.44,P,14.22,B*71",
    "$PHTRO,10.37,P,177.62,T*65",
    "$PHLIN,0.335,0.407,0.542*54",
    "$PHLIN,0.000,-0.002,0.006*78",
    "$PHSPD,0.016,0.309,0.001*51",
    "$PHCMP,3956.11,N,2.01,N*7C",
    "$PHCMP,4131.43,N,0.00,N*76",
    "$PHINF,20000000*77",
    "$PHINF,30000102*75",
    "$PHINF,08030027*7B",
    "$PHOCT,01,000201.000,E,00,356.592,E,+000.225,E,+00.039,E,+00.023,T,+00.023,+00.016,+00.003,\
     +00.002,-00.001,+00.000,+0001.96*04",
    "$PHOCT,01,192621.400,T,00,080.378,T,-000.106,T,-03.105,T,+00.220,T,+00.084,-00.025,+00.013,\
     +00.235,+00.024,+00.078,-0008.03*09",
    "$PHOCT,01,192621.500,T,00,080.311,T,-000.237,T,-03.066,T,+00.239,T,+00.105,-00.021,+00.020,\
     +00.172,+00.042,+00.073,-0061.95*0D",
    "$PHOCT,01,163405.123,T,03,180.000,T,+120.000,T,-45.000,T,+90.000,T,+85.000,+75.000,+65.000,\
     -85.000,-75.000,-65.000,+1250.00*0B",
    // Phins set: records of four units
    "$PIXSE,ATITUD,-1.641,-0.490*6D",
    "$PIXSE,ATITUD,1.129,5.394*62",
    "$PIXSE,POSITI,53.10245714,8.83994382,-0.115*71",
    "$PIXSE,POSITI,-15.14096288,186.22231161,0.033*79",
    "$PIXSE,SPEED_,-0.802,-1.243,0.000*6F",
    "$PIXSE,SPEED_,-0.068,0.046,0.009*49",
    "$PIXSE,UTMWGS,U,32,489284.019,5883680.109,-0.115*39",
    "$PIXSE,UTMWGS,L,2,201472.606,8324191.634,0.032*3E",
    "$PIXSE,UTMWGS,N,31,166021.443,0.000,0.000*0B",
    "$PIXSE,HEAVE_,-0.211,0.031,-6.256*7E",
    "$PIXSE,TIME__,003356.016693*64",
    "$PIXSE,STDHRP,1.997,0.082,0.101*7C",
    "$PIXSE,STDPOS,20563.20,18004.65,50.00*7D",
    "$PIXSE,STDSPD,19.747,13.032,10.002*41",
    "$PIXSE,ALGSTS,00000045,00004000*60",
    "$PIXSE,ALGSTS,00000041,00030000*63",
    "$PIXSE,STATUS,08000200,00001A00*15",
    "$PIXSE,STATUS,00000000,00200000*6D",
    "$PIXSE,HT_STS,FFFD5551*46",
    "$PIXSE,HT_STS,6FFD5551*36",
    // current profilers and satellite compasses
    "$PRDID,-012.39,+002.14,066.91*79",
    "$PRDID,-000.19,+000.04,158.32*7E",
    "$PFEC,GPatt,294.7,-02.5,+00.4*45",
    "$PFEC,GPatt,187.1,+12.0,-25.0*45",
    "$PSXN,23,1.28,1.93,104.68,-0.24*18",
];

fn parsed(line: &str) -> Sentence {
    Sentence::read(line.as_bytes()).unwrap_or_else(|fault| panic!("{line}: {fault}")).1
}

#[test]
fn published_sentences_are_read_and_written_byte_for_byte() {
    for line in GOLDEN {
        assert_eq!(parsed(line).write(Talker::IN).as_str(), line);
    }
}

#[test]
fn an_example_with_an_impossible_heading_is_refused_for_its_heading() {
    let published = b"$PRDID,-012.39,+002.14,366.91*7A";
    assert_eq!(Sentence::read(published), Err(NmeaFault::Malformed { field: 3 }));
}

#[test]
fn the_other_forms_of_prdid_and_pfec_are_written_and_read_without_a_checksum_if_the_port_allows() {
    let Sentence::Prdid(prdid) = parsed("$PRDID,-000.19,+000.04,158.32*7E") else { panic!() };
    let bare = prdid.write_as(PrdidForm::FixedWithoutChecksum);
    assert_eq!(bare.as_bytes(), b"$PRDID,-000.19,+000.04,158.32\r\n");
    let plain = prdid.write_as(PrdidForm::Plain);
    assert!(plain.as_str().starts_with("$PRDID,-0.19,0.04,158.32*"), "{plain:?}");
    assert_eq!(parsed(plain.as_str()), Sentence::Prdid(prdid));
    let Sentence::PfecAttitude(pfec) = parsed("$PFEC,GPatt,294.7,-02.5,+00.4*45") else { panic!() };
    let old = pfec.write_old();
    assert_eq!(old.as_bytes(), b"$PFEC,GPatt,294.7,-02.5,+00.4\r\n");
    for (line, sentence) in [(bare, Sentence::Prdid(prdid)), (old, Sentence::PfecAttitude(pfec))] {
        assert_eq!(Frame::parse(line.as_bytes()), Err(NmeaFault::NoChecksum));
        let frame = Frame::parse_with(line.as_bytes(), ChecksumPolicy::Optional).unwrap();
        assert_eq!(Sentence::read_frame(&frame), Ok(sentence));
    }
}

#[test]
fn other_words_under_the_same_address_are_other_sentences() {
    for text in ["PFEC,GPhve,00.007,A", "PIXSE,LOGIN_,1.468,0.039", "PHOCT,02,", "PINSD,XXX,1"] {
        let line = format!("${text}*{:02X}", checksum(text.as_bytes()));
        assert_eq!(Sentence::read(line.as_bytes()), Err(NmeaFault::OtherSentence), "{text}");
    }
}

#[test]
fn the_pitch_of_a_climbing_vehicle_is_up() {
    // record of an underwater vehicle on its way up, as published with the tests of a parser
    let Sentence::Pixse(Pixse::Attitude { pitch, .. }) = parsed("$PIXSE,ATITUD,-0.729,-15.705*58")
    else {
        panic!()
    };
    let Sentence::Pixse(Pixse::Velocity { north: Some(north), east: Some(east), down: Some(down) }) =
        parsed("$PIXSE,SPEED_,0.972,1.082,0.412*61")
    else {
        panic!()
    };
    let climb = (-down).atan2(north.hypot(east));
    assert!((climb - pitch.unwrap()).abs() < DEG, "{} {:?}", climb / DEG, pitch);
}

#[test]
fn the_grid_of_a_record_is_that_of_its_position() {
    for (place, grid) in [
        (
            "$PIXSE,POSITI,53.10245714,8.83994382,-0.115*71",
            "$PIXSE,UTMWGS,U,32,489284.019,5883680.109,-0.115*39",
        ),
        (
            "$PIXSE,POSITI,39.27301545,14.38044597,-731.923*4D",
            "$PIXSE,UTMWGS,S,33,446558.301,4347257.020,-731.923*3F",
        ),
    ] {
        let Sentence::Pixse(Pixse::Position { position: Some(place), altitude }) = parsed(place)
        else {
            panic!()
        };
        let Sentence::Pixse(Pixse::Grid { utm: Some(told), altitude: again }) = parsed(grid) else {
            panic!()
        };
        let utm = Utm::of(place.latitude, place.longitude).unwrap();
        assert_eq!((utm.zone, utm.band, altitude), (told.zone, told.band, again));
        assert!((utm.easting - told.easting).hypot(utm.northing - told.northing) < 0.002);
    }
}

#[test]
fn status_words_of_records_say_what_the_units_did() {
    let Sentence::Pixse(Pixse::Algorithm(Some(algorithm))) =
        parsed("$PIXSE,ALGSTS,00000041,00030000*63")
    else {
        panic!()
    };
    let zero_velocity =
        PixseAlgorithmStatus::ZERO_VELOCITY_MODE | PixseAlgorithmStatus::ZERO_VELOCITY_VALID;
    assert!(algorithm.has(PixseAlgorithmStatus::NAVIGATION | zero_velocity));
    assert!(!algorithm.has(PixseAlgorithmStatus::ALIGNMENT));
    let Sentence::Pixse(Pixse::System(Some(system))) = parsed("$PIXSE,STATUS,08000200,00001A00*15")
    else {
        panic!()
    };
    let detected = PixseSystemStatus::UTC_DETECTED | PixseSystemStatus::PPS_DETECTED;
    assert!(system.has(detected | PixseSystemStatus::ZERO_VELOCITY_MODE));
    let Sentence::Pixse(Pixse::HighLevel(Some(short))) = parsed("$PIXSE,HT_STS,6FFD5551*36") else {
        panic!()
    };
    assert!(short.has(PixseHighLevelStatus::GOOD | PixseHighLevelStatus::NO_GPS1));
    assert!(!short.has(PixseHighLevelStatus::NO_ZERO_VELOCITY_MODE));
    let Sentence::Phinf(phinf) = parsed("$PHINF,20000000*77") else { panic!() };
    assert_eq!(phinf.ins(), Some(InsUserStatus::NAVIGATION));
    let Sentence::Phinf(phinf) = parsed("$PHINF,08030027*7B") else { panic!() };
    let octans = phinf.octans().unwrap();
    assert!(octans.has(OctansStatus::HEADING_INVALID | OctansStatus::ATTITUDE_INVALID));
    assert!(octans.has(OctansStatus::ALIGNMENT) && !octans.has(OctansStatus::CPU_OVERLOAD));
}

/// A ship that leans: starboard side 5 deg down, bow 3 deg up, lifted 1.5 m by a wave, pushed 0.2 m
/// forward and 0.4 m to starboard. `side` -1 leans her the other way.
struct Ship {
    roll: Option<f64>,
    pitch: Option<f64>,
    heave: Option<f64>,
    surge: Option<f64>,
    sway: Option<f64>,
}

fn ship(side: f64) -> Ship {
    let of = |value: f64| Some(side * value);
    Ship {
        roll: of(5.0 * DEG),
        pitch: of(3.0 * DEG),
        heave: of(1.5),
        surge: of(0.2),
        sway: of(0.4),
    }
}

/// Her sentences, without checksums.
fn sentences(ship: &Ship) -> Vec<String> {
    let Ship { roll, pitch, heave, surge, sway } = *ship;
    let heading = Some(90.0 * DEG);
    let motion = SurgeSwayHeave { heave, surge, sway };
    let phoct = Phoct {
        heading: Marked::valid(heading),
        roll: Marked::valid(roll),
        pitch: Marked::valid(pitch),
        heave: Marked::valid(heave),
        motion,
        rates: motion,
        rate_of_turn: roll.map(|side| side.signum() * 2.0 * DEG / 60.0),
        ..Phoct::default()
    };
    let down = heave.map(|heave| -heave);
    let mut pashr = Pashr { roll, pitch, heading, ..Pashr::default() };
    let mut in_dialect = |dialect: PashrDialect| {
        pashr.set_heave_down(down, dialect);
        pashr.write()
    };
    let lines = [
        Phtro { roll, pitch }.write(),
        Phlin { surge, sway, heave }.write(),
        Phspd { surge, sway, heave }.write(),
        phoct.write(),
        Pixse::Attitude { roll, pitch }.write(),
        Pixse::Motion { surge, sway, heave }.write(),
        Pixse::Velocity { north: surge, east: sway, down }.write(),
        Prdid { roll, pitch, heading }.write(),
        PfecAttitude { roll, pitch, heading }.write(),
        Psxn::Motion { roll, pitch, heading, heave: down }.write(),
        Ptnthtm { roll, pitch, heading, is_warned: false }.write(),
        in_dialect(PashrDialect::Sbg),
        in_dialect(PashrDialect::SbgWassp),
    ];
    let bare = |line: &NmeaLine| line.as_str().split('*').next().unwrap().to_owned();
    lines.iter().map(bare).collect()
}

#[test]
fn a_ship_that_leans_to_starboard_and_rises_has_the_signs_of_each_format() {
    assert_eq!(
        sentences(&ship(1.0)),
        [
            "$PHTRO,3.00,M,5.00,T",
            "$PHLIN,0.200,-0.400,1.500",
            "$PHSPD,0.200,-0.400,1.500",
            "$PHOCT,01,,E,,090.000,T,+005.000,T,-03.000,T,+01.500,T,+01.500,+00.200,-00.400,\
             +01.500,+00.200,-00.400,+0002.00",
            "$PIXSE,ATITUD,5.000,-3.000",
            "$PIXSE,HEAVE_,0.200,-0.400,1.500",
            "$PIXSE,SPEED_,0.400,0.200,1.500",
            "$PRDID,+003.00,+005.00,090.00",
            "$PFEC,GPatt,090.0,+03.0,+05.0",
            "$PSXN,23,5.00,3.00,90.00,-1.50",
            "$PTNTHTM,90.00,N,3.00,N,5.00,N,,",
            "$PASHR,,090.00,T,+005.00,+003.00,-001.50,,,,",
            "$PASHR,,090.00,T,+005.00,+003.00,+001.50,,,,",
        ]
    );
}

#[test]
fn a_ship_that_leans_to_port_and_falls_has_the_other_signs() {
    assert_eq!(
        sentences(&ship(-1.0)),
        [
            "$PHTRO,3.00,P,5.00,B",
            "$PHLIN,-0.200,0.400,-1.500",
            "$PHSPD,-0.200,0.400,-1.500",
            "$PHOCT,01,,E,,090.000,T,-005.000,T,+03.000,T,-01.500,T,-01.500,-00.200,+00.400,\
             -01.500,-00.200,+00.400,-0002.00",
            "$PIXSE,ATITUD,-5.000,3.000",
            "$PIXSE,HEAVE_,-0.200,0.400,-1.500",
            "$PIXSE,SPEED_,-0.400,-0.200,-1.500",
            "$PRDID,-003.00,-005.00,090.00",
            "$PFEC,GPatt,090.0,-03.0,-05.0",
            "$PSXN,23,-5.00,-3.00,90.00,1.50",
            "$PTNTHTM,90.00,N,-3.00,N,-5.00,N,,",
            "$PASHR,,090.00,T,-005.00,-003.00,+001.50,,,,",
            "$PASHR,,090.00,T,-005.00,-003.00,-001.50,,,,",
        ]
    );
}

#[test]
fn unknown_values_are_empty_fields_and_never_valid() {
    let unknown = [
        (Phtro::default().write(), "$PHTRO,,,,*"),
        (Phlin::default().write(), "$PHLIN,,,*"),
        (Phcmp::default().write(), "$PHCMP,,,,*"),
        (Phinf::default().write(), "$PHINF,*"),
        (Phoct::default().write(), "$PHOCT,01,,E,,,E,,E,,E,,E,,,,,,,*"),
        (Pixse::Attitude { roll: None, pitch: None }.write(), "$PIXSE,ATITUD,,*"),
        (Pixse::Position { position: None, altitude: None }.write(), "$PIXSE,POSITI,,,*"),
        (Pixse::Grid { utm: None, altitude: None }.write(), "$PIXSE,UTMWGS,,,,,*"),
        (Pixse::System(None).write(), "$PIXSE,STATUS,,*"),
        (Pixse::HighLevel(None).write(), "$PIXSE,HT_STS,*"),
        (Prdid::default().write(), "$PRDID,,,*"),
        (PfecAttitude::default().write(), "$PFEC,GPatt,,,*"),
        (Ptnthtm::default().write(), "$PTNTHTM,,L,,L,,L,,*"),
    ];
    for (line, text) in unknown {
        assert!(line.as_str().starts_with(text), "{line:?}");
    }
    let claimed = Marked { value: Some(f64::NAN), state: PhoctState::Valid };
    let line =
        Phoct { roll: claimed, pitch: claimed, time_valid: true, ..Phoct::default() }.write();
    assert!(!line.as_str().contains(",T,"), "{line:?}");
}

#[test]
fn an_angle_that_rounds_to_zero_has_no_side() {
    let level = Phtro { roll: Some(-0.004 * DEG), pitch: Some(-0.004 * DEG) }.write();
    assert!(level.as_str().starts_with("$PHTRO,0.00,M,0.00,T*"), "{level:?}");
    let turned = Prdid { heading: Some(359.996 * DEG), ..Prdid::default() }.write();
    assert!(turned.as_str().starts_with("$PRDID,,,000.00*"), "{turned:?}");
}

#[test]
fn a_longitude_of_countless_turns_is_still_a_longitude() {
    let place = Position { latitude: 0.0, longitude: 8.8e307 };
    let line = Pixse::Position { position: Some(place), altitude: None }.write();
    let Sentence::Pixse(Pixse::Position { position: Some(_), .. }) = read(&line) else { panic!() };
}

/// The longest time of day.
const LATE: Option<TimeOfDay> =
    Some(TimeOfDay { hour: 23, minute: 59, second: 59, nanosecond: 999_999_999 });

#[test]
fn the_greatest_lengths_of_the_octans_set_are_those_that_are_stated() {
    let far = Some(-99.999);
    let angles = (Some(-180.0 * DEG), Some(-89.999 * DEG));
    let motion = SurgeSwayHeave { heave: far, surge: far, sway: far };
    let phoct = Phoct {
        time: LATE,
        time_valid: true,
        latency_ms: Some(99),
        heading: Marked::valid(Some(359.9 * DEG)),
        roll: Marked::valid(angles.0),
        pitch: Marked::valid(angles.1),
        heave: Marked::valid(far),
        motion,
        rates: motion,
        rate_of_turn: Some(-9999.0 * DEG / 60.0),
    };
    let [roll, pitch, heading] = [angles.0, angles.1, Some(359.0 * DEG)];
    let latitude = Some(-89.9 * DEG);
    let lines = [
        (Phtro { roll, pitch }.write(), Phtro::LONGEST),
        (Phlin { surge: far, sway: Some(99.999), heave: far }.write(), Phlin::LONGEST),
        (Phspd { surge: far, sway: Some(99.999), heave: far }.write(), Phspd::LONGEST),
        (Phcmp { latitude, speed: Some(99.0 * KNOT) }.write(), Phcmp::LONGEST),
        (Phinf::of_ins(InsUserStatus::FAILURE).write(), Phinf::LONGEST),
        (phoct.write(), Phoct::LONGEST),
        (Prdid { roll, pitch, heading }.write(), Prdid::LONGEST),
        (PfecAttitude { roll: pitch, pitch, heading }.write(), PfecAttitude::LONGEST),
        (Ptnthtm { roll, pitch, heading, is_warned: true }.write(), Ptnthtm::LONGEST),
    ];
    for (line, longest) in lines {
        assert_eq!(line.as_bytes().len(), longest, "{line:?}");
        read(&line);
    }
}

#[test]
fn the_greatest_lengths_of_the_phins_set_are_those_that_are_stated() {
    let far = Some(-99.999);
    let altitude = Some(-9999.999);
    let place = Position { latitude: -89.999 * DEG, longitude: -0.001 * DEG };
    let utm = Utm { zone: 60, band: b'M', easting: 833_978.557, northing: 10_000_000.0 };
    let sigma = Some(99.0);
    let lines = [
        Pixse::Attitude { roll: Some(-180.0 * DEG), pitch: Some(89.999 * DEG) },
        Pixse::Position { position: Some(place), altitude },
        Pixse::Velocity { north: far, east: far, down: Some(99.999) },
        Pixse::Grid { utm: Some(utm), altitude },
        Pixse::Motion { surge: far, sway: Some(99.999), heave: far },
        Pixse::Time(LATE),
        Pixse::AttitudeSigma { heading: Some(3.1), roll: Some(3.1), pitch: Some(3.1) },
        Pixse::PositionSigma { north: Some(9e5), east: Some(9e5), altitude: Some(9e5) },
        Pixse::VelocitySigma { north: sigma, east: sigma, down: sigma },
        Pixse::Algorithm(Some(PixseAlgorithmStatus(u64::MAX))),
        Pixse::System(Some(PixseSystemStatus(u64::MAX))),
        Pixse::HighLevel(Some(PixseHighLevelStatus(u32::MAX))),
    ];
    for pixse in lines {
        let line = pixse.write();
        assert_eq!(line.as_bytes().len(), pixse.longest(), "{line:?}");
        read(&line);
    }
    let longest = lines.iter().map(Pixse::longest).max();
    assert_eq!(longest, Some(Pixse::LONGEST));
}
