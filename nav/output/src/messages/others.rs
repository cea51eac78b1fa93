//! Attitude for current profilers, and as satellite compasses send it.
//!
//! What is beyond the policy is empty. None has a mark for simulated data, so from a simulator they are
//! silent.

use insd_wire::nmea::{Line, PfecAttitude, Prdid};

use super::{Entry, unmarked};
use crate::said::Said;

pub(super) static ENTRIES: &[Entry] = &[
    Entry::own("PRDID", Prdid::LONGEST, |said, _| unmarked(said, prdid)),
    Entry::own("PFEC.GPatt", PfecAttitude::LONGEST, |said, _| unmarked(said, pfec)),
    Entry::own("PFEC.GPatt.v1", PfecAttitude::LONGEST, |said, _| unmarked(said, pfec_v1)),
];

fn prdid(said: &Said<'_>) -> Line {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    Prdid { roll, pitch, heading: said.heading() }.write()
}

fn pfec(said: &Said<'_>) -> Line {
    attitude(said).write()
}

/// Version 1.5 has no checksum.
fn pfec_v1(said: &Said<'_>) -> Line {
    attitude(said).write_old()
}

fn attitude(said: &Said<'_>) -> PfecAttitude {
    let (roll, pitch) = said.roll_and_pitch().unzip();
    PfecAttitude { heading: said.heading(), pitch, roll }
}
