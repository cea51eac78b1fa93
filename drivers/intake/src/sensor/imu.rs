//! Samples of an IMU on the ship's time line.
//!
//! The device's clock or sample counter says how long it was from one sample to the next, the receipts
//! say when that was; a [`ClockMap`] brings both together. The first second is held back until the map
//! is tied.

use insd_base::{ImuSample, Span, Time};
use insd_wire::imu::{ImuMotion, ImuReading};
use nalgebra::Matrix3;
use schemars::JsonSchema;

use crate::clock::{ClockMap, MapChange, Observed, ShipUtc, Unwrap};
use crate::mounting::turned;

/// A sample may not be later than its receipt by more than this, s.
const FUTURE: f64 = 0.1;
/// A device's clock that goes back by more than this, s, and by more than so many samples has been set
/// anew; less than that are datagrams that changed places.
const BACK: f64 = 0.05;
const BACK_SAMPLES: f64 = 4.5;
/// What a device's clock is off at most, ratio.
const CLOCK_STD: f64 = 2e-4;
/// What the sample rate is off at most where nothing but a counter tells it, ratio.
const RATE_STD: f64 = 5e-3;
/// Samples held back while the clocks are being tied; more than that are dropped, oldest first.
const HELD: usize = 20_000;

/// Whose time is believed for the samples.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Default, serde::Deserialize, serde::Serialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum TimeBase {
    /// The device's clock, or its sample counter where it has no clock.
    #[default]
    Device,
    /// UTC as the device states it: for one that is synchronised to the ship's GNSS receiver.
    Utc,
}

/// What an installer says of an IMU.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImuSettings {
    /// Nominal interval between samples, s.
    pub period: f64,
    /// Time from the end of a sampling interval to the first byte on the wire, s, beyond what the
    /// device states.
    pub latency: f64,
    /// Whose time is believed.
    pub time_base: TimeBase,
    /// Rotation from the device's axes to the hull's.
    pub c_bd: Matrix3<f64>,
}

/// What a sample changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ImuChange {
    /// The counter says that so many samples are missing.
    Lost(u64),
    /// The device's clock stepped by so much, s.
    ClockStepped(f64),
}

/// One IMU.
#[derive(Clone, Debug)]
pub struct ImuIntake {
    settings: ImuSettings,
    map: ClockMap,
    ticks: Unwrap,
    counter: Unwrap,
    counted: Option<i64>,
    /// When the last reading began to come.
    begun: Option<Time>,
    /// Samples so far: the clock of a device without any.
    samples: i64,
    last: Option<i64>,
    /// Device's time, and the sample without a time on the ship's line.
    held: Vec<(i64, ImuSample)>,
}

impl ImuIntake {
    /// An IMU that has not spoken yet.
    #[must_use]
    pub fn new(settings: ImuSettings) -> Self {
        ImuIntake {
            settings,
            map: ClockMap::new(Observed::Receipts, CLOCK_STD),
            ticks: Unwrap::default(),
            counter: Unwrap::default(),
            counted: None,
            begun: None,
            samples: 0,
            last: None,
            held: Vec::new(),
        }
    }

    /// Takes a reading whose first byte came at `begun`. Samples that now have their time go to `ready`;
    /// what happened is returned.
    pub fn take(
        &mut self,
        reading: &ImuReading,
        begun: Time,
        utc: &ShipUtc,
        ready: &mut Vec<ImuSample>,
    ) -> [Option<ImuChange>; 2] {
        let lost = self.count(reading, begun);
        let own = self.device_time(reading);
        let by_utc = self.settings.time_base == TimeBase::Utc;
        let Some(foreign) = own else { return [lost, None] };
        let stepped = if by_utc { None } else { self.tie(foreign, begun, reading) };
        let sample = self.sample(reading, foreign);
        self.last = Some(foreign);
        // formats with floats carry NaN, and numbers that are none any more once they are turned
        if reading.valid && is_finite(&sample) {
            self.held.push((foreign, sample));
        }
        self.release(utc, ready);
        [lost, stepped]
    }

    /// Counts samples. Where some are missing, the time between receipts tells how often a short counter
    /// went on over its end meanwhile.
    fn count(&mut self, reading: &ImuReading, begun: Time) -> Option<ImuChange> {
        self.samples += 1;
        let between = self.begun.replace(begun).map_or(0.0, |last| (begun - last).as_seconds());
        let counter = reading.counter?;
        let count = self.counter.follow(counter);
        let before = self.counted.replace(count)?;
        let steps = count.saturating_sub(before);
        if steps <= 1 {
            return None;
        }
        let unexplained = between / self.settings.period - steps as f64;
        let cycles = (unexplained / counter.modulus as f64).round().max(0.0) as i64;
        let skipped = cycles.saturating_mul(i64::try_from(counter.modulus).unwrap_or(0));
        self.counter.skip(skipped);
        self.counted = Some(count.saturating_add(skipped));
        let missing = steps.saturating_add(skipped) - 1;
        self.samples = self.samples.saturating_add(missing);
        Some(ImuChange::Lost(missing.unsigned_abs()))
    }

