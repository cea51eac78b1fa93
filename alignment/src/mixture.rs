//! Mixtures of hypotheses: what they say together.

use insd_base::units::{wrap_pi, wrap_two_pi};
use insd_base::{Attitude, Ecef, Ned, Solution, SolutionSigma, earth};
use nalgebra::Vector3;

/// What weighted solutions of one instant say together; the sigmas hold the spread between them.
///
/// `None` if there is none. Weights need not sum to one.
#[must_use]
pub fn mixed(solutions: &[(f64, Solution)]) -> Option<Solution> {
    let total: f64 = solutions.iter().map(|(weight, _)| weight).sum();
    let (_, base) = solutions.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let mean = |value: &dyn Fn(&Solution) -> f64| {
        solutions.iter().map(|(weight, s)| weight * value(s)).sum::<f64>() / total
    };
    let spread = |about: f64, value: &dyn Fn(&Solution) -> (f64, f64)| {
        mean(&|s| {
            let (x, std) = value(s);
            std * std + (x - about) * (x - about)
        })
        .sqrt()
    };
    let velocity = Vector3::from_fn(|i, _| mean(&|s| s.velocity.0[i]));
    let roll = mean(&|s| s.attitude.roll);
    let pitch = mean(&|s| s.attitude.pitch);
    let heading =
        wrap_two_pi(mean(&|s| s.attitude.heading.sin()).atan2(mean(&|s| s.attitude.heading.cos())));
    let place = |s: &Solution| earth::ecef(&s.position).0;
    let centre = Vector3::from_fn(|i, _| mean(&|s| place(s)[i]));
    let position = earth::geodetic(&Ecef(centre));
    let c_ne = earth::c_ne(&position);
    let offset = |s: &Solution| c_ne * (place(s) - centre);
    let position_std =
        Vector3::from_fn(|i, _| spread(0.0, &|s| (offset(s)[i], s.sigma.position.0[i])));
    let sigma = SolutionSigma {
        position: Ned(position_std),
        velocity: Ned(Vector3::from_fn(|i, _| {
            spread(velocity[i], &|s| (s.velocity.0[i], s.sigma.velocity.0[i]))
        })),
        roll: spread(roll, &|s| (s.attitude.roll, s.sigma.roll)),
        pitch: spread(pitch, &|s| (s.attitude.pitch, s.sigma.pitch)),
        heading: spread(0.0, &|s| (wrap_pi(s.attitude.heading - heading), s.sigma.heading)),
    };
    Some(Solution {
        position,
        velocity: Ned(velocity),
        attitude: Attitude { roll, pitch, heading },
        sigma,
        ..*base
    })
}
