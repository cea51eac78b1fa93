//! An autoregressive model of the ship's displacement at her berth takes the sea out before the Kalman filter.
//!
//! Every few seconds her displacement d from the berth enters a sliding window ([`SeaWindow`]), which knows by A(q) what
//! the sea makes of the next from those before. What the filter is told is not the displacement but what A(q) did not
//! foretell of it, with a measurement matrix that went through the same A(q): of
//!
//! z(k) = o - d(k) = -H(k) dx(k) + sea,   A(q) z(k) = -[H(k) - sum A_i H(k-i)] dx(k) + eps(k),
//!
//! eps is white, and nothing of dx is lost: no trend is taken off, and an error that looks like the sea counts for as
//! little as it is worth. H(k-i) is over the error of now ([`Hindsight`]). The sea needs no assumed band; that of these
//! moorings and this swell is learnt. The whitening is that of an observation with coloured noise (Bryson and
//! Henrikson, J. Spacecraft and Rockets 5 (1968)).
//!
//! The model is in the axes of the ship, where surge and sway differ and a heading that is not known yet does not matter:
//! every filter of the bank sees the same motion, and all take the sea for what the likeliest has learnt.
//!
//! Before it has been learnt it is one of some kinds of sea, which are weighed by how well each foretells the next
//! displacement, given what the filter knows of its own errors. That tells a band within a period or two. A displacement
//! is learnt from when the filter has corrected it for a while, and as far as it is known to be the ship's and not the
//! navigator's own error; where most of it is the navigator's, for a while longer.

use std::collections::VecDeque;

use insd_base::{Geodetic, SeaFit, SeaQuantity, Span, Time};
use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::hindsight::Hindsight;
use super::learner::{SeaLearner, SeaLearnerCheckpoint, WhitenedSea};
use super::seen::Seen;
use super::shifts::Shifts;
use super::sight::{BerthSample, SeaSight};
use super::stated::{OFFSET_SHARE, UNSTATED, UNSURVEYED};
use crate::Filter;
use crate::aids::reference_position;
use crate::disturbance::{Displacement, Model, Whitener, WhiteningConfig};
use crate::error_state::{ATTITUDE, BERTH_OFFSET, Errors, Innovation, POSITION};
use crate::method::Method;

/// Holds a filter at the berth by its whitened displacement.
#[derive(Clone, Debug)]
pub struct Whitened {
    config: WhiteningConfig,
    place: Geodetic,
    is_named: bool,
    sea: SeaLearner,
    /// Displacements from the berth, newest first, as the filter sees them now, north and east, m.
    past: VecDeque<Vector2<f64>>,
    /// So many of them are still to be learnt from.
    unlearnt: usize,
    next: Time,
    shifts: Shifts,
}

/// What is kept of it for the next start of the program: the displacements that the filter still corrects are begun anew.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct WhitenedCheckpoint {
    place: Geodetic,
    is_named: bool,
    sea: SeaLearnerCheckpoint,
    shifts: Shifts,
}

/// Samples that a displacement is corrected for before it is learnt from where the navigator's own error has a smaller variance
/// than the ship's displacement; otherwise those of the model's order come on top.
const DELAY: usize = 3;

impl Whitened {
    /// Takes the ship as lying where the filter has her, until a reference names the berth.
    #[must_use]
    pub fn new(filter: &mut Filter) -> Self {
        let (config, now) = (*filter.whitening(), filter.time());
        let spacing = config.spacing.as_seconds();
        filter.lie(UNSURVEYED);
        Whitened {
            config,
            place: filter.nominal().geodetic(),
            is_named: false,
            sea: SeaLearner::new(&config, UNSTATED),
            past: VecDeque::new(),
            unlearnt: 0,
            next: now + config.spacing,
            shifts: Shifts::new(now, spacing),
        }
    }

    /// What is worth keeping of it.
    pub(super) fn kept(&self) -> WhitenedCheckpoint {
        WhitenedCheckpoint {
            place: self.place,
            is_named: self.is_named,
            sea: self.sea.kept(),
            shifts: self.shifts.clone(),
        }
    }

    /// Goes on from what was kept, on a time line that is later by a span; `None` if it is of other kinds of sea.
    pub(super) fn taken_up(kept: &WhitenedCheckpoint, filter: &Filter, by: Span) -> Option<Self> {
        let config = *filter.whitening();
        Some(Whitened {
            config,
            place: kept.place,
            is_named: kept.is_named,
            sea: SeaLearner::taken_up(&config, &kept.sea)?,
            past: VecDeque::new(),
            unlearnt: 0,
            next: filter.time() + config.spacing,
            shifts: kept.shifts.clone().shifted(by),
        })
    }

