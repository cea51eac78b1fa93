//! One epoch of a rover against one of a base, without any memory.

use insd_base::SatelliteEpoch;
use nalgebra::Vector3;

use super::codes::screen;
use super::difference::{BaseEpoch, differences};
use super::double::DoubleDifferences;
use super::float::Float;
use super::outcome::{RtkRefusal, RtkSolution};
use super::prior::RoverPrior;
use super::resolve::resolve;
use super::settings::RtkSettings;
use crate::context::Context;
use crate::single_point::SinglePoint;

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
        base: &BaseEpoch<'_>,
    ) -> Result<Self, RtkRefusal> {
        let age = age(rover, base);
        if age.is_nan() || age.abs() > settings.oldest {
            return Err(RtkRefusal::Age { age, limit: settings.oldest });
        }
        let mut own = Self::new(differences(context, settings, (rover, near), base));
        if own.codes() < 4 {
            return Err(RtkRefusal::TooFew { codes: own.codes() });
        }
        screen(&mut own, near);
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
        base: &BaseEpoch<'_>,
        prior: Option<&RoverPrior>,
    ) -> Result<Self, RtkRefusal> {
        let near = begin(context, rover, base, prior)?;
        let own = DoubleDifferences::of_epochs(context, settings, (rover, &near), base)?;
        let float = Float::solve(&own, &near, prior).ok_or(RtkRefusal::Geometry)?;
        Ok(Self {
            tag: rover.tag,
            age: age(rover, base),
            float: float.position,
            float_covariance: float.position_covariance(),
            phases: own.ambiguities().len(),
            half_cycles: own.half_cycles(),
            fixed: resolve(&own, &float, settings, prior),
        })
    }
}

/// A place to begin at.
pub(super) fn begin(
    context: &Context,
    rover: &SatelliteEpoch,
    base: &BaseEpoch<'_>,
    prior: Option<&RoverPrior>,
) -> Result<Vector3<f64>, RtkRefusal> {
    const ON_EARTH: std::ops::Range<f64> = 6.3e6..6.5e6;
    if !ON_EARTH.contains(&base.position.norm()) {
        return Err(RtkRefusal::BasePlace);
    }
    if let Some(prior) = prior.filter(|prior| ON_EARTH.contains(&prior.position.norm())) {
        return Ok(prior.position);
    }
    let point = SinglePoint::solve(context, rover, None).map_err(RtkRefusal::Rover)?;
    Ok(point.position)
}

/// By how much the base's epoch is older, s.
fn age(rover: &SatelliteEpoch, base: &BaseEpoch<'_>) -> f64 {
    rover.tag.since(base.epoch.tag).as_seconds()
}
