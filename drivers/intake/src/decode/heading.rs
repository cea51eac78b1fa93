//! Headings from compasses and other attitude sensors.

use insd_base::units::{wrap_pi, wrap_two_pi};
use insd_wire::binary::BinaryFault;
use insd_wire::gnss::novatel as oem;
use insd_wire::imu::stdbin::Telegram;
use insd_wire::imu::vectornav::VnMessage;
use insd_wire::motion::em::{EmAttitude, EmStatus};
use insd_wire::motion::kmb::Kmb;
use insd_wire::motion::tss1::Tss1;
use insd_wire::nmea::{
    HeadingMode, Pashr, PashrStatus, Position, PsatSource, Psxn, PsxnQuality, Sentence,
};

use super::reading::{HeadingReading, North, Reading};
use crate::config::SensorConfig;
use crate::event::Refusal;
use crate::status::ShownPart;

/// What a sensor said before that bears on what it says now.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct HeadingState {
    /// Quality of the heading by the last PSXN,20.
    psxn: Option<PsxnQuality>,
}

impl HeadingState {
    pub(super) fn sentence(
        &mut self,
        sentence: &Sentence,
        config: &SensorConfig,
    ) -> Result<Vec<Reading>, Refusal> {
        let tilt = match sentence {
            Sentence::Psxn(Psxn::Motion { roll, pitch, .. }) => Some((*roll, *pitch)),
            Sentence::Pashr(pashr) => Some((pashr.roll, pashr.pitch)),
            _ => None,
        };
        let reading = match sentence {
            Sentence::Hdt(hdt) => Some(told(hdt.heading, North::True, true)),
            Sentence::Ths(ths) => Some(told(ths.heading, North::True, is_measured(ths.mode))),
            Sentence::Hdg(hdg) => Some(match hdg.true_heading() {
                Some(heading) => told(Some(heading), North::Corrected, true),
                None => {
                    let reading = hdg.reading.map(|own| own + hdg.deviation.unwrap_or(0.0));
                    told(reading, North::Magnetic, true)
                }
            }),
            Sentence::Hdm(hdm) => Some(told(hdm.heading, North::Magnetic, true)),
            Sentence::Psxn(psxn) => self.psxn(psxn),
            Sentence::Pashr(pashr) => Some(of_pashr(pashr, config)),
            // a gyro that holds on while satellites are hidden is no measurement
            Sentence::PsatHpr(hpr) => {
                Some(told(hpr.heading, North::True, hpr.source == PsatSource::Satellites))
            }
            Sentence::PtnlAvr(avr) => Some(told(avr.heading(), North::True, true)),
            Sentence::PfecAttitude(attitude) => Some(told(attitude.heading, North::True, true)),
            _ => None,
        };
        match (reading, tilt) {
            (None, _) => Ok(vec![Reading::Idle]),
            (Some(reading), Some(tilt)) if reading.valid => with_tilt(reading, tilt, config),
            (Some(reading), _) => finished(reading, config),
        }
    }

    fn psxn(&mut self, psxn: &Psxn) -> Option<HeadingReading> {
        match psxn {
            Psxn::Quality { heading, .. } => {
                self.psxn = *heading;
                None
            }
            Psxn::Motion { heading, .. } => {
                Some(told(*heading, North::True, self.psxn != Some(PsxnQuality::Invalid)))
            }
            _ => None,
        }
    }
}

/// The heading of a SPAN system.
pub(super) fn novatel(bytes: &[u8], config: &SensorConfig) -> Result<Vec<Reading>, Refusal> {
    let log = oem::OemLog::read(bytes).map_err(|_| Refusal::Malformed)?;
    let Some((heading, std)) = log.attitude() else { return Ok(vec![Reading::Idle]) };
    finished(HeadingReading { std, ..told(heading, North::True, true) }, config)
}

/// Heading and tilt of KM binary.
pub(super) fn kmb(bytes: &[u8], config: &SensorConfig) -> Result<Vec<Reading>, Refusal> {
    let telegram = Kmb::read(bytes).map_err(|_| Refusal::Malformed)?;
    let std = telegram.sigma.heading.filter(|std| *std > 0.0);
    let heading = telegram.heading.map(|heading| heading.value);
    let tilt = telegram.tilt.map(|tilt| (tilt.value.roll, tilt.value.pitch));
    let reading = HeadingReading { std, ..told(heading, North::True, true) };
    with_tilt(reading, tilt.unzip(), config)
}

/// Heading and tilt of EM3000. A sensor that aligns or has an error stands behind neither.
pub(super) fn em(bytes: &[u8], config: &SensorConfig) -> Result<Vec<Reading>, Refusal> {
    let telegram = EmAttitude::read(bytes).map_err(|_| Refusal::Malformed)?;
    let valid = matches!(telegram.status, Some(EmStatus::Normal | EmStatus::Reduced));
    let shown = |angle: Option<f64>| angle.filter(|_| valid);
    let reading = told(telegram.heading, North::True, valid);
    with_tilt(reading, (shown(telegram.roll), shown(telegram.pitch)), config)
}

