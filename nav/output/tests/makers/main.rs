//! What makers' own sentences say of a ship, read back: signs, order, and the whole of each.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod own;
mod quality;
mod ship;

use insd_base::Utm;
use insd_base::units::{DEG, KNOT};
use insd_output::{Manner, MessageKind, OutputEpoch};
use insd_wire::nmea::{PashrDialect, PhoctState, Pixse, Psxn, Sentence};

use ship::*;

const DIALECTS: [(&str, PashrDialect); 6] = [
    ("PASHR.sbg", PashrDialect::Sbg),
    ("PASHR.sbg_wassp", PashrDialect::SbgWassp),
    ("PASHR.ixblue", PashrDialect::Ixblue),
    ("PASHR.novatel", PashrDialect::Novatel),
    ("PASHR.trimble", PashrDialect::Trimble),
    ("PASHR.applanix", PashrDialect::Applanix),
];

/// Roll, pitch and heading of [`leaned`].
#[track_caller]
fn check(attitude: [Option<f64>; 3], side: f64, resolution: f64) {
    let [roll, pitch, heading] = attitude;
    near(roll, 10.0 * side * DEG, resolution);
    near(pitch, 5.0 * side * DEG, resolution);
    near(heading, 90.0 * DEG, resolution);
}

#[test]
fn pashr_has_the_signs_of_its_dialect_on_either_side() {
    for side in [1.0, -1.0] {
        for (name, dialect) in DIALECTS {
            let Sentence::Pashr(pashr) = read(name, &leaned(side)) else { panic!("{name}") };
            check([pashr.roll, pashr.pitch, pashr.heading], side, 0.01 * DEG);
            let states_heave = [PashrDialect::Sbg, PashrDialect::SbgWassp, PashrDialect::Ixblue]
                .contains(&dialect);
            let down = pashr.heave_down(dialect);
            match states_heave {
                true => near(down, -1.25 * side, 0.01),
                false => assert_eq!((down, pashr.heave_as_sent), (None, None), "{name}"),
            }
        }
    }
}

#[test]
fn pashr_is_to_the_byte_what_each_dialect_has() {
    let angles = "T,+010.00,+005.00";
    let expected = [
        ("PASHR.sbg", format!("030405.00,090.00,{angles},-001.25,0.020,0.030,0.050,1,0")),
        ("PASHR.sbg_wassp", format!("030405.00,090.00,{angles},+001.250,0.020,0.030,0.050,1,0")),
        ("PASHR.ixblue", format!("030405.000,090.00,{angles},-001.25,0.020,0.030,0.050,1,0")),
        ("PASHR.novatel", "030405.000,90.00,T,+10.00,+5.00,,0.020,0.030,0.050,1".to_owned()),
        ("PASHR.trimble", format!("030405.000,090.00,{angles},,0.020,0.030,0.050,2,4")),
        ("PASHR.applanix", format!("030405.000,090.00,{angles},,0.020,0.030,0.050,1,0")),
    ];
    for (name, text) in expected {
        assert_eq!(said(name, &epoch()).unwrap(), format!("$PASHR,{text}"), "{name}");
    }
}

#[test]
fn psxn_has_port_up_bow_up_and_heave_down() {
    for side in [1.0, -1.0] {
        let Sentence::Psxn(Psxn::Motion { roll, pitch, heading, heave }) =
            read("PSXN.23", &leaned(side))
        else {
            panic!()
        };
        check([roll, pitch, heading], side, 0.01 * DEG);
        near(heave, -1.25 * side, 0.01);
        let Sentence::Psxn(Psxn::Rates { roll_rate, pitch_rate, yaw_rate, down_velocity }) =
            read("PSXN.24", &leaned(side))
        else {
            panic!()
        };
        near(roll_rate, side * DEG, 0.01 * DEG);
        near(pitch_rate, 2.0 * side * DEG, 0.01 * DEG);
        near(yaw_rate, 3.0 * side * DEG, 0.01 * DEG);
        near(down_velocity, -0.5 * side, 0.01);
    }
}

