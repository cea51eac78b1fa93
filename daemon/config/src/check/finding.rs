//! What was found: how bad it is, where it stands, what is wrong and what to do.

use std::fmt;

use serde::Serialize;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// Worth knowing; nothing need be done.
    Note,
    /// It works, but probably not as it is meant: look at it.
    Warning,
    /// The daemon refuses it, or the part that it concerns cannot work.
    Error,
}

impl Severity {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// Where it stands.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct ConfigPlace {
    /// The section as the file writes it: `[ship]`, `[[sensor]]`; empty for the file as a whole.
    pub section: String,
    /// Name of the section, where there are several.
    pub name: Option<String>,
    /// Key in it, with dots where it lies in a table.
    pub key: Option<String>,
    /// Line of the file, from 1.
    pub line: Option<usize>,
}

impl ConfigPlace {
    /// A section of which there is one.
    #[must_use]
    pub fn one(section: &str) -> Self {
        ConfigPlace { section: format!("[{section}]"), ..ConfigPlace::default() }
    }

    /// A section of which there are several.
    #[must_use]
    pub fn of(section: &str, name: &str) -> Self {
        let name = Some(name.to_owned());
        ConfigPlace { section: format!("[[{section}]]"), name, ..ConfigPlace::default() }
    }

    /// A key of it.
    #[must_use]
    pub fn key(self, key: &str) -> Self {
        ConfigPlace { key: Some(key.to_owned()), ..self }
    }

    /// The name of the section without its brackets.
    #[must_use]
    pub fn bare(&self) -> &str {
        self.section.trim_matches(['[', ']'])
    }

    /// Whether another place is in the same section, and under the same key as far as both tell one.
    #[must_use]
    pub(super) fn touches(&self, other: &ConfigPlace) -> bool {
        let first = |place: &ConfigPlace| {
            place.key.as_ref().map(|key| key.split('.').next().unwrap_or_default().to_owned())
        };
        let keys = first(self).zip(first(other));
        self.section == other.section
            && self.name == other.name
            && keys.is_none_or(|(own, other)| own == other)
    }
}

impl fmt::Display for ConfigPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        f.write_str(&self.section)?;
        if let Some(name) = &self.name {
            write!(f, " \"{name}\"")?;
        }
        if let Some(key) = &self.key {
            let colon = if self.section.is_empty() { "" } else { ": " };
            write!(f, "{colon}{key}")?;
        }
        Ok(())
    }
}

/// One thing that was found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ConfigFinding {
    /// How bad it is.
    pub severity: Severity,
    /// A lasting name of what it is, for programs: `unknown-key`, `lever-sign`.
    pub cause: &'static str,
    /// Whether `insd run` refuses to start with it.
    pub refused: bool,
    /// Where.
    pub place: ConfigPlace,
    /// What stands there.
    pub value: Option<String>,
    /// What is wrong, or what was expected.
    pub text: String,
    /// What to write or do instead.
    pub advice: Option<String>,
}

impl ConfigFinding {
    /// Something at a place.
    #[must_use]
    pub fn new(severity: Severity, cause: &'static str, place: ConfigPlace, text: &str) -> Self {
        let text = text.to_owned();
        ConfigFinding { severity, cause, refused: false, place, value: None, text, advice: None }
    }

    /// With what to do about it.
    #[must_use]
    pub fn advise(self, advice: impl Into<String>) -> Self {
        ConfigFinding { advice: Some(advice.into()), ..self }
    }

    /// With which the daemon does not start.
    #[must_use]
    pub fn refused(self) -> Self {
        ConfigFinding { refused: true, ..self }
    }
}

impl fmt::Display for ConfigFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = self.place.to_string();
        if !place.is_empty() {
            write!(f, "{place}: ")?;
        }
        f.write_str(&self.text)?;
        if let Some(value) = self.value.as_ref().filter(|_| self.text.contains("expected")) {
            write!(f, ", not {value}")?;
        }
        if let Some(advice) = &self.advice {
            write!(f, "; {advice}")?;
        }
        Ok(())
    }
}
