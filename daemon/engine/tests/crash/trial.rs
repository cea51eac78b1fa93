//! The trial: a right state passes it, a wrong one does not.

use insd_base::units::DEG;
use insd_base::{Body, Event, Message, Received, ResumeDoubt};
use nalgebra::{Rotation3, Vector3};

use crate::voyages::{After, RATE, Way, scenario, watch};

/// What the trial found: `None` if it found nothing.
fn finding(after: &After) -> Option<Result<(), ResumeDoubt>> {
    after.events.iter().find_map(|event| match event {
        Event::ResumeConfirmed { .. } => Some(Ok(())),
        Event::ResumeDropped { reason, .. } => Some(Err(*reason)),
        _ => None,
    })
}

fn all_pass(seeds: std::ops::Range<u64>, every: f64) -> (usize, Vec<String>) {
    let (mut count, mut fallen) = (0, Vec::new());
    for way in [Way::Steady, Way::Turning, Way::Moored] {
        for (sea, grade) in [(3, "navigation"), (5, "navigation"), (4, "mems")] {
            for seed in seeds.clone() {
                let watched = watch(&scenario(way, sea, grade, 700.0), seed, 335.0, every);
                for kept in &watched.kept {
                    for gap in [0.5, 2.0, 5.0] {
                        let Ok(after) = watched.resume(kept, gap, 32.0) else { continue };
                        count += 1;
                        match finding(&after) {
                            Some(Ok(())) => {}
                            None if kept.1.as_seconds() > 660.0 => {}
                            found => fallen.push(format!(
                                "{way:?} {sea} {grade} seed {seed} at {:.1} s, {gap} s: {found:?}",
                                kept.1.as_seconds()
                            )),
                        }
                    }
                }
            }
        }
    }
    (count, fallen)
}

#[test]
fn a_right_state_passes_the_trial() {
    let (count, fallen) = all_pass(1..2, 61.0);
    assert!(count > 90, "{count}");
    assert!(fallen.is_empty(), "{fallen:#?}");
}

#[test]
#[ignore = "takes minutes: for the figures of docs/restart.md"]
fn right_states_pass_the_trial_over_many_seeds() {
    let (count, fallen) = all_pass(11..21, 23.0);
    println!("{count} resumed, {} fallen: {fallen:#?}", fallen.len());
    assert!(fallen.is_empty());
}

/// The ship as if her hull had been turned by this rotation, body axes, while nobody looked.
fn turned(received: Received, turn: &Rotation3<f64>) -> Received {
    let mut received = received;
    if let Message::Imu(sample) = &mut received.message {
        let seen = |v: &Body| Body(turn.inverse() * v.0);
        sample.delta_theta = seen(&sample.delta_theta);
        sample.delta_velocity = seen(&sample.delta_velocity);
    }
    received
}

/// What the trial finds of each of several wrong states.
fn found_wrong(way: Way, changed: impl Fn(Received) -> Received) -> Vec<Option<ResumeDoubt>> {
    let mut found = Vec::new();
    for seed in 1..4 {
        let watched = watch(&scenario(way, 3, "navigation", 480.0), seed, 335.0, 19.0);
        for kept in watched.kept.iter().filter(|kept| kept.1.as_seconds() < 445.0) {
            let after = watched.resume_into(kept, 1.0, 32.0, &changed).unwrap();
            found.push(finding(&after).and_then(Result::err));
        }
    }
    found
}

#[test]
fn a_ship_that_was_turned_by_30_degrees_is_found_out_as_she_manoeuvres() {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 30.0 * DEG);
    let found = found_wrong(Way::Turning, |received| turned(received, &turn));
    assert!(found.iter().all(|doubt| *doubt == Some(ResumeDoubt::Velocity)), "{found:?}");
}

#[test]
fn a_roll_that_is_off_by_5_degrees_is_found_out() {
    let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), 5.0 * DEG);
    for way in [Way::Turning, Way::Steady, Way::Moored] {
        let found = found_wrong(way, |received| turned(received, &turn));
        let (velocity, level) = (Some(ResumeDoubt::Velocity), Some(ResumeDoubt::Level));
        assert!(found.iter().all(|d| *d == velocity || *d == level), "{way:?} {found:?}");
    }
}

#[test]
fn a_ship_that_is_a_kilometre_away_is_found_out() {
    let found = found_wrong(Way::Steady, |received| {
        let mut received = received;
        if let Message::Gnss(fix) = &mut received.message {
            fix.position.iter_mut().for_each(|place| place.latitude += 1000.0 / 6.371e6);
        }
        received
    });
    assert!(found.iter().all(|doubt| *doubt == Some(ResumeDoubt::Position)), "{found:?}");
}

#[test]
fn one_bad_fix_drops_nothing() {
    let watched = watch(&scenario(Way::Steady, 3, "navigation", 480.0), 5, 335.0, 19.0);
    for kept in watched.kept.iter().filter(|kept| kept.1.as_seconds() < 445.0) {
        let wild = |received: Received| {
            let mut received = received;
            if let Message::Gnss(fix) = &mut received.message
                && (2.5..3.5).contains(&fix.time.as_seconds())
            {
                fix.position.iter_mut().for_each(|place| place.latitude += 1e-3);
            }
            received
        };
        let after = watched.resume_into(kept, 1.0, 32.0, wild).unwrap();
        assert_eq!(finding(&after), Some(Ok(())));
    }
}

/// The first heading after a restart: seconds until it is told, and its error in claimed sigmas.
fn first_headings(seeds: std::ops::Range<u64>) -> Vec<(f64, f64)> {
    let mut found = Vec::new();
    for way in [Way::Steady, Way::Turning] {
        for seed in seeds.clone() {
            let sea = if seed % 2 == 0 { 5 } else { 3 };
            let grade = if seed % 3 == 0 { "mems" } else { "navigation" };
            let watched = watch(&scenario(way, sea, grade, 600.0), seed, 331.0, 3.7);
            for (place, kept) in watched.kept.iter().enumerate() {
                // any gap of the range, another one each time
                let share = (place as f64 * 0.618_033_988 + seed as f64 * 0.414).fract();
                // the truth is known every twentieth of a second
                let gap = ((0.4 + share * 1.1) * RATE).round() / RATE;
                let Ok(after) = watched.resume(kept, gap, 2.0) else { continue };
                let start = kept.1.as_seconds() + gap;
                for solution in &after.solutions {
                    let Some([_, _, (error, sigma)]) = watched.errors(solution) else { continue };
                    found.push((solution.time.as_seconds() - start, error.abs() / sigma));
                    break;
                }
            }
        }
    }
    found
}

#[test]
fn within_two_seconds_of_a_restart_there_is_a_heading_within_three_sigmas() {
    let found = first_headings(1..7);
    let good = found.iter().filter(|(after, sigmas)| *after < 2.0 && *sigmas < 3.0).count();
    let worst = found.iter().map(|(_, sigmas)| *sigmas).fold(0.0, f64::max);
    println!("{good} of {}, worst {worst:.2}", found.len());
    assert!(found.len() > 700, "{}", found.len());
    assert!(good * 100 >= found.len() * 99, "{good} of {}", found.len());
}
