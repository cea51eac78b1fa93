//! What a Signal K server is told, read back as JSON.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::geoid::undulation;
use insd_base::units::DEG;
use insd_base::{
    Attitude, Body, Geodetic, Heave, HeaveQuality, Mode, Ned, Solution, SolutionSigma, Time,
    UtcTime,
};
use insd_output::{
    Manner, MessageKind, OutputEpoch, OutputPortConfig, Port, Profile, Rate, SatelliteGeometry,
    Variation,
};
use serde_json::Value;

/// A ship that leans by 10 deg and pitches by 5 deg to this side, and turns to it.
fn solution(side: f64) -> Solution {
    Solution {
        time: Time::START,
        position: Geodetic::from_degrees(35.5, -139.25, 40.0),
        velocity: Ned::new(0.0, -5.0, 0.0),
        attitude: Attitude {
            roll: side * 10.0 * DEG,
            pitch: side * 5.0 * DEG,
            heading: -0.5 * DEG,
        },
        rate: Body::new(0.0, 0.0, side * 0.01),
        sigma: SolutionSigma {
            position: Ned::new(0.6, 0.8, 1.25),
            heading: 0.02 * DEG,
            ..SolutionSigma::default()
        },
        mode: Mode::Aided,
        judgement: insd_base::Judgement::default(),
        source: None,
        hidden: insd_base::Protection::default(),
    }
}

fn epoch(side: f64) -> OutputEpoch {
    let (time, sigma, quality) = (Time::START, 0.02, HeaveQuality::Settled);
    let (heave, rate, acceleration) = (side * 0.5, 0.0, 0.0);
    OutputEpoch {
        solution: Some(solution(side)),
        heave: Some(Heave { time, heave, rate, acceleration, sigma, quality, delayed: None }),
        utc: UtcTime::from_civil((2026, 1, 2), (3, 4, 5), 100_000_000),
        variation: Some(Variation { value: side * 4.0 * DEG, model: 2025, day: None }),
        current: Some(Ned::new(-2.0, 0.0, 0.0)),
        receiver: Some(SatelliteGeometry {
            satellites: Some(17),
            hdop: Some(0.7),
            ..SatelliteGeometry::default()
        }),
        ..OutputEpoch::unknown(Time::START)
    }
}

fn line(manner: Manner, epoch: &OutputEpoch) -> String {
    let messages = vec![(MessageKind::named("SIGNALK").unwrap(), Rate::from_hertz(10.0))];
    let config = OutputPortConfig { messages, manner, ..OutputPortConfig::default() };
    let message = Port::new(config).messages(epoch).remove(0);
    String::from_utf8(message.content.to_bytes()).unwrap()
}

/// The value of a path; it must be there, if only as null.
fn value(line: &str, path: &str) -> Value {
    let delta: Value = serde_json::from_str(line.trim_end()).unwrap();
    let values = delta["updates"][0]["values"].as_array().unwrap();
    let mut own = values.iter().filter(|value| value["path"] == path);
    let found = own.next().unwrap_or_else(|| panic!("{path} in {line}"))["value"].clone();
    assert_eq!(own.next(), None, "{path} stands once");
    found
}

fn paths(line: &str) -> Vec<String> {
    let delta: Value = serde_json::from_str(line.trim_end()).unwrap();
    let values = delta["updates"][0]["values"].as_array().unwrap().clone();
    values.iter().map(|value| value["path"].as_str().unwrap().to_owned()).collect()
}

fn near(value: &Value, expected: f64, limit: f64) {
    let number = value.as_f64().unwrap();
    assert!((number - expected).abs() <= limit, "{number}, expected {expected}");
}