    /// A reference names the berth and, if `stated`, the ship's displacement from it, 1-sigma of each
    /// component, m. To name the same berth again tells nothing new.
    pub fn name_berth(&mut self, filter: &mut Filter, place: &Geodetic, stated: Option<f64>) {
        let same = place.latitude == self.place.latitude && place.longitude == self.place.longitude;
        if same && self.is_named {
            return;
        }
        let std = stated.unwrap_or(UNSTATED);
        self.place = *place;
        self.is_named = true;
        self.past.clear();
        self.unlearnt = 0;
        self.sea.restate(std);
        filter.lie((OFFSET_SHARE * std).hypot(filter.berth_doubt()));
    }

    /// How often her mean place was found to have shifted.
    #[must_use]
    pub fn shifts(&self) -> u32 {
        self.shifts.count()
    }

    /// Displacements from her mean place, forward and to starboard, m, newest first: as many as the filter still
    /// corrects.
    #[must_use]
    pub fn displacements(&self, filter: &Filter) -> Vec<Vector2<f64>> {
        let (axes, offset) = (Hindsight::of(filter).ship_axes(), filter.nominal().berth_offset);
        self.past.iter().map(|d| axes.tr_mul(&(d - offset))).collect()
    }

    /// The sea as it is taken for now: a model of the displacement forward and to starboard, m.
    #[must_use]
    pub fn model(&self) -> Option<Model> {
        let whitener = self.whitener()?;
        let lags = whitener.coefficients().to_vec();
        Some(Model::new(lags, *whitener.residual_covariance(), self.config.spacing.as_seconds()))
    }

    /// The sea as it is taken for, what of it was seen, and how well the one fits the other.
    pub(super) fn sight(&self) -> Option<SeaSight> {
        Some(SeaSight {
            method: Some(Method::Autoregressive),
            model: self.model()?,
            quantity: SeaQuantity::Displacement,
            samples: self.sea.samples(),
            fit: self.sea.fit(),
        })
    }

    /// How well the sea fits that is taken for hers.
    #[must_use]
    pub fn fit(&self) -> Option<SeaFit> {
        self.sea.fit()
    }

    /// What she has told of the sea.
    #[must_use]
    pub fn learnt(&self) -> WhitenedSea {
        self.sea.learnt()
    }

    /// From now on the sea is what another has learnt; nothing for what she learns herself.
    pub fn lend(&mut self, sea: Option<WhitenedSea>) {
        self.sea.lend(sea);
    }

    /// A(q) as it is now.
    fn whitener(&self) -> Option<Whitener> {
        self.sea.whitener(self.past.len())
    }

    /// Holds the filter against the berth if it is time to; returns the log-likelihood.
    pub fn hold(&mut self, filter: &mut Filter) -> f64 {
        let now = filter.time();
        if now < self.next {
            return 0.0;
        }
        self.take_sample(filter)
    }

    /// Takes the next sample and holds the filter by it; apart, so that a step without one costs nothing.
    #[inline(never)]
    fn take_sample(&mut self, filter: &mut Filter) -> f64 {
        let now = filter.time();
        self.bridge(now);
        self.next = now + self.config.spacing;
        filter.settle();
        let hindsight = Hindsight::of(filter);
        let spacing = self.config.spacing.as_seconds();
        self.correct(filter, &hindsight, spacing);
        let displacement = self.displacement(filter);
        let seen = self.seen(filter, &hindsight, &displacement);
        self.sea.weigh_kinds(filter, &seen);
        let likelihood = self.whitener().map_or(0.0, |whitener| {
            let innovation = whiten(&hindsight.ship_axes(), &seen, &whitener);
            let away = (filter.nominal().berth_offset - displacement).norm();
            let told = self.shifts.impose(filter, &innovation, away);
            let is_telling = self.shifts.is_settled(now) && !self.shifts.is_free(now);
            if let Some(residual) = told.residual.filter(|_| is_telling) {
                self.sea.judge(residual);
            }
            told.likelihood
        });
        self.past.push_front(displacement);
        self.unlearnt += 1;
        self.correct(filter, &hindsight, 0.0);
        self.learn(filter, &hindsight);
        likelihood
    }

    /// What the berth says next.
    pub(super) fn sample(&self, filter: &Filter) -> Option<BerthSample> {
        let hindsight = Hindsight::of(filter);
        let seen = self.seen(filter, &hindsight, &self.displacement(filter));
        Some(BerthSample {
            innovation: whiten(&hindsight.ship_axes(), &seen, &self.whitener()?),
            spacing: self.config.spacing.as_seconds(),
            start: self.shifts.start(),
        })
    }

    /// Her displacement and those before.
    fn seen(&self, filter: &Filter, hindsight: &Hindsight, now: &Vector2<f64>) -> Seen {
        let before = self.past.iter().take(self.config.order);
        Seen::of(filter, hindsight, now, before, self.config.spacing.as_seconds())
    }

