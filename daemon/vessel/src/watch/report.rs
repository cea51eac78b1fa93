//! What is told of a comparison.

use std::fmt;

use insd_base::Time;
use insd_base::units::DEG;
use insd_output::alerts::AlertText;

use super::plan::WatchQuantity;

/// Most characters of each of two names in the description of an alert, and of one: it has room for 36.
const NAMES: usize = 12;
/// See [`NAMES`].
const NAME: usize = 17;

/// How a watched reference stands to another one, or to ourselves.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchComparison {
    /// Of what.
    pub quantity: WatchQuantity,
    /// Name of the sensor.
    pub sensor: String,
    /// Name of the other one; `None` for ourselves.
    pub against: Option<String>,
    /// Time of the last reading that is in it.
    pub time: Time,
    /// The sensor less the other one, averaged: of headings rad, of positions the distance, m, of attitudes that of roll and pitch
    /// together, rad.
    pub difference: f64,
    /// 1-sigma that both claim of it, rad or m; of a position of each component.
    pub sigma: f64,
    /// The limit that is set, rad or m.
    pub limit: f64,
    /// Whether it has been beyond the limit for long enough.
    pub differ: bool,
    /// Who is wrong, where that is known.
    pub wrong: Option<String>,
}

/// A comparison that turned out otherwise than before.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchChange {
    /// How it stands now.
    pub comparison: WatchComparison,
}

impl fmt::Display for WatchComparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, sensor) = (self.quantity.as_str(), &self.sensor);
        let against = self.against.as_deref().unwrap_or("insd");
        if !self.differ {
            return write!(f, "{what}: {sensor} and {against} agree again");
        }
        let (unit, name, digits) = match self.quantity {
            WatchQuantity::Position => (1.0, "m", 0),
            _ => (DEG, "deg", 1),
        };
        let [by, sigma] = [self.difference.abs() / unit, self.sigma / unit];
        write!(f, "{what}: {sensor} and {against} differ by {by:.digits$} {name}, ")?;
        write!(f, "1-sigma {sigma:.digits$}: ")?;
        match &self.wrong {
            Some(wrong) => write!(f, "{wrong} is wrong"),
            None => write!(f, "who is wrong is not known"),
        }
    }
}

/// What an alert says of comparisons that differ: who is wrong, or between whom it is; of names that are too long their begin.
pub(super) fn alert<'a>(
    mut all: impl Iterator<Item = &'a WatchComparison> + Clone,
) -> Option<AlertText> {
    let first = all.clone().next()?;
    let text = match all.find_map(|own| own.wrong.as_ref()) {
        Some(wrong) => format!("{} wrong. Do not use", begin(wrong, NAME)),
        None => {
            let against = first.against.as_deref().unwrap_or("insd");
            format!("{} and {} differ", begin(&first.sensor, NAMES), begin(against, NAMES))
        }
    };
    AlertText::new(&text).or_else(|| AlertText::new("Differ. See page"))
}

/// At most so many characters of a text.
fn begin(text: &str, most: usize) -> &str {
    text.char_indices().nth(most).map_or(text, |(end, _)| &text[..end])
}
