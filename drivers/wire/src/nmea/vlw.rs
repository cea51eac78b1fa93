//! VLW: distance run.
//!
//! ```text
//! $VDVLW,x.x,N,x.x,N,x.x,N,x.x,N*hh
//!        1   2 3   4 5   6 7   8
//! 1, 2 total through the water, nautical miles
//! 3, 4 since reset, through the water
//! 5, 6 total over ground; absent before NMEA 3.0, as is the rest
//! 7, 8 since reset, over ground
//! ```

use super::decimal::Form;
use super::fault::Fault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Line, Talker};

/// Metres in a nautical mile.
const MILE: f64 = 1852.0;

const DISTANCE: Form = Form { decimals: 3, width: 1, limit: 9_999_999.0 };

/// Distances run.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Vlw {
    /// Total through the water, m.
    pub water: Option<f64>,
    /// Since reset, through the water, m.
    pub water_trip: Option<f64>,
    /// Total over ground, m.
    pub ground: Option<f64>,
    /// Since reset, over ground, m.
    pub ground_trip: Option<f64>,
}

impl Vlw {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "VLW";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 63;

    /// Writes the sentence with all its four distances, to 0.001 nautical miles.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            for distance in [self.water, self.water_trip, self.ground, self.ground_trip] {
                line.magnitude(distance.map(|metres| metres / MILE), DISTANCE);
                line.letter(b'N');
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let water = distance(&mut fields)?;
        let mut vlw = Vlw { water, water_trip: distance(&mut fields)?, ..Vlw::default() };
        if fields.has_more() {
            vlw.ground = distance(&mut fields)?;
            vlw.ground_trip = distance(&mut fields)?;
        }
        Ok(vlw)
    }
}

fn distance(fields: &mut Fields<'_>) -> Result<Option<f64>, Fault> {
    let miles = fields.optional(|own| own.with_unit(0.0..=DISTANCE.limit, "N"))?;
    Ok(miles.map(|miles| miles * MILE))
}
