//! The voyage of the noise-free scenario integrated by the mechanisation alone: what it loses.

use insd_base::{Truth, Voyage, earth};
use insd_nav::strapdown::{self, LocalGravity};
use insd_nav::{Conditioned, Conditioner, Nominal};

/// Samples between new anchors of gravity, as often as the filter does it.
const ANCHOR: usize = 10;

/// Largest errors of a free run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loss {
    /// Horizontal position, m.
    pub horizontal: f64,
    /// Height, m.
    pub vertical: f64,
    /// Angle between true and computed attitude, rad.
    pub attitude: f64,
}

/// Integrates the IMU of a voyage from its true initial state and compares with its truth.
#[must_use]
pub fn integrate(voyage: &Voyage) -> Loss {
    let mut truth = voyage.truth.iter();
    let mut nominal = at(truth.next().unwrap());
    let mut gravity = LocalGravity::around(&nominal.position, &nominal.geodetic());
    let mut conditioner = Conditioner::new(&voyage.header.imu);
    let mut next = truth.next();
    let mut loss = Loss::default();
    for (index, sample) in voyage.imu.iter().enumerate() {
        let Conditioned::Sample(increment) = conditioner.take(&sample.message) else {
            panic!("a sample at {:?} is not like the others", sample.message.time);
        };
        strapdown::integrate(&mut nominal, &gravity, &increment);
        if index % ANCHOR == ANCHOR - 1 {
            nominal.attitude.renormalize();
            gravity = LocalGravity::around(&nominal.position, &nominal.geodetic());
        }
        while let Some(row) = next.filter(|row| row.time <= increment.to) {
            if row.time == increment.to {
                loss.widen(&nominal, row);
            }
            next = truth.next();
        }
    }
    loss
}

impl Loss {
    fn widen(&mut self, nominal: &Nominal, truth: &Truth) {
        let true_state = at(truth);
        let error_n = earth::c_ne(&truth.position) * (nominal.position - true_state.position);
        let turn = nominal.attitude * true_state.attitude.inverse();
        self.horizontal = self.horizontal.max(error_n.xy().norm());
        self.vertical = self.vertical.max(error_n.z.abs());
        self.attitude = self.attitude.max(turn.angle());
    }
}

/// The true state.
fn at(truth: &Truth) -> Nominal {
    Nominal::at(&truth.position, &truth.velocity.unwrap().0, &truth.attitude.unwrap().c_nb())
}
