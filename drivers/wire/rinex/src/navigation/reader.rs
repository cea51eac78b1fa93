//! Records out of a text.

use insd_base::{BroadcastRecord, Constellation, IonosphereModel, SatelliteId};

use crate::error::{Flaw, Flaws, RinexError};
use crate::navigation::entry::Entry;
use crate::navigation::ionosphere::Models;
use crate::navigation::{glonass, kepler};
use crate::observation::{leap_seconds, satellite, version};
use crate::text::{Lines, columns, is_blank, label};

/// What a file of navigation messages says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NavigationMessages {
    /// The records in the order of the file, also those that say the same.
    pub records: Vec<BroadcastRecord>,
    /// The newest model of the ionosphere that each constellation gave.
    pub ionosphere: Vec<(Constellation, IonosphereModel)>,
    /// GPS - UTC, s.
    pub leap_seconds: Option<i8>,
    /// Records that are well but of a kind that the vocabulary has no word for: CNAV, SBAS, time offsets, Earth orientation, BDGIM.
    pub skipped: usize,
    /// What was left out because it could not be read.
    pub flaws: Flaws,
}

/// How the records of a file begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Edition {
    /// Version 2: the number of a satellite of this constellation.
    Early(Constellation),
    /// Version 3: the name of the satellite.
    Modern,
    /// Version 4: a line with `>`, the kind of record, the satellite and the message.
    Marked,
}

/// Reads a file of navigation messages of version 2 (GPS, GLONASS), 3 or 4.
///
/// Times of GLONASS, which are UTC, become GPS time by the header's leap seconds, without them by the table of this version.
///
/// # Errors
/// When it is no header of such a file.
pub fn read_navigation<T: AsRef<[u8]> + ?Sized>(
    text: &T,
) -> Result<NavigationMessages, RinexError> {
    let mut lines = Lines::new(text.as_ref());
    let edition = edition(&mut lines)?;
    let mut navigation = NavigationMessages::default();
    let mut models = Models::default();
    header(&mut lines, &mut navigation, &mut models)?;
    while let Some(line) = lines.next() {
        if is_blank(line) {
            continue;
        }
        let number = lines.number();
        let body = body(line, &mut lines, edition);
        let taken = entry(line, body, number, edition).and_then(|(kind, mut entry)| {
            entry.leap_seconds = navigation.leap_seconds;
            take(kind, &entry, &mut navigation, &mut models)
        });
        if let Err(flaw) = taken {
            navigation.flaws.add(flaw);
        }
    }
    navigation.ionosphere = models.into_whole();
    Ok(navigation)
}

fn edition(lines: &mut Lines<'_>) -> Result<Edition, RinexError> {
    let line = lines.next().ok_or(RinexError::Missing("RINEX VERSION / TYPE"))?;
    let flaw = |expected| Flaw::new(1, "RINEX VERSION / TYPE", expected, line);
    if label(line) != b"RINEX VERSION / TYPE" {
        return Err(flaw("this label in columns 61 to 80").into());
    }
    match (version(line)?, columns(line, 20, 21)) {
        (..300, b"N") => Ok(Edition::Early(Constellation::Gps)),
        (..300, b"G") => Ok(Edition::Early(Constellation::Glonass)),
        (300..400, b"N") => Ok(Edition::Modern),
        (400.., b"N") => Ok(Edition::Marked),
        _ => {
            Err(flaw("a file of navigation messages, N or in version 2 also G in column 21").into())
        }
    }
}

fn header(
    lines: &mut Lines<'_>,
    navigation: &mut NavigationMessages,
    models: &mut Models,
) -> Result<(), RinexError> {
    loop {
        let line = lines.next().ok_or(RinexError::Missing("END OF HEADER"))?;
        let number = lines.number();
        let taken = match label(line) {
            b"END OF HEADER" => return Ok(()),
            b"IONOSPHERIC CORR" => models.line(line, number),
            b"ION ALPHA" => models.early(line, true, number),
            b"ION BETA" => models.early(line, false, number),
            b"LEAP SECONDS" => leap_seconds(line)
                .map(|leaps| navigation.leap_seconds = Some(leaps))
                .ok_or_else(|| Flaw::new(number, "LEAP SECONDS", "a number", line)),
            _ => Ok(()),
        };
        if let Err(flaw) = taken {
            navigation.flaws.add(flaw);
        }
    }
}

