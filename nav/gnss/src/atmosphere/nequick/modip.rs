//! The modified dip latitude: where a place lies in the Earth's magnetic field, as the ionosphere sees it.

/// Nodes along a meridian, from 95 degrees south to 95 degrees north, and as many along a parallel, from 190 degrees west
/// to 190 degrees east: one beyond the pole and the date line on each side, so that four are always at hand.
const NODES: usize = 39;
/// Between nodes in latitude and longitude, degrees.
const STEP_DEG: (f64, f64) = (5.0, 10.0);

/// Hundredths of a degree, `i16` little-endian, row by row from the south (`data/README.md`).
static GRID: &[u8; 2 * NODES * NODES] = include_bytes!("data/modip.bin");

/// Modified dip latitude, degrees, of a place, rad (equations 12 to 16).
pub(super) fn modip(latitude: f64, longitude: f64) -> f64 {
    let (row, x) = cell((latitude.to_degrees() + 90.0) / STEP_DEG.0);
    let (column, y) = cell((longitude.to_degrees() + 180.0).rem_euclid(360.0) / STEP_DEG.1);
    let along = |column: usize| third_order([0, 1, 2, 3].map(|k| node(row + k, column)), x);
    third_order([0, 1, 2, 3].map(|k| along(column + k)), y)
}

/// The cell of the grid, counted from the south or the west, and the place in it, 0 to 1.
fn cell(position: f64) -> (usize, f64) {
    let cell = position.floor().clamp(0.0, (NODES - 4) as f64);
    (cell as usize, position - cell)
}

fn node(row: usize, column: usize) -> f64 {
    let at = 2 * (row * NODES + column);
    f64::from(i16::from_le_bytes([GRID[at], GRID[at + 1]])) / 100.0
}

/// A cubic through the two nodes about `x`, 0 to 1 between them, shaped by one more on each side (equations 128 to 138).
fn third_order(z: [f64; 4], x: f64) -> f64 {
    let delta = 2.0 * x - 1.0;
    let (g1, g2) = (z[2] + z[1], z[2] - z[1]);
    let (g3, g4) = (z[3] + z[0], (z[3] - z[0]) / 3.0);
    let a = [9.0 * g1 - g3, 9.0 * g2 - g4, g3 - g1, g4 - g2];
    (a[0] + delta * (a[1] + delta * (a[2] + delta * a[3]))) / 16.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(latitude_deg: f64, longitude_deg: f64) -> f64 {
        modip(latitude_deg.to_radians(), longitude_deg.to_radians())
    }

    #[test]
    fn the_dip_latitude_is_that_of_the_nodes() {
        for (row, column) in [(1, 1), (7, 30), (19, 19), (30, 1), (36, 36)] {
            let (latitude, longitude) = (row as f64 * 5.0 - 95.0, column as f64 * 10.0 - 190.0);
            assert!((at(latitude, longitude) - node(row, column)).abs() < 1e-9);
        }
    }

    #[test]
    fn the_poles_are_the_poles_from_every_side() {
        for longitude in [-180.0, -77.0, 0.0, 3.0, 180.0] {
            assert!((at(90.0, longitude) - 90.0).abs() < 1e-9);
            assert!((at(-90.0, longitude) + 90.0).abs() < 1e-9);
        }
    }

    #[test]
    fn the_dip_latitude_is_the_same_on_both_sides_of_the_date_line() {
        for latitude in [-88.0, -42.0, 1.0, 67.0, 89.9] {
            assert!((at(latitude, 180.0 - 1e-7) - at(latitude, 180.0 + 1e-7)).abs() < 1e-6);
            assert!((at(latitude, -180.0) - at(latitude, 540.0)).abs() < 1e-9);
        }
    }

    #[test]
    fn every_place_has_a_dip_latitude_within_ninety_degrees() {
        for latitude in -180..=180 {
            for longitude in -361..=361 {
                let modip = at(f64::from(latitude) / 2.0, f64::from(longitude));
                assert!(modip.abs() <= 90.0 + 1e-9, "{latitude} {longitude}: {modip}");
            }
        }
    }
}
