//! Claims about alignment under way.

mod ship;

use insd_base::units::{DEG, wrap_pi};
use insd_base::{
    Attitude, ExternalReference, Geodetic, ImuSpec, Integrity, LeverArms, LogReference,
};
use insd_estimation::Innovation;
use insd_nav::error_state::{ATTITUDE, POSITION, VELOCITY};
use nalgebra::Cholesky;

use super::aids::{SpeedReading, Split};
use super::belief::{OWN, OwnErrors, STATES};
use super::*;
pub(super) use ship::good_imu;
use ship::{Run, Ship, mems_imu};

const ALL_HEADINGS: [f64; 8] = [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0];
const LATITUDES: [f64; 4] = [0.0, 35.0, -35.0, 70.0];

/// Error over claimed sigma, and the sigma in degrees.
fn judged(filter: &EightState, truth: &Attitude) -> (f64, f64) {
    let (heading, sigma) = filter.heading();
    (wrap_pi(heading - truth.heading) / sigma, sigma / DEG)
}

#[test]
fn the_equations_carry_the_truth_for_any_misheading_and_tilt() {
    for heading in ALL_HEADINGS {
        let ship = Ship { heading: heading * DEG, turn: 0.02, thrust: 0.1, ..Ship::at(-35.0) };
        let tilt = Vector2::new(0.02, -0.03);
        let tilting = UnitQuaternion::new(Vector3::new(tilt.x, tilt.y, 0.0));
        // C_pb = R(-dpsi) (I - [phi x]) C_nb with dpsi the true heading
        let c_nb = UnitQuaternion::from_matrix(&ship.attitude(0.0).c_nb());
        let dpsi = ship.heading;
        let back = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -dpsi);
        let mut motion = HorizontalMotion {
            place: ship.place,
            velocity: ship.velocity(0.0).xy(),
            tilt,
            sine: dpsi.sin(),
            versine: 1.0 - dpsi.cos(),
            attitude: back * tilting.inverse() * c_nb,
        };
        let mut place = ship.place;
        for i in 0..6000 {
            let local = Local::new(&motion);
            let increment = ship.increment(i, &mut place);
            motion.advance(&local, &increment, 0.0);
        }
        let off = motion.velocity - ship.velocity(60.0).xy();
        assert!(off.norm() < 0.02, "heading {heading}: velocity off by {off}");
        let lean = UnitQuaternion::new(Vector3::new(motion.tilt.x, motion.tilt.y, 0.0));
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), dpsi);
        let found = lean * turn * motion.attitude;
        let truth = UnitQuaternion::from_matrix(&ship.attitude(60.0).c_nb());
        // what is left is the square of the tilt
        assert!(found.angle_to(&truth) < 3e-4, "{heading}: {}", found.angle_to(&truth));
    }
}

