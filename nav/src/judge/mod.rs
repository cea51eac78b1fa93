//! The judge: who of the sensors lies, by what all of them say together.
//!
//! Beside the navigator goes a [`Shadow`] that believes everybody. Faults of every sensor, the IMU among them, that may
//! have begun at many instants ([`Onset`]) are sized from its innovations; [`Dissenter`]s do not believe one sensor,
//! whatever it does. They are weighed against each other and against nobody lying ([`assessment`]). Three things
//! follow:
//!
//! - *A verdict*: one sensor's fault explains what nobody else's does, for some seconds on end. It is left out, and the
//!   estimate becomes what it would have been without it.
//! - *A doubt*: somebody lies, but who is not known. The claims cover all that may be ([`Judge::claims`]).
//! - *Neither*: a navigator that refuses somebody then is wrong itself, and becomes its shadow.

mod aid;
mod alternative;
mod amends;
mod appeal;
mod assessment;
mod both_heard;
mod charge;
mod claims;
mod dissenter;
pub(crate) mod docket;
mod evidence;
mod hypotheses;
mod lie;
mod newcomers;
mod noise;
mod onset;
mod pessimist;
mod receivers;
mod returned;
pub mod rows;
mod scatter;
mod separation;
mod shadow;
mod suspicion;
mod verdict;
mod welcome;

use insd_base::{Integrity, Judgement, Parties, Party, Standing, Stands, Time};
use nalgebra::{SMatrix, UnitQuaternion, Vector3};

use crate::config::NavConfig;
use crate::declaration::Declaration;
use crate::error_state::{Block, Covariance, Effects, Errors, Innovation, Weighed};
use crate::propagation::Passage;
pub use aid::Aid;
use aid::{AIDS, Hearing, agreement};
pub use alternative::{Alternative, Ruling};
use appeal::Appeal;
use charge::{Assessment, Charge, DOUBT};
use dissenter::{Dissenter, Success, log_likelihood};
pub use docket::Docket;
use newcomers::Newcomers;
use onset::Onset;
use pessimist::Pessimist;
use rows::{Direct, USUAL_ROWS};
pub use separation::Separation;
use shadow::Shadow;
pub use shadow::agitate;
use suspicion::{Allowed, Suspicion};

/// Looks are so far apart, s.
const LOOK: f64 = 0.95;
/// What nobody was heard for longer is no time in which somebody was seen to be right, s.
const UNHEARD: f64 = 5.0;
/// Mean square of an innovation beyond which it is an outlier.
const OUTLIER: f64 = 9.0;
/// Spacing of onsets, s, and the least one where something has happened.
const SPAWN: f64 = 5.0;
const MARKED: f64 = 0.95;
/// Onsets closer than this share of their age are one, from such an age on, s; none is older than this, s.
const CLOSE: f64 = 0.5;
const YOUNG: f64 = 16.0;
const OLDEST: f64 = 2500.0;
/// Onsets of so many of the likeliest faults are kept.
const FOREMOST: usize = 2;
/// Somebody is guilty who was found to be at each look for so long, s.
const PERSISTS: f64 = 4.0;
/// the same of somebody who is wrong in no way that is known, and might only be found to scatter, s.
const SCATTERS: f64 = 12.0;
/// A log of which the variance of the noise is so many times that stated tells now this and now that.
const WILD: f64 = 25.0;
/// All of it.
#[derive(Clone, Debug)]
pub struct Judge {
    shadow: Shadow,
    dissenters: Vec<Dissenter>,
    /// Of who does not believe the receiver that is compared.
    spare: Success,
    pessimist: Pessimist,
    onsets: Vec<Onset>,
    spawned: Option<Time>,
    looked: Option<Time>,
    hearings: [Hearing; AIDS],
    assessment: Assessment,
    in_doubt: bool,
    /// Who is suspected of it.
    suspect: Option<Charge>,
    /// What may be a lie as well as an IMU that is worse than assumed.
    disputed: Option<Charge>,
    accused: Option<(Party, Time)>,
    /// What the receiver was suspected of, of late.
    suspicions: Vec<Suspicion>,
    /// What of its lies the levels allowed for at the last looks, and where it is left out for a leap, at the last one before that.
    allowed: Allowed,
    /// What the receiver may have been doing in place of what the IMU was found to do, while that is still heard.
    appeal: Option<Box<Appeal>>,
    docket: Docket,
    /// Since when the log scatters wildly.
    wild: Option<Time>,
    /// The gyros do not find north on their own.
    is_coarse: bool,
    /// The IMU was not believed at all a while ago: where it and somebody else contradict each other it is at fault.
    imu_on_trial: bool,
    /// How many faults may be, of those who have been heard.
    rows: usize,
    /// When antennas that are a compass, and each docking aid, were heard first.
    newcomers: Newcomers,
}

