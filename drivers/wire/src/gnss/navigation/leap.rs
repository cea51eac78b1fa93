//! GPS - UTC out of the UTC parameters of GPS and Galileo.

use insd_base::GpsTime;

use super::super::bits::{Bits, Field};
use super::super::kepler::SECOND;

/// Weeks that eight bits count.
const CYCLE: i64 = 256;

/// Where the parameters stand.
pub(super) struct LeapLayout {
    /// Leap seconds before the change, s.
    pub(super) before: Field,
    /// Week of the change, eight bits.
    pub(super) week: Field,
    /// At the end of which day of that week it is, from 1.
    pub(super) day: Field,
    /// Leap seconds after it, s.
    pub(super) after: Field,
}

impl LeapLayout {
    /// Those that hold at an instant (IS-GPS-200N, 20.3.3.5.2.4). A change long ago may seem to be ahead by the eight bits of its week;
    /// by then both numbers are the same.
    pub(super) fn leap_seconds(&self, bits: &Bits, now: GpsTime) -> Option<i8> {
        let (week, _) = now.to_week();
        let ahead = (self.week.whole(bits) - week).rem_euclid(CYCLE);
        let ahead = if ahead >= CYCLE / 2 { ahead - CYCLE } else { ahead };
        let change = (week + ahead) * 604_800 + self.day.whole(bits) * 86_400;
        let before = self.before.whole(bits);
        let passed = now.as_nanos() / SECOND >= change + before;
        i8::try_from(if passed { self.after.whole(bits) } else { before }).ok()
    }
}
