//! What codes say of themselves before anything rests on them: which contradict the others, and how noisy all are.

use nalgebra::{DMatrix, DVector, Vector3};

use super::double::DoubleDifferences;

/// A code is left out when it is off by more than so many of its sigmas.
const OFF: f64 = 4.5;
/// What a code that is left out has its variance multiplied by.
const LEFT_OUT: f64 = 1e6;
/// How many measurements the assumed noise is worth against what is seen of it.
const WORTH: f64 = 20.0;
/// What was seen earlier is worth no more than so many: receivers come under trees.
const MEMORY: f64 = 200.0;
/// Below this share of the assumed variance no residuals are believed: what errors of phases share with those of codes does not go so far.
const LEAST: f64 = 0.1;
/// How many measurements of the noise of phases the noise of codes is worth at the most.
const SHARED: f64 = 60.0;

/// How noisy a pair's codes are, over what is assumed, as their residuals have shown it so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct CodeLevel {
    chi_square: f64,
    freedom: f64,
}

impl CodeLevel {
    /// Variance over that assumed.
    fn value(self) -> f64 {
        (WORTH + self.chi_square) / (WORTH + self.freedom)
    }

    /// What it is worth as a measurement of the noise of all, phases with it: sum of squares and how many. Reflections and a weak signal are felt by both
    /// alike; of codes that are worse than assumed nothing follows for phases.
    pub(super) fn worth(self) -> (f64, f64) {
        let worth = self.freedom.min(SHARED);
        let level = (self.chi_square / self.freedom.max(1.0)).clamp(LEAST, 1.0);
        (level * worth, worth)
    }

    /// With the residuals of one epoch more.
    fn and(self, chi_square: f64, freedom: f64) -> Self {
        Self { chi_square: self.chi_square + chi_square, freedom: self.freedom + freedom }
    }

    /// As it is kept for the next epoch.
    fn faded(self) -> Self {
        let share = (MEMORY / self.freedom.max(MEMORY)).min(1.0);
        Self { chi_square: self.chi_square * share, freedom: self.freedom * share }
    }
}

/// Leaves codes out that contradict the rest, and scales the variances of all by what residuals show. Gives back what is known of their noise now.
pub(super) fn screen(
    differences: &mut DoubleDifferences,
    near: &Vector3<f64>,
    known: CodeLevel,
) -> CodeLevel {
    let begin = differences.whole_cycles().clone_owned();
    let most = differences.singles.len() / 4;
    for left_out in 0..=most {
        let rows = differences.rows(near, &begin);
        let count = differences.codes();
        let residuals = rows.residuals.rows(0, count).clone_owned();
        let directions = rows.directions.rows(0, count).clone_owned();
        let covariance = rows.covariance.view((0, 0), (count, count)).clone_owned();
        let freedom = count as f64 - 3.0 - left_out as f64;
        let Some(judged) =
            Judged::new(residuals, directions, covariance).filter(|_| freedom >= 1.0)
        else {
            break;
        };
        let level = known.and(judged.chi_square, freedom);
        let may_go = left_out < most && freedom > 3.0;
        match judged.worst(differences, level.value()).filter(|_| may_go) {
            Some(single) => differences.singles[single].code_variance *= LEFT_OUT,
            None => {
                differences.scale_codes(level.value().max(1.0));
                return level.faded();
            }
        }
    }
    differences.scale_codes(known.value().max(1.0));
    known
}

impl DoubleDifferences {
    fn scale_codes(&mut self, level: f64) {
        for single in &mut self.singles {
            single.code_variance *= level;
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
