//! Receivers that together are a compass: their epochs of one instant are taken together.

use insd_base::{Body, SatelliteEpoch, Stamp};
use insd_gnss::{ArrayRanging, TOGETHER};
use nalgebra::Vector3;

use super::came::Came;
use crate::satellites::EpochOrder;

/// An epoch as it came.
#[derive(Clone, Debug)]
pub(super) struct Arrived {
    pub(super) stamp: Stamp,
    pub(super) came: Came,
    pub(super) epoch: SatelliteEpoch,
    pub(super) is_dated: bool,
    /// The order of the receiver's epochs before it.
    pub(super) order: EpochOrder,
}

/// The receivers of an array, and what of the newest instant has come.
#[derive(Clone, Debug)]
pub(super) struct Array {
    /// Numbers of the sensors; the first is the one whose antenna ranges are of.
    pub(super) members: Vec<usize>,
    pub(super) ranging: ArrayRanging,
    come: Vec<Option<Arrived>>,
    /// Who was heard in the instant before.
    heard: Vec<bool>,
}

impl Array {
    /// Of sensors, by their numbers, with their antennas from the IMU, body axes, m, and the names of their clocks: one that is on no stated clock is on its own.
    /// `None` of fewer than two.
    pub(super) fn new(own: &[(usize, Body, Option<&str>)]) -> Option<Self> {
        let clock = |place: usize| match own[place].2 {
            Some(name) => own.iter().position(|other| other.2 == Some(name)).unwrap_or(place),
            None => place,
        };
        let clocks: Vec<usize> = (0..own.len()).map(clock).collect();
        let levers: Vec<Vector3<f64>> = own.iter().map(|(_, lever, _)| lever.0).collect();
        (own.len() > 1).then(|| Self {
            members: own.iter().map(|(index, ..)| *index).collect(),
            ranging: ArrayRanging::new(&levers, &clocks),
            come: vec![None; own.len()],
            heard: vec![true; own.len()],
        })
    }

    /// Its place among the antennas of a sensor that belongs to it.
    pub(super) fn place(&self, sensor: usize) -> Option<usize> {
        self.members.iter().position(|own| *own == sensor)
    }

    /// Takes an epoch. Gives those of an instant, each in its place, when all that are to be expected have come, or an epoch of the next one has.
    pub(super) fn take(&mut self, place: usize, arrived: Arrived) -> Vec<Vec<Option<Arrived>>> {
        let tag = arrived.epoch.tag;
        let is_of_instant = |own: &Arrived| tag.since(own.epoch.tag).as_seconds().abs() < TOGETHER;
        let mut ready = Vec::new();
        if !self.come.iter().flatten().all(is_of_instant) {
            ready.push(self.taken());
        }
        self.come[place] = Some(arrived);
        let is_missing = |(come, heard): (&Option<Arrived>, &bool)| *heard && come.is_none();
        if !self.come.iter().zip(&self.heard).any(is_missing) {
            ready.push(self.taken());
        }
        ready
    }

    fn taken(&mut self) -> Vec<Option<Arrived>> {
        let come = std::mem::replace(&mut self.come, vec![None; self.members.len()]);
        self.heard = come.iter().map(Option::is_some).collect();
        come
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{GpsTime, Span, Time, UtcTime};

    fn array(antennas: usize) -> Array {
        let lever = |number: usize| Body::new(0.1 * number as f64 + 1.0, 0.0, -5.0);
        let own: Vec<_> = (0..antennas).map(|at| (at, lever(at), Some("rack"))).collect();
        Array::new(&own).unwrap()
    }

    /// How many of each instant come together when antennas are heard in this order: number, second.
    fn taken(array: &mut Array, heard: &[(usize, u32)]) -> Vec<Vec<usize>> {
        let mut all = Vec::new();
        for (place, second) in heard {
            let tag = GpsTime::from_week(2400, 0).plus(Span::from_seconds(f64::from(*second)));
            let system = UtcTime::from_civil((2026, 1, 1), (0, 0, 0), 0).unwrap();
            let stamp = Stamp { monotonic: Time::START, system };
            let came = Came { begun: Time::START, ended: Time::START };
            let epoch =
                SatelliteEpoch { tag, signals: Vec::new(), leap_seconds: None, clock_reset: false };
            let order = EpochOrder::default();
            for own in array.take(*place, Arrived { stamp, came, epoch, is_dated: true, order }) {
                let present = own.iter().enumerate().filter(|(_, own)| own.is_some());
                all.push(present.map(|(place, _)| place).collect());
            }
        }
        all
    }

    #[test]
    fn epochs_of_an_instant_are_taken_together_in_any_order() {
        let told = taken(&mut array(3), &[(2, 0), (0, 0), (1, 0), (0, 1), (1, 1), (2, 1)]);
        assert_eq!(told, [[0, 1, 2], [0, 1, 2]]);
    }

    #[test]
    fn one_that_falls_silent_is_waited_for_once_and_taken_again_when_it_is_heard() {
        let heard = [(0, 0), (1, 0), (0, 1), (0, 2), (0, 3), (1, 3), (0, 4), (1, 4)];
        let told = taken(&mut array(2), &heard);
        let expected: [&[usize]; 6] = [&[0, 1], &[0], &[0], &[0], &[1], &[0, 1]];
        assert_eq!(told, expected);
    }
}
