//! A camera as the navigator has it.

use insd_base::CameraSight;

use crate::Engine;
use crate::ship::Ship;

impl Engine {
    /// The camera; `None` while the navigator uses none of its images.
    #[must_use]
    pub fn camera(&self) -> Option<CameraSight> {
        self.ship().and_then(Ship::likeliest)?.filter().camera_sight()
    }
}
