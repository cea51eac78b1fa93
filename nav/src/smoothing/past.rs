//! What a filter keeps of its way, so that it can be smoothed afterwards.
//!
//! Once in a while, where its covariance is settled, it puts away its estimate, its covariance and the trail since the last time
//! ([`insd_estimation::ErrorTrail`]); at the instants at which the smoothed solution is wanted, the estimate alone. What is kept hangs together from the newest
//! to the oldest, and a copy of the filter shares it: who goes back to a checkpoint for a late measurement goes back to what was kept by then, and what is
//! left in the end is of those states alone that are final.

use std::sync::Arc;

use insd_base::Time;
use insd_estimation::{Covariance, KeptCovariance, KeptTrail, Layout};
use nalgebra::{SVector, UnitQuaternion, Vector3};

use crate::dating::Dating;
use crate::error_state::{ATTITUDE, Errors, GNSS_DELAY, POSITION, VELOCITY};
use crate::nominal::Nominal;
use crate::smoothing::plan::SmoothingPlan;

/// Errors that are smoothed: position, velocity and attitude, ECEF axes, m, m/s and rad, and the delay of GNSS, s.
pub(crate) type Apart = SVector<f64, 10>;

/// What a solution is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct KeptEstimate {
    pub(crate) time: Time,
    pub(crate) position: Vector3<f64>,
    pub(crate) velocity: Vector3<f64>,
    pub(crate) attitude: UnitQuaternion<f64>,
    pub(crate) delay: f64,
    /// Angular rate with respect to inertial space, body axes, rad/s.
    pub(crate) rate: Vector3<f64>,
    /// Acceleration of the antenna, ECEF axes, m/s^2.
    pub(crate) acceleration: Vector3<f64>,
    /// By what it has been corrected since the epoch before, in all.
    pub(crate) moved: Apart,
}

/// An instant of which enough is kept to smooth it, with what lies between it and the one before.
#[derive(Debug)]
pub struct KeptEpoch {
    pub(crate) estimate: KeptEstimate,
    pub(crate) covariance: KeptCovariance,
    pub(crate) dating: Dating,
    /// What became of the errors since the epoch before; `None` where nobody can tell, and nothing is smoothed across.
    pub(crate) trail: Option<KeptTrail>,
    /// Estimates in between, in the order of time.
    pub(crate) rows: Box<[KeptEstimate]>,
    pub(crate) before: Option<Arc<KeptEpoch>>,
}

impl Drop for KeptEpoch {
    /// One after the other: each dropping the one before would need a stack as long as the voyage.
    fn drop(&mut self) {
        let mut before = self.before.take();
        while let Some(mut epoch) = before.and_then(Arc::into_inner) {
            before = epoch.before.take();
        }
    }
}

/// What has been kept so far.
#[derive(Clone, Debug)]
pub(crate) struct Past {
    pub(crate) plan: SmoothingPlan,
    pub(crate) newest: Option<Arc<KeptEpoch>>,
    wanted: Layout,
    moved: Apart,
    rows: Vec<KeptEstimate>,
    /// Number of the next row, in periods since the start.
    next_row: i64,
}

impl Past {
    /// Nothing yet at an instant, after what was kept before it.
    pub(crate) fn new(plan: SmoothingPlan, before: Option<Arc<KeptEpoch>>, now: Time) -> Self {
        let next_row = now.as_nanos().div_euclid(plan.period.as_nanos().max(1)) + 1;
        let (wanted, moved) = (smoothed_states(), Apart::zeros());
        Past { plan, newest: before, wanted, moved, rows: Vec::new(), next_row }
    }

    /// Instant of the next row.
    pub(crate) fn next_row(&self) -> Time {
        Time::from_nanos(self.next_row.saturating_mul(self.plan.period.as_nanos().max(1)))
    }

    pub(crate) fn keep_row(&mut self, estimate: &KeptEstimate) {
        self.rows.push(KeptEstimate { moved: self.moved, ..*estimate });
        self.next_row += 1;
    }

    /// Takes note that the estimate was corrected.
    pub(crate) fn note(&mut self, error: &Errors) {
        self.moved += apart(error);
    }

    pub(crate) fn is_due(&self, now: Time) -> bool {
        let since = self.newest.as_ref().map(|epoch| (now - epoch.estimate.time).as_seconds());
        since.is_none_or(|since| since >= self.plan.interval - 1e-6)
    }

    /// Keeps an epoch, and begins another trail.
    pub(crate) fn keep(&mut self, estimate: &KeptEstimate, dating: Dating, p: &mut Covariance) {
        let trail = p.begin_trail().map(|trail| trail.kept());
        let moved = std::mem::replace(&mut self.moved, Apart::zeros());
        self.newest = Some(Arc::new(KeptEpoch {
            estimate: KeptEstimate { moved, ..*estimate },
            covariance: KeptCovariance::of(p, &self.wanted),
            dating,
            trail,
            rows: self.rows.drain(..).collect(),
            before: self.newest.take(),
        }));
    }
}

impl KeptEstimate {
    /// Of an estimate at an instant.
    pub(crate) fn of(
        time: Time,
        nominal: &Nominal,
        rate: &Vector3<f64>,
        acceleration: &Vector3<f64>,
    ) -> Self {
        KeptEstimate {
            time,
            position: nominal.position,
            velocity: nominal.velocity,
            attitude: nominal.attitude,
            delay: nominal.gnss_delay,
            rate: *rate,
            acceleration: *acceleration,
            moved: Apart::zeros(),
        }
    }
}

/// The states that are smoothed, in the order in which the claims of a solution are made of them.
fn smoothed_states() -> Layout {
    let strapdown = [POSITION, VELOCITY, ATTITUDE].map(|block| (block.key(), 3));
    Layout::of_blocks(strapdown.into_iter().chain([(GNSS_DELAY.key(), 1)]))
}

/// Their errors.
pub(crate) fn apart(error: &Errors) -> Apart {
    let mut apart = Apart::zeros();
    for (block, at) in [(POSITION, 0), (VELOCITY, 3), (ATTITUDE, 6)] {
        apart.fixed_rows_mut::<3>(at).copy_from(&error.of(block));
    }
    apart[9] = error.of(GNSS_DELAY).x;
    apart
}