/// Heading, tilt and position of an Exail system.
pub(super) fn stdbin(bytes: &[u8], config: &SensorConfig) -> Result<Vec<Reading>, Refusal> {
    let telegram = Telegram::read(bytes).map_err(|_| Refusal::Malformed)?;
    let navigation = &telegram.navigation;
    let Some(attitude) = navigation.attitude else { return Ok(vec![Reading::Idle]) };
    let valid = telegram.is_aligned();
    let std = navigation.attitude_std.map(|[heading, ..]| heading).filter(|std| *std > 0.0);
    let reading = HeadingReading { std, ..told(Some(attitude.heading), North::True, valid) };
    let shown = |angle: f64| Some(angle).filter(|_| valid);
    let mut readings = with_tilt(reading, (shown(attitude.roll), shown(attitude.pitch)), config)?;
    // it is made of the same satellites as ours: something to watch, not to steer by
    let place = navigation
        .position
        .filter(|_| valid)
        .map(|at| Position { latitude: at.latitude, longitude: wrap_pi(at.longitude) });
    readings.extend(place.map(|place| Reading::Place(Some(place))));
    Ok(readings)
}

/// Heading and tilt of a VectorNav device. One without an INS has north from its magnetometers.
pub(super) fn vectornav(bytes: &[u8], config: &SensorConfig) -> Result<Vec<Reading>, Refusal> {
    let message = match VnMessage::read(bytes) {
        Err(BinaryFault::OtherMessage) => return Ok(vec![Reading::Idle]),
        read => read.map_err(|_| Refusal::Malformed)?,
    };
    let Some([yaw, pitch, roll]) = message.attitude else { return Ok(vec![Reading::Idle]) };
    let finite = |angle: f64| Some(angle).filter(|angle| angle.is_finite());
    let std = message.attitude_std.map(|[yaw, ..]| yaw).filter(|std| *std > 0.0);
    let reading = match message.ins_status {
        Some(_) => told(message.true_heading(), North::True, true),
        None => told(finite(yaw), North::Magnetic, true),
    };
    with_tilt(HeadingReading { std, ..reading }, (finite(roll), finite(pitch)), config)
}

/// Tilt of TSS1. A sensor that has not settled stands behind none.
pub(super) fn tss1(bytes: &[u8]) -> Result<Vec<Reading>, Refusal> {
    let telegram = Tss1::read(bytes).map_err(|_| Refusal::Malformed)?;
    let shown = |angle: f64| Some(angle).filter(|_| telegram.settled);
    let (roll, pitch) = (shown(telegram.roll), shown(telegram.pitch));
    Ok(vec![Reading::Shown(ShownPart::Tilt { roll, pitch })])
}

fn with_tilt(
    reading: HeadingReading,
    (roll, pitch): (Option<f64>, Option<f64>),
    config: &SensorConfig,
) -> Result<Vec<Reading>, Refusal> {
    let mut readings = finished(reading, config)?;
    readings.push(Reading::Shown(ShownPart::Tilt { roll, pitch }));
    Ok(readings)
}

/// A heading with the sensor's offset, if it is one that may be used.
pub(super) fn finished(
    reading: HeadingReading,
    config: &SensorConfig,
) -> Result<Vec<Reading>, Refusal> {
    if reading.north != North::True && !config.magnetic {
        return Err(Refusal::Magnetic);
    }
    let heading = wrap_two_pi(reading.heading + config.heading_offset_deg.to_radians());
    Ok(vec![Reading::Heading(HeadingReading { heading, ..reading })])
}

/// A sensor that says nothing of a heading says that it has none.
pub(super) fn told(heading: Option<f64>, north: North, valid: bool) -> HeadingReading {
    let valid = valid && heading.is_some();
    HeadingReading { heading: heading.unwrap_or(0.0), std: None, north, valid }
}

/// Autonomous and estimated headings are measured ones; typed-in, simulated and invalid ones are not.
fn is_measured(mode: HeadingMode) -> bool {
    matches!(mode, HeadingMode::Autonomous | HeadingMode::Estimated | HeadingMode::Simulator)
}

fn of_pashr(pashr: &Pashr, config: &SensorConfig) -> HeadingReading {
    let status = config.dialect.and_then(|dialect| pashr.status(dialect));
    let good = !matches!(
        status,
        Some(PashrStatus::Error | PashrStatus::GnssOnly | PashrStatus::Levelling)
    );
    let reading = told(pashr.heading, North::True, good);
    HeadingReading { std: pashr.heading_std.filter(|std| *std > 0.0), ..reading }
}
