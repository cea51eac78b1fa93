//! The header of a file of observations (RINEX 2.11, table A1; RINEX 3.05, table A2).

use insd_base::{Constellation, SignalCode};

use crate::calendar::{BEIDOU_BEHIND, TimeSystem};
use crate::decimal::{decimal, whole};
use crate::error::{Flaw, RinexError};
use crate::observation::codes::{Layout, early, modern};
use crate::text::{Lines, columns, is_blank, label, words};

/// A receiver or an antenna.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Equipment {
    /// Serial number.
    pub number: String,
    /// Type, of an antenna with its radome.
    pub kind: String,
    /// Version of its firmware; of an antenna always empty.
    pub version: String,
}

/// What a file of observations says before its first epoch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObservationHeader {
    /// Version of the format, hundredths: 305 is 3.05.
    pub version: u16,
    /// The only constellation, or `None` in a mixed file.
    pub constellation: Option<Constellation>,
    /// Name of the marker.
    pub marker: String,
    /// Its receiver.
    pub receiver: Equipment,
    /// Its antenna.
    pub antenna: Equipment,
    /// Where it is about, m, in Earth-fixed axes.
    pub position: Option<[f64; 3]>,
    /// Whether the antenna moves, as a record of flag 2 says, and one of flag 3 ends; its place is then that of the epoch that came last.
    pub is_moving: bool,
    /// Antenna's reference point from the marker: up, east, north, m.
    pub antenna_delta: Option<[f64; 3]>,
    /// Interval of the epochs, s.
    pub interval: Option<f64>,
    /// System of the times in the file; those that the reader gives are GPS time all the same.
    pub time_system: TimeSystem,
    /// GPS - UTC, s.
    pub leap_seconds: Option<i8>,
    /// Whether the receiver's clock offset is already applied to epochs, ranges and phases.
    pub clock_offset_applied: bool,
    /// Unit of the signal strengths, `DBHZ` or another; `None` where the file does not say.
    pub strength_unit: Option<String>,
    /// Frequency channels of the GLONASS satellites by their numbers.
    pub glonass_channels: Vec<(u8, i8)>,
    /// The signals of each constellation in the order of their columns.
    pub signals: Vec<(Constellation, Vec<SignalCode>)>,
}

impl ObservationHeader {
    /// Of a file of RINEX 3.05 of a marker, with strengths in dB Hz.
    #[must_use]
    pub fn of_marker(marker: &str) -> Self {
        ObservationHeader {
            version: 305,
            marker: marker.to_owned(),
            strength_unit: Some("DBHZ".to_owned()),
            ..ObservationHeader::default()
        }
    }
}

/// Types as they stand, of which layouts are made when all lines are there.
#[derive(Clone, Debug, Default)]
struct Listed {
    /// Version 2: one list for all constellations.
    early: Vec<[u8; 2]>,
    /// Version 3: one list for each.
    modern: Vec<(Constellation, Vec<[u8; 3]>)>,
    /// Types still to come on lines of continuation.
    due: usize,
}

/// A header as it is being read, with what the body needs to know of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Draft {
    pub(crate) header: ObservationHeader,
    /// Fields of the header that could not be read and are left out.
    pub(crate) flaws: Vec<Flaw>,
    /// Version 2: whether the phases of bands 1 and 2 are those of receivers that square, ambiguous by half cycles.
    pub(crate) squared: [bool; 2],
    layouts: Vec<(Constellation, Layout)>,
    listed: Listed,
}

/// Most types of one constellation: three times what receivers of all signals tell.
const MOST_TYPES: usize = 200;

const TYPES: &str = "SYS / # / OBS TYPES";
const EARLY_TYPES: &str = "# / TYPES OF OBSERV";

