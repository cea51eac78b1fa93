//! What is told of a ship alongside, against a ruler and against ships that are drawn by chance.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::earth::{c_ne, ecef, geodetic};
use insd_base::units::DEG;
use insd_base::{
    Attitude, Body, Ecef, Geodetic, Integrity, Judgement, Mode, Motion, MotionCovariance, Ned,
    Protection, Solution, SolutionSigma, SolutionSource, Time,
};
use nalgebra::{SVector, Vector3};

use super::*;

const FENDER: f64 = 1.0;
const SURVEY: f64 = 0.05;

/// A place so many metres north and east of the quay's first point.
fn place(north: f64, east: f64) -> Geodetic {
    let origin = Geodetic::from_degrees(54.0, 8.0, 0.0);
    let by = c_ne(&origin).transpose() * Vector3::new(north, east, 0.0);
    let level = geodetic(&Ecef(ecef(&origin).0 + by));
    Geodetic { height: 5.0, ..level }
}

/// A quay of 200 m to the east; the water is south of it.
fn quay() -> Quay {
    Quay {
        name: "Pier 3".to_owned(),
        line: [place(0.0, 0.0), place(0.0, 200.0)],
        water: WaterSide::Right,
        fenders: vec![Fender { at: 0.0, off: FENDER }, Fender { at: 200.0, off: FENDER }],
        bollards: vec![10.0, 190.0],
        height: None,
        sigma: SURVEY,
    }
}

/// 120 m long and 20 m wide.
fn hull() -> Hull {
    Hull {
        outline: vec![[60.0, -10.0], [60.0, 10.0], [-60.0, 10.0], [-60.0, -10.0]],
        bow: Body::new(50.0, 0.0, 0.0),
        stern: Body::new(-50.0, 0.0, 0.0),
        manifold: Some(Body::new(5.0, 0.0, -3.0)),
    }
}

fn config() -> DockingConfig {
    DockingConfig {
        berths: vec![quay()],
        hull: Some(hull()),
        rate_sigma: 1e-4,
        chosen: Some("Pier 3".to_owned()),
        ..DockingConfig::default()
    }
}

fn covariance() -> MotionCovariance {
    let sigmas = [0.04, 0.05, 0.1, 0.006, 0.005, 0.01, 0.05 * DEG, 0.05 * DEG, 0.2 * DEG];
    let mut covariance =
        MotionCovariance::from_diagonal(&SVector::<f64, 9>::from(sigmas.map(|s: f64| s * s)));
    // position with velocity, velocity with heading
    for (row, column, share) in [(0, 3, 0.5), (1, 4, -0.3), (3, 8, 0.6), (0, 8, -0.2)] {
        let value = share * sigmas[row] * sigmas[column];
        (covariance[(row, column)], covariance[(column, row)]) = (value, value);
    }
    covariance
}

/// A ship south of the quay's middle, heading so much, deg.
fn ship(heading: f64) -> Motion {
    let covariance = covariance();
    Motion {
        solution: Solution {
            time: Time::from_seconds(10.0),
            position: place(-30.0, 100.0),
            velocity: Ned::new(0.1, 0.05, 0.0),
            attitude: Attitude { roll: 0.0, pitch: 0.0, heading: heading * DEG },
            rate: Body::new(0.0, 0.0, -0.001),
            sigma: SolutionSigma::of_variances(&covariance.diagonal()),
            mode: Mode::Aided,
            judgement: Judgement { integrity: Integrity::Consistent, ..Judgement::default() },
            source: Some(SolutionSource::Rtk),
            hidden: Protection { horizontal: 0.02, vertical: 0.0 },
        },
        acceleration: Some(Ned::default()),
        covariance: Some(covariance),
        current: None,
    }
}

fn look_with(config: DockingConfig, motion: &Motion) -> Docking {
    BerthDesk::new(config).look(Some(motion), motion.solution.time).unwrap()
}

fn look(motion: &Motion) -> Docking {
    look_with(config(), motion)
}

fn close(value: f64, expected: f64, within: f64) {
    assert!((value - expected).abs() < within, "{value}, expected {expected}");
}

