//! Looks for all that can be wrong with a configuration without looking at the world: form, types, ranges,
//! references, and what installers get wrong. Everything is told at once, each with its place.

mod document;
mod finding;
mod lint;
pub mod nearest;
pub mod shape;
mod told;
pub mod uses;
pub(crate) mod walk;

use serde::Deserialize;
use toml::Table;

use document::Document;
use walk::Walk;

pub use finding::{ConfigFinding, ConfigPlace, Severity};

use super::{Config, environment, faults};

/// What came of looking at a text.
#[derive(Clone, Debug)]
pub struct Examined {
    /// The configuration, with whatever cannot be read taken out of it; `None` if too little is left.
    pub config: Option<Config>,
    /// What was found, the worst first.
    pub findings: Vec<ConfigFinding>,
}

impl Examined {
    /// Whether the daemon starts with it.
    #[must_use]
    pub fn is_accepted(&self) -> bool {
        self.config.is_some() && !self.findings.iter().any(|finding| finding.refused)
    }

    /// How many there are of a severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.findings.iter().filter(|finding| finding.severity == severity).count()
    }
}

/// Looks at a text, with the overrides of the environment that are written below it.
#[must_use]
pub fn examine(text: &str) -> Examined {
    let document = Document::read(text, environment::keys(text));
    let mut findings = document.syntax.clone();
    let slips: Vec<_> = findings.iter().filter_map(|finding| finding.place.line).collect();
    let mut walk = Walk::new(&document);
    let config = match document.plain() {
        Ok(mut table) => {
            walk.sections(&mut table, &shape::sections());
            let is_whole = findings.is_empty() && walk.findings.is_empty();
            let sound = |finding: &ConfigFinding| {
                finding.place.line.is_none_or(|line| !slips.contains(&line))
            };
            findings.extend(walk.findings.into_iter().filter(sound));
            if is_whole {
                read(text, text).map_err(|fault| findings.push(*fault)).ok()
            } else {
                mended(&table, text)
            }
        }
        Err(fault) => {
            findings.push(unreadable(fault.message(), None));
            None
        }
    };
    if let Some(config) = &config {
        let deeper = deeper(config, &document);
        let touched = |finding: &ConfigFinding| {
            findings.iter().any(|known| known.place.touches(&finding.place))
        };
        let new: Vec<ConfigFinding> =
            deeper.into_iter().filter(|finding| !touched(finding)).collect();
        findings.extend(new);
    }
    findings.sort_by_key(|finding| (std::cmp::Reverse(finding.severity), finding.place.line));
    Examined { config, findings }
}

/// What types cannot refuse, and what is allowed but strange.
fn deeper(config: &Config, document: &Document<'_>) -> Vec<ConfigFinding> {
    let mut all = told::findings(&faults::of(config), config, document);
    for mut finding in lint::all(config) {
        document.locate(&mut finding, 0);
        // what is out of its range needs no second word
        let same =
            |known: &ConfigFinding| known.place.key.is_some() && known.place == finding.place;
        if !all.iter().any(same) {
            all.push(finding);
        }
    }
    all
}

/// Puts lines and values of a text into the places of findings.
pub fn locate(findings: &mut [ConfigFinding], text: &str) {
    let document = Document::read(text, environment::keys(text));
    findings.iter_mut().for_each(|finding| document.locate(finding, 0));
}

fn unreadable(text: &str, line: Option<usize>) -> ConfigFinding {
    let place = ConfigPlace { line, ..ConfigPlace::default() };
    ConfigFinding::new(Severity::Error, "unreadable", place, text.trim()).refused()
}

/// Reads strictly, and again with the environment laid over it.
fn read(text: &str, with: &str) -> Result<Config, Box<ConfigFinding>> {
    toml::from_str::<Config>(text).map_err(|fault| {
        let document = Document::read(text, Vec::new());
        let line = fault.span().map(|span| document.line(span.start));
        Box::new(unreadable(fault.message(), line))
    })?;
    config::Config::builder()
        .add_source(config::File::from_str(text, config::FileFormat::Toml))
        .add_source(environment::of(with))
        .build()
        .and_then(config::Config::try_deserialize::<Config>)
        .map_err(|fault| {
            let text = format!("with the environment laid over it: {fault}");
            let finding =
                ConfigFinding::new(Severity::Error, "environment", ConfigPlace::default(), &text);
            Box::new(finding.refused())
        })
}

/// What is left of a text after all that is wrong was taken out.
fn mended(table: &Table, with: &str) -> Option<Config> {
    let config = Config::deserialize(table.clone()).ok()?;
    Some(read(&table.to_string(), with).unwrap_or(config))
}
