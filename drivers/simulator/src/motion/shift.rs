//! Shifts of a moored ship: a gust that leaves her elsewhere on her lines, a tug that pushes a while.

use super::jet::Jet;
use super::ramp::Ramp;
use super::seaway::SeaMotion;
use crate::scenario::Shift;

/// Displacements in body axes that build up and, some of them, go away again, each along a [`Ramp`],
/// so that the acceleration is smooth.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shifts(Vec<Push>);

#[derive(Clone, Copy, Debug)]
struct Push {
    /// Forward and starboard, m.
    by: [f64; 2],
    /// From 0 to 1 and perhaps back.
    there: Ramp,
    back: Option<Ramp>,
}

impl Shifts {
    /// From the shifts of a scenario.
    pub(crate) fn new(shifts: &[Shift]) -> Self {
        Shifts(shifts.iter().map(Push::new).collect())
    }

    /// A motion with the shifts at time `t`, s, added to its surge and sway.
    pub(crate) fn added_to(&self, motion: SeaMotion, t: f64) -> SeaMotion {
        self.0.iter().fold(motion, |motion, push| {
            let share = push.share(t);
            SeaMotion {
                surge: motion.surge + share * push.by[0],
                sway: motion.sway + share * push.by[1],
                ..motion
            }
        })
    }
}

impl Push {
    fn new(shift: &Shift) -> Self {
        let ramp = |start, height| Ramp { start, length: shift.over_s, height };
        Push {
            by: [shift.forward_m, shift.starboard_m],
            there: ramp(shift.at_s, 1.0),
            back: shift.until_s.map(|until| ramp(until, -1.0)),
        }
    }

    fn share(&self, t: f64) -> Jet {
        self.there.at(t) + self.back.map_or(Jet::default(), |back| back.at(t))
    }
}
