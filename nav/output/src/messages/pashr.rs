//! PASHR in the dialects of its makers.
//!
//! | field | |
//! |---|---|
//! | roll, pitch, heading | by the policy |
//! | heave | in the direction of the dialect, once it has settled; empty where the dialect states none |
//! | 1-sigma | of the angles that are told |
//! | quality | that of the position by the policy, estimated at best without GNSS, as far as the dialect can say it |
//! | status | of the mode; an error with a fault or without a solution |
//!
//! No dialect has a mark for simulated data, so from a simulator they are silent.

use insd_base::{FixQuality, Mode};
use insd_wire::nmea::{NmeaLine, Pashr, PashrDialect, PashrStatus};

use super::entry::{Entry, Make, unmarked};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    entry("PASHR.sbg", |said, _| unmarked(said, |said| pashr(said, PashrDialect::Sbg))),
    entry("PASHR.sbg_wassp", |said, _| unmarked(said, |said| pashr(said, PashrDialect::SbgWassp))),
    entry("PASHR.ixblue", |said, _| unmarked(said, |said| pashr(said, PashrDialect::Ixblue))),
    entry("PASHR.novatel", |said, _| unmarked(said, |said| pashr(said, PashrDialect::Novatel))),
    entry("PASHR.trimble", |said, _| unmarked(said, |said| pashr(said, PashrDialect::Trimble))),
    entry("PASHR.applanix", |said, _| unmarked(said, |said| pashr(said, PashrDialect::Applanix))),
];

const fn entry(name: &'static str, make: Make) -> Entry {
    Entry::own(name, Pashr::LONGEST, make)
}

fn pashr(said: &RedactedEpoch<'_>, dialect: PashrDialect) -> NmeaLine {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    let [roll_std, pitch_std, heading_std] = said.attitude_sigma();
    let mut pashr = Pashr {
        time: said.civil().map(|utc| utc.time),
        heading: said.heading(),
        roll,
        pitch,
        roll_std,
        pitch_std,
        heading_std,
        ..Pashr::default()
    };
    pashr.set_heave_down(said.heave().map(|heave| -heave.heave), dialect);
    // what the mode makes of a fix is in its quality already
    pashr.set_quality(aid(said), Mode::Aided, dialect);
    pashr.set_status(PashrStatus::of(said.mode().unwrap_or(Mode::Fault)), dialect);
    pashr.write_as(dialect)
}

/// Quality of what aids the attitude.
fn aid(said: &RedactedEpoch<'_>) -> FixQuality {
    match said.quality() {
        FixQuality::Invalid => FixQuality::Invalid,
        _ if !said.uses_gnss() => FixQuality::Estimated,
        quality => quality,
    }
}
