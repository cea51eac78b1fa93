//! Campaigns over cases that have names: kinds of faults, ships, archives of recordings.

use std::fmt::Debug;
use std::marker::PhantomData;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::declaration::{CampaignDeclaration, checksum};
use super::kept::KeptRuns;

/// Cases that are told in the report of missing ones.
const TOLD: usize = 10;

/// A list of cases, each with its name, and what comes of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseList<S> {
    /// A checksum of all that follows, as CRC-64/XZ.
    id: String,
    /// Version of the program.
    insd: String,
    /// Which campaign this is.
    catalogue: String,
    /// What changes what comes out, in words.
    options: String,
    /// The names of all cases, in the order of the report.
    cases: Vec<String>,
    #[serde(skip)]
    scores: PhantomData<fn() -> S>,
}

/// What came of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseRun<S> {
    /// Its name.
    pub case: String,
    /// Its score.
    pub score: S,
}

impl<S> CaseList<S> {
    /// A catalogue of this name. `content` is all on which the scores depend and which the names of the cases do not tell; it goes into
    /// the checksum only.
    #[must_use]
    pub fn new(name: &str, options: &str, cases: Vec<String>, content: &str) -> Self {
        let insd = env!("CARGO_PKG_VERSION").to_owned();
        let (catalogue, options) = (name.to_owned(), options.to_owned());
        let id = checksum(&format!("{insd} {catalogue} {options} {cases:?} {content}"));
        CaseList { id, insd, catalogue, options, cases, scores: PhantomData }
    }

    /// The names of all cases.
    #[must_use]
    pub fn cases(&self) -> &[String] {
        &self.cases
    }
}

impl<S> CampaignDeclaration for CaseList<S>
where
    S: Clone + Debug + PartialEq + Serialize + DeserializeOwned + Send,
{
    type Key = String;
    type Run = CaseRun<S>;
    const KEY: &'static str = "case";

    fn id(&self) -> &str {
        &self.id
    }

    fn keys(&self) -> Vec<String> {
        self.cases.clone()
    }

    fn key_of(run: &CaseRun<S>) -> String {
        run.case.clone()
    }

    fn has_key(&self, key: &String) -> bool {
        self.cases.contains(key)
    }

    fn range(&self) -> String {
        format!("the {} cases of {}", self.cases.len(), self.catalogue)
    }

    fn is_counterpart_of(&self, _: &Self) -> bool {
        true
    }

    fn facts(&self) -> Vec<(&'static str, String)> {
        vec![
            ("version", self.insd.clone()),
            ("the catalogue", self.catalogue.clone()),
            ("options", self.options.clone()),
            ("the number of cases", self.cases.len().to_string()),
            ("content of the cases", self.id.clone()),
        ]
    }
}

/// The runs of a catalogue in the order of its cases, and the names of those that are missing.
#[derive(Clone, Debug)]
pub struct CaseRuns<S> {
    /// What is there.
    pub runs: Vec<CaseRun<S>>,
    /// What is not.
    pub missing: Vec<String>,
}

impl<S> KeptRuns<CaseList<S>>
where
    S: Clone + Debug + PartialEq + Serialize + DeserializeOwned + Send,
{
    /// The runs in the order of the cases, and what is missing.
    #[must_use]
    pub fn into_cases(mut self) -> CaseRuns<S> {
        let Some(declared) = self.declared.pop() else {
            return CaseRuns { runs: Vec::new(), missing: Vec::new() };
        };
        let missing = declared.cases.iter().filter(|case| !self.has(&declared, case));
        let missing = missing.cloned().collect();
        CaseRuns { runs: self.take_runs(&declared), missing }
    }
}

impl<S> CaseRuns<S> {
    /// A sentence about what is missing; empty if nothing is.
    #[must_use]
    pub fn lack(&self) -> String {
        let count = self.missing.len();
        let told = self.missing.iter().take(TOLD).map(String::as_str).collect::<Vec<_>>();
        let more = if count > TOLD { format!(" and {} more", count - TOLD) } else { String::new() };
        match count {
            0 => String::new(),
            _ => format!("{count} cases of the campaign are missing: {}{more}\n", told.join(", ")),
        }
    }
}
