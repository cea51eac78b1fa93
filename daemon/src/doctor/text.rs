//! A diagnosis for people.

use std::fmt::Write as _;

use insd_config::check::{ConfigFinding, Severity};
use insd_lab::sniff::report::PortReport;
use insd_languages::Language;

use super::Diagnosis;

/// Every finding with what to do about it, what arrives, and the sum. What the catalogue of the language does not have stays English.
#[must_use]
pub fn report(diagnosis: &Diagnosis, language: Language) -> String {
    let (mut text, catalogue) = (String::new(), language.catalogue());
    for finding in &diagnosis.findings {
        let severity = finding.severity.name();
        let plain = ConfigFinding { advice: None, ..finding.clone() };
        let _ = writeln!(text, "{}", catalogue.said(&format!("{severity}: {plain}")));
        if let Some(advice) = &finding.advice {
            let _ = writeln!(text, "    {}", catalogue.said(advice));
        }
    }
    for port in diagnosis.heard.iter().flat_map(|heard| &heard.ports) {
        let _ = writeln!(text, "heard: {}: {}", port.name, arrived(port));
    }
    text
}

/// How many there are of each severity.
#[must_use]
pub fn sum(diagnosis: &Diagnosis) -> String {
    let count = |severity: Severity| {
        let number = diagnosis.count(severity);
        let s = if number == 1 { "" } else { "s" };
        (number > 0).then(|| format!("{number} {}{s}", severity.name()))
    };
    let all = [Severity::Error, Severity::Warning, Severity::Note].map(count);
    let told: Vec<String> = all.into_iter().flatten().collect();
    let sum = if told.is_empty() { "no faults".to_owned() } else { told.join(", ") };
    if diagnosis.accepted { sum } else { format!("{sum}; insd does not start with this") }
}

fn arrived(port: &PortReport) -> String {
    let mut messages: Vec<_> = port.messages.iter().collect();
    messages.sort_by_key(|message| std::cmp::Reverse((message.used, message.count)));
    let told: Vec<String> = messages
        .iter()
        .take(4)
        .map(|message| match message.rate_hz {
            Some(rate) => format!("{} {rate:.3} Hz", message.name),
            None => format!("{} {}", message.name, message.count),
        })
        .collect();
    if let Some(pulses) = &port.pulses {
        return format!("{} pulses", pulses.count);
    }
    if told.is_empty() {
        return format!("{} bytes, no frames", port.bytes);
    }
    told.join(", ")
}
