//! GSV: satellites in view.
//!
//! ```text
//! $GPGSV,n,n,ss,pp,ee,aaa,cc,...,h*hh
//!        1 2 3  4  5  6   7
//! 1    sentences of this group, 1 to 9
//! 2    number of this one
//! 3    satellites in view
//! 4..7 number, elevation deg, azimuth deg true, carrier to noise density dB-Hz (empty: not tracked)
//! ...  up to three more satellites
//! last signal, hexadecimal; absent before NMEA 4.1
//! ```

use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::gsa::hexadecimal;
use super::line::{NmeaLine, Talker};

const ELEVATION: Form = Form { decimals: 0, width: 2, limit: 90.0 };
const NOISE: Form = Form { decimals: 0, width: 2, limit: 99.0 };

/// A satellite in view.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SatelliteInView {
    /// Its number, at most 999.
    pub id: Option<u16>,
    /// Elevation above the horizon, rad.
    pub elevation: Option<f64>,
    /// Azimuth, rad, clockwise from true north.
    pub azimuth: Option<f64>,
    /// Carrier to noise density, dB-Hz; `None` if it is not tracked.
    pub noise_density: Option<f64>,
}

/// Up to four satellites in view.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Gsv {
    /// Sentences of the group.
    pub sentences: u8,
    /// Number of this one, from 1.
    pub number: u8,
    /// Satellites in view, of all sentences of the group.
    pub in_view: Option<u16>,
    /// The satellites of this sentence; one that has been left out altogether is `None`.
    pub satellites: [Option<SatelliteInView>; 4],
    /// Signal, 0 to 15.
    pub signal: Option<u8>,
}

impl Gsv {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "GSV";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 76;

    /// Writes the sentence, with as many satellites as there are before the first `None`; angles to
    /// 1 deg.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.whole(Some(self.sentences.into()), 1, 99);
            line.whole(Some(self.number.into()), 1, 99);
            line.whole(self.in_view.map(u32::from), 2, 999);
            for satellite in self.satellites.iter().map_while(Option::as_ref) {
                line.whole(satellite.id.map(u32::from), 2, 999);
                line.number(satellite.elevation.map(f64::to_degrees), ELEVATION);
                line.degrees(satellite.azimuth, 0);
                line.magnitude(satellite.noise_density, NOISE);
            }
            line.hexadecimal(self.signal);
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let sentences = count(&mut fields)?;
        let number = count(&mut fields)?;
        if number > sentences {
            return Err(fields.malformed());
        }
        let in_view =
            fields.optional(|own| own.whole(999))?.and_then(|count| u16::try_from(count).ok());
        let mut satellites = [None; 4];
        for satellite in &mut satellites {
            if fields.remaining() >= 2 {
                *satellite = Some(SatelliteInView::read(&mut fields)?);
            }
        }
        let signal = if fields.has_more() { fields.optional(hexadecimal)? } else { None };
        Ok(Gsv { sentences, number, in_view, satellites, signal })
    }
}

impl SatelliteInView {
    fn read(fields: &mut Fields<'_>) -> Result<Self, NmeaFault> {
        Ok(SatelliteInView {
            id: fields.optional(|own| own.whole(999))?.and_then(|id| u16::try_from(id).ok()),
            elevation: fields.optional(|own| own.number_in(-90.0..=90.0))?.map(f64::to_radians),
            azimuth: fields.optional(Fields::degrees)?,
            noise_density: fields.optional(|own| own.number_in(0.0..=NOISE.limit))?,
        })
    }
}

fn count(fields: &mut Fields<'_>) -> Result<u8, NmeaFault> {
    let count =
        fields.whole(99)?.filter(|count| *count > 0).and_then(|count| count.try_into().ok());
    count.ok_or_else(|| fields.malformed())
}
