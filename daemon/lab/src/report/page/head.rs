//! What the report is of, and its key figures.

use insd_base::Span;

use super::html::{Column, Table, UNKNOWN, count, escape, known, number, quantity};
use crate::report::VoyageReport;
use crate::report::collect::motion::Channel;
use crate::report::times::length;
use crate::words::distance;

/// Significant heave is four times the standard deviation.
const SIGNIFICANT: f64 = 4.0;

/// Title, span, program; and a warning where something is missing.
pub(super) fn head(report: &VoyageReport) -> String {
    let times = &report.collected.times;
    let (from, to) = (times.full(times.start()), times.full(times.end()));
    let program = report.program.as_ref().map_or_else(
        || "The program that recorded it is not known".to_owned(),
        |program| format!("Recorded by {program}"),
    );
    let run = match report.run {
        Some((run, runs)) if runs > 1 => format!(" · run {run} of {runs}"),
        _ => String::new(),
    };
    let config =
        if report.other_config { " · with another configuration than recorded" } else { "" };
    format!(
        "<header><div class=\"over\">Navigation report</div><h1>{}</h1>\n\
         <p>{} to {} · {}</p>\n<p class=\"soft\">{}{run}{config}</p></header>\n{}",
        escape(&report.name),
        escape(&from),
        escape(&to),
        length(duration(report)),
        escape(&program),
        warning(report)
    )
}

fn warning(report: &VoyageReport) -> String {
    let faults = report.faults.told.count();
    if faults == 0 {
        return String::new();
    }
    let read = &report.faults.read;
    format!(
        "<p class=\"warn\">The recording is not whole: {} faults, {} records missing, {} arrivals not \
         recorded. <a href=\"#recording\">Details</a></p>\n",
        count(faults),
        count(read.missing),
        count(read.not_recorded)
    )
}

/// Two tables side by side.
pub(super) fn figures(report: &VoyageReport) -> String {
    let mut html = "<div class=\"pairs\">".to_owned();
    for rows in [voyage_rows(report), trust_rows(report)] {
        let mut table = Table::new(&[Column::Text("Figure"), Column::Text("Value")]);
        rows.into_iter().for_each(|(name, value)| table.row([name.to_owned(), value]));
        html.push_str(&table.or(UNKNOWN));
    }
    html.push_str(
        "</div>\n<p class=\"note\">Motion, distance and claimed errors are those of the time in \
        which she navigated: with a heading to steer by. Heave is at the IMU.</p>\n",
    );
    html
}

type Rows = Vec<(&'static str, String)>;

fn voyage_rows(report: &VoyageReport) -> Rows {
    let collected = &report.collected;
    let motion = &collected.motion;
    let until = |time: Option<insd_base::Time>| {
        time.map(|time| length((time - collected.times.start()).as_seconds()))
    };
    let navigated = motion.navigated.is_some();
    let greatest = |channel: &Channel| channel.navigating.extremes().map(|(_, greatest)| greatest);
    let swing = |channel: &Channel, unit: &str| {
        channel.navigating.extremes().map_or(UNKNOWN.to_owned(), |(least, greatest)| {
            format!("{} to {} {unit}", number(Some(least), 1), number(Some(greatest), 1))
        })
    };
    let deviation = motion.heave.navigating.deviation();
    vec![
        ("Duration", length(duration(report))),
        ("First solution after", known(until(motion.first))),
        ("Heading to steer by after", known(until(motion.navigated))),
        ("Navigating", known(share(report))),
        ("Longest without GNSS", known(navigated.then(|| length(collected.modes.without_gnss)))),
        ("Distance run over ground", known(navigated.then(|| distance(motion.distance)))),
        ("Greatest speed over ground", quantity(greatest(&motion.speed), 1, "kn")),
        ("Roll, starboard down positive", swing(&motion.roll, "°")),
        ("Pitch, bow up positive", swing(&motion.pitch, "°")),
        ("Significant heave", quantity(deviation.map(|own| own * SIGNIFICANT), 2, "m")),
    ]
}

fn trust_rows(report: &VoyageReport) -> Rows {
    let (collected, counts) = (&report.collected, &report.counts);
    let motion = &collected.motion;
    let sigma = |channel: &Channel, decimals: usize, unit: &str| {
        let worst = channel.navigating.extremes().map(|(_, greatest)| greatest);
        channel.navigating.mean().map_or(UNKNOWN.to_owned(), |mean| {
            let (mean, worst) = (number(Some(mean), decimals), number(worst, decimals));
            format!("{mean} {unit}, worst {worst} {unit}")
        })
    };
    let used: u64 = counts.accepted.values().sum();
    let alerts = &collected.alerts;
    let raised = || format!("{}, {} active at the end", alerts.raised(), alerts.active());
    let mut rows = vec![
        ("Heading, 1σ, mean", sigma(&motion.heading_sigma, 3, "°")),
        ("Roll, 1σ, mean", sigma(&motion.roll_sigma, 3, "°")),
        ("Horizontal position, 1σ, mean", sigma(&motion.horizontal_sigma, 1, "m")),
        ("Horizontal velocity, 1σ, mean", sigma(&motion.velocity_sigma, 3, "m/s")),
        ("Solutions", format!("{} at {} Hz", count(motion.solutions), report.rate)),
        ("Gaps between solutions", gaps(&motion.gaps)),
        (
            "IMU samples",
            format!("{}; gaps: {}", count(counts.imu_samples), gaps(&collected.imu_gaps)),
        ),
        ("Measurements used", count(used)),
        ("Measurements rejected", count(counts.rejected_total())),
        ("Alerts raised", known(alerts.watched.then(raised))),
    ];
    rows.extend(satellites(report).map(|words| ("Satellites in use", words)));
    rows
}

/// Of how many satellites ranges were used in an epoch; `None` without raw GNSS.
fn satellites(report: &VoyageReport) -> Option<String> {
    let in_use = &report.collected.satellites.in_use;
    let (least, greatest) = in_use.extremes()?;
    let mean = number(in_use.mean(), 1);
    let epochs = count(in_use.count());
    Some(format!("{mean} in the mean, {least} to {greatest}, in {epochs} epochs"))
}

fn gaps(gaps: &crate::report::statistics::Statistics) -> String {
    match gaps.extremes() {
        Some((_, longest)) => format!("{}, the longest {longest:.2} s", gaps.count()),
        None => "none".to_owned(),
    }
}

fn share(report: &VoyageReport) -> Option<String> {
    let modes = &report.collected.modes;
    let navigating: f64 = modes.navigating();
    let whole = duration(report);
    let share = (whole > 0.0).then(|| (navigating / whole * 100.0).min(100.0))?;
    Some(format!("{} ({share:.1} % of the time)", length(navigating)))
}

/// How long the recording is, s.
pub(super) fn duration(report: &VoyageReport) -> f64 {
    let times = &report.collected.times;
    (times.end() - times.start()).max(Span::ZERO).as_seconds()
}
