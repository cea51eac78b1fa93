//! Conversion factors between SI and the units of data sheets, wires and people.
//!
//! Multiply a value in the named unit by the constant to get SI; divide to go back.

/// Radians in one degree.
pub const DEG: f64 = std::f64::consts::PI / 180.0;
/// Radians per second in one degree per hour.
pub const DEG_PER_HOUR: f64 = DEG / 3600.0;
/// Radians per square-root second in one degree per square-root hour (angle random walk).
pub const DEG_PER_SQRT_HOUR: f64 = DEG / 60.0;
/// Metres per second per square-root second in one m/s per square-root hour (velocity random walk).
pub const MPS_PER_SQRT_HOUR: f64 = 1.0 / 60.0;
/// Metres per second squared in one micro-g, with standard gravity.
pub const MICRO_G: f64 = 9.806_65e-6;
/// One part per million.
pub const PPM: f64 = 1e-6;
/// Metres per second in one knot.
pub const KNOT: f64 = 1852.0 / 3600.0;

/// Wraps an angle to (-pi, pi].
#[must_use]
pub fn wrap_pi(angle: f64) -> f64 {
    let wrapped = wrap_two_pi(angle);
    if wrapped > std::f64::consts::PI { wrapped - std::f64::consts::TAU } else { wrapped }
}

/// Wraps an angle to [0, 2 pi).
#[must_use]
pub fn wrap_two_pi(angle: f64) -> f64 {
    let wrapped = angle.rem_euclid(std::f64::consts::TAU);
    // rem_euclid of a tiny negative angle rounds up to a full turn
    if wrapped >= std::f64::consts::TAU { 0.0 } else { wrapped }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn wrapping_keeps_the_half_open_ranges() {
        assert_eq!(wrap_two_pi(-1e-20), 0.0);
        assert_eq!(wrap_two_pi(TAU), 0.0);
        assert_eq!(wrap_pi(PI), PI);
        assert!((wrap_pi(PI + 0.1) - (0.1 - PI)).abs() < 1e-15);
        assert!((wrap_two_pi(-0.1) - (TAU - 0.1)).abs() < 1e-15);
    }
}
