use super::*;
use crate::shipped;

const SMALL: &str = r#"
name = "small"
mode = "underway"
[start]
lat_deg = 35.0
lon_deg = 139.0
[[route.legs]]
heading_deg = 10.0
speed_kn = 8.0
duration_s = 60.0
[imu]
grade = "navigation"
"#;

fn faults_of(text: &str) -> Vec<ScenarioFault> {
    match Scenario::from_toml(text) {
        Err(ScenarioError::Values(faults)) => faults,
        other => panic!("expected faults, found {other:?}"),
    }
}

#[test]
fn every_shipped_scenario_parses_and_says_what_it_is_for() {
    for (file, text) in shipped() {
        let scenario = Scenario::from_toml(text).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(!scenario.name().is_empty() && !scenario.description().is_empty(), "{file}");
        assert!(scenario.duration() >= 600.0, "{file}");
    }
}

#[test]
fn shipped_scenarios_are_numbered_in_order_and_differ_in_name() {
    let mut names = std::collections::BTreeSet::new();
    for (index, (file, text)) in shipped().iter().enumerate() {
        assert!(file.starts_with(&format!("{:02}-", index + 1)), "{file}");
        assert!(names.insert(Scenario::from_toml(text).unwrap().name().to_owned()), "{file}");
    }
}

#[test]
fn an_unknown_key_is_named_with_its_line_and_a_caret() {
    let text = format!("{SMALL}rate_khz = 1.0\n");
    let Err(ScenarioError::Syntax(message)) = Scenario::from_toml(&text) else { panic!() };
    assert!(message.contains("rate_khz"), "{message}");
    assert!(message.contains("line 13") && message.contains('^'), "{message}");
}

#[test]
fn a_value_of_the_wrong_type_is_shown_where_it_stands() {
    let text = SMALL.replace("speed_kn = 8.0", "speed_kn = \"fast\"");
    let Err(ScenarioError::Syntax(message)) = Scenario::from_toml(&text) else { panic!() };
    assert!(message.contains("\"fast\"") && message.contains('^'), "{message}");
}

#[test]
fn all_bad_values_are_reported_together_each_with_its_key() {
    let text = SMALL
        .replace("lat_deg = 35.0", "lat_deg = 95.0")
        .replace("speed_kn = 8.0", "speed_kn = -8.0")
        .replace("[imu]", "[gnss]\nrate_hz = 0.0\n[sea]\ngamma = 0.0\n[imu]\nrate_hz = 5000.0");
    let keys: Vec<String> = faults_of(&text).into_iter().map(|fault| fault.key).collect();
    for key in [
        "start.lat_deg",
        "route.legs[0].speed_kn",
        "gnss.rate_hz",
        "sea",
        "sea.gamma",
        "imu.rate_hz",
    ] {
        assert!(keys.iter().any(|k| k == key), "{key} not in {keys:?}");
    }
}

#[test]
fn the_message_says_what_was_expected_and_what_was_found() {
    let error =
        Scenario::from_toml(&SMALL.replace("lat_deg = 35.0", "lat_deg = 95.0")).unwrap_err();
    assert_eq!(error.to_string(), "start.lat_deg: expected a number from -90 to 90, found 95");
}

#[test]
fn a_leg_too_short_for_its_turn_is_refused() {
    let leg = "[[route.legs]]\nheading_deg = 190.0\nspeed_kn = 8.0\nduration_s = 60.0\n[imu]";
    let faults = faults_of(&SMALL.replace("[imu]", leg));
    assert_eq!(faults[0].key, "route.legs[1].duration_s");
}

#[test]
fn not_a_number_is_refused_wherever_a_number_decides() {
    for (key, value) in
        [("heading_deg = 10.0", "heading_deg = nan"), ("lon_deg = 139.0", "lon_deg = inf")]
    {
        assert_eq!(faults_of(&SMALL.replace(key, value)).len(), 1, "{key}");
    }
}

#[test]
fn moored_needs_a_leg_at_the_berth() {
    assert_eq!(faults_of(&SMALL.replace("underway", "moored"))[0].key, "mode");
}

#[test]
fn fault_times_are_either_given_or_random() {
    let with = |when: &str| {
        let outage = format!("[[gnss.outages]]\nduration_s = 5.0\nwhen = {when}\n[imu]");
        Scenario::from_toml(&SMALL.replace("[imu]", &outage))
    };
    assert!(with("{ at_s = [3.0] }").is_ok());
    assert!(with("{ count = 2, window_s = [0.0, 20.0] }").is_ok());
    for bad in [
        "{}",
        "{ count = 2 }",
        "{ at_s = [1.0], count = 1 }",
        "{ count = 5, window_s = [0.0, 20.0] }",
    ] {
        let error = with(bad).unwrap_err().to_string();
        assert!(error.contains("gnss.outages[0].when"), "{error}");
    }
}

#[test]
fn the_start_must_be_an_instant_in_utc() {
    let text = format!("start_utc = \"yesterday\"\n{SMALL}");
    assert_eq!(faults_of(&text)[0].key, "start_utc");
}

#[test]
fn a_shift_comes_back_after_it_was_there() {
    let with = |shift: &str| {
        Scenario::from_toml(&format!("{SMALL}[sea]\nstate = 2\nshifts = [{{ {shift} }}]\n"))
    };
    assert!(with("at_s = 5.0, forward_m = 1.0").is_ok());
    assert!(with("at_s = 5.0, until_s = 25.0, forward_m = 1.0").is_ok());
    for bad in ["at_s = 5.0, until_s = 24.0", "at_s = -1.0", "at_s = 5.0, over_s = 0.0"] {
        let error = with(bad).unwrap_err().to_string();
        assert!(error.starts_with("sea.shifts[0]."), "{error}");
    }
}
