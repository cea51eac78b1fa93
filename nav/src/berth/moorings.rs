//! A ship on her moorings: the default way of holding her at the berth.
//!
//! Her mean velocity is zero, but that is the lesser part of what is known: her *displacement* is
//! bounded, for hours. Her position is the berth's plus a slow swaying, which is a state of the
//! filter with the spectrum of moorings ([`crate::sway`]), plus the waves, which are nearly white
//! at the spacing of the samples. The filter then weighs every frequency by what the sea puts there;
//! taken as white noise, the swaying would be believed to average out within seconds, and would be
//! found again in tilt and heading.
//!
//! A gust or a tug that shifts the ship is found by the innovation, and her mean place set free.

use super::shifts::Shifts;
use super::sight::BerthSample;
use super::stated::{OFFSET_SHARE, UNSTATED, UNSURVEYED};
use crate::aids::berth;
use crate::error_state::SWAY;
use crate::{Filter, Oscillator, Sway};
use insd_base::{Geodetic, Span, Time};
use nalgebra::{DVector, Vector2};
use serde::{Deserialize, Serialize};

/// What is known of the ship at her berth, and learnt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moorings {
    place: Geodetic,
    sway_variance: [f64; 2],
    learning_time: f64,
    wave_variance: f64,
    /// The sea of another, where that is what counts.
    #[serde(skip)]
    lent: Option<MooredSea>,
    next: Time,
    shifts: Shifts,
}

/// How much of her displacement is swaying, by oscillator, and waves: variance of a component, m^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MooredSea {
    sway: [f64; 2],
    waves: f64,
}

/// Spacing of the samples: about half a wave, so that the waves of consecutive ones have little in
/// common, s.
const SPACING: f64 = 4.0;
/// Natural periods of the two oscillators that cover the one to three minutes of a ship on her
/// moorings (docs/systems.md, S1), s.
const PERIODS: [f64; 2] = [66.0, 106.0];
/// Damping that fills the band between them and little beyond.
const DAMPING: f64 = 0.045;
/// Share of the stated displacement that is slow swaying.
const SLOW_SHARE: f64 = 0.9;
/// The share that is waves, before they have been seen: with the other it is more than all, as nobody says
/// which of the two it is. In a swell most of it is waves, and their samples are not white: taken for
/// less than they are they pass for a heading within half a minute.
const WAVE_SHARE: f64 = 0.6;
/// Time over which the swaying is learnt where a reference states it, and where nobody does, s.
const LEARNING_STATED: f64 = 900.0;
const LEARNING_UNSTATED: f64 = 200.0;
/// Time over which the waves are learnt, s.
const LEARNING_WAVES: f64 = 60.0;
/// Least displacement by waves and by swaying that is believed, 1-sigma, m.
const LEAST_WAVES: f64 = 0.005;
const LEAST_SWAY: f64 = 0.01;

/// North and east.
fn pair(z: &DVector<f64>) -> Vector2<f64> {
    Vector2::new(z[0], z[1])
}

impl Moorings {
    /// Takes the ship as lying where the filter has her, until a reference names the berth.
    #[must_use]
    pub fn new(filter: &mut Filter) -> Self {
        let place = filter.nominal().geodetic();
        let mut moorings = Moorings {
            place,
            sway_variance: [0.5 * UNSTATED * UNSTATED; 2],
            learning_time: LEARNING_UNSTATED,
            wave_variance: (WAVE_SHARE * UNSTATED).powi(2),
            lent: None,
            next: filter.time() + Span::from_seconds(SPACING),
            shifts: Shifts::new(filter.time(), SPACING),
        };
        moorings.begin(filter, UNSURVEYED);
        moorings
    }

    /// A reference names the berth and, if `stated`, the ship's displacement from it, 1-sigma of each
    /// component, m. To name the same berth again tells nothing new.
    pub fn name_berth(&mut self, filter: &mut Filter, place: &Geodetic, stated: Option<f64>) {
        let same = place.latitude == self.place.latitude && place.longitude == self.place.longitude;
        if same && self.learning_time == LEARNING_STATED {
            return;
        }
        let std = stated.unwrap_or(UNSTATED);
        self.place = *place;
        self.sway_variance = [0.5 * (SLOW_SHARE * std).powi(2); 2];
        self.wave_variance = (WAVE_SHARE * std).powi(2);
        self.learning_time = LEARNING_STATED;
        self.begin(filter, (OFFSET_SHARE * std).hypot(filter.berth_doubt()));
    }

