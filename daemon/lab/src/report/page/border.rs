//! What came in: ports, sensors, which of them were used, and time.

use std::collections::BTreeMap;

use insd_base::{Span, Time};
use insd_intake::status::{IntakeStatus, PortStatus, SensorStatus};
use insd_vessel::words;

use super::html::{Column, Table, UNKNOWN, count, known, number, quantity};
use super::record::left_out;
use crate::report::VoyageReport;
use crate::report::collect::border::{BAD, GOOD, Line, POOR};
use crate::report::draw::strips::{self, Meaning, Strip};
use crate::report::draw::{figure, key};

const MEANINGS: [Meaning; 3] = [
    Meaning { bit: GOOD, class: "good", words: "speaks" },
    Meaning { bit: POOR, class: "poor", words: "says it is not valid, or overrun" },
    Meaning { bit: BAD, class: "bad", words: "silent, absent or lost" },
];
const CLOCK: [Meaning; 3] = [
    Meaning { bit: GOOD, class: "good", words: "UTC from pulses" },
    Meaning { bit: POOR, class: "poor", words: "UTC from messages" },
    Meaning { bit: BAD, class: "bad", words: "UTC not known" },
];
const VOYAGE: &str = "<p class=\"unknown\">not known: a voyage directory holds measurements, not what ports gave</p>\n";

/// Ports and sensors.
pub(super) fn ports(report: &VoyageReport) -> String {
    let Some(intake) = &report.intake else { return VOYAGE.to_owned() };
    let (times, border) = (&report.collected.times, &report.collected.border);
    let named = |name: &str, line| Strip { name: name.to_owned(), lane: line, meanings: &MEANINGS };
    let numbered = intake.ports.iter().zip((0..).map(insd_base::PortId));
    let ports = numbered.filter_map(|(port, id)| Some((&port.name, border.ports.get(&id)?)));
    let sensors = intake.sensors.iter().enumerate();
    let sensors = sensors.filter_map(|(id, own)| Some((&own.name, border.sensors.get(&id)?)));
    let ports = ports.map(|(name, line)| named(&format!("port {name}"), &line.lane));
    let strips: Vec<Strip<'_>> =
        ports.chain(sensors.map(|(name, line)| named(name, &line.lane))).collect();
    let mut html = String::new();
    if !strips.is_empty() {
        let keys: String = MEANINGS.iter().map(|own| key(own.class, own.words)).collect();
        html.push_str(&figure(&keys, &strips::draw("Ports and sensors", &strips, times)));
    }
    html.push_str("<h3>Ports that were listened to</h3>\n");
    html.push_str(&port_table(report, &intake.ports));
    html.push_str("<h3>Sensors</h3>\n");
    html.push_str(&sensor_table(&border.sensors, &intake.sensors));
    html.push_str(
        "<p class=\"note\">A silence counts from when it was noticed, after the patience of the port or \
         sensor. Gaps are samples that are missing by the device's own counter. Bytes of no frame are noise, or \
         messages that no sensor of the port speaks.</p>\n",
    );
    html
}

fn port_table(report: &VoyageReport, ports: &[PortStatus]) -> String {
    let mut table = Table::new(&[
        Column::Text("Port"),
        Column::Text("State at the end"),
        Column::Number("Bytes"),
        Column::Number("Frames"),
        Column::Number("Damaged"),
        Column::Number("Bytes of no frame"),
        Column::Number("Silences"),
        Column::Text("Heard last"),
    ]);
    for (port, id) in ports.iter().zip((0..).map(insd_base::PortId)) {
        let (counts, line) = (&port.counts, report.collected.border.ports.get(&id));
        let times = &report.collected.times;
        table.row([
            port.name.clone(),
            known(port.told.state.as_ref().map(ToString::to_string)),
            count(counts.bytes),
            count(counts.frames),
            count(counts.damaged),
            count(counts.skipped),
            line.map_or(UNKNOWN.to_owned(), silences),
            known(port.heard.map(|time| times.clock(time))),
        ]);
    }
    table.or("no port is configured")
}

