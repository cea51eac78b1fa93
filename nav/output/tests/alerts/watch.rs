//! When which alert is raised.

use insd_base::units::DEG;
use insd_base::{
    AlignmentPhase, AlignmentStatus, Forecast, Lack, Mode, Ned, Solution, StorageFaults, Time,
};
use insd_output::alerts::{Condition, Watch};
use insd_output::{OutputEpoch, Policy};
use insd_wire::nmea::Alf;

use super::{at, solution};

use Condition::{
    AlertLimit, EnginesDiffer, HeadingDegraded, HeadingLost, NoUtc, PositionEstimated,
    PositionLost, Simulated, SystemFault,
};

/// Ten looks a second, and when what was found.
struct Look {
    watch: Watch,
    policy: Policy,
    seconds: f64,
}

impl Look {
    fn new() -> Self {
        Look { watch: Watch::default(), policy: Policy::default(), seconds: 0.0 }
    }

    /// What holds after so many seconds of such epochs.
    fn at(&mut self, seconds: f64, epoch: impl Fn(OutputEpoch) -> OutputEpoch) -> Vec<Condition> {
        let mut found = Vec::new();
        for _ in 0..(seconds * 10.0) as u32 {
            let now = at(self.seconds);
            let usual = OutputEpoch {
                solution: Some(solution(now.time)),
                utc: now.utc,
                ..OutputEpoch::unknown(now.time)
            };
            let holding = self.watch.note(&epoch(usual), &self.policy, &Default::default(), false);
            found = holding.iter().filter(|(_, holds)| *holds).map(|(own, _)| *own).collect();
            self.seconds = ((self.seconds + 0.1) * 10.0).round() / 10.0;
        }
        found
    }

    /// After a minute in which all was well.
    fn of_a_sound_ship() -> Self {
        let mut look = Look::new();
        assert_eq!(look.at(60.0, |epoch| epoch), []);
        look
    }
}

fn with(change: impl Fn(&mut Solution)) -> impl Fn(OutputEpoch) -> OutputEpoch {
    move |mut epoch| {
        epoch.solution.iter_mut().for_each(&change);
        epoch
    }
}

fn silent(epoch: OutputEpoch) -> OutputEpoch {
    OutputEpoch { solution: None, ..epoch }
}

fn levelling(told: Time) -> Option<AlignmentStatus> {
    Some(AlignmentStatus {
        time: told,
        phase: AlignmentPhase::Levelling,
        moored: true,
        sigma: None,
        target: None,
        gyrocompass: None,
        ready: Forecast::Unknown { lacks: Lack::Time },
        sea: None,
        fit: None,
        shifts: 0,
    })
}

#[test]
fn engines_that_differ_are_told_at_once_and_as_long_as_they_do() {
    let mut look = Look::of_a_sound_ship();
    let differ = |epoch| OutputEpoch { engines_differ: true, ..epoch };
    assert_eq!(look.at(0.1, differ), [EnginesDiffer]);
    assert_eq!(look.at(60.0, differ), [EnginesDiffer]);
    assert_eq!(look.at(0.1, |epoch| epoch), []);
}

#[test]
fn a_level_beyond_the_alert_limit_is_told_where_one_is_set() {
    let vague =
        |sigma: f64| with(move |solution| solution.sigma.position = Ned::new(sigma, 0.0, 0.0));
    let mut look = Look::of_a_sound_ship();
    assert_eq!(look.at(60.0, vague(6.0)), []);
    look.policy.alert_limit = Some(25.0);
    assert_eq!(look.at(60.0, vague(4.0)), []);
    assert_eq!(look.at(9.0, vague(6.0)), []);
    assert_eq!(look.at(2.0, vague(6.0)), [AlertLimit]);
    assert_eq!(look.at(12.0, vague(4.0)), []);
}

#[test]
fn a_heading_that_was_never_valid_is_not_lost() {
    let aligning = with(|solution| solution.mode = Mode::FineAlignment);
    assert_eq!(Look::new().at(600.0, aligning), []);
}

#[test]
fn a_ship_that_aligns_at_her_berth_has_an_estimated_position_only_if_it_is_little_certain() {
    for mode in [Mode::CoarseAlignment, Mode::FineAlignment] {
        let sure = with(|solution| solution.mode = mode);
        assert_eq!(Look::new().at(600.0, sure), []);
        let vague = with(|solution| {
            solution.mode = mode;
            solution.sigma.position = Ned::new(20.0, 20.0, 20.0);
        });
        assert_eq!(Look::new().at(60.0, vague), [PositionEstimated]);
    }
}

#[test]
fn a_heading_is_lost_within_2_s_and_found_when_it_was_good_for_10_s() {
    let mut look = Look::of_a_sound_ship();
    let lost = with(|solution| solution.sigma.heading = 10.0 * DEG);
    assert_eq!(look.at(1.9, &lost), []);
    assert_eq!(look.at(0.2, &lost), [HeadingLost]);
    assert_eq!(look.at(10.0, |epoch| epoch), [HeadingLost]);
    assert_eq!(look.at(0.1, |epoch| epoch), []);
}