#[test]
fn the_transition_agrees_with_perturbed_strapdowns() {
    let ship = Ship { heading: 2.0, turn: 0.03, thrust: 0.2, ..Ship::at(52.0) };
    let start = HorizontalMotion {
        place: ship.place,
        velocity: ship.velocity(0.0).xy(),
        tilt: Vector2::new(0.01, -0.02),
        sine: 0.4,
        versine: 0.7,
        attitude: UnitQuaternion::from_matrix(&ship.attitude(0.0).c_nb()),
    };
    let local = Local::new(&start);
    let config = NavConfig::new(good_imu(), LeverArms::default());
    let run = |errors: &OwnErrors| {
        let mut motion = start;
        motion.inject(&local, errors);
        let mut stretch = HorizontalStretch::default();
        let mut place = ship.place;
        for i in 0..50 {
            let increment = ship.increment(i, &mut place);
            let step = motion.advance(&local, &increment, 0.0);
            stretch.add(&step, &increment);
        }
        (motion, stretch)
    };
    let (_, stretch) = run(&OwnErrors::zeros());
    let f = stretch.transition(&start, &local, &Belief::new(&config), &config).f;
    for state in 0..STATES {
        let step = if state < 4 { 1.0 } else { 1e-3 };
        let moved = |amount: f64| {
            let mut errors = OwnErrors::zeros();
            errors[state] = amount;
            run(&errors).0
        };
        let (ahead, behind) = (moved(step), moved(-step));
        let north = (ahead.place.latitude - behind.place.latitude) * local.radii.0;
        let east = (ahead.place.longitude - behind.place.longitude)
            * (local.radii.1 * start.place.latitude.cos());
        let v = ahead.velocity - behind.velocity;
        // the frame is commanded by the estimate, but the true axes turn with the true velocity
        let turning = |motion: &HorizontalMotion| Local::new(motion).turn.xy() * stretch.duration;
        let tilt = ahead.tilt - behind.tilt - (turning(&ahead) - turning(&behind));
        let turn = (ahead.sine - behind.sine, ahead.versine - behind.versine);
        let slope =
            OwnErrors::from_column_slice(&[north, east, v.x, v.y, tilt.x, tilt.y, turn.0, turn.1])
                / (2.0 * step);
        let scales =
            OwnErrors::from_column_slice(&[2e-4, 2e-4, 4e-4, 4e-4, 1e-8, 1e-8, 1e-9, 1e-9]);
        for row in 0..STATES {
            let (found, model) = (slope[row], f[(row, state)]);
            let tolerance = scales[row] + 2e-3 * model.abs();
            assert!((found - model).abs() < tolerance, "({row}, {state}): {found} {model}");
        }
    }
}

#[test]
fn a_turn_shows_the_heading_wherever_it_points() {
    for (i, latitude) in LATITUDES.into_iter().enumerate() {
        for (j, heading) in ALL_HEADINGS.into_iter().enumerate() {
            let ship = Ship { heading: heading * DEG, turn: 1.5 * DEG, ..Ship::at(latitude) };
            let mut run = Run::new(&ship, &good_imu(), (i * 8 + j) as u64);
            run.sail(60.0);
            let (off, sigma) = judged(&run.filter, &run.truth());
            assert!(sigma < 5.0, "{latitude} {heading}: sigma {sigma}");
            assert!(off.abs() < 4.0, "{latitude} {heading}: {off} sigmas of {sigma} deg");
            assert!((off * sigma).abs() < 5.0);
            assert!(run.filter.finished());
        }
    }
}

#[test]
fn a_change_of_speed_shows_the_heading_wherever_it_points() {
    for (j, heading) in ALL_HEADINGS.into_iter().enumerate() {
        for imu in [good_imu(), mems_imu()] {
            let ship = Ship { heading: heading * DEG, thrust: 0.08, ..Ship::at(35.0) };
            let mut run = Run::new(&ship, &imu, 100 + j as u64);
            run.sail(60.0);
            let (off, sigma) = judged(&run.filter, &run.truth());
            assert!(sigma < 5.0, "{heading}: sigma {sigma}");
            assert!(off.abs() < 4.0, "{heading}: {off} sigmas of {sigma} deg");
        }
    }
}

#[test]
fn heading_errors_are_as_large_as_claimed() {
    for (imu, end) in [(good_imu(), 25.0), (mems_imu(), 40.0)] {
        let mut squares = Vec::new();
        for seed in 0..60_u64 {
            let heading = 6.0 * DEG * seed as f64;
            let ship = Ship { heading, turn: 1.0 * DEG, ..Ship::at(35.0) };
            let mut run = Run::new(&ship, &imu, 1000 + seed);
            run.sail(end);
            squares.push(judged(&run.filter, &run.truth()).0.powi(2));
        }
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        assert!((0.4..1.6).contains(&mean), "mean square {mean}");
        assert!(squares.iter().all(|square| *square < 16.0));
    }
}

#[test]
fn a_straight_and_steady_course_tells_no_heading() {
    for seed in 0..8_u64 {
        let heading = 45.0 * DEG * seed as f64;
        let ship = Ship { heading, roll: 0.0, ..Ship::at(35.0) };
        let mut run = Run::new(&ship, &mems_imu(), 7 + seed);
        for _ in 0..4 {
            run.sail(60.0);
            let (off, sigma) = judged(&run.filter, &run.truth());
            assert!(sigma > 40.0 && off.abs() < 4.0, "{seed}: {off} sigmas of {sigma}");
        }
        assert!(!run.filter.finished() && run.filter.initial_state().is_none());
    }
}

