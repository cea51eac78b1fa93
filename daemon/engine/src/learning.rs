//! What is learnt of the sensors while the ship is well aided, for the time when she is not.

use insd_base::{
    Body, Estimate, Event, ImuSample, LearntTurn, LogReference, LogVelocity, Message, Mode,
    Received, Span, Time,
};
use insd_learning::model::PRIOR;
use insd_learning::{Collector, Compensation, KeptModel, Learner, Look, Thermal, Verdict};
use insd_nav::config::LogShape;
use insd_nav::{Filter, NavConfig, Navigator};
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};

use crate::ship::Ship;
use crate::{Engine, Stage};

/// Biases of the gyros are looked at so often, s, and what is taken away for the temperature is renewed so often.
const LOOK: f64 = 30.0;
const RENEW: f64 = 120.0;
/// A temperature is that of the IMU for so long, s.
const FRESH: f64 = 60.0;
/// A look at a log is one at its time to so much, s.
const TOGETHER: f64 = 0.3;

/// What is learnt, and what of it is in use.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Learning {
    collector: Collector,
    learner: Learner,
    thermal: Thermal,
    compensation: Option<Compensation>,
    celsius: Option<(Time, f64)>,
    looked: Option<Time>,
    renewed: Option<Time>,
    sampled: Option<Time>,
    /// How the current goes on before anything is learnt, 1-sigma, m/s, and time constant, s.
    unknown_waters: (f64, f64),
    /// What the filter is told of the log before it learns itself: value and 1-sigma by speed, 1/(m/s), and by turn, m. What this voyage
    /// has told it learns itself, and nothing is counted twice.
    before: [(f64, f64); 2],
    /// Voyages before, and how often the model of them was written.
    earlier: (u32, u32),
}

impl Learning {
    /// One that goes on from earlier voyages, if there were any.
    pub(crate) fn new(config: &NavConfig, kept: Option<&KeptModel>) -> Self {
        let bias_std = config.imu.gyro.bias_std;
        let log = kept.map(|kept| &kept.log);
        let gyros = kept.and_then(|kept| kept.gyros.as_ref());
        Learning {
            collector: Collector::default(),
            learner: log.map_or_else(Learner::default, Learner::after),
            thermal: gyros
                .map_or_else(|| Thermal::unknown(bias_std), |own| Thermal::after(own, bias_std)),
            compensation: None,
            celsius: None,
            looked: None,
            renewed: None,
            sampled: None,
            unknown_waters: (config.log.current_std, config.log.current_time),
            before: log.map_or([(0.0, PRIOR[1]), (0.0, PRIOR[3])], |kept| {
                let std = |i: usize| kept.covariance[i].max(0.0).sqrt();
                [(kept.scale_by_speed_s_m, std(2)), (kept.slide_m, std(9))]
            }),
            earlier: kept.map_or((0, 0), |kept| (kept.voyages, kept.generation)),
        }
    }

    /// What is taken away from the rate at this temperature, rad/s.
    fn taken_away(&self) -> Vector3<f64> {
        let celsius = self.celsius.map(|(_, celsius)| celsius);
        let own = self.compensation.as_ref().zip(celsius).map(|(own, celsius)| own.rate(celsius));
        own.unwrap_or_else(Vector3::zeros)
    }

    /// The same on a time line that is later by a span.
    pub(crate) fn shifted(&self, by: Span) -> Self {
        let later = |time: Option<Time>| time.map(|time| time + by);
        Learning {
            // what was begun before the gap is no label, nor is a temperature of before it that of now
            collector: Collector::default(),
            celsius: self.celsius.map(|(time, celsius)| (time + by, celsius)),
            looked: later(self.looked),
            renewed: later(self.renewed),
            sampled: None,
            ..self.clone()
        }
    }

    /// What the filter is told of the log.
    fn shape(&self) -> LogShape {
        let [by_speed, by_turn] = self.before.map(|(value, sigma)| Estimate { value, sigma });
        LogShape { by_speed, by_turn }
    }

    /// What is kept for the next voyage.
    fn kept(&self) -> KeptModel {
        let (voyages, generation) = self.earlier;
        let mut own = KeptModel::new(self.learner.kept(), self.thermal.kept());
        (own.voyages, own.generation) = (voyages + 1, generation + 1);
        own
    }

