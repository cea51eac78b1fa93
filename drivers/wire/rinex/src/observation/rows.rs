//! The observations of one satellite as fields, and the line before the satellites of an epoch.

use insd_base::{Constellation, GpsTime, SatelliteId, SignalObservation};

use crate::calendar::Civil;
use crate::decimal::{decimal, nanoseconds, whole};
use crate::error::Flaw;
use crate::observation::codes::{Layout, Quantity};
use crate::observation::header::Draft;
use crate::text::{Lines, columns, is_blank};

/// Columns of one observation: F14.3, loss of lock, signal strength.
pub(crate) const FIELD: usize = 16;

/// Observations on a line of version 2.
pub(crate) const EARLY_FIELDS: usize = 5;

/// Satellites on a line of version 2.
const EARLY_SATELLITES: usize = 12;

/// The line that begins an epoch or tells an event (RINEX 2.11, table A2; RINEX 3.05, table A3).
#[derive(Clone, Debug)]
pub(crate) struct Head<'a> {
    /// 0 good, 1 after a power failure, 2 to 5 events, 6 cycle slips.
    pub(crate) flag: u8,
    /// Satellites that follow, or lines of an event.
    pub(crate) count: usize,
    /// The instant; events need none.
    pub(crate) tag: Option<GpsTime>,
    /// Version 2: lines with the names of the satellites.
    pub(crate) names: Vec<&'a [u8]>,
    /// Its number.
    pub(crate) line: usize,
}

/// Where the fields of a head stand: year, month, day, hour, minute, second, flag and count, from and to.
struct Places {
    date: [(usize, usize); 5],
    second: (usize, usize),
    flag: usize,
    count: (usize, usize),
}

const EARLY: Places = Places {
    date: [(1, 3), (4, 6), (7, 9), (10, 12), (13, 15)],
    second: (15, 26),
    flag: 28,
    count: (29, 32),
};

const MODERN: Places = Places {
    date: [(2, 6), (7, 9), (10, 12), (13, 15), (16, 18)],
    second: (18, 29),
    flag: 31,
    count: (32, 35),
};

/// Whether a line begins an epoch or an event. Lines of version 2 carry no mark: an observation has its point in
/// column 11 or 27, an epoch in 19, and an event without a date is blank but for its flag.
pub(crate) fn is_head(line: &[u8], early: bool) -> bool {
    if !early {
        return line.first() == Some(&b'>');
    }
    let at = |place: usize| line.get(place).copied().unwrap_or(b' ');
    let flagged = at(28).is_ascii_digit() && at(26) == b' ' && at(27) == b' ';
    let dated = at(18) == b'.' && at(10) != b'.';
    flagged && (dated || is_blank(columns(line, 0, 28)))
}

/// Reads a head, of version 2 with the lines that only name satellites.
pub(crate) fn head<'a>(
    line: &'a [u8],
    lines: &mut Lines<'a>,
    draft: &Draft,
) -> Result<Head<'a>, Flaw> {
    let early = draft.is_early();
    let places = if early { EARLY } else { MODERN };
    let number = lines.number();
    let flaw = |field, expected| Flaw::new(number, field, expected, line);
    let field = |(from, to)| columns(line, from, to);
    let flag = match field((places.flag, places.flag + 1)) {
        [digit @ b'0'..=b'6'] => digit - b'0',
        [b' '] => 0,
        _ => return Err(flaw("epoch flag", "0 to 6")),
    };
    let count =
        whole(field(places.count)).ok().flatten().and_then(|count| usize::try_from(count).ok());
    let count = count.ok_or_else(|| flaw("number of satellites", "a number in its columns"))?;
    let tag = instant(line, draft);
    if tag.is_none() && !(2..=5).contains(&flag) {
        return Err(flaw("epoch", "a date and a time of day that exist"));
    }
    let mut names = Vec::new();
    if early && (flag < 2 || flag == 6) {
        names.push(columns(line, 32, 68));
        while names.len() * EARLY_SATELLITES < count {
            let more = lines.peek().filter(|more| is_blank(columns(more, 0, 32)));
            let Some(more) = more else { break };
            lines.next();
            names.push(columns(more, 32, 68));
        }
    }
    Ok(Head { flag, count, tag, names, line: number })
}

