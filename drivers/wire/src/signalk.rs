//! Signal K: a delta, the message by which values reach a Signal K server, as one line of JSON.
//!
//! ```text
//! {"updates":[{"source":{"label":"insd"},"timestamp":"2026-01-02T03:04:05.100Z",
//!   "values":[{"path":"navigation.headingTrue","value":1.5708}, ...]}]}
//! ```
//! | path | |
//! |---|---|
//! | `navigation.datetime` | UTC |
//! | `navigation.position` | `latitude`, `longitude`, deg; `altitude` above mean sea level, m |
//! | `navigation.headingTrue`, `headingMagnetic`, `magneticVariation` | rad, east positive |
//! | `navigation.courseOverGroundTrue`, `speedOverGround` | rad, m/s |
//! | `navigation.speedThroughWater` | m/s along the keel, ahead positive |
//! | `navigation.rateOfTurn` | rad/s, bow to starboard positive |
//! | `navigation.attitude` | `roll`, to starboard positive; `pitch`, bow up positive; `yaw`, the true heading; rad |
//! | `environment.heave` | m, up positive |
//! | `navigation.gnss.methodQuality` | quality of the position in the words of Signal K |
//! | `navigation.gnss.geoidalSeparation` | m |
//! | `navigation.gnss.satellites`, `horizontalDilution` | of the receiver in use |
//! | `navigation.ins.mode` | what the system does, in words |
//! | `navigation.ins.positionSigma`, `headingSigma` | 1-sigma, m (root sum square of north and east), rad |
//!
//! The paths `navigation.ins` are our own: Signal K has none for how sure a value is. What is not known is
//! `null`, which is how a server is told that a value is known no longer. After the schema of Signal K 1.7 (units,
//! signs, names of the qualities). A delta names no vessel: that is the server's own.
//!
//! What a server sends is read by [`ServerLine`].

mod server;

pub use server::{ServerLine, ServerUpdate, ServerValue, look};

use std::fmt::Write;

use insd_base::FixQuality;

use crate::nmea::CivilTime;

/// What is known at one instant.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Delta {
    /// The instant.
    pub time: Option<CivilTime>,
    /// Latitude and longitude, rad, north and east positive.
    pub place: Option<(f64, f64)>,
    /// Height above mean sea level, m.
    pub altitude: Option<f64>,
    /// True heading, rad.
    pub heading: Option<f64>,
    /// Heading from magnetic north, rad.
    pub magnetic_heading: Option<f64>,
    /// Magnetic variation, rad, east positive.
    pub variation: Option<f64>,
    /// Course over ground, rad from true north.
    pub course: Option<f64>,
    /// Speed over ground, m/s.
    pub speed: Option<f64>,
    /// Speed through the water along the keel, m/s.
    pub speed_through_water: Option<f64>,
    /// Rate of turn, rad/s, bow to starboard positive.
    pub rate_of_turn: Option<f64>,
    /// Roll, starboard down positive, and pitch, bow up positive, rad.
    pub tilt: Option<(f64, f64)>,
    /// Heave, m, up positive.
    pub heave: Option<f64>,
    /// Quality of the position.
    pub quality: FixQuality,
    /// Height of the geoid above the ellipsoid, m.
    pub geoid_separation: Option<f64>,
    /// Satellites used.
    pub satellites: Option<u16>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// What the system does, in plain words without quotation marks.
    pub mode: &'static str,
    /// 1-sigma of the horizontal position, root sum square, m.
    pub position_sigma: Option<f64>,
    /// 1-sigma of the heading, rad.
    pub heading_sigma: Option<f64>,
}

/// Decimals of an angle in radians: 0.06 arc seconds.
const ANGLE: usize = 7;
/// Decimals of m and m/s.
const METRE: usize = 3;
/// Decimals of degrees of latitude and longitude: 1 mm.
const DEGREE: usize = 8;

impl Delta {
    /// Bytes of the longest line that a ship can bring about, CR LF included.
    pub const LONGEST: usize = 1280;

