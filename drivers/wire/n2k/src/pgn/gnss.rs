//! What a receiver, or an integrated system, says of its fix.

use insd_base::Span;

use super::bits::{DILUTION, Number, Reader, TIME, Writer, place_of};
use super::{Group, Short, Sid, millis};

/// What a fix is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GnssSystem {
    /// GPS.
    Gps,
    /// GLONASS.
    Glonass,
    /// GPS and GLONASS.
    GpsGlonass,
    /// GPS with SBAS.
    GpsSbas,
    /// GPS with SBAS, and GLONASS.
    GpsSbasGlonass,
    /// Chayka.
    Chayka,
    /// An integrated navigation system.
    Integrated,
    /// A surveyed place.
    Surveyed,
    /// Galileo.
    Galileo,
    /// Another number, as it stands.
    Other(u8),
}

/// How a fix was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixMethod {
    /// There is none.
    NoFix,
    /// GNSS alone.
    Gnss,
    /// With corrections.
    Differential,
    /// Precise (military) GNSS.
    Precise,
    /// RTK, ambiguities fixed.
    RtkFixed,
    /// RTK, ambiguities not fixed.
    RtkFloat,
    /// Dead reckoning.
    DeadReckoning,
    /// Typed in.
    Manual,
    /// A simulator.
    Simulated,
    /// Another number, as it stands.
    Other(u8),
}

/// What a receiver's own watch says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrity {
    /// Nobody watches.
    NoChecking,
    /// Safe.
    Safe,
    /// Caution.
    Caution,
    /// Unsafe.
    Unsafe,
}

/// A reference station of a differential fix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Kind, as the system of the fix.
    pub system: Option<GnssSystem>,
    /// Number of the station.
    pub id: Option<u16>,
    /// Age of its corrections, s.
    pub age: Option<f64>,
}

/// 129029 GNSS position data.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | date, u16, days |
/// | 24 | time, u32, 1e-4 s |
/// | 56 | latitude, i64, 1e-16 deg |
/// | 120 | longitude, i64, 1e-16 deg |
/// | 184 | altitude, i64, 1e-6 m |
/// | 248 | system, 4 bits, [`GnssSystem`] in its order from 0 |
/// | 252 | method, 4 bits, [`FixMethod`] in its order from 0 |
/// | 256 | integrity, 2 bits, [`Integrity`] in its order from 0 |
/// | 258 | reserved, 6 bits |
/// | 264 | satellites, u8 |
/// | 272 | HDOP, i16, 0.01 |
/// | 288 | PDOP, i16, 0.01 |
/// | 304 | height of the geoid, i32, 0.01 m |
/// | 336 | number of reference stations, u8 |
/// | 344 | for each: system, 4 bits; id, 12 bits; age, u16, 0.01 s |
///
/// The integrity has no number for "not available": unknown is written as [`Integrity::NoChecking`],
/// and read as `None` only where the contents end before it. At most 45 stations fit a message; more
/// are left out.
///
/// The altitude: the title of NMEA's field is "altitude referenced to WGS-84", and some receivers
/// nevertheless send the height above the geoid. Whoever reads must know his receiver.
#[derive(Clone, Debug, PartialEq)]
pub struct GnssPosition {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Days since 1970-01-01.
    pub date: Option<u16>,
    /// UTC, seconds of the day.
    pub time: Option<f64>,
    /// Geodetic latitude, rad, north positive.
    pub latitude: Option<f64>,
    /// Longitude, rad, east positive.
    pub longitude: Option<f64>,
    /// Altitude, m: above the ellipsoid of WGS-84, or with some receivers above the geoid.
    pub altitude: Option<f64>,
    /// What the fix is made from.
    pub system: Option<GnssSystem>,
    /// How.
    pub method: Option<FixMethod>,
    /// What the receiver's own watch says.
    pub integrity: Option<Integrity>,
    /// Satellites used.
    pub satellites: Option<u8>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// Position dilution of precision.
    pub pdop: Option<f64>,
    /// Height of the geoid above the ellipsoid, m.
    pub geoid: Option<f64>,
    /// Reference stations.
    pub stations: Vec<Station>,
}

/// The number of dimensions of a fix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixMode {
    /// Clock only.
    OneD,
    /// Horizontal.
    TwoD,
    /// With height.
    ThreeD,
    /// Chosen by the receiver.
    Auto,
    /// Another number, as it stands.
    Other(u8),
}

