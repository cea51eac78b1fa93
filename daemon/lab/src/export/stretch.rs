//! A solution cut where it becomes another: of another mode, not to be used any more, after a gap, across the antimeridian.

use insd_base::Mode;
use insd_drivers::recording::NavRow;

use crate::evaluation::is_told;

/// Rows are apart by a gap when it is so many times the least interval between two.
const GAP: f64 = 3.5;

/// Rows of one mode without a gap.
pub(super) struct Stretch<'a> {
    pub(super) rows: &'a [NavRow],
    pub(super) mode: Mode,
    /// Whether it may be relied on.
    pub(super) is_told: bool,
}

/// All stretches of a solution, in their order.
pub(super) fn stretches(rows: &[NavRow]) -> impl Iterator<Item = Stretch<'_>> {
    let gap = GAP * least_interval(rows);
    let is_one = move |a: &NavRow, b: &NavRow| {
        a.solution.mode == b.solution.mode
            && is_told(a) == is_told(b)
            && interval(a, b) <= gap
            && !crosses(a, b)
    };
    rows.chunk_by(is_one).filter_map(|rows| {
        let first = rows.first()?;
        Some(Stretch { rows, mode: first.solution.mode, is_told: is_told(first) })
    })
}

fn interval(a: &NavRow, b: &NavRow) -> f64 {
    (b.solution.time - a.solution.time).as_seconds()
}

fn least_interval(rows: &[NavRow]) -> f64 {
    let intervals = rows.windows(2).map(|pair| interval(&pair[0], &pair[1]));
    intervals.filter(|own| *own > 0.0).fold(f64::INFINITY, f64::min)
}

/// Whether the antimeridian lies between two rows: a line between them would go round the Earth.
fn crosses(a: &NavRow, b: &NavRow) -> bool {
    (a.solution.position.longitude - b.solution.position.longitude).abs() > std::f64::consts::PI
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use insd_base::{
        Attitude, Availability, Body, Geodetic, Judgement, Ned, Protection, Solution,
        SolutionSigma, Time,
    };

    /// A row at a time, s, and a longitude, deg.
    pub(in crate::export) fn row(seconds: f64, longitude: f64, mode: Mode) -> NavRow {
        let solution = Solution {
            time: Time::from_seconds(seconds),
            position: Geodetic::from_degrees(54.123_456_789_1, longitude, 41.5),
            velocity: Ned::new(3.0, 4.0, 0.0),
            attitude: Attitude { roll: 0.02, pitch: -0.01, heading: 1.0 },
            rate: Body::default(),
            sigma: SolutionSigma {
                position: Ned::new(0.5, 0.25, 1.0),
                velocity: Ned::new(0.1, 0.1, 0.1),
                roll: 1e-3,
                pitch: 1e-3,
                heading: 2e-3,
            },
            mode,
            judgement: Judgement::default(),
            source: None,
            hidden: Protection::default(),
        };
        NavRow {
            solution,
            horizontal_level: None,
            vertical_level: None,
            integrity: None,
            excluded: Vec::new(),
            satellites: None,
        }
    }

    #[test]
    fn a_solution_is_cut_at_modes_gaps_faults_and_the_antimeridian() {
        let aided = |seconds, longitude| row(seconds, longitude, Mode::Aided);
        let mut doubted = aided(3.0, 179.92);
        doubted.integrity = Some(Availability::Fault);
        let rows = [
            row(0.0, 179.9, Mode::CoarseAlignment),
            aided(1.0, 179.9),
            aided(2.0, 179.91),
            doubted,
            aided(4.0, 179.99),
            aided(5.0, -179.99),
            aided(15.0, -179.9),
        ];
        let cut: Vec<(usize, bool)> =
            stretches(&rows).map(|own| (own.rows.len(), own.is_told)).collect();
        assert_eq!(cut, [(1, false), (2, true), (1, false), (1, true), (1, true), (1, true)]);
    }
}
