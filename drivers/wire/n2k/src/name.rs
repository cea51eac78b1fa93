//! The NAME of a node: 64 bits that no other node in the world has (ISO 11783-5, 4.3; NMEA 2000).

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// A NAME. The lower number wins the contest for an address. Written as 16 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Name(u64);

/// The parts of a NAME, from the lowest bits to the highest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NameParts {
    /// Given by the manufacturer, 21 bits.
    pub unique_number: u32,
    /// Code of the manufacturer, given by NMEA, 11 bits.
    pub manufacturer: u16,
    /// Instance of the device, lower part, 3 bits.
    pub instance_lower: u8,
    /// Instance of the device, upper part, 5 bits.
    pub instance_upper: u8,
    /// What the device does, by its class.
    pub function: u8,
    /// Class of the device, 7 bits.
    pub class: u8,
    /// Which of several networks of the ship, 4 bits.
    pub system_instance: u8,
    /// Industry, 3 bits: 4 is marine.
    pub industry: u8,
    /// Whether the node takes another address when it loses its own.
    pub arbitrary_address: bool,
}

/// First bit and number of bits of the parts.
const UNIQUE: (u32, u32) = (0, 21);
const MANUFACTURER: (u32, u32) = (21, 11);
const LOWER: (u32, u32) = (32, 3);
const UPPER: (u32, u32) = (35, 5);
const FUNCTION: (u32, u32) = (40, 8);
const CLASS: (u32, u32) = (49, 7);
const SYSTEM: (u32, u32) = (56, 4);
const INDUSTRY: (u32, u32) = (60, 3);
const ARBITRARY: (u32, u32) = (63, 1);

impl Name {
    /// The name of this number.
    #[must_use]
    pub const fn new(bits: u64) -> Self {
        Name(bits)
    }

    /// The number.
    #[must_use]
    pub const fn bits(self) -> u64 {
        self.0
    }

    /// As it stands in a claim.
    #[must_use]
    pub const fn bytes(self) -> [u8; 8] {
        self.0.to_le_bytes()
    }

    /// The name that stands in a claim.
    #[must_use]
    pub const fn from_bytes(bytes: [u8; 8]) -> Self {
        Name(u64::from_le_bytes(bytes))
    }

    /// Its parts. The reserved bit is not one of them.
    #[must_use]
    pub const fn parts(self) -> NameParts {
        NameParts {
            unique_number: self.part(UNIQUE) as u32,
            manufacturer: self.part(MANUFACTURER) as u16,
            instance_lower: self.part(LOWER) as u8,
            instance_upper: self.part(UPPER) as u8,
            function: self.part(FUNCTION) as u8,
            class: self.part(CLASS) as u8,
            system_instance: self.part(SYSTEM) as u8,
            industry: self.part(INDUSTRY) as u8,
            arbitrary_address: self.part(ARBITRARY) == 1,
        }
    }

    const fn part(self, (first, bits): (u32, u32)) -> u64 {
        self.0 >> first & ((1 << bits) - 1)
    }
}

impl NameParts {
    /// The name of these parts; `None` if one is too big for its bits.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        let parts = [
            (u64::from(self.unique_number), UNIQUE),
            (u64::from(self.manufacturer), MANUFACTURER),
            (u64::from(self.instance_lower), LOWER),
            (u64::from(self.instance_upper), UPPER),
            (u64::from(self.function), FUNCTION),
            (u64::from(self.class), CLASS),
            (u64::from(self.system_instance), SYSTEM),
            (u64::from(self.industry), INDUSTRY),
            (u64::from(self.arbitrary_address), ARBITRARY),
        ];
        let place = |bits: u64, (value, (first, count)): (u64, (u32, u32))| {
            (value >> count == 0).then_some(bits | value << first)
        };
        parts.into_iter().try_fold(0, place).map(Name)
    }

    /// The instance of the device as one number, 0 to 255.
    #[must_use]
    pub const fn instance(&self) -> u8 {
        self.instance_upper << 3 | self.instance_lower & 7
    }
}

/// Sixteen hexadecimal digits.
impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016X}", self.0)
    }
}

/// What is no NAME.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a NAME has 16 hexadecimal digits")]
pub struct NoName;

/// Reads sixteen hexadecimal digits.
impl FromStr for Name {
    type Err = NoName;
    fn from_str(text: &str) -> Result<Self, NoName> {
        let digits = text.len() == 16 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let bits = digits.then(|| u64::from_str_radix(text, 16).ok()).flatten();
        bits.map(Name).ok_or(NoName)
    }
}

impl Serialize for Name {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From canboat's sample dirona-actisense-serial.raw: a claim of a load controller of Maretron.
    const CLAIM: [u8; 8] = [0x15, 0xF2, 0x39, 0x11, 0x02, 0x8C, 0x3C, 0xC0];

    fn parts() -> NameParts {
        NameParts {
            unique_number: 0x19_F215,
            manufacturer: 137,
            instance_lower: 2,
            instance_upper: 0,
            function: 140,
            class: 30,
            system_instance: 0,
            industry: 4,
            arbitrary_address: true,
        }
    }

    #[test]
    fn a_claim_of_a_real_device_is_taken_apart_and_put_together() {
        let name = Name::from_bytes(CLAIM);
        assert_eq!(name.parts(), parts());
        assert_eq!(parts().name(), Some(name));
        assert_eq!(name.bytes(), CLAIM);
    }

    #[test]
    fn text_is_sixteen_digits_and_nothing_else() {
        let name = Name::from_bytes(CLAIM);
        assert_eq!(name.to_string(), "C03C8C021139F215");
        assert_eq!("c03c8c021139f215".parse(), Ok(name));
        for text in ["", "C03C", "C03C8C021139F21G", "+03C8C021139F215", "0xC03C8C021139F215"] {
            assert_eq!(text.parse::<Name>(), Err(NoName), "{text}");
        }
    }

    #[test]
    fn a_file_holds_the_digits() {
        use serde::de::value::{Error, StrDeserializer};
        let read = |text| Name::deserialize(StrDeserializer::<Error>::new(text));
        assert_eq!(read("C03C8C021139F215"), Ok(Name::from_bytes(CLAIM)));
        assert!(read("12").is_err());
    }

    #[test]
    fn parts_too_big_for_their_bits_make_no_name() {
        assert_eq!(NameParts { manufacturer: 2048, ..parts() }.name(), None);
        assert_eq!(NameParts { class: 128, ..parts() }.name(), None);
        assert_eq!(NameParts { instance_upper: 31, instance_lower: 7, ..parts() }.instance(), 255);
    }
}
