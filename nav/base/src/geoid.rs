//! Mean sea level: the geoid of EGM96 above the ellipsoid of WGS-84.
//!
//! `data/egm96-15.dac` is the grid of 15 minutes of arc of the National Geospatial-Intelligence Agency (public
//! domain; `data/README.md`). Between its points runs the polynomial of third degree through four of them,
//! along the meridian and along the parallel. At 3000 points spread evenly over the Earth that agrees with the
//! sum of all spherical harmonics of EGM96 to 7 mm (RMS), 7 cm at most; a plane between four points would to
//! 4 cm and 50 cm. EGM96 itself is good to half a metre to a metre, and the sea lies within 2 m of it beside
//! its tides.

mod grid;

use crate::frames::Geodetic;
use grid::{COLUMNS, GRID, ROWS};

/// Half the way round the Earth.
const HALF: i64 = COLUMNS as i64 / 2;
/// Points of the grid in a radian.
const PER_RADIAN: f64 = HALF as f64 / std::f64::consts::PI;
/// Metres in a step of the grid's numbers.
const STEP: f64 = 0.01;

/// Height of the geoid above the ellipsoid at a point, m, from -107 to 86. `None` where latitude or longitude
/// is not finite, or the latitude is beyond a pole.
#[must_use]
pub fn undulation(point: &Geodetic) -> Option<f64> {
    let south = (std::f64::consts::FRAC_PI_2 - point.latitude) * PER_RADIAN;
    let east = point.longitude.rem_euclid(std::f64::consts::TAU) * PER_RADIAN;
    if !(0.0..=(ROWS - 1) as f64).contains(&south) || !east.is_finite() {
        return None;
    }
    // at the south pole the last row is the lower one of the last cell
    let row = south.floor().min((ROWS - 2) as f64);
    let column = east.floor();
    let (along_meridian, along_parallel) = (weights(south - row), weights(east - column));
    let (row, column) = (row as i64, column as i64);
    let mut sum = 0.0;
    for (down, of_row) in (-1..).zip(along_meridian) {
        for (right, of_column) in (-1..).zip(along_parallel) {
            sum += of_row * of_column * f64::from(value(row + down, column + right)?);
        }
    }
    Some(sum * STEP)
}

/// Weights of the points at -1, 0, 1 and 2 for the polynomial through them (Lagrange's), at `t` from 0 to 1.
fn weights(t: f64) -> [f64; 4] {
    let [before, here, next, after] = [t + 1.0, t, t - 1.0, t - 2.0];
    [
        -here * next * after / 6.0,
        before * next * after / 2.0,
        -before * here * after / 2.0,
        before * here * next / 6.0,
    ]
}

/// A number of the grid. Beyond a pole the meridian on the other side goes on.
fn value(row: i64, column: i64) -> Option<i16> {
    let last = ROWS as i64 - 1;
    let (row, column) = match row {
        ..0 => (-row, column + HALF),
        _ if row > last => (2 * last - row, column + HALF),
        _ => (row, column),
    };
    let index = row * COLUMNS as i64 + column.rem_euclid(COLUMNS as i64);
    GRID.get(usize::try_from(index).ok()?).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(latitude: f64, longitude: f64) -> f64 {
        undulation(&Geodetic::from_degrees(latitude, longitude, 0.0)).unwrap()
    }

    #[test]
    fn the_geoid_is_where_its_makers_print_it() {
        // OUTF477.DAT of NGA's program F477, the sum of all harmonics; the last is the example of GeographicLib's GeoidEval
        for (latitude, longitude, published) in [
            (38.628_155, 269.779_155, -31.628),
            (-14.621_217, 305.021_114, -2.969),
            (46.874_319, 102.448_729, -43.575),
            (-23.617_446, 133.874_712, 15.871),
            (38.625_473, 359.999_5, 50.066),
            (-0.466_744, 0.002_3, 17.329),
            (16.0 + 46.0 / 60.0 + 33.0 / 3600.0, -(3.0 + 34.0 / 3600.0), 28.7068),
        ] {
            let ours = at(latitude, longitude);
            assert!((ours - published).abs() < 0.012, "{latitude} {longitude}: {ours} {published}");
        }
    }

    #[test]
    fn it_has_its_known_depth_south_of_india_and_height_at_new_guinea() {
        let mut depth = (0.0, 0.0, f64::INFINITY);
        let mut height = (0.0, 0.0, f64::NEG_INFINITY);
        for row in -180..=180 {
            for column in 0..720 {
                let (latitude, longitude) = (f64::from(row) / 2.0, f64::from(column) / 2.0);
                let here = (latitude, longitude, at(latitude, longitude));
                depth = if here.2 < depth.2 { here } else { depth };
                height = if here.2 > height.2 { here } else { height };
            }
        }
        assert!((depth.2 + 106.9).abs() < 0.2 && (4.0..5.5).contains(&depth.0), "{depth:?}");
        assert!((78.0..80.0).contains(&depth.1), "{depth:?}");
        assert!((height.2 - 85.4).abs() < 1.0 && (-9.0..-7.5).contains(&height.0), "{height:?}");
        assert!((146.5..148.0).contains(&height.1), "{height:?}");
    }

    #[test]
    fn it_is_the_same_from_both_sides_of_greenwich_the_antimeridian_and_the_poles() {
        for latitude in [-89.99, -45.3, 0.0, 60.1, 89.99] {
            for meridian in [0.0, 180.0, 360.0] {
                let (west, east) = (at(latitude, meridian - 1e-9), at(latitude, meridian + 1e-9));
                assert!((west - east).abs() < 1e-6, "{latitude} {meridian}: {west} {east}");
            }
        }
        for (pole, published) in [(90.0, 13.61), (-90.0, -29.53)] {
            for longitude in [-180.0, -3.3, 77.7, 180.0] {
                assert!((at(pole, longitude) - published).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn it_has_no_steps() {
        let mut before = at(-60.0, -170.0);
        for step in 1..=24_000 {
            let along = f64::from(step) * 0.005;
            let here = at(along - 60.0, 2.5 * along - 170.0);
            assert!((here - before).abs() < 0.6, "{along}: {before} {here}");
            before = here;
        }
    }

    #[test]
    fn where_there_is_no_place_there_is_no_geoid() {
        for (latitude, longitude) in
            [(f64::NAN, 0.0), (0.0, f64::NAN), (0.0, f64::INFINITY), (90.1, 0.0), (-90.1, 0.0)]
        {
            let point = Geodetic::from_degrees(latitude, longitude, 0.0);
            assert_eq!(undulation(&point), None, "{latitude} {longitude}");
        }
    }
}
