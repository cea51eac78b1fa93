//! A bank of filters, one for each heading that the ship could have.
//!
//! A linear filter that starts with an unknown heading locks onto a wrong one with a small sigma.
//! Here each filter starts close enough to its own heading to be linear; the likelihood of every
//! measurement weighs them (Gaussian-sum filter: Alspach and Sorenson, IEEE Trans. AC 17 (1972)).
//! Filters that the data refute are dropped, filters that have come together are joined; when one is
//! left and knows its heading, it is the navigator, without a step in any output.

use std::f64::consts::TAU;

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Received, Solution, Span, Time};
use insd_nav::berth::Method;
use insd_nav::error_state::{ATTITUDE, POSITION, VELOCITY};
use insd_nav::initial::sensor_covariance;
use insd_nav::{Estimator, Increment, InitialState, NavConfig, Navigator, Nominal, Report};
use nalgebra::{Matrix3, Vector3};

use crate::config::AlignmentConfig;
use crate::kinematics::Kinematics;
use crate::levelling::Level;
use crate::mixture::mixed;
use crate::stored::StoredState;
use crate::trial::{ANY, Origin, Shares, StoredVerdict, Trial, explanations, joined_origin};

/// The filters and their weights.
#[derive(Clone, Debug)]
pub struct Bank {
    members: Vec<Member>,
    /// What the members have not been carried over yet: they are many and need no detail. The likeliest, who is asked
    /// between, does not wait.
    waiting: Option<Increment>,
    next_tidy: Time,
    trial: Option<Trial>,
}

#[derive(Clone, Debug)]
struct Member {
    navigator: Box<Navigator>,
    /// It has been carried over what waits for the others.
    is_ahead: bool,
    log_weight: f64,
    origin: Origin,
}

/// Headings at the start.
const HEADINGS: usize = 24;
/// Sigma of each over their spacing: neighbours overlap to an almost even density.
const OVERLAP: f64 = 0.55;
/// Weight, as logarithm below the best, at which a heading is taken as refuted.
const REFUTED: f64 = -14.0;
/// Distance of two headings in units of their joint sigma at which they are taken as one.
const TOGETHER: f64 = 0.7;
/// Ratio of their sigmas beyond which a stored heading and another are not one: joined, the narrow
/// peak would be lost, and with it what the data say of it.
const ALIKE: f64 = 1.5;
/// Heading sigma below which one filter alone is linear enough to go on.
const LINEAR: f64 = 5.0 * DEG;
/// Sigma of roll and pitch after levelling, sensor bias aside.
const LEVEL_STD: f64 = 2.0 * DEG;
/// Interval between propagations of the covariances, s: the search needs no more, and there are many.
const COVARIANCE_INTERVAL: f64 = 1.0;
/// All but the likeliest go in steps of so long, s.
const STRIDE: f64 = 0.1;
/// How often the bank is tidied.
const TIDY: Span = Span::from_nanos(1_000_000_000);

impl Bank {
    /// A bank of all headings around a levelled ship.
    #[must_use]
    pub fn new(config: &NavConfig, level: &Level, kinematics: &Kinematics, method: Method) -> Self {
        let members = (0..HEADINGS)
            .map(|i| {
                let heading = TAU * i as f64 / HEADINGS as f64;
                let spread = OVERLAP * TAU / HEADINGS as f64;
                let initial = hypothesis(config, level, kinematics, heading, spread);
                let berth = kinematics.moored.then_some(method);
                Member::new(config, &initial.at_berth(berth), 0.0, Origin::Any)
            })
            .collect();
        Bank { members, waiting: None, next_tidy: level.time + TIDY, trial: None }
    }

