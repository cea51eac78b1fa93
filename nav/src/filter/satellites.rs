//! Which satellites have which states.

use insd_base::satellites::{SatelliteId, SatelliteRange, SatelliteUse};
use insd_base::{Source, Time};

use super::unrest::Unrest;
use crate::error_state::SATELLITES;

/// A satellite that is not seen for so long, s, gives its place away.
const FORGOTTEN: f64 = 120.0;
/// One that is left out is used again after so many codes that agree.
const READMITTED: u8 = 5;
/// Of fewer satellites nobody is in the majority.
const FEW: usize = 5;
/// Ranges of less than so long ago are fresh, s.
const FRESH: f64 = 5.0;

/// One satellite with states.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    satellite: SatelliteId,
    /// 1-sigma of its slow error, m.
    slow_std: f64,
    seen: Time,
    /// The arc whose constant is estimated.
    pub(super) arc: Option<u32>,
    /// When that began, for the receiver: the errors of codes go on over a slip that is found here.
    arc_began: Time,
    /// Of one that is left out: since when, and its codes in a row that agree.
    out: Option<(Time, u8)>,
}

impl Slot {
    /// Whether it is left out.
    pub(super) fn is_excluded(&self) -> bool {
        self.out.is_some()
    }

    /// For how long its phase has gone on without a break, s.
    pub(super) fn arc_lasts(&self, now: Time) -> f64 {
        self.arc.map_or(0.0, |_| (now - self.arc_began).as_seconds())
    }

    /// Its phase is of this arc; returns whether that is another one than before.
    pub(super) fn goes_over_to(&mut self, arc: u32, now: Time) -> bool {
        let is_new = self.arc.replace(arc) != Some(arc);
        if is_new {
            self.arc_began = now;
        }
        is_new
    }

    /// Its code contradicts those of the others: it is left out, and its phase begins anew when it comes back. Returns it if that is new.
    pub(super) fn exclude(&mut self, now: Time) -> Option<SatelliteId> {
        self.arc = None;
        let since = self.out.map_or(now, |(since, _)| since);
        self.out.replace((since, 0)).is_none().then_some(self.satellite)
    }

    /// Its code agrees, while it is left out. Returns it if it is used from now on.
    pub(super) fn agree(&mut self) -> Option<SatelliteId> {
        let (_, agreeing) = self.out.as_mut()?;
        *agreeing += 1;
        if *agreeing < READMITTED {
            return None;
        }
        self.out = None;
        Some(self.satellite)
    }
}

/// The satellites in use.
#[derive(Clone, Debug, Default)]
pub(super) struct Satellites {
    slots: Vec<Option<Slot>>,
    /// Time of the newest ranges.
    pub(super) last: Option<Time>,
    /// Between the last two epochs, s; zero for the first of a receiver.
    pub(super) apart: f64,
    /// Whose they are.
    source: Option<Source>,
    /// Since when the filter and nearly all of them contradict each other.
    strife: Option<Time>,
    /// When nearly all of them contradicted the filter last, or had their phases broken.
    upset: Option<Time>,
    /// Whether the place is known by ranges, and not by fixes.
    places: bool,
    /// What phases scatter beyond what is expected of them.
    pub(super) unrest: Unrest,
}

impl Satellites {
    /// Whether ranges are in use.
    pub(super) fn are_fresh(&self, now: Time) -> bool {
        self.last.is_some_and(|last| (now - last).as_seconds() < FRESH)
    }

    /// Whether ranges are of another receiver than those before, whose clock and arcs are its own; arcs begin anew then.
    pub(super) fn is_of_other(&mut self, source: Source) -> bool {
        let is_other = self.source.replace(source) != Some(source);
        if is_other {
            self.slots.iter_mut().flatten().for_each(|slot| slot.arc = None);
        }
        is_other
    }

    /// The place is known by them from now on; returns whether it was known by fixes before.
    pub(super) fn place(&mut self) -> bool {
        !std::mem::replace(&mut self.places, true)
    }

    /// Whether they do.
    pub(super) fn tell_place(&self) -> bool {
        self.places
    }

    /// A fix has told the place.
    pub(super) fn replaced_by_fix(&mut self) {
        self.places = false;
    }

