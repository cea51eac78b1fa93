//! Compact RINEX ("Hatanaka" compression), versions 1.0 for RINEX 2 and 3.0 for RINEX 3, made plain again (Y. Hatanaka, "A Compression
//! Format and Tools for GNSS Observation Data", Bulletin of the Geographical Survey Institute 55, 2008).
//!
//! Texts stand as what changed since the epoch before: a blank keeps a character, `&` is a blank, all else
//! replaces. Numbers stand as differences of a rising order: `3&123` begins a series of third differences.

use std::collections::BTreeMap;

use crate::decimal::whole;
use crate::error::{Flaw, Flaws, RinexError};
use crate::observation::{Draft, instant, satellite};
use crate::text::{Lines, columns, label};

/// A plain file made of a compact one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlainObservations {
    /// The text, for [`crate::ObservationReader`].
    pub text: String,
    /// What was left out: observations, satellites, or epochs up to the next that stands by itself.
    pub flaws: Flaws,
}

const LABEL: &str = "CRINEX VERS   / TYPE";

/// Satellites on a line of version 2, and observations.
const EARLY_SATELLITES: usize = 12;
const EARLY_FIELDS: usize = 5;

/// Most digits of an observation F14.3 without its point, and of a clock offset F15.12.
const LARGEST: i64 = 9_999_999_999_999;

/// Whether a text is compact RINEX.
#[must_use]
pub fn is_compact<T: AsRef<[u8]> + ?Sized>(text: &T) -> bool {
    Lines::new(text.as_ref()).next().is_some_and(|line| label(line) == LABEL.as_bytes())
}

/// Makes a compact file plain.
///
/// # Errors
/// When it is no compact file of version 1 or 3, or what it contains is no header of observations.
pub fn expand<T: AsRef<[u8]> + ?Sized>(text: &T) -> Result<PlainObservations, RinexError> {
    let mut lines = Lines::new(text.as_ref());
    let first = lines.next().ok_or(RinexError::Missing(LABEL))?;
    if label(first) != LABEL.as_bytes() || !matches!(first.first(), Some(b'1' | b'3')) {
        return Err(Flaw::new(1, LABEL, "this label, and version 1.0 or 3.0", first).into());
    }
    lines.next();
    let mut header = lines.clone();
    // the version stands in the first line of the plain header
    let mut counted = Lines::new(header.rest());
    let draft = Draft::read(&mut counted)?;
    let mut expansion = Expansion {
        lines: counted,
        offset: header.number(),
        draft,
        epoch: Vec::new(),
        clock: None,
        tracks: BTreeMap::new(),
        epochs: 0,
        plain: PlainObservations::default(),
    };
    for line in header.by_ref().take(expansion.lines.number()) {
        expansion.push_line(line);
    }
    while expansion.step() {}
    Ok(expansion.plain)
}

/// A series of differences.
#[derive(Clone, Debug)]
struct Series {
    order: usize,
    /// The newest value, then its differences; as many as have come so far.
    differences: Vec<i64>,
}

impl Series {
    /// Takes the next text of a series; `None` where it has no series to go on or leaves the range.
    fn next(own: &mut Option<Self>, text: &[u8]) -> Option<i64> {
        if let [order @ b'0'..=b'9', b'&', value @ ..] = text {
            let differences = vec![whole(value).ok()??];
            *own = Some(Self { order: usize::from(order - b'0'), differences });
        } else {
            let difference = whole(text).ok()??;
            own.as_mut()?.add(difference)?;
        }
        own.as_ref()?.differences.first().copied().filter(|value| value.abs() <= LARGEST)
    }

    fn add(&mut self, difference: i64) -> Option<()> {
        if self.differences.len() > self.order {
            self.differences.pop();
        }
        self.differences.push(difference);
        for index in (1..self.differences.len()).rev() {
            self.differences[index - 1] =
                self.differences[index - 1].checked_add(self.differences[index])?;
        }
        Some(())
    }
}

/// One satellite from epoch to epoch.
#[derive(Clone, Debug, Default)]
struct Track {
    /// The last epoch it was in.
    epoch: usize,
    series: Vec<Option<Series>>,
    /// Two flags for each observation.
    flags: Vec<u8>,
}

