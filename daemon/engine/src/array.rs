//! Antennas that are a compass, as they are heard.

use std::sync::Arc;

use insd_base::satellites::CompassReading;
use insd_base::{Message, Received};
use nalgebra::Matrix3;

use crate::Engine;

impl Engine {
    /// Takes note of what antennas tell.
    pub(crate) fn hear_antennas(&mut self, reading: &CompassReading) {
        if let Some(news) = self.antennas.hear(reading) {
            self.tell(news);
        }
    }

    /// What antennas tell as well as it is known how they sit; `None` of another message.
    pub(crate) fn as_well_as_they_sit(&self, received: &Received) -> Option<Received> {
        let Message::Compass(reading) = &received.message else { return None };
        let mut reading = Arc::clone(reading);
        if let Ok(told) = &mut Arc::make_mut(&mut reading).told {
            let std = self.nav.antennas.axes_std;
            told.covariance += Matrix3::from_diagonal(&std.component_mul(&std));
        }
        Some(Received { message: Message::Compass(reading), ..*received })
    }
}
