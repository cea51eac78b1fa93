//! The grid of the geoid, which the program holds packed (`build.rs` says how): unpacked when it is first asked for.

use std::sync::LazyLock;

pub(super) const ROWS: usize = 721;
pub(super) const COLUMNS: usize = 1440;

static PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/egm96-15.packed"));

/// Heights above the ellipsoid, cm: rows from the north pole, each from Greenwich to the east.
pub(super) static GRID: LazyLock<Vec<i16>> = LazyLock::new(|| unpacked(PACKED));

/// Stands before a difference that does not fit into a byte.
const ESCAPE: u8 = 255;

fn unpacked(packed: &[u8]) -> Vec<i16> {
    let mut grid: Vec<i16> = Vec::with_capacity(ROWS * COLUMNS);
    let mut bytes = packed.iter().copied();
    while let Some(folded) = folded(&mut bytes) {
        let index = grid.len();
        let expected = match (index / COLUMNS, index % COLUMNS) {
            (0, 0) => 0,
            (0, _) => grid[index - 1],
            (_, 0) => grid[index - COLUMNS],
            _ => grid[index - 1] + grid[index - COLUMNS] - grid[index - COLUMNS - 1],
        };
        let difference = (folded >> 1).cast_signed() ^ -(folded & 1).cast_signed();
        grid.push(expected + difference);
    }
    grid
}

/// The next difference, with its sign folded into the lowest bit.
fn folded(bytes: &mut impl Iterator<Item = u8>) -> Option<u16> {
    match bytes.next()? {
        ESCAPE => Some(u16::from_le_bytes([bytes.next()?, bytes.next()?])),
        byte => Some(u16::from(byte)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_is_that_of_its_makers() {
        let made = include_bytes!("../../data/egm96-15.dac");
        let made: Vec<i16> =
            made.chunks_exact(2).map(|pair| i16::from_be_bytes([pair[0], pair[1]])).collect();
        assert_eq!(made.len(), ROWS * COLUMNS);
        assert!(*GRID == made);
    }
}