#[test]
fn roll_and_pitch_are_as_sure_as_claimed_where_nothing_tells_the_heading() {
    let mut squares = Vec::new();
    for seed in 0..6_u64 {
        let heading = 60.0 * DEG * seed as f64;
        let ship = Ship { heading, speed: 0.0, roll: 0.0, ..Ship::at(35.0) };
        let mut run = Run::new(&ship, &mems_imu(), 60 + seed);
        for minute in 1..=20 {
            run.sail(60.0);
            let (said, truth) = (run.filter.solution(), run.truth());
            let roll = (said.attitude.roll - truth.roll) / said.sigma.roll;
            let pitch = (said.attitude.pitch - truth.pitch) / said.sigma.pitch;
            let worst = roll.abs().max(pitch.abs());
            assert!(worst < 3.5, "{seed} at {minute} min: {worst} claimed sigmas");
            // the accelerometers' bias and little beside it
            assert!(said.sigma.pitch < 1.6 * 2e-3, "{seed} at {minute} min: {}", said.sigma.pitch);
            squares.push(0.5 * (roll * roll + pitch * pitch));
        }
    }
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!((0.4..1.7).contains(&mean), "mean square {mean}");
}

#[test]
fn gyros_that_are_noisy_tell_no_heading_of_a_ship_that_lies_still() {
    let mut squares = Vec::new();
    for seed in 0..10_u64 {
        let heading = 36.0 * DEG * seed as f64;
        let ship = Ship { heading, speed: 0.0, roll: 0.0, ..Ship::at(35.0) };
        let mut run = Run::new(&ship, &mems_imu(), 80 + seed);
        for minute in [5, 10, 15] {
            run.sail(300.0);
            let (off, sigma) = judged(&run.filter, &run.truth());
            assert!(off.abs() < 3.0, "{seed} at {minute} min: {off} sigmas of {sigma}");
            squares.push(off * off);
        }
    }
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!(mean < 1.6, "mean square {mean}");
}

#[test]
fn good_gyros_show_the_heading_on_a_straight_course_as_well_as_they_claim() {
    let mut squares = 0.0;
    for seed in 0..40_u64 {
        let ship = Ship { heading: 9.0 * DEG * seed as f64, roll: 0.0, ..Ship::at(35.0) };
        let mut run = Run::new(&ship, &good_imu(), 500 + seed);
        run.sail(60.0);
        let (off, sigma) = judged(&run.filter, &run.truth());
        assert!((1.0..8.0).contains(&sigma), "{sigma}");
        squares += off * off / 40.0;
    }
    assert!((0.4..1.7).contains(&squares), "mean square {squares}");
}

#[test]
fn the_swing_of_a_masthead_antenna_shows_the_heading() {
    let ship = Ship { heading: 2.0, ..Ship::at(35.0) };
    let mut run = Run::new(&ship, &good_imu(), 8);
    run.sail(60.0);
    let (off, sigma) = judged(&run.filter, &run.truth());
    assert!(sigma < 3.0 && off.abs() < 4.0, "{off} sigmas of {sigma}");
}

#[test]
fn gyrocompassing_turns_the_right_way_north_and_south_of_the_equator() {
    for latitude in [35.0, -35.0] {
        for (i, heading) in [20.0, 120.0, 200.0, 290.0].into_iter().enumerate() {
            for speed in [0.0, 6.0] {
                let heading = heading * DEG;
                let ship = Ship { heading, speed, roll: 0.0, ..Ship::at(latitude) };
                let mut run =
                    Run::new(&ship, &good_imu(), 30 + i as u64).with_log().without_course();
                run.gnss = None;
                run.sail(200.0);
                let (off, sigma) = judged(&run.filter, &run.truth());
                assert!(sigma < 1.5, "{latitude} {heading} {speed}: sigma {sigma}");
                assert!(off.abs() < 4.0, "{latitude} {heading} {speed}: {off} sigmas of {sigma}");
            }
        }
    }
}

