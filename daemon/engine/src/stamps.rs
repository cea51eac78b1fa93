//! Whether the clock that stamps the samples of the IMU goes on evenly: a step of it is no gap.
//!
//! A sample is stamped with its time of validity, and received later, never before. Stamps that leap ahead of when they are
//! received were leapt by their clock; those that fall back while samples come as evenly as ever, too, but not those that come
//! together after they lay in a buffer. What it stepped by is taken back, so that the samples go on where they were: the other
//! sensors' times are of other clocks. Where nothing is known of when a sample was received nothing is seen.

use insd_base::{ImuSample, Message, Received, Span, Time};

/// A step is one beyond this, s.
const STEP: f64 = 0.2;
/// A stamp is from the future that is so far ahead of its receipt, s.
const FUTURE: f64 = 0.1;
/// Samples in a row that fall back with one another: fewer came out of order.
const CONFIRMED: u32 = 3;
/// Samples in a row are no further apart, in intervals.
const SUCCESSIVE: f64 = 10.0;
/// Receipts of samples that come evenly pass with their stamps, within such a ratio.
const EVENLY: f64 = 2.0;
/// Steps longer than this are taken for gaps, s: what she did meanwhile is anyone's guess.
const LONG: f64 = 10.0;
/// A pause in which more than the clock may have changed, s.
const PAUSE: f64 = 2.0;

/// What the clock has stepped by.
#[derive(Clone, Debug)]
pub(crate) struct Stamps {
    /// Interval of the samples, s.
    interval: f64,
    stepped: Span,
    last: Option<Stamped>,
    back: Option<Back>,
}

/// Samples in a row that fell back.
#[derive(Clone, Copy, Debug)]
struct Back {
    first: Stamped,
    last: Stamped,
    count: u32,
}

/// When a sample is valid, by the corrected clock, and when it was received.
#[derive(Clone, Copy, Debug)]
struct Stamped {
    valid: Time,
    receipt: Time,
}

impl Stamped {
    /// What passed since an earlier one, by the stamps and by the receipts, s.
    fn since(&self, earlier: &Stamped) -> (f64, f64) {
        let passed = |to: Time, from: Time| (to - from).as_seconds();
        (passed(self.valid, earlier.valid), passed(self.receipt, earlier.receipt))
    }
}

impl Stamps {
    /// Samples so many seconds apart.
    pub(crate) fn new(interval: f64) -> Self {
        Stamps { interval, stepped: Span::ZERO, last: None, back: None }
    }

    /// The sample by the corrected clock, and what that has stepped by just now, s.
    pub(crate) fn corrected(
        &mut self,
        sample: &ImuSample,
        receipt: Time,
    ) -> (ImuSample, Option<f64>) {
        let mut own = Stamped { valid: sample.time - self.stepped, receipt };
        let step = self.last.and_then(|last| self.step(&last, &own));
        if let Some(step) = step {
            own.valid = own.valid - Span::from_seconds(step);
            if (sample.time - own.valid).as_seconds().abs() < STEP {
                own.valid = sample.time;
            }
            self.stepped = sample.time - own.valid;
        }
        if self.last.is_none_or(|last| own.valid > last.valid) {
            self.last = Some(own);
            self.back = None;
        }
        (ImuSample { time: own.valid, ..*sample }, step)
    }

    /// What the clock may have stepped by at this sample, s, where nothing tells a step from a gap.
    pub(crate) fn may_have_stepped(&self, received: &Received) -> Option<f64> {
        let Message::Imu(sample) = received.message else { return None };
        let last = self.last.filter(|last| last.receipt == last.valid + self.stepped)?;
        let step = (sample.time - self.stepped - last.valid).as_seconds() - self.interval;
        (received.receipt == sample.time && (STEP..LONG).contains(&step)).then_some(step)
    }

    /// Takes back a step.
    pub(crate) fn take_back(&mut self, step: f64) {
        self.stepped =
            Span::from_nanos(self.stepped.as_nanos() + Span::from_seconds(step).as_nanos());
    }

