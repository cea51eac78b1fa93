//! What follows when somebody is found to lie.

use insd_base::units::MICRO_G;
use insd_base::{Fault, Party, Standing, Stands, Time};

use super::aid::Aid;
use super::alternative::Ruling;
use super::charge::{Charge, DOUBT, Kind};
use super::docket::NO_LIE;
use super::pessimist::CONVINCED;
use super::{Judge, SCATTERS, UNHEARD, WILD};
use crate::config::WORST;
use crate::error_state::{ATTITUDE, GNSS_DELAY, GYRO_SCALE, POSITION, VELOCITY};

/// Mean square of an innovation that only a lie explains.
const BLATANT: f64 = 100.0;
/// An attitude that is off by more than this is beyond mending, rad: nothing is linear any more.
const MENDABLE: f64 = 0.2;
/// A gyro of which the scale is off by more is none: noise, too, is a scale factor of a gyro that tells little else.
const MENDABLE_SCALE: f64 = 0.3;
/// The moment at which an IMU began to be wrong is not known better than this, s.
const UNTIMED: f64 = 1.0;
/// An IMU of which a bias changed tells turns no better than so, as a ratio, until they have been seen: what changed it may
/// have changed that, too.
const WRONG_SCALE: f64 = 0.01;
/// Share of the weight, as a logarithm, of what explains as much.
const AS_MUCH: f64 = 0.95;
/// Within this before somebody is seen to lie the IMU may have been blamed for it, s.
const MEANWHILE: f64 = 60.0;
/// A log that stands still has not led the estimate further astray than this, 1-sigma, m/s: it is seen at once when she goes 0.6 m/s
/// otherwise.
const FOLLOWED: f64 = 0.3;
/// Fixes that are later than this are left out, s; others are set back.
const SET_BACK: f64 = 1.0;

impl Judge {
    /// While the IMU is not believed nobody else is judged; it is again when its word has been good for a while.
    pub(super) fn look_at_imu(&mut self, now: Time) -> Option<Ruling> {
        let is_of_imu = |charge: &&Charge| charge.fault == Fault::ImuUseless;
        let of_imu = self.assessment.charges.iter().find(is_of_imu).copied();
        self.docket.consider_imu(now);
        let wrong = of_imu.filter(|charge| charge.weight > 0.0)?;
        Some(self.convict(&wrong, now))
    }

    pub(super) fn convict(&mut self, charge: &Charge, now: Time) -> Ruling {
        if charge.party() == Party::Imu {
            return self.convict_imu(charge, now);
        }
        if self.imu_on_trial && self.docket.imu_doubted_since().is_some() {
            self.condemn_imu(now);
            return self.disbelieve_imu(now);
        }
        if let Some(shapeless) = self.without_size(charge) {
            let mended = Some(self.alternative(&shapeless));
            return Ruling { mended, ..self.leave_out(charge, now) };
        }
        let left = self.left(charge).unwrap_or(1.0);
        let mut mended = self.alternative(charge);
        // what is not explained has gone into the estimate
        if charge.kind != Kind::Shapeless && left > 1.0 {
            for block in [POSITION, VELOCITY] {
                let own = block.covariance(&mended.covariance).trace().max(0.0) / 3.0;
                block.inflate(&mut mended.covariance, (left - 1.0) * own);
            }
        }
        if charge.kind == Kind::Shapeless && self.lies_another(charge.party()) {
            return self.leave_out(charge, now);
        }
        if let Some(late) = charge.lateness() {
            if late.abs() < SET_BACK {
                let distance = self.leave_distance_open(now);
                self.hear_both(distance, charge, now);
                return Ruling { fault: charge.fault, mended: Some(mended) };
            }
            mended.error.scale_block(GNSS_DELAY, 0.0);
            GNSS_DELAY
                .renew(&mut mended.covariance, &GNSS_DELAY.covariance(&self.shadow.covariance));
        }
        Ruling { mended: Some(mended), ..self.leave_out(charge, now) }
    }

    /// What stands for a lie of which a shape has the name and not the size, as it leaves much unexplained: whoever has not believed him, if
    /// that explains it.
    fn without_size(&self, charge: &Charge) -> Option<Charge> {
        let shapeless = Charge::shapeless(charge.party(), 0.0);
        let is_no_shape = charge.kind == Kind::Shapeless || self.explains(charge);
        (!is_no_shape && self.explains(&shapeless)).then_some(shapeless)
    }

