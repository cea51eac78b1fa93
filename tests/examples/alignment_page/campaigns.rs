//! Many voyages with every method.

use std::fmt::Write as _;
use std::ops::Range;

use insd_alignment::{AlignmentConfig, InMotion};
use insd_base::Voyage;
use insd_base::alignment::{ACCURACY, heading_target};
use insd_base::units::DEG;
use insd_lab::evaluation::{Component, EpochError, alignment, errors, mean};
use insd_lab::table::significant;
use insd_nav::berth::Method;
use insd_simulator::{Scenario, limit, simulate};
use insd_tests::sailing::sail_aligned;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::svg::{Axis, Panel, Series};

const SEEDS: Range<u64> = 1..25;
/// When the heading is looked at, s.
pub(crate) const INSTANTS: [f64; 4] = [300.0, 600.0, 900.0, 1800.0];
/// Every so many seconds of a voyage are drawn.
const DRAWN: usize = 4;

/// The errors of one method, by voyage.
pub(crate) struct Campaign {
    /// How it is chosen.
    pub(crate) name: &'static str,
    pub(crate) runs: Vec<Vec<EpochError>>,
}

/// One scenario with every method.
pub(crate) struct Comparison {
    pub(crate) label: &'static str,
    pub(crate) scenario: Scenario,
    pub(crate) campaigns: Vec<Campaign>,
}

/// Every method at the berth.
pub(crate) fn moored(label: &'static str, scenario: Scenario) -> Comparison {
    let choices = Method::ALL
        .map(|moored| (moored.as_str(), AlignmentConfig { moored, ..AlignmentConfig::default() }));
    compare(label, scenario, &choices)
}

/// Every method under way.
pub(crate) fn in_motion(label: &'static str, scenario: Scenario) -> Comparison {
    let choices = InMotion::ALL.map(|in_motion| {
        (in_motion.as_str(), AlignmentConfig { in_motion, ..AlignmentConfig::default() })
    });
    compare(label, scenario, &choices)
}

