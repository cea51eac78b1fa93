use super::*;
use insd_base::units::DEG;
use insd_base::{Attitude, Body, Geodetic, Mode, Ned, Solution, SolutionSigma, earth};
use proptest::prelude::*;

/// Errors of an engine in sigmas: heading, roll, pitch, velocity, position.
type Errors = [f64; 9];

const NONE: Errors = [0.0; 9];

/// A ship that steams and rolls, at a time, s.
fn truth(seconds: f64) -> Motion {
    let (roll, pitch) = ((0.7 * seconds).sin() * 4.0 * DEG, (0.9 * seconds).cos() * DEG);
    let rates = [0.7 * 4.0 * DEG * (0.7 * seconds).cos(), -0.9 * DEG * (0.9 * seconds).sin(), 0.0];
    Motion {
        solution: Solution {
            time: Time::from_seconds(seconds),
            position: Geodetic::from_degrees(35.0 + 6e-5 * seconds, -59.0, 28.0),
            velocity: Ned::new(6.6, 0.5, 0.3 * (0.7 * seconds).sin()),
            attitude: Attitude { roll, pitch, heading: 0.8 + 0.002 * seconds },
            rate: Body::new(rates[0], rates[1], rates[2]),
            sigma: SolutionSigma {
                position: Ned::new(1.5, 1.5, 3.0),
                velocity: Ned::new(0.03, 0.03, 0.03),
                roll: 0.01 * DEG,
                pitch: 0.01 * DEG,
                heading: 0.08 * DEG,
            },
            mode: Mode::Aided,
            judgement: insd_base::Judgement::default(),
            source: None,
            hidden: insd_base::Protection::default(),
        },
        acceleration: None,
        covariance: None,
        current: None,
    }
}

/// A motion with errors of so many of its own sigmas.
fn wrong_by(mut motion: Motion, errors: &Errors) -> Motion {
    let solution = &mut motion.solution;
    let sigma = solution.sigma;
    let attitude = &mut solution.attitude;
    attitude.heading += errors[0] * sigma.heading;
    attitude.roll += errors[1] * sigma.roll;
    attitude.pitch += errors[2] * sigma.pitch;
    let errors = |from: usize| nalgebra::Vector3::from_fn(|axis, _| errors[from + axis]);
    solution.velocity.0 += errors(3).component_mul(&sigma.velocity.0);
    let moved = errors(6).component_mul(&sigma.position.0);
    let mut place = earth::ecef(&solution.position);
    place.0 += earth::c_ne(&solution.position).tr_mul(&moved);
    solution.position = earth::geodetic(&place);
    motion
}

fn says(motion: Motion) -> Testimony {
    Testimony {
        motion: Some(motion),
        imu_valid: true,
        refused: Some(0.0),
        turned: None,
        odds: None,
    }
}

fn sound(seconds: f64) -> Testimony {
    says(truth(seconds))
}

fn silent() -> Testimony {
    Testimony { motion: None, imu_valid: true, refused: None, turned: None, odds: None }
}

/// Engines with an IMU each.
fn voices(count: usize) -> Vec<Voice> {
    (0..count).map(|imu| Voice { imu, mounting_std: 0.0, distance: 0.0 }).collect()
}

/// Ten looks a second from one time to another, s, at what engines say; gives what was found and when.
fn sit(
    voter: &mut Voter,
    (from, to): (f64, f64),
    said: impl Fn(f64) -> Vec<Testimony>,
) -> Vec<(f64, VoteEvent)> {
    let looks = (from * 10.0).round() as u32..(to * 10.0).round() as u32;
    let mut events = Vec::new();
    for look in looks {
        let seconds = f64::from(look) / 10.0;
        let found = voter.look(Time::from_seconds(seconds), &said(seconds));
        events.extend(found.into_iter().map(|event| (seconds, event)));
    }
    events
}

/// Adds to the error of the engine's heading, rad.
fn turned(mut testimony: Testimony, by: f64) -> Testimony {
    if let Some(motion) = &mut testimony.motion {
        motion.solution.attitude.heading += by;
    }
    testimony
}

fn in_mode(mut testimony: Testimony, mode: Mode) -> Testimony {
    if let Some(motion) = &mut testimony.motion {
        motion.solution.mode = mode;
    }
    testimony
}

