//! STA: what the system does, and how good that is.

use insd_base::{FixQuality, HeaveQuality, Integrity, Mode, Parties, Party, SolutionSource};

use crate::nmea::civil::TimeOfDay;
use crate::nmea::kinds::{Clock, DIGIT, Field, Needed, Whole, letter};
use crate::nmea::mode::{HeadingMode, letters};
use crate::nmea::parts::letter_of;
use crate::nmea::table::sentence;

/// As GGA has it.
const QUALITY: Field<FixQuality> = Field {
    write: |line, quality| line.letter(b'0' + quality.as_gga()),
    read: |text| FixQuality::from_gga(letter_of(text)?.checked_sub(b'0')?),
};
/// 0 not settled, 1 reduced, 2 settled.
const HEAVE: Field<HeaveQuality> = Field {
    write: |line, heave| line.whole(Some(heave as u32), 1, 2),
    read: |text| match text {
        "0" => Some(HeaveQuality::Unsettled),
        "1" => Some(HeaveQuality::Reduced),
        "2" => Some(HeaveQuality::Settled),
        _ => None,
    },
};
/// Their letters.
const PARTIES: Field<Parties> =
    Field { write: |line, parties| line.text(&letters_of(parties)), read: parties_of };

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

/// What the position lives by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PinsdSource {
    /// R: carrier phases against a base, with integers.
    Rtk,
    /// F: the same without integers.
    Float,
    /// P: carrier phases.
    Carrier,
    /// C: codes, or a receiver's fixes.
    Code,
    /// D: Doppler shifts, or a receiver's velocity.
    Doppler,
    /// N: no satellites.
    DeadReckoning,
}

letters! {
    PinsdSource {
        Rtk b'R', Float b'F', Carrier b'P', Code b'C', Doppler b'D', DeadReckoning b'N'
    }
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
    (Party::Antennas, 'C'),
    (Party::Docking, 'D'),
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

impl From<SolutionSource> for PinsdSource {
    fn from(source: SolutionSource) -> Self {
        match source {
            SolutionSource::Rtk => PinsdSource::Rtk,
            SolutionSource::Float => PinsdSource::Float,
            SolutionSource::Carrier => PinsdSource::Carrier,
            SolutionSource::Code => PinsdSource::Code,
            SolutionSource::Doppler => PinsdSource::Doppler,
            SolutionSource::DeadReckoning => PinsdSource::DeadReckoning,
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

sentence! {
    /// What the system does, and how good that is. A line that ends before one of the last four fields is one of an
    /// older version.
    part PinsdStatus "PINSD" "STA", longest 75: Eq;
    /// UTC.
    1 time: Option<TimeOfDay> = Clock(2);
    /// What it does.
    2 mode: PinsdMode = Needed(letter());
    /// How long it has done so, whole s.
    3 seconds_in_mode: Option<u32> = Whole::of(1, 999_999_999);
    /// How far the heading may be trusted, as THS has it.
    4 heading: HeadingMode = Needed(letter());
    /// What the position stands on.
    5 position: FixQuality = Needed(QUALITY);
    /// How far the heave can be relied on.
    6 heave: Option<HeaveQuality> = HEAVE;
    /// How UTC is known.
    7 time_source: PinsdTime = Needed(letter());
    /// Whether any of this comes from a simulator.
    8 simulated: bool = DIGIT;
    /// Number of active alerts.
    9 alerts: Option<u32> = Whole::of(1, 999);
    /// Whether the sensors bear it out.
    10 integrity: Option<PinsdIntegrity> = letter(), later;
    /// Who is left out: N nobody; `None` where that is not known.
    11 excluded: Option<Parties> = PARTIES, later;
    /// What the position lives by.
    12 source: Option<PinsdSource> = letter(), later;
    /// How long it has lived by that, whole s.
    13 seconds_of_source: Option<u32> = Whole::of(1, 999_999_999), later;
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
