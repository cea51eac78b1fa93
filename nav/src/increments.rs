//! IMU samples made ready for integration: gaps and duplicates told apart, coning and sculling
//! compensated, and cut at any instant where a measurement falls inside the interval.

use insd_base::{ImuSample, ImuSpec, Rejection, Span, Time};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::angular_rate::AngularRate;
use crate::bridging::{Bridging, Moment};
use crate::noise::NoiseMonitor;
use crate::spikes::Spikes;
pub use increment::Increment;
pub(crate) use increment::second_order;

mod increment;

/// What one IMU sample gave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conditioned {
    /// The increments of the sample.
    Sample(Increment),
    /// Samples were missing before this one: the bridge over the gap, then the sample.
    AfterGap(Increment, Increment),
    /// Not used.
    Rejected(Rejection),
}

/// Turns samples into increments; remembers the last sample.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Conditioner {
    nominal: f64,
    rate: NoiseMonitor,
    force: NoiseMonitor,
    spikes: Spikes,
    bridging: Bridging,
    turning: AngularRate,
    /// Mean square of the stamps' departure from the nominal interval, s^2.
    jitter: f64,
    last: Option<Last>,
    leap: Option<Time>,
    /// Time of a sample that was left out as a spike, until the next.
    #[serde(skip)]
    spike: Option<Time>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Last {
    time: Time,
    mean: Mean,
}

/// Mean angular rate and specific force of a sample, and its length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Mean {
    rate: Vector3<f64>,
    force: Vector3<f64>,
    duration: f64,
}

/// Rates beyond this are no ship's, rad/s.
const MAX_RATE: f64 = 50.0;
/// Specific forces beyond this are no ship's, m/s^2.
const MAX_FORCE: f64 = 500.0;
/// Weight of a new interval in the mean square of the stamps' jitter.
const JITTER_WEIGHT: f64 = 0.01;
/// A leap of the stamps that must be confirmed, s.
const LEAP: f64 = 30.0;
/// Jitter over the nominal interval beyond which stamps count as uneven.
const JITTERING: f64 = 0.01;
/// An interval longer than this many nominal ones holds missing samples.
const GAP: f64 = 1.5;

impl Mean {
    fn moment(&self) -> Moment {
        Moment { rate: self.rate, force: self.force }
    }
}

impl Conditioner {
    /// A conditioner for samples of this IMU.
    #[must_use]
    pub fn new(imu: &ImuSpec) -> Self {
        Conditioner {
            nominal: 1.0 / imu.rate,
            rate: NoiseMonitor::new(imu.gyro.random_walk, 1.0 / imu.rate),
            force: NoiseMonitor::new(imu.accel.random_walk, 1.0 / imu.rate),
            spikes: Spikes::default(),
            bridging: Bridging::default(),
            turning: AngularRate::new(imu),
            jitter: 0.0,
            last: None,
            leap: None,
            spike: None,
        }
    }

    /// The same on a time line that is later by a span: the next sample closes a gap.
    #[must_use]
    pub fn shifted(self, by: Span) -> Self {
        let last = self.last.map(|last| Last { time: last.time + by, ..last });
        Conditioner { last, leap: None, spike: None, ..self }
    }

    /// What is kept for the next start of the program.
    #[must_use]
    pub fn kept(&self) -> Self {
        let bridging = match &self.last {
            Some(last) => self.bridging.kept(last.time, &last.mean.moment()),
            None => Bridging::default(),
        };
        Conditioner {
            nominal: self.nominal,
            rate: self.rate.kept(),
            force: self.force.kept(),
            spikes: self.spikes,
            bridging,
            turning: self.turning,
            jitter: self.jitter,
            last: self.last,
            leap: self.leap,
            spike: None,
        }
    }

    /// What has been learnt of bridging gaps.
    #[must_use]
    pub fn bridging(&self) -> &Bridging {
        &self.bridging
    }

