//! The reader's cursor over the fields of a frame.

use std::cell::Cell;
use std::ops::RangeInclusive;

use insd_base::units::wrap_two_pi;

use super::civil::TimeOfDay;
use super::decimal::{parse, parse_digits};
use super::fault::NmeaFault;
use super::position::Position;

/// Fields of a frame, one after the other. An empty field is `None`.
#[derive(Clone, Debug)]
pub struct Fields<'a> {
    rest: Option<&'a str>,
    taken: u8,
    left_out: &'a Cell<LeftOut>,
}

/// Fields of a sentence that were bad, and that it is good without.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct LeftOut {
    /// How many.
    pub count: u8,
    /// What is wrong with the first of them.
    pub first: Option<NmeaFault>,
}

impl<'a> Fields<'a> {
    pub(crate) fn new(rest: Option<&'a str>, left_out: &'a Cell<LeftOut>) -> Self {
        Fields { rest, taken: 0, left_out }
    }

    /// What a sentence is good without: where it is malformed it is unknown, and noted as left out.
    /// `read` must take all of its fields, whatever the first of them holds. One that is missing stays
    /// a fault, as the line may have been cut short.
    ///
    /// # Errors
    /// Any but [`NmeaFault::Malformed`].
    pub fn optional<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<Option<T>, NmeaFault>,
    ) -> Result<Option<T>, NmeaFault> {
        match read(self) {
            Err(fault @ NmeaFault::Malformed { .. }) => {
                self.leave_out(fault);
                Ok(None)
            }
            read => read,
        }
    }

    /// Notes that a field is left out.
    pub(crate) fn leave_out(&self, fault: NmeaFault) {
        let LeftOut { count, first } = self.left_out.get();
        self.left_out.set(LeftOut { count: count.saturating_add(1), first: first.or(Some(fault)) });
    }

    /// Whether there is another field, even an empty one.
    #[must_use]
    pub fn has_more(&self) -> bool {
        self.rest.is_some()
    }

    /// The next field as it stands.
    ///
    /// # Errors
    /// [`NmeaFault::Missing`] past the last field.
    pub fn text(&mut self) -> Result<&'a str, NmeaFault> {
        self.taken = self.taken.saturating_add(1);
        let rest = self.rest.ok_or(NmeaFault::Missing { field: self.taken })?;
        let (field, rest) = match rest.split_once(',') {
            Some((field, rest)) => (field, Some(rest)),
            None => (rest, None),
        };
        self.rest = rest;
        Ok(field)
    }

    /// All fields that are left, with the commas between them.
    ///
    /// # Errors
    /// [`NmeaFault::Missing`] past the last field.
    pub fn remainder(&mut self) -> Result<&'a str, NmeaFault> {
        self.taken = self.taken.saturating_add(1);
        self.rest.take().ok_or(NmeaFault::Missing { field: self.taken })
    }

    /// The next field through a conversion that refuses with `None`; empty stays `None`.
    ///
    /// # Errors
    /// [`NmeaFault::Missing`], or [`NmeaFault::Malformed`] where the conversion refuses.
    pub fn convert<T>(
        &mut self,
        conversion: impl FnOnce(&'a str) -> Option<T>,
    ) -> Result<Option<T>, NmeaFault> {
        match self.text()? {
            "" => Ok(None),
            text => conversion(text).map(Some).ok_or_else(|| self.malformed()),
        }
    }

    /// A decimal number.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn number(&mut self) -> Result<Option<f64>, NmeaFault> {
        self.convert(parse)
    }

    /// A whole number of at most `max`.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn whole(&mut self, max: u32) -> Result<Option<u32>, NmeaFault> {
        self.convert(|text| parse_digits(text).filter(|value| *value <= max))
    }

    /// An angle of 0 to 360 degrees, returned in rad, [0, 2 pi).
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn degrees(&mut self) -> Result<Option<f64>, NmeaFault> {
        let degrees = self.convert(|t| parse(t).filter(|d| (0.0..=360.0).contains(d)))?;
        Ok(degrees.map(|degrees| wrap_two_pi(degrees.to_radians())))
    }

    /// A single character.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn letter(&mut self) -> Result<Option<u8>, NmeaFault> {
        self.convert(|text| match text.as_bytes() {
            [letter] => Some(*letter),
            _ => None,
        })
    }

    /// A unit or another fixed letter, which may be empty.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn fixed(&mut self, letter: &str) -> Result<(), NmeaFault> {
        self.convert(|text| (text == letter).then_some(())).map(|_| ())
    }

    /// A time of day `hhmmss.ss`.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn time_of_day(&mut self) -> Result<Option<TimeOfDay>, NmeaFault> {
        self.convert(TimeOfDay::parse)
    }

    /// How many fields are left, empty ones included.
    #[must_use]
    pub fn remaining(&self) -> usize {
        self.rest.map_or(0, |rest| rest.split(',').count())
    }

    /// A decimal number within bounds.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn number_in(&mut self, range: RangeInclusive<f64>) -> Result<Option<f64>, NmeaFault> {
        self.convert(|text| parse(text).filter(|value| range.contains(value)))
    }

    /// A magnitude and the letter of its sign, the positive one first: `1.3,W` is -1.3.
    ///
    /// # Errors
    /// As [`Fields::convert`]; a magnitude without its letter is malformed.
    pub fn signed(&mut self, max: f64, letters: [&str; 2]) -> Result<Option<f64>, NmeaFault> {
        let magnitude = self.number_in(0.0..=max);
        let sign = self.convert(|text| sign_of(text, letters));
        if let Err(fault @ NmeaFault::Missing { .. }) = sign {
            return Err(fault);
        }
        match (magnitude?, sign?) {
            (Some(magnitude), Some(sign)) => Ok(Some(sign * magnitude)),
            (None, _) => Ok(None),
            (Some(_), None) => Err(self.malformed()),
        }
    }

    /// A decimal number within bounds and the letter of its unit; a number beside another letter is
    /// malformed.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn with_unit(
        &mut self,
        range: RangeInclusive<f64>,
        unit: &str,
    ) -> Result<Option<f64>, NmeaFault> {
        let number = self.number_in(range);
        match (self.fixed(unit), number) {
            (Ok(()), number) => number,
            (Err(fault @ NmeaFault::Malformed { .. }), number) => {
                Err(number.err().unwrap_or(fault))
            }
            (Err(fault), _) => Err(fault),
        }
    }

    /// An angle of 0 to 360 degrees and the letter of its north, returned in rad, [0, 2 pi).
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn degrees_with(&mut self, letter: &str) -> Result<Option<f64>, NmeaFault> {
        let degrees = self.with_unit(0.0..=360.0, letter)?;
        Ok(degrees.map(|degrees| wrap_two_pi(degrees.to_radians())))
    }

    /// A status: A valid, V not valid.
    ///
    /// # Errors
    /// As [`Fields::convert`]; an empty status is malformed.
    pub fn status(&mut self) -> Result<bool, NmeaFault> {
        match self.text()? {
            "A" => Ok(true),
            "V" => Ok(false),
            _ => Err(self.malformed()),
        }
    }

    /// Latitude, hemisphere, longitude, hemisphere; all four empty or none. The four fields are
    /// behind the cursor afterwards, whatever they held.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn position(&mut self) -> Result<Option<Position>, NmeaFault> {
        let start = self.taken;
        let fault = |number: u8| NmeaFault::Malformed { field: start.saturating_add(number) };
        let texts = [self.text()?, self.text()?, self.text()?, self.text()?];
        let latitude = angle([texts[0], texts[1]], 2, 90.0, ["N", "S"]);
        let latitude = latitude.map_err(fault)?;
        let longitude = angle([texts[2], texts[3]], 3, 180.0, ["E", "W"]);
        match (latitude, longitude.map_err(|number| fault(number + 2))?) {
            (Some(latitude), Some(longitude)) => Ok(Some(Position { latitude, longitude })),
            (None, None) => Ok(None),
            _ => Err(fault(4)),
        }
    }

    /// Latitude and hemisphere, rad; both empty or none.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn latitude(&mut self) -> Result<Option<f64>, NmeaFault> {
        let start = self.taken;
        let texts = [self.text()?, self.text()?];
        let fault = |number: u8| NmeaFault::Malformed { field: start.saturating_add(number) };
        angle(texts, 2, 90.0, ["N", "S"]).map_err(fault)
    }

    /// The fault of the field that was taken last.
    #[must_use]
    pub fn malformed(&self) -> NmeaFault {
        NmeaFault::Malformed { field: self.taken }
    }
}

/// The angle of a magnitude and its hemisphere, rad; the number of the field that is malformed.
fn angle(
    [magnitude, hemisphere]: [&str; 2],
    width: usize,
    limit: f64,
    hemispheres: [&str; 2],
) -> Result<Option<f64>, u8> {
    let degrees = match magnitude {
        "" => None,
        text => Some(Position::parse_angle(text, width).filter(|deg| *deg <= limit).ok_or(1)?),
    };
    let sign = match hemisphere {
        "" => None,
        text => Some(sign_of(text, hemispheres).ok_or(2)?),
    };
    match (degrees, sign) {
        (Some(degrees), Some(sign)) => Ok(Some((sign * degrees).to_radians())),
        (None, _) => Ok(None),
        (Some(_), None) => Err(2),
    }
}

fn sign_of(text: &str, [positive, negative]: [&str; 2]) -> Option<f64> {
    match text {
        _ if text == positive => Some(1.0),
        _ if text == negative => Some(-1.0),
        _ => None,
    }
}