fn compare(
    label: &'static str,
    scenario: Scenario,
    choices: &[(&'static str, AlignmentConfig)],
) -> Comparison {
    let seeds: Vec<u64> = SEEDS.collect();
    let of_seed = |seed: u64| -> Vec<Vec<EpochError>> {
        let voyage = simulate(&scenario, seed);
        choices.iter().map(|(_, choice)| sail(&voyage, choice)).collect()
    };
    let by_seed: Vec<Vec<Vec<EpochError>>> = seeds.into_par_iter().map(of_seed).collect();
    let campaign = |(index, (name, _)): (usize, &(&'static str, AlignmentConfig))| Campaign {
        name,
        runs: by_seed.iter().map(|methods| methods[index].clone()).collect(),
    };
    let campaigns = choices.iter().enumerate().map(campaign).collect();
    Comparison { label, scenario, campaigns }
}

fn sail(voyage: &Voyage, choice: &AlignmentConfig) -> Vec<EpochError> {
    let log = sail_aligned(voyage, choice);
    errors(&log.solutions, &voyage.truth, None).epochs
}

impl Campaign {
    /// Error and claimed sigma of the heading at an instant, deg, by voyage.
    fn at(&self, instant: f64) -> Vec<(f64, f64)> {
        let found = self.runs.iter().filter_map(|run| {
            let epoch = run.iter().find(|epoch| epoch.time.as_seconds() >= instant - 0.5)?;
            let error = epoch.of(Component::Heading)?;
            Some((error / DEG, epoch.sigma_of(Component::Heading) / DEG))
        });
        found.collect()
    }

    /// RMS of the heading at an instant, deg.
    pub(crate) fn rms(&self, instant: f64) -> f64 {
        mean(self.at(instant).iter().map(|(error, _)| error * error)).sqrt()
    }

    /// Mean of (error / claimed sigma)^2 of the heading over all epochs of all voyages from 60 s on.
    fn nees(&self) -> f64 {
        let epochs = self.runs.iter().flatten().filter(|epoch| epoch.time.as_seconds() >= 60.0);
        let heading = Component::Heading;
        mean(epochs.filter_map(|e| Some((e.of(heading)? / e.sigma_of(heading)).powi(2))))
    }

    /// When the error is below `bar`, rad, for good: the middle voyage; and how many never are. When
    /// all claim to be.
    fn aligned(&self, bar: f64) -> [String; 3] {
        let times: Vec<_> = self.runs.iter().map(|run| alignment(run, bar)).collect();
        let sorted = |pick: fn(&insd_lab::evaluation::RunAlignment) -> Option<f64>| {
            let mut sorted: Vec<f64> =
                times.iter().map(|time| pick(time).unwrap_or(f64::INFINITY)).collect();
            sorted.sort_by(f64::total_cmp);
            sorted
        };
        let (error, claim) = (sorted(|time| time.error), sorted(|time| time.claim));
        let text = |at: Option<&f64>| match at {
            Some(at) if at.is_finite() => format!("{at:.0}"),
            _ => "never".to_owned(),
        };
        let nine_tenths = error.len() * 9 / 10;
        [text(error.get(error.len() / 2)), text(error.get(nine_tenths)), text(claim.last())]
    }
}

impl Comparison {
    /// The limit of the heading at some instants, deg, if it is known.
    fn limits(&self, at: &[f64]) -> Vec<Option<f64>> {
        match limit(&self.scenario, at) {
            Ok(limits) => limits.iter().map(|limit| Some(limit.heading / DEG)).collect(),
            Err(_) => vec![None; at.len()],
        }
    }

    /// Rows of the table of figures.
    pub(crate) fn rows(&self, instants: &[f64]) -> String {
        let bar = heading_target(ACCURACY, self.scenario.start_latitude());
        let mut rows = String::new();
        for campaign in &self.campaigns {
            let rms = instants.iter().map(|at| significant(campaign.rms(*at), 2));
            let [middle, most, claim] = campaign.aligned(bar);
            // writing to a String cannot fail
            let _ = writeln!(
                rows,
                "| {} | `{}` | {} | {:.2} | {middle} | {most} | {claim} |",
                self.label,
                campaign.name,
                rms.collect::<Vec<String>>().join(" | "),
                campaign.nees(),
            );
        }
        let limits = self.limits(instants).into_iter();
        let limits = limits.map(|limit| limit.map_or("?".to_owned(), |deg| significant(deg, 2)));
        let limits = limits.collect::<Vec<String>>().join(" | ");
        let _ = writeln!(rows, "| {} | *limit* | {limits} | 1 | | | |", self.label);
        rows
    }

    /// Error and claim of one voyage, a panel for each method.
    pub(crate) fn voyage(&self, run: usize, classes: &[&'static str]) -> Vec<Panel> {
        let panel = |(campaign, class): (&Campaign, &&'static str)| {
            let of = |pick: fn(&EpochError) -> Option<f64>| -> Vec<(f64, f64)> {
                let epochs = campaign.runs[run].iter().step_by(DRAWN);
                epochs.filter_map(|e| Some((e.time.as_seconds() / 60.0, pick(e)? / DEG))).collect()
            };
            let three = |e: &EpochError| Some(3.0 * e.sigma_of(Component::Heading));
            let error =
                |e: &EpochError| e.of(Component::Heading).map(|error| error.abs().max(1e-9));
            Panel {
                title: campaign.name.to_owned(),
                x: Axis::linear("time, min", 0.0, 30.0, 5.0),
                y: Axis::log("heading error, deg", 0.003, 100.0, &[0.01, 0.1, 1.0, 10.0, 100.0]),
                series: vec![
                    Series { class: "band", label: "within claimed 3\u{3c3}", points: of(three) },
                    Series { class, label: "|error|", points: of(error) },
                ],
            }
        };
        self.campaigns.iter().zip(classes).map(panel).collect()
    }

    /// RMS of every method over time beside the limit, from one value to another, deg.
    pub(crate) fn rms_panel(&self, classes: &[&'static str], scale: (f64, f64)) -> Panel {
        let (first, last) = (30.0_f64, 1800.0_f64);
        let instants: Vec<f64> =
            (0..=80).map(|i| (first * (last / first).powf(f64::from(i) / 80.0)).round()).collect();
        let mut series: Vec<Series> = self
            .campaigns
            .iter()
            .zip(classes)
            .map(|(campaign, class)| {
                let points = instants.iter().map(|at| (*at, campaign.rms(*at))).collect();
                Series { class, label: campaign.name, points }
            })
            .collect();
        let limits = instants.iter().zip(self.limits(&instants));
        let points = limits.filter_map(|(at, limit)| Some((*at, limit?))).collect();
        series.push(Series { class: "grey dashed", label: "limit", points });
        let marks = |scale: (f64, f64)| -> Vec<f64> {
            let powers = [0.01, 0.1, 1.0, 10.0, 100.0].into_iter();
            powers.filter(|mark| (scale.0..=scale.1).contains(mark)).collect()
        };
        Panel {
            title: self.label.to_owned(),
            x: Axis::log("time, s", first, last, &[30.0, 60.0, 120.0, 300.0, 600.0, 1800.0]),
            y: Axis::log("RMS heading error, deg", scale.0, scale.1, &marks(scale)),
            series,
        }
    }
}
