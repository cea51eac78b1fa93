//! From a file to a configuration, or to all its faults at once.

use std::path::Path;

use anyhow::Context;

use crate::bad_input::BadInput;
use crate::check::{self, Examined};
use crate::environment;
use crate::file::Config;

impl Config {
    /// Reads and checks a file, with the environment's overrides; gives its text, too.
    ///
    /// # Errors
    /// [`BadInput`] with all faults and their places.
    pub fn load(path: &Path) -> anyhow::Result<(Self, String)> {
        let text =
            Self::text_of(path).with_context(|| format!("{}: cannot be read", path.display()))?;
        let config = Self::of_text(&text)
            .map_err(|fault| BadInput(format!("{}: {fault}", path.display())))?;
        Ok((config, text))
    }

    /// The text of a file, with the environment's overrides written below it.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn text_of(path: &Path) -> std::io::Result<String> {
        std::fs::read_to_string(path).map(|text| environment::written_below(&text))
    }

    /// The configuration of a text alone, as [`Config::load`] gives it and a recording holds it: with the
    /// overrides of the environment written below it.
    ///
    /// # Errors
    /// All faults as one text.
    pub fn of_text(text: &str) -> Result<Self, String> {
        let Examined { config, findings } = check::examine(text);
        let refused: Vec<String> =
            findings.iter().filter(|finding| finding.refused).map(ToString::to_string).collect();
        match config {
            Some(config) if refused.is_empty() => Ok(config),
            _ => Err(listed(&refused)),
        }
    }
}

/// Faults below each other, with their number in front.
fn listed(faults: &[String]) -> String {
    let s = if faults.len() == 1 { "" } else { "s" };
    format!("{} fault{s}\n  {}", faults.len(), faults.join("\n  "))
}
