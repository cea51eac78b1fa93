//! What is not available, and when.

use insd_base::units::DEG;
use insd_base::{self as base, Attitude as Angles, Body, Geodetic, Mode, Ned, Solution, Time};
use insd_n2k::pgn::{
    Attitude, CourseSpeed, Dops, FixMethod, GnssPosition, GnssSystem, Group, Heading, Heave,
    Integrity, MagneticVariation, PositionRapid, PseudorangeNoise, RateOfTurn, SetDrift, Speed,
    SpeedComponents, SystemTime, TimeDate,
};
use insd_output::n2k::PgnSchedule;
use insd_output::{Manner, OutputEpoch};
use proptest::prelude::*;

use crate::ship::{all, epoch, heaving, said, said_by, solution, with};

const MODES: [Mode; 7] = [
    Mode::CoarseAlignment,
    Mode::FineAlignment,
    Mode::InMotionAlignment,
    Mode::Aided,
    Mode::DeadReckoning,
    Mode::Inertial,
    Mode::Fault,
];

/// Fails unless an epoch says nothing but its number in every group that has no mark for its quality.
#[track_caller]
fn says_nothing(config: &Manner, epoch: &OutputEpoch) {
    let sid = Some(0);
    let heading = said_by::<Heading>(config, epoch);
    let (deviation, reference) = (None, None);
    assert_eq!(heading, Heading { sid, heading: None, deviation, variation: None, reference });
    assert_eq!(said_by::<RateOfTurn>(config, epoch), RateOfTurn { sid, rate: None });
    assert_eq!(said_by::<Heave>(config, epoch), Heave { sid, heave: None });
    let attitude = Attitude { sid, yaw: None, pitch: None, roll: None };
    assert_eq!(said_by::<Attitude>(config, epoch), attitude);
    let variation = MagneticVariation { sid, source: None, date: None, variation: None };
    assert_eq!(said_by::<MagneticVariation>(config, epoch), variation);
    let speed = Speed { sid, water: None, ground: None, kind: None, direction: None };
    assert_eq!(said_by::<Speed>(config, epoch), speed);
    assert_eq!(said_by::<SpeedComponents>(config, epoch), SpeedComponents::default());
    let position = PositionRapid { latitude: None, longitude: None };
    assert_eq!(said_by::<PositionRapid>(config, epoch), position);
    let course = CourseSpeed { sid, reference: None, course: None, speed: None };
    assert_eq!(said_by::<CourseSpeed>(config, epoch), course);
    let current = SetDrift { sid, reference: None, set: None, drift: None };
    assert_eq!(said_by::<SetDrift>(config, epoch), current);
    let dops = Dops { sid, desired: None, actual: None, hdop: None, vdop: None, tdop: None };
    assert_eq!(said_by::<Dops>(config, epoch), dops);
    let noise = said_by::<PseudorangeNoise>(config, epoch);
    let (major, minor, orientation) = (noise.major, noise.minor, noise.orientation);
    assert_eq!(
        (noise.sid, noise.range_rms, major, minor, orientation),
        (sid, None, None, None, None)
    );
    let sigmas = [noise.latitude_std, noise.longitude_std, noise.altitude_std];
    assert_eq!(sigmas, [None; 3]);
}

#[test]
fn an_unknown_epoch_says_nothing() {
    let unknown = OutputEpoch::unknown(Time::START);
    says_nothing(&Manner::default(), &unknown);
    let system = SystemTime { sid: Some(0), source: None, date: None, time: None };
    assert_eq!(said::<SystemTime>(&unknown), system);
    assert_eq!(said::<TimeDate>(&unknown), TimeDate { date: None, time: None, local_offset: None });
    let fix = said::<GnssPosition>(&unknown);
    let none = GnssPosition {
        sid: Some(0),
        date: None,
        time: None,
        latitude: None,
        longitude: None,
        altitude: None,
        system: Some(GnssSystem::Integrated),
        method: Some(FixMethod::NoFix),
        integrity: Some(Integrity::Unsafe),
        satellites: None,
        hdop: None,
        pdop: None,
        geoid: None,
        stations: Vec::new(),
    };
    assert_eq!(fix, none);
}

#[test]
fn what_was_known_is_not_said_again_when_it_no_longer_is() {
    let mut voice = PgnSchedule::new(Manner::default());
    voice.messages(&epoch(), &all());
    let later = Time::from_seconds(0.1);
    let mut other = PgnSchedule::new(Manner::default());
    other.messages(&OutputEpoch::unknown(Time::START), &all());
    let unknown = OutputEpoch::unknown(later);
    assert_eq!(voice.messages(&unknown, &all()), other.messages(&unknown, &all()));
}

