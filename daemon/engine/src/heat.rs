//! How the IMU follows its temperature, from what is kept between voyages to what the navigator begins with, and back.

use insd_base::Triad;
use insd_learning::{KeptModel, KeptThermal, KeptTriad};
use insd_nav::NavConfig;
use insd_nav::thermal::{ThermalModel, ThermalTriad};

/// By what calibrations age from voyage to voyage, in units of what is known of a sensor that was never heard.
const AGEING: f64 = 0.05;

/// What earlier voyages told, if there were any.
pub(crate) fn of_earlier_voyages(
    kept: Option<&KeptModel>,
    config: &NavConfig,
) -> Option<ThermalModel> {
    kept?.imu.as_ref().map(|imu| known(imu, config))
}

fn known(kept: &KeptThermal, config: &NavConfig) -> ThermalModel {
    let triad = |kept: &KeptTriad, own: &Triad| {
        ThermalTriad {
            slope: kept.slope_per_k.into(),
            bend: kept.bend_per_k2.into(),
            covariance: kept.covariance,
        }
        .less_sure(AGEING * own.thermal_slope_std(), AGEING * own.thermal_bend_std())
    };
    ThermalModel {
        reference: kept.reference_c,
        gyro: triad(&kept.gyros, &config.imu.gyro),
        accel: triad(&kept.accelerometers, &config.imu.accel),
    }
}

/// What is kept of what was found, in a range of temperatures, degrees Celsius; about its middle.
pub(crate) fn kept(found: &ThermalModel, range: [f64; 2]) -> KeptThermal {
    let found = found.about(0.5 * (range[0] + range[1]));
    let triad = |own: &ThermalTriad| KeptTriad {
        slope_per_k: own.slope.into(),
        bend_per_k2: own.bend.into(),
        covariance: own.covariance,
    };
    KeptThermal {
        reference_c: found.reference,
        range_c: range,
        gyros: triad(&found.gyro),
        accelerometers: triad(&found.accel),
    }
}
