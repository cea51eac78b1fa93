//! Small functions of which the layers are made.

/// `exp(x)` that neither overflows nor vanishes (F.2.12.2): constant beyond +-80.
pub(super) fn clipped_exp(x: f64) -> f64 {
    x.clamp(-80.0, 80.0).exp()
}

/// Glides from `below` where `x` is negative to `above` where it is positive; `sharpness` is the inverse of the width
/// of the passage (F.2.12.1).
pub(super) fn join(above: f64, below: f64, sharpness: f64, x: f64) -> f64 {
    let weight = clipped_exp(sharpness * x);
    (above * weight + below) / (weight + 1.0)
}

/// Epstein's function without its factor 4 (2.5.1): a bell over `x`, 1/4 at zero.
pub(super) fn epstein(x: f64) -> f64 {
    let weight = clipped_exp(x);
    weight / (1.0 + weight).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_join_is_one_function_on_each_side_and_their_mean_between() {
        assert_eq!(join(3.0, 1.0, 60.0, -2.0), 1.0);
        assert_eq!(join(3.0, 1.0, 60.0, 2.0), 3.0);
        assert_eq!(join(3.0, 1.0, 60.0, 0.0), 2.0);
    }

    #[test]
    fn the_bell_is_even_and_highest_at_zero() {
        assert_eq!(epstein(0.0), 0.25);
        assert!((epstein(1.5) - epstein(-1.5)).abs() < 1e-15 && epstein(1.5) < 0.25);
        assert!(epstein(1e3) > 0.0 && epstein(-1e3) > 0.0);
    }
}
