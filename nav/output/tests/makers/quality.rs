//! What makers' sentences say of quality, what they leave empty, and when they are silent.

use insd_base::units::DEG;
use insd_base::{
    Attitude, Body, FixQuality, Geodetic, Heave, HeaveQuality, Mode, Ned, SolutionSigma,
};
use insd_output::{Manner, OutputEpoch, Policy};
use insd_wire::nmea::{
    OctansStatus, PashrDialect, PhoctState, Pixse, PixseAlgorithmStatus, PixseHighLevelStatus,
    PixseSystemStatus, Psxn, PsxnQuality, Sentence,
};

use proptest::prelude::*;
use std::f64::consts::TAU;

use crate::ship::*;

/// Quality and status of PASHR.
fn pashr(name: &str, epoch: &OutputEpoch) -> (Option<u8>, Option<u8>) {
    let Sentence::Pashr(pashr) = read(name, epoch) else { panic!("{name}") };
    (pashr.quality_digit, pashr.status_digit)
}

fn precise(mode: Mode) -> OutputEpoch {
    with(|ship| {
        ship.sigma.position = Ned::new(0.01, 0.01, 0.01);
        ship.mode = mode;
    })
}

#[test]
fn the_quality_of_pashr_is_that_of_the_position_as_far_as_its_dialect_goes() {
    let of = |epoch: &OutputEpoch| {
        [
            "PASHR.sbg",
            "PASHR.sbg_wassp",
            "PASHR.ixblue",
            "PASHR.novatel",
            "PASHR.trimble",
            "PASHR.applanix",
        ]
        .map(|name| pashr(name, epoch).0.unwrap())
    };
    assert_eq!(of(&epoch()), [1, 1, 1, 1, 2, 1]);
    assert_eq!(of(&precise(Mode::Aided)), [2, 2, 1, 2, 4, 1]);
    for mode in [Mode::DeadReckoning, Mode::Inertial, Mode::FineAlignment] {
        assert_eq!(of(&precise(mode)), [0, 0, 0, 0, 6, 0], "{mode:?}");
    }
    let nothing = [lost(), in_mode(Mode::Fault), OutputEpoch::unknown(now())];
    let adrift = with(|ship| {
        ship.sigma.position = Ned::new(90.0, 90.0, 1.0);
        ship.mode = Mode::DeadReckoning;
    });
    for epoch in nothing.iter().chain([&adrift]) {
        assert_eq!(of(epoch), [0; 6], "{epoch:?}");
    }
}

#[test]
fn a_port_that_calls_dead_reckoning_good_does_not_call_it_gnss_in_pashr() {
    let policy = Policy { estimated_without_gnss: false, ..Policy::default() };
    let manner = Manner { policy, ..Manner::default() };
    for mode in [Mode::DeadReckoning, Mode::FineAlignment] {
        let line = said_by(&manner, "PASHR.sbg", &precise(mode)).unwrap();
        assert!(line.ends_with(",0,0"), "{line}");
    }
}

#[test]
fn the_status_of_pashr_follows_from_the_mode() {
    let trimble = MODES.map(|mode| pashr("PASHR.trimble", &in_mode(mode)).1.unwrap());
    assert_eq!(trimble, [1, 2, 2, 4, 2, 2, 0]);
    let sbg = MODES.map(|mode| pashr("PASHR.sbg", &in_mode(mode)).1.unwrap());
    assert_eq!(sbg, [0, 0, 0, 0, 0, 0, 1]);
    assert_eq!(pashr("PASHR.sbg", &OutputEpoch::unknown(now())).1, Some(1));
    assert_eq!(pashr("PASHR.novatel", &epoch()).1, None);
}

