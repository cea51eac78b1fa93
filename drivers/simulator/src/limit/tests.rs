use approx::assert_relative_eq;
use insd_base::units::DEG;
use nalgebra::DMatrix;

use super::covariance::{Shaping, discrete};
use super::*;
use crate::scenario::Override;
use crate::shipped;

const INSTANTS: [f64; 6] = [60.0, 120.0, 300.0, 600.0, 900.0, 1800.0];

/// A shipped scenario by its number, with overrides.
fn scenario(number: usize, sets: &[&str]) -> Scenario {
    let sets: Vec<Override> = sets.iter().map(|set| set.parse().unwrap()).collect();
    Scenario::with_overrides(shipped()[number - 1].1, &sets).unwrap()
}

/// Headings of the limit, deg.
fn headings(scenario: &Scenario, at: &[f64]) -> Vec<f64> {
    limit(scenario, at).unwrap().iter().map(|limit| limit.heading / DEG).collect()
}

/// Holds values to references, the first two to 15 % and the others to 5 %.
fn close(found: &[f64], reference: &[f64]) {
    for (index, (found, reference)) in found.iter().zip(reference).enumerate() {
        let bar = if index < 2 { 0.15 } else { 0.05 };
        assert!((found / reference - 1.0).abs() < bar, "{index}: {found} for {reference}");
    }
}

/// The references come with the moored voyages that the project is held against, computed by others
/// with another model of the same kind.
#[test]
fn the_heading_at_the_berth_agrees_with_the_limits_of_the_reference_voyages() {
    for (number, reference) in [
        (7, [8.568, 1.538, 0.1095, 0.0650, 0.05846, 0.05298]),
        (8, [22.36, 4.120, 0.2180, 0.06829, 0.05966, 0.05322]),
        (9, [8.809, 3.173, 2.541, 2.441, 2.410, 2.379]),
    ] {
        close(&headings(&scenario(number, &[]), &INSTANTS), &reference);
    }
}

#[test]
fn tilt_and_position_at_the_berth_agree_with_the_limits_of_the_reference_voyages() {
    let found = limit(&scenario(7, &[]), &[300.0, 600.0, 1800.0]).unwrap();
    for (found, (position, velocity)) in
        found.iter().zip([(0.3358, 0.009867), (0.3158, 0.008082), (0.3121, 0.007778)])
    {
        assert_relative_eq!(found.horizontal_position, position, max_relative = 0.08);
        assert_relative_eq!(found.horizontal_velocity, velocity, max_relative = 0.05);
        assert_relative_eq!(found.roll / DEG, 0.00298, max_relative = 0.02);
        assert_relative_eq!(found.pitch / DEG, 0.00300, max_relative = 0.02);
    }
}

#[test]
fn in_a_calm_nothing_but_the_gyros_stands_in_the_way_of_the_heading() {
    let calm = scenario(7, &["sea.state=1"]);
    let reference = [0.075, 0.061, 0.057, 0.053];
    for (found, reference) in headings(&calm, &INSTANTS[2..]).iter().zip(reference) {
        assert_relative_eq!(*found, reference, max_relative = 0.05);
    }
}

#[test]
fn the_heading_is_harder_to_find_the_weaker_the_horizontal_earth_rate() {
    let at = |latitude: &str| headings(&scenario(7, &[latitude]), &[900.0])[0];
    let here = at("start.lat_deg=35");
    assert_relative_eq!(at("start.lat_deg=1") / here, 0.82, max_relative = 0.01);
    assert_relative_eq!(at("start.lat_deg=60") / here, 1.64, max_relative = 0.01);
    assert_relative_eq!(at("start.lat_deg=-60") / here, 1.64, max_relative = 0.01);
}

