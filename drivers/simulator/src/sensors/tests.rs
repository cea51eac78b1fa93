use approx::assert_relative_eq;
use insd_base::earth::{c_ne, ecef};
use insd_base::units::{DEG, DEG_PER_HOUR};
use insd_base::{ExternalReference, FixQuality, GnssFix, LogReference, LogVelocity, Stamped};
use nalgebra::Vector3;

use crate::scenario::Scenario;
use crate::track::{Track, start_of};

/// A voyage of one leg: `rest` holds the sections of the sensors.
fn scenario(speed_kn: f64, duration: f64, rest: &str) -> Scenario {
    let moored = speed_kn == 0.0;
    Scenario::from_toml(&format!(
        "name = \"one leg\"\nmode = \"underway\"\nstart = {{ lat_deg = 50.0, lon_deg = -4.0 }}\n\
         route.legs = [{{ heading_deg = 60.0, speed_kn = {speed_kn:?}, moored = {moored}, \
         duration_s = {duration:?} }}]\n{rest}"
    ))
    .unwrap()
}

const PERFECT: &str = "imu = { grade = \"perfect\" }\n";
const ROUGH: &str = "sea = { state = 5 }\n";

fn fixes(rest: &str, duration: f64, seed: u64) -> (Track, Vec<Stamped<GnssFix>>) {
    let scenario = scenario(10.0, duration, &format!("{PERFECT}{rest}"));
    let track = Track::new(&scenario, seed);
    let gnss = scenario.gnss.clone().unwrap();
    let fixes = super::gnss::fixes(&gnss, &track, duration, seed);
    (track, fixes)
}

/// Errors of position and velocity north, east, down at the antenna; fixes without are left out.
fn errors(track: &Track, fixes: &[Stamped<GnssFix>]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let lever = insd_base::Body::new(-6.0, -0.8, -14.0);
    let error = |fix: &GnssFix| {
        let (place, velocity) = track.at(fix.time.as_seconds()).at_lever(&lever);
        let c_ne = c_ne(&fix.position?);
        let position = c_ne * (ecef(&fix.position?).0 - place.0);
        Some((position, fix.velocity?.0 - c_ne * velocity))
    };
    fixes.iter().filter_map(|fix| error(&fix.message)).collect()
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    (sum / count).sqrt()
}

/// Sampling interval of the IMU in tests of its statistics, s.
const DT: f64 = 0.1;

/// Errors of the increments: those of `errors` less those of a perfect IMU.
fn imu_errors(errors: &str, duration: f64, seed: u64) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    let samples = |rest: &str| {
        let scenario = scenario(0.0, duration.max(30.0), rest);
        let track = Track::new(&scenario, seed);
        super::imu::samples(&scenario.imu, &track, duration, seed)
    };
    let zero = "gyro_bias_std_deg_h = 0.0, gyro_bias_instability_deg_h = 0.0, \
        gyro_bias_time_constant_s = 10.0, angle_random_walk_deg_sqrt_h = 0.0, \
        gyro_scale_factor_std_ppm = 0.0, accel_bias_std_ug = 0.0, accel_bias_instability_ug = 0.0, \
        accel_bias_time_constant_s = 10.0, velocity_random_walk_mps_sqrt_h = 0.0, \
        accel_scale_factor_std_ppm = 0.0";
    let mut model = zero.to_owned();
    for assignment in errors.split(", ") {
        let key = assignment.split(" = ").next().unwrap();
        model = model.replace(&format!("{key} = 0.0"), assignment);
    }
    let measured = samples(&format!("imu = {{ errors = {{ {model} }}, rate_hz = 10.0 }}\n"));
    let difference = |(a, b): (&Stamped<insd_base::ImuSample>, &Stamped<insd_base::ImuSample>)| {
        let (a, b) = (&a.message, &b.message);
        (a.delta_theta.0 - b.delta_theta.0, a.delta_velocity.0 - b.delta_velocity.0)
    };
    measured
        .iter()
        .zip(&samples("imu = { grade = \"perfect\", rate_hz = 10.0 }\n"))
        .map(difference)
        .collect()
}

