//! What a port says of a solution, and when it is silent.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::geoid::undulation;
use insd_base::units::{DEG, KNOT};
use insd_base::{Attitude, Body, Geodetic, Mode, Ned, Solution, SolutionSigma, Time, UtcTime};
use insd_output::{
    Manner, MessageKind, OutputEpoch, OutputPortConfig, Policy, Port, Profile, Rate,
};
use proptest::prelude::*;

/// 2026-01-02 03:04:05 and so many milliseconds.
fn utc(ms: u32) -> Option<UtcTime> {
    UtcTime::from_civil((2026, 1, 2), (3, 4, 5), ms * 1_000_000)
}

fn epoch(solution: &Solution) -> OutputEpoch {
    OutputEpoch { solution: Some(*solution), utc: utc(0), ..OutputEpoch::unknown(solution.time) }
}

fn bridge() -> OutputPortConfig {
    Profile::named("bridge").unwrap().port()
}

fn simulated(unmarked_when_simulated: bool) -> OutputPortConfig {
    let manner = Manner { simulated: true, unmarked_when_simulated, policy: Policy::default() };
    OutputPortConfig { manner, ..bridge() }
}

fn solution() -> Solution {
    Solution {
        time: Time::START,
        position: Geodetic::from_degrees(35.5, -139.25, 40.0),
        velocity: Ned::new(0.0, 10.0 * KNOT, 0.0),
        attitude: Attitude { roll: 0.02, pitch: -0.01, heading: 91.5 * DEG },
        rate: Body::new(0.0, 0.0, -12.0 * DEG / 60.0),
        sigma: SolutionSigma {
            position: Ned::new(1.0, 1.0, 2.0),
            velocity: Ned::new(0.02, 0.02, 0.02),
            roll: 0.01 * DEG,
            pitch: 0.01 * DEG,
            heading: 0.02 * DEG,
        },
        mode: Mode::Aided,
        judgement: insd_base::Judgement::default(),
        source: None,
        hidden: insd_base::Protection::default(),
    }
}

fn said(config: &OutputPortConfig, solution: &Solution) -> Vec<String> {
    lines(&mut Port::new(config.clone()), &epoch(solution))
}

fn lines(port: &mut Port, epoch: &OutputEpoch) -> Vec<String> {
    let bytes =
        port.messages(epoch).iter().flat_map(|message| message.content.to_bytes()).collect();
    String::from_utf8(bytes).unwrap().split_terminator("\r\n").map(str::to_owned).collect()
}

/// The sentence with this address, without checksum.
fn one(config: &OutputPortConfig, solution: &Solution, address: &str) -> Option<String> {
    let line = said(config, solution).into_iter().find(|line| line[1..].starts_with(address))?;
    Some(line.split('*').next().unwrap().to_owned())
}

#[test]
fn an_aided_ship_is_told_in_full() {
    let lines = said(&bridge(), &solution());
    let stems: Vec<&str> = lines.iter().map(|line| line.split('*').next().unwrap()).collect();
    assert_eq!(
        stems,
        [
            "$INZDA,030405.00,02,01,2026,,",
            "$INGGA,030405.00,3530.00000,N,13915.00000,W,1,,,73.45,M,-33.45,M,,",
            "$INVTG,90.00,T,,M,10.00,N,18.52,K,A",
            "$INRMC,030405.00,A,3530.00000,N,13915.00000,W,10.00,90.00,020126,,,A,S",
            "$HEHDT,91.50,T",
            "$HETHS,91.50,A",
            "$TIROT,-12.0,A",
        ]
    );
}

#[test]
fn a_simulated_ship_is_marked_in_every_sentence_that_has_a_mark() {
    let config = simulated(false);
    let lines = said(&config, &solution());
    assert_eq!(lines.len(), 5, "HDT and ROT have no mark and are not sent: {lines:?}");
    assert!(one(&config, &solution(), "HETHS").unwrap().ends_with(",S"));
    assert!(one(&config, &solution(), "INGGA").unwrap().contains(",W,8,"));
    assert!(one(&config, &solution(), "INVTG").unwrap().ends_with(",S"));
    assert_eq!(said(&simulated(true), &solution()).len(), 7);
}

