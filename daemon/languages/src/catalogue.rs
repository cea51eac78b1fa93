//! The texts of a language.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};

use crate::pattern::{Part, Pattern, parts};

/// Groups whose texts are looked for when a sentence of the program is read.
const SENTENCES: [&str; 4] = ["alert.", "said.", "report.", "check."];
/// A place whose name ends so holds another sentence or a word, which is said in the other language as well.
const SENTENCE_PLACE: &str = "_text";
/// A place whose name ends so holds a number.
const NUMBER_PLACE: &str = "_n";

/// What was looked for already within one sentence, so that one with many separators is not looked through again and again.
type Seen = RefCell<HashMap<String, Option<String>>>;

/// The texts of a language, by key: `page.heading`, `alert.position_lost`.
#[derive(Clone, Debug, Default)]
pub struct Catalogue {
    texts: BTreeMap<String, String>,
    /// The English sentences that can be found again, the longest first; none in the English catalogue itself.
    patterns: Vec<Pattern>,
    /// Keys of the English words; none in the English catalogue itself.
    words: BTreeMap<String, String>,
}

impl Catalogue {
    /// Reads the files of a catalogue; what is not a text in a table is left out, which the tests would tell.
    pub(crate) fn read(files: &[&str], english: Option<&Catalogue>) -> Self {
        let tables = files.iter().filter_map(|text| toml::from_str::<toml::Table>(text).ok());
        let mut texts = BTreeMap::new();
        for (group, table) in tables.flatten() {
            let toml::Value::Table(table) = table else { continue };
            let own = table.into_iter().filter_map(|(key, text)| {
                Some((format!("{group}.{key}"), text.as_str()?.to_owned()))
            });
            texts.extend(own);
        }
        let (patterns, words) =
            english.map(|own| (own.sentences(), own.own_words())).unwrap_or_default();
        Catalogue { texts, patterns, words }
    }

    fn sentences(&self) -> Vec<Pattern> {
        let is_sentence = |key: &str| SENTENCES.iter().any(|group| key.starts_with(group));
        let own = self.texts.iter().filter(|(key, _)| is_sentence(key));
        let mut patterns: Vec<Pattern> = own.map(|(key, text)| Pattern::new(key, text)).collect();
        patterns.sort_by_key(|pattern| std::cmp::Reverse(pattern.plain));
        patterns
    }

    fn own_words(&self) -> BTreeMap<String, String> {
        let own = self.texts.iter().filter(|(key, _)| key.starts_with("word."));
        own.map(|(key, text)| (text.clone(), key.clone())).collect()
    }

    /// All keys with their texts.
    pub fn texts(&self) -> impl Iterator<Item = (&str, &str)> {
        self.texts.iter().map(|(key, text)| (key.as_str(), text.as_str()))
    }

    /// The text of a key; the key itself where there is none, which a test forbids.
    #[must_use]
    pub fn text<'a>(&'a self, key: &'a str) -> &'a str {
        self.texts.get(key).map_or(key, String::as_str)
    }

    /// An English sentence of the program in this language; `None` where the catalogue does not have it. In English it is itself.
    #[must_use]
    pub fn sentence(&self, english: &str) -> Option<String> {
        if self.patterns.is_empty() {
            return Some(english.to_owned());
        }
        self.found(english, &Seen::default())
    }

    /// The same, or the English sentence where there is no other.
    #[must_use]
    pub fn said(&self, english: &str) -> String {
        self.sentence(english).unwrap_or_else(|| english.to_owned())
    }

    fn word(&self, english: &str) -> Option<String> {
        self.texts.get(self.words.get(english)?).cloned()
    }

    /// It ends, as what stands in a place is shorter than what it stands in.
    fn found(&self, english: &str, seen: &Seen) -> Option<String> {
        if let Some(known) = seen.borrow().get(english) {
            return known.clone();
        }
        let found = self.looked_for(english, seen);
        seen.borrow_mut().insert(english.to_owned(), found.clone());
        found
    }

    fn looked_for(&self, english: &str, seen: &Seen) -> Option<String> {
        let taken = |place: &str, value: &str| match place {
            _ if place.ends_with(SENTENCE_PLACE) => {
                self.found(value, seen).or_else(|| self.word(value))
            }
            _ if place.ends_with(NUMBER_PLACE) => is_number(value).then(|| value.to_owned()),
            _ => Some(value.to_owned()),
        };
        let values = |own: &Pattern| Some((own.key.clone(), own.values(english, &taken)?));
        let (key, values) = self.patterns.iter().find_map(values)?;
        let values: Vec<(&str, &str)> =
            values.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
        Some(filled(self.texts.get(&key)?, &values))
    }
}

fn is_number(text: &str) -> bool {
    text.contains(|c: char| c.is_ascii_digit())
        && text.chars().all(|c| c.is_ascii_digit() || "+-−.,:\u{2009}\u{202F}".contains(c))
}

/// A text with values in its places.
#[must_use]
pub fn filled(text: &str, values: &[(&str, &str)]) -> String {
    let value =
        |name: &str| values.iter().find(|(own, _)| *own == name).map_or("", |(_, value)| value);
    let said = |part: Part| match part {
        Part::Plain(text) => text,
        Part::Place(name) => value(&name).to_owned(),
    };
    parts(text).into_iter().map(said).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two() -> (Catalogue, Catalogue) {
        let english = "[said]\nlog = \"a log is used\"\nmode = \"{mode_text}: {why_text}\"\nheading = \"heading {sigma_n} deg\"\naided = \"aided\"\n[word]\nlog = \"log\"\n";
        let other = "[said]\nlog = \"ログ使用\"\nmode = \"{mode_text}（{why_text}）\"\nheading = \"方位{sigma_n}°\"\naided = \"補正航法\"\n[word]\nlog = \"ログ\"\n";
        let english = Catalogue::read(&[english], None);
        let other = Catalogue::read(&[other], Some(&english));
        (english, other)
    }

    #[test]
    fn a_sentence_is_said_in_the_other_language_with_its_values_and_the_sentences_in_it() {
        let (english, other) = two();
        assert_eq!(other.said("aided: a log is used"), "補正航法（ログ使用）");
        assert_eq!(other.said("heading 0.12 deg"), "方位0.12°");
        assert_eq!(english.said("heading 0.12 deg"), "heading 0.12 deg");
    }

    #[test]
    fn what_is_not_known_stays_english_as_a_whole() {
        let (_, other) = two();
        for unknown in ["aided: nobody knows why", "heading north deg", "log", ""] {
            assert_eq!(other.said(unknown), unknown);
            assert_eq!(other.sentence(unknown), None);
        }
        assert_eq!(other.text("word.log"), "ログ");
        assert_eq!(other.text("word.none"), "word.none");
    }

    #[test]
    fn a_long_sentence_that_is_not_known_is_given_up_soon() {
        let parts = ["x: y", "2 of 3", "line 4: gnss", "a, not b", "c; d"];
        let long = parts.into_iter().cycle().take(60).collect::<Vec<_>>().join(", ");
        let catalogue = crate::Language::Japanese.catalogue();
        assert_eq!(catalogue.sentence(&long), None);
    }

    #[test]
    fn a_place_without_a_value_is_left_empty() {
        assert_eq!(filled("{a} and {b}", &[("a", "1")]), "1 and ");
    }
}