    /// Those that are left out.
    pub(super) fn left_out(&self) -> impl Iterator<Item = SatelliteId> + '_ {
        let out = self.slots.iter().flatten().filter(|slot| slot.is_excluded());
        out.map(|slot| slot.satellite)
    }

    /// For how long nearly all that are heard now have contradicted the filter, s: one of them is wrong, and it is not known who.
    pub(super) fn strife(&mut self, now: Time) -> Option<f64> {
        let heard = self.slots.iter().flatten().filter(|slot| slot.seen == now);
        let (all, out) =
            heard.fold((0, 0), |(all, out), slot| (all + 1, out + usize::from(slot.is_excluded())));
        let is_strife = are_most(out, all);
        let since = is_strife.then(|| self.strife.unwrap_or(now));
        self.strife = since;
        self.upset = since.map(|_| now).or(self.upset);
        since.map(|since| (now - since).as_seconds())
    }

    /// Takes note of how many phases of all begin anew.
    pub(super) fn note_breaks(&mut self, new: usize, all: usize, now: Time) {
        if are_most(new, all) {
            self.upset = Some(now);
        }
    }

    /// Whether they have gone on without a break for so long, s.
    pub(super) fn went_on(&self, now: Time, span: f64) -> bool {
        self.are_fresh(now) && self.upset.is_none_or(|at| (now - at).as_seconds() > span)
    }

    /// The place of a satellite, and whether it is new there. `None` where all are taken.
    pub(super) fn seat(&mut self, range: &SatelliteRange, now: Time) -> Option<(usize, bool)> {
        self.slots.resize(SATELLITES, None);
        let own = |slot: &Option<Slot>| slot.is_some_and(|slot| slot.satellite == range.satellite);
        if let Some(place) = self.slots.iter().position(own) {
            let seen = |slot: &mut Slot| (slot.seen, slot.slow_std) = (now, range.slow_std);
            self.slots[place].iter_mut().for_each(seen);
            return Some((place, false));
        }
        let is_free = |slot: &Option<Slot>| {
            slot.is_none_or(|slot| (now - slot.seen).as_seconds() > FORGOTTEN)
        };
        let place = self.slots.iter().position(is_free)?;
        let SatelliteRange { satellite, slow_std, .. } = *range;
        self.slots[place] =
            Some(Slot { satellite, slow_std, seen: now, arc: None, arc_began: now, out: None });
        Some((place, true))
    }

    /// Those that are used now: place, 1-sigma of the slow error, m, and name.
    pub(super) fn used(&self, now: Time) -> impl Iterator<Item = (usize, f64, SatelliteId)> + '_ {
        let all = self.slots.iter().enumerate();
        let all = all.filter_map(|(place, slot)| Some((place, slot.as_ref()?)));
        let is_used =
            move |slot: &Slot| !slot.is_excluded() && (now - slot.seen).as_seconds() < FRESH;
        let used = all.filter(move |(_, slot)| is_used(slot));
        used.map(|(place, slot)| (place, slot.slow_std, slot.satellite))
    }

    /// What becomes of a satellite that has a range.
    pub(super) fn fate_of(&self, range: &SatelliteRange, now: Time) -> SatelliteUse {
        if !self.are_fresh(now) {
            return SatelliteUse::Waiting;
        }
        let mut taken = self.slots.iter().flatten();
        match taken.find(|slot| slot.satellite == range.satellite) {
            None => SatelliteUse::Crowded,
            Some(Slot { out: Some((since, _)), .. }) => SatelliteUse::LeftOut { since: *since },
            Some(_) if range.phase.is_some() => SatelliteUse::Phase,
            Some(_) => SatelliteUse::CodeOnly,
        }
    }

    /// The satellite at a place, if that is taken.
    pub(super) fn slot(&self, place: usize) -> Option<&Slot> {
        self.slots.get(place)?.as_ref()
    }

    /// The same, to be changed.
    pub(super) fn slot_mut(&mut self, place: usize) -> Option<&mut Slot> {
        self.slots.get_mut(place)?.as_mut()
    }
}

/// Whether so many out of all satellites are nearly all: what the rest says is not believed against them.
pub(super) fn are_most(some: usize, all: usize) -> bool {
    all >= FEW && 4 * some >= 3 * all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn satellites_of_which_nearly_all_phases_broke_have_not_gone_on() {
        let at = Time::from_seconds;
        let mut satellites = Satellites { last: Some(at(100.0)), ..Satellites::default() };
        satellites.note_breaks(3, 10, at(90.0));
        assert!(satellites.went_on(at(100.0), 30.0));
        satellites.note_breaks(9, 10, at(90.0));
        assert!(!satellites.went_on(at(100.0), 30.0));
        satellites.last = Some(at(121.0));
        assert!(satellites.went_on(at(121.0), 30.0));
    }
}
