//! Going alongside with docking aids on the quay and no satellites.

use insd_base::{
    Body, Event, Geodetic, Message, Party, RangingBeam, RangingLine, RangingReading, RangingTarget,
    RangingTurn, Received, Solution, Source, Time, Truth, Voyage, earth,
};
use insd_engine::EngineConfig;
use insd_lab::evaluation::Component;
use insd_simulator::{Scenario, simulate};
use insd_tests::sailing::{Logbook, Passage, sail_messages};
use insd_tests::scores::{Scores, dishonest, pooled};
use nalgebra::Vector3;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::figure;

/// Bow and stern of her side, where the beams of the heads ashore meet it, m.
const SIDE: [[f64; 3]; 2] = [[60.0, 11.0, 4.0], [-58.0, 11.0, 4.0]];
/// One reading of a laser, 1-sigma, m, and how well each end of the line is known.
const WHITE: f64 = 0.03;
const SURVEY: f64 = 0.03;
/// Satellites are gone from and to, s: she comes sideways to the quay and stops.
pub(crate) const GONE: [f64; 2] = [600.0, 660.0];
const SEEDS: std::ops::RangeInclusive<u64> = 1..=24;

/// The shipped berthing with a MEMS IMU, to a quay that runs east.
pub(crate) fn berthing() -> Scenario {
    let gone = format!(
        "grade = \"rtk\"\nrate_hz = 5.0\n[[gnss.outages]]\nwhen = {{ at_s = [{}] }}\nduration_s = {}\n",
        GONE[0],
        GONE[1] - GONE[0]
    );
    insd_tests::variant(
        6,
        &[
            ("heading_deg = 46.0", "heading_deg = 90.0"),
            ("grade = \"navigation\"", "grade = \"mems\""),
            ("grade = \"rtk\"\nrate_hz = 5.0\n", &gone),
        ],
    )
}

/// Normal numbers that are the same for a seed (Marsaglia's xorshift; Box and Muller).
pub(crate) struct Dice(u64);

impl Dice {
    /// What comes first of a small seed is small.
    pub(crate) fn new(seed: u64) -> Self {
        let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
        (0..20).for_each(|_| _ = dice.uniform());
        dice
    }

    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    pub(crate) fn normal(&mut self) -> f64 {
        let (a, b) = (self.uniform(), self.uniform());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }
}

fn place_of(truth: &Truth, lever: &[f64; 3]) -> Vector3<f64> {
    point(&truth.position, &truth.attitude.unwrap().c_nb(), lever)
}

fn point(place: &Geodetic, c_nb: &nalgebra::Matrix3<f64>, lever: &[f64; 3]) -> Vector3<f64> {
    earth::ecef(place).0 + earth::c_ne(place).transpose() * (c_nb * Vector3::from(*lever))
}

/// The two ends of a quay that runs east, 15 m to starboard of where she stops.
fn quay(voyage: &Voyage) -> [Geodetic; 2] {
    let last = voyage.truth.last().unwrap();
    let here = earth::ecef(&last.position).0;
    let c_en = earth::c_ne(&last.position).transpose();
    [-150.0, 150.0].map(|along| {
        earth::geodetic(&insd_base::Ecef(here + c_en * Vector3::new(-15.0, along, 0.0)))
    })
}

/// What two heads tell ten times a second, of a line whose ends are elsewhere than surveyed by so much across it, m. `wrong` is added to
/// a distance by its time and the number of the head.
fn readings(voyage: &Voyage, dice: &mut Dice, wrong: impl Fn(f64, usize) -> f64) -> Vec<Received> {
    let ends = quay(voyage);
    let off = [0, 1].map(|_| SURVEY * dice.normal());
    let (origin, c_ne) = (earth::ecef(&ends[0]).0, earth::c_ne(&ends[0]));
    let target = RangingTarget::Line(RangingLine {
        ends,
        water_right: false,
        std: SURVEY,
        beam: RangingBeam::Across,
    });
    let mut all = Vec::new();
    for truth in voyage.truth.iter().filter(|truth| truth.time.as_seconds() > 560.0) {
        for (head, lever) in SIDE.iter().enumerate() {
            // north of the line by its own north: 300 m of it bend by a micrometre
            let from_origin = c_ne * (place_of(truth, lever) - origin);
            let share = from_origin.y / 300.0;
            let line = off[0] * (1.0 - share) + off[1] * share;
            let seconds = truth.time.as_seconds();
            let reading = RangingReading {
                time: truth.time,
                mark: 1,
                target,
                lever: Body(Vector3::from(*lever)),
                distance: from_origin.x - line + WHITE * dice.normal() + wrong(seconds, head),
                std: WHITE,
            };
            all.push(Received {
                receipt: truth.time,
                source: Source::Ranging(head as u8),
                message: Message::Ranging(reading),
            });
        }
    }
    all
}

fn sail(voyage: &Voyage, rangings: Vec<Received>) -> Logbook {
    let mut all = voyage.received();
    all.extend(rangings);
    all.sort_by_key(|received| received.receipt);
    sail_messages(&EngineConfig::for_voyage(&voyage.header, 10.0), &all, 7)
}

