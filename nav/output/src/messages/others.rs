//! Attitude for current profilers, as satellite compasses send it, and for gpsd.
//!
//! What is beyond the policy is empty. None has a mark for simulated data, so from a simulator they are
//! silent.

use insd_wire::nmea::{NmeaLine, PfecAttitude, Prdid, Ptnthtm};

use super::entry::{Entry, unmarked};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry::own("PRDID", Prdid::LONGEST, |said, _| unmarked(said, prdid)),
    Entry::own("PFEC.GPatt", PfecAttitude::LONGEST, |said, _| unmarked(said, pfec)),
    Entry::own("PFEC.GPatt.v1", PfecAttitude::LONGEST, |said, _| unmarked(said, pfec_v1)),
    Entry::own("PTNTHTM", Ptnthtm::LONGEST, |said, _| unmarked(said, ptnthtm)),
];

fn prdid(said: &RedactedEpoch<'_>) -> NmeaLine {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    Prdid { roll, pitch, heading: said.heading() }.write()
}

fn pfec(said: &RedactedEpoch<'_>) -> NmeaLine {
    attitude(said).write()
}

/// Version 1.5 has no checksum.
fn pfec_v1(said: &RedactedEpoch<'_>) -> NmeaLine {
    attitude(said).write_old()
}

/// A heading that is an estimate only is told with a warning.
fn ptnthtm(said: &RedactedEpoch<'_>) -> NmeaLine {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    let (heading, is_warned) = (said.heading(), said.is_heading_estimated());
    Ptnthtm { heading, is_warned, pitch, roll }.write()
}

fn attitude(said: &RedactedEpoch<'_>) -> PfecAttitude {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    PfecAttitude { heading: said.heading(), pitch, roll }
}
