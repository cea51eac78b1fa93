//! What the whole-ship tests share: shipped scenarios and variants of them, a voyage through the
//! engine in memory, and scores.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

/// The examples of the document are held by the compiler.
#[cfg(doctest)]
#[doc = include_str!("../../ARCHITECTURE.md")]
struct Architecture;

pub mod caster;
pub mod engines;
pub mod noise_free;
pub mod pages;
pub mod programs;
pub mod raw_feed;
pub mod recorded;
pub mod sailing;
pub mod scores;
pub mod wire;

pub use insd_simulator::feed;
use insd_simulator::{Scenario, shipped};

/// A shipped scenario by its number.
#[must_use]
pub fn scenario(number: usize) -> Scenario {
    variant(number, &[])
}

/// A shipped scenario with pieces of its text replaced. A piece that is not there is a mistake of
/// the test, or of who changed the scenario.
#[must_use]
pub fn variant(number: usize, replacements: &[(&str, &str)]) -> Scenario {
    let (file, text) = shipped()[number - 1];
    let mut text = text.to_owned();
    for (old, new) in replacements {
        assert!(text.contains(old), "{file} has no {old:?}");
        text = text.replace(old, new);
    }
    Scenario::from_toml(&text).unwrap_or_else(|fault| panic!("{file}: {fault}"))
}

/// The shipped port of raw satellites on two bands, with a base 4 km away; further pieces of its text replaced.
#[must_use]
pub fn port_with_base(replacements: &[(&str, &str)]) -> Scenario {
    let base = "common_clock = [1]\nfrequencies = 2\n[raw.base]\nlat_deg = 35.03\nlon_deg = 135.85\nheight_m = 60.0\n";
    variant(26, &[&[("common_clock = [1]\n", base)], replacements].concat())
}