#[test]
fn the_octans_set_has_its_letters_and_heave_up_and_no_surge_or_sway() {
    for side in [1.0, -1.0] {
        let told = leaned(side);
        let Sentence::Phtro(phtro) = read("PHTRO", &told) else { panic!() };
        check([phtro.roll, phtro.pitch, Some(90.0 * DEG)], side, 0.01 * DEG);
        let Sentence::Phlin(phlin) = read("PHLIN", &told) else { panic!() };
        near(phlin.heave, 1.25 * side, 0.001);
        let Sentence::Phspd(phspd) = read("PHSPD", &told) else { panic!() };
        near(phspd.heave, 0.5 * side, 0.001);
        let nothing = [phlin.surge, phlin.sway, phspd.surge, phspd.sway];
        assert_eq!(nothing, [None; 4]);
    }
    let Sentence::Phcmp(phcmp) = read("PHCMP", &epoch()) else { panic!() };
    near(phcmp.latitude, 54.0 * DEG, 0.01 / 60.0 * DEG);
    near(phcmp.speed, 5.0_f64.hypot(0.5), 0.01 * KNOT);
    assert_eq!(said("PHTRO", &leaned(1.0)).unwrap(), "$PHTRO,5.00,M,10.00,T");
    assert_eq!(said("PHTRO", &leaned(-1.0)).unwrap(), "$PHTRO,5.00,P,10.00,B");
    assert_eq!(said("PHINF", &epoch()).unwrap(), "$PHINF,00000000");
}

#[test]
fn phoct_has_bow_down_on_the_wire_and_heave_up() {
    for side in [1.0, -1.0] {
        let Sentence::Phoct(phoct) = read("PHOCT", &leaned(side)) else { panic!() };
        check([phoct.roll.value, phoct.pitch.value, phoct.heading.value], side, 0.001 * DEG);
        near(phoct.heave.value, 1.25 * side, 0.001);
        near(phoct.motion.heave, 1.25 * side, 0.001);
        near(phoct.rates.heave, 0.5 * side, 0.001);
        let motion = [phoct.motion.surge, phoct.motion.sway, phoct.rates.surge, phoct.rates.sway];
        assert_eq!(motion, [None; 4]);
        let turn = leaned(side).solution.unwrap().rate_of_turn();
        near(phoct.rate_of_turn, turn, 0.01 / 60.0 * DEG);
        for state in [phoct.heading, phoct.roll, phoct.pitch, phoct.heave] {
            assert_eq!(state.state, PhoctState::Valid);
        }
        assert!(phoct.time_valid && phoct.latency_ms == Some(0));
    }
    assert!(said("PHOCT", &epoch()).unwrap().contains(",+010.000,T,-05.000,T,+01.250,T,"));
}

#[test]
fn the_other_attitudes_have_their_signs() {
    for side in [1.0, -1.0] {
        let Sentence::Prdid(prdid) = read("PRDID", &leaned(side)) else { panic!() };
        check([prdid.roll, prdid.pitch, prdid.heading], side, 0.01 * DEG);
        for name in ["PFEC.GPatt", "PFEC.GPatt.v1"] {
            let Sentence::PfecAttitude(pfec) = read(name, &leaned(side)) else { panic!() };
            check([pfec.roll, pfec.pitch, pfec.heading], side, 0.1 * DEG);
        }
    }
    for side in [1.0, -1.0] {
        let Sentence::Ptnthtm(told) = read("PTNTHTM", &leaned(side)) else { panic!() };
        check([told.roll, told.pitch, told.heading], side, 0.01 * DEG);
    }
    let whole = |name| lines(name, &Manner::default(), &epoch()).remove(0);
    assert_eq!(whole("PFEC.GPatt.v1"), "$PFEC,GPatt,090.0,+05.0,+10.0");
    assert_eq!(whole("PFEC.GPatt"), "$PFEC,GPatt,090.0,+05.0,+10.0*45");
    assert_eq!(said("PRDID", &epoch()).unwrap(), "$PRDID,+005.00,+010.00,090.00");
}

