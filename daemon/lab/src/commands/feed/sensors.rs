//! Which sensors the simulated ship has, and what they speak.

use std::str::FromStr;

use insd_intake::config::Kind;
use insd_simulator::feed::Encoding;
use serde::Deserialize;
use serde::de::IntoDeserializer;
use serde::de::value::Error;

use super::voyage::Found;

/// A sensor on a terminal of its own.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sensor {
    /// Name of its link.
    pub(super) name: String,
    /// What a configuration calls its kind.
    pub(super) word: String,
    /// Its format.
    pub(super) encoding: Encoding,
}

impl FromStr for Sensor {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, word) = text.split_once('=').ok_or("expected NAME=KIND")?;
        let sound = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if name.is_empty() || !name.chars().all(sound) {
            return Err("expected a name of letters, digits, - and _".to_owned());
        }
        let deserializer: serde::de::value::StrDeserializer<'_, Error> = word.into_deserializer();
        let kind = Kind::deserialize(deserializer).map_err(|fault| fault.to_string())?;
        let encoding = Encoding::of(kind).ok_or("a kind that is not simulated on a serial line")?;
        Ok(Sensor { name: name.to_owned(), word: word.to_owned(), encoding })
    }
}

/// Whether a camera is among the sensors that are asked for, or may be among the usual ones.
pub(super) fn may_see(asked: &[Sensor]) -> bool {
    asked.is_empty() || asked.iter().any(|sensor| sensor.encoding == Encoding::Tracks)
}

/// The sensors that are asked for, or the usual ones as far as the voyage has them.
pub(super) fn chosen(asked: &[Sensor], found: &Found) -> Vec<Sensor> {
    if !asked.is_empty() {
        return asked.to_vec();
    }
    let sensor = |name: &str, word: &str, encoding| Sensor {
        name: name.to_owned(),
        word: word.to_owned(),
        encoding,
    };
    let voyage = &found.voyage;
    let usual = [
        (!voyage.imu.is_empty(), sensor("imu", "sbg", Encoding::Sbg)),
        (!voyage.gnss.is_empty(), sensor("gnss", "ubx", Encoding::Ubx)),
        (!voyage.log.is_empty(), sensor("log", "nmea_log", Encoding::Vbw)),
        (!found.frames.is_empty(), sensor("camera", "camera", Encoding::Tracks)),
    ];
    usual.into_iter().filter(|(present, _)| *present).map(|(_, sensor)| sensor).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_are_made_where_a_camera_may_be_asked_for() {
        let asked = |words: &[&str]| -> Vec<Sensor> {
            words.iter().map(|word| word.parse().unwrap()).collect()
        };
        assert!(may_see(&[]) && may_see(&asked(&["imu=sbg", "eye=camera"])));
        assert!(!may_see(&asked(&["imu=sbg", "gnss=ubx"])));
    }

    #[test]
    fn a_sensor_is_named_as_in_a_configuration() {
        let sensor: Sensor = "imu=stim".parse().unwrap();
        assert_eq!((sensor.name.as_str(), sensor.encoding), ("imu", Encoding::Stim));
        assert!("imu=sgb".parse::<Sensor>().unwrap_err().contains("sgb"));
        for wrong in ["imu", "=sbg", "../imu=sbg", "imu=n2k_gnss"] {
            assert!(wrong.parse::<Sensor>().is_err(), "{wrong}");
        }
    }
}
