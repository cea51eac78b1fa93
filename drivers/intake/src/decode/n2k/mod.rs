//! Devices of NMEA 2000: messages into readings.
//!
//! A field that is not available makes what it tells invalid, never zero.

mod gnss;

use insd_base::{LogReference, Time};
use insd_n2k::BusMessage;
use insd_n2k::pgn::{
    Attitude, Direction, DistanceLog, Heading, Known, North as N2kNorth, PositionRapid, RateOfTurn,
    Speed, SpeedComponents,
};
use insd_wire::nmea::Position;

use super::heading::{finished, told};
use super::log::{LogState, invalid};
use super::reading::{HeadingReading, North, Reading};
use crate::config::{Kind, SensorConfig};
use crate::device::Role;
use crate::event::Refusal;
use crate::status::ShownPart;

/// What a device said before that bears on what it says now.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct N2kState {
    gnss: gnss::GnssState,
    /// When the better message of two that tell the same came last: heading (127250), velocity over
    /// the bottom and through the water (130578).
    heading: Option<Time>,
    bottom: Option<Time>,
    water: Option<Time>,
}

/// What a message is to a sensor; `None` if the sensor does not listen to its group.
pub(super) fn role(message: &BusMessage, config: &SensorConfig) -> Option<Role> {
    let known = read(message, config.kind)?.ok();
    let Some(known) = known else { return Some(Role::SaysNothing) };
    let says = match &known {
        Known::GnssPosition(fix) => fix.latitude.and(fix.longitude).is_some(),
        Known::PositionRapid(place) => place.latitude.and(place.longitude).is_some(),
        Known::Heading(heading) => heading.heading.is_some() && heading.reference.is_some(),
        Known::Attitude(attitude) if config.yaw => attitude.yaw.is_some(),
        Known::Speed(speed) => speed.water.or(speed.ground).is_some(),
        Known::SpeedComponents(own) => components(own).iter().flatten().any(Option::is_some),
        _ => return Some(Role::Beside),
    };
    Some(if says { Role::Says } else { Role::SaysNothing })
}

/// The contents of a message, if its group is one of the kind's.
fn read(message: &BusMessage, kind: Kind) -> Option<Result<Known, insd_n2k::pgn::Short>> {
    let groups: &[u32] = match kind {
        Kind::N2kGnss => &[126_992, 129_026, 129_029, 129_033, 129_539, 129_542],
        Kind::N2kHeading => &[127_250, 127_251, 127_257],
        Kind::N2kLog => &[128_259, 128_275, 130_578],
        Kind::N2kPosition => &[129_025],
        _ => &[],
    };
    groups.contains(&message.pgn).then(|| Known::read(message.pgn, &message.data)).flatten()
}

impl N2kState {
    /// The readings of a message of the sensor's own device, and when the first message of their epoch
    /// came.
    pub(super) fn message(
        &mut self,
        message: &BusMessage,
        begun: Time,
        config: &SensorConfig,
        log: &LogState,
    ) -> (Time, Result<Vec<Reading>, Refusal>) {
        let readings = self.readings(message, begun, config, log);
        (self.gnss.first().unwrap_or(begun), readings)
    }

    fn readings(
        &mut self,
        message: &BusMessage,
        begun: Time,
        config: &SensorConfig,
        log: &LogState,
    ) -> Result<Vec<Reading>, Refusal> {
        let Some(read) = read(message, config.kind) else { return Ok(Vec::new()) };
        match read.map_err(|_| Refusal::Malformed)? {
            Known::Heading(heading) => self.heading(&heading, begun, config),
            Known::Attitude(attitude) => self.attitude(&attitude, begun, config),
            Known::RateOfTurn(RateOfTurn { rate, .. }) => {
                Ok(vec![Reading::Shown(ShownPart::RateOfTurn(rate))])
            }
            Known::DistanceLog(DistanceLog { log, trip, .. }) => {
                Ok(vec![Reading::Shown(ShownPart::Distance { log, trip })])
            }
            Known::SpeedComponents(own) => Ok(self.components(&own, begun, log)),
            Known::Speed(speed) => Ok(self.speed(&speed, begun, config, log)),
            Known::PositionRapid(place) => Ok(vec![Reading::Place(position(&place))]),
            other => self.gnss.known(&other, begun, config),
        }
    }