impl Draft {
    /// Reads up to the end of the header.
    pub(crate) fn read(lines: &mut Lines<'_>) -> Result<Self, RinexError> {
        let mut draft = Self::default();
        draft.version(lines)?;
        loop {
            let line = lines.next().ok_or(RinexError::Missing("END OF HEADER"))?;
            if label(line) == b"END OF HEADER" {
                break;
            }
            draft.line(line, lines.number())?;
        }
        draft.settle();
        if draft.layouts.is_empty() {
            let missing = if draft.is_early() { EARLY_TYPES } else { TYPES };
            return Err(RinexError::Missing(missing));
        }
        Ok(draft)
    }

    /// Whether it is of version 2.
    pub(crate) fn is_early(&self) -> bool {
        self.header.version < 300
    }

    /// The columns of a constellation.
    pub(crate) fn layout(&self, constellation: Constellation) -> Option<&Layout> {
        self.layouts.iter().find(|(own, _)| *own == constellation).map(|(_, layout)| layout)
    }

    /// Number of columns of a constellation, as the text has them.
    pub(crate) fn width(&self, constellation: Constellation) -> Option<usize> {
        self.layout(constellation).map(|layout| layout.columns.len())
    }

    /// Whether signal strengths are carrier to noise densities in dB Hz.
    pub(crate) fn strength_is_cn0(&self) -> bool {
        self.header.strength_unit.as_ref().is_none_or(|unit| unit == "DBHZ")
    }

    /// The channel of a GLONASS satellite.
    pub(crate) fn channel(&self, number: u8) -> Option<i8> {
        let channels = &self.header.glonass_channels;
        channels.iter().find(|(own, _)| *own == number).map(|(_, channel)| *channel)
    }

    fn version(&mut self, lines: &mut Lines<'_>) -> Result<(), RinexError> {
        let line = lines.next().ok_or(RinexError::Missing("RINEX VERSION / TYPE"))?;
        let number = lines.number();
        let flaw = |expected, found| Flaw::new(number, "RINEX VERSION / TYPE", expected, found);
        if label(line) != b"RINEX VERSION / TYPE" {
            return Err(flaw("this label in columns 61 to 80", line).into());
        }
        self.header.version = version(line, number)?;
        if columns(line, 20, 21) != b"O" {
            return Err(flaw("a file of observations, O in column 21", line).into());
        }
        let letter = columns(line, 40, 41).first().map_or(' ', |byte| char::from(*byte));
        self.header.constellation = match letter {
            'M' => None,
            ' ' => Some(Constellation::Gps),
            letter => Some(
                Constellation::from_letter(letter)
                    .ok_or_else(|| flaw("M or the letter of a constellation in column 41", line))?,
            ),
        };
        self.header.time_system = match self.header.constellation {
            Some(Constellation::Glonass) => TimeSystem::Glonass,
            Some(Constellation::BeiDou) => TimeSystem::BeiDou,
            _ => TimeSystem::Gps,
        };
        Ok(())
    }

    /// Takes in one line, of the header or of an event in the body.
    pub(crate) fn line(&mut self, line: &[u8], number: usize) -> Result<(), Flaw> {
        match label(line) {
            b"SYS / # / OBS TYPES" => return self.modern_types(line, number),
            b"# / TYPES OF OBSERV" => return self.early_types(line, number),
            b"TIME OF FIRST OBS" => return self.first(line, number),
            b"SYS / SCALE FACTOR" => return scale(line, number),
            b"WAVELENGTH FACT L1/2" => return self.wavelengths(line, number),
            b"MARKER NAME" => self.header.marker = words(line, 0, 60),
            b"REC # / TYPE / VERS" => self.header.receiver = equipment(line),
            b"ANT # / TYPE" => self.header.antenna = equipment(line),
            b"SIGNAL STRENGTH UNIT" => self.header.strength_unit = Some(words(line, 0, 20)),
            _ => self.numbers(line, number),
        }
        Ok(())
    }

