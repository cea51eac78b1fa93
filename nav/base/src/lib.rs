//! The vocabulary that every crate of insd shares.
//!
//! Pure: no I/O, no clock, no thread, no randomness. SI units and radians inside; degrees, knots
//! and the like appear only where a name says so. Axes: `n` = north, east, down (NED); `b` =
//! forward, starboard, down of the hull (FRD); `e` = Earth-centred, Earth-fixed (ECEF, WGS-84);
//! `c_eb` rotates a vector from `b` to `e`.

/// Its example is held by the compiler.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod alignment;
pub mod attitude;
pub mod camera;
pub mod can;
pub mod earth;
pub mod estimates;
pub mod events;
pub mod frames;
pub mod geoid;
pub mod gnss;
pub mod heave;
pub mod input;
pub mod installation;
mod learnt;
pub mod messages;
pub mod motion;
pub mod party;
pub mod protection;
pub mod ranging;
pub mod requirement;
pub mod satellites;
pub mod sea_fit;
pub mod sensor;
pub mod solution;
mod source_reason;
mod stored_doubt;
pub mod time;
pub mod units;
pub mod utc;
pub mod utm;
pub mod vessel;
pub mod voyage;

pub use alignment::{
    AlignmentPhase, AlignmentStatus, AttitudeSigma, Forecast, Lack, Limiting, SeaEstimate,
};
pub use attitude::Attitude;
pub use camera::{CameraFrame, CameraModel, CameraSight, CameraTurn, ImagePoint, VisualOdometry};
pub use can::{BusEvent, CanFrame, CanId};
pub use estimates::{Disturbance, Estimate, Estimates, SeaQuantity};
pub use events::{
    AidInnovation, Counts, Event, ModeReason, Rejection, ResumeDoubt, SatelliteInnovation,
};
pub use frames::{Body, Ecef, Geodetic, Ned};
pub use gnss::{FixQuality, GnssFix};
pub use heave::{DelayedHeave, Heave, HeaveQuality};
pub use input::{
    AlertOrder, Arrival, Closed, Input, Order, PortId, PortState, Pulse, Sent, Stamp, StorageFaults,
};
pub use installation::{Axes, Finding, Frozen};
pub use learnt::LearntTurn;
pub use messages::{
    ExternalReference, ImuSample, LogReference, LogVelocity, Message, Received, Source,
};
pub use motion::{Current, Motion, MotionCovariance};
pub use party::{Fault, Integrity, Judgement, Parties, Party, ReceiverChange, Standing, Stands};
pub use protection::Availability;
pub use ranging::{RangingBeam, RangingLine, RangingReading, RangingTarget, RangingTurn};
pub use requirement::Requirement;
pub use satellites::{
    BaseEpoch, BroadcastRecord, Constellation, IonosphereModel, RtkEpoch, RtkPlace, RtkSilence,
    RtkTurn, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation,
};
pub use sea_fit::{Residual, SeaFit, SeenResidual};
pub use sensor::{ImuSpec, LeverArms, Triad};
pub use solution::{Mode, Protection, Solution, SolutionSigma, SolutionSource};
pub use source_reason::SourceReason;
pub use stored_doubt::StoredDoubt;
pub use time::{Span, Time};
pub use utc::{GpsTime, UtcTime};
pub use utm::Utm;
pub use vessel::{Sideways, VesselKind};
pub use voyage::{Stamped, StartCondition, Truth, Voyage, VoyageHeader};
