//! How she came alongside.

use super::html::{Column, Table, number};
use crate::report::VoyageReport;

/// The section.
pub(super) fn berths(report: &VoyageReport) -> String {
    let (times, berths) = (&report.collected.times, &report.collected.berths);
    let mut table = Table::new(&[
        Column::Text("Berth"),
        Column::Text("Within 50 m since"),
        Column::Text("Nearest part"),
        Column::Text("When"),
        Column::Number("To the fenders, m"),
        Column::Number("1-sigma"),
        Column::Number("Level"),
        Column::Number("Fastest within 5 m, m/s"),
        Column::Number("1-sigma"),
    ]);
    for (name, own) in berths.approaches() {
        let (part, at, distance, level) = own.nearest;
        table.row([
            name.to_owned(),
            times.clock(own.since),
            part.as_str().to_owned(),
            times.clock(at),
            number(Some(distance.value), 2),
            number(Some(distance.sigma), 2),
            number(Some(level), 2),
            number(own.fastest.map(|(_, speed)| speed.value), 3),
            number(own.fastest.map(|(_, speed)| speed.sigma), 3),
        ]);
    }
    table.or("No part of her was told to be within 50 m of the fenders of a berth.")
}
