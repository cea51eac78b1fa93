//! GNSS receivers.

use insd_wire::gnss::{nmea as sentences, sbf as septentrio, ubx as ublox};
use insd_wire::nmea::Sentence;

use super::Reading;
use crate::event::Refusal;

pub(super) fn ubx(bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
    let message = ublox::Message::read(bytes).map_err(|_| Refusal::Malformed)?;
    let part = message.part().map(Reading::Gnss);
    Ok(or_idle(part.into_iter().chain(message.pulse().map(Reading::Pulse)).collect()))
}

pub(super) fn sbf(bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
    let message = septentrio::Message::read(bytes).map_err(|_| Refusal::Malformed)?;
    let part = message.part().map(Reading::Gnss);
    Ok(or_idle(part.into_iter().chain(message.pulse().map(Reading::Pulse)).collect()))
}

pub(super) fn nmea(sentence: &Sentence) -> Vec<Reading> {
    or_idle(sentences::part(sentence).map(Reading::Gnss).into_iter().collect())
}

fn or_idle(readings: Vec<Reading>) -> Vec<Reading> {
    if readings.is_empty() { vec![Reading::Idle] } else { readings }
}
