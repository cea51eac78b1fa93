//! DTM: datum of the positions that follow.
//!
//! ```text
//! $GPDTM,ccc,a,x.x,a,x.x,a,x.x,ccc*hh
//!        1   2 3   4 5   6 7   8
//! 1    datum in use: W84 WGS 84, W72 WGS 72, S85 SGS 85, P90 PE 90, 999 the user's, or another code
//! 2    subdivision of the datum
//! 3, 4 offset of latitude, minutes, N or S
//! 5, 6 offset of longitude, minutes, E or W
//! 7    offset of altitude, m
//! 8    reference datum, mostly W84
//! ```
//! Offset: what must be added to a position in the reference datum to get one in the datum in use.
//! A Saab R4 sends `W84,C` alone; what is absent is unknown.

use super::decimal::Form;
use super::fault::Fault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Line, Talker};

const OFFSET: Form = Form { decimals: 4, width: 1, limit: 60.0 };
const ALTITUDE: Form = Form { decimals: 2, width: 1, limit: 9999.9 };

/// Code of a datum: three letters or digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Datum([u8; 3]);

impl Datum {
    /// WGS 84, the datum of everything here.
    pub const WGS84: Datum = Datum(*b"W84");

    /// A datum of three upper-case letters or digits.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        let good = text.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit());
        <[u8; 3]>::try_from(text.as_bytes()).ok().filter(|_| good).map(Datum)
    }

    /// The code.
    #[must_use]
    pub fn as_str(&self) -> &str {
        std::str::from_utf8(&self.0).unwrap_or_default()
    }
}

/// The datum in use and its offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dtm {
    /// Datum in use.
    pub datum: Option<Datum>,
    /// Subdivision of the datum.
    pub subdivision: Option<u8>,
    /// Offset of latitude, rad, north positive.
    pub latitude_offset: Option<f64>,
    /// Offset of longitude, rad, east positive.
    pub longitude_offset: Option<f64>,
    /// Offset of altitude, m.
    pub altitude_offset: Option<f64>,
    /// Reference datum.
    pub reference: Option<Datum>,
}

impl Dtm {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "DTM";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 49;

    /// Writes the sentence, offsets to 0.0001 minutes and 0.01 m.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        let minutes = |angle: Option<f64>| angle.map(|angle| angle.to_degrees() * 60.0);
        let subdivision = self.subdivision.map(char::from).map(String::from).unwrap_or_default();
        Line::compose(talker, Self::FORMATTER, |line| {
            line.text(self.datum.as_ref().map_or("", Datum::as_str));
            line.text(&subdivision);
            line.signed(minutes(self.latitude_offset), OFFSET, [b'N', b'S']);
            line.signed(minutes(self.longitude_offset), OFFSET, [b'E', b'W']);
            line.number(self.altitude_offset, ALTITUDE);
            line.text(self.reference.as_ref().map_or("", Datum::as_str));
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let datum = fields.convert(Datum::new)?;
        let subdivision = fields.letter()?;
        let mut dtm = Dtm {
            datum,
            subdivision,
            latitude_offset: None,
            longitude_offset: None,
            altitude_offset: None,
            reference: None,
        };
        if fields.has_more() {
            dtm.latitude_offset = offset(&mut fields, ["N", "S"])?;
            dtm.longitude_offset = offset(&mut fields, ["E", "W"])?;
            dtm.altitude_offset = fields.number_in(-ALTITUDE.limit..=ALTITUDE.limit)?;
            dtm.reference = fields.convert(Datum::new)?;
        }
        Ok(dtm)
    }
}

fn offset(fields: &mut Fields<'_>, letters: [&str; 2]) -> Result<Option<f64>, Fault> {
    let minutes = fields.signed(OFFSET.limit, letters)?;
    Ok(minutes.map(|minutes| (minutes / 60.0).to_radians()))
}
