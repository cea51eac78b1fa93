//! The navigator: a filter with what holds it while the ship lies at her berth, and what it sees of the sea.
//!
//! Alignment searches with navigators and hands over the last one; nothing steps, and nothing of alignment goes
//! along. When the ship leaves her berth a navigator is its filter.

pub mod checkpoint;

use insd_base::{Message, Received, SeaEstimate, SeaFit, Solution, Time};

use crate::berth::{BerthSample, Departure, Hold, LearntSea, Method, Moorings, SeaSight};
use crate::config::NavConfig;
use crate::filter::Filter;
use crate::increments::Increment;
use crate::initial::InitialState;
use crate::report::{AidReport, Outcome, Report};
use crate::sea_state::{SeaTracker, WaveMotion};
use crate::timeline::Estimator;

/// A filter and, while the ship is moored, what holds it.
#[derive(Clone, Debug)]
pub struct Navigator {
    filter: Filter,
    hold: Option<Hold>,
    departure: Departure,
    sea: SeaTracker,
    is_berth_named: bool,
    /// Time of the fix that was heard last.
    heard: Option<Time>,
    likelihood: f64,
}

impl Navigator {
    /// A navigator from an initial state.
    #[must_use]
    pub fn new(config: &NavConfig, initial: &InitialState) -> Self {
        Navigator::of(Filter::new(config, initial), initial.berth)
    }

    /// A navigator with a filter, of a ship that lies at her berth, held by a method, or is under way.
    #[must_use]
    pub fn of(mut filter: Filter, berth: Option<Method>) -> Self {
        let hold = berth.map(|method| Hold::new(method, &mut filter));
        Navigator {
            departure: Departure::new(&filter),
            sea: SeaTracker::new(filter.time()),
            filter,
            hold,
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

    /// The filter, to be told what the vessel knows from elsewhere.
    pub fn filter_mut(&mut self) -> &mut Filter {
        &mut self.filter
    }

    /// Ends the search for the heading ([`Filter::begin_navigation`]).
    pub fn begin_navigation(&mut self) {
        self.filter.begin_navigation();
    }

    /// Until then propagates the covariance only every so many seconds ([`Filter::slow_down`]).
    pub fn slow_down(&mut self, interval: f64) {
        self.filter.slow_down(interval);
    }

    /// Joins another of the same instant, whose weight is `share`, 0..1 ([`Filter::join`]).
    pub fn join(&mut self, mut other: Navigator, share: f64) {
        self.filter.settle();
        other.filter.settle();
        self.filter.join(&other.filter, share);
    }

    /// How the ship is held at her berth, if she is taken as lying there.
    #[must_use]
    pub fn berth(&self) -> Option<Method> {
        self.hold.as_ref().map(Hold::method)
    }

    /// Whether the ship is taken as lying at her berth.
    #[must_use]
    pub fn is_moored(&self) -> bool {
        self.hold.is_some()
    }

    /// Whether the estimate moves away as a moored ship does not.
    #[must_use]
    pub fn seems_to_leave(&self) -> bool {
        let Some(hold) = &self.hold else { return false };
        hold.lets_go(&self.departure) || self.departure.is_told()
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
        self.hold.as_ref().and_then(Hold::moorings)
    }

    /// What the berth says next, where her displacement is held; the covariance of the filter must be settled.
    #[must_use]
    pub fn berth_sample(&self) -> Option<BerthSample> {
        self.hold.as_ref()?.sample(&self.filter)
    }

    /// The sea as a model has it, where one holds the filter at the berth.
    #[must_use]
    pub fn sea_sight(&self) -> Option<SeaSight> {
        self.hold.as_ref()?.sea_sight()
    }

    /// How well the model of the sea fits that holds the filter at the berth.
    #[must_use]
    pub fn sea_fit(&self) -> Option<SeaFit> {
        self.hold.as_ref()?.sea_fit()
    }

    /// The sea as a ship at her berth has learnt it.
    #[must_use]
    pub fn learnt_sea(&self) -> Option<LearntSea> {
        self.hold.as_ref().and_then(Hold::learnt)
    }

    /// From now on the sea at the berth is what another has learnt; nothing for what this one learns itself.
    pub fn lend_sea(&mut self, sea: Option<&LearntSea>) {
        if let Some(hold) = &mut self.hold {
            hold.lend(&mut self.filter, sea);
        }
    }

    /// How she moves in the waves, once that has been seen.
    #[must_use]
    pub fn waves(&self) -> Option<WaveMotion> {
        self.sea.motion()
    }

    /// The sea, once it has been seen.
    #[must_use]
    pub fn sea(&self) -> Option<SeaEstimate> {
        let motion = self.waves()?;
        Some(SeaEstimate {
            period: motion.period(),
            significant_heave: motion.significant_heave(),
            significant_horizontal: motion.significant_horizontal(),
            waves_std: self.moorings().map(Moorings::waves_std),
            sway_std: self.sea_std().map(|(_, sway)| sway),
        })
    }

    /// What of a moored ship's displacement is taken for white, and what for swaying, 1-sigma of a component, m, where she
    /// is held by it.
    #[must_use]
    pub fn sea_std(&self) -> Option<(f64, f64)> {
        self.hold.as_ref()?.sea_std()
    }

    /// How often her mean place at the berth was found to have shifted.
    #[must_use]
    pub fn shifts(&self) -> u32 {
        self.hold.as_ref().map_or(0, Hold::shifts)
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
    fn take_berth(&mut self, received: &Received, report: &mut Report) -> Received {
        let mut rest = received.clone();
        let (Some(hold), Message::Reference(reference)) = (&mut self.hold, &mut rest.message)
        else {
            return rest;
        };
        if reference.position.is_none() {
            return rest;
        }
        let is_first = !std::mem::replace(&mut self.is_berth_named, true);
        if hold.take_place(&mut self.filter, reference, is_first) {
            report.aids.push(AidReport {
                time: reference.time,
                source: received.source,
                aid: "reference_position",
                outcome: Outcome::Accepted,
                innovation: [(f64::NAN, f64::NAN); 3],
            });
        }
        rest
    }
}

impl Estimator for Navigator {
    fn advance(&mut self, increment: &Increment) {
        self.filter.advance(increment);
        self.sea.watch(&self.filter);
        let Some(hold) = &mut self.hold else { return };
        self.likelihood += hold.hold(&mut self.filter);
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
