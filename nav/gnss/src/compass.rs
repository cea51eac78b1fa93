//! A compass of antennas: how a hull stands, or one antenna against another, by differences of carrier phase between antennas a few wavelengths apart.
//!
//! Equations: gnss.md, section 8, eq. 14; Teunissen and Montenbruck (ed.), "Springer Handbook of Global Navigation Satellite Systems",
//! 2017, chapter 27. What each step rests on and what it does with real receivers: docs/compass.md.
//!
//! **Line biases** are states of this core, as integers cannot be told without them: a phase is known only up to whole wavelengths *and* its line. They are learnt with an
//! attitude that is free in each epoch, so that nothing of a navigator goes into them or into the fix, and both may be used as measurements. A filter
//! that knows its attitude from epoch to epoch tells lines and attitude apart much sooner: it takes the
//! [signals](CompassFix::signals), whose integers are resolved, and carries line biases of its own.

mod align;
mod faults;
mod fit;
mod hypotheses;
mod level;
mod lines;
mod model;
mod observe;
mod outcome;
mod pose;
mod prior;
mod search;
mod settings;
mod signal;
mod solve;
mod told;
mod tracker;

pub use lines::LineBiases;
pub use observe::TOGETHER;
pub use outcome::{
    CompassEpoch, CompassFix, CompassInteger, CompassObjection, CompassRejection, CompassResidual,
};
pub use pose::CompassPose;
pub use prior::{AttitudePrior, CompassPrior};
pub use settings::{CompassArray, CompassSettings, CompassShape};
pub use tracker::CompassTracker;
