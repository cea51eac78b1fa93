//! Satellites of navigation, what a receiver measures of each signal, and what they broadcast of themselves.

mod base;
mod broadcast;
mod compass;
mod epoch;
mod line;
mod ranges;
mod refusal;
mod rtk;
mod signal;
mod sky;

pub use base::BaseEpoch;
pub use broadcast::{
    BroadcastKind, BroadcastRecord, ClockPolynomial, GlonassRecord, IonosphereModel, KeplerOrbit,
    KeplerRecord,
};
pub use compass::{
    AntennaPhase, AntennaSignal, CompassFault, CompassPhases, CompassReading, CompassRefusal,
};
pub use epoch::{SatelliteEpoch, SignalObservation};
pub use line::LineBias;
pub use ranges::{
    AntennaDisplacement, ArcPhase, HeardSatellite, Measured, SatelliteRange, SatelliteRanges,
    Transmitter, time_keeper,
};
pub use refusal::{OrbitRefusal, RangeRefusal};
pub use rtk::{RtkEpoch, RtkPlace, RtkSilence, RtkTurn};
pub use signal::{Constellation, SPEED_OF_LIGHT, SatelliteId, SignalCode};
pub use sky::{LookAngles, SatelliteUse, SignalStrength, Sky, SkySatellite};
