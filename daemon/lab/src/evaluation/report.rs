//! The report of `insd evaluate`, as a table for people and as JSON for programs.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use super::by_satellites::WithSatellites;
use super::component::Component;
use super::drift::Drift;
use super::errors::{EpochsLeftOut, VoyageErrors};
use super::evidence::Evidence;
use super::statistics::{Summary, summarise, summarise_horizontal};
use crate::table::{Align, Table, significant};

/// Key of the horizontal position beside the names of [`Component`].
pub(super) const HORIZONTAL: &str = "horizontal";

/// Scores of one solution. The field names are the keys of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct ErrorReport {
    /// File of solutions.
    pub nav: String,
    /// File of truth.
    pub truth: String,
    /// First epoch compared, s.
    pub from_s: f64,
    /// Last epoch compared, s.
    pub to_s: f64,
    /// Number of epochs compared.
    pub epochs: u64,
    /// Epochs that could not be compared, by reason.
    pub left_out: EpochsLeftOut,
    /// Faulty rows of the file of solutions.
    pub skipped_nav_rows: u64,
    /// Faulty rows of the file of truth.
    pub skipped_truth_rows: u64,
    /// Figures by component: `north`, `east`, `down`, `horizontal`, `velocity_north`,
    /// `velocity_east`, `velocity_down`, `roll`, `pitch`, `heading`; null where truth knows nothing.
    pub components: BTreeMap<&'static str, Option<Summary>>,
    /// Errors in each stretch without GNSS.
    pub outages: Vec<Drift>,
    /// The horizontal position by the number of satellites in use; no key where ranges never were.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub satellites: Vec<WithSatellites>,
    /// What the solution said of how far it may be relied on, against truth.
    pub evidence: Evidence,
}

/// Figures of all components and of the horizontal position.
pub(crate) fn summaries(errors: &VoyageErrors) -> BTreeMap<&'static str, Option<Summary>> {
    let each = Component::ALL.map(|c| (c.name(), summarise(&errors.epochs, c)));
    let mut all = BTreeMap::from(each);
    all.insert(HORIZONTAL, summarise_horizontal(&errors.epochs));
    all
}

/// Names of the rows of a table, in the order in which people look for them.
pub(super) fn row_order() -> Vec<&'static str> {
    let mut names = Component::ALL.map(Component::name).to_vec();
    names.insert(3, HORIZONTAL);
    names
}

impl ErrorReport {
    /// The report on a comparison. File names, skipped rows and satellites are filled in by the caller.
    #[must_use]
    pub fn new(errors: &VoyageErrors, outages: Vec<Drift>, evidence: Evidence) -> Self {
        let seconds = |epoch: Option<&super::EpochError>| {
            epoch.map_or(f64::NAN, |epoch| epoch.time.as_seconds())
        };
        ErrorReport {
            nav: String::new(),
            truth: String::new(),
            from_s: seconds(errors.epochs.first()),
            to_s: seconds(errors.epochs.last()),
            epochs: errors.epochs.len() as u64,
            left_out: errors.left_out,
            skipped_nav_rows: 0,
            skipped_truth_rows: 0,
            components: summaries(errors),
            outages,
            satellites: Vec::new(),
            evidence,
        }
    }

    fn component_table(&self) -> Table {
        let numbers =
            ["RMS", "95 %", "max", "mean", "claimed σ", "NEES", "≤1σ %", "≤2σ %", "≤3σ %"];
        let mut columns = vec![("error", Align::Left), ("unit", Align::Left)];
        columns.extend(numbers.map(|name| (name, Align::Right)));
        columns.push(("epochs", Align::Right));
        let mut table = Table::new(&columns);
        for name in row_order() {
            let mut row = vec![name.replace('_', " ")];
            match self.components.get(name).copied().flatten() {
                Some(summary) => row.extend(cells(&summary)),
                None => row.push("not in truth".to_owned()),
            }
            table.push(row);
        }
        table
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let mut note = |count: u64, text: &str| {
            if count > 0 {
                notes.push(format!("{count} {text}"));
            }
        };
        note(self.left_out.outside, "epochs left out: the other file does not reach there");
        note(self.left_out.in_gap, "epochs left out: gap in the other file");
        note(self.skipped_nav_rows, "faulty rows of the solution skipped");
        note(self.skipped_truth_rows, "faulty rows of truth skipped");
        for name in row_order() {
            if let Some(Some(summary)) = self.components.get(name) {
                let shown = name.replace('_', " ");
                note(summary.missing, &format!("epochs without true {shown}"));
                note(summary.without_claim, &format!("epochs without claim for {shown}"));
            }
        }
        notes
    }
}