    /// The line, CR LF included.
    #[must_use]
    pub fn write(&self) -> String {
        let mut line = Values { text: String::with_capacity(Self::LONGEST), is_first: true };
        line.text.push_str(r#"{"updates":[{"source":{"label":"insd"},"#);
        let time = self.time.map(timestamp);
        if let Some(time) = &time {
            line.push(format_args!(r#""timestamp":"{time}","#));
        }
        line.text.push_str(r#""values":["#);
        line.word("navigation.datetime", time.as_deref());
        self.position(&mut line);
        for (path, value, decimals) in self.numbers() {
            line.number(path, value, decimals);
        }
        self.attitude(&mut line);
        line.word("navigation.gnss.methodQuality", Some(quality(self.quality)));
        line.word("navigation.ins.mode", Some(self.mode));
        line.text.push_str("]}]}\r\n");
        line.text
    }

    fn numbers(&self) -> [(&'static str, Option<f64>, usize); 13] {
        [
            ("navigation.headingTrue", turn(self.heading), ANGLE),
            ("navigation.headingMagnetic", turn(self.magnetic_heading), ANGLE),
            ("navigation.magneticVariation", self.variation, ANGLE),
            ("navigation.courseOverGroundTrue", turn(self.course), ANGLE),
            ("navigation.speedOverGround", self.speed, METRE),
            ("navigation.speedThroughWater", self.speed_through_water, METRE),
            ("navigation.rateOfTurn", self.rate_of_turn, ANGLE),
            ("environment.heave", self.heave, METRE),
            ("navigation.gnss.geoidalSeparation", self.geoid_separation, METRE),
            ("navigation.gnss.satellites", self.satellites.map(f64::from), 0),
            ("navigation.gnss.horizontalDilution", self.hdop, 2),
            ("navigation.ins.positionSigma", self.position_sigma, METRE),
            ("navigation.ins.headingSigma", self.heading_sigma, ANGLE),
        ]
    }

    fn position(&self, line: &mut Values) {
        line.path("navigation.position");
        let good =
            |(latitude, longitude): &(f64, f64)| latitude.is_finite() && longitude.is_finite();
        let Some((latitude, longitude)) = self.place.filter(good) else {
            return line.text.push_str("null}");
        };
        let (latitude, longitude) = (latitude.to_degrees(), longitude.to_degrees());
        line.push(format_args!(
            r#"{{"latitude":{latitude:.DEGREE$},"longitude":{longitude:.DEGREE$}"#
        ));
        if let Some(altitude) = self.altitude.filter(|altitude| altitude.is_finite()) {
            line.push(format_args!(r#","altitude":{altitude:.METRE$}"#));
        }
        line.text.push_str("}}");
    }

    fn attitude(&self, line: &mut Values) {
        line.path("navigation.attitude");
        let (roll, pitch) = self.tilt.unzip();
        let parts = [("roll", roll), ("pitch", pitch), ("yaw", turn(self.heading))];
        for (index, (name, value)) in parts.into_iter().enumerate() {
            let open = if index == 0 { '{' } else { ',' };
            line.push(format_args!(r#"{open}"{name}":"#));
            line.value(value, ANGLE);
        }
        line.text.push_str("}}");
    }
}

/// The values of a delta on their way into the text.
struct Values {
    text: String,
    is_first: bool,
}

impl Values {
    fn push(&mut self, parts: std::fmt::Arguments<'_>) {
        // a string takes whatever it is given
        let _ = self.text.write_fmt(parts);
    }

    fn path(&mut self, path: &str) {
        let comma = if std::mem::take(&mut self.is_first) { "" } else { "," };
        self.push(format_args!(r#"{comma}{{"path":"{path}","value":"#));
    }

    fn value(&mut self, value: Option<f64>, decimals: usize) {
        match value.filter(|value| value.is_finite()) {
            Some(value) => self.push(format_args!("{value:.decimals$}")),
            None => self.text.push_str("null"),
        }
    }

    fn number(&mut self, path: &str, value: Option<f64>, decimals: usize) {
        self.path(path);
        self.value(value, decimals);
        self.text.push('}');
    }

    fn word(&mut self, path: &str, word: Option<&str>) {
        self.path(path);
        match word {
            Some(word) => self.push(format_args!(r#""{word}"}}"#)),
            None => self.text.push_str("null}"),
        }
    }
}

/// An angle in [0, 2 pi).
fn turn(angle: Option<f64>) -> Option<f64> {
    angle.map(|angle| angle.rem_euclid(std::f64::consts::TAU))
}

/// RFC 3339 to the millisecond.
fn timestamp(civil: CivilTime) -> String {
    let (date, time) = (civil.date, civil.time);
    format!(
        "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z",
        date.year,
        date.month,
        date.day,
        time.hour,
        time.minute,
        time.second,
        time.nanosecond / 1_000_000
    )
}

/// The words of Signal K.
fn quality(quality: FixQuality) -> &'static str {
    match quality {
        FixQuality::Invalid => "no GPS",
        FixQuality::Autonomous => "GNSS Fix",
        FixQuality::Differential => "DGNSS fix",
        FixQuality::Precise => "Precise GNSS",
        FixQuality::RtkFixed => "RTK fixed integer",
        FixQuality::RtkFloat => "RTK float",
        FixQuality::Estimated => "Estimated (DR) mode",
        FixQuality::Manual => "Manual input",
        FixQuality::Simulated => "Simulator mode",
    }
}
