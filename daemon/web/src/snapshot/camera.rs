//! A camera, and what the navigator makes of it.

use serde::{Deserialize, Serialize};

use super::ShownEstimate;

/// What becomes of what a camera sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CameraState {
    /// It is used.
    Used,
    /// It sees too little, or contradicts the ship: it is looked at, and not used.
    Doubtful,
    /// It is heard, and the navigator uses no camera now: at the berth, or before it navigates.
    Waiting,
    /// It is not heard.
    Silent,
    /// Nothing is known, or a word that this version does not know.
    #[default]
    #[serde(other)]
    Unknown,
}

/// A camera as the navigator has it.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownCamera {
    /// Name of the sensor.
    pub sensor: String,
    /// What becomes of what it sees.
    pub state: CameraState,
    /// When its last image was taken that was looked at, on the ship's time line, s.
    pub valid_at_s: Option<f64>,
    /// Points in that image; `None` where steps of another's visual odometry are used.
    pub points: Option<u32>,
    /// Poses of the ship that are held, from which points were seen.
    pub poses: Option<u32>,
    /// Points of the quay that are held as places.
    pub landmarks: Option<u32>,
    /// How it is found to sit otherwise than configured: a small turn about the ship's forward, starboard and down axes, deg.
    pub turned: Vec<ShownEstimate>,
    /// By how much its images are taken later than they are stamped, s.
    pub delay: Option<ShownEstimate>,
    /// Whether a picture of what it sees is to be had at `/api/v1/camera`.
    pub has_picture: bool,
}

impl ShownCamera {
    /// Whether the navigator looks at it.
    #[must_use]
    pub fn is_looked_at(&self) -> bool {
        matches!(self.state, CameraState::Used | CameraState::Doubtful)
    }
}
