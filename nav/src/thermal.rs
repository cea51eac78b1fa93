//! How the biases of an IMU follow its temperature, as it is known before a voyage and after it.
//!
//! Of each axis b(T) = b(R) + h (T - R) + k (T - R)^2, R the reference: h the slope, k the bend. The bias at the reference is that of
//! the switch-on, another one each time, and no part of it.

use nalgebra::Vector3;

/// What is known of gyros and accelerometers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThermalModel {
    /// Temperature that the slopes are those at, degrees Celsius.
    pub reference: f64,
    /// The gyros, rad/s.
    pub gyro: ThermalTriad,
    /// The accelerometers, m/s^2.
    pub accel: ThermalTriad,
}

/// What is known of three axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThermalTriad {
    /// Slope of each axis, unit per K.
    pub slope: Vector3<f64>,
    /// Bend of each axis, unit per K^2.
    pub bend: Vector3<f64>,
    /// Of each axis the variance of the slope, its covariance with the bend, and the variance of that.
    pub covariance: [[f64; 3]; 3],
}

impl ThermalModel {
    /// The same with the slopes at another temperature, degrees Celsius.
    #[must_use]
    pub fn about(&self, reference: f64) -> Self {
        let apart = reference - self.reference;
        ThermalModel { reference, gyro: self.gyro.moved(apart), accel: self.accel.moved(apart) }
    }
}

impl ThermalTriad {
    fn moved(&self, apart: f64) -> Self {
        let covariance = self.covariance.map(|[slope, both, bend]| {
            let far = 2.0 * apart;
            [slope + far * (2.0 * both + far * bend), both + far * bend, bend]
        });
        ThermalTriad { slope: self.slope + self.bend * (2.0 * apart), bend: self.bend, covariance }
    }

    /// The largest 1-sigma of a slope, unit per K.
    #[must_use]
    pub fn slope_std(&self) -> f64 {
        self.largest(0)
    }

    /// The largest 1-sigma of a bend, unit per K^2.
    #[must_use]
    pub fn bend_std(&self) -> f64 {
        self.largest(2)
    }

    fn largest(&self, of: usize) -> f64 {
        self.covariance.iter().map(|own| own[of]).fold(0.0, f64::max).sqrt()
    }

    /// With something added to every variance of a slope and of a bend.
    #[must_use]
    pub fn less_sure(mut self, slope_std: f64, bend_std: f64) -> Self {
        for own in &mut self.covariance {
            own[0] += slope_std * slope_std;
            own[2] += bend_std * bend_std;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_reference_is_the_same_curve() {
        let triad = ThermalTriad {
            slope: Vector3::new(1e-5, -2e-5, 0.0),
            bend: Vector3::new(1e-7, 0.0, -3e-7),
            covariance: [[4e-12, 1e-14, 1e-15]; 3],
        };
        let own = ThermalModel { reference: 20.0, gyro: triad, accel: triad };
        let other = own.about(35.0);
        let bias = |model: &ThermalModel, celsius: f64| {
            let apart = celsius - model.reference;
            (model.gyro.slope + model.gyro.bend * apart) * apart
        };
        for celsius in [10.0, 25.0, 50.0] {
            let told = bias(&other, celsius) - bias(&other, 20.0);
            assert!((told - bias(&own, celsius)).norm() < 1e-15, "{celsius}");
        }
        let back = other.about(20.0);
        for (was, is) in
            own.gyro.covariance.iter().flatten().zip(back.gyro.covariance.iter().flatten())
        {
            assert!((was - is).abs() < 1e-20);
        }
    }
}
