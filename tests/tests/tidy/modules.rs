//! Which module of a crate names which, by the paths that begin with `crate`, `super`, `self` or a child.
//!
//! A name that a module gives on (`pub use`) is followed to where it is at home.

use std::collections::{BTreeMap, BTreeSet};

use crate::source::Source;

/// Names from the root of a crate to a module; empty for the root itself.
pub(crate) type Module = Vec<String>;

/// All modules of a crate.
#[derive(Debug, Default)]
pub(crate) struct Modules {
    named: BTreeMap<Module, Vec<Named>>,
}

/// A path that a module names.
#[derive(Debug)]
pub(crate) struct Named {
    /// Its parts.
    pub(crate) path: Vec<String>,
    /// Whether it is given on: named by a `pub use`.
    pub(crate) is_given_on: bool,
}

impl Modules {
    /// Those of the sources of one crate.
    pub(crate) fn of(sources: &[Source]) -> Self {
        let production = sources.iter().filter(|source| !source.is_test());
        let named = production.map(|source| (module(&source.path), named(&source.code)));
        Modules { named: named.collect() }
    }

    /// Modules and the paths that they name.
    pub(crate) fn named(&self) -> impl Iterator<Item = (&Module, &Vec<Named>)> {
        self.named.iter()
    }

    /// The module that a path leads to from another, and what is left of the path.
    pub(crate) fn resolve(&self, from: &Module, path: &[String]) -> Option<(Module, Vec<String>)> {
        let (mut at, mut rest) = match path.first()?.as_str() {
            "crate" => (Module::new(), &path[1..]),
            "self" => (from.clone(), &path[1..]),
            "super" => {
                let steps = path.iter().take_while(|part| *part == "super").count();
                (from[..from.len().saturating_sub(steps)].to_vec(), &path[steps..])
            }
            child => {
                let is_child = self.named.contains_key(&joined(from, child));
                (is_child.then(|| from.clone())?, path)
            }
        };
        while let Some(child) = rest.first().map(|part| joined(&at, part)) {
            if !self.named.contains_key(&child) {
                break;
            }
            (at, rest) = (child, &rest[1..]);
        }
        Some((at, rest.to_vec()))
    }

    /// The module at which what a path names is at home.
    pub(crate) fn home(&self, from: &Module, path: &[String]) -> Option<Module> {
        let (at, rest) = self.resolve(from, path)?;
        let Some(name) = rest.first() else { return Some(at) };
        let mut given = self.named[&at].iter().filter(|named| named.is_given_on);
        let found = given.find(|named| named.path.last() == Some(name) && named.path != path);
        found.and_then(|named| self.home(&at, &named.path)).or(Some(at))
    }

    /// What each module needs. What it only gives on of its children it does not need.
    fn needs(&self) -> BTreeMap<&Module, BTreeSet<Module>> {
        let needs = |(module, named): (&Module, &Vec<Named>)| {
            let is_needed = |named: &&Named| {
                let target = self.resolve(module, &named.path);
                !(named.is_given_on && target.is_some_and(|(at, _)| at.starts_with(module)))
            };
            let homes = named.iter().filter(is_needed);
            let homes = homes.filter_map(|named| self.home(module, &named.path));
            homes.filter(|home| home != module).collect()
        };
        self.named.iter().map(|own| (own.0, needs(own))).collect()
    }

    /// Which of them needs which, of those that need each other.
    pub(crate) fn ties(&self) -> BTreeSet<(Module, Module)> {
        let (needs, circles) = (self.needs(), self.circles());
        let of_circle = |circle: &BTreeSet<Module>| {
            let inside = |module: &Module| {
                let others = needs[module].intersection(circle).cloned();
                others.map(|other| (module.clone(), other)).collect::<Vec<_>>()
            };
            circle.iter().flat_map(inside).collect::<Vec<_>>()
        };
        circles.iter().flat_map(of_circle).collect()
    }

    /// Modules that need each other, all of a circle together.
    pub(crate) fn circles(&self) -> BTreeSet<BTreeSet<Module>> {
        let needs = self.needs();
        let reached: BTreeMap<&Module, BTreeSet<Module>> =
            needs.keys().map(|module| (*module, reach(&needs, module))).collect();
        let circle = |module: &Module| {
            let all = reached[module].iter();
            all.filter(|other| reached[*other].contains(module)).cloned().collect()
        };
        let circles = needs.keys().map(|module| circle(module));
        circles.filter(|circle: &BTreeSet<Module>| !circle.is_empty()).collect()
    }
}