#[test]
fn random_walks_of_the_imu_grow_as_the_data_sheet_says() {
    let errors = imu_errors(
        "angle_random_walk_deg_sqrt_h = 0.2, velocity_random_walk_mps_sqrt_h = 0.06",
        1500.0,
        1,
    );
    let (gyro, accel) = (0.2 * DEG / 60.0 * DT.sqrt(), 0.06 / 60.0 * DT.sqrt());
    assert_relative_eq!(rms(errors.iter().map(|e| e.0.x)), gyro, max_relative = 0.02);
    assert_relative_eq!(rms(errors.iter().map(|e| e.1.z)), accel, max_relative = 0.02);
    let neighbours = errors.windows(2).map(|w| w[0].0.y * w[1].0.y).sum::<f64>();
    assert!((neighbours / errors.len() as f64 / gyro.powi(2)).abs() < 0.03);
}

#[test]
fn turn_on_biases_and_scale_factors_scatter_over_the_voyages() {
    let seeds = || {
        (0..150).map(|seed| {
            imu_errors("gyro_bias_std_deg_h = 5.0, accel_scale_factor_std_ppm = 100.0", 0.2, seed)
        })
    };
    let bias = rms(seeds().flat_map(|e| e[0].0.iter().copied().collect::<Vec<_>>()));
    assert_relative_eq!(bias, 5.0 * DEG_PER_HOUR * DT, max_relative = 0.15);
    let scale = rms(seeds().map(|e| e[0].1.z));
    assert_relative_eq!(scale, 100e-6 * 9.81 * DT, max_relative = 0.2);
}

#[test]
fn in_run_biases_have_their_std_and_correlation_time() {
    let errors = imu_errors(
        "gyro_bias_instability_deg_h = 2.0, accel_bias_instability_ug = 100.0",
        3000.0,
        2,
    );
    let rate = |e: &(Vector3<f64>, Vector3<f64>)| e.0.x / DT;
    assert_relative_eq!(rms(errors.iter().map(rate)), 2.0 * DEG_PER_HOUR, max_relative = 0.15);
    let force = rms(errors.iter().map(|e| e.1.x / DT));
    assert_relative_eq!(force, 100.0 * 9.806_65e-6, max_relative = 0.15);
    let lagged = errors.windows(101).map(|w| rate(&w[0]) * rate(&w[100])).sum::<f64>();
    let own = errors.iter().map(|e| rate(e).powi(2)).sum::<f64>();
    assert_relative_eq!(lagged / own, (-1.0_f64).exp(), epsilon = 0.15);
}

#[test]
fn gaps_and_duplicates_leave_all_other_samples_as_they_were() {
    let samples = |faults: &str| {
        let rest = format!("imu = {{ grade = \"mems\", jitter_std_s = 0.0005{faults} }}\n");
        let scenario = scenario(10.0, 20.0, &rest);
        super::imu::samples(&scenario.imu, &Track::new(&scenario, 4), 20.0, 4)
    };
    let clean = samples("");
    let faulty = samples(
        ", gaps = [{ when = { at_s = [5.005] }, duration_s = 0.1 }], duplicates = [{ at_s = [8.0, 9.0] }]",
    );
    assert_eq!(faulty.len(), clean.len() - 10 + 2);
    let mut once = faulty.clone();
    once.dedup();
    assert!(once.iter().all(|sample| clean.contains(sample)));
    let gap =
        |s: &Stamped<insd_base::ImuSample>| (5.005..5.105).contains(&s.message.time.as_seconds());
    assert!(!faulty.iter().any(gap));
}

