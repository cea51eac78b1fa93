//! What a log was learnt on: speeds and turns. What was never seen is not claimed.

use serde::{Deserialize, Serialize};

use crate::label::Label;

/// Range of speeds that shows how a scale changes with the speed, m/s: three knots.
const SPEEDS: f64 = 1.5;
/// A mean rate of turn from which on a label is one of a turn, rad/s, and so many of them show a slide.
const TURNING: f64 = 3e-3;
const TURNS: u32 = 6;

/// Speeds and turns of the labels that were learnt from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trained {
    /// Least and greatest speed that the log told, m/s.
    pub speeds_mps: Option<[f64; 2]>,
    /// Half minutes in a turn.
    pub turns: u32,
}

impl Trained {
    /// Learnt from one more.
    pub(crate) fn widen(&mut self, label: &Label) {
        let speed = label.told.x;
        let [least, most] = self.speeds_mps.get_or_insert([speed; 2]);
        (*least, *most) = (least.min(speed), most.max(speed));
        self.turns = self.turns.saturating_add(u32::from(label.turn.abs() > TURNING));
    }

    /// Whether speeds and turns differ enough to tell errors of a log from a current.
    #[must_use]
    pub fn is_enough(&self) -> bool {
        self.speeds_mps.is_some_and(|[least, most]| most - least >= SPEEDS) && self.turns >= TURNS
    }

    pub(crate) fn is_sound(&self) -> bool {
        self.speeds_mps.is_none_or(|[least, most]| (-100.0..=most).contains(&least) && most < 100.0)
    }
}