    /// A sample without what the temperature makes of it.
    fn corrected(&mut self, sample: &ImuSample, usual: f64) -> ImuSample {
        let apart = self.sampled.replace(sample.time).map(|last| (sample.time - last).as_seconds());
        let interval = apart.filter(|apart| (0.0..2.0 * usual).contains(apart)).unwrap_or(usual);
        let delta_theta = Body(sample.delta_theta.0 - self.taken_away() * interval);
        ImuSample { delta_theta, ..*sample }
    }
}

impl Engine {
    /// The temperature of the IMU, degrees Celsius: what its biases do with it is learnt.
    pub fn feel(&mut self, time: Time, celsius: f64) {
        if let Some(own) = self.learning.as_mut().filter(|_| celsius.is_finite()) {
            own.celsius = Some((time, celsius));
            if own.compensation.is_none() && own.thermal.is_known() {
                let none = Vector3::zeros();
                own.compensation = Some(Compensation::beginning(&own.thermal, celsius, &none));
            }
        }
    }

    /// What is learnt, to be kept for the next voyage; `None` where nothing is.
    #[must_use]
    pub fn learnt(&self) -> Option<KeptModel> {
        let mut kept = self.learning.as_ref()?.kept();
        let filter = self.ship().and_then(Ship::likeliest).map(Navigator::filter);
        if let Some((found, covariance)) = filter.and_then(Filter::found_log) {
            kept.log = kept.log.with_found(&found, &covariance);
        }
        Some(kept)
    }

    /// A sample as it is used.
    pub(crate) fn without_heat(&mut self, sample: &ImuSample) -> ImuSample {
        let usual = 1.0 / self.config.imu.rate;
        self.learning.as_mut().map_or(*sample, |own| own.corrected(sample, usual))
    }

    /// Looks at the biases of the gyros now and then while she is aided.
    pub(crate) fn look_at_biases(&mut self, now: Time) {
        let is_aided = self.machine.mode() == Mode::Aided;
        let (Some(own), Stage::Running(line)) = (&mut self.learning, &self.stage) else { return };
        let since = |at: Option<Time>| at.map_or(f64::INFINITY, |at| (now - at).as_seconds());
        let Some((felt, celsius)) = own.celsius else { return };
        if !is_aided || since(Some(felt)) > FRESH || since(own.looked) < LOOK {
            return;
        }
        own.looked = Some(now);
        let Ship::Navigating { navigator, .. } = line.estimator() else { return };
        let found = navigator.filter().estimates(false);
        let bias = found.gyro_bias.0 + own.taken_away();
        own.thermal.hear(now.as_seconds(), celsius, &bias, &found.gyro_bias_sigma.0);
        if own.thermal.is_known() && since(own.renewed) >= RENEW {
            own.renewed = Some(now);
            let until_then = own.taken_away();
            own.compensation = Some(Compensation::beginning(&own.thermal, celsius, &until_then));
        }
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
            return own.collector.spoil();
        }
        let Some(look) = look(navigator.filter(), log) else { return };
        let Some(label) = own.collector.take(&look) else { return };
        let verdict = own.learner.hear(&label);
        let standing = own.learner.standing();
        let current = standing.current.map(|current| (current.std, current.time));
        let shape = standing.is_used.then(|| own.shape());
        let wanted = (shape, current.unwrap_or(own.unknown_waters));
        if navigator.filter().log_as_learnt() != wanted {
            line.amend(|ship| ship.learn_log(wanted));
        }
        if let Some(verdict) = verdict {
            let turn = match verdict {
                Verdict::Proven => LearntTurn::LogProven,
                Verdict::Unproven => LearntTurn::LogUnproven,
                Verdict::Changed => LearntTurn::LogChanged,
            };
            self.tell(Event::Learnt { time: log.time, turn });
        }
    }
}

/// A log that measures through the water beside the estimate at its time.
fn look(filter: &Filter, log: &LogVelocity) -> Option<Look> {
    let (u, v) = (log.u?, log.v?);
    let is_together = (filter.time() - log.time).as_seconds().abs() < TOGETHER;
    if log.reference != LogReference::Water || !is_together {
        return None;
    }
    let own = filter.look_at_log(log);
    Some(Look {
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
