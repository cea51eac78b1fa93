//! Counts by name, bounded.

use serde::Serialize;

/// Names that are told apart.
const NAMES: usize = 32;

/// How often a name was met.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Counted {
    /// The name.
    pub name: String,
    /// How often.
    pub count: u64,
}

/// How often each name was met.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally(Vec<Counted>);

impl Tally {
    /// Counts a name; one that is met after very many others is left out.
    pub(super) fn add(&mut self, name: &str) {
        let is_room = self.0.len() < NAMES;
        match self.0.iter_mut().find(|counted| counted.name == name) {
            Some(counted) => counted.count += 1,
            None if is_room => {
                self.0.push(Counted { name: name.to_owned(), count: 1 });
            }
            None => {}
        }
    }

    /// All of them, by name.
    pub(super) fn sorted(&self) -> Vec<Counted> {
        let mut all = self.0.clone();
        all.sort_by(|a, b| a.name.cmp(&b.name));
        all
    }
}
