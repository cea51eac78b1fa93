//! Mistakes that are made when a ship is fitted out, each in a sound configuration: found before she sails,
//! and named. The table is also the documentation: `docs/installation-mistakes.md`.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod table;
mod world;

use insd_config::{Config, ConfigFinding, Examined, Severity, check::examine};

use insd_languages::Language;

use table::{Mistake, TABLE};

/// A ship as she should be.
const SHIP: &str = include_str!("../../../systemd/examples/survey.toml");
const DOCS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/installation-mistakes.md");

impl Mistake {
    /// The sound configuration with this mistake in it.
    fn text(&self) -> String {
        match self.change {
            table::Change::Write(from, to) => {
                assert!(SHIP.contains(from), "{}: {from}", self.what);
                SHIP.replacen(from, to, 1)
            }
            table::Change::Add(more) => format!("{SHIP}\n{more}\n"),
            table::Change::Say(key, value) => format!("{SHIP}\n#! {key}={value}\n"),
        }
    }

    /// The finding that names it.
    fn found(&self) -> Option<ConfigFinding> {
        let findings = examine(&self.text()).findings;
        findings.into_iter().find(|finding| finding.cause == self.cause)
    }
}

#[test]
fn a_sound_ship_has_neither_errors_nor_warnings() {
    let Examined { findings, .. } = examine(SHIP);
    let bad: Vec<_> = findings.iter().filter(|own| own.severity > Severity::Note).collect();
    assert!(bad.is_empty(), "{bad:?}");
}

#[test]
fn every_mistake_is_named_with_its_cause_and_severity() {
    let mut missed = Vec::new();
    for mistake in TABLE {
        match mistake.found() {
            Some(finding) if finding.severity == mistake.severity => {}
            found => {
                let all = examine(&mistake.text()).findings;
                let all: Vec<_> = all.iter().map(|own| format!("{}: {own}", own.cause)).collect();
                missed.push(format!("{}: {found:?}\n    {}", mistake.what, all.join("\n    ")));
            }
        }
    }
    assert!(missed.is_empty(), "{} of {}:\n{}", missed.len(), TABLE.len(), missed.join("\n"));
    assert!(TABLE.len() + world::ROWS.len() >= 40);
}

#[test]
fn every_mistake_has_a_place_and_the_value_where_there_is_one() {
    for mistake in TABLE {
        let finding = mistake.found().unwrap();
        let by_environment = matches!(mistake.change, table::Change::Say(..));
        let is_absence = ["no-imu"].contains(&mistake.cause);
        assert!(finding.place.line.is_some() || by_environment || is_absence, "{finding:?}");
    }
}

#[test]
fn what_the_daemon_refuses_is_what_is_marked_as_refused() {
    for mistake in TABLE {
        let text = mistake.text();
        let refused = examine(&text).findings.iter().any(|finding| finding.refused);
        assert_eq!(Config::of_text(&text).is_err(), refused, "{}", mistake.what);
    }
}

#[test]
fn many_mistakes_are_told_at_once() {
    let kinds = ["unknown-key", "type", "unknown-word", "unknown-port", "lever-sign", "imu-spec"];
    let mut text = SHIP.to_owned();
    for cause in kinds {
        let mistake = TABLE.iter().find(|mistake| mistake.cause == cause).unwrap();
        let table::Change::Write(from, to) = mistake.change else { panic!("{cause}") };
        assert!(text.contains(from), "{cause}: {from}");
        text = text.replacen(from, to, 1);
    }
    let causes: Vec<_> = examine(&text).findings.iter().map(|finding| finding.cause).collect();
    for cause in kinds {
        assert!(causes.contains(&cause), "{cause} is not in {causes:?}");
    }
}

/// The table as the documentation has it.
fn documented() -> String {
    let mut text = include_str!("head.md").to_owned();
    let row = |what: &str, severity: Severity, cause: &str, told: &str| {
        let told = told.replace('|', "\\|");
        format!("| {what} | {} | `{cause}` | {told} |\n", severity.name())
    };
    text.push_str("\n| mistake | severity | cause | what is said |\n|---|---|---|---|\n");
    for mistake in TABLE {
        let mut finding = mistake.found().unwrap();
        finding.place.line = None;
        text.push_str(&row(mistake.what, mistake.severity, mistake.cause, &finding.to_string()));
    }
    text.push_str("\n## Found by `insd doctor`, which looks at the computer, too\n");
    text.push_str("\n| mistake | severity | cause |\n|---|---|---|\n");
    for (what, severity, cause) in world::ROWS {
        text.push_str(&format!("| {what} | {} | `{cause}` |\n", severity.name()));
    }
    text
}

/// `INSD_WRITE_DOCS=1 cargo test -p insd --test mistakes` writes it.
#[test]
fn the_documentation_shows_this_table() {
    if std::env::var_os("INSD_WRITE_DOCS").is_some() {
        std::fs::write(DOCS, documented()).unwrap();
    }
    let shown = std::fs::read_to_string(DOCS).unwrap_or_default();
    assert_eq!(shown, documented(), "INSD_WRITE_DOCS=1 writes it");
}

#[test]
fn every_mistake_is_told_in_japanese_with_what_to_do_about_it() {
    let catalogue = Language::Japanese.catalogue();
    let mut english = Vec::new();
    for mistake in TABLE {
        // of the syntax of TOML its reader tells, in English
        let Some(finding) = mistake.found().filter(|own| own.cause != "syntax") else { continue };
        let plain = ConfigFinding { advice: None, ..finding.clone() };
        let line = format!("{}: {plain}", finding.severity.name());
        // what is to be written is no sentence
        let is_sentence = |advice: &String| {
            advice.contains(' ') && !advice.contains(" = ") && !advice.starts_with('[')
        };
        for text in std::iter::once(line).chain(finding.advice.filter(is_sentence)) {
            if catalogue.sentence(&text).is_none() {
                english.push(text);
            }
        }
    }
    assert!(english.is_empty(), "not in the catalogue:\n{}", english.join("\n"));
}

#[test]
fn a_sum_is_told_in_japanese() {
    let catalogue = Language::Japanese.catalogue();
    let text = "ship: 1 error, 2 warnings, 1 note; insd does not start with this";
    let told = catalogue.said(text.trim_start_matches("ship: "));
    assert_eq!(told, "誤り1件、警告2件、注記1件。この設定では insd は始動しない");
    assert_eq!(catalogue.said("no faults"), "誤りなし");
}
