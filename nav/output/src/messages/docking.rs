//! The ship and a berth, in two kinds of sentences: one BTH for the berth, then a DOK for each part of her. `docs/pinsd.md` has
//! them field by field.

use insd_wire::nmea::{
    Pinsd, PinsdBerth, PinsdChoice, PinsdDocking, PinsdPart, PinsdPartOfShip, PinsdSide, Talker,
    TimeOfDay,
};

use super::entry::{Content, Entry};
use crate::docking::{BerthChoice, Docking, DockingPoint, DockingSide, DockingState, HullPart};
use crate::redacted_epoch::RedactedEpoch;

/// Parts of a ship that are told of at the most.
const PARTS: usize = HullPart::ALL.len();

pub(super) static ENTRIES: &[Entry] =
    &[Entry::own("PINSD.DOK", PinsdBerth::LONGEST + PARTS * PinsdPartOfShip::LONGEST, docking)];

/// Where no berth is chosen or near that is said, so that a listener knows that it is not the line that is silent.
fn docking(said: &RedactedEpoch<'_>, _: Talker) -> Option<Content> {
    if said.is_muted() {
        return None;
    }
    let time = said.civil().map(|utc| utc.time);
    let Some(docking) = said.docking() else {
        let none = PinsdBerth { time, ..PinsdBerth::default() };
        return Some(Content::Lines(vec![Pinsd::Berth(none).write()]));
    };
    let parts = HullPart::ALL.iter().zip(&docking.points);
    let told = parts.filter_map(|(part, point)| {
        Some(Pinsd::Part(part_of_ship(time, docking.state, *part, point.as_ref()?)))
    });
    let all = std::iter::once(Pinsd::Berth(berth(time, &docking))).chain(told);
    Some(Content::Lines(all.map(|sentence| sentence.write()).collect()))
}

fn berth(time: Option<TimeOfDay>, docking: &Docking) -> PinsdBerth {
    let contact = docking.contact.as_ref();
    PinsdBerth {
        time,
        state: letter_of(docking.state),
        berth: u32::try_from(docking.berth + 1).ok(),
        choice: Some(match docking.choice {
            BerthChoice::Chosen => PinsdChoice::Chosen,
            BerthChoice::Nearest => PinsdChoice::Nearest,
        }),
        side: docking.side.map(|side| match side {
            DockingSide::Port => PinsdSide::Port,
            DockingSide::Starboard => PinsdSide::Starboard,
        }),
        angle: docking.angle.map(|own| own.value),
        angle_sigma: docking.angle.map(|own| own.sigma),
        first: contact.map(|own| named(own.part)),
        contact_speed: contact.map(|own| own.speed.value),
        contact_speed_sigma: contact.map(|own| own.speed.sigma),
        seconds: contact.map(|own| own.seconds.value),
        seconds_sigma: contact.map(|own| own.seconds.sigma),
    }
}

fn part_of_ship(
    time: Option<TimeOfDay>,
    state: DockingState,
    part: HullPart,
    point: &DockingPoint,
) -> PinsdPartOfShip {
    PinsdPartOfShip {
        time,
        part: named(part),
        state: letter_of(state),
        distance: Some(point.distance.value),
        distance_sigma: Some(point.distance.sigma),
        level: Some(point.level),
        closing: Some(point.closing.value),
        closing_sigma: Some(point.closing.sigma),
        along: Some(point.along.value),
        along_sigma: Some(point.along.sigma),
        place: Some(point.place),
    }
}

fn letter_of(state: DockingState) -> PinsdDocking {
    match state {
        DockingState::Valid => PinsdDocking::Valid,
        DockingState::Doubtful(_) => PinsdDocking::Doubtful,
        DockingState::NotValid(_) => PinsdDocking::NotValid,
    }
}

fn named(part: HullPart) -> PinsdPart {
    match part {
        HullPart::Bow => PinsdPart::Bow,
        HullPart::Stern => PinsdPart::Stern,
        HullPart::Manifold => PinsdPart::Manifold,
    }
}
