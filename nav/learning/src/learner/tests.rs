use nalgebra::{Rotation2, Vector2};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::*;
use crate::kept::{KeptFault, KeptModel, REPEAT};

/// A log and a sea.
#[derive(Clone, Copy)]
struct Truth {
    scale: f64,
    slope: f64,
    turn: f64,
    slide: f64,
    current: f64,
    time: f64,
}

const REPEATS: Truth =
    Truth { scale: 0.015, slope: 0.0015, turn: 0.004, slide: -5.0, current: 0.15, time: 20_000.0 };
const NOTHING: Truth =
    Truth { scale: 0.0, slope: 0.0, turn: 0.0, slide: 0.0, current: 0.15, time: 20_000.0 };

/// A ship that turns every few minutes and changes her speed now and then, and how she goes on.
struct Sea {
    rng: Pcg64,
    c: Vector2<f64>,
    heading: f64,
    at: u32,
}

impl Sea {
    fn new(seed: u64) -> Self {
        Sea { rng: Pcg64::seed_from_u64(seed), c: Vector2::new(0.1, -0.1), heading: 0.3, at: 0 }
    }

    fn noise(&mut self) -> Vector2<f64> {
        Vector2::from_fn(|_, _| StandardNormal.sample(&mut self.rng))
    }

    fn label(&mut self, truth: &Truth) -> Label {
        let left = (-30.0 / truth.time).exp();
        self.c = self.c * left + self.noise() * (truth.current * (1.0 - left * left).sqrt());
        let turn = match self.at % 16 {
            6..8 => 0.012,
            12..15 => -0.011,
            _ => 0.0,
        };
        self.heading += turn * 30.0;
        self.at += 1;
        let u = 4.0 + f64::from((self.at / 23) % 3) * 1.5;
        let across = truth.turn * u + truth.slide * turn;
        let repeats = Vector2::new(truth.scale * u + truth.slope * u * u, across);
        let beyond = repeats - Rotation2::new(-self.heading) * self.c + self.noise() * 0.012;
        Label {
            time: 30.0 * f64::from(self.at),
            told: Vector2::new(u, 0.0),
            beyond,
            variance: Vector2::repeat(0.012 * 0.012),
            bow: Vector2::new(self.heading.cos(), self.heading.sin()),
            turn,
        }
    }
}

fn sailed(truth: &Truth, labels: u32, seed: u64) -> Learner {
    let (mut sea, mut own) = (Sea::new(seed), Learner::default());
    for _ in 0..labels {
        own.hear(&sea.label(truth));
    }
    own
}

#[test]
fn what_repeats_is_found_beside_a_current_that_wanders() {
    let own = sailed(&REPEATS, 720, 1);
    let (found, std) = (own.model().values(), own.model().stds());
    let truth = [REPEATS.scale, REPEATS.slope, 0.0, REPEATS.turn, 0.0, REPEATS.slide];
    for i in 0..REPEAT {
        assert!((found[i] - truth[i]).abs() < 4.0 * std[i], "{i}: {found} {std}");
    }
    assert!(std[0] < 0.01 && std[5] < 0.5, "{std}");
    assert!(own.standing().is_used);
}

#[test]
fn how_a_current_goes_on_is_found_on_the_side_of_caution() {
    let current = sailed(&REPEATS, 720, 2).standing().current.unwrap();
    let walk = |std: f64, time: f64| std * std / time;
    let ratio = walk(current.std, current.time) / walk(REPEATS.current, REPEATS.time);
    assert!((0.5..8.0).contains(&ratio), "{current:?}");
}

#[test]
fn where_nothing_repeats_what_is_used_is_hardly_worse_than_nothing() {
    let (mut raw, mut ours) = ([0.0; 2], [0.0; 2]);
    for seed in 0..20 {
        let mut sea = Sea::new(seed);
        let mut own = Learner::default();
        for _ in 0..300 {
            own.hear(&sea.label(&NOTHING));
        }
        let was_used = own.standing().is_used;
        // twenty outages that the decision has not seen
        for _ in 0..60 {
            own.hear(&sea.label(&NOTHING));
        }
        let [without, with] = own.shadow().quantiles().unwrap();
        for i in 0..2 {
            raw[i] += without[i];
            ours[i] += if was_used { with[i] } else { without[i] };
        }
    }
    assert!(ours[0] < 1.1 * raw[0] && ours[1] < 1.1 * raw[1], "{ours:?} {raw:?}");
}

