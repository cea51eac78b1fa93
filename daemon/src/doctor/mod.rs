//! Looks at a configuration and at the computer it is meant for, and tells everything that is wrong or
//! strange: before the ship sails, and before anything is started.
//!
//! Nothing is ever written to a port. What was found are plain values ([`Diagnosis`]), so that any surface can
//! show them.

mod compare;
mod files;
mod listen;
mod people;
mod places;
mod processes;
pub mod text;
mod under_way;

use std::path::PathBuf;
use std::time::Duration;

use serde::Serialize;

pub use people::Person;

use insd_config::check::{ConfigFinding, ConfigPlace, Severity, examine};
use insd_config::{Config, Examined};
use insd_lab::sniff::SniffReport;

/// What came of looking.
#[derive(Clone, Debug, Serialize)]
pub struct Diagnosis {
    /// Whether `insd run` would start with this configuration.
    pub accepted: bool,
    /// What was found, the worst first.
    pub findings: Vec<ConfigFinding>,
    /// What arrived at the ports, if they were listened to.
    pub heard: Option<SniffReport>,
}

/// How far to look.
#[derive(Clone, Debug)]
pub struct Extent {
    /// For how long to listen at the ports; not at all if zero.
    pub listen: Duration,
    /// As whom the daemon runs.
    pub person: Person,
    /// The file, to know whether a daemon runs with it.
    pub file: Option<PathBuf>,
}

impl Diagnosis {
    /// Of the text alone.
    #[must_use]
    pub fn of_text(text: &str) -> Self {
        Self::of(examine(text)).0
    }

    /// Of the text and the computer.
    ///
    /// # Errors
    /// No event loop can be started to listen with.
    pub fn of_ship(text: &str, extent: &Extent) -> std::io::Result<Self> {
        let (mut diagnosis, config) = Self::of(examine(text));
        let Some(config) = config else { return Ok(diagnosis) };
        let running = extent.file.as_deref().and_then(processes::daemon);
        let mut found = places::look(&config, &extent.person, running.is_some());
        found.extend(files::look(&config, &extent.person));
        if let Some(number) = running {
            let text = format!(
                "insd runs with this file, as process {number}: its ports are not listened to"
            );
            let finding =
                ConfigFinding::new(Severity::Note, "daemon-running", ConfigPlace::default(), &text);
            found.push(
                finding.advise("its page shows what arrives; `systemctl stop insd` to listen here"),
            );
            found.extend(under_way::look(&config));
        } else if !extent.listen.is_zero() {
            let taken: Vec<&ConfigPlace> = found
                .iter()
                .filter(|finding| finding.severity == Severity::Error)
                .map(|finding| &finding.place)
                .collect();
            let heard = listen::listen(&config, &taken, extent.listen)?;
            found.extend(compare::all(&config, &heard));
            diagnosis.heard = Some(heard.report);
        }
        diagnosis.add(found, text);
        Ok(diagnosis)
    }

    fn of(examined: Examined) -> (Self, Option<Config>) {
        let accepted = examined.is_accepted();
        let Examined { config, findings } = examined;
        (Diagnosis { accepted, findings, heard: None }, config)
    }

    /// What was found in the world, with the places of the text.
    fn add(&mut self, found: Vec<ConfigFinding>, text: &str) {
        let mut found = found;
        insd_config::check::locate(&mut found, text);
        // what cannot be read was replaced, and says nothing of the world
        let same = |own: &ConfigPlace, other: &ConfigPlace| {
            (&own.section, &own.name, &own.key) == (&other.section, &other.name, &other.key)
        };
        let refused: Vec<ConfigPlace> =
            self.findings.iter().filter(|own| own.refused).map(|own| own.place.clone()).collect();
        found.retain(|own| !refused.iter().any(|place| same(place, &own.place)));
        self.findings.extend(found);
        self.findings
            .sort_by_key(|finding| (std::cmp::Reverse(finding.severity), finding.place.line));
    }

    /// How many there are of a severity.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.findings.iter().filter(|finding| finding.severity == severity).count()
    }
}
