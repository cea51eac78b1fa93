//! The file of a stored state: the aligned ship at shutdown, for a warm start ([`insd_alignment::stored`]).
//!
//! TOML with units in the keys. A file that is not understood to the last key is refused: a heading
//! that was misread is worse than none.

use std::fs;
use std::io::Write;
use std::ops::RangeInclusive;
use std::path::Path;

use anyhow::Context;
use insd_alignment::StoredState;
use insd_base::units::{DEG, DEG_PER_HOUR, MICRO_G, wrap_two_pi};
use insd_base::{Attitude, Geodetic, Time};
use nalgebra::Vector3;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

use crate::bad_input::BadInput;
use crate::output_file::OutputFile;

/// The version of the format that is written, and the only one that is read.
const VERSION: u64 = 1;
/// Longest file that is read, bytes.
const MAX_LENGTH: u64 = 1 << 16;

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Contents {
    #[serde(deserialize_with = "version")]
    version: u64,
    /// UTC of the start of the voyage that stored it, for people.
    start_utc: String,
    #[serde(deserialize_with = "time")]
    t_s: f64,
    moored: bool,
    #[serde(deserialize_with = "fingerprint", serialize_with = "hexadecimal")]
    imu_fingerprint: u64,
    #[serde(deserialize_with = "length")]
    sway_std_m: f64,
    position: Position,
    attitude: Angles,
    attitude_std: AngleSigmas,
    gyro_bias_deg_h: Triple,
    gyro_bias_std_deg_h: Sigmas,
    accel_bias_ug: Triple,
    accel_bias_std_ug: Sigmas,
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Position {
    #[serde(deserialize_with = "latitude")]
    lat_deg: f64,
    #[serde(deserialize_with = "longitude")]
    lon_deg: f64,
    #[serde(deserialize_with = "height")]
    height_m: f64,
    #[serde(deserialize_with = "length")]
    std_m: f64,
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Angles {
    #[serde(deserialize_with = "half_turn")]
    roll_deg: f64,
    #[serde(deserialize_with = "quarter_turn")]
    pitch_deg: f64,
    #[serde(deserialize_with = "full_turn")]
    heading_deg: f64,
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct AngleSigmas {
    #[serde(deserialize_with = "angle_std")]
    roll_deg: f64,
    #[serde(deserialize_with = "angle_std")]
    pitch_deg: f64,
    #[serde(deserialize_with = "angle_std")]
    heading_deg: f64,
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Triple {
    #[serde(deserialize_with = "bias")]
    forward: f64,
    #[serde(deserialize_with = "bias")]
    starboard: f64,
    #[serde(deserialize_with = "bias")]
    down: f64,
}

#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Sigmas {
    #[serde(deserialize_with = "bias_std")]
    forward: f64,
    #[serde(deserialize_with = "bias_std")]
    starboard: f64,
    #[serde(deserialize_with = "bias_std")]
    down: f64,
}

/// Writes a state; the file appears whole or not at all. `start_utc` is that of the voyage.
///
/// # Errors
/// The file cannot be written.
pub fn write(path: &Path, state: &StoredState, start_utc: &str) -> anyhow::Result<()> {
    let text = text(state, start_utc).context("cannot put the state into words")?;
    let mut file = OutputFile::create(path)?;
    file.write_all(text.as_bytes())
        .with_context(|| format!("{}: cannot be written", path.display()))?;
    file.finish()
}

/// Reads a state.
///
/// # Errors
/// [`BadInput`] with file, line, column and what was expected.
pub fn read(path: &Path) -> anyhow::Result<StoredState> {
    let name = path.display();
    let bad = |fault: &dyn std::fmt::Display| BadInput(format!("{name}: {fault}"));
    let about = fs::metadata(path).map_err(|fault| bad(&fault))?;
    if about.len() > MAX_LENGTH {
        return Err(bad(&format!("longer than {MAX_LENGTH} bytes; expected a stored state")).into());
    }
    let bytes = fs::read(path).map_err(|fault| bad(&fault))?;
    let text = String::from_utf8(bytes).map_err(|_| {
        bad(&"not UTF-8 text; expected a stored state, as replay --save-state writes")
    })?;
    parse(&text).map_err(|fault| BadInput(format!("{name}{fault}")).into())
}

/// A state as its file has it. `start_utc` is for people.
///
/// # Errors
/// It cannot be put into words.
pub fn text(state: &StoredState, start_utc: &str) -> Result<String, toml::ser::Error> {
    let triple = |v: &Vector3<f64>, unit: f64| Triple {
        forward: v.x / unit,
        starboard: v.y / unit,
        down: v.z / unit,
    };
    let sigmas = |v: &Vector3<f64>, unit: f64| Sigmas {
        forward: v.x / unit,
        starboard: v.y / unit,
        down: v.z / unit,
    };
    let (attitude, std) = (&state.attitude, &state.attitude_std);
    toml::to_string(&Contents {
        version: VERSION,
        start_utc: start_utc.to_owned(),
        t_s: state.time.as_seconds(),
        moored: state.moored,
        imu_fingerprint: state.imu,
        sway_std_m: state.sway_std,
        position: Position {
            lat_deg: state.position.latitude.to_degrees(),
            lon_deg: state.position.longitude.to_degrees(),
            height_m: state.position.height,
            std_m: state.position_std,
        },
        attitude: Angles {
            roll_deg: attitude.roll / DEG,
            pitch_deg: attitude.pitch / DEG,
            heading_deg: attitude.heading / DEG,
        },
        attitude_std: AngleSigmas {
            roll_deg: std.x / DEG,
            pitch_deg: std.y / DEG,
            heading_deg: std.z / DEG,
        },
        gyro_bias_deg_h: triple(&state.gyro_bias, DEG_PER_HOUR),
        gyro_bias_std_deg_h: sigmas(&state.gyro_bias_std, DEG_PER_HOUR),
        accel_bias_ug: triple(&state.accel_bias, MICRO_G),
        accel_bias_std_ug: sigmas(&state.accel_bias_std, MICRO_G),
    })
}

/// The state of a text, or `:line:column: line: what is wrong`.
///
/// # Errors
/// As it says.
pub fn parse(text: &str) -> Result<StoredState, String> {
    let contents: Contents = toml::from_str(text).map_err(|fault| {
        let at = fault.span().map_or(0, |span| span.start);
        let before = text.get(..at).unwrap_or(text);
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        let line = before.matches('\n').count() + 1;
        let column = before[start..].chars().count() + 1;
        let source = text[start..].lines().next().unwrap_or("").trim();
        format!(":{line}:{column}: {source}: {}", fault.message().trim())
    })?;
    let (place, angles, std) = (&contents.position, &contents.attitude, &contents.attitude_std);
    let triple = |t: &Triple, unit: f64| Vector3::new(t.forward, t.starboard, t.down) * unit;
    let sigmas = |t: &Sigmas, unit: f64| Vector3::new(t.forward, t.starboard, t.down) * unit;
    Ok(StoredState {
        time: Time::from_seconds(contents.t_s),
        moored: contents.moored,
        imu: contents.imu_fingerprint,
        position: Geodetic::from_degrees(place.lat_deg, place.lon_deg, place.height_m),
        position_std: place.std_m,
        attitude: Attitude {
            roll: angles.roll_deg * DEG,
            pitch: angles.pitch_deg * DEG,
            heading: wrap_two_pi(angles.heading_deg * DEG),
        },
        attitude_std: Vector3::new(std.roll_deg, std.pitch_deg, std.heading_deg) * DEG,
        gyro_bias: triple(&contents.gyro_bias_deg_h, DEG_PER_HOUR),
        gyro_bias_std: sigmas(&contents.gyro_bias_std_deg_h, DEG_PER_HOUR),
        accel_bias: triple(&contents.accel_bias_ug, MICRO_G),
        accel_bias_std: sigmas(&contents.accel_bias_std_ug, MICRO_G),
        sway_std: contents.sway_std_m,
    })
}

fn version<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
    let found = u64::deserialize(from)?;
    let expected = || D::Error::custom(format!("version {found} is not known, expected {VERSION}"));
    if found == VERSION { Ok(found) } else { Err(expected()) }
}

fn fingerprint<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
    let word = String::deserialize(from)?;
    let expected = || D::Error::custom("expected 16 hexadecimal digits in quotes");
    if word.len() != 16 {
        return Err(expected());
    }
    u64::from_str_radix(&word, 16).map_err(|_| expected())
}

#[expect(clippy::pedantic, reason = "serde asks for a reference")]
fn hexadecimal<S: serde::Serializer>(value: &u64, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&format!("{value:016x}"))
}

