//! Labels: what the log said and what it ought to have said, in means of half a minute.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// Length of a label, s.
pub const LENGTH: f64 = 30.0;
/// Words of the log that a label is made of at least.
const FEWEST: u32 = 8;
/// A heading known to less tells crosswise errors of the log that are its own, 1-sigma, rad.
const HEADING: f64 = 0.0175;
/// A velocity known to less is no label, 1-sigma, m/s.
const VELOCITY: f64 = 0.05;

/// One word of a log beside the solution at its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelLook {
    /// When, s.
    pub time: f64,
    /// What the log says, forward and starboard, m/s.
    pub told: Vector2<f64>,
    /// Stated 1-sigma of either, m/s.
    pub told_std: f64,
    /// Velocity over the Earth at the log by the aided solution, forward and starboard, m/s.
    pub aided: Vector2<f64>,
    /// Its 1-sigma, m/s.
    pub aided_std: f64,
    /// Heading, rad, and its 1-sigma.
    pub heading: f64,
    /// 1-sigma of the heading, rad.
    pub heading_std: f64,
    /// Rate of turn, rad/s.
    pub turn: f64,
}

/// Mean of half a minute of looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Label {
    /// Its end, s.
    pub time: f64,
    /// What the log said, m/s.
    pub told: Vector2<f64>,
    /// What the log said beyond the velocity over the Earth, m/s.
    pub beyond: Vector2<f64>,
    /// Its variance, (m/s)^2.
    pub variance: Vector2<f64>,
    /// Mean direction of the heading as cosine and sine.
    pub bow: Vector2<f64>,
    /// Mean rate of turn, rad/s.
    pub turn: f64,
}

/// Puts looks together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Collector {
    begun: Option<f64>,
    count: u32,
    told: Vector2<f64>,
    beyond: Vector2<f64>,
    white: f64,
    by_heading: Vector2<f64>,
    bow: Vector2<f64>,
    turn: f64,
}

impl Collector {
    /// Takes a look; returns the label that it completes. What is not known well enough spoils the half minute.
    pub fn take(&mut self, look: &LabelLook) -> Option<Label> {
        let is_good = look.aided_std < VELOCITY && look.heading_std < HEADING;
        if !is_good {
            self.spoil();
            return None;
        }
        let begun = *self.begun.get_or_insert(look.time);
        self.count += 1;
        self.told += look.told;
        self.beyond += look.told - look.aided;
        // the error of a heading turns what goes ahead to the side, and lasts longer than a label
        let white = look.told_std.powi(2) + look.aided_std.powi(2);
        let by_heading = (look.aided * look.heading_std).map(|part| part * part);
        self.white += white;
        self.by_heading += Vector2::new(by_heading.y, by_heading.x);
        self.bow += Vector2::new(look.heading.cos(), look.heading.sin());
        self.turn += look.turn;
        (look.time - begun >= LENGTH).then(|| self.finish(look.time)).flatten()
    }

    /// GNSS is lost, or known no longer: what was begun is no label.
    pub fn spoil(&mut self) {
        *self = Collector::default();
    }

    fn finish(&mut self, time: f64) -> Option<Label> {
        let all = std::mem::take(self);
        let n = f64::from(all.count);
        let label = Label {
            time,
            told: all.told / n,
            beyond: all.beyond / n,
            variance: (all.by_heading / n).add_scalar(all.white / (n * n)),
            bow: all.bow.normalize(),
            turn: all.turn / n,
        };
        (all.count >= FEWEST && label.bow.iter().all(|x| x.is_finite())).then_some(label)
    }
}