/// The route and the sea of the reference voyage, read off its truth; our own tenth scenario turns at
/// other times.
#[test]
fn under_way_the_limit_agrees_with_that_of_the_reference_voyage() {
    let text = shipped()[9].1;
    let (before, rest) = text.split_once("[[route.legs]]").unwrap();
    let (_, after) = rest.split_once("[sea]").unwrap();
    let leg = |(heading, duration, rate): (f64, f64, f64)| {
        format!(
            "[[route.legs]]\nheading_deg = {heading:?}\nspeed_kn = 10.0\nduration_s = {duration:?}\n\
             turn_rate_deg_s = {rate:?}\n"
        )
    };
    let legs = [(151.0, 170.0, 1.0), (119.3, 420.0, 1.0), (34.0, 500.0, 0.75), (96.0, 710.0, 0.7)];
    let text = format!("{before}{}[sea]{after}", legs.map(leg).concat());
    let found = limit(&Scenario::from_toml(&text).unwrap(), &INSTANTS[2..]).unwrap();
    for (found, (heading, roll, pitch, position, velocity)) in found.iter().zip([
        (0.1036, 0.002127, 0.001893, 1.107, 0.01153),
        (0.06252, 0.001747, 0.001663, 1.102, 0.01025),
        (0.04192, 0.0008733, 0.001051, 1.102, 0.01029),
        (0.02803, 0.0007874, 0.0007745, 1.101, 0.00982),
    ]) {
        assert_relative_eq!(found.heading / DEG, heading, max_relative = 0.05);
        assert_relative_eq!(found.roll / DEG, roll, max_relative = 0.05);
        assert_relative_eq!(found.pitch / DEG, pitch, max_relative = 0.05);
        assert_relative_eq!(found.horizontal_position, position, max_relative = 0.05);
        assert_relative_eq!(found.horizontal_velocity, velocity, max_relative = 0.05);
    }
}

#[test]
fn gnss_beside_the_berth_can_only_help() {
    let alone = headings(&scenario(8, &[]), &INSTANTS);
    let both = headings(&scenario(8, &["gnss.rate_hz=1.0"]), &INSTANTS);
    assert!(both.iter().zip(&alone).all(|(both, alone)| both <= alone), "{both:?} {alone:?}");
    assert!(both[1] < alone[1] / 5.0);
}

#[test]
fn a_departure_goes_on_from_what_the_berth_has_given() {
    let found = headings(&scenario(23, &[]), &[199.0, 210.0, 600.0]);
    assert!(found[1] < 1.05 * found[0] && found[2] < found[0], "{found:?}");
}

#[test]
fn the_rate_of_the_fixes_hardly_matters_when_their_noise_is_as_dense() {
    let rtk = |rate: &str, white: &str| {
        let position = format!(
            "gnss.position={{ white = [{white}, {white}, 1.0], correlated = [0.0, 0.0, 0.0], \
             correlation_time_s = 1.0 }}"
        );
        let sets = [rate, position.as_str(), "gnss.with_velocity=false"];
        headings(&scenario(10, &sets), &[600.0])[0]
    };
    let (slow, fast) = (rtk("gnss.rate_hz=1.0", "0.1"), rtk("gnss.rate_hz=25.0", "0.5"));
    assert_relative_eq!(slow, fast, max_relative = 0.03);
}

#[test]
fn what_is_not_modelled_gives_no_number() {
    for (number, sets, told) in [
        (2, &[][..], "a velocity log"),
        (15, &[], "neither a known berth nor GNSS"),
        (7, &["reference.heading_std_deg=1.0"], "a reference of heading"),
        (7, &["reference.velocity_std_mps=1.0"], "a reference of velocity"),
        (7, &["imu.grade=perfect"], "an IMU without errors"),
        (10, &["route.heading_reference=grid"], "headings that count from grid north"),
        (
            7,
            &["sea.exposure=[{ at_s = 0.0, factor = 0.2 }, { at_s = 900.0, factor = 1.0 }]"],
            "a sea at the berth that changes",
        ),
        (10, &["gnss.outages=[{ when = { at_s = [9.0] }, duration_s = 5.0 }]"], "faults of the"),
        (10, &["imu.gaps=[{ when = { at_s = [9.0] }, duration_s = 5.0 }]"], "gaps in the data"),
    ] {
        let message = limit(&scenario(number, sets), &[60.0]).unwrap_err().to_string();
        assert!(message.contains(told), "{number} {sets:?}: {message}");
    }
}

