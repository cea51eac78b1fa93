//! Berthing, lying at the berth, starting under way.

use insd_base::Mode;
use insd_lab::evaluation::Component;
use insd_tests::sailing::sail_all;
use insd_tests::scenario;
use insd_tests::scores::{Scores, dishonest, pooled};

use super::figure;

#[test]
fn s06_a_berthing_with_centimetre_gnss_is_followed_to_centimetres() {
    let passages = sail_all(&scenario(6), 0..3);
    let scores: Vec<Scores> = passages.iter().map(|p| p.scores_from(500.0)).collect();
    let all = pooled(&scores);
    figure!("s06 {:?} {:?}", all.horizontal(), all.of(Component::Heading));
    assert!(all.horizontal().rms < 0.05, "{:?}", all.horizontal());
    assert!(all.of(Component::VelocityNorth).rms < 0.02);
    assert!(all.of(Component::VelocityEast).rms < 0.02);
    assert!(all.of(Component::Heading).rms < 0.5, "{:?}", all.of(Component::Heading));
    assert_eq!(dishonest(&scores, &Component::ALL), Vec::<String>::new());
}

#[test]
fn s07_a_moored_ship_finds_her_heading_and_is_honest_about_it() {
    let passages = sail_all(&scenario(7), 0..4);
    let scores: Vec<Scores> = passages.iter().map(|p| p.scores_from(1700.0)).collect();
    let heading = pooled(&scores).of(Component::Heading);
    figure!("s07 {heading:?} {:?}", passages[0].log.mode_at(1799.0));
    assert!(heading.rms < 0.15, "{heading:?}");
    assert!(heading.mean_sigma < 0.15, "{heading:?}");
    let attitude = [Component::Roll, Component::Pitch, Component::Heading];
    assert_eq!(dishonest(&scores, &attitude), Vec::<String>::new());
    for passage in &passages {
        assert_eq!(passage.log.mode_at(60.0), Some(Mode::FineAlignment));
        let end = passage.log.solutions.last().unwrap().mode;
        assert!(end == Mode::FineAlignment || end.is_navigating(), "{end:?}");
    }
}

#[test]
fn s10_restarted_under_way_the_heading_is_found_from_gnss_and_motion() {
    let passages = sail_all(&scenario(10).with_duration(1200.0), 0..4);
    let scores: Vec<Scores> = passages.iter().map(|p| p.scores_from(900.0)).collect();
    let all = pooled(&scores);
    figure!("s10 {:?} {:?}", all.horizontal(), all.of(Component::Heading));
    assert!(all.of(Component::Heading).rms < 0.5, "{:?}", all.of(Component::Heading));
    assert_eq!(dishonest(&scores, &Component::ALL), Vec::<String>::new());
    let early: Vec<Scores> = passages.iter().map(|p| p.scores_between(15.0, 60.0)).collect();
    assert_eq!(dishonest(&early, &Component::ALL), Vec::<String>::new());
    for passage in &passages {
        assert_eq!(passage.log.mode_at(900.0), Some(Mode::Aided));
    }
}
