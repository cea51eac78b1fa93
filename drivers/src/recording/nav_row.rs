//! A row of `nav.csv`: a solution, and what it says of how far it may be relied on.

use insd_base::{Availability, Solution, SolutionSource, Time};

use super::fields::Fields;
use super::reader::Rows;
use super::report::{BadRow, FileReport, RowFault};
use super::rows::{NAV, solution};
use super::table::Row;

/// Where the columns behind the mode stand in [`NAV`].
const HORIZONTAL: usize = 20;
const VERTICAL: usize = 21;
const INTEGRITY: usize = 22;
const EXCLUDED: usize = 23;
const SATELLITES: usize = 24;
const SOURCE: usize = 25;

/// More satellites than there are.
const MOST: f64 = 1000.0;

/// A row of `nav.csv`. What it does not say is `None`.
#[derive(Clone, Debug, PartialEq)]
pub struct NavRow {
    /// The solution. Of what was made of the sensors' words it says nothing; that stands below.
    pub solution: Solution,
    /// The horizontal error is said to be smaller, m.
    pub horizontal_level: Option<f64>,
    /// The error of the height is said to be smaller, m.
    pub vertical_level: Option<f64>,
    /// Whether it may be relied on.
    pub integrity: Option<Availability>,
    /// Whoever is left out: `gnss`, `log`, or words of another program (`G07`, `a2`).
    pub excluded: Vec<String>,
    /// Of how many satellites the ranges are in use.
    pub satellites: Option<u32>,
}

impl Rows<NavRow> {
    /// Rows that never were in a file, with all columns.
    #[must_use]
    pub fn told(rows: Vec<NavRow>) -> Self {
        Rows { rows, report: FileReport::default(), columns: NAV.to_vec() }
    }
}

impl Row for NavRow {
    const COLUMNS: &'static [&'static str] = NAV;
    const OPTIONAL: &'static [&'static [&'static str]] =
        &[&["hpl_m"], &["vpl_m"], &["integrity"], &["excluded"], &["satellites"], &["source"]];

    fn parse(fields: &Fields<'_>) -> Result<Self, BadRow> {
        let level = |column| fields.within(column, 0.0..=f64::MAX);
        Ok(NavRow {
            solution: Solution {
                source: of_word(fields, SOURCE, SolutionSource::from_word)?,
                ..solution(fields)?
            },
            horizontal_level: level(HORIZONTAL)?,
            vertical_level: level(VERTICAL)?,
            integrity: of_word(fields, INTEGRITY, Availability::from_word)?,
            excluded: excluded(fields)?,
            satellites: satellites(fields)?,
        })
    }

    fn time(&self) -> Time {
        self.solution.time
    }

    /// A row that is left out because of them might be the one that misled.
    fn is_fatal(bad: &BadRow) -> bool {
        NAV[HORIZONTAL..].contains(&bad.column)
    }
}

/// What a word of a column stands for; `None` where the column is empty or not there.
fn of_word<T>(
    fields: &Fields<'_>,
    column: usize,
    read: fn(&str) -> Option<T>,
) -> Result<Option<T>, BadRow> {
    let word = fields.raw(column);
    if word.is_empty() {
        return Ok(None);
    }
    let known = std::str::from_utf8(word).ok().and_then(read);
    known.map(Some).ok_or_else(|| fields.bad(column, RowFault::UnknownWord))
}

fn satellites(fields: &Fields<'_>) -> Result<Option<u32>, BadRow> {
    let count = fields.within(SATELLITES, 0.0..=MOST)?;
    if count.is_some_and(|count| count.fract() != 0.0) {
        return Err(fields.bad(SATELLITES, RowFault::NotANumber));
    }
    Ok(count.map(|count| count as u32))
}

/// Words of letters, digits and underscores, between spaces.
fn excluded(fields: &Fields<'_>) -> Result<Vec<String>, BadRow> {
    let is_of_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b' ';
    let text = std::str::from_utf8(fields.raw(EXCLUDED)).ok();
    let text = text.filter(|text| text.bytes().all(is_of_word));
    let text = text.ok_or_else(|| fields.bad(EXCLUDED, RowFault::UnknownWord))?;
    Ok(text.split_ascii_whitespace().map(str::to_owned).collect())
}
