//! Error model of the IMU as its data sheet states it.

use insd_base::{ImuSpec, Triad};
use schemars::JsonSchema;
use serde::Deserialize;

/// Keys and units as in a voyage's `[imu]`.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImuModel {
    /// Turn-on bias of the gyros, 1-sigma, deg/h.
    pub gyro_bias_std_deg_h: f64,
    /// In-run bias of the gyros, 1-sigma, deg/h.
    pub gyro_bias_instability_deg_h: f64,
    /// Time constant of the gyros' in-run bias, s.
    pub gyro_bias_time_constant_s: f64,
    /// Angle random walk, deg/sqrt(h).
    pub angle_random_walk_deg_sqrt_h: f64,
    /// Scale factor of the gyros, 1-sigma, ppm.
    pub gyro_scale_factor_std_ppm: f64,
    /// Turn-on bias of the accelerometers, 1-sigma, micro-g.
    pub accel_bias_std_ug: f64,
    /// In-run bias of the accelerometers, 1-sigma, micro-g.
    pub accel_bias_instability_ug: f64,
    /// Time constant of the accelerometers' in-run bias, s.
    pub accel_bias_time_constant_s: f64,
    /// Velocity random walk, (m/s)/sqrt(h).
    pub velocity_random_walk_mps_sqrt_h: f64,
    /// Scale factor of the accelerometers, 1-sigma, ppm.
    pub accel_scale_factor_std_ppm: f64,
}

impl ImuModel {
    /// In SI units, for an IMU with this many samples per second.
    #[must_use]
    pub fn spec(&self, rate: f64) -> ImuSpec {
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

    /// Each key with its value, and whether it is a time constant.
    pub(super) fn values(&self) -> [(&'static str, f64, bool); 10] {
        [
            ("gyro_bias_std_deg_h", self.gyro_bias_std_deg_h, false),
            ("gyro_bias_instability_deg_h", self.gyro_bias_instability_deg_h, false),
            ("gyro_bias_time_constant_s", self.gyro_bias_time_constant_s, true),
            ("angle_random_walk_deg_sqrt_h", self.angle_random_walk_deg_sqrt_h, false),
            ("gyro_scale_factor_std_ppm", self.gyro_scale_factor_std_ppm, false),
            ("accel_bias_std_ug", self.accel_bias_std_ug, false),
            ("accel_bias_instability_ug", self.accel_bias_instability_ug, false),
            ("accel_bias_time_constant_s", self.accel_bias_time_constant_s, true),
            ("velocity_random_walk_mps_sqrt_h", self.velocity_random_walk_mps_sqrt_h, false),
            ("accel_scale_factor_std_ppm", self.accel_scale_factor_std_ppm, false),
        ]
    }

    /// Values that cannot be, each with its place and what was expected.
    pub(super) fn faults(&self, place: &str) -> impl Iterator<Item = String> {
        let least = |is_time: bool| if is_time { 1e-3 } else { 0.0 };
        let bad = self
            .values()
            .into_iter()
            .filter(move |(_, value, is_time)| !(least(*is_time)..=1e9).contains(value));
        bad.map(move |(key, _, is_time)| {
            format!("{place}: {key}: expected {} to 1e9", least(is_time))
        })
    }
}
