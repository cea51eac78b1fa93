//! The sky of a replay as a file: `t_s,satellite,azimuth_deg,elevation_deg,cn0_dbhz,state,reason`.

use insd_base::satellites::{SignalStrength, Sky, SkySatellite};
use serde::{Deserialize, Serialize};

/// A satellite of one epoch, and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SkyRow {
    /// When the epoch was sampled, s.
    pub t_s: f64,
    /// Which satellite, as in RINEX.
    pub satellite: String,
    /// From true north, deg, 0 to 360; empty where its orbit or the antenna's place is not known.
    pub azimuth_deg: Option<f64>,
    /// Above the horizon, deg.
    pub elevation_deg: Option<f64>,
    /// The strongest of its signals, dB Hz.
    pub cn0_dbhz: Option<f64>,
    /// What became of it: `used`, `code_only`, `left_out`, `crowded`, `waiting`, `refused`.
    pub state: String,
    /// Why it is not used; empty where it is.
    pub reason: Option<String>,
}

impl SkyRow {
    /// The rows of one epoch.
    pub fn all(sky: &Sky) -> impl Iterator<Item = SkyRow> + '_ {
        sky.satellites.iter().map(|own| SkyRow::of(sky.time.as_seconds(), own))
    }

    /// Whether its ranges are used.
    #[must_use]
    pub fn is_used(&self) -> bool {
        self.state == "used" || self.state == "code_only"
    }

    fn of(t_s: f64, own: &SkySatellite) -> Self {
        let rounded = |angle: f64| (angle.to_degrees() * 100.0).round() / 100.0;
        let cn0 = |signal: &SignalStrength| signal.cn0;
        SkyRow {
            t_s,
            satellite: own.satellite.to_string(),
            // north has one name
            azimuth_deg: own.direction.map(|at| rounded(at.azimuth).rem_euclid(360.0) + 0.0),
            elevation_deg: own.direction.map(|at| rounded(at.elevation)),
            cn0_dbhz: own.signals.iter().filter_map(cn0).reduce(f64::max),
            state: own.fate.as_str().to_owned(),
            reason: own.fate.reason().map(str::to_owned),
        }
    }
}

#[cfg(test)]
mod tests {
    use insd_base::satellites::{LookAngles, RangeRefusal, SatelliteUse};
    use insd_base::{SignalCode, Time};

    use super::*;
    use crate::evaluation::{RowWriter, read_rows};

    fn satellite(name: &str, azimuth: Option<f64>, fate: SatelliteUse) -> SkySatellite {
        let signal = |band, cn0| SignalStrength { signal: SignalCode::new(band, b'C'), cn0 };
        SkySatellite {
            satellite: name.parse().unwrap(),
            direction: azimuth.map(|azimuth| LookAngles { azimuth, elevation: 0.5 }),
            signals: vec![signal(1, Some(41.5)), signal(2, Some(44.0)), signal(5, None)],
            fate,
            is_outlier: false,
        }
    }

    #[test]
    fn a_sky_that_is_written_reads_back() {
        let refused = SatelliteUse::Refused(RangeRefusal::NoCode);
        let satellites = vec![
            satellite("G07", Some(-1e-6), SatelliteUse::Phase),
            satellite("E11", None, refused),
            satellite("C30", Some(1.0), SatelliteUse::LeftOut { since: Time::START }),
        ];
        let sky = Sky { time: Time::from_seconds(1.25), satellites };
        let rows: Vec<SkyRow> = SkyRow::all(&sky).collect();
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("sky.csv");
        let mut writer = RowWriter::new(std::fs::File::create(&path).unwrap());
        rows.iter().for_each(|row| writer.write(row).unwrap());
        writer.finish().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains("\n1.25,G07,0.0,28.65,44.0,used,\n"), "{text}");
        assert!(text.contains("\n1.25,E11,,,44.0,refused,no_code\n"), "{text}");
        assert_eq!(read_rows::<SkyRow>(&path).unwrap(), rows);
        assert_eq!(rows.iter().filter(|row| row.is_used()).count(), 1);
    }
}
