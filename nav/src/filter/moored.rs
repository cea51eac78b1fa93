//! The filter of a ship that is taken as lying at her berth.

use nalgebra::{Matrix2, Vector2};

use super::Filter;
use crate::declaration::Carried;
use crate::error_state::{ATTITUDE, BERTH_OFFSET, POSITION, VELOCITY};
use crate::sway::Sway;

impl Filter {
    /// Takes the ship as lying at a berth about which she sways; how far her mean place is from it is
    /// known to `offset_std` of each component, m.
    pub fn moor(&mut self, sway: Sway, offset_std: f64) {
        self.settle_sway();
        sway.begin(&mut self.state.nominal, &mut self.state.covariance);
        self.state.sway = Some(sway);
        self.lie(offset_std);
    }

    /// Takes the ship as lying at a berth; how far her mean place is from it is known to `offset_std` of each component, m.
    pub fn lie(&mut self, offset_std: f64) {
        self.settle_sway();
        self.state.nominal.berth_offset = Vector2::zeros();
        let offset = Matrix2::from_diagonal_element(offset_std * offset_std);
        BERTH_OFFSET.renew(&mut self.state.covariance, &offset);
        self.be_judged();
    }

    /// By how much the named berth may be off beyond what is said of it, 1-sigma of each component, m.
    #[must_use]
    pub fn berth_doubt(&self) -> f64 {
        self.config.berth_doubt()
    }

    /// How the ship sways, as far as she is taken as moored.
    #[must_use]
    pub fn sway(&self) -> Option<&Sway> {
        self.state.sway.as_ref()
    }

    /// Changes what is assumed of the swaying from now on.
    pub fn set_sway(&mut self, sway: Sway) {
        self.settle_sway();
        self.state.sway = Some(sway);
    }

    /// Admits that the ship's mean place at the berth has shifted by as much as this, 1-sigma of each
    /// component, m.
    pub fn loosen_berth(&mut self, std: f64) {
        BERTH_OFFSET.inflate(&mut self.state.covariance, std * std);
    }

    /// Admits that position, m, velocity, m/s, and attitude, rad, are off by as much as this, 1-sigma of each component.
    pub fn doubt_motion(&mut self, [position, velocity, attitude]: [f64; 3]) {
        self.settle_sway();
        let each = [(POSITION, position), (VELOCITY, velocity), (ATTITUDE, attitude)];
        each.iter().for_each(|(block, std)| block.inflate(&mut self.state.covariance, std * std));
    }

    /// Carries the swaying up to the time of the estimate. Nothing but the berth depends on it, so it
    /// waits until the berth is looked at.
    pub fn settle_sway(&mut self) {
        self.settle();
        self.state.settle_sway();
    }

    /// The ship is no longer taken as moored.
    pub fn cast_off(&mut self) {
        self.settle();
        self.state.sway = None;
        self.end_to_carry(Carried::AtBerth);
        self.be_judged();
    }
}
