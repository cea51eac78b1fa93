//! Frames into readings: one decoder for each sensor.

mod gnss;
mod heading;
mod imu;
mod log;
mod n2k;
mod reading;
mod signalk;

use insd_base::Time;
use insd_base::can::CanFrame;
use insd_n2k::BusMessage;
use insd_wire::gnss::gsof::Pages;
use insd_wire::imu::can::{CanImu, CanPart};
use insd_wire::nmea::{ChecksumPolicy, Frame as NmeaFrame, Pinsd, Rls, Sentence};

use crate::config::{Kind, SensorConfig};
use crate::device::Role;
use crate::event::Refusal;
use crate::ranging::HeadDistance;

pub use reading::{HeadingReading, North, Reading, ShipVelocity};

/// Reads the frames of one sensor.
#[derive(Clone, Debug)]
pub struct Decoder {
    config: SensorConfig,
    imu: imu::ImuState,
    log: log::LogState,
    heading: heading::HeadingState,
    /// Pages of a report of GSOF that is not complete.
    pages: Pages,
    n2k: n2k::N2kState,
    signalk: signalk::ServerState,
    can: Option<CanImu>,
}

impl Decoder {
    /// A decoder for a sensor as described.
    #[must_use]
    pub fn new(config: &SensorConfig) -> Self {
        Decoder {
            config: config.clone(),
            imu: imu::ImuState::new(config),
            log: log::LogState::new(config.kind, &config.mounting, config.velocity_std_mps),
            heading: heading::HeadingState::default(),
            pages: Pages::default(),
            n2k: n2k::N2kState::default(),
            signalk: signalk::ServerState::default(),
            can: config
                .layout
                .as_ref()
                .filter(|_| config.kind == Kind::CanImu)
                .map(|layout| CanImu::new(&layout.layout(), 1.0 / config.rate_hz)),
        }
    }

    /// The readings of a frame of the sensor's own protocol; none if it is not from this sensor.
    ///
    /// # Errors
    /// Why the frame is refused.
    pub fn read(&mut self, bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
        match self.config.kind {
            Kind::Sbg
            | Kind::Stdbin
            | Kind::Mip
            | Kind::Xbus
            | Kind::Kvh
            | Kind::Stim
            | Kind::Vectornav
            | Kind::NovatelImu => {
                self.imu.read(self.config.kind, bytes).map(|reading| vec![reading])
            }
            Kind::Ubx => gnss::ubx(bytes, self.config.raw),
            Kind::Sbf => gnss::sbf(bytes, self.config.raw),
            Kind::Gsof => gnss::gsof(&mut self.pages, bytes),
            Kind::Novatel => gnss::novatel(bytes),
            Kind::NovatelIns => heading::novatel(bytes, &self.config),
            Kind::Kmb => heading::kmb(bytes, &self.config),
            Kind::Em3000 => heading::em(bytes, &self.config),
            Kind::Tss1 => heading::tss1(bytes),
            Kind::StdbinIns => heading::stdbin(bytes, &self.config),
            Kind::VectornavIns => heading::vectornav(bytes, &self.config),
            Kind::Rtcm => Ok(gnss::rtcm(bytes)),
            Kind::RtcmBase => Ok(vec![Reading::Base(bytes.to_vec())]),
            Kind::Pd0 => self.log.pd0(bytes),
            Kind::Pd6 => self.log.pd6(bytes),
            Kind::Ad2cp => self.log.ad2cp(bytes),
            Kind::SignalkHeading | Kind::SignalkLog | Kind::SignalkPosition => {
                self.signalk.line(bytes, &self.config, &self.log)
            }
            _ => self.read_sentence(bytes),
        }
    }

    /// The reading of a CAN frame that began to come at an instant, and when its sample began to come.
    pub(crate) fn can_frame(
        &mut self,
        frame: &CanFrame,
        begun: Time,
    ) -> (Time, Result<Vec<Reading>, Refusal>) {
        let Some(imu) = &mut self.can else { return (begun, Ok(Vec::new())) };
        match imu.take(frame, begun) {
            Ok(CanPart::Sample { reading, begun }) => (begun, Ok(vec![Reading::Imu(reading)])),
            Ok(CanPart::Part | CanPart::Other) => (begun, Ok(Vec::new())),
            Err(_) => (begun, Err(Refusal::Malformed)),
        }
    }

    /// Samples so far of which a frame was missing.
    pub(crate) fn incomplete(&self) -> u64 {
        self.can.as_ref().map_or(0, CanImu::incomplete)
    }

    /// What a message of NMEA 2000 is to the sensor; `None` if it is nothing to it.
    pub(crate) fn role(&self, message: &BusMessage) -> Option<Role> {
        n2k::role(message, &self.config)
    }

    /// The readings of a message of the sensor's own device, which began to come at an instant, and
    /// when the first message of their epoch came.
    pub(crate) fn message(
        &mut self,
        message: &BusMessage,
        begun: Time,
    ) -> (Time, Result<Vec<Reading>, Refusal>) {
        self.n2k.message(message, begun, &self.config, &self.log)
    }

    /// From now on another device is the sensor.
    pub(crate) fn forget_device(&mut self) {
        self.n2k = n2k::N2kState::default();
    }

