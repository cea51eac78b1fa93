//! What repeats of the errors of a log and of an IMU, and how the current goes on: learnt while the ship is well aided, proven on
//! outages that did not happen, and used only while it is better than nothing.
//!
//! Pure. A [`Learner`] takes [`Label`]s, each the mean of half a minute, and says how it [`Standing`] is. It knows no filter: what
//! is done with it is the engine's matter.

pub mod current;
pub mod kept;
pub mod label;
pub mod learner;
pub mod model;
pub mod shadow;
pub mod trained;
mod words;

pub use current::CurrentModel;
pub use kept::{KeptFault, KeptLog, KeptModel, KeptThermal, KeptTriad};
pub use label::{Collector, Label, LabelLook};
pub use learner::{Learner, LearnerStanding, LearnerVerdict};
pub use model::LogErrors;
pub use shadow::ShadowScore;
pub use trained::Trained;
pub use words::words;
