//! GSA: satellites used and dilution of precision.
//!
//! ```text
//! $GNGSA,a,n,ss,...,ss,x.x,x.x,x.x,h*hh
//!        1 2 3      14 15  16  17  18
//! 1      A receiver chooses 2D or 3D, M set by hand
//! 2      1 no fix, 2 two-dimensional, 3 three-dimensional
//! 3..14  satellites used
//! 15..17 position, horizontal and vertical dilution of precision
//! 18     system, hexadecimal: 1 GPS, 2 GLONASS, 3 Galileo, 4 BeiDou, 5 QZSS, 6 NavIC; absent before
//!        NMEA 4.1
//! ```
//! A receiver of several systems sends one sentence for each. SiRF-III receivers of 24 channels send
//! 24 satellites (field 27 is then the first dilution). Some receivers send a fourth dilution, of time,
//! in field 18, which is no system. The dimension must be good; any other field that is bad is left out.

use super::decimal::{Form, parse_digits};
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{NmeaLine, Talker};

const DOP: Form = Form { decimals: 2, width: 1, limit: 9999.9 };

/// Satellites of the standard's sentence.
const PLACES: usize = 12;

/// Most satellites that are read.
pub const MAX_USED: usize = 24;

/// Dimensions of a fix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum FixDimension {
    /// 1: no fix.
    #[default]
    None,
    /// 2: the height is assumed.
    Two,
    /// 3.
    Three,
}

/// Satellites used and dilution of precision.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Gsa {
    /// Whether the receiver itself chooses between two and three dimensions; unknown is written as M.
    pub automatic: Option<bool>,
    /// Dimensions of the fix.
    pub dimension: FixDimension,
    /// Numbers of the satellites used, by their place in the sentence; the first 12 are written.
    pub satellites: [Option<u16>; MAX_USED],
    /// Position dilution of precision.
    pub pdop: Option<f64>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// Vertical dilution of precision.
    pub vdop: Option<f64>,
    /// Number of the system, 1 to 15.
    pub system: Option<u8>,
}

impl Gsa {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "GSA";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 82;

    /// Writes the sentence, dilutions to 0.01.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.letter(if self.automatic == Some(true) { b'A' } else { b'M' });
            line.letter(b'1' + self.dimension as u8);
            for satellite in self.satellites.iter().take(PLACES) {
                line.whole(satellite.map(u32::from), 2, 999);
            }
            for dop in [self.pdop, self.hdop, self.vdop] {
                line.magnitude(dop, DOP);
            }
            line.hexadecimal(self.system);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let places = if fields.remaining() >= MAX_USED + 5 { MAX_USED } else { PLACES };
        let automatic = fields.optional(|own| {
            own.convert(|text| match text {
                "A" => Some(true),
                "M" => Some(false),
                _ => None,
            })
        })?;
        let dimension = match fields.text()? {
            "1" => FixDimension::None,
            "2" => FixDimension::Two,
            "3" => FixDimension::Three,
            _ => return Err(fields.malformed()),
        };
        let mut satellites = [None; MAX_USED];
        for satellite in satellites.iter_mut().take(places) {
            let id = fields.optional(|own| own.whole(999))?;
            *satellite = id.and_then(|id| u16::try_from(id).ok());
        }
        let dop = |fields: &mut Fields<'_>| fields.number_in(0.0..=DOP.limit);
        Ok(Gsa {
            automatic,
            dimension,
            satellites,
            pdop: fields.optional(dop)?,
            hdop: fields.optional(dop)?,
            vdop: fields.optional(dop)?,
            system: if fields.has_more() { fields.optional(hexadecimal)? } else { None },
        })
    }
}

/// A field of one hexadecimal digit.
pub(crate) fn hexadecimal(fields: &mut Fields<'_>) -> Result<Option<u8>, NmeaFault> {
    fields.convert(|text| match text.as_bytes() {
        [digit] => (*digit as char).to_digit(16).and_then(|digit| u8::try_from(digit).ok()),
        [_, _] => parse_digits(text).filter(|id| *id < 16).and_then(|id| u8::try_from(id).ok()),
        _ => None,
    })
}
