//! An epoch solved from an assumed pose: integers by rounding, pose and line biases by least squares, satellites that do not fit left out.

use nalgebra::{DMatrix, DVector, Matrix3};
use statrs::function::erf::erf;

use super::align::{Loose, align};
use super::lines::LineBiases;
use super::model::{Model, of_antennas};
use super::pose::CompassPose;
use super::prior::CompassPrior;
use super::settings::CompassShape;
use super::signal::Common;
use crate::least_squares::{Normal, Solved};

/// 1-sigma of a pose of which nothing is known, rad or m.
const ANYWHERE: f64 = 10.0;
/// What a signal that is left out counts for among hypotheses: as much as the worst that is kept.
const LEFT_OUT: f64 = 30.0;
/// At most one of so many signals is left out.
const SHARE: usize = 3;

/// Where an epoch begins.
#[derive(Clone, Debug)]
pub(super) struct Start {
    pub(super) pose: CompassPose,
    /// Its covariance, rad^2 or m^2; it tells how sure rounding is, and does not weigh.
    pub(super) covariance: Matrix3<f64>,
    pub(super) lines: LineBiases,
}

impl Start {
    /// Begins at what is known beforehand where that is better known, and does not contradict what has been followed.
    pub(super) fn helped(&mut self, prior: &CompassPrior) {
        const FAR: f64 = 5.0;
        let Some(own) = prior.attitude.filter(|own| own.std.iter().all(|x| x.is_finite())) else {
            return;
        };
        let CompassPose::Attitude(_) = self.pose else { return };
        let pose = CompassPose::Attitude(own.c_nb);
        let covariance = Matrix3::from_diagonal(&own.std.map(|x| x * x));
        let off = pose.error_of(&self.pose);
        let both: Matrix3<f64> = covariance + self.covariance;
        let far = both.cholesky().map_or(f64::INFINITY, |both| off.dot(&both.solve(&off)));
        if covariance.trace() < self.covariance.trace() && far < FAR * FAR {
            (self.pose, self.covariance) = (pose, covariance);
        }
    }
}

/// A signal that does not fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Misfit {
    pub(super) common: usize,
    pub(super) residual: f64,
    pub(super) times: f64,
}

/// An epoch as it comes out.
#[derive(Clone, Debug)]
pub(super) struct Outcome {
    pub(super) pose: CompassPose,
    pub(super) covariance: Matrix3<f64>,
    pub(super) lines: LineBiases,
    /// Integers of each signal: of each antenna against the first.
    pub(super) integers: Vec<Vec<f64>>,
    /// What is left of each signal, m, likewise.
    pub(super) residuals: Vec<DVector<f64>>,
    /// Which signals are used.
    pub(super) used: Vec<bool>,
    pub(super) misfits: Vec<Misfit>,
    /// Weighed squares of the residuals of what is used, and degrees of freedom.
    pub(super) misfit: (f64, usize),
    pub(super) success: f64,
}

impl Outcome {
    /// Variance of the residuals over that assumed.
    pub(super) fn level(&self) -> f64 {
        self.misfit.0 / self.misfit.1.max(1) as f64
    }

    /// By how much an antenna may be off in the pose, m; the greatest 1-sigma.
    pub(super) fn unsure(&self, shape: &CompassShape) -> f64 {
        let antennas = match shape {
            CompassShape::Body(levers) => levers.len(),
            CompassShape::Baseline { .. } => 2,
        };
        let off = |antenna| {
            let jacobian = self.pose.jacobian(shape, antenna);
            let covariance: Matrix3<f64> = jacobian * self.covariance * jacobian.transpose();
            covariance.symmetric_eigenvalues().max()
        };
        (0..antennas).map(off).fold(0.0, f64::max).sqrt()
    }

    /// Weighed squares over what chance makes them exceed once in a million, what is left out included.
    pub(super) fn times(&self) -> f64 {
        let (misfit, count) = self.evidence();
        misfit / limit((count as usize).max(1))
    }

    /// Misfit and measurements as hypotheses are weighed by: what is left out counts.
    pub(super) fn evidence(&self) -> (f64, f64) {
        let left_out = self.misfits.len() as f64;
        (self.misfit.0 + LEFT_OUT * left_out, self.misfit.1 as f64 + left_out)
    }
}

/// One pass of least squares.
struct Pass {
    pose: CompassPose,
    lines: LineBiases,
    integers: Vec<Vec<f64>>,
    solved: Solved,
}

