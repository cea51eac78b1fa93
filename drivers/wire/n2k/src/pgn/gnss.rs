//! What a receiver, or an integrated system, says of its fix.

use super::bits::{Number, Reader, Writer};
use super::kinds::{
    Always, COUNT, Count, DATE, DEVIATION, DILUTION, DIRECTION, Degrees, Kind, SID, TIME,
};
use super::table::{codes, group};
use super::{Sid, millis};

codes! {
    /// What a fix is made from.
    GnssSystem as SYSTEM, 4 bits;
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
    ..Other
}

codes! {
    /// How a fix was made.
    FixMethod as METHOD, 4 bits;
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
    ..Other
}

codes! {
    /// What a receiver's own watch says.
    Integrity as WATCH, 2 bits;
    /// Nobody watches.
    NoChecking,
    /// Safe.
    Safe,
    /// Caution.
    Caution,
    /// Unsafe.
    Unsafe,
}

codes! {
    /// The number of dimensions of a fix.
    FixMode as MODE, 3 bits;
    /// Clock only.
    OneD,
    /// Horizontal.
    TwoD,
    /// With height.
    ThreeD,
    /// Chosen by the receiver.
    Auto,
    ..Other
}

/// Latitude. The steps are finer than those of a double: reading and writing each lose some units in its
/// last place, about 1e-9 m.
const LATITUDE: Degrees = Degrees(
    Number::signed(64, 1e16).within(-900_000_000_000_000_000, 900_000_000_000_000_000).unit("deg"),
);
/// Longitude.
const LONGITUDE: Degrees = Degrees(
    Number::signed(64, 1e16)
        .within(-1_800_000_000_000_000_000, 1_800_000_000_000_000_000)
        .unit("deg"),
);
/// Altitude.
const ALTITUDE: Number = Number::signed(64, 1e6).unit("m");
/// Height of the geoid.
const GEOID: Number = Number::signed(32, 100.0).unit("m");
/// There is no number for "not available".
const INTEGRITY: Always<Integrity> = WATCH.always(Integrity::NoChecking);
/// Age of corrections.
const AGE: Number = Number::unsigned(16, 100.0).unit("s");
/// Number of a reference station.
const STATION: Count<u16> = Count::of(Number::unsigned(12, 1.0));

group! {
    /// 129029 GNSS position data.
    ///
    /// The integrity has no number for "not available": unknown is written as [`Integrity::NoChecking`],
    /// and read as `None` only where the contents end before it. At most 45 stations fit a message; more
    /// are left out.
    ///
    /// The altitude: the title of NMEA's field is "altitude referenced to WGS-84", and some receivers
    /// nevertheless send the height above the geoid. Whoever reads must know his receiver.
    129_029 GnssPosition, priority 3, every millis(1000), least 7;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Days since 1970-01-01.
    8 date: Option<u16> = DATE;
    /// UTC, seconds of the day.
    24 time: Option<f64> = TIME;
    /// Geodetic latitude, rad, north positive.
    56 latitude: Option<f64> = LATITUDE;
    /// Longitude, rad, east positive.
    120 longitude: Option<f64> = LONGITUDE;
    /// Altitude, m: above the ellipsoid of WGS-84, or with some receivers above the geoid.
    184 altitude: Option<f64> = ALTITUDE;
    /// What the fix is made from.
    248 system: Option<GnssSystem> = SYSTEM;
    /// How.
    252 method: Option<FixMethod> = METHOD;
    /// What the receiver's own watch says.
    256 integrity: Option<Integrity> = INTEGRITY, reserved 6;
    /// Satellites used.
    264 satellites: Option<u8> = COUNT;
    /// Horizontal dilution of precision.
    272 hdop: Option<f64> = DILUTION;
    /// Position dilution of precision.
    288 pdop: Option<f64> = DILUTION;
    /// Height of the geoid above the ellipsoid, m.
    304 geoid: Option<f64> = GEOID;
    /// Reference stations.
    336 stations: Vec<Station> = Stations;
}

group! {
    /// 129539 GNSS dilutions of precision.
    129_539 Dops: Copy, priority 6, every millis(1000), least 4;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// What was asked for.
    8 desired: Option<FixMode> = MODE;
    /// What there is.
    11 actual: Option<FixMode> = MODE, reserved 2;
    /// Horizontal.
    16 hdop: Option<f64> = DILUTION;
    /// Vertical.
    32 vdop: Option<f64> = DILUTION;
    /// Of time.
    48 tdop: Option<f64> = DILUTION;
}

group! {
    /// 129542 GNSS pseudorange noise statistics.
    ///
    /// Both sources of the layout agree, but no log at hand has this group: not verified against a device.
    129_542 PseudorangeNoise: Copy, priority 6, every millis(1000), least 3;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Root mean square of the residuals of ranges ("of position uncertainty"), m.
    8 range_rms: Option<f64> = DEVIATION;
    /// 1-sigma along the major axis of the ellipse of position errors, m.
    24 major: Option<f64> = DEVIATION;
    /// 1-sigma along its minor axis, m.
    40 minor: Option<f64> = DEVIATION;
    /// Direction of its major axis from true north, rad.
    56 orientation: Option<f64> = DIRECTION;
    /// 1-sigma of the latitude, m.
    72 latitude_std: Option<f64> = DEVIATION;
    /// 1-sigma of the longitude, m.
    88 longitude_std: Option<f64> = DEVIATION;
    /// 1-sigma of the altitude, m.
    104 altitude_std: Option<f64> = DEVIATION;
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

/// How many stations there are, and each of them.
struct Stations;

impl Stations {
    /// Bits of one.
    const ONE: u32 = 32;
    /// Those that fit into the 223 bytes of a fast packet.
    const MOST: usize = 45;
}

impl Kind for Stations {
    type Value = Vec<Station>;

    /// Those of the number; the stations come behind all fields of fixed place.
    fn bits(&self) -> u32 {
        COUNT.bits()
    }

    fn read(&self, fields: &mut Reader<'_>) -> Vec<Station> {
        let mut stations = Vec::new();
        for _ in 0..COUNT.read(fields).unwrap_or(0) {
            if fields.has(Self::ONE) {
                let (system, id) = (SYSTEM.read(fields), STATION.read(fields));
                stations.push(Station { system, id, age: AGE.read(fields) });
            }
        }
        stations
    }

    fn write(&self, fields: &mut Writer, stations: &Vec<Station>) {
        let fitting = stations.iter().take(Self::MOST);
        COUNT.write(fields, &u8::try_from(fitting.len()).ok());
        for station in fitting {
            SYSTEM.write(fields, &station.system);
            STATION.write(fields, &station.id);
            AGE.write(fields, &station.age);
        }
    }

    fn form(&self) -> String {
        let parts = [SYSTEM.bits(), STATION.bits()].map(|bits| bits.to_string());
        let [system, id] = parts;
        format!(
            "u8: how many; of each the system, {system} bits, the id, {id} bits, the age, {}",
            AGE.form()
        )
    }
}
