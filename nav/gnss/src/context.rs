//! What an epoch is computed with.

use std::collections::BTreeMap;

use insd_base::{Constellation, Geodetic, GpsTime, IonosphereModel};

use crate::atmosphere::{LookAngles, Mapping, Troposphere, klobuchar};
use crate::ephemerides::Ephemerides;
use crate::signals::Noise;

/// Relative humidity of the standard atmosphere that is assumed.
const HUMIDITY: f64 = 0.7;

/// Delay of the ionosphere at the zenith where no model is known, m: that of a middling day.
const UNTOLD: f64 = 4.0;

/// What satellites have broadcast, and what the receiver is taken for.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// Orbits and clocks.
    pub ephemerides: Ephemerides,
    /// Models of the ionosphere, by who broadcasts them.
    pub ionosphere: BTreeMap<Constellation, IonosphereModel>,
    /// The receiver's noise.
    pub noise: Noise,
}

/// What the atmosphere does to one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delays {
    /// Ionosphere at 1575.42 MHz, m: added to the code, taken from the phase.
    pub ionosphere: f64,
    /// Troposphere, m.
    pub troposphere: f64,
    /// 1-sigma of the troposphere, m: the weather, of which most is vapour.
    pub troposphere_std: f64,
}

impl Context {
    /// Delays along the ray to an antenna near the Earth's surface.
    #[must_use]
    pub fn delays(&self, antenna: &Geodetic, direction: LookAngles, time: GpsTime) -> Delays {
        let mapping = Mapping::niell(antenna, direction.elevation, time);
        Delays {
            ionosphere: self
                .klobuchar(antenna, direction, time)
                .unwrap_or_else(|| UNTOLD / direction.elevation.sin().max(0.3)),
            troposphere: Troposphere::standard(antenna, HUMIDITY).slant(mapping),
            troposphere_std: 0.1 * mapping.wet,
        }
    }

    fn klobuchar(&self, antenna: &Geodetic, direction: LookAngles, time: GpsTime) -> Option<f64> {
        let all = [Constellation::Gps, Constellation::Qzss];
        all.iter().find_map(|constellation| match self.ionosphere.get(constellation)? {
            IonosphereModel::Klobuchar { alpha, beta } => {
                Some(klobuchar((alpha, beta), antenna, direction, time))
            }
            IonosphereModel::NeQuickG { .. } => None,
        })
    }
}