#[test]
fn a_log_that_fouled_overnight_is_found_to_be_another_within_ten_minutes() {
    let (mut sea, mut own) = (Sea::new(3), Learner::default());
    (0..400).for_each(|_| {
        own.hear(&sea.label(&REPEATS));
    });
    let fouled = Truth { scale: REPEATS.scale + 0.03, ..REPEATS };
    let words: Vec<_> = (0..20).map(|_| own.hear(&sea.label(&fouled))).collect();
    assert!(words.contains(&Some(LearnerVerdict::Changed)), "{words:?}");
    assert!(!own.standing().is_used && own.standing().current.is_none());
}

#[test]
fn what_is_kept_is_read_as_it_was_written_and_damage_is_found() {
    let own = sailed(&REPEATS, 400, 4);
    let model = KeptModel::new(own.kept(), None);
    let text = model.text();
    assert_eq!(KeptModel::parse(&text), Ok(model.clone()));
    assert!(text.len() < 65_536 && text == model.text());
    let next = Learner::after(&model.log);
    assert_eq!(next.kept().covariance, model.log.covariance);
    assert_eq!(next.standing(), own.standing());
    let changed = text.replace("voyages = 1", "voyages = 9");
    assert_eq!(KeptModel::parse(&changed), Err(KeptFault::Checksum));
    assert_eq!(KeptModel::parse("hello"), Err(KeptFault::NotAModel));
    for cut in 0..text.len() - 1 {
        assert!(KeptModel::parse(&text[..cut]).is_err(), "{cut}");
    }
}

#[test]
fn the_same_labels_make_the_same_learner() {
    assert_eq!(sailed(&REPEATS, 100, 5), sailed(&REPEATS, 100, 5));
}

/// A learner that knows the log of an earlier voyage, and what it says on the next one, half an hour of legs, where the log is another.
fn next_voyage(truth: &Truth, seed: u64) -> (Vec<Option<LearnerVerdict>>, Learner) {
    let before = sailed(&REPEATS, 480, seed);
    assert!(before.standing().is_used, "{seed}");
    let mut own = Learner::after(&before.kept());
    // another day, another current
    let mut sea = Sea { c: Vector2::new(-0.12, 0.2), ..Sea::new(seed + 100) };
    let words = (0..60).map(|_| own.hear(&sea.label(truth))).collect();
    (words, own)
}

/// After how many labels it is told that the log is another, at the latest of ten voyages.
fn told_after(truth: &Truth) -> usize {
    let told = |seed| {
        let (words, _) = next_voyage(truth, seed);
        words.iter().position(|word| *word == Some(LearnerVerdict::Changed)).map_or(60, |at| at + 1)
    };
    (0..10).map(told).max().unwrap()
}

#[test]
fn after_a_night_a_log_that_fouled_or_was_exchanged_is_found_within_ten_minutes() {
    let fouled = Truth { scale: REPEATS.scale - 0.03, ..REPEATS };
    let exchanged = Truth { scale: -0.02, slope: -0.001, turn: -0.012, slide: 1.0, ..REPEATS };
    assert!(told_after(&fouled) <= 20);
    assert!(told_after(&exchanged) <= 20);
}

#[test]
fn one_that_was_turned_by_a_degree_is_found_within_twenty_minutes_of_small_turns() {
    assert!(told_after(&Truth { turn: REPEATS.turn + 0.01745, ..REPEATS }) <= 40);
}

#[test]
fn the_same_log_on_another_day_is_not_taken_for_another_whatever_the_current() {
    for (current, time) in [(0.15, 20_000.0), (0.3, 7200.0), (0.05, 40_000.0)] {
        for seed in 0..20 {
            let (words, _) = next_voyage(&Truth { current, time, ..REPEATS }, seed);
            assert!(!words.contains(&Some(LearnerVerdict::Changed)), "{seed} {current}");
        }
    }
}

#[test]
fn what_was_never_sailed_at_another_speed_or_in_a_turn_is_not_used() {
    let (mut sea, mut own) = (Sea::new(6), Learner::default());
    for _ in 0..200 {
        let label = sea.label(&REPEATS);
        own.hear(&Label { told: Vector2::new(6.0, 0.0), ..label });
    }
    assert!(!own.standing().is_used && own.standing().current.is_some());
}
