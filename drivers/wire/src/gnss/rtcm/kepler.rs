//! Records with Keplerian elements: 1019 (GPS), 1042 (BeiDou), 1044 (QZSS), 1045 and 1046 (Galileo F/NAV and I/NAV).
//!
//! Layouts: RTCM 10403.3, the contents of each message (fields DF009 and DF071 to DF103, DF252 and DF289 to DF317,
//! DF429 to DF457, DF488 to DF515). The week is not needed: reference times are those nearest to the reception, which has to be right to three days.

use insd_base::GpsTime;
use insd_base::satellites::{BroadcastKind, Constellation, KeplerRecord, SatelliteId};

use super::super::bits::{Bits, Field};
use super::super::kepler::{Layout, SECOND, half, range_accuracy, semi, signal_in_space_accuracy};
use super::NUMBER;
use crate::binary::BinaryFault;

/// One message: where it says what.
struct Ephemeris {
    number: u16,
    constellation: Constellation,
    kind: BroadcastKind,
    /// Bits, its number included.
    length: usize,
    satellite: Field,
    /// Weeks since the first of its system, which stands so many weeks behind that of GPS.
    week: (Field, i64),
    /// Of the orbit and of the clock.
    issues: [Field; 2],
    accuracy: Field,
    /// Fields of the health, with the place of each.
    health: &'static [(Field, u32)],
    group_delays: [Field; 2],
    layout: Layout,
}

/// All of them.
const ALL: [&Ephemeris; 5] = [&GPS, &QZSS, &BEIDOU, &GALILEO_FNAV, &GALILEO_INAV];

/// 1019.
const GPS: Ephemeris = Ephemeris {
    number: 1019,
    constellation: Constellation::Gps,
    kind: BroadcastKind::Lnav,
    length: 488,
    satellite: Field::count(12, 6),
    week: (Field::count(18, 10), 0),
    issues: [Field::count(48, 8), Field::count(118, 10)],
    accuracy: Field::count(28, 4),
    health: &[(Field::count(480, 6), 0)],
    group_delays: [Field::signed(472, 8, half(31)), Field::count(0, 0)],
    layout: Layout {
        toe: Field::unsigned(288, 16, 16.0),
        sqrt_a: Field::unsigned(256, 32, half(19)),
        eccentricity: Field::unsigned(208, 32, half(33)),
        m0: Field::signed(160, 32, semi(31)),
        delta_n: Field::signed(144, 16, semi(43)),
        omega: Field::signed(416, 32, semi(31)),
        omega0: Field::signed(320, 32, semi(31)),
        omega_dot: Field::signed(448, 24, semi(43)),
        i0: Field::signed(368, 32, semi(31)),
        i_dot: Field::signed(34, 14, semi(43)),
        latitude: [Field::signed(192, 16, half(29)), Field::signed(240, 16, half(29))],
        radius: [Field::signed(400, 16, half(5)), Field::signed(128, 16, half(5))],
        inclination: [Field::signed(304, 16, half(29)), Field::signed(352, 16, half(29))],
        toc: Field::unsigned(56, 16, 16.0),
        clock: [
            Field::signed(96, 22, half(31)),
            Field::signed(80, 16, half(43)),
            Field::signed(72, 8, half(55)),
        ],
        behind: 0,
    },
};

/// 1044.
const QZSS: Ephemeris = Ephemeris {
    number: 1044,
    constellation: Constellation::Qzss,
    kind: BroadcastKind::Lnav,
    length: 485,
    satellite: Field::count(12, 4),
    week: (Field::count(446, 10), 0),
    issues: [Field::count(78, 8), Field::count(474, 10)],
    accuracy: Field::count(456, 4),
    health: &[(Field::count(460, 6), 0)],
    group_delays: [Field::signed(466, 8, half(31)), Field::count(0, 0)],
    layout: Layout {
        toe: Field::unsigned(246, 16, 16.0),
        sqrt_a: Field::unsigned(214, 32, half(19)),
        eccentricity: Field::unsigned(166, 32, half(33)),
        m0: Field::signed(118, 32, semi(31)),
        delta_n: Field::signed(102, 16, semi(43)),
        omega: Field::signed(374, 32, semi(31)),
        omega0: Field::signed(278, 32, semi(31)),
        omega_dot: Field::signed(406, 24, semi(43)),
        i0: Field::signed(326, 32, semi(31)),
        i_dot: Field::signed(430, 14, semi(43)),
        latitude: [Field::signed(150, 16, half(29)), Field::signed(198, 16, half(29))],
        radius: [Field::signed(358, 16, half(5)), Field::signed(86, 16, half(5))],
        inclination: [Field::signed(262, 16, half(29)), Field::signed(310, 16, half(29))],
        toc: Field::unsigned(16, 16, 16.0),
        clock: [
            Field::signed(56, 22, half(31)),
            Field::signed(40, 16, half(43)),
            Field::signed(32, 8, half(55)),
        ],
        behind: 0,
    },
};