    /// Time of the sample on the device's clock, ns; `None` if it should tell UTC and does not.
    fn device_time(&mut self, reading: &ImuReading) -> Option<i64> {
        if self.settings.time_base == TimeBase::Utc {
            return reading.utc.map(|utc| utc.to_gps().as_nanos());
        }
        let period = self.settings.period;
        let seconds = match (reading.device_time, self.counted) {
            (Some(clock), _) => self.ticks.follow(clock.ticks) as f64 * clock.tick,
            (None, Some(count)) => count as f64 * period,
            (None, None) => self.samples as f64 * period,
        };
        Some((seconds * 1e9).round() as i64)
    }

    /// Ties the device's clock to the computer's.
    fn tie(&mut self, foreign: i64, begun: Time, reading: &ImuReading) -> Option<ImuChange> {
        let latency = self.settings.latency + reading.latency.unwrap_or(0.0);
        let seen = begun - Span::from_seconds(latency);
        let far = BACK.max(BACK_SAMPLES * self.settings.period);
        let back = self.last.is_some_and(|last| seconds(last, foreign) > far);
        let late = self.map.map(foreign).map(|time| (seen - time).as_seconds());
        let mut by = None;
        if back || late.is_some_and(|late| late < -FUTURE) {
            by = late;
            self.map.forget_offset();
            // when those that still wait were taken nobody will know any more
            self.held.clear();
        }
        if self.last.is_none() {
            let std = if reading.device_time.is_some() { CLOCK_STD } else { RATE_STD };
            self.map = ClockMap::new(Observed::Receipts, std);
        }
        if let MapChange::Stepped { by: step } = self.map.observe(foreign, seen) {
            by = Some(step);
        }
        by.map(ImuChange::ClockStepped)
    }

    /// The sample's increments in the hull's axes; its time is not known yet.
    fn sample(&self, reading: &ImuReading, foreign: i64) -> ImuSample {
        let period = self.settings.period;
        let elapsed = self.last.map_or(period, |last| seconds(foreign, last));
        // what a coarse clock tells beyond the nominal interval is its own rounding
        let tick = reading.device_time.map_or(0.0, |clock| 1.01 * clock.tick);
        let told = (elapsed - period).abs() > tick && (0.5..1.5).contains(&(elapsed / period));
        let covered = if told { elapsed } else { period };
        let (theta, velocity) = match reading.motion {
            ImuMotion::Increments { delta_theta, delta_velocity } => (delta_theta, delta_velocity),
            ImuMotion::Rates { gyro, accel } => {
                (gyro.map(|rate| rate * covered), accel.map(|force| force * covered))
            }
        };
        ImuSample {
            time: Time::START,
            delta_theta: turned(&self.settings.c_bd, theta),
            delta_velocity: turned(&self.settings.c_bd, velocity),
        }
    }

    fn release(&mut self, utc: &ShipUtc, ready: &mut Vec<ImuSample>) {
        let (map, by_utc) = (&self.map, self.settings.time_base == TimeBase::Utc);
        let time_of = |foreign: i64| {
            if by_utc {
                utc.time_of(insd_base::GpsTime::from_nanos(foreign))
            } else {
                map.map(foreign)
            }
        };
        let tied = self.held.last().is_some_and(|(foreign, _)| time_of(*foreign).is_some());
        if tied {
            let timed = self.held.drain(..).filter_map(|(foreign, sample)| {
                time_of(foreign).map(|time| ImuSample { time, ..sample })
            });
            ready.extend(timed);
        } else if self.held.len() > HELD {
            self.held.drain(..HELD / 2);
        }
    }
}

fn is_finite(sample: &ImuSample) -> bool {
    sample.delta_theta.0.iter().chain(sample.delta_velocity.0.iter()).all(|own| own.is_finite())
}