#[test]
fn what_is_told_of_a_ship_alongside_is_what_a_ruler_says() {
    let parallel = look(&ship(90.0));
    assert_eq!((parallel.state, parallel.side), (DockingState::Valid, Some(DockingSide::Port)));
    // north turns by 2e-5 rad from the first point of the line to her
    close(parallel.angle.unwrap().value, 0.0, 3e-5);
    let [bow, stern, manifold] = parallel.points.map(Option::unwrap);
    // 30 m less half the beam and the fenders; she turns to port, so her bow comes nearer the faster
    for (point, closing, along) in
        [(bow, 0.15, 150.0), (stern, 0.05, 50.0), (manifold, 0.105, 105.0)]
    {
        close(point.distance.value, 19.0, 2e-3);
        close(point.closing.value, closing, 1e-5);
        close(point.place, along, 2e-3);
        // ahead, less what the turn takes from the port side
        close(point.along.value, 0.04, 1e-5);
    }
    assert_eq!(parallel.contact.unwrap().part, HullPart::Bow);
    // the corner beyond the bow point is the first to touch
    close(parallel.contact.unwrap().speed.value, 0.16, 1e-5);
    close(parallel.contact.unwrap().seconds.value, 19.0 / 0.16, 0.05);

    let bow_in = look(&ship(87.0));
    close(bow_in.angle.unwrap().value, 3.0 * DEG, 3e-5);
    let (sin, cos) = (3.0 * DEG).sin_cos();
    close(bow_in.points[0].unwrap().distance.value, 29.0 - 50.0 * sin - 10.0 * cos, 2e-3);
    close(bow_in.points[1].unwrap().distance.value, 29.0 + 50.0 * sin - 10.0 * cos, 2e-3);
}

#[test]
fn she_may_lie_the_other_way_and_the_points_may_stand_the_other_way() {
    let starboard = look(&ship(273.0));
    assert_eq!(starboard.side, Some(DockingSide::Starboard));
    close(starboard.angle.unwrap().value, 3.0 * DEG, 3e-5);
    assert!(
        starboard.points[0].unwrap().distance.value < starboard.points[1].unwrap().distance.value
    );
    // ahead is west now, and she makes way to the east
    assert!(starboard.points[0].unwrap().along.value < 0.0);
    let mut turned = config();
    turned.berths[0].line.reverse();
    turned.berths[0].water = WaterSide::Left;
    for heading in [87.0, 90.0, 93.0, 273.0] {
        let (one, other) = (look(&ship(heading)), look_with(turned.clone(), &ship(heading)));
        assert_eq!(one.side, other.side);
        close(one.angle.unwrap().value, other.angle.unwrap().value, 1e-4);
        for (one, other) in one.points.iter().flatten().zip(other.points.iter().flatten()) {
            close(one.distance.value, other.distance.value, 1e-3);
            close(one.closing.value, other.closing.value, 1e-5);
            close(one.along.value, other.along.value, 1e-5);
            close(one.place, 200.0 - other.place, 1e-3);
        }
    }
}

#[test]
fn the_distance_is_to_the_fenders_and_between_two_of_them_to_the_line_through_their_faces() {
    let mut uneven = config();
    uneven.berths[0].fenders = vec![Fender { at: 50.0, off: 1.0 }, Fender { at: 150.0, off: 2.0 }];
    let docking = look_with(uneven, &ship(90.0));
    for (point, off) in docking.points.iter().flatten().zip([2.0, 1.0, 1.55]) {
        close(point.distance.value, 20.0 - off, 3e-3);
    }
    let mut bare = config();
    bare.berths[0].fenders.clear();
    close(look_with(bare, &ship(90.0)).points[0].unwrap().distance.value, 20.0, 2e-3);
}

#[test]
fn without_an_outline_the_points_are_those_of_her_side() {
    let mut bare = config();
    let hull = bare.hull.as_mut().unwrap();
    hull.outline.clear();
    (hull.bow, hull.manifold) = (Body::new(50.0, -10.0, 0.0), None);
    let docking = look_with(bare, &ship(90.0));
    close(docking.points[0].unwrap().distance.value, 19.0, 2e-3);
    close(docking.points[1].unwrap().distance.value, 29.0, 2e-3);
    assert_eq!(docking.points[2], None);
    assert_eq!(docking.contact.unwrap().part, HullPart::Bow);
}

/// Numbers that look like chance (Knuth's linear congruence), and normal ones of them (Box and Muller).
struct Dice(u64);

impl Dice {
    fn uniform(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0
    }

    fn normal(&mut self) -> f64 {
        let (one, other) = (self.uniform(), self.uniform());
        (-2.0 * one.ln()).sqrt() * (std::f64::consts::TAU * other).cos()
    }
}

/// A ship that is where her estimate is not: errors of position, velocity and attitude of these sizes, and of the rate.
fn drawn(estimate: &Motion, dice: &mut Dice, rate_sigma: f64) -> Motion {
    let half = covariance().cholesky().unwrap().l();
    let error = half * SVector::<f64, 9>::from_fn(|_, _| dice.normal());
    let mut truth = *estimate;
    let own = &mut truth.solution;
    let moved = c_ne(&own.position).transpose() * error.fixed_rows::<3>(0);
    own.position = geodetic(&Ecef(ecef(&own.position).0 + moved));
    own.velocity.0 += error.fixed_rows::<3>(3);
    own.attitude.roll += error[6];
    own.attitude.pitch += error[7];
    own.attitude.heading += error[8];
    own.rate.0 += Vector3::from_fn(|_, _| rate_sigma * dice.normal());
    truth
}

