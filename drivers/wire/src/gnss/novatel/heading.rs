//! HEADING2 and DUALANTENNAHEADING: from one antenna of the ship to another.

use insd_base::FixQuality;
use insd_base::units::{DEG, wrap_two_pi};

use super::as_body;
use super::solution::quality;
use crate::gnss::GnssPart;
use crate::layout::{Each, layout, le};

layout! {
    /// What HEADING2 (48 bytes) and DUALANTENNAHEADING (44 bytes) begin with.
    AntennaHeading, 36 bytes;
    /// Solution status: 0 computed, else why not.
    0 status: u32 = le();
    /// Position type of the line between the antennas: 50 fixed narrow lanes.
    4 kind: u32 = le();
    /// Its length, m; -1 where there is none.
    8 length: Option<f64> = le::<f32>().unless(f32::NAN, 1.0);
    /// Its direction, rad from true north, as it stands.
    12 heading: Option<f64> = le::<f32>().unless(f32::NAN, DEG);
    /// By how much it rises, rad.
    16 pitch: Option<f64> = le::<f32>().unless(f32::NAN, DEG);
    /// 1-sigma of the direction, rad.
    24 heading_std: Option<f64> = le::<f32>().unless(f32::NAN, DEG);
    /// 1-sigma of the rise, rad.
    28 pitch_std: Option<f64> = le::<f32>().unless(f32::NAN, DEG);
    /// Characters of the receiver's number, in DUALANTENNAHEADING the base's.
    32 rover: [u8; 4] = Each(le());
}
as_body!(AntennaHeading);

impl AntennaHeading {
    /// What it says of its epoch: a heading where the integers of the line are fixed. Of float ambiguities it is wrong by more than is
    /// claimed. No place, and nothing of the quality of one.
    pub(super) fn part(&self) -> GnssPart {
        let fixed = quality(self.status, self.kind) == FixQuality::RtkFixed;
        let heading = self.heading.filter(|_| fixed).map(wrap_two_pi);
        let heading_std = self.heading_std.filter(|std| *std > 0.0 && heading.is_some());
        GnssPart { heading, heading_std, ..GnssPart::default() }
    }
}
