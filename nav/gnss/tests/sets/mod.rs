//! Pairs of real receivers whose places are known, in the folder that `INSD_RAW_GNSS` names: docs/rtk.md says which they are.

#![allow(dead_code)] // each user needs some of it
#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::path::{Path, PathBuf};
use std::process::Command;

use insd_base::{Geodetic, GpsTime, SatelliteEpoch, earth};
use insd_gnss::Context;
use insd_rinex::{ObservationReader, read_navigation};
use nalgebra::Vector3;

/// Two receivers.
#[derive(Clone, Copy)]
pub(crate) struct Pair {
    pub(crate) label: &'static str,
    pub(crate) rover: &'static str,
    pub(crate) base: &'static str,
    pub(crate) navigation: &'static [&'static str],
    /// ECEF, m.
    pub(crate) base_at: [f64; 3],
    /// ECEF, m; `None`: `reference.csv` beside the rover's observations.
    pub(crate) rover_at: Option<[f64; 3]>,
    pub(crate) constellations: &'static str,
    /// Bands that are used, all if none is named; of BeiDou's B1I the band is 2.
    pub(crate) bands: &'static [u8],
}

pub(crate) const MOVING: Pair = Pair {
    label: "moving-5km, GEJ, L1 and L2",
    rover: "moving-5km/SEPT265G.21O.gz",
    base: "moving-5km/3034265G.21O.gz",
    navigation: &["moving-5km/SEPT2650.21P"],
    base_at: [-3_959_400.631, 3_385_704.533, 3_667_523.111],
    rover_at: None,
    constellations: "GEJ",
    bands: &[1, 2, 7],
};
pub(crate) const NEAR: Pair = Pair {
    label: "pair-1m, GECJ, L1",
    rover: "pair-1m/rover.obs.gz",
    base: "pair-1m/base.obs.gz",
    navigation: &["pair-1m/base.nav"],
    base_at: [-3_817_681.121_3, 3_562_839.431_1, 3_650_159.159_3],
    rover_at: Some([-3_817_681.380_7, 3_562_839.978_5, 3_650_158.376]),
    constellations: "GECJ",
    bands: &[1],
};
pub(crate) const WETTZELL: Pair = Pair {
    label: "common-clock-1p6m, G, L1",
    rover: "common-clock-1p6m/WTZZ00DEU_R_20201770000_01D_30S_MO_120epoch.rnx.gz",
    base: "common-clock-1p6m/WTZR00DEU_R_20201770000_01D_30S_MO_120epoch.rnx.gz",
    navigation: &[
        "common-clock-1p6m/ESBC00DNK_R_20201770000_01D_MN.rnx.gz",
        "common-clock-1p6m/ESBC00DNK_R_20201770000_01D_RN.rnx",
    ],
    base_at: [4_075_580.356_4, 931_854.064_7, 4_801_568.334_5],
    rover_at: Some([4_075_579.372_4, 931_853.411, 4_801_569.404_5]),
    constellations: "G",
    bands: &[1],
};
pub(crate) const GEONET: Pair = Pair {
    label: "geonet-3km, G, L1 and L2",
    rover: "geonet-3km/07590920.05o",
    base: "geonet-3km/30400920.05o",
    navigation: &["geonet-3km/07590920.05n", "geonet-3km/30400920.05n"],
    base_at: [-3_978_241.958, 3_382_840.234, 3_649_900.853],
    rover_at: Some([-3_976_219.187_1, 3_382_371.603_6, 3_652_511.140_9]),
    constellations: "G",
    bands: &[1, 2],
};

/// All that are shown.
pub(crate) const PAIRS: [Pair; 13] = [
    MOVING,
    Pair { label: "moving-5km, GEJ, L1", bands: &[1], ..MOVING },
    Pair { label: "moving-5km, GEJ, L1 and L5", bands: &[1, 5], ..MOVING },
    Pair { label: "moving-5km, GEJ, all", bands: &[], ..MOVING },
    NEAR,
    Pair { label: "pair-1m, G, L1", constellations: "G", ..NEAR },
    Pair { label: "pair-1m, GECJ, all", bands: &[], ..NEAR },
    WETTZELL,
    Pair { label: "common-clock-1p6m, GE, L1", constellations: "GE", ..WETTZELL },
    Pair {
        label: "common-clock-1p6m, GE, L1 and L2",
        constellations: "GE",
        bands: &[1, 2, 7],
        ..WETTZELL
    },
    Pair { label: "common-clock-1p6m, GEC, all", constellations: "GEC", bands: &[], ..WETTZELL },
    GEONET,
    Pair { label: "geonet-3km, G, L1", bands: &[1], ..GEONET },
];

