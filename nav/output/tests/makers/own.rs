//! What insd says in its own sentences.

use insd_base::units::DEG;
use insd_base::{
    FixQuality, HeaveQuality, Integrity, Judgement, Mode, Ned, Parties, Party, SolutionSource, Span,
};
use insd_output::{Manner, OutputEpoch, Policy};
use insd_wire::nmea::{
    HeadingMode, Pinsd, PinsdIntegrity, PinsdMode, PinsdProtection, PinsdSource, PinsdStatus,
    ProtectionState, Sentence,
};

use crate::ship::*;

fn status(manner: &Manner, epoch: &OutputEpoch) -> PinsdStatus {
    let line = lines("PINSD.STA", manner, epoch).remove(0);
    let Sentence::Pinsd(Pinsd::Status(status)) = parsed(&line) else { panic!("{line}") };
    status
}

fn protection(manner: &Manner, epoch: &OutputEpoch) -> PinsdProtection {
    let line = lines("PINSD.PRO", manner, epoch).remove(0);
    let Sentence::Pinsd(Pinsd::Protection(protection)) = parsed(&line) else { panic!("{line}") };
    protection
}

fn limited(alert_limit: f64) -> Manner {
    let policy = Policy { alert_limit: Some(alert_limit), ..Policy::default() };
    Manner { policy, ..Manner::default() }
}

/// Whose horizontal error has these sigmas and this covariance.
fn spread(north: f64, east: f64, covariance: Option<f64>) -> OutputEpoch {
    let told = with(|ship| ship.sigma.position = Ned::new(north, east, 1.5));
    OutputEpoch { covariance_north_east: covariance, ..told }
}

#[test]
fn each_sentence_is_to_the_byte_what_its_page_says() {
    for (name, text) in [
        ("PINSD.STA", "STA,030405.00,A,799,A,2,2,M,0,,A,N,,"),
        ("PINSD.SIG", "SIG,030405.00,0.80,0.60,1.50,0.020,0.030,0.040,0.020,0.030,0.050,0.04"),
        ("PINSD.ALI", "ALI,030405.00,F,1,0.500,0.170,6,0.040"),
        ("PINSD.PRO", "PRO,030405.00,1.75,3.84,6.63,5,,N"),
    ] {
        assert_eq!(said(name, &epoch()).unwrap(), format!("$PINSD,{text}"), "{name}");
    }
}

#[test]
fn the_status_says_what_the_position_lives_by_and_for_how_long() {
    let own = with(|ship| ship.source = Some(SolutionSource::Rtk));
    let since = Some(own.time + Span::from_seconds(-42.5));
    let told = status(&Manner::default(), &OutputEpoch { source_since: since, ..own });
    assert_eq!((told.source, told.seconds_of_source), (Some(PinsdSource::Rtk), Some(42)));
    let told = status(&Manner::default(), &epoch());
    assert_eq!((told.source, told.seconds_of_source), (None, None));
}

#[test]
fn levels_are_of_the_risk_that_is_asked_for() {
    let own = spread(0.8, 0.6, Some(0.0));
    let at = |risk_exponent| {
        let policy = Policy { risk_exponent, ..Policy::default() };
        protection(&Manner { policy, ..Manner::default() }, &own)
    };
    let told = [3, 5, 7].map(at);
    assert_eq!(told.map(|own| own.exponent), [Some(3), Some(5), Some(7)]);
    // without what the navigator adds, a level is never less than that of the usual risk
    let [lax, usual, strict] = told.map(|own| own.horizontal.unwrap());
    assert!((usual - 3.84).abs() < 0.01 && lax == usual, "{lax} {usual}");
    assert!((strict - 0.8 * (14.0 * std::f64::consts::LN_10).sqrt()).abs() < 0.01, "{strict}");
}

#[test]
fn the_status_says_mode_and_qualities_by_the_policy() {
    let status = |epoch: &OutputEpoch| status(&Manner::default(), epoch);
    for mode in MODES {
        assert_eq!(status(&in_mode(mode)).mode, PinsdMode::from(mode));
    }
    assert_eq!(status(&estimated_heading()).heading, HeadingMode::Estimated);
    assert_eq!(status(&bad_heading()).heading, HeadingMode::NotValid);
    assert_eq!(status(&in_mode(Mode::Inertial)).position, FixQuality::Estimated);
    assert_eq!(status(&lost()).position, FixQuality::Invalid);
    for quality in [HeaveQuality::Unsettled, HeaveQuality::Reduced, HeaveQuality::Settled] {
        assert_eq!(status(&heaving(quality)).heave, Some(quality));
    }
    assert_eq!(status(&in_mode(Mode::Fault)).heave, None);
}

