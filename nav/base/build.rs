//! Packs the grid of the geoid, for a program that is a megabyte smaller (`src/geoid/grid.rs` unpacks it).

use std::path::Path;
use std::{env, fs, io};

/// Numbers of a row.
const COLUMNS: usize = 1440;
/// Stands before a difference that does not fit into a byte.
const ESCAPE: u8 = 255;

fn main() -> io::Result<()> {
    const SOURCE: &str = "data/egm96-15.dac";
    println!("cargo::rerun-if-changed={SOURCE}");
    let grid: Vec<i16> = fs::read(SOURCE)?
        .chunks_exact(2)
        .map(|pair| i16::from_be_bytes([pair[0], pair[1]]))
        .collect();
    let folder = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    fs::write(Path::new(&folder).join("egm96-15.packed"), packed(&grid))
}

/// What every number differs by from the plane through its neighbours in the west, the north and the north-west: a byte,
/// signs folded (0, -1, 1, -2 are 0, 1, 2, 3); or the escape and two bytes, the lower first.
fn packed(grid: &[i16]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(grid.len());
    let at = |row: usize, column: usize| i32::from(grid[row * COLUMNS + column]);
    for (index, value) in grid.iter().enumerate() {
        let expected = match (index / COLUMNS, index % COLUMNS) {
            (0, 0) => 0,
            (0, column) => at(0, column - 1),
            (row, 0) => at(row - 1, 0),
            (row, column) => at(row, column - 1) + at(row - 1, column) - at(row - 1, column - 1),
        };
        let difference = i32::from(*value) - expected;
        let folded = (difference << 1) ^ (difference >> 31);
        match u8::try_from(folded) {
            Ok(byte) if byte != ESCAPE => bytes.push(byte),
            _ => {
                bytes.push(ESCAPE);
                bytes.extend(&folded.to_le_bytes()[..2]);
            }
        }
    }
    bytes
}
