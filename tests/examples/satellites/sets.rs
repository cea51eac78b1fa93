//! The sets, and where their antennas were.

use std::error::Error;
use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::read::GzDecoder;
use insd_base::{Geodetic, GpsTime, SatelliteEpoch, earth};
use insd_gnss::Context;
use insd_rinex::{ObservationReader, read_navigation};
use nalgebra::Vector3;

/// A receiver's file with what is used of it.
pub(crate) struct Set {
    pub(crate) label: &'static str,
    observations: &'static str,
    navigation: &'static [&'static str],
    /// ECEF, m; `None`: `reference.csv` beside the observations.
    place: Option<[f64; 3]>,
    constellations: &'static str,
    /// All unless some are named.
    bands: &'static [u8],
    /// Horizontal RMS of RTKLIB 2.4.3 b34 on L1, of the set's `reference.json`, m.
    pub(crate) rtklib_m: f64,
    /// The best of plain least squares on differences, of the same, mm.
    pub(crate) plain_mm: Option<f64>,
}

const MOVING: Set = Set {
    label: "moving-5km, GEJ, all",
    observations: "moving-5km/SEPT265G.21O.gz",
    navigation: &["moving-5km/SEPT2650.21P"],
    place: None,
    constellations: "GEJ",
    bands: &[],
    rtklib_m: 1.914,
    plain_mm: Some(26.0),
};
const PAIR: Set = Set {
    label: "pair-1m, GEJ, all",
    observations: "pair-1m/rover.obs.gz",
    navigation: &["pair-1m/base.nav"],
    place: Some([-3_817_681.380_7, 3_562_839.978_5, 3_650_158.376]),
    constellations: "GEJ",
    bands: &[],
    rtklib_m: 1.911,
    plain_mm: Some(24.0),
};
const WETTZELL: Set = Set {
    label: "common-clock-1p6m WTZR, GE, all",
    observations: "common-clock-1p6m/WTZR00DEU_R_20201770000_01D_30S_MO_120epoch.rnx.gz",
    navigation: &[
        "common-clock-1p6m/ESBC00DNK_R_20201770000_01D_MN.rnx.gz",
        "common-clock-1p6m/ESBC00DNK_R_20201770000_01D_RN.rnx",
    ],
    place: Some([4_075_580.356_4, 931_854.064_7, 4_801_568.334_5]),
    constellations: "GE",
    bands: &[],
    rtklib_m: 1.787,
    plain_mm: None,
};
const GEONET: Set = Set {
    label: "geonet-3km, G, L1 and L2",
    observations: "geonet-3km/07590920.05o",
    navigation: &["geonet-3km/07590920.05n", "geonet-3km/30400920.05n"],
    place: Some([-3_976_219.187_1, 3_382_371.603_6, 3_652_511.140_9]),
    constellations: "G",
    bands: &[],
    rtklib_m: 1.245,
    plain_mm: None,
};

/// All that the table shows.
pub(crate) const SETS: [Set; 10] = [
    MOVING,
    Set { label: "moving-5km, GEJ, L1", bands: &[1], ..MOVING },
    PAIR,
    Set { label: "pair-1m, GEJ, L1", bands: &[1], plain_mm: Some(30.0), ..PAIR },
    Set { label: "pair-1m, GECJ, all", constellations: "GECJ", plain_mm: Some(15.0), ..PAIR },
    Set { label: "pair-1m, GRECJ, all", constellations: "GRECJ", plain_mm: Some(15.0), ..PAIR },
    WETTZELL,
    Set { label: "common-clock-1p6m WTZR, GREC, all", constellations: "GREC", ..WETTZELL },
    GEONET,
    Set { label: "geonet-3km, G, L1", bands: &[1], ..GEONET },
];

/// Where an antenna was, instant by instant, or always.
pub(crate) enum Whereabouts {
    Always(Vector3<f64>),
    Rows(Vec<(i64, Vector3<f64>)>),
}

impl Whereabouts {
    /// ECEF, m.
    pub(crate) fn at(&self, tag: GpsTime) -> Option<Vector3<f64>> {
        let Self::Rows(rows) = self else {
            let Self::Always(place) = self else { return None };
            return Some(*place);
        };
        // tags are within a millisecond of the second
        let second = (tag.to_week().1 + 500_000_000) / 1_000_000_000;
        rows.iter().find(|(own, _)| *own == second).map(|(_, place)| *place)
    }
}

impl Set {
    pub(crate) fn context(&self, folder: &Path) -> Result<Context, Box<dyn Error>> {
        let mut context = Context::default();
        for name in self.navigation {
            let told = read_navigation(&read(&folder.join(name))?)?;
            for record in told.records {
                context.ephemerides.insert(record).map_err(|refusal| refusal.to_string())?;
            }
            context.ionosphere.extend(told.ionosphere);
        }
        Ok(context)
    }

    pub(crate) fn epochs(&self, folder: &Path) -> Result<Vec<SatelliteEpoch>, Box<dyn Error>> {
        let text = read(&folder.join(self.observations))?;
        let mut epochs: Vec<_> = ObservationReader::new(&text)?.flatten().collect();
        for epoch in &mut epochs {
            epoch.signals.retain(|signal| {
                self.constellations.contains(signal.satellite.constellation.letter())
                    && (self.bands.is_empty() || self.bands.contains(&signal.signal.band))
            });
        }
        Ok(epochs)
    }

    pub(crate) fn truth(&self, folder: &Path) -> Result<Whereabouts, Box<dyn Error>> {
        if let Some(place) = self.place {
            return Ok(Whereabouts::Always(Vector3::from(place)));
        }
        let observations = folder.join(self.observations);
        let mut reader = csv::Reader::from_path(observations.with_file_name("reference.csv"))?;
        let head = reader.headers()?.clone();
        let column = |name: &str| {
            head.iter().position(|own| own == name).ok_or(format!("reference.csv: no {name}"))
        };
        let columns = ["tow_s", "lat_deg", "lon_deg", "h_m"].map(column);
        let mut rows = Vec::new();
        for row in reader.records() {
            let row = row?;
            let mut values = [0.0; 4];
            for (value, column) in values.iter_mut().zip(&columns) {
                *value = row[column.clone()?].parse()?;
            }
            let [tow, latitude, longitude, height] = values;
            let place = earth::ecef(&Geodetic::from_degrees(latitude, longitude, height)).0;
            rows.push((tow.round() as i64, place));
        }
        Ok(Whereabouts::Rows(rows))
    }
}

fn read(path: &Path) -> Result<Vec<u8>, Box<dyn Error>> {
    let bytes = fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    if path.extension().is_none_or(|extension| extension != "gz") {
        return Ok(bytes);
    }
    let mut text = Vec::new();
    GzDecoder::new(bytes.as_slice()).read_to_end(&mut text)?;
    Ok(text)
}
