//! The report of `insd campaign`: one scenario over many seeds.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;

use serde::Serialize;

use super::aligned::{self, AlignedEstimates, WorstHeading, WorstRun};
use super::alignment::RunAlignment;
use super::component::Unit;
use super::drift::Drift;
use super::instants::{self, AlignmentMoment, Instant, InstantEstimates};
use super::interval::{MeanOfRuns, shown};
use super::promises;
use super::report::row_order;
use super::run::{Run, Yardstick};
use super::statistics::{Summary, quantile};
use super::stored::{self, StoredEstimates, StoredFate};
use crate::table::{Align, Table, significant};

/// Outages of different runs that start within this of each other are the same one, s.
const SAME_OUTAGE: f64 = 30.0;

/// One component over all seeds.
#[derive(Clone, Debug, Serialize)]
pub struct ComponentEstimates {
    /// Unit of `rms` and `mean_sigma`.
    pub unit: Unit,
    /// Runs with figures of this component.
    pub runs: usize,
    /// Root mean square error.
    pub rms: MeanOfRuns,
    /// Mean claimed 1-sigma.
    pub mean_sigma: MeanOfRuns,
    /// Normalised estimation error squared per degree of freedom, over all epochs.
    pub nees: MeanOfRuns,
    /// Share of errors within the claimed 1-sigma.
    pub coverage_1sigma: MeanOfRuns,
    /// Share within 2 sigma.
    pub coverage_2sigma: MeanOfRuns,
    /// Share within 3 sigma.
    pub coverage_3sigma: MeanOfRuns,
}

/// One stretch without GNSS over all seeds.
#[derive(Clone, Debug, Serialize)]
pub struct OutageEstimates {
    /// Start in the first of the runs, s.
    pub start_s: f64,
    /// Length in the first of the runs, s.
    pub length_s: f64,
    /// Runs that have it.
    pub runs: usize,
    /// RMS over the runs of the horizontal error at the last epoch, m.
    pub end_horizontal_rms_m: MeanOfRuns,
    /// Median over the runs of the largest horizontal error, m.
    pub max_horizontal_median_m: f64,
    /// RMS of the claimed 1-sigma (radius) at the last epoch, m.
    pub end_sigma_rms_m: MeanOfRuns,
    /// RMS of the heading error at the last epoch, deg, if truth knows it.
    pub end_heading_rms_deg: Option<MeanOfRuns>,
}

/// A scenario over many seeds. The field names are the keys of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct CampaignReport {
    /// Name of the scenario.
    pub scenario: String,
    /// Seeds whose solution could be compared.
    pub seeds: Vec<u64>,
    /// Seeds without a single epoch to compare: the engine never gave a solution.
    pub silent_seeds: Vec<u64>,
    /// Seeds of the campaign that are not among these runs.
    pub missing_seeds: Vec<u64>,
    /// Epochs compared, all runs together.
    pub epochs: u64,
    /// Estimates by component, as in [`super::ErrorReport`]; null where no run has figures.
    pub components: BTreeMap<&'static str, Option<ComponentEstimates>>,
    /// Stretches without GNSS.
    pub outages: Vec<OutageEstimates>,
    /// The largest error of the heading over its claimed 1-sigma, of all runs.
    pub worst_heading: Option<WorstRun>,
    /// Roll, pitch and heading at some instants; empty unless asked for.
    pub instants: Vec<InstantEstimates>,
    /// Why the limit of the optimal filter is not among them.
    pub no_limit: Option<String>,
    /// When the heading was good; null unless instants are asked for.
    pub aligned: Option<AlignedEstimates>,
    /// What became of the stored states; null unless the voyages start from some.
    pub stored: Option<StoredEstimates>,
}

impl CampaignReport {
    /// Puts the runs together, all measured with the same yardstick if there is one. The result does
    /// not depend on their order.
    #[must_use]
    pub fn new(scenario: &str, mut runs: Vec<Run>, yardstick: Option<&Yardstick>) -> Self {
        runs.sort_by_key(|run| run.seed);
        let alignments: Vec<RunAlignment> = runs.iter().map(|run| run.alignment).collect();
        let said: Vec<_> = runs.iter_mut().map(|r| std::mem::take(&mut r.promises)).collect();
        let fates: Vec<StoredFate> = runs.iter().filter_map(|run| run.stored).collect();
        let (heard, silent): (Vec<Run>, Vec<Run>) = runs.into_iter().partition(|r| r.epochs > 0);
        let names = row_order().into_iter();
        CampaignReport {
            scenario: scenario.to_owned(),
            seeds: heard.iter().map(|run| run.seed).collect(),
            silent_seeds: silent.iter().map(|run| run.seed).collect(),
            missing_seeds: Vec::new(),
            epochs: heard.iter().map(|run| run.epochs).sum(),
            components: names.map(|name| (name, component(&heard, name))).collect(),
            outages: same_outages(&heard).iter().filter_map(|drifts| outage(drifts)).collect(),
            worst_heading: worst_run(&heard),
            instants: yardstick.map_or_else(Vec::new, |yardstick| at_instants(&heard, yardstick)),
            no_limit: yardstick.and_then(|yardstick| yardstick.no_limit.clone()),
            aligned: yardstick.map(|y| aligned::together(y.bar, &alignments, &said)),
            stored: stored::together(&fates),
        }
    }
}

