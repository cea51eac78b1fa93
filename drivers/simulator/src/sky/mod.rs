//! Raw GNSS: satellites, the air below them, receivers, and what goes wrong.
//!
//! The satellites keep to Keplerian elements, which they broadcast ([`constellation`], [`records`]); where they truly are, and what their clocks
//! truly show, is smoothly beside that ([`satellite`]). Their signals come through air that no model knows ([`atmosphere`], [`path`]), past
//! obstructions ([`scene`]), into receivers with clocks, lines and phase arcs of their own ([`clock`], [`channel`], [`receiver`]). Of a ray
//! is computed: light time, turn of the Earth, clocks with their relativistic part, ionosphere, troposphere. The bending of light by the
//! Earth's mass (below 2 cm), tides, antenna patterns and the winding of the phase are not there.

mod atmosphere;
mod channel;
mod clock;
mod constellation;
mod faults;
mod installation;
mod kepler;
mod output;
mod path;
mod receiver;
mod records;
mod satellite;
mod scene;
mod signals;
mod truth;
mod view;
mod voyage;
mod wander;

pub use output::{RawBaseStation, RawGnss, RawSpec};
pub use truth::{
    InjectedAntennaFault, InjectedFault, InjectedSlip, InjectedSpoof, JudgedSegment, RawTruth,
};
pub(crate) use view::{Seen, SkyView};
pub(crate) use voyage::raw_gnss;

#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
