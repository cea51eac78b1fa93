//! Alerts on a time line and as a table.

use insd_vessel::words::priority;

use super::html::{Column, Table, known};
use super::record::left_out;
use crate::report::VoyageReport;
use crate::report::collect::alerts::{ASKS, KNOWN, OVER, Occurrence};
use crate::report::draw::strips::{self, Meaning, Strip};
use crate::report::draw::{figure, key};

const MEANINGS: [Meaning; 3] = [
    Meaning { bit: OVER, class: "m5", words: "rectified, not acknowledged" },
    Meaning { bit: KNOWN, class: "poor", words: "active, acknowledged or a caution" },
    Meaning { bit: ASKS, class: "bad", words: "active, not acknowledged" },
];

/// The section.
pub(super) fn alerts(report: &VoyageReport) -> String {
    let alerts = &report.collected.alerts;
    if !alerts.watched {
        let why = "not known: alerts are kept where there is a port that is written to";
        return format!("<p class=\"unknown\">{why}</p>\n");
    }
    let times = &report.collected.times;
    let strips = alerts.lanes.iter().map(|((identifier, _), (title, lane))| Strip {
        name: format!("{identifier} {title}"),
        lane,
        meanings: &MEANINGS,
    });
    let strips: Vec<Strip<'_>> = strips.collect();
    let mut html = String::new();
    if !strips.is_empty() {
        let keys: String = MEANINGS.iter().map(|own| key(own.class, own.words)).collect();
        html.push_str(&figure(&keys, &strips::draw("Alerts", &strips, times)));
    }
    let mut table = Table::new(&[
        Column::Text("Raised"),
        Column::Text("Alert"),
        Column::Text("Priority"),
        Column::Text("What it means"),
        Column::Text("Acknowledged"),
        Column::Text("Rectified"),
        Column::Number("Raised again"),
    ]);
    let over = alerts.over.first().chain(alerts.over.last());
    let mut all: Vec<&Occurrence> = over.chain(alerts.open.values()).collect();
    all.sort_by_key(|own| own.raised);
    for own in all {
        let view = &own.view;
        let clock = |time: insd_base::Time| times.clock(time);
        let caution = priority(view.priority) == "caution";
        let never = if caution { "needs none" } else { "never" };
        table.row([
            clock(own.raised),
            format!("{} {}", view.identifier, view.title),
            priority(view.priority).to_owned(),
            view.description.to_string(),
            own.acknowledged.map_or(never.to_owned(), clock),
            known(Some(own.rectified.map_or("still active".to_owned(), clock))),
            view.escalation.to_string(),
        ]);
    }
    html.push_str(&table.or("No alert was raised."));
    html.push_str(&left_out(alerts.over.left_out(), "alerts"));
    html
}
