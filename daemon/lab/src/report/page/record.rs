//! What went out, what happened, and the recording itself.

use std::fmt::Write as _;

use super::head::duration;
use super::html::{Column, Table, UNKNOWN, count, escape, number};
use crate::report::VoyageReport;

/// How many were left out of a table, if any.
pub(super) fn left_out(number: u64, what: &str) -> String {
    if number == 0 {
        return String::new();
    }
    format!(
        "<p class=\"note\">The first and the last are shown; {} {} between them are not.</p>\n",
        count(number),
        escape(what)
    )
}

/// Messages by port and kind.
pub(super) fn outputs(report: &VoyageReport) -> String {
    if report.intake.is_none() {
        return "<p class=\"unknown\">not known: a voyage directory has no ports</p>\n".to_owned();
    }
    let seconds = duration(report);
    let mut table = Table::new(&[
        Column::Text("Port"),
        Column::Text("Message"),
        Column::Number("Sent"),
        Column::Number("A second, on the average"),
        Column::Number("Bytes"),
    ]);
    for ((port, kind), sent) in &report.collected.said.0 {
        let name = report.outputs.get(*port).map_or(UNKNOWN, String::as_str);
        let rate = (seconds > 0.0).then(|| sent.messages as f64 / seconds);
        let row = [count(sent.messages), number(rate, 2), count(sent.bytes)];
        let [messages, rate, bytes] = row;
        table.row([name.to_owned(), (*kind).to_owned(), messages, rate, bytes]);
    }
    let mut html = table.or("Nothing was sent.");
    let silent: Vec<&str> = (0..)
        .zip(&report.outputs)
        .filter(|(port, _)| !report.collected.said.0.keys().any(|(own, _)| own == port))
        .map(|(_, name)| name.as_str())
        .collect();
    if !silent.is_empty() {
        let _ = writeln!(html, "<p>Nothing was sent to {}.</p>", escape(&silent.join(", ")));
    }
    if report.skipped > 0 {
        let _ = writeln!(
            html,
            "<p>{} epochs were skipped as nobody was awake for them.</p>",
            count(report.skipped)
        );
    }
    html
}

/// The journal.
pub(super) fn events(report: &VoyageReport) -> String {
    let (times, journal) = (&report.collected.times, &report.collected.journal);
    let kinds = journal.kinds.iter().map(|(kind, number)| format!("{kind}: {}", count(*number)));
    let kinds = kinds.collect::<Vec<_>>().join(" · ");
    let mut html = format!("<p>{}</p>\n", escape(&kinds));
    let columns =
        [Column::Text(times.heading()), Column::Text("Kind"), Column::Text("What happened")];
    let entries = &journal.entries;
    let mut table = Table::new(&columns);
    for entry in entries.first().chain(entries.last()) {
        table.row([times.clock(entry.time), entry.kind.to_owned(), entry.text.clone()]);
    }
    html.push_str(&table.or("Nothing happened."));
    html.push_str(&left_out(entries.left_out(), "events"));
    html.push_str(
        "<p class=\"note\">Rejected measurements are counted here and told by reason under the aids.</p>\n",
    );
    html
}

/// Whether the recording is whole.
pub(super) fn recording(report: &VoyageReport) -> String {
    let (times, faults) = (&report.collected.times, &report.faults);
    let mut html = String::new();
    if let Some((run, runs)) = report.run {
        let _ = writeln!(
            html,
            "<p>Run {run} of {runs}: {} arrivals read, {} records missing, {} arrivals not recorded.</p>",
            count(faults.read.arrivals),
            count(faults.read.missing),
            count(faults.read.not_recorded)
        );
    }
    let mut table = Table::new(&[Column::Text("Behind"), Column::Text("Fault")]);
    for (time, fault) in faults.told.first().chain(faults.told.last()) {
        let place = time.map_or("the beginning".to_owned(), |time| times.clock(time));
        table.row([place, fault.clone()]);
    }
    html.push_str(&table.or("The recording is whole."));
    html.push_str(&left_out(faults.told.left_out(), "faults"));
    html
}

/// The text of the configuration.
pub(super) fn configuration(report: &VoyageReport) -> String {
    match &report.config {
        Some(text) => format!("<pre>{}</pre>\n", escape(text)),
        None => format!("<p class=\"unknown\">{UNKNOWN}</p>\n"),
    }
}