#[test]
fn each_mode_says_what_it_may() {
    for mode in MODES {
        let epoch = with(|ship| ship.mode = mode);
        let navigating = mode.is_navigating();
        let sound = mode != Mode::Fault;
        assert_eq!(said::<Heading>(&epoch).heading.is_some(), navigating, "{mode:?}");
        assert_eq!(said::<Attitude>(&epoch).yaw.is_some(), navigating, "{mode:?}");
        assert_eq!(said::<Attitude>(&epoch).roll.is_some(), sound, "{mode:?}");
        assert_eq!(said::<Attitude>(&epoch).pitch.is_some(), sound, "{mode:?}");
        assert_eq!(said::<RateOfTurn>(&epoch).rate.is_some(), navigating, "{mode:?}");
        assert_eq!(
            said::<SpeedComponents>(&epoch).forward_ground.is_some(),
            navigating,
            "{mode:?}"
        );
        assert_eq!(said::<Speed>(&epoch).ground.is_some(), navigating, "{mode:?}");
        assert_eq!(said::<CourseSpeed>(&epoch).speed.is_some(), sound, "{mode:?}");
        assert_eq!(said::<PositionRapid>(&epoch).latitude.is_some(), sound, "{mode:?}");
        assert_eq!(said::<PseudorangeNoise>(&epoch).major.is_some(), sound, "{mode:?}");
        let uses_gnss = matches!(mode, Mode::Aided | Mode::InMotionAlignment);
        let fix = said::<GnssPosition>(&epoch);
        let (method, integrity) = match (sound, uses_gnss) {
            (false, _) => (FixMethod::NoFix, Integrity::Unsafe),
            (true, false) => (FixMethod::DeadReckoning, Integrity::Caution),
            (true, true) => (FixMethod::Differential, Integrity::Safe),
        };
        assert_eq!((fix.method, fix.integrity), (Some(method), Some(integrity)), "{mode:?}");
        assert_eq!(fix.satellites.is_some(), uses_gnss, "{mode:?}");
        assert_eq!(said::<Dops>(&epoch).hdop.is_some(), uses_gnss, "{mode:?}");
        assert_eq!(fix.geoid.is_some(), sound, "{mode:?}");
    }
}

#[test]
fn a_value_that_is_too_uncertain_is_not_said() {
    let unsure = with(|ship| ship.sigma.heading = 3.0 * DEG);
    assert_eq!(said::<Heading>(&unsure).heading, None);
    assert_eq!(said::<Heading>(&unsure).reference, None);
    assert_eq!(said::<SpeedComponents>(&unsure).forward_ground, None);
    assert!(said::<CourseSpeed>(&unsure).course.is_some(), "needs no heading");
    let unsure = with(|ship| ship.sigma.pitch = 0.6 * DEG);
    assert_eq!(said::<Attitude>(&unsure).roll, None);
    assert!(said::<Attitude>(&unsure).yaw.is_some());
    let unsure = with(|ship| ship.sigma.velocity = Ned::new(2.0, 0.0, 0.0));
    assert_eq!(said::<CourseSpeed>(&unsure).speed, None);
    let unsure = with(|ship| ship.sigma.position = Ned::new(90.0, 90.0, 1.0));
    assert_eq!(said::<PositionRapid>(&unsure).longitude, None);
    assert_eq!(said::<GnssPosition>(&unsure).altitude, None);
    assert_eq!(said::<GnssPosition>(&unsure).method, Some(FixMethod::NoFix));
    assert_eq!(said::<PseudorangeNoise>(&unsure).latitude_std, None);
}

#[test]
fn a_ship_at_rest_has_a_speed_but_no_course() {
    let resting = with(|ship| ship.velocity = Ned::new(0.03, 0.0, 0.0));
    let course = said::<CourseSpeed>(&resting);
    assert_eq!((course.speed, course.course, course.reference), (Some(0.03), None, None));
}

#[test]
fn the_method_follows_the_sigma() {
    for (sigma, method, integrity) in [
        (0.05, FixMethod::RtkFixed, Integrity::Safe),
        (0.2, FixMethod::RtkFloat, Integrity::Safe),
        (0.8, FixMethod::Differential, Integrity::Safe),
        (5.0, FixMethod::Gnss, Integrity::Safe),
        (50.0, FixMethod::DeadReckoning, Integrity::Caution),
        (150.0, FixMethod::NoFix, Integrity::Unsafe),
    ] {
        let fix =
            said::<GnssPosition>(&with(|ship| ship.sigma.position = Ned::new(sigma, 0.0, 0.0)));
        assert_eq!((fix.method, fix.integrity), (Some(method), Some(integrity)), "{sigma}");
    }
}

