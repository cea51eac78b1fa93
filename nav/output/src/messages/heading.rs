//! Heading and rate of turn.

use insd_wire::nmea::{Hcr, Hdg, Hdt, HeadingCorrections, HeadingMode, Rot, Talker, Ths};

use super::entry::{Content, Entry, one};
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[
    Entry { name: "HDT", talker: Some(Talker::HE), longest: Hdt::LONGEST, make: hdt },
    Entry { name: "THS", talker: Some(Talker::HE), longest: Ths::LONGEST, make: ths },
    Entry { name: "ROT", talker: Some(Talker::TI), longest: Rot::LONGEST, make: rot },
    Entry { name: "HDG", talker: Some(Talker::IN), longest: Hdg::LONGEST, make: hdg },
    Entry { name: "HCR", talker: Some(Talker::HE), longest: Hcr::LONGEST, make: hcr },
];

/// HDT cannot say that it is wrong, so it stops when THS would say V or S.
fn hdt(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let heading = Some(said.heading()?);
    one(Hdt { heading }.write(talker))
}

fn ths(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let said = said.marked();
    let mode = said.heading_mode();
    let heading = said.heading().filter(|_| mode != HeadingMode::NotValid);
    one(Ths { heading, mode }.write(talker))
}

/// From a simulator it is silent: its status can only say whether it is valid.
fn rot(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    if said.is_muted() {
        return None;
    }
    let rate = said.rate_of_turn();
    one(Rot { rate, valid: rate.is_some() }.write(talker))
}

/// What a magnetic compass without deviation would show: for consumers that know no true heading.
fn hdg(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let reading = Some(said.magnetic_heading()?);
    let variation = said.variation().map(|variation| variation.value);
    one(Hdg { reading, deviation: None, variation }.write(talker))
}

/// An inertial heading rests on her own velocity, latitude and acceleration: what disturbs a gyro compass
/// is in it from the start. There is none without, so the sum of the corrections stays empty.
fn hcr(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let said = said.marked();
    let (heading, mode) = (said.heading(), said.heading_mode());
    let corrections = match heading {
        Some(_) => HeadingCorrections::Both,
        None => HeadingCorrections::Unknown,
    };
    one(Hcr { heading, mode, corrections, correction: None }.write(talker))
}