impl Judge {
    /// A judge of a navigator with this covariance, to whom everybody is as before.
    #[must_use]
    pub fn new(covariance: &Covariance, config: &NavConfig, docket: Docket) -> Self {
        Judge {
            shadow: Shadow::of(covariance),
            pessimist: Pessimist::new(covariance, &config.imu),
            dissenters: vec![Dissenter::new(Party::Imu, Shadow::of(covariance))],
            spare: Success::default(),
            onsets: Vec::new(),
            spawned: None,
            looked: None,
            hearings: [Hearing::default(); AIDS],
            assessment: Assessment::default(),
            in_doubt: false,
            suspect: None,
            disputed: None,
            accused: None,
            suspicions: Vec::new(),
            allowed: Allowed::default(),
            appeal: None,
            wild: None,
            is_coarse: config.has_coarse_gyros(),
            imu_on_trial: docket.imu_doubted_since().is_some(),
            docket,
            rows: USUAL_ROWS,
            newcomers: Newcomers::default(),
        }
    }

    /// The standing of all.
    #[must_use]
    pub fn docket(&self) -> &Docket {
        &self.docket
    }

    /// A docking aid, by its number, measures to a line or point, by its place.
    pub fn note_mark(&mut self, number: usize, place: usize) {
        self.docket.note_mark(number, place);
    }

    /// Begins anew with a navigator; the standing of all stays, and what was in dispute is left open.
    pub fn restart(&mut self, covariance: &Covariance, config: &NavConfig) {
        self.leave_dispute_open();
        self.shadow = Shadow::of(covariance);
        self.pessimist = Pessimist::new(covariance, &config.imu);
        for dissenter in &mut self.dissenters {
            *dissenter = Dissenter::new(dissenter.whom, Shadow::of(covariance));
        }
        self.onsets.clear();
        self.spare = Success::default();
        self.suspicions.clear();
        (self.spawned, self.accused, self.in_doubt) = (None, None, false);
        (self.suspect, self.disputed) = (None, None);
        self.assessment = Assessment::default();
        self.keep_new_appeal();
    }

    fn shadows(&mut self) -> impl Iterator<Item = &mut Shadow> {
        let others = self.dissenters.iter_mut().map(|dissenter| &mut dissenter.shadow);
        [&mut self.shadow, &mut self.pessimist.shadow].into_iter().chain(others)
    }

    /// What is carried along with the errors beside them.
    fn all_effects(&mut self) -> impl Iterator<Item = &mut Effects> {
        let of_appeal = self.appeal.iter_mut().map(|appeal| appeal.effects_mut());
        self.onsets.iter_mut().map(Onset::effects_mut).chain(of_appeal)
    }

    /// The navigator's estimate was corrected.
    pub fn corrected(&mut self, error: &Errors) {
        self.shadows().for_each(|shadow| shadow.apart -= error);
    }

    /// What is known of the navigator's errors changes, in the same way of all estimates.
    pub fn change(&mut self, of: impl Fn(&mut Covariance)) {
        self.shadows().for_each(|shadow| of(&mut shadow.covariance));
    }

    /// A block of states is carried from now on.
    pub fn join(&mut self, declared: &Declaration, config: &NavConfig) {
        self.shadows().for_each(|shadow| declared.join(&mut shadow.covariance, config));
    }

    /// A block of states is not carried any longer.
    pub fn leave(&mut self, declared: &Declaration) {
        for shadow in self.shadows() {
            shadow.covariance.leave(declared.key);
            shadow.apart.conform(&shadow.covariance.layout().clone());
        }
    }