/// Times and targets of switches.
fn switches(events: &[(f64, VoteEvent)]) -> Vec<(f64, usize, Option<Doubt>)> {
    let switch = |(at, event): &(f64, VoteEvent)| match event {
        VoteEvent::Switched { to, why, .. } => Some((*at, *to, *why)),
        _ => None,
    };
    events.iter().filter_map(switch).collect()
}

#[test]
fn two_that_are_apart_for_two_seconds_disagree_and_nobody_is_blamed_without_evidence() {
    let mut voter = Voter::new(voices(2));
    assert_eq!(sit(&mut voter, (0.0, 60.0), |t| vec![sound(t), sound(t)]), []);
    let found = sit(&mut voter, (60.0, 90.0), |t| vec![sound(t), turned(sound(t), 3.0 * DEG)]);
    let [(at, VoteEvent::Differ { disagreement, .. })] = found[..] else { panic!("{found:?}") };
    assert!((61.8..62.2).contains(&at), "{at}");
    assert_eq!((disagreement.between, disagreement.wrong), ((0, 1), None));
    let Difference { quantity, value, limit } = disagreement.difference;
    assert_eq!(quantity, ComparedQuantity::Heading);
    assert!((value - 3.0 * DEG).abs() < 1e-9 && limit < 0.7 * DEG, "{limit}");
    assert_eq!((voter.chosen(), voter.doubt(0), voter.doubt(1)), (0, None, None));
    let ended = sit(&mut voter, (90.0, 200.0), |t| vec![sound(t), sound(t)]);
    let [(at, VoteEvent::Agree { between: (0, 1), .. })] = ended[..] else { panic!("{ended:?}") };
    assert!((109.0..111.0).contains(&at), "{at}");
}

#[test]
fn a_knock_of_a_second_is_no_disagreement_but_one_that_comes_with_each_wave_is() {
    let apart = |seconds: f64, on: bool| turned(sound(seconds), if on { DEG } else { 0.0 });
    let mut voter = Voter::new(voices(2));
    let once = |t: f64| vec![sound(t), apart(t, (10.0..11.0).contains(&t))];
    assert_eq!(sit(&mut voter, (0.0, 60.0), once), []);
    let waves = |t: f64| vec![sound(t), apart(t, t % 8.0 < 3.0 || (4.0..7.0).contains(&(t % 8.0)))];
    let found = sit(&mut voter, (60.0, 90.0), waves);
    assert!(matches!(found[..], [(_, VoteEvent::Differ { .. })]), "{found:?}");
}

#[test]
fn of_two_that_disagree_the_one_with_evidence_against_it_is_left() {
    let refuses = |testimony| Testimony { refused: Some(0.9), ..testimony };
    let invalid = |testimony| Testimony { imu_valid: false, ..testimony };
    let vague = |mut testimony: Testimony| {
        testimony.motion.iter_mut().for_each(|motion| motion.solution.sigma.heading *= 6.0);
        testimony
    };
    let cases: [(Doubt, &dyn Fn(Testimony) -> Testimony); 5] = [
        (Doubt::ImuInvalid, &invalid),
        (Doubt::Refuses, &refuses),
        (Doubt::LesserMode, &|own| in_mode(own, Mode::Inertial)),
        (Doubt::Aligning, &|own| in_mode(own, Mode::InMotionAlignment)),
        (Doubt::LessCertain, &vague),
    ];
    for (doubt, change) in cases {
        let mut voter = Voter::new(voices(2));
        sit(&mut voter, (0.0, 10.0), |t| vec![sound(t), sound(t)]);
        let slipped = |t: f64| {
            let mut own = truth(t);
            own.solution.velocity.0.x += 5.0;
            own.solution.attitude.roll += DEG;
            says(own)
        };
        let found = sit(&mut voter, (10.0, 100.0), |t| vec![change(slipped(t)), sound(t)]);
        let switched = switches(&found);
        let [(at, 1, Some(why))] = switched[..] else { panic!("{doubt:?}: {found:?}") };
        assert!(at < 15.0 && why == doubt, "{at} {why:?}");
        assert_eq!((voter.chosen(), voter.doubt(0)), (1, Some(doubt)));
    }
}

