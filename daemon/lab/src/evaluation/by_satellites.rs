//! The error of the position by the number of satellites whose ranges are in use.

use std::collections::BTreeMap;

use insd_drivers::recording::NavRow;
use serde::Serialize;

use super::errors::{EpochError, VoyageErrors};
use super::statistics::{Summary, summarise_horizontal};
use crate::table::{Align, Table, significant};

/// What the horizontal position is worth with so many satellites.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WithSatellites {
    /// Of how many satellites the ranges are in use.
    pub satellites: u32,
    /// The horizontal position meanwhile.
    #[serde(flatten)]
    pub horizontal: Summary,
}

/// The epochs with each number of satellites, as the newest row of the solution tells it. Those of which it tells none are left out.
#[must_use]
pub fn by_satellites(nav: &[NavRow], errors: &VoyageErrors) -> BTreeMap<u32, Vec<EpochError>> {
    let mut rows: Vec<_> = nav.iter().map(|row| (row.solution.time, row.satellites)).collect();
    rows.sort_by_key(|(time, _)| *time);
    let mut all: BTreeMap<u32, Vec<EpochError>> = BTreeMap::new();
    for epoch in &errors.epochs {
        let behind = rows.partition_point(|(time, _)| *time <= epoch.time);
        if let Some((_, Some(count))) = behind.checked_sub(1).map(|newest| rows[newest]) {
            all.entry(count).or_default().push(*epoch);
        }
    }
    all
}

impl WithSatellites {
    /// The figures with each number of satellites, the fewest first; none where ranges were never in use.
    #[must_use]
    pub fn all(nav: &[NavRow], errors: &VoyageErrors) -> Vec<Self> {
        let of = |(satellites, epochs): (u32, Vec<EpochError>)| {
            summarise_horizontal(&epochs).map(|horizontal| Self { satellites, horizontal })
        };
        by_satellites(nav, errors).into_iter().filter_map(of).collect()
    }

    /// All of them as a table.
    pub(super) fn table(all: &[Self]) -> Table {
        let names = ["satellites", "RMS m", "95 % m", "max m", "claimed σ m", "NEES", "epochs"];
        let mut table = Table::new(&names.map(|name| (name, Align::Right)));
        for Self { satellites, horizontal } in all {
            let lengths = [horizontal.rms, horizontal.p95, horizontal.max, horizontal.mean_sigma];
            let mut row = vec![satellites.to_string()];
            row.extend(lengths.map(|length| significant(length, 4)));
            row.extend([significant(horizontal.nees, 3), horizontal.count.to_string()]);
            table.push(row);
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use insd_base::Geodetic;

    use super::super::errors::errors;
    use super::super::testing::{solution, truth};
    use super::*;

    fn row(seconds: f64, east: f64, satellites: Option<u32>) -> NavRow {
        NavRow {
            solution: solution(seconds, Geodetic::from_degrees(0.0, east / 111_319.5, 0.0)),
            horizontal_level: None,
            vertical_level: None,
            integrity: None,
            excluded: Vec::new(),
            satellites,
        }
    }

    fn scored(nav: &[NavRow], step: f64) -> Vec<WithSatellites> {
        let truth: Vec<_> =
            (0..100).map(|at| truth(f64::from(at) * step, Geodetic::default())).collect();
        let solutions: Vec<_> = nav.iter().map(|row| row.solution).collect();
        WithSatellites::all(nav, &errors(&solutions, &truth, None))
    }

    #[test]
    fn errors_are_told_by_the_number_of_satellites_of_their_time() {
        let number = |at: i32| match at {
            0..2 => None,
            2..8 => Some(9),
            _ => Some(3),
        };
        let off = |at: i32| if at < 8 { 1.0 } else { 4.0 };
        let mut nav: Vec<_> = (0..12).map(|at| row(f64::from(at), off(at), number(at))).collect();
        nav.reverse();
        let all = scored(&nav, 0.5);
        let counts: Vec<_> = all.iter().map(|own| (own.satellites, own.horizontal.count)).collect();
        assert_eq!(counts, [(3, 4), (9, 6)]);
        assert!((all[0].horizontal.rms - 4.0).abs() < 1e-3, "{all:?}");
        assert!((all[1].horizontal.rms - 1.0).abs() < 1e-3, "{all:?}");
        let table = WithSatellites::table(&all).to_string();
        assert_eq!(table.lines().count(), 3, "{table}");
    }

    #[test]
    fn between_rows_the_newest_one_tells_the_number() {
        let nav: Vec<_> =
            (0..40).map(|at| row(f64::from(at) * 0.1, 1.0, Some(u32::from(at >= 10)))).collect();
        let counts: Vec<_> =
            scored(&nav, 0.55).iter().map(|own| (own.satellites, own.horizontal.count)).collect();
        assert_eq!(counts, [(0, 2), (1, 6)]);
    }

    #[test]
    fn where_ranges_were_never_in_use_there_is_nothing_to_tell() {
        let nav: Vec<_> = (0..12).map(|at| row(f64::from(at), 1.0, None)).collect();
        assert_eq!(scored(&nav, 0.5), []);
    }
}
