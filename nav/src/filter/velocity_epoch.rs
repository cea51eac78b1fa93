//! How often a receiver tells her velocity, and how well.

use insd_base::Time;

use crate::aids::gnss_velocity::VelocityFix;

/// The last GNSS velocity that was used: what the next ones will be like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VelocityEpoch {
    pub(super) time: Time,
    pub(super) fix: VelocityFix,
    pub(super) spacing: f64,
}

/// Spacing of GNSS velocities before two have been seen, and the bounds of what is believed, s.
const SPACING: f64 = 1.0;
const SPACINGS: (f64, f64) = (0.02, 10.0);
/// Share of a new spacing in the mean.
const SHARE: f64 = 0.2;

impl VelocityEpoch {
    /// The epoch at `time`, with what is known from the one before.
    pub(super) fn after(before: Option<Self>, time: Time, fix: &VelocityFix) -> Self {
        let spacing = before.map_or(SPACING, |before| {
            let seen = (time - before.time).as_seconds().clamp(SPACINGS.0, SPACINGS.1);
            before.spacing + SHARE * (seen - before.spacing)
        });
        VelocityEpoch { time, fix: *fix, spacing }
    }
}
