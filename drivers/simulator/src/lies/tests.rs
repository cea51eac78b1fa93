use std::collections::BTreeMap;

use super::*;

/// Everything that is told before an instant.
fn before(voyage: &Voyage, from: f64) -> (usize, Vec<f64>) {
    let is_early = |time: Time| time.as_seconds() < from;
    let imu = voyage.imu.iter().filter(|sample| is_early(sample.message.time));
    let told = imu.map(|sample| sample.message.delta_theta.0.sum()).collect();
    let others = voyage.gnss.iter().filter(|fix| is_early(fix.message.time)).count()
        + voyage.log.iter().filter(|log| is_early(log.message.time)).count()
        + voyage.reference.iter().filter(|told| is_early(told.message.time)).count();
    (others, told)
}

#[test]
fn every_kind_spoils_something_and_nothing_before_its_time() {
    let mut honest: BTreeMap<Suite, Voyage> = BTreeMap::new();
    for kind in catalogue() {
        for suite in kind.suites {
            let case = case(kind, Grade::Navigation, *suite, 3);
            let voyage = honest.entry(*suite).or_insert_with(|| case.honest().expect("a scenario"));
            let spoilt = case.spoilt(voyage);
            assert!(spoilt != *voyage, "{} changes nothing: {}", kind.name, case.size);
            let first = case.told.iter().map(|told| told.window.from).fold(f64::INFINITY, f64::min);
            assert_eq!(before(&spoilt, first), before(voyage, first), "{}", kind.name);
        }
    }
}

#[test]
fn the_same_seed_draws_the_same_case() {
    for kind in catalogue() {
        let draw = |seed| case(kind, Grade::Mems, kind.suites[0], seed);
        assert_eq!(draw(1).told, draw(1).told, "{}", kind.name);
        assert!(draw(1).told != draw(2).told, "{}", kind.name);
    }
}

#[test]
fn what_is_asked_depends_on_what_the_others_can_show() {
    let jump = catalogue().iter().find(|kind| kind.name == "gnss jump").expect("there is one");
    let classes = |suite| {
        let all = (1..=20).map(|seed| case(jump, Grade::Navigation, suite, seed));
        all.map(|case| case.class).collect::<Vec<_>>()
    };
    assert!(classes(Suite::Gnss).contains(&Class::Told));
    assert!(classes(Suite::Log).contains(&Class::Required));
    assert!(!classes(Suite::Gnss).contains(&Class::Required));
}

#[test]
fn a_mirrored_compass_is_shown_in_a_turn_only() {
    let mirrored =
        catalogue().iter().find(|kind| kind.name == "compass mirrored").expect("there is one");
    let case = case(mirrored, Grade::Navigation, Suite::Compass, 62);
    let honest = case.honest().expect("a scenario");
    let (from, spoilt) = (case.told[0].window.from, case.spoilt(&honest));
    let shown = case.shown_in(&honest, &spoilt).shown_at.expect("she turns");
    let heading_at = |time: f64| {
        let row = honest.truth.iter().find(|row| row.time.as_seconds() >= time);
        row.and_then(|row| row.attitude).expect("a row").heading
    };
    assert!(shown > from + 60.0, "goes straight: {from} s, {shown} s");
    let turned = insd_base::units::wrap_pi(heading_at(shown + 60.0) - heading_at(from)).abs();
    assert!(turned > 0.1, "{turned} rad");
}
