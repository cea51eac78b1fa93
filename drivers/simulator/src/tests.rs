use approx::assert_relative_eq;
use insd_base::earth::{gravity_e, rate_e};
use insd_base::units::{DEG, wrap_pi};
use insd_base::{FixQuality, Span, Time};
use nalgebra::{Matrix3, Rotation3};

use super::*;
use crate::sensors::imu::increments;

/// A shipped scenario by its number.
fn scenario(number: usize) -> Scenario {
    Scenario::from_toml(shipped()[number - 1].1).unwrap()
}

/// Rotation from ECEF axes at `t`, s, to those at time zero, which are inertial.
fn c_ie(t: f64) -> Matrix3<f64> {
    Rotation3::new(rate_e() * t).into_inner()
}

/// Places where the axes of a chart or of the globe change quickly, and plain ones: scenario, time.
const MOMENTS: [(usize, f64); 8] = [
    (3, 100.0),
    (3, 830.0),
    (8, 50.0),
    (11, 420.0),
    (12, 1000.0),
    (12, 1082.0),
    (12, 1550.0),
    (15, 1850.0),
];

#[test]
fn an_imu_elsewhere_on_the_hull_feels_the_acceleration_of_its_own_point() {
    let (h, lever) = (1e-2, Body::new(12.0, -3.0, 5.0));
    for (number, t) in MOMENTS {
        let track = Track::new(&scenario(number).with_duration(t + 1.0), 1);
        let (before, now, after) = (track.at(t - h), track.at(t), track.at(t + h));
        let (place, velocity) = now.at_lever(&lever);
        let acceleration = (after.at_lever(&lever).1 - before.at_lever(&lever).1) / (2.0 * h);
        let gravity = gravity_e(&geodetic(&place));
        let force = acceleration + 2.0 * rate_e().cross(&velocity) - gravity;
        let measured = increments(&track, t - h, t + h).1
            + crate::sensors::imu::swing(&track, (t - h, t + h), &lever.0);
        let expected = now.c_eb.tr_mul(&force);
        assert_relative_eq!(measured / (2.0 * h), expected, epsilon = 3e-3);
    }
}

#[test]
fn velocity_acceleration_and_rate_are_the_derivatives_of_position_and_attitude() {
    let h = 1e-2;
    for (number, t) in MOMENTS {
        let track = Track::new(&scenario(number).with_duration(t + 1.0), 1);
        let (before, now, after) = (track.at(t - h), track.at(t), track.at(t + h));
        let velocity = (after.position - before.position) / (2.0 * h);
        assert_relative_eq!(velocity, now.velocity, epsilon = 3e-5);
        let acceleration = (after.velocity - before.velocity) / (2.0 * h);
        assert_relative_eq!(acceleration, now.acceleration, epsilon = 1e-4);
        let turn = Rotation3::from_matrix_unchecked(before.c_eb.tr_mul(&after.c_eb));
        assert_relative_eq!(turn.scaled_axis() / (2.0 * h), now.omega_eb, epsilon = 1e-5);
    }
}

#[test]
fn the_gyros_sense_the_change_of_attitude_in_inertial_space() {
    for (number, t) in MOMENTS {
        let track = Track::new(&scenario(number).with_duration(t + 1.0), 1);
        let attitude = |t: f64| c_ie(t) * track.at(t).c_eb;
        let dt = 0.01;
        let turn = Rotation3::from_matrix_unchecked(attitude(t).tr_mul(&attitude(t + dt)));
        let (theta, _) = increments(&track, t, t + dt);
        // the rotation vector differs from the integral of the rate by the coning, dt^3/12 |w x dw|
        assert_relative_eq!(turn.scaled_axis(), theta, epsilon = 3e-9);
    }
}

/// Specific force along inertial axes at `t`, s, from nothing but positions: second derivative by
/// the five-point formula, less gravitation, which is gravity without its centrifugal part.
fn specific_force_from_positions(track: &Track, t: f64) -> Vector3<f64> {
    let h = 0.1;
    let weights = [-1.0, 16.0, -30.0, 16.0, -1.0].map(|w| w / (12.0 * h * h));
    let instants = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|n: f64| t + n * h);
    let place = |t: f64| c_ie(t) * track.at(t).position;
    let terms = instants.into_iter().zip(weights).map(|(t, w)| place(t) * w);
    let position = track.at(t).position;
    let centripetal = rate_e().cross(&rate_e().cross(&position));
    terms.sum::<Vector3<f64>>() - c_ie(t) * (gravity_e(&geodetic(&Ecef(position))) + centripetal)
}

#[test]
fn the_accelerometers_sense_the_second_derivative_of_the_position_in_inertial_space() {
    for (number, t) in MOMENTS {
        let track = Track::new(&scenario(number).with_duration(t + 1.0), 1);
        let expected =
            (c_ie(t) * track.at(t).c_eb).tr_mul(&specific_force_from_positions(&track, t));
        let dt = 0.001;
        let (_, velocity) = increments(&track, t - dt / 2.0, t + dt / 2.0);
        assert_relative_eq!(velocity / dt, expected, epsilon = 5e-5);
    }
}

#[test]
fn increments_of_any_rate_add_up_to_the_same() {
    let track = Track::new(&scenario(15).with_duration(101.0), 1);
    let (theta, velocity) = increments(&track, 99.0, 100.0);
    let fine = (0..1000)
        .map(|i| increments(&track, 99.0 + f64::from(i) * 1e-3, 99.0 + f64::from(i + 1) * 1e-3));
    let fine = fine.fold((Vector3::zeros(), Vector3::zeros()), |a, b| (a.0 + b.0, a.1 + b.1));
    assert_relative_eq!(theta, fine.0, epsilon = 1e-11);
    assert_relative_eq!(velocity, fine.1, epsilon = 1e-9);
}

