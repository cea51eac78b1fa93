//! Installations that are not as configured: the ship stays where she is, and the cause is named.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::units::{DEG, wrap_pi};
use insd_base::{
    Body, Event, Finding, Geodetic, Mode, Motion, Party, Rejection, Solution, Span, Truth, Voyage,
    earth,
};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, shipped, simulate};
use nalgebra::{Rotation3, Vector3};

/// A quarter of an hour under way in sea state 4, with four turns.
fn voyage() -> Voyage {
    let (_, text) = shipped().iter().find(|(name, _)| name.starts_with("10")).unwrap();
    simulate(&Scenario::from_toml(text).unwrap().with_duration(1000.0), 3)
}

struct Sailed {
    solutions: Vec<Solution>,
    truth: Vec<Truth>,
    told: Vec<Finding>,
    last: Vec<Finding>,
    /// Measurements that were refused as not usable.
    unusable: u64,
}

fn sail(voyage: Voyage) -> Sailed {
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    sail_with(config, voyage)
}

fn sail_with(config: EngineConfig, voyage: Voyage) -> Sailed {
    let mut engine = Engine::new(config);
    let (mut solutions, mut told) = (Vec::new(), Vec::new());
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Solution(solution) => solutions.push(solution),
                Output::Event(Event::InstallationFound { finding, .. }) => told.push(finding),
                _ => {}
            }
        }
    }
    let refused = engine.counts().rejected.iter();
    let unusable =
        refused.filter(|((_, why), _)| *why == Rejection::NotUsable).map(|(_, n)| n).sum();
    Sailed { solutions, truth: voyage.truth, told, last: engine.findings().to_vec(), unusable }
}

impl Sailed {
    fn names(&self) -> Vec<&'static str> {
        self.told.iter().map(Finding::as_str).collect()
    }

    /// RMS of the horizontal error of the last minute, m, and over the claimed sigma.
    fn end(&self) -> (f64, f64) {
        let from = self.solutions.len() - 60;
        let (mut square, mut scaled) = (0.0, 0.0);
        for solution in &self.solutions[from..] {
            let error = self.off(solution).powi(2);
            square += error / 60.0;
            scaled += error / solution.sigma.position.0.xy().norm_squared() / 60.0;
        }
        (square.sqrt(), scaled.sqrt())
    }

    /// Horizontal error of a solution, m.
    fn off(&self, solution: &Solution) -> f64 {
        let truth = self.truth.iter().find(|truth| truth.time >= solution.time).unwrap();
        let apart = earth::ecef(&solution.position).0 - earth::ecef(&truth.position).0;
        (earth::c_ne(&truth.position) * apart).xy().norm()
    }

    /// The greatest horizontal error from an instant on, in claimed sigmas.
    fn worst_after(&self, second: f64) -> f64 {
        let told = self.solutions.iter().filter(|own| own.time.as_seconds() > second);
        let sigmas = told.map(|own| self.off(own) / own.sigma.position.0.xy().norm());
        sigmas.fold(0.0, f64::max)
    }
}

/// The samples of an IMU that is turned in the ship by these angles, deg.
fn turned(mut voyage: Voyage, roll: f64, pitch: f64, yaw: f64) -> Voyage {
    let c = Rotation3::from_euler_angles(roll * DEG, pitch * DEG, yaw * DEG).inverse();
    for sample in &mut voyage.imu {
        sample.message.delta_theta = Body(c * sample.message.delta_theta.0);
        sample.message.delta_velocity = Body(c * sample.message.delta_velocity.0);
    }
    voyage
}

#[test]
fn nothing_is_found_where_all_is_as_configured() {
    let sailed = sail(voyage());
    assert_eq!(sailed.told, []);
}

#[test]
fn a_lever_arm_of_the_wrong_sign_costs_a_ship_nothing_and_is_told() {
    let truth = sail(voyage()).end().0;
    for wrong in [[-6.0, -0.8, 14.0], [6.0, 0.8, 14.0], [-60.0, -8.0, -140.0]] {
        let mut voyage = voyage();
        voyage.header.lever_arms.gnss = Body(Vector3::from(wrong));
        let sailed = sail(voyage);
        let (error, sigmas) = sailed.end();
        assert!(error < 1.5 * truth.max(0.8) && sigmas < 3.0, "{wrong:?}: {error} m, {sigmas}");
        let Some(Finding::GnssLever { found, .. }) = sailed.last.first() else {
            panic!("{wrong:?}: {:?}", sailed.last);
        };
        let off = found.0 - Vector3::new(-6.0, -0.8, -14.0);
        assert!(off.amax() < 2.5, "{wrong:?}: {found:?}");
    }
}

