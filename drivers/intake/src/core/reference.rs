//! Velocities, headings and positions: most are timed by their receipt.

use insd_base::{
    ExternalReference, Geodetic, GpsTime, LogReference, LogVelocity, Message, Source, Span, Stamp,
    Time,
};
use insd_wire::nmea::Position;

use super::{Came, Core};
use crate::choice::Quantity;
use crate::decode::{HeadingReading, ShipVelocity};
use crate::event::Refusal;

impl Core {
    pub(super) fn manual(
        &mut self,
        index: usize,
        stamp: &Stamp,
        came: Came,
        position: Position,
        std: Option<f64>,
    ) {
        let now = stamp.monotonic;
        let Position { latitude, longitude } = position;
        let default = self.sensors[index].config.position_std_m;
        self.validity(index, now, true, 0);
        let reference = ExternalReference {
            time: came.begun,
            position: Some(Geodetic { latitude, longitude, height: 0.0 }),
            position_std: std.filter(|std| *std > 0.0).or(Some(default)),
            ..ExternalReference::default()
        };
        self.reference(Quantity::Position, index, now, true, reference);
    }

    /// A position that is timed by its receipt.
    pub(super) fn place(
        &mut self,
        index: usize,
        stamp: &Stamp,
        came: Came,
        place: Option<Position>,
    ) {
        let now = stamp.monotonic;
        let valid = place.is_some();
        self.validity(index, now, valid, 0);
        if valid && !self.is_fresh(Quantity::Position, index, came) {
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        let config = &self.sensors[index].config;
        let height = 0.0;
        let reference = ExternalReference {
            time: came.begun - Span::from_seconds(config.latency_s),
            position: place.map(|at| Geodetic {
                latitude: at.latitude,
                longitude: at.longitude,
                height,
            }),
            position_std: Some(config.position_std_m),
            position_lasting_std: config.position_lasting_std_m,
            ..ExternalReference::default()
        };
        self.reference(Quantity::Position, index, now, valid, reference);
    }

    pub(super) fn velocity(
        &mut self,
        index: usize,
        stamp: &Stamp,
        came: Came,
        told: &ShipVelocity,
    ) {
        let now = stamp.monotonic;
        let latency = self.sensors[index].config.latency_s + told.age;
        let by_receipt = came.begun - Span::from_seconds(latency);
        let own = told.gps.filter(|gps| self.fits(*gps, came.begun));
        let own = own.and_then(|gps| self.utc.time_of(gps));
        self.validity(index, now, told.valid, 0);
        let quantity = match told.reference {
            LogReference::Bottom => Quantity::BottomVelocity,
            LogReference::Water => Quantity::WaterVelocity,
        };
        let used = self.choose(quantity, index, told.valid, now);
        if !told.valid {
            self.refuse(index, Refusal::Invalid);
        } else if used && own.is_none() && !self.is_fresh(quantity, index, came) {
            self.refuse(index, Refusal::TimeDoubted);
        } else if used {
            let time = own.unwrap_or(by_receipt);
            let [u, v, w] = told.velocity;
            let (std, reference) = (Some(told.std), told.reference);
            let message = Message::Log(LogVelocity { time, u, v, w, std, reference });
            self.pass(index, now, Source::Log(self.sensors[index].number), message);
        } else {
            self.refuse(index, Refusal::NotChosen);
        }
    }

    /// Whether an instant that a log tells is near its receipt.
    pub(super) fn fits(&self, gps: GpsTime, begun: Time) -> bool {
        let late = self.utc.time_of(gps).map(|time| (begun - time).as_seconds());
        late.is_some_and(|late| (-0.1..2.5).contains(&late))
    }

    /// Whether a reading that is timed by its receipt is not one that waited, or one told again.
    pub(super) fn is_fresh(&mut self, quantity: Quantity, index: usize, came: Came) -> bool {
        self.sensors[index].paces[quantity as usize].is_fresh(came.begun)
    }

    pub(super) fn heading(
        &mut self,
        index: usize,
        stamp: &Stamp,
        came: Came,
        told: &HeadingReading,
    ) {
        let now = stamp.monotonic;
        let config = &self.sensors[index].config;
        let time = came.begun - Span::from_seconds(config.latency_s);
        let std = told.std.unwrap_or(config.heading_std_deg.to_radians());
        let Some((heading, std)) = self.variation.to_true(told, std) else {
            self.refuse(index, Refusal::Magnetic);
            return;
        };
        self.validity(index, now, told.valid, 0);
        if told.valid && !self.is_fresh(Quantity::Heading, index, came) {
            self.refuse(index, Refusal::TimeDoubted);
            return;
        }
        let reference = ExternalReference {
            time,
            heading: Some(heading),
            heading_std: Some(std),
            ..ExternalReference::default()
        };
        self.reference(Quantity::Heading, index, now, told.valid, reference);
    }

    pub(super) fn reference(
        &mut self,
        quantity: Quantity,
        index: usize,
        now: Time,
        valid: bool,
        reference: ExternalReference,
    ) {
        let used = self.choose(quantity, index, valid, now);
        if !valid {
            self.refuse(index, Refusal::Invalid);
        } else if self.sensors[index].watched {
            self.watch_reference(index, &reference);
        } else if used {
            let number = u8::try_from(index).unwrap_or(u8::MAX);
            self.pass(index, now, Source::Reference(number), Message::Reference(reference));
        } else {
            self.refuse(index, Refusal::NotChosen);
        }
    }
}
