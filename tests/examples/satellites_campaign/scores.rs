//! A solution against the truth, segment by segment.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::Path;

use insd_base::earth;

/// What is known of one instant: latitude, longitude and heading, degrees, and of a solution the 1-sigmas north and east, m.
#[derive(Clone, Copy)]
pub(crate) struct Row {
    latitude: f64,
    longitude: f64,
    heading: f64,
    stds: [f64; 2],
}

/// Labels and spans, s.
pub(crate) type Segments = Vec<(String, [f64; 2])>;

/// Errors north and east, m, of the heading, degrees, and the claimed 1-sigmas of the first two.
struct Errors {
    place: [f64; 2],
    heading: f64,
    stds: [f64; 2],
}

/// A track by its times in milliseconds.
pub(crate) type Track = BTreeMap<i64, Row>;

/// How a solution stood in a segment.
#[derive(Clone, Copy)]
pub(crate) struct Score {
    /// RMS of the horizontal error since the first row of the segment, m.
    pub(crate) moved: f64,
    /// Mean of the squares of the errors north and east over their sigmas: one, if they are claimed honestly.
    pub(crate) nees: f64,
    /// RMS of the heading's error, degrees.
    pub(crate) heading: f64,
}

/// Reads a truth, or the rows of a solution that say everything.
pub(crate) fn track(path: &Path, is_solution: bool) -> Result<Track, Box<dyn Error>> {
    let mut reader = csv::Reader::from_path(path)?;
    let head = reader.headers()?.clone();
    let column = |name: &str| {
        let missing = || format!("{}: no {name}", path.display());
        head.iter().position(|own| own == name).ok_or_else(missing)
    };
    let stds = if is_solution { [column("std_n_m")?, column("std_e_m")?] } else { [0, 0] };
    let [time, latitude, longitude, heading] =
        [column("t_s")?, column("lat_deg")?, column("lon_deg")?, column("heading_deg")?];
    let mut track = Track::new();
    for row in reader.records() {
        let row = row?;
        let value = |column: usize| row[column].parse::<f64>().ok();
        let read = || {
            Some(Row {
                latitude: value(latitude)?,
                longitude: value(longitude)?,
                heading: value(heading)?,
                stds: [value(stds[0])?, value(stds[1])?],
            })
        };
        let time = value(time).ok_or("a row without a time")?;
        track.extend(read().map(|row| ((time * 1e3).round() as i64, row)));
    }
    Ok(track)
}

/// Labels and spans, s, of a voyage's `truth.json`.
pub(crate) fn segments(path: &Path) -> Result<Segments, Box<dyn Error>> {
    let truth: serde_json::Value = serde_json::from_str(&fs::read_to_string(path)?)?;
    let segments = truth["segments"].as_array().ok_or("truth.json: no segments")?;
    let segment = |segment: &serde_json::Value| {
        let label = segment["label"].as_str()?.to_owned();
        Some((label, [segment["t0_s"].as_f64()?, segment["t1_s"].as_f64()?]))
    };
    Ok(segments.iter().filter_map(segment).collect())
}

/// The score in a segment; `None` where the solution says nothing in it.
pub(crate) fn score(solution: &Track, truth: &Track, [from, to]: [f64; 2]) -> Option<Score> {
    let within = (from * 1e3).round() as i64..(to * 1e3).round() as i64;
    let errors: Vec<Errors> = solution
        .range(within)
        .filter_map(|(time, row)| truth.get(time).map(|truth| error(row, truth)))
        .collect();
    let first = errors.first()?.place;
    let mean =
        |of: &dyn Fn(&Errors) -> f64| errors.iter().map(of).sum::<f64>() / errors.len() as f64;
    let square = |pair: [f64; 2]| pair[0] * pair[0] + pair[1] * pair[1];
    let moved = mean(&|own| square([own.place[0] - first[0], own.place[1] - first[1]]));
    let nees = mean(&|own| square([own.place[0] / own.stds[0], own.place[1] / own.stds[1]]) / 2.0);
    let heading = mean(&|own| own.heading * own.heading);
    Some(Score { moved: moved.sqrt(), nees, heading: heading.sqrt() })
}

fn error(row: &Row, truth: &Row) -> Errors {
    let latitude = truth.latitude.to_radians();
    let (meridian, normal) = earth::radii(latitude);
    let north = (row.latitude - truth.latitude).to_radians() * meridian;
    let east = (row.longitude - truth.longitude).to_radians() * normal * latitude.cos();
    let heading = (row.heading - truth.heading + 540.0).rem_euclid(360.0) - 180.0;
    Errors { place: [north, east], heading, stds: row.stds }
}