#[test]
fn pashr_tells_an_error_only_of_what_it_tells() {
    let tail = |epoch: &OutputEpoch| {
        let line = said("PASHR.sbg", epoch).unwrap();
        line.split_once(",T,").unwrap().1.to_owned()
    };
    assert_eq!(tail(&not_level()), ",,-001.25,,,0.050,1,0");
    assert_eq!(tail(&bad_heading()), "+010.00,+005.00,-001.25,0.020,0.030,,1,0");
    assert_eq!(tail(&heaving(HeaveQuality::Unsettled)), "+010.00,+005.00,,0.020,0.030,0.050,1,0");
    assert!(tail(&heaving(HeaveQuality::Reduced)).contains(",-001.25,"));
    let Sentence::Pashr(pashr) = read("PASHR.sbg", &lost()) else { panic!() };
    assert_eq!(pashr.quality(PashrDialect::Sbg), Some(FixQuality::Invalid));
}

#[test]
fn psxn_20_tells_the_quality_of_psxn_23() {
    use PsxnQuality::{Invalid, Normal, Reduced};
    let normal = [Normal; 4];
    let [first, second, third, _] = normal;
    for (epoch, expected) in [
        (epoch(), normal),
        (in_mode(Mode::DeadReckoning), [Reduced, second, third, Normal]),
        (in_mode(Mode::Inertial), [Reduced, second, third, Normal]),
        (lost(), [Invalid, second, third, Normal]),
        (
            with(|ship| ship.sigma.velocity = Ned::new(2.0, 0.0, 0.0)),
            [Invalid, second, third, Normal],
        ),
        (heaving(HeaveQuality::Reduced), [first, Reduced, third, Normal]),
        (heaving(HeaveQuality::Unsettled), [first, Invalid, third, Normal]),
        (OutputEpoch { heave: None, ..epoch() }, [first, Invalid, third, Normal]),
        (estimated_heading(), [first, second, Reduced, Normal]),
        (bad_heading(), [first, second, Invalid, Normal]),
        (in_mode(Mode::FineAlignment), [Reduced, second, Invalid, Normal]),
        (not_level(), [first, second, third, Invalid]),
        (in_mode(Mode::Fault), [Invalid; 4]),
        (OutputEpoch::unknown(now()), [Invalid; 4]),
    ] {
        let Sentence::Psxn(Psxn::Quality { horizontal, height, heading, attitude }) =
            read("PSXN.20", &epoch)
        else {
            panic!()
        };
        let told = [horizontal, height, heading, attitude];
        assert_eq!(told, expected.map(Some), "{epoch:?}");
        let Sentence::Psxn(Psxn::Motion { roll, pitch, heading: angle, heave }) =
            read("PSXN.23", &epoch)
        else {
            panic!()
        };
        let marks = [height, heading, attitude, attitude];
        for (mark, value) in marks.into_iter().zip([heave, angle, roll, pitch]) {
            assert_eq!(mark == Some(Invalid), value.is_none(), "{epoch:?}");
        }
    }
}

#[test]
fn phinf_says_what_is_invalid_and_that_the_system_aligns() {
    use OctansStatus as Bit;
    let attitude = Bit::ATTITUDE_INVALID;
    let level = Bit::ROLL_INVALID | Bit::PITCH_INVALID | attitude;
    let heading = Bit::HEADING_INVALID | attitude;
    let unsettled = Bit::HEAVE_INITIALISATION;
    for (epoch, expected) in [
        (epoch(), Bit::default()),
        (estimated_heading(), Bit::default()),
        (bad_heading(), heading),
        (not_level(), level),
        (heaving(HeaveQuality::Unsettled), unsettled),
        (heaving(HeaveQuality::Reduced), Bit::default()),
        (OutputEpoch { heave: None, ..epoch() }, unsettled),
        (in_mode(Mode::CoarseAlignment), heading | Bit::ALIGNMENT),
        (in_mode(Mode::FineAlignment), heading | Bit::ALIGNMENT),
        (in_mode(Mode::InMotionAlignment), heading | Bit::ALIGNMENT),
        (in_mode(Mode::Inertial), Bit::default()),
        (in_mode(Mode::Fault), heading | level | unsettled),
        (OutputEpoch::unknown(now()), heading | level | unsettled),
    ] {
        let Sentence::Phinf(phinf) = read("PHINF", &epoch) else { panic!() };
        assert_eq!(phinf.octans(), Some(expected), "{epoch:?}");
    }
}