/// Her place at the berth was surveyed, but until she turns nobody can tell whether a lever arm was measured wrongly, or the
/// berth is not where it is said to be: one taken from a chart.
#[test]
fn a_wrong_lever_arm_is_covered_at_a_surveyed_berth_and_named_at_the_first_turns() {
    for seed in [1, 8] {
        let mut voyage = departure_of(1000.0, seed);
        voyage.header.lever_arms.gnss = Body(Vector3::new(-0.8, -6.0, -14.0));
        let sailed = sail(voyage);
        let (worst, (error, sigmas)) = (sailed.worst_after(110.0), sailed.end());
        assert_eq!(sailed.names(), ["gnss_lever"], "{seed}: {:?}", sailed.told);
        assert!(worst < 4.0, "{seed}: {worst}");
        assert!(error < 3.0 && sigmas < 3.0, "{seed}: {error} m, {sigmas}");
    }
}

#[test]
fn a_berth_that_is_named_elsewhere_is_covered_by_the_claims() {
    for (seed, north) in [(1, 5.0), (2, 10.0), (3, 10.0)] {
        let mut voyage = departure_of(1000.0, seed);
        for reference in &mut voyage.reference {
            let place = &mut reference.message.position;
            *place = place.map(|at| Geodetic { latitude: at.latitude + north / 6.36e6, ..at });
        }
        let worst = sail(voyage).worst_after(110.0);
        assert!(worst < 3.5, "{seed}: {worst}");
    }
}

/// What is told as a heading to steer by, while what it was found by is wrong.
#[test]
fn a_heading_that_a_wrong_lever_arm_tells_is_not_told_to_anyone() {
    for wrong in [[-6.0, -0.8, 14.0], [-60.0, -8.0, -140.0]] {
        let mut voyage = voyage();
        voyage.header.lever_arms.gnss = Body(Vector3::from(wrong));
        let sailed = sail(voyage);
        for solution in &sailed.solutions {
            let truth = sailed.truth.iter().find(|truth| truth.time >= solution.time).unwrap();
            let heading = truth.attitude.unwrap().heading;
            let off = wrap_pi(solution.attitude.heading - heading).abs();
            let told = solution.sigma.heading < 2.5 * DEG;
            assert!(!told || off < 5.0 * solution.sigma.heading, "{wrong:?}: {off} {solution:?}");
        }
    }
}

/// A ship that leaves her berth with a log.
fn departure() -> Voyage {
    departure_of(1100.0, 2)
}

fn departure_of(seconds: f64, seed: u64) -> Voyage {
    let (_, text) = shipped().iter().find(|(name, _)| name.starts_with("01")).unwrap();
    simulate(&Scenario::from_toml(text).unwrap().with_duration(seconds), seed)
}

#[test]
fn a_log_that_tells_other_units_is_named_and_not_used() {
    let mut voyage = departure();
    for log in &mut voyage.log {
        log.message.u = log.message.u.map(|u| u / 0.514_444);
        log.message.v = log.message.v.map(|v| v / 0.514_444);
    }
    let sailed = sail(voyage);
    let named = sailed.told.iter().map(Finding::to_string).find(|words| words.contains("knots"));
    assert!(named.is_some(), "{:?}", sailed.told);
    assert!(sailed.end().0 < 3.0 && sailed.end().1 < 3.0, "{:?}", sailed.end());
    assert!(sailed.unusable > 50, "{} of the log were refused", sailed.unusable);
}

#[test]
fn a_log_that_was_found_out_is_not_believed_by_an_alignment_that_begins_anew() {
    let mut voyage = departure_of(1100.0, 14);
    for log in &mut voyage.log {
        log.message.u = log.message.u.map(|u| u * 3.6);
        log.message.v = log.message.v.map(|v| v * 3.6);
    }
    let sailed = sail(voyage);
    assert!(sailed.end().0 < 3.0 && sailed.end().1 < 3.0, "{:?}", sailed.end());
    let named = sailed.told.iter().any(|found| found.to_string().contains("kilometres"));
    assert!(named, "{:?}", sailed.told);
}

#[test]
fn gyros_that_tell_degrees_are_named_at_a_calm_berth() {
    for seed in 1..=8 {
        let mut voyage = departure_of(130.0, seed);
        voyage.imu.iter_mut().for_each(|imu| imu.message.delta_theta.0 *= 57.3);
        assert!(sail(voyage).names().contains(&"imu_rate"), "seed {seed}");
    }
}

#[test]
fn gyros_that_are_mirrored_are_named_and_the_imu_is_not_used() {
    let mut voyage = voyage();
    voyage.imu.iter_mut().for_each(|imu| imu.message.delta_theta.0.z *= -1.0);
    let sailed = sail(voyage);
    assert!(sailed.names().contains(&"imu_turns"), "{:?}", sailed.told);
    assert!(sailed.last.iter().any(Finding::doubts_imu), "{:?}", sailed.last);
}