/// The lines of a record: of version 4 those behind the marked one, else the first and those that begin with blanks.
fn body<'a>(first: &'a [u8], lines: &mut Lines<'a>, edition: Edition) -> Vec<&'a [u8]> {
    let goes_on = |line: &[u8]| match edition {
        Edition::Marked => line.first() != Some(&b'>'),
        Edition::Early(_) => is_blank(columns(line, 0, 2)),
        Edition::Modern => is_blank(columns(line, 0, 3)),
    };
    let mut body = if edition == Edition::Marked { Vec::new() } else { vec![first] };
    while let Some(line) = lines.peek().filter(|line| goes_on(line)) {
        lines.next();
        body.push(line);
    }
    body
}

/// A record with its kind, `EPH` before version 4.
fn entry<'a>(
    first: &'a [u8],
    lines: Vec<&'a [u8]>,
    number: usize,
    edition: Edition,
) -> Result<(&'a [u8], Entry<'a>), Flaw> {
    let (name, only, kind, message) = match edition {
        Edition::Marked => {
            (columns(first, 6, 9), None, columns(first, 2, 5), columns(first, 10, 14).trim_ascii())
        }
        Edition::Modern => (columns(first, 0, 3), None, &b"EPH"[..], &b""[..]),
        Edition::Early(own) => (columns(first, 0, 2), Some(own), &b"EPH"[..], &b""[..]),
    };
    let is_early = only.is_some();
    let padded =
        [b' ', name.first().copied().unwrap_or(b' '), name.get(1).copied().unwrap_or(b' ')];
    let found = if is_early { satellite(&padded, only) } else { satellite(name, None) };
    let is_named = is_early || name.first().is_some_and(u8::is_ascii_uppercase);
    let is_marked = edition != Edition::Marked || first.first() == Some(&b'>');
    let satellite = found.filter(|_| is_named && is_marked).ok_or_else(|| {
        Flaw::new(number, "satellite", "the first line of a record with its satellite", first)
    })?;
    let number = if edition == Edition::Marked { number + 1 } else { number };
    Ok((kind, Entry { satellite, message, early: is_early, lines, number, leap_seconds: None }))
}

/// Takes in a record of whatever kind.
fn take(
    kind: &[u8],
    entry: &Entry<'_>,
    navigation: &mut NavigationMessages,
    models: &mut Models,
) -> Result<(), Flaw> {
    match kind {
        b"EPH" if is_known(entry.satellite, entry.message) => {
            let glonass = entry.satellite.constellation == Constellation::Glonass;
            navigation.records.push(if glonass {
                BroadcastRecord::Glonass(glonass::read(entry)?)
            } else {
                BroadcastRecord::Kepler(kepler::read(entry)?)
            });
        }
        b"ION" if models.message(entry)? => {}
        b"EPH" | b"ION" | b"STO" | b"EOP" => navigation.skipped += 1,
        _ => {
            let number = entry.number.saturating_sub(1);
            return Err(Flaw::new(number, "record", "EPH, STO, EOP or ION", kind));
        }
    }
    Ok(())
}

/// Whether the vocabulary has a record for a message; versions before 4 tell no message and mean the first of each.
fn is_known(satellite: SatelliteId, message: &[u8]) -> bool {
    use Constellation as C;
    match satellite.constellation {
        C::Gps | C::Qzss | C::Navic => matches!(message, b"" | b"LNAV"),
        C::Galileo => matches!(message, b"" | b"INAV" | b"FNAV"),
        C::BeiDou => matches!(message, b"" | b"D1" | b"D2"),
        C::Glonass => matches!(message, b"" | b"FDMA"),
        C::Sbas => false,
    }
}