#[test]
fn samples_lost_one_by_one_leave_the_others_as_they_were() {
    let samples = |faults: &str| {
        let rest = format!("imu = {{ grade = \"mems\"{faults} }}\n");
        let scenario = scenario(10.0, 60.0, &rest);
        super::imu::samples(&scenario.imu, &Track::new(&scenario, 4), 60.0, 4)
    };
    let (clean, lossy) = (samples(""), samples(", lost_share = 0.02"));
    let lost = clean.len() - lossy.len();
    assert!((80..=160).contains(&lost), "{lost} of 6000");
    let mut rest = clean.iter();
    assert!(lossy.iter().all(|sample| rest.any(|one| one == sample)));
}

#[test]
fn uneven_samples_cover_the_voyage_without_gap_or_overlap() {
    let sum = |jitter: f64| {
        let rest = format!("imu = {{ grade = \"perfect\", jitter_std_s = {jitter} }}\n{ROUGH}");
        let scenario = scenario(10.0, 30.0, &rest);
        let samples = super::imu::samples(&scenario.imu, &Track::new(&scenario, 4), 30.0, 4);
        let last = samples.last().unwrap().message.time.as_seconds();
        let rest = super::imu::increments(&Track::new(&scenario, 4), last, 30.01);
        samples.iter().fold(rest.1, |sum, sample| sum + sample.message.delta_velocity.0)
    };
    assert_relative_eq!(sum(0.0), sum(0.001), epsilon = 1e-8);
}

#[test]
fn gnss_errors_have_the_claimed_sigma_and_their_correlation() {
    let noise =
        "{ white = [0.5, 0.5, 0.9], correlated = [0.8, 0.8, 1.4], correlation_time_s = 10.0 }";
    let (track, fixes) = fixes(&format!("gnss = {{ position = {noise} }}\n"), 6000.0, 1);
    let errors = errors(&track, &fixes);
    for axis in 0..3 {
        let claimed = fixes[0].message.position_std.unwrap().0[axis];
        let own = rms(errors.iter().map(|e| e.0[axis]));
        assert_relative_eq!(own, claimed, max_relative = 0.08);
        let lagged = errors.windows(2).map(|w| w[0].0[axis] * w[1].0[axis]).sum::<f64>();
        let share = if axis == 2 { 1.4_f64 } else { 0.8 }.powi(2) / claimed.powi(2);
        let expected = share * (-0.1_f64).exp();
        assert_relative_eq!(lagged / errors.len() as f64 / own.powi(2), expected, epsilon = 0.06);
    }
    let velocity = rms(errors.iter().map(|e| e.1.x));
    assert_relative_eq!(velocity, 0.0316, max_relative = 0.08);
}

#[test]
fn the_antenna_velocity_is_the_derivative_of_the_antenna_position() {
    let silent =
        "{ white = [0.0, 0.0, 0.0], correlated = [0.0, 0.0, 0.0], correlation_time_s = 1.0 }";
    let gnss =
        format!("gnss = {{ rate_hz = 50.0, position = {silent}, velocity = {silent} }}\n{ROUGH}");
    let (_, fixes) = fixes(&gnss, 30.0, 1);
    for w in fixes.windows(3) {
        let place = |i: usize| ecef(&w[i].message.position.unwrap()).0;
        let c_ne = c_ne(&w[1].message.position.unwrap());
        let derivative = c_ne * (place(2) - place(0)) / 0.04;
        assert_relative_eq!(derivative, w[1].message.velocity.unwrap().0, epsilon = 2e-3);
    }
}

#[test]
fn a_fault_leaves_all_other_fixes_as_they_were() {
    let (_, clean) = fixes("gnss = {}\n", 200.0, 1);
    let (_, faulty) = fixes(
        "gnss = { outages = [{ when = { at_s = [50.0] }, duration_s = 10.0 }], \
         jumps = [{ when = { at_s = [80.0] }, duration_s = 5.0, offset_m = [30.0, 0.0, 0.0] }], \
         dop_spikes = [{ when = { at_s = [120.0] }, duration_s = 5.0, hdop = 6.0 }] }\n",
        200.0,
        1,
    );
    assert_eq!(faulty.len(), clean.len() - 10);
    let changed = faulty.iter().filter(|fix| !clean.contains(fix)).count();
    assert_eq!(changed, 10);
}