struct Expansion<'a> {
    lines: Lines<'a>,
    /// Lines before the plain header.
    offset: usize,
    draft: Draft,
    /// The epoch's line with its satellites; empty where the next has to stand by itself.
    epoch: Vec<u8>,
    clock: Option<Series>,
    tracks: BTreeMap<[u8; 3], Track>,
    epochs: usize,
    plain: PlainObservations,
}

/// Applies what changed to a text.
fn patch(text: &mut Vec<u8>, changes: &[u8]) {
    if text.len() < changes.len() {
        text.resize(changes.len(), b' ');
    }
    for (own, change) in text.iter_mut().zip(changes) {
        match change {
            b' ' => {}
            b'&' => *own = b' ',
            other => *own = *other,
        }
    }
}

/// A whole number of units of the last decimal as a decimal fraction.
fn fraction(number: i64, decimals: u32, width: usize) -> String {
    let power = 10_u64.pow(decimals);
    let (sign, size) = (if number < 0 { "-" } else { "" }, number.unsigned_abs());
    let digits = decimals as usize;
    // without a zero before the point, as the first program to do this wrote it
    let front = if size < power { String::new() } else { (size / power).to_string() };
    let text = format!("{sign}{front}.{:0digits$}", size % power);
    format!("{text:>width$}")
}

