//! A report as text for a terminal of 80 columns.

use std::fmt::Write;

use crate::table::{Align, Table, significant};

use super::bus;
use super::report::{MessageReport, PortReport, PulseReport, SatelliteReport, SniffReport, State};
use super::tally::Counted;

/// Columns of the terminal that hints are folded to.
const WIDTH: usize = 80;

/// Columns of the messages; those of times are left out where there are none.
const NAME: [(&str, Align); 4] = [
    ("", Align::Left),
    ("protocol", Align::Left),
    ("message", Align::Left),
    ("count", Align::Right),
];
const TIMES: [(&str, Align); 3] =
    [("Hz", Align::Right), ("jitter ms", Align::Right), ("last s ago", Align::Right)];
const SKY: [(&str, Align); 6] = [
    ("", Align::Left),
    ("satellites of", Align::Left),
    ("seen", Align::Right),
    ("signals", Align::Left),
    ("dB Hz", Align::Left),
    ("orbits known", Align::Left),
];
const READ: [(&str, Align); 1] = [("read", Align::Left)];

/// The whole report with its suggestions at the end.
#[must_use]
pub fn report(report: &SniffReport) -> String {
    let mut text: Vec<String> = report.ports.iter().map(port).collect();
    let sections: Vec<&str> =
        report.ports.iter().flat_map(|port| port.suggestions.iter().map(String::as_str)).collect();
    if !sections.is_empty() {
        let heading = "To take it into the configuration:\n\n";
        text.push(format!("{heading}{}", sections.join("\n")));
    }
    text.join("\n")
}

/// One port, without suggestions.
#[must_use]
pub fn port(port: &PortReport) -> String {
    let mut text = folded("", &format!("{}: {}", port.name, state(port)));
    if let Some(amount) = amount(port) {
        text.push_str(&folded("  ", &amount));
    }
    if let Some(pulses) = &port.pulses {
        text.push_str(&folded("  ", &told_pulses(pulses)));
    }
    if let Some(own) = &port.bus {
        text.push_str(&folded("  ", &bus::text::amount(own, port.seconds)));
        text.push_str(&bus::text::devices(own));
    }
    for (what, names) in [("talkers", &port.talkers), ("TAG sources", &port.sources)] {
        if !names.is_empty() {
            text.push_str(&folded(&format!("  {what}  "), &counted(names)));
        }
    }
    if let Some(satellites) = &port.satellites {
        text.push_str(&sky(satellites));
    }
    if !port.messages.is_empty() {
        let _ = write!(text, "\n{}", messages(port));
    }
    if !port.hints.is_empty() {
        text.push('\n');
    }
    for hint in &port.hints {
        text.push_str(&folded("  ! ", hint));
    }
    printable(&text)
}

/// A text without what could command the terminal.
#[must_use]
pub fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { '.' } else { c }).collect()
}

fn state(port: &PortReport) -> String {
    let what = port.what.as_deref().map(|what| without(&port.name, what)).unwrap_or_default();
    let opened = if what.is_empty() { String::new() } else { format!(" {what}") };
    match &port.state {
        State::Opening => "nothing known of it yet".to_owned(),
        State::Open => format!("open{opened}"),
        State::Silent { silent_s } if port.is_mute() => {
            format!("open{opened}, and silent for {silent_s:.0} s")
        }
        State::Silent { silent_s } => format!("open{opened}, silent for the last {silent_s:.0} s"),
        State::Absent { reason } => format!("absent: {}", without(&port.name, reason)),
        State::Lost { reason } => format!("lost: {}", without(&port.name, reason)),
        State::Ended => "read to its end".to_owned(),
    }
}

/// What the system said, without the name of the port that it may begin with and the number of the
/// error that it may end with.
fn without<'a>(name: &str, reason: &'a str) -> &'a str {
    let reason = reason.rsplit_once(" (os error").map_or(reason, |(words, _)| words);
    reason.strip_prefix(name).map_or(reason, |rest| rest.trim_start_matches([':', ' ']))
}

/// How much came, and how much of it was good.
fn amount(port: &PortReport) -> Option<String> {
    if port.bytes == 0 {
        return None;
    }
    let mut parts = vec![match port.seconds {
        Some(seconds) => format!("{} bytes in {seconds:.1} s", port.bytes),
        None => format!("{} bytes", port.bytes),
    }];
    if let Some(rate) = port.bytes_per_s {
        parts.push(format!("{rate:.0} bytes/s"));
    }
    if let Some((load, baud)) = port.load.zip(port.baud) {
        parts.push(format!("{} % of {baud} baud", significant(load * 100.0, 2)));
    }
    parts.push(format!("{} frames", port.frames));
    if port.damaged > 0 {
        parts.push(format!("{} damaged", port.damaged));
    }
    if port.stray > 0 {
        parts.push(format!("{} of no frame", percent(port.stray_share())));
    }
    Some(parts.join(", "))
}

