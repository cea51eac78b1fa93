//! A rover that is followed from epoch to epoch.

use insd_base::SatelliteEpoch;

use super::arcs::Arcs;
use super::belief::Belief;
use super::codes::CodeLevel;
use super::difference::PlacedEpoch;
use super::double::DoubleDifferences;
use super::float::Float;
use super::instant::begin;
use super::outcome::{RtkFix, RtkRefusal, RtkSolution};
use super::prior::RoverPrior;
use super::resolve::resolve;
use super::settings::RtkSettings;
use crate::context::Context;

/// Follows a rover: by ambiguities that are carried on, or epoch by epoch with nothing but the noise of codes remembered.
///
/// ```
/// use insd_gnss::{PlacedEpoch, Context, RtkRefusal, RtkSettings, RtkTracker};
/// # use insd_base::{GpsTime, SatelliteEpoch};
/// # use nalgebra::Vector3;
/// # let context = Context::default();
/// # let tag = GpsTime::from_week(2300, 0);
/// # let of_rover = SatelliteEpoch { tag, signals: Vec::new(), leap_seconds: None, clock_reset: false };
/// # let of_base = of_rover.clone();
/// let mut tracker = RtkTracker::continuous(RtkSettings::default());
/// let base = PlacedEpoch { epoch: &of_base, position: Vector3::new(3.2e6, 5.2e5, 5.4e6) };
/// match tracker.take(&context, &of_rover, &base, None) {
///     Ok(told) => println!("{} {:?}", told.position(), told.fixed.map(|fix| fix.doubt)),
///     Err(why) => println!("{why}"),
/// }
/// ```
#[derive(Clone, Debug)]
pub struct RtkTracker {
    settings: RtkSettings,
    level: CodeLevel,
    arcs: Option<Arcs>,
    belief: Belief,
    withdrawals: usize,
}

impl RtkTracker {
    /// Ambiguities are carried on as long as both receivers track.
    #[must_use]
    pub fn continuous(settings: RtkSettings) -> Self {
        Self { arcs: Some(Arcs::default()), ..Self::single_epoch(settings) }
    }

    /// Each epoch stands for itself.
    #[must_use]
    pub fn single_epoch(settings: RtkSettings) -> Self {
        let (level, belief) = (CodeLevel::default(), Belief::default());
        Self { settings, level, arcs: None, belief, withdrawals: 0 }
    }

    /// How often a fix had to be withdrawn.
    #[must_use]
    pub fn withdrawals(&self) -> usize {
        self.withdrawals
    }

    /// Takes an epoch, with the newest of the base, and what is known of the rover's place beforehand: with a covariance it counts as a measurement, whose
    /// error should not be that of earlier epochs. All epochs of the rover should come: what is said of lost signals in one that does not is missed.
    ///
    /// # Errors
    /// Why there is not even a position with real ambiguities.
    pub fn take(
        &mut self,
        context: &Context,
        rover: &SatelliteEpoch,
        base: &PlacedEpoch<'_>,
        prior: Option<&RoverPrior>,
    ) -> Result<RtkSolution, RtkRefusal> {
        let Some(arcs) = &mut self.arcs else {
            let level = &mut self.level;
            return RtkSolution::of_epoch(context, &self.settings, (rover, base), prior, level);
        };
        arcs.hear(rover, base.epoch);
        let near = begin(context, &self.settings, (rover, base), prior)?;
        let known = self.level.worth();
        let level = &mut self.level;
        let own =
            DoubleDifferences::with_level(context, &self.settings, (rover, &near), base, level)?;
        arcs.advance(rover.tag, &own);
        let float = Float::carried(arcs, &own, &near, prior).ok_or(RtkRefusal::Geometry)?;
        let float = Float { known, ..float };
        self.belief.keep(arcs);
        // ways share the risk: what is carried on, and this epoch alone, whose reflections are others
        let half = RtkSettings { risk: self.settings.risk / 2.0, ..self.settings };
        let mut fixed = resolve(&own, &float, &half, prior);
        if fixed.is_err()
            && let Some(alone) = Float::solve(&own, &near, prior)
            && let Ok(fix) = resolve(&own, &Float { known, ..alone }, &half, prior)
            && self.belief.allows(&fix)
        {
            fixed = Ok(fix);
        }
        // integers that have been sure bear those of satellites that are new
        if fixed.is_err()
            && let Some((sure, doubt)) = self.belief.sure(&own)
            && let Some(held) = float.held(&sure)
            && let Ok(fix) = resolve(&own, &held, &half, prior)
        {
            fixed = Ok(RtkFix { doubt: fix.doubt + doubt, ..fix });
        }
        let withdrawn = self.belief.take(rover.tag, (&own, &float), fixed.as_ref().ok());
        self.withdrawals += usize::from(withdrawn.is_some());
        let told = RtkSolution::told((rover, base), &own, &float, fixed);
        Ok(RtkSolution { withdrawn, ..told })
    }
}
