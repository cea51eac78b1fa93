//! Values of a Signal K server.
//!
//! A server passes on what many devices tell, and `insd` itself, of this ship and of those that AIS hears, and tells old values again where it was
//! asked for values at a fixed pace. Taken are those of this ship, of the source that the installer names, each once: by the time that the server
//! has it told at.

use insd_base::LogReference;
use insd_base::units::wrap_two_pi;
use insd_wire::binary::BinaryFault;
use insd_wire::signalk::{ServerLine, ServerUpdate, ServerValue};

use super::heading::{finished, told};
use super::log::LogState;
use super::reading::{North, Reading};
use crate::config::{Kind, SensorConfig};
use crate::event::Refusal;

/// Every server's name for its own ship.
const SELF: &str = "vessels.self";

/// What was heard of a server.
#[derive(Clone, Debug, Default)]
pub(super) struct ServerState {
    /// The context of its own ship, from its greeting.
    own: Option<String>,
    /// The time of the value that was taken last.
    taken: Option<String>,
}

impl ServerState {
    /// The readings of a line.
    pub(super) fn line(
        &mut self,
        bytes: &[u8],
        config: &SensorConfig,
        log: &LogState,
    ) -> Result<Vec<Reading>, Refusal> {
        let (context, updates) = match ServerLine::read(bytes) {
            Ok(ServerLine::Delta { context, updates }) => (context, updates),
            Ok(ServerLine::Hello { own }) => {
                *self = ServerState { own: Some(own), ..ServerState::default() };
                return Ok(vec![Reading::Idle]);
            }
            Err(BinaryFault::OtherMessage) => return Ok(vec![Reading::Idle]),
            Err(_) => return Err(Refusal::Malformed),
        };
        let mut readings = Vec::new();
        for update in &updates {
            for value in update.values.iter().filter(|value| is_of(value, config)) {
                if !self.is_own(context.as_deref()) {
                    return Err(Refusal::OtherShip);
                }
                match self.refusal(update, config) {
                    Some(refusal) => readings.push(Reading::LeftOut(refusal)),
                    None => readings.extend(reading(value, config, log)?),
                }
            }
        }
        Ok(if readings.is_empty() { vec![Reading::Idle] } else { readings })
    }

    fn is_own(&self, context: Option<&str>) -> bool {
        context.is_none_or(|context| context == SELF || self.own.as_deref() == Some(context))
    }

    /// Why a value of an update is not taken; takes note of the update otherwise.
    fn refusal(&mut self, update: &ServerUpdate, config: &SensorConfig) -> Option<Refusal> {
        if config.source.as_ref() != Some(&update.source) {
            return Some(Refusal::OtherDevice);
        }
        if update.timestamp.is_some() && update.timestamp == self.taken {
            return Some(Refusal::Repeated);
        }
        self.taken.clone_from(&update.timestamp);
        None
    }
}

/// Whether a value is what the sensor measures.
fn is_of(value: &ServerValue, config: &SensorConfig) -> bool {
    let path = match config.kind {
        Kind::SignalkHeading if config.magnetic => ServerValue::HeadingMagnetic(None).path(),
        Kind::SignalkHeading => ServerValue::HeadingTrue(None).path(),
        Kind::SignalkLog => ServerValue::SpeedThroughWater(None).path(),
        _ => ServerValue::Position(None).path(),
    };
    value.path() == path
}

fn reading(
    value: &ServerValue,
    config: &SensorConfig,
    log: &LogState,
) -> Result<Vec<Reading>, Refusal> {
    Ok(match *value {
        ServerValue::HeadingTrue(heading) => {
            return finished(told(heading.map(wrap_two_pi), North::True, true), config);
        }
        ServerValue::HeadingMagnetic(heading) => {
            return finished(told(heading.map(wrap_two_pi), North::Magnetic, true), config);
        }
        ServerValue::SpeedThroughWater(speed) => {
            let velocity = [speed, None, None];
            vec![log.ship_velocity(velocity, LogReference::Water, speed.is_some())]
        }
        ServerValue::Position(place) => vec![Reading::Place(place)],
        ServerValue::Bad(_) => vec![Reading::LeftOut(Refusal::Field)],
    })
}