    fn begin(&mut self, filter: &mut Filter, offset_std: f64) {
        filter.moor(self.sway(), offset_std);
    }

    /// The sea as she has learnt it.
    #[must_use]
    pub fn learnt(&self) -> MooredSea {
        MooredSea { sway: self.sway_variance, waves: self.wave_variance }
    }

    /// From now on the sea is what another has learnt; nothing for what she learns herself.
    pub fn lend(&mut self, filter: &mut Filter, sea: Option<MooredSea>) {
        if self.lent != sea {
            self.lent = sea;
            filter.settle_sway();
            filter.set_sway(self.sway());
        }
    }

    /// The sea that counts.
    fn sea(&self) -> MooredSea {
        self.lent.unwrap_or_else(|| self.learnt())
    }

    fn sway(&self) -> Sway {
        Sway(std::array::from_fn(|i| Oscillator {
            std: self.sea().sway[i].sqrt().max(LEAST_SWAY),
            period: PERIODS[i],
            damping: DAMPING,
        }))
    }

    /// Displacement by waves, 1-sigma of each horizontal component, m.
    #[must_use]
    pub fn waves_std(&self) -> f64 {
        self.sea().waves.sqrt().max(LEAST_WAVES)
    }

    /// Displacement by slow swaying, 1-sigma of each horizontal component, m.
    #[must_use]
    pub fn sway_std(&self) -> f64 {
        self.sway().std()
    }

    /// How often her mean place was found to have shifted.
    #[must_use]
    pub fn shifts(&self) -> u32 {
        self.shifts.count()
    }

    /// The berth.
    #[must_use]
    pub fn place(&self) -> &Geodetic {
        &self.place
    }

    /// The same on a time line that is later by a span.
    #[must_use]
    pub fn shifted(self, by: Span) -> Self {
        Moorings { next: self.next + by, shifts: self.shifts.shifted(by), ..self }
    }

    /// What the berth says next.
    pub(super) fn sample(&self, filter: &Filter) -> BerthSample {
        let innovation = berth::innovation(&filter.view(), &self.place, self.waves_std());
        BerthSample { innovation, spacing: SPACING, start: self.shifts.start() }
    }

    /// Holds the filter against the berth if it is time to; returns the log-likelihood.
    pub fn hold(&mut self, filter: &mut Filter) -> f64 {
        let now = filter.time();
        if now < self.next {
            return 0.0;
        }
        self.next = now + Span::from_seconds(SPACING);
        filter.settle_sway();
        let innovation = berth::innovation(&filter.view(), &self.place, self.waves_std());
        let told = self.shifts.impose(filter, &innovation, innovation.z.norm());
        if let Some(judged) = told.judged {
            let s = Vector2::from_fn(|i, _| judged.innovation[i].1.powi(2));
            self.learn(filter, &pair(&innovation.z), &s);
        }
        told.likelihood
    }

    /// Learns the waves from what the filter did not foresee, and the swaying from what it found:
    /// E[x^2] = x_estimated^2 + P_xx (Shumway and Stoffer, J. Time Series Analysis 3 (1982), the
    /// step of expectation and maximisation, here as a running mean).
    fn learn(&mut self, filter: &mut Filter, z: &Vector2<f64>, s: &Vector2<f64>) {
        let r = self.waves_std().powi(2);
        for axis in 0..2 {
            let seen = (z[axis].powi(2) - (s[axis] - r)).clamp(0.0, 9.0 * r);
            let clearness = (r / s[axis]).powi(2);
            self.wave_variance +=
                SPACING / LEARNING_WAVES * clearness * (seen - self.wave_variance);
        }
        if self.shifts.is_free(filter.time()) {
            return;
        }
        let variance = SWAY.covariance(filter.covariance()).diagonal();
        let square = filter.nominal().sway.component_mul(&filter.nominal().sway) + variance;
        for (learnt, seen) in self.sway_variance.iter_mut().zip([0, 2]) {
            *learnt +=
                SPACING / self.learning_time * (square.fixed_rows::<2>(seen).mean() - *learnt);
        }
        filter.set_sway(self.sway());
    }
}