#[test]
fn pixse_has_port_up_bow_down_on_the_wire_and_upward_speed() {
    for side in [1.0, -1.0] {
        let told = leaned(side);
        let Sentence::Pixse(Pixse::Attitude { roll, pitch }) = read("PIXSE.ATITUD", &told) else {
            panic!()
        };
        check([roll, pitch, Some(90.0 * DEG)], side, 0.001 * DEG);
        let Sentence::Pixse(Pixse::Motion { surge: None, sway: None, heave }) =
            read("PIXSE.HEAVE_", &told)
        else {
            panic!()
        };
        near(heave, 1.25 * side, 0.001);
        let Sentence::Pixse(Pixse::Velocity { north, east, down }) = read("PIXSE.SPEED_", &told)
        else {
            panic!()
        };
        near(north, -0.5, 0.001);
        near(east, 5.0, 0.001);
        near(down, 0.25 * side, 0.001);
    }
    assert_eq!(said("PIXSE.ATITUD", &epoch()).unwrap(), "$PIXSE,ATITUD,10.000,-5.000");
    assert_eq!(said("PIXSE.SPEED_", &epoch()).unwrap(), "$PIXSE,SPEED_,5.000,-0.500,-0.250");
}

#[test]
fn the_whole_pixse_set_leaves_as_one_message_in_its_usual_order() {
    let utm = Utm::of(54.0 * DEG, 8.0 * DEG).unwrap();
    let lines = lines("PIXSE", &Manner::default(), &epoch());
    let stems: Vec<_> = lines.iter().map(|line| line[7..].split('*').next().unwrap()).collect();
    assert_eq!(
        stems,
        [
            "ATITUD,10.000,-5.000",
            "POSITI,54.00000000,8.00000000,3.500",
            "SPEED_,5.000,-0.500,-0.250",
            &format!("UTMWGS,U,32,{:.3},{:.3},3.500", utm.easting, utm.northing),
            "HEAVE_,,,1.250",
            "TIME__,030405.000000",
            "STDHRP,0.050,0.020,0.030",
            "STDPOS,0.80,0.60,1.50",
            "STDSPD,0.030,0.020,0.040",
            "ALGSTS,00003001,00000000",
            "STATUS,00000000,00000204",
            "HT_STS,EFF80001",
        ]
    );
    for line in lines {
        let Sentence::Pixse(pixse) = parsed(&line) else { panic!("{line}") };
        let single = said(&format!("PIXSE.{}", pixse.name()), &epoch()).unwrap();
        assert!(line.starts_with(&single), "{line} {single}");
    }
}

#[test]
fn every_kind_exists_and_its_place_is_where_its_readers_want_it() {
    let order: Vec<_> = MessageKind::all().map(MessageKind::name).collect();
    let place = |name: &str| order.iter().position(|own| *own == name).unwrap();
    for name in KINDS {
        assert_eq!(MessageKind::named(name).unwrap().talker(), None, "{name}");
    }
    for (name, _) in DIALECTS {
        assert!(place("VTG") < place(name) && place(name) < place("HDT"), "{name}");
    }
    assert!(place("PSXN.20") < place("PSXN.23"));
    assert!(place("HDT") < place("PHTRO") && place("HDT") < place("PIXSE"));
}

#[test]
fn psxn_tells_of_the_start_once_and_never_again() {
    let mut port = port(&["PSXN.21", "PSXN.23"], &Manner::default());
    let mut count = |epoch: &OutputEpoch| port.messages(epoch).len();
    let (begin, later) = (OutputEpoch::unknown(now()), epoch());
    assert_eq!([count(&begin), count(&later), count(&later)], [2, 1, 1]);
    assert_eq!(said("PSXN.21", &epoch()).unwrap(), "$PSXN,21,1");
}
