//! STA: what the system does, and how good that is.
//!
//! ```text
//! $PINSD,STA,hhmmss.ss,m,x,a,q,h,t,s,n,i,e*hh
//!            1         2 3 4 5 6 7 8 9 1011
//! 1 UTC
//! 2 mode: S standby, C coarse alignment, F fine alignment at the berth, M alignment in motion, A aided by
//!   GNSS, D dead reckoning by log or reference, I inertial alone, X fault
//! 3 whole seconds in this mode
//! 4 heading, as THS has it: A good, E estimated, S simulated, V not valid (M: manual)
//! 5 position, as GGA has it: 0 not valid, 1 GNSS, 2 differential, 4 RTK, 5 RTK float, 6 estimated,
//!   8 simulated
//! 6 heave: 0 not settled, 1 reduced, 2 settled
//! 7 time: P by pulses, M by messages, U unknown
//! 8 1 if any of this comes from a simulator, else 0
//! 9 number of active alerts
//! 10 whether the sensors bear it out: A they do, U it rests on a receiver on trial, V they contradict each other,
//!    N nobody compares them
//! 11 who is left out: N nobody, else letters of G the first GNSS receiver, S the second, T the third, L log, H heading,
//!   R other reference, I IMU
//! ```
//! Fields 10 and 11 came later: a line that ends before them is one of an older version.

use insd_base::{FixQuality, HeaveQuality, Integrity, Mode, Parties, Party};

use super::{flag, read_flag, read_letter};
use crate::nmea::civil::TimeOfDay;
use crate::nmea::fault::Fault;
use crate::nmea::fields::Fields;
use crate::nmea::line::Composer;
use crate::nmea::mode::{HeadingMode, letters};

/// Greatest number of seconds and of alerts.
const MAX_SECONDS: u32 = 999_999_999;
const MAX_ALERTS: u32 = 999;

/// What the system does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdMode {
    /// S: it waits for what it needs.
    Standby,
    /// C: levelling and first search for the heading.
    CoarseAlignment,
    /// F: at the berth.
    FineAlignment,
    /// M: under way, the heading is being found.
    InMotionAlignment,
    /// A: aligned, GNSS in use.
    Aided,
    /// D: aligned, log or reference in use, no GNSS.
    DeadReckoning,
    /// I: aligned, nothing but the IMU.
    Inertial,
    /// X: the solution must not be used.
    Fault,
}

/// How UTC is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdTime {
    /// P: by pulses, to microseconds.
    Pulses,
    /// M: by the receipt of messages, to milliseconds or tens of them.
    Messages,
    /// U: by the system clock alone, if at all.
    Unknown,
}

/// Whether the sensors bear out what is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdIntegrity {
    /// A: those that are used agree.
    Agreed,
    /// U: a receiver is used that was found to lie, and nothing shows that it does not any more.
    Unproven,
    /// V: they contradict each other, and it is not known who is wrong.
    Contradicted,
    /// N: nobody compares them.
    Unwatched,
}

letters! {
    PinsdMode {
        Standby b'S', CoarseAlignment b'C', FineAlignment b'F', InMotionAlignment b'M',
        Aided b'A', DeadReckoning b'D', Inertial b'I', Fault b'X'
    }
    PinsdTime { Pulses b'P', Messages b'M', Unknown b'U' }
    PinsdIntegrity { Agreed b'A', Unproven b'U', Contradicted b'V', Unwatched b'N' }
}

/// The letter of nobody.
const NOBODY: &str = "N";
/// Whose letter is whose.
const LETTERS: [(Party, char); Party::ALL.len()] = [
    (Party::Gnss, 'G'),
    (Party::Gnss2, 'S'),
    (Party::Gnss3, 'T'),
    (Party::Log, 'L'),
    (Party::Heading, 'H'),
    (Party::Reference, 'R'),
    (Party::Imu, 'I'),
];

impl From<Integrity> for PinsdIntegrity {
    fn from(integrity: Integrity) -> Self {
        match integrity {
            Integrity::Unwatched => PinsdIntegrity::Unwatched,
            Integrity::Consistent => PinsdIntegrity::Agreed,
            Integrity::Unproven => PinsdIntegrity::Unproven,
            Integrity::Contradiction => PinsdIntegrity::Contradicted,
        }
    }
}

