//! What the mode says is so.

use insd_base::{Event, Mode};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, shipped, simulate};

#[test]
fn a_ship_that_uses_gnss_is_never_said_to_be_without_it() {
    let (_, text) = shipped().iter().find(|(name, _)| name.starts_with("10")).unwrap();
    let voyage = simulate(&Scenario::from_toml(text).unwrap().with_duration(200.0), 1);
    let mut engine = Engine::new(EngineConfig::for_voyage(&voyage.header, 10.0));
    let mut modes = Vec::new();
    for received in voyage.received() {
        engine.handle(&received);
        while let Some(output) = engine.poll_output() {
            if let Output::Event(Event::ModeChanged { to, .. }) = output {
                modes.push(to);
            }
        }
    }
    let expected = [Mode::CoarseAlignment, Mode::InMotionAlignment, Mode::Aided];
    assert_eq!(modes, expected);
}
