//! A ship's displacement now and some samples before, as it is seen from now.

use nalgebra::{Matrix2, SMatrix, Vector2};

use super::hindsight::{Hindsight, Rows};
use crate::Filter;
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ATTITUDE, BERTH_OFFSET, Block, Covariance, GYRO_BIAS, GYRO_DRIFT,
    Innovation, POSITION, VELOCITY,
};

/// Newest first: how far she was off her mean place, with the sign turned, o - d, north and east, m; and the rows of d
/// over the filter's errors of now.
pub(super) struct Seen {
    off: Vec<Vector2<f64>>,
    rows: Vec<Rows>,
}

/// How samples vary with the filter's errors, m^2: each with itself and, both ways together, with those before it.
pub(super) struct Own {
    pairs: Vec<Matrix2<f64>>,
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
        let unturned = hindsight.unturned(now);
        let rows = (0..off.len()).map(|lag| unturned.rows(lag as f64 * spacing)).collect();
        Seen { off, rows }
    }

    /// o - d of the samples before, newest first, m.
    pub(super) fn before(&self) -> &[Vector2<f64>] {
        &self.off[1..]
    }

    /// How it varies with the filter's errors.
    pub(super) fn own(&self, filter: &Filter) -> Own {
        let p = gathered(filter.covariance());
        // columns, not rows: one after the other in memory
        let columns: Vec<_> =
            self.rows.iter().map(|rows| over_gathered(rows).transpose()).collect();
        let mut pairs = Vec::with_capacity(columns.len() * (columns.len() + 1) / 2);
        for (i, column) in columns.iter().enumerate() {
            let through = p * column;
            pairs.push(column.tr_mul(&through));
            pairs.extend(columns[i + 1..].iter().map(|other| {
                let pair = other.tr_mul(&through);
                pair + pair.transpose()
            }));
        }
        Own { pairs }
    }

    /// How likely it is that a kind of sea made it, whose samples hang together by `lags` and leave a variance of
    /// `unexplained`, m^2, of each component: the normalised innovation squared, and half the logarithm of the determinant
    /// of its covariance; `None` if the numbers are out of range.
    pub(super) fn weigh(&self, own: &Own, lags: &[f64], unexplained: f64) -> Option<(f64, f64)> {
        let factors: Vec<f64> = std::iter::once(1.0).chain(lags.iter().map(|a| -a)).collect();
        let z: Vector2<f64> = self.off.iter().zip(&factors).map(|(off, by)| off * *by).sum();
        let s = own.of(&factors) + Matrix2::from_diagonal_element(unexplained + LEAST * LEAST);
        let determinant = s.determinant();
        let nis = z.dot(&(s.try_inverse()? * z));
        (determinant > 0.0 && nis.is_finite()).then(|| (nis, 0.5 * determinant.ln()))
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

impl Own {
    /// The variance of the sum of samples by factors, newest first.
    fn of(&self, factors: &[f64]) -> Matrix2<f64> {
        let products =
            factors.iter().enumerate().flat_map(|(i, a)| factors[i..].iter().map(move |b| a * b));
        self.pairs.iter().zip(products).map(|(pair, product)| pair * product).sum()
    }
}

/// Errors that displacements depend on, those of a sensor that look alike taken together, and the mean place.
const GATHERED: usize = 17;

/// Covariance of them.
fn gathered(p: &Covariance) -> SMatrix<f64, GATHERED, GATHERED> {
    let groups: [&[Block<3>]; 5] = [
        &[POSITION],
        &[VELOCITY],
        &[ATTITUDE],
        &[GYRO_BIAS, GYRO_DRIFT],
        &[ACCEL_BIAS, ACCEL_DRIFT],
    ];
    let mut all = SMatrix::<f64, GATHERED, GATHERED>::zeros();
    let last = GATHERED - 2;
    for (i, own) in groups.into_iter().enumerate() {
        for block in own {
            let mut with_offset = all.fixed_view_mut::<3, 2>(3 * i, last);
            with_offset += block.covariance_with(BERTH_OFFSET, p);
            for (j, others) in groups.into_iter().enumerate().skip(i) {
                for other in others {
                    let mut pair = all.fixed_view_mut::<3, 3>(3 * i, 3 * j);
                    pair += block.covariance_with(*other, p);
                }
            }
        }
    }
    all.fixed_view_mut::<2, 2>(last, last).copy_from(&BERTH_OFFSET.covariance(p));
    all.fill_lower_triangle_with_upper_triangle();
    all
}

/// o - d over them.
fn over_gathered(rows: &Rows) -> SMatrix<f64, 2, GATHERED> {
    let mut over = SMatrix::<f64, 2, GATHERED>::zeros();
    for (i, block) in rows.blocks().into_iter().enumerate() {
        over.fixed_view_mut::<2, 3>(0, 3 * i).copy_from(block);
    }
    over.fixed_view_mut::<2, 2>(0, GATHERED - 2).copy_from(&-Matrix2::identity());
    over
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::berth::prefiltered::tests as ship;
    use approx::assert_relative_eq;

    #[test]
    fn a_kind_of_sea_is_weighed_as_its_innovation_would_be() {
        let filter = ship::filter(&ship::errors());
        let before = [Vector2::new(0.4, -0.2), Vector2::new(-0.1, 0.3)];
        let now = Vector2::new(0.2, 0.1);
        let seen = Seen::of(&filter, &Hindsight::of(&filter), &now, before.iter(), 4.0);
        let (lags, unexplained) = ([1.2, -0.5], 0.3);
        let (nis, root) = seen.weigh(&seen.own(&filter), &lags, unexplained).expect("a weight");
        let blocks = lags.into_iter().map(Matrix2::from_diagonal_element);
        let covariance = Matrix2::from_diagonal_element(unexplained);
        let whole =
            seen.whitened(blocks, &covariance).weigh(filter.covariance()).expect("a weight");
        assert_relative_eq!(nis, whole.nis(), max_relative = 1e-9);
        assert_relative_eq!(root, whole.log_root_determinant(), max_relative = 1e-9);
    }
}
