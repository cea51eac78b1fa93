//! Faults that may have begun at one instant, and what the innovations say of each.
//!
//! A fault of size b that began then does to the errors of the estimate, and to the innovations,
//!
//! E\[x\] = U b,   U <- Phi U,   G = H U + D,   U <- U - K G,   E\[nu\] = G b,
//!
//! D what it adds to a measurement itself. The innovations tell b by least squares, and how much likelier they are with
//! it than without (Willsky and Jones, A Generalized Likelihood Ratio Approach to the Detection and Estimation
//! of Jumps in Linear Systems, IEEE Transactions on Automatic Control AC-21 (1976), eqs. (9)-(22)). With a size of prior
//! covariance s^2 I, information Lambda, evidence eta and A = I + s^2 Lambda:
//!
//! ln BF = (s eta)^T A^-1 (s eta) / 2 - ln(det A) / 2.

use insd_base::{Party, Time};
use nalgebra::{Cholesky, Matrix3, Vector3};

use super::aid::Aid;
use super::rows::{self, ALL, Direct, FaultGroup, GROUPS};
use crate::error_state::{Block, Covariance, Effects, Errors, Weighed};

/// What may have begun at an instant.
#[derive(Clone, Debug)]
pub(super) struct Onset {
    /// The instant.
    pub(super) since: Time,
    effects: Effects,
    information: [Matrix3<f64>; GROUPS],
    evidence: [Vector3<f64>; GROUPS],
    /// Of the information of each group, times for how long a fault had lasted when it came, s.
    aged: [f64; GROUPS],
    /// Whether anything was heard since that tells of it but, beside antennas, their heading and the sea level.
    told: [bool; GROUPS],
    /// Sum of the normalised squares since, and how many components there were.
    misfit: f64,
    heard: f64,
}

/// A fault of a group, sized.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sized {
    /// Logarithm of the ratio of likelihoods, with it over without.
    pub(super) log_factor: f64,
    /// What it explains of the normalised squares.
    pub(super) explained: f64,
    /// Its components.
    pub(super) value: Vector3<f64>,
    covariance: Matrix3<f64>,
}

/// What a tilt pushes her athwart by in the time that an onset is unknown by, over what a turn does to her velocity, as a ratio: g t / v
/// with 2 s and 5 m/s.
const ATHWART: f64 = 4.0;

impl Sized {
    /// How well its components are known; those that a group has not are of no account.
    pub(super) fn covariance(&self) -> Matrix3<f64> {
        self.covariance
    }

    /// Gyros that began to tilt her at another moment than an onset there is for: what that does to her velocity is what a turn does,
    /// and the turn that is found is no better known than that.
    pub(super) fn untimed(mut self) -> Self {
        self.covariance[(2, 2)] += (ATHWART * self.value.xy().norm()).powi(2);
        self
    }
}

impl Onset {
    /// Everything may begin now, so many faults.
    #[must_use]
    pub(super) fn new(since: Time, rows: usize) -> Self {
        Onset {
            since,
            effects: rows::at_onset(rows),
            information: [Matrix3::zeros(); GROUPS],
            evidence: [Vector3::zeros(); GROUPS],
            aged: [0.0; GROUPS],
            told: [false; GROUPS],
            misfit: 0.0,
            heard: 0.0,
        }
    }

    /// The effects, to be carried along with the errors.
    pub(super) fn effects_mut(&mut self) -> &mut Effects {
        &mut self.effects
    }

    /// So many faults may be.
    pub(super) fn widen(&mut self, rows: usize) {
        self.effects.widen(rows);
    }

    /// Hears an innovation before it is absorbed, if it is.
    pub(super) fn hear(&mut self, (aid, now): (Aid, Time), weighed: &Weighed, direct: Direct) {
        let age = (now - self.since).as_seconds();
        self.effects.conform(weighed.layout());
        let causes = self.effects.causes();
        let is_as_wide = direct.nrows() == causes;
        let direct = if is_as_wide { direct } else { direct.resize_vertically(causes, 0.0) };
        let effect = weighed.effect_of(&self.effects, direct);
        let z = weighed.whitened();
        let has_antennas = causes > rows::USUAL_ROWS;
        let tells_place = !(has_antennas && matches!(aid, Aid::Antennas | Aid::SeaLevel));
        let is_carried = |group: &&FaultGroup| group.rows.end <= causes;
        for (i, group) in ALL.iter().take_while(is_carried).enumerate() {
            let (start, width) = (group.rows.start, group.rows.len());
            let own = effect.rows(start, width);
            let mut information = self.information[i].view_mut((0, 0), (width, width));
            information += own * own.transpose();
            let mut evidence = self.evidence[i].rows_mut(0, width);
            evidence += own * &z;
            self.aged[i] += own.norm_squared() * age;
            self.told[i] |= tells_place && own.norm_squared() > 0.0;
        }
        if aid.is_absorbed() {
            weighed.pass_on(&mut self.effects, &effect);
        }
        self.misfit += z.norm_squared();
        self.heard += weighed.rows() as f64;
    }