impl CampaignReport {
    /// The same as a part of a campaign over these seeds.
    #[must_use]
    pub fn out_of(self, seeds: Range<u64>) -> Self {
        let there: BTreeSet<&u64> = self.seeds.iter().chain(&self.silent_seeds).collect();
        let missing_seeds = seeds.filter(|seed| !there.contains(seed)).collect();
        CampaignReport { missing_seeds, ..self }
    }

    /// Whether there were voyages and none gave a solution.
    #[must_use]
    pub fn is_silent(&self) -> bool {
        self.seeds.is_empty() && !self.silent_seeds.is_empty()
    }
}

fn worst_run(runs: &[Run]) -> Option<WorstRun> {
    let of_run = |run: &Run| Some(WorstRun { seed: run.seed, worst: run.worst_heading? });
    runs.iter().filter_map(of_run).max_by(|a, b| a.worst.ratio.total_cmp(&b.worst.ratio))
}

fn at_instants(runs: &[Run], yardstick: &Yardstick) -> Vec<InstantEstimates> {
    let at = |(index, instant): (usize, &Instant)| {
        let moments = runs.iter().filter_map(|run| run.moments.get(index).copied().flatten());
        instants::together(instant, &moments.collect::<Vec<AlignmentMoment>>())
    };
    yardstick.instants.iter().enumerate().filter_map(at).collect()
}

fn component(runs: &[Run], name: &str) -> Option<ComponentEstimates> {
    let summaries: Vec<Summary> =
        runs.iter().filter_map(|run| run.components.get(name).copied().flatten()).collect();
    let values = |pick: fn(&Summary) -> f64| -> Vec<f64> {
        summaries.iter().map(pick).filter(|value| value.is_finite()).collect()
    };
    let estimate = |pick| MeanOfRuns::from_runs(&values(pick)).map(|e| e.within(0.0, f64::MAX));
    let share = |pick| estimate(pick).map(|e| e.within(0.0, 1.0));
    Some(ComponentEstimates {
        unit: summaries.first()?.unit,
        runs: summaries.len(),
        rms: MeanOfRuns::of_rms(&values(|s| s.rms))?,
        mean_sigma: estimate(|s| s.mean_sigma)?,
        nees: estimate(|s| s.nees)?,
        coverage_1sigma: share(|s| s.coverage_1sigma)?,
        coverage_2sigma: share(|s| s.coverage_2sigma)?,
        coverage_3sigma: share(|s| s.coverage_3sigma)?,
    })
}

/// Outages of all runs, grouped by their start.
fn same_outages(runs: &[Run]) -> Vec<Vec<Drift>> {
    let mut groups: Vec<Vec<Drift>> = Vec::new();
    for drift in runs.iter().flat_map(|run| &run.outages) {
        let is_same =
            |group: &&mut Vec<Drift>| (group[0].start_s - drift.start_s).abs() <= SAME_OUTAGE;
        match groups.iter_mut().find(is_same) {
            Some(group) => group.push(*drift),
            None => groups.push(vec![*drift]),
        }
    }
    groups.sort_by(|a, b| a[0].start_s.total_cmp(&b[0].start_s));
    groups
}

fn outage(drifts: &[Drift]) -> Option<OutageEstimates> {
    let rms = |pick: fn(&Drift) -> Option<f64>| {
        MeanOfRuns::of_rms(&drifts.iter().filter_map(pick).collect::<Vec<f64>>())
    };
    let mut largest: Vec<f64> = drifts.iter().map(|drift| drift.max_horizontal_m).collect();
    largest.sort_by(f64::total_cmp);
    Some(OutageEstimates {
        start_s: drifts.first()?.start_s,
        length_s: drifts.first()?.length_s,
        runs: drifts.len(),
        end_horizontal_rms_m: rms(|drift| Some(drift.end_horizontal_m))?,
        max_horizontal_median_m: quantile(&largest, 0.5),
        end_sigma_rms_m: rms(|drift| Some(drift.end_sigma_m))?,
        end_heading_rms_deg: rms(|drift| drift.end_heading_deg),
    })
}