    /// The same with a stored state put on trial among all headings.
    #[must_use]
    pub fn with_stored(
        config: &NavConfig,
        level: &Level,
        kinematics: &Kinematics,
        choice: &AlignmentConfig,
        stored: &StoredState,
    ) -> Self {
        let mut bank = Bank::new(config, level, kinematics, choice.moored);
        let doubt = stored.doubt(&config.imu, level, kinematics);
        bank.trial = Some(Trial::new(stored, doubt, level.time));
        if doubt.is_some() {
            return bank;
        }
        for member in &mut bank.members {
            member.log_weight = (ANY / HEADINGS as f64).ln();
        }
        let heading = stored.attitude.heading;
        for (origin, share, std) in explanations(stored.heading_std()) {
            let mut initial = hypothesis(config, level, kinematics, heading, std);
            if choice.same_power_up {
                stored.carry_biases(&mut initial.nominal, &mut initial.covariance);
            }
            let initial = initial.at_berth(Some(choice.moored));
            bank.members.push(Member::new(config, &initial, share.ln(), origin));
        }
        bank
    }

    /// What became of the stored state, if there was one; `None` while it is on trial.
    #[must_use]
    pub fn verdict(&self) -> Option<StoredVerdict> {
        self.trial.as_ref().and_then(Trial::verdict)
    }

    /// Lets the data judge the stored state; one that is dropped leaves the bank.
    fn try_stored(&mut self, time: Time) {
        let of = |origin: Origin| -> f64 {
            let members = self.members.iter().filter(|member| member.origin == origin);
            members.map(|member| member.log_weight.exp()).sum()
        };
        let shares = Shares {
            any: of(Origin::Any),
            near: of(Origin::Near),
            confirmed: of(Origin::Confirmed),
        };
        let alone = self.members.len() == 1;
        let Some(trial) = &mut self.trial else { return };
        let before = trial.verdict();
        trial.weigh(&shares, alone, time);
        if before.is_none() && matches!(trial.verdict(), Some(StoredVerdict::Dropped { .. })) {
            self.drop_members(|origin| origin == Origin::Confirmed);
        }
    }

    /// Takes members of some origins out, unless no other is left.
    fn drop_members(&mut self, out: impl Fn(Origin) -> bool) {
        if self.members.iter().any(|member| !out(member.origin)) {
            self.members.retain(|member| !out(member.origin));
        }
    }

    /// The one filter left, once it knows its heading well enough to go on alone.
    #[must_use]
    pub fn winner(&self) -> Option<&Navigator> {
        match self.members.as_slice() {
            // the sigma of the heading is a matter of the covariance: no need to ask between
            [only] if only.navigator.filter().is_settled() => {
                Some(only.navigator.as_ref()).filter(|it| it.filter().heading_std() < LINEAR)
            }
            _ => None,
        }
    }

    /// Whether the ship is taken as lying at her berth.
    #[must_use]
    pub fn is_moored(&self) -> bool {
        self.likeliest().is_some_and(Navigator::is_moored)
    }

    /// The likeliest filter.
    #[must_use]
    pub fn likeliest(&self) -> Option<&Navigator> {
        self.index_of_likeliest().map(|index| self.members[index].navigator.as_ref())
    }

    fn index_of_likeliest(&self) -> Option<usize> {
        let weight = |index: &usize| self.members[*index].log_weight;
        (0..self.members.len()).max_by(|a, b| weight(a).total_cmp(&weight(b)))
    }

    /// Carries all over what waits.
    fn catch_up(&mut self) {
        let Some(waiting) = self.waiting.take() else { return };
        for member in &mut self.members {
            if !std::mem::take(&mut member.is_ahead) {
                member.advance(&waiting);
            }
        }
    }

    /// Lets an increment wait for the next ones, but not for the likeliest.
    fn let_wait(&mut self, increment: &Increment) {
        let both = self.waiting.map_or(*increment, |waiting| waiting.then(increment));
        let ahead = self.members.iter_mut().filter(|member| member.is_ahead);
        ahead.for_each(|member| member.advance(increment));
        self.waiting = Some(both);
        if both.duration() > STRIDE - 1e-6 {
            return self.catch_up();
        }
        let likeliest = self.index_of_likeliest().map(|index| &mut self.members[index]);
        if let Some(member) = likeliest.filter(|member| !member.is_ahead) {
            member.advance(&both);
            member.is_ahead = true;
        }
    }

