//! When messages leave, of which instant and which point.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::units::DEG;
use insd_base::{
    Attitude, Body, Geodetic, Mode, Motion, Ned, Solution, SolutionSigma, Time, UtcTime,
};
use insd_output::{
    Boundary, Due, MessageKind, OutputPortConfig, OutputStation, Profile, Rate, Situation,
};

/// UTC that is 12.345 ms ahead of a second of the time line.
fn utc(time: Time) -> UtcTime {
    UtcTime::from_nanos(1_795_000_000_012_345_000 + time.as_nanos())
}

/// The last IMU sample of a ship that turns to starboard at 20 deg/s and runs at 10 m/s.
fn turning(time: Time) -> Situation {
    let turned = 20.0 * DEG * time.as_seconds();
    let (sin, cos) = turned.sin_cos();
    let motion = Motion {
        solution: Solution {
            time,
            position: Geodetic::from_degrees(54.0, 8.0, 10.0),
            velocity: Ned::new(10.0 * cos, 10.0 * sin, 0.0),
            attitude: Attitude { roll: 0.0, pitch: 0.0, heading: turned },
            rate: Body::new(0.0, 0.0, 20.0 * DEG),
            sigma: SolutionSigma {
                position: Ned::new(0.5, 0.5, 1.0),
                heading: 0.1 * DEG,
                ..SolutionSigma::default()
            },
            mode: Mode::Aided,
            judgement: insd_base::Judgement::default(),
            source: None,
            hidden: insd_base::Protection::default(),
        },
        acceleration: Some(Ned::new(-3.49 * sin, 3.49 * cos, 0.0)),
        covariance: Some(insd_base::MotionCovariance::zeros()),
        current: None,
    };
    Situation { motion: Some(motion), ..Situation::default() }
}

fn port(messages: &[(&str, f64)]) -> OutputPortConfig {
    let kind =
        |(name, hertz): &(&str, f64)| (MessageKind::named(name).unwrap(), Rate::from_hertz(*hertz));
    OutputPortConfig {
        messages: messages.iter().map(kind).collect(),
        ..OutputPortConfig::default()
    }
}

/// What leaves from `from` to `to`, ms, if the newest IMU sample is so many milliseconds old.
fn sent(station: &mut OutputStation, from: i64, to: i64, age: i64) -> Vec<(Boundary, String)> {
    let at = |ms: i64| Time::from_nanos(ms * 1_000_000);
    station.due(at(from), Some(utc(at(from))));
    let mut said = Vec::new();
    let mut now = at(from);
    loop {
        now = station.next(now, Some(utc(now))).unwrap().at;
        if now > at(to) {
            return said;
        }
        for boundary in station.due(now, Some(utc(now))) {
            let sample = Time::from_nanos((now.as_nanos() / 1_000_000 - age) * 1_000_000);
            station.messages(&boundary, &turning(sample), |_, messages| {
                for message in messages {
                    assert_eq!(message.valid, boundary.time);
                    let line = String::from_utf8(message.content.to_bytes()).unwrap();
                    said.push((boundary, line));
                }
            });
        }
    }
}

#[test]
fn a_heading_is_that_of_its_utc_boundary_however_old_the_last_sample_is() {
    for age in [0, 5, 20, 50] {
        let mut station = OutputStation::new(
            [port(&[("HDT", 50.0), ("THS", 10.0)])],
            vec![Body::default()],
            None,
        );
        let said = sent(&mut station, 1000, 3000, age);
        assert_eq!(said.len(), 100 + 20);
        for (boundary, line) in said {
            assert_eq!(boundary.utc.unwrap().as_nanos() % 20_000_000, 0, "{line}");
            let told: f64 = line.split(',').nth(1).unwrap().parse().unwrap();
            let true_heading = 20.0 * boundary.time.as_seconds();
            assert!((told - true_heading).abs() < 0.006, "{age} ms: {told} for {true_heading}");
        }
    }
}

