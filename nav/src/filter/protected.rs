//! What faults that nobody has found add to the protection levels, once a second: the filter as it would be without each.

use insd_base::satellites::{Constellation, time_keeper};
use insd_base::{Protection, SolutionSigma, Time};
use insd_estimation::Release;
use nalgebra::{Matrix3, Vector3};

use super::Filter;
use super::hidden::{AHEAD, Hidden, beyond};
use crate::aids::View;
use crate::error_state::{POSITION, RANGE_ERRORS, SATELLITES, VELOCITY};
use crate::judge::Separation;
use crate::protection::{Hypothesis, RiskModel, level};
use crate::solution_sigma::solution_sigma;

/// How wrong a satellite may be, 1-sigma, m: its clock or orbit, or a signal that came by way of a reflection.
const WRONG_RANGE: f64 = 50.0;
/// Causes of the judge are below this.
const BY_SATELLITE: usize = 1000;

/// That of fixes beside ranges.
const BESIDE: usize = BY_SATELLITE - 2;
/// That of a lie that was left open.
const LEFT_OPEN: usize = BY_SATELLITE - 3;

impl Filter {
    /// Works out anew what faults that nobody has found add to the levels.
    pub(super) fn protect(&mut self) {
        let model = self.config.risk;
        let mut judged = self.judged_separations(self.state.time, &model);
        self.weigh_return(&judged);
        let mut separations = match &self.companion {
            Some(companion) => self.separations_beside(companion, &model),
            None => {
                judged.extend(self.court.returned);
                judged
            }
        };
        separations.extend(self.without_marks(self.state.time, &model));
        let (view, acceleration) = self.dated_view();
        let claimed = self.sigma_of_one(&view, &acceleration);
        let free = usual(&claimed, &model);
        let adds = [AHEAD, 2.0 * AHEAD].map(|ahead| {
            beyond(&levels((&claimed, &view.c_ne), &separations, &model, ahead), &free)
        });
        self.court.hidden = Hidden::new(self.state.time, adds);
    }

    /// The same after an epoch of ranges, no more often than levels are worked out ahead.
    pub(super) fn protect_at_epochs(&mut self) {
        if self.court.hidden.is_due(self.state.time) {
            self.protect();
        }
    }

    /// 1-sigma that the filter claims of its solution, and what is hidden beside it. The claim covers where fixes have her that are apart from ranges, as if
    /// that were a sigma; the levels know that she is in one place or in the other.
    pub(super) fn claims(
        &self,
        view: &View,
        acceleration: &Vector3<f64>,
    ) -> (SolutionSigma, Protection) {
        let own = self.sigma_of_one(view, acceleration);
        let hidden = self.court.hidden.at(self.state.time);
        let Some(beside) = self.court.beside else { return (own, hidden) };
        let both = own.greatest(&beside);
        let (less, more) = (usual(&own, &self.config.risk), usual(&both, &self.config.risk));
        let hidden = Protection {
            horizontal: hidden.horizontal + less.horizontal - more.horizontal,
            vertical: hidden.vertical + less.vertical - more.vertical,
        };
        (both, hidden)
    }

    /// 1-sigma where nothing is made of fixes beside ranges.
    fn sigma_of_one(&self, view: &View, acceleration: &Vector3<f64>) -> SolutionSigma {
        let own = solution_sigma(view, acceleration, &self.dating(), &self.state.covariance);
        let own = self.with_dispute(self.with_held(view, self.with_base_error(own)));
        self.court.covered.map_or(own, |covered| own.greatest(&covered))
    }

    /// The claim covers where a receiver has her that the filter refuses though nobody has found it to lie.
    fn with_dispute(&self, mut own: SolutionSigma) -> SolutionSigma {
        let apart = self.receiver.disputed.abs();
        own.position.0.x = own.position.0.x.max(apart.x);
        own.position.0.y = own.position.0.y.max(apart.y);
        own
    }

    /// What the judge has of everybody.
    fn judged_separations(&self, now: Time, model: &RiskModel) -> Vec<Separation> {
        let judge = self.court.judge.as_deref();
        let mut all = judge.map_or_else(Vec::new, |judge| judge.separations(now, model));
        all.extend(self.left_open(now));
        all
    }

    /// What the receiver that the estimate follows may be doing, which a verdict against the IMU left open.
    fn left_open(&self, now: Time) -> Option<Separation> {
        let docket = self.docket();
        let lie = docket.open_lie()?;
        let [(off, unsure), (rate, spreading)] = lie.grown(now)?;
        let level = self.view().c_ne.fixed_rows::<2>(0).transpose();
        let mut own = self.as_it_is(LEFT_OPEN, lie.chance(now));
        (own.apart, own.growth) = (-level * off, -level * rate);
        own.covariance += level * unsure * level.transpose();
        own.spreading += level * spreading * level.transpose();
        Some(own)
    }

