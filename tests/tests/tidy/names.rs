//! The public types of a crate: those that others can name.

use std::collections::{BTreeMap, BTreeSet};

use crate::modules::{Module, Modules, module};
use crate::source::Source;

/// Beginnings of lines that declare a type.
const DECLARATIONS: [&str; 4] = ["pub struct ", "pub enum ", "pub trait ", "pub type "];

/// The names of all types that can be named from outside a crate.
pub(crate) fn public_types(sources: &[Source]) -> BTreeSet<String> {
    let modules = Modules::of(sources);
    let codes: BTreeMap<Module, &str> =
        sources.iter().map(|source| (module(&source.path), source.code.as_str())).collect();
    let mut names = BTreeSet::new();
    for (module, named) in modules.named() {
        let code = codes[module];
        if !is_open(&codes, module) {
            continue;
        }
        names.extend(declared(code));
        let given = named.iter().filter(|named| named.is_given_on);
        names.extend(given.filter_map(|named| {
            let name = named.path.last()?;
            let home = modules.home(module, &named.path)?;
            declared(codes[&home]).find(|own| own == name)
        }));
    }
    names
}

/// Whether a module and all above it can be named from outside.
fn is_open(codes: &BTreeMap<Module, &str>, module: &Module) -> bool {
    (1..=module.len()).all(|depth| {
        let (parent, own) = (&module[..depth - 1], &module[depth - 1]);
        let line = format!("pub mod {own};");
        codes.get(parent).is_some_and(|code| code.lines().any(|own| own == line))
    })
}

fn declared(code: &str) -> impl Iterator<Item = String> {
    code.lines().filter_map(|line| {
        let rest = DECLARATIONS.iter().find_map(|start| line.strip_prefix(start))?;
        Some(rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect())
    })
}