#[test]
fn a_delta_has_position_motion_and_attitude_in_the_units_and_signs_of_signal_k() {
    for side in [1.0, -1.0] {
        let line = line(Manner::default(), &epoch(side));
        assert!(line.ends_with("}\r\n") && line.matches('\n').count() == 1, "one line: {line}");
        let position = value(&line, "navigation.position");
        near(&position["latitude"], 35.5, 1e-8);
        near(&position["longitude"], -139.25, 1e-8);
        let geoid = undulation(&solution(side).position).unwrap();
        near(&position["altitude"], 40.0 - geoid, 0.001);
        near(&value(&line, "navigation.gnss.geoidalSeparation"), geoid, 0.001);
        near(&value(&line, "navigation.headingTrue"), 359.5 * DEG, 1e-7);
        let magnetic = ((359.5 - side * 4.0) * DEG).rem_euclid(std::f64::consts::TAU);
        near(&value(&line, "navigation.headingMagnetic"), magnetic, 1e-7);
        near(&value(&line, "navigation.magneticVariation"), side * 4.0 * DEG, 1e-7);
        near(&value(&line, "navigation.courseOverGroundTrue"), 270.0 * DEG, 1e-7);
        near(&value(&line, "navigation.speedOverGround"), 5.0, 0.001);
        let ahead = 2.0 * (0.5 * DEG).cos() + 5.0 * (0.5 * DEG).sin();
        near(&value(&line, "navigation.speedThroughWater"), ahead, 0.001);
        near(&value(&line, "navigation.rateOfTurn"), solution(side).rate_of_turn(), 1e-7);
        assert!(value(&line, "navigation.rateOfTurn").as_f64().unwrap() * side > 0.0);
        let attitude = value(&line, "navigation.attitude");
        near(&attitude["roll"], side * 10.0 * DEG, 1e-7);
        near(&attitude["pitch"], side * 5.0 * DEG, 1e-7);
        near(&attitude["yaw"], 359.5 * DEG, 1e-7);
        near(&value(&line, "environment.heave"), side * 0.5, 0.001);
        near(&value(&line, "navigation.ins.positionSigma"), 1.0, 0.001);
        near(&value(&line, "navigation.ins.headingSigma"), 0.02 * DEG, 1e-7);
        near(&value(&line, "navigation.gnss.satellites"), 17.0, 0.0);
        assert_eq!(value(&line, "navigation.gnss.methodQuality"), "DGNSS fix");
        assert_eq!(value(&line, "navigation.ins.mode"), "aided navigation");
        assert_eq!(value(&line, "navigation.datetime"), "2026-01-02T03:04:05.100Z");
        assert!(line.contains(r#""timestamp":"2026-01-02T03:04:05.100Z","#), "{line}");
    }
}

#[test]
fn what_is_not_known_is_null_and_every_path_is_there_to_say_so() {
    let (full, empty) = (
        line(Manner::default(), &epoch(1.0)),
        line(Manner::default(), &OutputEpoch::unknown(Time::START)),
    );
    assert_eq!(paths(&full), paths(&empty), "a value that was told is taken back");
    for path in paths(&empty) {
        let value = value(&empty, &path);
        match path.as_str() {
            "navigation.attitude" => {
                assert!(value.as_object().unwrap().values().all(Value::is_null), "{value}");
            }
            "navigation.gnss.methodQuality" => assert_eq!(value, "no GPS"),
            "navigation.ins.mode" => assert_eq!(value, "no solution"),
            _ => assert!(value.is_null(), "{path}: {value}"),
        }
    }
    assert!(!empty.contains("timestamp"), "without UTC the server stamps it: {empty}");
}

#[test]
fn a_delta_passes_the_policy_like_every_sentence() {
    let with = |change: &dyn Fn(&mut Solution)| {
        let mut own = solution(1.0);
        change(&mut own);
        line(Manner::default(), &OutputEpoch { solution: Some(own), ..epoch(1.0) })
    };
    let unsure = with(&|own| own.sigma.heading = 3.0 * DEG);
    for path in
        ["navigation.headingTrue", "navigation.headingMagnetic", "navigation.speedThroughWater"]
    {
        assert!(value(&unsure, path).is_null(), "{path}");
    }
    let attitude = value(&unsure, "navigation.attitude");
    assert!(attitude["yaw"].is_null() && !attitude["roll"].is_null(), "{attitude}");
    let tilted = value(&with(&|own| own.sigma.roll = 1.0 * DEG), "navigation.attitude");
    assert!(tilted["roll"].is_null() && tilted["pitch"].is_null() && !tilted["yaw"].is_null());
    let lost = with(&|own| own.sigma.position = Ned::new(200.0, 200.0, 2.0));
    for path in
        ["navigation.position", "navigation.gnss.geoidalSeparation", "navigation.ins.positionSigma"]
    {
        assert!(value(&lost, path).is_null(), "{path}");
    }
    assert_eq!(value(&lost, "navigation.gnss.methodQuality"), "no GPS");
    let dead = with(&|own| own.mode = Mode::DeadReckoning);
    assert_eq!(value(&dead, "navigation.gnss.methodQuality"), "Estimated (DR) mode");
    assert_eq!(value(&dead, "navigation.ins.mode"), "dead reckoning");
    let fault = with(&|own| own.mode = Mode::Fault);
    for path in [
        "navigation.position",
        "navigation.headingTrue",
        "navigation.speedOverGround",
        "environment.heave",
    ] {
        assert!(value(&fault, path).is_null(), "{path}");
    }
    let broken = with(&|own| {
        own.attitude.heading = f64::NAN;
        own.velocity = Ned::new(f64::INFINITY, 0.0, 0.0);
    });
    assert!(value(&broken, "navigation.headingTrue").is_null());
}

#[test]
fn a_simulated_ship_is_marked_and_what_has_no_mark_is_null() {
    let manner = Manner { simulated: true, ..Manner::default() };
    let marked = line(manner.clone(), &epoch(1.0));
    assert_eq!(value(&marked, "navigation.gnss.methodQuality"), "Simulator mode");
    assert!(value(&marked, "navigation.position").is_object());
    for path in [
        "navigation.headingTrue",
        "navigation.speedOverGround",
        "navigation.rateOfTurn",
        "environment.heave",
    ] {
        assert!(value(&marked, path).is_null(), "{path}");
    }
    let open = line(Manner { unmarked_when_simulated: true, ..manner }, &epoch(1.0));
    near(&value(&open, "navigation.speedOverGround"), 5.0, 0.001);
}

#[test]
fn the_longest_delta_is_within_what_the_budget_reckons_with() {
    let mut own = solution(-1.0);
    own.position = Geodetic::from_degrees(-89.123_456_78, -179.123_456_78, -9999.999);
    let line = line(Manner::default(), &OutputEpoch { solution: Some(own), ..epoch(-1.0) });
    let longest = MessageKind::named("SIGNALK").unwrap().longest();
    assert!(line.len() <= longest && line.len() * 5 > longest * 4, "{} {longest}", line.len());
}

#[test]
fn the_profile_of_a_server_sends_deltas_five_times_a_second() {
    let config = Profile::named("signalk").unwrap().port();
    let kinds: Vec<_> =
        config.messages.iter().map(|(kind, rate)| (kind.name(), rate.as_hertz())).collect();
    assert_eq!(kinds, [("SIGNALK", 5.0)]);
}
