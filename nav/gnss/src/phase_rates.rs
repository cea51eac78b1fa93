//! What phases change by from one epoch to the next, as range rates in the middle between the two: the line-of-sight velocities of the berthing source.
//!
//! Furuno and NAIST (docs/systems.md, S4), eq. (8): `eta = v_k - lambda d(phi)/dt - Z - u`, with one clock drift Z for all; eq. (10): phases of once a second
//! tell the velocity of half a second before.

use insd_base::Span;
use insd_base::satellites::{Measured, SatelliteRange, SatelliteRanges, Transmitter};

/// Epochs that are further apart than this are not of one stretch, s.
const APART: f64 = 3.0;

/// A receiver whose phases are told as rates.
#[derive(Clone, Debug, Default)]
pub struct PhaseRates {
    before: Option<SatelliteRanges>,
}

impl PhaseRates {
    /// The rates between the epoch before and this one, at the instant in the middle. `None` of the first one, and after a gap.
    pub fn take(&mut self, told: &SatelliteRanges) -> Option<SatelliteRanges> {
        let before = self.before.replace(told.clone())?;
        let lasted = told.time - before.time;
        let seconds = lasted.as_seconds();
        if seconds <= 0.0 || seconds > APART {
            return None;
        }
        let rate = |now: &SatelliteRange| {
            let then = before.ranges.iter().find(|then| then.satellite == now.satellite)?;
            between(then, now, seconds)
        };
        let ranges = told.ranges.iter().filter_map(rate).collect();
        let time = before.time + Span::from_nanos(lasted.as_nanos() / 2);
        let heard = told.heard.clone();
        Some(SatelliteRanges { time, clock: None, ranges, displacement: None, heard })
    }
}

fn between(then: &SatelliteRange, now: &SatelliteRange, seconds: f64) -> Option<SatelliteRange> {
    let (old, new) = then.phase.zip(now.phase)?;
    let change = new.phase.value - old.phase.value;
    let variance = (new.phase.variance + old.phase.variance) / (seconds * seconds);
    let transmitter = Transmitter {
        position: (then.transmitter.position + now.transmitter.position) * 0.5,
        velocity: (now.transmitter.position - then.transmitter.position) / seconds,
    };
    (old.arc == new.arc && then.offset == now.offset).then(|| SatelliteRange {
        transmitter,
        code: None,
        phase: None,
        rate: Some(Measured { value: change / seconds, variance }),
        ..*now
    })
}

#[cfg(test)]
mod tests {
    use insd_base::Time;
    use insd_base::satellites::ArcPhase;
    use insd_base::{Constellation, SatelliteId};
    use nalgebra::Vector3;

    use super::*;

    fn told(seconds: f64, arc: u32) -> SatelliteRanges {
        let along = Vector3::new(0.0, 3_000.0, 0.0);
        let position = Vector3::new(26_000_000.0, 0.0, 0.0) + along * seconds;
        let phase = Measured { value: 5.0 + 700.0 * seconds, variance: 4e-6 };
        let range = SatelliteRange {
            satellite: SatelliteId { constellation: Constellation::Gps, number: 7 },
            offset: Vector3::zeros(),
            transmitter: Transmitter { position, velocity: along },
            elevation: 1.0,
            code: Some(phase),
            rate: None,
            phase: Some(ArcPhase { phase, arc }),
            slow_std: 1.0,
            by_ionosphere: 0.0,
            multipath_std: 0.3,
        };
        let time = Time::from_seconds(seconds);
        SatelliteRanges {
            time,
            clock: None,
            ranges: vec![range],
            displacement: None,
            heard: Vec::new(),
        }
    }

    #[test]
    fn a_phase_tells_the_rate_of_half_a_second_before() {
        let mut rates = PhaseRates::default();
        assert!(rates.take(&told(10.0, 1)).is_none());
        let told = rates.take(&told(11.0, 1)).unwrap();
        assert_eq!(told.time, Time::from_seconds(10.5));
        let [range] = &told.ranges[..] else { panic!("{:?}", told.ranges) };
        let rate = range.rate.unwrap();
        assert!((rate.value - 700.0).abs() < 1e-9 && (rate.variance - 8e-6).abs() < 1e-12);
        assert!(range.code.is_none() && range.phase.is_none());
        assert!((range.transmitter.position.y - 31_500.0).abs() < 1e-6);
    }

    #[test]
    fn over_a_slip_and_over_a_gap_there_is_no_rate() {
        let mut rates = PhaseRates::default();
        rates.take(&told(10.0, 1));
        assert!(rates.take(&told(11.0, 2)).unwrap().ranges.is_empty());
        assert!(rates.take(&told(20.0, 2)).is_none());
    }
}
