//! The house rules as a test. Each failure lists every offender with its place.
//!
//! The scan of sources is rough on purpose: comments, strings and test code are blanked
//! ([`source`]), and the rest is looked at line by line.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod documents;
mod manifest;
mod modules;
mod names;
mod source;

use std::collections::BTreeMap;

use manifest::{Member, members, root};
use modules::{Module, Modules};
use names::public_types;
use source::{Source, rust_sources, text_files};

/// Longest file, lines.
const FILE_LIMIT: usize = 500;
/// Longest function, lines, from its signature to its closing brace.
const FUNCTION_LIMIT: usize = 60;

/// Crates without I/O, clock, thread, log or randomness.
const PURE: [&str; 16] = [
    "insd-base",
    "insd-estimation",
    "insd-gnss",
    "insd-nav",
    "insd-learning",
    "insd-output",
    "insd-alignment",
    "insd-wire",
    "insd-n2k",
    "insd-rinex",
    "insd-intake",
    "insd-simulator",
    "insd-vision",
    "insd-engine",
    "insd-vessel",
    "insd-languages",
];

/// What a pure crate may depend on beside the house's own crates: all of it without side effects.
const PURE_DEPENDENCIES: [&str; 17] = [
    "crc",
    "fast-float2",
    "igrf",
    "kinavis-kernel",
    "kinavis-wmm",
    // corners and flow of images in memory, on the pool of threads that the caller chose
    "kornia-image",
    "kornia-imgproc",
    "nalgebra",
    "nmea",
    "postcard",
    "schemars",
    "serde",
    "serde_json",
    "statrs",
    "thiserror",
    "toml",
    // dates of the calendar, without its clock
    "time",
];

/// Seeded generators, for the simulator and for the draws among points of an image.
const SEEDED: [&str; 3] = ["rand", "rand_distr", "rand_pcg"];
/// Who draws.
const DRAWING: [&str; 2] = ["insd-simulator", "insd-vision"];

/// What the sources of a pure crate must not name.
const IMPURE: [&str; 15] = [
    "std::env",
    "std::fs",
    "std::io",
    "std::net",
    "std::os",
    "std::process",
    "std::thread",
    "std::time",
    "thread_local!",
    "static mut",
    "println!",
    "eprintln!",
    "tracing::",
    "log::info",
    "rand::rng",
];

/// Crates that go to crates.io; all others are `publish = false`.
const PUBLISHED: [&str; 3] = ["insd-base", "insd-estimation", "insd-nav"];

/// Which crates of the house a crate may use. The daemon sees all; tests may see all.
const ARROWS: [(&str, &[&str]); 23] = [
    ("insd-base", &[]),
    ("insd-estimation", &[]),
    ("insd-gnss", &["insd-base"]),
    ("insd-nav", &["insd-base", "insd-estimation"]),
    ("insd-learning", &[]),
    ("insd-wire", &["insd-base"]),
    ("insd-n2k", &["insd-base"]),
    ("insd-rinex", &["insd-base"]),
    ("insd-output", &["insd-base", "insd-wire", "insd-n2k"]),
    ("insd-alignment", &["insd-base", "insd-estimation", "insd-nav"]),
    ("insd-intake", &["insd-base", "insd-gnss", "insd-wire", "insd-n2k"]),
    ("insd-simulator", &["insd-base", "insd-wire", "insd-n2k", "insd-intake"]),
    ("insd-vision", &["insd-base"]),
    ("insd-capture", &["insd-base", "insd-vision"]),
    ("insd-drivers", &["insd-base", "insd-wire", "insd-n2k", "insd-simulator"]),
    ("insd-engine", &["insd-base", "insd-nav", "insd-alignment", "insd-learning"]),
    (
        "insd-vessel",
        &[
            "insd-base",
            "insd-alignment",
            "insd-engine",
            "insd-intake",
            "insd-n2k",
            "insd-output",
            "insd-wire",
        ],
    ),
    ("insd-fleet", &["insd-base", "insd-web"]),
    ("insd-languages", &[]),
    ("insd-web", &["insd-languages"]),
    (
        "insd-config",
        &[
            "insd-base",
            "insd-alignment",
            "insd-drivers",
            "insd-engine",
            "insd-intake",
            "insd-languages",
            "insd-n2k",
            "insd-nav",
            "insd-output",
            "insd-vessel",
            "insd-web",
            "insd-wire",
        ],
    ),
    (
        "insd-lab",
        &[
            "insd-base",
            "insd-alignment",
            "insd-config",
            "insd-drivers",
            "insd-engine",
            "insd-gnss",
            "insd-intake",
            "insd-languages",
            "insd-learning",
            "insd-n2k",
            "insd-nav",
            "insd-output",
            "insd-rinex",
            "insd-simulator",
            "insd-vessel",
            "insd-wire",
        ],
    ),
    ("insd-python", &["insd-base", "insd-config", "insd-drivers", "insd-lab", "insd-simulator"]),
];