#[test]
fn hdt_stops_and_ths_says_v_when_the_heading_is_not_to_be_used() {
    let mut unsure = solution();
    unsure.sigma.heading = 3.0 * DEG;
    let aligning = Solution { mode: Mode::FineAlignment, ..solution() };
    let mut lost = solution();
    lost.sigma.heading = f64::NAN;
    for config in [bridge(), simulated(true)] {
        for solution in [&unsure, &aligning, &lost] {
            assert_eq!(one(&config, solution, "HEHDT"), None);
            assert_eq!(one(&config, solution, "HETHS").unwrap(), "$HETHS,,V");
        }
    }
}

#[test]
fn a_heading_between_the_limits_is_estimated() {
    let mut solution = solution();
    solution.sigma.heading = 1.0 * DEG;
    assert_eq!(one(&bridge(), &solution, "HETHS").unwrap(), "$HETHS,91.50,E");
    assert!(one(&bridge(), &solution, "HEHDT").is_some());
}

#[test]
fn position_quality_follows_the_sigma() {
    for (sigma, digit) in [(0.05, 4), (0.2, 5), (0.8, 2), (5.0, 1), (50.0, 6)] {
        let mut solution = solution();
        solution.sigma.position = Ned::new(sigma, 0.0, 0.0);
        let gga = one(&bridge(), &solution, "INGGA").unwrap();
        assert!(gga.contains(&format!(",W,{digit},")), "{sigma}: {gga}");
    }
}

#[test]
fn dead_reckoning_is_never_called_better_than_estimated() {
    for mode in [Mode::DeadReckoning, Mode::Inertial] {
        let solution = Solution { mode, ..solution() };
        assert!(one(&bridge(), &solution, "INGGA").unwrap().contains(",W,6,"));
        assert!(one(&bridge(), &solution, "INVTG").unwrap().ends_with(",E"));
    }
}

#[test]
fn an_invalid_position_is_empty() {
    let fault = Solution { mode: Mode::Fault, ..solution() };
    let mut lost = solution();
    lost.sigma.position = Ned::new(90.0, 90.0, 1.0);
    for config in [bridge(), simulated(true)] {
        for solution in [&fault, &lost] {
            let gga = one(&config, solution, "INGGA").unwrap();
            assert_eq!(gga, "$INGGA,030405.00,,,,,0,,,,,,,,");
            assert_eq!(one(&config, solution, "INVTG").unwrap(), "$INVTG,,T,,M,,N,,K,N");
        }
    }
}

#[test]
fn a_ship_at_rest_has_a_speed_but_no_course() {
    let mut solution = solution();
    solution.velocity = Ned::new(0.01, 0.0, 0.0);
    let vtg = one(&bridge(), &solution, "INVTG").unwrap();
    assert_eq!(vtg, "$INVTG,,T,,M,0.02,N,0.04,K,A");
}

#[test]
fn a_course_that_the_velocity_does_not_support_is_left_empty() {
    let mut solution = solution();
    solution.velocity = Ned::new(0.3, 0.0, 0.0);
    solution.sigma.velocity = Ned::new(0.02, 0.02, 0.02);
    assert!(one(&bridge(), &solution, "INVTG").unwrap().starts_with("$INVTG,0.00,T"));
    solution.sigma.velocity = Ned::new(0.02, 0.05, 0.02);
    assert!(one(&bridge(), &solution, "INVTG").unwrap().starts_with("$INVTG,,T"));
}

#[test]
fn height_above_sea_level_is_never_empty_and_by_the_geoid_that_is_configured_else_by_egm96() {
    let config = OutputPortConfig { geoid_separation: Some(36.7), ..bridge() };
    let gga = one(&config, &solution(), "INGGA").unwrap();
    assert!(gga.ends_with(",W,1,,,3.30,M,36.70,M,,"), "{gga}");
    let gga = one(&bridge(), &solution(), "INGGA").unwrap();
    assert!(gga.ends_with(",W,1,,,73.45,M,-33.45,M,,"), "{gga}");
}

