//! Velocity from the Doppler shifts of one epoch.

use insd_base::{SatelliteEpoch, SatelliteId, SignalObservation};
use nalgebra::{Matrix3, RowVector4, Vector3};

use crate::budget::LOWEST;
use crate::context::Context;
use crate::least_squares::{Observation, Solved, solve};
use crate::sight::Sight;
use crate::signals::{best_of_each_band, first_band, range_rate};

/// A velocity from one epoch.
#[derive(Clone, Debug, PartialEq)]
pub struct DopplerVelocity {
    /// Of the antenna over the Earth, ECEF, m/s.
    pub velocity: Vector3<f64>,
    /// Its covariance, m^2/s^2.
    pub covariance: Matrix3<f64>,
    /// Drift of the receiver's clock, m/s.
    pub clock_drift: f64,
    /// Satellites used.
    pub used: Vec<SatelliteId>,
    /// Satellites whose shift contradicts the others.
    pub faulty: Vec<SatelliteId>,
}

impl DopplerVelocity {
    /// The velocity of an antenna at a position, ECEF, m, known to ten metres: 100 m make an error of
    /// 15 mm/s. `None` where fewer than four satellites have a Doppler shift, or
    /// the shifts contradict one another (Groves, 2nd ed., 9.4.1).
    #[must_use]
    pub fn solve(
        context: &Context,
        epoch: &SatelliteEpoch,
        position: &Vector3<f64>,
    ) -> Option<Self> {
        let satellites = epoch.signals.chunk_by(|a, b| a.satellite == b.satellite);
        let (mut satellites, mut rates): (Vec<_>, Vec<_>) =
            satellites.filter_map(|signals| rate(context, epoch, signals, position)).unzip();
        let mut faulty = Vec::new();
        loop {
            let solved = solve(&rates)?;
            let Some(worst) = solved.worst(&rates, 0.0) else {
                return Some(Self::told(&rates, &solved, satellites, faulty));
            };
            if rates.len() < 6 {
                return None;
            }
            rates.remove(worst);
            faulty.push(satellites.remove(worst));
        }
    }

    fn told(
        rates: &[Observation],
        solved: &Solved,
        used: Vec<SatelliteId>,
        faulty: Vec<SatelliteId>,
    ) -> Self {
        let x = &solved.unknowns;
        let squares: f64 = rates
            .iter()
            .map(|rate| (rate.observed - (rate.row * x)[0]).powi(2) / rate.variance)
            .sum();
        let factor = (squares / rates.len().saturating_sub(4).max(1) as f64).max(1.0);
        Self {
            velocity: Vector3::new(x[0], x[1], x[2]),
            covariance: solved.covariance.fixed_view::<3, 3>(0, 0) * factor,
            clock_drift: x[3],
            used,
            faulty,
        }
    }
}

/// The rate at which the way from a satellite grows, its own motion and clock taken out: `-e . v + c drift`, m/s.
fn rate(
    context: &Context,
    epoch: &SatelliteEpoch,
    signals: &[SignalObservation],
    position: &Vector3<f64>,
) -> Option<(SatelliteId, Observation)> {
    let best = best_of_each_band(signals);
    let satellite = best.first()?.satellite;
    let first = first_band(satellite.constellation);
    let record = context.ephemerides.select(satellite, epoch.tag).ok()?;
    let sight = Sight::new(record, epoch.tag, best.first()?.code?);
    let elevation = sight.direction(position).elevation;
    let mut shifts = best.iter().filter(|signal| signal.doppler.is_some());
    let shift = shifts.clone().find(|signal| signal.signal.band == first).or(shifts.next())?;
    let measured = range_rate(context.noise, shift, &sight.satellite, elevation)?;
    let at_rest = sight.transmitter().range_rate(position, &Vector3::zeros());
    let line = sight.transmitter().line(position);
    let observation = Observation {
        row: RowVector4::new(-line.x, -line.y, -line.z, 1.0),
        observed: measured.value - at_rest,
        variance: measured.variance,
    };
    (elevation >= LOWEST).then_some((satellite, observation))
}