    /// Whether all of it are numbers.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let last = self.last.is_none_or(|last| {
            let mean = &last.mean;
            mean.duration.is_finite() && mean.rate.iter().chain(&mean.force).all(|x| x.is_finite())
        });
        let learnt = self.bridging.is_finite() && self.turning.is_finite();
        last && learnt && self.jitter.is_finite()
    }

    /// Takes the next sample.
    ///
    /// An interval within 1.5 nominal ones is taken as it is (uneven stamps: the increments cover
    /// (last, this]); beyond that the sample covers the last nominal interval and the time before it
    /// is a gap, bridged as [`Bridging`] has learnt to. A sample that was left out as a spike is such a gap, up to
    /// its stamp. The first sample covers a nominal interval.
    pub fn take(&mut self, sample: &ImuSample) -> Conditioned {
        let Some(last) = self.last else {
            return self.first(sample);
        };
        let elapsed = (sample.time - last.time).as_seconds();
        if sample.time == last.time {
            return Conditioned::Rejected(Rejection::Duplicate);
        }
        if elapsed < 0.0 {
            return Conditioned::Rejected(Rejection::OutOfOrder);
        }
        if elapsed > LEAP && !self.is_confirmed(sample.time) {
            return Conditioned::Rejected(Rejection::OutOfRange);
        }
        let gap = elapsed > GAP * self.nominal;
        let duration = if gap { self.coverage_after_gap(sample, &last) } else { elapsed };
        self.spike = None;
        let Some(mean) = mean_of(sample, duration) else {
            return Conditioned::Rejected(Rejection::OutOfRange);
        };
        let changes = [mean.rate - last.mean.rate, mean.force - last.mean.force];
        if self.spikes.see(changes) {
            self.spike = Some(sample.time);
            return Conditioned::Rejected(Rejection::Spike);
        }
        self.last = Some(Last { time: sample.time, mean });
        if gap {
            self.rate.interrupt();
            self.force.interrupt();
        }
        self.turning.tune(self.rate.excess().max());
        self.turning.take(&mean.rate, duration, elapsed - duration);
        self.rate.learn(&mean.rate, duration);
        self.force.learn(&mean.force, duration);
        if gap {
            let start = sample.time - Span::from_seconds(duration);
            let bridge = self.bridge(&last, start, &mean);
            self.bridging.interrupt();
            Conditioned::AfterGap(
                bridge,
                self.with_noise(compensated(&mean, &mean, (start, sample.time), &self.turning)),
            )
        } else {
            self.jitter += ((elapsed - self.nominal).powi(2) - self.jitter) * JITTER_WEIGHT;
            let interval = (last.time, sample.time);
            let increment = compensated(&last.mean, &mean, interval, &self.turning);
            self.bridging.learn(&increment, &mean.moment());
            Conditioned::Sample(self.with_noise(increment))
        }
    }

    /// How much time the sample after a gap covers, s: that since a spike, else a nominal interval, unless the stamps
    /// jitter. Then gravity is the better clock: the specific force is much the same before and after.
    fn coverage_after_gap(&self, sample: &ImuSample, last: &Last) -> f64 {
        let since_spike = self.spike.map_or(0.0, |spike| (sample.time - spike).as_seconds());
        if since_spike > 0.0 && since_spike <= GAP * self.nominal {
            return since_spike;
        }
        let jitters = self.jitter.sqrt() > JITTERING * self.nominal;
        let before = last.mean.force.norm();
        if !jitters || before <= 0.0 {
            return self.nominal;
        }
        let by_force = sample.delta_velocity.0.norm() / before;
        by_force.clamp(0.5 * self.nominal, GAP * self.nominal)
    }

    /// The increment over missing samples. Where stamps jitter, nobody knows to a stamp's error when
    /// the sample after the gap began: mean rate and force over that time are added to the noise.
    fn bridge(&self, last: &Last, to: Time, next: &Mean) -> Increment {
        let missing = (to - last.time).as_seconds();
        let bridge = self.bridging.bridge(last.time, missing, &last.mean.moment(), &next.moment());
        let jitter = |v: &Vector3<f64>| v.component_mul(v) * (self.jitter / missing);
        Increment {
            from: last.time,
            to,
            rotation: bridge.rotation,
            velocity: bridge.velocity,
            end_rate: next.rate,
            end_rate_variance: self.turning.variance(),
            angular_acceleration: Vector3::zeros(),
            rate_noise: jitter(&next.rate) + bridge.rotation_variance / missing,
            force_noise: jitter(&next.force) + bridge.velocity_variance / missing,
            bridged: Some(missing),
            celsius: None,
        }
    }

    /// A stamp that leaps far ahead counts once the next sample follows it: a single wild stamp must
    /// not put all that come after it in the past.
    fn is_confirmed(&mut self, time: Time) -> bool {
        let follows = self.leap.is_some_and(|leap| {
            let step = (time - leap).as_seconds();
            step > 0.0 && step <= GAP * self.nominal
        });
        self.leap = (!follows).then_some(time);
        follows
    }

    fn with_noise(&self, increment: Increment) -> Increment {
        Increment { rate_noise: self.rate.excess(), force_noise: self.force.excess(), ..increment }
    }

    fn first(&mut self, sample: &ImuSample) -> Conditioned {
        let Some(mean) = mean_of(sample, self.nominal) else {
            return Conditioned::Rejected(Rejection::OutOfRange);
        };
        self.last = Some(Last { time: sample.time, mean });
        self.turning.take(&mean.rate, self.nominal, 0.0);
        let start = sample.time - Span::from_seconds(self.nominal);
        let interval = (start, sample.time);
        Conditioned::Sample(compensated(&mean, &mean, interval, &self.turning))
    }
}