    fn step(&mut self, last: &Stamped, own: &Stamped) -> Option<f64> {
        let (stamped, received) = own.since(last);
        let step = stamped - received.max(self.interval);
        let is_short = (0.0..PAUSE).contains(&received);
        if step > STEP && (own.valid - own.receipt).as_seconds() > FUTURE {
            return Some(step);
        }
        if !is_short || step > -STEP {
            return None;
        }
        let follows = self.back.filter(|back| {
            let (stamped, received) = own.since(&back.last);
            let successive = 0.0..SUCCESSIVE * self.interval;
            stamped > 0.0 && successive.contains(&stamped) && successive.contains(&received)
        });
        let back = follows.map_or(Back { first: *own, last: *own, count: 1 }, |back| Back {
            last: *own,
            count: back.count + 1,
            ..back
        });
        self.back = Some(back);
        let (stamped, received) = own.since(&back.first);
        let pass_together = (stamped / EVENLY..=stamped * EVENLY).contains(&received);
        (back.count >= CONFIRMED && pass_together).then_some(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Body;

    /// Stamps that are told, and when each was received, s, with the interval 10 ms.
    fn corrected(samples: &[(f64, f64)]) -> (Vec<f64>, Vec<f64>) {
        let mut stamps = Stamps::new(0.01);
        let (mut times, mut steps) = (Vec::new(), Vec::new());
        for (time, receipt) in samples {
            let (time, receipt) = (Time::from_seconds(*time), Time::from_seconds(*receipt));
            let nothing = Body(nalgebra::Vector3::zeros());
            let sample = ImuSample { time, delta_theta: nothing, delta_velocity: nothing };
            let (sample, step) = stamps.corrected(&sample, receipt);
            times.push(sample.time.as_seconds());
            steps.extend(step);
        }
        (times, steps)
    }

    fn run(from: u32, until: u32, off: f64, late: f64) -> impl Iterator<Item = (f64, f64)> {
        (from..until).map(move |k| (0.01 * f64::from(k) + off, 0.01 * f64::from(k) + late))
    }

    #[test]
    fn a_clock_that_leaps_ahead_is_set_back_and_no_sample_is_lost() {
        let samples: Vec<_> = run(0, 100, 0.0, 0.002).chain(run(100, 200, 1.6, 0.002)).collect();
        let (times, steps) = corrected(&samples);
        assert!((steps[0] - 1.6).abs() < 1e-6 && steps.len() == 1, "{steps:?}");
        let worst = times.windows(2).map(|two| (two[1] - two[0] - 0.01).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-6, "{worst}");
    }

    #[test]
    fn a_clock_that_falls_back_costs_two_samples() {
        let back = run(0, 100, 0.0, 0.002).chain(run(100, 200, -1.6, 0.002));
        let (times, steps) = corrected(&back.collect::<Vec<_>>());
        assert!((steps[0] + 1.6).abs() < 0.021 && steps.len() == 1, "{steps:?}");
        assert!((times[102] - 1.02).abs() < 0.021, "{}", times[102]);
    }

    #[test]
    fn a_gap_a_burst_and_samples_out_of_order_are_no_steps() {
        let gap = run(0, 100, 0.0, 0.002).chain(run(300, 400, 0.0, 0.002));
        let burst = (0..300).map(|k| {
            let time = 0.01 * f64::from(k);
            (time, if k < 100 { time + 0.002 } else { time.max(2.5) })
        });
        let swapped =
            run(0, 100, 0.0, 0.3).chain([(0.5, 1.3), (1.0, 1.31)]).chain(run(101, 200, 0.0, 0.3));
        // samples that lay for two seconds in a buffer which then ran over
        let over = run(0, 100, 0.0, 2.0).chain(run(300, 400, 0.0, 0.0));
        // samples of the second before, out of a buffer, after a first one that was stamped when it was read
        let buffered = (0..200).map(|k| {
            let time = 0.01 * f64::from(k);
            (if k == 0 { 1.0 } else { time }, time.max(1.0))
        });
        let all = [gap.collect::<Vec<_>>(), burst.collect(), swapped.collect(), over.collect()];
        for samples in all.into_iter().chain([buffered.collect()]) {
            let (times, steps) = corrected(&samples);
            assert!(steps.is_empty(), "{steps:?}");
            assert!(times.iter().zip(&samples).all(|(time, told)| (time - told.0).abs() < 1e-9));
        }
    }

    #[test]
    fn a_single_stamp_from_the_far_future_changes_nothing_for_long() {
        for receipt in [1.0, 1e9] {
            let wild = run(0, 100, 0.0, 0.0).chain([(1e9, receipt)]).chain(run(100, 200, 0.0, 0.0));
            let (times, _) = corrected(&wild.collect::<Vec<_>>());
            let late = &times[150..];
            assert!(
                late.iter().zip(149..).all(|(time, k)| (time - 0.01 * f64::from(k)).abs() < 0.02)
            );
        }
    }

    #[test]
    fn where_nothing_is_known_of_receipts_nothing_is_seen() {
        let samples =
            run(0, 100, 0.0, 0.0).chain(run(260, 300, 0.0, 0.0)).chain(run(50, 90, 0.0, 0.0));
        assert!(corrected(&samples.collect::<Vec<_>>()).1.is_empty());
    }
}
