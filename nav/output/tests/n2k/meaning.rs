//! What the numbers mean: signs, axes, units. All is read back by the readers of the groups.

use insd_base::units::{DEG, wrap_pi, wrap_two_pi};
use insd_base::{Attitude as Angles, Body, Geodetic, Ned, Solution, UtcTime};
use insd_n2k::pgn::{
    Attitude, CourseSpeed, Direction, Dops, FixMode, GnssPosition, GnssSystem, Heading, Heave,
    MagneticVariation, North, PositionRapid, PseudorangeNoise, RateOfTurn, SetDrift, Speed,
    SpeedComponents, SystemTime, TimeDate, TimeSource, VariationSource,
};
use insd_output::OutputEpoch;
use proptest::prelude::*;

use crate::ship::{epoch, heaving, near, said, with};

#[test]
fn bow_up_and_starboard_side_down_are_positive() {
    let attitude: Attitude = said(&with(|ship| {
        ship.attitude = Angles { roll: 0.1, pitch: 0.05, heading: 0.0 };
    }));
    near(attitude.roll, 0.1, 1e-4);
    near(attitude.pitch, 0.05, 1e-4);
    let attitude: Attitude = said(&with(|ship| {
        ship.attitude = Angles { roll: -0.1, pitch: -0.05, heading: 0.0 };
    }));
    near(attitude.roll, -0.1, 1e-4);
    near(attitude.pitch, -0.05, 1e-4);
}

#[test]
fn a_turn_of_the_bow_to_starboard_is_positive_also_on_a_heeling_ship() {
    for (heel, turn) in [(0.0, 0.02), (0.3, 0.02), (0.3, -0.02)] {
        let rate: RateOfTurn = said(&with(|ship| {
            ship.attitude = Angles { roll: heel, pitch: 0.0, heading: 1.0 };
            // the hull turns about the vertical
            ship.rate = Body::new(0.0, turn * f64::sin(heel), turn * f64::cos(heel));
        }));
        near(rate.rate, turn, 3.125e-8);
    }
}

#[test]
fn a_heading_runs_from_north_through_east_and_a_yaw_from_south_to_south() {
    let told = |degrees: f64| -> (Heading, Attitude) {
        let epoch = with(|ship| ship.attitude.heading = degrees * DEG);
        (said(&epoch), said(&epoch))
    };
    for (degrees, yaw) in [(0.0, 0.0), (90.0, 90.0), (180.0, 180.0), (270.0, -90.0), (359.0, -1.0)]
    {
        let (heading, attitude) = told(degrees);
        near(heading.heading, degrees * DEG, 1e-4);
        // due south may be a step away: some displays drop the step nearest to half a turn
        near(attitude.yaw, yaw * DEG, if degrees == 180.0 { 2e-4 } else { 1e-4 });
        assert_eq!((heading.reference, heading.deviation), (Some(North::True), None));
        near(heading.variation, -7.6 * DEG, 1e-4);
    }
    // nearer to north than to the last step below a full turn
    let (heading, attitude) = told(359.999);
    assert_eq!((heading.heading, attitude.yaw), (Some(0.0), Some(0.0)));
    near(told(359.995).0.heading, 359.995 * DEG, 1e-4);
}

#[test]
fn a_ship_that_goes_astern_says_so() {
    let astern = with(|ship| {
        ship.attitude.heading = 90.0 * DEG;
        ship.velocity = Ned::new(0.0, -3.0, 0.0);
    });
    let astern = OutputEpoch { current: None, ..astern };
    let components: SpeedComponents = said(&astern);
    near(components.forward_ground, -3.0, 1e-3);
    near(components.starboard_ground, 0.0, 1e-3);
    assert_eq!((components.forward_water, components.starboard_water), (None, None));
    let speed: Speed = said(&astern);
    near(speed.ground, 3.0, 0.01);
    assert_eq!((speed.direction, speed.water), (Some(Direction::Reverse), None));
    let course: CourseSpeed = said(&astern);
    near(course.course, 270.0 * DEG, 1e-4);
    near(course.speed, 3.0, 0.01);
}

#[test]
fn leeway_to_port_is_negative() {
    let components: SpeedComponents = said(&with(|ship| {
        ship.attitude = Angles { roll: 0.3, pitch: 0.1, heading: 0.0 };
        ship.velocity = Ned::new(5.0, -0.5, 1.0);
    }));
    near(components.forward_ground, 5.0, 1e-3);
    near(components.starboard_ground, -0.5, 1e-3);
    assert_eq!(components.stern_starboard_ground, None);
}