fn seconds(later: i64, earlier: i64) -> f64 {
    later.saturating_sub(earlier) as f64 * 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_wire::imu::{DeviceTime, Wrapping};

    fn settings() -> ImuSettings {
        ImuSettings {
            period: 0.01,
            latency: 0.0,
            time_base: TimeBase::Device,
            c_bd: Matrix3::identity(),
        }
    }

    fn reading(micros: u64, count: u64) -> ImuReading {
        let motion = ImuMotion::Rates { gyro: [0.1, 0.0, 0.0], accel: [0.0, 0.0, -9.8] };
        ImuReading {
            device_time: Some(DeviceTime {
                ticks: Wrapping { value: micros, modulus: 1 << 32 },
                tick: 1e-6,
            }),
            counter: Some(Wrapping { value: count, modulus: 256 }),
            ..ImuReading::bare(motion)
        }
    }

    /// Feeds samples `from..to`, received 1 ms late; gives the samples and what happened.
    fn fed(
        imu: &mut ImuIntake,
        from: u64,
        to: u64,
        micros: impl Fn(u64) -> u64,
    ) -> (Vec<ImuSample>, Vec<ImuChange>) {
        let (mut ready, mut changes) = (Vec::new(), Vec::new());
        for k in from..to {
            let begun = Time::from_seconds(k as f64 * 0.01 + 0.001);
            let reading = reading(micros(k) % (1 << 32), k % 256);
            let told = imu.take(&reading, begun, &ShipUtc::default(), &mut ready);
            changes.extend(told.into_iter().flatten());
        }
        (ready, changes)
    }

    #[test]
    fn the_first_second_is_held_back_and_nothing_is_lost() {
        let mut imu = ImuIntake::new(settings());
        let (ready, changes) = fed(&mut imu, 0, 500, |k| k * 10_000 + 4_294_000_000);
        assert_eq!((ready.len(), changes.len()), (500, 0));
        for pair in ready.windows(2) {
            let interval = (pair[1].time - pair[0].time).as_seconds();
            assert!((interval - 0.01).abs() < 1e-5, "{interval}");
        }
        assert!((ready[10].time.as_seconds() - 0.101).abs() < 1e-4);
        assert!((ready[10].delta_theta.0.x - 0.001).abs() < 1e-12);
    }

    #[test]
    fn a_jump_of_the_counter_tells_how_many_samples_are_missing() {
        let mut imu = ImuIntake::new(settings());
        fed(&mut imu, 0, 300, |k| k * 10_000);
        let (ready, changes) = fed(&mut imu, 305, 400, |k| k * 10_000);
        assert_eq!(changes, [ImuChange::Lost(5)]);
        assert!((ready[0].time.as_seconds() - 3.051).abs() < 1e-4);
        assert!((ready[0].delta_theta.0.x - 0.001).abs() < 1e-12, "covers one interval");
    }

    #[test]
    fn the_rounding_of_a_coarse_clock_is_not_in_the_increments() {
        let mut imu = ImuIntake::new(settings());
        let mut ready = Vec::new();
        for k in 0..300_u64 {
            let mut reading = reading(0, k % 256);
            // ticks of 0.1 ms of a clock that is fast by 300 ppm
            let value = (k as f64 * 100.03) as u64;
            let ticks = Wrapping { value, modulus: 1 << 32 };
            reading.device_time = Some(DeviceTime { ticks, tick: 1e-4 });
            let begun = Time::from_seconds(k as f64 * 0.01 + 0.001);
            imu.take(&reading, begun, &ShipUtc::default(), &mut ready);
        }
        assert!(ready.iter().all(|sample| (sample.delta_theta.0.x - 0.001).abs() < 1e-12));
    }

    #[test]
    fn a_short_count_that_went_round_while_nothing_came_is_made_good_by_the_receipts() {
        let mut imu = ImuIntake::new(settings());
        let mut ready = Vec::new();
        let mut changes = Vec::new();
        for k in (0..300_u64).chain(1000..1200) {
            let reading = ImuReading { device_time: None, ..reading(0, k % 256) };
            let begun = Time::from_seconds(k as f64 * 0.01 + 0.001);
            let told = imu.take(&reading, begun, &ShipUtc::default(), &mut ready);
            changes.extend(told.into_iter().flatten());
        }
        assert_eq!(changes, [ImuChange::Lost(700)]);
        let last = ready.last().unwrap().time.as_seconds();
        assert!((last - 11.991).abs() < 1e-3, "{last}");
    }

    #[test]
    fn a_device_that_starts_again_is_tied_anew() {
        let mut imu = ImuIntake::new(settings());
        fed(&mut imu, 0, 1000, |k| 1_000_000_000 + k * 10_000);
        let (ready, changes) = fed(&mut imu, 1000, 1400, |k| (k - 1000) * 10_000);
        assert!(matches!(changes[..], [ImuChange::ClockStepped(_)]), "{changes:?}");
        assert_eq!(ready.len(), 400);
        assert!(
            (ready[399].time.as_seconds() - 13.991).abs() < 1e-3,
            "{}",
            ready[399].time.as_seconds()
        );
    }

    #[test]
    fn samples_that_wait_when_the_device_starts_again_are_dropped() {
        let mut imu = ImuIntake::new(settings());
        let (ready, _) = fed(&mut imu, 0, 400, |k| if k < 50 { 7_000_000 } else { 0 } + k * 10_000);
        assert_eq!(ready.len(), 350);
        assert!((ready[0].time.as_seconds() - 0.501).abs() < 1e-3);
    }

    #[test]
    fn a_clock_that_leaps_ahead_does_not_put_samples_in_the_future() {
        let mut imu = ImuIntake::new(settings());
        fed(&mut imu, 0, 1000, |k| k * 10_000);
        let (ready, changes) = fed(&mut imu, 1000, 1400, |k| k * 10_000 + 50_000_000);
        assert!(matches!(changes[..], [ImuChange::ClockStepped(_)]), "{changes:?}");
        assert!(ready.iter().all(|sample| sample.time.as_seconds() < 14.0));
    }
}
