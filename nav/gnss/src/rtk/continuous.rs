//! Ambiguities carried on from epoch to epoch.

use nalgebra::{DMatrix, DVector, Vector3};

use super::arcs::Arcs;
use super::double::DoubleDifferences;
use super::float::Float;
use super::prior::RoverPrior;

/// A phase has slipped when it is off by more than so many of its sigmas,
const OFF: f64 = 5.0;
/// and by more than this, m: half a cycle on L1 is 95 mm.
const LEAST: f64 = 0.05;

impl Float {
    /// The filter's step over one epoch: position free or by a prior, ambiguities as they were. Phases that contradict what is carried begin anew.
    pub(super) fn carried(
        arcs: &mut Arcs,
        differences: &DoubleDifferences,
        near: &Vector3<f64>,
        prior: Option<&RoverPrior>,
    ) -> Option<Self> {
        let known = prior.and_then(|prior| prior.covariance);
        arcs.place(near, known);
        let doubled = arcs.doubled(differences);
        let most = differences.singles.len();
        let mut step = Step::new(arcs, differences, &doubled, near)?;
        for _ in 0..most {
            let Some(slipped) = step.slipped(arcs, differences) else { break };
            arcs.restart(&differences.singles[slipped]);
            step = Step::new(arcs, differences, &doubled, near)?;
        }
        let chi_square = step.chi_square;
        step = Step::new(arcs, &arcs.weighed(differences), &doubled, near)?;
        let freedom = step.freedom(arcs, differences, known.is_some());
        step.update(arcs);
        let position = arcs.state.fixed_rows::<3>(0).clone_owned();
        let count = differences.ambiguities().len();
        let mut both = DMatrix::zeros(3 + count, arcs.state.len());
        both.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
        both.rows_mut(3, count).copy_from(&doubled);
        let ambiguities = &doubled * &arcs.state;
        let covariance = &both * &arcs.covariance * both.transpose();
        Some(Self {
            position,
            ambiguities,
            covariance,
            misfit: (chi_square, freedom),
            known: (0.0, 0.0),
        })
    }
}

/// Rows of an epoch against what is carried.
struct Step {
    design: DMatrix<f64>,
    noise: DMatrix<f64>,
    residuals: DVector<f64>,
    /// Inverse of the residuals' covariance.
    weight: DMatrix<f64>,
    chi_square: f64,
}

impl Step {
    fn new(
        arcs: &Arcs,
        differences: &DoubleDifferences,
        doubled: &DMatrix<f64>,
        near: &Vector3<f64>,
    ) -> Option<Self> {
        let rows = differences.rows(near, &(doubled * &arcs.state));
        let design = arcs.design(&rows, doubled);
        let spread = &design * &arcs.covariance * design.transpose() + &rows.covariance;
        let weight = spread.cholesky()?.inverse();
        let chi_square = rows.residuals.dot(&(&weight * &rows.residuals));
        let (noise, residuals) = (rows.covariance, rows.residuals);
        Some(Self { design, noise, residuals, weight, chi_square })
    }

    /// The phase that contradicts the others and what is carried most, if one does.
    fn slipped(&self, arcs: &Arcs, differences: &DoubleDifferences) -> Option<usize> {
        let weighed = &self.weight * &self.residuals;
        let off = |single: usize| {
            let one = &differences.singles[single];
            if one.phase.is_none() || arcs.is_new(one.pair) {
                return None;
            }
            let in_rows = differences.phases_with(single);
            let certainty = in_rows.dot(&(&self.weight * &in_rows));
            let pull = in_rows.dot(&weighed).abs();
            let is_off =
                certainty > 0.0 && pull > OFF * certainty.sqrt() && pull > LEAST * certainty;
            is_off.then(|| pull / certainty.sqrt())
        };
        (0..differences.singles.len())
            .filter_map(|single| Some((single, off(single)?)))
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map(|(single, _)| single)
    }

    /// Rows less what they have to determine first.
    fn freedom(&self, arcs: &Arcs, differences: &DoubleDifferences, has_prior: bool) -> usize {
        let new = |row: &usize| {
            let (of, less) = differences.singles_of(*row);
            [of, less].iter().any(|single| arcs.is_new(differences.singles[*single].pair))
        };
        let begun = (0..differences.ambiguities().len()).filter(new).count();
        let position = if has_prior { 0 } else { 3 };
        self.residuals.len().saturating_sub(position + begun)
    }

    /// In the form that keeps the covariance symmetric and positive (Joseph).
    fn update(&self, arcs: &mut Arcs) {
        let gain = &arcs.covariance * self.design.transpose() * &self.weight;
        arcs.state += &gain * &self.residuals;
        let size = arcs.state.len();
        let left = DMatrix::identity(size, size) - &gain * &self.design;
        let after =
            &left * &arcs.covariance * left.transpose() + &gain * &self.noise * gain.transpose();
        arcs.covariance = (&after + after.transpose()) * 0.5;
    }
}
