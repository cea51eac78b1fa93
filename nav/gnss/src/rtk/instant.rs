//! One epoch of a rover against one of a base, without any memory.

use insd_base::SatelliteEpoch;
use nalgebra::Vector3;

use super::codes::{CodeLevel, screen};
use super::difference::{PlacedEpoch, differences};
use super::double::DoubleDifferences;
use super::float::Float;
use super::outcome::{RtkFix, RtkRefusal, RtkSolution};
use super::prior::RoverPrior;
use super::resolve::resolve;
use super::settings::RtkSettings;
use crate::context::Context;
use crate::single_point::SinglePoint;

/// How far from the middle of the Earth an antenna may be, m.
const ON_EARTH: std::ops::Range<f64> = 6.3e6..6.5e6;

impl DoubleDifferences {
    /// The double differences of a rover near a place, ECEF, m, and a base. Codes that contradict the others have next to no weight, and all weigh as their
    /// residuals show.
    ///
    /// # Errors
    /// [`RtkRefusal`] where base data are too old, or too few satellites are common.
    pub fn of_epochs(
        context: &Context,
        settings: &RtkSettings,
        (rover, near): (&SatelliteEpoch, &Vector3<f64>),
        base: &PlacedEpoch<'_>,
    ) -> Result<Self, RtkRefusal> {
        Self::with_level(context, settings, (rover, near), base, &mut CodeLevel::default())
    }

    /// The same with what is known of the noise of codes.
    pub(super) fn with_level(
        context: &Context,
        settings: &RtkSettings,
        (rover, near): (&SatelliteEpoch, &Vector3<f64>),
        base: &PlacedEpoch<'_>,
        level: &mut CodeLevel,
    ) -> Result<Self, RtkRefusal> {
        check_age(settings, rover, base)?;
        let mut own = Self::new(differences(context, settings, (rover, near), base));
        if own.codes() < 4 {
            return Err(RtkRefusal::TooFew { codes: own.codes() });
        }
        *level = screen(&mut own, near, *level);
        Ok(own)
    }

    /// Phases that are left out as they may be wrong by half a cycle.
    #[must_use]
    pub fn half_cycles(&self) -> usize {
        self.singles.iter().filter(|single| single.is_half).count()
    }
}

impl RtkSolution {
    /// A single epoch: differences, real ambiguities, integers if they are sure. With a prior that has a covariance, its information is used, and integers that
    /// contradict it are refused.
    ///
    /// # Errors
    /// Why there is not even a position with real ambiguities.
    pub fn single_epoch(
        context: &Context,
        settings: &RtkSettings,
        rover: &SatelliteEpoch,
        base: &PlacedEpoch<'_>,
        prior: Option<&RoverPrior>,
    ) -> Result<Self, RtkRefusal> {
        Self::of_epoch(context, settings, (rover, base), prior, &mut CodeLevel::default())
    }

    /// The same with what is known of the noise of codes.
    pub(super) fn of_epoch(
        context: &Context,
        settings: &RtkSettings,
        (rover, base): (&SatelliteEpoch, &PlacedEpoch<'_>),
        prior: Option<&RoverPrior>,
        level: &mut CodeLevel,
    ) -> Result<Self, RtkRefusal> {
        let near = begin(context, settings, (rover, base), prior)?;
        let known = level.worth();
        let own = DoubleDifferences::with_level(context, settings, (rover, &near), base, level)?;
        let float = Float::solve(&own, &near, prior).ok_or(RtkRefusal::Geometry)?;
        let float = Float { known, ..float };
        let fixed = resolve(&own, &float, settings, prior);
        Ok(Self::told((rover, base), &own, &float, fixed))
    }

    /// All that is known of an epoch once its integers have been looked for.
    pub(super) fn told(
        (rover, base): (&SatelliteEpoch, &PlacedEpoch<'_>),
        own: &DoubleDifferences,
        float: &Float,
        fixed: Result<RtkFix, RtkRefusal>,
    ) -> Self {
        Self {
            tag: rover.tag,
            age: age(rover, base),
            float: float.position,
            float_covariance: float.position_covariance(),
            phases: own.ambiguities().len(),
            half_cycles: own.half_cycles(),
            fixed,
            withdrawn: None,
        }
    }
}

/// A place to begin at, and a base that is where it says.
pub(super) fn begin(
    context: &Context,
    settings: &RtkSettings,
    (rover, base): (&SatelliteEpoch, &PlacedEpoch<'_>),
    prior: Option<&RoverPrior>,
) -> Result<Vector3<f64>, RtkRefusal> {
    check_age(settings, rover, base)?;
    check_base(context, base)?;
    match prior.filter(|prior| ON_EARTH.contains(&prior.position.norm())) {
        Some(prior) => Ok(prior.position),
        None => {
            let point = SinglePoint::solve(context, rover, None).map(|point| point.position);
            let by_base =
                |why| coarse(context, settings, (rover, base)).ok_or(RtkRefusal::Rover(why));
            point.or_else(by_base)
        }
    }
}

/// A place by codes against the base, beginning there: they agree where codes alone contradict one another, as what is wrong with both is gone.
fn coarse(
    context: &Context,
    settings: &RtkSettings,
    (rover, base): (&SatelliteEpoch, &PlacedEpoch<'_>),
) -> Option<Vector3<f64>> {
    let mut place = base.position;
    // from the second on the air above the rover is its own
    for _ in 0..2 {
        let mut own = DoubleDifferences::new(differences(context, settings, (rover, &place), base));
        if own.codes() < 4 {
            return None;
        }
        screen(&mut own, &place, CodeLevel::default());
        place = Float::solve(&own, &place, None)?.position;
    }
    ON_EARTH.contains(&place.norm()).then_some(place)
}

fn check_age(
    settings: &RtkSettings,
    rover: &SatelliteEpoch,
    base: &PlacedEpoch<'_>,
) -> Result<(), RtkRefusal> {
    let age = age(rover, base);
    if age.abs() <= settings.oldest {
        return Ok(());
    }
    Err(RtkRefusal::Age { age, limit: settings.oldest })
}

/// The base's coordinates against its own codes, which know it to metres: a base that is taken for another, or for the rover, is found.
fn check_base(context: &Context, base: &PlacedEpoch<'_>) -> Result<(), RtkRefusal> {
    const SIGMAS: f64 = 6.0;
    // what errors of orbits and air share among satellites for an hour
    const SLOW: f64 = 10.0;
    if !ON_EARTH.contains(&base.position.norm()) {
        return Err(RtkRefusal::BasePlace { off: base.position.norm(), limit: SLOW });
    }
    // codes that make no position say nothing against it
    let Ok(point) = SinglePoint::solve(context, base.epoch, Some(base.position)) else {
        return Ok(());
    };
    let off = (point.position - base.position).norm();
    let limit = SLOW + SIGMAS * point.covariance.trace().max(0.0).sqrt();
    if off > limit {
        return Err(RtkRefusal::BasePlace { off, limit });
    }
    Ok(())
}

/// By how much the base's epoch is older, s.
fn age(rover: &SatelliteEpoch, base: &PlacedEpoch<'_>) -> f64 {
    rover.tag.since(base.epoch.tag).as_seconds()
}
