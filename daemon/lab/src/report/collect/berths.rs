//! How she came alongside: the nearest that she was to each berth, and how fast she came.

use std::collections::BTreeMap;

use insd_base::{Estimate, Time};
use insd_output::docking::{BerthDesk, Docking, HullPart};

/// Within this of the fenders she is coming alongside, m.
const NEAR: f64 = 50.0;
/// Within this the greatest speed counts, m.
const CLOSE: f64 = 5.0;

/// The berths that she came near.
#[derive(Clone, Debug, Default)]
pub(crate) struct Berths {
    names: Vec<String>,
    /// By place in the configuration.
    seen: BTreeMap<usize, Approach>,
}

/// How she came to one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Approach {
    /// When a part of her was first so near as to come alongside.
    pub(crate) since: Time,
    /// The nearest that a part of her was: which, when, how far and with what protection level, m.
    pub(crate) nearest: (HullPart, Time, Estimate, f64),
    /// The fastest that a part came while it was close, m/s, and when.
    pub(crate) fastest: Option<(Time, Estimate)>,
}

impl Berths {
    /// Takes note of the names.
    pub(crate) fn name(&mut self, desk: &BerthDesk) {
        if self.names.len() != desk.config().berths.len() {
            self.names = desk.config().berths.iter().map(|berth| berth.name.clone()).collect();
        }
    }

    /// Takes note of how she stands.
    pub(crate) fn note(&mut self, docking: &Docking) {
        for part in HullPart::ALL {
            let Some(point) = docking.point(part).filter(|own| own.distance.value < NEAR) else {
                continue;
            };
            let nearest = (part, docking.time, point.distance, point.level);
            let fresh = Approach { since: docking.time, nearest, fastest: None };
            let own = self.seen.entry(docking.berth).or_insert(fresh);
            if point.distance.value < own.nearest.2.value {
                own.nearest = nearest;
            }
            let is_faster = own.fastest.is_none_or(|(_, best)| point.closing.value > best.value);
            if point.distance.value < CLOSE && is_faster {
                own.fastest = Some((docking.time, point.closing));
            }
        }
    }

    /// Each berth that she came near, by its name.
    pub(crate) fn approaches(&self) -> impl Iterator<Item = (&str, &Approach)> {
        let name = |index: usize| self.names.get(index).map_or("?", String::as_str);
        self.seen.iter().map(move |(index, own)| (name(*index), own))
    }
}

#[cfg(test)]
mod tests {
    use insd_output::docking::{BerthChoice, DockingPoint, DockingState, NotDocking};

    use super::*;

    #[test]
    fn the_nearest_and_the_fastest_near_the_fenders_are_kept_and_nothing_from_afar() {
        let which = (0, BerthChoice::Chosen);
        let at = |second: f64, distance: f64, closing: f64| {
            let own = |value: f64| Estimate { value, sigma: 0.1 };
            let point = DockingPoint {
                distance: own(distance),
                level: 0.5,
                closing: own(closing),
                along: own(0.0),
                place: 0.0,
                above: None,
            };
            let time = Time::from_seconds(second);
            Docking {
                state: DockingState::Valid,
                points: [None, Some(point), None],
                ..Docking::not_valid(time, which, NotDocking::NoSolution)
            }
        };
        let mut berths = Berths::default();
        berths.note(&at(1.0, 60.0, 2.0));
        assert_eq!(berths.approaches().count(), 0);
        for (second, distance, closing) in
            [(2.0, 40.0, 1.0), (3.0, 4.0, 0.2), (4.0, 0.1, 0.05), (5.0, 0.2, -0.1)]
        {
            berths.note(&at(second, distance, closing));
        }
        let (_, own) = berths.approaches().next().unwrap();
        assert_eq!((own.since, own.nearest.0), (Time::from_seconds(2.0), HullPart::Stern));
        assert_eq!((own.nearest.1, own.nearest.2.value), (Time::from_seconds(4.0), 0.1));
        assert_eq!(own.fastest.unwrap().1.value, 0.2);
    }
}