impl Expansion<'_> {
    fn is_early(&self) -> bool {
        self.draft.is_early()
    }

    fn push_line(&mut self, line: &[u8]) {
        self.plain.text.push_str(String::from_utf8_lossy(line).trim_end());
        self.plain.text.push('\n');
    }

    fn flaw(&mut self, field: &'static str, expected: &'static str, found: &[u8]) {
        let line = self.lines.number() + self.offset;
        self.plain.flaws.add(Flaw::new(line, field, expected, found));
    }

    /// Whether a line is an epoch that stands by itself.
    fn is_whole(&self, line: &[u8]) -> bool {
        line.first() == Some(if self.is_early() { &b'&' } else { &b'>' })
    }

    /// Takes the next epoch or event; false at the end.
    fn step(&mut self) -> bool {
        let Some(line) = self.lines.next() else { return false };
        if self.is_whole(line) {
            self.epoch = line.to_vec();
            if self.is_early() {
                self.epoch[0] = b' ';
            }
        } else if self.epoch.is_empty() {
            self.flaw("epoch", "an epoch that stands by itself", line);
            self.pass_over();
            return true;
        } else {
            patch(&mut self.epoch, line);
        }
        let (flag, count) = if self.is_early() { (28, 29) } else { (31, 32) };
        let told = whole(columns(&self.epoch, count, count + 3)).ok().flatten();
        let told = told.and_then(|told| usize::try_from(told).ok());
        let flag = self.epoch.get(flag).copied().unwrap_or(b' ');
        match told {
            Some(count) if (b'2'..=b'5').contains(&flag) => self.event(Some(count)),
            // slips take as many lines as their satellites
            Some(_) if flag == b'6' => self.event(None),
            Some(count) if instant(&self.epoch, &self.draft).is_some() => self.observations(count),
            _ => {
                self.flaw("epoch", "a date, a flag and a number of satellites", line);
                self.pass_over();
            }
        }
        true
    }

    /// Leaves out what stands before the next epoch that stands by itself.
    fn pass_over(&mut self) {
        self.epoch.clear();
        self.tracks.clear();
        while self.lines.peek().is_some_and(|line| !self.is_whole(line)) {
            self.lines.next();
        }
    }

    /// Lines that are as in the plain file.
    fn event(&mut self, count: Option<usize>) {
        let head = std::mem::take(&mut self.epoch);
        self.push_line(&head);
        self.tracks.clear();
        for _ in 0..count.unwrap_or(usize::MAX) {
            let Some(line) = self.lines.peek().filter(|line| !self.is_whole(line)) else { break };
            self.lines.next();
            self.push_line(line);
            if let Err(flaw) = self.draft.line(line, self.lines.number() + self.offset) {
                self.plain.flaws.add(flaw);
            }
        }
        self.draft.settle();
    }

    fn observations(&mut self, count: usize) {
        let Some(clock) = self.lines.next() else { return };
        let clock = self.clock_offset(clock);
        let from = if self.is_early() { 32 } else { 41 };
        let names = columns(&self.epoch, from, from + 3 * count).to_vec();
        self.push_head(&names, clock);
        self.epochs += 1;
        for index in 0..count {
            let Some(line) = self.lines.peek().filter(|line| !self.is_whole(line)) else {
                self.flaw("epoch", "as many satellites as it says", b"fewer");
                return self.pass_over();
            };
            self.lines.next();
            self.satellite(columns(&names, 3 * index, 3 * index + 3), line);
        }
    }

    fn clock_offset(&mut self, text: &[u8]) -> Option<i64> {
        if text.trim_ascii().is_empty() {
            self.clock = None;
            return None;
        }
        let clock = Series::next(&mut self.clock, text.trim_ascii());
        if clock.is_none() {
            self.flaw("receiver clock offset", "a difference", text);
        }
        clock
    }

    /// Version 2 names the satellites here, and on more lines when there are more than twelve.
    fn push_head(&mut self, names: &[u8], clock: Option<i64>) {
        let early = self.is_early();
        let (head, pad, decimals, width) = if early { (32, 68, 9, 12) } else { (35, 41, 12, 15) };
        let mut line = columns(&self.epoch, 0, head).to_vec();
        let mut rows = names.chunks(3 * EARLY_SATELLITES);
        if early {
            line.extend_from_slice(rows.next().unwrap_or_default());
        }
        if let Some(clock) = clock {
            line.resize(pad, b' ');
            line.extend_from_slice(fraction(clock, decimals, width).as_bytes());
        }
        self.push_line(&line);
        for row in rows.filter(|_| early) {
            self.push_line(&[&[b' '; 32], row].concat());
        }
    }

    fn satellite(&mut self, name: &[u8], line: &[u8]) {
        let only = self.draft.header.constellation;
        let width = satellite(name, only).and_then(|own| self.draft.width(own.constellation));
        let (Some(width), Ok(name)) = (width, <[u8; 3]>::try_from(name)) else {
            self.flaw("satellite", "a satellite of a constellation that the header has", name);
            return;
        };
        let mut track = self.tracks.remove(&name).unwrap_or_default();
        if track.epoch + 1 != self.epochs || track.series.len() != width {
            track = Track { epoch: 0, series: vec![None; width], flags: vec![b' '; 2 * width] };
        }
        track.epoch = self.epochs;
        let mut rest = line;
        let mut values = Vec::with_capacity(width);
        for (series, flags) in track.series.iter_mut().zip(track.flags.chunks_mut(2)) {
            let end = rest.iter().position(|byte| *byte == b' ').unwrap_or(rest.len());
            let text = &rest[..end];
            rest = rest.get(end + 1..).unwrap_or_default();
            if text.is_empty() && series.is_some() {
                // the flags of what goes missing go with it, and are told anew where they do not
                flags.fill(b' ');
            }
            let value = Series::next(series, text);
            if value.is_none() {
                *series = None;
                if !text.is_empty() {
                    self.flaw("observation", "a difference that goes on", text);
                }
            }
            values.push(value);
        }
        patch(&mut track.flags, &rest[..rest.len().min(2 * width)]);
        if track.flags.iter().any(|flag| !flag.is_ascii_digit() && *flag != b' ') {
            self.flaw("flags", "digits and blanks", rest);
            track.flags.fill(b' ');
        }
        self.push_satellite(&name, &values, &track.flags);
        self.tracks.insert(name, track);
    }

    fn push_satellite(&mut self, name: &[u8; 3], values: &[Option<i64>], flags: &[u8]) {
        let early = self.is_early();
        let mut line = if early { Vec::new() } else { name.to_vec() };
        for (index, (value, flags)) in values.iter().zip(flags.chunks(2)).enumerate() {
            if early && index > 0 && index % EARLY_FIELDS == 0 {
                self.push_line(&line);
                line.clear();
            }
            let text = value.map_or(String::new(), |value| fraction(value, 3, 14));
            line.extend_from_slice(format!("{text:14}").as_bytes());
            line.extend_from_slice(flags);
        }
        self.push_line(&line);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn compact(body: &str) -> String {
        let headed = |contents: &str, label: &str| format!("{contents:<60}{label}\n");
        headed("3.0                 COMPACT RINEX FORMAT", LABEL)
            + &headed("", "CRINEX PROG / DATE")
            + &headed("     3.04           OBSERVATION DATA    G", "RINEX VERSION / TYPE")
            + &headed("G    2 C1C L1C", "SYS / # / OBS TYPES")
            + &headed("", "END OF HEADER")
            + body
    }

    /// What follows the header.
    fn plain(body: &str) -> (Vec<String>, Vec<String>) {
        let plain = expand(&compact(body)).unwrap();
        let lines = plain.text.lines().skip(3).map(str::to_owned).collect();
        (lines, plain.flaws.first.iter().map(ToString::to_string).collect())
    }

    const FIRST: &str = "> 2021 09 22 06 30  0.0000000  0  2      G01G02\n\n";

    #[test]
    fn epochs_are_what_changed_since_the_one_before() {
        let body = FIRST.to_owned()
            + "3&20000000123 3&-100500  716\n1&5000\n"
            + "                    1             1         &&&\n5&-1000\n10 -100  &\n"
            + "                    2\n7\n5 -20\n";
        let (lines, flaws) = plain(&body);
        assert!(flaws.is_empty(), "{flaws:?}");
        assert_eq!(
            lines,
            [
                "> 2021 09 22 06 30  0.0000000  0  2",
                "G01  20000000.123 7      -100.50016",
                "G02         5.000",
                "> 2021 09 22 06 30  1.0000000  0  1       -.000000001000",
                "G01  20000000.133        -100.60016",
                "> 2021 09 22 06 30  2.0000000  0  1       -.000000000993",
                "G01  20000000.148        -100.72016",
            ]
        );
    }

    #[test]
    fn a_series_that_breaks_is_left_out_until_it_begins_anew() {
        let second = "                    1\n\n";
        let body = FIRST.to_owned()
            + "1&1000 1&1000\n1&1000 x\n"
            + second
            + "1x 1\n1 1\n"
            + "                    2\n\n"
            + "1 1\n3&7000 1\n";
        let (lines, flaws) = plain(&body);
        let codes: Vec<&str> = lines
            .iter()
            .filter(|line| line.starts_with('G'))
            .map(|line| line[3..].trim())
            .collect();
        let expected = ["1.000           1.000", "1.000", "1.001", "1.001", "1.002", "7.000"];
        assert_eq!(codes, expected);
        assert_eq!(flaws.len(), 5, "{flaws:#?}");
        assert!(flaws[0].starts_with("line 9: observation: "), "{}", flaws[0]);
    }

    #[test]
    fn after_a_cut_the_next_whole_epoch_counts() {
        let whole = FIRST.to_owned() + "1&1000 1&1000\n1&1000 1&1000\n";
        let body = whole.clone()
            + "                   x1\n\n1 1\n1 1\n"
            + &whole.replace("30  0.0", "31  0.0");
        let (lines, flaws) = plain(&body);
        assert_eq!(lines.len(), 6);
        assert_eq!(flaws.len(), 1, "{flaws:?}");
    }

    #[test]
    fn what_is_not_compact_is_refused() {
        assert!(!is_compact("") && is_compact(&compact("")));
        assert!(expand("").is_err());
        assert!(expand(&compact("").replacen("3.0 ", "2.0 ", 1)).is_err());
        assert!(expand(&compact("").replace("END OF", "")).is_err());
    }

    proptest! {
        #[test]
        fn a_series_of_any_order_gives_back_its_values(
            values in prop::collection::vec(-LARGEST..=LARGEST, 1..20),
            order in 0_usize..4,
        ) {
            let mut differences: Vec<i64> = Vec::new();
            let mut series = None;
            for value in values {
                let (mut newest, mut told) = (vec![value], value);
                for old in differences.iter().take(order) {
                    told -= old;
                    newest.push(told);
                }
                let first = differences.is_empty();
                let text = if first { format!("{order}&{value}") } else { told.to_string() };
                differences = newest;
                prop_assert_eq!(Series::next(&mut series, text.as_bytes()), Some(value));
            }
        }
    }
}
