//! The reader's cursor over the fields of a frame.

use insd_base::units::wrap_two_pi;

use super::civil::TimeOfDay;
use super::decimal::{parse, parse_digits};
use super::fault::Fault;
use super::position::Position;

/// Fields of a frame, one after the other. An empty field is `None`.
#[derive(Clone, Debug)]
pub struct Fields<'a> {
    rest: Option<&'a str>,
    taken: u8,
}

impl<'a> Fields<'a> {
    pub(crate) fn new(rest: Option<&'a str>) -> Self {
        Fields { rest, taken: 0 }
    }

    /// Whether there is another field, even an empty one.
    #[must_use]
    pub fn has_more(&self) -> bool {
        self.rest.is_some()
    }

    /// The next field as it stands.
    ///
    /// # Errors
    /// [`Fault::Missing`] past the last field.
    pub fn text(&mut self) -> Result<&'a str, Fault> {
        self.taken = self.taken.saturating_add(1);
        let rest = self.rest.ok_or(Fault::Missing { field: self.taken })?;
        let (field, rest) = match rest.split_once(',') {
            Some((field, rest)) => (field, Some(rest)),
            None => (rest, None),
        };
        self.rest = rest;
        Ok(field)
    }

    /// The next field through a conversion that refuses with `None`; empty stays `None`.
    ///
    /// # Errors
    /// [`Fault::Missing`], or [`Fault::Malformed`] where the conversion refuses.
    pub fn convert<T>(
        &mut self,
        conversion: impl FnOnce(&'a str) -> Option<T>,
    ) -> Result<Option<T>, Fault> {
        match self.text()? {
            "" => Ok(None),
            text => conversion(text).map(Some).ok_or_else(|| self.malformed()),
        }
    }

    /// A decimal number.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn number(&mut self) -> Result<Option<f64>, Fault> {
        self.convert(parse)
    }

    /// A whole number of at most `max`.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn whole(&mut self, max: u32) -> Result<Option<u32>, Fault> {
        self.convert(|text| parse_digits(text).filter(|value| *value <= max))
    }

    /// An angle of 0 to 360 degrees, returned in rad, [0, 2 pi).
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn degrees(&mut self) -> Result<Option<f64>, Fault> {
        let degrees = self.convert(|t| parse(t).filter(|d| (0.0..=360.0).contains(d)))?;
        Ok(degrees.map(|degrees| wrap_two_pi(degrees.to_radians())))
    }

    /// A single character.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn letter(&mut self) -> Result<Option<u8>, Fault> {
        self.convert(|text| match text.as_bytes() {
            [letter] => Some(*letter),
            _ => None,
        })
    }

    /// A unit or another fixed letter, which may be empty.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn fixed(&mut self, letter: &str) -> Result<(), Fault> {
        self.convert(|text| (text == letter).then_some(())).map(|_| ())
    }

    /// A time of day `hhmmss.ss`.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn time_of_day(&mut self) -> Result<Option<TimeOfDay>, Fault> {
        self.convert(TimeOfDay::parse)
    }

    /// Latitude, hemisphere, longitude, hemisphere; all four empty or none.
    ///
    /// # Errors
    /// As [`Fields::convert`].
    pub fn position(&mut self) -> Result<Option<Position>, Fault> {
        let latitude = self.angle(2, 90.0, ["N", "S"])?;
        let longitude = self.angle(3, 180.0, ["E", "W"])?;
        match (latitude, longitude) {
            (Some(latitude), Some(longitude)) => Ok(Some(Position { latitude, longitude })),
            (None, None) => Ok(None),
            _ => Err(self.malformed()),
        }
    }

    /// The fault of the field that was taken last.
    #[must_use]
    pub fn malformed(&self) -> Fault {
        Fault::Malformed { field: self.taken }
    }

    fn angle(
        &mut self,
        width: usize,
        limit: f64,
        hemispheres: [&str; 2],
    ) -> Result<Option<f64>, Fault> {
        let degrees = self.convert(|text| {
            Position::parse_angle(text, width).filter(|degrees| *degrees <= limit)
        })?;
        let sign = self.convert(|text| match text {
            _ if text == hemispheres[0] => Some(1.0),
            _ if text == hemispheres[1] => Some(-1.0),
            _ => None,
        })?;
        match (degrees, sign) {
            (Some(degrees), Some(sign)) => Ok(Some((sign * degrees).to_radians())),
            (None, _) => Ok(None),
            (Some(_), None) => Err(self.malformed()),
        }
    }
}
