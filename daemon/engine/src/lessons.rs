//! Lessons: the engine lets what learns look at the sensors while she is well aided, and does as it says.

use insd_base::{Event, LearntTurn, LogReference, LogVelocity, Message, Mode, Received, Time};
use insd_learning::{KeptModel, LabelLook, LearnerVerdict};
use insd_nav::{Filter, Navigator};
use nalgebra::Vector2;

use crate::heat;
use crate::learning::{Learning, LearningStatus};
use crate::ship::Ship;
use crate::{Engine, Stage};

/// A look at a log is one at its time to so much, s.
const TOGETHER: f64 = 0.3;

impl Engine {
    /// The temperature of the IMU, degrees Celsius: what its biases do with it is learnt.
    pub fn feel(&mut self, time: Time, celsius: f64) {
        if let Some(own) = self.learning.as_mut().filter(|_| celsius.is_finite()) {
            own.feel(time, celsius);
        }
    }

    /// Offers what was learnt on earlier voyages, as [`crate::EngineConfig::learnt`] does, before the first message. Where nothing is to be learnt it is of no use.
    pub fn offer_learnt(&mut self, model: &KeptModel) {
        let is_begun = self.machine.has_begun() || !matches!(self.stage, Stage::Levelling(_));
        if let Some(own) = self.learning.as_mut().filter(|_| !is_begun) {
            let is_barred = own.is_barred();
            **own = Learning::new(&self.nav, Some(model));
            own.bar(is_barred);
            self.nav.thermal = heat::of_earlier_voyages(Some(model), &self.nav);
        }
    }

    /// Whether what is learnt may be used; it is learnt all the same.
    pub fn use_learnt(&mut self, is_wanted: bool) {
        let Some(own) = &mut self.learning else { return };
        own.bar(!is_wanted);
        let wanted = own.wanted();
        if let Stage::Running(line) = &mut self.stage {
            line.amend(|ship| ship.learn_log(wanted));
        }
    }

    /// How what is learnt stands; `None` where nothing is to be.
    #[must_use]
    pub fn learning(&self) -> Option<LearningStatus> {
        let kept = self.learnt()?;
        let is_heat_known = self.filter().and_then(Filter::found_thermal).is_some();
        Some(self.learning.as_ref()?.status(kept, is_heat_known))
    }

    /// What is learnt, to be kept for the next voyage; `None` where nothing is.
    #[must_use]
    pub fn learnt(&self) -> Option<KeptModel> {
        let filter = self.filter();
        let thermal = filter.and_then(Filter::found_thermal);
        let mut kept = self.learning.as_ref()?.kept(thermal.as_ref());
        if let Some((found, covariance)) = filter.and_then(Filter::found_log) {
            kept.log = kept.log.with_found(&found, &covariance);
        }
        Some(kept)
    }

    /// The filter of the likeliest ship that navigates.
    fn filter(&self) -> Option<&Filter> {
        self.ship().and_then(Ship::likeliest).map(Navigator::filter)
    }

    /// Temperature of the IMU, degrees Celsius, if it is known.
    pub(crate) fn felt(&self, now: Time) -> Option<f64> {
        self.learning.as_ref()?.celsius(now)
    }

    /// Looks at a log beside the solution while she is aided.
    pub(crate) fn look_at_log(&mut self, received: &Received) {
        let Message::Log(log) = &received.message else { return };
        let is_aided = self.machine.mode() == Mode::Aided;
        let (Some(own), Stage::Running(line)) = (&mut self.learning, &mut self.stage) else {
            return;
        };
        let Ship::Navigating { navigator, .. } = line.estimator() else { return };
        if !is_aided {
            return own.pause();
        }
        let Some(look) = look(navigator.filter(), log) else { return };
        let Some(verdict) = own.hear_log(&look) else { return };
        let wanted = own.wanted();
        if navigator.filter().log_as_learnt() != wanted {
            line.amend(|ship| ship.learn_log(wanted));
        }
        if let Some(verdict) = verdict {
            let turn = match verdict {
                LearnerVerdict::Proven => LearntTurn::LogProven,
                LearnerVerdict::Unproven => LearntTurn::LogUnproven,
                LearnerVerdict::Changed => LearntTurn::LogChanged,
            };
            self.tell(Event::Learnt { time: log.time, turn });
        }
    }
}

/// A log that measures through the water beside the estimate at its time.
fn look(filter: &Filter, log: &LogVelocity) -> Option<LabelLook> {
    let (u, v) = (log.u?, log.v?);
    let is_together = (filter.time() - log.time).as_seconds().abs() < TOGETHER;
    if log.reference != LogReference::Water || !is_together {
        return None;
    }
    let own = filter.look_at_log(log);
    Some(LabelLook {
        time: log.time.as_seconds(),
        told: Vector2::new(u, v),
        told_std: own.stated_std,
        aided: own.velocity,
        aided_std: own.velocity_std,
        heading: own.heading,
        heading_std: own.heading_std,
        turn: own.turn,
    })
}
