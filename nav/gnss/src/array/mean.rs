//! Antennas that stand close together on one clock, as one in their middle: reflections of each are its own.

use std::collections::BTreeMap;

use insd_base::SatelliteId;
use insd_base::satellites::{ArcPhase, Constellation, Measured, SatelliteRange, time_keeper};
use nalgebra::Vector3;

use crate::ranging::Ranged;

/// What receivers differ by is averaged over so many ranges: they stay the same as long as they run.
const REMEMBERED: f64 = 1e5;
/// A code that differs from the middle one of all by more sigmas is not of the same way.
const FAR: f64 = 6.0;

/// An antenna, and what it tells of a satellite.
type Told = (usize, SatelliteRange);

/// Antennas as one.
#[derive(Clone, Debug, Default)]
pub(super) struct MeanAntenna {
    /// What arcs the phase of each satellite is made of, and the number of that.
    arcs: BTreeMap<SatelliteId, (Vec<(usize, u32)>, u32)>,
    arcs_begun: u32,
    /// By how much codes of an antenna's receiver are longer than the first one's, m, and of how many ranges it is the mean.
    offsets: BTreeMap<(usize, Constellation), (f64, f64)>,
}

impl MeanAntenna {
    /// Of what antennas heard in one instant; none of those that are at fault, if there is another.
    pub(super) fn of(
        &mut self,
        levers: &[Vector3<f64>],
        faulty: &[usize],
        mut heard: Vec<(usize, Ranged)>,
    ) -> Option<Ranged> {
        if heard.iter().any(|(antenna, _)| !faulty.contains(antenna)) {
            heard.retain(|(antenna, _)| !faulty.contains(antenna));
        }
        let mut of_each: BTreeMap<SatelliteId, Vec<Told>> = BTreeMap::new();
        for (antenna, ranged) in &heard {
            for range in &ranged.ranges {
                of_each.entry(range.satellite).or_default().push((*antenna, *range));
            }
        }
        for told in of_each.values() {
            self.learn_offsets(told);
        }
        let ranges = of_each.values().map(|told| self.merged(levers, told)).collect();
        let (_, first) = heard.into_iter().next()?;
        Some(Ranged { ranges, ..first })
    }

    fn learn_offsets(&mut self, told: &[Told]) {
        let code = |told: &Told| told.1.code.map(|code| code.value);
        let first = told.iter().find(|(antenna, _)| *antenna == 0).and_then(code);
        let Some(first) = first else { return };
        for own in told.iter().filter(|(antenna, _)| *antenna != 0) {
            let Some(longer) = code(own).map(|code| code - first) else { continue };
            let key = (own.0, time_keeper(own.1.satellite.constellation));
            let (mean, count) = self.offsets.entry(key).or_default();
            *count = (*count + 1.0).min(REMEMBERED);
            *mean += (longer - *mean) / *count;
        }
    }

    /// What the codes of an antenna's receiver are longer by; `None` where that has not been heard.
    fn offset(&self, antenna: usize, range: &SatelliteRange) -> Option<f64> {
        if antenna == 0 {
            return Some(0.0);
        }
        let key = (antenna, time_keeper(range.satellite.constellation));
        self.offsets.get(&key).map(|(mean, _)| *mean)
    }

    fn merged(&mut self, levers: &[Vector3<f64>], told: &[Told]) -> SatelliteRange {
        let own = told[0].1;
        let count = told.len() as f64;
        let middle = told.iter().map(|(antenna, _)| levers[*antenna]).sum::<Vector3<f64>>() / count;
        let codes = told.iter().filter_map(|(antenna, range)| {
            let code = range.code?;
            Some(Measured { value: code.value - self.offset(*antenna, range)?, ..code })
        });
        let codes = agreeing(codes.collect(), own.multipath_std);
        let rates: Vec<Measured> = told.iter().filter_map(|(_, range)| range.rate).collect();
        let phase = self.phase(told);
        SatelliteRange {
            offset: middle - levers[0],
            multipath_std: own.multipath_std / (codes.len().max(1) as f64).sqrt(),
            code: mean(&codes),
            rate: mean(&rates),
            phase,
            ..own
        }
    }

