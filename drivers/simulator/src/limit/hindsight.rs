//! The limit from both sides: what the optimal smoother knows, of all measurements before and after.
//!
//! Rauch, Tung and Striebel, AIAA J. 3 (1965), for the covariance alone: with P+ after the measurements of step k, Phi to the next
//! step and P- predicted there,
//!
//! C = P+ Phi^T (P-)^-1,   P_k = P+ + C (P_k+1 - P-) C^T,
//!
//! backwards from the end, where P is that of the filter. The transitions are worked out once more on the way back, as they were on the way there.

use nalgebra::DMatrix;

use super::{Analysis, Limit};

impl Analysis {
    /// The limits at some instants, s, in order of time, of who knows all of the voyage.
    pub(super) fn run_and_back(mut self, at: &[f64], end: f64) -> Vec<Limit> {
        let last = (end / self.step).round() as usize;
        let mut known = Vec::with_capacity(last + 1);
        for index in 0..last {
            known.push(self.covariance.p().clone());
            self.advance(index);
        }
        let mut found = Vec::with_capacity(at.len());
        let mut index = last;
        for &instant in at.iter().rev() {
            let wanted = ((instant / self.step).round() as usize).min(last);
            while index > wanted {
                index -= 1;
                let Some(before) = known.pop() else { break };
                self.step_back(index, before);
            }
            found.push(self.limit(instant, index as f64 * self.step));
        }
        found.reverse();
        found
    }

    /// From what is known of step `index + 1` to what is known of step `index`, of which the filter knew `before`.
    fn step_back(&mut self, index: usize, before: DMatrix<f64>) {
        let from = index as f64 * self.step;
        let stretch = self.way.between(from, from + self.step);
        let after = self.covariance.replace(before.clone());
        self.covariance.predict(&stretch);
        let predicted = self.covariance.p().clone();
        // it is not positive only where something is known without any error, and then nothing more is learnt of it
        let gain = predicted
            .clone()
            .cholesky()
            .map(|factor| factor.solve(&(self.covariance.transition() * &before)).transpose());
        let known = match gain {
            Some(gain) => &before + &gain * (after - predicted) * gain.transpose(),
            None => before,
        };
        self.covariance.replace((&known + known.transpose()) * 0.5);
    }
}
