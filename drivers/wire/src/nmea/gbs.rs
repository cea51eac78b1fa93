//! GBS: what a receiver's integrity monitoring makes of its position.
//!
//! ```text
//! $GPGBS,hhmmss.ss,x.x,x.x,x.x,ss,x.x,x.x,x.x,h,h*hh
//!        1         2   3   4   5  6   7   8   9 10
//! 1    UTC of the position
//! 2..4 expected error of latitude, longitude and altitude, m; some receivers send signs
//! 5    number of the satellite that is most likely to have failed
//! 6    probability that its failure is missed
//! 7, 8 estimate of its bias and the 1-sigma of that, m
//! 9    its system, 10 its signal, hexadecimal; absent before NMEA 4.1
//! ```
//! Sources: manuals of u-blox, Trimble, Quectel and NavCom receivers, whose examples are read by tests.

use super::civil::TimeOfDay;
use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::gsa::hexadecimal;
use super::line::{NmeaLine, Talker};

const METRES: Form = Form { decimals: 2, width: 1, limit: 99_999.9 };
const PROBABILITY: Form = Form { decimals: 2, width: 1, limit: 1.0 };

/// Expected errors of a position.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Gbs {
    /// UTC of the position.
    pub time: Option<TimeOfDay>,
    /// Expected error of the latitude, m, as it was sent: 1-sigma, or an error with its sign.
    pub latitude_error: Option<f64>,
    /// Expected error of the longitude, m.
    pub longitude_error: Option<f64>,
    /// Expected error of the altitude, m.
    pub altitude_error: Option<f64>,
    /// Satellite that is most likely to have failed, at most 999.
    pub satellite: Option<u16>,
    /// Probability that its failure is missed, 0 to 1.
    pub missed_detection: Option<f64>,
    /// Estimate of its bias, m.
    pub bias: Option<f64>,
    /// 1-sigma of the estimate, m.
    pub bias_std: Option<f64>,
    /// Number of its system, 0 to 15, as in [`super::Gsa`].
    pub system: Option<u8>,
    /// Number of its signal, 0 to 15.
    pub signal: Option<u8>,
}

impl Gbs {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "GBS";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 73;

    /// Writes the sentence: time truncated to 0.01 s, all else to 0.01. System and signal are written
    /// if one of them is known.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.time_of_day(self.time);
            for error in [self.latitude_error, self.longitude_error, self.altitude_error] {
                line.number(error, METRES);
            }
            line.whole(self.satellite.map(u32::from), 2, 999);
            line.magnitude(self.missed_detection, PROBABILITY);
            line.number(self.bias, METRES);
            line.magnitude(self.bias_std, METRES);
            let known = |number: Option<u8>| number.filter(|number| *number < 16);
            if known(self.system).or(known(self.signal)).is_some() {
                for number in [self.system, self.signal] {
                    line.optional_letter(known(number).map(hexadecimal_digit));
                }
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let metres = |fields: &mut Fields<'_>| fields.number_in(-METRES.limit..=METRES.limit);
        let satellite = |fields: &mut Fields<'_>| fields.whole(999);
        Ok(Gbs {
            time: fields.time_of_day()?,
            latitude_error: fields.optional(metres)?,
            longitude_error: fields.optional(metres)?,
            altitude_error: fields.optional(metres)?,
            satellite: fields.optional(satellite)?.and_then(|id| u16::try_from(id).ok()),
            missed_detection: fields.optional(|own| own.number_in(0.0..=PROBABILITY.limit))?,
            bias: fields.optional(metres)?,
            bias_std: fields.optional(|own| own.number_in(0.0..=METRES.limit))?,
            system: if fields.has_more() { fields.optional(hexadecimal)? } else { None },
            signal: if fields.has_more() { fields.optional(hexadecimal)? } else { None },
        })
    }
}

fn hexadecimal_digit(number: u8) -> u8 {
    if number < 10 { b'0' + number } else { b'A' + (number - 10) }
}
