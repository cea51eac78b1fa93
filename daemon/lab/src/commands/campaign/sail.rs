//! One voyage of a campaign: made, navigated, scored.

use insd_base::{AlignmentStatus, Solution, Time, Voyage, VoyageHeader};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, simulate};

use super::super::stored_start;
use super::args::CampaignArgs;
use crate::evaluation::{Run, StoredFate, Yardstick, drifts, errors, outages};

/// The scores of a seed.
pub(super) fn run_seed(
    scenario: &Scenario,
    seed: u64,
    yardstick: Option<&Yardstick>,
    args: &CampaignArgs,
) -> Run {
    let voyage = simulate(scenario, seed);
    let sailed = navigate(scenario, &voyage, seed, args);
    let found = errors(&sailed.solutions, &voyage.truth, args.from.map(Time::from_seconds));
    let run = Run::new(seed, &found, drifts(&outages(&sailed.solutions), &found.epochs))
        .telling(&sailed.statuses)
        .started_from(sailed.fate);
    match yardstick {
        Some(yardstick) => {
            run.measured(&errors(&sailed.solutions, &voyage.truth, None).epochs, yardstick)
        }
        None => run,
    }
}

/// What came out of the engine on one voyage.
struct Sailed {
    solutions: Vec<Solution>,
    /// What it said of its alignment.
    statuses: Vec<AlignmentStatus>,
    /// What became of its stored state, if it was to have one.
    fate: Option<StoredFate>,
}

/// The engine on a voyage in memory.
fn navigate(scenario: &Scenario, voyage: &Voyage, seed: u64, args: &CampaignArgs) -> Sailed {
    let configured = |header: &VoyageHeader| {
        let alignment = args.alignment.config();
        EngineConfig { alignment, ..EngineConfig::for_voyage(header, args.rate) }
    };
    let stored = args
        .stored
        .and_then(|turned| stored_start::state_of_first_voyage(scenario, configured, seed, turned));
    let mut fate = args.stored.map(|_| match stored {
        Some(_) => StoredFate::Undecided,
        None => StoredFate::Missing,
    });
    let mut engine = Engine::new(EngineConfig { stored, ..configured(&voyage.header) });
    let (mut solutions, mut statuses) = (Vec::new(), Vec::new());
    for received in voyage.received() {
        if args.outages.iter().any(|outage| outage.drops(&received)) {
            continue;
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Solution(solution) => solutions.push(solution),
                Output::Alignment(status) => statuses.push(status),
                Output::Event(event) => fate = StoredFate::of(&event).or(fate),
                Output::Innovation(_) | Output::Satellite(_) => {}
            }
        }
    }
    Sailed { solutions, statuses, fate }
}
