//! Losses of GNSS: at each of many instants the engine, as it is then, goes on alone for five minutes.

use insd_base::{Message, Received, Solution, Time};
use insd_engine::{Engine, EngineConfig, Output};
use insd_lab::evaluation::{EpochError, errors};

use crate::ship::Ship;

/// Lengths that are judged, s.
pub(crate) const LENGTHS: [f64; 5] = [10.0, 30.0, 60.0, 120.0, 300.0];
/// Losses of a voyage, the first after an hour, and the time between two, s.
pub(crate) const LOSSES: usize = 30;
const FIRST: f64 = 3600.0;
const APART: f64 = 110.0;
/// Time between two temperatures, s.
const FELT: f64 = 10.0;

/// The end of an outage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    /// Length, as an index of [`LENGTHS`].
    pub(crate) length: usize,
    /// Horizontal error, m.
    pub(crate) error: f64,
    /// Its square beside its claim, of two degrees of freedom.
    pub(crate) square: f64,
}

/// The ends of all outages of a ship.
pub(crate) fn ends(ship: &Ship, is_learning: bool) -> Vec<End> {
    let config = EngineConfig {
        learning: is_learning,
        ..EngineConfig::for_voyage(&ship.voyage.header, 1.0)
    };
    let (mut engine, messages) = (Engine::new(config), ship.voyage.received());
    let mut felt = 0.0;
    let mut ends = Vec::new();
    for (at, received) in messages.iter().enumerate() {
        let next = FIRST + ends.len() as f64 / LENGTHS.len() as f64 * APART;
        let lost = received.receipt.as_seconds() >= next && ends.len() < LENGTHS.len() * LOSSES;
        if lost {
            ends.extend(alone(ship, engine.clone(), felt, &messages[at..]));
        }
        hand(ship, &mut engine, &mut felt, received);
        while engine.poll_output().is_some() {}
    }
    ends
}

/// What becomes of an engine without GNSS.
fn alone(ship: &Ship, mut engine: Engine, mut felt: f64, rest: &[Received]) -> Vec<End> {
    let Some(begin) = rest.first().map(|first| first.receipt) else { return Vec::new() };
    let mut said: Vec<Solution> = Vec::new();
    let last = LENGTHS[LENGTHS.len() - 1] + 1.0;
    for received in rest {
        if (received.receipt - begin).as_seconds() > last {
            break;
        }
        if matches!(received.message, Message::Gnss(_)) {
            continue;
        }
        hand(ship, &mut engine, &mut felt, received);
        while let Some(output) = engine.poll_output() {
            said.extend(if let Output::Solution(own) = output { Some(own) } else { None });
        }
    }
    let found = errors(&said, &ship.voyage.truth, None).epochs;
    (0..LENGTHS.len()).filter_map(|length| end(&found, begin, length)).collect()
}

fn end(found: &[EpochError], begin: Time, length: usize) -> Option<End> {
    let apart = |own: &&EpochError| ((own.time - begin).as_seconds() - LENGTHS[length]).abs();
    let own = found.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    Some(End { length, error: own.horizontal()?, square: own.horizontal_distance_sq()? })
}

fn hand(ship: &Ship, engine: &mut Engine, felt: &mut f64, received: &Received) {
    if received.receipt.as_seconds() >= *felt {
        engine.feel(received.receipt, ship.celsius(received.receipt));
        *felt += FELT;
    }
    engine.handle(received);
}
