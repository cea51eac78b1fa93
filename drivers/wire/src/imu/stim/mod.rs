//! Sensonor STIM300 and STIM318: normal datagrams and the configuration datagram.
//!
//! ```text
//! id u8
//! rate x, y, z 3 x i24   status u8
//! [acceleration x, y, z 3 x i24   status u8]
//! [inclination x, y, z 3 x i24   status u8]
//! [temperatures x, y, z 3 x i16   status u8] for each of the groups above
//! [AUX or PPS i24   status u8]
//! counter u8   latency u16, us   CRC u32
//! ```
//!
//! Numbers are big endian. The id says which groups there are: 90 rate; +1 acceleration, +2
//! inclination, +4 temperatures, +8 AUX; ids with temperatures of more than the gyroscopes are A5 to
//! A7 and AD to AF; F0 to F7 have PPS in place of AUX. The CRC-32 (poly 04C11DB7, init FFFFFFFF, not
//! reflected) is taken over the bytes before it, filled up with zeros to a multiple of four. CR LF may
//! follow; it is filler.
//!
//! Units: rate 2^-14 deg/s, angle 2^-21 deg; acceleration by the accelerometers' range 2^-21 g (2 g) to
//! 2^-16 g (80 g), velocity an eighth of that number in m/s; inclination 2^-22 g; temperature 2^-8
//! deg C; AUX 5 V / 2^24. Which of them the device sends is set in it: a [`StimFormat`] says so, and
//! the configuration datagram gives one.
//!
//! Status bits: 7 system integrity error, 6 start-up, 5 outside operating conditions, 4 overload, 3
//! error in a measurement channel, 2 to 0 in the channel z, y, x. A sample is valid if gyroscopes and
//! accelerometers have none.
//!
//! Sources: data sheet TS1524 rev. 31 as `pystim300` follows it (tables 5-16, 5-20 to 5-23, section
//! 7.5.2.2); vortexntnu `stim300-driver` (MIT) for AUX and for 2 g, which older revisions have. Not
//! verified against a device. The part number, serial number, bias and error datagrams are not read.

mod configuration;
mod datagram;

pub use configuration::{StimConfiguration, StimFormat, StimKind, StimRange};
pub use datagram::{StimDatagram, StimGroup, StimInput};

use crc::{CRC_32_MPEG_2, Crc};

use crate::stream::Look;

const CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_MPEG_2);

/// Ids of the configuration datagram without and with CR LF.
const CONFIGURATION: [u8; 2] = [0xBC, 0xBD];
/// Bytes of the configuration datagram.
const CONFIGURATION_LENGTH: usize = 26;

/// What stands at the start of some bytes: a datagram with its CRC verified, or a line end.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    let Some(id) = bytes.first() else { return Look::More(1) };
    if matches!(id, b'\r' | b'\n') {
        return Look::Filler(1);
    }
    let Some(length) = length_of(*id) else { return Look::Nothing };
    match bytes.get(..length) {
        None => Look::More(length),
        Some(frame) if is_sound(frame) => Look::Frame(length),
        Some(_) => Look::Damaged,
    }
}

/// Which groups a datagram has: acceleration, inclination, temperatures, AUX, PPS.
type Groups = [bool; 5];

fn groups_of(id: u8) -> Option<Groups> {
    let bit = |bit: u8| id & bit != 0;
    let pps = id >= 0xF0;
    let groups = [bit(1), bit(2), bit(4), bit(8) && !pps, pps];
    (id_of(groups) == id).then_some(groups)
}

/// The id of some groups; PPS goes before AUX, as there is no datagram with both.
fn id_of([acceleration, inclination, temperatures, aux, pps]: Groups) -> u8 {
    let bits = [acceleration, inclination, temperatures, aux && !pps];
    let low = bits.iter().rev().fold(0, |low, bit| low << 1 | u8::from(*bit));
    let long = temperatures && (acceleration || inclination);
    low | match (pps, long) {
        (true, _) => 0xF0,
        (false, true) => 0xA0,
        (false, false) => 0x90,
    }
}

fn length_of(id: u8) -> Option<usize> {
    if CONFIGURATION.contains(&id) {
        return Some(CONFIGURATION_LENGTH);
    }
    let [acceleration, inclination, temperatures, aux, pps] = groups_of(id)?;
    let sensors = 1 + usize::from(acceleration) + usize::from(inclination);
    let sensor = 10 + if temperatures { 7 } else { 0 };
    Some(1 + sensors * sensor + if aux || pps { 4 } else { 0 } + 3 + 4)
}

fn crc(body: &[u8]) -> u32 {
    let padding = body.len().next_multiple_of(4) - body.len();
    let mut digest = CRC.digest();
    digest.update(body);
    digest.update([0; 3].get(..padding).unwrap_or_default());
    digest.finalize()
}

fn is_sound(frame: &[u8]) -> bool {
    frame.split_last_chunk::<4>().is_some_and(|(body, sum)| crc(body) == u32::from_be_bytes(*sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_lengths_and_padding_are_those_of_the_table() {
        let table = [
            (0x90, 18, 2),
            (0x91, 28, 0),
            (0x92, 28, 0),
            (0x93, 38, 2),
            (0x94, 25, 3),
            (0xA5, 42, 2),
            (0xA6, 42, 2),
            (0xA7, 59, 1),
            (0x98, 22, 2),
            (0x99, 32, 0),
            (0x9A, 32, 0),
            (0x9B, 42, 2),
            (0x9C, 29, 3),
            (0xAD, 46, 2),
            (0xAE, 46, 2),
            (0xAF, 63, 1),
            (0xF0, 22, 2),
            (0xF1, 32, 0),
            (0xF2, 32, 0),
            (0xF3, 42, 2),
            (0xF4, 29, 3),
            (0xF5, 46, 2),
            (0xF6, 46, 2),
            (0xF7, 63, 1),
            (0xBC, 26, 2),
            (0xBD, 26, 2),
        ];
        for (id, length, padding) in table {
            assert_eq!(length_of(id), Some(length), "{id:X}");
            assert_eq!((length + padding) % 4, 0, "{id:X}");
        }
        let known = (0..=u8::MAX).filter(|id| length_of(*id).is_some()).count();
        assert_eq!(known, table.len());
    }
}