#[test]
fn a_jump_moves_the_position_and_neither_velocity_nor_sigma() {
    let jump = "{ when = { count = 4, window_s = [10.0, 190.0] }, duration_s = 10.0, size_m = [30.0, 200.0] }";
    let (_, clean) = fixes("gnss = {}\n", 200.0, 1);
    let (_, faulty) = fixes(&format!("gnss = {{ jumps = [{jump}] }}\n"), 200.0, 1);
    let mut jumped = 0;
    for (a, b) in clean.iter().zip(&faulty) {
        assert_eq!(
            (a.message.velocity, a.message.position_std),
            (b.message.velocity, b.message.position_std)
        );
        let place = |fix: &GnssFix| ecef(&fix.position.unwrap()).0;
        let distance = (place(&a.message) - place(&b.message)).norm();
        assert!(distance == 0.0 || (29.99..200.01).contains(&distance));
        jumped += usize::from(distance > 0.0);
    }
    assert_eq!(jumped, 40);
}

#[test]
fn few_satellites_scale_errors_and_sigmas_alike() {
    let spike =
        "gnss = { dop_spikes = [{ when = { at_s = [0.0] }, duration_s = 5000.0, hdop = 4.5 }] }\n";
    let (track, poor) = fixes(spike, 3000.0, 1);
    let (_, good) = fixes("gnss = {}\n", 3000.0, 1);
    let fix = poor[0].message;
    assert_relative_eq!(
        fix.position_std.unwrap().0,
        good[0].message.position_std.unwrap().0 * 5.0,
        epsilon = 1e-9
    );
    assert_relative_eq!(
        fix.velocity_std.unwrap().0,
        good[0].message.velocity_std.unwrap().0 * 5.0,
        epsilon = 1e-9
    );
    assert!(fix.hdop == Some(4.5) && (4..=7).contains(&fix.satellites.unwrap()));
    let (a, b) = (errors(&track, &poor), errors(&track, &good));
    for (a, b) in a.iter().zip(&b) {
        assert_relative_eq!(a.0, b.0 * 5.0, epsilon = 1e-4);
    }
}

#[test]
fn spoofing_pulls_position_and_velocity_consistently() {
    let ramp = "{ when = { at_s = [20.0] }, duration_s = 100.0, speed_mps = 0.1, acceleration_mps2 = 0.01, direction_deg = 90.0 }";
    let (track, clean) = fixes("gnss = {}\n", 150.0, 1);
    let (_, faulty) = fixes(&format!("gnss = {{ spoofing = [{ramp}] }}\n"), 150.0, 1);
    let pulls: Vec<_> = errors(&track, &faulty)
        .iter()
        .zip(errors(&track, &clean))
        .map(|(a, b)| (a.0 - b.0, a.1 - b.1))
        .collect();
    assert_relative_eq!(pulls[70].0, Vector3::new(0.0, 5.0 + 12.5, 0.0), epsilon = 1e-3);
    assert_relative_eq!(pulls[70].1, Vector3::new(0.0, 0.6, 0.0), epsilon = 1e-4);
    assert_relative_eq!(pulls[120].0.norm(), 0.0, epsilon = 1e-6);
}

#[test]
fn sigmas_can_be_zero_missing_or_absurd() {
    for (word, expected) in [("zero", Some(0.0)), ("missing", None), ("absurd", Some(1e7))] {
        let gnss = format!(
            "gnss = {{ bad_stds = [{{ when = {{ at_s = [3.0] }}, duration_s = 2.0, fault = \"{word}\" }}] }}\n"
        );
        let (_, fixes) = fixes(&gnss, 10.0, 1);
        assert_eq!(fixes[3].message.position_std.map(|std| std.0.x), expected);
        assert_eq!(fixes[4].message.velocity_std.map(|std| std.0.z), expected);
        assert!(fixes[5].message.position_std.unwrap().0.x > 0.9);
    }
}

