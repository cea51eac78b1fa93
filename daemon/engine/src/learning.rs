//! What is learnt of the sensors while the ship is well aided, for the time when she is not.

use insd_base::{Estimate, Span, Time};
use insd_learning::kept::{BY_SPEED, BY_TURN};
use insd_learning::model::PRIOR;
use insd_learning::{Collector, KeptModel, KeptThermal, LabelLook, Learner, LearnerVerdict};
use insd_nav::NavConfig;
use insd_nav::config::LogShape;
use insd_nav::thermal::ThermalModel;
use serde::{Deserialize, Serialize};

use crate::heat;
use crate::thermometer::Thermometer;

/// A temperature is that of the IMU for so long, s.
const FRESH: f64 = 60.0;
/// Of what repeats of a log, its changes with the speed and with the turn, each forward and to starboard.
const SHAPE: [[usize; 2]; 2] = [BY_SPEED, BY_TURN];

/// What is learnt, and what of it is in use.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Learning {
    collector: Collector,
    learner: Learner,
    /// How the IMU followed its temperature on earlier voyages.
    imu: Option<KeptThermal>,
    thermometer: Thermometer,
    /// Temperatures that were felt on all voyages, degrees Celsius.
    range: Option<[f64; 2]>,
    /// How the current goes on before anything is learnt, 1-sigma, m/s, and time constant, s.
    unknown_waters: (f64, f64),
    /// What the filter is told of the log before it learns itself: value and 1-sigma by speed, 1/(m/s), and by turn, m, each forward and to
    /// starboard. What this voyage has told it learns itself, and nothing is counted twice.
    before: [[(f64, f64); 2]; 2],
    /// Voyages before, and how often the model of them was written.
    earlier: (u32, u32),
    /// It may not be used; biases stay what they were when that was said.
    is_barred: bool,
}

/// How what is learnt stands.
#[derive(Clone, Debug, PartialEq)]
pub struct LearningStatus {
    /// What is learnt.
    pub kept: KeptModel,
    /// Whether it may be used.
    pub may_be_used: bool,
    /// Whether what was learnt of the log is used, of the current, and of the temperature of the IMU.
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
        let log = kept.map(|kept| &kept.log);
        let imu = kept.and_then(|kept| kept.imu.as_ref());
        Learning {
            collector: Collector::default(),
            learner: log.map_or_else(Learner::default, Learner::after),
            imu: imu.cloned(),
            thermometer: Thermometer::default(),
            range: imu.map(|own| own.range_c),
            unknown_waters: (config.log.current_std, config.log.current_time),
            before: log.map_or(SHAPE.map(|own| own.map(|i| (0.0, PRIOR[i]))), |kept| {
                let (found, covariance) = kept.belief();
                let of = |i: usize| (found[i], covariance[(i, i)].max(0.0).sqrt());
                SHAPE.map(|own| own.map(of))
            }),
            earlier: kept.map_or((0, 0), |kept| (kept.voyages, kept.generation)),
            is_barred: false,
        }
    }

    /// Bars it or allows it.
    pub(crate) fn bar(&mut self, is_barred: bool) {
        self.is_barred = is_barred;
    }

    /// Whether it may not be used.
    pub(crate) fn is_barred(&self) -> bool {
        self.is_barred
    }

    /// How it stands.
    pub(crate) fn status(&self, kept: KeptModel, is_heat_known: bool) -> LearningStatus {
        let may_be_used = !self.is_barred;
        let standing = self.learner.standing();
        let used = [standing.is_used, standing.current.is_some(), is_heat_known];
        LearningStatus { kept, may_be_used, used: used.map(|used| used && may_be_used) }
    }

    /// The same on a time line that is later by a span.
    pub(crate) fn shifted(&self, by: Span) -> Self {
        Learning {
            // what was begun before the gap is no label
            collector: Collector::default(),
            thermometer: self.thermometer.shifted(by),
            ..self.clone()
        }
    }

    /// What the filter is told of the log.
    fn shape(&self) -> LogShape {
        let [by_speed, by_turn] =
            self.before.map(|own| own.map(|(value, sigma)| Estimate { value, sigma }));
        LogShape { by_speed, by_turn }
    }

    /// What is kept for the next voyage, with how the IMU was found to follow its temperature on this one.
    pub(crate) fn kept(&self, found: Option<&ThermalModel>) -> KeptModel {
        let (voyages, generation) = self.earlier;
        let imu = found.zip(self.range).map(|(found, range)| heat::kept(found, range));
        let mut own = KeptModel::new(self.learner.kept(), imu.or_else(|| self.imu.clone()));
        (own.voyages, own.generation) = (voyages + 1, generation + 1);
        own
    }

    /// The temperature of the IMU, degrees Celsius.
    pub(crate) fn feel(&mut self, time: Time, celsius: f64) {
        self.thermometer.hear(time, celsius);
        let Some((_, celsius)) = self.thermometer.felt() else { return };
        let [least, most] = self.range.unwrap_or([celsius; 2]);
        self.range = Some([least.min(celsius), most.max(celsius)]);
    }

    /// The temperature of the IMU as it may be used, degrees Celsius, if it was told of late.
    pub(crate) fn celsius(&self, now: Time) -> Option<f64> {
        let (felt, celsius) = self.thermometer.felt().filter(|_| !self.is_barred)?;
        ((now - felt).as_seconds() < FRESH).then_some(celsius)
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
        if self.is_barred {
            return (None, self.unknown_waters);
        }
        let standing = self.learner.standing();
        let current = standing.current.map(|current| (current.std, current.time));
        (standing.is_used.then(|| self.shape()), current.unwrap_or(self.unknown_waters))
    }
}