    /// The mean of all phases, if all of them are there: of another set it would be the phase of another place.
    fn phase(&mut self, told: &[Told]) -> Option<ArcPhase> {
        let phases: Vec<_> =
            told.iter().filter_map(|(antenna, range)| Some((*antenna, range.phase?))).collect();
        if phases.len() < told.len() {
            return None;
        }
        let arcs: Vec<_> = phases.iter().map(|(antenna, phase)| (*antenna, phase.arc)).collect();
        let values: Vec<_> = phases.iter().map(|(_, phase)| phase.phase).collect();
        let (known, number) = self.arcs.entry(told[0].1.satellite).or_default();
        if *known != arcs {
            self.arcs_begun += 1;
            (*known, *number) = (arcs, self.arcs_begun);
        }
        let arc = *number;
        mean(&values).map(|phase| ArcPhase { phase, arc })
    }
}

/// Those that are of the same way as the middle one.
fn agreeing(codes: Vec<Measured>, multipath_std: f64) -> Vec<Measured> {
    let mut values: Vec<f64> = codes.iter().map(|code| code.value).collect();
    values.sort_by(f64::total_cmp);
    let Some(middle) = values.get(values.len() / 2).copied() else { return codes };
    let is_near = |code: &Measured| {
        let sigma = (code.variance + multipath_std * multipath_std).sqrt();
        (code.value - middle).abs() < FAR * sigma
    };
    codes.into_iter().filter(is_near).collect()
}

fn mean(all: &[Measured]) -> Option<Measured> {
    let count = all.len() as f64;
    (!all.is_empty()).then(|| Measured {
        value: all.iter().map(|own| own.value).sum::<f64>() / count,
        variance: all.iter().map(|own| own.variance).sum::<f64>() / (count * count),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::satellites::Transmitter;

    fn range(code: f64, phase: f64, arc: u32) -> SatelliteRange {
        let measured = |value| Measured { value, variance: 0.09 };
        SatelliteRange {
            satellite: "E11".parse().unwrap(),
            offset: Vector3::zeros(),
            transmitter: Transmitter {
                position: Vector3::new(2.9e7, 0.0, 0.0),
                velocity: Vector3::zeros(),
            },
            elevation: 1.0,
            code: Some(measured(code)),
            rate: None,
            phase: Some(ArcPhase { phase: measured(phase), arc }),
            slow_std: 1.0,
            by_ionosphere: 1.0,
            multipath_std: 0.4,
        }
    }

    const LEVERS: [[f64; 3]; 2] = [[1.0, 0.0, -5.0], [1.2, 0.4, -5.0]];

    fn merged(mean: &mut MeanAntenna, told: &[Told]) -> SatelliteRange {
        mean.learn_offsets(told);
        mean.merged(&LEVERS.map(Vector3::from), told)
    }

    #[test]
    fn two_antennas_are_one_between_them_with_codes_of_the_first_ones_receiver() {
        let told = [(0, range(100.0, 50.0, 1)), (1, range(107.0, 52.0, 9))];
        let own = merged(&mut MeanAntenna::default(), &told);
        assert!((own.offset - Vector3::new(0.1, 0.2, 0.0)).norm() < 1e-12);
        let code = own.code.unwrap();
        assert!((code.value - 100.0).abs() < 1e-9 && (code.variance - 0.045).abs() < 1e-12);
        assert!((own.phase.unwrap().phase.value - 51.0).abs() < 1e-12);
        assert!((own.multipath_std - 0.4 / 2_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_slip_of_one_or_an_antenna_less_begins_another_arc() {
        let mut mean = MeanAntenna::default();
        let mut arc = |told: &[Told]| merged(&mut mean, told).phase.unwrap().arc;
        let (first, second) = ((0, range(100.0, 50.0, 1)), (1, range(100.0, 52.0, 9)));
        let both = arc(&[first, second]);
        assert_eq!(arc(&[first, second]), both);
        let slipped = arc(&[first, (1, range(100.0, 52.0, 10))]);
        assert_ne!(slipped, both);
        let alone = arc(&[first]);
        assert!(alone != slipped && alone != both);
    }

    #[test]
    fn a_code_by_another_way_is_not_in_the_mean() {
        let mut mean = MeanAntenna::default();
        let three = |third: f64| {
            [(0, range(100.0, 50.0, 1)), (1, range(100.2, 52.0, 9)), (1, range(third, 52.0, 9))]
        };
        merged(&mut mean, &three(100.1));
        let own = mean.merged(&LEVERS.map(Vector3::from), &three(130.0));
        assert!((own.code.unwrap().value - 100.0).abs() < 0.5, "{:?}", own.code);
    }
}
