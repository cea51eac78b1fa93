//! The fields of one row, by name, as numbers.

use std::ops::Range;

use insd_base::{Geodetic, Ned, Time};

use super::report::{BadRow, RowFault};

/// Greatest |t_s|, s: 30 years, far inside the range of [`Time`].
const MAX_TIME: f64 = 1e9;

/// Where the named columns of a file stand in its lines.
#[derive(Debug)]
pub(super) struct Columns {
    /// Names as in the format.
    pub(super) names: &'static [&'static str],
    /// Their places in a line; `None` for an optional column that is not there.
    pub(super) places: Vec<Option<usize>>,
    /// Fields of a whole line, unknown columns included.
    pub(super) width: usize,
}

impl Columns {
    /// Names of the columns of the format that the file has.
    pub(super) fn present(&self) -> impl Iterator<Item = &'static str> {
        self.named(true)
    }

    /// Names of those that it lacks.
    pub(super) fn absent(&self) -> impl Iterator<Item = &'static str> {
        self.named(false)
    }

    fn named(&self, is_there: bool) -> impl Iterator<Item = &'static str> {
        let all = self.names.iter().zip(&self.places);
        all.filter(move |(_, place)| place.is_some() == is_there).map(|(name, _)| *name)
    }
}

/// One line, cut at its commas.
pub(super) struct Fields<'a> {
    pub(super) columns: &'a Columns,
    pub(super) line: &'a [u8],
    pub(super) number: u64,
    pub(super) cuts: &'a [Range<usize>],
}

/// Cuts a line at its commas into `cuts`.
pub(super) fn cut(line: &[u8], cuts: &mut Vec<Range<usize>>) {
    cuts.clear();
    let mut start = 0;
    for comma in memchr::memchr_iter(b',', line) {
        cuts.push(start..comma);
        start = comma + 1;
    }
    cuts.push(start..line.len());
}

impl Fields<'_> {
    /// The raw field, empty for an absent column. Columns are counted as in the row's `COLUMNS`.
    pub(super) fn raw(&self, column: usize) -> &[u8] {
        match self.columns.places[column] {
            Some(place) => self.line[self.cuts[place].clone()].trim_ascii(),
            None => b"",
        }
    }

    /// A number, or `None` for an empty field.
    pub(super) fn number(&self, column: usize) -> Result<Option<f64>, BadRow> {
        let raw = self.raw(column);
        if raw.is_empty() {
            return Ok(None);
        }
        match fast_float2::parse::<f64, _>(raw) {
            Ok(value) if value.is_finite() => Ok(Some(value)),
            Ok(_) => Err(self.bad(column, RowFault::NotFinite)),
            Err(_) => Err(self.bad(column, RowFault::NotANumber)),
        }
    }

    /// A number within a range, or `None` for an empty field.
    pub(super) fn within(
        &self,
        column: usize,
        range: std::ops::RangeInclusive<f64>,
    ) -> Result<Option<f64>, BadRow> {
        match self.number(column)? {
            Some(value) if !range.contains(&value) => Err(self.bad(column, RowFault::OutOfRange)),
            other => Ok(other),
        }
    }

    /// A number that must be there.
    pub(super) fn required(&self, column: usize) -> Result<f64, BadRow> {
        self.number(column)?.ok_or_else(|| self.bad(column, RowFault::Empty))
    }

    /// An instant that must be there, from seconds.
    pub(super) fn time(&self, column: usize) -> Result<Time, BadRow> {
        self.optional_time(column)?.ok_or_else(|| self.bad(column, RowFault::Empty))
    }

    /// An instant, from seconds.
    pub(super) fn optional_time(&self, column: usize) -> Result<Option<Time>, BadRow> {
        Ok(self.within(column, -MAX_TIME..=MAX_TIME)?.map(Time::from_seconds))
    }

    /// Three numbers from `first` on; `None` if one of them is empty.
    pub(super) fn triple(&self, first: usize) -> Result<Option<Ned>, BadRow> {
        let (north, east, down) =
            (self.number(first)?, self.number(first + 1)?, self.number(first + 2)?);
        Ok(match (north, east, down) {
            (Some(north), Some(east), Some(down)) => Some(Ned::new(north, east, down)),
            _ => None,
        })
    }

    /// Latitude and longitude from columns `first` and `first + 1`, deg; `None` if one is empty.
    /// Longitudes up to 360 deg are taken and brought to (-180, 180]. The height is left at 0.
    pub(super) fn latitude_longitude(&self, first: usize) -> Result<Option<Geodetic>, BadRow> {
        let latitude = self.within(first, -90.0..=90.0)?;
        let longitude = self.within(first + 1, -180.0..=360.0)?;
        Ok(latitude.zip(longitude).map(|(latitude, longitude)| {
            let east = if longitude > 180.0 { longitude - 360.0 } else { longitude };
            Geodetic::from_degrees(latitude, east, 0.0)
        }))
    }

    /// A fault of one field of this row.
    pub(super) fn bad(&self, column: usize, fault: RowFault) -> BadRow {
        BadRow::new(self.number, self.columns.names[column], fault, self.raw(column))
    }
}