#[test]
fn a_ship_carried_east_by_the_current_goes_west_through_the_water() {
    let resting = with(|ship| {
        ship.attitude.heading = 0.0;
        ship.velocity = Ned::new(0.0, 0.0, 0.0);
    });
    let resting = OutputEpoch { current: Some(Ned::new(0.0, 1.0, 0.0)), ..resting };
    let components: SpeedComponents = said(&resting);
    near(components.starboard_water, -1.0, 1e-3);
    near(components.starboard_ground, 0.0, 1e-3);
    let current: SetDrift = said(&resting);
    near(current.set, 90.0 * DEG, 1e-4);
    near(current.drift, 1.0, 0.01);
    assert_eq!(current.reference, Some(North::True));
}

#[test]
fn a_direction_is_told_only_if_ground_and_water_agree_on_it() {
    let told = |north: f64, current: f64| {
        let epoch = with(|ship| {
            ship.attitude.heading = 0.0;
            ship.velocity = Ned::new(north, 0.0, 0.0);
        });
        said::<Speed>(&OutputEpoch { current: Some(Ned::new(current, 0.0, 0.0)), ..epoch })
            .direction
    };
    assert_eq!(told(3.0, -1.0), Some(Direction::Forward));
    assert_eq!(told(-3.0, -1.0), Some(Direction::Reverse));
    assert_eq!(told(-1.0, -3.0), None, "astern over ground, ahead through the water");
    assert_eq!(told(0.0, -1.0), Some(Direction::Forward), "stemming the tide");
    assert_eq!(told(0.05, 0.0), None, "at rest");
}

#[test]
fn a_weak_current_has_no_set() {
    let weak = OutputEpoch { current: Some(Ned::new(0.03, 0.03, 0.0)), ..epoch() };
    let current: SetDrift = said(&weak);
    near(current.drift, 0.04, 0.01);
    assert_eq!((current.set, current.reference), (None, None));
}

#[test]
fn heave_is_positive_upwards_and_variation_to_the_east() {
    near(said::<Heave>(&epoch()).heave, -0.42, 0.01);
    let variation: MagneticVariation = said(&epoch());
    near(variation.variation, -7.6 * DEG, 1e-4);
    assert_eq!(
        (variation.source, variation.date),
        (Some(VariationSource::Wmm(2025)), Some(20_455))
    );
}

#[test]
fn the_altitude_is_above_the_ellipsoid_and_the_geoid_stands_beside_it() {
    let position: GnssPosition = said(&epoch());
    near(position.altitude, 40.0, 1e-6);
    near(position.geoid, 36.7, 0.01);
    assert_eq!(position.system, Some(GnssSystem::Integrated));
    assert_eq!(
        (position.satellites, position.hdop, position.pdop),
        (Some(14), Some(0.8), Some(1.44))
    );
    let dops: Dops = said(&epoch());
    assert_eq!((dops.hdop, dops.vdop, dops.tdop), (Some(0.8), Some(1.2), Some(0.7)));
    assert_eq!((dops.desired, dops.actual), (None, Some(FixMode::ThreeD)));
}

#[test]
fn no_day_has_a_second_86400() {
    let utc = UtcTime::from_civil((2026, 1, 1), (23, 59, 59), 999_960_000);
    let midnight = OutputEpoch { utc, ..epoch() };
    let (date, time) = (Some(20_455), Some(0.0));
    let system: SystemTime = said(&midnight);
    assert_eq!((system.date, system.time, system.source), (date, time, Some(TimeSource::Gps)));
    let clock: TimeDate = said(&midnight);
    assert_eq!((clock.date, clock.time, clock.local_offset), (date, time, None));
    let position: GnssPosition = said(&midnight);
    assert_eq!((position.date, position.time), (date, time));
}

#[test]
fn the_ellipse_of_the_error_is_turned_as_the_covariance_says() {
    let told = |major: f64, minor: f64, turned: f64| -> PseudorangeNoise {
        let (sin, cos) = turned.sin_cos();
        let (long, short) = (major * major, minor * minor);
        let north = (long * cos * cos + short * sin * sin).sqrt();
        let east = (long * sin * sin + short * cos * cos).sqrt();
        let epoch = with(|ship| ship.sigma.position = Ned::new(north, east, 3.0));
        said(&OutputEpoch { covariance_north_east: Some((long - short) * sin * cos), ..epoch })
    };
    for degrees in [0.0, 30.0, 89.0, 135.0] {
        let noise = told(4.0, 1.0, degrees * DEG);
        near(noise.major, 4.0, 0.01);
        near(noise.minor, 1.0, 0.01);
        near(noise.orientation, degrees * DEG, 1e-4);
        near(noise.altitude_std, 3.0, 0.01);
    }
}