#[test]
fn the_same_seed_gives_the_same_voyage_and_another_seed_another() {
    let scenario = scenario(5).with_duration(30.0);
    let voyage = simulate(&scenario, 7);
    assert_eq!(voyage, simulate(&scenario, 7));
    let other = simulate(&scenario, 8);
    assert_ne!(voyage.imu, other.imu);
    assert_ne!(voyage.gnss, other.gnss);
    assert_ne!(voyage.truth, other.truth);
}

#[test]
fn a_longer_voyage_begins_like_a_shorter_one() {
    let short = simulate(&scenario(3).with_duration(20.0), 1);
    let long = simulate(&scenario(3).with_duration(40.0), 1);
    assert_eq!(short.imu[..], long.imu[..short.imu.len()]);
    assert_eq!(short.gnss[..], long.gnss[..short.gnss.len()]);
    assert_eq!(short.truth[..], long.truth[..short.truth.len()]);
}

#[test]
fn every_shipped_scenario_makes_finite_data_in_order_of_time() {
    for (file, text) in shipped() {
        let voyage = simulate(&Scenario::from_toml(text).unwrap().with_duration(20.0), 3);
        assert_eq!(voyage.truth.len(), 201, "{file}");
        assert!(voyage.imu.len() >= 1900, "{file}");
        assert!(voyage.imu.windows(2).all(|w| w[0].message.time <= w[1].message.time), "{file}");
        for sample in &voyage.imu {
            let (theta, velocity) = (sample.message.delta_theta.0, sample.message.delta_velocity.0);
            assert!(theta.norm() < 0.01 && (velocity.norm() - 0.098).abs() < 0.03, "{file}");
        }
    }
}

#[test]
fn the_header_states_the_start_the_imu_and_the_lever_arms() {
    let header = simulate(&scenario(7).with_duration(1.0), 1).header;
    assert_eq!(header.start, insd_base::StartCondition::Moored);
    assert_eq!(header.initial, Some(Geodetic::from_degrees(35.0, 26.773, 20.0)));
    assert_relative_eq!(header.imu.gyro.bias_std, 0.01 * DEG / 3600.0, max_relative = 1e-12);
    assert_eq!(header.lever_arms.gnss, Body::new(-6.0, -0.8, -14.0));
    let perfect = simulate(&scenario(15).with_duration(1.0), 1).header.imu;
    assert!(perfect.gyro.bias_std > 0.0 && perfect.accel.random_walk > 0.0);
}

#[test]
fn the_antimeridian_is_crossed_without_a_step() {
    let track = Track::new(&scenario(11), 1);
    let longitudes: Vec<f64> = (0..1500).map(|t| track.at(f64::from(t)).point.longitude).collect();
    assert!(
        longitudes.iter().any(|l| *l > 179.99 * DEG)
            && longitudes.iter().any(|l| *l < -179.99 * DEG)
    );
    assert!(longitudes.windows(2).all(|w| wrap_pi(w[1] - w[0]).abs() < 2e-6));
}

#[test]
fn the_pole_is_passed_on_a_straight_track() {
    let track = Track::new(&scenario(12), 1);
    let latitudes: Vec<f64> = (0..1400).map(|t| track.at(f64::from(t)).point.latitude).collect();
    let nearest = latitudes.iter().copied().fold(0.0, f64::max);
    assert!((90.0 * DEG - nearest) * 6.4e6 < 100.0);
    let first = track.at(0.0);
    let beyond = track.at(1400.0);
    assert_relative_eq!(first.attitude().heading.cos(), 1.0, epsilon = 1e-3);
    assert_relative_eq!(beyond.attitude().heading.cos(), -1.0, epsilon = 1e-3);
    let across = beyond.point.longitude - first.point.longitude;
    assert_relative_eq!(wrap_pi(across).abs(), 180.0 * DEG, epsilon = 0.05);
}

#[test]
fn a_leg_of_constant_heading_keeps_its_true_heading_at_high_latitude() {
    let text = shipped()[14]
        .1
        .replace("lat_deg = 45.0", "lat_deg = 85.0")
        .replace("state = 6", "state = 0");
    let track = Track::new(&Scenario::from_toml(&text).unwrap(), 1);
    assert_relative_eq!(track.at(1700.0).attitude().heading, 60.0 * DEG, epsilon = 1e-9);
}

#[test]
fn outages_of_the_mems_voyage_fall_where_the_scenario_says() {
    let track = Track::new(&scenario(3).with_duration(3400.0), 1);
    let gnss = scenario(3).gnss.unwrap();
    let fixes = sensors::gnss::fixes(&gnss, &track, 3400.0, 1);
    let at = |t: f64| fixes.iter().find(|f| f.message.time == Time::from_seconds(t));
    assert!(at(2064.0).is_some() && at(2065.0).is_none() && at(2125.0).is_some());
    let silent = at(3100.0).unwrap().message;
    assert_eq!((silent.quality, silent.satellites), (FixQuality::Invalid, Some(2)));
    assert!(silent.position.is_none() && silent.velocity.is_none() && silent.hdop.is_none());
    assert_eq!(at(3379.0).unwrap().message.quality, FixQuality::Differential);
}

#[test]
fn messages_that_arrive_late_arrive_within_their_bounds() {
    let voyage = simulate(&scenario(13).with_duration(60.0), 1);
    for fix in &voyage.gnss {
        let late = fix.arrival.unwrap() - fix.message.time;
        assert!(late >= Span::from_seconds(0.3) && late <= Span::from_seconds(1.5));
    }
    let arrivals: Vec<_> = voyage.gnss.iter().map(|fix| fix.arrival).collect();
    assert!(!arrivals.is_sorted(), "some overtake each other");
}