#[test]
fn sigmas_cover_the_errors_of_ships_that_are_drawn_from_the_covariance() {
    let mut exact = config();
    exact.berths[0].sigma = 0.0;
    exact.rate_sigma = 2e-4;
    let (estimate, mut dice) = (ship(84.0), Dice(7));
    let told = look_with(exact.clone(), &estimate);
    let mut sums = [0.0; 11];
    let draws = 4000;
    for _ in 0..draws {
        let truth = look_with(exact.clone(), &drawn(&estimate, &mut dice, exact.rate_sigma));
        let mut errors = Vec::new();
        for (own, told) in truth.points.iter().flatten().zip(told.points.iter().flatten()) {
            for (own, told) in [
                (own.distance, told.distance),
                (own.closing, told.closing),
                (own.along, told.along),
            ] {
                errors.push((own.value - told.value) / told.sigma);
            }
        }
        let (own, told) = (truth.angle.unwrap(), told.angle.unwrap());
        errors.push((own.value - told.value) / told.sigma);
        let (own, told) =
            (truth.contact.unwrap(), look_with(exact.clone(), &estimate).contact.unwrap());
        errors.push((own.seconds.value - told.seconds.value) / told.seconds.sigma);
        sums.iter_mut().zip(&errors).for_each(|(sum, error)| *sum += error * error);
    }
    for (index, sum) in sums.iter().enumerate() {
        let nees = sum / f64::from(draws);
        // the time to contact is not linear in the speed
        let widest = if index == 10 { 0.15 } else { 0.08 };
        assert!((nees - 1.0).abs() < widest, "{index}: {nees}");
    }
}

#[test]
fn levels_hold_what_may_be_wrong_that_nobody_has_found_and_what_the_survey_leaves() {
    let docking = look(&ship(90.0));
    for point in docking.points.iter().flatten() {
        assert!(point.distance.sigma > SURVEY);
        close(point.level, 5.2 * point.distance.sigma + 0.02, 1e-6);
    }
    // a claim that is larger than the covariance is believed
    let mut wide = ship(90.0);
    wide.solution.sigma.position.0.x = 0.5;
    assert!(look(&wide).points[0].unwrap().distance.sigma >= 0.5);
    // at the ends of the ship the heading counts
    let [bow, _, manifold] = docking.points.map(Option::unwrap);
    assert!(bow.distance.sigma > 1.5 * manifold.distance.sigma);
}

#[test]
fn nothing_is_told_of_what_is_not_known() {
    let told = |change: &dyn Fn(&mut Motion)| {
        let mut motion = ship(90.0);
        change(&mut motion);
        let docking = look(&motion);
        if matches!(docking.state, DockingState::NotValid(_)) {
            assert_eq!((docking.points, docking.contact), ([None; 3], None));
            assert_eq!((docking.angle, docking.side), (None, None));
        }
        docking.state
    };
    let not = DockingState::NotValid;
    let contradiction =
        |own: &mut Motion| own.solution.judgement.integrity = Integrity::Contradiction;
    let unproven = |own: &mut Motion| own.solution.judgement.integrity = Integrity::Unproven;
    for (mode, state) in [
        (Mode::Fault, not(NotDocking::Fault)),
        (Mode::Standby, not(NotDocking::NotNavigating)),
        (Mode::CoarseAlignment, not(NotDocking::NotNavigating)),
        (Mode::FineAlignment, not(NotDocking::NotNavigating)),
        (Mode::InMotionAlignment, not(NotDocking::NotNavigating)),
        (Mode::DeadReckoning, DockingState::Valid),
        (Mode::Inertial, DockingState::Valid),
    ] {
        assert_eq!(told(&|own| own.solution.mode = mode), state);
    }
    assert_eq!(told(&contradiction), not(NotDocking::Contradiction));
    assert_eq!(told(&unproven), DockingState::Doubtful(DockingDoubt::Unproven));
    assert_eq!(told(&|own| own.covariance = None), not(NotDocking::NotNavigating));
    assert_eq!(told(&|own| own.solution.velocity.0.x = f64::NAN), not(NotDocking::NoSolution));
    assert_eq!(told(&|own| own.solution.attitude.heading = f64::NAN), not(NotDocking::NoSolution));
    assert_eq!(told(&|own| own.solution.position = place(-2100.0, 100.0)), not(NotDocking::Away));
    assert_eq!(told(&|own| own.solution.position = place(40.0, 100.0)), not(NotDocking::Ashore));
    assert_eq!(told(&|own| own.solution.position = place(40.0, 400.0)), not(NotDocking::Behind));
    let desk = BerthDesk::new(config());
    let later = Time::from_seconds(11.0);
    for motion in [None, Some(&ship(90.0))] {
        let state = desk.look(motion, later).unwrap().state;
        assert_eq!(state, not(NotDocking::NoSolution), "a second later");
    }
    let mut limited = config();
    limited.limits.level = Some(0.1);
    let state = look_with(limited, &ship(90.0)).state;
    assert_eq!(state, DockingState::Doubtful(DockingDoubt::Level));
}

