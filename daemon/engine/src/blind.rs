//! Somebody who finds the heading without the heading reference: whether that can be believed.
//!
//! A gyrocompass that was set wrongly is as steady as one that was not. So where a heading was found with one, the
//! filter of eight states goes on without it, by gyros, course and turns alone, until it knows the heading well
//! enough to bear it out or to refute it.

use insd_alignment::EightState;
use insd_base::units::{DEG, wrap_pi};
use insd_base::{
    ExternalReference, Fault, Message, Party, Received, Solution, SolutionSigma, Time,
};
use insd_nav::{Estimator, Increment, Report};

use crate::antennas::as_heading;
use crate::images::{Images, LEADS, Verdict as Seat};
use crate::odds::{Likelihood, Odds};

/// What nobody has borne out is claimed to be no surer than this, rad.
const UNCHECKED: f64 = 2.4 * DEG;
/// A ship that is faster than this, m/s, over the ground heads where she goes, within this, rad.
const MAKES_WAY: f64 = 1.5;
const LEEWAY: f64 = 30.0 * DEG;
/// A heading known so well, rad, bears out another within so many sigmas;
const KNOWN: f64 = 1.5 * DEG;
const BEARS_OUT: f64 = 3.0;
/// one that differs by more than so many, and this, rad, for so long, s, refutes it.
const REFUTES: f64 = 5.0;
const LEAST: f64 = 1.0 * DEG;
const PERSISTS: f64 = 5.0;

/// What came of it.
#[derive(Clone, Debug)]
pub(crate) enum Word {
    /// Nothing yet.
    Open,
    /// The heading is as it was told.
    BornOut,
    /// It is not.
    Refuted,
    /// It is, and the antenna is not where it was told to be, as this finder has it.
    Elsewhere(Box<EightState>),
}

/// A finder that hears no heading.
#[derive(Clone, Debug)]
pub(crate) struct Blind {
    finder: Box<EightState>,
    /// Who tells the heading.
    whom: Party,
    differs_since: Option<Time>,
    /// How much likelier it finds what a receiver says than who hears the heading.
    odds: Odds,
    /// Those who hear the heading and take the antenna to sit elsewhere, as likely as they are beside that.
    images: Images,
    /// By how much it contradicts the heading while it is as likely that the antenna sits elsewhere, rad.
    disputed: f64,
}

impl Blind {
    /// One that knows what a finder knows before it hears a heading.
    pub(crate) fn beside(finder: &EightState, whom: Party) -> Self {
        let finder = Box::new(finder.clone());
        let (odds, images) = (Odds::default(), Images::default());
        Blind { finder, whom, differs_since: None, odds, images, disputed: 0.0 }
    }

    /// What whoever tells the heading does if it is not so.
    pub(crate) fn fault(&self) -> Fault {
        if self.whom == Party::Antennas { Fault::AntennasOffset } else { Fault::HeadingOffset }
    }

    pub(crate) fn finder(&self) -> &EightState {
        &self.finder
    }

    pub(crate) fn advance(&mut self, increment: &Increment) {
        self.finder.advance(increment);
        self.images.advance(increment);
    }

    /// Hears everything but headings.
    pub(crate) fn apply(&mut self, received: &Received) -> Report {
        self.finder.apply(&without_heading(received))
    }

    /// Goes on beside a navigator, and those with it who take the antenna to sit elsewhere.
    pub(crate) fn with_images(self, images: Images) -> Self {
        Blind { images, ..self }
    }

    /// Hears everything but headings, and they those as well.
    pub(crate) fn hear(&mut self, received: &Received) {
        let own = self.apply(received);
        self.images.apply(&as_heading(received), &own);
    }

    /// Notes what it made of a message, `own`, and who hears the heading did.
    pub(crate) fn compare(&mut self, own: &Report, told: &Report) {
        self.odds.weigh(&self.finder, own, &Likelihood::of(told));
    }

    /// How much likelier than who hears the heading it is, as a logarithm.
    pub(crate) fn odds(&self) -> f64 {
        self.odds.logarithm
    }

    /// Who seeks the heading from now on, if whoever tells it lies.
    pub(crate) fn believed(&self) -> Box<EightState> {
        let docket = self.finder.config().docket.without(self.fault(), self.finder.time());
        let mut finder = self.finder.clone();
        finder.take_docket(docket);
        finder
    }

