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
pub fn vector(stated: Option<Ned>, range: &[Believable; 3]) -> Floored<Vector3<f64>> {
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

/// Believable sigmas of a GNSS position by fix quality, NED, m.
#[must_use]
pub fn gnss_position(quality: FixQuality) -> [Believable; 3] {
    let (least, default) = match quality {
        FixQuality::RtkFixed => (0.003, 0.02),
        FixQuality::RtkFloat => (0.02, 0.4),
        FixQuality::Differential | FixQuality::Precise => (0.05, 1.5),
        _ => (0.2, 3.0),
    };
    let horizontal = Believable { least, greatest: 1000.0, default };
    [horizontal, horizontal, Believable { default: 2.0 * default, ..horizontal }]
}

/// Believable sigmas of a GNSS velocity, NED, m/s.
#[must_use]
pub fn gnss_velocity() -> [Believable; 3] {
    let horizontal = Believable { least: 0.005, greatest: 50.0, default: 0.1 };
    [horizontal, horizontal, Believable { default: 0.2, ..horizontal }]
}

/// Believable sigmas of each component of a log, m/s; what is taken where it states none is a matter of its error model.
#[must_use]
pub fn log(default: f64) -> Believable {
    Believable { least: 0.002, greatest: 10.0, default }
}

/// Believable sigmas of the velocity of an external reference, each component, m/s.
pub const REFERENCE_VELOCITY: Believable =
    Believable { least: 0.005, greatest: 50.0, default: 0.5 };

/// Believable sigmas of its position, each component, m.
pub const REFERENCE_POSITION: Believable = Believable { least: 0.01, greatest: 1e4, default: 20.0 };

/// Believable sigmas of its heading, rad.
pub const REFERENCE_HEADING: Believable =
    Believable { least: 0.01 * DEG, greatest: 180.0 * DEG, default: DEG };

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
        let std = vector(Some(stated), &gnss_velocity());
        assert_eq!(std, Floored { value: Vector3::new(0.1, 0.2, UNTOLD), replaced: false });
        assert_eq!(slow_part(&std.value, 0.25), Vector3::new(0.05, 0.1, 0.0));
        assert_eq!(greatest_told(&std.value), 0.2);
        let absurd = vector(Some(Ned::new(f64::INFINITY, 0.2, f64::INFINITY)), &gnss_velocity());
        assert!(absurd.replaced && absurd.value.max() < 1.0);
    }
}