    /// What of her displacement is not foretold, and all of it, 1-sigma of a component, m.
    pub(super) fn sea_std(&self) -> Option<(f64, f64)> {
        let unforeseen = 0.5 * self.whitener()?.residual_covariance().trace();
        Some((unforeseen.sqrt(), self.sea.variance().sqrt()))
    }

    /// Samples that were missed break the past of those that come.
    fn bridge(&mut self, now: Time) {
        let missed = (now - self.next).as_seconds() > 0.5 * self.config.spacing.as_seconds();
        if missed && !self.past.is_empty() {
            self.past.clear();
            self.unlearnt = 0;
            self.sea.push(None);
        }
    }

    /// Where the estimate has her, from the berth, north and east, m.
    fn displacement(&self, filter: &Filter) -> Vector2<f64> {
        let off = reference_position::innovation(&filter.view(), &self.place, 0.0).z;
        -Vector2::new(off[0], off[1])
    }

    /// The displacements as if what was corrected since the last look, `age` seconds after the newest of them, had
    /// always been so.
    fn correct(&mut self, filter: &mut Filter, hindsight: &Hindsight, age: f64) {
        let error: Errors = filter.take_correction();
        if error == Errors::none() {
            return;
        }
        let spacing = self.config.spacing.as_seconds();
        let unturned = hindsight.unturned(&self.displacement(filter)).of(&error);
        for (lag, d) in self.past.iter_mut().enumerate() {
            let turned = hindsight.turn(d) * error.of(ATTITUDE);
            *d += unturned(age + lag as f64 * spacing) - turned;
        }
    }

    /// Learns from the displacements that are corrected as far as they need to be.
    fn learn(&mut self, filter: &Filter, hindsight: &Hindsight) {
        let own = own_variance(filter, hindsight);
        let kept = self.config.order + DELAY;
        let wait = if own < self.sea.variance() { DELAY } else { kept };
        let is_settled = self.shifts.is_settled(filter.time());
        let axes = hindsight.ship_axes();
        while self.unlearnt > wait {
            self.unlearnt -= 1;
            let seen = axes.tr_mul(&(self.past[self.unlearnt] - filter.nominal().berth_offset));
            let clearness = self.clearness(own, &seen);
            self.sea.push(is_settled.then_some(Displacement { seen, clearness }));
        }
        self.past.truncate(kept);
    }

    /// How clearly a displacement is the ship's, by her share in the variance of what is seen: little where much of it is
    /// the navigator's own error, m^2, which would be learnt as a sea that wanders as the navigator does.
    fn clearness(&self, own: f64, seen: &Vector2<f64>) -> f64 {
        let ship = self.sea.mean_square().max(0.5 * seen.norm_squared());
        let share = ship / (ship + own).max(f64::MIN_POSITIVE);
        share * share
    }
}

/// Variance of a component of the error of the displacement from her mean place, m^2.
fn own_variance(filter: &Filter, hindsight: &Hindsight) -> f64 {
    let p = filter.covariance();
    let to_level = hindsight.level();
    let across = to_level * POSITION.covariance_with(BERTH_OFFSET, p);
    let own = to_level * POSITION.covariance(p) * to_level.transpose() + BERTH_OFFSET.covariance(p)
        - across
        - across.transpose();
    0.5 * own.trace()
}

