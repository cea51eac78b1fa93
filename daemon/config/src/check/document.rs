//! The text of a configuration with the places of what it says.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::finding::{ConfigFinding, ConfigPlace, Severity};

/// A text that was read, as far as it could be.
pub(super) struct Document<'a> {
    text: &'a str,
    table: Spanned<DeTable<'a>>,
    /// Keys that the environment sets, with what it sets them to.
    overrides: Vec<(Vec<String>, String)>,
    /// What is not TOML.
    pub(super) syntax: Vec<ConfigFinding>,
}

/// What stands at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Found {
    /// Line, from 1; none of what the environment says.
    pub(super) line: Option<usize>,
    /// The value as it is written; none of a section.
    pub(super) value: Option<String>,
}

/// Longest value that is shown, characters.
const SHOWN: usize = 60;

impl<'a> Document<'a> {
    /// Reads a text; `overrides` are what the environment says, by key in small letters.
    pub(super) fn read(text: &'a str, overrides: Vec<(Vec<String>, String)>) -> Self {
        let (table, faults) = DeTable::parse_recoverable(text);
        let mut document = Document { text, table, overrides, syntax: Vec::new() };
        for fault in faults {
            let line = fault.span().map(|span| document.line(span.start));
            let place = ConfigPlace { line, ..ConfigPlace::default() };
            let finding = ConfigFinding::new(Severity::Error, "syntax", place, fault.message());
            let finding = match line.and_then(|line| text.lines().nth(line - 1)) {
                Some(own) if has_comma(own) => finding.advise("a decimal point, not a comma?"),
                Some(own) => finding.advise(format!("the line is `{}`", own.trim())),
                None => finding,
            };
            let same = |other: &ConfigFinding| other.place.line == line && line.is_some();
            // one slip makes several faults of one line
            if !document.syntax.iter().any(same) {
                document.syntax.push(finding.refused());
            }
        }
        document.syntax.sort_by_key(|finding| finding.place.line);
        document
    }

    /// Without places, for readers.
    pub(super) fn plain(&self) -> Result<toml::Table, toml::de::Error> {
        use serde::Deserialize;
        toml::Table::deserialize(toml::de::Deserializer::from(self.table.clone()))
    }

    /// Line of a byte, from 1.
    pub(super) fn line(&self, at: usize) -> usize {
        self.text.get(..at).map_or(1, |before| before.matches('\n').count() + 1)
    }

    /// What stands at the end of a path; of arrays the steps are numbers.
    pub(super) fn at(&self, path: &[String]) -> Option<Found> {
        let is_it = |(own, _): &&(Vec<String>, String)| own == path;
        if let Some((_, value)) = self.overrides.iter().find(is_it) {
            return Some(Found { line: None, value: Some(value.clone()) });
        }
        let (first, rest) = path.split_first()?;
        let (key, mut value) = member(self.table.get_ref(), first)?;
        let mut start = key;
        for step in rest {
            (start, value) = match value.get_ref() {
                DeValue::Table(table) => member(table, step)?,
                DeValue::Array(list) => {
                    let value = list.get(step.parse::<usize>().ok()?)?;
                    (value.span().start, value)
                }
                _ => return None,
            };
        }
        let written = self.text.get(value.span()).map(str::trim);
        let short = |text: &&str| !text.starts_with('[') || text.chars().count() <= SHOWN;
        let is_table = matches!(value.get_ref(), DeValue::Table(_));
        let value = written.filter(short).filter(|_| !is_table).map(str::to_owned);
        Some(Found { line: Some(self.line(start)), value })
    }