#[test]
fn rtk_is_quality_four_with_centimetre_sigmas() {
    let (_, fixes) = fixes("gnss = { grade = \"rtk\", rate_hz = 5.0 }\n", 10.0, 1);
    assert_eq!(fixes.len(), 51);
    assert_eq!(fixes[0].message.quality, FixQuality::RtkFixed);
    assert_relative_eq!(fixes[0].message.position_std.unwrap().0.x, 0.01414, epsilon = 1e-5);
}

fn log(rest: &str, duration: f64, seed: u64) -> (Track, Vec<LogVelocity>) {
    let scenario = scenario(10.0, duration, &format!("{PERFECT}{rest}"));
    let track = Track::new(&scenario, seed);
    let log = scenario.log.as_ref().unwrap();
    let all = super::log::velocities(log, &scenario.current, &track, duration, seed);
    (track, all.into_iter().map(|stamped| stamped.message).collect())
}

fn uvw(message: &LogVelocity) -> Vector3<f64> {
    Vector3::new(message.u.unwrap(), message.v.unwrap(), message.w.unwrap())
}

const CLEAN_LOG: &str = "white_mps = 0.0, scale_std = 0.0, misalignment_std_deg = 0.0";

#[test]
fn a_log_without_errors_sees_the_hull_move_over_the_ground() {
    let (track, log) = log(&format!("log = {{ {CLEAN_LOG} }}\n{ROUGH}"), 60.0, 1);
    for message in &log {
        let ship = track.at(message.time.as_seconds());
        let lever = Vector3::new(9.0, -1.0, 9.0);
        let expected = ship.c_eb.tr_mul(&ship.velocity) + ship.omega_eb.cross(&lever);
        assert_relative_eq!(uvw(message), expected, epsilon = 1e-12);
    }
}

#[test]
fn a_log_that_loses_the_bottom_sees_the_water() {
    let rest = format!(
        "log = {{ {CLEAN_LOG}, water_from_s = 30.0 }}\ncurrent = {{ north_mps = 0.0, east_mps = 1.0 }}\n"
    );
    let (_, log) = log(&rest, 60.0, 1);
    assert_eq!(log[29].reference, LogReference::Bottom);
    assert_eq!(log[30].reference, LogReference::Water);
    let change = uvw(&log[30]) - uvw(&log[29]);
    let heading = 60.0 * DEG;
    assert_relative_eq!(change, Vector3::new(-heading.sin(), -heading.cos(), 0.0), epsilon = 1e-5);
}

#[test]
fn scale_and_misalignment_of_the_log_scatter_over_the_voyages() {
    let errors = |seed: u64| {
        let rest = "log = { white_mps = 0.0 }\n";
        let (_, measured) = log(rest, 1.0, seed);
        let speed = 10.0 * 1852.0 / 3600.0;
        uvw(&measured[0]) / speed - Vector3::x()
    };
    let all: Vec<_> = (0..200).map(errors).collect();
    assert_relative_eq!(rms(all.iter().map(|e| e.x)), 0.005, max_relative = 0.15);
    assert_relative_eq!(rms(all.iter().map(|e| e.y)), 0.3 * DEG, max_relative = 0.15);
    assert_relative_eq!(rms(all.iter().map(|e| e.z)), 0.3 * DEG, max_relative = 0.15);
}

#[test]
fn the_log_is_noisy_drops_out_and_may_give_forward_speed_only() {
    let rest = "log = { axes = \"u\", scale_std = 0.0, misalignment_std_deg = 0.0, \
        dropouts = [{ when = { at_s = [100.0] }, duration_s = 50.0 }] }\n";
    let (_, log) = log(rest, 3000.0, 1);
    assert_eq!(log.len(), 3001 - 50);
    assert!(log.iter().all(|m| m.v.is_none() && m.w.is_none() && m.std == Some(0.03)));
    let speed = 10.0 * 1852.0 / 3600.0;
    assert_relative_eq!(rms(log.iter().map(|m| m.u.unwrap() - speed)), 0.03, max_relative = 0.05);
}

