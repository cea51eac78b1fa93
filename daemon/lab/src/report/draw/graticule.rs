//! Parallels and meridians on the chart, with their degrees and minutes.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write as _;

use insd_base::units::{DEG, wrap_pi};

use super::view::View;

/// Spacings, minutes of arc.
const STEPS: [f64; 20] = [
    0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 60.0,
    120.0, 300.0, 600.0, 1800.0,
];
/// Lines at most of each kind.
const LINES: f64 = 8.0;
/// Points of a line, and places looked at along each side of the frame.
const POINTS: u32 = 48;
const MINUTE: f64 = DEG / 60.0;

/// What part of the Earth the frame shows, rad; longitudes are counted from the middle.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    south: f64,
    north: f64,
    west: f64,
    east: f64,
}

/// Draws all lines and their labels.
pub(crate) fn draw(svg: &mut String, view: &View) {
    let bounds = bounds(view);
    let step = step(bounds.north - bounds.south);
    for latitude in multiples(bounds.south, bounds.north, step, 0.0) {
        let line = points(bounds.west, bounds.east, |east| view.at_offset(latitude, east));
        draw_line(svg, &line);
        label_left(svg, view, &line, &degrees(latitude, step, ['N', 'S']));
    }
    let middle = view.projection.longitude;
    let step = self::step(bounds.east - bounds.west);
    for east in multiples(bounds.west, bounds.east, step, middle) {
        let line = points(bounds.south, bounds.north, |latitude| view.at_offset(latitude, east));
        draw_line(svg, &line);
        label_below(svg, view, &line, &degrees(wrap_pi(middle + east), step, ['E', 'W']));
    }
}

fn bounds(view: &View) -> Bounds {
    let none = Bounds { south: f64::MAX, north: f64::MIN, west: f64::MAX, east: f64::MIN };
    let share = (0..=POINTS).map(|index| f64::from(index) / f64::from(POINTS));
    let border = share.flat_map(|own| [(own, 0.0), (own, 1.0), (0.0, own), (1.0, own)]);
    let mut bounds = border.fold(none, |bounds, (x, y)| {
        let (latitude, east) = view.sphere(x, y);
        Bounds {
            south: bounds.south.min(latitude),
            north: bounds.north.max(latitude),
            west: bounds.west.min(east),
            east: bounds.east.max(east),
        }
    });
    for pole in [FRAC_PI_2, -FRAC_PI_2] {
        if view.holds(view.at_offset(pole, 0.0)) {
            (bounds.west, bounds.east) = (-PI, PI);
            bounds.north = bounds.north.max(pole);
            bounds.south = bounds.south.min(pole);
        }
    }
    bounds
}

/// Spacing of lines over an angle, rad.
fn step(angle: f64) -> f64 {
    let fits = |step: &f64| angle / (step * MINUTE) <= LINES;
    STEPS.into_iter().find(fits).unwrap_or(3600.0) * MINUTE
}

/// Offsets from `from` to `to` at which `origin` plus the offset is a whole multiple of a step.
fn multiples(from: f64, to: f64, step: f64, origin: f64) -> impl Iterator<Item = f64> {
    let (first, last) = (((origin + from) / step).ceil(), ((origin + to) / step).floor());
    let count = (last - first + 1.0).clamp(0.0, 100.0) as u32;
    (0..count).map(move |index| (first + f64::from(index)) * step - origin)
}

fn points(from: f64, to: f64, place: impl Fn(f64) -> (f64, f64)) -> Vec<(f64, f64)> {
    let at = |index: u32| from + (to - from) * f64::from(index) / f64::from(POINTS);
    (0..=POINTS).map(|index| place(at(index))).collect()
}

fn draw_line(svg: &mut String, line: &[(f64, f64)]) {
    let mut d = String::new();
    for (index, (x, y)) in line.iter().enumerate() {
        let command = if index == 0 { 'M' } else { 'L' };
        let _ = write!(d, "{command}{x:.1} {y:.1}");
    }
    let _ = write!(svg, "<path class=\"grid\" clip-path=\"url(#chart)\" d=\"{d}\"/>");
}

/// Where a line crosses the left side of the frame.
fn label_left(svg: &mut String, view: &View, line: &[(f64, f64)], label: &str) {
    let swapped: Vec<(f64, f64)> = line.iter().map(|(x, y)| (*y, *x)).collect();
    if let Some(y) = crossing(&swapped, view.left).filter(|y| (view.top..view.bottom()).contains(y))
    {
        let (x, y) = (view.left - 6.0, y + 4.0);
        let _ = write!(svg, "<text class=\"end\" x=\"{x:.1}\" y=\"{y:.1}\">{label}</text>");
    }
}

/// Where a line crosses the foot of the frame.
fn label_below(svg: &mut String, view: &View, line: &[(f64, f64)], label: &str) {
    if let Some(x) = crossing(line, view.bottom()).filter(|x| (view.left..view.right()).contains(x))
    {
        let y = view.bottom() + 15.0;
        let _ = write!(svg, "<text class=\"mid\" x=\"{x:.1}\" y=\"{y:.1}\">{label}</text>");
    }
}

/// First coordinate of a line where its second one passes a value.
fn crossing(line: &[(f64, f64)], value: f64) -> Option<f64> {
    line.iter().zip(line.iter().skip(1)).find_map(|(one, other)| {
        let (before, after) = (one.1 - value, other.1 - value);
        let crosses = before * after <= 0.0 && before != after;
        crosses.then(|| one.0 + (other.0 - one.0) * before / (before - after))
    })
}

/// An angle as on a chart, with as many decimals of the minute as the step needs.
fn degrees(angle: f64, step: f64, sides: [char; 2]) -> String {
    let decimals = [1.0, 0.1, 0.01].iter().filter(|least| step < *least * MINUTE * 0.999).count();
    let unit = 10_i64.pow(decimals as u32);
    let whole = (angle / MINUTE * unit as f64).round() as i64;
    let [positive, negative] = sides;
    let side = if whole < 0 { negative } else { positive };
    let (minutes, rest) = (whole.abs() / unit, whole.abs() % unit);
    let (degrees, minutes) = (minutes / 60, minutes % 60);
    match decimals {
        0 => format!("{degrees}°{minutes:02}′{side}"),
        _ => format!("{degrees}°{minutes:02}.{rest:0decimals$}′{side}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_have_the_decimals_that_tell_lines_apart() {
        assert_eq!(degrees(35.5 * DEG, MINUTE, ['N', 'S']), "35°30′N");
        assert_eq!(degrees(-0.05 * MINUTE, 0.05 * MINUTE, ['E', 'W']), "0°00.05′W");
        assert_eq!(degrees(-PI, 60.0 * MINUTE, ['E', 'W']), "180°00′W");
    }

    #[test]
    fn lines_fall_on_round_numbers_on_both_sides_of_the_antimeridian() {
        let middle = 179.95 * DEG;
        let east = multiples(-0.12 * DEG, 0.12 * DEG, 0.1 * DEG, middle);
        let labels: Vec<String> =
            east.map(|east| degrees(wrap_pi(middle + east), 0.1 * DEG, ['E', 'W'])).collect();
        assert_eq!(labels, ["179°54′E", "180°00′E"]);
    }

    #[test]
    fn a_crossing_is_found_between_two_points() {
        assert_eq!(crossing(&[(0.0, 0.0), (10.0, 4.0)], 1.0), Some(2.5));
        assert_eq!(crossing(&[(0.0, 0.0), (10.0, 4.0)], 5.0), None);
    }
}
