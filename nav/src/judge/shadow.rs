//! A filter that believes everybody: what the estimate would be if nobody were refused.
//!
//! Its estimate is told as its difference from the navigator's, linear about it, and has a covariance of its own. Its
//! innovations are white as long as nobody lies, which those of a filter that refuses are not: only in them can a
//! lie be sized.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use super::alternative::Alternative;
use crate::error_state::{ATTITUDE, Covariance, Errors, Innovation, VELOCITY, Weighed};
use crate::propagation::Passing;
use crate::symmetry::turn_biases;

/// Its estimate less the navigator's, and the covariance of its errors.
#[derive(Clone, Debug)]
pub(super) struct Shadow {
    /// What the navigator's estimate lacks to it.
    pub(super) apart: Errors,
    /// Covariance of its errors.
    pub(super) covariance: Covariance,
    turned: Vector3<f64>,
}

/// Correction of the attitude after which the knowledge of the biases is turned with it, rad.
const TURN: f64 = 2e-4;

/// An attitude so far from the navigator's is the doing of a lie, rad: what is known of the biases is not turned with it, as it will not stay.
const ASTRAY: f64 = 0.05;

/// Who does not believe the IMU takes velocity, m/s, and attitude, rad, for random walks, each over the root of a
/// second.
const RESTLESS: f64 = 0.5;
const GIDDY: f64 = 0.1;
/// up to these, 1-sigma, m/s and rad: beyond them nothing is linear.
const FASTEST: f64 = 20.0;
const GIDDIEST: f64 = 0.5;

/// Lets velocity and attitude be what they will over a time, s: what a covariance becomes where the IMU is not
/// believed.
pub fn agitate(p: &mut Covariance, dt: f64) {
    for (block, walk, most) in [(VELOCITY, RESTLESS, FASTEST), (ATTITUDE, GIDDY, GIDDIEST)] {
        if block.covariance(p).diagonal().amax() < most * most {
            block.inflate(p, walk * walk * dt);
        }
    }
}

impl Shadow {
    /// The navigator's own.
    #[must_use]
    pub(super) fn of(covariance: &Covariance) -> Self {
        let apart = Errors::zeros(covariance.layout());
        let mut covariance = covariance.clone();
        covariance.break_trail();
        Shadow { apart, covariance, turned: Vector3::zeros() }
    }

    /// Its estimate, as one that may be.
    pub(super) fn alternative(&self) -> Alternative {
        Alternative { error: self.apart.clone(), covariance: self.covariance.clone() }
    }

    /// Carries it over a stretch.
    pub(super) fn propagate(&mut self, passing: &Passing<'_>) {
        passing.errors(&mut self.apart);
        passing.covariance(&mut self.covariance);
    }

    /// An innovation of the navigator as it is here, with a variance of its noise that is so many times as
    /// large; `None` if it cannot be one.
    #[must_use]
    pub(super) fn weigh(&self, innovation: &Innovation, noise: f64) -> Option<Weighed> {
        let z = &innovation.z - innovation.h.times(&self.apart);
        let (h, r) = (innovation.h.clone(), &innovation.r * noise);
        Innovation { z, h, r }.weigh(&self.covariance)
    }

    /// Absorbs it; `attitude` is the navigator's, from body to ECEF axes.
    pub(super) fn absorb(&mut self, weighed: &Weighed, attitude: &UnitQuaternion<f64>) {
        let error = weighed.update(&mut self.covariance);
        self.apart += &error;
        self.turned += error.of(ATTITUDE);
        if self.apart.of(ATTITUDE).norm() > ASTRAY {
            self.turned = Vector3::zeros();
        } else if self.turned.norm() > TURN {
            let axes = |attitude: UnitQuaternion<f64>| -> Matrix3<f64> {
                attitude.to_rotation_matrix().into_inner()
            };
            let before = UnitQuaternion::new(-self.turned) * attitude;
            turn_biases(&mut self.covariance, &axes(before), &axes(*attitude));
            self.turned = Vector3::zeros();
        }
    }
}