#[test]
fn the_status_says_whether_the_sensors_bear_it_out_and_who_is_left_out() {
    for (integrity, said) in [
        (Integrity::Unwatched, PinsdIntegrity::Unwatched),
        (Integrity::Consistent, PinsdIntegrity::Agreed),
        (Integrity::Unproven, PinsdIntegrity::Unproven),
        (Integrity::Contradiction, PinsdIntegrity::Contradicted),
    ] {
        let excluded: Parties = [Party::Log, Party::Gnss].into_iter().collect();
        let told = with(|ship| ship.judgement = Judgement { integrity, excluded });
        let told = status(&Manner::default(), &told);
        assert_eq!((told.integrity, told.excluded), (Some(said), Some(excluded)));
    }
    let unknown = status(&Manner::default(), &OutputEpoch { solution: None, ..epoch() });
    assert_eq!((unknown.integrity, unknown.excluded), (None, None));
}

#[test]
fn a_simulated_status_is_marked_and_always_sent() {
    let manner = Manner { simulated: true, ..Manner::default() };
    let told = status(&manner, &epoch());
    assert_eq!((told.mode, told.simulated), (PinsdMode::Aided, true));
    assert_eq!((told.heading, told.position), (HeadingMode::Simulator, FixQuality::Simulated));
}

#[test]
fn errors_of_any_quality_are_told_but_not_those_of_a_fault() {
    let sigma = said("PINSD.SIG", &bad_heading()).unwrap();
    assert!(sigma.ends_with(",3.00,0.04"), "{sigma}");
    assert_eq!(said("PINSD.SIG", &in_mode(Mode::Fault)).unwrap(), "$PINSD,SIG,030405.00,,,,,,,,,,");
}

#[test]
fn a_round_error_of_a_metre_has_the_textbook_levels() {
    let told = protection(&Manner::default(), &spread(1.0, 1.0, Some(0.0)));
    near(told.radius_95, 2.45, 0.01);
    near(told.horizontal, 4.80, 0.01);
    near(told.vertical, 6.63, 0.01);
    assert_eq!((told.exponent, told.state), (Some(5), ProtectionState::Unknown));
}

#[test]
fn an_error_that_lies_across_is_told_along_its_own_axis() {
    // 3 m along 45 deg, 1 m across
    let told = protection(&Manner::default(), &spread(5.0_f64.sqrt(), 5.0_f64.sqrt(), Some(4.0)));
    near(told.horizontal, 3.0 * 4.7985, 0.01);
    near(told.radius_95, 3.0 * 1.9886, 0.01);
}

#[test]
fn without_the_covariance_the_levels_are_never_less() {
    for covariance in [-0.47, -0.2, 0.0, 0.2, 0.47] {
        let known = protection(&Manner::default(), &spread(0.8, 0.6, Some(covariance)));
        let bound = protection(&Manner::default(), &spread(0.8, 0.6, None));
        assert!(bound.horizontal >= known.horizontal && bound.radius_95 >= known.radius_95);
        assert_eq!(bound.vertical, known.vertical);
    }
}

#[test]
fn a_level_is_good_below_the_alert_limit_only() {
    let state = |limit: f64, epoch: &OutputEpoch| protection(&limited(limit), epoch).state;
    assert_eq!(state(4.0, &epoch()), ProtectionState::Below);
    assert_eq!(state(3.5, &epoch()), ProtectionState::Above);
    for unknown in [lost(), in_mode(Mode::Fault), OutputEpoch::unknown(now())] {
        let told = protection(&limited(10.0), &unknown);
        assert_eq!(told.state, ProtectionState::Unknown);
        assert_eq!([told.radius_95, told.horizontal, told.vertical], [None; 3]);
        assert_eq!((told.exponent, told.alert_limit), (None, Some(10.0)));
    }
    let adrift = with(|ship| {
        ship.sigma.position = Ned::new(f64::NAN, 1.0, 1.0);
        ship.sigma.heading = DEG;
    });
    assert_ne!(state(10.0, &adrift), ProtectionState::Below);
}

#[test]
fn the_alignment_is_told_while_there_is_one() {
    let none = OutputEpoch { alignment: None, ..epoch() };
    assert_eq!(said("PINSD.ALI", &none), None);
}