#[test]
fn a_position_is_safe_only_where_somebody_compares_the_sensors_and_they_agree() {
    let told = |watch: base::Integrity, sigma: f64| {
        let fix: GnssPosition = said(&with(|ship| {
            ship.judgement.integrity = watch;
            ship.sigma.position = Ned::new(sigma, 0.0, 0.0);
        }));
        (fix.method, fix.integrity)
    };
    let estimated = (Some(FixMethod::DeadReckoning), Some(Integrity::Caution));
    for (watch, good) in [
        (base::Integrity::Consistent, (Some(FixMethod::Differential), Some(Integrity::Safe))),
        (base::Integrity::Unwatched, (Some(FixMethod::Differential), Some(Integrity::NoChecking))),
        (base::Integrity::Unproven, estimated),
        (base::Integrity::Contradiction, estimated),
    ] {
        assert_eq!(told(watch, 0.8), good, "{watch:?}");
        assert_eq!(told(watch, 50.0), estimated, "{watch:?}");
        let none = (Some(FixMethod::NoFix), Some(Integrity::Unsafe));
        assert_eq!(told(watch, 150.0), none, "{watch:?}");
    }
}

#[test]
fn a_simulated_ship_is_marked_where_there_is_a_mark_and_else_not_told() {
    let config = Manner { simulated: true, ..Manner::default() };
    says_nothing(&config, &epoch());
    let fix = said_by::<GnssPosition>(&config, &epoch());
    assert_eq!(fix.method, Some(FixMethod::Simulated));
    assert!(fix.latitude.is_some() && fix.satellites.is_some());
    assert!(said_by::<SystemTime>(&config, &epoch()).time.is_some());
    let demo = Manner { unmarked_when_simulated: true, ..config };
    assert!(said_by::<Heading>(&demo, &epoch()).heading.is_some());
    assert_eq!(said_by::<GnssPosition>(&demo, &epoch()).method, Some(FixMethod::Simulated));
    let lost = OutputEpoch { solution: None, ..epoch() };
    assert_eq!(said_by::<GnssPosition>(&demo, &lost).method, Some(FixMethod::NoFix));
}

fn angle_is_sound(angle: Option<f64>, least: f64, most: f64) -> bool {
    angle.is_none_or(|angle| (least..=most).contains(&angle))
}

proptest! {
    #[test]
    fn whatever_the_solution_every_group_is_readable_and_in_range(
        values in prop::array::uniform16(any::<f64>()), mode in 0..7_usize, good: bool,
    ) {
        let [lat, lon, height, vn, ve, vd, roll, pitch, heading, wx, wy, wz, sn, se, sv, sh] = values;
        let sigma = solution().sigma;
        let ship = Solution {
            position: Geodetic { latitude: lat, longitude: lon, height },
            velocity: Ned::new(vn, ve, vd),
            attitude: Angles { roll, pitch, heading },
            rate: Body::new(wx, wy, wz),
            mode: MODES[mode],
            ..solution()
        };
        let mut told = OutputEpoch { solution: Some(ship), heave: Some(heaving(sn)), geoid: Some(se), ..epoch() };
        told.covariance_north_east = Some(sv);
        told.current = Some(Ned::new(se, sh, sn));
        if let Some(ship) = told.solution.as_mut().filter(|_| !good) {
            ship.sigma.position = Ned::new(sn, se, sigma.position.0.z);
            ship.sigma.velocity = Ned::new(sv, sv, sv);
            ship.sigma.heading = sh;
        }
        // half a turn is not a whole number of steps of 1e-4 rad
        let (half, full) = (std::f64::consts::PI + 1e-5, std::f64::consts::TAU);
        let fix: GnssPosition = said(&told);
        prop_assert!(angle_is_sound(fix.latitude, -half / 2.0, half / 2.0));
        prop_assert!(angle_is_sound(fix.longitude, -half, half));
        prop_assert!(angle_is_sound(said::<Heading>(&told).heading, 0.0, full));
        let attitude: Attitude = said(&told);
        for part in [attitude.yaw, attitude.pitch, attitude.roll] {
            prop_assert!(angle_is_sound(part, -half, half));
        }
        prop_assert!(angle_is_sound(said::<CourseSpeed>(&told).course, 0.0, full));
        prop_assert!(angle_is_sound(said::<PseudorangeNoise>(&told).orientation, 0.0, full));
        for (pgn, contents) in PgnSchedule::new(Manner::default()).messages(&told, &all()) {
            prop_assert!(contents.len() >= 8, "{} has {} bytes", pgn, contents.len());
            prop_assert!(pgn != Heave::PGN || contents.len() == 8);
        }
    }
}