/// Words that do not enter the repository: promises to do it later, praise, and paths of one desk.
const BANNED: [&str; 10] = [
    concat!("TO", "DO"),
    concat!("FIX", "ME"),
    concat!("HA", "CK:"),
    concat!("blaz", "ing"),
    concat!("seam", "less"),
    concat!("lever", "ages"),
    concat!("uti", "lize"),
    concat!("obvi", "ously"),
    concat!("trivi", "ally"),
    concat!("/wo", "rk/"),
];

/// Fails with all complaints at once.
fn none(rule: &str, complaints: &[String]) {
    assert!(complaints.is_empty(), "{rule}:\n  {}", complaints.join("\n  "));
}

/// Complaints about each line of the production code of some files that holds one of the words.
fn lines_with(sources: &[Source], words: &[&str]) -> Vec<String> {
    let complain = |source: &Source| {
        let found = |line: &str| words.iter().find(|word| line.contains(**word)).copied();
        let lines = source.code.lines().enumerate();
        let complaints = lines.filter_map(|(index, line)| {
            found(line).map(|word| format!("{}:{}: {word}", source.path, index + 1))
        });
        complaints.collect::<Vec<_>>()
    };
    sources.iter().flat_map(complain).collect()
}

fn is_pure(member: &Member) -> bool {
    PURE.contains(&member.name.as_str())
}

#[test]
fn pure_crates_list_only_pure_dependencies() {
    let mut complaints = Vec::new();
    for member in members().iter().filter(|member| is_pure(member)) {
        let allowed = |name: &str| {
            name.starts_with("insd-")
                || PURE_DEPENDENCIES.contains(&name)
                || DRAWING.contains(&member.name.as_str()) && SEEDED.contains(&name)
        };
        let foreign = member.dependencies().into_iter().filter(|(name, _)| !allowed(name));
        complaints.extend(foreign.map(|(name, _)| format!("{}: {name}", member.name)));
    }
    none("a pure crate depends on something with side effects", &complaints);
}

#[test]
fn pure_crates_do_no_io_and_read_no_clock() {
    let pure = members().into_iter().filter(is_pure);
    let sources: Vec<Source> =
        pure.flat_map(|member| rust_sources(&member.folder.join("src"))).collect();
    none("a pure crate names something with side effects", &lines_with(&sources, &IMPURE));
}

#[test]
fn all_pure_crates_exist() {
    let names: Vec<String> = members().into_iter().map(|member| member.name).collect();
    let missing: Vec<String> = PURE
        .iter()
        .filter(|pure| !names.contains(&(**pure).to_owned()))
        .map(ToString::to_string)
        .collect();
    none("a crate of this test's list is gone", &missing);
}

#[test]
fn crates_use_only_crates_upstream() {
    let mut complaints = Vec::new();
    for member in members() {
        let Some((_, upstream)) = ARROWS.iter().find(|(name, _)| *name == member.name) else {
            continue;
        };
        let house = member.dependencies().into_iter().filter(|(name, _)| name.starts_with("insd"));
        let wrong = house.filter(|(name, _)| !upstream.contains(&name.as_str()));
        complaints.extend(wrong.map(|(name, _)| format!("{} -> {name}", member.name)));
    }
    none("a compile arrow points the wrong way", &complaints);
}

/// Sources of a crate, without tests and examples.
fn sources_of(member: &Member) -> Vec<Source> {
    rust_sources(&member.folder.join("src"))
}