/// Satellites and their signals.
fn sky(told: &SatelliteReport) -> String {
    let mut table = Table::new(&SKY);
    for own in &told.constellations {
        let density =
            |density: Option<f64>| density.map_or("-".to_owned(), |own| format!("{own:.0}"));
        table.push(vec![
            String::new(),
            own.constellation.clone(),
            own.satellites.to_string(),
            own.signals.join(" "),
            format!("{} to {}", density(own.least_dbhz), density(own.greatest_dbhz)),
            format!("{} of {}", own.orbits, own.satellites),
        ]);
    }
    let mut text = folded("  ", &format!("{} epochs of raw measurements", told.epochs));
    if !told.constellations.is_empty() {
        let _ = write!(text, "\n{table}");
    }
    text
}

fn percent(share: f64) -> String {
    if share < 0.0005 { "< 0.1 %".to_owned() } else { format!("{:.1} %", share * 100.0) }
}

fn told_pulses(pulses: &PulseReport) -> String {
    let mut text = format!("{} pulses", pulses.count);
    if let Some(interval) = pulses.interval_s {
        let _ = write!(text, ", one every {interval:.6} s");
    }
    if let Some(jitter) = pulses.jitter_ms {
        let _ = write!(text, ", jitter {jitter:.3} ms");
    }
    let ahead = pulses.clock_ahead_ms;
    let which = if ahead < 0.0 { "behind" } else { "ahead of" };
    let _ = write!(text, ", {} missed, clock {:.3} ms {which} it", pulses.missed, ahead.abs());
    text
}

fn counted(names: &[Counted]) -> String {
    let all = names.iter().map(|counted| format!("{} {}", counted.name, counted.count));
    all.collect::<Vec<_>>().join(", ")
}

fn messages(port: &PortReport) -> String {
    let is_timed = port.seconds.is_some();
    let times: &[(&str, Align)] = if is_timed { &TIMES } else { &[] };
    let mut table = Table::new(&[&NAME[..], times, &READ].concat());
    let (mut refusals, mut flaws) = (Vec::new(), Vec::new());
    for message in &port.messages {
        let name = message.name.clone();
        let protocol = message.protocol.name().to_owned();
        let mut row = vec![String::new(), protocol, name, message.count.to_string()];
        if is_timed {
            row.extend(times_of(message));
        }
        row.push(reading(message));
        table.push(row);
        for (told, last) in [(&mut refusals, &message.refusal), (&mut flaws, &message.flaw)] {
            if let Some(last) = last {
                let name = format!("{}: {}", message.name, last.reason);
                told.push((name, last.bytes.as_str()));
            }
        }
    }
    let mut text = table.to_string();
    if port.more > 0 {
        let _ = writeln!(text, "  and {} frames of further kinds", port.more);
    }
    for (heading, told) in [("refused last", refusals), ("left out last", flaws)] {
        if !told.is_empty() {
            let _ = writeln!(text, "\n  {heading}");
        }
        for (name, bytes) in told {
            text.push_str(&folded("    ", &name));
            let _ = writeln!(text, "      {bytes}");
        }
    }
    text
}

fn times_of(message: &MessageReport) -> [String; 3] {
    let number = |value: Option<f64>, digits| {
        value.map_or("-".to_owned(), |value| significant(value, digits))
    };
    let age = message.age_s.map_or("-".to_owned(), |age| format!("{age:.1}"));
    [number(message.rate_hz, 3), number(message.jitter_ms, 2), age]
}

fn reading(message: &MessageReport) -> String {
    let parts =
        [(message.used, "used"), (message.other(), "not needed"), (message.refused, "refused")];
    let there: Vec<_> = parts.iter().filter(|(count, _)| *count > 0).collect();
    match there.as_slice() {
        [(_, what)] => (*what).to_owned(),
        _ => there.iter().map(|(n, what)| format!("{n} {what}")).collect::<Vec<_>>().join(", "),
    }
}

/// A text folded at words, its later lines under the beginning of the first.
fn folded(start: &str, words: &str) -> String {
    let indent = " ".repeat(start.chars().count());
    let (mut text, mut column) = (start.to_owned(), start.chars().count());
    let begun = column;
    for word in words.split_whitespace() {
        let length = word.chars().count();
        if column > begun && column + 1 + length > WIDTH {
            let _ = write!(text, "\n{indent}");
            column = begun;
        } else if column > begun {
            text.push(' ');
            column += 1;
        }
        text.push_str(word);
        column += length;
    }
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_folded_under_their_beginning() {
        let text = folded("  ! ", &"word ".repeat(20));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 2);
        assert!(lines[0].starts_with("  ! word") && lines[1].starts_with("    word"), "{text}");
        assert!(lines.iter().all(|line| line.len() <= WIDTH), "{text}");
        assert_eq!(folded("  ", &"x".repeat(200)).lines().count(), 1);
    }

    #[test]
    fn nothing_that_was_recorded_commands_the_terminal() {
        assert_eq!(printable("a\u{1b}[2J\nb"), "a.[2J\nb");
    }

    #[test]
    fn a_reason_does_not_repeat_the_name() {
        assert_eq!(without("/dev/x", "/dev/x: No such device"), "No such device");
        assert_eq!(without("/dev/x", "/dev/x at 4800 baud"), "at 4800 baud");
        assert_eq!(
            without("a", "tcp b: Connection refused (os error 111)"),
            "tcp b: Connection refused"
        );
        assert_eq!(without("gnss", "/dev/x: gone"), "/dev/x: gone");
    }
}