#[test]
fn whoever_is_to_be_woken_is_told_what_for() {
    let ports = [port(&[("HDT", 4.0)]), port(&[("THS", 40.0)])];
    let mut station =
        OutputStation::new(ports, vec![Body::default()], Some(Rate::from_hertz(100.0)));
    let at = |ms: i64| Time::from_nanos(ms * 1_000_000);
    assert_eq!(station.next(at(0), None).unwrap().why, Due::Grid);
    station.due(at(0), None);
    let mut reasons = Vec::new();
    let mut now = at(0);
    while now < at(100) {
        let wake_up = station.next(now, None).unwrap();
        reasons.push((wake_up.at.as_nanos() / 1_000_000, wake_up.why));
        now = wake_up.at;
        station.due(now, None);
    }
    assert_eq!(reasons[..3], [(10, Due::Groups), (20, Due::Groups), (25, Due::Messages(1))]);
    assert_eq!(reasons.last(), Some(&(100, Due::Upkeep)), "the slowest first");
    assert_eq!(station.next(now, Some(utc(now))).unwrap().why, Due::Grid, "UTC became known");
}

#[test]
fn what_has_not_advanced_is_not_repeated_with_a_new_time() {
    let mut station = OutputStation::new(
        [port(&[("HDT", 1.0), ("THS", 1.0), ("GGA", 1.0)])],
        vec![Body::default()],
        None,
    );
    for (_, line) in sent(&mut station, 10_000, 12_000, 300) {
        let stem = line.split('*').next().unwrap();
        assert!(stem == "$HETHS,,V" || stem.ends_with(",,,,,0,,,,,,,,"), "{stem}");
    }
}

#[test]
fn a_port_speaks_of_its_own_monitoring_point() {
    let bow = OutputPortConfig { point: 1, ..port(&[("GGA", 1.0), ("VTG", 1.0)]) };
    let points = vec![Body::default(), Body::new(100.0, 0.0, 0.0)];
    let mut station = OutputStation::new([bow], points, None);
    // heading 180 when 9 s have gone
    let said = sent(&mut station, 8500, 9400, 0);
    let (_, gga) = &said[0];
    let south: f64 = gga.split(',').nth(2).unwrap()[2..].parse().unwrap();
    let boundary = said[0].0.time.as_seconds() * 20.0 * DEG;
    let expected = 0.0 + 100.0 * boundary.cos() / 1855.3;
    assert!((south - (60.0 + expected).rem_euclid(60.0)).abs() < 1e-4, "{south} {expected}");
    let (_, vtg) = &said[1];
    let knots: f64 = vtg.split(',').nth(5).unwrap().parse().unwrap();
    let bow_speed = 10.0_f64.hypot(100.0 * 20.0 * DEG) / insd_base::units::KNOT;
    assert!((knots - bow_speed).abs() < 0.02, "{knots} for {bow_speed}");
}

#[test]
fn the_rate_of_turn_is_damped_by_the_time_constant_of_its_port() {
    let damped = OutputPortConfig { turn_damping: 2.0, ..port(&[("ROT", 10.0)]) };
    let mut station = OutputStation::new([damped], vec![Body::default()], None);
    let still = |time| {
        let mut moment = turning(time);
        moment.motion.as_mut().unwrap().solution.rate = Body::default();
        moment
    };
    let mut rates = Vec::new();
    for step in 0..60 {
        let time = Time::from_nanos(step * 100_000_000);
        let moment = if step < 20 { still(time) } else { turning(time) };
        station.messages(&Boundary { time, utc: None }, &moment, |_, messages| {
            let line = String::from_utf8(messages[0].content.to_bytes()).unwrap();
            rates.push(line.split(',').nth(1).unwrap().parse::<f64>().unwrap());
        });
    }
    // one time constant after the step: 63.2 % of 1200 deg/min
    assert!((rates[39] - 1200.0 * 0.632).abs() < 5.0, "{:?}", &rates[15..45]);
}