fn ranged<'de, D: Deserializer<'de>>(from: D, range: RangeInclusive<f64>) -> Result<f64, D::Error> {
    let value = f64::deserialize(from)?;
    if range.contains(&value) {
        return Ok(value);
    }
    let (low, high) = (range.start(), range.end());
    Err(D::Error::custom(format!("expected a number from {low} to {high}")))
}

/// One reader for each range, by name.
macro_rules! ranges {
    ($($name:ident: $range:expr;)*) => {
        $(fn $name<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
            ranged(from, $range)
        })*
    };
}

ranges! {
    time: -1e9..=1e9;
    latitude: -90.0..=90.0;
    longitude: -180.0..=180.0;
    height: -12_000.0..=100_000.0;
    length: 0.0..=1e4;
    half_turn: -180.0..=180.0;
    quarter_turn: -90.0..=90.0;
    full_turn: 0.0..=360.0;
    angle_std: 1e-9..=180.0;
    bias: -1e9..=1e9;
    bias_std: 0.0..=1e9;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state() -> StoredState {
        StoredState {
            time: Time::from_seconds(1799.5),
            moored: true,
            imu: 0x00f1_e2d3_c4b5_a697,
            position: Geodetic::from_degrees(-35.123_456_789, 179.987_654_321, 20.25),
            position_std: 0.31,
            attitude: Attitude { roll: 0.011, pitch: -0.007, heading: 6.1 },
            attitude_std: Vector3::new(1e-4, 2e-4, 9.5e-4),
            gyro_bias: Vector3::new(4.8e-8, -1.7e-8, 3e-9),
            gyro_bias_std: Vector3::new(4e-8, 4e-8, 4e-8),
            accel_bias: Vector3::new(1e-4, -2e-4, 3e-4),
            accel_bias_std: Vector3::new(2e-4, 2e-4, 1e-5),
            sway_std: 0.42,
        }
    }

    fn written() -> String {
        text(&state(), "2026-01-01T00:00:00Z").unwrap()
    }

    #[test]
    fn a_state_survives_its_file() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("state.toml");
        write(&path, &state(), "2026-01-01T00:00:00Z").unwrap();
        let (back, state) = (read(&path).unwrap(), state());
        assert_eq!((back.time, back.moored, back.imu), (state.time, true, state.imu));
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-14 * b.abs(), "{a} {b}");
        near(back.attitude.heading, state.attitude.heading);
        near(back.position.longitude, state.position.longitude);
        near(back.position.latitude, state.position.latitude);
        for i in 0..3 {
            near(back.attitude_std[i], state.attitude_std[i]);
            near(back.gyro_bias[i], state.gyro_bias[i]);
            near(back.gyro_bias_std[i], state.gyro_bias_std[i]);
            near(back.accel_bias[i], state.accel_bias[i]);
            near(back.accel_bias_std[i], state.accel_bias_std[i]);
        }
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_second_file_is_the_same_as_the_first() {
        let back = parse(&written()).unwrap();
        let again = parse(&text(&back, "2026-01-01T00:00:00Z").unwrap()).unwrap();
        assert!((again.attitude.heading - back.attitude.heading).abs() < 1e-15);
    }

    #[test]
    fn a_damaged_file_is_refused_with_line_field_and_what_was_expected() {
        for (from, to, wanted) in [
            (
                "version = 1",
                "version = 2",
                ":1:11: version = 2: version 2 is not known, expected 1",
            ),
            ("moored = true", "moored = 7", "expected a boolean"),
            ("lat_deg = -", "lat_deg = -1", "expected a number from -90 to 90"),
            ("std_m = 0.31", "std_m = nan", "expected a number from 0 to 10000"),
            ("imu_fingerprint = \"00", "imu_fingerprint = \"", "16 hexadecimal digits"),
            ("height_m", "hight_m", "unknown field `hight_m`"),
            ("[attitude_std]", "[attitude_st", "unclosed table"),
            ("height_m = 20.25\n", "", "missing field `height_m`"),
        ] {
            let text = written();
            assert!(text.contains(from), "{from}: {text}");
            let message = parse(&text.replacen(from, to, 1)).unwrap_err();
            assert!(message.contains(wanted), "{message}");
        }
    }

    #[test]
    fn no_cut_of_a_file_makes_the_reader_panic_or_believe_it() {
        let text = written();
        let last = text.trim_end().rfind('=').unwrap();
        for end in 0..last {
            assert!(parse(&text[..end]).is_err(), "{end}");
        }
    }
}
