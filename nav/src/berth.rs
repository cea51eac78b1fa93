//! The ship at her berth: what holds a filter that navigates while she lies there, and what tells that she
//! has left. It comes with the [`crate::InitialState`] and goes when she does.

use insd_base::{ExternalReference, Span, Time};
use serde::{Deserialize, Serialize};

use crate::disturbance::Model;
use crate::error_state::Innovation;
use crate::filter::Filter;
pub use crate::method::Method;
pub use departure::Departure;
pub use moorings::{MooredSea, Moorings};
pub use prefiltered::Prefiltered;
pub use white_noise::WhiteNoise;
pub use whitened::{Whitened, WhitenedSea};

mod departure;
mod hindsight;
mod moorings;
mod prefiltered;
mod seen;
mod shifts;
mod white_noise;
mod whitened;

/// How far her mean place may be from the named berth, as share of her stated displacement.
const OFFSET_SHARE: f64 = 0.15;
/// Displacement before anyone states it, 1-sigma of each component, m.
pub const UNSTATED: f64 = 0.7;
/// The same of a berth that is only known as the place of the start, m.
const UNSURVEYED: f64 = 10.0;

/// What holds a filter at the berth, by one of the methods.
#[derive(Clone, Debug)]
pub(crate) enum Hold {
    WhiteNoise(WhiteNoise),
    Prefiltered(Box<Prefiltered>),
    Whitened(Box<Whitened>),
    Moorings(Box<Moorings>),
}

/// The sea as a ship at her berth has learnt it, by the method that holds her.
#[derive(Clone, Debug)]
pub enum LearntSea {
    /// White noise of her velocity, variance of a component, (m/s)^2.
    WhiteNoise(f64),
    /// An autoregression of her displacement.
    Whitened(WhitenedSea),
    /// Swaying and waves.
    Moorings(MooredSea),
}

/// What the berth says next, if nothing moves: for looking ahead.
#[derive(Clone, Debug)]
pub struct BerthSample {
    /// The sample, with the noise of one.
    pub innovation: Innovation,
    /// From one to the next, s.
    pub spacing: f64,
    /// Since when the ship is held so.
    pub start: Time,
}

/// What is worth keeping of it: the moorings go on; the other methods begin with a new window, as theirs has a gap
/// in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum HoldCheckpoint {
    WhiteNoise,
    Prefiltered,
    Whitened,
    Moorings(Box<Moorings>),
}

impl Hold {
    /// Takes the ship of a filter as lying where it has her.
    pub(crate) fn new(method: Method, filter: &mut Filter) -> Self {
        match method {
            Method::WhiteNoise => Hold::WhiteNoise(WhiteNoise::new(filter)),
            Method::AsPublished => Hold::Prefiltered(Box::new(Prefiltered::new(filter))),
            Method::Autoregressive => Hold::Whitened(Box::new(Whitened::new(filter))),
            Method::Moorings => Hold::Moorings(Box::new(Moorings::new(filter))),
        }
    }

    /// Holds the filter if it is time to; returns the log-likelihood.
    pub(crate) fn hold(&mut self, filter: &mut Filter) -> f64 {
        match self {
            Hold::WhiteNoise(white) => white.hold(filter),
            Hold::Prefiltered(prefiltered) => prefiltered.hold(filter),
            Hold::Whitened(whitened) => whitened.hold(filter),
            Hold::Moorings(moorings) => moorings.hold(filter),
        }
    }

    /// The sea as it was learnt; the prefilter's is that of a window that is its own.
    pub(crate) fn learnt(&self) -> Option<LearntSea> {
        match self {
            Hold::WhiteNoise(white) => Some(LearntSea::WhiteNoise(white.learnt())),
            Hold::Prefiltered(_) => None,
            Hold::Whitened(whitened) => Some(LearntSea::Whitened(whitened.learnt())),
            Hold::Moorings(moorings) => Some(LearntSea::Moorings(moorings.learnt())),
        }
    }

    /// From now on the sea is what another has learnt by the same method; nothing for her own.
    pub(crate) fn lend(&mut self, filter: &mut Filter, sea: Option<&LearntSea>) {
        match (self, sea) {
            (Hold::WhiteNoise(white), Some(LearntSea::WhiteNoise(sea))) => white.lend(Some(*sea)),
            (Hold::Whitened(own), Some(LearntSea::Whitened(sea))) => own.lend(Some(sea.clone())),
            (Hold::Moorings(own), Some(LearntSea::Moorings(sea))) => own.lend(filter, Some(*sea)),
            (Hold::WhiteNoise(white), _) => white.lend(None),
            (Hold::Whitened(own), _) => own.lend(None),
            (Hold::Moorings(own), _) => own.lend(filter, None),
            (Hold::Prefiltered(_), _) => {}
        }
    }