    /// Lines of numbers without which the rest can be read.
    fn numbers(&mut self, line: &[u8], number: usize) {
        let taken = match label(line) {
            b"APPROX POSITION XYZ" => triple(line).map(|position| {
                self.header.position =
                    position.filter(|position| position.iter().any(|x| x.abs() >= 1.0));
            }),
            b"ANTENNA: DELTA H/E/N" => triple(line).map(|delta| self.header.antenna_delta = delta),
            b"INTERVAL" => decimal(columns(line, 0, 10)).ok().map(|interval| {
                self.header.interval = interval.filter(|interval| *interval > 0.0);
            }),
            b"LEAP SECONDS" => {
                leap_seconds(line).map(|leaps| self.header.leap_seconds = Some(leaps))
            }
            b"RCV CLOCK OFFS APPL" => whole(columns(line, 0, 6)).ok().map(|applied| {
                self.header.clock_offset_applied = applied == Some(1);
            }),
            b"GLONASS SLOT / FRQ #" => self.channels(line),
            _ => Some(()),
        };
        if taken.is_none() {
            self.flaws.push(Flaw::new(
                number,
                "header",
                "numbers in the columns of its label",
                line,
            ));
        }
    }

    /// Eight pairs of satellite and channel in columns 5 to 60.
    fn channels(&mut self, line: &[u8]) -> Option<()> {
        for pair in columns(line, 4, 60).chunks(7).filter(|pair| !is_blank(pair)) {
            let slot = whole(columns(pair, 1, 3)).ok()??;
            let channel = whole(columns(pair, 4, 6)).ok()??;
            let (slot, channel) = (u8::try_from(slot).ok()?, i8::try_from(channel).ok()?);
            self.header.glonass_channels.retain(|(own, _)| *own != slot);
            self.header.glonass_channels.push((slot, channel));
        }
        Some(())
    }

    fn first(&mut self, line: &[u8], number: usize) -> Result<(), Flaw> {
        let name = columns(line, 48, 51).trim_ascii();
        if !name.is_empty() {
            let expected = "GPS, GLO, GAL, QZS, BDT or IRN in columns 49 to 51";
            self.header.time_system = TimeSystem::from_name(name)
                .ok_or_else(|| Flaw::new(number, "TIME OF FIRST OBS", expected, name))?;
        }
        Ok(())
    }

    /// `2I6,I6`: 2 for half cycles. Lines for single satellites that say otherwise than the first are not read.
    fn wavelengths(&mut self, line: &[u8], number: usize) -> Result<(), Flaw> {
        let is_half = |from| matches!(whole(columns(line, from, from + 6)), Ok(Some(2)));
        let told = [is_half(0), is_half(6)];
        if matches!(whole(columns(line, 12, 18)), Ok(Some(1..))) {
            if told != self.squared {
                let expected = "the same factors for all satellites";
                self.flaws.push(Flaw::new(number, "WAVELENGTH FACT L1/2", expected, line));
            }
        } else {
            self.squared = told;
        }
        Ok(())
    }

    /// `A1,2X,I3,13(1X,A3)`; lines of continuation have neither letter nor number.
    fn modern_types(&mut self, line: &[u8], number: usize) -> Result<(), Flaw> {
        let flaw = |expected| Flaw::new(number, TYPES, expected, line);
        if !is_blank(columns(line, 0, 6)) {
            let letter = line.first().map(|byte| char::from(*byte));
            let constellation = letter
                .and_then(Constellation::from_letter)
                .ok_or_else(|| flaw("the letter of a constellation in column 1"))?;
            self.listed.due =
                count(columns(line, 3, 6)).ok_or_else(|| flaw("a number of types"))?;
            self.listed.modern.retain(|(own, _)| *own != constellation);
            self.listed.modern.push((constellation, Vec::new()));
        }
        let (_, types) =
            self.listed.modern.last_mut().ok_or_else(|| flaw("a constellation first"))?;
        for code in columns(line, 6, 58).chunks(4).take(self.listed.due) {
            let mut padded = [b' '; 3];
            for (to, from) in padded.iter_mut().zip(columns(code, 1, 4)) {
                *to = *from;
            }
            types.push(padded);
        }
        self.listed.due = self.listed.due.saturating_sub(13);
        Ok(())
    }

