//! XDR: measurements of transducers.
//!
//! ```text
//! $IIXDR,a,x.x,a,c--c,...*hh
//!        1 2   3 4
//! 1   kind: A angle, D displacement, and others
//! 2   value; an angle is negative anti-clockwise
//! 3   unit: D degrees, M metres, and others; may be empty
//! 4   name of the transducer
//! ... further measurements, four fields each
//! ```
//! No two makers agree on names: `PTCH`, `PITCH`, `Pitch`; `ROLL`, `HEEL`; so they are configurable.
//! NMEA's own list (its bulletin of 2019) has `Pitch`, `Roll`, `Heel`, `Yaw`; it has none for heave. The
//! signs of pitch and roll are as little agreed upon; nothing says whether the bow up is clockwise.
//!
//! Sources: gpsd `www/NMEA.adoc`; the bulletin; logs of gpsd.

use super::decimal::{Form, parse};
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Composer, MAX_LEN, NmeaLine, Talker};
use super::parts::letter_of;
use super::text::Text;

/// Most measurements of a sentence.
pub const MAX_MEASUREMENTS: usize = 6;

/// Most characters of a transducer's name.
const NAME: usize = 16;

/// Greatest value, and most decimals of it.
const LIMIT: f64 = 9_999_999.0;
const DECIMALS: u8 = 6;

/// A measurement of a transducer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct XdrMeasurement {
    /// Kind: a letter or digit.
    pub kind: Option<u8>,
    /// Value in the unit of the sentence; see [`XdrMeasurement::angle`] and
    /// [`XdrMeasurement::displacement`].
    pub value: Option<f64>,
    /// Digits after the point, at most 6.
    pub decimals: u8,
    /// Unit: a letter or digit.
    pub unit: Option<u8>,
    /// Name of the transducer.
    pub name: Text<NAME>,
}

/// Measurements.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Xdr {
    /// The measurements, one at least, no gap but at the end. Those that do not fit into 82 bytes, even
    /// without decimals, are not written.
    pub measurements: [Option<XdrMeasurement>; MAX_MEASUREMENTS],
}

impl XdrMeasurement {
    /// An angle, rad, that is written in degrees.
    #[must_use]
    pub fn of_angle(name: Text<NAME>, angle: Option<f64>, decimals: u8) -> Self {
        let value = angle.map(f64::to_degrees);
        XdrMeasurement { kind: Some(b'A'), value, decimals, unit: Some(b'D'), name }
    }

    /// A displacement, m.
    #[must_use]
    pub fn of_displacement(name: Text<NAME>, metres: Option<f64>, decimals: u8) -> Self {
        XdrMeasurement { kind: Some(b'D'), value: metres, decimals, unit: Some(b'M'), name }
    }

    /// The angle, rad, if it is one in degrees.
    #[must_use]
    pub fn angle(&self) -> Option<f64> {
        let is_angle = (self.kind, self.unit) == (Some(b'A'), Some(b'D'));
        self.value.filter(|_| is_angle).map(f64::to_radians)
    }

    /// The displacement, m, if it is one in metres.
    #[must_use]
    pub fn displacement(&self) -> Option<f64> {
        self.value.filter(|_| (self.kind, self.unit) == (Some(b'D'), Some(b'M')))
    }

    fn write(&self, line: &mut Composer) {
        let plain = |letter: Option<u8>| letter.filter(u8::is_ascii_alphanumeric);
        let form = Form { decimals: self.decimals.min(DECIMALS), width: 1, limit: LIMIT };
        line.optional_letter(plain(self.kind));
        line.number(self.value, form);
        line.optional_letter(plain(self.unit));
        line.escaped(&self.name);
    }

    fn read(fields: &mut Fields<'_>) -> Result<Self, NmeaFault> {
        let kind = letter(fields)?;
        let value = fields.convert(|text| {
            let decimals = text.split_once('.').map_or(0, |(_, fraction)| fraction.len());
            let value = parse(text).filter(|value| value.abs() <= LIMIT)?;
            Some((value, u8::try_from(decimals).ok()?.min(DECIMALS)))
        })?;
        let unit = letter(fields)?;
        let name = fields.convert(Text::read)?.unwrap_or_default();
        let (value, decimals) = value.map_or((None, 0), |(value, count)| (Some(value), count));
        Ok(XdrMeasurement { kind, value, decimals, unit, name })
    }
}

impl Xdr {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "XDR";

    /// Bytes of the longest sentence, CR LF included: names are anyone's choice.
    pub const LONGEST: usize = MAX_LEN;

    /// Writes the sentence, each value to its own decimals if they fit.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        let all = self.measurements.iter().flatten().count();
        let fitting = (0..=all).rev().find_map(|count| {
            NmeaLine::try_compose(talker, Self::FORMATTER, |line| {
                self.measurements.iter().flatten().take(count).for_each(|one| one.write(line));
            })
        });
        fitting.unwrap_or_else(|| NmeaLine::compose(talker, Self::FORMATTER, |_| {}))
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields; [`NmeaFault::Malformed`] for more than [`MAX_MEASUREMENTS`].
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let mut measurements = [None; MAX_MEASUREMENTS];
        measurements[0] = Some(XdrMeasurement::read(&mut fields)?);
        for measurement in measurements.iter_mut().skip(1) {
            if fields.has_more() {
                *measurement = Some(XdrMeasurement::read(&mut fields)?);
            }
        }
        if fields.has_more() {
            return Err(fields.malformed());
        }
        Ok(Xdr { measurements })
    }
}

fn letter(fields: &mut Fields<'_>) -> Result<Option<u8>, NmeaFault> {
    fields.convert(|text| letter_of(text).filter(u8::is_ascii_alphanumeric))
}
