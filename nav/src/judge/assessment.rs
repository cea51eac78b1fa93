//! Faults that may be, weighed against each other.

use insd_base::{Fault, Party, Standing, Time};

use super::aid::Aid;
use super::alternative::Alternative;
use super::charge::{Assessment, CERTAIN, Charge, DOUBT, Kind, LIKELY};
use super::newcomers::MISTAKEN;
use super::rows::{ALL, FaultGroup, OF_FALSE_PUSHES, OF_GYROS, OF_ONE_GYRO};
use super::{CLOSE, Judge, SPAWN};

/// Mean square of the innovations, of which one is expected, that a fault may leave unexplained.
const UNEXPLAINED: f64 = 4.0;
/// Somebody is likely to lie until the odds are below those, as a logarithm;
const UNLIKELY: f64 = 0.9;
/// the claims cover what may be, as far as three sigmas, from one in nine on.
const COVER: f64 = 0.12;
const UNCOVER: f64 = 0.06;
/// No rival may explain so much of what the guilty one explains;
const RIVAL: f64 = 0.95;
/// but for gyros that told a turn that was none, as a log or compass that is off looks the same, and is so more often; and but
/// for fine gyros that have another bias, as a compass drifts more often than they. Such a rival must be less likely by this, as a
/// logarithm. Coarse gyros may have another bias at any time: a compass must explain so much more than they, of the
/// normalised squares.
const SURE: f64 = 2.0 * CERTAIN;
/// What is less likely than this share of the likeliest fault, and this, as logarithms, is out of the question.
const NEARLY: f64 = 0.95;
const MUCH: f64 = 20.0;
/// By how much likelier an IMU that was wrong a while ago is to be wrong again, as a logarithm.
const RELAPSE: f64 = 10.0;
/// Share of what the likeliest fault of an IMU explains that a plain one must.
const PLAIN: f64 = 0.9;
/// A scale factor that changes so much that it matters shows within this, s: what takes longer is how little the model
/// knows of a ship in waves.
const QUICK: f64 = 60.0;
/// What no model knows adds up: after so long, s, evidence is worth half, and in the end so many times less.
const LONG: f64 = 60.0;
pub(super) const WORST: f64 = 4.0;
/// The same of a compass: its slow error is a state of its own, and only the gyros stand between its words.
const WORST_OF_HEADING: f64 = 1.5;
/// The same where a receiver contradicts itself, its position its velocity: no model of the ship stands between them.
const OWN_WORD: f64 = 1.2;
/// What begins within this of when a receiver is heard again began in its silence, s.
const RESUMED: f64 = 5.0;
/// Share of the likeliest fault's weight, as a logarithm, that is most of it.
const MOST: f64 = 0.8;
const NEARLY_ALL: f64 = 0.98;
/// Logarithm of how often anybody does what has no shape, 1/s.
const SHAPELESS: f64 = -17.4;

impl Judge {
    /// Weighs all that may be, by what is known in common of how much evidence is worth: that of what has most of it.
    pub(super) fn assess(&self, now: Time) -> Assessment {
        let (all, worst) = self.all_comparable(now);
        let is_relapse = self.docket.standing(Party::Imu) == Standing::Doubtful;
        let relapse = if is_relapse { RELAPSE } else { 0.0 };
        let most = most_evident(&all);
        // what another receiver tells is not his own word
        let is_of_spare = most.is_some_and(|charge| charge.party() == Party::Gnss2);
        let worth = most.map_or(1.0, |charge| unsure((now - charge.begun).as_seconds(), worst));
        let mut charges: Vec<Charge> = Vec::new();
        let mut total = 0.0;
        for mut charge in all {
            let is_own_word = charge.is_own_word && !is_of_spare || charge.is_mistake;
            let own = if is_own_word { worth.min(OWN_WORD) } else { worth };
            charge.weight += charge.evidence / own;
            charge.weight += if charge.party() == Party::Imu { relapse } else { 0.0 };
            total = log_sum(total, charge.weight);
            match charges.iter_mut().find(|known| known.fault == charge.fault) {
                Some(known) if known.weight < charge.weight => *known = charge,
                Some(_) => {}
                None => charges.push(charge),
            }
        }
        charges.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        let Assessment { is_covered, is_likely, .. } = self.assessment;
        let is_covered = total >= if is_covered { UNCOVER } else { COVER };
        let is_likely = total >= if is_likely { UNLIKELY } else { LIKELY };
        Assessment { charges, total, is_covered, is_likely }
    }

    /// All that may be, and how many times less their evidence is worth in the end: less is unknown of what most of it is
    /// against where that is a compass.
    fn all_comparable(&self, now: Time) -> (Vec<Charge>, f64) {
        let all = self.all_charges(now, WORST);
        match most_evident(&all).map(Charge::party) {
            Some(Party::Heading) => (self.all_charges(now, WORST_OF_HEADING), WORST_OF_HEADING),
            _ => (all, WORST),
        }
    }

