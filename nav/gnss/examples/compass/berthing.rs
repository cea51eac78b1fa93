//! A made-up ship on her way to the berth with four antennas, by how many satellites are in sight: `berthing-4ant` of the folder that `INSD_VOYAGES` names.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use insd_base::units::wrap_pi;
use insd_base::{Attitude, Geodetic, SatelliteEpoch, earth};
use insd_gnss::{
    AttitudePrior, CompassArray, CompassPrior, CompassSettings, CompassTracker, Context,
};
use insd_rinex::{ObservationReader, read_navigation};
use nalgebra::{Matrix3, Vector3};

use crate::random::Random;

const HEAD: &str = "| segment | epochs | told | roll RMS, deg | pitch | heading | limit with IMU: roll | pitch | heading |\n|---|---|---|---|---|---|---|---|---|\n";

/// From and to, s, what the voyage calls it, and the 1-sigmas of roll, pitch and heading that no filter with its IMU is better than (`limit.json`), deg.
const SEGMENTS: [(f64, f64, &str, [f64; 3]); 7] = [
    (0.0, 120.0, "first two minutes", [f64::NAN; 3]),
    (120.0, 210.0, "open", [0.051, 0.051, 0.291]),
    (240.0, 300.0, "5", [0.043, 0.045, 0.255]),
    (330.0, 390.0, "4", [0.042, 0.043, 0.246]),
    (420.0, 480.0, "3", [0.037, 0.036, 0.266]),
    (510.0, 570.0, "2", [0.035, 0.038, 0.270]),
    (600.0, 660.0, "1", [0.037, 0.037, 0.263]),
];

pub(crate) fn table() -> String {
    let mut table = String::from(HEAD);
    let Some(folder) = std::env::var_os("INSD_VOYAGES") else {
        println!("skipped: INSD_VOYAGES names no folder");
        return table;
    };
    let voyage = Voyage::read(&Path::new(&folder).join("berthing-4ant"));
    let errors = voyage.sailed();
    for (from, to, label, limit) in SEGMENTS {
        let within = errors.iter().filter(|(t, _)| (from..to).contains(t));
        let all: Vec<_> = within.map(|(_, own)| own).collect();
        let told: Vec<_> = all.iter().filter_map(|own| own.as_ref()).collect();
        let rms = |axis: usize| {
            let squares: f64 = told.iter().map(|own| own[axis].powi(2)).sum();
            (squares / told.len().max(1) as f64).sqrt().to_degrees()
        };
        let _ = write!(table, "| {label} | {} | {} |", all.len(), told.len());
        let _ = match told.is_empty() {
            true => write!(table, " | | |"),
            false => write!(table, " {:.2} | {:.2} | {:.2} |", rms(0), rms(1), rms(2)),
        };
        for own in limit {
            let _ = match own.is_finite() {
                true => write!(table, " {own:.3} |"),
                false => write!(table, " |"),
            };
        }
        table.push('\n');
    }
    table
}

struct Voyage {
    context: Context,
    /// Of each antenna its epochs, by seconds since the start.
    epochs: Vec<BTreeMap<i64, SatelliteEpoch>>,
    /// Attitude and place, by tenths of a second since the start.
    truth: BTreeMap<i64, (Attitude, Vector3<f64>, Vector3<f64>)>,
}

impl Voyage {
    fn read(folder: &Path) -> Self {
        let mut context = Context::default();
        let told = read_navigation(&unpacked(&folder.join("raw/nav.rnx.zst"))).unwrap();
        for record in told.records {
            let _ = context.ephemerides.insert(record);
        }
        context.ionosphere.extend(told.ionosphere);
        let start = insd_base::UtcTime::from_civil((2026, 1, 1), (0, 0, 0), 0).unwrap().to_gps();
        let epochs = (1..=4).map(|antenna| {
            let text = unpacked(&folder.join(format!("raw/a{antenna}.obs.zst")));
            let all = ObservationReader::new(&text).unwrap().flatten();
            let timed =
                |own: SatelliteEpoch| (own.tag.since(start).as_seconds().round() as i64, own);
            all.map(timed).collect()
        });
        let epochs = epochs.collect();
        let text = String::from_utf8(unpacked(&folder.join("truth.csv.zst"))).unwrap();
        let row = |line: &str| {
            let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
            let [t, lat, lon, height, vn, ve, vd, roll, pitch, heading] = cells[..] else {
                return None;
            };
            let place = Geodetic::from_degrees(lat, lon, height);
            let velocity = earth::c_ne(&place).transpose() * Vector3::new(vn, ve, vd);
            let [roll, pitch, heading] = [roll, pitch, heading].map(f64::to_radians);
            let attitude = Attitude { roll, pitch, heading };
            Some(((t * 10.0).round() as i64, (attitude, earth::ecef(&place).0, velocity)))
        };
        Self { context, epochs, truth: text.lines().skip(1).filter_map(row).collect() }
    }

    /// Errors of each epoch, rad; an IMU that levels to half a degree and tells turns goes along.
    fn sailed(&self) -> Vec<(f64, Option<[f64; 3]>)> {
        let corner = |x: f64, y: f64| Vector3::new(x, y, -14.0);
        let levers = vec![
            corner(-5.95, -0.85),
            corner(-5.95, -0.75),
            corner(-6.05, -0.75),
            corner(-6.05, -0.85),
        ];
        let mut compass =
            CompassTracker::new(CompassArray::on_one_clock(levers), CompassSettings::default());
        let mut random = Random(11);
        let mut before: Option<Matrix3<f64>> = None;
        let mut errors = Vec::new();
        for (second, first) in &self.epochs[0] {
            let Some((attitude, place, velocity)) = self.truth.get(&(second * 10)) else {
                continue;
            };
            let others = self.epochs[1..].iter().map(|own| own.get(second));
            let epochs: Vec<_> = std::iter::once(Some(first)).chain(others).collect();
            let level = 0.5_f64.to_radians();
            let known = Attitude {
                roll: attitude.roll + level * random.gauss(),
                pitch: attitude.pitch + level * random.gauss(),
                heading: 0.0,
            };
            let c_nb = attitude.c_nb();
            let prior = CompassPrior {
                antenna: Some(*place),
                velocity: Some(*velocity),
                attitude: Some(AttitudePrior {
                    c_nb: known.c_nb(),
                    std: Vector3::new(level, level, f64::INFINITY),
                }),
                turn: before.map(|before| before.transpose() * c_nb),
            };
            before = Some(c_nb);
            let told = compass.take(&self.context, &epochs, &prior);
            let fix = told.told.ok().and_then(|fix| fix.attitude());
            let off = fix.map(|(own, _)| {
                let off = [
                    own.roll - attitude.roll,
                    own.pitch - attitude.pitch,
                    own.heading - attitude.heading,
                ];
                off.map(wrap_pi)
            });
            if !told.faults.is_empty() {
                eprintln!("{second} s: {:?}", told.faults);
            }
            errors.push((*second as f64, off));
        }
        errors
    }
}

fn unpacked(path: &Path) -> Vec<u8> {
    Command::new("zstd").arg("-dc").arg(path).output().unwrap().stdout
}
