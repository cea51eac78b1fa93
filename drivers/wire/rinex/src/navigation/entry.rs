//! One record of a navigation file: lines of numbers D19.12, three behind the date, then four on each line.

use insd_base::{GpsTime, SatelliteId};

use crate::calendar::{Civil, SECOND, TimeSystem};
use crate::decimal::{decimal, push_scientific, scientific, whole};
use crate::error::Flaw;
use crate::text::columns;

/// Columns of a number.
const NUMBER: usize = 19;

/// Seconds that nobody means: "not known" in several fields (RINEX 3.05, tables A5 to A16).
const UNKNOWN: f64 = 0.9999e9;

/// The lines of a record with what was read of their surroundings.
#[derive(Clone, Debug)]
pub(crate) struct Entry<'a> {
    pub(crate) satellite: SatelliteId,
    /// Version 4: the message it came in.
    pub(crate) message: &'a [u8],
    /// Version 2, whose dates have years of two digits and whose columns are one to the left.
    pub(crate) early: bool,
    pub(crate) lines: Vec<&'a [u8]>,
    /// Number of the first of them.
    pub(crate) number: usize,
    /// GPS - UTC of the header.
    pub(crate) leap_seconds: Option<i8>,
}

impl Entry<'_> {
    /// Number of the line and text of the field of an index: 0 to 2 behind the date, then four on each line.
    fn field(&self, index: usize) -> (usize, &[u8]) {
        let early = usize::from(self.early);
        let (row, from) = match index.checked_sub(3) {
            None => (0, 23 - early + NUMBER * index),
            Some(rest) => (1 + rest / 4, 4 - early + NUMBER * (rest % 4)),
        };
        let line = self.lines.get(row).copied().unwrap_or_default();
        (self.number + row, columns(line, from, from + NUMBER))
    }

    /// A flaw of a field.
    pub(crate) fn flaw(&self, index: usize, name: &'static str, expected: &'static str) -> Flaw {
        let (line, found) = self.field(index);
        Flaw::new(line, name, expected, found)
    }

    /// The number of a field times ten to the power of `shift`; `None` where it is blank.
    pub(crate) fn optional(
        &self,
        index: usize,
        name: &'static str,
        shift: i32,
    ) -> Result<Option<f64>, Flaw> {
        let (_, field) = self.field(index);
        let number =
            scientific(field, shift).map_err(|_| self.flaw(index, name, "a number D19.12"))?;
        Ok(number)
    }

    /// The number of a field that may also say that it is not known.
    pub(crate) fn known(&self, index: usize, name: &'static str) -> Result<Option<f64>, Flaw> {
        Ok(self.optional(index, name, 0)?.filter(|number| *number < UNKNOWN))
    }

    /// The number of a field that has to be there.
    pub(crate) fn required(
        &self,
        index: usize,
        name: &'static str,
        shift: i32,
    ) -> Result<f64, Flaw> {
        self.optional(index, name, shift)?.ok_or_else(|| self.flaw(index, name, "a number D19.12"))
    }

    /// A whole number of a field that has to be there.
    pub(crate) fn count<T: TryFrom<i64>>(
        &self,
        index: usize,
        name: &'static str,
    ) -> Result<T, Flaw> {
        let number = self.required(index, name, 0)?;
        small(number).ok_or_else(|| self.flaw(index, name, "a whole number in its range"))
    }

    /// The date of the first line.
    pub(crate) fn date(&self, system: TimeSystem) -> Result<GpsTime, Flaw> {
        let line = self.lines.first().copied().unwrap_or_default();
        self.instant(line, system).ok_or_else(|| {
            let expected = "a date and a time of day that exist";
            Flaw::new(self.number, "epoch of clock", expected, columns(line, 0, 23))
        })
    }

    fn instant(&self, line: &[u8], system: TimeSystem) -> Option<GpsTime> {
        // version 2: I2,5(1X,I2),F5.1 with the year in two digits; later ones 1X,I4,5(1X,I2)
        let (places, second) = if self.early {
            ([(3, 5), (6, 8), (9, 11), (12, 14), (15, 17)], (17, 22))
        } else {
            ([(4, 8), (9, 11), (12, 14), (15, 17), (18, 20)], (20, 23))
        };
        let mut numbers = [0; 5];
        for (number, (from, to)) in numbers.iter_mut().zip(places) {
            *number = whole(columns(line, from, to)).ok()??;
        }
        if self.early {
            numbers[0] += if numbers[0] < 80 { 2000 } else { 1900 };
        }
        let second = decimal(columns(line, second.0, second.1)).ok()??;
        // tenths at the most, so that nothing is lost
        let tenths: i64 = small((second * 10.0).round())?;
        system.to_gps(Civil::new(numbers, tenths * SECOND / 10)?, self.leap_seconds)
    }
}

/// A whole number in the range of a type.
fn small<T: TryFrom<i64>>(number: f64) -> Option<T> {
    let is_small = number.fract() == 0.0 && number.abs() < 1e15;
    // exact, as it is whole and below 2^53
    is_small.then_some(number as i64).and_then(|number| T::try_from(number).ok())
}

/// Writes the satellite and the date of a record; what is finer than a second is lost.
pub(crate) fn push_date(out: &mut String, satellite: SatelliteId, civil: Civil) {
    let (year, month, day) = civil.date;
    let (hour, minute) = civil.clock;
    let second = civil.nanos / SECOND;
    out.push_str(&format!(
        "{satellite} {year:04} {month:02} {day:02} {hour:02} {minute:02} {second:02}"
    ));
}

/// Writes the numbers of a record with their shifts: three behind the date, then lines of four.
pub(crate) fn push_numbers(out: &mut String, numbers: &[(Option<f64>, i32)]) {
    for (index, (number, shift)) in numbers.iter().enumerate() {
        if index >= 3 && (index - 3) % 4 == 0 {
            out.push_str("\n    ");
        }
        push_scientific(out, *number, *shift);
    }
    out.push('\n');
}
