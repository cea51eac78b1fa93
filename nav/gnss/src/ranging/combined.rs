//! The codes of all bands as one range.

use insd_base::frames::Ecef;
use insd_base::satellites::Measured;
use insd_base::{BroadcastRecord, GpsTime, SignalObservation, earth};
use nalgebra::{DMatrix, DVector, Vector3};

use crate::atmosphere::LookAngles;
use crate::band_code::BandCode;
use crate::budget::{BAND_DELAY, IONOSPHERE_RAY, IONOSPHERE_SCALE, orbit_std};
use crate::context::Context;
use crate::sight::Sight;
use crate::signals::first_band;

/// The codes of all bands as one.
pub(super) struct Combined {
    /// The range and the receiver's clock with all models taken out, m, and the variance of its noise.
    pub(super) code: Measured,
    /// 1-sigma of what is slow in its error: orbit and clock, what is left of the atmosphere on this ray alone, delays that nobody tells, m.
    pub(super) slow_std: f64,
    /// How it changes with the share by which the ionosphere as a whole is more than its model, m.
    pub(super) by_ionosphere: f64,
}

/// Bands are weighed as their errors hang together (Gauss and Markov).
pub(super) fn combined_code(
    context: &Context,
    tag: GpsTime,
    (record, sight, best): (&BroadcastRecord, &Sight, &[&SignalObservation]),
    (antenna, direction): (&Vector3<f64>, LookAngles),
) -> Option<Combined> {
    let satellite = record.satellite();
    let first = first_band(satellite.constellation);
    let delays = context.delays(&earth::geodetic(&Ecef(*antenna)), direction, tag);
    let mut codes = Vec::with_capacity(best.len());
    let mut bands = Vec::with_capacity(best.len());
    for signal in best {
        let Some(band) = BandCode::new(record, sight, signal) else { continue };
        codes.push(band.code - delays.troposphere - band.dispersion * delays.ionosphere);
        let noise = band.noise(direction.elevation, context.noise.code);
        let further = if band.band == first { 0.0 } else { BAND_DELAY };
        bands.push((band.dispersion, noise, band.untold.hypot(further).powi(2)));
    }
    let (scale, ray) = (delays.ionosphere * IONOSPHERE_SCALE, delays.ionosphere * IONOSPHERE_RAY);
    let shared = orbit_std(satellite.constellation).hypot(delays.troposphere_std).powi(2);
    let slow = DMatrix::from_fn(bands.len(), bands.len(), |i, j| {
        let own = if i == j { bands[i].2 } else { 0.0 };
        shared + ray * ray * bands[i].0 * bands[j].0 + own
    });
    let noise = DMatrix::from_diagonal(&DVector::from_iterator(
        bands.len(),
        bands.iter().map(|(_, noise, _)| *noise),
    ));
    let common =
        DMatrix::from_fn(bands.len(), bands.len(), |i, j| scale * scale * bands[i].0 * bands[j].0);
    let weights = gauss_markov(&(&slow + &noise + common))?;
    let value = weights.dot(&DVector::from_vec(codes));
    let variance = (weights.transpose() * noise * &weights)[0];
    let slow_std = (weights.transpose() * slow * &weights)[0].sqrt();
    let spread = weights.iter().zip(&bands).map(|(weight, (spread, ..))| weight * spread);
    Some(Combined {
        code: Measured { value, variance },
        slow_std,
        by_ionosphere: spread.sum::<f64>() * delays.ionosphere,
    })
}

/// Weights of several measurements of one quantity, by the covariance of their errors; their sum is one.
fn gauss_markov(covariance: &DMatrix<f64>) -> Option<DVector<f64>> {
    let ones = DVector::repeat(covariance.nrows(), 1.0);
    let raw = covariance.clone().cholesky()?.solve(&ones);
    let sum = raw.sum();
    (sum > 0.0).then(|| raw / sum)
}
