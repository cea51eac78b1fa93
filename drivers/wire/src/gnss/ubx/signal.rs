//! u-blox's numbers of systems, satellites and signals.
//!
//! Tables: u-blox ZED-F9P Interface Description (UBX-18010854), "Satellite numbering" and "Signal identifiers", with those of later receivers of
//! generations 9, 10 and 20.

use insd_base::satellites::{Constellation, SatelliteId, SignalCode};

use Constellation as C;

/// A signal of a satellite in u-blox's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub struct Signal {
    /// `gnssId`: 0 GPS, 1 SBAS, 2 Galileo, 3 `BeiDou`, 5 QZSS, 6 GLONASS, 7 NavIC.
    pub system: u8,
    /// `svId`.
    pub satellite: u8,
    /// `sigId`; zero on receivers older than generation 9.
    pub signal: u8,
    /// `freqId`: GLONASS frequency slot + 7.
    pub slot: u8,
}

/// `gnssId`, least and greatest `svId`, what is to be taken from it to have RINEX's number, constellation.
const SYSTEMS: [(u8, [u8; 2], u8, Constellation); 7] = [
    (0, [1, 32], 0, C::Gps),
    (1, [120, 158], 100, C::Sbas),
    (2, [1, 36], 0, C::Galileo),
    (3, [1, 63], 0, C::BeiDou),
    (5, [1, 10], 0, C::Qzss),
    (6, [1, 32], 0, C::Glonass),
    (7, [1, 14], 0, C::Navic),
];

/// `sigId` of each constellation and the signal in RINEX's characters.
const SIGNALS: [(Constellation, u8, u8, u8); 35] = [
    (C::Gps, 0, 1, b'C'),
    (C::Gps, 3, 2, b'L'),
    (C::Gps, 4, 2, b'S'),
    (C::Gps, 6, 5, b'I'),
    (C::Gps, 7, 5, b'Q'),
    (C::Sbas, 0, 1, b'C'),
    (C::Galileo, 0, 1, b'C'),
    (C::Galileo, 1, 1, b'B'),
    (C::Galileo, 3, 5, b'I'),
    (C::Galileo, 4, 5, b'Q'),
    (C::Galileo, 5, 7, b'I'),
    (C::Galileo, 6, 7, b'Q'),
    (C::Galileo, 8, 6, b'B'),
    (C::Galileo, 9, 6, b'C'),
    (C::Galileo, 10, 6, b'A'),
    (C::BeiDou, 0, 2, b'I'),
    (C::BeiDou, 1, 2, b'I'),
    (C::BeiDou, 2, 7, b'I'),
    (C::BeiDou, 3, 7, b'I'),
    (C::BeiDou, 4, 6, b'I'),
    (C::BeiDou, 10, 6, b'I'),
    (C::BeiDou, 5, 1, b'P'),
    (C::BeiDou, 6, 1, b'D'),
    (C::BeiDou, 7, 5, b'P'),
    (C::BeiDou, 8, 5, b'D'),
    (C::Qzss, 0, 1, b'C'),
    (C::Qzss, 1, 1, b'Z'),
    (C::Qzss, 4, 2, b'S'),
    (C::Qzss, 5, 2, b'L'),
    (C::Qzss, 8, 5, b'I'),
    (C::Qzss, 9, 5, b'Q'),
    (C::Qzss, 12, 1, b'E'),
    (C::Glonass, 0, 1, b'C'),
    (C::Glonass, 2, 2, b'C'),
    (C::Navic, 0, 5, b'A'),
];

impl Signal {
    /// The satellite and the signal; `None` if one of them is not known.
    #[must_use]
    pub fn known(&self) -> Option<(SatelliteId, SignalCode)> {
        let own = |(system, [least, greatest], ..): &&(u8, [u8; 2], u8, Constellation)| {
            *system == self.system && (*least..=*greatest).contains(&self.satellite)
        };
        let (_, _, offset, constellation) = SYSTEMS.iter().find(own)?;
        let satellite = SatelliteId::new(*constellation, self.satellite.checked_sub(*offset)?)?;
        let mut signals = SIGNALS.iter();
        let (_, _, band, attribute) = signals
            .find(|(system, number, ..)| system == constellation && *number == self.signal)?;
        Some((satellite, SignalCode::new(*band, *attribute)))
    }

    /// The numbers of a signal of a satellite, with a channel of GLONASS; `None` of one that u-blox has no number of.
    #[must_use]
    pub fn of(satellite: SatelliteId, signal: SignalCode, channel: Option<i8>) -> Option<Self> {
        let (system, _, offset, _) =
            SYSTEMS.iter().find(|(.., own)| *own == satellite.constellation)?;
        let (_, number, ..) = SIGNALS.iter().find(|(own, _, band, attribute)| {
            (*own, *band, *attribute) == (satellite.constellation, signal.band, signal.attribute)
        })?;
        let slot = channel.and_then(|channel| u8::try_from(i16::from(channel) + 7).ok());
        let own = Signal {
            system: *system,
            satellite: satellite.number.checked_add(*offset)?,
            signal: *number,
            slot: slot.unwrap_or(0),
        };
        (own.known()? == (satellite, signal)).then_some(own)
    }

    /// GLONASS: the frequency channel, -7 to 6.
    #[must_use]
    pub fn channel(&self) -> Option<i8> {
        (self.system == 6 && self.slot <= 13).then(|| self.slot as i8 - 7)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_ublox_are_named_as_rinex_names_them() {
        let named = |system, satellite, signal, slot| {
            let signal = Signal { system, satellite, signal, slot };
            let known = signal.known();
            known.map(|(satellite, code)| format!("{satellite} {code} {:?}", signal.channel()))
        };
        assert_eq!(named(0, 7, 3, 0).as_deref(), Some("G07 2L None"));
        assert_eq!(named(1, 137, 0, 0).as_deref(), Some("S37 1C None"));
        assert_eq!(named(2, 11, 6, 0).as_deref(), Some("E11 7Q None"));
        assert_eq!(named(3, 60, 1, 0).as_deref(), Some("C60 2I None"));
        assert_eq!(named(5, 2, 5, 0).as_deref(), Some("J02 2L None"));
        assert_eq!(named(6, 24, 2, 3).as_deref(), Some("R24 2C Some(-4)"));
        assert_eq!(named(7, 9, 0, 0).as_deref(), Some("I09 5A None"));
    }

    #[test]
    fn a_signal_comes_back_from_its_numbers() {
        for (satellite, signal, channel) in [
            ("G07", b"1C", None),
            ("S37", b"1C", None),
            ("E11", b"5Q", None),
            ("C60", b"6I", None),
            ("R24", b"2C", Some(-4)),
        ] {
            let satellite = satellite.parse().unwrap();
            let code = SignalCode::new(signal[0] - b'0', signal[1]);
            let own = Signal::of(satellite, code, channel).unwrap();
            assert_eq!((own.known(), own.channel()), (Some((satellite, code)), channel));
        }
        assert_eq!(Signal::of("G07".parse().unwrap(), SignalCode::new(2, b'W'), None), None);
    }

    #[test]
    fn a_satellite_or_signal_that_is_not_known_has_no_name() {
        for (system, satellite, signal) in
            [(0, 0, 0), (0, 33, 0), (0, 7, 1), (1, 7, 0), (4, 1, 0), (6, 255, 0), (9, 1, 0)]
        {
            assert_eq!(Signal { system, satellite, signal, slot: 0 }.known(), None);
        }
    }
}
