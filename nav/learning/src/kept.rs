//! What is learnt, as it is kept from voyage to voyage: a text that people can read.
//!
//! TOML with units in the keys; the last line is a CRC-32 over all before it. Whatever the text is, reading it gives a model or a
//! reason.

use crc::{CRC_32_ISO_HDLC, Crc};
use nalgebra::{Matrix5, Matrix6, Vector5, Vector6};
use serde::{Deserialize, Serialize};

use crate::current::CurrentModel;
use crate::label::LENGTH;
use crate::trained::Trained;

/// The version that is written, and the only one that is read.
const VERSION: u32 = 3;
/// Longest text that is read, bytes.
pub const LONGEST: usize = 1 << 16;
/// How many values repeat: of each axis that at any speed, its change with the speed, and what a turn adds.
pub const REPEAT: usize = 6;
/// Values of the covariance of what repeats of a log.
const TRIANGLE: usize = REPEAT * (REPEAT + 1) / 2;
/// Of what repeats, the turn of the log.
const TURN: usize = 3;
/// Its changes with the speed, forward and to starboard.
pub const BY_SPEED: [usize; 2] = [1, 4];
/// And what turns add.
pub const BY_TURN: [usize; 2] = [2, 5];
/// What a filter finds, in its order.
const FOUND: [usize; 5] = [0, BY_SPEED[0], BY_SPEED[1], BY_TURN[0], BY_TURN[1]];
const SUM: &str = "checksum = ";

static CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// What is learnt, between voyages.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeptModel {
    version: u32,
    /// How often it was written.
    pub generation: u32,
    /// Voyages that it was learnt on.
    pub voyages: u32,
    /// The log and the current.
    pub log: KeptLog,
    /// How the IMU follows its temperature, where that was told and has changed.
    pub imu: Option<KeptThermal>,
}

/// What repeats of a log's errors, how the current goes on, and what it was worth.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeptLog {
    /// Half minutes that were learnt from.
    pub labels: u32,
    /// Scale factor, ratio: what the log tells too much.
    pub scale: f64,
    /// Its change with the speed, 1/(m/s).
    pub scale_by_speed_s_m: f64,
    /// What it adds forward by the size of the rate of turn, m.
    pub forward_by_turn_m: f64,
    /// Turn of the log, rad.
    pub turn_rad: f64,
    /// Its change with the speed, rad/(m/s).
    pub turn_by_speed_s_m: f64,
    /// What it adds to starboard by the rate of turn, m.
    pub slide_m: f64,
    /// Lower triangle of their covariance, by rows.
    pub covariance: [f64; TRIANGLE],
    /// 1-sigma of the current, each component, m/s.
    pub current_std_mps: f64,
    /// Its time constant, s.
    pub current_time_s: f64,
    /// Ends of the last outages that did not happen, without what was learnt, m.
    pub shadow_without_m: Vec<f64>,
    /// And with it, m.
    pub shadow_with_m: Vec<f64>,
    /// Speeds and turns that it was learnt on.
    #[serde(default)]
    pub trained: Trained,
}

/// How the biases of an IMU follow its temperature: slope at a reference and bend about it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeptThermal {
    /// Temperature that the slopes are those at, degrees Celsius.
    pub reference_c: f64,
    /// Range of temperatures that it was learnt in, degrees Celsius.
    pub range_c: [f64; 2],
    /// Gyros, rad/s.
    pub gyros: KeptTriad,
    /// Accelerometers, m/s^2.
    pub accelerometers: KeptTriad,
}

/// What is known of three axes, forward, starboard, down.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeptTriad {
    /// Slope of each, unit per K.
    pub slope_per_k: [f64; 3],
    /// Bend of each, unit per K^2.
    pub bend_per_k2: [f64; 3],
    /// Of each the variance of the slope, its covariance with the bend, and the variance of that.
    pub covariance: [[f64; 3]; 3],
}

/// Why a text is no model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KeptFault {
    /// It is longer than any model.
    #[error("longer than any model of a log")]
    TooLong,
    /// The checksum is not that of the text.
    #[error("damaged, or changed by hand: its checksum is another")]
    Checksum,
    /// It is not a model, or of another version of the program.
    #[error("no model of a log that this version reads")]
    NotAModel,
    /// A value is none that a model can have.
    #[error("a value that no model has")]
    OutOfRange,
}

impl KeptModel {
    /// A model of this version.
    #[must_use]
    pub fn new(log: KeptLog, imu: Option<KeptThermal>) -> Self {
        KeptModel { version: VERSION, generation: 1, voyages: 1, log, imu }
    }