    /// The errors of a block of states are no longer those of before, and known to a covariance.
    pub fn renew<const W: usize>(&mut self, block: Block<W>, covariance: &SMatrix<f64, W, W>) {
        for shadow in self.shadows() {
            block.renew(&mut shadow.covariance, covariance);
            shadow.apart.scale_block(block, 0.0);
        }
        self.all_effects().for_each(|own| own.scale_block(block, 0.0));
    }

    /// The unit of a block of states has grown: their numbers are what they were, times a factor.
    pub fn rescale<const W: usize>(&mut self, block: Block<W>, factor: f64) {
        for shadow in self.shadows() {
            block.rescale(&mut shadow.covariance, factor);
            shadow.apart.scale_block(block, factor);
        }
        self.all_effects().for_each(|own| own.scale_block(block, factor));
    }

    /// Carries everything over a stretch.
    pub fn propagate(&mut self, passage: &Passage<'_>) {
        let layout = self.shadow.covariance.layout().clone();
        passage.over(&layout, |passing| {
            self.shadow.propagate(passing);
            for dissenter in &mut self.dissenters {
                dissenter.shadow.propagate(passing);
                dissenter.agitate(passage.stretch.duration);
            }
            self.all_effects().for_each(|own| passing.effects(own));
        });
        let worse = Passage { config: &passage.config.with_worse_imu(), ..*passage };
        worse.over(&layout, |passing| self.pessimist.shadow.propagate(passing));
    }

    /// Whether it is time to hear an aid.
    #[must_use]
    pub fn is_due(&self, aid: Aid, now: Time) -> bool {
        self.hearings[aid as usize].is_due(now)
    }

    /// Whether an aid was heard within such a time, s.
    #[must_use]
    pub fn has_heard(&self, aid: Aid, now: Time, within: f64) -> bool {
        self.hearings[aid as usize].was_within(now, within)
    }

    /// By how much the variance of an aid's noise is larger than stated.
    #[must_use]
    pub fn noise(&self, aid: Aid) -> f64 {
        self.hearings[aid as usize].noise()
    }

    /// Hears an innovation of the navigator before it is absorbed there, used or not, its noise raised by
    /// [`Judge::noise`]; `direct` gives what a fault of such an age, s, adds to it, `attitude` is the navigator's.
    pub fn hear(
        &mut self,
        aid: Aid,
        now: Time,
        innovation: &Innovation,
        attitude: &UnitQuaternion<f64>,
        direct: impl Fn(f64) -> Direct,
    ) {
        let hearing = &mut self.hearings[aid as usize];
        hearing.note(now);
        if hearing.see(innovation).is_some_and(|growth| self.is_noise_all(aid.party(), growth)) {
            self.acquit_all(aid.party());
        }
        let Some(weighed) = self.shadow.weigh(innovation, 1.0) else { return };
        let is_outlier = weighed.nis() > OUTLIER * weighed.rows() as f64;
        let (is_first, is_heard) = self.hearings[aid as usize].count(is_outlier);
        let is_new = self.welcome(aid, now);
        self.spawn(now, is_first || is_new);
        if !is_heard {
            return;
        }
        for onset in &mut self.onsets {
            let age = (now - onset.since).as_seconds();
            onset.hear((aid, now), &weighed, direct(age));
        }
        self.hear_appeal((aid, now), &weighed, attitude, &direct);
        let likelihood = log_likelihood(&weighed);
        self.spare.hear((aid, now), innovation, &weighed, &self.shadow);
        if aid.is_absorbed() {
            self.admit(aid.party());
            self.pessimist.hear(now, innovation, attitude, likelihood);
        }
        for dissenter in &mut self.dissenters {
            dissenter.hear((aid, now), innovation, attitude, likelihood);
        }
        if aid.is_absorbed() {
            self.shadow.absorb(&weighed, attitude);
        }
    }

    /// Whoever is heard for the first time may be disbelieved from then on.
    fn admit(&mut self, party: Option<Party>) {
        let Some(party) = party else { return };
        if self.dissenter(party).is_none() {
            self.dissenters.push(Dissenter::new(party, self.shadow.clone()));
        }
    }