/// Solves an epoch. `None` where nothing determines it.
pub(super) fn solve(model: &Model<'_>, start: &Start) -> Option<Outcome> {
    let mut lines = start.lines.clone();
    let loose = align(model, &start.pose, &mut lines);
    let success = success(model, start, &loose);
    let information = lines.information()?;
    let mut used = vec![true; model.commons.len()];
    let mut misfits: Vec<Misfit> = Vec::new();
    loop {
        let pass = iterate(model, &start.pose, (&lines, &information), &used)?;
        let residuals = residuals(model, &pass);
        let worst = worst(model, &pass, &residuals, &used);
        let allowed = misfits.len() < model.commons.len() / SHARE
            && !(misfits.is_empty() && is_hopeless(model, &residuals));
        if let Some(worst) = worst.filter(|_| allowed) {
            used[worst.common] = false;
            misfits.push(worst);
            continue;
        }
        let moved = &pass.lines.mean - &lines.mean;
        let mut misfit = moved.dot(&(&information * &moved));
        for ((common, left), used) in model.commons.iter().zip(&residuals).zip(&used) {
            if *used {
                misfit += common.squares(left);
            }
        }
        let (by_length, known) = by_length(model.shape(), &pass.pose);
        let freedom = freedom(model, &loose, &used) + known;
        return Some(told(
            &pass,
            (residuals, used, misfits),
            (misfit + by_length, freedom),
            success,
        ));
    }
}

fn told(
    pass: &Pass,
    (residuals, used, misfits): (Vec<DVector<f64>>, Vec<bool>, Vec<Misfit>),
    misfit: (f64, usize),
    success: f64,
) -> Outcome {
    let covariance = &pass.solved.covariance;
    let count = pass.lines.keys.len();
    let mut lines = pass.lines.clone();
    lines.covariance = covariance.view((3, 3), (count, count)).into();
    Outcome {
        pose: pass.pose,
        covariance: covariance.fixed_view::<3, 3>(0, 0).into(),
        lines,
        integers: pass.integers.clone(),
        residuals,
        used,
        misfits,
        misfit,
        success,
    }
}

/// Rounds and solves until the integers stand.
fn iterate(
    model: &Model<'_>,
    start: &CompassPose,
    (assumed, information): (&LineBiases, &DMatrix<f64>),
    used: &[bool],
) -> Option<Pass> {
    const ROUNDS: usize = 8;
    const STANDS: f64 = 1e-7;
    let (mut pose, mut lines) = (*start, assumed.clone());
    let mut last: Option<Pass> = None;
    for _ in 0..ROUNDS {
        let (integers, left) = rounded(model, &pose, &lines);
        let count = lines.keys.len();
        let mut normal = Normal::new(3 + count);
        for place in 0..3 {
            normal.know(place, 0.0, ANYWHERE);
        }
        if count > 0 {
            let rows = DMatrix::from_fn(count, 3 + count, |i, j| f64::from(u8::from(j == 3 + i)));
            normal.add(&rows, &(&assumed.mean - &lines.mean), information);
        }
        for ((common, left), used) in model.commons.iter().zip(&left).zip(used) {
            if *used {
                let full = of_antennas(left);
                normal.add(&model.design(common, &pose, &lines), &full, &common.weight());
            }
        }
        let solved = normal.solve()?;
        let error = solved.unknowns.fixed_rows::<3>(0).into_owned();
        if !error.iter().all(|x| x.abs() < ANYWHERE) {
            return None;
        }
        pose = pose.corrected(&error);
        lines.mean += solved.unknowns.rows(3, count);
        let same = last.as_ref().is_some_and(|last| last.integers == integers);
        let stands = same && solved.unknowns.amax() < STANDS;
        last = Some(Pass { pose, lines: lines.clone(), integers, solved });
        if stands {
            break;
        }
    }
    last
}

/// The integers of all differences in a pose, and what is left of them, m.
fn rounded(
    model: &Model<'_>,
    pose: &CompassPose,
    lines: &LineBiases,
) -> (Vec<Vec<f64>>, Vec<DVector<f64>>) {
    let offsets = model.offsets(pose);
    let one = |common: &Common| {
        let against = &common.heard[0];
        let all = common.heard[1..].iter().map(|own| {
            let left = model.difference(common, (own, against), &offsets, lines);
            let integer = (left / common.wavelength).round();
            (integer, left - integer * common.wavelength)
        });
        let (integers, left): (Vec<f64>, Vec<f64>) = all.unzip();
        (integers, DVector::from_vec(left))
    };
    model.commons.iter().map(one).unzip()
}