    /// Whether a receiver that is left out for a leap has returned from a lie that nobody had found.
    fn weigh_return(&mut self, judged: &[Separation]) {
        let now = self.state.time;
        let Some(judge) = self.court.judge.as_deref() else { return };
        let z = judge.docket().off_by_gnss();
        let off = self.view().c_ne.tr_mul(&Vector3::new(z.x, z.y, 0.0));
        let covariance = POSITION.covariance(&self.state.covariance);
        if let Some(judge) = self.judge_now() {
            judge.note_allowed(now, judged);
            self.court.returned = judge.returned(&off, &covariance);
        }
    }

    /// Where ranges are in use: what the companion's judge has of everybody, whose estimate is apart from this one; and each satellite, and all of a
    /// constellation.
    fn separations_beside(&self, companion: &Filter, model: &RiskModel) -> Vec<Separation> {
        let now = self.state.time;
        let own = &self.state.nominal;
        let apart = companion.state.nominal.position - own.position;
        let growth = companion.state.nominal.velocity - own.velocity;
        let mut all = companion.judged_separations(now, model);
        // one of the two is as likely as the other
        all.extend(self.court.beside.map(|_| companion.as_it_is(BESIDE, model.renewals())));
        all.extend(companion.court.returned);
        for one in &mut all {
            one.apart += apart;
            one.growth += growth;
        }
        all.extend(self.base_misplaced(companion, model));
        let used: Vec<_> = self.satellites.used(now).collect();
        for (at, slow, satellite) in &used {
            all.extend(self.without(&[*at], *slow, model.chance(model.satellite_fails)));
            let keeper = time_keeper(satellite.constellation);
            let of_one: Vec<usize> = used
                .iter()
                .filter(|(_, _, other)| time_keeper(other.constellation) == keeper)
                .map(|(at, ..)| *at)
                .collect();
            // once for each constellation: at the first of its satellites
            if keeper != Constellation::Gps && of_one.first() == Some(at) {
                all.extend(self.without(&of_one, *slow, model.chance(model.constellation_fails)));
            }
        }
        all
    }

    /// That this estimate is right.
    fn as_it_is(&self, cause: usize, chance: f64) -> Separation {
        Separation {
            cause,
            chance,
            apart: Vector3::zeros(),
            growth: Vector3::zeros(),
            covariance: POSITION.covariance(&self.state.covariance),
            spreading: VELOCITY.covariance(&self.state.covariance),
        }
    }

    /// The filter in which the codes of some satellites, by their places, may be wrong by [`WRONG_RANGE`].
    fn without(&self, places: &[usize], slow: f64, chance: f64) -> Option<Separation> {
        let errors = &self.state.nominal.range_errors;
        let of: Vec<_> = places.iter().map(|at| (*at, errors[*at])).collect();
        let p = &self.state.covariance;
        let free = WRONG_RANGE / slow.max(1e-3);
        let release = Release::new(p, RANGE_ERRORS.key(), &of, [1.0, free])?;
        let more: Matrix3<f64> = release.more(POSITION);
        Some(Separation {
            cause: BY_SATELLITE + SATELLITES * (places.len() - 1) + places.first()?,
            chance: (chance * release.log_factor.exp()).min(1.0),
            apart: release.apart(POSITION),
            growth: release.apart(VELOCITY),
            covariance: POSITION.covariance(p) + more,
            spreading: VELOCITY.covariance(p) + release.more(VELOCITY),
        })
    }
}

/// Levels of errors with these sigmas where nobody lies.
fn usual(sigma: &SolutionSigma, model: &RiskModel) -> Protection {
    Protection::of(sigma).plus(&model.beyond_usual(sigma))
}

/// The levels at so many seconds from now, of what is claimed where nobody lies, and of all that may be.
fn levels(
    (claimed, c_ne): (&SolutionSigma, &Matrix3<f64>),
    separations: &[Separation],
    model: &RiskModel,
    ahead: f64,
) -> Protection {
    let claimed = &claimed.position.0;
    let chance = model.renewals();
    let free = |std| Hypothesis { cause: usize::MAX, chance, apart: 0.0, std };
    let mut horizontal = vec![free(claimed.xy().norm())];
    let mut vertical = vec![free(claimed.z)];
    for own in separations {
        let apart = c_ne * (own.apart + own.growth * ahead);
        let wide = own.covariance + own.spreading * (ahead * ahead);
        let variance = (c_ne * wide * c_ne.transpose()).diagonal().map(|own| own.max(0.0));
        let Separation { cause, chance, .. } = *own;
        let std = (variance.x + variance.y).sqrt();
        horizontal.push(Hypothesis { cause, chance, apart: apart.xy().norm(), std });
        let std = variance.z.sqrt();
        vertical.push(Hypothesis { cause, chance, apart: apart.z.abs(), std });
    }
    Protection {
        horizontal: level(&mut horizontal, model.risk),
        vertical: level(&mut vertical, model.risk),
    }
}
