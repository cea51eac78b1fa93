//! `campaign --stored`: each voyage starts warm, from the state that another voyage from the same
//! berth left.

use insd_alignment::StoredState;
use insd_base::units::{DEG, wrap_two_pi};
use insd_engine::{Engine, EngineConfig};
use insd_simulator::{Scenario, simulate};

/// Seeds of the first voyages are this far from those that are scored.
const OTHER_SEEDS: u64 = 1 << 32;

/// Turn of the ship between the two voyages on the command line, deg.
pub(super) fn turn(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(degrees) if degrees.abs() <= 180.0 => Ok(degrees),
        _ => Err("expected a turn from -180 to 180 deg".to_owned()),
    }
}

/// The state at the end of a first voyage in the same scenario, in another sea and with another IMU
/// of the same kind, as if the ship had been turned since by `turned`, deg.
pub(super) fn state_of_first_voyage(
    scenario: &Scenario,
    config: impl Fn(&insd_base::VoyageHeader) -> EngineConfig,
    seed: u64,
    turned: f64,
) -> Option<StoredState> {
    let voyage = simulate(scenario, seed.wrapping_add(OTHER_SEEDS));
    let mut engine = Engine::new(config(&voyage.header));
    for received in voyage.received() {
        engine.handle(&received);
        while engine.poll_output().is_some() {}
    }
    let mut state = engine.stored_state()?;
    state.attitude.heading = wrap_two_pi(state.attitude.heading - turned * DEG);
    Some(state)
}
