//! Docking aids: distances of heads, and positions between targets ashore as distances from two axes.

use insd_wire::nmea::{Pinsd, Rls, Sentence};

use super::Reading;
use super::heading::{North, finished, told};
use crate::config::SensorConfig;
use crate::event::Refusal;

/// A distance of one head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadDistance {
    /// Its number; of a local position reference 1 along its axis A and 2 along B.
    pub head: u32,
    /// Distance, m; `None` where there is none.
    pub distance: Option<f64>,
    /// 1-sigma as the device claims, m.
    pub std: Option<f64>,
    /// Time from the measurement to the message, s.
    pub age: f64,
}

/// A distance by the sentence of our own.
pub(super) fn own(sentence: &Sentence) -> Vec<Reading> {
    let Sentence::Pinsd(Pinsd::Range(told)) = sentence else { return vec![Reading::Idle] };
    let Some(head) = told.head else { return vec![Reading::Idle] };
    vec![Reading::Range(HeadDistance {
        head,
        distance: told.distance.filter(|_| told.valid),
        std: told.std.filter(|std| *std > 0.0),
        age: told.age.unwrap_or(0.0),
    })]
}

/// A position and a heading between targets. The heading is that from axis A, and what the configuration adds makes it true; where there is
/// none, as with a single target, nothing is said of it.
pub(super) fn rls(sentence: &Sentence, config: &SensorConfig) -> Result<Vec<Reading>, Refusal> {
    let Sentence::Rls(Rls { a, b, position_valid, bearing, bearing_valid, .. }) = sentence else {
        return Ok(vec![Reading::Idle]);
    };
    let along = |head: u32, value: Option<f64>| {
        let distance = value.filter(|_| *position_valid);
        Reading::Range(HeadDistance { head, distance, std: None, age: 0.0 })
    };
    let mut readings = vec![along(1, *a), along(2, *b)];
    if *bearing_valid && bearing.is_some() {
        readings.extend(finished(told(*bearing, North::True, true), config)?);
    }
    Ok(readings)
}
