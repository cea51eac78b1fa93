//! Everything that somebody may be doing without being found to, with what that makes of the place: for protection levels.
//!
//! Verdicts ask what is likeliest; a level asks how far wrong she may be with a risk. So nothing is left out here for being small or unlikely, and how often
//! anybody lies is what a [`RiskModel`] says, not what the judge supposes, who would rather suspect somebody too often.

use insd_base::{Fault, Party, Time};
use nalgebra::{Matrix3, Vector3};

use super::Judge;
use super::assessment::{WORST, unsure};
use super::charge::Charge;
use super::onset::Onset;
use super::rows::ALL;
use super::separation::Separation;
use crate::error_state::{Covariance, Errors, POSITION, VELOCITY};
use crate::protection::RiskModel;

/// How often somebody begins to do this, 1/h: of all that he may do each is as likely.
fn rate(fault: Fault, model: &RiskModel) -> f64 {
    let (rate, ways) = match (fault.party(), fault) {
        (Party::Gnss, Fault::Jump | Fault::Height | Fault::GnssNoise) => {
            (model.receiver_fails, 3.0)
        }
        (Party::Gnss, _) => (model.receiver_deceived, 5.0),
        (Party::Log, _) => (model.log_fails, 4.0),
        (Party::Heading, _) => (model.heading_fails, 3.0),
        // the levels are of the filter with ranges, where phases and surveys are weighed beside states of their own
        (Party::Antennas | Party::Docking, _) => (0.0, 1.0),
        (Party::Imu, _) => (model.imu_fails, 3.0),
        (Party::Reference, _) => (model.receiver_fails, 3.0),
        // no estimate takes anything of a receiver that is only compared
        (Party::Gnss2 | Party::Gnss3, _) => (0.0, 1.0),
    };
    rate / ways
}

/// One that is not weighed yet: its chance against nobody lying is as its logarithm says.
struct Open {
    odds: f64,
    /// How many times likelier it is within the exposure than now.
    lasts: f64,
    separation: Separation,
}

impl Judge {
    /// All that may be so but for nobody lying, as of the last look.
    #[must_use]
    pub fn separations(&self, now: Time, model: &RiskModel) -> Vec<Separation> {
        let mut open = Vec::with_capacity(self.onsets.len() * ALL.len());
        let base = Place::of(&self.shadow.apart, &self.shadow.covariance);
        for (i, onset) in self.onsets.iter().enumerate() {
            let next = self.onsets.get(i + 1).map_or(now, |next| next.since);
            let lasts = (next - onset.since).as_seconds().max(1.0);
            for (group, of) in ALL.iter().enumerate() {
                let rate = rate(of.fault, model) / 3600.0;
                // who is not there does nothing
                let is_there = rate > 0.0 && !onset.is_untold(group);
                let unsure = unsure_of(onset, group, now);
                let sized = is_there.then(|| onset.sized(group, unsure)).flatten();
                let Some(sized) = sized else { continue };
                let [place, way] = onset.places(of, [POSITION, VELOCITY]);
                open.push(Open {
                    odds: (rate * lasts).ln() + sized.log_factor,
                    lasts: model.exposure / lasts,
                    separation: Separation { cause: group, ..base.moved(&place, &way, &sized) },
                });
            }
        }
        open.extend(self.shapeless(now, model));
        weighed(&open)
    }

    /// Since when the receiver would lie if what speaks most for it were so.
    pub(super) fn feared(&self, now: Time) -> Option<Time> {
        let of_gnss = |onset: &Onset| {
            let own = ALL.iter().enumerate().filter(|(_, of)| of.fault.party() == Party::Gnss);
            let factors = own.filter_map(|(group, _)| {
                let unsure = unsure_of(onset, group, now);
                Some(onset.sized(group, unsure)?.log_factor)
            });
            factors.fold(0.0, f64::max)
        };
        let all = self.onsets.iter().map(|onset| (of_gnss(onset), onset.since));
        let most = all.max_by(|a, b| a.0.total_cmp(&b.0));
        most.filter(|(factor, _)| *factor > 0.0).map(|(_, since)| since)
    }

    /// Of those who do not believe one sensor, whatever it does: since they have found likelier what is said than who believes all. What
    /// a sensor has done for so short a time is no long-lived disbelief of it, so that one that has not shown yet counts with the
    /// chance of now, and not with that of the exposure.
    fn shapeless<'a>(&'a self, now: Time, model: &'a RiskModel) -> impl Iterator<Item = Open> + 'a {
        self.dissenters.iter().filter(|own| own.success.gain > 0.0).map(move |own| {
            let rate = rate(Charge::shapeless(own.whom, 0.0).fault, model) / 3600.0;
            let age = (now - own.success.since).as_seconds().max(1.0);
            Open {
                odds: (rate * age).ln() + own.success.gain,
                lasts: 1.0,
                separation: Separation {
                    cause: ALL.len() + own.whom as usize,
                    ..Place::of(&own.shadow.apart, &own.shadow.covariance).separation()
                },
            }
        })
    }
}

/// How many times as uncertain as stated the innovations are that tell of a fault. A lie that is there of a sudden is told of at its begin, and what was told then
/// is worth no less for what comes later; one that grows is told of all the time.
fn unsure_of(onset: &Onset, group: usize, now: Time) -> f64 {
    let age = (now - onset.since).as_seconds();
    let is_sudden = matches!(
        ALL[group].fault,
        Fault::Jump | Fault::Height | Fault::Drag | Fault::Slide | Fault::Velocity
    );
    unsure(if is_sudden { onset.told_for(group).min(age) } else { age }, WORST)
}

/// Chances by odds against nobody lying, and all others.
fn weighed(open: &[Open]) -> Vec<Separation> {
    let most = open.iter().fold(0.0, |most: f64, own| most.max(own.odds));
    let total = (-most).exp() + open.iter().map(|own| (own.odds - most).exp()).sum::<f64>();
    let chance = |own: &Open| ((own.odds - most).exp() / total * own.lasts.max(1.0)).min(1.0);
    open.iter().map(|own| Separation { chance: chance(own), ..own.separation }).collect()
}

/// Place and velocity of an estimate against the navigator's.
struct Place {
    apart: Vector3<f64>,
    growth: Vector3<f64>,
    covariance: Matrix3<f64>,
    spreading: Matrix3<f64>,
}

impl Place {
    fn of(apart: &Errors, p: &Covariance) -> Self {
        Place {
            apart: apart.of(POSITION),
            growth: apart.of(VELOCITY),
            covariance: POSITION.covariance(p),
            spreading: VELOCITY.covariance(p),
        }
    }

    fn separation(&self) -> Separation {
        let Place { apart, growth, covariance, spreading } = *self;
        Separation { cause: 0, chance: 0.0, apart, growth, covariance, spreading }
    }

    /// By a fault of a size that is not known better than its covariance, of which a unit does so much to place and velocity.
    fn moved(
        &self,
        place: &Matrix3<f64>,
        way: &Matrix3<f64>,
        sized: &super::onset::Sized,
    ) -> Separation {
        let size = sized.covariance();
        Separation {
            cause: 0,
            chance: 0.0,
            apart: self.apart + place * sized.value,
            growth: self.growth + way * sized.value,
            covariance: self.covariance + place * size * place.transpose(),
            spreading: self.spreading + way * size * way.transpose(),
        }
    }
}
