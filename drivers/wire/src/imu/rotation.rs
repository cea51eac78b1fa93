//! The turn over one sampling interval as a delta quaternion and as a delta theta.
//!
//! Both say the same: q(end) = q(start) * dq, with dq = (cos(|d|/2), sin(|d|/2) d/|d|) for the
//! rotation vector d (Groves, Principles of GNSS, Inertial and Multisensor Integrated Navigation
//! Systems, 2nd ed., appendix E.6). For a turn about a fixed axis d is the integral of the rate.
//! Held by `a_turn_below_half_a_revolution_comes_back`.

/// Below this angle, rad, the next term of the series is lost in the rounding of an `f64`.
const SMALL: f64 = 1e-8;

/// The quaternion (w, x, y, z) of a rotation vector, rad.
#[must_use]
pub fn quaternion_of(delta_theta: [f64; 3]) -> [f64; 4] {
    let angle = norm(delta_theta);
    let half = angle / 2.0;
    let factor = if angle > SMALL { half.sin() / angle } else { 0.5 };
    let [x, y, z] = delta_theta.map(|component| component * factor);
    [half.cos(), x, y, z]
}

/// The rotation vector, rad, of a quaternion (w, x, y, z) of any length but zero: the shorter of the
/// two turns that it stands for. NaN for the zero quaternion, which stands for none.
#[must_use]
pub fn delta_theta_of(quaternion: [f64; 4]) -> [f64; 3] {
    let [w, x, y, z] = quaternion.map(|part| if quaternion[0] < 0.0 { -part } else { part });
    let sine = norm([x, y, z]);
    let factor = if sine > SMALL * w { 2.0 * sine.atan2(w) / sine } else { 2.0 / w };
    [x, y, z].map(|component| component * factor)
}

fn norm(vector: [f64; 3]) -> f64 {
    vector.iter().map(|component| component * component).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
        norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]])
    }

    #[test]
    fn a_quarter_turn_about_down_has_equal_first_and_last_parts() {
        let [w, x, y, z] = quaternion_of([0.0, 0.0, FRAC_PI_2]);
        assert!((w - z).abs() < 1e-15 && x == 0.0 && y == 0.0 && z > 0.0);
    }

    #[test]
    fn length_and_sign_of_a_quaternion_do_not_matter() {
        let turn = [0.01, -0.02, 0.003];
        for scale in [1.000_001, 0.5, -1.0, -3.0] {
            let scaled = quaternion_of(turn).map(|part| part * scale);
            assert!(distance(delta_theta_of(scaled), turn) < 1e-16);
        }
    }

    #[test]
    fn the_zero_quaternion_is_no_turn_at_all() {
        assert!(delta_theta_of([0.0; 4]).iter().all(|component| component.is_nan()));
        assert_eq!(delta_theta_of([1.0, 0.0, 0.0, 0.0]), [0.0; 3]);
    }

    proptest! {
        #[test]
        fn a_turn_below_half_a_revolution_comes_back(
            axis in prop::array::uniform3(-1.0..1.0_f64),
            decades in -14.0..1.0_f64,
        ) {
            let length = norm(axis);
            prop_assume!(length > 1e-3);
            let angle = 10.0_f64.powf(decades).min(PI - 1e-9);
            let turn = axis.map(|component| component / length * angle);
            let back = delta_theta_of(quaternion_of(turn));
            prop_assert!(distance(back, turn) < 1e-12, "{turn:?} {back:?}");
        }
    }
}
