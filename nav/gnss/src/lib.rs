//! Satellites of navigation: where they are, what lies between, and what follows for a receiver.
//!
//! Pure, and without a filter: an epoch of a receiver and what satellites broadcast go in; ranges as they should be, positions, velocities and
//! displacements with their covariances come out, and of several antennas how they stand. ECEF axes, metres, seconds, radians; e points from the antenna to the satellite.

mod array;
pub mod atmosphere;
mod band_code;
mod budget;
mod carrier;
mod compass;
mod context;
mod ephemerides;
mod integers;
mod least_squares;
pub mod orbit;
mod phase_rates;
mod ranging;
mod rtk;
mod sight;
mod signals;
mod single_point;
mod turns;
mod velocity;

pub use array::{ArrayRanged, ArrayRanging, CompassTold};
pub use carrier::{CarrierDisplacement, CarrierTracker, PhaseChange};
pub use compass::{
    AttitudePrior, CompassArray, CompassEpoch, CompassFix, CompassInteger, CompassObjection,
    CompassPose, CompassPrior, CompassRejection, CompassResidual, CompassSettings, CompassShape,
    CompassTracker, LineBiases, TOGETHER,
};
pub use context::{Context, Delays};
pub use ephemerides::{Ephemerides, OrbitRefusal};
pub use integers::{IntegerRefusal, IntegerSearch, IntegerVector};
pub use orbit::SatelliteState;
pub use phase_rates::PhaseRates;
pub use ranging::{Guess, Ranged, Ranging};
pub use rtk::{
    DifferencedRows, DoubleDifferences, PairAmbiguity, PlacedEpoch, RoverPrior, RtkFix, RtkLink,
    RtkRefusal, RtkSettings, RtkSolution, RtkTracker, RtkWithdrawal, SignalPair,
};
pub use sight::Sight;
pub use signals::{Noise, best_of_each_band, dispersion, first_band, group_delay, inflation};
pub use single_point::{NoPosition, SinglePoint, Verdict, Witness};
pub use turns::Turns;
pub use velocity::DopplerVelocity;

#[cfg(test)]
mod tests;
