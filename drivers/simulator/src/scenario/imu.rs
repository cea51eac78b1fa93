//! The inertial measurement unit: rate, error model by grade or in full, faults of the data line.

use serde::Deserialize;

use insd_base::{ImuSpec, Triad};

use super::fault::Faults;
use super::when::{Spread, When};

/// A class of IMU by name.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum ImuGrade {
    /// Ring-laser or fibre-optic gyros of 0.01 deg/h.
    Navigation,
    /// 0.5 deg/h.
    Tactical,
    /// 20 deg/h.
    Mems,
    /// No errors at all; the header states small positive numbers.
    Perfect,
}

/// An error model in the units of data sheets, with the keys of `voyage.toml`.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct ImuErrors {
    pub(crate) gyro_bias_std_deg_h: f64,
    pub(crate) gyro_bias_instability_deg_h: f64,
    pub(crate) gyro_bias_time_constant_s: f64,
    pub(crate) angle_random_walk_deg_sqrt_h: f64,
    pub(crate) gyro_scale_factor_std_ppm: f64,
    pub(crate) accel_bias_std_ug: f64,
    pub(crate) accel_bias_instability_ug: f64,
    pub(crate) accel_bias_time_constant_s: f64,
    pub(crate) velocity_random_walk_mps_sqrt_h: f64,
    pub(crate) accel_scale_factor_std_ppm: f64,
}

impl ImuErrors {
    /// From gyro (deg/h, deg/h, s, deg/sqrt(h), ppm) and accelerometer (ug, ug, s, (m/s)/sqrt(h),
    /// ppm) figures: turn-on bias, in-run bias, its time constant, random walk, scale factor.
    fn of(gyro: [f64; 5], accel: [f64; 5]) -> Self {
        ImuErrors {
            gyro_bias_std_deg_h: gyro[0],
            gyro_bias_instability_deg_h: gyro[1],
            gyro_bias_time_constant_s: gyro[2],
            angle_random_walk_deg_sqrt_h: gyro[3],
            gyro_scale_factor_std_ppm: gyro[4],
            accel_bias_std_ug: accel[0],
            accel_bias_instability_ug: accel[1],
            accel_bias_time_constant_s: accel[2],
            velocity_random_walk_mps_sqrt_h: accel[3],
            accel_scale_factor_std_ppm: accel[4],
        }
    }

    fn of_grade(grade: ImuGrade) -> Self {
        match grade {
            ImuGrade::Navigation => {
                Self::of([0.01, 0.003, 3600.0, 0.003, 10.0], [50.0, 10.0, 3600.0, 0.005_884, 50.0])
            }
            ImuGrade::Tactical => {
                Self::of([0.5, 0.1, 1000.0, 0.05, 100.0], [500.0, 50.0, 1000.0, 0.029_42, 200.0])
            }
            ImuGrade::Mems => {
                Self::of([20.0, 2.0, 600.0, 0.2, 500.0], [1000.0, 50.0, 600.0, 0.058_84, 500.0])
            }
            ImuGrade::Perfect => {
                Self::of([1e-5, 1e-5, 3600.0, 1e-5, 0.01], [0.1, 0.1, 3600.0, 1e-5, 0.01])
            }
        }
    }

    /// The model in SI.
    pub(crate) fn spec(&self, rate: f64) -> ImuSpec {
        ImuSpec {
            rate,
            gyro: Triad::of_gyros([
                self.gyro_bias_std_deg_h,
                self.gyro_bias_instability_deg_h,
                self.gyro_bias_time_constant_s,
                self.angle_random_walk_deg_sqrt_h,
                self.gyro_scale_factor_std_ppm,
            ]),
            accel: Triad::of_accelerometers([
                self.accel_bias_std_ug,
                self.accel_bias_instability_ug,
                self.accel_bias_time_constant_s,
                self.velocity_random_walk_mps_sqrt_h,
                self.accel_scale_factor_std_ppm,
            ]),
        }
    }

    fn check(&self, faults: &mut Faults) {
        for (key, value) in [
            ("gyro_bias_std_deg_h", self.gyro_bias_std_deg_h),
            ("gyro_bias_instability_deg_h", self.gyro_bias_instability_deg_h),
            ("angle_random_walk_deg_sqrt_h", self.angle_random_walk_deg_sqrt_h),
            ("gyro_scale_factor_std_ppm", self.gyro_scale_factor_std_ppm),
            ("accel_bias_std_ug", self.accel_bias_std_ug),
            ("accel_bias_instability_ug", self.accel_bias_instability_ug),
            ("velocity_random_walk_mps_sqrt_h", self.velocity_random_walk_mps_sqrt_h),
            ("accel_scale_factor_std_ppm", self.accel_scale_factor_std_ppm),
        ] {
            faults.not_negative(format!("imu.errors.{key}"), value);
        }
        for (key, value) in [
            ("gyro_bias_time_constant_s", self.gyro_bias_time_constant_s),
            ("accel_bias_time_constant_s", self.accel_bias_time_constant_s),
        ] {
            faults.positive(format!("imu.errors.{key}"), value);
        }
    }
}