    /// Every fault that may be, its weight without the evidence, which is worth so many times less in the end.
    fn all_charges(&self, now: Time, worst: f64) -> Vec<Charge> {
        let mut all: Vec<Charge> = Vec::new();
        let is_log_heard = self.is_witness(Aid::Log, now);
        let may_be_two = self.docket.may_be_two(now);
        for onset in &self.onsets {
            let age = (now - onset.since).as_seconds();
            let step = (age * CLOSE).max(1.0).ln();
            let unsure = unsure(age, worst);
            for (group, FaultGroup { fault, least, log_rate, .. }) in ALL.iter().enumerate() {
                let is_slow = *fault == Fault::GyroScale && age > QUICK;
                let is_own_word = *fault == Fault::Slide;
                let is_mistake = self.is_from_begin(*fault, onset.since);
                // a mistake is told of at its begin, and is worth no less for what comes later
                let is_lasting = is_own_word || is_mistake;
                let unsure = if is_lasting { unsure.min(OWN_WORD) } else { unsure };
                let is_blind = onset.is_blind_to(group);
                let sized = (!is_blind).then(|| onset.sized(group, unsure)).flatten();
                let sized = sized.filter(|sized| sized.value.norm() >= *least);
                let is_unseen = self.began_unseen(*fault, onset.since, now);
                // of receivers only it is the drift of one
                let is_drift = group == OF_FALSE_PUSHES && !is_log_heard;
                // what two say that lie alike is no reason to blame one gyro after the other
                let is_forced = group == OF_ONE_GYRO && may_be_two;
                let is_none = is_slow || is_unseen || is_drift || is_forced;
                let Some(sized) = sized.filter(|_| !is_none) else { continue };
                let (fault, begun) = (*fault, onset.since);
                let kind = Kind::Shaped { group, since: begun, sized };
                let often = if is_mistake { MISTAKEN } else { log_rate + step };
                let (weight, evidence) = (often, sized.log_factor * unsure);
                all.push(Charge { fault, weight, evidence, begun, is_own_word, is_mistake, kind });
            }
        }
        let most = all.iter().filter_map(Charge::explained).fold(0.0, f64::max);
        all.retain(|charge| !charge.is_own_word || charge.explained() > Some(NEARLY_ALL * most));
        let others = self.dissenters.iter().map(|dissenter| (dissenter.whom, &dissenter.success));
        let spare = (self.spare.gain > 0.0).then_some((Party::Gnss2, &self.spare));
        let shapeless = others.chain(spare).map(|(whom, success)| Charge {
            evidence: success.gain,
            begun: success.since,
            ..Charge::shapeless(whom, SHAPELESS + SPAWN.ln())
        });
        all.extend(shapeless);
        all
    }

    /// Whether it would have begun while nobody but coarse gyros and their accelerometers told where she is: what they say of place and
    /// speed after a silence of the receiver is no evidence that it leapt, or goes away, since then. One that contradicts
    /// itself does.
    fn began_unseen(&self, fault: Fault, since: Time, now: Time) -> bool {
        let of_gnss = &self.hearings[Aid::GnssPosition as usize];
        matches!(fault, Fault::Jump | Fault::Height | Fault::Drag | Fault::Creep)
            && self.is_coarse
            && of_gnss.was_silent_at(since, RESUMED)
            && self.witnesses(now) < 2
    }

    /// Whether somebody lies, and that is nearly as likely as a mistake of the installation, or likelier; of that the logarithm of the
    /// ratio of its likelihood to that of none.
    #[must_use]
    pub fn doubts(&self, mistake: f64) -> bool {
        let evidence = self.assessment.charges.iter().map(|charge| charge.evidence);
        self.is_in_doubt() && mistake < evidence.fold(0.0, f64::max) + CERTAIN
    }

    /// Whether a height or a place leaps, by somebody's word: no ship does that, and no mistake of the installation makes it.
    #[must_use]
    pub fn leaps(&self, whom: Party) -> bool {
        whom == Party::Docking
            || self.leap(whom).or_else(|| self.far_jump(whom)).is_some()
            || self.most_of_it(whom).any(|charge| self.turns(charge))
    }

    /// The leap of somebody's height, where that is most of what there is: a receiver that hears reflections is off in height,
    /// place and velocity at once, and no shape has it all.
    pub(super) fn leap(&self, whom: Party) -> Option<Charge> {
        self.most_of_it(whom).find(|charge| charge.is_leap()).copied()
    }

    /// The leap of somebody's place, where that is most of what there is.
    pub(super) fn far_jump(&self, whom: Party) -> Option<Charge> {
        self.most_of_it(whom).find(|charge| charge.is_far()).copied()
    }

