//! What the temperature of the IMU does to its biases: states of their own once it changes.

use nalgebra::Vector3;

use super::Filter;
use crate::declaration::Carried;
use crate::error_state::{
    ACCEL_THERMAL, ACCEL_THERMAL_BEND, Block, GYRO_THERMAL, GYRO_THERMAL_BEND,
};
use crate::thermal::{ThermalModel, ThermalTriad};

/// By how much the temperature must have changed before anything is made of it, K: a ship whose IMU keeps its temperature pays nothing.
const CHANGED: f64 = 1.0;

impl Filter {
    /// The temperature of the IMU, degrees Celsius. Nothing steps when it begins to count: the biases are those of that moment.
    pub(super) fn feel(&mut self, celsius: f64) {
        let mut reference = *self.state.nominal.warmth.reference.get_or_insert(celsius);
        if !self.state.covariance.has(GYRO_THERMAL) {
            if (celsius - reference).abs() < CHANGED {
                return;
            }
            self.begin_to_feel(celsius);
            reference = celsius;
        }
        self.state.nominal.warmth.above = celsius - reference;
    }

    /// Biases follow the temperature from this one on, as they did on earlier voyages if that is known.
    fn begin_to_feel(&mut self, celsius: f64) {
        self.config.thermal = self.config.thermal.map(|known| known.about(celsius));
        self.begin_to_carry(Carried::WithTemperature);
        let nominal = &mut self.state.nominal;
        nominal.warmth.reference = Some(celsius);
        let Some(ThermalModel { gyro, accel, .. }) = self.config.thermal else { return };
        (nominal.gyro_thermal, nominal.gyro_thermal_bend) = (gyro.slope, gyro.bend);
        (nominal.accel_thermal, nominal.accel_thermal_bend) = (accel.slope, accel.bend);
    }

    /// How the biases are found to follow the temperature; `None` while it has not changed.
    #[must_use]
    pub fn found_thermal(&self) -> Option<ThermalModel> {
        if !self.state.covariance.has(GYRO_THERMAL) {
            return None;
        }
        let nominal = &self.state.nominal;
        Some(ThermalModel {
            reference: nominal.warmth.reference?,
            gyro: self.triad(
                [GYRO_THERMAL, GYRO_THERMAL_BEND],
                [nominal.gyro_thermal, nominal.gyro_thermal_bend],
            ),
            accel: self.triad(
                [ACCEL_THERMAL, ACCEL_THERMAL_BEND],
                [nominal.accel_thermal, nominal.accel_thermal_bend],
            ),
        })
    }

    fn triad(
        &self,
        [of_slope, of_bend]: [Block<3>; 2],
        [slope, bend]: [Vector3<f64>; 2],
    ) -> ThermalTriad {
        let p = &self.state.covariance;
        let (slopes, bends) = (of_slope.covariance(p), of_bend.covariance(p));
        let both = of_slope.covariance_with(of_bend, p);
        let covariance = std::array::from_fn(|i| [slopes[(i, i)], both[(i, i)], bends[(i, i)]]);
        ThermalTriad { slope, bend, covariance }
    }
}

#[cfg(test)]
mod tests {
    use crate::error_state::GYRO_THERMAL;
    use crate::filter::checkpoint::tests::filter;
    use crate::thermal::{ThermalModel, ThermalTriad};
    use nalgebra::Vector3;

    #[test]
    fn an_imu_that_keeps_its_temperature_costs_nothing_and_nothing_steps_when_it_warms_up() {
        let (_, mut filter) = filter();
        filter.feel(20.0);
        filter.feel(20.8);
        assert!(!filter.state.covariance.has(GYRO_THERMAL));
        assert!(filter.found_thermal().is_none());
        let before = filter.state.nominal.gyro_error();
        filter.feel(21.1);
        assert!(filter.state.covariance.has(GYRO_THERMAL));
        assert_eq!(filter.state.nominal.gyro_error(), before);
        assert_eq!(filter.state.nominal.warmth.above, 0.0);
        filter.feel(25.1);
        assert!((filter.state.nominal.warmth.above - 4.0).abs() < 1e-12);
    }

    #[test]
    fn what_earlier_voyages_told_is_where_a_voyage_begins() {
        let (_, mut filter) = filter();
        let triad = ThermalTriad {
            slope: Vector3::new(1e-8, 2e-8, -1e-8),
            bend: Vector3::repeat(1e-10),
            covariance: [[1e-18, 0.0, 1e-22]; 3],
        };
        let known = ThermalModel { reference: 30.0, gyro: triad, accel: triad };
        filter.config.thermal = Some(known);
        filter.feel(20.0);
        filter.feel(22.0);
        let found = filter.found_thermal().unwrap();
        assert_eq!(found.gyro.slope, known.about(22.0).gyro.slope);
        assert!((found.gyro.slope_std() - known.about(22.0).gyro.slope_std()).abs() < 1e-15);
        filter.feel(32.0);
        let bias = filter.state.nominal.gyro_error().bias;
        let expected = (found.gyro.slope + found.gyro.bend * 10.0) * 10.0;
        assert!((bias - expected).norm() < 1e-12);
    }
}