#[test]
fn phoct_marks_each_value() {
    let states = |epoch: &OutputEpoch| {
        let Sentence::Phoct(phoct) = read("PHOCT", epoch) else { panic!() };
        [phoct.heading.state, phoct.roll.state, phoct.pitch.state, phoct.heave.state]
    };
    use PhoctState::{Initialising, Invalid, Valid};
    assert_eq!(states(&bad_heading()), [Invalid, Valid, Valid, Valid]);
    assert_eq!(states(&not_level()), [Valid, Invalid, Invalid, Valid]);
    assert_eq!(states(&in_mode(Mode::FineAlignment)), [Initialising, Valid, Valid, Valid]);
    assert_eq!(states(&in_mode(Mode::Fault)), [Invalid; 4]);
    assert_eq!(states(&OutputEpoch::unknown(now())), [Invalid; 4]);
    let unsettled = heaving(HeaveQuality::Unsettled);
    assert_eq!(states(&unsettled), [Valid, Valid, Valid, Initialising]);
    let Sentence::Phoct(phoct) = read("PHOCT", &unsettled) else { panic!() };
    near(phoct.heave.value, 1.25, 0.001);
    assert_eq!(said("PHLIN", &unsettled).unwrap(), "$PHLIN,,,");
    let timeless = OutputEpoch { utc: None, ..epoch() };
    assert!(said("PHOCT", &timeless).unwrap().starts_with("$PHOCT,01,,E,,090.000,T,"));
}

fn algorithm(epoch: &OutputEpoch) -> PixseAlgorithmStatus {
    let Sentence::Pixse(Pixse::Algorithm(Some(status))) = read("PIXSE.ALGSTS", epoch) else {
        panic!()
    };
    status
}

fn system(epoch: &OutputEpoch) -> PixseSystemStatus {
    let Sentence::Pixse(Pixse::System(Some(status))) = read("PIXSE.STATUS", epoch) else {
        panic!()
    };
    status
}

fn high_level(epoch: &OutputEpoch) -> PixseHighLevelStatus {
    let Sentence::Pixse(Pixse::HighLevel(Some(status))) = read("PIXSE.HT_STS", epoch) else {
        panic!()
    };
    status
}

#[test]
fn algsts_says_what_the_filter_does() {
    use PixseAlgorithmStatus as Bit;
    let gps = Bit::GPS1_RECEIVED | Bit::GPS1_VALID;
    let adrift = Bit::NAVIGATION | Bit::DEAD_RECKONING;
    let expected = [
        Bit::ALIGNMENT,
        Bit::ALIGNMENT | Bit::FINE_ALIGNMENT | Bit::STATIC_ALIGNMENT,
        Bit::ALIGNMENT | gps,
        Bit::NAVIGATION | gps,
        adrift,
        adrift,
        Bit::HEAVE_INITIALISATION,
    ];
    for (mode, status) in MODES.into_iter().zip(expected) {
        assert_eq!(algorithm(&in_mode(mode)), status, "{mode:?}");
    }
    let settling = heaving(HeaveQuality::Unsettled);
    assert!(algorithm(&settling).has(Bit::HEAVE_INITIALISATION | Bit::NAVIGATION));
    assert_eq!(algorithm(&OutputEpoch::unknown(now())), Bit::HEAVE_INITIALISATION);
}

