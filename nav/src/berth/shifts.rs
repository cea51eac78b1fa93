//! A ship that is shifted on her lines, by a gust or a tug: she is not where she was, and her mean place is set free.

use insd_base::{Span, Time};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::error_state::{Errors, Innovation, POSITION, VELOCITY, Weighed};
use crate::filter::Judged;
use crate::{Filter, Outcome};

/// Finds shifts in what the berth says sample by sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Shifts {
    /// From sample to sample, s.
    spacing: f64,
    start: Time,
    free_until: Time,
    refused: u32,
    count: u32,
    /// What the last samples have done to the estimate, sooner or later forgotten.
    recent: Errors,
    /// Running mean of the samples' innovations in units of their sigma.
    lean: Vector2<f64>,
}

/// What became of a sample.
pub(super) struct Told {
    /// How it was judged, if it was accepted.
    pub(super) judged: Option<Judged>,
    /// Its log-likelihood.
    pub(super) likelihood: f64,
    /// Each component over its sigma, bounded; nothing if that is out of range.
    pub(super) residual: Option<Vector2<f64>>,
}

/// Before this the filter is still finding its tilt, s.
const SETTLING: f64 = 90.0;
/// Samples one after the other that do not fit before the ship counts as shifted.
const SHIFT: u32 = 2;
/// Sigmas beyond which a single wild sample is the gate's affair, and says little of the next.
const WILD: f64 = 4.0;
/// After a shift was found, her mean place stays free for this long, s.
const FREE: f64 = 20.0;
/// Weight of a sample in the running mean of the innovations. Of white ones with weight w the mean has a
/// variance of w / (2 - w); a ship that begins to leave gives one after the other of the same sign.
const LEANING: f64 = 0.4;
/// Square of that mean over its variance beyond which she is not where she was: once in 10,000 samples.
const LEAN: f64 = 18.4;
/// A shift is found some samples after it began: for so long what they do to the estimate is remembered, s.
const ONSET: f64 = 10.0;
/// How far it may wander from one sample to the next where it is not seen to go further, 1-sigma, m.
const WANDER: f64 = 0.5;
/// Variance, m^2, at which a sample that does not fit tells nothing any more.
const NOTHING: f64 = 1e8;

impl Shifts {
    /// Of a ship that is held from now on by a sample every so many seconds.
    pub(super) fn new(start: Time, spacing: f64) -> Self {
        Shifts {
            spacing,
            start,
            free_until: start,
            refused: 0,
            count: 0,
            recent: Errors::none(),
            lean: Vector2::zeros(),
        }
    }

    /// How often her mean place was found to have shifted.
    pub(super) fn count(&self) -> u32 {
        self.count
    }

    /// Since when the ship is held at the berth.
    pub(super) fn start(&self) -> Time {
        self.start
    }

    /// The same on a time line that is later by a span.
    pub(super) fn shifted(self, by: Span) -> Self {
        Shifts { start: self.start + by, free_until: self.free_until + by, ..self }
    }

    /// Whether her mean place is free at a time.
    pub(super) fn is_free(&self, now: Time) -> bool {
        now < self.free_until
    }

    /// Whether the filter knows its tilt.
    pub(super) fn is_settled(&self, now: Time) -> bool {
        (now - self.start).as_seconds() > SETTLING
    }

    /// Tells the filter what a sample says, when the ship is `away` from her mean place, m: accepted, or not believed,
    /// or the word that she is not where she was.
    pub(super) fn impose(
        &mut self,
        filter: &mut Filter,
        innovation: &Innovation,
        away: f64,
    ) -> Told {
        if self.is_free(filter.time()) {
            filter.loosen_berth(away.max(WANDER));
        }
        self.forget();
        filter.settle_sway();
        let weighed = innovation.weigh(filter.covariance());
        let residual = weighed.as_ref().map(bounded);
        let leaning = residual.is_some_and(|residual| self.leans(filter, &residual));
        if let Some(weighed) = weighed.as_ref().filter(|_| leaning) {
            let likelihood = filter.decline(weighed);
            self.refuse(filter, innovation, away);
            return Told { judged: None, likelihood, residual };
        }
        let before = *filter.nominal();
        let judged = filter.impose_weighed(weighed.as_ref());
        let likelihood = judged.log_likelihood;
        if judged.outcome == Outcome::Accepted {
            self.recent += &before.error_to(filter.nominal());
            self.refused = 0;
            return Told { judged: Some(judged), likelihood, residual };
        }
        self.refuse(filter, innovation, away);
        Told { judged: None, likelihood, residual }
    }

    /// Whether the last samples together do not fit, though each of them may.
    fn leans(&mut self, filter: &Filter, residual: &Vector2<f64>) -> bool {
        self.lean += (residual - self.lean) * LEANING;
        let variance = LEANING / (2.0 - LEANING);
        self.is_settled(filter.time()) && self.lean.norm_squared() > LEAN * variance
    }

    /// Carries on what the last samples have done: a velocity that is off moves the position.
    fn forget(&mut self) {
        let moved = self.recent.of(POSITION) + self.recent.of(VELOCITY) * self.spacing;
        self.recent.set(POSITION, &moved);
        self.recent.scale((-self.spacing / ONSET).exp());
    }

    /// Before the filter knows its tilt, a sample that does not fit may well be the tilt's, and counts for
    /// less. After that it is the ship who is not where she was, by a gust or for good: one sample is left
    /// out, and with more of them her mean place is free for as long as they do not fit. To weigh what does
    /// not fit just so little that it passes would draw a ship that leaves back to her berth, sample by sample.
    fn refuse(&mut self, filter: &mut Filter, innovation: &Innovation, away: f64) {
        let now = filter.time();
        self.refused += 1;
        let settled = self.is_settled(now);
        if settled && self.refused < SHIFT {
            return;
        }
        if settled {
            if self.refused == SHIFT {
                self.count += 1;
                filter.take_back(&std::mem::take(&mut self.recent));
            }
            self.free_until = now + Span::from_seconds(FREE);
            filter.loosen_berth(away);
        }
        let mut doubtful = innovation.clone();
        while filter.impose(&doubtful).outcome != Outcome::Accepted && doubtful.r[(0, 0)] < NOTHING
        {
            doubtful.r *= 4.0;
        }
    }
}

/// Each component of a sample over its sigma, bounded.
fn bounded(weighed: &Weighed) -> Vector2<f64> {
    let off = weighed.z().component_div(&weighed.sigma());
    Vector2::new(off[0], off[1]).map(|off| off.clamp(-WILD, WILD))
}