    /// An IMU cannot be left out: where a fault of a shape explains it all the estimate is mended, and it is believed
    /// with that; else it is not believed for a while.
    fn convict_imu(&mut self, charge: &Charge, now: Time) -> Ruling {
        self.docket.note_witnesses(self.witnesses(now), now);
        let lie = self.leave_lie_open(now);
        let push = self.false_push(charge);
        if push.is_some() {
            self.docket.note_alike(now);
        }
        let plain = push.unwrap_or_else(|| self.plain_fault_of_imu(charge));
        let mut mended = self.alternative(&plain);
        let turned = mended.error.of(ATTITUDE).norm();
        let is_wild = plain.fault == Fault::GyroScale && plain.size() > MENDABLE_SCALE;
        if plain.kind == Kind::Shapeless || turned > MENDABLE || is_wild {
            return self.disbelieve_imu(now);
        }
        ATTITUDE.inflate(&mut mended.covariance, (0.5 * turned * turned).powi(2));
        let untimed = if push.is_some() { POSITION } else { ATTITUDE };
        untimed.inflate(&mut mended.covariance, (plain.size() * UNTIMED).powi(2));
        if push.is_none() {
            GYRO_SCALE.inflate(&mut mended.covariance, WRONG_SCALE * WRONG_SCALE);
        }
        self.docket.convict(plain.fault, now, NO_LIE);
        // two that lie alike bear each other out
        self.hear_both(lie.filter(|_| push.is_none()), &plain, now);
        Ruling { fault: plain.fault, mended: Some(mended) }
    }

    /// Whether the IMU is worse than assumed, while nobody is known to lie.
    pub(super) fn look_at_pessimist(&mut self, now: Time) -> Option<Ruling> {
        let is_any_out = self.docket.all().any(|stands| stands.standing != Standing::Trusted);
        // what an IMU does that is worse than assumed looks like another bias of it first
        let likeliest = self.assessment.charges.first();
        let is_another = likeliest.is_some_and(|charge| charge.party() != Party::Imu);
        if is_any_out || self.assessment.total > DOUBT && is_another {
            self.pessimist.forget();
        }
        let is_one_against_one = self.is_one_against_one(now);
        let was_disputed = self.disputed.take().is_some() && is_one_against_one;
        if !(self.pessimist.is_likely() || was_disputed) || self.docket.worse() >= WORST {
            return None;
        }
        // once in dispute it stays so until the lie explains nothing any more
        self.disputed = self.explained_by_another(self.pessimist.gain.max(CONVINCED), now);
        if self.disputed.is_some() || !self.pessimist.is_right(now) {
            return None;
        }
        if is_one_against_one {
            self.leave_lie_open(now);
        }
        // a step is proven; what biases do that no aid sees, to the heading above all, asks for another
        self.docket = self.docket.with_worse_imu().with_worse_imu();
        Some(Ruling { fault: Fault::ImuWorse, mended: Some(self.pessimist.shadow.alternative()) })
    }

    /// A log that scatters wildly, as one that tells now the speed over the bottom and now that through the water, while
    /// a receiver is heard: without one, what it says is better than nothing.
    pub(super) fn look_at_scatter(&mut self, now: Time) -> Option<Ruling> {
        let is_wild = [Aid::Log, Aid::LogStarboard].iter().any(|aid| self.noise(*aid) > WILD);
        let of_gnss = &self.hearings[Aid::GnssPosition as usize];
        let has_fixes = of_gnss.was_within(now, UNHEARD) && !self.docket.leaves_out_gnss();
        if self.docket.is_excluded(Party::Log) {
            if is_wild && !has_fixes {
                self.docket.recall(Party::Log, now, Fault::is_noise);
            }
            return None;
        }
        // of an IMU that scatters itself a log is not known better
        let is_seen = has_fixes && self.docket.standing(Party::Imu) == Standing::Trusted;
        self.wild = self.wild.or(Some(now)).filter(|_| is_wild && is_seen);
        let persists = self.wild.is_some_and(|since| (now - since).as_seconds() >= SCATTERS);
        persists.then(|| {
            let charge = Charge::shapeless(Party::Log, DOUBT);
            let mended = self.alternative(&charge);
            self.docket.convict(charge.fault, now, NO_LIE);
            Ruling { fault: charge.fault, mended: Some(mended) }
        })
    }