/// Samples that never arrive.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct ImuGap {
    /// When.
    pub(crate) when: When,
    /// For how long.
    pub(crate) duration_s: Spread,
}

/// The steps in which angle and velocity are counted; zero is none.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Quantisation {
    /// Angle. What is left of a step goes into the next increment.
    #[serde(default)]
    pub(crate) gyro_arcsec: f64,
    /// Velocity, likewise.
    #[serde(default)]
    pub(crate) accel_mps: f64,
}

/// One line in the spectrum of what an engine does to the IMU. Each axis has an amplitude between a
/// third of these and all of it, and a phase of its own.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Vibration {
    /// Frequency.
    pub(crate) frequency_hz: f64,
    /// Greatest amplitude of the angular rate of an axis.
    #[serde(default)]
    pub(crate) rate_deg_s: f64,
    /// Greatest amplitude of the specific force along an axis.
    #[serde(default)]
    pub(crate) force_mps2: f64,
}

/// The inertial measurement unit.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Imu {
    /// Sampling rate.
    #[serde(default = "hundred")]
    pub(crate) rate_hz: f64,
    /// Error model by name; or give `errors`.
    pub(crate) grade: Option<ImuGrade>,
    /// Error model in full.
    pub(crate) errors: Option<ImuErrors>,
    /// Standard deviation of the sampling instants about the even grid; the increments cover
    /// the uneven intervals.
    #[serde(default)]
    pub(crate) jitter_std_s: f64,
    /// Steps of the increments.
    #[serde(default)]
    pub(crate) quantisation: Quantisation,
    /// What the engine does; too small and too quick to be in the truth.
    #[serde(default)]
    pub(crate) vibration: Vec<Vibration>,
    /// Share of the samples that never arrive, each lost on its own.
    #[serde(default)]
    pub(crate) lost_share: f64,
    /// Missing samples.
    #[serde(default)]
    pub(crate) gaps: Vec<ImuGap>,
    /// Samples sent twice.
    #[serde(default)]
    pub(crate) duplicates: Vec<When>,
}

fn hundred() -> f64 {
    100.0
}

impl Imu {
    /// The error model that the header states, SI.
    pub(crate) fn stated(&self) -> ImuSpec {
        let by_name = || ImuErrors::of_grade(self.grade.unwrap_or(ImuGrade::Navigation));
        self.errors.unwrap_or_else(by_name).spec(self.rate_hz)
    }

    /// The error model that is simulated, SI: that of the header, or nothing for `perfect`.
    pub(crate) fn simulated(&self) -> ImuSpec {
        if self.grade == Some(ImuGrade::Perfect) {
            let none = [0.0, 0.0, 1.0, 0.0, 0.0];
            ImuErrors::of(none, none).spec(self.rate_hz)
        } else {
            self.stated()
        }
    }

    pub(super) fn check(&self, faults: &mut Faults) {
        faults.range("imu.rate_hz", self.rate_hz, 10.0, 1000.0);
        faults.range("imu.jitter_std_s", self.jitter_std_s, 0.0, 0.2 / self.rate_hz);
        faults.range("imu.lost_share", self.lost_share, 0.0, 0.5);
        let steps = &self.quantisation;
        faults.range("imu.quantisation.gyro_arcsec", steps.gyro_arcsec, 0.0, 1e3);
        faults.range("imu.quantisation.accel_mps", steps.accel_mps, 0.0, 1.0);
        for (index, line) in self.vibration.iter().enumerate() {
            let key = format!("imu.vibration[{index}]");
            faults.range(format!("{key}.frequency_hz"), line.frequency_hz, 1.0, 1e4);
            faults.range(format!("{key}.rate_deg_s"), line.rate_deg_s, 0.0, 100.0);
            faults.range(format!("{key}.force_mps2"), line.force_mps2, 0.0, 100.0);
        }
        match (self.grade, &self.errors) {
            (Some(_), None) => {}
            (None, Some(errors)) => errors.check(faults),
            _ => faults.add("imu", "expected either grade or errors"),
        }
        for (index, gap) in self.gaps.iter().enumerate() {
            let key = format!("imu.gaps[{index}]");
            gap.duration_s.check(&format!("{key}.duration_s"), 0.0, 1e6, faults);
            gap.when.check(&format!("{key}.when"), gap.duration_s.bounds()[1], faults);
        }
        for (index, when) in self.duplicates.iter().enumerate() {
            when.check(&format!("imu.duplicates[{index}]"), 0.0, faults);
        }
    }
}
