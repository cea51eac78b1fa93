//! How much likelier one who seeks the heading finds what a receiver says than another who does.

use insd_alignment::EightState;
use insd_base::Rejection;
use insd_nav::{AidReport, Outcome, Report};

/// Square of an innovation, of which one is expected, beyond which it counts no more.
const OUTLIER: f64 = 25.0;
/// On a ship that hardly moves, of which more than this share of the motion that is seen may be noise, nobody is the likelier:
/// a longer arm makes more of the noise of the gyros.
const NOISY: f64 = 0.3;

/// How much likelier.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Odds {
    /// As a logarithm.
    pub(crate) logarithm: f64,
    /// Sum of the normalised squares of its innovations, and how many there were.
    pub(crate) misfit: f64,
    pub(crate) heard: f64,
}

impl Odds {
    /// Enters what a finder made of a message, `own`, beside how likely another finds it.
    pub(crate) fn weigh(&mut self, finder: &EightState, own: &Report, other: &Likelihood) {
        if finder.noise_share() < NOISY {
            let own = Likelihood::of(own);
            self.logarithm += own.logarithm - other.logarithm;
            self.misfit += own.misfit;
            self.heard += own.heard;
        }
    }
}

/// How likely a finder finds what a receiver says.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Likelihood {
    logarithm: f64,
    misfit: f64,
    heard: f64,
}

impl Likelihood {
    /// By what a finder made of a message.
    pub(crate) fn of(report: &Report) -> Self {
        let was_weighed = |aid: &&AidReport| {
            let passed = [Outcome::Accepted, Outcome::Rejected(Rejection::ChiSquare)];
            aid.aid.starts_with("gnss") && passed.contains(&aid.outcome)
        };
        let weighed = report.aids.iter().filter(was_weighed);
        let horizontal = weighed.flat_map(|aid| aid.innovation.iter().take(2));
        horizontal.fold(Likelihood::default(), |sum, (z, sigma)| {
            let square = (z / sigma).powi(2).min(OUTLIER);
            let logarithm = sum.logarithm - 0.5 * square - sigma.ln();
            Likelihood { logarithm, misfit: sum.misfit + square, heard: sum.heard + 1.0 }
        })
    }
}