    /// The IMU is of no use.
    pub fn condemn_imu(&mut self, now: Time) {
        self.docket.condemn_imu(now);
    }

    /// How many are heard of how she moves. A compass is no witness of that.
    pub(super) fn witnesses(&self, now: Time) -> usize {
        let all = [Aid::GnssPosition, Aid::SparePosition, Aid::Log, Aid::ReferencePosition];
        all.iter().filter(|aid| self.is_witness(**aid, now)).count()
    }

    /// Whether somebody is heard with an aid, and not left out.
    pub(super) fn is_witness(&self, aid: Aid, now: Time) -> bool {
        self.hearings[aid as usize].was_within(now, UNHEARD) && !self.docket.leaves_out(aid)
    }

    /// Whether it is one's word against the other's: a receiver that creeps away, and an IMU of which the biases grow beyond all
    /// that is assumed of them, are the same to each other.
    pub(super) fn is_one_word(&self, charge: &Charge, now: Time) -> bool {
        charge.fault == Fault::Creep && self.witnesses(now) < 2
    }

    /// Where no single fault explains what is said, as two lie: he of whom it explains most by far, or who contradicts himself.
    pub(super) fn foremost_of_two(&self, now: Time) -> Option<Charge> {
        let all = &self.assessment.charges;
        let is_own_word = self.is_gnss_contradicted(now);
        let most = all.iter().find(|most| !is_own_word || most.party() == Party::Gnss)?;
        if most.party() == Party::Imu || most.weight <= DOUBT {
            return None;
        }
        let is_rival = |other: &&Charge| {
            let is_excused = is_own_word && other.party() == Party::Imu;
            other.party() != most.party() && !is_excused
        };
        let rival = all.iter().find(is_rival);
        let is_far = rival.is_none_or(|rival| rival.weight < AS_MUCH * most.weight);
        (is_far && self.lies_another(most.party())).then_some(*most)
    }

    /// Leaves somebody out for what he does; the estimate stays as it is, as it must where somebody else lies, too.
    pub(super) fn leave_out(&mut self, charge: &Charge, now: Time) -> Ruling {
        let age = (now - charge.since(now)).as_seconds();
        self.docket.convict(charge.fault, now, charge.lie_of_gnss(age));
        Ruling { fault: charge.fault, mended: None }
    }

    /// Whether somebody else lies beside him, as whoever does not believe him has found out: then what is made of the
    /// others' word is no better than the navigator's estimate, which has refused them.
    pub(super) fn lies_another(&self, whom: Party) -> bool {
        self.success(whom).is_some_and(|success| success.worst > BLATANT)
    }

    /// Whether the lie of another, who is no IMU, explains what is said far better than his does.
    fn is_another_likelier(&self, whom: Party) -> bool {
        let all = &self.assessment.charges;
        let own = all.iter().find(|charge| charge.party() == whom);
        let own = own.map_or(0.0, |own| own.weight).max(DOUBT);
        let is_far = |first: &Charge| AS_MUCH * first.weight > own;
        all.first().is_some_and(|first| {
            first.party() != whom && first.party() != Party::Imu && is_far(first)
        })
    }

    /// What somebody does who is found to lie, if it has a shape; `early` while only leaps of a place are no mistakes of the installation.
    pub(super) fn shape_of(&self, whom: Party, early: bool) -> Option<Charge> {
        let shaped = self.shaped(whom).or_else(|| self.leap(whom));
        let shaped = shaped.or_else(|| self.wrong_velocity(whom));
        shaped.or_else(|| self.far_jump(whom).filter(|_| early))
    }

    /// The receiver in use contradicts itself, or tells the past.
    pub fn note_contradiction(&mut self, now: Time) {
        self.hearings[Aid::GnssPosition as usize].note_contradiction(now);
    }

    /// Who is to blame where the likeliest fault is another's.
    pub(super) fn blamed_instead(&self, first: &Charge, now: Time) -> Option<Charge> {
        self.astray_meanwhile(first, now).or_else(|| self.contradicts_itself(first, now))
    }

