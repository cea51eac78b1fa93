//! Phases of several antennas of the hull, whole cycles taken out.
//!
//! Of a signal, g how the range changes with an antenna's place, w the inverse variances:
//!
//! z_i = phase_i - g . C_eb l_i - line_i = (C_eb l_i x g) . (phi + C_eb m) + dline_i + clock + what all antennas share + noise (gnss.md, eq. 14),
//!
//! m how the antennas sit otherwise than configured.
//!
//! What all share is free: the weights are `W = diag(w) - w w^T / sum(w)`. So is what receivers on another clock share, on each wavelength. An epoch of many
//! satellites tells of no more than attitude and lines x: normal equations `N = J^T W J`, `b = J^T W z` come to as many rows,
//!
//! `N^-1/2 b = N^1/2 x + e`, e of unit covariance (Teunissen and Montenbruck, Springer Handbook of GNSS, chapter 22).
//!
//! Most of e is what antennas and the ship reflect, which goes on for a minute. Rows of the symmetric root are the same combinations of phases from epoch to epoch, as long
//! as the sky is: `e = sqrt(s) u + white`, u a state of unit variance for each of them.
//!
//! Held by `every_measurement_matrix_agrees_with_perturbed_predictions`.

use insd_base::satellites::{AntennaPhase, AntennaSignal, LineBias};
use insd_estimation::{Innovation, Jacobian};
use nalgebra::{DMatrix, DVector, Rotation3, SMatrix, SymmetricEigen, Vector3};

use super::View;
use crate::error_state::{
    ANTENNA_AXES, ANTENNA_LINES, ANTENNA_REFLECTIONS, ANTENNA_ROWS, ATTITUDE, LINES,
};

/// Of what an epoch tells best, combinations that it tells by less than this share are not told.
const LEAST: f64 = 1e-9;

/// Columns of an epoch: attitude, lines, clocks.
struct Columns<'a> {
    lines: &'a [LineBias],
    /// By clock and wavelength, micrometres: bands are centimetres apart.
    clocks: Vec<(usize, i64)>,
}

/// Shares of the variance of a phase that reflections and what is new in each epoch are. Residuals of real antennas on roofs are 0.6 to 0.8 reflections
/// (docs/compass.md); both are taken for a little more than there is.
pub(super) const REFLECTED: f64 = 0.7;
pub(super) const WHITE: f64 = 0.5;

