//! What people read, in each language.
//!
//! A language is a folder of TOML files beside this source: texts by key, with placeholders like `{name}`. Programs, logs, journals
//! and everything on a wire speak English. What comes from there as an English sentence is found again in the English catalogue
//! ([`Catalogue::sentence`]), and said in the other language with the same values: so whoever shows it needs no more than the sentence.
//!
//! How a language is added, and the words that are used: `docs/languages.md`.

mod catalogue;
mod language;
mod pattern;

pub use catalogue::{Catalogue, filled};
pub use language::Language;
