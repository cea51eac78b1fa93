//! NAV-RELPOSNED: from the antenna of a base to that of the receiver; of a base that moves with the ship, a heading.
//!
//! Layout: u-blox ZED-F9P Interface Description (UBX-18010854), version 1, compared with pyubx2. Version 0 (NEO-M8P) tells neither
//! length nor heading and is not read.

use insd_base::units::{DEG, wrap_two_pi};

use super::field::epoch;
use super::frame::as_message;
use super::pvt::Carrier;
use crate::gnss::GnssPart;
use crate::layout::{Each, bit, bits, layout, le};

/// Class and id.
pub(super) const NAME: (u8, u8) = (0x01, 0x3C);

/// Radians in one step of a heading.
const HEADING: f64 = 1e-5 * DEG;

layout! {
    /// NAV-RELPOSNED of version 1.
    ///
    /// A component is the sum of its centimetres and of its tenths of a millimetre.
    NavRelPosNed, 64 bytes;
    /// `version`.
    0 version: u8 = le();
    /// `refStationId`: number of the base.
    2 station: u16 = le();
    /// `iTOW`: time of the GPS week, whole milliseconds, in ns.
    4 time_of_week: i64 = le::<u32>().nanos(1_000_000);
    /// `relPosN`, `relPosE`, `relPosD`, m; of unit length if `relPosNormalized` is set.
    8 relative: [f64; 3] = Each(le::<i32>().steps(1e-2));
    /// `relPosLength`, m.
    20 length: f64 = le::<i32>().steps(1e-2);
    /// `relPosHeading`: direction from the base to the receiver, rad, as it stands.
    24 heading: f64 = le::<i32>().steps(HEADING);
    /// `relPosHPN`, `relPosHPE`, `relPosHPD`: what is to be added to `relative`, m.
    32 finer: [f64; 3] = Each(le::<i8>().steps(1e-4));
    /// `relPosHPLength`: what is to be added to `length`, m.
    35 finer_length: f64 = le::<i8>().steps(1e-4);
    /// `accN`, `accE`, `accD`: 1-sigma of the components, m.
    36 accuracy: [Option<f64>; 3] = Each(le::<u32>().unless(u32::MAX, 1e-4));
    /// `accLength`, m.
    48 length_accuracy: Option<f64> = le::<u32>().unless(u32::MAX, 1e-4);
    /// `accHeading`, rad.
    52 heading_accuracy: Option<f64> = le::<u32>().unless(u32::MAX, HEADING);
    /// `gnssFixOK`.
    60 fix_ok: bool = bit(0);
    /// `diffSoln`.
    60 differential: bool = bit(1);
    /// `relPosValid`: components and accuracies.
    60 valid: bool = bit(2);
    /// `carrSoln`.
    60 carrier: Carrier = bits(3, 2).codes(Carrier::of_raw, |carrier| carrier.raw());
    /// `isMoving`: the base moves.
    60 moving: bool = bit(5);
    /// `refPosMiss`: the base's position was extrapolated.
    60 position_missing: bool = bit(6);
    /// `refObsMiss`: the base's measurements were extrapolated.
    60 measurements_missing: bool = bit(7);
    /// `relPosHeadingValid`.
    61 heading_valid: bool = bit(0);
    /// `relPosNormalized`: components and length are of unit length.
    61 normalized: bool = bit(1);
}

as_message!(NavRelPosNed, NAME);

impl NavRelPosNed {
    /// The version that is read.
    pub const VERSION: u8 = 1;

    /// From the base to the receiver: north, east, down, m; `None` unless it is valid and told in metres.
    #[must_use]
    pub fn baseline(&self) -> Option<[f64; 3]> {
        let [north, east, down] = self.relative;
        let [finer_north, finer_east, finer_down] = self.finer;
        let told = self.fix_ok && self.valid && !self.normalized;
        told.then_some([north + finer_north, east + finer_east, down + finer_down])
    }

    /// Direction from the base to the receiver, rad, with its 1-sigma, of a base that moves with the ship and of ambiguities that are
    /// fixed. One ashore tells no heading; of float ambiguities it is wrong by more than is claimed.
    #[must_use]
    pub fn compass(&self) -> Option<(f64, Option<f64>)> {
        let told = self.fix_ok && self.valid && self.heading_valid;
        let told = told && self.moving && self.carrier == Carrier::Fixed;
        told.then(|| (wrap_two_pi(self.heading), self.heading_accuracy))
    }

    /// What the message says of its epoch: no place, for it is told from the base.
    #[must_use]
    pub fn part(&self) -> GnssPart {
        let (heading, heading_std) = self.compass().unzip();
        GnssPart {
            kind: "NAV-RELPOSNED",
            epoch: epoch(self.time_of_week),
            heading,
            heading_std: heading_std.flatten(),
            ..GnssPart::default()
        }
    }
}