#[test]
fn status_says_what_is_detected_and_whether_the_attitude_is_valid() {
    use PixseSystemStatus as Bit;
    assert_eq!(system(&epoch()), Bit::GPS1_DETECTED | Bit::UTC_DETECTED);
    assert_eq!(system(&in_mode(Mode::Inertial)), Bit::UTC_DETECTED);
    assert_eq!(system(&OutputEpoch { utc: None, ..epoch() }), Bit::GPS1_DETECTED);
    for epoch in [not_level(), bad_heading(), in_mode(Mode::Fault), OutputEpoch::unknown(now())] {
        assert!(system(&epoch).has(Bit::ATTITUDE_INVALID), "{epoch:?}");
    }
}

#[test]
fn ht_sts_has_one_word_of_health_and_names_nothing_as_there_that_is_not_known_to_be() {
    use PixseHighLevelStatus as Bit;
    let health = |epoch: &OutputEpoch| Bit(high_level(epoch).0 & 0x3_FFFF);
    let by_mode = [
        Bit::ALIGNING,
        Bit::ALIGNING,
        Bit::ALIGNING,
        Bit::GOOD,
        Bit::WARNING,
        Bit::WARNING,
        Bit::ERROR,
    ];
    for (mode, expected) in MODES.into_iter().zip(by_mode) {
        assert_eq!(health(&in_mode(mode)), expected, "{mode:?}");
    }
    for epoch in [estimated_heading(), bad_heading(), not_level(), lost()] {
        assert_eq!(health(&epoch), Bit::WARNING, "{epoch:?}");
    }
    assert_eq!(health(&OutputEpoch::unknown(now())), Bit::ERROR);
    let absent = |epoch: &OutputEpoch| high_level(epoch).0 >> 18;
    assert_eq!(absent(&OutputEpoch::unknown(now())), 0x3FFF);
    assert!(!high_level(&epoch()).has(Bit::NO_GPS1) && !high_level(&epoch()).has(Bit::NO_UTC));
    assert!(high_level(&in_mode(Mode::DeadReckoning)).has(Bit::NO_GPS1));
}

#[test]
fn a_simulated_set_that_is_asked_for_says_so_in_its_status_words() {
    let manner = Manner { simulated: true, unmarked_when_simulated: true, ..Manner::default() };
    let word = |name| {
        let Sentence::Pixse(pixse) = parsed(&lines(name, &manner, &epoch())[0]) else { panic!() };
        pixse
    };
    let Pixse::Algorithm(Some(algorithm)) = word("PIXSE.ALGSTS") else { panic!() };
    assert!(algorithm.has(PixseAlgorithmStatus::EMULATION));
    let Pixse::System(Some(system)) = word("PIXSE.STATUS") else { panic!() };
    assert!(system.has(PixseSystemStatus::SIMULATION));
}