/// 129539 GNSS dilutions of precision.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | desired mode, 3 bits, [`FixMode`] in its order from 0 |
/// | 11 | actual mode, 3 bits |
/// | 14 | reserved, 2 bits |
/// | 16 | HDOP, i16, 0.01 |
/// | 32 | VDOP, i16, 0.01 |
/// | 48 | TDOP, i16, 0.01 |
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dops {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// What was asked for.
    pub desired: Option<FixMode>,
    /// What there is.
    pub actual: Option<FixMode>,
    /// Horizontal.
    pub hdop: Option<f64>,
    /// Vertical.
    pub vdop: Option<f64>,
    /// Of time.
    pub tdop: Option<f64>,
}

/// 129542 GNSS pseudorange noise statistics.
///
/// | bit | field |
/// |---:|---|
/// | 0 | SID, u8 |
/// | 8 | RMS of residuals ("of position uncertainty"), u16, 0.01 m |
/// | 24 | major axis, u16, 0.01 m |
/// | 40 | minor axis, u16, 0.01 m |
/// | 56 | orientation of the major axis, u16, 1e-4 rad |
/// | 72 | latitude, u16, 0.01 m |
/// | 88 | longitude, u16, 0.01 m |
/// | 104 | altitude, u16, 0.01 m |
///
/// Both sources of the layout agree, but no log at hand has this group: not verified against a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PseudorangeNoise {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Root mean square of the residuals of ranges, m.
    pub range_rms: Option<f64>,
    /// 1-sigma along the major axis of the ellipse of position errors, m.
    pub major: Option<f64>,
    /// 1-sigma along its minor axis, m.
    pub minor: Option<f64>,
    /// Direction of its major axis from true north, rad.
    pub orientation: Option<f64>,
    /// 1-sigma of the latitude, m.
    pub latitude_std: Option<f64>,
    /// 1-sigma of the longitude, m.
    pub longitude_std: Option<f64>,
    /// 1-sigma of the altitude, m.
    pub altitude_std: Option<f64>,
}

/// Latitude, 1e-16 deg. The steps are finer than those of a double: reading and writing each lose
/// some units in its last place, about 1e-9 m.
const LATITUDE: Number =
    Number::signed(64, 1e16).within(-900_000_000_000_000_000, 900_000_000_000_000_000);
/// Longitude, 1e-16 deg.
const LONGITUDE: Number =
    Number::signed(64, 1e16).within(-1_800_000_000_000_000_000, 1_800_000_000_000_000_000);
/// Altitude, 1e-6 m.
const ALTITUDE: Number = Number::signed(64, 1e6);
/// Height of the geoid, 0.01 m.
const GEOID: Number = Number::signed(32, 100.0);
/// Age of corrections, 0.01 s.
const AGE: Number = Number::unsigned(16, 100.0);
/// A standard deviation, 0.01 m.
const DEVIATION: Number = Number::unsigned(16, 100.0);
/// Every one of the four numbers is data.
const INTEGRITY: Number = Number::unsigned(2, 1.0).within(0, 3);
/// Bits of a station.
const STATION: u32 = 32;
/// The stations that fit into the 223 bytes of a fast packet.
const MOST_STATIONS: usize = 45;

impl GnssSystem {
    /// By their codes.
    const LIST: [GnssSystem; 9] = [
        GnssSystem::Gps,
        GnssSystem::Glonass,
        GnssSystem::GpsGlonass,
        GnssSystem::GpsSbas,
        GnssSystem::GpsSbasGlonass,
        GnssSystem::Chayka,
        GnssSystem::Integrated,
        GnssSystem::Surveyed,
        GnssSystem::Galileo,
    ];

    fn read(fields: &mut Reader<'_>) -> Option<Self> {
        fields.choice(4, &Self::LIST, |code| Some(GnssSystem::Other(code)))
    }

    fn code(self) -> Option<u8> {
        if let GnssSystem::Other(code) = self { Some(code) } else { place_of(&Self::LIST, &self) }
    }
}

impl FixMethod {
    /// By their codes.
    const LIST: [FixMethod; 9] = [
        FixMethod::NoFix,
        FixMethod::Gnss,
        FixMethod::Differential,
        FixMethod::Precise,
        FixMethod::RtkFixed,
        FixMethod::RtkFloat,
        FixMethod::DeadReckoning,
        FixMethod::Manual,
        FixMethod::Simulated,
    ];

    fn code(self) -> Option<u8> {
        if let FixMethod::Other(code) = self { Some(code) } else { place_of(&Self::LIST, &self) }
    }
}

impl Integrity {
    /// By their codes.
    const LIST: [Integrity; 4] =
        [Integrity::NoChecking, Integrity::Safe, Integrity::Caution, Integrity::Unsafe];
}

impl FixMode {
    /// By their codes.
    const LIST: [FixMode; 4] = [FixMode::OneD, FixMode::TwoD, FixMode::ThreeD, FixMode::Auto];

