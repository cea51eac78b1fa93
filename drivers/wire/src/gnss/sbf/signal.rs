//! Septentrio's numbers of satellites and signals.
//!
//! Tables: mosaic-X5 Reference Guide 4.14.10, 4.1.9 ("Satellite ID and GLONASS frequency number") and 4.1.10 ("Signal type").

use insd_base::satellites::{Constellation, SatelliteId, SignalCode};

use Constellation as C;

/// First and last `SVID`, what is to be taken from it to have RINEX's number, constellation. 62 is a satellite of GLONASS whose slot is not known.
const SATELLITES: [(u8, u8, u8, Constellation); 11] = [
    (1, 37, 0, C::Gps),
    (38, 61, 37, C::Glonass),
    (63, 68, 38, C::Glonass),
    (71, 106, 70, C::Galileo),
    (120, 140, 100, C::Sbas),
    (141, 180, 140, C::BeiDou),
    (181, 190, 180, C::Qzss),
    (191, 197, 190, C::Navic),
    (198, 215, 157, C::Sbas),
    (216, 222, 208, C::Navic),
    (223, 245, 182, C::BeiDou),
];

/// Number of a signal, constellation, RINEX's characters.
const SIGNALS: [(u8, Constellation, &[u8; 2]); 34] = [
    (0, C::Gps, b"1C"),
    (1, C::Gps, b"1W"),
    (2, C::Gps, b"2W"),
    (3, C::Gps, b"2L"),
    (4, C::Gps, b"5Q"),
    (5, C::Gps, b"1L"),
    (6, C::Qzss, b"1C"),
    (7, C::Qzss, b"2L"),
    (8, C::Glonass, b"1C"),
    (9, C::Glonass, b"1P"),
    (10, C::Glonass, b"2P"),
    (11, C::Glonass, b"2C"),
    (12, C::Glonass, b"3Q"),
    (13, C::BeiDou, b"1P"),
    (14, C::BeiDou, b"5P"),
    (15, C::Navic, b"5A"),
    (17, C::Galileo, b"1C"),
    (19, C::Galileo, b"6C"),
    (20, C::Galileo, b"5Q"),
    (21, C::Galileo, b"7Q"),
    (22, C::Galileo, b"8Q"),
    (24, C::Sbas, b"1C"),
    (25, C::Sbas, b"5I"),
    (26, C::Qzss, b"5Q"),
    (27, C::Qzss, b"6L"),
    (28, C::BeiDou, b"2I"),
    (29, C::BeiDou, b"7I"),
    (30, C::BeiDou, b"6I"),
    (32, C::Qzss, b"1L"),
    (33, C::Qzss, b"1Z"),
    (34, C::BeiDou, b"7D"),
    (37, C::Navic, b"1P"),
    (38, C::Qzss, b"1E"),
    (39, C::Qzss, b"5P"),
];

/// The satellite of an `SVID`.
pub(super) fn satellite(id: u8) -> Option<SatelliteId> {
    let own = |(first, last, ..): &&(u8, u8, u8, Constellation)| (*first..=*last).contains(&id);
    let (_, _, offset, constellation) = SATELLITES.iter().find(own)?;
    SatelliteId::new(*constellation, id - offset)
}

/// The signal of a number, if the satellite's constellation has it.
pub(super) fn signal(satellite: SatelliteId, number: u8) -> Option<SignalCode> {
    let own = |(own, constellation, _): &&(u8, Constellation, &[u8; 2])| {
        *own == number && *constellation == satellite.constellation
    };
    let (.., [band, attribute]) = SIGNALS.iter().find(own)?;
    Some(SignalCode::new(band - b'0', *attribute))
}

/// GLONASS: the channel, -7 to 6, of a number that is 8 higher.
pub(super) fn channel(satellite: SatelliteId, raw: u8) -> Option<i8> {
    (satellite.constellation == C::Glonass && (1..=14).contains(&raw)).then(|| raw as i8 - 8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_septentrio_are_named_as_rinex_names_them() {
        let names = [
            (32, "G32"),
            (38, "R01"),
            (61, "R24"),
            (63, "R25"),
            (106, "E36"),
            (136, "S36"),
            (145, "C05"),
            (182, "J02"),
            (198, "S41"),
            (216, "I08"),
            (223, "C41"),
        ];
        for (id, name) in names {
            assert_eq!(satellite(id).unwrap().to_string(), name);
        }
        assert_eq!(satellite(62), None);
        assert_eq!(signal(satellite(145).unwrap(), 28), Some(SignalCode::new(2, b'I')));
        assert_eq!(signal(satellite(145).unwrap(), 0), None);
        assert_eq!(channel(satellite(56).unwrap(), 11), Some(3));
    }
}
