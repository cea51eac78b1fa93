//! RMC: the recommended minimum: position, course, speed, date.
//!
//! ```text
//! $GPRMC,hhmmss.ss,A,ddmm.mmmmm,a,dddmm.mmmmm,a,x.x,x.x,ddmmyy,x.x,a,a,a*hh
//!        1         2 3          4 5           6 7   8   9      10  11 12 13
//! 1     UTC of the position
//! 2     A valid, V not valid
//! 3, 4  latitude, N or S
//! 5, 6  longitude, E or W
//! 7     speed over ground, knots
//! 8     course over ground, deg true
//! 9     day, month, year of the century: 80 to 99 are 1980 to 1999
//! 10,11 magnetic variation, deg, E or W
//! 12    mode: A D E F M N P R S; absent before NMEA 2.3
//! 13    navigational status: S C U V; absent before NMEA 4.1
//! ```
//! What is no position in a sentence that says V is unknown; in one that says A it is a fault, as is a
//! bad time, status or mode. Any other field that is bad is left out: there are receivers that send a
//! variation of 999.9. A Motorola receiver leaves field 11 out and puts the mode there: its variation,
//! which then has no sign, is unknown.

use insd_base::units::KNOT;

use super::civil::{Date, TimeOfDay};
use super::decimal::{Form, parse_digits};
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::gns::nav_status;
use super::line::{NmeaLine, Talker};
use super::mode::{NavStatus, PositionMode};
use super::parts::letter_of;
use super::position::Position;

const SPEED: Form = Form { decimals: 2, width: 1, limit: 9999.9 };
const VARIATION: Form = Form { decimals: 1, width: 1, limit: 180.0 };

/// Position, course, speed and date.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Rmc {
    /// UTC of the position.
    pub time: Option<TimeOfDay>,
    /// Whether the data may be used. A sentence without a position is written as not valid.
    pub valid: bool,
    /// Latitude and longitude.
    pub position: Option<Position>,
    /// Speed over ground, m/s.
    pub speed: Option<f64>,
    /// Course over ground, rad, clockwise from true north.
    pub course: Option<f64>,
    /// Date, 1980 to 2079.
    pub date: Option<Date>,
    /// Magnetic variation, rad, magnetic north east of true north positive.
    pub variation: Option<f64>,
    /// How the position was found; an unknown mode is written as autonomous or not valid.
    pub mode: Option<PositionMode>,
    /// Navigational status; not provided is written if it is unknown.
    pub nav_status: Option<NavStatus>,
}

impl Rmc {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "RMC";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 82;

    /// Writes the sentence: time truncated to 0.01 s, position to 0.00001 minutes (2 cm), course to
    /// 0.01 deg, speed to 0.01 kn, variation to 0.1 deg.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        let valid = self.valid && self.position.is_some_and(Position::is_writable);
        let otherwise = if valid { PositionMode::Autonomous } else { PositionMode::NotValid };
        let date = self.date.filter(|date| date.is_valid() && (1980..2080).contains(&date.year));
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.time_of_day(self.time);
            line.letter(if valid { b'A' } else { b'V' });
            line.position(self.position, 5);
            line.magnitude(self.speed.map(|speed| speed / KNOT), SPEED);
            line.degrees(self.course, 2);
            match date {
                Some(date) => line.digits(&date.short_groups()),
                None => line.empty(),
            }
            line.signed(self.variation.map(f64::to_degrees), VARIATION, [b'E', b'W']);
            line.letter(self.mode.unwrap_or(otherwise).letter());
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
        let valid = fields.status()?;
        let position = fields.position();
        let speed = fields.optional(|own| own.number_in(0.0..=SPEED.limit))?;
        let speed = speed.map(|knots| knots * KNOT);
        let course = fields.optional(Fields::degrees)?;
        let date = fields.optional(|own| own.convert(short_date))?;
        let (variation, mode) = variation_and_mode(&mut fields)?;
        let nav_status = if fields.has_more() { fields.optional(nav_status)? } else { None };
        let position = if valid { position? } else { position.ok().flatten() };
        Ok(Rmc { time, valid, position, speed, course, date, variation, mode, nav_status })
    }
}

/// Fields 10 to 12, of which the oldest editions end after 11.
fn variation_and_mode(
    fields: &mut Fields<'_>,
) -> Result<(Option<f64>, Option<PositionMode>), NmeaFault> {
    let mut behind = fields.clone();
    behind.text()?;
    let mode_in_its_place = letter_of(behind.text()?).and_then(PositionMode::from_letter);
    if let Some(mode) = mode_in_its_place.filter(|mode| *mode != PositionMode::Estimated)
        && !behind.has_more()
    {
        return Ok((None, Some(mode)));
    }
    let variation = fields.optional(|own| own.signed(VARIATION.limit, ["E", "W"]))?;
    let variation = variation.map(f64::to_radians);
    if !fields.has_more() {
        return Ok((variation, None));
    }
    let mode = fields.convert(|text| letter_of(text).and_then(PositionMode::from_letter))?;
    Ok((variation, mode))
}

fn short_date(text: &str) -> Option<Date> {
    let part = |from: usize| text.get(from..from + 2).and_then(parse_digits);
    let year = part(4).filter(|_| text.len() == 6)?;
    let century = if year >= 80 { 1900 } else { 2000 };
    let date = Date::from_parts(century + year, part(2)?, part(0)?);
    date.filter(|date| date.is_valid())
}