/// The folder of the sets, if one is named.
pub(crate) fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("INSD_RAW_GNSS").map(PathBuf::from);
    if folder.is_none() {
        println!("skipped: INSD_RAW_GNSS names no folder");
    }
    folder
}

/// An epoch of the rover, that of the base nearest to it, and where the rover was, ECEF, m.
pub(crate) struct Moment {
    pub(crate) rover: SatelliteEpoch,
    pub(crate) base: SatelliteEpoch,
    pub(crate) truth: Option<Vector3<f64>>,
}

impl Pair {
    pub(crate) fn context(&self, folder: &Path) -> Context {
        let mut context = Context::default();
        for name in self.navigation {
            let told = read_navigation(&contents(&folder.join(name))).unwrap();
            for record in told.records {
                context.ephemerides.insert(record).unwrap();
            }
            context.ionosphere.extend(told.ionosphere);
        }
        context
    }

    pub(crate) fn moments(&self, folder: &Path) -> Vec<Moment> {
        let base = self.epochs(&folder.join(self.base));
        let truth = self.truth(folder);
        let with_base = |rover: SatelliteEpoch| {
            let apart =
                |other: &&SatelliteEpoch| rover.tag.since(other.tag).as_nanos().unsigned_abs();
            let base = base.iter().min_by_key(apart)?.clone();
            let truth = truth.at(rover.tag);
            Some(Moment { rover, base, truth })
        };
        self.epochs(&folder.join(self.rover)).into_iter().filter_map(with_base).collect()
    }

    fn epochs(&self, path: &Path) -> Vec<SatelliteEpoch> {
        let text = contents(path);
        let mut epochs: Vec<_> = ObservationReader::new(&text).unwrap().flatten().collect();
        for epoch in &mut epochs {
            epoch.signals.retain(|signal| {
                let constellation = signal.satellite.constellation;
                let first =
                    constellation == insd_base::Constellation::BeiDou && signal.signal.band == 2;
                let band = if first { 1 } else { signal.signal.band };
                self.constellations.contains(constellation.letter())
                    && (self.bands.is_empty() || self.bands.contains(&band))
            });
        }
        epochs
    }

    fn truth(&self, folder: &Path) -> Truth {
        if let Some(place) = self.rover_at {
            return Truth::Always(Vector3::from(place));
        }
        let text = std::fs::read_to_string(folder.join(self.rover).with_file_name("reference.csv"));
        let text = text.unwrap();
        let mut lines = text.lines();
        let head: Vec<_> = lines.next().unwrap().split(',').collect();
        let columns = ["tow_s", "lat_deg", "lon_deg", "h_m"]
            .map(|name| head.iter().position(|own| *own == name).unwrap());
        let row = |line: &str| {
            let cells: Vec<_> = line.split(',').collect();
            let [tow, latitude, longitude, height] =
                columns.map(|column| cells[column].parse::<f64>().unwrap());
            let place = Geodetic::from_degrees(latitude, longitude, height);
            (tow.round() as i64, earth::ecef(&place).0)
        };
        Truth::Rows(lines.map(row).collect())
    }
}

/// Where the rover was.
enum Truth {
    Always(Vector3<f64>),
    Rows(Vec<(i64, Vector3<f64>)>),
}

impl Truth {
    fn at(&self, tag: GpsTime) -> Option<Vector3<f64>> {
        match self {
            Self::Always(place) => Some(*place),
            Self::Rows(rows) => {
                // tags are within a millisecond of the second
                let second = (tag.to_week().1 + 500_000_000) / 1_000_000_000;
                rows.iter().find(|(own, _)| *own == second).map(|(_, place)| *place)
            }
        }
    }
}

fn contents(path: &Path) -> Vec<u8> {
    if path.extension().is_some_and(|extension| extension == "gz") {
        return Command::new("gzip").arg("-dc").arg(path).output().unwrap().stdout;
    }
    std::fs::read(path).unwrap()
}

/// The horizontal part of what lies off a place, m.
pub(crate) fn horizontal(at: &Vector3<f64>, off: &Vector3<f64>) -> f64 {
    (earth::c_ne(&earth::geodetic(&insd_base::Ecef(*at))) * off).xy().norm()
}

/// The vertical part, m, down.
pub(crate) fn vertical(at: &Vector3<f64>, off: &Vector3<f64>) -> f64 {
    (earth::c_ne(&earth::geodetic(&insd_base::Ecef(*at))) * off).z
}
