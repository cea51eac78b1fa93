//! Two solutions side by side.

use std::fs;
use std::path::Path;

/// One row of `nav.csv` as far as it is compared.
#[derive(Clone, Debug)]
struct Row {
    time: f64,
    latitude: f64,
    longitude: f64,
    height: f64,
    angles: [f64; 3],
    mode: String,
}

/// Greatest and root mean square differences.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Differences {
    /// Rows compared.
    pub(crate) rows: u64,
    /// Horizontal position, m.
    pub(crate) position: (f64, f64),
    /// Height, m.
    pub(crate) height: (f64, f64),
    /// Roll and pitch, deg.
    pub(crate) tilt: (f64, f64),
    /// Heading, deg.
    pub(crate) heading: (f64, f64),
}

/// Mean radius of the Earth, m: good to 0.3 % of a difference of millimetres.
const RADIUS: f64 = 6.371e6;

/// Compares `live` with `direct` from a time on; rows in the last 5 s are left out.
pub(crate) fn compare(live: &Path, direct: &Path, from: f64) -> Differences {
    let (live, direct) = (rows(live), rows(direct));
    let last = direct.last().map_or(0.0, |row| row.time) - 5.0;
    let mut found = Differences::default();
    let mut squares = [0.0; 4];
    for row in &live {
        let at = row.time;
        if at < from || at > last {
            continue;
        }
        let after = direct.partition_point(|other| other.time < at);
        let Some(other) = direct.get(after).filter(|other| other.time == at) else { continue };
        if other.mode != row.mode {
            continue;
        }
        let cos = row.latitude.to_radians().cos();
        let north = (row.latitude - other.latitude).to_radians() * RADIUS;
        let east = (row.longitude - other.longitude).to_radians() * RADIUS * cos;
        let turn = |i: usize| wrapped(row.angles[i] - other.angles[i]).abs();
        let each =
            [north.hypot(east), (row.height - other.height).abs(), turn(0).max(turn(1)), turn(2)];
        found.rows += 1;
        for ((greatest, square), value) in
            [&mut found.position.0, &mut found.height.0, &mut found.tilt.0, &mut found.heading.0]
                .into_iter()
                .zip(&mut squares)
                .zip(each)
        {
            *greatest = greatest.max(value);
            *square += value * value;
        }
    }
    let rms = |square: f64| (square / found.rows.max(1) as f64).sqrt();
    found.position.1 = rms(squares[0]);
    found.height.1 = rms(squares[1]);
    found.tilt.1 = rms(squares[2]);
    found.heading.1 = rms(squares[3]);
    found
}

fn rows(path: &Path) -> Vec<Row> {
    let text = fs::read_to_string(path).unwrap_or_else(|fault| panic!("{path:?}: {fault}"));
    text.lines().skip(1).filter_map(row).collect()
}

fn row(line: &str) -> Option<Row> {
    let fields: Vec<&str> = line.split(',').collect();
    let number = |index: usize| fields.get(index)?.parse::<f64>().ok();
    Some(Row {
        time: number(0)?,
        latitude: number(1)?,
        longitude: number(2)?,
        height: number(3)?,
        angles: [number(7)?, number(8)?, number(9)?],
        mode: (*fields.last()?).to_owned(),
    })
}

fn wrapped(degrees: f64) -> f64 {
    (degrees + 180.0).rem_euclid(360.0) - 180.0
}