impl From<Mode> for PinsdMode {
    fn from(mode: Mode) -> Self {
        match mode {
            Mode::Standby => PinsdMode::Standby,
            Mode::CoarseAlignment => PinsdMode::CoarseAlignment,
            Mode::FineAlignment => PinsdMode::FineAlignment,
            Mode::InMotionAlignment => PinsdMode::InMotionAlignment,
            Mode::Aided => PinsdMode::Aided,
            Mode::DeadReckoning => PinsdMode::DeadReckoning,
            Mode::Inertial => PinsdMode::Inertial,
            Mode::Fault => PinsdMode::Fault,
        }
    }
}

/// What the system does, and how good that is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PinsdStatus {
    /// UTC.
    pub time: Option<TimeOfDay>,
    /// What it does.
    pub mode: PinsdMode,
    /// How long it has done so, whole s.
    pub seconds_in_mode: Option<u32>,
    /// How far the heading may be trusted.
    pub heading: HeadingMode,
    /// What the position stands on.
    pub position: FixQuality,
    /// How far the heave can be relied on.
    pub heave: Option<HeaveQuality>,
    /// How UTC is known.
    pub time_source: PinsdTime,
    /// Whether any of this comes from a simulator.
    pub simulated: bool,
    /// Number of active alerts.
    pub alerts: Option<u32>,
    /// Whether the sensors bear it out.
    pub integrity: Option<PinsdIntegrity>,
    /// Who is left out; `None` where that is not known.
    pub excluded: Option<Parties>,
}

impl PinsdStatus {
    /// The word after the address.
    pub const NAME: &'static str = "STA";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 61;

    pub(super) fn write_fields(&self, line: &mut Composer) {
        line.text(Self::NAME);
        line.time_of_day(self.time);
        line.letter(self.mode.letter());
        line.whole(self.seconds_in_mode, 1, MAX_SECONDS);
        line.letter(self.heading.letter());
        line.letter(b'0' + self.position.as_gga());
        line.whole(self.heave.map(|heave| heave as u32), 1, 2);
        line.letter(self.time_source.letter());
        flag(line, self.simulated);
        line.whole(self.alerts, 1, MAX_ALERTS);
        line.optional_letter(self.integrity.map(PinsdIntegrity::letter));
        line.text(&self.excluded.map(letters_of).unwrap_or_default());
    }

    pub(super) fn read_fields(fields: &mut Fields<'_>) -> Result<Self, Fault> {
        let digit = |letter: u8| FixQuality::from_gga(letter.checked_sub(b'0')?);
        Ok(PinsdStatus {
            time: fields.time_of_day()?,
            mode: read_letter(fields, PinsdMode::from_letter)?,
            seconds_in_mode: fields.whole(MAX_SECONDS)?,
            heading: read_letter(fields, HeadingMode::from_letter)?,
            position: read_letter(fields, digit)?,
            heave: fields.convert(|text| match text {
                "0" => Some(HeaveQuality::Unsettled),
                "1" => Some(HeaveQuality::Reduced),
                "2" => Some(HeaveQuality::Settled),
                _ => None,
            })?,
            time_source: read_letter(fields, PinsdTime::from_letter)?,
            simulated: read_flag(fields)?,
            alerts: fields.whole(MAX_ALERTS)?,
            integrity: appended(fields, |fields| {
                fields.convert(|text| match text.as_bytes() {
                    [letter] => PinsdIntegrity::from_letter(*letter),
                    _ => None,
                })
            })?,
            excluded: appended(fields, |fields| fields.convert(parties_of))?,
        })
    }
}

/// A field that lines of older versions do not have.
fn appended<'a, T>(
    fields: &mut Fields<'a>,
    read: impl FnOnce(&mut Fields<'a>) -> Result<Option<T>, Fault>,
) -> Result<Option<T>, Fault> {
    if fields.has_more() { read(fields) } else { Ok(None) }
}

fn letters_of(parties: Parties) -> String {
    let own = LETTERS.into_iter().filter(|(party, _)| parties.contains(*party));
    let letters: String = own.map(|(_, letter)| letter).collect();
    if letters.is_empty() { NOBODY.to_owned() } else { letters }
}

/// Those of some letters, in whatever order.
fn parties_of(letters: &str) -> Option<Parties> {
    if letters == NOBODY {
        return Some(Parties::default());
    }
    let party = |letter| LETTERS.into_iter().find(|(_, own)| *own == letter).map(|own| own.0);
    letters.chars().map(party).collect()
}