fn sensor_table(lines: &BTreeMap<usize, Line>, sensors: &[SensorStatus]) -> String {
    let mut table = Table::new(&[
        Column::Text("Sensor"),
        Column::Text("At the end"),
        Column::Number("Passed on"),
        Column::Text("Not passed on"),
        Column::Number("Gaps"),
        Column::Number("Silences"),
        Column::Number("Temperature °C"),
    ]);
    for (index, sensor) in sensors.iter().enumerate() {
        let refused = sensor.refused.iter();
        let refused: Vec<String> = refused
            .map(|(reason, times)| {
                format!("{} {}", reason.as_str().replace('_', " "), count(*times))
            })
            .collect();
        let state = match (sensor.heard, sensor.silent, sensor.valid) {
            (None, ..) => "never heard",
            (_, true, _) => "silent",
            (_, _, Some(false)) => "says it is not valid",
            (_, _, Some(true)) => "valid",
            (_, _, None) => "validity not known",
        };
        table.row([
            sensor.name.clone(),
            state.to_owned(),
            count(sensor.passed),
            refused.join(", "),
            count(sensor.lost),
            lines.get(&index).map_or(UNKNOWN.to_owned(), silences),
            number(sensor.temperature, 1),
        ]);
    }
    table.or("no sensor is configured")
}

fn silences(line: &Line) -> String {
    match line.silences.extremes() {
        Some((_, longest)) => format!("{}, longest {longest:.1} s", line.silences.count()),
        None => "none".to_owned(),
    }
}

/// Which sensor was used for what, and why.
pub(super) fn sources(report: &VoyageReport) -> String {
    let Some(intake) = &report.intake else { return VOYAGE.to_owned() };
    let (times, chosen) = (&report.collected.times, &report.collected.border.chosen);
    let name = |sensor: usize| name_of(intake, sensor);
    let mut table = Table::new(&[
        Column::Text("Quantity"),
        Column::Text("Source at the end"),
        Column::Text("Because"),
    ]);
    for choice in &intake.choices {
        table.row([
            words::quantity(choice.quantity).to_owned(),
            choice.sensor.map_or("none", name).to_owned(),
            choice.why.map_or("none was ever valid", words::why).to_owned(),
        ]);
    }
    let mut html = table.or("nothing to choose from");
    html.push_str("<h3>Changes</h3>\n");
    let mut table = Table::new(&[Column::Text(times.heading()), Column::Text("Change")]);
    for (time, chosen) in chosen.first().chain(chosen.last()) {
        table.row([times.clock(*time), words::choice(chosen, name)]);
    }
    html.push_str(&table.or("none"));
    html.push_str(&left_out(chosen.left_out(), "changes"));
    html
}

fn name_of(intake: &IntakeStatus, sensor: usize) -> &str {
    intake.sensors.get(sensor).map_or(UNKNOWN, |sensor| &sensor.name)
}

/// How UTC was known.
pub(super) fn time(report: &VoyageReport) -> String {
    let Some(intake) = &report.intake else { return voyage_time(report) };
    let (times, border) = (&report.collected.times, &report.collected.border);
    let strip = Strip { name: "UTC".to_owned(), lane: &border.clock, meanings: &CLOCK };
    let keys: String = CLOCK.iter().map(|own| key(own.class, own.words)).collect();
    let mut html = figure(&keys, &strips::draw("Time", &[strip], times));
    let mut table = Table::new(&[Column::Text("Figure"), Column::Text("Value")]);
    let since = |time: Time| format!("{:.1} s", (time - times.start()).as_seconds());
    let sigma = intake.time.sigma.map(|sigma| sigma * 1e3);
    let error = border.system_error.map(Span::as_seconds);
    for (figure, value) in [
        ("UTC at the end", words::time_quality(intake.time.quality).to_owned()),
        ("Known after", known(border.utc_since.map(since))),
        ("1σ at the end, apart from the least delay of messages", quantity(sigma, 3, "ms")),
        ("The computer's own clock minus UTC, at the end", quantity(error, 3, "s")),
    ] {
        table.row([figure.to_owned(), value]);
    }
    html.push_str(&table.or(UNKNOWN));
    let changes = &border.time_changes;
    let mut table = Table::new(&[Column::Text(times.heading()), Column::Text("Change")]);
    for (time, change) in changes.first().chain(changes.last()) {
        table.row([times.clock(*time), words::time(change)]);
    }
    html.push_str(&table.or("no changes"));
    html.push_str(&left_out(changes.left_out(), "changes"));
    html
}

fn voyage_time(report: &VoyageReport) -> String {
    let words = if report.collected.times.has_utc() {
        "<p>UTC is that of the voyage's header.</p>\n"
    } else {
        "<p class=\"unknown\">UTC is not known: the voyage's header has none.</p>\n"
    };
    words.to_owned()
}
