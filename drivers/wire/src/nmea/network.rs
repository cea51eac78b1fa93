//! Where a sentence goes on a network of IEC 61162-450, and by what name a sender goes.
//!
//! There are 16 groups, each with an address 239.192.0.N and a port 60000 + N. By default the talker
//! of a sentence decides; a port may be set to another group, as receivers differ in what they listen
//! to.
//!
//! The table of talkers is that of a public sender (codekilo nmea0183-iec61121-450-server); the
//! standard was not seen. Talkers that it does not have, those of newer satellite systems among them
//! (GB, GI, GQ), go to MISC here.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::line::Talker;

/// A group of listeners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TransmissionGroup {
    /// 1: all that has no other place.
    Misc,
    /// 2: targets of AIS and radar.
    Tgtd,
    /// 3: heading and rate of turn, which must come fast.
    Satd,
    /// 4: navigation.
    Navd,
    /// 5: for the voyage data recorder.
    Vdrd,
    /// 6: radio.
    Rcom,
    /// 7: time.
    Time,
    /// 8: makers' own sentences.
    Prop,
    /// 9: for the ship's own use, as are those that follow.
    Usr1,
    /// 10.
    Usr2,
    /// 11.
    Usr3,
    /// 12.
    Usr4,
    /// 13.
    Usr5,
    /// 14.
    Usr6,
    /// 15.
    Usr7,
    /// 16.
    Usr8,
}

use TransmissionGroup::{
    Misc, Navd, Prop, Rcom, Satd, Tgtd, Time, Usr1, Usr2, Usr3, Usr4, Usr5, Usr6, Usr7, Usr8, Vdrd,
};

impl TransmissionGroup {
    /// All groups, in the order of their numbers.
    pub const ALL: [TransmissionGroup; 16] = [
        Misc, Tgtd, Satd, Navd, Vdrd, Rcom, Time, Prop, Usr1, Usr2, Usr3, Usr4, Usr5, Usr6, Usr7,
        Usr8,
    ];

    /// Its number, 1 to 16.
    #[must_use]
    pub fn number(self) -> u8 {
        self as u8 + 1
    }

    /// Its multicast address (IPv4).
    #[must_use]
    pub fn address(self) -> [u8; 4] {
        [239, 192, 0, self.number()]
    }

    /// Its UDP port.
    #[must_use]
    pub fn port(self) -> u16 {
        60_000 + u16::from(self.number())
    }

    /// Its name: `SATD`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Misc => "MISC",
            Tgtd => "TGTD",
            Satd => "SATD",
            Navd => "NAVD",
            Vdrd => "VDRD",
            Rcom => "RCOM",
            Time => "TIME",
            Prop => "PROP",
            Usr1 => "USR1",
            Usr2 => "USR2",
            Usr3 => "USR3",
            Usr4 => "USR4",
            Usr5 => "USR5",
            Usr6 => "USR6",
            Usr7 => "USR7",
            Usr8 => "USR8",
        }
    }

    /// The group of a name, in letters of either case.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|group| group.name().eq_ignore_ascii_case(name))
    }

    /// The group of a talker.
    #[must_use]
    pub fn of_talker(talker: Talker) -> Self {
        match talker.as_str() {
            "AI" | "RA" => Tgtd,
            "HE" | "HN" | "TI" => Satd,
            "AG" | "AP" | "DF" | "EC" | "EI" | "GA" | "GL" | "GN" | "GP" | "HC" | "HF" | "IN"
            | "LC" | "SD" | "SN" | "VD" | "VM" | "VW" | "WI" => Navd,
            "BN" | "FD" | "FE" | "FR" | "FS" | "HD" | "HS" | "WD" | "WL" => Vdrd,
            "CD" | "CR" | "CS" | "CT" | "CV" | "CX" | "EP" => Rcom,
            "ZA" | "ZC" | "ZQ" | "ZV" => Time,
            _ => Misc,
        }
    }

    /// The group of a sentence's address: `HETHS`, `PSXN`.
    #[must_use]
    pub fn of_address(address: &str) -> Self {
        match address.get(..2).and_then(Talker::new) {
            Some(talker) => Self::of_talker(talker),
            None if address.starts_with('P') => Prop,
            None => Misc,
        }
    }
}

/// Name of a sender on the network, its system function identifier: the letters of its talker and a
/// number of four digits from 0001, as `IN0001`. No two of a ship may be the same.
///
/// That 0000 is no number is from general knowledge.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Sfi([u8; 6]);

impl Sfi {
    /// An identifier of two upper-case letters and four digits.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        let bytes = <[u8; 6]>::try_from(text.as_bytes()).ok()?;
        let (letters, digits) = bytes.split_at(2);
        let good = letters.iter().all(u8::is_ascii_uppercase)
            && digits.iter().all(u8::is_ascii_digit)
            && digits != b"0000";
        good.then_some(Sfi(bytes))
    }

    /// The identifier, for the source or destination of a [`super::TagBlock`].
    #[must_use]
    pub fn as_str(&self) -> &str {
        std::str::from_utf8(&self.0).unwrap_or_default()
    }
}

impl fmt::Display for Sfi {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl fmt::Debug for Sfi {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Sfi({self})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_goes_to_the_group_of_its_talker() {
        for (address, group) in [
            ("HETHS", Satd),
            ("HEHDT", Satd),
            ("TIROT", Satd),
            ("INGGA", Navd),
            ("VDVBW", Navd),
            ("AIVDM", Tgtd),
            ("ZAZDA", Time),
            ("IIXDR", Misc),
            ("QQXXX", Misc),
            ("", Misc),
            ("PSXN", Prop),
            ("P", Prop),
        ] {
            assert_eq!(TransmissionGroup::of_address(address), group, "{address}");
        }
    }

    #[test]
    fn each_group_has_its_address_and_its_port() {
        assert_eq!((Satd.address(), Satd.port()), ([239, 192, 0, 3], 60_003));
        assert_eq!((Usr8.address(), Usr8.port()), ([239, 192, 0, 16], 60_016));
        for (number, group) in (1..).zip(TransmissionGroup::ALL) {
            assert_eq!((group.number(), group.port()), (number, 60_000 + u16::from(number)));
            assert_eq!(TransmissionGroup::from_name(group.name()), Some(group));
            let lower = group.name().to_lowercase();
            assert_eq!(TransmissionGroup::from_name(&lower), Some(group));
            assert_eq!(serde_json::to_string(&group).unwrap(), format!("\"{lower}\""));
        }
        assert_eq!(TransmissionGroup::from_name("USR9"), None);
    }

    #[test]
    fn a_sender_is_two_letters_and_a_number_above_zero() {
        assert_eq!(Sfi::new("IN0001").map(|sfi| sfi.to_string()), Some("IN0001".to_owned()));
        for text in ["", "IN", "IN0000", "IN001", "IN00001", "in0001", "I10001", "IN00é"] {
            assert_eq!(Sfi::new(text), None, "{text}");
        }
    }
}
