//! The ship at her berth: what holds a filter that navigates while she lies there, and what tells that she
//! has left. It comes with the [`crate::InitialState`] and goes when she does.

use insd_base::{ExternalReference, SeaFit, Span};
use serde::{Deserialize, Serialize};

use crate::filter::Filter;
pub use crate::method::Method;
pub use departure::Departure;
pub use learner::WhitenedSea;
pub use moorings::{MooredSea, Moorings};
pub use prefiltered::Prefiltered;
pub use sight::{BerthSample, SeaSight};
pub use stated::UNSTATED;
pub use white_noise::WhiteNoise;
pub use whitened::Whitened;
use whitened::WhitenedCheckpoint;

mod departure;
mod hindsight;
mod learner;
mod moorings;
mod prefiltered;
mod seen;
mod shifts;
mod sight;
mod stated;
mod white_noise;
mod whitened;

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

/// What is worth keeping of it: what was learnt of the sea where it outlasts a gap; the others begin with a new window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum HoldCheckpoint {
    WhiteNoise,
    Prefiltered,
    Whitened(Box<WhitenedCheckpoint>),
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

    /// The sea as a model has it that holds her.
    pub(crate) fn sea_sight(&self) -> Option<SeaSight> {
        match self {
            Hold::Prefiltered(prefiltered) => prefiltered.sight(),
            Hold::Whitened(whitened) => whitened.sight(),
            Hold::WhiteNoise(_) | Hold::Moorings(_) => None,
        }
    }

    /// How well the model fits of the sea that holds her.
    pub(crate) fn sea_fit(&self) -> Option<SeaFit> {
        match self {
            Hold::Whitened(whitened) => whitened.fit(),
            Hold::WhiteNoise(_) | Hold::Prefiltered(_) | Hold::Moorings(_) => None,
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
            Hold::Whitened(whitened) => HoldCheckpoint::Whitened(Box::new(whitened.kept())),
            Hold::Moorings(moorings) => HoldCheckpoint::Moorings(moorings.clone()),
        }
    }

    /// Goes on from what was kept, on a time line that is later by a span.
    pub(crate) fn taken_up(kept: &HoldCheckpoint, filter: &mut Filter, by: Span) -> Self {
        match kept {
            HoldCheckpoint::WhiteNoise => Hold::new(Method::WhiteNoise, filter),
            HoldCheckpoint::Prefiltered => Hold::new(Method::AsPublished, filter),
            HoldCheckpoint::Whitened(kept) => Whitened::taken_up(kept, filter, by).map_or_else(
                || Hold::new(Method::Autoregressive, filter),
                |whitened| Hold::Whitened(Box::new(whitened)),
            ),
            HoldCheckpoint::Moorings(moorings) => {
                Hold::Moorings(Box::new(moorings.as_ref().clone().shifted(by)))
            }
        }
    }
}
