//! What is learnt of the sensors while the ship is well aided, for the time when she is not.

use insd_base::{Body, Estimate, ImuSample, Span, Time};
use insd_learning::model::PRIOR;
use insd_learning::{
    Collector, Compensation, KeptModel, LabelLook, Learner, LearnerVerdict, Thermal,
};
use insd_nav::NavConfig;
use insd_nav::config::LogShape;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Biases of the gyros are looked at so often, s, and what is taken away for the temperature is renewed so often.
const LOOK: f64 = 30.0;
const RENEW: f64 = 120.0;
/// A temperature is that of the IMU for so long, s.
const FRESH: f64 = 60.0;

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
    /// It may not be used; what is taken away from the gyros stays as it was then, rad/s.
    barred: Option<Vector3<f64>>,
}

/// How what is learnt stands.
#[derive(Clone, Debug, PartialEq)]
pub struct LearningStatus {
    /// What is learnt.
    pub kept: KeptModel,
    /// Whether it may be used.
    pub may_be_used: bool,
    /// Whether what was learnt of the log is used, of the current, and of the gyros.
    pub used: [bool; 3],
}

impl Learning {
    /// One where it is wanted.
    pub(crate) fn where_wanted(
        is_wanted: bool,
        config: &NavConfig,
        kept: Option<&KeptModel>,
    ) -> Option<Box<Self>> {
        is_wanted.then(|| Box::new(Learning::new(config, kept)))
    }

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
                let (found, covariance) = kept.belief();
                [1, 3].map(|i| (found[i], covariance[(i, i)].max(0.0).sqrt()))
            }),
            earlier: kept.map_or((0, 0), |kept| (kept.voyages, kept.generation)),
            barred: None,
        }
    }

    /// The same, barred or not.
    pub(crate) fn barred(mut self, is_barred: bool) -> Self {
        self.bar(is_barred);
        self
    }

    /// Whether it may not be used.
    pub(crate) fn is_barred(&self) -> bool {
        self.barred.is_some()
    }

    /// Bars it or allows it; what is taken away from the gyros does not step.
    pub(crate) fn bar(&mut self, is_barred: bool) {
        match (self.barred, is_barred) {
            (None, true) => self.barred = Some(self.taken_away()),
            (Some(until_then), false) => {
                self.barred = None;
                self.renew(&until_then);
            }
            _ => {}
        }
    }

    /// How it stands.
    pub(crate) fn status(&self, kept: KeptModel) -> LearningStatus {
        let may_be_used = !self.is_barred();
        let standing = self.learner.standing();
        let used = [standing.is_used, standing.current.is_some(), self.compensation.is_some()];
        LearningStatus { kept, may_be_used, used: used.map(|used| used && may_be_used) }
    }

    /// Takes away from now on what is known of the gyros; it begins at what was until then, rad/s.
    fn renew(&mut self, until_then: &Vector3<f64>) {
        let Some((_, celsius)) = self.celsius.filter(|_| self.thermal.is_known()) else { return };
        self.compensation = Some(Compensation::beginning(&self.thermal, celsius, until_then));
    }

    /// What is taken away from the rate at this temperature, rad/s.
    fn taken_away(&self) -> Vector3<f64> {
        if let Some(barred) = self.barred {
            return barred;
        }
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
    pub(crate) fn kept(&self) -> KeptModel {
        let (voyages, generation) = self.earlier;
        let mut own = KeptModel::new(self.learner.kept(), self.thermal.kept());
        (own.voyages, own.generation) = (voyages + 1, generation + 1);
        own
    }

    /// A sample without what the temperature makes of it.
    pub(crate) fn corrected(&mut self, sample: &ImuSample, usual: f64) -> ImuSample {
        let apart = self.sampled.replace(sample.time).map(|last| (sample.time - last).as_seconds());
        let interval = apart.filter(|apart| (0.0..2.0 * usual).contains(apart)).unwrap_or(usual);
        let delta_theta = Body(sample.delta_theta.0 - self.taken_away() * interval);
        ImuSample { delta_theta, ..*sample }
    }

    /// The temperature of the IMU, degrees Celsius.
    pub(crate) fn feel(&mut self, time: Time, celsius: f64) {
        self.celsius = Some((time, celsius));
        if self.compensation.is_none() {
            self.renew(&Vector3::zeros());
        }
    }

    /// Whether the biases of the gyros are to be looked at.
    pub(crate) fn is_look_due(&self, now: Time) -> bool {
        let is_fresh = self.celsius.is_some_and(|(felt, _)| (now - felt).as_seconds() < FRESH);
        is_fresh && since(self.looked, now) >= LOOK
    }

    /// Learns from biases of the gyros, rad/s, as they are beside what is taken away, with their 1-sigma.
    pub(crate) fn hear_biases(&mut self, now: Time, (bias, std): (Vector3<f64>, Vector3<f64>)) {
        let Some((_, celsius)) = self.celsius else { return };
        self.looked = Some(now);
        let until_then = self.taken_away();
        self.thermal.hear(now.as_seconds(), celsius, &(bias + until_then), &std);
        if self.thermal.is_known() && since(self.renewed, now) >= RENEW {
            self.renewed = Some(now);
            self.renew(&until_then);
        }
    }

    /// She is not well aided: what was begun is no label.
    pub(crate) fn pause(&mut self) {
        self.collector.spoil();
    }

    /// Learns from a look at a log; tells what that changed if it completes a label.
    pub(crate) fn hear_log(&mut self, look: &LabelLook) -> Option<Option<LearnerVerdict>> {
        let label = self.collector.take(look)?;
        Some(self.learner.hear(&label))
    }

    /// What the filter is to assume of the log, and of the current, 1-sigma, m/s, and time constant, s.
    pub(crate) fn wanted(&self) -> (Option<LogShape>, (f64, f64)) {
        if self.is_barred() {
            return (None, self.unknown_waters);
        }
        let standing = self.learner.standing();
        let current = standing.current.map(|current| (current.std, current.time));
        (standing.is_used.then(|| self.shape()), current.unwrap_or(self.unknown_waters))
    }
}

fn since(at: Option<Time>, now: Time) -> f64 {
    at.map_or(f64::INFINITY, |at| (now - at).as_seconds())
}
