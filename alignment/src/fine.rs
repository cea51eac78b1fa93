//! Fine alignment: a Kalman filter that knows that the ship lies at her berth, for as long as she
//! does.
//!
//! The same filter then navigates: it is handed over, not copied into another, and nothing steps.

pub mod kept;

use insd_base::{Forecast, ImuSpec, Lack, Message, Received, SeaEstimate, Solution, Time};
use insd_nav::{AidReport, Estimator, Filter, Increment, Outcome, Report};

use crate::config::Method;
use crate::departure::Departure;
use crate::disturbance::Model;
use crate::forecast;
use crate::moorings::Moorings;
use crate::prefiltered::Prefiltered;
use crate::sea_state::SeaTracker;
use crate::white::WhiteNoise;

/// A filter and, while the ship is moored, what holds it.
#[derive(Clone, Debug)]
pub struct Fine {
    filter: Filter,
    hold: Option<Hold>,
    departure: Departure,
    sea: SeaTracker,
    is_berth_named: bool,
    /// Time of the fix that was heard last.
    heard: Option<Time>,
    likelihood: f64,
}

/// The ways of holding a filter at the berth.
#[derive(Clone, Debug)]
enum Hold {
    WhiteNoise(WhiteNoise),
    Prefiltered(Box<Prefiltered>),
    Moorings(Box<Moorings>),
}

impl Fine {
    /// A filter of a ship at her berth, held by a method, or under way.
    #[must_use]
    pub fn held(filter: Filter, moored: Option<Method>) -> Self {
        match moored {
            Some(method) => Fine::moored(filter, method),
            None => Fine::under_way(filter),
        }
    }

    /// A filter of a ship at her berth.
    #[must_use]
    pub fn moored(filter: Filter, method: Method) -> Self {
        let mut filter = filter;
        let hold = match method {
            Method::WhiteNoise => Hold::WhiteNoise(WhiteNoise::new(&filter)),
            Method::Autoregressive => Hold::Prefiltered(Box::new(Prefiltered::new(&filter))),
            Method::Moorings => Hold::Moorings(Box::new(Moorings::new(&mut filter))),
        };
        Fine { hold: Some(hold), ..Fine::under_way(filter) }
    }

    /// A filter of a ship under way.
    #[must_use]
    pub fn under_way(filter: Filter) -> Self {
        let departure = Departure::new(&filter);
        let sea = SeaTracker::new(filter.time());
        Fine {
            filter,
            hold: None,
            departure,
            sea,
            is_berth_named: false,
            heard: None,
            likelihood: 0.0,
        }
    }

    /// The filter.
    #[must_use]
    pub fn filter(&self) -> &Filter {
        &self.filter
    }

    /// The filter, to be joined with others.
    pub fn filter_mut(&mut self) -> &mut Filter {
        &mut self.filter
    }

    /// Whether the ship is taken as lying at her berth.
    #[must_use]
    pub fn is_moored(&self) -> bool {
        self.hold.is_some()
    }

    /// Whether the estimate moves away as a moored ship does not.
    #[must_use]
    pub fn seems_to_leave(&self) -> bool {
        let is_by_estimate = match &self.hold {
            None => return false,
            Some(Hold::Moorings(_)) => self.departure.is_certain(),
            // nothing bounds the position: only speed tells
            Some(_) => self.departure.is_fast(),
        };
        is_by_estimate || self.departure.is_told()
    }

    /// The ship is no longer taken as moored.
    pub fn cast_off(&mut self) {
        self.hold = None;
        if self.departure.is_told() {
            self.filter.doubt_motion(self.departure.missed());
        }
        self.filter.cast_off();
    }

    /// The moorings, where they are what holds the filter.
    #[must_use]
    pub fn moorings(&self) -> Option<&Moorings> {
        match &self.hold {
            Some(Hold::Moorings(moorings)) => Some(moorings),
            _ => None,
        }
    }