    /// What somebody may do that explains most of what there is.
    fn most_of_it(&self, whom: Party) -> impl Iterator<Item = &Charge> {
        let all = &self.assessment.charges;
        let most = all.first().map_or(0.0, |first| MOST * first.weight).max(DOUBT);
        all.iter().filter(move |charge| charge.party() == whom && charge.weight > most)
    }

    /// The wrong velocity of a receiver, where that is nearly all there is though no constant has it: with the wrong sign it is
    /// otherwise at every wave.
    pub(super) fn wrong_velocity(&self, whom: Party) -> Option<Charge> {
        let all = &self.assessment.charges;
        let nearly_all = all.first().map_or(0.0, |first| NEARLY_ALL * first.weight).max(DOUBT);
        let is_it = |charge: &&Charge| charge.fault == Fault::Velocity && charge.party() == whom;
        all.iter().filter(is_it).find(|charge| charge.weight > nearly_all).copied()
    }

    /// Whether a fault leaves nothing much unexplained.
    pub(super) fn explains(&self, charge: &Charge) -> bool {
        self.left(charge).is_some_and(|left| left < UNEXPLAINED)
    }

    /// Mean square of the innovations, of which one is expected, that a fault leaves unexplained.
    pub(super) fn left(&self, charge: &Charge) -> Option<f64> {
        match charge.kind {
            Kind::Shapeless => self.success(charge.party()).map(|success| success.strain),
            Kind::Shaped { since, sized, .. } => {
                self.begun(since).map(|onset| onset.left(sized.explained))
            }
        }
    }

    /// Faults that are not much less likely than the likeliest: what began later explains what came later only.
    fn nearly_likeliest(&self) -> impl Iterator<Item = &Charge> {
        let all = &self.assessment.charges;
        let least = all.first().map_or(0.0, |first| NEARLY * first.weight.max(0.0) - MUCH);
        all.iter().take_while(move |charge| charge.weight > least)
    }

    /// The likeliest fault that explains what there is.
    pub(super) fn likeliest(&self) -> Option<Charge> {
        self.nearly_likeliest().copied().find(|charge| self.explains(charge))
    }

    /// The likeliest fault of somebody that has a shape and explains what there is; of the IMU only what is likeliest
    /// of all, as its shapes are many.
    pub(super) fn shaped(&self, whom: Party) -> Option<Charge> {
        let is_of = |charge: &&Charge| charge.party() == whom && charge.kind != Kind::Shapeless;
        let mut all = self.nearly_likeliest().filter(is_of);
        all.find(|charge| whom != Party::Imu && charge.weight > DOUBT && self.explains(charge))
            .copied()
    }

    /// The fault of the IMU that is to be mended where another is likeliest: what a gyro tells wrongly is a bias rather than a
    /// scale factor of it, if that explains as much.
    pub(super) fn plain_fault_of_imu(&self, likeliest: &Charge) -> Charge {
        let needed = likeliest.explained().map_or(f64::INFINITY, |explained| PLAIN * explained);
        let is_plain = |charge: &&Charge| {
            charge.fault == Fault::GyroBias && charge.explained().is_some_and(|own| own > needed)
        };
        self.assessment.charges.iter().find(is_plain).copied().unwrap_or(*likeliest)
    }

    /// A push that the IMU has not told, where that explains nearly as much as its likeliest fault: whoever else tells how she moves told
    /// another speed at once.
    pub(super) fn false_push(&self, likeliest: &Charge) -> Option<Charge> {
        let needed = NEARLY_ALL * likeliest.weight;
        let is_it = |charge: &&Charge| charge.is_false_push() && charge.weight > needed;
        let mut all = self.assessment.charges.iter().filter(is_it);
        all.find(|charge| self.explains(charge)).copied()
    }

    /// A lie of somebody else than the IMU that explains so much, too, as a logarithm, if innovations are as sure as stated.
    pub(super) fn explained_by_another(&self, gain: f64, now: Time) -> Option<Charge> {
        let is_one_against_one = self.is_one_against_one(now);
        let explains = |charge: &&Charge| {
            let stated = if is_one_against_one { self.stated(charge) } else { None };
            charge.party() != Party::Imu && stated.unwrap_or(charge.evidence) > gain
        };
        self.assessment.charges.iter().find(explains).copied()
    }

    /// Nobody but a receiver, which may creep away, contradicts gyros and accelerometers that are hardly ever worse than assumed: coarse ones often are.
    pub(super) fn is_one_against_one(&self, now: Time) -> bool {
        self.witnesses(now) < 2 && !self.is_coarse
    }

