//! Errors after a gap over what is claimed of them.

use insd_base::units::DEG;

use crate::voyages::{Way, scenario, watch};

/// Errors of one component over all gaps of one length.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Score {
    count: f64,
    square: f64,
    claimed: f64,
    outside: f64,
    worst: f64,
}

impl Score {
    fn add(&mut self, (error, sigma): (f64, f64)) {
        self.count += 1.0;
        self.square += error * error;
        self.claimed += sigma * sigma;
        self.outside += f64::from(u8::from(error.abs() > 2.0 * sigma));
        self.worst = self.worst.max(error.abs() / sigma);
    }

    fn ratio(&self) -> f64 {
        (self.square / self.claimed).sqrt()
    }

    fn covered(&self) -> f64 {
        1.0 - self.outside / self.count
    }
}

/// Solutions after gaps of each length: roll, pitch, heading.
fn campaign(
    way: Way,
    sea: u8,
    grade: &str,
    seeds: std::ops::Range<u64>,
    gaps: &[f64],
) -> Vec<[Score; 3]> {
    let mut scores = vec![[Score::default(); 3]; gaps.len()];
    for seed in seeds {
        let watched = watch(&scenario(way, sea, grade, 700.0), seed, 330.0, 7.3);
        for kept in &watched.kept {
            for (scores, gap) in scores.iter_mut().zip(gaps) {
                // what would be lost after the gap is refused, and that is right
                let Ok(after) = watched.resume(kept, *gap, 0.11) else { continue };
                let Some(errors) = after.solutions.last().and_then(|last| watched.errors(last))
                else {
                    continue;
                };
                for (score, error) in scores.iter_mut().zip(errors) {
                    score.add(error);
                }
            }
        }
    }
    scores
}

fn told(score: &Score) -> String {
    format!(
        "{:6.3} {:6.3} {:5.2} {:4.0}% {:4.1}",
        (score.square / score.count).sqrt() / DEG,
        (score.claimed / score.count).sqrt() / DEG,
        score.ratio(),
        100.0 * score.covered(),
        score.worst
    )
}

const GAPS: [f64; 6] = [0.2, 0.5, 1.0, 2.0, 5.0, 20.0];

#[test]
fn the_claims_after_a_gap_are_honest_and_not_silly() {
    let gaps = [0.5, 2.0, 5.0];
    for way in [Way::Steady, Way::Turning, Way::Moored] {
        for sea in [3, 5] {
            for (scores, gap) in campaign(way, sea, "navigation", 8..10, &gaps).iter().zip(gaps) {
                for (score, what) in scores.iter().zip(["roll", "pitch", "heading"]) {
                    let place = format!("{way:?} sea state {sea}, {gap} s, {what}: {score:?}");
                    // of 50 gaps, twelve a minute: fewer than that are independent
                    assert!((0.25..1.5).contains(&score.ratio()), "{place}");
                    assert!(score.covered() > 0.8 && score.worst < 6.0, "{place}");
                    assert!(score.count > 40.0, "{place}");
                }
            }
        }
    }
}

#[test]
#[ignore = "takes minutes: for the figures of docs/restart.md"]
fn the_campaign() {
    for grade in ["navigation", "mems"] {
        for way in [Way::Steady, Way::Turning, Way::Moored] {
            for sea in [3, 5] {
                for (scores, gap) in campaign(way, sea, grade, 1..5, &GAPS).iter().zip(GAPS) {
                    let text = scores.each_ref().map(told).join(" | ");
                    let (name, count) = (format!("{way:?}"), scores[0].count);
                    println!("{name:8} ss{sea} {grade:10} {gap:4.1} s n={count:3} | {text}");
                }
            }
        }
    }
}