#[test]
fn a_sigma_on_the_edge_raises_nothing_over_and_over() {
    let mut look = Look::of_a_sound_ship();
    let lost = with(|solution| solution.sigma.heading = 10.0 * DEG);
    for _ in 0..50 {
        assert_eq!(look.at(1.0, &lost), []);
        assert_eq!(look.at(1.0, |epoch| epoch), []);
    }
    look.at(5.0, &lost);
    for _ in 0..50 {
        assert_eq!(look.at(1.0, &lost), [HeadingLost]);
        assert_eq!(look.at(9.0, |epoch| epoch), [HeadingLost]);
    }
}

#[test]
fn a_heading_that_is_estimated_is_degraded() {
    let mut look = Look::of_a_sound_ship();
    let worse = with(|solution| solution.sigma.heading = 1.0 * DEG);
    assert_eq!(look.at(10.0, &worse), []);
    assert_eq!(look.at(0.1, &worse), [HeadingDegraded]);
}

#[test]
fn a_position_is_first_estimated_and_then_lost() {
    let mut look = Look::of_a_sound_ship();
    let reckoned = with(|solution| solution.mode = Mode::DeadReckoning);
    assert_eq!(look.at(11.0, reckoned), [PositionEstimated]);
    let nowhere = with(|solution| {
        solution.mode = Mode::Inertial;
        solution.sigma.position = Ned::new(200.0, 200.0, 10.0);
    });
    assert_eq!(look.at(3.0, &nowhere), [PositionLost, PositionEstimated]);
    assert_eq!(look.at(40.0, &nowhere), [PositionLost]);
}

#[test]
fn a_silent_imu_and_a_fault_are_a_system_fault_and_nothing_else() {
    let fault = with(|solution| solution.mode = Mode::Fault);
    let faults: [&dyn Fn(OutputEpoch) -> OutputEpoch; 2] = [&silent, &fault];
    for fault in faults {
        let mut look = Look::of_a_sound_ship();
        assert_eq!(look.at(5.0, fault), []);
        assert_eq!(look.at(100.0, fault), [SystemFault]);
    }
    assert_eq!(Look::new().at(10.0, silent), [SystemFault], "from the start");
}

#[test]
fn a_ship_that_finds_out_which_way_is_down_has_no_fault_unless_it_comes_to_a_halt() {
    let told =
        |epoch: OutputEpoch| OutputEpoch { alignment: levelling(epoch.time), ..silent(epoch) };
    let mut look = Look::new();
    assert_eq!(look.at(600.0, told), []);
    let halted =
        |epoch: OutputEpoch| OutputEpoch { alignment: levelling(at(600.0).time), ..silent(epoch) };
    assert_eq!(look.at(19.0, halted), []);
    assert_eq!(look.at(2.0, halted), [SystemFault]);
}

#[test]
fn utc_is_missed_after_a_minute() {
    let mut look = Look::of_a_sound_ship();
    let timeless = |epoch: OutputEpoch| OutputEpoch { utc: None, ..epoch };
    assert_eq!(look.at(60.0, timeless), []);
    assert_eq!(look.at(0.1, timeless), [NoUtc]);
}

#[test]
fn simulated_data_are_told_at_once() {
    let mut watch = Watch::default();
    let epoch =
        OutputEpoch { solution: Some(solution(Time::START)), ..OutputEpoch::unknown(Time::START) };
    let found = watch.note(&epoch, &Policy::default(), &Default::default(), true);
    let holding: Vec<_> = found.iter().filter(|(_, holds)| *holds).collect();
    assert_eq!(holding, [&(Simulated, true)]);
}

#[test]
fn titles_have_16_characters_and_descriptions_fit_into_their_sentence() {
    for condition in Condition::ALL {
        let (title, description) = (condition.title(), condition.description());
        assert!((1..=16).contains(&title.len()), "{title}");
        assert!((1..=Alf::ROOM[1]).contains(&description.len()), "{description}");
        let plain =
            |text: &str| text.chars().all(|c| c.is_ascii_alphanumeric() || " .".contains(c));
        assert!(plain(title) && plain(description), "{title}: {description}");
    }
}

#[test]
fn identifiers_are_our_own_or_those_of_a_standard_and_each_is_used_once() {
    for (index, condition) in Condition::ALL.into_iter().enumerate() {
        let alert = condition.alert();
        assert_eq!(alert.manufacturer.is_some(), alert.identifier >= 10_000, "{condition:?}");
        assert!(Condition::ALL[..index].iter().all(|other| other.alert() != alert));
    }
    assert_eq!(SystemFault.alert().identifier, 3062);
}

#[test]
fn what_cannot_be_written_is_told_at_once_and_no_more_when_it_can_be_for_a_while() {
    let mut look = Look::of_a_sound_ship();
    let faults = |recording, state| {
        let storage = StorageFaults { recording, state, fleet: false };
        move |epoch: OutputEpoch| OutputEpoch { storage, ..epoch }
    };
    assert_eq!(look.at(0.1, faults(true, false)), [Condition::NotRecording]);
    assert_eq!(look.at(0.1, faults(true, true)), [Condition::NotRecording, Condition::NotSaving]);
    assert_eq!(look.at(9.9, faults(false, true)), [Condition::NotRecording, Condition::NotSaving]);
    assert_eq!(look.at(0.5, faults(false, true)), [Condition::NotSaving]);
    assert_eq!(look.at(11.0, faults(false, false)), []);
    let storage = StorageFaults { fleet: true, ..StorageFaults::default() };
    let unspooled = move |epoch: OutputEpoch| OutputEpoch { storage, ..epoch };
    assert_eq!(look.at(0.1, unspooled), [Condition::NotSpooling]);
}