#[test]
fn a_log_alone_tells_no_heading_unless_the_gyros_feel_the_earth_turn() {
    for seed in 0..4_u64 {
        let heading = 90.0 * DEG * seed as f64;
        let ship = Ship { heading, turn: 1.0 * DEG, ..Ship::at(35.0) };
        let mut run = Run::new(&ship, &mems_imu(), 40 + seed).with_log().without_course();
        run.gnss = None;
        run.sail(300.0);
        let (off, sigma) = judged(&run.filter, &run.truth());
        assert!(sigma > 20.0, "{seed}: {off} sigmas of {sigma}");
    }
}

#[test]
fn gnss_and_a_bottom_log_show_the_heading_at_once_and_without_a_manoeuvre() {
    for heading in ALL_HEADINGS {
        let ship = Ship { heading: heading * DEG, roll: 0.0, ..Ship::at(35.0) };
        let mut run = Run::new(&ship, &mems_imu(), 9).with_log();
        run.sail(5.0);
        let (off, sigma) = judged(&run.filter, &run.truth());
        assert!(sigma < 2.0 && off.abs() < 4.0, "{heading}: {off} sigmas of {sigma}");
    }
}

#[test]
fn a_log_in_other_units_is_found_out_and_finds_no_heading() {
    for (gain, found) in [(3.6, true), (1.944, true), (1.1, false)] {
        let mut run = Run::new(&Ship::at(35.0), &mems_imu(), 9).with_log();
        run.log_gain = gain;
        run.sail(20.0);
        let told = run.filter.gain_of_log().filter(|told| (told - gain).abs() < 0.1 * gain);
        assert_eq!((told.is_some(), run.filter.finished()), (found, !found), "{gain}: {told:?}");
    }
}

#[test]
fn a_log_through_the_water_is_believed_no_better_than_the_current() {
    for (i, heading) in ALL_HEADINGS.into_iter().enumerate() {
        let ship = Ship { heading: heading * DEG, roll: 0.0, ..Ship::at(35.0) };
        let mut run = Run::new(&ship, &mems_imu(), i as u64).with_water_log(0.7, -0.3);
        run.sail(120.0);
        let (off, sigma) = judged(&run.filter, &run.truth());
        assert!((2.5..8.0).contains(&sigma), "{heading}: sigma {sigma}");
        assert!(off.abs() < 3.0, "{heading}: {off} sigmas of {sigma}");
    }
}

#[test]
fn the_full_filter_starts_where_alignment_ends() {
    for seed in 0..12_u64 {
        let heading = 30.0 * DEG * seed as f64;
        let ship = Ship { heading, turn: 1.5 * DEG, ..Ship::at(-35.0) };
        let imu = if seed % 2 == 0 { good_imu() } else { mems_imu() };
        let mut run = Run::new(&ship, &imu, 200 + seed);
        run.sail(40.0);
        let initial = run.filter.initial_state().unwrap();
        let mut guarded = initial.covariance.matrix().clone();
        for i in 0..guarded.nrows() {
            guarded[(i, i)] += 1e-9 * guarded[(i, i)] + 1e-18;
        }
        assert!(Cholesky::new(guarded).is_some(), "not positive definite");
        let truth =
            insd_nav::Nominal::at(&run.true_place(), &run.true_velocity(), &run.truth().c_nb());
        let error = initial.nominal.error_to(&truth);
        let p = initial.covariance.matrix().fixed_view::<9, 9>(0, 0).into_owned();
        let heads = [POSITION, VELOCITY, ATTITUDE].map(|block| error.of(block));
        let x = nalgebra::SVector::<f64, 9>::from_fn(|i, _| heads[i / 3][i % 3]);
        let whitened = Cholesky::new(p).unwrap().l().solve_lower_triangular(&x).unwrap();
        assert!(whitened.norm_squared() < 30.0, "seed {seed}: {}", whitened.norm_squared());
        assert!(error.of(ATTITUDE).norm() < 5.0 * DEG);
        let filter = insd_nav::Filter::new(run.config(), &initial);
        let said = filter.solution();
        assert!(wrap_pi(said.attitude.heading - run.filter.heading().0).abs() < 0.01);
        assert!((said.sigma.heading - run.filter.heading().1).abs() < 0.2 * said.sigma.heading);
    }
}