    /// Lets all go if the likeliest has left the berth: one that stayed would be judged by other
    /// evidence than one that left.
    fn follow_departure(&mut self) {
        if self.likeliest().is_some_and(Navigator::seems_to_leave) {
            for member in &mut self.members {
                member.navigator.cast_off();
            }
        }
    }

    /// All take the sea for what the likeliest has learnt that it is: with a sea of its own each would be judged by other
    /// evidence, and one that takes its errors for the sea's would be the likeliest in the end.
    fn share_sea(&mut self) {
        let Some(likeliest) = self.index_of_likeliest() else { return };
        let sea = self.members[likeliest].navigator.learnt_sea();
        for (index, member) in self.members.iter_mut().enumerate() {
            member.navigator.lend_sea(sea.as_ref().filter(|_| index != likeliest));
        }
    }

    fn tidy(&mut self) {
        let best = self.members.iter().map(|m| m.log_weight).fold(f64::NEG_INFINITY, f64::max);
        for member in &mut self.members {
            member.log_weight -= best;
        }
        self.members.retain(|member| member.log_weight > REFUTED);
        let mut peaks: Vec<Peak> = self.members.iter().map(Member::peak).collect();
        let mut first = 0;
        while first < self.members.len() {
            let mut second = first + 1;
            while second < self.members.len() {
                if peaks[first].is_one_with(&peaks[second]) {
                    self.join(first, second);
                    peaks.remove(second);
                    peaks[first] = self.members[first].peak();
                } else {
                    second += 1;
                }
            }
            first += 1;
        }
        self.try_stored(self.next_tidy);
    }

    fn join(&mut self, first: usize, second: usize) {
        let other = self.members.remove(second);
        let member = &mut self.members[first];
        let share = 1.0 / (1.0 + (member.log_weight - other.log_weight).exp());
        member.origin = joined_origin((member.origin, 1.0 - share), (other.origin, share));
        member.navigator.join(*other.navigator, share);
        let (high, low) = if member.log_weight > other.log_weight {
            (member.log_weight, other.log_weight)
        } else {
            (other.log_weight, member.log_weight)
        };
        member.log_weight = high + (low - high).exp().ln_1p();
    }

    fn weighted(&self, solution: impl Fn(&Member) -> Solution) -> Vec<(f64, Solution)> {
        let best = self.members.iter().map(|m| m.log_weight).fold(f64::NEG_INFINITY, f64::max);
        self.members
            .iter()
            .map(|member| ((member.log_weight - best).exp(), solution(member)))
            .collect()
    }

    /// What the bank says together; the likeliest member where the mixture is empty of sense.
    fn together(&self, solution: impl Fn(&Member) -> Solution) -> Solution {
        mixed(&self.weighted(&solution)).unwrap_or_else(|| solution(&self.members[0]))
    }
}

impl Estimator for Bank {
    fn advance(&mut self, increment: &Increment) {
        if increment.bridged.is_some() {
            self.catch_up();
            self.members.iter_mut().for_each(|member| member.advance(increment));
        } else {
            self.let_wait(increment);
        }
        let at = increment.to;
        if at >= self.next_tidy {
            self.next_tidy = at + TIDY;
            self.catch_up();
            self.tidy();
            self.share_sea();
            self.follow_departure();
        }
    }

    fn apply(&mut self, received: &Received) -> Report {
        let time = received.message.time();
        if let Some(trial) = self.trial.as_mut().filter(|trial| trial.is_moved_by(received)) {
            trial.drop_as_moved(time);
            self.drop_members(|origin| origin != Origin::Any);
        }
        self.catch_up();
        let mut best: Option<(f64, Report)> = None;
        for member in &mut self.members {
            let report = member.navigator.apply(received);
            member.log_weight += report.log_likelihood;
            if best.as_ref().is_none_or(|(weight, _)| member.log_weight > *weight) {
                best = Some((member.log_weight, report));
            }
        }
        best.map(|(_, report)| report).unwrap_or_default()
    }

