//! A delta for a Signal K server: all of an epoch at once, `null` where it may not be told.
//!
//! The quality of the position says that it is simulated; what else comes from a simulator has no mark, and is
//! `null`.

use insd_wire::nmea::Talker;
use insd_wire::signalk::Delta;

use super::entry::{Content, Entry};
use super::state::words;
use crate::redacted_epoch::RedactedEpoch;

pub(super) static ENTRIES: &[Entry] = &[Entry::own("SIGNALK", Delta::LONGEST, delta)];

fn delta(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    let marked = said.marked();
    let (course, speed) = said.course_and_speed().unzip();
    let delta = Delta {
        time: said.civil(),
        place: marked.position().map(|place| (place.latitude, place.longitude)),
        altitude: marked.altitude(),
        heading: said.heading(),
        magnetic_heading: said.magnetic_heading(),
        variation: marked.variation().map(|variation| variation.value),
        course: course.flatten(),
        speed,
        speed_through_water: said.through_water().map(|level| level.forward),
        rate_of_turn: said.rate_of_turn(),
        tilt: said.roll_and_pitch(),
        heave: said.heave().map(|heave| heave.heave),
        quality: marked.marked_quality(),
        geoid_separation: marked.geoid(),
        satellites: marked.receiver().satellites,
        hdop: marked.receiver().hdop,
        mode: words(said).1,
        position_sigma: marked.position_sigma().map(|sigma| sigma.0.x.hypot(sigma.0.y)),
        heading_sigma: said.attitude_sigma()[2],
    };
    Some(Content::Binary(delta.write().into_bytes()))
}
