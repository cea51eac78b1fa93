//! GNSS receivers.

use insd_wire::gnss::gsof::{GsofReport, Page, Pages};
use insd_wire::gnss::{nmea as sentences, novatel as oem, sbf as septentrio, ubx as ublox};
use insd_wire::nmea::Sentence;
use insd_wire::stream::Protocol;

use super::reading::Reading;
use crate::event::Refusal;
use crate::satellites::{RawReading, RawUse};

pub(super) fn ubx(bytes: &[u8], raw: RawUse) -> Result<Vec<Reading>, Refusal> {
    let message = ublox::UbxMessage::read(bytes).map_err(|_| Refusal::Malformed)?;
    let part = message.part().map(Reading::Gnss);
    let pulse = message.pulse().map(Reading::Pulse);
    let is_epoch = matches!(message, ublox::UbxMessage::RxmRawx(_));
    let told = raw_reading(raw, is_epoch, || RawReading::of_ubx(&message));
    Ok(or_idle(part.into_iter().chain(pulse).chain(told).collect()))
}

pub(super) fn sbf(bytes: &[u8], raw: RawUse) -> Result<Vec<Reading>, Refusal> {
    let message = septentrio::SbfMessage::read(bytes).map_err(|_| Refusal::Malformed)?;
    let part = message.part().map(Reading::Gnss);
    let pulse = message.pulse().map(Reading::Pulse);
    let is_epoch = matches!(message, septentrio::SbfMessage::MeasEpoch(_));
    let told = raw_reading(raw, is_epoch, || RawReading::of_sbf(&message));
    Ok(or_idle(part.into_iter().chain(pulse).chain(told).collect()))
}

/// A report, once all its pages have come.
pub(super) fn gsof(pages: &mut Pages, bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
    let page = Page::open(bytes).map_err(|_| Refusal::Malformed)?;
    let Some(records) = pages.take(&page) else { return Ok(vec![Reading::Idle]) };
    let report = GsofReport::read(&records).map_err(|_| Refusal::Malformed)?;
    let parts = report.part().into_iter().chain(report.heading());
    Ok(or_idle(parts.map(Reading::Gnss).collect()))
}

/// A place of the receiver's own inertial filter is not one by satellites, and is left out.
pub(super) fn novatel(bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
    let log = oem::OemLog::read(bytes).map_err(|_| Refusal::Malformed)?;
    let inertial = matches!(&log.body, oem::OemBody::Position(place) if place.is_inertial());
    let left_out = inertial.then_some(Reading::LeftOut(Refusal::Invalid));
    Ok(or_idle(log.part().map(Reading::Gnss).into_iter().chain(left_out).collect()))
}

/// What a message says of satellites, where that is wanted. An epoch says nothing only where the receiver does not know when it was.
fn raw_reading(
    raw: RawUse,
    is_epoch: bool,
    reading: impl FnOnce() -> Option<RawReading>,
) -> Option<Reading> {
    if raw == RawUse::Off {
        return None;
    }
    let timeless = is_epoch.then_some(Reading::LeftOut(Refusal::NoTime));
    reading().map(Reading::Raw).or(timeless)
}

pub(super) fn rtcm(bytes: &[u8]) -> Vec<Reading> {
    let reading = RawReading::of_frame(Protocol::Rtcm, bytes);
    or_idle(reading.map(Reading::Raw).into_iter().collect())
}

pub(super) fn nmea(sentence: &Sentence) -> Vec<Reading> {
    or_idle(sentences::part(sentence).map(Reading::Gnss).into_iter().collect())
}

fn or_idle(readings: Vec<Reading>) -> Vec<Reading> {
    if readings.is_empty() { vec![Reading::Idle] } else { readings }
}