fn mean_of(sample: &ImuSample, duration: f64) -> Option<Mean> {
    let rate = sample.delta_theta.0 / duration;
    let force = sample.delta_velocity.0 / duration;
    let physical = rate.amax() < MAX_RATE && force.amax() < MAX_FORCE;
    let finite = rate.iter().chain(force.iter()).all(|x| x.is_finite());
    (physical && finite).then_some(Mean { rate, force, duration })
}

/// Coning and sculling compensation from this sample and the one before, both rates taken as linear
/// in time over the two intervals, which need not be equal:
///
/// coning = h^3/12 (omega x omega'), sculling = h^3/12 (omega x f' - omega' x f),
///
/// with omega and f at the middle of this interval and omega', f' their slopes. For equal intervals
/// these are the two-sample forms of Savage, Strapdown Inertial Navigation Integration Algorithm
/// Design, J. Guidance 21 (1998), eqs. (33), (55)-(57) in part 1 and part 2.
/// The rate at the end of the interval is that of the line through the samples, `turning`.
fn compensated(
    before: &Mean,
    this: &Mean,
    (from, to): (Time, Time),
    turning: &AngularRate,
) -> Increment {
    let h = this.duration;
    let spacing = 0.5 * (before.duration + h);
    let rate_slope = (this.rate - before.rate) / spacing;
    let force_slope = (this.force - before.force) / spacing;
    let weight = h * h * h / 12.0;
    let (end_rate, angular_acceleration) = turning.at_end();
    Increment {
        from,
        to,
        rotation: this.rate * h + this.rate.cross(&rate_slope) * weight,
        velocity: this.force * h
            + (this.rate.cross(&force_slope) - rate_slope.cross(&this.force)) * weight,
        end_rate,
        end_rate_variance: turning.variance(),
        angular_acceleration,
        rate_noise: Vector3::zeros(),
        force_noise: Vector3::zeros(),
        bridged: None,
        celsius: None,
    }
}

#[cfg(test)]
mod tests;