    fn read_sentence(&mut self, bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
        let policy = if self.config.no_checksum {
            ChecksumPolicy::Optional
        } else {
            ChecksumPolicy::Required
        };
        let frame = NmeaFrame::parse_with(bytes, policy).map_err(|_| Refusal::Malformed)?;
        if !self.hears(&frame) || !self.wants(&frame) {
            return Ok(Vec::new());
        }
        let sentence = Sentence::read_frame(&frame).map_err(|_| Refusal::Malformed)?;
        let mut readings = match self.config.kind {
            Kind::NmeaGnss | Kind::NmeaPosition => gnss::nmea(&sentence),
            Kind::NmeaLog | Kind::Nortek => self.log.sentence(&sentence)?,
            Kind::Manual => vec![manual(&sentence)],
            Kind::Ranging => distance(&sentence),
            Kind::Camera => vec![seen(&sentence)],
            Kind::Rls => between_targets(&sentence, &self.config)?,
            _ => self.heading.sentence(&sentence, &self.config)?,
        };
        let left_out = usize::from(frame.left_out().count);
        readings.extend(std::iter::repeat_n(Reading::LeftOut(Refusal::Field), left_out));
        Ok(readings)
    }

    /// Whether the sentence's talker is one of the sensor's; makers' own sentences have none.
    fn hears(&self, frame: &NmeaFrame<'_>) -> bool {
        let talkers = &self.config.talkers;
        talkers.is_empty()
            || frame.talker().is_none_or(|talker| talkers.iter().any(|own| own == talker.as_str()))
    }

    /// Whether the sentence is of those that the sensor's kind consists of.
    fn wants(&self, frame: &NmeaFrame<'_>) -> bool {
        let address = frame.address();
        let name = if frame.talker().is_some() { address.get(2..).unwrap_or("") } else { address };
        let own: &[&str] = match self.config.kind {
            Kind::NmeaGnss => {
                &["GGA", "GNS", "GLL", "RMC", "VTG", "ZDA", "GST", "GSA", "HDT", "THS"]
            }
            Kind::NmeaPosition => &["GGA", "GNS", "GLL", "RMC"],
            Kind::NmeaLog => &["VBW", "VHW"],
            Kind::Nortek => &["PNORBT6", "PNORBT7", "PNORBT8", "PNORBT9"],
            Kind::Compass => &["HDT", "THS", "HDG", "HDM"],
            Kind::Psxn => &["PSXN"],
            Kind::Pashr => &["PASHR"],
            Kind::Psat => &["PSAT"],
            Kind::Ptnl => &["PTNL"],
            Kind::Pfec => &["PFEC"],
            Kind::Manual | Kind::Ranging | Kind::Camera => &["PINSD"],
            Kind::Rls => &["RLS"],
            _ => &[],
        };
        own.contains(&name)
    }
}

/// What an operator says; half a statement says nothing.
fn manual(sentence: &Sentence) -> Reading {
    match sentence {
        Sentence::Pinsd(Pinsd::Fix { position: Some(position), std }) => {
            Reading::Fix(*position, *std)
        }
        Sentence::Pinsd(Pinsd::Heading { heading: Some(heading), std }) => {
            let (heading, std) = (*heading, *std);
            Reading::Heading(HeadingReading { heading, std, north: North::True, valid: true })
        }
        _ => Reading::Idle,
    }
}

/// A distance by the sentence of our own.
fn distance(sentence: &Sentence) -> Vec<Reading> {
    let Sentence::Pinsd(Pinsd::Range(told)) = sentence else { return vec![Reading::Idle] };
    let Some(head) = told.head else { return vec![Reading::Idle] };
    vec![Reading::Range(HeadDistance {
        head,
        distance: told.distance.filter(|_| told.valid),
        std: told.std.filter(|std| *std > 0.0),
        age: told.age.unwrap_or(0.0),
    })]
}

/// What the front end of a camera tells.
fn seen(sentence: &Sentence) -> Reading {
    match sentence {
        Sentence::Pinsd(Pinsd::Tracks(told)) => Reading::Tracks(Box::new(*told)),
        Sentence::Pinsd(Pinsd::Step(told)) => Reading::Step(Box::new(*told)),
        _ => Reading::Idle,
    }
}

/// A position and a heading between targets. The heading is that from axis A, and what the configuration adds makes it true; where there is
/// none, as with a single target, nothing is said of it.
fn between_targets(sentence: &Sentence, config: &SensorConfig) -> Result<Vec<Reading>, Refusal> {
    let Sentence::Rls(Rls { a, b, position_valid, bearing, bearing_valid, .. }) = sentence else {
        return Ok(vec![Reading::Idle]);
    };
    use heading::{finished, told};
    let along = |head: u32, value: Option<f64>| {
        let distance = value.filter(|_| *position_valid);
        Reading::Range(HeadDistance { head, distance, std: None, age: 0.0 })
    };
    let mut readings = vec![along(1, *a), along(2, *b)];
    if *bearing_valid && bearing.is_some() {
        readings.extend(finished(told(*bearing, North::True, true), config)?);
    }
    Ok(readings)
}
