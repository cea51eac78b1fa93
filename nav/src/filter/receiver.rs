//! The receiver in use, as the filter has come to know it: how far its word agrees, how late it comes, where its antenna is
//! and how that moves.

use insd_base::Time;
use nalgebra::Vector2;

use super::found_lever::FoundLever;
use super::velocity_epoch::VelocityEpoch;
use crate::antenna::AntennaMotion;
use crate::echo::Echo;
use crate::own_word::OwnWord;
use crate::trust::Trust;

/// What is known of one receiver beside the states of its errors.
#[derive(Clone, Debug)]
pub(super) struct Receiver {
    pub(super) trust: Trust,
    /// Whether its positions come from fixed carrier ambiguities; `None` before the first.
    pub(super) rtk: Option<bool>,
    /// By how much the sigmas that slow errors of its position and velocity are told in are larger than stated, as variances.
    pub(super) slow_noise: [f64; 2],
    pub(super) antenna: AntennaMotion,
    /// By how much its fixes are set back, s; `None` before the first.
    pub(super) redated: Option<f64>,
    pub(super) velocity_epoch: Option<VelocityEpoch>,
    /// What its epochs are suspected of being late by, 1-sigma, s.
    pub(super) lateness: f64,
    pub(super) found_lever: FoundLever,
    pub(super) own_word: OwnWord,
    pub(super) echo: Echo,
    /// How far it has her from where the filter does that refuses it and may be wrong, north and east, m.
    pub(super) disputed: Vector2<f64>,
}

impl Receiver {
    /// One of which nothing is known but when it was last used, if it was.
    pub(super) fn new(used: Option<Time>) -> Self {
        let mut trust = Trust::default();
        used.iter().for_each(|time| trust.used(*time));
        Receiver {
            trust,
            rtk: None,
            slow_noise: [1.0; 2],
            antenna: AntennaMotion::default(),
            redated: None,
            velocity_epoch: None,
            lateness: 0.0,
            found_lever: FoundLever::default(),
            own_word: OwnWord::default(),
            echo: Echo::default(),
            disputed: Vector2::zeros(),
        }
    }

    /// Whether its positions come from fixed carrier ambiguities.
    pub(super) fn is_rtk(&self) -> bool {
        self.rtk == Some(true)
    }
}
