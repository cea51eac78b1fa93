//! The trial of a stored heading: it is one of several explanations, and the data weigh them.
//!
//! Beside the even spread of all headings stand three more members of the bank ([`crate::bank`]):
//! - *confirmed*: the ship lies as she lay, to the stored sigma and her yaw on the moorings;
//! - *near*, twice: she has been shifted a little, or has been made fast otherwise.
//!
//! Gyrocompassing and the berth weigh them by the likelihood of every measurement (Alspach and
//! Sorenson 1972, as the bank itself). Until they have, the solution is the mixture and its sigma holds
//! all of them, so that a stored heading is never believed before it is verified, and a turn that takes
//! minutes to be seen in a seaway is covered by the claim meanwhile.
//!
//! The shares are chosen for that, not for how often ships are turned. A mixture of which the share p
//! is wrong by d claims at least d sqrt(p (1 - p)), so that its error is up to sqrt(p / (1 - p))
//! sigmas. With a share of 90 % for the stored heading, a turn of twice the sigma of a cold alignment,
//! which the data do not refute, would be claimed to be none: 7.6 sigmas were seen for 20 deg in sea
//! state 3 with three quarters of the prior at or near the stored heading, below 4 with one half.

use insd_base::units::DEG;
use insd_base::{Message, Received, StoredDoubt, Time};

use crate::stored::StoredState;

/// Which explanation a member of the bank stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Nothing is known of the heading.
    Any,
    /// It is near the stored one.
    Near,
    /// It is the stored one.
    Confirmed,
}

/// What became of a stored state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StoredVerdict {
    /// The sensors have confirmed it.
    Used {
        /// When.
        time: Time,
    },
    /// It plays no part any more.
    Dropped {
        /// When.
        time: Time,
        /// Why.
        reason: StoredDoubt,
    },
}

/// A stored state that is or was put to the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    state: StoredState,
    verdict: Option<StoredVerdict>,
}

/// Shares of the probability; they need not sum to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Of all headings alike.
    pub any: f64,
    /// Of those near the stored one.
    pub near: f64,
    /// Of the stored one.
    pub confirmed: f64,
}

/// Share of all headings alike before any data.
pub const ANY: f64 = 0.5;
/// The other explanations: their share, and how far the ship is turned, 1-sigma, rad.
const STORED: [(Origin, f64, f64); 3] = [
    (Origin::Near, 0.2, 10.0 * DEG),
    (Origin::Near, 0.15, 4.0 * DEG),
    (Origin::Confirmed, 0.15, 0.0),
];
/// Share above which the stored heading counts as confirmed. Data that know the heading less well than
/// its neighbourhood is wide cannot lift it that far.
const CONFIRMED: f64 = 0.65;
/// Share of all headings alike below which they have been refuted, having had the same data.
const REFUTED: f64 = 0.02;
/// Share of two explanations that have come together from which on they stand for the stored heading.
const HEARD: f64 = 0.25;
/// Share below which the stored heading is dropped.
const DROPPED: f64 = 0.01;

/// The explanations beside all headings alike: origin, share before any data and 1-sigma of the
/// heading, rad, where the stored one is known to `std`.
#[must_use]
pub fn explanations(std: f64) -> [(Origin, f64, f64); 3] {
    STORED.map(|(origin, share, turned)| (origin, share, std.hypot(turned)))
}

/// What two explanations with their shares of one stand for when the data no longer tell them apart.
#[must_use]
pub fn joined_origin(first: (Origin, f64), second: (Origin, f64)) -> Origin {
    let (light, heavy) = if first.1 < second.1 { (first, second) } else { (second, first) };
    let is_heard = light.0 == Origin::Confirmed && light.1 > HEARD;
    if is_heard { Origin::Confirmed } else { heavy.0 }
}

impl Trial {
    /// Opens the trial, or closes it at once where something speaks against the state.
    #[must_use]
    pub fn new(state: &StoredState, doubt: Option<StoredDoubt>, time: Time) -> Self {
        let verdict = doubt.map(|reason| StoredVerdict::Dropped { time, reason });
        Trial { state: *state, verdict }
    }

    /// The state on trial.
    #[must_use]
    pub fn state(&self) -> &StoredState {
        &self.state
    }

    /// What became of it; `None` while the trial goes on.
    #[must_use]
    pub fn verdict(&self) -> Option<StoredVerdict> {
        self.verdict
    }

