//! Samples of the IMU in the axes of robots: forward, left, up (REP 103 of ROS), not corrected, as `/imu/data_raw` of REP 145.

use std::iter::Peekable;

use insd_base::{ImuSample, Time};
use nalgebra::Vector3;

use super::pose::FRD_FLU;

/// Where samples are told, and the frame in which they are.
pub(super) const TOPIC: &str = "/imu/data_raw";
pub(super) const FRAME: &str = "base_link";

/// Two samples that lie between these shares of their usual distance apart followed each other.
const FOLLOWED: std::ops::Range<f64> = 0.5..1.5;

/// The samples of an IMU, in order of time.
#[derive(Clone, Debug)]
pub struct ImuTrack {
    samples: Vec<ImuSample>,
    /// Usual distance of samples, s.
    interval: f64,
}

impl ImuTrack {
    /// Those of an IMU that is said to give so many each second, in any order.
    #[must_use]
    pub fn new(mut samples: Vec<ImuSample>, rate: f64) -> Self {
        samples.sort_by_key(|sample| sample.time);
        ImuTrack { samples, interval: 1.0 / rate }
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty()
    }

    fn reading(&self, index: usize) -> Option<Reading> {
        let sample = self.samples.get(index)?;
        let before = index.checked_sub(1).and_then(|before| self.samples.get(before));
        let apart = before.map(|before| (sample.time - before.time).as_seconds());
        let followed = |apart: &f64| FOLLOWED.contains(&(apart / self.interval));
        let interval = apart.filter(followed).unwrap_or(self.interval);
        Some(Reading {
            time: Time::from_seconds(sample.time.as_seconds() - 0.5 * interval),
            rate: FRD_FLU * sample.delta_theta.0 / interval,
            force: FRD_FLU * sample.delta_velocity.0 / interval,
        })
    }
}

/// What the IMU measured: means over the interval of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reading {
    /// The middle of the interval.
    pub(super) time: Time,
    /// Angular rate with respect to inertial space about forward, left, up, rad/s.
    pub(super) rate: Vector3<f64>,
    /// Specific force along forward, left, up, m/s^2: about +9.8 upwards for a ship at rest.
    pub(super) force: Vector3<f64>,
}

/// The readings that are due before something else is told.
pub(super) struct Readings<'a>(Peekable<Box<dyn Iterator<Item = Reading> + 'a>>);

impl<'a> Readings<'a> {
    /// All of a track; none without one.
    pub(super) fn of(track: Option<&'a ImuTrack>) -> Self {
        let all = track
            .into_iter()
            .flat_map(|track| (0..track.len()).filter_map(|index| track.reading(index)));
        let all: Box<dyn Iterator<Item = Reading> + 'a> = Box::new(all);
        Readings(all.peekable())
    }

    /// The next one up to a time, or of all that are left.
    pub(super) fn next_until(&mut self, time: Option<Time>) -> Option<Reading> {
        self.0.next_if(|own| time.is_none_or(|time| own.time <= time))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use insd_base::Body;

    fn sample(seconds: f64) -> ImuSample {
        ImuSample {
            time: Time::from_seconds(seconds),
            delta_theta: Body::new(0.001, 0.002, 0.003),
            delta_velocity: Body::new(0.01, 0.02, -0.098),
        }
    }

    #[test]
    fn readings_are_means_about_forward_left_and_up_in_the_middle_of_their_interval() {
        let track = ImuTrack::new(vec![sample(0.02), sample(0.01)], 100.0);
        let mut readings = Readings::of(Some(&track));
        let first = readings.next_until(Some(Time::from_seconds(0.01))).unwrap();
        assert_relative_eq!(first.time.as_seconds(), 0.005, epsilon = 1e-9);
        assert_relative_eq!(first.rate, Vector3::new(0.1, -0.2, -0.3), epsilon = 1e-12);
        assert_relative_eq!(first.force, Vector3::new(1.0, -2.0, 9.8), epsilon = 1e-12);
        assert_eq!(readings.next_until(Some(Time::from_seconds(0.01))), None);
        assert!(readings.next_until(None).is_some() && readings.next_until(None).is_none());
    }

    #[test]
    fn the_sample_behind_a_gap_is_one_of_the_usual_length() {
        let track = ImuTrack::new(vec![sample(0.01), sample(1.0)], 100.0);
        assert_relative_eq!(track.reading(1).unwrap().rate.x, 0.1, epsilon = 1e-12);
    }
}
