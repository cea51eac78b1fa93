//! What codes say of themselves before anything rests on them: which contradict the others, and how noisy all are.

use nalgebra::{DMatrix, DVector, Vector3};

use super::double::DoubleDifferences;

/// A code is left out when it is off by more than so many of its sigmas.
const OFF: f64 = 4.5;
/// What a code that is left out has its variance multiplied by.
const LEFT_OUT: f64 = 1e6;
/// How many measurements the assumed noise is worth against what is seen of it.
const WORTH: f64 = 20.0;

/// Leaves codes out that contradict the rest, and scales the variances of all by what their residuals show.
pub(super) fn screen(differences: &mut DoubleDifferences, near: &Vector3<f64>) {
    let none = DVector::zeros(differences.ambiguities().len());
    let most = differences.singles.len() / 4;
    for left_out in 0..=most {
        let rows = differences.rows(near, &none);
        let count = differences.codes();
        let residuals = rows.residuals.rows(0, count).clone_owned();
        let directions = rows.directions.rows(0, count).clone_owned();
        let covariance = rows.covariance.view((0, 0), (count, count)).clone_owned();
        let Some(judged) = Judged::new(residuals, directions, covariance) else { return };
        let freedom = count as f64 - 3.0 - left_out as f64;
        if freedom < 1.0 {
            return;
        }
        let level = ((WORTH + judged.chi_square) / (WORTH + freedom)).max(0.5);
        let worst = judged.worst(differences, level).filter(|_| left_out < most && freedom > 3.0);
        match worst {
            Some(single) => differences.singles[single].code_variance *= LEFT_OUT,
            None => {
                for single in &mut differences.singles {
                    single.code_variance *= level;
                }
                return;
            }
        }
    }
}

/// A position of codes alone, and what is left of them.
struct Judged {
    chi_square: f64,
    /// `R^-1 v`.
    weighed: DVector<f64>,
    /// Its covariance.
    spread: DMatrix<f64>,
}

impl Judged {
    fn new(
        residuals: DVector<f64>,
        directions: DMatrix<f64>,
        covariance: DMatrix<f64>,
    ) -> Option<Self> {
        if residuals.len() < 4 {
            return None;
        }
        let inverse = covariance.cholesky()?.inverse();
        let weighed_rows = &inverse * &directions;
        let normal = (directions.transpose() * &weighed_rows).cholesky()?;
        let step = normal.solve(&(weighed_rows.transpose() * &residuals));
        let left = residuals - directions * step;
        let weighed = &inverse * &left;
        let chi_square = left.dot(&weighed);
        let spread = inverse - &weighed_rows * normal.inverse() * weighed_rows.transpose();
        Some(Self { chi_square, weighed, spread })
    }

    /// The single difference that is off most, if one is (Baarda; with correlated errors Teunissen, "Testing theory", 2006, 4.2).
    fn worst(&self, differences: &DoubleDifferences, level: f64) -> Option<usize> {
        let off = |single: usize| {
            let in_rows = differences.codes_with(single);
            let variance = in_rows.dot(&(&self.spread * &in_rows));
            let known = variance > 1e-9 / differences.singles[single].code_variance;
            known.then(|| self.weighed.dot(&in_rows).abs() / (variance * level).sqrt())
        };
        (0..differences.singles.len())
            .filter_map(|single| Some((single, off(single)?)))
            .filter(|(_, off)| *off > OFF)
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map(|(single, _)| single)
    }
}
