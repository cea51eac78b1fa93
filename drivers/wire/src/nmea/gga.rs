//! GGA: position fix.
//!
//! ```text
//! $INGGA,hhmmss.ss,ddmm.mmmmm,a,dddmm.mmmmm,a,q,ss,h.h,x.x,M,g.g,M,t.t,iiii*hh
//!        1         2          3 4           5 6 7  8   9   10 11 12 13 14
//! 1     UTC of the position
//! 2, 3  latitude, N or S
//! 4, 5  longitude, E or W
//! 6     quality: 0 invalid, 1 GNSS, 2 differential, 3 PPS, 4 RTK fixed, 5 RTK float, 6 estimated
//!       (dead reckoning), 7 manual, 8 simulator; never empty
//! 7     satellites in use
//! 8     horizontal dilution of precision
//! 9, 10 antenna height above mean sea level (the geoid), m
//! 11,12 geoid separation: geoid above the WGS-84 ellipsoid, m
//! 13    age of the differential correction, s
//! 14    differential station, 0000 to 1023 (RTCM 2) or 4095 (RTCM 3)
//! ```
//! The position is that of whoever talks: of the antenna for a receiver, of the IMU for us.
//! Field 9 is not the ellipsoidal height: without a geoid model it stays empty. Fields 13 and 14
//! are the first to go when the line would exceed 82 bytes.
//!
//! Where the quality is 0, what is no position is unknown (a receiver without a fix sends 8960.0000
//! for a latitude); elsewhere it is a fault. A Saab R4 leaves field 14 out; that is read if field 13
//! is empty, so that a line cut short inside field 13 is not taken for a shorter one.
//!
//! Time, position and quality must be good; any other field that is bad is left out.

use insd_base::FixQuality;

use super::civil::TimeOfDay;
use super::decimal::Form;
use super::fault::NmeaFault;
use super::frame::Frame;
use super::line::{NmeaLine, Talker};
use super::position::Position;

pub(crate) const HDOP: Form = Form { decimals: 1, width: 1, limit: 999.9 };
pub(crate) const HEIGHT: Form = Form { decimals: 2, width: 1, limit: 99_999.9 };
pub(crate) const AGE: Form = Form { decimals: 1, width: 1, limit: 9999.9 };
pub(crate) const STATION_MAX: u32 = 4095;

/// A position fix.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Gga {
    /// UTC of the position.
    pub time: Option<TimeOfDay>,
    /// Latitude and longitude.
    pub position: Option<Position>,
    /// Quality.
    pub quality: FixQuality,
    /// Satellites in use, at most 99.
    pub satellites: Option<u8>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// Height above mean sea level, m.
    pub altitude: Option<f64>,
    /// Height of the geoid above the ellipsoid, m.
    pub geoid_separation: Option<f64>,
    /// Age of the differential correction, s.
    pub age: Option<f64>,
    /// Differential station, at most 4095.
    pub station: Option<u16>,
}

impl Gga {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "GGA";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 82;

    /// Writes the sentence: time truncated to 0.01 s, position to 0.00001 minutes (2 cm).
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.time_of_day(self.time);
            line.position(self.position, 5);
            line.letter(b'0' + self.quality.as_gga());
            line.whole(self.satellites.map(u32::from), 2, 99);
            line.magnitude(self.hdop, HDOP);
            line.measured(self.altitude, HEIGHT, b'M');
            line.measured(self.geoid_separation, HEIGHT, b'M');
            line.optional(2, |line| {
                line.magnitude(self.age, AGE);
                line.whole(self.station.map(u32::from), 4, STATION_MAX);
            });
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let time = fields.time_of_day()?;
        let position = fields.position();
        let digit = fields.letter()?.and_then(|letter| letter.checked_sub(b'0'));
        let quality = digit.and_then(FixQuality::from_gga).ok_or_else(|| fields.malformed())?;
        let satellites = fields.optional(|own| own.whole(99))?;
        let satellites = satellites.and_then(|count| u8::try_from(count).ok());
        let height = -HEIGHT.limit..=HEIGHT.limit;
        let hdop = fields.optional(|own| own.number_in(0.0..=HDOP.limit))?;
        let altitude = fields.optional(|own| own.with_unit(height.clone(), "M"))?;
        let geoid_separation = fields.optional(|own| own.with_unit(height, "M"))?;
        let age = fields.optional(|own| own.number_in(0.0..=AGE.limit))?;
        let station = if fields.has_more() || age.is_some() {
            let station = fields.optional(|own| own.whole(STATION_MAX))?;
            station.and_then(|id| u16::try_from(id).ok())
        } else {
            None
        };
        let position = match quality {
            FixQuality::Invalid => position.ok().flatten(),
            _ => position?,
        };
        Ok(Gga {
            time,
            position,
            quality,
            satellites,
            hdop,
            altitude,
            geoid_separation,
            age,
            station,
        })
    }
}
