//! Which measurements were used, which were not and why, and whether they were as far off as expected.

use std::collections::{BTreeMap, BTreeSet};

use super::html::{Column, Table, count, number};
use crate::report::VoyageReport;
use crate::report::collect::aids::{Aid, REJECTED, USED};
use crate::report::draw::strips::{self, Meaning, Strip};
use crate::report::draw::{figure, key};

const MEANINGS: [Meaning; 2] = [
    Meaning { bit: USED, class: "good", words: "used" },
    Meaning { bit: REJECTED, class: "bad", words: "rejected" },
];

/// Strips and tables.
pub(super) fn aids(report: &VoyageReport) -> String {
    let aids = &report.collected.aids.by_name;
    if aids.is_empty() {
        return "<p class=\"unknown\">No measurement of any aid was weighed.</p>\n".to_owned();
    }
    let strips = aids.iter().map(|(name, aid)| Strip {
        name: words(name),
        lane: &aid.lane,
        meanings: &MEANINGS,
    });
    let strips: Vec<Strip<'_>> = strips.collect();
    let keys: String = MEANINGS.iter().map(|own| key(own.class, own.words)).collect();
    let drawing = strips::draw("Aids used and rejected", &strips, &report.collected.times);
    let mut html = figure(&keys, &drawing);
    html.push_str(&counted(report));
    html.push_str("<h3>Innovations over their expected sigma</h3>\n");
    html.push_str(&weighed(aids));
    html.push_str(
        "<p class=\"note\">An innovation is what was measured minus what was expected. If the claims are \
         true, their ratio to the expected sigma has mean 0 and root mean square 1, and 95.4 % are within \
         2σ. Components are north, east and down of positions and velocities, and in the order of the \
         log's axes; satellites have one, and are counted each, where the table above counts epochs.</p>\n",
    );
    html
}

fn words(name: &str) -> String {
    name.replace('_', " ").replace("gnss", "GNSS").replace("imu", "IMU")
}

fn counted(report: &VoyageReport) -> String {
    let counts = &report.counts;
    let rejected = counts.rejected.keys().map(|(aid, _)| *aid);
    let names: BTreeSet<&str> =
        counts.accepted.keys().chain(counts.floored.keys()).copied().chain(rejected).collect();
    let mut table = Table::new(&[
        Column::Text("Aid"),
        Column::Number("Used"),
        Column::Number("Rejected"),
        Column::Number("Sigma replaced"),
        Column::Text("Rejected because"),
    ]);
    for name in names {
        let own = counts.rejected.iter().filter(|((aid, _), _)| *aid == name);
        let total: u64 = own.clone().map(|(_, count)| count).sum();
        let reasons = own.map(|((_, reason), times)| {
            format!("{} {}", reason.as_str().replace('_', " "), count(*times))
        });
        let reasons = reasons.collect::<Vec<_>>().join(", ");
        let used = counts.accepted.get(name).copied().unwrap_or(0);
        let floored = counts.floored.get(name).copied().unwrap_or(0);
        table.row([words(name), count(used), count(total), count(floored), reasons]);
    }
    table.or("nothing was counted")
}

fn weighed(aids: &BTreeMap<&'static str, Aid>) -> String {
    let mut table = Table::new(&[
        Column::Text("Aid"),
        Column::Number("Component"),
        Column::Number("Weighed"),
        Column::Number("Used"),
        Column::Number("Mean"),
        Column::Number("RMS"),
        Column::Number("Within 2σ, used %"),
        Column::Number("Within 2σ, all %"),
    ]);
    for (name, aid) in aids {
        for (component, (used, all)) in aid.used.iter().zip(&aid.weighed).enumerate() {
            if all.all.count() == 0 {
                continue;
            }
            let percent = |share: Option<f64>| number(share.map(|share| share * 100.0), 1);
            table.row([
                words(name),
                (component + 1).to_string(),
                count(all.all.count()),
                count(used.all.count()),
                number(used.all.mean(), 2),
                number(used.all.root_mean_square(), 2),
                percent(used.coverage()),
                percent(all.coverage()),
            ]);
        }
    }
    table.or("no innovation was formed")
}