    fn heading(
        &mut self,
        told_by: &Heading,
        begun: Time,
        config: &SensorConfig,
    ) -> Result<Vec<Reading>, Refusal> {
        self.heading = Some(begun);
        let deviation = told_by.deviation.unwrap_or(0.0);
        let (heading, north) = match (told_by.reference, told_by.variation) {
            (Some(N2kNorth::True), _) => (told_by.heading, North::True),
            (Some(N2kNorth::Magnetic), Some(variation)) => {
                (told_by.heading.map(|own| own + deviation + variation), North::Corrected)
            }
            (Some(N2kNorth::Magnetic), None) => {
                (told_by.heading.map(|own| own + deviation), North::Magnetic)
            }
            (None, _) => (None, North::True),
        };
        finished(told(heading, north, true), config)
    }

    /// Roll and pitch are shown; the yaw is the heading of a device that sends no better one.
    fn attitude(
        &self,
        attitude: &Attitude,
        begun: Time,
        config: &SensorConfig,
    ) -> Result<Vec<Reading>, Refusal> {
        let tilt = ShownPart::Tilt { roll: attitude.roll, pitch: attitude.pitch };
        let mut readings = vec![Reading::Shown(tilt)];
        if config.yaw && !config.is_recent(self.heading, begun) {
            let reading: HeadingReading = told(attitude.yaw, North::True, true);
            readings.extend(finished(reading, config)?);
        }
        Ok(readings)
    }

    fn components(&mut self, own: &SpeedComponents, begun: Time, log: &LogState) -> Vec<Reading> {
        let [bottom, water] = components(own);
        let mut readings = Vec::new();
        let parts = [
            (bottom, LogReference::Bottom, &mut self.bottom),
            (water, LogReference::Water, &mut self.water),
        ];
        for (velocity, reference, last) in parts {
            if velocity.iter().any(Option::is_some) {
                *last = Some(begun);
                readings.push(log.turned_velocity(velocity, reference));
            }
        }
        if readings.is_empty() { vec![invalid(LogReference::Bottom)] } else { readings }
    }

    /// Speeds along the keel where the device tells no components. The field has no sign: astern only
    /// where the device says so.
    fn speed(
        &self,
        speed: &Speed,
        begun: Time,
        config: &SensorConfig,
        log: &LogState,
    ) -> Vec<Reading> {
        let sign = if speed.direction == Some(Direction::Reverse) { -1.0 } else { 1.0 };
        let parts = [
            (speed.ground, LogReference::Bottom, self.bottom),
            (speed.water, LogReference::Water, self.water),
        ];
        let better = parts.iter().any(|(_, _, last)| config.is_recent(*last, begun));
        let told = parts.into_iter().filter_map(|(value, reference, last)| {
            let value = value.filter(|_| !config.is_recent(last, begun))?;
            let velocity = [Some(sign * value), None, None];
            Some(log.ship_velocity(velocity, reference, true))
        });
        let readings: Vec<Reading> = told.collect();
        match readings.is_empty() {
            true if better => vec![Reading::Idle],
            true => vec![invalid(LogReference::Water)],
            false => readings,
        }
    }
}

/// Over the bottom and through the water: forward, starboard, down.
fn components(own: &SpeedComponents) -> [[Option<f64>; 3]; 2] {
    [
        [own.forward_ground, own.starboard_ground, None],
        [own.forward_water, own.starboard_water, None],
    ]
}

fn position(place: &PositionRapid) -> Option<Position> {
    let (latitude, longitude) = place.latitude.zip(place.longitude)?;
    Some(Position { latitude, longitude })
}
