//! Depth-first search from the last number to the first, outwards from where each should be, in an ellipsoid that shrinks to the worst of those found.

use nalgebra::{DMatrix, DVector};

use super::reduction::Reduced;

/// The most steps of a search: some ten milliseconds, where a sound one has some hundred.
pub(super) const STEPS: usize = 200_000;

/// One level of the search.
struct Level {
    /// Where the number should be in the light of those after it.
    centre: f64,
    /// Whole; no count, so that nothing overflows however wild the centre.
    integer: f64,
    /// To the next integer of the zig-zag.
    step: f64,
    /// Distance of the numbers after it.
    before: f64,
}

impl Level {
    fn at(centre: f64, before: f64) -> Self {
        let integer = centre.round();
        let step = if centre >= integer { 1.0 } else { -1.0 };
        Self { centre, integer, step, before }
    }

    fn off(&self) -> f64 {
        self.centre - self.integer
    }

    /// The integer that is next nearest to the centre (Schnorr and Euchner 1994).
    fn next(&mut self) {
        self.integer += self.step;
        self.step = -self.step - self.step.signum();
    }
}

/// The nearest vectors of the reduced lattice, nearest first; `None` where the search does not end.
pub(super) fn nearest(
    reduced: &Reduced,
    measured: &DVector<f64>,
    count: usize,
) -> Option<Vec<(Vec<i64>, f64)>> {
    let last = measured.len() - 1;
    let mut found: Vec<(Vec<i64>, f64)> = Vec::with_capacity(count + 1);
    let mut levels: Vec<Level> = measured.iter().map(|x| Level::at(*x, 0.0)).collect();
    // row k: what the numbers after k move the centres of those before by
    let mut moved = DMatrix::<f64>::zeros(last + 2, last + 1);
    let mut k = last;
    for _ in 0..STEPS {
        let off = levels[k].off();
        let distance = levels[k].before + off * off / reduced.d[k];
        let bound = if found.len() < count { f64::INFINITY } else { furthest(&found) };
        if distance < bound && k > 0 {
            for j in 0..k {
                moved[(k, j)] = moved[(k + 1, j)] - off * reduced.l[(k, j)];
            }
            k -= 1;
            levels[k] = Level::at(measured[k] + moved[(k + 1, k)], distance);
            continue;
        }
        if distance < bound {
            let integers = levels.iter().map(|level| level.integer as i64).collect();
            let place = found.partition_point(|(_, other)| *other <= distance);
            found.insert(place, (integers, distance));
            found.truncate(count);
        } else if k == last {
            return Some(found);
        } else {
            k += 1;
        }
        levels[k].next();
    }
    None
}

fn furthest(found: &[(Vec<i64>, f64)]) -> f64 {
    found.last().map_or(0.0, |(_, distance)| *distance)
}
