//! From a telegram to what all IMUs and logs have in common.

use insd_base::{LogReference, Span, UtcTime};

use super::external::{EmLog, LogSpeed};
use super::telegram::{Navigation, StdBinAttitude, Telegram};
use crate::imu::{DeviceTime, ImuMotion, ImuReading, Wrapping};
use crate::log::{LogFrame, LogReading};

/// Seconds of a tick of the validity time.
const TICK: f64 = 1e-4;
/// Ticks of a day.
const DAY: u32 = 864_000_000;

/// Bits of the user status: time received; then gyroscope or accelerometer anomaly, temperature error,
/// dynamics exceeded, failure mode.
const TIME_RECEIVED: u32 = 1 << 8;
const UNUSABLE: u32 = 1 << 9 | 1 << 10 | 1 << 11 | 1 << 13 | 1 << 31;
/// Bit of the first word of the algorithm status: first alignment, as in PIXSE,ALGSTS.
const ALIGNMENT: u32 = 1 << 1;
/// Bit of the second word of the system status: UTC detected.
const UTC_DETECTED: u32 = 1 << 9;

/// How far the raw specific force may be from what the other blocks say it is, m/s^2: filters and times
/// of validity of the two differ while the ship is shaken.
const APART: f64 = 1.0;
/// Standard gravity, m/s^2.
const GRAVITY: f64 = 9.806_65;

impl Navigation {
    /// Whether a raw pair may be what gyroscopes and accelerometers sense. It is not
    ///
    /// - if all of a block is exactly zero: the Earth turns and pulls, so that nobody has filled it;
    /// - if the same telegram tells the acceleration without gravity, and this with the gravity of the
    ///   attitude is another specific force, by more than 1 m/s^2 in length.
    fn bears_raw(&self, gyro: [f64; 3], accel: [f64; 3]) -> bool {
        let filled = [gyro, accel].iter().all(|block| block.iter().any(|own| *own != 0.0));
        let expected = self.acceleration.zip(self.attitude).map(|(free, attitude)| {
            let up = up(&attitude);
            length([0, 1, 2].map(|axis| free[axis] + GRAVITY * up[axis]))
        });
        filled && expected.is_none_or(|expected| (length(accel) - expected).abs() < APART)
    }
}

/// The direction that is up, along XV1 forward, XV2 to port, XV3 up.
fn up(attitude: &StdBinAttitude) -> [f64; 3] {
    let (sin_roll, cos_roll) = attitude.roll.sin_cos();
    let (sin_pitch, cos_pitch) = attitude.pitch.sin_cos();
    [sin_pitch, cos_pitch * sin_roll, cos_pitch * cos_roll]
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|own| own * own).sum::<f64>().sqrt()
}

impl Telegram {
    /// Whether the system stands behind heading, roll and pitch: it is not in its first alignment, and its user status tells of no
    /// anomaly. What it does not send speaks not against it.
    #[must_use]
    pub fn is_aligned(&self) -> bool {
        let aligning =
            self.navigation.algorithm_status.is_some_and(|[own, ..]| own & ALIGNMENT != 0);
        let unusable = self.navigation.user_status.is_some_and(|[user]| user & UNUSABLE != 0);
        !aligning && !unusable
    }

    /// Angular rate and specific force about and along XV1 forward, XV2 to port, XV3 up; `None` unless
    /// both raw blocks are there. Valid if the user status tells of no anomaly, or is not there, and
    /// nothing in the telegram speaks against the raw blocks (`Navigation::bears_raw`).
    #[must_use]
    pub fn reading(&self) -> Option<ImuReading> {
        let navigation = &self.navigation;
        let (gyro, accel) = (navigation.raw_rotation?, navigation.raw_acceleration?);
        let [status] = navigation.user_status.unwrap_or_default();
        let modulus = if self.is_synchronised() { DAY.into() } else { 1 << 32 };
        let ticks = Wrapping { value: self.validity.into(), modulus };
        Some(ImuReading {
            device_time: Some(DeviceTime { ticks, tick: TICK }),
            counter: Some(Wrapping { value: self.counter.into(), modulus: 1 << 32 }),
            utc: self.utc_of(self.validity),
            temperature: navigation.temperatures.map(|[gyro, ..]| gyro),
            valid: status & UNUSABLE == 0 && navigation.bears_raw(gyro, accel),
            status,
            ..ImuReading::bare(ImuMotion::Rates { gyro, accel })
        })
    }

    /// What the system's logs told it.
    #[must_use]
    pub fn log_readings(&self) -> Vec<LogReading> {
        let external = &self.external;
        let ground = external.ground.iter().flatten();
        let water = external.water.iter().flatten();
        let em_logs = external.em_logs.iter().flatten();
        ground
            .map(|dvl| self.doppler(dvl, LogReference::Bottom))
            .chain(water.map(|dvl| self.doppler(dvl, LogReference::Water)))
            .chain(em_logs.map(|log| self.electromagnetic(log)))
            .collect()
    }

    /// Whether the system's clock keeps UTC: by the user status, or, without it, the system status.
    #[must_use]
    pub fn is_synchronised(&self) -> bool {
        match (self.navigation.user_status, self.navigation.system_status) {
            (Some([user]), _) => user & TIME_RECEIVED != 0,
            (None, Some([_, second, _])) => second & UTC_DETECTED != 0,
            (None, None) => false,
        }
    }

    fn doppler(&self, dvl: &LogSpeed, reference: LogReference) -> LogReading {
        let [forward, port, up] = dvl.velocity;
        let velocity = [Some(forward), Some(-port), Some(-up), None];
        let std = dvl.std.into_iter().fold(0.0, f64::max);
        self.log(velocity, reference, std, dvl.validity)
    }

    fn electromagnetic(&self, log: &EmLog) -> LogReading {
        let velocity = [Some(log.forward), None, None, None];
        self.log(velocity, LogReference::Water, log.std, log.validity)
    }

    fn log(
        &self,
        velocity: [Option<f64>; 4],
        reference: LogReference,
        std: f64,
        validity: u32,
    ) -> LogReading {
        let age = self.validity.checked_sub(validity).map(|ticks| f64::from(ticks) * TICK);
        LogReading {
            velocity,
            frame: LogFrame::Ship,
            reference,
            std: (std > 0.0).then_some(std),
            utc: self.utc_of(validity),
            age,
        }
    }

    /// UTC of a validity time. One that is later than the telegram's by more than half a day is of the
    /// day before.
    fn utc_of(&self, validity: u32) -> Option<UtcTime> {
        let midnight = self.navigation.midnight().filter(|_| self.is_synchronised())?;
        let in_day = validity < DAY && self.validity < DAY;
        let day_before = validity.checked_sub(self.validity).is_some_and(|late| late > DAY / 2);
        let ticks = i64::from(validity) - if day_before { i64::from(DAY) } else { 0 };
        in_day.then(|| midnight.plus(Span::from_nanos(ticks * 100_000)))
    }
}