fn references(speed_kn: f64, rest: &str) -> (Track, Scenario, Vec<ExternalReference>) {
    let scenario = scenario(speed_kn, 3000.0, &format!("{PERFECT}{ROUGH}{rest}"));
    let track = Track::new(&scenario, 1);
    let reference = scenario.reference.unwrap();
    let all = super::reference::messages(&reference, &start_of(&scenario), &track, 3000.0, 1);
    (track, scenario, all.into_iter().map(|stamped| stamped.message).collect())
}

#[test]
fn the_berth_is_given_with_the_sigma_of_the_sway_about_it() {
    let (track, scenario, messages) = references(0.0, "reference = {}\n");
    assert_eq!(messages.len(), 301);
    let berth = start_of(&scenario);
    assert!(messages.iter().all(|m| m.position == Some(berth) && m.velocity().is_none()));
    let north = |t: u32| {
        let away = track.at(f64::from(t)).position - ecef(&berth).0;
        (c_ne(&berth) * away).xy()
    };
    let sway = rms((0..3000).flat_map(|t| [north(t).x, north(t).y]));
    assert_relative_eq!(messages[0].position_std.unwrap(), sway, max_relative = 0.15);
}

#[test]
fn another_navigator_gives_velocity_and_heading_with_their_noise() {
    let rest = "reference = { interval_s = 1.0, velocity_std_mps = 0.2, heading_std_deg = 0.5 }\n";
    let (track, _, messages) = references(10.0, rest);
    let at = |m: &ExternalReference| track.at(m.time.as_seconds());
    let east = messages.iter().map(|m| m.v_east.unwrap() - at(m).velocity_n().0.y);
    assert_relative_eq!(rms(east), 0.2, max_relative = 0.06);
    let heading = messages.iter().map(|m| m.heading.unwrap() - at(m).attitude().heading);
    assert_relative_eq!(rms(heading), 0.5 * DEG, max_relative = 0.06);
    assert!(messages.iter().all(|m| m.position.is_none()));
}

#[test]
fn a_reference_that_only_knows_the_berth_is_silent_under_way() {
    assert!(references(10.0, "reference = {}\n").2.is_empty());
}

#[test]
fn an_imu_that_counts_in_steps_and_an_engine_leave_the_sums_as_they_were() {
    let samples = |faults: &str| {
        let rest = format!("imu = {{ grade = \"navigation\"{faults} }}\n{ROUGH}");
        let scenario = scenario(10.0, 60.0, &rest);
        super::imu::samples(&scenario.imu, &Track::new(&scenario, 4), 60.0, 4)
    };
    let clean = samples("");
    let counted = samples(", quantisation = { gyro_arcsec = 2.0, accel_mps = 0.0006 }");
    let shaken = samples(", vibration = [{ frequency_hz = 12.4, rate_deg_s = 0.05 }]");
    let (step, swing) = (2.0 * DEG / 3600.0, 0.05 * DEG / (std::f64::consts::TAU * 12.4));
    let mut sums = [Vector3::zeros(); 3];
    let mut swung: f64 = 0.0;
    for ((a, b), c) in clean.iter().zip(&counted).zip(&shaken) {
        let (a, b, c) = (a.message.delta_theta.0, b.message.delta_theta.0, c.message.delta_theta.0);
        assert!(b.iter().all(|angle| (angle / step - (angle / step).round()).abs() < 1e-6));
        sums = [sums[0] + a, sums[1] + b, sums[2] + c];
        assert!((sums[1] - sums[0]).amax() < 0.5001 * step);
        assert!((sums[2] - sums[0]).amax() < 2.0 * swing);
        swung = swung.max((sums[2] - sums[0]).amax());
    }
    assert!(swung > 0.5 * swing);
}