impl fmt::Display for CampaignReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (runs, epochs) = (self.seeds.len(), self.epochs);
        writeln!(
            f,
            "{}: {runs} seeds, {epochs} epochs; [95 % confidence over seeds]\n",
            self.scenario
        )?;
        write!(f, "{}", component_table(&self.components))?;
        if let Some(WorstRun { seed, worst: WorstHeading { ratio, at_s } }) = self.worst_heading {
            let ratio = significant(ratio, 3);
            writeln!(f, "\nworst heading: {ratio} claimed σ with seed {seed} at {at_s} s")?;
        }
        if !self.outages.is_empty() {
            writeln!(f, "\nwithout GNSS")?;
            write!(f, "{}", outage_table(&self.outages))?;
        }
        self.write_heading(f)?;
        if let Some(stored) = &self.stored {
            write!(f, "\n{}", stored::table(stored))?;
        }
        if !self.silent_seeds.is_empty() {
            writeln!(f, "\nno solution to compare with seeds {:?}", self.silent_seeds)?;
        }
        if !self.missing_seeds.is_empty() {
            let (count, which) = (self.missing_seeds.len(), ranges(&self.missing_seeds));
            writeln!(f, "\n{count} seeds of the campaign are missing: {which}")?;
        }
        Ok(())
    }
}

impl CampaignReport {
    /// The heading at the instants and the times of alignment.
    fn write_heading(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.instants.is_empty() {
            writeln!(f, "\nat instants, beside the limit of the optimal filter")?;
            write!(f, "{}", instants::table(&self.instants))?;
        }
        if let Some(why) = &self.no_limit {
            writeln!(f, "no limit: {why}")?;
        }
        if let Some(aligned) = &self.aligned {
            writeln!(f, "\nheading within {} deg", significant(aligned.bar_deg, 3))?;
            write!(f, "{}", aligned::table(aligned))?;
            if !aligned.promises.is_empty() {
                writeln!(f, "\nwhen the alignment said that it would be")?;
                write!(f, "{}", promises::table(&aligned.promises))?;
            }
        }
        Ok(())
    }
}

/// Sorted seeds in short: `3, 7..12`, where the last of a range is left out as on the command line.
fn ranges(seeds: &[u64]) -> String {
    let runs = seeds.chunk_by(|a, b| a + 1 == *b);
    let text = |run: &[u64]| match run {
        [first, .., last] => format!("{first}..{}", last + 1),
        _ => run.iter().map(u64::to_string).collect(),
    };
    runs.map(text).collect::<Vec<_>>().join(", ")
}

fn component_table(components: &BTreeMap<&'static str, Option<ComponentEstimates>>) -> Table {
    let names = ["RMS", "claimed σ", "NEES", "≤1σ %", "≤2σ %", "≤3σ %"];
    let mut columns = vec![("error", Align::Left), ("unit", Align::Left)];
    columns.extend(names.map(|name| (name, Align::Left)));
    let mut table = Table::new(&columns);
    for name in row_order() {
        let mut row = vec![name.replace('_', " ")];
        match components.get(name) {
            Some(Some(estimates)) => row.extend(cells(estimates)),
            _ => row.push("not in truth".to_owned()),
        }
        table.push(row);
    }
    table
}

fn cells(estimates: &ComponentEstimates) -> Vec<String> {
    let percent = |share: &MeanOfRuns| shown(share, |share| format!("{:.1}", 100.0 * share));
    let number = |estimate: &MeanOfRuns| shown(estimate, |value| significant(value, 3));
    vec![
        estimates.unit.to_string(),
        number(&estimates.rms),
        significant(estimates.mean_sigma.mean, 3),
        number(&estimates.nees),
        percent(&estimates.coverage_1sigma),
        percent(&estimates.coverage_2sigma),
        percent(&estimates.coverage_3sigma),
    ]
}

