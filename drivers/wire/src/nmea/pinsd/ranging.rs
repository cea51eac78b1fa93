//! RNG: a distance of a docking aid.

use crate::nmea::kinds::{Decimal, STATUS, Whole};
use crate::nmea::table::sentence;

sentence! {
    /// How far a point of the ship is from a line or a point ashore.
    part PinsdRange "PINSD" "RNG", longest 46;
    /// Which head or anchor, by its number in the configuration.
    1 head: Option<u32> = Whole::of(1, 999);
    /// Distance, m.
    2 distance: Option<f64> = Decimal::signed(3, 99_999.999);
    /// Whether there is one.
    3 valid: bool = STATUS;
    /// Its 1-sigma, m, if the device knows it.
    4 std: Option<f64> = Decimal::magnitude(3, 999.999);
    /// How old it was when the sentence was sent, s.
    5 age: Option<f64> = Decimal::magnitude(2, 99.99);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nmea::Pinsd;

    #[test]
    fn the_longest_is_as_long_as_is_stated() {
        let longest = PinsdRange {
            head: Some(999),
            distance: Some(-99_999.999),
            valid: true,
            std: Some(999.999),
            age: Some(99.99),
        };
        assert_eq!(Pinsd::Range(longest).write().as_bytes().len(), PinsdRange::LONGEST);
    }
}