#[test]
fn an_instant_after_the_voyage_is_refused() {
    let message = limit(&scenario(7, &[]), &[60.0, 1801.0]).unwrap_err().to_string();
    assert!(message.contains("1800 s, found 1801 s"), "{message}");
    assert!(limit(&scenario(7, &[]), &[f64::NAN]).is_err());
}

#[test]
fn an_oscillator_stays_in_its_steady_state_and_turns_by_its_frequency() {
    let (std, omega, zeta, dt) = (0.3_f64, 0.8, 0.1, 0.5);
    let dynamics = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -omega * omega, -2.0 * zeta * omega]);
    let noise = 4.0 * zeta * f64::powi(omega, 3) * std * std;
    let density = DMatrix::from_row_slice(2, 2, &[0.0, 0.0, 0.0, noise]);
    let steady = DMatrix::from_diagonal_element(2, 2, std * std)
        .component_mul(&DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, omega * omega]));
    let (transition, added) = discrete(&dynamics, &density, dt);
    let next = &transition * &steady * transition.transpose() + added;
    assert_relative_eq!(next, steady, epsilon = 1e-12);
    // x(t) = e^(-zeta omega t) (cos(w t) + zeta omega / w sin(w t)) from x = 1, x' = 0
    let w = omega * f64::sqrt(1.0 - zeta * zeta);
    let (sin, cos) = (w * dt).sin_cos();
    let free = f64::exp(-zeta * omega * dt) * (cos + zeta * omega / w * sin);
    assert_relative_eq!(transition[(0, 0)], free, epsilon = 1e-12);
}

#[test]
fn a_measurement_of_what_is_known_changes_nothing_and_leaves_the_covariance_finite() {
    let spec = scenario(7, &[]).imu.simulated();
    let mut covariance = Covariance::new(&spec, model::start(None), 0.5);
    let nothing = covariance.append(&Shaping::oscillator(0.0, 0.0, 0.1));
    let mut rows = DMatrix::zeros(1, covariance.size());
    rows[(0, nothing)] = 1.0;
    let variances = nalgebra::DVector::zeros(1);
    covariance.update(&covariance::Measurement { rows, variances });
    assert_eq!(covariance.std_of(&[(model::ATTITUDE.at(2), 1.0)]), 104.0 * DEG);
}

/// A MEMS unit under way with fixes that are away for a minute.
fn afterwards(at: &[f64], is_afterwards: bool) -> Vec<Limit> {
    let scenario = Scenario::with_overrides(
        "name = \"s\"\nmode = \"underway\"\nduration_s = 600.0\n[start]\nlat_deg = 35.0\nlon_deg = 61.0\n\
         [[route.legs]]\nheading_deg = 90.0\nspeed_kn = 10.0\nduration_s = 600.0\n[imu]\ngrade = \"mems\"\n[gnss]\n",
        &[],
    )
    .unwrap();
    let outages = vec![(300.0, 360.0)];
    limit_of(&scenario, &LimitQuestion { at: at.to_vec(), outages, is_afterwards }).unwrap()
}

#[test]
fn who_knows_all_of_the_voyage_knows_no_less_than_who_knows_its_past_and_as_much_at_its_end() {
    let at = [30.0, 299.0, 330.0, 359.0, 420.0, 600.0];
    let (filtered, smoothed) = (afterwards(&at, false), afterwards(&at, true));
    for (one, both) in filtered.iter().zip(&smoothed) {
        assert!(both.horizontal_position <= one.horizontal_position * (1.0 + 1e-6), "{both:?}");
        assert!(both.heading <= one.heading * (1.0 + 1e-6), "{both:?}");
    }
    let (last, end) = (filtered[5], smoothed[5]);
    assert_relative_eq!(last.horizontal_position, end.horizontal_position, max_relative = 1e-9);
    // on a straight course the heading stays unknown, and with it where the antenna is; how she moves is known from both sides
    assert!(smoothed[3].horizontal_velocity < 0.1 * filtered[3].horizontal_velocity);
}
