use approx::assert_relative_eq;
use insd_base::units::DEG;

use super::*;

const ROUTE: &str = r#"
name = "all at once"
mode = "underway"
[start]
lat_deg = 50.0
lon_deg = -4.0
[[route.legs]]
heading_deg = 40.0
speed_kn = 0.0
duration_s = 60.0
moored = true
[[route.legs]]
heading_deg = 90.0
speed_kn = 10.0
drift_deg = 4.0
duration_s = 300.0
[[route.legs]]
heading_deg = 350.0
speed_kn = 6.0
duration_s = 300.0
[sea]
state = 5
from_deg = 10.0
exposure = [{ at_s = 0.0, factor = 0.2 }, { at_s = 400.0, factor = 1.0 }]
[imu]
grade = "perfect"
"#;

fn scenario(text: &str) -> Scenario {
    Scenario::from_toml(text).unwrap()
}

/// A ship at anchor for ever: `hull` and `sea` are sections of TOML.
fn lying(heading: f64, moored: bool, hull: &str, sea: &str) -> Motion {
    let text = format!(
        "name = \"lying\"\nmode = \"underway\"\nstart = {{ lat_deg = 0.0, lon_deg = 0.0 }}\n\
         route.legs = [{{ heading_deg = {heading:?}, speed_kn = 0.0, duration_s = 60.0, \
         moored = {moored} }}]\nship = {hull}\nsea = {sea}\nimu = {{ grade = \"perfect\" }}\n"
    );
    Motion::new(&scenario(&text), 5)
}

/// Standard deviation over some hours, every 0.7 s.
fn std(of: impl Fn(f64) -> f64) -> f64 {
    let values: Vec<f64> = (0..30_000).map(|i| of(f64::from(i) * 0.7)).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
    (square / values.len() as f64).sqrt()
}

#[test]
fn the_acceleration_is_the_derivative_of_the_velocity_also_in_turns_and_changes_of_seaway() {
    let motion = Motion::new(&scenario(ROUTE), 1);
    let h = 1e-4;
    for t in [30.0, 65.0, 90.0, 200.0, 365.0, 400.0, 430.0, 600.0] {
        let (before, now, after) = (motion.at(t - h), motion.at(t), motion.at(t + h));
        for axis in 0..3 {
            let slope = (after.velocity[axis].value - before.velocity[axis].value) / (2.0 * h);
            assert_relative_eq!(now.velocity[axis].rate, slope, epsilon = 1e-6);
        }
        for get in [|m: &LocalMotion| m.roll, |m: &LocalMotion| m.pitch, |m: &LocalMotion| m.yaw] {
            let slope = (get(&after).value - get(&before).value) / (2.0 * h);
            assert_relative_eq!(get(&now).rate, slope, epsilon = 1e-7);
        }
    }
}

#[test]
fn a_cork_heaves_with_the_significant_height_of_the_sea() {
    let cork = "{ length_m = 1.0, beam_m = 0.5, draught_m = 0.1 }";
    let motion = lying(0.0, false, cork, "{ state = 5 }");
    assert_relative_eq!(4.0 * std(|t| motion.at(t).displacement[2]), 3.25, max_relative = 0.03);
}

#[test]
fn a_ship_rolls_most_in_beam_seas_and_pitches_most_in_head_seas() {
    let sea = "{ state = 5, from_deg = 0.0, spreading_deg = 0.0 }";
    let (head, beam) = (lying(0.0, false, "{}", sea), lying(90.0, false, "{}", sea));
    assert!(std(|t| beam.at(t).roll.value) > 2.0 * DEG);
    assert!(std(|t| head.at(t).roll.value) < 0.01 * DEG);
    assert!(std(|t| head.at(t).pitch.value) > 0.5 * DEG);
    assert!(std(|t| beam.at(t).pitch.value) < 0.01 * DEG);
}

#[test]
fn a_long_ship_heaves_less_than_a_short_one() {
    let heave = |hull| {
        let motion = lying(0.0, false, hull, "{ state = 4, from_deg = 0.0 }");
        std(|t| motion.at(t).displacement[2])
    };
    assert!(heave("{ length_m = 150.0 }") < 0.3 * heave("{ length_m = 30.0 }"));
}

#[test]
fn roll_is_strongest_at_its_own_period() {
    let roll = |period: f64| {
        let sea = format!(
            "{{ significant_height_m = 1.0, peak_period_s = {period:?}, gamma = 7.0, from_deg = 90.0 }}"
        );
        let motion = lying(0.0, false, "{ roll_period_s = 10.0 }", &sea);
        std(|t| motion.at(t).roll.value)
    };
    assert!(roll(10.0) > 1.5 * roll(7.0) && roll(10.0) > 1.5 * roll(16.0));
}

