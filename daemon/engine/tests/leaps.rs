//! Receivers that leap while she aligns, when nobody compares the sensors yet.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Integrity, Mode, Party, Solution, earth};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::lies::{GnssLie, Grade, Lie, Suite, Told, Window, case, catalogue};
use nalgebra::Vector2;

/// What she says each second, and how far off she is, m.
type Seconds = Vec<(Solution, f64)>;

/// Sails the voyage of a kind for so many seconds; in a window its receiver is so far off, m.
fn sailed(kind: &str, (grade, suite): (Grade, Suite), off: f64, window: Window) -> Seconds {
    let kind = catalogue().iter().find(|it| it.name == kind).unwrap();
    let mut voyage = case(kind, grade, suite, 3).honest().unwrap();
    let lie = Lie::Gnss(GnssLie::Jump(Vector2::new(0.6 * off, -0.8 * off)));
    Told { lie, window }.spoil_by(&mut voyage, 1);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    let mut seconds = Vec::new();
    for received in voyage.received() {
        if received.message.time().as_seconds() > 900.0 {
            break;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            let Output::Solution(said) = output else { continue };
            let Ok(at) = voyage.truth.binary_search_by_key(&said.time, |row| row.time) else {
                continue;
            };
            let truth = voyage.truth[at].position;
            let apart = earth::ecef(&said.position).0 - earth::ecef(&truth).0;
            seconds.push((said, (earth::c_ne(&truth) * apart).xy().norm()));
        }
    }
    seconds
}

fn is_named(said: &Solution) -> bool {
    said.judgement.excluded.contains(Party::Gnss)
}

fn worst(seconds: &Seconds) -> f64 {
    seconds.iter().map(|(_, off)| *off).fold(0.0, f64::max)
}

/// Within so many seconds.
fn within(seconds: &Seconds, span: std::ops::Range<f64>) -> impl Iterator<Item = &(Solution, f64)> {
    seconds.iter().filter(move |(said, _)| span.contains(&said.time.as_seconds()))
}

#[test]
fn at_the_berth_it_is_left_out_and_she_stays_there() {
    let window = Window { from: 150.0, until: f64::INFINITY };
    let sensors = (Grade::Navigation, Suite::Log);
    let seconds = sailed("moored: gnss jump", sensors, 2000.0, window);
    assert!(within(&seconds, 160.0..900.0).all(|(said, _)| is_named(said)));
    assert!(worst(&seconds) < 20.0, "{} m", worst(&seconds));
}

#[test]
fn one_that_hears_reflections_for_a_while_is_heard_again() {
    let window = Window { from: 120.0, until: 140.0 };
    for (grade, off) in [(Grade::Navigation, 25.0), (Grade::Mems, 25.0), (Grade::Mems, 200.0)] {
        let seconds = sailed("moored: gnss jump", (grade, Suite::Log), off, window);
        assert!(within(&seconds, 130.0..138.0).all(|(said, _)| is_named(said)));
        assert!(within(&seconds, 260.0..900.0).all(|(said, _)| !is_named(said)), "{grade:?}");
        assert_eq!(seconds.last().unwrap().0.judgement.integrity, Integrity::Consistent);
        assert!(worst(&seconds) < 10.0, "{grade:?}: {} m", worst(&seconds));
    }
}

#[test]
fn before_a_heading_is_known_the_claims_cover_both_of_its_words() {
    let window = Window { from: 30.0, until: f64::INFINITY };
    for (grade, suite) in [(Grade::Mems, Suite::Gnss), (Grade::Navigation, Suite::Gnss)] {
        let seconds = sailed("berth: gnss jump", (grade, suite), 2000.0, window);
        for (said, off) in within(&seconds, 40.0..900.0) {
            let level = 5.0 * said.sigma.position.0.xy().norm();
            assert!(*off < level.max(10.0), "{grade:?}: {off} m of {level} m at {:?}", said.time);
        }
        let is_unproven = |(said, _): &(Solution, f64)| {
            said.judgement.integrity == Integrity::Unproven || is_named(said)
        };
        assert!(within(&seconds, 60.0..900.0).all(is_unproven));
        assert!(within(&seconds, 600.0..900.0).all(|(said, _)| said.mode != Mode::Fault));
    }
}
