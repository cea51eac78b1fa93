//! What she did: modes, track, motion, and how sure that was.

use insd_base::StartCondition;
use insd_vessel::words;

use super::head::duration;
use super::html::{Column, Table};
use crate::words::{latitude, longitude};

use crate::report::VoyageReport;
use crate::report::collect::lane::Lane;
use crate::report::collect::modes::MODES;
use crate::report::collect::motion::{Channel, Fix};
use crate::report::draw::axis::TimeAxis;
use crate::report::draw::chart::{Chart, Curve};
use crate::report::draw::scale::Kind;
use crate::report::draw::strips::{self, Meaning, Strip};
use crate::report::draw::{MODE_CLASSES, figure, key, map};
use crate::report::times::length;

/// Room at the left of a chart, px.
const LEFT: f64 = 58.0;

/// The time line of modes and its changes.
pub(super) fn modes(report: &VoyageReport) -> String {
    let (times, modes) = (&report.collected.times, &report.collected.modes);
    if report.collected.motion.solutions == 0 {
        return "<p class=\"unknown\">not known: there is no solution</p>\n".to_owned();
    }
    let meanings: Vec<Meaning> = meanings();
    let strip = Strip { name: "mode".to_owned(), lane: &modes.lane, meanings: &meanings };
    let whole = duration(report).max(1e-9);
    let spent = MODES.iter().zip(MODE_CLASSES).zip(modes.spent);
    let keys: String = spent
        .filter(|(_, spent)| *spent > 0.0)
        .map(|((mode, class), spent)| {
            let share = (spent / whole * 100.0).min(100.0);
            key(class, &format!("{} {} ({share:.1} %)", words::mode(*mode), length(spent)))
        })
        .collect();
    let mut html = figure(&keys, &strips::draw("Modes", &[strip], times));
    let mut table = Table::new(&[
        Column::Text(times.heading()),
        Column::Text("From"),
        Column::Text("To"),
        Column::Text("Why, as the recording shows it"),
    ]);
    for change in modes.changes.first().chain(modes.changes.last()) {
        let from = change.from.map_or("no solution", words::mode);
        let to = words::mode(change.to);
        let time = times.clock(change.time);
        table.row([time, from.to_owned(), to.to_owned(), change.reason.clone()]);
    }
    html.push_str(&table.or("no changes"));
    html.push_str(&super::record::left_out(modes.changes.left_out(), "changes"));
    html
}

fn meanings() -> Vec<Meaning> {
    let bits = (0..).map(|index| 1 << index);
    let all = MODES.iter().zip(MODE_CLASSES).zip(bits);
    all.map(|((mode, class), bit)| Meaning { bit, class, words: words::mode(*mode) }).collect()
}

/// The chart.
pub(super) fn track(report: &VoyageReport) -> String {
    let motion = &report.collected.motion;
    let moored = report.start == StartCondition::Moored;
    let berth = report.place.filter(|_| moored);
    let Some(drawing) = map::draw(&motion.track, berth) else {
        return "<p class=\"unknown\">not known: there is no position</p>\n".to_owned();
    };
    let seen = |mode| report.collected.modes.has_seen(mode);
    let keys = MODES.iter().zip(MODE_CLASSES).filter(|(mode, _)| seen(**mode));
    let keys: String = keys.map(|(mode, class)| key(class, words::mode(*mode))).collect();
    let fixes = || motion.track.iter().filter_map(|(_, place)| place.0);
    let words = |fix: Fix| format!("{}, {}", latitude(fix.latitude), longitude(fix.longitude));
    let (first, last) = (fixes().next().map(words), fixes().last().map(words));
    let place = first.zip(last).map_or(String::new(), |(first, last)| {
        let berth = if berth.is_some() { " The berth is as configured." } else { "" };
        format!(
            "<p class=\"note\">Start {first}; end {last}. Position of the IMU, WGS-84. Stereographic \
             projection, the same scale in all directions. Not a nautical chart.{berth}</p>\n"
        )
    });
    format!("{}{place}", figure(&keys, &drawing))
}

/// Attitude, heading, rate of turn, speed, heave.
pub(super) fn motion(report: &VoyageReport) -> String {
    let motion = &report.collected.motion;
    let charts = [
        linear("Roll", "°, starboard down positive", 0.2, &motion.roll),
        linear("Pitch", "°, bow up positive", 0.2, &motion.pitch),
        Chart { kind: Kind::Bearing, ..linear("Heading", "° true", 1.0, &motion.heading) },
        linear("Rate of turn", "°/min, to starboard positive", 2.0, &motion.turn),
        linear("Speed over ground", "kn", 0.5, &motion.speed),
        linear("Heave", "m, up positive", 0.1, &motion.heave),
    ];
    let mut html = draw(report, &charts);
    html.push_str(
        "<p class=\"note\">A line is the mean of a bin of time, the area about it what lies between the \
         least and the greatest in it. The strip at the foot is the mode.</p>\n",
    );
    if !motion.heave.is_known() {
        html.push_str(
            "<p class=\"note\">Heave is worked out for the ports that are written to; without any it is \
             not known.</p>\n",
        );
    }
    html
}

/// The 1-sigma of everything over time.
pub(super) fn errors(report: &VoyageReport) -> String {
    let motion = &report.collected.motion;
    let one = |title, unit, channel| Chart {
        kind: Kind::Logarithmic,
        ..linear(title, unit, 0.0, channel)
    };
    let two = |title, unit, channels: [(&'static str, _); 2]| {
        let curves = channels.into_iter().zip(["c1", "c2"]);
        let curves = curves.map(|((label, channel), class)| curve(class, label, channel));
        Chart { title, unit, kind: Kind::Logarithmic, span: 0.0, curves: curves.collect() }
    };
    let tilt = [("roll", &motion.roll_sigma), ("pitch", &motion.pitch_sigma)];
    let position = [("horizontal", &motion.horizontal_sigma), ("height", &motion.height_sigma)];
    let velocity = [("horizontal", &motion.velocity_sigma), ("down", &motion.down_velocity_sigma)];
    let charts = [
        one("Heading", "1σ, °", &motion.heading_sigma),
        two("Roll and pitch", "1σ, °", tilt),
        two("Position", "1σ, m", position),
        two("Velocity", "1σ, m/s", velocity),
    ];
    let mut html = draw(report, &charts);
    html.push_str(
        "<p class=\"note\">What the system said of its own errors, on logarithmic scales. Horizontal is \
         the root of the sum of the squares north and east.</p>\n",
    );
    html
}

fn draw(report: &VoyageReport, charts: &[Chart<'_>]) -> String {
    let axis = TimeAxis::new(&report.collected.times, LEFT);
    let modes: &Lane = &report.collected.modes.lane;
    charts.iter().map(|chart| chart.draw(&axis, modes)).collect()
}

fn linear<'a>(
    title: &'static str,
    unit: &'static str,
    span: f64,
    channel: &'a Channel,
) -> Chart<'a> {
    Chart { title, unit, kind: Kind::Linear, span, curves: vec![curve("c1", title, channel)] }
}

fn curve<'a>(class: &'static str, label: &'static str, channel: &'a Channel) -> Curve<'a> {
    Curve { class, label, bins: &channel.bins }
}
