//! Doubts about a stored state.

use serde::{Deserialize, Serialize};

/// Why a state that was stored at the last shutdown is not believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StoredDoubt {
    /// The IMU is not the one that it was stored with, by its error model.
    OtherImu,
    /// The ship did not lie at her berth then, or does not now.
    NotMoored,
    /// The ship is at another place.
    Moved,
    /// Roll and pitch are not what they were by more than the sea can do: the mounting has changed.
    Tilted,
    /// The heading is not what it was: the ship has been turned.
    Turned,
}

impl StoredDoubt {
    /// A short name for tables: `other_imu`, `moved`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            StoredDoubt::OtherImu => "other_imu",
            StoredDoubt::NotMoored => "not_moored",
            StoredDoubt::Moved => "moved",
            StoredDoubt::Tilted => "tilted",
            StoredDoubt::Turned => "turned",
        }
    }
}