#[test]
fn the_altitude_of_every_sentence_is_height_minus_geoid_all_round_the_world() {
    for latitude in [-89.5, -60.3, -12.0, 0.0, 33.3, 54.1, 89.5] {
        for longitude in [-179.99, -100.0, -3.3, 0.0, 79.0, 147.5, 179.99] {
            let place = Geodetic::from_degrees(latitude, longitude, 25.0);
            let here = Solution { position: place, ..solution() };
            let geoid = undulation(&place).unwrap();
            for name in ["GGA", "GNS"] {
                let config = OutputPortConfig {
                    messages: vec![(MessageKind::named(name).unwrap(), Rate::from_hertz(1.0))],
                    ..OutputPortConfig::default()
                };
                let line = one(&config, &here, &format!("IN{name}")).unwrap();
                let fields: Vec<&str> = line.split(',').collect();
                let own = fields.get(9..).unwrap();
                let number = |index: usize| own[index].parse::<f64>().unwrap();
                let separation = number(if name == "GGA" { 2 } else { 1 });
                assert!((separation - geoid).abs() < 0.0051, "{line} {geoid}");
                assert!((number(0) + separation - 25.0).abs() < 0.011, "{line}");
            }
        }
    }
}

#[test]
fn a_bridge_is_given_rmc_as_consumers_want_it_with_altitude_and_course_before_it() {
    let names: Vec<_> = Port::new(bridge()).kinds().map(MessageKind::name).collect();
    assert_eq!(names, ["ZDA", "GGA", "VTG", "RMC", "HDT", "THS", "ROT"]);
}

#[test]
fn gpsd_is_sent_nothing_that_upsets_its_old_releases() {
    let port = Port::new(Profile::named("gpsd").unwrap().port());
    let names: Vec<_> = port.kinds().map(MessageKind::name).collect();
    // times of 10 Hz hide the end of the epoch; after GST its attitude is no JSON
    assert!(!names.iter().any(|name| name.starts_with("PASHR") || *name == "GST"), "{names:?}");
    let place = |name: &str| names.iter().position(|own| *own == name).unwrap();
    assert!(place("GGA") < place("RMC") && place("VTG") < place("RMC"), "{names:?}");
    assert!(names.contains(&"PTNTHTM"));
}

#[test]
fn one_second_of_solutions_gives_ten_headings_and_one_position() {
    let mut port = Port::new(bridge());
    let mut formatters = Vec::new();
    for step in 0..10 {
        let time = Time::from_nanos(i64::from(step) * 100_000_000);
        let epoch = OutputEpoch { time, utc: utc(step * 100), ..epoch(&solution()) };
        formatters.extend(lines(&mut port, &epoch).into_iter().map(|line| line[3..6].to_owned()));
    }
    let count = |formatter: &str| formatters.iter().filter(|line| *line == formatter).count();
    assert_eq!([count("HDT"), count("THS"), count("ROT")], [10, 10, 10]);
    assert_eq!([count("GGA"), count("VTG"), count("ZDA")], [1, 1, 1]);
}

proptest! {
    #[test]
    fn whatever_the_solution_every_sentence_is_short_and_readable(
        values in prop::array::uniform16(any::<f64>()), mode in 0..7_usize, simulated: bool,
    ) {
        let [lat, lon, height, vn, ve, vd, roll, pitch, heading, wx, wy, wz, sn, se, sv, sh] = values;
        let mode = [
            Mode::CoarseAlignment, Mode::FineAlignment, Mode::InMotionAlignment, Mode::Aided,
            Mode::DeadReckoning, Mode::Inertial, Mode::Fault,
        ][mode];
        let solution = Solution {
            time: Time::START,
            position: Geodetic { latitude: lat, longitude: lon, height },
            velocity: Ned::new(vn, ve, vd),
            attitude: Attitude { roll, pitch, heading },
            rate: Body::new(wx, wy, wz),
            sigma: SolutionSigma {
                position: Ned::new(sn, se, 0.0),
                velocity: Ned::new(sv, sv, sv),
                roll: 0.0, pitch: 0.0, heading: sh,
            },
            mode,
            judgement: insd_base::Judgement::default(),
            source: None,
            hidden: insd_base::Protection::default(),
        };
        let manner = Manner { simulated, ..Manner::default() };
        let config = OutputPortConfig { manner, geoid_separation: Some(sn), ..bridge() };
        for line in said(&config, &solution) {
            prop_assert!(line.len() <= 80);
            prop_assert!(insd_wire::nmea::Sentence::read(line.as_bytes()).is_ok(), "{}", line);
        }
    }
}
