//! Standard deviations as stated by sensors, made believable: missing, zero, negative, not finite
//! or absurd ones are replaced, and the caller is told.

use insd_base::units::DEG;
use insd_base::{FixQuality, Ned};
use nalgebra::Vector3;

/// A sigma to use and whether it had to be replaced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floored<T> {
    /// Sigma to use.
    pub value: T,
    /// Whether the stated one was not usable.
    pub replaced: bool,
}

/// The range in which a stated sigma is believed, and what is taken where none is stated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Believable {
    /// Least believable sigma.
    pub least: f64,
    /// Greatest sigma worth using.
    pub greatest: f64,
    /// Where none is stated.
    pub default: f64,
}

/// Sigma of a scalar.
#[must_use]
pub fn scalar(stated: Option<f64>, range: &Believable) -> Floored<f64> {
    match stated {
        Some(std) if std.is_finite() && std > 0.0 => {
            let value = std.clamp(range.least, range.greatest);
            Floored { value, replaced: value != std }
        }
        _ => Floored { value: range.default, replaced: true },
    }
}

/// Sigma of a component that a receiver does not tell: so large that even a day of epochs weighs nothing.
pub const UNTOLD: f64 = 1e6;

/// Sigma of each component of a vector; [`UNTOLD`] for a down component whose sigma alone is infinite.
#[must_use]
fn vector(stated: Option<Ned>, range: &[Believable; 3]) -> Floored<Vector3<f64>> {
    let untold =
        stated.is_some_and(|std| std.0.z == f64::INFINITY && std.0.xy().amax() != f64::INFINITY);
    let each: [Floored<f64>; 3] = std::array::from_fn(|i| {
        if untold && i == 2 {
            return Floored { value: UNTOLD, replaced: false };
        }
        scalar(stated.map(|std| std.0[i]), &range[i])
    });
    Floored {
        value: Vector3::from_fn(|i, _| each[i].value),
        replaced: each.iter().any(|f| f.replaced),
    }
}

/// The slowly varying part of a sigma, of the variance of which a share is slow. There is none in a
/// component that is not told: its filter state must not learn from it.
#[must_use]
pub fn slow_part(std: &Vector3<f64>, share: f64) -> Vector3<f64> {
    std.map(|std| if std < UNTOLD { std * share.sqrt() } else { 0.0 })
}

/// The greatest sigma of those components that are told.
#[must_use]
pub fn greatest_told(std: &Vector3<f64>) -> f64 {
    std.iter().copied().filter(|std| *std < 0.1 * UNTOLD).fold(0.0, f64::max)
}

/// The sigmas that are believed of each source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floors {
    /// Of a GNSS position, north and east, m, by its solution: code, differential, float and fixed carrier ambiguities. Where no
    /// height is stated its sigma is twice as large.
    pub code: Believable,
    /// See [`Floors::code`].
    pub differential: Believable,
    /// See [`Floors::code`].
    pub rtk_float: Believable,
    /// See [`Floors::code`].
    pub rtk_fixed: Believable,
    /// Of a GNSS velocity, north and east, m/s; likewise.
    pub gnss_velocity: Believable,
    /// Of each component of a log, m/s.
    pub log: Believable,
    /// Of the velocity of an external reference, each component, m/s.
    pub reference_velocity: Believable,
    /// Of its position, each component, m.
    pub reference_position: Believable,
    /// Of its heading, rad.
    pub reference_heading: Believable,
}

impl Default for Floors {
    fn default() -> Self {
        let position = |least, default| Believable { least, greatest: 1000.0, default };
        Floors {
            code: position(0.2, 3.0),
            differential: position(0.05, 1.5),
            rtk_float: position(0.02, 0.4),
            rtk_fixed: position(0.003, 0.02),
            gnss_velocity: Believable { least: 0.005, greatest: 50.0, default: 0.1 },
            log: Believable { least: 0.002, greatest: 10.0, default: 0.1 },
            reference_velocity: Believable { least: 0.005, greatest: 50.0, default: 0.5 },
            reference_position: Believable { least: 0.01, greatest: 1e4, default: 20.0 },
            reference_heading: Believable {
                least: 0.01 * DEG,
                greatest: 180.0 * DEG,
                default: DEG,
            },
        }
    }
}

impl Floors {
    /// The sigma of a GNSS position, NED, m, by what is stated and the quality of the fix.
    #[must_use]
    pub fn gnss_position(&self, stated: Option<Ned>, quality: FixQuality) -> Floored<Vector3<f64>> {
        vector(
            stated,
            &with_height(match quality {
                FixQuality::RtkFixed => self.rtk_fixed,
                FixQuality::RtkFloat => self.rtk_float,
                FixQuality::Differential | FixQuality::Precise => self.differential,
                _ => self.code,
            }),
        )
    }

    /// The sigma of a GNSS velocity, NED, m/s, by what is stated.
    #[must_use]
    pub fn gnss_velocity(&self, stated: Option<Ned>) -> Floored<Vector3<f64>> {
        vector(stated, &with_height(self.gnss_velocity))
    }
}

fn with_height(horizontal: Believable) -> [Believable; 3] {
    [horizontal, horizontal, Believable { default: 2.0 * horizontal.default, ..horizontal }]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_zero_negative_and_endless_sigmas_are_replaced() {
        let range = Believable { least: 0.1, greatest: 10.0, default: 1.0 };
        for stated in [None, Some(0.0), Some(-3.0), Some(f64::NAN), Some(f64::INFINITY)] {
            assert_eq!(scalar(stated, &range), Floored { value: 1.0, replaced: true });
        }
        assert_eq!(scalar(Some(0.01), &range), Floored { value: 0.1, replaced: true });
        assert_eq!(scalar(Some(1e9), &range), Floored { value: 10.0, replaced: true });
        assert_eq!(scalar(Some(2.5), &range), Floored { value: 2.5, replaced: false });
    }

    #[test]
    fn a_component_that_is_not_told_weighs_nothing() {
        let stated = Ned::new(0.1, 0.2, f64::INFINITY);
        let std = Floors::default().gnss_velocity(Some(stated));
        assert_eq!(std, Floored { value: Vector3::new(0.1, 0.2, UNTOLD), replaced: false });
        assert_eq!(slow_part(&std.value, 0.25), Vector3::new(0.05, 0.1, 0.0));
        assert_eq!(greatest_told(&std.value), 0.2);
        let absurd =
            Floors::default().gnss_velocity(Some(Ned::new(f64::INFINITY, 0.2, f64::INFINITY)));
        assert!(absurd.replaced && absurd.value.max() < 1.0);
    }
}
