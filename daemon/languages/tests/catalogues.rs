//! What holds of the catalogues: they say the same in each language, and nothing in them is unused.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use insd_languages::Language;

/// Groups of sentences that the program says in English and people read in their language.
const SENTENCES: [&str; 4] = ["alert", "said", "report", "check"];

/// What stands in the page and is the same in every language.
const NAMES: [&str; 17] = [
    "insd",
    "UTC",
    "kn",
    "°/min",
    "m",
    "m/s",
    "°",
    "s",
    "IEC 62923",
    "JSON",
    "C/N0",
    "C/N0 dB Hz",
    "p50",
    "p99",
    "1σ",
    "1σ °",
    "m,",
];

/// Words that are the same in Japanese.
const SAME: [&str; 6] = ["GNSS", "IMU", "UTC", "RTK", "WGS-84", "CAN"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn assets() -> PathBuf {
    root().join("daemon/web/assets")
}

/// The keys of a group with their texts, without the name of the group.
fn group(language: Language, name: &str) -> BTreeMap<String, String> {
    let own = language.catalogue().texts();
    let own = own.filter_map(|(key, text)| Some((key.split_once('.')?, text)));
    let own = own.filter(|((group, _), _)| *group == name);
    own.map(|((_, key), text)| (key.to_owned(), text.to_owned())).collect()
}

fn english(name: &str) -> BTreeMap<String, String> {
    group(Language::English, name)
}

/// The names of the places of a text, and what stands between them.
fn taken_apart(text: &str) -> (BTreeSet<String>, Vec<String>) {
    let (mut places, mut plain) = (BTreeSet::new(), Vec::new());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let (place, after) = after.split_once('}').unwrap();
        places.insert(place.to_owned());
        plain.push(before.to_owned());
        rest = after;
    }
    plain.push(rest.to_owned());
    (places, plain)
}

/// All files below a folder that end so, outside of tests' and builds' own folders.
fn files(folder: &Path, end: &str, all: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        if path.is_dir() && !["target", ".git", "languages"].contains(&name.as_str()) {
            files(&path, end, all);
        } else if name.ends_with(end) {
            all.push(path);
        }
    }
}

/// The text of all files of some kinds in some folders, one behind the other, with texts over several lines in one.
fn sources(folders: &[&str], ends: &[&str]) -> String {
    let mut all = Vec::new();
    for (folder, end) in folders.iter().flat_map(|folder| ends.iter().map(move |end| (folder, end)))
    {
        files(&root().join(folder), end, &mut all);
    }
    let text: String = all.iter().map(|path| fs::read_to_string(path).unwrap()).collect();
    let mut joined = String::new();
    for piece in text.split("\\\n") {
        joined.push_str(piece.trim_start_matches(' '));
    }
    joined.replace("\\\"", "\"")
}

fn program() -> String {
    sources(&["nav", "alignment", "drivers", "daemon"], &[".rs", ".js"])
}

/// The texts of the page as it is written, and what it calls its parts.
fn written() -> BTreeSet<String> {
    let html = fs::read_to_string(assets().join("index.html")).unwrap();
    let texts = html.split('>').skip(1).filter_map(|rest| Some(rest.split_once('<')?.0));
    let labels =
        html.split("aria-label=\"").skip(1).filter_map(|rest| Some(rest.split_once('"')?.0));
    let options = html
        .split("translate=\"no\">")
        .skip(1)
        .filter_map(|rest| Some(rest.split_once("</select>")?.0));
    let kept: BTreeSet<String> = options
        .flat_map(|text| {
            text.split('>').filter_map(|rest| Some(rest.split_once('<')?.0.to_owned()))
        })
        .collect();
    let all = texts.chain(labels).map(str::trim);
    let is_text = |text: &&str| {
        text.contains(|c: char| c.is_alphabetic()) && !NAMES.contains(text) && !kept.contains(*text)
    };
    all.filter(is_text).map(str::to_owned).collect()
}

#[test]
fn each_language_has_the_keys_of_the_others_and_no_more() {
    for language in Language::ALL {
        for name in ["html", "page", "word", "alert", "said", "report", "check"] {
            let (own, english) = (group(language, name), english(name));
            assert!(!english.is_empty(), "{name} is empty");
            let own: Vec<&String> = own.keys().collect();
            assert_eq!(own, english.keys().collect::<Vec<_>>(), "{name} of {language}");
        }
    }
}

#[test]
fn every_file_of_a_catalogue_is_one_table_of_texts() {
    for language in Language::ALL {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(language.code());
        let mut texts = 0;
        for entry in fs::read_dir(folder).unwrap().flatten() {
            let table: toml::Table = fs::read_to_string(entry.path()).unwrap().parse().unwrap();
            let name = entry.file_name().to_string_lossy().into_owned();
            assert_eq!(table.keys().collect::<Vec<_>>(), [name.trim_end_matches(".toml")]);
            let inner = table.values().next().unwrap().as_table().unwrap();
            assert!(inner.values().all(toml::Value::is_str), "{name}");
            texts += inner.len();
        }
        assert_eq!(texts, language.catalogue().texts().count(), "a file is not read");
    }
}