/// Innovation of an epoch. `lines`: those that are carried, in their places, at most [`LINES`]; phases of others are not used. `None` where it tells nothing.
#[must_use]
pub fn innovation(
    view: &View,
    signals: &[AntennaSignal],
    lines: &[LineBias],
) -> Option<Innovation> {
    let columns = Columns { lines, clocks: clocks(signals) };
    let known = 3 + lines.len();
    let size = known + columns.clocks.len();
    let (mut normal, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
    for signal in signals {
        columns.add(view, signal, (&mut normal, &mut right));
    }
    // a decomposition of what is no number does not end
    if !normal.iter().chain(right.iter()).all(|x| x.is_finite()) {
        return None;
    }
    let (normal, right) = without(&normal, &right, known);
    let (root, inverse) = roots(normal)?;
    let z = inverse * right - view.nominal.antenna_reflections.rows(0, known) * REFLECTED.sqrt();
    let rows: Vec<_> = (0..known).map(|place| row(view, &root, z[place], place)).collect();
    Some(Innovation::stacked(rows.iter()))
}

fn row(view: &View, root: &DMatrix<f64>, z: f64, place: usize) -> Innovation {
    let own = |column: usize| if column < root.ncols() { root[(place, column)] } else { 0.0 };
    let attitude = SMatrix::<f64, 1, 3>::from_fn(|_, column| own(column));
    let line = SMatrix::<f64, 1, LINES>::from_fn(|_, column| own(3 + column));
    let mut reflected = SMatrix::<f64, 1, ANTENNA_ROWS>::zeros();
    reflected[place] = REFLECTED.sqrt();
    let h = Jacobian::none(1)
        .with(ATTITUDE, &attitude)
        .with(ANTENNA_AXES, &(attitude * view.c_eb))
        .with(ANTENNA_LINES, &line)
        .with(ANTENNA_REFLECTIONS, &reflected);
    Innovation::new(&SMatrix::<f64, 1, 1>::new(z), h, &SMatrix::<f64, 1, 1>::new(WHITE))
}

/// Symmetric root of a matrix, and the inverse of that where there is one; `None` of one that tells nothing.
fn roots(normal: DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let own = SymmetricEigen::new(normal);
    let largest = own.eigenvalues.max();
    let is_told = |value: f64| value > largest * LEAST;
    let root = own.eigenvalues.map(|value| if is_told(value) { value.sqrt() } else { 0.0 });
    let inverse = root.map(|root| if root > 0.0 { 1.0 / root } else { 0.0 });
    let with = |values: &DVector<f64>| {
        &own.eigenvectors * DMatrix::from_diagonal(values) * own.eigenvectors.transpose()
    };
    (largest > 0.0).then(|| (with(&root), with(&inverse)))
}

fn key(phase: &AntennaPhase, signal: &AntennaSignal) -> Option<(usize, i64)> {
    Some((phase.clock?, (signal.wavelength * 1e6).round() as i64))
}

fn clocks(signals: &[AntennaSignal]) -> Vec<(usize, i64)> {
    let keys = signals.iter().flat_map(|own| own.phases.iter().filter_map(|one| key(one, own)));
    let mut clocks: Vec<_> = keys.collect();
    clocks.sort_unstable();
    clocks.dedup();
    clocks
}

impl Columns<'_> {
    /// Adds the normal equations of a signal.
    fn add(
        &self,
        view: &View,
        signal: &AntennaSignal,
        (normal, right): (&mut DMatrix<f64>, &mut DVector<f64>),
    ) {
        let rows: Vec<_> =
            signal.phases.iter().filter_map(|phase| self.row(view, signal, phase)).collect();
        let sum: f64 = rows.iter().map(|(_, _, weight)| weight).sum();
        if rows.len() < 2 || sum <= 0.0 {
            return;
        }
        let mut mean = (DVector::zeros(right.len()), 0.0);
        for (row, z, weight) in &rows {
            mean.0.axpy(weight / sum, row, 1.0);
            mean.1 += weight / sum * z;
        }
        for (row, z, weight) in rows {
            let (row, z) = (row - &mean.0, z - mean.1);
            normal.ger(weight, &row, &row, 1.0);
            right.axpy(weight * z, &row, 1.0);
        }
    }

    /// How a phase depends on all columns, what it is beyond what is expected, and its weight.
    fn row(
        &self,
        view: &View,
        signal: &AntennaSignal,
        phase: &AntennaPhase,
    ) -> Option<(DVector<f64>, f64, f64)> {
        let known = 3 + self.lines.len();
        let mut row = DVector::zeros(known + self.clocks.len());
        let line = phase.line.map(|line| self.lines.iter().position(|own| *own == line));
        let line = if let Some(place) = line { Some(place?) } else { None };
        let (z, turned) = beyond(view, (signal, phase), line);
        row.fixed_rows_mut::<3>(0).copy_from(&turned);
        if let Some(place) = line {
            row[3 + place] = 1.0;
        }
        if let Some(key) = key(phase, signal) {
            row[known + self.clocks.binary_search(&key).ok()?] = 1.0;
        }
        Some((row, z, 1.0 / phase.variance))
    }
}

/// What a phase is beyond what is expected of it but for what all share, m, and how that depends on the attitude.
pub(super) fn beyond(
    view: &View,
    (signal, phase): (&AntennaSignal, &AntennaPhase),
    line: Option<usize>,
) -> (f64, Vector3<f64>) {
    let sits = Rotation3::from_scaled_axis(view.nominal.antenna_axes);
    let arm = view.c_eb * (sits * phase.lever);
    let bias = line.map_or(0.0, |place| view.nominal.antenna_lines[place]);
    (phase.phase - signal.gradient.dot(&arm) - bias, arm.cross(&signal.gradient))
}

/// Normal equations of the first unknowns alone, the others free.
fn without(
    normal: &DMatrix<f64>,
    right: &DVector<f64>,
    known: usize,
) -> (DMatrix<f64>, DVector<f64>) {
    let free = right.len() - known;
    let (own, of_own) = (normal.view((0, 0), (known, known)), right.rows(0, known));
    if free == 0 {
        return (own.into_owned(), of_own.into_owned());
    }
    let across = normal.view((0, known), (known, free));
    let theirs = SymmetricEigen::new(normal.view((known, known), (free, free)).into_owned());
    let largest = theirs.eigenvalues.max();
    let inverse = theirs.eigenvalues.map(|own| if own > largest * LEAST { 1.0 / own } else { 0.0 });
    let inverse =
        &theirs.eigenvectors * DMatrix::from_diagonal(&inverse) * theirs.eigenvectors.transpose();
    let by = across * inverse;
    (own - &by * across.transpose(), of_own - by * right.rows(known, free))
}
