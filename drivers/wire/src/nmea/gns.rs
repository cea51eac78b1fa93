//! GNS: fix of one or several satellite systems.
//!
//! ```text
//! $GNGNS,hhmmss.ss,ddmm.mmmmm,a,dddmm.mmmmm,a,c--c,ss,h.h,x.x,g.g,t.t,iiii,a*hh
//!        1         2          3 4           5 6    7  8   9   10  11  12   13
//! 1     UTC of the position
//! 2, 3  latitude, N or S
//! 4, 5  longitude, E or W
//! 6     mode of each system: GPS, GLONASS, Galileo, BeiDou, QZSS, NavIC; never empty
//! 7     satellites in use
//! 8     horizontal dilution of precision
//! 9     antenna height above mean sea level (the geoid), m
//! 10    geoid separation, m
//! 11    age of the differential correction, s
//! 12    differential station, 0000 to 4095
//! 13    navigational status: S C U V; absent before NMEA 4.1
//! ```
//! Time, position and modes must be good; any other field that is bad is left out.

use std::ops::RangeInclusive;

use insd_base::FixQuality;

use super::civil::TimeOfDay;
use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::gga::{AGE, HDOP, HEIGHT, STATION_MAX};
use super::line::{NmeaLine, Talker};
use super::mode::{NavStatus, PositionMode};
use super::parts::letter_of;
use super::position::Position;

const SATELLITES: Form = Form { decimals: 0, width: 2, limit: 99.0 };

/// Most systems that a sentence tells of.
pub const MAX_SYSTEMS: usize = 8;

/// Modes from the least to the most exact.
const RANKING: [PositionMode; 9] = [
    PositionMode::NotValid,
    PositionMode::Manual,
    PositionMode::Estimated,
    PositionMode::Simulator,
    PositionMode::Autonomous,
    PositionMode::Precise,
    PositionMode::Differential,
    PositionMode::RtkFloat,
    PositionMode::RtkFixed,
];

/// A position fix with a mode for each system.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Gns {
    /// UTC of the position.
    pub time: Option<TimeOfDay>,
    /// Latitude and longitude; `None` if no system has a fix and they are no position.
    pub position: Option<Position>,
    /// Mode of each system, in the order GPS, GLONASS, Galileo, BeiDou, QZSS, NavIC; no gap but at the
    /// end. If there is none, N is written for GPS and GLONASS.
    pub modes: [Option<PositionMode>; MAX_SYSTEMS],
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
    /// Navigational status; not provided is written if it is unknown.
    pub nav_status: Option<NavStatus>,
}

impl Gns {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "GNS";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 82;

    /// The best mode of all systems as the quality of the fix.
    #[must_use]
    pub fn quality(&self) -> FixQuality {
        let rank = |mode: &PositionMode| RANKING.iter().position(|own| own == mode);
        let best = self.modes.iter().flatten().max_by_key(|mode| rank(mode));
        best.map_or(FixQuality::Invalid, |mode| mode.quality())
    }

    /// Writes the sentence: time truncated to 0.01 s, position to 0.00001 minutes (2 cm).
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        let letters: String = self.modes.iter().flatten().map(|m| char::from(m.letter())).collect();
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.time_of_day(self.time);
            line.position(self.position, 5);
            line.text(if letters.is_empty() { "NN" } else { &letters });
            line.number(self.satellites.map(f64::from), SATELLITES);
            line.magnitude(self.hdop, HDOP);
            line.number(self.altitude, HEIGHT);
            line.number(self.geoid_separation, HEIGHT);
            line.optional(2, |line| {
                line.magnitude(self.age, AGE);
                line.whole(self.station.map(u32::from), 4, STATION_MAX);
            });
            line.letter(self.nav_status.unwrap_or(NavStatus::NotProvided).letter());
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
        let modes = modes(&mut fields)?;
        let mut gns = Gns {
            time,
            modes,
            satellites: whole(&mut fields, 99)?.and_then(|count| u8::try_from(count).ok()),
            hdop: number(&mut fields, 0.0..=HDOP.limit)?,
            altitude: number(&mut fields, -HEIGHT.limit..=HEIGHT.limit)?,
            geoid_separation: number(&mut fields, -HEIGHT.limit..=HEIGHT.limit)?,
            age: number(&mut fields, 0.0..=AGE.limit)?,
            station: whole(&mut fields, STATION_MAX)?.and_then(|id| u16::try_from(id).ok()),
            ..Gns::default()
        };
        gns.position =
            if gns.quality() == FixQuality::Invalid { position.ok().flatten() } else { position? };
        if fields.has_more() {
            gns.nav_status = fields.optional(nav_status)?;
        }
        Ok(gns)
    }
}

/// The navigational status, which says little.
pub(crate) fn nav_status(fields: &mut Fields<'_>) -> Result<Option<NavStatus>, NmeaFault> {
    fields.convert(|text| letter_of(text).and_then(NavStatus::from_letter))
}

fn number(fields: &mut Fields<'_>, range: RangeInclusive<f64>) -> Result<Option<f64>, NmeaFault> {
    fields.optional(|own| own.number_in(range))
}

fn whole(fields: &mut Fields<'_>, most: u32) -> Result<Option<u32>, NmeaFault> {
    fields.optional(|own| own.whole(most))
}

fn modes(fields: &mut Fields<'_>) -> Result<[Option<PositionMode>; MAX_SYSTEMS], NmeaFault> {
    let text = fields.text()?;
    let mut modes = [None; MAX_SYSTEMS];
    if text.is_empty() || text.len() > MAX_SYSTEMS {
        return Err(fields.malformed());
    }
    for (mode, letter) in modes.iter_mut().zip(text.bytes()) {
        *mode = Some(PositionMode::from_letter(letter).ok_or_else(|| fields.malformed())?);
    }
    Ok(modes)
}