    /// The model of the sea that the prefilter found last, where it is what holds the filter.
    #[must_use]
    pub fn sea_model(&self) -> Option<&Model> {
        match &self.hold {
            Some(Hold::Prefiltered(prefiltered)) => prefiltered.model(),
            _ => None,
        }
    }

    /// When the heading of a ship at her berth will have this sigma, rad, if all stays as it is.
    #[must_use]
    pub fn forecast(&self, imu: &ImuSpec, target: f64) -> Forecast {
        match self.moorings() {
            Some(moorings) => {
                let waves = self.sea.motion();
                forecast::at_the_berth(&self.filter, moorings, waves.as_ref(), imu, target)
            }
            None => Forecast::Unknown { lacks: Lack::Method },
        }
    }

    /// The sea, once it has been seen.
    #[must_use]
    pub fn sea(&self) -> Option<SeaEstimate> {
        let motion = self.sea.motion()?;
        Some(SeaEstimate {
            period: motion.period(),
            significant_heave: motion.significant_heave(),
            significant_horizontal: motion.significant_horizontal(),
            waves_std: self.moorings().map(Moorings::waves_std),
            sway_std: self.moorings().map(Moorings::sway_std),
        })
    }

    /// Log-likelihood of what the berth said since the last call.
    pub fn take_likelihood(&mut self) -> f64 {
        std::mem::take(&mut self.likelihood)
    }

    /// While a receiver is left out what it says of her way is heard all the same.
    fn hear_of_way(&mut self, received: &Received) {
        let Message::Gnss(fix) = &received.message else { return };
        let before = self.heard.replace(fix.time);
        let Some(velocity) = fix.velocity.filter(|_| self.filter.docket().leaves_out_gnss()) else {
            return;
        };
        let interval = before.map_or(0.0, |before| (fix.time - before).as_seconds());
        self.departure.hear(&velocity.0.xy(), interval);
    }

    /// Gives the position of a reference to what holds the ship and leaves the rest for the filter.
    ///
    /// The moorings hold her displacement from it. The other methods hold her velocity alone: to them
    /// the berth is where the ship was when it was first named, once; after that her position is what
    /// her velocity makes of it. Were it given to the filter again and again, it would be the
    /// displacement that aligns her, and a bad model of it at that.
    fn take_berth(&mut self, received: &Received, report: &mut Report) -> Received {
        let mut rest = *received;
        let (Some(hold), Message::Reference(reference)) = (&mut self.hold, &mut rest.message)
        else {
            return rest;
        };
        let Some(place) = reference.position.take() else { return rest };
        match hold {
            Hold::Moorings(moorings) => {
                let stated = reference.position_std.filter(|std| (0.01..1e3).contains(std));
                moorings.name_berth(&mut self.filter, &place, stated);
            }
            _ if self.is_berth_named => {}
            _ => {
                self.is_berth_named = true;
                return *received;
            }
        }
        report.aids.push(AidReport {
            time: reference.time,
            source: received.source,
            aid: "reference_position",
            outcome: Outcome::Accepted,
            innovation: [(f64::NAN, f64::NAN); 3],
        });
        rest
    }
}

impl Estimator for Fine {
    fn advance(&mut self, increment: &Increment) {
        self.filter.advance(increment);
        self.sea.watch(&self.filter);
        let Some(hold) = &mut self.hold else { return };
        self.likelihood += match hold {
            Hold::WhiteNoise(white) => white.hold(&mut self.filter),
            Hold::Prefiltered(prefiltered) => prefiltered.hold(&mut self.filter),
            Hold::Moorings(moorings) => moorings.hold(&mut self.filter),
        };
        self.departure.watch(&self.filter);
    }

    fn apply(&mut self, received: &Received) -> Report {
        let mut report = Report::default();
        let rest = self.take_berth(received, &mut report);
        self.hear_of_way(received);
        let mut said = self.filter.apply(&rest);
        said.aids.splice(0..0, report.aids);
        said
    }

    fn solution(&self) -> Solution {
        self.filter.solution()
    }

    fn solution_at(&self, increment: &Increment, at: Time) -> Solution {
        self.filter.solution_at(increment, at)
    }
}