    pub(crate) fn method(&self) -> Method {
        match self {
            Hold::WhiteNoise(_) => Method::WhiteNoise,
            Hold::Prefiltered(_) => Method::AsPublished,
            Hold::Whitened(_) => Method::Autoregressive,
            Hold::Moorings(_) => Method::Moorings,
        }
    }

    pub(crate) fn moorings(&self) -> Option<&Moorings> {
        match self {
            Hold::Moorings(moorings) => Some(moorings),
            _ => None,
        }
    }

    /// What the berth says next, where her displacement is held; the covariance of the filter must be settled.
    pub(crate) fn sample(&self, filter: &Filter) -> Option<BerthSample> {
        match self {
            Hold::Moorings(moorings) => Some(moorings.sample(filter)),
            Hold::Whitened(whitened) => whitened.sample(filter),
            Hold::WhiteNoise(_) | Hold::Prefiltered(_) => None,
        }
    }

    /// What of her displacement is taken for white, and what for swaying, 1-sigma of a component, m, where it is held.
    pub(crate) fn sea_std(&self) -> Option<(f64, f64)> {
        match self {
            Hold::Moorings(moorings) => Some((moorings.waves_std(), moorings.sway_std())),
            Hold::Whitened(whitened) => whitened.sea_std(),
            Hold::WhiteNoise(_) | Hold::Prefiltered(_) => None,
        }
    }

    /// How often her mean place was found to have shifted.
    pub(crate) fn shifts(&self) -> u32 {
        match self {
            Hold::Moorings(moorings) => moorings.shifts(),
            Hold::Whitened(whitened) => whitened.shifts(),
            Hold::WhiteNoise(_) | Hold::Prefiltered(_) => 0,
        }
    }

    /// The model of the sea that the prefilter found last.
    pub(crate) fn sea_model(&self) -> Option<&Model> {
        match self {
            Hold::Prefiltered(prefiltered) => prefiltered.model(),
            _ => None,
        }
    }

    /// Whether a filter that is held so moves away as a moored ship does not.
    pub(crate) fn lets_go(&self, departure: &Departure) -> bool {
        match self {
            Hold::Moorings(_) | Hold::Whitened(_) => departure.is_certain(),
            // nothing bounds the position: only speed tells
            _ => departure.is_fast(),
        }
    }

    /// Takes the place of the berth out of a reference, if it is what holds the ship that is told by it; whether it was.
    ///
    /// The moorings hold her displacement from it. The other methods hold her velocity alone: to them
    /// the berth is where the ship was when it was first named, once; after that her position is what
    /// her velocity makes of it. Were it given to the filter again and again, it would be the
    /// displacement that aligns her, and a bad model of it at that.
    pub(crate) fn take_place(
        &mut self,
        filter: &mut Filter,
        reference: &mut ExternalReference,
        is_first: bool,
    ) -> bool {
        let stated = reference.position_std.filter(|std| (0.01..1e3).contains(std));
        match (self, reference.position) {
            (_, None) => return false,
            (Hold::Moorings(moorings), Some(place)) => {
                moorings.name_berth(filter, &place, stated);
            }
            (Hold::Whitened(whitened), Some(place)) => {
                whitened.name_berth(filter, &place, stated);
            }
            _ if is_first => return false,
            _ => {}
        }
        reference.position = None;
        true
    }

    pub(crate) fn kept(&self) -> HoldCheckpoint {
        match self {
            Hold::WhiteNoise(_) => HoldCheckpoint::WhiteNoise,
            Hold::Prefiltered(_) => HoldCheckpoint::Prefiltered,
            Hold::Whitened(_) => HoldCheckpoint::Whitened,
            Hold::Moorings(moorings) => HoldCheckpoint::Moorings(moorings.clone()),
        }
    }

    /// Goes on from what was kept, on a time line that is later by a span.
    pub(crate) fn taken_up(kept: &HoldCheckpoint, filter: &mut Filter, by: Span) -> Self {
        match kept {
            HoldCheckpoint::WhiteNoise => Hold::new(Method::WhiteNoise, filter),
            HoldCheckpoint::Prefiltered => Hold::new(Method::AsPublished, filter),
            HoldCheckpoint::Whitened => Hold::new(Method::Autoregressive, filter),
            HoldCheckpoint::Moorings(moorings) => {
                Hold::Moorings(Box::new(moorings.as_ref().clone().shifted(by)))
            }
        }
    }
}