    /// Whether nothing was learnt.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.log.labels == 0 && self.imu.is_none()
    }

    /// Hours that were learnt from.
    #[must_use]
    pub fn hours(&self) -> f64 {
        f64::from(self.log.labels) * LENGTH / 3600.0
    }

    /// The text; the same for the same model.
    #[must_use]
    pub fn text(&self) -> String {
        let body = toml::to_string(self).unwrap_or_default();
        // the tables stand last: the checksum is a comment behind them
        format!("{body}\n# {SUM}\"{:08x}\"\n", CRC.checksum(body.as_bytes()))
    }

    /// The model of a text.
    ///
    /// # Errors
    /// Why it is none.
    pub fn parse(text: &str) -> Result<Self, KeptFault> {
        if text.len() > LONGEST {
            return Err(KeptFault::TooLong);
        }
        let (body, sum) = text.rsplit_once(&format!("\n# {SUM}")).ok_or(KeptFault::NotAModel)?;
        if sum.trim() != format!("\"{:08x}\"", CRC.checksum(body.as_bytes())) {
            return Err(KeptFault::Checksum);
        }
        let model: KeptModel = toml::from_str(body).map_err(|_| KeptFault::NotAModel)?;
        if model.version != VERSION {
            return Err(KeptFault::NotAModel);
        }
        if model.is_sound() { Ok(model) } else { Err(KeptFault::OutOfRange) }
    }

    fn is_sound(&self) -> bool {
        let log = &self.log;
        let ratios = [log.scale, log.scale_by_speed_s_m, log.turn_rad, log.turn_by_speed_s_m];
        let lengths = [log.forward_by_turn_m, log.slide_m];
        let small =
            ratios.iter().all(|x| x.abs() < 0.5) && lengths.iter().all(|x| x.abs() < 1000.0);
        let current = (1e-3..=5.0).contains(&log.current_std_mps)
            && (60.0..=1e6).contains(&log.current_time_s);
        let is_variance = |i: usize| (0.0..1e6).contains(&log.covariance[in_triangle(i, i)]);
        let variances = (0..REPEAT).all(is_variance);
        let numbers = log.covariance.iter().chain(&log.shadow_with_m).chain(&log.shadow_without_m);
        small
            && current
            && variances
            && log.trained.is_sound()
            && numbers.clone().all(|x| x.is_finite())
            && log.shadow_with_m.len() == log.shadow_without_m.len()
            && self.imu.as_ref().is_none_or(KeptThermal::is_sound)
    }
}

impl KeptThermal {
    fn is_sound(&self) -> bool {
        let [least, most] = self.range_c;
        (-100.0..=most).contains(&least)
            && most < 200.0
            && (-100.0..200.0).contains(&self.reference_c)
            && self.gyros.is_sound()
            && self.accelerometers.is_sound()
    }
}

impl KeptTriad {
    fn is_sound(&self) -> bool {
        let mut values = self.slope_per_k.iter().chain(&self.bend_per_k2);
        let is_covariance = |own: &[f64; 3]| {
            let [slope, both, bend] = *own;
            (0.0..1.0).contains(&slope) && (0.0..1.0).contains(&bend) && both * both <= slope * bend
        };
        values.all(|x| x.abs() < 1.0) && self.covariance.iter().all(is_covariance)
    }

    /// By how much the bias of each axis is other than at the reference, this many kelvins above it.
    #[must_use]
    pub fn change(&self, above: f64) -> [f64; 3] {
        std::array::from_fn(|i| (self.slope_per_k[i] + self.bend_per_k2[i] * above) * above)
    }
}

/// Where an entry of a symmetric matrix stands in its lower triangle, by rows.
pub(crate) fn in_triangle(i: usize, j: usize) -> usize {
    let (row, column) = (i.max(j), i.min(j));
    row * (row + 1) / 2 + column
}

impl KeptLog {
    /// Scale, its slope, s/m, what turns add forward, m, turn of the log, rad, its slope, s/m, slide, m, and their covariance.
    #[must_use]
    pub fn belief(&self) -> (Vector6<f64>, Matrix6<f64>) {
        let x = Vector6::new(
            self.scale,
            self.scale_by_speed_s_m,
            self.forward_by_turn_m,
            self.turn_rad,
            self.turn_by_speed_s_m,
            self.slide_m,
        );
        (x, Matrix6::from_fn(|i, j| self.covariance[in_triangle(i, j)]))
    }

    /// With all but the turn of the log (scale factor, its change with the speed and that of the turn, what turns add forward and
    /// to starboard) as a filter has found them together with all else, and their covariance: the heading that labels are told in leans to what a log says in a turn, and they see less of the slide than there is.
    #[must_use]
    pub fn with_found(self, found: &Vector5<f64>, covariance: &Matrix5<f64>) -> Self {
        let (mut x, before) = self.belief();
        let mut p = Matrix6::zeros();
        p[(TURN, TURN)] = before[(TURN, TURN)];
        for (i, to) in FOUND.into_iter().enumerate() {
            x[to] = found[i];
            FOUND
                .into_iter()
                .enumerate()
                .for_each(|(j, other)| p[(to, other)] = covariance[(i, j)]);
        }
        self.with_belief(&x, &p)
    }

    fn with_belief(mut self, x: &Vector6<f64>, p: &Matrix6<f64>) -> Self {
        (self.scale, self.scale_by_speed_s_m, self.forward_by_turn_m) = (x[0], x[1], x[2]);
        (self.turn_rad, self.turn_by_speed_s_m, self.slide_m) = (x[3], x[4], x[5]);
        for i in 0..REPEAT {
            (0..=i).for_each(|j| self.covariance[in_triangle(i, j)] = p[(i, j)]);
        }
        self
    }

    /// Of values with their covariance and a current.
    pub(crate) fn of(x: &Vector6<f64>, p: &Matrix6<f64>, current: &CurrentModel) -> Self {
        let (current_std_mps, current_time_s) = (current.std, current.time);
        KeptLog { current_std_mps, current_time_s, ..KeptLog::default() }.with_belief(x, p)
    }
}