/// 1042; satellites in geostationary orbits have it from D2.
const BEIDOU: Ephemeris = Ephemeris {
    number: 1042,
    constellation: Constellation::BeiDou,
    kind: BroadcastKind::D1,
    length: 511,
    satellite: Field::count(12, 6),
    week: (Field::count(18, 13), 1356),
    issues: [Field::count(49, 5), Field::count(128, 5)],
    accuracy: Field::count(31, 4),
    health: &[(Field::count(510, 1), 0)],
    group_delays: [Field::signed(490, 10, 1e-10), Field::signed(500, 10, 1e-10)],
    layout: Layout {
        toe: Field::unsigned(299, 17, 8.0),
        sqrt_a: Field::unsigned(267, 32, half(19)),
        eccentricity: Field::unsigned(217, 32, half(33)),
        m0: Field::signed(167, 32, semi(31)),
        delta_n: Field::signed(151, 16, semi(43)),
        omega: Field::signed(434, 32, semi(31)),
        omega0: Field::signed(334, 32, semi(31)),
        omega_dot: Field::signed(466, 24, semi(43)),
        i0: Field::signed(384, 32, semi(31)),
        i_dot: Field::signed(35, 14, semi(43)),
        latitude: [Field::signed(199, 18, half(31)), Field::signed(249, 18, half(31))],
        radius: [Field::signed(416, 18, half(6)), Field::signed(133, 18, half(6))],
        inclination: [Field::signed(316, 18, half(31)), Field::signed(366, 18, half(31))],
        toc: Field::unsigned(54, 17, 8.0),
        clock: [
            Field::signed(104, 24, half(33)),
            Field::signed(82, 22, half(50)),
            Field::signed(71, 11, half(66)),
        ],
        behind: 14,
    },
};

/// Orbit and clock stand alike in both of Galileo's.
const GALILEO: Layout = Layout {
    toe: Field::unsigned(294, 14, 60.0),
    sqrt_a: Field::unsigned(262, 32, half(19)),
    eccentricity: Field::unsigned(214, 32, half(33)),
    m0: Field::signed(166, 32, semi(31)),
    delta_n: Field::signed(150, 16, semi(43)),
    omega: Field::signed(420, 32, semi(31)),
    omega0: Field::signed(324, 32, semi(31)),
    omega_dot: Field::signed(452, 24, semi(43)),
    i0: Field::signed(372, 32, semi(31)),
    i_dot: Field::signed(48, 14, semi(43)),
    latitude: [Field::signed(198, 16, half(29)), Field::signed(246, 16, half(29))],
    radius: [Field::signed(404, 16, half(5)), Field::signed(134, 16, half(5))],
    inclination: [Field::signed(308, 16, half(29)), Field::signed(356, 16, half(29))],
    toc: Field::unsigned(62, 14, 60.0),
    clock: [
        Field::signed(103, 31, half(34)),
        Field::signed(82, 21, half(46)),
        Field::signed(76, 6, half(59)),
    ],
    behind: 0,
};

/// 1045.
const GALILEO_FNAV: Ephemeris = Ephemeris {
    number: 1045,
    constellation: Constellation::Galileo,
    kind: BroadcastKind::Fnav,
    length: 496,
    satellite: Field::count(12, 6),
    week: (Field::count(18, 12), 1024),
    issues: [Field::count(30, 10), Field::count(30, 10)],
    accuracy: Field::count(40, 8),
    health: &[(Field::count(488, 1), 3), (Field::count(486, 2), 4)],
    group_delays: [Field::signed(476, 10, half(32)), Field::count(0, 0)],
    layout: GALILEO,
};