fn cells(summary: &Summary) -> Vec<String> {
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    let mut cells = vec![summary.unit.to_string()];
    let lengths = [summary.rms, summary.p95, summary.max, summary.mean, summary.mean_sigma];
    cells.extend(lengths.map(|length| significant(length, 4)));
    cells.push(significant(summary.nees, 3));
    let coverages = [summary.coverage_1sigma, summary.coverage_2sigma, summary.coverage_3sigma];
    cells.extend(coverages.map(percent));
    cells.push(summary.count.to_string());
    cells
}

/// The outages of one voyage as a table.
fn outage_table(outages: &[Drift]) -> Table {
    let names =
        ["start s", "length s", "max horiz. m", "end horiz. m", "claimed σ m", "end heading deg"];
    let mut table = Table::new(&names.map(|name| (name, Align::Right)));
    for drift in outages {
        table.push(vec![
            significant(drift.start_s, 6),
            significant(drift.length_s, 4),
            significant(drift.max_horizontal_m, 4),
            significant(drift.end_horizontal_m, 4),
            significant(drift.end_sigma_m, 4),
            drift.end_heading_deg.map_or("-".to_owned(), |heading| significant(heading, 3)),
        ]);
    }
    table
}

impl fmt::Display for ErrorReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (epochs, from, to) = (self.epochs, self.from_s, self.to_s);
        writeln!(f, "{} against {}: {epochs} epochs, {from} s to {to} s\n", self.nav, self.truth)?;
        write!(f, "{}", self.component_table())?;
        if !self.outages.is_empty() {
            writeln!(f, "\nwithout GNSS")?;
            write!(f, "{}", outage_table(&self.outages))?;
        }
        if !self.satellites.is_empty() {
            writeln!(f, "\nhorizontal position by satellites in use")?;
            write!(f, "{}", WithSatellites::table(&self.satellites))?;
        }
        write!(f, "\n{}", self.evidence)?;
        let notes = self.notes();
        if !notes.is_empty() {
            writeln!(f)?;
        }
        notes.iter().try_for_each(|note| writeln!(f, "{note}"))
    }
}

#[cfg(test)]
mod tests {
    use super::super::errors::errors;
    use super::super::testing::{solution, truth};
    use super::*;
    use insd_base::Geodetic;
    use insd_drivers::recording::{FileReport, Rows};

    fn report(with_attitude: bool) -> ErrorReport {
        let point = Geodetic::from_degrees(1.0, 2.0, 3.0);
        let nav: Vec<_> = (0..10).map(|t| solution(f64::from(t), point)).collect();
        let mut true_rows: Vec<_> = (0..8).map(|t| truth(f64::from(t), point)).collect();
        if !with_attitude {
            true_rows.iter_mut().for_each(|row| row.attitude = None);
        }
        let found = errors(&nav, &true_rows, None);
        let file = Rows { rows: Vec::new(), report: FileReport::default(), columns: Vec::new() };
        let evidence = Evidence::new(&file, &found, None);
        ErrorReport::new(&found, Vec::new(), evidence)
    }

    #[test]
    fn the_table_shows_every_component_and_names_what_is_missing() {
        let text = report(false).to_string();
        for name in ["north", "horizontal", "velocity down"] {
            assert!(text.contains(name), "{text}");
        }
        assert!(text.contains("heading         not in truth"), "{text}");
    }

    #[test]
    fn json_has_a_null_where_truth_knows_nothing() {
        let json = serde_json::to_value(report(false)).unwrap();
        assert!(json["components"]["heading"].is_null());
        assert_eq!(json["components"]["east"]["unit"], "m");
        assert_eq!(json["epochs"], 8);
        let full = serde_json::to_value(report(true)).unwrap();
        assert_eq!(full["components"]["heading"]["rms"], 0.0);
    }
}