/// The instant of a head, where it is a date and a time of day.
pub(crate) fn instant(line: &[u8], draft: &Draft) -> Option<GpsTime> {
    let places = if draft.is_early() { EARLY } else { MODERN };
    let mut numbers = [0; 5];
    for (number, (from, to)) in numbers.iter_mut().zip(places.date) {
        *number = whole(columns(line, from, to)).ok()??;
    }
    if draft.is_early() {
        // two digits from 1980 to 2079 (RINEX 2.11, 6.5)
        numbers[0] += if numbers[0] < 80 { 2000 } else { 1900 };
    }
    let nanos = nanoseconds(columns(line, places.second.0, places.second.1)).ok()??;
    let civil = Civil::new(numbers, nanos)?;
    draft.header.time_system.to_gps(civil, draft.header.leap_seconds)
}

impl Head<'_> {
    /// The name of a satellite of version 2, in columns after those of the ones before.
    pub(crate) fn name(&self, index: usize) -> &[u8] {
        let line = self.names.get(index / EARLY_SATELLITES).copied().unwrap_or_default();
        let from = index % EARLY_SATELLITES * 3;
        columns(line, from, from + 3)
    }
}

/// A satellite by its three columns; in version 2 a blank letter is that of the file.
pub(crate) fn satellite(name: &[u8], only: Option<Constellation>) -> Option<SatelliteId> {
    let constellation = match name.first()? {
        b' ' => only.unwrap_or(Constellation::Gps),
        letter => Constellation::from_letter(char::from(*letter))?,
    };
    let number = whole(columns(name, 1, 3)).ok()??;
    SatelliteId::new(constellation, u8::try_from(number).ok()?)
}

/// The lines of one satellite: one of any length, or of version 2 several of five fields.
#[derive(Debug, Default)]
pub(crate) struct Rows<'a> {
    lines: Vec<&'a [u8]>,
    early: bool,
}

impl<'a> Rows<'a> {
    /// Takes the line of a satellite of version 3, behind its name.
    pub(crate) fn take_modern(&mut self, line: &'a [u8]) {
        self.lines.clear();
        self.early = false;
        self.lines.push(line.get(3..).unwrap_or_default());
    }

    /// Takes the lines of so many columns of version 2; false where the next epoch or the end comes first.
    pub(crate) fn take_early(&mut self, lines: &mut Lines<'a>, width: usize) -> bool {
        self.lines.clear();
        self.early = true;
        for _ in 0..width.div_ceil(EARLY_FIELDS) {
            match lines.peek().filter(|line| !is_head(line, true)) {
                Some(line) => self.lines.push(line),
                None => return false,
            }
            lines.next();
        }
        true
    }

    fn field(&self, index: usize) -> &'a [u8] {
        let (row, index) =
            if self.early { (index / EARLY_FIELDS, index % EARLY_FIELDS) } else { (0, index) };
        let line = self.lines.get(row).copied().unwrap_or_default();
        columns(line, index * FIELD, (index + 1) * FIELD)
    }

    /// Whether something stands behind the last column of the header.
    fn overflows(&self, width: usize) -> bool {
        let line = self.lines.first().copied().unwrap_or_default();
        !self.early && !is_blank(columns(line, width * FIELD, usize::MAX))
    }

    /// Reads the fields into the signals of the layout; an error names the field and what is there.
    pub(crate) fn read(
        &self,
        layout: &Layout,
        with_cn0: bool,
        signals: &mut [SignalObservation],
    ) -> Result<(), (&'static str, &'a [u8])> {
        let width = layout.columns.len();
        if self.overflows(width) {
            return Err(("no more observations than the header has types", self.field(width)));
        }
        for (index, column) in layout.columns.iter().enumerate() {
            let field = self.field(index);
            let Some((place, quantity)) = column else { continue };
            let Some(signal) = signals.get_mut(*place) else { continue };
            let value = decimal(columns(field, 0, 14)).map_err(|_| ("a number F14.3", field))?;
            let value = value.filter(|value| *value != 0.0);
            match quantity {
                Quantity::Code => signal.code = value,
                Quantity::Doppler => signal.doppler = value,
                Quantity::Strength => signal.cn0 = value.filter(|_| with_cn0),
                Quantity::Phase => {
                    signal.phase = value;
                    let lock = match field.get(14) {
                        None | Some(b' ') => 0,
                        Some(digit @ b'0'..=b'9') => digit - b'0',
                        Some(_) => return Err(("a digit for the loss of lock", field)),
                    };
                    signal.slip |= lock & 1 != 0;
                    signal.half_cycle = lock & 2 != 0;
                }
            }
        }
        Ok(())
    }
}
