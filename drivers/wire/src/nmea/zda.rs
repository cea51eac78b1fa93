//! ZDA: date and time, UTC.
//!
//! ```text
//! $INZDA,hhmmss.ss,dd,mm,yyyy,xx,yy*hh
//!        1         2  3  4    5  6
//! 1    UTC
//! 2..4 day, month, year
//! 5    local zone: hours to add to local time to get UTC, -13 to 13, negative for east longitude
//! 6    local zone: minutes, of the same sign as the hours
//! ```
//! There are receivers whose sentence ends after field 5, or 4, and such that send a year of two digits: 80
//! to 99 are 1980 to 1999. Time and date must be good; a bad zone is
//! left out, and so is a time without a date.

use super::civil::{CivilTime, Date};
use super::decimal::{Form, parse, parse_digits};
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{NmeaLine, Talker};

const ZONE: Form = Form { decimals: 0, width: 2, limit: 59.0 };

/// What must be added to local time to get UTC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Zone {
    /// Hours, -13 to 13, negative in east longitude.
    pub hours: i8,
    /// Minutes, -59 to 59, of the sign of the hours.
    pub minutes: i8,
}

/// Date and time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Zda {
    /// Date and time of day, UTC.
    pub utc: Option<CivilTime>,
    /// The ship's zone.
    pub zone: Option<Zone>,
}

impl Zda {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "ZDA";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 40;

    /// Writes the sentence, time truncated to 0.01 s.
    #[must_use]
    pub fn write(&self, talker: Talker) -> NmeaLine {
        let utc = self.utc.filter(|utc| utc.date.is_valid() && utc.time.is_valid());
        NmeaLine::compose(talker, Self::FORMATTER, |line| {
            line.time_of_day(utc.map(|utc| utc.time));
            match utc.map(|utc| utc.date) {
                Some(date) => date.groups().into_iter().for_each(|group| line.digits(&[group])),
                None => (0..3).for_each(|_| line.empty()),
            }
            line.number(self.zone.map(|zone| zone.hours.into()), ZONE);
            line.number(self.zone.map(|zone| zone.minutes.into()), ZONE);
        })
    }

    /// Reads the sentence. A time without a date is unknown.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let time = fields.time_of_day()?;
        let day = fields.whole(31)?;
        let month = fields.whole(12)?;
        let year = year(&mut fields)?;
        let utc = match (time, day, month, year) {
            (Some(time), Some(day), Some(month), Some(year)) => {
                let date = Date::from_parts(year, month, day);
                let date = date.filter(|date| date.is_valid());
                Some(CivilTime { date: date.ok_or_else(|| fields.malformed())?, time })
            }
            (None, None, None, None) => None,
            // a receiver that has not learnt the date yet
            (Some(_), None, None, None) => {
                fields.leave_out(NmeaFault::Malformed { field: 2 });
                None
            }
            _ => return Err(fields.malformed()),
        };
        let hours = if fields.has_more() { fields.optional(|own| signed(own, 13))? } else { None };
        let minutes =
            if fields.has_more() { fields.optional(|own| signed(own, 59))? } else { None };
        let zone = hours.map(|hours| Zone { hours, minutes: minutes.unwrap_or(0) });
        Ok(Zda { utc, zone })
    }
}

/// The year; of two digits only where another field follows, as it may have been cut short.
fn year(fields: &mut Fields<'_>) -> Result<Option<u32>, NmeaFault> {
    let text = fields.text()?;
    let year = parse_digits(text);
    match (text.len(), year) {
        (0, _) => Ok(None),
        (4, Some(year)) => Ok(Some(year)),
        (2, Some(year)) if fields.has_more() => {
            Ok(Some(year + if year >= 80 { 1900 } else { 2000 }))
        }
        _ => Err(fields.malformed()),
    }
}

fn signed(fields: &mut Fields<'_>, max: i8) -> Result<Option<i8>, NmeaFault> {
    fields.convert(|text| {
        let whole = parse(text).filter(|value| value.fract() == 0.0)?;
        (whole.abs() <= f64::from(max)).then_some(whole as i8)
    })
}