#[test]
fn a_tilt_of_some_degrees_at_the_start_is_found_too() {
    let ship = Ship { heading: 4.0, turn: 1.5 * DEG, ..Ship::at(35.0) };
    let mut run = Run::new(&ship, &good_imu(), 11);
    run.filter.motion.attitude =
        UnitQuaternion::new(Vector3::new(0.06, -0.05, 0.0)) * run.filter.motion.attitude;
    run.filter.belief.renew_pair(x::TILT, (4.0 * DEG).powi(2));
    run.sail(60.0);
    let (off, sigma) = judged(&run.filter, &run.truth());
    assert!(sigma < 5.0 && off.abs() < 4.0, "{off} sigmas of {sigma}");
    let said = run.filter.solution();
    assert!((said.attitude.roll - run.truth().roll).abs() < 4.0 * said.sigma.roll);
    assert!((said.attitude.pitch - run.truth().pitch).abs() < 4.0 * said.sigma.pitch);
}

#[test]
fn a_reference_heading_ends_the_search() {
    let ship = Ship { heading: 3.0, roll: 0.0, ..Ship::at(35.0) };
    let mut run = Run::new(&ship, &mems_imu(), 12);
    run.sail(3.0);
    let heading = Some(run.truth().heading + 0.5 * DEG);
    let reference = ExternalReference {
        time: run.filter.time(),
        heading,
        heading_std: Some(1.0 * DEG),
        ..ExternalReference::default()
    };
    let report = run.filter.reference(&reference, insd_base::Source::Reference(0));
    assert_eq!(report.aids.len(), 1);
    let (off, sigma) = judged(&run.filter, &run.truth());
    assert!((0.9..1.1).contains(&sigma) && off.abs() < 1.0, "{off} sigmas of {sigma}");
    assert!(run.filter.finished() && run.filter.motion().sine.abs() < 1e-3);
}

#[test]
fn a_filter_that_refuses_its_receiver_starts_again_from_its_word() {
    let ship = Ship { heading: 1.0, turn: 1.5 * DEG, ..Ship::at(35.0) };
    let mut run = Run::new(&ship, &good_imu(), 13);
    run.sail(30.0);
    assert!(run.filter.finished());
    run.gnss = None;
    run.sail(12.0);
    run.gnss = Some(1.0);
    run.jump = 400.0;
    run.sail(7.0);
    assert!(!run.filter.finished());
    run.sail(50.0);
    let (off, sigma) = judged(&run.filter, &run.truth());
    assert!(sigma < 5.0 && off.abs() < 4.0, "{off} sigmas of {sigma}");
}

#[test]
fn where_a_receiver_leaps_she_is_where_it_says_and_claims_no_more() {
    let ship = Ship { heading: 1.0, turn: 1.5 * DEG, ..Ship::at(35.0) };
    let mut run = Run::new(&ship, &good_imu(), 13);
    run.sail(30.0);
    let before = run.filter.solution().judgement.integrity;
    run.jump = 400.0;
    run.sail(7.0);
    let said = run.filter.solution();
    assert!(run.filter.finished(), "the heading is what it was");
    assert_eq!((before, said.judgement.integrity), (Integrity::Unwatched, Integrity::Unproven));
    assert!(said.sigma.position.0.x > 150.0, "claimed {}", said.sigma.position.0.x);
    run.jump = 0.0;
    run.sail(7.0);
    let said = run.filter.solution();
    assert_eq!(said.judgement.integrity, Integrity::Unwatched, "it went back");
    assert!(said.sigma.position.0.x < 5.0, "claimed {}", said.sigma.position.0.x);
    let (off, sigma) = judged(&run.filter, &run.truth());
    assert!(sigma < 5.0 && off.abs() < 4.0, "{off} sigmas of {sigma}");
}

