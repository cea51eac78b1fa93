//! Headings: those of the voyage's reference, or of the truth if it has none.

use insd_base::{Attitude, Time, Voyage};
use insd_wire::nmea::{Hdt, HeadingMode, Pashr, Psxn, PsxnQuality, Talker, Ths};

use super::line::Line;
use super::sensor::{Encoding, SensorFeed};

/// A heading to be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Told {
    /// When.
    pub(super) time: Time,
    /// Heading, rad.
    pub(super) heading: f64,
    /// 1-sigma, rad.
    pub(super) std: f64,
}

/// 1-sigma of headings that are taken from the truth, rad.
const TRUTH_STD: f64 = 0.1 * insd_base::units::DEG;

/// What a compass of this voyage tells.
#[must_use]
pub(super) fn headings(voyage: &Voyage) -> Vec<Told> {
    let messages = voyage.reference.iter().map(|stamped| &stamped.message);
    let by_reference = messages.filter_map(|own| {
        let std = own.heading_std.unwrap_or(TRUTH_STD);
        Some(Told { time: own.time, heading: own.heading?, std })
    });
    let own: Vec<Told> = by_reference.collect();
    if !own.is_empty() {
        return own;
    }
    let by_truth = voyage.truth.iter().filter_map(|truth| {
        let heading = truth.attitude?.heading;
        Some(Told { time: truth.time, heading, std: TRUTH_STD })
    });
    by_truth.collect()
}

pub(super) fn encode(voyage: &Voyage, sensor: &SensorFeed, line: &mut Line) {
    for told in headings(voyage) {
        let heading = Some(told.heading);
        match sensor.encoding {
            Encoding::Hdt => line.send(told.time, Hdt { heading }.write(Talker::HE).as_bytes()),
            Encoding::Psxn => {
                line.send(told.time, motion(heading).write().as_bytes());
                line.send(told.time, quality().write().as_bytes());
            }
            Encoding::Pashr => {
                line.send(told.time, pashr(&told, sensor).write().as_bytes());
            }
            _ => {
                let ths = Ths { heading, mode: HeadingMode::Autonomous };
                line.send(told.time, ths.write(Talker::HE).as_bytes());
            }
        }
    }
}

fn motion(heading: Option<f64>) -> Psxn {
    let Attitude { roll, pitch, .. } = Attitude::default();
    Psxn::Motion { roll: Some(roll), pitch: Some(pitch), heading, heave: Some(0.0) }
}

fn quality() -> Psxn {
    let normal = Some(PsxnQuality::Normal);
    Psxn::Quality { horizontal: normal, height: normal, heading: normal, attitude: normal }
}

fn pashr(told: &Told, sensor: &SensorFeed) -> Pashr {
    Pashr {
        time: Some(sensor.calendar.civil(told.time).time),
        heading: Some(told.heading),
        roll: Some(0.0),
        pitch: Some(0.0),
        heave_as_sent: Some(0.0),
        roll_std: Some(told.std),
        pitch_std: Some(told.std),
        heading_std: Some(told.std),
        quality_digit: Some(1),
        status_digit: Some(0),
    }
}
