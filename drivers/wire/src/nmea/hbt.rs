//! HBT: a device lives.

use super::kinds::{Decimal, STATUS, Whole};
use super::table::sentence;

sentence! {
    /// A sign of life. From manuals (Furuno BR-500, JRC JFE-680); not verified against a device.
    approved Hbt "HBT", longest 21;
    /// How often the sentence is sent, s, 1 to 999.
    1 interval: Option<f64> = Decimal::magnitude(1, 999.0).short();
    /// Whether the device works.
    2 normal: bool = STATUS;
    /// Number of this sentence, 0 to 9 and again.
    3 sequence: Option<u8> = Whole::of(1, 9);
}