    /// Forgets what speaks for faults of somebody of whom no estimate takes anything.
    pub(super) fn forget(&mut self, party: Party) {
        for (i, _) in ALL.iter().enumerate().filter(|(_, group)| group.fault.party() == party) {
            (self.information[i], self.evidence[i]) = (Matrix3::zeros(), Vector3::zeros());
            self.aged[i] = 0.0;
        }
    }

    /// Mean square of the innovations since, of which one is expected, that is left when so much is explained.
    pub(super) fn left(&self, explained: f64) -> f64 {
        (self.misfit - explained) / self.heard.max(1.0)
    }

    /// For how long innovations have told of a fault of a group, s: as long as it has lasted where they do so evenly, less where most was told at its begin.
    pub(super) fn told_for(&self, group: usize) -> f64 {
        let information = self.information[group].trace();
        if information > 0.0 { 2.0 * self.aged[group] / information } else { 0.0 }
    }

    /// Sizes a fault of a group; `None` where the numbers are none. `unsure` is how many times as uncertain as
    /// stated the innovations are, as variances.
    #[must_use]
    pub(super) fn sized(&self, group: usize, unsure: f64) -> Option<Sized> {
        let s = ALL[group].size;
        let (information, evidence) =
            (self.information[group] / unsure, self.evidence[group] / unsure);
        let factor = Cholesky::new(Matrix3::identity() + information * (s * s))?;
        let value = factor.solve(&evidence) * (s * s);
        let explained = value.dot(&self.evidence[group]);
        let volume: f64 = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        let covariance = factor.inverse() * (s * s);
        Some(Sized {
            log_factor: 0.5 * value.dot(&evidence) - volume,
            explained,
            value,
            covariance,
        })
    }

    /// The logarithm of the ratio of likelihoods of a fault of a group that has such a size, with it over without.
    pub(super) fn odds(&self, group: usize, value: &Vector3<f64>) -> f64 {
        value.dot(&self.evidence[group]) - 0.5 * value.dot(&(self.information[group] * value))
    }

    /// Whether nothing that was heard since could have told of a fault of a group.
    pub(super) fn is_blind_to(&self, group: usize) -> bool {
        self.information[group] == Matrix3::zeros()
    }

    /// Whether nothing was heard since that tells of a fault of a group where she is. The heading of antennas goes on where ranges are too few for a fix, and an
    /// estimate by fixes alone knows nothing of those.
    pub(super) fn is_untold(&self, group: usize) -> bool {
        let is_own = ALL[group].fault.party() == Party::Antennas;
        self.is_blind_to(group) || !(self.told[group] || is_own)
    }

    /// What a unit of each component of a group has done to blocks of three states, a column for each component.
    pub(super) fn places(&self, group: &FaultGroup, blocks: [Block<3>; 2]) -> [Matrix3<f64>; 2] {
        let width = group.rows.len();
        blocks.map(|block| {
            let mut of = Matrix3::zeros();
            if let Some(start) = self.effects.layout().start(block.key()) {
                let rows = self.effects.matrix().view((group.rows.start, start), (width, 3));
                of.columns_mut(0, width).copy_from(&rows.transpose());
            }
            of
        })
    }

    /// What a unit of each component of a group has done to the errors.
    pub(super) fn effects_of(&self, group: &FaultGroup) -> Effects {
        self.effects.some(group.rows.start, group.rows.len())
    }

    /// What such a fault has done to the errors; the covariance of theirs is as much wider as its size is not known.
    pub(super) fn correct(&self, group: &FaultGroup, sized: &Sized, p: &mut Covariance) -> Errors {
        let width = group.rows.len();
        let own = self.effects.some(group.rows.start, width);
        p.spread_by(&own, &sized.covariance.view((0, 0), (width, width)).clone_owned());
        own.total(&sized.value.as_slice()[..width])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_told_at_a_begin_was_told_for_a_short_time_and_what_is_told_evenly_for_all_of_it() {
        let told = |ages: std::ops::Range<u32>| {
            let mut own = Onset::new(Time::START, rows::USUAL_ROWS);
            for age in ages {
                own.information[0][(0, 0)] += 1.0;
                own.aged[0] += f64::from(age);
            }
            own.told_for(0)
        };
        assert!((told(0..101) - 100.0).abs() < 1e-9);
        assert!((told(0..5) - 4.0).abs() < 1e-9);
        assert!(told(0..0).abs() < 1e-9);
    }
}