#[test]
fn the_places_of_a_text_are_the_same_in_each_language() {
    let english: BTreeMap<&str, &str> = Language::English.catalogue().texts().collect();
    for language in Language::ALL {
        for (key, text) in language.catalogue().texts() {
            assert_eq!(taken_apart(text).0, taken_apart(english[key]).0, "{key} of {language}");
        }
    }
}

#[test]
fn what_is_written_in_another_language_is_not_english() {
    for (key, text) in Language::Japanese.catalogue().texts() {
        let mut plain = taken_apart(text).1.join(" ");
        SAME.iter().for_each(|same| plain = plain.replace(same, ""));
        let is_named = key == "said.party_imu" || key.ends_with("party_gnss");
        let has_letters = plain.chars().any(|c| c.is_ascii_lowercase());
        let has_japanese = plain.chars().any(|c| c > '\u{3000}');
        assert!(has_japanese || !has_letters || is_named, "{key}: {text}");
    }
}

#[test]
fn every_text_of_the_page_as_written_is_in_the_catalogue_and_no_other() {
    let catalogue: BTreeSet<String> = english("html").into_values().collect();
    assert_eq!(catalogue.len(), english("html").len(), "a text stands twice");
    let written = written();
    let lacks: Vec<_> = written.difference(&catalogue).collect();
    assert!(lacks.is_empty(), "not in the catalogue: {lacks:?}");
    let unused: Vec<_> = catalogue.difference(&written).collect();
    assert!(unused.is_empty(), "not in the page: {unused:?}");
}

#[test]
fn every_key_that_the_page_asks_for_is_there_and_every_key_is_asked_for() {
    let scripts = sources(&["daemon/web/assets"], &[".js"]);
    let keys = english("page");
    let asked = scripts.split(" t(\"").chain(scripts.split("(t(\"")).chain(scripts.split("[t(\""));
    let asked = asked.filter_map(|rest| Some(rest.split_once('"')?.0));
    let is_key = |text: &&str| {
        text.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
    };
    let lacks: Vec<&str> =
        asked.filter(is_key).filter(|key| !key.is_empty() && !keys.contains_key(*key)).collect();
    assert!(lacks.is_empty(), "asked for and not there: {lacks:?}");
    let unused: Vec<_> =
        keys.keys().filter(|key| !scripts.contains(&format!("\"{key}\""))).collect();
    assert!(unused.is_empty(), "not asked for: {unused:?}");
}

#[test]
fn every_word_is_one_that_the_program_says() {
    let program = program();
    let camel = |word: &str| -> String {
        word.split('_').map(|part| part[..1].to_uppercase() + &part[1..]).collect()
    };
    let is_said = |word: &String| {
        program.contains(&format!("\"{word}\""))
            || program.contains(&format!("    {},", camel(word)))
    };
    let unused: Vec<_> = english("word").into_keys().filter(|word| !is_said(word)).collect();
    assert!(unused.is_empty(), "nobody says {unused:?}");
}

/// Whether the program has a text, in at most three pieces of whole words.
fn is_said(program: &str, text: &str) -> bool {
    // a name of the interface is said with spaces
    if program.contains(&format!("\"{}\"", text.replace(' ', "_"))) {
        return true;
    }
    let words: Vec<&str> = text.split(' ').collect();
    let mut from = 0;
    for _ in 0..3 {
        let ends = (from + 1..=words.len()).rev();
        let Some(end) = ends.into_iter().find(|end| program.contains(&words[from..*end].join(" ")))
        else {
            return false;
        };
        from = end;
        if from == words.len() {
            return true;
        }
    }
    false
}

#[test]
fn every_sentence_is_one_that_the_program_says() {
    let program = program();
    let mut unused = Vec::new();
    for (name, (key, text)) in
        SENTENCES.into_iter().flat_map(|name| english(name).into_iter().map(move |own| (name, own)))
    {
        let longest = taken_apart(&text).1.into_iter().max_by_key(String::len).unwrap();
        if !is_said(&program, longest.trim()) {
            unused.push(format!("{name}.{key}: {}", longest.trim()));
        }
    }
    assert!(unused.is_empty(), "nobody says\n{}", unused.join("\n"));
}

#[test]
fn no_two_sentences_are_the_same_in_english() {
    let mut seen = BTreeMap::new();
    for name in SENTENCES {
        for (key, text) in english(name) {
            let other = seen.insert(text.clone(), format!("{name}.{key}"));
            assert_eq!(other, None, "{name}.{key}: {text}");
        }
    }
}