    /// `I6,9(4X,A1,A1)`; lines of continuation have no number.
    fn early_types(&mut self, line: &[u8], number: usize) -> Result<(), Flaw> {
        if !is_blank(columns(line, 0, 6)) {
            let due = count(columns(line, 0, 6));
            self.listed.due =
                due.ok_or_else(|| Flaw::new(number, EARLY_TYPES, "a number of types", line))?;
            self.listed.early.clear();
        }
        for code in columns(line, 6, 60).chunks(6).take(self.listed.due) {
            if let [.., kind, band] = columns(code, 4, 6) {
                self.listed.early.push([*kind, *band]);
            }
        }
        self.listed.due = self.listed.due.saturating_sub(9);
        Ok(())
    }

    /// Makes the layouts of the types that are listed.
    pub(crate) fn settle(&mut self) {
        let version = self.header.version;
        let listed = &self.listed;
        self.layouts = if self.is_early() {
            let all = Constellation::ALL.into_iter().filter(|_| !listed.early.is_empty());
            let layout =
                |own| Layout::new(listed.early.iter().map(|c| early(own, *c, &listed.early)));
            all.map(|own| (own, layout(own))).collect()
        } else {
            let layout = |own, codes: &[[u8; 3]]| {
                Layout::new(codes.iter().map(|code| modern(own, *code, version)))
            };
            listed.modern.iter().map(|(own, codes)| (*own, layout(*own, codes))).collect()
        };
        let signals = self.layouts.iter().map(|(own, layout)| (*own, layout.signals.clone()));
        self.header.signals = signals.filter(|(_, signals)| !signals.is_empty()).collect();
    }
}

/// The version in hundredths, of a first line whose label was seen.
pub(crate) fn version(line: &[u8], number: usize) -> Result<u16, Flaw> {
    let field = columns(line, 0, 9);
    let told = decimal(field).ok().flatten().filter(|told| (2.0..5.0).contains(told));
    // three digits at the most
    told.map(|told| (told * 100.0).round() as u16)
        .ok_or_else(|| Flaw::new(number, "RINEX VERSION / TYPE", "a version from 2 to 4", field))
}

/// GPS - UTC; BeiDou's count, which is so marked from version 3.05 on, is 14 s less.
pub(crate) fn leap_seconds(line: &[u8]) -> Option<i8> {
    let beidou = matches!(columns(line, 24, 27), b"BDS" | b"BDT");
    let told = whole(columns(line, 0, 6)).ok()??;
    i8::try_from(told.checked_add(if beidou { BEIDOU_BEHIND } else { 0 })?).ok()
}

fn equipment(line: &[u8]) -> Equipment {
    Equipment {
        number: words(line, 0, 20),
        kind: words(line, 20, 40),
        version: words(line, 40, 60),
    }
}

/// Three numbers `3F14.4`; `Some(None)` when blank.
fn triple(line: &[u8]) -> Option<Option<[f64; 3]>> {
    if is_blank(columns(line, 0, 42)) {
        return Some(None);
    }
    let number = |from| decimal(columns(line, from, from + 14)).ok().flatten();
    Some(Some([number(0)?, number(14)?, number(28)?]))
}

/// Scaled observations are refused rather than misread; nobody is known to write them.
fn scale(line: &[u8], number: usize) -> Result<(), Flaw> {
    match whole(columns(line, 2, 6)) {
        Ok(Some(1) | None) => Ok(()),
        _ => Err(Flaw::new(number, "SYS / SCALE FACTOR", "no factor but 1", line)),
    }
}

fn count(field: &[u8]) -> Option<usize> {
    usize::try_from(whole(field).ok()??).ok().filter(|count| *count <= MOST_TYPES)
}