#[test]
fn a_solution_is_as_good_as_it_says() {
    let ship = Ship { heading: 5.0, turn: 1.0 * DEG, ..Ship::at(-35.0) };
    let mut run = Run::new(&ship, &mems_imu(), 14);
    for _ in 0..6 {
        run.sail(9.5);
        let (said, truth) = (run.filter.solution(), run.truth());
        assert_eq!(said.mode, Mode::InMotionAlignment);
        let off = said.velocity.0 - run.true_velocity();
        assert!(off.component_div(&said.sigma.velocity.0).amax() < 4.0, "{off}");
        assert!((said.attitude.roll - truth.roll).abs() < 4.0 * said.sigma.roll);
        assert!((said.attitude.pitch - truth.pitch).abs() < 4.0 * said.sigma.pitch);
        let north = (said.position.latitude - run.true_place().latitude) * 6.37e6;
        assert!(north.abs() < 4.0 * said.sigma.position.0.x);
        assert!((said.rate_of_turn() - ship.turn).abs() < 0.002);
    }
}

/// A named aid of a fixed measurement.
type Aid = (&'static str, fn(&Scene, &Belief) -> Innovation);

fn table() -> [Aid; 6] {
    const LEVER: Vector3<f64> = Vector3::new(-6.0, -0.8, -14.0);
    fn split<T>(value: T) -> Split<T> {
        Split { value, white: Vector2::repeat(0.1), slow: Vector2::repeat(0.1) }
    }
    [
        ("gnss_position", |scene, belief| {
            let fix = split(Geodetic::from_degrees(52.000_01, 139.000_02, 40.0));
            aids::gnss_position(scene, &fix, &LEVER, scene.leaning(&Mast::default(), belief))
        }),
        ("gnss_velocity", |scene, belief| {
            let fix = split(Vector2::new(4.0, -3.0));
            aids::gnss_velocity(scene, &fix, &LEVER, &Vector2::new(0.3, -0.2), belief)
        }),
        ("log", |scene, belief| {
            let reading =
                SpeedReading { u: 5.0, v: Some(0.4), w: Some(0.1), std: 0.1, water: false };
            aids::log_velocity(scene, &reading, &LEVER, belief)
        }),
        ("reference_position", |scene, _| {
            aids::reference_position(scene, &Geodetic::from_degrees(52.0, 139.0, 0.0), 1.0)
        }),
        ("reference_velocity", |scene, _| {
            aids::reference_velocity(scene, &Vector2::new(1.0, 2.0), 0.1)
        }),
        ("reference_heading", |scene, _| aids::reference_heading(scene, 2.0, 0.02)),
    ]
}

#[test]
fn every_measurement_matrix_agrees_with_perturbed_predictions() {
    let ship = Ship { heading: 2.0, turn: 0.03, ..Ship::at(52.0) };
    let motion = HorizontalMotion {
        place: ship.place,
        velocity: ship.velocity(0.0).xy(),
        tilt: Vector2::new(0.01, -0.02),
        sine: 0.4,
        versine: 0.7,
        attitude: UnitQuaternion::from_matrix(&ship.attitude(2.0).c_nb()),
    };
    let local = Local::new(&motion);
    let belief = Belief::new(&NavConfig::new(good_imu(), LeverArms::default()));
    let scene = |state: usize, amount: f64| {
        let mut errors = OwnErrors::zeros();
        errors[state] = amount;
        let mut moved = motion;
        moved.inject(&local, &errors);
        Scene::new(&moved, &Vector3::new(0.02, -0.05, 0.03), 0.0, (0.1, 1.0))
    };
    for (name, aid) in table() {
        let h = aid(&scene(0, 0.0), &belief).h.of(OWN);
        for state in 0..STATES {
            let step = if state < 4 { 1.0 } else { 1e-3 };
            let (ahead, behind) =
                (aid(&scene(state, step), &belief), aid(&scene(state, -step), &belief));
            // moving the estimate by +x lowers the innovation by H x; the Earth rate's share in the
            // hull's rate, a millimetre per second at a masthead, is left out
            let slope = (behind.z - ahead.z) / (2.0 * step);
            let off = (&slope - h.column(state)).norm();
            assert!(off < 3e-3, "{name} {state}: {slope} {}", h.column(state));
        }
    }
}
