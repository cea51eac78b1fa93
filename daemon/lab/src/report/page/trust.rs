//! How far what was told could be relied on, and who was left out.

use insd_base::Time;

use super::html::{Column, Table, number};
use super::record::left_out;
use crate::report::VoyageReport;
use crate::report::times::length;

/// The section.
pub(super) fn trust(report: &VoyageReport) -> String {
    let (times, trust) = (&report.collected.times, &report.collected.trust);
    let mut states = Table::new(&[
        Column::Text("The position"),
        Column::Number("In all"),
        Column::Number("Of the time, %"),
    ]);
    for (state, share) in trust.told.states() {
        let percent = number(Some(100.0 * share.share), 1);
        states.row([state.as_str().to_owned(), length(share.total_s), percent]);
    }
    let clock = |seconds: f64| times.clock(Time::from_seconds(seconds));
    let mut excluded = Table::new(&[
        Column::Text("Left out"),
        Column::Text("First"),
        Column::Text("Last"),
        Column::Number("In all"),
        Column::Number("Times"),
    ]);
    for own in trust.told.exclusions() {
        excluded.row([
            own.source.clone(),
            clock(own.first_s),
            clock(own.last_s),
            length(own.total_s),
            own.pieces.to_string(),
        ]);
    }
    let mut verdicts = Table::new(&[Column::Text(times.heading()), Column::Text("What was found")]);
    for (time, words) in trust.verdicts.first().chain(trust.verdicts.last()) {
        verdicts.row([times.clock(*time), words.clone()]);
    }
    let mut html = states.or("not known: there is no solution");
    html.push_str(
        "<p class=\"note\">Available: nothing speaks against it, and the horizontal protection level is \
         within 25 m. Unavailable: the level is beyond that, or a receiver is on trial. Fault: the sensors \
         contradict each other, and it is not known who is wrong.</p>\n",
    );
    html.push_str(&excluded.or("Nobody was left out."));
    html.push_str(&verdicts.or("No sensor was found to lie."));
    html.push_str(&left_out(trust.verdicts.left_out(), "findings"));
    html
}