    /// What it makes of a heading and its 1-sigma, rad.
    pub(crate) fn judge(&mut self, heading: f64, sigma: f64) -> Word {
        self.disputed = 0.0;
        let (own, own_sigma) = self.finder.heading();
        let off = wrap_pi(heading - own).abs();
        let both = own_sigma.hypot(sigma);
        let differs = self.finder.finished() && off > LEAST.max(REFUTES * both);
        if !differs {
            self.differs_since = None;
            let is_known = own_sigma < KNOWN && off < BEARS_OUT * both;
            return if is_known { Word::BornOut } else { Word::Open };
        }
        let now = self.finder.time();
        let since = *self.differs_since.get_or_insert(now);
        if (now - since).as_seconds() < PERSISTS {
            return Word::Open;
        }
        let word = self.who_is_right();
        self.disputed = if matches!(word, Word::Open) { off } else { 0.0 };
        word
    }

    /// Whether the heading was told wrongly, or where the antenna sits: what is told of either way is the same at first.
    fn who_is_right(&self) -> Word {
        match self.images.likeliest(&self.finder) {
            Some(Seat::Other(_, odds)) if (odds - self.odds()).abs() < LEADS => Word::Open,
            Some(Seat::Other(finder, odds)) if odds > self.odds() => Word::Elsewhere(finder),
            Some(Seat::Mirrored | Seat::Open) => Word::Open,
            _ => Word::Refuted,
        }
    }

    /// A solution with a heading that nobody has borne out, or which is disputed.
    pub(crate) fn covered(&self, solution: Solution) -> Solution {
        let unchecked = unchecked(solution);
        let sigma = SolutionSigma {
            heading: unchecked.sigma.heading.max(self.disputed),
            ..unchecked.sigma
        };
        Solution { sigma, ..unchecked }
    }
}

/// A solution with a heading that nobody has borne out. A ship that makes way goes where she heads, within her leeway: one that does not goes astern, or is
/// set by a stream, or antennas stand in each other's places, and who cannot tell claims half the angle.
fn unchecked(solution: Solution) -> Solution {
    let mut sigma = solution.sigma;
    let way = solution.velocity.0.xy();
    let drift = wrap_pi(way.y.atan2(way.x) - solution.attitude.heading).abs();
    let is_odd = way.norm() > MAKES_WAY && drift > LEEWAY;
    let least = if is_odd { drift / 2.0 } else { UNCHECKED };
    sigma.heading = sigma.heading.max(least);
    Solution { sigma, ..solution }
}

/// A message without the heading that it may tell.
pub(crate) fn without_heading(received: &Received) -> Received {
    let message = match &received.message {
        Message::Reference(told) => {
            Message::Reference(ExternalReference { heading: None, heading_std: None, ..*told })
        }
        other => other.clone(),
    };
    Received { message, ..*received }
}

/// Whether somebody tells a heading.
pub(crate) fn tells_heading(received: &Received) -> bool {
    matches!(received.message, Message::Reference(told) if told.heading.is_some())
}

#[cfg(test)]
mod tests {
    use insd_base::{Attitude, Body, Geodetic, Judgement, Mode, Ned, Protection, SolutionSigma};
    use nalgebra::{SVector, Vector3};

    use super::*;

    fn claimed(heading: f64, velocity: [f64; 3]) -> f64 {
        let solution = Solution {
            time: Time::START,
            position: Geodetic::from_degrees(54.0, 10.0, 0.0),
            velocity: Ned(Vector3::from(velocity)),
            attitude: Attitude { roll: 0.0, pitch: 0.0, heading: heading * DEG },
            rate: Body::default(),
            sigma: SolutionSigma::of(&SVector::repeat(0.01)),
            mode: Mode::Aided,
            judgement: Judgement::default(),
            source: Default::default(),
            hidden: Protection::default(),
        };
        unchecked(solution).sigma.heading / DEG
    }

    #[test]
    fn a_heading_that_nobody_bears_out_is_claimed_by_what_the_course_contradicts() {
        assert!((claimed(10.0, [2.0, 0.0, 0.0]) - 2.4).abs() < 1e-9);
        assert!((claimed(90.0, [2.0, 0.0, 0.0]) - 45.0).abs() < 1e-9);
        assert!((claimed(180.0, [3.0, 0.0, 0.0]) - 90.0).abs() < 1e-9);
        // alongside a ship moves any way
        assert!((claimed(90.0, [0.5, 0.0, 0.0]) - 2.4).abs() < 1e-9);
    }
}
