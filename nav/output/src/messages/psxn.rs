//! PSXN: attitude, rates and their quality, as a Seapath sends them.
//!
//! PSXN,20 tells the quality of the others. Where it has one mark for several values it stands for the worst
//! of them:
//!
//! | | 0 normal | 1 reduced | 2 invalid |
//! |---|---|---|---|
//! | horizontal position and velocity | GGA 1 to 5 | GGA 6 | either is unknown, or beyond the policy |
//! | height, heave, vertical velocity | settled heave | reduced heave | unsettled or unknown heave |
//! | heading | THS A | THS E | THS V |
//! | roll and pitch | within the policy | | beyond it |
//!
//! A value that is invalid is empty in PSXN,23 and PSXN,24. The vertical velocity shares its mark with the
//! heave, so it is that of the heave. PSXN,21 tells of the start, once. PSXN,22 is about a gyro compass
//! beside the unit, of which nothing is known here: its fields are empty.
//!
//! None has a mark for simulated data, so from a simulator they are silent.

use insd_base::{FixQuality, HeaveQuality};
use insd_wire::nmea::{NmeaLine, Psxn, PsxnQuality};

use super::entry::{Entry, Make, unmarked};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    entry("PSXN.20", |said, _| unmarked(said, quality)),
    entry("PSXN.21", |said, _| unmarked(said, started).filter(|_| said.count == 0)),
    entry("PSXN.22", |said, _| unmarked(said, gyro_offsets)),
    entry("PSXN.23", |said, _| unmarked(said, motion)),
    entry("PSXN.24", |said, _| unmarked(said, rates)),
];

const fn entry(name: &'static str, make: Make) -> Entry {
    Entry::own(name, Psxn::LONGEST, make)
}

fn quality(said: &RedactedEpoch<'_>) -> NmeaLine {
    let place = said.position().zip(said.velocity());
    let heave = said.heave();
    let is_reduced = heave.is_some_and(|heave| heave.quality == HeaveQuality::Reduced);
    Psxn::Quality {
        horizontal: mark(place.is_some(), said.quality() == FixQuality::Estimated),
        height: mark(heave.is_some(), is_reduced),
        heading: mark(said.heading().is_some(), said.is_heading_estimated()),
        attitude: mark(said.roll_and_pitch().is_some(), false),
    }
    .write()
}

fn mark(is_known: bool, is_reduced: bool) -> Option<PsxnQuality> {
    Some(match (is_known, is_reduced) {
        (false, _) => PsxnQuality::Invalid,
        (true, true) => PsxnQuality::Reduced,
        (true, false) => PsxnQuality::Normal,
    })
}

fn started(_: &RedactedEpoch<'_>) -> NmeaLine {
    Psxn::Event { event: 1 }.write()
}

fn gyro_offsets(_: &RedactedEpoch<'_>) -> NmeaLine {
    Psxn::GyroOffsets { calibration: None, offset: None }.write()
}

fn motion(said: &RedactedEpoch<'_>) -> NmeaLine {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    let heave = said.heave().map(|heave| -heave.heave);
    Psxn::Motion { roll, pitch, heading: said.heading(), heave }.write()
}

fn rates(said: &RedactedEpoch<'_>) -> NmeaLine {
    let rates = said.rates().map(|rates| rates.0);
    Psxn::Rates {
        roll_rate: rates.map(|rates| rates.x),
        pitch_rate: rates.map(|rates| rates.y),
        yaw_rate: rates.map(|rates| rates.z),
        down_velocity: said.heave().map(|heave| -heave.rate),
    }
    .write()
}