    fn solution(&self) -> Solution {
        self.together(|member| member.solution(self.waiting.as_ref()))
    }

    fn solution_at(&self, increment: &Increment, at: Time) -> Solution {
        self.together(|member| member.solution_at(self.waiting.as_ref(), increment, at))
    }
}

/// A heading in question.
struct Peak {
    heading: f64,
    std: f64,
    origin: Origin,
}

impl Member {
    fn new(config: &NavConfig, initial: &InitialState, log_weight: f64, origin: Origin) -> Self {
        let mut navigator = Box::new(Navigator::new(config, initial));
        navigator.slow_down(COVARIANCE_INTERVAL);
        Member { navigator, is_ahead: false, log_weight, origin }
    }

    fn advance(&mut self, increment: &Increment) {
        self.navigator.advance(increment);
        self.log_weight += self.navigator.take_likelihood();
    }

    /// What waits for it: nothing where it is ahead.
    fn waiting<'a>(&self, waiting: Option<&'a Increment>) -> Option<&'a Increment> {
        waiting.filter(|_| !self.is_ahead)
    }

    fn solution(&self, waiting: Option<&Increment>) -> Solution {
        match self.waiting(waiting) {
            Some(waiting) => self.navigator.solution_at(waiting, waiting.to),
            None => self.navigator.solution(),
        }
    }

    fn solution_at(&self, waiting: Option<&Increment>, next: &Increment, at: Time) -> Solution {
        match self.waiting(waiting) {
            Some(waiting) if next.bridged.is_some() => {
                let mut ahead = self.navigator.clone();
                ahead.advance(waiting);
                ahead.solution_at(next, at)
            }
            Some(waiting) => {
                let head = if at < next.to { next.split(at).0 } else { *next };
                self.navigator.solution_at(&waiting.then(&head), at)
            }
            None => self.navigator.solution_at(next, at),
        }
    }

    fn peak(&self) -> Peak {
        let solution = self.navigator.solution();
        let (heading, std) = (solution.attitude.heading, solution.sigma.heading);
        Peak { heading, std, origin: self.origin }
    }
}

impl Peak {
    /// Whether two headings are as good as one.
    fn is_one_with(&self, other: &Peak) -> bool {
        let (narrow, wide) = (self.std.min(other.std), self.std.max(other.std));
        let both_any = self.origin == Origin::Any && other.origin == Origin::Any;
        if !both_any && wide > ALIKE * narrow {
            return false;
        }
        let distance = wrap_pi(self.heading - other.heading).abs();
        distance < TOGETHER * self.std.hypot(other.std) && wide < 2.0 * LINEAR
    }
}

fn hypothesis(
    config: &NavConfig,
    level: &Level,
    kinematics: &Kinematics,
    heading: f64,
    turn: f64,
) -> InitialState {
    let attitude = level.attitude(heading, &kinematics.position, &kinematics.acceleration);
    let nominal = Nominal::at(&kinematics.position, &kinematics.velocity, &attitude.c_nb());
    let mut covariance = sensor_covariance(config);
    let diagonal = |std: f64| Matrix3::from_diagonal_element(std * std);
    POSITION.renew(&mut covariance, &diagonal(kinematics.position_std));
    VELOCITY.renew(&mut covariance, &diagonal(kinematics.velocity_std));
    let tilt = LEVEL_STD.hypot(config.imu.accel.bias_std / 9.8);
    let in_ned = Matrix3::from_diagonal(&Vector3::new(tilt * tilt, tilt * tilt, turn * turn));
    let c_en = insd_base::earth::c_ne(&kinematics.position).transpose();
    ATTITUDE.renew(&mut covariance, &(c_en * in_ned * c_en.transpose()));
    InitialState::new(level.time, nominal, covariance, level.rate)
}

#[cfg(test)]
mod tests;
