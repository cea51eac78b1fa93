//! The table `[reference]` of `voyage.toml`: what stays of the errors of `reference.csv`.

use std::fs;
use std::path::Path;

use insd_base::{ExternalReference, Message, Received};
use insd_config::BadInput;
use serde::Deserialize;

#[derive(Debug, Deserialize)]
struct File {
    reference: Option<ReferenceTable>,
}

/// What stays of the errors of a reference.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
pub(crate) struct ReferenceTable {
    /// 1-sigma of what stays for hours of the error of a position, m.
    position_lasting_std_m: Option<f64>,
}

impl ReferenceTable {
    /// Reads the table; one that says nothing where there is none.
    ///
    /// # Errors
    /// The file is no TOML, or no sigma is like that.
    pub(crate) fn read(dir: &Path) -> anyhow::Result<Self> {
        let path = dir.join("voyage.toml");
        let text = fs::read_to_string(&path)?;
        let bad = |text: String| BadInput(format!("{}: {text}", path.display()));
        let file: File = toml::from_str(&text).map_err(|error| bad(error.to_string()))?;
        let table = file.reference.unwrap_or_default();
        if table.position_lasting_std_m.is_some_and(|std| !(std > 0.0 && std.is_finite())) {
            let expected = "reference.position_lasting_std_m: expected a number above 0";
            return Err(bad(expected.to_owned()).into());
        }
        Ok(table)
    }

    /// What a sensor tells, with what is known of it.
    pub(crate) fn told(&self, received: Received) -> Received {
        let message = match received.message {
            Message::Reference(told) if told.position.is_some() => {
                let position_lasting_std = self.position_lasting_std_m;
                Message::Reference(ExternalReference { position_lasting_std, ..told })
            }
            other => other,
        };
        Received { message, ..received }
    }
}

#[cfg(test)]
mod tests {
    use insd_base::{Geodetic, Source, Time};

    use super::*;

    const HERE: Geodetic = Geodetic { latitude: 0.9, longitude: 0.1, height: 0.0 };

    fn table(text: &str) -> anyhow::Result<ReferenceTable> {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("voyage.toml"), text).unwrap();
        ReferenceTable::read(folder.path())
    }

    #[test]
    fn a_position_is_told_what_stays_of_its_error_and_a_heading_is_left_alone() {
        let table = table("[reference]\nposition_lasting_std_m = 100.0\n").unwrap();
        let heading = ExternalReference {
            time: Time::START,
            heading: Some(1.0),
            ..ExternalReference::default()
        };
        let place = ExternalReference { position: Some(HERE), ..heading };
        let told = |own| {
            let message = Message::Reference(own);
            let received = Received { receipt: Time::START, source: Source::Reference(0), message };
            table.told(received).message
        };
        assert_eq!(told(heading), Message::Reference(heading));
        let with = ExternalReference { position_lasting_std: Some(100.0), ..place };
        assert_eq!(told(place), Message::Reference(with));
    }

    #[test]
    fn no_table_says_nothing_and_a_sigma_of_nothing_is_told() {
        assert!(table("").unwrap().position_lasting_std_m.is_none());
        let wrong = table("[reference]\nposition_lasting_std_m = 0\n").unwrap_err();
        assert!(wrong.to_string().contains("reference.position_lasting_std_m"));
    }
}
