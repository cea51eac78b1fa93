//! Overrides of the environment: `INSD__SHIP__RATE_HZ=5`. They are written below the text of the file as
//! comments, so that a recording holds the configuration with which the program ran.

use config::{Environment, Map};

/// Name of the variables.
const PREFIX: &str = "INSD";
/// What a line with an override begins with.
const MARK: &str = "#! ";

/// The text with the overrides of this process below it.
pub(super) fn written_below(text: &str) -> String {
    let prefix = format!("{PREFIX}__");
    let mut overrides: Vec<String> = std::env::vars()
        .filter(|(key, value)| key.starts_with(&prefix) && !value.contains(['\n', '\r']))
        .map(|(key, value)| format!("{MARK}{key}={value}\n"))
        .collect();
    if overrides.is_empty() {
        return text.to_owned();
    }
    overrides.sort();
    let own: Vec<&str> = text.lines().filter(|line| !line.starts_with(MARK)).collect();
    format!("{}\n{}", own.join("\n"), overrides.concat())
}

fn written(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.lines().filter_map(|line| line.strip_prefix(MARK)?.split_once('='))
}

/// The keys that are overridden below a text, step by step, with what they are set to.
pub(super) fn keys(text: &str) -> Vec<(Vec<String>, String)> {
    let steps = |key: &str| key.split("__").skip(1).map(str::to_lowercase).collect();
    written(text).map(|(key, value)| (steps(key), value.to_owned())).collect()
}

/// The overrides that are written below a text.
pub(super) fn of(text: &str) -> Environment {
    let pairs: Map<String, String> =
        written(text).map(|(key, value)| (key.to_owned(), value.to_owned())).collect();
    Environment::with_prefix(PREFIX)
        .prefix_separator("__")
        .separator("__")
        .try_parsing(true)
        .source(Some(pairs))
}

#[cfg(test)]
mod tests {
    use super::super::Config;

    const SHIPPED: &str = include_str!("../../../systemd/insd.toml");

    #[test]
    fn an_override_that_is_no_number_is_a_fault_that_names_the_environment() {
        let text = format!("{SHIPPED}\n#! INSD__SHIP__RATE_HZ=often\n");
        let message = Config::of_text(&text).unwrap_err();
        assert!(message.contains("environment"), "{message}");
    }
}
