//! Which states there are beside those of the inertial system, and where they are.

use std::collections::{BTreeMap, BTreeSet};

use insd_base::satellites::{Constellation, SatelliteId};

use super::super::block::Block;
use super::inertial::INERTIAL;
use crate::scenario::Raw;

/// Of one satellite.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfSatellite {
    /// Cycles of its phase, m; the same in all antennas, as integers between them are known.
    pub(super) cycles: usize,
    /// Orbit and clock along the line of sight, m, and their rate, m/s.
    pub(super) slow: usize,
    /// Change of the factor of the ionosphere, and its rate, 1/s.
    pub(super) ionosphere: usize,
    /// Reflections of code and phase in the first antenna, over the weight, m; then of the others.
    pub(super) reflections: usize,
}

/// Places of all states.
#[derive(Clone, Debug)]
pub(super) struct States {
    /// Position north and east at the begin of a segment.
    pub(super) begin: Block,
    /// Bias and drift of each clock.
    clocks: Block,
    /// Of each antenna its clock.
    clock_of: Vec<usize>,
    offsets: BTreeMap<(usize, Constellation), usize>,
    lines: BTreeMap<(usize, Constellation), usize>,
    /// Zenith delay of the water, m.
    pub(super) water: usize,
    /// Factor of the ionosphere.
    pub(super) factor: usize,
    satellites: BTreeMap<SatelliteId, OfSatellite>,
    /// The first of those of a camera.
    pub(super) eyes: usize,
    size: usize,
}

impl States {
    /// Those of the receivers of a scenario that hear these satellites, and so many of a camera.
    pub(super) fn new(raw: &Raw, satellites: &BTreeSet<SatelliteId>, eyes: usize) -> Self {
        let antennas = raw.antennas_m.len();
        let own = |index: usize| !raw.common_clock.contains(&(index + 1));
        let shared = raw.common_clock.iter().min().map(|first| first - 1);
        let keepers: Vec<usize> =
            (0..antennas).filter(|index| own(*index) || shared == Some(*index)).collect();
        let keeper = |index: usize| if own(index) { Some(index) } else { shared };
        let clock = |index: usize| keepers.iter().position(|own| keeper(index) == Some(*own));
        let begin = Block::first(INERTIAL).then(2);
        let clocks = begin.then(2 * keepers.len());
        let mut next = clocks.end();
        let mut place = |count: usize| {
            next += count;
            next - count
        };
        let systems: BTreeSet<Constellation> =
            satellites.iter().map(|id| id.constellation).collect();
        let each = (0..antennas).flat_map(|index| systems.iter().map(move |own| (index, *own)));
        let lines = each.clone().map(|key| (key, place(1))).collect();
        let is_apart = |key: &(usize, Constellation)| {
            !matches!(key.1, Constellation::Gps | Constellation::Qzss)
        };
        let offsets = each.filter(is_apart).map(|key| (key, place(1))).collect();
        let (water, factor) = (place(1), place(1));
        let of = |id: &SatelliteId| {
            let own = OfSatellite {
                cycles: place(1),
                slow: place(2),
                ionosphere: place(2),
                reflections: place(2 * antennas),
            };
            (*id, own)
        };
        let satellites = satellites.iter().map(of).collect();
        let clock_of = (0..antennas).map(|index| clock(index).unwrap_or(0)).collect();
        States {
            begin,
            clocks,
            clock_of,
            offsets,
            lines,
            water,
            factor,
            satellites,
            eyes: next,
            size: next + eyes,
        }
    }

    /// How many there are.
    pub(super) fn size(&self) -> usize {
        self.size
    }

    /// Places of the bias of each clock; the drift is behind it.
    pub(super) fn clocks(&self) -> impl Iterator<Item = usize> + use<> {
        self.clocks.places().step_by(2)
    }

    /// Place of the bias of an antenna's clock, by its index.
    pub(super) fn clock(&self, antenna: usize) -> usize {
        self.clocks.at(2 * self.clock_of[antenna])
    }

    /// Place of the offset of a constellation in the receiver of an antenna, if it has one.
    pub(super) fn offset(&self, antenna: usize, constellation: Constellation) -> Option<usize> {
        self.offsets.get(&(antenna, constellation)).copied()
    }

    /// Place of the delay in the line of an antenna for a constellation.
    pub(super) fn line(&self, antenna: usize, constellation: Constellation) -> Option<usize> {
        self.lines.get(&(antenna, constellation)).copied()
    }

    /// Of each antenna the places of its lines.
    pub(super) fn lines_of(&self, antenna: usize) -> impl Iterator<Item = usize> + '_ {
        self.lines.iter().filter(move |(key, _)| key.0 == antenna).map(|(_, place)| *place)
    }

    /// Places of all offsets.
    pub(super) fn offsets(&self) -> impl Iterator<Item = usize> + '_ {
        self.offsets.values().copied()
    }

    /// States of a satellite.
    pub(super) fn satellite(&self, id: SatelliteId) -> Option<OfSatellite> {
        self.satellites.get(&id).copied()
    }

    /// States of all satellites.
    pub(super) fn satellites(&self) -> impl Iterator<Item = OfSatellite> + '_ {
        self.satellites.values().copied()
    }
}