    /// A receiver of which the position does not go where its velocity says lies, whatever the IMU does: it is not blamed for that.
    fn contradicts_itself(&self, first: &Charge, now: Time) -> Option<Charge> {
        if first.party() != Party::Imu || !self.is_gnss_contradicted(now) {
            return None;
        }
        self.as_likely(first, |other| other.party() == Party::Gnss)
    }

    /// Whether the receiver in use contradicts itself.
    fn is_gnss_contradicted(&self, now: Time) -> bool {
        self.hearings[Aid::GnssPosition as usize].was_contradicted_within(now, UNHEARD)
    }

    /// A receiver that is heard again contradicts a heading that gyros have carried alone meanwhile: they have had the time to go astray, and
    /// where they explain as much as its lie would they did. What is beyond 10 deg no model is linear in: as much is nearly as much.
    pub(super) fn astray_meanwhile(&self, first: &Charge, now: Time) -> Option<Charge> {
        let of_gnss = &self.hearings[Aid::GnssPosition as usize];
        let is_back = first.party() == Party::Gnss && of_gnss.was_resumed_within(now, MEANWHILE);
        if !is_back || self.has_heard(Aid::Heading, now, MEANWHILE) {
            return None;
        }
        self.as_likely(first, |other| other.fault == Fault::ImuUseless)
    }

    /// The likeliest of some faults, where it explains as much as another does.
    fn as_likely(&self, first: &Charge, is_meant: impl Fn(&Charge) -> bool) -> Option<Charge> {
        let mut all = self.assessment.charges.iter();
        all.find(|other| is_meant(other) && other.weight > AS_MUCH * first.weight).copied()
    }

    /// Somebody is seen to lie by what he says alone, as one whose numbers stand still; gives the estimate of who has not believed him, or
    /// none where that follows somebody else who lies. What was made of the others meanwhile is of no account; but for what has followed already
    /// where the IMU was blamed.
    pub fn disbelieve(&mut self, whom: Party, now: Time) -> Option<Ruling> {
        self.docket.doubt(None, now);
        let charge = Charge::shapeless(whom, DOUBT);
        let is_blamed = |since: Time| (now - since).as_seconds() < MEANWHILE;
        if self.docket.imu_doubted_since().is_some_and(is_blamed) {
            self.docket.absolve_imu(now);
            self.imu_on_trial = false;
            return Some(Ruling { fault: charge.fault, mended: None });
        }
        if self.lies_another(whom) || self.is_another_likelier(whom) {
            return Some(Ruling { fault: charge.fault, mended: None });
        }
        let mut mended = self.alternative(&charge);
        if self.rehabilitate(whom, now) && whom == Party::Log {
            VELOCITY.inflate(&mut mended.covariance, FOLLOWED * FOLLOWED);
            POSITION.inflate(&mut mended.covariance, (0.5 * FOLLOWED * MEANWHILE).powi(2));
            // what the velocity followed in that time looks like a lean
            let lean = FOLLOWED / (MEANWHILE * 1e6 * MICRO_G);
            ATTITUDE.inflate(&mut mended.covariance, lean * lean);
        }
        Some(Ruling { fault: charge.fault, mended: Some(mended) })
    }

    /// Hears those again who were found to drift from somebody who has turned out to lie. Whether anybody was found to lie meanwhile: then the
    /// judge has begun anew with an estimate that believed him.
    fn rehabilitate(&mut self, liar: Party, now: Time) -> bool {
        let is_of_late = |stands: &Stands| {
            let age = (now - stands.since).as_seconds();
            stands.party != liar && stands.standing == Standing::Excluded && age < MEANWHILE
        };
        let mut is_anybody = false;
        let before = self.docket;
        for stands in before.all().filter(is_of_late) {
            is_anybody = true;
            self.docket.recall(stands.party, now, Fault::is_drift);
        }
        is_anybody
    }

    /// The IMU is wrong, as what it says is not what any ship does; gives the estimate without it.
    pub fn disbelieve_imu(&mut self, now: Time) -> Ruling {
        self.docket.note_witnesses(self.witnesses(now), now);
        self.imu_on_trial = true;
        self.docket.disbelieve_imu(now);
        let charge = Charge::shapeless(Party::Imu, DOUBT);
        Ruling { fault: charge.fault, mended: Some(self.alternative(&charge)) }
    }
}