#[test]
fn without_a_covariance_the_ellipse_is_not_guessed() {
    let noise: PseudorangeNoise = said(&OutputEpoch { covariance_north_east: None, ..epoch() });
    assert_eq!((noise.major, noise.minor, noise.orientation), (None, None, None));
    assert_eq!((noise.latitude_std, noise.longitude_std), (Some(0.8), Some(0.6)));
    assert_eq!(noise.range_rms, None);
}

fn sailing() -> impl Strategy<Value = Solution> {
    let place = (-90.0..90.0_f64, -180.0..180.0_f64, -100.0..100.0_f64);
    let motion = (-15.0..15.0_f64, -15.0..15.0_f64, -0.2..0.2_f64, -0.2..0.2_f64);
    let angles = (-0.8..0.8_f64, -0.5..0.5_f64, 0.0..std::f64::consts::TAU);
    (place, motion, angles).prop_map(|(place, motion, angles)| {
        let mut ship = crate::ship::solution();
        ship.position = Geodetic::from_degrees(place.0, place.1, place.2);
        ship.velocity = Ned::new(motion.0, motion.1, 0.3);
        ship.rate = Body::new(0.1, motion.2, motion.3);
        ship.attitude = Angles { roll: angles.0, pitch: angles.1, heading: angles.2 };
        ship
    })
}

proptest! {
    #[test]
    fn every_group_says_what_the_solution_says(ship in sailing(), heave in -15.0..15.0_f64) {
        let told = OutputEpoch { solution: Some(ship), heave: Some(heaving(heave)), ..epoch() };
        let heading: Heading = said(&told);
        let off = wrap_pi(heading.heading.unwrap() - ship.attitude.heading);
        prop_assert!(off.abs() < 0.6e-4);
        let attitude: Attitude = said(&told);
        prop_assert!(wrap_pi(attitude.yaw.unwrap() - ship.attitude.heading).abs() < 0.6e-4);
        near(attitude.roll, ship.attitude.roll, 1e-4);
        near(attitude.pitch, ship.attitude.pitch, 1e-4);
        near(said::<RateOfTurn>(&told).rate, ship.rate_of_turn(), 3.125e-8);
        near(said::<Heave>(&told).heave, heave, 0.01);
        let rapid: PositionRapid = said(&told);
        near(rapid.latitude, ship.position.latitude, 1e-7 * DEG);
        near(rapid.longitude, ship.position.longitude, 1e-7 * DEG);
        let position: GnssPosition = said(&told);
        near(position.latitude, ship.position.latitude, 1e-14);
        near(position.longitude, ship.position.longitude, 1e-14);
        near(position.altitude, ship.position.height, 1e-6);
        let course: CourseSpeed = said(&told);
        near(course.speed, ship.speed(), 0.01);
        if let Some(course) = course.course {
            prop_assert!(wrap_pi(course - ship.course()).abs() < 0.6e-4);
        } else {
            prop_assert!(ship.speed() < 0.5, "she has no course though she moves");
        }
        // back from the ship's axes to north and east
        let parts: SpeedComponents = said(&told);
        let (forward, starboard) = (parts.forward_ground.unwrap(), parts.starboard_ground.unwrap());
        let (sin, cos) = ship.attitude.heading.sin_cos();
        prop_assert!((forward * cos - starboard * sin - ship.velocity.0.x).abs() < 1e-3);
        prop_assert!((forward * sin + starboard * cos - ship.velocity.0.y).abs() < 1e-3);
        let speed: Speed = said(&told);
        prop_assert!((speed.ground.unwrap() - forward.abs()).abs() < 0.006);
        let through = (parts.forward_water.unwrap(), parts.starboard_water.unwrap());
        let current = ((forward - through.0) * cos - (starboard - through.1) * sin, 0.3);
        prop_assert!((current.0 - current.1).abs() < 3e-3);
        prop_assert!(wrap_two_pi(said::<SetDrift>(&told).set.unwrap()) > std::f64::consts::PI);
    }
}
