//! Times and sizes of faults: given, or drawn at random.

use serde::Deserialize;

use super::fault::Faults;

/// A number, or a pair from between which one is drawn for each occurrence.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(untagged, expecting = "expected a number or a pair [low, high]")]
pub(crate) enum Spread {
    /// Always this.
    Fixed(f64),
    /// Uniform between the two.
    Between([f64; 2]),
}

impl Spread {
    /// The lowest and the highest value.
    pub(crate) fn bounds(self) -> [f64; 2] {
        match self {
            Spread::Fixed(value) => [value, value],
            Spread::Between(pair) => pair,
        }
    }

    /// Expects values in [low, high], in order.
    pub(crate) fn check(self, key: &str, low: f64, high: f64, faults: &mut Faults) {
        let [from, to] = self.bounds();
        faults.range(key, from, low, high);
        faults.range(key, to, low, high);
        if from > to {
            faults.add(key, format!("expected [low, high], found [{from}, {to}]"));
        }
    }
}

/// When something happens: at the times `at_s`, or `count` times in `window_s`, evenly strewn.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct When {
    /// Beginnings, s.
    pub(crate) at_s: Vec<f64>,
    /// How many times within the window.
    pub(crate) count: u32,
    /// First and last moment, s.
    pub(crate) window_s: Option<[f64; 2]>,
}

impl When {
    /// Expects either times or a count with its window, wide enough for `longest` s each.
    pub(crate) fn check(&self, key: &str, longest: f64, faults: &mut Faults) {
        for (index, at) in self.at_s.iter().enumerate() {
            faults.not_negative(format!("{key}.at_s[{index}]"), *at);
        }
        match (self.at_s.is_empty(), self.count, self.window_s) {
            (false, 0, None) => {}
            (true, 1.., Some([from, to])) => {
                faults.not_negative(format!("{key}.window_s"), from);
                if to - from < longest * f64::from(self.count) {
                    let problem = format!(
                        "expected at least {} s of room for {} times {longest} s, found {} s",
                        longest * f64::from(self.count),
                        self.count,
                        to - from
                    );
                    faults.add(format!("{key}.window_s"), problem);
                }
            }
            _ => faults.add(key, "expected either at_s, or both count (1 or more) and window_s"),
        }
    }
}

/// How late a message reaches the computer: `fixed_s` plus a uniform draw from [0, `random_s`].
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Delay {
    /// Delay of every message, s.
    pub(crate) fixed_s: f64,
    /// Largest additional delay, s.
    pub(crate) random_s: f64,
}

impl Delay {
    /// Expects delays of up to an hour.
    pub(crate) fn check(self, key: &str, faults: &mut Faults) {
        faults.range(format!("{key}.fixed_s"), self.fixed_s, 0.0, 3600.0);
        faults.range(format!("{key}.random_s"), self.random_s, 0.0, 3600.0);
    }
}