    /// What the innovations tell of a fault that has a shape, if they are as sure as stated, however long it has gone on.
    fn stated(&self, charge: &Charge) -> Option<f64> {
        let Kind::Shaped { group, since, .. } = charge.kind else { return None };
        self.begun(since)?.sized(group, 1.0).map(|sized| sized.log_factor)
    }

    /// Whether no other sensor's fault explains it, too.
    pub(super) fn is_certain(&self, first: &Charge) -> bool {
        let of_others = |other: &&Charge| other.party() != first.party() && self.explains(other);
        let mut others = self.assessment.charges.iter().filter(of_others);
        first.weight > first.needed() && others.all(|other| self.rules_out(first, other))
    }

    /// Whether one who may be guilty leaves nothing to another: is likelier, and explains more, or is likelier by far where
    /// nothing else can tell them apart.
    fn rules_out(&self, first: &Charge, other: &Charge) -> bool {
        let gap = first.weight - other.weight;
        if first.is_sudden() {
            return gap > CERTAIN;
        }
        let is_of_heading = first.party() == Party::Heading;
        let is_less = match (first.explained(), other.explained()) {
            (Some(own), Some(others)) if is_of_heading && self.is_coarse => own - others > SURE,
            (Some(own), Some(others)) => others < RIVAL * own,
            _ => true,
        };
        let is_of_hull = is_of_heading || first.party() == Party::Log;
        let is_rare = is_of_heading && !self.is_coarse && other.fault == Fault::GyroBias;
        let is_unlikely = (is_of_hull && other.is_false_turn() || is_rare) && gap > SURE;
        gap > CERTAIN && (is_less || is_unlikely)
    }

    /// What the estimate would be with it.
    pub(super) fn alternative(&self, charge: &Charge) -> Alternative {
        match charge.kind {
            Kind::Shapeless => self.dissenter(charge.party()).map(|own| own.shadow.alternative()),
            Kind::Shaped { group, since, sized } => self.begun(since).map(|onset| {
                let sized = if group == OF_GYROS { sized.untimed() } else { sized };
                let mut other = self.shadow();
                other.error += &onset.correct(&ALL[group], &sized, &mut other.covariance);
                other
            }),
        }
        .unwrap_or_else(|| self.shadow())
    }
}

/// What the innovations tell most of.
fn most_evident(all: &[Charge]) -> Option<&Charge> {
    all.iter().max_by(|a, b| a.evidence.total_cmp(&b.evidence))
}

/// How many times as uncertain as stated innovations are that have added up for so long, s, as variances.
pub(super) fn unsure(age: f64, worst: f64) -> f64 {
    (1.0 + age / LONG).min(worst)
}

/// The logarithm of the sum of two numbers of which these are the logarithms.
fn log_sum(a: f64, b: f64) -> f64 {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    high + (low - high).exp().ln_1p()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::NavConfig;
    use crate::initial::sensor_covariance;
    use crate::judge::Docket;
    use insd_base::units::DEG_PER_HOUR;
    use insd_base::{ImuSpec, LeverArms, Triad};

    /// Of gyros of such a bias, deg/h, and a receiver that has been silent from 10 to 70 s.
    fn after_an_outage(gyro_bias: f64) -> Judge {
        let triad = Triad {
            bias_std: gyro_bias * DEG_PER_HOUR,
            instability_std: 1e-7,
            instability_time: 300.0,
            random_walk: 1e-5,
            scale_std: 1e-3,
        };
        let imu = ImuSpec { rate: 100.0, gyro: triad, accel: triad };
        let config = NavConfig::new(imu, LeverArms::default());
        let mut judge = Judge::new(&sensor_covariance(&config), &config, Docket::default());
        for second in (0..=10).chain(70..=80) {
            let now = Time::from_seconds(f64::from(second));
            judge.hearings[Aid::GnssPosition as usize].note(now);
        }
        judge
    }

    #[test]
    fn coarse_gyros_that_carried_her_alone_do_not_convict_a_receiver_of_a_leap_in_its_silence() {
        let now = Time::from_seconds(80.0);
        let [then, later] = [70.0, 78.0].map(Time::from_seconds);
        let mut judge = after_an_outage(20.0);
        assert!(judge.began_unseen(Fault::Jump, then, now));
        assert!(judge.began_unseen(Fault::Height, then, now));
        assert!(judge.began_unseen(Fault::Drag, then, now));
        assert!(!judge.began_unseen(Fault::Jump, later, now), "seen from one fix to the next");
        assert!(!judge.began_unseen(Fault::Slide, then, now), "it contradicts itself");
        judge.hearings[Aid::Log as usize].note(now);
        assert!(!judge.began_unseen(Fault::Jump, then, now), "a log has seen it, too");
        assert!(!after_an_outage(0.01).began_unseen(Fault::Jump, then, now), "fine gyros have");
    }
}
