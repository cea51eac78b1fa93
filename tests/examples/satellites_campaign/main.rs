//! Scenario 26 with many seeds: what three, two, one and no satellites and reflections cost, with fixes and with ranges. One table.
//!
//! ```text
//! cargo run --release -p insd-tests --example satellites_campaign -- target/release/insd 20 docs/satellites.md
//! ```
//!
//! The voyages are made in `target/satellites-campaign`, one after the other. Without a page the table is printed.

mod scores;

use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

use insd_tests::pages;
use insd_tests::programs::run;

use scores::{Score, score, segments, track};

const SCENARIO: &str = "26";
const HEAD: &str = "| satellites left | fixes, m | ranges, m | its worst seed | NEES | its worst seed | heading, deg |\n|---|---|---|---|---|---|---|\n";

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let program = arguments.next().ok_or("which insd? target/release/insd")?;
    let seeds: u64 = arguments.next().map_or(Ok(20), |seeds| seeds.parse())?;
    let folder = PathBuf::from("target/satellites-campaign");
    std::fs::create_dir_all(&folder)?;
    let mut all: BTreeMap<String, [Vec<Score>; 2]> = BTreeMap::new();
    for seed in 1..=seeds {
        sail(&program, &folder, seed, &mut all)?;
        let newest = |(label, scores): (&String, &[Vec<Score>; 2])| {
            scores[1].last().map_or(String::new(), |score| format!(" {label}: {:.2}", score.moved))
        };
        eprintln!("seed {seed} of {seeds}, m:{}", all.iter().map(newest).collect::<String>());
    }
    let rows = all.iter().rev().map(|(label, scores)| row(label, scores));
    let table = HEAD.to_owned() + &rows.collect::<String>();
    Ok(pages::put(arguments.next(), "satellites-campaign", &table)?)
}

/// Makes the voyage of a seed, replays it both ways and adds the scores of its segments by their labels.
fn sail(
    program: &str,
    folder: &Path,
    seed: u64,
    all: &mut BTreeMap<String, [Vec<Score>; 2]>,
) -> Result<(), Box<dyn Error>> {
    let dir = folder.join("voyage");
    run(Command::new(program)
        .args(["simulate", SCENARIO, "--seed", &seed.to_string(), "--out"])
        .arg(&dir))?;
    let truth = track(&dir.join("truth.csv"), false)?;
    for (way, gnss) in ["loose", "tight"].into_iter().enumerate() {
        let out = folder.join("nav.csv");
        run(Command::new(program)
            .arg("replay")
            .arg(&dir)
            .args(["--gnss", gnss, "--out"])
            .arg(&out))?;
        let solution = track(&out, true)?;
        for (label, span) in segments(&dir.join("truth.json"))? {
            if let Some(score) = score(&solution, &truth, span) {
                all.entry(label).or_default()[way].push(score);
            }
        }
    }
    Ok(())
}

fn row(label: &str, [fixes, ranges]: &[Vec<Score>; 2]) -> String {
    let together = |scores: &[Score], of: fn(&Score) -> f64| {
        let squares: f64 = scores.iter().map(|score| of(score).powi(2)).sum();
        (squares / scores.len() as f64).sqrt()
    };
    let worst = |of: fn(&Score) -> f64| ranges.iter().map(of).fold(0.0, f64::max);
    let nees = ranges.iter().map(|score| score.nees).sum::<f64>() / ranges.len() as f64;
    format!(
        "| {label} | {:.2} | {:.3} | {:.2} | {nees:.2} | {:.1} | {:.2} |\n",
        together(fixes, |score| score.moved),
        together(ranges, |score| score.moved),
        worst(|score| score.moved),
        worst(|score| score.nees),
        together(ranges, |score| score.heading),
    )
}