#[test]
fn an_engine_that_stands_first_is_taken_back_after_its_trial() {
    let mut voter = Voter::new(voices(2));
    sit(&mut voter, (0.0, 10.0), |t| vec![sound(t), sound(t)]);
    let left = sit(&mut voter, (10.0, 20.0), |t| vec![silent(), sound(t)]);
    assert_eq!(switches(&left), [(10.0, 1, Some(Doubt::Silent))]);
    let back = sit(&mut voter, (20.0, 60.0), |t| vec![sound(t), sound(t)]);
    assert_eq!(switches(&back), [(50.0, 0, None)]);
}

#[test]
fn an_engine_that_comes_and_goes_is_not_taken_back() {
    let mut voter = Voter::new(voices(2));
    let said = |t: f64| vec![if t % 20.0 < 1.0 { silent() } else { sound(t) }, sound(t)];
    assert_eq!(switches(&sit(&mut voter, (1.0, 300.0), said)).len(), 1);
    let modes = |t: f64| {
        let mode = if t % 2.0 < 1.0 { Mode::Aided } else { Mode::Inertial };
        vec![in_mode(sound(t), mode), sound(t)]
    };
    let mut voter = Voter::new(voices(2));
    assert_eq!(sit(&mut voter, (0.0, 300.0), modes), []);
}

#[test]
fn engines_on_one_imu_have_one_voice() {
    let one = Voice { imu: 0, mounting_std: 0.0, distance: 0.0 };
    let mut voter = Voter::new(vec![one, one, Voice { imu: 1, ..one }]);
    let bad = |t: f64| turned(sound(t), 5.0 * DEG);
    let found = sit(&mut voter, (0.0, 30.0), |t| vec![bad(t), bad(t), sound(t)]);
    assert_eq!(found.len(), 2, "{found:?}");
    assert_eq!(voter.disagreements().filter_map(|own| own.wrong).count(), 0);
    // what is known of the two engines otherwise still counts
    let refuses = |own: Testimony| Testimony { refused: Some(1.0), ..own };
    let said = |t: f64| vec![refuses(bad(t)), refuses(bad(t)), sound(t)];
    assert_eq!(switches(&sit(&mut voter, (30.0, 60.0), said)).len(), 1);
    assert_eq!(voter.chosen(), 2);
}

#[test]
fn near_a_pole_two_engines_some_metres_apart_agree() {
    let at = |t: f64, longitude: f64| {
        let mut own = truth(t);
        own.solution.position = Geodetic::from_degrees(89.99999, longitude, 0.0);
        // the same course by meridians that are turned
        let turn = (longitude - 10.0) * DEG;
        own.solution.attitude.heading += turn;
        let (sin, cos) = turn.sin_cos();
        let v = own.solution.velocity.0;
        own.solution.velocity = Ned::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z);
        says(own)
    };
    let mut voter = Voter::new(voices(2));
    assert_eq!(sit(&mut voter, (0.0, 30.0), |t| vec![at(t, 10.0), at(t, 70.0)]), []);
}

/// What can be wrong with an engine from an instant on.
#[derive(Clone, Copy, Debug)]
enum Fault {
    Bias(usize, f64),
    Drift(usize, f64),
    Stuck,
    Frozen,
    NotANumber(usize),
    Scale(f64),
}

fn fault() -> impl Strategy<Value = Fault> {
    let sign = prop_oneof![Just(-1.0), Just(1.0)];
    let size = (sign, 60.0..2000.0_f64).prop_map(|(sign, size)| sign * size);
    prop_oneof![
        (0..9_usize, size.clone()).prop_map(|(of, size)| Fault::Bias(of, size)),
        (0..9_usize, size).prop_map(|(of, size)| Fault::Drift(of, size * 0.02)),
        Just(Fault::Stuck),
        Just(Fault::Frozen),
        (0..9_usize).prop_map(Fault::NotANumber),
        prop_oneof![-0.5..0.5_f64, 1.5..3.0_f64].prop_map(Fault::Scale),
    ]
}

