//! ROT: rate of turn.

use insd_base::units::DEG;

use super::kinds::{Decimal, STATUS};
use super::table::sentence;

/// Radians per second in one degree per minute.
const DEG_PER_MINUTE: f64 = DEG / 60.0;

/// Greatest rate, degrees per minute.
const MOST: f64 = 99_999.9;

sentence! {
    /// Rate of turn with its status.
    ///
    /// AIS transponders take the value from talker TI only; from others they take the side alone (Saab R4
    /// manual).
    approved Rot "ROT", longest 21, written as honest;
    /// Rate of turn, rad/s, positive when the bow turns to starboard.
    1 rate: Option<f64> = Decimal::signed(1, MOST).of(DEG_PER_MINUTE);
    /// Whether the rate may be used. A sentence without a rate is written as not valid.
    2 valid: bool = STATUS;
}

impl Rot {
    fn honest(&self) -> Self {
        let known = self.rate.is_some_and(|rate| (rate / DEG_PER_MINUTE).abs() <= MOST);
        Rot { valid: self.valid && known, ..*self }
    }
}