    fn read(fields: &mut Reader<'_>) -> Option<Self> {
        fields.choice(3, &Self::LIST, |code| Some(FixMode::Other(code)))
    }

    fn code(self) -> Option<u8> {
        if let FixMode::Other(code) = self { Some(code) } else { place_of(&Self::LIST, &self) }
    }
}

impl Group for GnssPosition {
    const PGN: u32 = 129_029;
    const PRIORITY: u8 = 3;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 7)?;
        let mut fix = GnssPosition {
            sid: fields.byte(),
            date: fields.short(16),
            time: fields.number(TIME),
            latitude: fields.degrees(LATITUDE),
            longitude: fields.degrees(LONGITUDE),
            altitude: fields.number(ALTITUDE),
            system: GnssSystem::read(&mut fields),
            method: fields.choice(4, &FixMethod::LIST, |code| Some(FixMethod::Other(code))),
            integrity: fields.choice(2, &Integrity::LIST, |_| None),
            satellites: fields.after(6).byte(),
            hdop: fields.number(DILUTION),
            pdop: fields.number(DILUTION),
            geoid: fields.number(GEOID),
            stations: Vec::new(),
        };
        for _ in 0..fields.byte().unwrap_or(0) {
            if fields.has(STATION) {
                fix.stations.push(Station::read(&mut fields));
            }
        }
        Ok(fix)
    }

    fn write(&self) -> Vec<u8> {
        let integrity = self.integrity.unwrap_or(Integrity::NoChecking);
        let integrity = place_of(&Integrity::LIST, &integrity).map(i64::from);
        let stations = self.stations.iter().take(MOST_STATIONS);
        let mut fields = Writer::default();
        fields.byte(self.sid).short(16, self.date).number(TIME, self.time);
        fields.degrees(LATITUDE, self.latitude).degrees(LONGITUDE, self.longitude);
        fields.number(ALTITUDE, self.altitude);
        fields.code(4, self.system.and_then(GnssSystem::code));
        fields.code(4, self.method.and_then(FixMethod::code));
        fields.steps(INTEGRITY, integrity).reserved(6).byte(self.satellites);
        fields.number(DILUTION, self.hdop).number(DILUTION, self.pdop);
        fields.number(GEOID, self.geoid).byte(u8::try_from(stations.len()).ok());
        for station in stations {
            station.write(&mut fields);
        }
        fields.done()
    }
}

impl Station {
    fn read(fields: &mut Reader<'_>) -> Self {
        Station { system: GnssSystem::read(fields), id: fields.short(12), age: fields.number(AGE) }
    }

    fn write(&self, fields: &mut Writer) {
        fields.code(4, self.system.and_then(GnssSystem::code));
        fields.short(12, self.id).number(AGE, self.age);
    }
}

impl Group for Dops {
    const PGN: u32 = 129_539;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 4)?;
        let sid = fields.byte();
        let desired = FixMode::read(&mut fields);
        let actual = FixMode::read(&mut fields);
        fields.skip(2);
        Ok(Dops {
            sid,
            desired,
            actual,
            hdop: fields.number(DILUTION),
            vdop: fields.number(DILUTION),
            tdop: fields.number(DILUTION),
        })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.byte(self.sid);
        fields.code(3, self.desired.and_then(FixMode::code));
        fields.code(3, self.actual.and_then(FixMode::code)).reserved(2);
        fields.number(DILUTION, self.hdop).number(DILUTION, self.vdop).number(DILUTION, self.tdop);
        fields.done()
    }
}

impl Group for PseudorangeNoise {
    const PGN: u32 = 129_542;
    const PRIORITY: u8 = 6;
    const INTERVAL: Option<Span> = millis(1000);

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut fields = Reader::new(data, 3)?;
        Ok(PseudorangeNoise {
            sid: fields.byte(),
            range_rms: fields.number(DEVIATION),
            major: fields.number(DEVIATION),
            minor: fields.number(DEVIATION),
            orientation: fields.direction(),
            latitude_std: fields.number(DEVIATION),
            longitude_std: fields.number(DEVIATION),
            altitude_std: fields.number(DEVIATION),
        })
    }

    fn write(&self) -> Vec<u8> {
        let mut fields = Writer::default();
        fields.byte(self.sid).number(DEVIATION, self.range_rms);
        fields.number(DEVIATION, self.major).number(DEVIATION, self.minor);
        fields.direction(self.orientation).number(DEVIATION, self.latitude_std);
        fields.number(DEVIATION, self.longitude_std).number(DEVIATION, self.altitude_std);
        fields.done()
    }
}