/// What an engine says that has been faulty for some time, s.
fn faulty(fault: Fault, seconds: f64, since: f64) -> Testimony {
    let mut errors = NONE;
    let mut motion = truth(seconds);
    match fault {
        // a bias or a drift of tens of sigmas, beyond the floors
        Fault::Bias(of, size) => errors[of] = size,
        Fault::Drift(of, rate) => errors[of] = rate * (seconds - since),
        Fault::Stuck => {
            motion = Motion {
                solution: Solution { time: motion.solution.time, ..truth(since).solution },
                ..motion
            }
        }
        Fault::Frozen => motion = truth(since),
        Fault::NotANumber(of) => errors[of] = f64::NAN,
        Fault::Scale(factor) => {
            let solution = &mut motion.solution;
            solution.attitude.roll *= factor;
            solution.velocity.0 *= factor;
        }
    }
    says(wrong_by(motion, &errors))
}

fn honest() -> impl Strategy<Value = Errors> {
    proptest::array::uniform9(-2.5..2.5_f64)
}

proptest! {
    #[test]
    fn any_single_faulty_engine_of_three_is_voted_out(
        who in 0..3_usize, fault in fault(), errors in proptest::array::uniform2(honest()),
    ) {
        let mut voter = Voter::new(voices(3));
        let said = |t: f64, wrong: bool| -> Vec<Testimony> {
            let mut honest = errors.iter();
            (0..3).map(|engine| {
                if engine == who && wrong {
                    return faulty(fault, t, 20.0);
                }
                says(wrong_by(truth(t), if engine == who { &NONE } else { honest.next().unwrap() }))
            }).collect()
        };
        prop_assert_eq!(sit(&mut voter, (0.0, 20.0), |t| said(t, false)), []);
        sit(&mut voter, (20.0, 140.0), |t| said(t, true));
        prop_assert_ne!(voter.chosen(), who);
        // one that is silent has no voice; of the others it is said who is wrong
        let silent = matches!(fault, Fault::Frozen | Fault::NotANumber(_));
        let blamed: Vec<usize> =
            voter.disagreements().filter_map(|own| Some(own.wrong?.0)).collect();
        prop_assert!(blamed.iter().all(|own| *own == who), "{:?}", blamed);
        prop_assert!(silent || blamed.len() == 2, "{:?}", blamed);
    }

    #[test]
    fn engines_within_their_claims_never_disagree(
        count in 2..4_usize, errors in proptest::array::uniform3(proptest::array::uniform9(-2.8..2.8_f64)),
        vague in proptest::array::uniform3(0.3..30.0_f64),
    ) {
        let mut voter = Voter::new(voices(count));
        let said = |t: f64| -> Vec<Testimony> {
            (0..count).map(|engine| {
                let mut motion = truth(t);
                let sigma = &mut motion.solution.sigma;
                sigma.position.0 *= vague[engine];
                sigma.velocity.0 *= vague[engine];
                sigma.heading *= vague[engine];
                sigma.roll *= vague[engine];
                sigma.pitch *= vague[engine];
                says(wrong_by(motion, &errors[engine]))
            }).collect()
        };
        let found = sit(&mut voter, (0.0, 30.0), said);
        prop_assert_eq!(found.len(), switches(&found).len());
        prop_assert_eq!(voter.disagreements().count(), 0);
    }

    #[test]
    fn whatever_engines_say_a_silent_one_is_never_used_while_another_speaks(
        rounds in prop::collection::vec(
            proptest::array::uniform3((0..6_usize, any::<bool>(), 0.0..1.0_f64, -100.0..100.0_f64)), 1..200),
    ) {
        let modes = [
            Mode::CoarseAlignment, Mode::FineAlignment, Mode::DeadReckoning, Mode::Inertial, Mode::Aided,
        ];
        let mut voter = Voter::new(voices(3));
        for (look, round) in (0_u32..).zip(rounds) {
            let seconds = f64::from(look) / 10.0;
            let said = round.map(|(mode, imu_valid, refused, error)| {
                let motion = modes.get(mode).map(|mode| {
                    let own = turned(sound(seconds), error * DEG);
                    in_mode(own, *mode).motion.unwrap()
                });
                Testimony { motion, imu_valid, refused: Some(refused), turned: None, odds: None }
            });
            voter.look(Time::from_seconds(seconds), &said);
            let any = said.iter().any(|own| own.motion.is_some());
            prop_assert!(!any || said[voter.chosen()].motion.is_some());
        }
    }
}