    /// Judges by the shares of the explanations after the data up to `time`. `alone` says that only
    /// one explanation is left.
    pub fn weigh(&mut self, shares: &Shares, alone: bool, time: Time) {
        if self.verdict.is_some() {
            return;
        }
        let total = shares.any + shares.near + shares.confirmed;
        let (any, confirmed) = (shares.any / total, shares.confirmed / total);
        if confirmed < DROPPED {
            self.verdict = Some(StoredVerdict::Dropped { time, reason: StoredDoubt::Turned });
        } else if alone || (confirmed > CONFIRMED && any < REFUTED) {
            self.verdict = Some(StoredVerdict::Used { time });
        }
    }

    /// Whether a measurement says that the ship is at another place than the stored one.
    #[must_use]
    pub fn is_moved_by(&self, received: &Received) -> bool {
        let place = match &received.message {
            Message::Reference(reference) => reference.position,
            Message::Gnss(fix) if fix.quality.is_measured() => fix.position,
            _ => None,
        };
        self.verdict.is_none() && place.is_some_and(|place| self.state.is_elsewhere(&place))
    }

    /// Closes the trial because the ship is at another place.
    pub fn drop_as_moved(&mut self, time: Time) {
        self.verdict = Some(StoredVerdict::Dropped { time, reason: StoredDoubt::Moved });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{Attitude, Geodetic};
    use nalgebra::Vector3;

    fn state() -> StoredState {
        StoredState {
            time: Time::START,
            moored: true,
            imu: 1,
            position: Geodetic::from_degrees(35.0, 139.0, 20.0),
            position_std: 1.0,
            attitude: Attitude::default(),
            attitude_std: Vector3::repeat(0.001),
            gyro_bias: Vector3::zeros(),
            gyro_bias_std: Vector3::repeat(1e-8),
            accel_bias: Vector3::zeros(),
            accel_bias_std: Vector3::repeat(1e-4),
            sway_std: 0.3,
        }
    }

    /// Shares after data that know the heading to `sigma` and find it `away` from the stored one.
    fn after(away: f64, sigma: f64) -> Shares {
        let of = |(_, share, width): (Origin, f64, f64)| {
            let s = width.hypot(sigma);
            share * (-0.5 * (away / s).powi(2)).exp() / s
        };
        let [wide, narrow, confirmed] = explanations(state().heading_std());
        let even = (2.0 * std::f64::consts::PI).sqrt() / std::f64::consts::TAU;
        Shares { any: ANY * even, near: of(wide) + of(narrow), confirmed: of(confirmed) }
    }

    fn judged(away: f64, sigma: f64) -> Option<StoredVerdict> {
        let mut trial = Trial::new(&state(), None, Time::START);
        trial.weigh(&after(away * DEG, sigma * DEG), false, Time::START);
        trial.verdict()
    }

    #[test]
    fn data_that_know_little_neither_confirm_nor_refute() {
        assert!((STORED.iter().map(|(_, share, _)| share).sum::<f64>() + ANY - 1.0).abs() < 1e-12);
        for away in [0.0, 5.0, 20.0] {
            assert_eq!(judged(away, 20.0), None, "{away}");
        }
    }

    #[test]
    fn data_that_agree_and_know_the_heading_as_well_confirm() {
        assert_eq!(judged(0.2, 0.7), Some(StoredVerdict::Used { time: Time::START }));
    }

    #[test]
    fn a_turn_of_four_sigmas_is_dropped_and_a_small_one_is_not_taken_for_confirmed() {
        let dropped = StoredVerdict::Dropped { time: Time::START, reason: StoredDoubt::Turned };
        assert_eq!(judged(35.0, 8.0), Some(dropped));
        assert_eq!(judged(90.0, 22.0), Some(dropped));
        assert_eq!(judged(5.0, 0.7), Some(dropped));
        assert_eq!(judged(5.0, 3.0), None);
    }

    #[test]
    fn headings_that_come_together_stand_for_the_stored_one_if_it_weighs_enough() {
        let (near, confirmed) = (Origin::Near, Origin::Confirmed);
        assert_eq!(joined_origin((near, 0.6), (confirmed, 0.4)), confirmed);
        assert_eq!(joined_origin((confirmed, 0.9), (Origin::Any, 0.1)), confirmed);
        assert_eq!(joined_origin((confirmed, 0.1), (near, 0.9)), near);
    }

    #[test]
    fn a_trial_that_is_closed_stays_closed() {
        let mut trial = Trial::new(&state(), Some(StoredDoubt::OtherImu), Time::START);
        trial.weigh(&Shares { any: 0.0, near: 0.0, confirmed: 1.0 }, true, Time::START);
        let reason = StoredDoubt::OtherImu;
        assert_eq!(trial.verdict(), Some(StoredVerdict::Dropped { time: Time::START, reason }));
    }
}
