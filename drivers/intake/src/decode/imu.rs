//! IMUs.

use insd_base::Span;
use insd_wire::binary::BinaryFault;
use insd_wire::gnss::novatel;
use insd_wire::imu::kvh::{KvhFormat, KvhMessage};
use insd_wire::imu::sbg::TimeReference;
use insd_wire::imu::stim::{StimConfiguration, StimDatagram, StimFormat};
use insd_wire::imu::vectornav::VnMessage;
use insd_wire::imu::{ImuReading, mip, sbg, stdbin, xbus};

use super::reading::Reading;
use crate::config::{Kind, SensorConfig};
use crate::event::Refusal;

/// What an IMU's messages must be read with.
#[derive(Clone, Debug)]
pub(super) struct ImuState {
    kvh: KvhFormat,
    stim: Option<StimFormat>,
    /// Which UTC belongs to which count of an SBG unit's clock.
    reference: Option<TimeReference>,
}

impl ImuState {
    pub(super) fn new(config: &SensorConfig) -> Self {
        let interval = 1.0 / config.rate_hz;
        ImuState {
            kvh: config.kvh.format(interval),
            stim: config.stim.format(interval),
            reference: None,
        }
    }

    pub(super) fn read(&mut self, kind: Kind, bytes: &[u8]) -> Result<Reading, Refusal> {
        let reading = match kind {
            Kind::Sbg => self.sbg(bytes)?,
            Kind::Stdbin => stdbin::Telegram::read(bytes).map_err(malformed)?.reading(),
            Kind::Mip => mip::Packet::read(bytes).map_err(malformed)?.reading(),
            Kind::Xbus => xbus::MtData2::read(bytes).map_err(malformed)?.reading(),
            Kind::Vectornav => match VnMessage::read(bytes) {
                Err(BinaryFault::OtherMessage) => None,
                read => read.map_err(malformed)?.reading(),
            },
            Kind::NovatelImu => novatel::OemLog::read(bytes).map_err(malformed)?.imu(),
            Kind::Kvh => Some(KvhMessage::read(bytes).map_err(malformed)?.reading(&self.kvh)),
            _ => self.stim(bytes)?,
        };
        Ok(reading.map_or(Reading::Idle, Reading::Imu))
    }

    fn sbg(&mut self, bytes: &[u8]) -> Result<Option<ImuReading>, Refusal> {
        let message = sbg::SbgMessage::read(bytes).map_err(malformed)?;
        if let sbg::SbgMessage::Time(reference) = &message {
            self.reference = Some(*reference);
        }
        let reading = message.reading();
        Ok(reading.map(|reading| ImuReading { utc: self.utc_of(&reading), ..reading }))
    }

    /// UTC of a reading, by the last pair of clock and UTC that the unit told.
    fn utc_of(&self, reading: &ImuReading) -> Option<insd_base::UtcTime> {
        let reference = self.reference?;
        let (told, now) = (reference.device_time(), reading.device_time?);
        let modulus = now.ticks.modulus;
        let ahead = (now.ticks.value + modulus - told.ticks.value) % modulus;
        let signed = if ahead > modulus / 2 { ahead as f64 - modulus as f64 } else { ahead as f64 };
        Some(reference.utc()?.plus(Span::from_seconds(signed * now.tick)))
    }

    fn stim(&mut self, bytes: &[u8]) -> Result<Option<ImuReading>, Refusal> {
        if let Ok(told) = StimConfiguration::read(bytes) {
            let interval = self.stim.and_then(|own| own.interval).or(told.format.interval);
            self.stim = Some(StimFormat { interval, ..told.format });
            return Ok(None);
        }
        let datagram = StimDatagram::read(bytes).map_err(malformed)?;
        Ok(self.stim.as_ref().and_then(|format| datagram.reading(format)))
    }
}

fn malformed<E>(_: E) -> Refusal {
    Refusal::Malformed
}
