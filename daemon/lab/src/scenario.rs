//! Scenarios by file, by name or by number.

use std::fs;
use std::path::Path;

use insd_config::BadInput;
use insd_simulator::{Override, Scenario, shipped};

/// A scenario and what to call it.
#[derive(Debug)]
pub struct Named {
    /// Its name, with what was set otherwise.
    pub name: String,
    /// What it says.
    pub scenario: Scenario,
}

/// Reads a scenario from a file or, if there is none of that name, from those that are shipped:
/// `02-coastal-2h-navigation`, `coastal-2h-navigation` or `2`; and sets some of its keys.
///
/// # Errors
/// With the list of shipped scenarios if there is no such one, or with what is wrong in it.
pub fn find(word: &str, sets: &[Override]) -> anyhow::Result<Named> {
    let path = Path::new(word);
    if path.is_file() {
        let text =
            fs::read_to_string(path).map_err(|fault| BadInput(format!("{word}: {fault}")))?;
        let stem = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
        return parse(&stem, word, &text, sets);
    }
    let found = shipped().iter().find(|(file, _)| answers_to(stem(file), word));
    match found {
        Some((file, text)) => parse(stem(file), file, text, sets),
        None => Err(BadInput(unknown(word)).into()),
    }
}

/// Reads a scenario from its text, and sets some of its keys.
///
/// # Errors
/// What is wrong in it, with its line.
pub fn of_text(name: &str, text: &str, sets: &[Override]) -> anyhow::Result<Named> {
    parse(name, name, text, sets)
}

fn parse(name: &str, place: &str, text: &str, sets: &[Override]) -> anyhow::Result<Named> {
    let scenario = Scenario::with_overrides(text, sets)
        .map_err(|fault| BadInput(format!("{place}: {fault}")))?;
    let name = sets.iter().fold(name.to_owned(), |name, set| format!("{name} {set}"));
    Ok(Named { name, scenario })
}

fn stem(file: &str) -> &str {
    file.strip_suffix(".toml").unwrap_or(file)
}

/// Whether a word is the full name, the name without number, or the number.
fn answers_to(full: &str, word: &str) -> bool {
    let word = stem(word);
    let (number, name) = full.split_once('-').unwrap_or((full, full));
    let is_number = word.parse::<u32>().is_ok_and(|word| number.parse() == Ok(word));
    word == full || word == name || is_number
}

/// The shipped scenarios, a line for each: number, name and what it is for.
#[must_use]
pub fn list() -> String {
    let line = |(file, text): &(&str, &str)| {
        let (number, name) = stem(file).split_once('-').unwrap_or(("", stem(file)));
        let table = text.parse::<toml::Table>().unwrap_or_default();
        let what = table.get("description").and_then(toml::Value::as_str).unwrap_or_default();
        format!("{number}  {name:<22} {}\n", what.trim())
    };
    shipped().iter().map(line).collect()
}

fn unknown(word: &str) -> String {
    let names: Vec<&str> = shipped().iter().map(|(file, _)| stem(file)).collect();
    format!("{word}: no such file; shipped scenarios are\n  {}", names.join("\n  "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shipped_scenario_answers_to_its_number_and_its_names() {
        for word in ["2", "02", "two-ways", "02-two-ways", "02-two-ways.toml"] {
            assert!(answers_to("02-two-ways", word), "{word}");
        }
        assert!(!answers_to("02-two-ways", "12") && !answers_to("02-two-ways", "ways"));
    }

    #[test]
    fn every_shipped_scenario_is_found_and_sound() {
        for (file, _) in shipped() {
            assert_eq!(find(stem(file), &[]).unwrap().name, stem(file));
        }
    }

    #[test]
    fn what_is_set_stands_in_the_name() {
        let set = |text: &str| text.parse::<Override>().unwrap();
        let named = find("7", &[set("start.lat_deg=60"), set("sea.state=5")]).unwrap();
        assert_eq!(named.name, "07-moored-ss3 start.lat_deg=60 sea.state=5");
        let message = find("7", &[set("start.lat=60")]).unwrap_err().to_string();
        assert!(message.starts_with("07-moored-ss3.toml: start.lat: unknown field"), "{message}");
    }

    #[test]
    fn an_unknown_word_lists_what_there_is() {
        let message = find("nowhere", &[]).unwrap_err().to_string();
        assert!(message.contains("nowhere") && message.contains(stem(shipped()[0].0)));
    }
}