#[test]
fn a_lever_arm_that_was_not_measured_is_found_and_is_no_fault() {
    let mut voyage = voyage();
    voyage.header.lever_arms.gnss = Body::default();
    let sailed = sail(voyage);
    assert!(sailed.end().0 < 2.0, "{:?}", sailed.end());
    assert_eq!(sailed.names(), ["gnss_lever_unmeasured"]);
    assert!(!sailed.told[0].is_fault());
}

/// The last motion that anyone is shown, with the truth at its time.
fn shown_at_the_end(voyage: &Voyage) -> (Motion, f64) {
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 1.0));
    for received in voyage.received() {
        engine.handle(&received);
        while engine.poll_output().is_some() {}
    }
    let motion = engine.motion().unwrap();
    let time = motion.solution.time;
    let truth =
        voyage.truth.iter().min_by_key(|truth| (truth.time - time).as_nanos().abs()).unwrap();
    let apart = earth::ecef(&motion.solution.position).0 - earth::ecef(&truth.position).0;
    (motion, apart.norm())
}

#[test]
fn an_imu_that_is_upside_down_is_named_and_not_used() {
    for (roll, pitch) in [(180.0, 0.0), (0.0, 180.0), (90.0, 0.0), (0.0, -90.0)] {
        let sailed = sail(turned(voyage(), roll, pitch, 0.0));
        assert_eq!(sailed.names(), ["mounting_tilted"]);
        assert_eq!(sailed.solutions, [], "before anyone could be misled");
    }
    let (motion, off) = shown_at_the_end(&turned(voyage(), 180.0, 0.0, 0.0));
    let sigma = motion.solution.sigma;
    assert_eq!(motion.solution.mode, Mode::Standby, "receivers pass through");
    assert!(motion.solution.judgement.excluded.contains(Party::Imu), "and it says so");
    assert!(off < 3.0 * sigma.position.0.norm() && off < 30.0, "{off} m, {sigma:?}");
    assert!(sigma.heading > 90.0 * DEG && sigma.roll > 90.0 * DEG, "{sigma:?}");
}

#[test]
fn an_imu_that_is_turned_about_the_vertical_is_named_and_not_used() {
    for yaw in [90.0, 180.0, -90.0] {
        let sailed = sail(turned(voyage(), 0.0, 0.0, yaw));
        assert!(sailed.names().contains(&"mounting_turned"), "{yaw}: {:?}", sailed.told);
        let (motion, off) = shown_at_the_end(&turned(voyage(), 0.0, 0.0, yaw));
        assert_eq!(motion.solution.mode, Mode::Standby);
        assert!(motion.solution.sigma.heading > 90.0 * DEG && off < 30.0, "{off} m");
    }
}

#[test]
fn epochs_that_are_tagged_late_are_set_back() {
    let truth = sail(voyage()).end().0;
    for late in [0.5, -0.5] {
        let mut voyage = voyage();
        for fix in &mut voyage.gnss {
            fix.message.time = fix.message.time + Span::from_seconds(late);
            fix.arrival = Some(fix.message.time);
        }
        let sailed = sail(voyage);
        let (error, sigmas) = sailed.end();
        assert!(error < 1.5 * truth.max(0.8) && sigmas < 3.0, "{late} s: {error} m, {sigmas}");
        let Some(Finding::GnssDelay { found, .. }) = sailed.last.first() else {
            panic!("{late} s: {:?}", sailed.last);
        };
        assert!((found - late).abs() < 0.1, "{late} s: {:?}", sailed.last);
    }
}

#[test]
fn an_operator_who_accepts_the_mounting_has_his_heading() {
    let voyage = turned(voyage(), 0.0, 0.0, 180.0);
    let config =
        EngineConfig { accept_mounting: true, ..EngineConfig::for_voyage(&voyage.header, 1.0) };
    let sailed = sail_with(config, voyage);
    assert!(!sailed.names().contains(&"mounting_turned"), "{:?}", sailed.told);
    assert!(sailed.solutions.last().unwrap().sigma.heading < 1.0 * DEG);
}

#[test]
fn an_imu_that_tells_other_units_is_named_and_nothing_is_made_of_it() {
    let mut in_g = voyage();
    in_g.imu.iter_mut().for_each(|imu| imu.message.delta_velocity.0 /= 9.806_65);
    let mut in_degrees = voyage();
    in_degrees.imu.iter_mut().for_each(|imu| imu.message.delta_theta.0 *= 57.3);
    for (voyage, name) in [(in_g, "imu_force"), (in_degrees, "imu_rate")] {
        let sailed = sail(voyage);
        assert_eq!(sailed.names(), [name]);
        assert_eq!(sailed.solutions.len(), 0);
    }
}
