//! Course, speed and distance.

use insd_wire::nmea::{Talker, Vbw, VbwStern, VbwVelocity, Vhw, Vlw, Vtg};

use super::entry::{Content, Entry, one};
use crate::redacted_epoch::{Level, RedactedEpoch};

pub(super) static ENTRIES: &[Entry] = &[
    Entry { name: "VTG", talker: Some(Talker::IN), longest: Vtg::LONGEST, make: vtg },
    Entry { name: "VBW", talker: Some(Talker::VD), longest: Vbw::LONGEST, make: vbw },
    Entry { name: "VHW", talker: Some(Talker::IN), longest: Vhw::LONGEST, make: vhw },
    Entry { name: "VLW", talker: Some(Talker::VD), longest: Vlw::LONGEST, make: vlw },
];

/// The magnetic course is told, too: from RMC alone a known consumer makes it with the wrong sign.
fn vtg(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    let said = said.marked();
    let (course, speed) = said.course_and_speed().unzip();
    let course = course.flatten();
    let variation = said.variation();
    let course_magnetic = course.zip(variation).map(|(course, variation)| course - variation.value);
    one(Vtg { course, course_magnetic, speed, mode: Some(said.velocity_mode()) }.write(talker))
}

/// What the stern does is empty where nobody has told which point that is.
fn vbw(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    if said.is_muted() {
        return None;
    }
    let water = velocity(said.through_water());
    let ground = velocity(said.over_ground());
    let stern_water = stern(said.stern_through_water());
    let stern_ground = stern(said.stern_over_ground());
    one(Vbw { water, ground, stern_water, stern_ground, without_stern: false }.write(talker))
}

fn stern(level: Option<Level>) -> VbwStern {
    VbwStern { transverse: level.map(|level| level.starboard), valid: level.is_some() }
}

fn velocity(level: Option<Level>) -> VbwVelocity {
    VbwVelocity {
        longitudinal: level.map(|level| level.forward),
        transverse: level.map(|level| level.starboard),
        valid: level.is_some(),
    }
}

fn vhw(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    if said.is_muted() {
        return None;
    }
    let speed = said.through_water().map(|level| level.forward.hypot(level.starboard));
    let (heading, heading_magnetic) = (said.heading(), said.magnetic_heading());
    one(Vhw { heading, heading_magnetic, speed }.write(talker))
}

/// The distances since the start are those of a trip; totals are a log's.
fn vlw(said: &RedactedEpoch<'_>, talker: Talker) -> Option<Content> {
    if said.is_muted() {
        return None;
    }
    let distance = said.distance();
    let (water_trip, ground_trip) = (distance.water, distance.ground);
    one(Vlw { water: None, water_trip, ground: None, ground_trip }.write(talker))
}
