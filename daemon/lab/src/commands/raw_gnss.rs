//! Simulated raw GNSS as the text of files.

use insd_base::earth::ecef;
use insd_base::satellites::{Constellation, SatelliteEpoch};
use insd_drivers::recording::RawFiles;
use insd_rinex::{Equipment, ObservationHeader, write_navigation, write_observations};
use insd_simulator::{RawBaseStation, RawGnss, RawSpec};
use serde::Serialize;

/// GPS - UTC, s, in all simulated voyages.
const LEAP_SECONDS: i8 = 18;

/// The tables of `voyage.toml`.
#[derive(Debug, Serialize)]
struct Tables<'a> {
    raw: &'a RawSpec,
    base: Option<BaseTable>,
}

/// The table `[base]`.
#[derive(Debug, Serialize)]
struct BaseTable {
    lat_deg: f64,
    lon_deg: f64,
    height_m: f64,
}

impl From<&RawBaseStation> for BaseTable {
    fn from(base: &RawBaseStation) -> Self {
        BaseTable {
            lat_deg: base.position.latitude.to_degrees(),
            lon_deg: base.position.longitude.to_degrees(),
            height_m: base.position.height,
        }
    }
}

/// The files of the raw GNSS of a voyage.
///
/// # Errors
/// Something in it cannot be written as TOML or JSON.
pub(super) fn files(raw: &RawGnss) -> anyhow::Result<RawFiles> {
    let rate = raw.spec.rate_hz;
    let antenna = |(number, epochs): (usize, &Vec<SatelliteEpoch>)| {
        write_observations(&header(&format!("a{number}"), rate, None), epochs)
    };
    let base = |base: &RawBaseStation| {
        let place = ecef(&base.position).0;
        write_observations(&header("base", rate, Some(place.into())), &base.epochs)
    };
    let surveyed = raw.base.as_ref().filter(|base| base.is_surveyed);
    let tables = Tables { raw: &raw.spec, base: surveyed.map(BaseTable::from) };
    let ionosphere = [(Constellation::Gps, raw.ionosphere)];
    Ok(RawFiles {
        antennas: (1..).zip(&raw.antennas).map(antenna).collect(),
        base: raw.base.as_ref().map(base),
        navigation: write_navigation(&raw.broadcast, &ionosphere, Some(LEAP_SECONDS)),
        truth: Some(serde_json::to_string(&raw.truth)?),
        tables: toml::to_string(&tables)?,
    })
}

fn header(marker: &str, rate: f64, position: Option<[f64; 3]>) -> ObservationHeader {
    let simulated = |kind: &str| Equipment { kind: kind.to_owned(), ..Equipment::default() };
    ObservationHeader {
        receiver: simulated("SIMULATED"),
        antenna: simulated("NONE"),
        position,
        interval: Some(1.0 / rate),
        leap_seconds: Some(LEAP_SECONDS),
        ..ObservationHeader::of_marker(marker)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::BroadcastRecord;
    use insd_rinex::{ObservationReader, read_navigation};
    use insd_simulator::{Scenario, raw_gnss, shipped};

    fn raw() -> RawGnss {
        let text = "name = \"a\"\nmode = \"underway\"\n[start]\nlat_deg = 35.0\nlon_deg = 139.0\n\
                    [[route.legs]]\nheading_deg = 10.0\nspeed_kn = 8.0\nduration_s = 60.0\n[imu]\ngrade = \"mems\"\n\
                    [raw]\nfrequencies = 2\nsky = { constellations = \"GEJC\" }\nslips_per_hour = 20.0\n\
                    base = { lat_deg = 35.01, lon_deg = 139.0, height_m = 40.0 }\n";
        raw_gnss(&Scenario::from_toml(text).unwrap(), 1).unwrap()
    }

    #[test]
    fn what_is_written_is_read_back_as_far_as_the_format_holds_it() {
        let raw = raw();
        let files = files(&raw).unwrap();
        assert_eq!(files.antennas.len(), 1);
        held_against(&files.antennas[0], &raw.antennas[0]);
    }

    #[test]
    fn each_antenna_of_four_is_read_back_from_a_file_of_its_own() {
        let text = shipped().iter().find(|(file, _)| file.starts_with("29")).unwrap().1;
        let scenario = Scenario::from_toml(text).unwrap().with_duration(30.0);
        let raw = raw_gnss(&scenario, 1).unwrap();
        let files = files(&raw).unwrap();
        assert_eq!(files.antennas.len(), 4);
        for (text, made) in files.antennas.iter().zip(&raw.antennas) {
            held_against(text, made);
        }
        let tables: toml::Table = files.tables.parse().unwrap();
        assert_eq!(tables["raw"]["antennas_m"].as_array().map(Vec::len), Some(4));
        assert_eq!(tables["raw"]["common_clock"].as_array().map(Vec::len), Some(4));
    }

    fn held_against(text: &str, made: &[SatelliteEpoch]) {
        let read: Vec<SatelliteEpoch> =
            ObservationReader::new(text).unwrap().map(Result::unwrap).collect();
        assert_eq!(read.len(), made.len());
        for (read, made) in read.iter().zip(made) {
            assert_eq!((read.tag, read.signals.len()), (made.tag, made.signals.len()));
            for made in &made.signals {
                let own = |read: &&insd_base::SignalObservation| {
                    (read.satellite, read.signal) == (made.satellite, made.signal)
                };
                let read = read.signals.iter().find(own).unwrap();
                assert!((read.code.unwrap() - made.code.unwrap()).abs() < 6e-4);
                assert!((read.phase.unwrap() - made.phase.unwrap()).abs() < 6e-4);
                assert!((read.doppler.unwrap() - made.doppler.unwrap()).abs() < 6e-4);
                assert_eq!(read.slip, made.slip);
            }
        }
    }

    #[test]
    fn records_are_read_back_with_all_their_times() {
        let raw = raw();
        let read = read_navigation(&files(&raw).unwrap().navigation).unwrap();
        assert_eq!(read.records.len(), raw.broadcast.len());
        let kepler = |record: &BroadcastRecord| match record {
            BroadcastRecord::Kepler(record) => *record,
            BroadcastRecord::Glonass(_) => panic!(),
        };
        for (read, made) in read.records.iter().map(kepler).zip(raw.broadcast.iter().map(kepler)) {
            assert_eq!(
                (read.satellite, read.kind, read.transmitted),
                (made.satellite, made.kind, made.transmitted)
            );
            assert_eq!(
                (read.orbit.reference, read.clock.reference),
                (made.orbit.reference, made.clock.reference)
            );
            assert_eq!((read.issue, read.health), (made.issue, made.health));
            assert!((read.orbit.m0 - made.orbit.m0).abs() < 1e-11);
        }
    }

    #[test]
    fn the_tables_have_the_keys_of_the_format() {
        let tables: toml::Table = files(&raw()).unwrap().tables.parse().unwrap();
        assert_eq!(tables["raw"]["rate_hz"].as_float(), Some(1.0));
        assert_eq!(tables["raw"]["antennas_m"][0].as_array().map(Vec::len), Some(3));
        assert_eq!(tables["base"]["height_m"].as_float(), Some(40.0));
    }
}