    fn dissenter(&self, whom: Party) -> Option<&Dissenter> {
        self.dissenters.iter().find(|dissenter| dissenter.whom == whom)
    }

    /// How well who does not believe somebody finds what is said.
    fn success(&self, whom: Party) -> Option<&Success> {
        let own = (whom == Party::Gnss2).then_some(&self.spare);
        own.or_else(|| self.dissenter(whom).map(|dissenter| &dissenter.success))
    }

    /// Lets faults begin now, if it is time to, or something has happened.
    fn spawn(&mut self, now: Time, is_marked: bool) {
        let since = self.spawned.map_or(f64::INFINITY, |last| (now - last).as_seconds());
        if since < MARKED || (since < SPAWN && !is_marked) {
            return;
        }
        self.spawned = Some(now);
        self.onsets.retain(|onset| (now - onset.since).as_seconds() < OLDEST);
        let feared = self.feared(now);
        let mut i = 1;
        while i + 1 < self.onsets.len() {
            let age = (now - self.onsets[i].since).as_seconds();
            let apart = (self.onsets[i + 1].since - self.onsets[i - 1].since).as_seconds();
            let since = self.onsets[i].since;
            let is_kept = self.is_accused(since) || feared == Some(since);
            if age < YOUNG || apart > CLOSE * age || is_kept {
                i += 1;
            } else {
                self.onsets.remove(i);
            }
        }
        self.onsets.push(Onset::new(now, self.rows));
    }

    /// How much likelier what was said since an instant is if the gyros have told so much too much since then, rad/s,
    /// body axes, as a logarithm; what is said from now on is weighed for that.
    pub fn odds_of_gyros(&mut self, now: Time, since: Time, excess: &Vector3<f64>) -> f64 {
        let own = self.onsets.iter().find(|onset| onset.since >= since);
        let odds = own.map(|onset| onset.odds(rows::OF_GYROS, excess));
        if odds.is_none() {
            self.spawn(now, true);
        }
        odds.unwrap_or(0.0)
    }

    /// Whether a fault that began then is one of what the last look found likeliest.
    fn is_accused(&self, since: Time) -> bool {
        let foremost = self.assessment.charges.iter().take(FOREMOST);
        foremost.into_iter().any(|charge| charge.since(Time::START) == since)
    }

    fn begun(&self, since: Time) -> Option<&Onset> {
        self.onsets.iter().find(|onset| onset.since == since)
    }

    /// Whether it is time to look again.
    #[must_use]
    pub fn is_look_due(&self, now: Time) -> bool {
        self.looked.is_none_or(|last| (now - last).as_seconds() >= LOOK)
    }

    /// Looks at the evidence, once a second; gives who is found to lie.
    ///
    /// Nobody of `excused` is judged: what looks like his lie may be a mistake of the installation, or of the heading. These do not
    /// make a height or a place leap. Nor is a receiver or the IMU where a mistake of the installation is nearly as likely, by the
    /// logarithm of the ratio of its likelihood to that of none.
    pub fn look(&mut self, now: Time, excused: Parties, mistake: f64) -> Option<Ruling> {
        let unheard = self.looked.map_or(0.0, |last| (now - last).as_seconds());
        if unheard > UNHEARD {
            self.docket.postpone(unheard);
        }
        self.looked = Some(now);
        self.assessment = self.assess(now);
        self.note_suspicion(now);
        if self.docket.is_restless() {
            return self.look_at_imu(now);
        }
        let quiet = self.look_at_pessimist(now).or_else(|| self.look_at_scatter(now));
        if quiet.is_some() {
            return quiet;
        }
        let is_excused =
            |charge: &Charge| excused.contains(charge.party()) && !self.leaps(charge.party());
        let likeliest = self.likeliest();
        let astray = likeliest.and_then(|first| self.blamed_instead(&first, now));
        let foremost = likeliest.is_none().then(|| self.foremost_of_two(now)).flatten();
        let first = astray.or(likeliest).or(foremost).filter(|first| !is_excused(first));
        let is_new = first.is_some_and(|first| first.is_mistake && first.weight > first.needed());
        let is_likely = self.assessment.total > DOUBT || is_new;
        self.in_doubt = is_likely || self.disputed.is_some();
        let suspect = first.filter(|_| is_likely);
        self.docket.doubt(suspect.map(|first| first.fault), now);
        self.suspect = suspect;
        let is_sure = |first: &Charge| {
            let is_open = self.is_one_word(first, now) || first.may_be_a_mistake(mistake);
            astray.is_some() || (self.is_certain(first) && !is_open)
        };
        let certain = first.filter(is_sure);
        let before = self.accused.take();
        let accused = certain?;
        let whom = accused.party();
        let since = before.filter(|(party, _)| *party == whom).map_or(now, |(_, since)| since);
        self.accused = Some((whom, since));
        let persists = |needed: f64| (now - since).as_seconds() >= needed;
        if foremost.is_some() {
            return persists(SCATTERS).then(|| self.leave_out(&accused, now));
        }
        let shaped = self.shape_of(whom, excused.contains(whom)).unwrap_or(accused);
        let needed = if shaped.fault.is_noise() { SCATTERS } else { PERSISTS };
        persists(needed).then(|| {
            self.look_at_return(&shaped, now).unwrap_or_else(|| self.convict(&shaped, now))
        })
    }