#[test]
fn a_moored_ship_works_slowly_in_her_moorings() {
    let sea = "{ significant_height_m = 0.0, peak_period_s = 8.0, mooring_sway_m = 0.3, mooring_yaw_deg = 0.4 }";
    let moored = lying(0.0, true, "{}", sea);
    assert_relative_eq!(std(|t| moored.at(t).displacement[0]), 0.3, max_relative = 0.02);
    assert_relative_eq!(std(|t| moored.at(t).displacement[1]), 0.3, max_relative = 0.02);
    assert_relative_eq!(std(|t| moored.at(t).yaw.value), 0.4 * DEG, max_relative = 0.02);
    assert_relative_eq!(moored.sway_std(0.0), 0.3, max_relative = 1e-9);
    assert_eq!(std(|t| lying(0.0, false, "{}", sea).at(t).displacement[0]), 0.0);
}

#[test]
fn she_heels_outward_in_a_turn() {
    let calm = ROUTE.replace("state = 5", "state = 0");
    let motion = Motion::new(&scenario(&calm), 1);
    // to starboard at 105 s, to port at 400 s
    assert!(motion.at(105.0).roll.value < -0.01 * DEG);
    assert!(motion.at(400.0).roll.value > 0.1 * DEG);
}

#[test]
fn a_gust_leaves_the_moored_ship_elsewhere_and_a_tug_lets_her_come_back() {
    let sea = |until: &str| {
        format!(
            "{{ significant_height_m = 0.0, peak_period_s = 8.0, mooring_sway_m = 0.0, \
             shifts = [{{ at_s = 100.0, forward_m = 3.0, starboard_m = -4.0{until} }}] }}"
        )
    };
    let (gust, tug) =
        (lying(90.0, true, "{}", &sea("")), lying(90.0, true, "{}", &sea(", until_s = 220.0")));
    // heading east, forward is east and port is north
    for (t, north, east) in [(99.0, 0.0, 0.0), (110.0, 2.0, 1.5), (121.0, 4.0, 3.0)] {
        for motion in [&gust, &tug] {
            assert_relative_eq!(motion.at(t).displacement[0], north, epsilon = 1e-9);
            assert_relative_eq!(motion.at(t).displacement[1], east, epsilon = 1e-9);
        }
    }
    assert_relative_eq!(gust.at(1e4).displacement[0], 4.0, epsilon = 1e-9);
    assert_relative_eq!(tug.at(219.0).displacement[0], 4.0, epsilon = 1e-9);
    assert_relative_eq!(tug.at(241.0).displacement[0], 0.0, epsilon = 1e-9);
}

#[test]
fn the_velocity_of_a_shift_is_the_smooth_derivative_of_its_displacement() {
    let sea = "{ state = 3, shifts = [{ at_s = 10.0, starboard_m = 5.0, until_s = 31.0 }] }";
    let motion = lying(30.0, true, "{}", sea);
    let h = 1e-4;
    for i in 0..450 {
        let t = 8.0 + 0.1 * f64::from(i);
        let (before, now, after) = (motion.at(t - h), motion.at(t), motion.at(t + h));
        for axis in 0..2 {
            let slope = (after.displacement[axis] - before.displacement[axis]) / (2.0 * h);
            assert_relative_eq!(now.velocity[axis].value, slope, epsilon = 1e-6);
            let slope = (after.velocity[axis].value - before.velocity[axis].value) / (2.0 * h);
            assert_relative_eq!(now.velocity[axis].rate, slope, epsilon = 1e-5);
        }
    }
}

#[test]
fn what_is_said_of_the_swinging_at_the_berth_is_what_she_does() {
    let sea = "{ state = 4, from_deg = 60.0, exposure = [{ at_s = 0.0, factor = 0.5 }] }";
    let motion = lying(0.0, true, "{}", sea);
    let [moorings, waves] = motion.swings(0.0);
    for axis in 0..2 {
        let both = moorings[axis].std.hypot(waves[axis].std);
        assert_relative_eq!(std(|t| motion.at(t).displacement[axis]), both, max_relative = 0.03);
        // the square of the mean frequency is a little below the mean of the square
        let speed =
            (moorings[axis].std * moorings[axis].omega).hypot(waves[axis].std * waves[axis].omega);
        assert_relative_eq!(std(|t| motion.at(t).velocity[axis].value), speed, max_relative = 0.1);
        let period = std::f64::consts::TAU / moorings[axis].omega;
        assert!((80.0..92.0).contains(&period), "{period}");
    }
}
