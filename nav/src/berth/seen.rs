//! A ship's displacement now and some samples before, as it is seen from now.

use nalgebra::{Matrix2, Vector2};

use super::hindsight::{Hindsight, Rows};
use crate::Filter;
use crate::error_state::{BERTH_OFFSET, Innovation};

/// Newest first: how far she was off her mean place, with the sign turned, o - d, north and east, m; and the rows of d
/// over the filter's errors of now.
pub(super) struct Seen {
    off: Vec<Vector2<f64>>,
    rows: Vec<Rows>,
}

/// Least motion that is believed, 1-sigma, m.
const LEAST: f64 = 1e-3;

impl Seen {
    /// Her displacement now, and those before at a spacing, s, newest first.
    pub(super) fn of<'a>(
        filter: &Filter,
        hindsight: &Hindsight,
        now: &'a Vector2<f64>,
        before: impl Iterator<Item = &'a Vector2<f64>>,
        spacing: f64,
    ) -> Self {
        let offset = filter.nominal().berth_offset;
        let off: Vec<Vector2<f64>> =
            std::iter::once(now).chain(before).map(|d| offset - d).collect();
        let ages = (0..off.len()).map(|lag| lag as f64 * spacing);
        let rows = hindsight.unturned(now, ages);
        Seen { off, rows }
    }

    /// o - d of the samples before, newest first, m.
    pub(super) fn before(&self) -> &[Vector2<f64>] {
        &self.off[1..]
    }

    /// What A(q) = I - sum A_i q^-i leaves of it, where the rest has this covariance, m^2.
    pub(super) fn whitened(
        &self,
        lags: impl Iterator<Item = Matrix2<f64>>,
        covariance: &Matrix2<f64>,
    ) -> Innovation {
        let (mut z, mut sum) = (self.off[0], self.rows[0]);
        let mut of_offset = -Matrix2::identity();
        for (a, (off, rows)) in lags.zip(self.off.iter().zip(&self.rows).skip(1)) {
            z -= a * off;
            sum = sum.plus(&rows.under(&-a));
            of_offset += a;
        }
        let least = Matrix2::from_diagonal_element(LEAST * LEAST);
        let mut innovation = Innovation::silent(2);
        innovation.z.copy_from(&z);
        innovation.r.copy_from(&(covariance + least));
        sum.fill(&mut innovation.h);
        innovation.h.set(BERTH_OFFSET, &of_offset);
        innovation
    }
}
