use insd_base::satellites::RtkSilence;
use insd_base::{
    Attitude, Body, Geodetic, Integrity, Judgement, Mode, ModeReason, Motion, Ned, Party, Solution,
    SolutionSigma, SolutionSource, SourceReason, Stamp,
};
use insd_web::snapshot::Freshness;

use super::*;
use crate::clock::HostClock;

const SHIPPED: &str = include_str!("../../../../systemd/examples/simulated.toml");

fn showcase() -> Showcase {
    let clock = HostClock::start();
    let (hash, configuration) = (String::new(), None);
    let origin = Origin { clock, started: clock.now(), configuration, hash };
    let (publisher, _) = insd_web::channel();
    let config = Config::of_text(SHIPPED).unwrap();
    Showcase::new(publisher, Log::silent(), &config, origin)
}

/// A ship that navigates, at an instant; her IMU was heard last at another, s.
fn report(now: f64, heard: f64) -> Report {
    let system = UtcTime::from_nanos(1_800_000_000_000_000_000);
    let solution = Solution {
        time: Time::from_seconds(heard),
        position: Geodetic::from_degrees(53.5, 8.2, 40.0),
        velocity: Ned::new(5.0, 0.0, 0.0),
        attitude: Attitude { roll: 0.0, pitch: 0.0, heading: 1.0 },
        rate: Body::default(),
        sigma: SolutionSigma::default(),
        mode: Mode::Aided,
        judgement: insd_base::Judgement::default(),
        source: None,
        hidden: insd_base::Protection::default(),
    };
    let motion = Motion { solution, acceleration: None, covariance: None, current: None };
    Report {
        stamp: Stamp { monotonic: Time::from_seconds(now), system },
        utc: None,
        mode: Mode::Aided,
        motion: Some(motion),
        heave: None,
        alongside: None,
        alignment: None,
        alerts: Vec::new(),
        engines: Vec::new(),
        heard: Vec::new(),
        slow: None,
    }
}

#[test]
fn the_motion_says_whether_it_may_be_relied_on_and_who_is_left_out() {
    let mut showcase = showcase();
    let mut told = |integrity, position| {
        let mut report = report(1.0, 1.0);
        let solution = &mut report.motion.as_mut().unwrap().solution;
        let excluded = [Party::Log, Party::Gnss].into_iter().collect();
        solution.judgement = Judgement { integrity, excluded };
        solution.sigma.position = position;
        showcase.see(&report);
        showcase.shown.motion.clone().unwrap()
    };
    let vague = told(Integrity::Consistent, Ned::new(3.0, 4.0, 2.0));
    assert_eq!((vague.hpl_m, vague.vpl_m), (Some(27.5), Some(10.4)));
    assert_eq!(vague.integrity.as_deref(), Some("unavailable"));
    assert_eq!(vague.excluded, ["gnss", "log"]);
    let good = Ned::new(0.3, 0.4, 2.0);
    for (integrity, word) in [
        (Integrity::Consistent, Some("available")),
        (Integrity::Unproven, Some("unavailable")),
        (Integrity::Contradiction, Some("fault")),
        (Integrity::Unwatched, None),
    ] {
        assert_eq!(told(integrity, good).integrity.as_deref(), word);
    }
}

#[test]
fn what_the_position_lives_by_is_told_with_the_time_and_the_reason_of_its_last_change() {
    let mut showcase = showcase();
    let mut told = |event: Option<Event>, source| {
        let event = event.map(|event| Product::Engine(Output::Event(event)));
        event.iter().for_each(|product| showcase.hear(&Names::default(), product));
        let mut report = report(42.0, 42.0);
        report.utc = Some(report.stamp.system);
        report.motion.as_mut().unwrap().solution.source = source;
        showcase.see(&report);
        showcase.shown.motion.clone().unwrap().source
    };
    assert_eq!(told(None, None), None);
    // before its change was told it is known, and nothing else of it
    let own = told(None, Some(SolutionSource::Carrier)).unwrap();
    assert_eq!((own.name.as_str(), own.since_s, own.reason), ("carrier", None, None));
    let why = SourceReason::NoRtk(RtkSilence::BaseSilent);
    let (from, to) = (Some(SolutionSource::Rtk), SolutionSource::Carrier);
    let time = Time::from_seconds(40.0);
    let own = told(Some(Event::SourceChanged { time, from, to, why }), Some(to)).unwrap();
    assert_eq!(
        (own.since_s, own.reason.as_deref()),
        (Some(2.0), Some("nothing comes of the base"))
    );
    assert_eq!(own.changed_utc.as_deref(), Some("2027-01-15T07:59:58.000Z"));
    assert_eq!(own.text, "carrier phases");
}

#[test]
fn an_imu_that_falls_silent_and_comes_back_is_told_as_changes_of_the_mode() {
    let mut showcase = showcase();
    showcase.see(&report(0.5, 0.5));
    assert!(showcase.shown.modes.is_empty(), "the engine has not said a word yet");
    let (time, to, why) = (Time::from_seconds(1.0), Mode::Aided, ModeReason::GnssInUse);
    showcase.hear_event(&Event::ModeChanged { time, from: None, to, why });
    showcase.see(&report(10.0, 9.99));
    assert!(showcase.shown.after(0.0).is_navigating());
    for now in [10.3, 10.6, 10.9, 11.2] {
        showcase.see(&report(now, 10.0));
    }
    assert_eq!(showcase.shown.after(0.0).motion, None);
    assert_eq!(showcase.shown.motion.as_ref().unwrap().freshness, Freshness::Fresh);
    showcase.see(&report(12.0, 11.99));
    let told: Vec<(&str, f64)> =
        showcase.shown.modes.iter().map(|own| (own.to.as_str(), own.at_s)).collect();
    assert_eq!(told, [("aided", 1.0), ("standby", 10.0), ("aided", 12.0)]);
    assert_eq!(showcase.shown.modes[1].reason.as_deref(), Some("the IMU is silent"));
}