#[test]
fn where_nothing_is_known_nothing_is_zero() {
    let nothing = OutputEpoch::unknown(now());
    for (name, text) in [
        ("PASHR.sbg", "PASHR,,,T,,,,,,,0,1"),
        ("PASHR.sbg_wassp", "PASHR,,,T,,,,,,,0,1"),
        ("PASHR.ixblue", "PASHR,,,T,,,,,,,0,1"),
        ("PASHR.novatel", "PASHR,,,T,,,,,,,0"),
        ("PASHR.trimble", "PASHR,,,T,,,,,,,0,0"),
        ("PASHR.applanix", "PASHR,,,T,,,,,,,0,1"),
        ("PSXN.20", "PSXN,20,2,2,2,2"),
        ("PSXN.22", "PSXN,22,,"),
        ("PSXN.23", "PSXN,23,,,,"),
        ("PSXN.24", "PSXN,24,,,,"),
        ("PRDID", "PRDID,,,"),
        ("PFEC.GPatt", "PFEC,GPatt,,,"),
        ("PFEC.GPatt.v1", "PFEC,GPatt,,,"),
        ("PTNTHTM", "PTNTHTM,,L,,L,,L,,"),
        ("PHTRO", "PHTRO,,,,"),
        ("PHLIN", "PHLIN,,,"),
        ("PHSPD", "PHSPD,,,"),
        ("PHCMP", "PHCMP,,,,"),
        ("PHINF", "PHINF,0800000F"),
        ("PHOCT", "PHOCT,01,,E,,,E,,E,,E,,E,,,,,,,"),
        ("PIXSE.ATITUD", "PIXSE,ATITUD,,"),
        ("PIXSE.POSITI", "PIXSE,POSITI,,,"),
        ("PIXSE.SPEED_", "PIXSE,SPEED_,,,"),
        ("PIXSE.UTMWGS", "PIXSE,UTMWGS,,,,,"),
        ("PIXSE.HEAVE_", "PIXSE,HEAVE_,,,"),
        ("PIXSE.TIME__", "PIXSE,TIME__,"),
        ("PIXSE.STDHRP", "PIXSE,STDHRP,,,"),
        ("PIXSE.STDPOS", "PIXSE,STDPOS,,,"),
        ("PIXSE.STDSPD", "PIXSE,STDSPD,,,"),
        ("PIXSE.ALGSTS", "PIXSE,ALGSTS,80000000,00000000"),
        ("PIXSE.STATUS", "PIXSE,STATUS,00000000,00020000"),
        ("PIXSE.HT_STS", "PIXSE,HT_STS,FFFC0004"),
        ("PINSD.STA", "PINSD,STA,,S,,V,0,,U,0,,,,,"),
        ("PINSD.SIG", "PINSD,SIG,,,,,,,,,,,"),
        ("PINSD.PRO", "PINSD,PRO,,,,,,,N"),
    ] {
        assert_eq!(said(name, &nothing).unwrap(), format!("${text}"), "{name}");
    }
    assert_eq!(said("PINSD.ALI", &nothing), None);
}

#[test]
fn what_is_beyond_the_policy_is_empty() {
    for (name, epoch, text) in [
        ("PRDID", not_level(), "PRDID,,,090.00"),
        ("PRDID", bad_heading(), "PRDID,+005.00,+010.00,"),
        ("PFEC.GPatt", not_level(), "PFEC,GPatt,090.0,,"),
        ("PTNTHTM", not_level(), "PTNTHTM,90.00,N,,L,,L,,"),
        ("PTNTHTM", bad_heading(), "PTNTHTM,,L,5.00,N,10.00,N,,"),
        ("PHTRO", not_level(), "PHTRO,,,,"),
        ("PHSPD", heaving(HeaveQuality::Unsettled), "PHSPD,,,"),
        ("PHCMP", lost(), "PHCMP,,,,"),
        ("PIXSE.ATITUD", not_level(), "PIXSE,ATITUD,,"),
        ("PIXSE.STDHRP", not_level(), "PIXSE,STDHRP,0.050,,"),
        ("PIXSE.STDHRP", bad_heading(), "PIXSE,STDHRP,,0.020,0.030"),
        ("PIXSE.POSITI", lost(), "PIXSE,POSITI,,,"),
        ("PIXSE.UTMWGS", lost(), "PIXSE,UTMWGS,,,,,"),
        ("PIXSE.STDPOS", lost(), "PIXSE,STDPOS,,,"),
        ("PIXSE.SPEED_", lost(), "PIXSE,SPEED_,,,"),
        ("PIXSE.STDSPD", lost(), "PIXSE,STDSPD,,,"),
        ("PIXSE.HEAVE_", heaving(HeaveQuality::Unsettled), "PIXSE,HEAVE_,,,"),
        ("PIXSE.TIME__", OutputEpoch { utc: None, ..epoch() }, "PIXSE,TIME__,"),
        ("PSXN.24", not_level(), "PSXN,24,,,,-0.50"),
        ("PSXN.24", heaving(HeaveQuality::Unsettled), "PSXN,24,1.00,2.00,3.00,"),
    ] {
        assert_eq!(said(name, &epoch).unwrap(), format!("${text}"), "{name}");
    }
    let without_geoid = OutputEpoch { geoid: None, ..epoch() };
    let place = said("PIXSE.POSITI", &without_geoid).unwrap();
    assert_eq!(place, "$PIXSE,POSITI,54.00000000,8.00000000,4.310", "by EGM96 it is 39.19 m");
}