    /// The path of a section: the `nth` of those with this name.
    pub(super) fn section(&self, place: &ConfigPlace, nth: usize) -> Option<Vec<String>> {
        let bare = place.bare().to_owned();
        let (_, value) = member(self.table.get_ref(), &bare)?;
        let DeValue::Array(list) = value.get_ref() else { return Some(vec![bare]) };
        let Some(name) = &place.name else { return Some(vec![bare]) };
        let is_named = |value: &Spanned<DeValue<'_>>| {
            let DeValue::Table(table) = value.get_ref() else { return false };
            ["name", "port", "sensor"].iter().any(|key| {
                member(table, key).and_then(|(_, own)| own.get_ref().as_str()) == Some(name)
            })
        };
        // a sensor's `port` may be the name of another section: its own name counts first
        let own_name = |value: &Spanned<DeValue<'_>>| {
            let DeValue::Table(table) = value.get_ref() else { return false };
            member(table, "name").and_then(|(_, own)| own.get_ref().as_str()) == Some(name)
        };
        let count = |is: &dyn Fn(&Spanned<DeValue<'_>>) -> bool| {
            let found: Vec<usize> =
                (0..list.len()).filter(|index| list.get(*index).is_some_and(is)).collect();
            found.get(nth).or(found.last()).copied()
        };
        let index = count(&own_name).or_else(|| count(&is_named))?;
        Some(vec![bare, index.to_string()])
    }

    /// Puts line and value into a place that tells section and key.
    pub(super) fn locate(&self, finding: &mut ConfigFinding, nth: usize) {
        if finding.place.line.is_some() {
            return;
        }
        let Some(section) = self.section(&finding.place, nth) else { return };
        let keys: Vec<String> =
            finding.place.key.iter().flat_map(|key| key.split('.')).map(str::to_owned).collect();
        for length in (0..=keys.len()).rev() {
            let path = [&section[..], &keys[..length]].concat();
            if let Some(found) = self.at(&path) {
                finding.place.line = found.line;
                if length == keys.len() && length > 0 && finding.value.is_none() {
                    finding.value = found.value;
                }
                return;
            }
        }
    }
}

/// Whether a number in a line has a comma in it, and no bracket that would make a list of it.
fn has_comma(line: &str) -> bool {
    let Some((_, value)) = line.split_once('=') else { return false };
    let digit = |c: char| c.is_ascii_digit();
    let mut parts = value.trim().splitn(2, ',');
    let around = parts.next().zip(parts.next());
    around.is_some_and(|(before, after)| before.ends_with(digit) && after.starts_with(digit))
        && !value.trim().starts_with('[')
}

/// A member of a table: where its key begins, and its value.
fn member<'t, 'a>(table: &'t DeTable<'a>, name: &str) -> Option<(usize, &'t Spanned<DeValue<'a>>)> {
    let (key, value) = table.iter().find(|(key, _)| key.get_ref().as_ref() == name)?;
    Some((key.span().start, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "# a ship\n[ship]\nlat_deg = 100 # north\n\n[[port]]\nname = \"a\"\n\
        transport = { baud = 1 }\n[[port]]\nname = \"b\"\ntransport = { baud = 2 }\n";

    fn located(place: ConfigPlace) -> (Option<usize>, Option<String>) {
        let document = Document::read(TEXT, Vec::new());
        let mut finding = ConfigFinding::new(Severity::Note, "test", place, "");
        document.locate(&mut finding, 0);
        (finding.place.line, finding.value)
    }

    #[test]
    fn a_fault_is_given_the_line_of_its_key_or_of_its_section() {
        let value = |text: &str| Some(text.to_owned());
        for (place, line, found) in [
            (ConfigPlace::one("ship").key("lat_deg"), Some(3), value("100")),
            (ConfigPlace::one("ship").key("rate_hz"), Some(2), None),
            (ConfigPlace::of("port", "b").key("transport.baud"), Some(10), value("2")),
            (ConfigPlace::of("port", "b").key("transport.bits"), Some(10), None),
            (ConfigPlace::of("port", "a"), Some(5), None),
            (ConfigPlace::of("port", "c"), None, None),
            (ConfigPlace::one("imu"), None, None),
        ] {
            assert_eq!(located(place.clone()), (line, found), "{place}");
        }
    }

    #[test]
    fn what_the_environment_says_counts_and_has_no_line() {
        let own = (vec!["ship".to_owned(), "lat_deg".to_owned()], "7".to_owned());
        let document = Document::read(TEXT, vec![own]);
        let mut finding =
            ConfigFinding::new(Severity::Note, "test", ConfigPlace::one("ship").key("lat_deg"), "");
        document.locate(&mut finding, 0);
        assert_eq!((finding.place.line, finding.value.as_deref()), (None, Some("7")));
    }

    #[test]
    fn all_slips_of_a_text_are_told_with_their_lines() {
        let document = Document::read("[ship]\na = \nb = 1\nc == 2\n", Vec::new());
        let lines: Vec<_> = document.syntax.iter().map(|fault| fault.place.line).collect();
        assert_eq!(lines, [Some(2), Some(4)]);
    }
}
