//! Errors that change slowly and smoothly.

use rand_pcg::Pcg64;

use crate::random::{normal, uniform};

/// Components of a wander.
const COMPONENTS: usize = 5;

/// A sum of sinusoids of random period and phase, normal at every instant: E[x(t)^2] = std^2.
///
/// Its derivative is bounded, unlike that of a first-order Gauss-Markov process: one of 0.5 m and half an hour
/// would change the phase of a carrier by 17 mm from second to second.
#[derive(Clone, Debug)]
pub(crate) struct Wander {
    /// Rate, rad/s, and the factors of cosine and sine.
    components: [[f64; 3]; COMPONENTS],
}

impl Wander {
    /// One of standard deviation `std`; its periods are strewn evenly from half to one and a half times `period`, s.
    pub(crate) fn new(std: f64, period: f64, rng: &mut Pcg64) -> Self {
        let size = std / (COMPONENTS as f64).sqrt();
        let components = std::array::from_fn(|_| {
            let own = uniform(rng, 0.5 * period, 1.5 * period);
            [std::f64::consts::TAU / own, size * normal(rng), size * normal(rng)]
        });
        Wander { components }
    }

    /// The value at time `t`, s.
    pub(crate) fn at(&self, t: f64) -> f64 {
        let value = |[rate, cosine, sine]: [f64; 3]| {
            let (sin, cos) = (rate * t).sin_cos();
            cosine * cos + sine * sin
        };
        self.components.into_iter().map(value).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, numbered};
    use approx::assert_relative_eq;

    #[test]
    fn a_wander_has_its_std_and_moves_slowly() {
        let wanders: Vec<Wander> = (0..2000)
            .map(|number| Wander::new(0.5, 2400.0, &mut numbered(3, Purpose::OrbitError, number)))
            .collect();
        let rms = |value: &dyn Fn(&Wander) -> f64| {
            let sum: f64 = wanders.iter().map(|wander| value(wander).powi(2)).sum();
            (sum / wanders.len() as f64).sqrt()
        };
        assert_relative_eq!(rms(&|w| w.at(777.0)), 0.5, max_relative = 0.05);
        assert!(rms(&|w| w.at(778.0) - w.at(777.0)) < 0.003);
    }
}