/// All that a module needs, and what that needs in turn.
fn reach(needs: &BTreeMap<&Module, BTreeSet<Module>>, from: &Module) -> BTreeSet<Module> {
    let mut reached = BTreeSet::new();
    let mut open: Vec<&Module> = needs[from].iter().collect();
    while let Some(module) = open.pop() {
        if reached.insert(module.clone()) {
            open.extend(&needs[module]);
        }
    }
    reached
}

fn joined(module: &Module, child: &str) -> Module {
    module.iter().cloned().chain([child.to_owned()]).collect()
}

/// The module of a file: `daemon/src/run/mod.rs` is `run`.
pub(crate) fn module(path: &str) -> Module {
    let below = path.rsplit_once("src/").map_or(path, |(_, below)| below);
    let stem = below.strip_suffix(".rs").unwrap_or(below);
    let mut parts: Module = stem.split('/').map(str::to_owned).collect();
    if parts.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
        parts.pop();
    }
    parts
}

/// All paths in a text without comments and strings.
fn named(code: &str) -> Vec<Named> {
    let mut all = Vec::new();
    let mut body = String::new();
    let mut rest = code;
    while let Some((before, after)) = split_at_use(rest) {
        body.push_str(before);
        let (tree, behind) = after.split_once(';').unwrap_or((after, ""));
        let line = before.rsplit(['\n', ';', '}']).next().unwrap_or("");
        let is_given_on = line.trim_start().starts_with("pub");
        all.extend(expanded(tree).into_iter().map(|path| Named { path, is_given_on }));
        rest = behind;
    }
    body.push_str(rest);
    all.extend(paths(&body).into_iter().map(|path| Named { path, is_given_on: false }));
    all
}

/// What stands before the next `use`, and what behind it.
fn split_at_use(code: &str) -> Option<(&str, &str)> {
    let is_word = |before: &str| !before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
    let at = code.match_indices("use ").map(|(at, _)| at).find(|at| is_word(&code[..*at]))?;
    Some((&code[..at], &code[at + 4..]))
}

/// The paths of a tree like `a::{b, c::d as e}`.
fn expanded(tree: &str) -> Vec<Vec<String>> {
    let Some((stem, inner)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or(tree);
        return vec![path.split("::").map(|part| part.trim().to_owned()).collect()];
    };
    let stem: Vec<String> =
        stem.split("::").map(|part| part.trim().to_owned()).filter(|p| !p.is_empty()).collect();
    let inner = inner.rsplit_once('}').map_or(inner, |(inner, _)| inner);
    let branches = branches(inner).into_iter().filter(|branch| !branch.trim().is_empty());
    branches.flat_map(expanded).map(|path| stem.iter().cloned().chain(path).collect()).collect()
}

/// Parts between the commas that stand in no braces.
fn branches(inner: &str) -> Vec<&str> {
    let (mut depth, mut from, mut parts) = (0_usize, 0, Vec::new());
    for (at, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(&inner[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&inner[from..]);
    parts
}

/// The paths of several parts in a text, but for those that say who may see something.
fn paths(body: &str) -> Vec<Vec<String>> {
    let seen_by = |before: &str| before.trim_end().ends_with("(in");
    let mut all = Vec::new();
    let mut at = 0;
    for word in body.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')) {
        let before = &body[..at];
        at = (at + word.len() + 1).min(body.len());
        while !body.is_char_boundary(at) {
            at += 1;
        }
        let parts: Vec<String> = word.split("::").map(str::to_owned).collect();
        if parts.len() > 1 && !parts[0].is_empty() && !seen_by(before) {
            all.push(parts);
        }
    }
    all
}

#[test]
fn a_circle_is_seen_through_what_is_given_on() {
    let source = |path: &str, text: &str| Source::new(format!("a/src/{path}"), text.to_owned());
    let modules = Modules::of(&[
        source("lib.rs", "mod one; mod two;\npub use one::One;\npub use two::Two;"),
        source("one.rs", "use crate::{Two};\nstruct One(Two);"),
        source("two.rs", "struct Two; fn f() -> super::one::One {}"),
        source("three.rs", "use crate::Two; pub(in crate::one) struct Three;"),
    ]);
    let circles: Vec<String> = modules.circles().iter().map(|own| format!("{own:?}")).collect();
    assert_eq!(circles, [r#"{["one"], ["two"]}"#]);
}
