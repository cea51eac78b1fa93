//! The page, section by section.

mod aids;
mod alerts;
mod berths;
mod border;
mod head;
pub(crate) mod html;
mod record;
mod trust;
mod voyage;

use std::fmt::Write as _;

use super::VoyageReport;
use html::{escape, section};

const STYLE: &str = include_str!("style.css");

/// The whole page.
pub(crate) fn page(report: &VoyageReport) -> String {
    let sections = [
        ("figures", "Key figures", head::figures(report)),
        ("modes", "Modes", voyage::modes(report)),
        ("track", "Track", voyage::track(report)),
        ("motion", "Attitude and motion", voyage::motion(report)),
        ("errors", "Errors claimed", voyage::errors(report)),
        ("trust", "Whom she believed", trust::trust(report)),
        ("aids", "Aids used and rejected", aids::aids(report)),
        ("alerts", "Alerts", alerts::alerts(report)),
        ("berths", "Alongside", berths::berths(report)),
        ("ports", "Ports and sensors", border::ports(report)),
        ("sources", "Sources", border::sources(report)),
        ("time", "Time", border::time(report)),
        ("outputs", "Outputs", record::outputs(report)),
        ("events", "Events", record::events(report)),
        ("recording", "Recording", record::recording(report)),
        ("configuration", "Configuration", record::configuration(report)),
    ];
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>VoyageReport of {}</title>\n<style>\n{STYLE}</style></head>\n<body>\n",
        escape(&report.name)
    );
    page.push_str(&head::head(report));
    page.push_str("<nav aria-label=\"Contents\">");
    for (id, title, _) in &sections {
        let _ = write!(page, "<a href=\"#{id}\">{}</a>", escape(title));
    }
    page.push_str("</nav>\n<main>\n");
    for (id, title, content) in &sections {
        page.push_str(&section(id, title, content));
    }
    let _ = writeln!(
        page,
        "</main>\n<footer>Made by insd {} of the recording alone. Times are {}.</footer>\n</body></html>",
        env!("CARGO_PKG_VERSION"),
        times_are(report)
    );
    page
}

/// What the times of the page are.
fn times_are(report: &VoyageReport) -> &'static str {
    if report.collected.times.has_utc() {
        "UTC"
    } else {
        "since the start of the recording, as UTC is not known"
    }
}
