//! Rows of the house as columns with names and units. What is unknown is NaN in a column of numbers and `None` in one of words.

use std::borrow::Cow;

use insd_base::{Availability, Ned, Solution, SolutionSource, Truth};
use insd_drivers::recording::NavRow;

/// A column.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    /// As in the files, the unit at its end.
    pub(crate) name: &'static str,
    /// Its unit, empty where it has none.
    pub(crate) unit: &'static str,
    /// What stands in it.
    pub(crate) values: Values,
}

/// What stands in a column.
#[derive(Clone, Debug)]
pub(crate) enum Values {
    /// NaN where unknown.
    Numbers(Vec<f64>),
    /// `None` where unknown.
    Words(Vec<Option<Cow<'static, str>>>),
}

/// Name, unit and value of a column of numbers.
pub(crate) type Number<T> = (&'static str, &'static str, fn(&T) -> Option<f64>);

/// Columns of numbers.
pub(crate) fn numbers<T>(rows: &[T], layout: &[Number<T>]) -> Vec<Column> {
    let column = |(name, unit, value): &Number<T>| {
        let values = rows.iter().map(|row| value(row).unwrap_or(f64::NAN)).collect();
        Column { name, unit, values: Values::Numbers(values) }
    };
    layout.iter().map(column).collect()
}

/// A column of words.
pub(crate) fn words<T>(
    name: &'static str,
    rows: &[T],
    word: impl Fn(&T) -> Option<Cow<'static, str>>,
) -> Column {
    Column { name, unit: "", values: Values::Words(rows.iter().map(word).collect()) }
}

/// The columns of `nav.csv`, in its order: at the IMU, velocity north, east and down.
pub(crate) fn of_nav(rows: &[NavRow]) -> Vec<Column> {
    let level: [Number<NavRow>; 2] =
        [("hpl_m", "m", |row| row.horizontal_level), ("vpl_m", "m", |row| row.vertical_level)];
    let count: [Number<NavRow>; 1] = [("satellites", "", |row| row.satellites.map(f64::from))];
    let mut columns = numbers(rows, &STATE);
    columns.extend(numbers(rows, &SIGMA));
    columns.push(words("mode", rows, |row| Some(row.solution.mode.as_str().into())));
    columns.extend(numbers(rows, &level));
    let integrity = |row: &NavRow| row.integrity.map(|own: Availability| own.as_str().into());
    columns.push(words("integrity", rows, integrity));
    columns.push(words("excluded", rows, |row| Some(row.excluded.join(" ").into())));
    columns.extend(numbers(rows, &count));
    let source = |row: &NavRow| row.solution.source.map(|own: SolutionSource| own.as_str().into());
    columns.push(words("source", rows, source));
    columns
}

const STATE: [Number<NavRow>; 10] = [
    ("t_s", "s", |row| Some(row.solution.time.as_seconds())),
    ("lat_deg", "deg", |row| Some(row.solution.position.latitude.to_degrees())),
    ("lon_deg", "deg", |row| Some(row.solution.position.longitude.to_degrees())),
    ("height_m", "m", |row| Some(row.solution.position.height)),
    ("vn_mps", "m/s", |row| Some(row.solution.velocity.0.x)),
    ("ve_mps", "m/s", |row| Some(row.solution.velocity.0.y)),
    ("vd_mps", "m/s", |row| Some(row.solution.velocity.0.z)),
    ("roll_deg", "deg", |row| Some(row.solution.attitude.roll.to_degrees())),
    ("pitch_deg", "deg", |row| Some(row.solution.attitude.pitch.to_degrees())),
    ("heading_deg", "deg", |row| Some(heading(&row.solution))),
];

const SIGMA: [Number<NavRow>; 9] = [
    ("std_n_m", "m", |row| Some(row.solution.sigma.position.0.x)),
    ("std_e_m", "m", |row| Some(row.solution.sigma.position.0.y)),
    ("std_d_m", "m", |row| Some(row.solution.sigma.position.0.z)),
    ("std_vn_mps", "m/s", |row| Some(row.solution.sigma.velocity.0.x)),
    ("std_ve_mps", "m/s", |row| Some(row.solution.sigma.velocity.0.y)),
    ("std_vd_mps", "m/s", |row| Some(row.solution.sigma.velocity.0.z)),
    ("std_roll_deg", "deg", |row| Some(row.solution.sigma.roll.to_degrees())),
    ("std_pitch_deg", "deg", |row| Some(row.solution.sigma.pitch.to_degrees())),
    ("std_heading_deg", "deg", |row| Some(row.solution.sigma.heading.to_degrees())),
];

fn heading(solution: &Solution) -> f64 {
    solution.attitude.heading.to_degrees().rem_euclid(360.0)
}

/// The columns of `truth.csv`, in its order.
pub(crate) fn of_truth(rows: &[Truth]) -> Vec<Column> {
    numbers(rows, &TRUTH)
}

const TRUTH: [Number<Truth>; 10] = [
    ("t_s", "s", |row| Some(row.time.as_seconds())),
    ("lat_deg", "deg", |row| Some(row.position.latitude.to_degrees())),
    ("lon_deg", "deg", |row| Some(row.position.longitude.to_degrees())),
    ("height_m", "m", |row| Some(row.position.height)),
    ("vn_mps", "m/s", |row| row.velocity.map(|Ned(v)| v.x)),
    ("ve_mps", "m/s", |row| row.velocity.map(|Ned(v)| v.y)),
    ("vd_mps", "m/s", |row| row.velocity.map(|Ned(v)| v.z)),
    ("roll_deg", "deg", |row| row.attitude.map(|own| own.roll.to_degrees())),
    ("pitch_deg", "deg", |row| row.attitude.map(|own| own.pitch.to_degrees())),
    ("heading_deg", "deg", |row| {
        row.attitude.map(|own| own.heading.to_degrees().rem_euclid(360.0))
    }),
];