/// Errors of bow and stern across the quay while satellites are gone, m.
fn across(solutions: &[Solution], truth: &[Truth]) -> Vec<f64> {
    let mut all = Vec::new();
    let mut rows = truth.iter().peekable();
    let within = |time: Time| (GONE[0]..=GONE[1]).contains(&time.as_seconds());
    for solution in solutions.iter().filter(|own| within(own.time)) {
        while rows.next_if(|row| row.time < solution.time).is_some() {}
        let Some(row) = rows.peek().filter(|row| row.time == solution.time) else { continue };
        for lever in &SIDE {
            let own = point(&solution.position, &solution.attitude.c_nb(), lever);
            all.push((earth::c_ne(&row.position) * (own - place_of(row, lever))).x);
        }
    }
    all
}

fn percentile_95(errors: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = errors.iter().map(|error| error.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    sizes[sizes.len() * 95 / 100]
}

/// Errors of bow and stern with lasers and without, and of the whole with them, of one seed.
fn alongside(seed: u64) -> (Vec<f64>, Vec<f64>, Scores) {
    let voyage = simulate(&berthing(), seed);
    let rangings = readings(&voyage, &mut Dice::new(seed), |_, _| 0.0);
    let count = rangings.len() as u64;
    let log = sail(&voyage, rangings);
    assert!(log.accepted("ranging") > count * 98 / 100, "{seed}: {:?}", log.counts.rejected);
    let with = across(&log.solutions, &voyage.truth);
    let without = across(&sail(&voyage, Vec::new()).solutions, &voyage.truth);
    (with, without, Passage { voyage, log }.scores_between(GONE[0], GONE[1]))
}

#[test]
fn two_lasers_on_the_quay_keep_bow_and_stern_within_a_decimetre_across_it_without_any_satellite() {
    let all: Vec<_> = SEEDS.into_par_iter().map(alongside).collect();
    let errors: Vec<f64> = all.iter().flat_map(|own| own.0.iter().copied()).collect();
    let alone: Vec<f64> = all.iter().flat_map(|own| own.1.iter().copied()).collect();
    let (with, without) = (percentile_95(&errors), percentile_95(&alone));
    figure!("across the quay, 95 %: {with:.3} m with lasers, {without:.3} m without");
    let scores: Vec<Scores> = all.into_iter().map(|(.., scores)| scores).collect();
    let components = [Component::North, Component::East, Component::Heading];
    for component in components {
        let own = pooled(&scores).of(component);
        figure!("{}: rms {:.4}, NEES {:.2}", component.name(), own.rms, own.nees);
    }
    assert!(errors.len() > 20_000 && with < 0.10, "{with} m of {}", errors.len());
    assert_eq!(dishonest(&scores, &components), Vec::<String>::new());
}

#[test]
fn a_laser_that_meets_something_else_is_not_used_and_said_so_until_it_agrees_again() {
    let voyage = simulate(&berthing(), 3);
    let container = |time: f64, head: usize| {
        if head == 0 && (570.0..590.0).contains(&time) { -2.4 } else { 0.0 }
    };
    let log = sail(&voyage, readings(&voyage, &mut Dice::new(5), container));
    let turns: Vec<_> = log
        .events
        .iter()
        .filter_map(|event| match event {
            Event::RangingJudged { time, ranging, turn } => {
                Some((time.as_seconds().round(), *ranging, *turn))
            }
            _ => None,
        })
        .collect();
    let expected = [(572.0, 0, RangingTurn::Contradicted), (595.0, 0, RangingTurn::Agrees)];
    assert_eq!(turns, expected);
    assert!(percentile_95(&across(&log.solutions, &voyage.truth)) < 0.10);
}

/// When somebody is named first, and whether he is to the end, with docking aids that lie so.
fn named(seed: u64, wrong: impl Fn(f64, usize) -> f64) -> (f64, bool) {
    let voyage = simulate(&berthing(), seed);
    let log = sail(&voyage, readings(&voyage, &mut Dice::new(seed), wrong));
    let is_out = |own: &Solution| own.judgement.excluded.contains(Party::Docking);
    let first = log.solutions.iter().position(is_out).unwrap();
    let at = log.solutions[first].time.as_seconds();
    let mut all = log.solutions.iter().flat_map(|own| own.judgement.excluded.iter());
    assert!(all.all(|party| party == Party::Docking), "{seed}");
    // she is made fast at 660 s, and nobody compares them from then on
    let mut before = log.solutions[first..].iter().take_while(|own| own.time.as_seconds() < 655.0);
    (at, before.all(is_out))
}

#[test]
fn a_laser_whose_zero_or_whose_line_is_wrong_is_named_within_ten_seconds_and_for_good() {
    for seed in [1, 2] {
        for heads in [1, 2] {
            let (at, lasts) = named(seed, |_, head| if head < heads { 5.0 } else { 0.0 });
            assert!(at < 571.0 && lasts, "{seed}, {heads} heads: {at} s, {lasts}");
        }
    }
}

#[test]
fn a_laser_that_jumps_or_drifts_is_named_within_ten_seconds_and_not_heard_again_without_satellites()
{
    let since = 580.0;
    let lies: [fn(f64) -> f64; 2] = [|_| 2.0, |age| 0.05 * age];
    for lie in lies {
        let wrong = |time: f64, head| {
            if head == 0 && time >= since { lie(time - since) } else { 0.0 }
        };
        let (at, lasts) = named(2, wrong);
        assert!((since..since + 10.0).contains(&at) && lasts, "{at} s, {lasts}");
    }
}
