//! What came of a voyage.

use std::collections::HashMap;
use std::fmt;

use insd_base::units::wrap_pi;
use insd_base::{Event, Finding, Mode, Solution, Truth, earth};
use insd_engine::{Engine, EngineConfig, Output};

use crate::systematic::Spoilt;

/// Components that are judged.
const COMPONENTS: usize = 9;
/// Refusals that are so far apart belong together, s.
const APART: f64 = 1.5;

/// Mean squares of the errors over their variances: position and velocity north, east and down, roll, pitch, heading.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    nees: [f64; COMPONENTS],
    /// Longest time for which one aid was refused, s.
    refused: f64,
    /// How many times as bad as its data sheet the IMU was found to be.
    worse: f64,
    count: f64,
}

impl Outcome {
    pub(crate) const HEAD: &'static str =
        "   north   east   down   v_n    v_e    v_d    roll   pitch heading  refused s  worse";

    /// The mean of many; of the time of refusal, the greatest.
    pub(crate) fn mean(all: &[Outcome]) -> Outcome {
        let n = all.len() as f64;
        let mean = |of: &dyn Fn(&Outcome) -> f64| all.iter().map(of).sum::<f64>() / n;
        Outcome {
            nees: std::array::from_fn(|i| mean(&|one| one.nees[i])),
            refused: all.iter().map(|one| one.refused).fold(0.0, f64::max),
            worse: mean(&|one| one.worse),
            count: n,
        }
    }

    fn judge(&mut self, said: &Solution, truth: &Truth) {
        let Some(attitude) = truth.attitude else { return };
        let apart = earth::ecef(&said.position).0 - earth::ecef(&truth.position).0;
        let place = earth::c_ne(&truth.position) * apart;
        let velocity = said.velocity.0 - truth.velocity.map_or(said.velocity.0, |own| own.0);
        let (position_std, velocity_std) = (said.sigma.position.0, said.sigma.velocity.0);
        let squares = [
            place.x / position_std.x,
            place.y / position_std.y,
            place.z / position_std.z,
            velocity.x / velocity_std.x,
            velocity.y / velocity_std.y,
            velocity.z / velocity_std.z,
            wrap_pi(said.attitude.roll - attitude.roll) / said.sigma.roll,
            wrap_pi(said.attitude.pitch - attitude.pitch) / said.sigma.pitch,
            wrap_pi(said.attitude.heading - attitude.heading) / said.sigma.heading,
        ];
        self.nees.iter_mut().zip(squares).for_each(|(sum, off)| *sum += off * off);
        self.count += 1.0;
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.nees.iter().try_for_each(|nees| write!(f, "{nees:>7.2}"))?;
        write!(f, "{:>10.1} {:>6.1}", self.refused, self.worse)
    }
}

/// Sails a voyage; the temperature of the IMU is told or not.
pub(crate) fn sail(spoilt: &Spoilt, is_told: bool) -> Outcome {
    let voyage = &spoilt.voyage;
    let config = EngineConfig::for_voyage(&voyage.header, 1.0);
    let mut engine = Engine::new(EngineConfig { learning: is_told, ..config });
    let (mut outcome, mut refusals) = (Outcome::default(), Refusals::default());
    for received in voyage.received() {
        if is_told {
            engine.feel(received.receipt, spoilt.celsius(received.receipt.as_seconds()));
        }
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            match output {
                Output::Solution(said)
                    if matches!(said.mode, Mode::Aided | Mode::DeadReckoning) =>
                {
                    let at = voyage.truth.binary_search_by_key(&said.time, |row| row.time);
                    at.iter().for_each(|at| outcome.judge(&said, &voyage.truth[*at]));
                }
                Output::Event(Event::Rejected { time, aid, .. }) => {
                    refusals.note(aid, time.as_seconds());
                }
                Output::Event(Event::InstallationFound {
                    finding: Finding::ImuWorse { times },
                    ..
                }) => outcome.worse = times,
                _ => {}
            }
        }
    }
    outcome.refused = refusals.longest;
    outcome.nees.iter_mut().for_each(|sum| *sum /= outcome.count.max(1.0));
    outcome
}

/// For how long each aid is refused without a break.
#[derive(Default)]
struct Refusals {
    runs: HashMap<&'static str, (f64, f64)>,
    longest: f64,
}

impl Refusals {
    fn note(&mut self, aid: &'static str, now: f64) {
        let run = self.runs.entry(aid).or_insert((now, now));
        let begun = if now - run.1 > APART { now } else { run.0 };
        *run = (begun, now);
        self.longest = self.longest.max(now - begun);
    }
}