fn outage_table(outages: &[OutageEstimates]) -> Table {
    let mut columns = vec![("start s", Align::Right), ("length s", Align::Right)];
    columns.extend([("runs", Align::Right), ("median max m", Align::Right)]);
    let names = ["RMS at end m", "claimed σ m", "heading RMS at end deg"];
    columns.extend(names.map(|name| (name, Align::Left)));
    let mut table = Table::new(&columns);
    let number = |estimate: &MeanOfRuns| shown(estimate, |value| significant(value, 3));
    for outage in outages {
        let heading = outage.end_heading_rms_deg.as_ref();
        table.push(vec![
            significant(outage.start_s, 6),
            significant(outage.length_s, 4),
            outage.runs.to_string(),
            significant(outage.max_horizontal_median_m, 3),
            number(&outage.end_horizontal_rms_m),
            significant(outage.end_sigma_rms_m.mean, 3),
            heading.map_or("-".to_owned(), number),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::super::errors::{VoyageErrors, errors};
    use super::super::testing::{solution, truth};
    use super::*;
    use insd_base::Geodetic;

    fn run(seed: u64, north: f64, outages: Vec<Drift>) -> Run {
        let point = Geodetic::from_degrees(north / 110_574.0, 0.0, 0.0);
        let nav: Vec<_> = (0..10).map(|t| solution(f64::from(t), point)).collect();
        let still: Vec<_> = (0..10).map(|t| truth(f64::from(t), Geodetic::default())).collect();
        Run::new(seed, &errors(&nav, &still, None), outages)
    }

    fn drift(start_s: f64, end: f64) -> Drift {
        Drift {
            start_s,
            length_s: 60.0,
            max_horizontal_m: end,
            end_horizontal_m: end,
            end_sigma_m: 1.0,
            end_heading_deg: None,
        }
    }

    #[test]
    fn runs_are_put_together_in_order_of_their_seeds() {
        let make = |seeds: [u64; 3]| {
            let runs = seeds.map(|seed| run(seed, seed as f64, Vec::new()));
            serde_json::to_string(&CampaignReport::new("x", runs.to_vec(), None)).unwrap()
        };
        assert_eq!(make([1, 2, 3]), make([3, 1, 2]));
    }

    #[test]
    fn nees_over_seeds_is_the_mean_of_the_runs() {
        let report = CampaignReport::new("x", vec![run(0, 1.0, vec![]), run(1, 2.0, vec![])], None);
        let north = report.components["north"].as_ref().unwrap();
        assert!((north.nees.mean - 2.5).abs() < 0.01, "{north:?}");
        assert!(report.to_string().contains("north"));
    }

    #[test]
    fn outages_are_matched_by_their_start() {
        let runs = vec![
            run(0, 0.0, vec![drift(100.0, 3.0), drift(900.0, 7.0)]),
            run(1, 0.0, vec![drift(901.0, 1.0)]),
            run(2, 0.0, vec![drift(99.0, 4.0), drift(900.0, 5.0)]),
        ];
        let report = CampaignReport::new("x", runs, None);
        assert_eq!(report.outages.iter().map(|o| o.runs).collect::<Vec<_>>(), [2, 3]);
        let rms = report.outages[0].end_horizontal_rms_m.mean;
        assert!((rms - 12.5_f64.sqrt()).abs() < 1e-9);
        assert_eq!(report.outages[1].max_horizontal_median_m, 5.0);
    }

    #[test]
    fn the_heading_is_held_against_a_yardstick_if_there_is_one() {
        let instants = [(3.0, Some(0.005)), (99.0, Some(0.005))];
        let instants = instants.map(|(at, limit)| Instant { at, limit }).to_vec();
        let yardstick = Yardstick { instants, no_limit: None, bar: 0.02 };
        let nav: Vec<_> = (0..10).map(|t| solution(f64::from(t), Geodetic::default())).collect();
        let mut still: Vec<_> = (0..10).map(|t| truth(f64::from(t), Geodetic::default())).collect();
        still[4].attitude.as_mut().unwrap().heading = 0.03;
        let found = errors(&nav, &still, None);
        let run = |seed| Run::new(seed, &found, vec![]).measured(&found.epochs, &yardstick);
        let report = CampaignReport::new("x", vec![run(5), run(6)], Some(&yardstick));
        assert_eq!(report.instants.len(), 1, "there is no epoch at 99 s");
        assert!((report.instants[0].sigma_over_limit.unwrap() - 2.0).abs() < 1e-9);
        let aligned = report.aligned.as_ref().unwrap();
        assert_eq!((aligned.error.median_s, aligned.claim.max_s), (Some(5.0), Some(0.0)));
        let worst = report.worst_heading.unwrap().worst;
        assert!((worst.ratio - 3.0).abs() < 1e-9 && worst.at_s == 4.0);
        let text = report.to_string();
        assert!(text.contains("claim / limit") && text.contains("heading within 1.15 deg"));
    }

    #[test]
    fn a_seed_without_solution_is_told() {
        let silent = Run::new(9, &VoyageErrors::default(), Vec::new());
        let report = CampaignReport::new("x", vec![run(0, 0.0, vec![]), silent], None);
        assert_eq!((report.seeds.len(), report.silent_seeds.as_slice()), (1, &[9_u64][..]));
    }
}
