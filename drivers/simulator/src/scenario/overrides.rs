//! `KEY=VALUE`: one key of a scenario set to another value.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;
use toml::{Table, Value};

use super::Scenario;
use super::fault::{ScenarioError, ScenarioFault};

/// A key of a scenario with the value that it shall have instead of its own, as
/// `start.lat_deg=60` or `route.legs.0.heading_deg=90`. Entries of a list are counted from 0; tables
/// that are not there are made. The value is TOML; what is no TOML is a text.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    key: String,
    value: Value,
}

impl FromStr for Override {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "expected KEY=VALUE, for example start.lat_deg=60".to_owned();
        let (key, value) = text.split_once('=').ok_or_else(expected)?;
        let (key, value) = (key.trim(), value.trim());
        if value.is_empty() || key.split('.').any(str::is_empty) {
            return Err(expected());
        }
        let parsed: Option<Value> = format!("value = {value}")
            .parse::<Table>()
            .ok()
            .and_then(|mut table| table.remove("value"));
        let value = parsed.unwrap_or_else(|| Value::String(value.to_owned()));
        Ok(Override { key: key.to_owned(), value })
    }
}

impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key, self.value)
    }
}

impl Override {
    /// Changes the table of a scenario, and reads the scenario that it makes; ranges are not checked.
    pub(super) fn apply(&self, table: &mut Table) -> Result<Scenario, ScenarioError> {
        let fault =
            |problem| ScenarioError::Values(vec![ScenarioFault { key: self.key.clone(), problem }]);
        self.set(table).map_err(fault)?;
        Scenario::deserialize(table.clone())
            .map_err(|error| fault(error.to_string().trim_end().replace('\n', " ")))
    }

    fn set(&self, table: &mut Table) -> Result<(), String> {
        let mut steps = self.key.split('.');
        let first = steps.next().unwrap_or_default();
        let absent = || Value::Table(Table::new());
        let mut place = table.entry(first).or_insert_with(absent);
        for step in steps {
            place = match place {
                Value::Table(table) => table.entry(step).or_insert_with(absent),
                Value::Array(list) => entry(list, step)?,
                other => return Err(format!("{step}: {other} has no keys")),
            };
        }
        *place = self.value.clone();
        Ok(())
    }
}

/// An entry of a list by its number, counted from 0.
fn entry<'a>(list: &'a mut [Value], step: &str) -> Result<&'a mut Value, String> {
    let length = list.len();
    let entry = step.parse::<usize>().ok().and_then(|index| list.get_mut(index));
    entry.ok_or_else(|| format!("expected the number of one of {length} entries, found {step}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shipped;

    fn with(sets: &[&str]) -> Result<Scenario, ScenarioError> {
        let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
        Scenario::with_overrides(shipped()[6].1, &sets)
    }

    #[test]
    fn an_override_is_as_if_the_file_said_so() {
        let text = shipped()[6].1;
        let edited = text
            .replace("lat_deg = 35.0", "lat_deg = 60.0")
            .replace("heading_deg = 204.0", "heading_deg = 90.0")
            .replace("grade = \"navigation\"", "grade = \"tactical\"");
        let sets = ["start.lat_deg=60", "route.legs.0.heading_deg=90", "imu.grade=tactical"];
        assert_eq!(with(&sets), Scenario::from_toml(&edited));
        assert_eq!(with(&[]), Scenario::from_toml(text));
    }

    #[test]
    fn a_section_that_is_not_there_is_made() {
        assert!(with(&["gnss.rate_hz=2.0"]).unwrap().gnss.is_some());
    }

    #[test]
    fn a_key_that_names_nothing_is_told() {
        for (set, told) in [
            ("start.latitude=60", "start.latitude: unknown field `latitude`"),
            ("weather=1", "weather: unknown field `weather`"),
            ("route.legs.3.heading_deg=1", "one of 1 entries, found 3"),
            ("mode.x=1", "has no keys"),
        ] {
            let message = with(&[set]).unwrap_err().to_string();
            assert!(message.contains(told), "{set}: {message}");
        }
    }

    #[test]
    fn a_value_that_cannot_be_is_told_with_its_key() {
        let message = with(&["start.lat_deg=north"]).unwrap_err().to_string();
        assert!(message.starts_with("start.lat_deg: ") && message.contains("north"), "{message}");
        let message = with(&["start.lat_deg=95"]).unwrap_err().to_string();
        assert_eq!(message, "start.lat_deg: expected a number from -90 to 90, found 95");
    }

    #[test]
    fn only_a_key_and_a_value_make_an_override() {
        for text in ["start.lat_deg", "=3", "a..b=3", "a=", ".a=1"] {
            assert!(text.parse::<Override>().is_err(), "{text}");
        }
        let shown = "sea.state=5".parse::<Override>().unwrap().to_string();
        assert_eq!(shown, "sea.state=5");
    }
}