    /// Sees an innovation of somebody who is left out, as it is and weighed by the navigator; `direct` is what faults add to it.
    pub fn watch(
        &mut self,
        (party, aid): (Party, Aid),
        now: Time,
        (innovation, weighed): (&Innovation, &Weighed),
        direct: &Direct,
    ) {
        let hearing = &mut self.hearings[aid as usize];
        hearing.note(now);
        hearing.see(innovation);
        let is_calm = hearing.noise() < WILD;
        let square = agreement(weighed).filter(|_| is_calm);
        if matches!(party, Party::Antennas | Party::Docking) {
            let sigmas = [weighed.sigma()[0], innovation.r[(0, 0)].sqrt()];
            return self.docket.follow_number(aid, now, (weighed.z()[0], square), sigmas);
        }
        let gain = self.docket.gain_of_log().filter(|_| party == Party::Log);
        let is_hidden = gain.is_some_and(|gain| !rows::would_show(direct, &gain, weighed));
        if square.is_none() || !is_hidden {
            self.docket.watch(party, now, square);
        }
    }

    /// Sees position and velocity of a receiver that is left out together, weighed by the navigator, whose own
    /// position is known to `own`, 1-sigma, m, and follows what the receiver, by its part, is off by; `noise` is that of its position, m.
    pub fn follow(
        &mut self,
        (party, now): (Party, Time),
        weighed: &Weighed,
        [noise, own]: [f64; 2],
    ) {
        if party == Party::Gnss2 {
            self.hearings[Aid::SparePosition as usize].note(now);
        }
        let alone = party == Party::Gnss && self.witnesses(now) == 0;
        self.docket.see_receiver((party, now), weighed, [noise, own], alone);
    }

    /// Sees the height of a receiver of which only that is wrong, weighed by the navigator.
    pub fn watch_height(&mut self, now: Time, weighed: &Weighed) {
        self.docket.watch(Party::Gnss, now, agreement(weighed));
    }

    /// What is made of all that is said.
    #[must_use]
    pub fn judgement(&self) -> Judgement {
        let is_doubted = |stands: &Stands| match stands.standing {
            Standing::Excluded => true,
            Standing::Doubtful => {
                stands.party == Party::Imu && !self.docket.is_imu_doubted_by_one()
            }
            Standing::Trusted | Standing::Probation => false,
        };
        let all = self.docket.all();
        let excluded: Parties = all.filter(is_doubted).map(|stands| stands.party).collect();
        let integrity = if self.assessment.total > DOUBT || self.docket.is_restless() {
            Integrity::Contradiction
        } else if self.docket.standing(Party::Gnss) == Standing::Probation {
            Integrity::Unproven
        } else {
            Integrity::Consistent
        };
        Judgement { integrity, excluded }
    }

    /// Whether what somebody says with an aid is not to be used now.
    #[must_use]
    pub fn withholds(&self, aid: Aid) -> bool {
        self.docket.leaves_out(aid) || self.docket.doubts(aid)
    }
}