#[test]
fn a_line_of_no_length_tells_nothing() {
    let mut point = config();
    let one = point.berths[0].line[0];
    point.berths[0].line = [one, one];
    assert!(matches!(look_with(point, &ship(90.0)).state, DockingState::NotValid(_)));
    let mut none = config();
    none.hull = None;
    assert_eq!(BerthDesk::new(none).look(Some(&ship(90.0)), Time::from_seconds(10.0)), None);
}

#[test]
fn a_contact_is_foretold_only_where_she_surely_comes_nearer_and_meets_the_quay() {
    let contact = |change: &dyn Fn(&mut Motion)| {
        let mut motion = ship(90.0);
        motion.solution.rate = Body::default();
        change(&mut motion);
        look(&motion).contact
    };
    assert!(contact(&|_| ()).is_some());
    assert_eq!(contact(&|own| own.solution.velocity.0.x = -0.1), None, "she goes away");
    assert_eq!(contact(&|own| own.solution.velocity.0.x = 0.012), None, "nobody can be sure");
    assert_eq!(contact(&|own| own.solution.velocity.0.y = 5.0), None, "she passes the end");
    let hard = contact(&|own| own.solution.position = place(-11.0, 100.0)).unwrap();
    assert!(hard.seconds.value < 0.05, "she touches");
}

#[test]
fn the_nearest_berth_is_proposed_and_the_one_that_is_chosen_stays() {
    let mut both = config();
    let line = [place(-80.0, 0.0), place(-80.0, 200.0)];
    let other = Quay { name: "Pier 4".to_owned(), line, water: WaterSide::Left, ..quay() };
    both.berths.push(other);
    both.chosen = None;
    let mut desk = BerthDesk::new(both.clone());
    assert_eq!(desk.berth(), None);
    desk.note(&place(-30.0, 100.0));
    assert_eq!(desk.berth(), Some((0, BerthChoice::Nearest)));
    // in the middle between both it stays at the first
    desk.note(&place(-42.0, 100.0));
    assert_eq!(desk.berth(), Some((0, BerthChoice::Nearest)));
    desk.note(&place(-50.0, 100.0));
    assert_eq!(desk.berth(), Some((1, BerthChoice::Nearest)));
    desk.note(&place(-9000.0, 100.0));
    assert_eq!(desk.berth(), None, "none is near");
    assert!(!desk.choose(Some("Pier 5")) && desk.choose(Some("Pier 3")));
    desk.note(&place(-70.0, 100.0));
    assert_eq!(desk.berth(), Some((0, BerthChoice::Chosen)));
    let mut next = BerthDesk::new(both);
    next.inherit(&desk);
    assert_eq!(next.chosen(), Some("Pier 3"));
    assert!(next.choose(None));
    assert_eq!(next.berth(), None);
}

#[test]
fn a_hard_or_near_approach_is_warned_of_at_the_berth_that_was_chosen_and_at_no_other() {
    let limits = DockingLimits { contact_speed: Some(0.15), distance: Some(20.0), level: None };
    let docking = look(&ship(90.0));
    assert!(limits.is_too_fast(&docking) && limits.is_too_near(&docking));
    let passed = Docking { choice: BerthChoice::Nearest, ..docking };
    assert!(!limits.is_too_fast(&passed) && !limits.is_too_near(&passed));
    let wider = DockingLimits { contact_speed: Some(0.17), distance: Some(18.0), ..limits };
    assert!(!wider.is_too_fast(&docking) && !wider.is_too_near(&docking));
    let mut still = ship(90.0);
    (still.solution.velocity, still.solution.rate) = (Ned::default(), Body::default());
    assert!(!limits.is_too_near(&look(&still)), "she lies there");
    let none = Docking::not_valid(Time::START, (0, BerthChoice::Chosen), NotDocking::Fault);
    assert!(!limits.is_too_fast(&none) && !limits.is_too_near(&none));
}

#[test]
fn the_height_above_the_quay_is_told_where_that_of_the_quay_is_known() {
    let mut high = config();
    high.berths[0].height = Some(3.5);
    let docking = look_with(high, &ship(90.0));
    close(docking.points[2].unwrap().above.unwrap().value, 5.0 + 3.0 - 3.5, 0.02);
    assert_eq!(look(&ship(90.0)).points[2].unwrap().above, None);
}