/// 1046.
const GALILEO_INAV: Ephemeris = Ephemeris {
    number: 1046,
    constellation: Constellation::Galileo,
    kind: BroadcastKind::Inav,
    length: 504,
    satellite: Field::count(12, 6),
    week: (Field::count(18, 12), 1024),
    issues: [Field::count(30, 10), Field::count(30, 10)],
    accuracy: Field::count(40, 8),
    health: &[
        (Field::count(501, 1), 0),
        (Field::count(499, 2), 1),
        (Field::count(498, 1), 6),
        (Field::count(496, 2), 7),
    ],
    group_delays: [Field::signed(476, 10, half(32)), Field::signed(486, 10, half(32))],
    layout: GALILEO,
};

/// Whether a message of this number has a record that is read.
pub(super) fn is_read(number: u16) -> bool {
    ALL.iter().any(|own| own.number == number)
}

/// The record of a message; `None` if its number is that of another one.
pub(super) fn read(
    number: u16,
    bits: &Bits,
    received: GpsTime,
) -> Option<Result<KeplerRecord, BinaryFault>> {
    let own = ALL.into_iter().find(|own| own.number == number)?;
    Some(own.read(bits, received))
}

/// The message of a record, without what is not read; `None` if there is none of its kind.
pub(super) fn write(record: &KeplerRecord) -> Option<Bits> {
    let kind = if record.kind == BroadcastKind::D2 { BroadcastKind::D1 } else { record.kind };
    let is_it =
        |own: &&Ephemeris| own.constellation == record.satellite.constellation && own.kind == kind;
    ALL.into_iter().find(is_it).map(|own| own.write(record))
}

impl Ephemeris {
    fn write(&self, record: &KeplerRecord) -> Bits {
        let mut bits = Bits::zeros(self.length);
        NUMBER.put_raw(&mut bits, self.number.into());
        self.satellite.put_raw(&mut bits, record.satellite.number.into());
        let system = record.orbit.reference.as_nanos() - self.layout.behind * SECOND;
        let (week, weeks) = &self.week;
        week.put_raw(&mut bits, (GpsTime::from_nanos(system).to_week().0 - weeks) as u64);
        self.layout.put(&mut bits, &record.orbit, &record.clock);
        for (field, issue) in self.issues.iter().zip([record.issue, record.clock_issue]) {
            field.put_raw(&mut bits, issue.into());
        }
        for (field, at) in self.health {
            field.put_raw(&mut bits, u64::from(record.health) >> at);
        }
        for (field, delay) in self.group_delays.iter().zip(record.group_delays) {
            field.put(&mut bits, delay);
        }
        // the last index of each says that nothing is foretold
        let indices = if self.constellation == Constellation::Galileo { 0..=255 } else { 0..=15 };
        let last = *indices.end();
        let index = indices.into_iter().find(|index| self.accuracy_of(*index) == record.accuracy);
        self.accuracy.put_raw(&mut bits, index.unwrap_or(last) as u64);
        bits
    }

    /// Accuracy of an index, m.
    fn accuracy_of(&self, index: i64) -> Option<f64> {
        match self.constellation {
            Constellation::Galileo => signal_in_space_accuracy(index),
            _ => range_accuracy(index),
        }
    }

    fn read(&self, bits: &Bits, received: GpsTime) -> Result<KeplerRecord, BinaryFault> {
        if bits.len() < self.length {
            let (needed, found) = (self.length.div_ceil(8), bits.len() / 8);
            return Err(BinaryFault::Short { needed, found });
        }
        let satellite = SatelliteId::new(self.constellation, self.satellite.raw(bits) as u8)
            .ok_or(BinaryFault::Range { field: "satellite id" })?;
        let orbit =
            self.layout.orbit(bits, received).ok_or(BinaryFault::Range { field: "orbit" })?;
        let [issue, clock_issue] = self.issues.map(|field| field.raw(bits) as u16);
        let health = self.health.iter().map(|(field, at)| field.raw(bits) << at).sum::<u64>();
        Ok(KeplerRecord {
            satellite,
            kind: if satellite.is_geostationary() { BroadcastKind::D2 } else { self.kind },
            issue,
            clock_issue,
            health: health as u16,
            accuracy: self.accuracy_of(self.accuracy.whole(bits)),
            group_delays: self.group_delays.map(|field| field.value(bits)),
            orbit,
            clock: self.layout.clock(bits, received),
            transmitted: None,
        })
    }
}