#[test]
fn every_message_and_every_profile_is_in_the_documentation() {
    let page = include_str!("../../../docs/outputs.md");
    for kind in MessageKind::all() {
        let (family, member) = kind.name().split_once('.').unwrap_or((kind.name(), ""));
        let named = |name: &str| page.contains(&format!("`{name}`"));
        let is_member = page.contains(family) && named(&format!(".{member}"));
        assert!(named(kind.name()) || is_member, "{}", kind.name());
    }
    for profile in Profile::all() {
        assert!(page.contains(&format!("`{}`", profile.name)), "{}", profile.name);
    }
}

#[test]
fn every_message_of_every_profile_exists() {
    for profile in Profile::all() {
        let port = profile.port();
        assert_eq!(port.messages.len(), profile.names().count(), "{}", profile.name);
    }
}

#[test]
fn the_time_in_a_mode_begins_anew_with_the_mode() {
    let mut station =
        OutputStation::new([port(&[("PINSD.STA", 1.0)])], vec![Body::default()], None);
    let mut said = Vec::new();
    for second in 0..8 {
        let time = Time::from_nanos(second * 1_000_000_000);
        let mut moment = turning(time);
        if second >= 3 {
            moment.motion.as_mut().unwrap().solution.mode = Mode::Inertial;
        }
        if second == 7 {
            moment.motion = None;
        }
        station.messages(&Boundary { time, utc: None }, &moment, |_, messages| {
            let line = String::from_utf8(messages[0].content.to_bytes()).unwrap();
            said.push(line.split(',').skip(3).take(2).collect::<Vec<_>>().join(" "));
        });
    }
    assert_eq!(said, ["A 0", "A 1", "A 2", "I 0", "I 1", "I 2", "I 3", "S 0"]);
}

/// What a second's boundaries say to a port, if receivers and compass said it so long before, ms.
fn relayed(age: i64, messages: &[(&str, f64)]) -> String {
    let at = |ms: i64| Time::from_nanos(ms * 1_000_000);
    let mut station = OutputStation::new([port(messages)], vec![Body::default()], None);
    station.due(at(0), Some(utc(at(0))));
    let (mut now, mut said) = (at(0), String::new());
    while now < at(1_000) {
        now = station.next(now, Some(utc(now))).unwrap().at;
        let mut moment = turning(now - insd_base::Span::from_nanos(age * 1_000_000));
        let solution = &mut moment.motion.as_mut().unwrap().solution;
        solution.mode = Mode::Standby;
        solution.sigma.roll = std::f64::consts::PI;
        solution.sigma.pitch = std::f64::consts::PI;
        for boundary in station.due(now, Some(utc(now))) {
            station.messages(&boundary, &moment, |_, messages| {
                for message in messages {
                    said += &String::from_utf8(message.content.to_bytes()).unwrap();
                }
            });
        }
    }
    said
}

#[test]
fn a_ship_without_an_imu_still_has_position_course_and_the_heading_of_her_compass() {
    let said = relayed(900, &[("GGA", 1.0), ("VTG", 1.0), ("THS", 1.0), ("ROT", 1.0)]);
    let line = |name: &str| said.lines().find(|line| line.get(3..6) == Some(name)).unwrap_or("");
    assert!(line("GGA").contains(",2,"), "{said}");
    assert!(line("VTG").contains(",D*"), "{said}");
    assert!(line("THS").contains(",E*"), "{said}");
    assert!(!line("ROT").contains(",A*"), "{said}");
    let attitude = relayed(0, &[("XDR", 1.0)]);
    assert!(!attitude.contains("PITCH") && !attitude.contains("ROLL"), "{attitude}");
    assert!(!relayed(2_000, &[("GGA", 1.0)]).contains(",2,"), "what is old is not passed on");
}