/// What A(q) does not foretell of what is seen; A(q) is in the axes of the ship.
fn whiten(axes: &Matrix2<f64>, seen: &Seen, whitener: &Whitener) -> Innovation {
    let lags = whitener.coefficients().iter().map(|a| axes * a * axes.transpose());
    let before: Vec<_> = seen.before().iter().map(|off| axes.tr_mul(off)).collect();
    let covariance = axes * whitener.covariance(&before) * axes.transpose();
    seen.whitened(lags, &covariance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Estimator;
    use crate::berth::prefiltered::tests as ship;

    /// Steps of the shared helpers in a sample.
    const STEPS: usize = 40;

    /// Displacements of two ships of which one is not navigated as she should be, and their filters.
    fn sailed(error: &Errors, samples: usize) -> (Whitened, Filter) {
        let mut filter = ship::filter(error);
        let mut whitened = Whitened::new(&mut filter);
        let still = ship::filter(&Errors::none());
        whitened.place = still.nominal().geodetic();
        for step in 0..samples * STEPS {
            filter.advance(&ship::increment(step));
            if step % STEPS == STEPS - 1 {
                let displacement = whitened.displacement(&filter);
                whitened.past.push_front(displacement);
            }
        }
        (whitened, filter)
    }

    #[test]
    fn a_corrected_filter_leaves_the_displacements_as_if_it_had_always_been_right() {
        let ((mut seen, mut wrong), (ideal, right)) =
            (sailed(&ship::errors(), 20), sailed(&Errors::none(), 20));
        let distance = |seen: &Whitened| {
            let pairs = seen.past.iter().zip(&ideal.past);
            pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
        };
        let before = distance(&seen);
        assert!(before > 0.5, "the errors make {before} m");
        wrong.settle();
        wrong.take_correction();
        wrong.join(&right, 1.0);
        let hindsight = Hindsight::of(&wrong);
        seen.correct(&mut wrong, &hindsight, 0.0);
        assert!(distance(&seen) < 0.005 * before, "{} m are left", distance(&seen));
    }

    #[test]
    fn a_turn_about_the_berth_does_not_show() {
        let filter = ship::filter(&ship::errors());
        let (hindsight, view) = (Hindsight::of(&filter), filter.view());
        let (d, v, turn) = (Vector2::new(0.7, -0.4), view.v_n().xy(), 0.01);
        let to_ecef = |across: Vector2<f64>| view.c_ne.transpose() * across.push(0.0);
        let mut error = Errors::none();
        error.set(ATTITUDE, &(view.c_ne.transpose() * nalgebra::Vector3::z() * turn));
        error.set(POSITION, &to_ecef(Vector2::new(-d.y, d.x) * turn));
        error.set(crate::error_state::VELOCITY, &to_ecef(Vector2::new(-v.y, v.x) * turn));
        let unturned = hindsight.unturned(&d);
        for age in [0.0, 4.0] {
            // within seconds the Earth does not turn the heading into a tilt
            let moved = unturned.rows(age).times(&error);
            assert!(moved.norm() < 0.02 * turn * d.norm(), "{moved}");
            assert!((moved - unturned.of(&error)(age)).norm() < 1e-12);
        }
    }

    /// A ship held for so many seconds.
    fn held(seconds: usize) -> Whitened {
        let mut filter = ship::filter(&ship::errors());
        let mut whitened = Whitened::new(&mut filter);
        for step in 0..seconds * 10 {
            filter.advance(&ship::increment(step));
            whitened.hold(&mut filter);
        }
        whitened
    }

    #[test]
    fn a_sea_that_is_lent_counts_until_it_is_taken_back() {
        let (mut whitened, other) = (held(400), held(200));
        let fit = |whitened: &Whitened| whitened.whitener().expect("a model").coefficients()[0];
        let own = fit(&whitened);
        assert_ne!(own, fit(&other));
        whitened.lend(Some(other.learnt()));
        assert_eq!(fit(&whitened), fit(&other));
        whitened.lend(None);
        assert_eq!(fit(&whitened), own);
    }

    #[test]
    fn what_was_learnt_outlasts_a_new_start_of_the_program() {
        let mut filter = ship::filter(&ship::errors());
        let mut whitened = Whitened::new(&mut filter);
        for k in 0..40 {
            let seen = Vector2::new(0.1, 0.2) * (f64::from(k) * 0.3).cos();
            whitened.sea.push(Some(Displacement { seen, clearness: 1.0 }));
        }
        let by = Span::from_seconds(7.0);
        let again = Whitened::taken_up(&whitened.kept(), &filter, by).expect("the same kinds");
        let of_order_0 =
            |whitened: &Whitened| *whitened.sea.whitener(0).expect("a model").residual_covariance();
        let unlearnt = Whitened::new(&mut filter);
        assert!((of_order_0(&again) - of_order_0(&whitened)).norm() < 1e-9);
        assert!((of_order_0(&unlearnt) - of_order_0(&whitened)).norm() > 0.1);
        assert_eq!(again.shifts.start(), whitened.shifts.start() + by);
    }

    #[test]
    fn forward_is_where_the_bow_is_taken_to_point() {
        let filter = ship::filter(&ship::errors());
        let heading = filter.solution().attitude.heading;
        let axes = Hindsight::of(&filter).ship_axes();
        let forward = axes * Vector2::x();
        assert!((forward - Vector2::new(heading.cos(), heading.sin())).norm() < 1e-9);
        let starboard = axes * Vector2::y();
        assert!((starboard - Vector2::new(-heading.sin(), heading.cos())).norm() < 1e-9);
    }

    #[test]
    fn a_ship_whose_samples_are_missed_is_held_by_those_that_come() {
        let mut filter = ship::filter(&Errors::none());
        let mut whitened = Whitened::new(&mut filter);
        for step in 0..6000 {
            filter.advance(&ship::increment(step));
            let is_missed = (2000..2600).contains(&step);
            if !is_missed {
                whitened.hold(&mut filter);
            }
        }
        assert!(whitened.past.len() > whitened.config.order);
        assert_eq!(whitened.shifts(), 0);
        let away = whitened.displacement(&filter).norm();
        assert!(away < 0.1, "{away} m from where she lies");
    }
}