#[test]
fn nothing_but_our_own_status_comes_from_a_simulator_unless_it_is_asked_for() {
    let manner = Manner { simulated: true, ..Manner::default() };
    for name in KINDS.into_iter().filter(|name| *name != "PINSD.STA") {
        for mode in MODES {
            assert_eq!(lines(name, &manner, &in_mode(mode)), [""; 0], "{name}");
        }
        let open = Manner { unmarked_when_simulated: true, ..manner.clone() };
        let bits = ["PIXSE", "PIXSE.ALGSTS", "PIXSE.STATUS"].contains(&name);
        let same = lines(name, &open, &epoch()) == lines(name, &Manner::default(), &epoch());
        assert_eq!(same, !bits, "{name}");
    }
}

proptest! {
    #[test]
    fn whatever_is_known_every_sentence_is_readable(
        values in prop::array::uniform16(prop_oneof![4 => -4.0..4.0, 1 => any::<f64>()]),
        mode in 0..7_usize, good: bool,
    ) {
        let [lat, lon, height, vn, ve, vd, roll, pitch, heading, wx, wy, wz, a, b, c, d] = values;
        // an attitude is within half a turn, or no number of any sense
        let halved = |angle: f64| if angle.abs() < TAU { angle / 2.0 } else { angle };
        let [roll, pitch] = [roll, pitch].map(halved);
        let mut told = with(|ship| {
            ship.position = Geodetic { latitude: lat, longitude: lon, height };
            ship.velocity = Ned::new(vn, ve, vd);
            ship.attitude = Attitude { roll, pitch, heading };
            ship.rate = Body::new(wx, wy, wz);
            ship.mode = MODES[mode];
            if !good {
                let sigma = Ned::new(d, c, b);
                ship.sigma =
                    SolutionSigma { position: sigma, velocity: sigma, roll: a, pitch: b, heading: d };
            }
        });
        told.covariance_north_east = Some(c);
        told.heave = told.heave.map(|heave| Heave { heave: a, rate: b, sigma: c, ..heave });
        for name in KINDS {
            let mut port = port(&[name], &Manner::default());
            for message in port.messages(&told) {
                let text = String::from_utf8(message.content.to_bytes()).unwrap();
                for line in text.split_terminator("\r\n") {
                    parsed(line);
                }
            }
        }
    }

    #[test]
    fn no_message_of_a_ship_is_longer_than_it_is_planned_for(
        place in (-1.5..1.5_f64, -3.1..3.1_f64, -900.0..900.0_f64),
        velocity in prop::array::uniform3(-30.0..30.0_f64),
        attitude in (-3.1..3.1_f64, -1.5..1.5_f64, 0.0..6.2_f64),
        rates in prop::array::uniform3(-99.9..99.9_f64), heave in prop::array::uniform2(-99.0..99.0),
        sigma in prop::array::uniform3(0.0..0.008_f64), side in -60.0..60.0_f64,
    ) {
        let mut told = with(|ship| {
            ship.position = Geodetic { latitude: place.0, longitude: place.1, height: place.2 };
            ship.velocity = Ned(velocity.into());
            ship.attitude = Attitude { roll: attitude.0, pitch: attitude.1, heading: attitude.2 };
            ship.rate = Body((rates.map(|rate| rate * DEG)).into());
            ship.sigma.position = Ned::new(side.abs(), side.abs(), 900.0);
            [ship.sigma.roll, ship.sigma.pitch, ship.sigma.heading] = sigma;
        });
        told.heave = told.heave.map(|old| Heave { heave: heave[0], rate: heave[1], ..old });
        for name in KINDS {
            lines(name, &Manner::default(), &told);
        }
    }
}
