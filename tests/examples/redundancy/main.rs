//! Figures of several engines: how close sound ones are beside what they claim, and what they cost.
//!
//! `cargo run --release -p insd-tests --example redundancy -- [SEEDS]`; with 0 seeds only the cost.

#![allow(clippy::unwrap_used)] // a tool of the tests

use std::collections::BTreeMap;

use insd_engine::vote::{Apart, VoteEvent, differences};
use insd_tests::engines::Fleet;
use insd_tests::scenario;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// Numbers of scenarios and for how long each is sailed, s.
const VOYAGES: [(usize, f64); 14] = [
    (1, 1800.0),
    (2, 3600.0),
    (3, 3600.0),
    (4, 3600.0),
    (5, 3600.0),
    (6, 1460.0),
    (8, 1800.0),
    (9, 1800.0),
    (10, 1800.0),
    (12, 2100.0),
    (13, 1800.0),
    (16, 1800.0),
    (22, 1800.0),
    (23, 1800.0),
];

/// Greatest share of its limit of each quantity, and what the voter found, of one pair of sound engines.
#[derive(Clone, Debug, Default)]
struct Closeness {
    shares: BTreeMap<&'static str, f64>,
    disagreements: usize,
    switches: usize,
    found: Vec<String>,
}

fn sail(number: usize, seconds: f64, seed: u64) -> Closeness {
    let scenario = scenario(number).with_duration(seconds);
    let fleet = Fleet::new(&scenario, seed, &[[-12.0, 2.0, 0.5]]);
    let apart = Apart { mounting_std: 0.0, distance: 12.2 };
    let mut close = Closeness::default();
    fleet.watch(|at, said, found| {
        if let [Some(one), Some(other)] = [said[0].motion, said[1].motion]
            && one.solution.time == other.solution.time
        {
            for difference in differences(&one, &other, &apart) {
                let most = close.shares.entry(difference.quantity.as_str()).or_insert(0.0);
                *most = most.max(difference.share());
            }
        }
        for event in found {
            close.disagreements += usize::from(matches!(event, VoteEvent::Differ { .. }));
            close.switches += usize::from(matches!(event, VoteEvent::Switched { .. }));
            close.found.push(format!("{at:.1} {event:?}"));
        }
    });
    close
}

/// Length of the voyage on which the cost is measured, and how often, s.
const COSTLY: f64 = 900.0;
const TIMES: usize = 3;

/// Processor time of pipelines with one to three engines, from bytes to messages, on the same arrivals.
fn cost() {
    let sensors = [("[gnss]", "[gnss]\nrate_hz = 5.0\n[log]")];
    let scenario = insd_tests::variant(10, &sensors).with_duration(COSTLY);
    let mut fleet = Fleet::new(&scenario, 1, &[[-12.0, 2.0, 0.5], [3.0, -1.0, 2.0]]);
    let (arrivals, reception) = fleet.arrivals();
    let mut least = [f64::MAX; 3];
    for _ in 0..TIMES {
        for (count, least) in (1..).zip(&mut least) {
            fleet.engines = (0..count).collect();
            let before = processor_time();
            let log = fleet.sail_on(&arrivals, &reception);
            assert!(log.solutions.len() > 1000);
            *least = least.min(processor_time() - before);
        }
    }
    for (count, spent) in (1..).zip(least) {
        let an_hour = spent * 3600.0 / COSTLY;
        let ratio = spent / least[0];
        println!("{count} engines: {an_hour:.2} s for an hour at 100 Hz, {ratio:.2} times one");
    }
}

/// Processor time of this process so far, s.
fn processor_time() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap();
    // the second field is the program's name in brackets, and may hold spaces
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split(' ').collect();
    let ticks: u64 = fields[12..14].iter().map(|field| field.parse::<u64>().unwrap()).sum();
    ticks as f64 / rustix::param::clock_ticks_per_second() as f64
}

fn main() {
    cost();
    let seeds: u64 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(2);
    if seeds == 0 {
        return;
    }
    let runs: Vec<(usize, f64, u64)> = VOYAGES
        .iter()
        .flat_map(|(number, seconds)| (1..=seeds).map(|seed| (*number, *seconds, seed)))
        .collect();
    let hours: f64 = runs.iter().map(|(_, seconds, _)| seconds / 3600.0).sum();
    let all: Vec<((usize, f64, u64), Closeness)> =
        runs.into_par_iter().map(|run| (run, sail(run.0, run.1, run.2))).collect();
    for ((number, _, seed), close) in &all {
        let shares: Vec<String> =
            close.shares.iter().map(|(name, share)| format!("{name} {share:.2}")).collect();
        println!("s{number:02} seed {seed}: {}", shares.join(", "));
        for found in &close.found {
            println!("    {found}");
        }
    }
    let disagreements: usize = all.iter().map(|(_, close)| close.disagreements).sum();
    let switches: usize = all.iter().map(|(_, close)| close.switches).sum();
    println!("{hours:.1} h of pairs: {disagreements} disagreements, {switches} switches");
}
