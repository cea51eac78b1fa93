//! Mixtures of hypotheses: joining filters and reporting what they say together.

use insd_base::units::{wrap_pi, wrap_two_pi};
use insd_base::{Attitude, Ecef, Ned, Solution, SolutionSigma, earth};
use insd_nav::filter::Filter;
use insd_nav::symmetry::turn_biases;
use nalgebra::Vector3;

/// Joins two filters of one instant into the first: mean and covariance of the mixture
/// (Bar-Shalom, Li and Kirubarajan, Estimation with Applications to Tracking and Navigation,
/// eq. (1.4.16-10)), each covariance seen from the mean. `share` is the weight of the second, 0..1.
pub fn join(first: &mut Filter, second: &Filter, share: f64) {
    let apart = first.nominal().error_to(second.nominal());
    let mut nominal = *first.nominal();
    nominal.inject(&apart.scaled(share));
    let seen_from_there = |filter: &Filter| {
        let mut covariance = filter.covariance().clone();
        turn_biases(&mut covariance, &filter.nominal().c_eb(), &nominal.c_eb());
        covariance
    };
    let mut covariance = seen_from_there(first).scaled(1.0 - share);
    covariance.add(&seen_from_there(second).scaled(share));
    covariance.spread(&apart.scaled((share * (1.0 - share)).sqrt()));
    first.replace(nominal, covariance);
}

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