#[test]
fn no_modules_go_round_in_circles() {
    let mut complaints = Vec::new();
    for member in members() {
        let modules = Modules::of(&sources_of(&member));
        let tie = |(one, other): &(Module, Module)| {
            format!("{}: {} needs {}", member.name, one.join("::"), other.join("::"))
        };
        complaints.extend(modules.ties().iter().map(tie));
    }
    none("modules need each other", &complaints);
}

#[test]
fn no_public_type_has_a_namesake_in_another_crate() {
    let mut crates: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for member in members() {
        for name in public_types(&sources_of(&member)) {
            crates.entry(name).or_default().push(member.name.clone());
        }
    }
    let shared = crates.iter().filter(|(_, crates)| crates.len() > 1);
    let complaints: Vec<String> =
        shared.map(|(name, crates)| format!("{name}: {}", crates.join(", "))).collect();
    none("a public type has a namesake", &complaints);
}

#[test]
fn time_enters_in_one_place() {
    let elsewhere: Vec<Source> = members()
        .iter()
        .flat_map(|member| rust_sources(&member.folder.join("src")))
        .filter(|source| source.path != "daemon/src/clock.rs")
        .collect();
    let complaints = lines_with(&elsewhere, &["Instant::now", "SystemTime::now", "Utc::now"]);
    none("a clock is read outside daemon/src/clock.rs", &complaints);
}

#[test]
fn nothing_unwraps_outside_tests() {
    let sources: Vec<Source> =
        members().iter().flat_map(|member| rust_sources(&member.folder.join("src"))).collect();
    none("an unwrap outside tests", &lines_with(&sources, &[".unwrap()", ".expect("]));
}

#[test]
fn nothing_is_left_undone() {
    let sources = rust_sources(&root());
    none("unfinished code", &lines_with(&sources, &["todo!", "unimplemented!", "dbg!("]));
}

#[test]
fn files_are_short() {
    let sources = rust_sources(&root());
    let complaints: Vec<String> = sources
        .iter()
        .map(|source| (source, source.text.lines().count()))
        .filter(|(_, lines)| *lines > FILE_LIMIT)
        .map(|(source, lines)| format!("{}: {lines} lines", source.path))
        .collect();
    none("a file is too long", &complaints);
}

#[test]
fn functions_fit_a_screen() {
    let mut complaints = Vec::new();
    for source in rust_sources(&root()) {
        let long = source.functions().into_iter().filter(|function| function.2 > FUNCTION_LIMIT);
        complaints.extend(
            long.map(|(name, line, length)| {
                format!("{}:{line}: {name}, {length} lines", source.path)
            }),
        );
    }
    none("a function is too long", &complaints);
}

#[test]
fn every_source_file_says_what_it_is_for() {
    let sources = rust_sources(&root());
    let silent = sources
        .iter()
        .filter(|source| !source.path.ends_with("/tests.rs") && !source.text.starts_with("//!"));
    let complaints: Vec<String> = silent.map(|source| source.path.clone()).collect();
    none("a file does not begin with //!", &complaints);
}

#[test]
fn no_banned_word_is_used() {
    let mut complaints = Vec::new();
    for (path, text) in text_files(&root()) {
        for (index, line) in text.lines().enumerate() {
            let words = BANNED.iter().filter(|word| line.contains(**word));
            complaints.extend(words.map(|word| format!("{path}:{}: {word}", index + 1)));
        }
    }
    none("a banned word", &complaints);
}

#[test]
fn every_crate_inherits_lints_and_package_keys() {
    let keys = ["version", "edition", "rust-version", "license", "repository", "publish"];
    let mut complaints = Vec::new();
    for member in members() {
        if !member.inherits(&["lints"]) {
            complaints.push(format!("{}: lints", member.name));
        }
        let published = PUBLISHED.contains(&member.name.as_str());
        let own = keys
            .iter()
            .filter(|key| member.inherits(&["package", key]) == (published && **key == "publish"));
        complaints.extend(own.map(|key| format!("{}: package.{key}", member.name)));
    }
    none("a manifest does not inherit from the workspace", &complaints);
}

#[test]
fn versions_stand_in_the_root_manifest_only() {
    let mut complaints = Vec::new();
    for member in members() {
        let own = member.all_dependencies().into_iter().filter(|(_, inherited)| !inherited);
        complaints.extend(own.map(|(name, _)| format!("{}: {name}", member.name)));
    }
    none("a dependency is not inherited from the workspace", &complaints);
}