/// What is left of all differences with the integers that were found, m.
fn residuals(model: &Model<'_>, pass: &Pass) -> Vec<DVector<f64>> {
    let offsets = model.offsets(&pass.pose);
    let one = |(common, integers): (&Common, &Vec<f64>)| {
        let left = common.heard[1..].iter().zip(integers).map(|(own, integer)| {
            let pair = (own, &common.heard[0]);
            model.difference(common, pair, &offsets, &pass.lines) - integer * common.wavelength
        });
        DVector::from_iterator(integers.len(), left)
    };
    model.commons.iter().zip(&pass.integers).map(one).collect()
}

/// Whether the better two thirds of the signals are so far from fitting that leaving out the others is of no use.
fn is_hopeless(model: &Model<'_>, residuals: &[DVector<f64>]) -> bool {
    const HOPELESS: f64 = 16.0;
    let level =
        |(common, left): (&Common, &DVector<f64>)| common.squares(left) / left.len().max(1) as f64;
    let mut levels: Vec<f64> = model.commons.iter().zip(residuals).map(level).collect();
    levels.sort_by(f64::total_cmp);
    let better = levels.len() - levels.len() / SHARE;
    levels[..better].iter().sum::<f64>() > HOPELESS * better as f64
}

/// The signal that fits worst, if chance makes one as bad less than once in a million.
fn worst(
    model: &Model<'_>,
    pass: &Pass,
    residuals: &[DVector<f64>],
    used: &[bool],
) -> Option<Misfit> {
    let one = |(place, common): (usize, &Common)| {
        let difference = common.against_first();
        let design = &difference * model.design(common, &pass.pose, &pass.lines);
        let noise = common.covariance();
        let drawn = &design * &pass.solved.covariance * design.transpose();
        // a share of the noise: what nothing checks is no misfit
        let covariance = &noise * 1.001 - drawn;
        let left = &residuals[place];
        let squares = left.dot(&covariance.cholesky()?.solve(left));
        let times = squares / limit(left.len());
        (times > 1.0).then(|| Misfit { common: place, residual: left.amax(), times })
    };
    let kept = model.commons.iter().enumerate().filter(|(place, _)| used[*place]);
    kept.filter_map(one).max_by(|a, b| a.times.total_cmp(&b.times))
}

/// What chance makes a sum of so many squares exceed once in a million (Wilson and Hilferty 1931).
fn limit(freedom: usize) -> f64 {
    const RARE: f64 = 4.753;
    let share = 2.0 / (9.0 * freedom as f64);
    freedom as f64 * (1.0 - share + RARE * share.sqrt()).powi(3)
}

/// Differences in use less what they have to tell.
fn freedom(model: &Model<'_>, loose: &Loose, used: &[bool]) -> usize {
    let kept = model.commons.iter().zip(used).filter(|own| *own.1);
    let rows: usize = kept.map(|(common, _)| common.heard.len() - 1).sum();
    // a line through two antennas has no turn about itself
    let is_line = matches!(model.shape(), CompassShape::Body(levers) if levers.len() == 2);
    let fresh = loose.fresh.iter().filter(|fresh| **fresh).count();
    rows.saturating_sub(if is_line { 2 } else { 3 } + fresh + loose.clocks)
}

/// What a known length has to say of a baseline, and how many measurements it is.
fn by_length(shape: &CompassShape, pose: &CompassPose) -> (f64, usize) {
    match (shape, pose) {
        (CompassShape::Baseline { length: Some((length, std)) }, CompassPose::Baseline(b)) => {
            (((b.norm() - length) / std).powi(2), 1)
        }
        _ => (0.0, 0),
    }
}

/// The chance that rounding all differences from where an epoch begins finds their integers: the product of those of each, which is no better than that of all
/// together (Sidak 1967).
fn success(model: &Model<'_>, start: &Start, loose: &Loose) -> f64 {
    let is_loose = |place: usize| loose.fresh.get(place).copied().unwrap_or(true);
    let mut success = 1.0;
    for common in model.commons {
        let against = &common.heard[0];
        let of_line = |line| start.lines.place(line).filter(|place| !is_loose(*place));
        let jacobian = |antenna| start.pose.jacobian(model.shape(), antenna);
        for own in &common.heard[1..] {
            let by_pose = (jacobian(own.antenna) - jacobian(against.antenna)).transpose()
                * common.line_of_sight;
            let turned = by_pose.dot(&(start.covariance * by_pose));
            // beyond a wavelength a line is found by the epoch itself
            let line = of_line(&own.line).map_or(0.0, |p| start.lines.covariance[(p, p)]);
            let line = line.min((0.1 * common.wavelength).powi(2));
            let sigma = (turned + line + own.variance + against.variance).sqrt();
            let root = 2.0 * std::f64::consts::SQRT_2;
            success *= erf(common.wavelength / (root * sigma));
        }
    }
    success
}
