//! The voyage as it is known afterwards: each instant with all that was measured before and after it.
//!
//! Backwards over what the filter has kept ([`past`]), the errors of each epoch are found from what was measured after it
//! ([`insd_estimation::Hindsight`]: the smoother of Rauch, Tung and Striebel in the form of Bryson and Frazier, over the error states around the
//! filter's own estimate; Crassidis and Junkins, Optimal Estimation of Dynamic Systems, section 5.1). Between epochs the filter's estimate is taken as it would
//! have gone on without the corrections since the epoch before, which is smooth, and what it lacks at both ends is interpolated.
//!
//! Where nobody can tell what became of the errors - an estimate was given up for that of a judge, or for another filter's - the pass is cut: what is before is
//! smoothed without what comes after.

mod past;
pub(crate) mod plan;

use std::sync::Arc;

use insd_base::{Attitude, Geodetic, Ned, SolutionSigma, Time};
use insd_estimation::Hindsight;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::aids::View;
use crate::dating::Dating;
use crate::nominal::Nominal;
use crate::solution_sigma::solution_sigma;
pub use past::KeptEpoch;
use past::{Apart, apart};
pub(crate) use past::{KeptEstimate, Past};
pub use plan::SmoothingPlan;

/// Where the ship was, how she moved and lay, at the IMU, and how sure that is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoothed {
    /// Time of validity.
    pub time: Time,
    /// Position.
    pub position: Geodetic,
    /// Velocity over the Earth, m/s.
    pub velocity: Ned,
    /// Roll, pitch, heading.
    pub attitude: Attitude,
    /// 1-sigma of the above.
    pub sigma: SolutionSigma,
}

/// A voyage, smoothed.
#[derive(Clone, Debug, Default)]
pub struct SmoothedVoyage {
    /// Rows at whole multiples of the period, in the order of time.
    pub rows: Vec<Smoothed>,
    /// Instants that nothing is smoothed across: the stretches before and after each know nothing of one another.
    pub cuts: Vec<Time>,
    /// Instants that were smoothed by themselves.
    pub epochs: usize,
}

impl SmoothedVoyage {
    /// With another part of the voyage after it.
    #[must_use]
    pub fn followed_by(mut self, other: Self) -> Self {
        self.rows.extend(other.rows);
        self.cuts.extend(other.cuts);
        SmoothedVoyage { epochs: self.epochs + other.epochs, ..self }
    }
}

/// An epoch, smoothed.
struct Found {
    time: Time,
    error: Apart,
    sigma: SolutionSigma,
}

/// Smooths what a filter has kept, from its newest epoch back to its oldest.
#[must_use]
pub fn smoothed(newest: &Arc<KeptEpoch>) -> SmoothedVoyage {
    let mut voyage = SmoothedVoyage::default();
    let mut hindsight = Hindsight::none();
    let mut at_end = found(newest, &hindsight);
    let mut epoch = newest;
    loop {
        voyage.epochs += 1;
        hindsight = epoch.trail.as_ref().map_or_else(Hindsight::none, |own| hindsight.before(own));
        let Some(before) = &epoch.before else { break };
        let at_begin = found(before, &hindsight);
        let is_cut = epoch.trail.is_none();
        voyage.cuts.extend(is_cut.then_some(epoch.estimate.time));
        let moved = epoch.estimate.moved;
        let row = |row: &KeptEstimate| match is_cut {
            true => as_it_was(row, &at_begin, &epoch.dating),
            false => between(row, &at_begin, (&at_end, &moved), &epoch.dating),
        };
        voyage.rows.extend(epoch.rows.iter().rev().map(row));
        (epoch, at_end) = (before, at_begin);
    }
    voyage.rows.reverse();
    voyage.cuts.reverse();
    voyage
}

fn found(epoch: &KeptEpoch, hindsight: &Hindsight) -> Found {
    let (error, p) = hindsight.of(&epoch.covariance);
    let error = apart(&error);
    let view =
        view_of(&epoch.estimate, &error).at_gnss_time(&epoch.estimate.acceleration, &epoch.dating);
    let sigma = solution_sigma(&view, &epoch.estimate.acceleration, &epoch.dating, &p);
    Found { time: epoch.estimate.time, error, sigma }
}

/// Between two epochs: what the filter's estimate lacks is interpolated, once it is rid of the corrections since the first.
fn between(
    row: &KeptEstimate,
    begin: &Found,
    (end, moved): (&Found, &Apart),
    dating: &Dating,
) -> Smoothed {
    let whole = (end.time - begin.time).as_seconds();
    let share = if whole > 0.0 { (row.time - begin.time).as_seconds() / whole } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    let lacks = begin.error * (1.0 - share) + (end.error + moved) * share - row.moved;
    let mean = |a: f64, b: f64| (a * a * (1.0 - share) + b * b * share).sqrt();
    told(row, &lacks, dating, &begin.sigma.zip(&end.sigma, mean))
}

/// Where the pass is cut: what the filter told.
fn as_it_was(row: &KeptEstimate, begin: &Found, dating: &Dating) -> Smoothed {
    told(row, &Apart::zeros(), dating, &begin.sigma)
}

fn told(row: &KeptEstimate, error: &Apart, dating: &Dating, sigma: &SolutionSigma) -> Smoothed {
    let view = view_of(row, error).at_gnss_time(&row.acceleration, dating);
    Smoothed {
        time: row.time,
        position: view.geodetic,
        velocity: Ned(view.v_n()),
        attitude: view.attitude(),
        sigma: *sigma,
    }
}

/// The estimate with its error taken out.
fn view_of(kept: &KeptEstimate, error: &Apart) -> View {
    let none = Geodetic::from_degrees(0.0, 0.0, 0.0);
    let mut nominal = Nominal::at(&none, &Vector3::zeros(), &Matrix3::identity());
    nominal.position = kept.position + error.fixed_rows::<3>(0);
    nominal.velocity = kept.velocity + error.fixed_rows::<3>(3);
    nominal.attitude = UnitQuaternion::new(error.fixed_rows::<3>(6).into_owned()) * kept.attitude;
    nominal.gnss_delay = kept.delay + error[9];
    View::new(&nominal, &kept.rate, 0.0)
}
