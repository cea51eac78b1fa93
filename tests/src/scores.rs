//! Errors of a passage, and bounds that follow from the statistics of honest claims.

use std::ops::RangeInclusive;

use insd_base::{Geodetic, Solution, Time, Truth, earth};
use insd_lab::evaluation::{self, Component, EpochError, Summary};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Errors at the epochs of a stretch of a passage.
#[derive(Clone, Debug, Default)]
pub struct Scores {
    /// In order of time.
    pub epochs: Vec<EpochError>,
}

impl Scores {
    /// Errors of solutions from one instant to another, s.
    #[must_use]
    pub fn new(solutions: &[Solution], truth: &[Truth], from: f64, to: f64) -> Self {
        let mut epochs =
            evaluation::errors(solutions, truth, Some(Time::from_seconds(from))).epochs;
        epochs.retain(|epoch| epoch.time.as_seconds() <= to);
        Scores { epochs }
    }

    /// Figures of one component.
    #[must_use]
    pub fn of(&self, component: Component) -> Summary {
        evaluation::summarise(&self.epochs, component).unwrap()
    }

    /// Figures of the horizontal position.
    #[must_use]
    pub fn horizontal(&self) -> Summary {
        evaluation::summarise_horizontal(&self.epochs).unwrap()
    }

    /// The last epoch.
    #[must_use]
    pub fn last(&self) -> &EpochError {
        self.epochs.last().unwrap()
    }
}

/// Puts the epochs of several passages together.
#[must_use]
pub fn pooled(scores: &[Scores]) -> Scores {
    Scores { epochs: scores.iter().flat_map(|score| score.epochs.iter().copied()).collect() }
}

/// Range in which the mean of normalised squared errors lies but once in 10^5 on either side, if the
/// claims are honest and there are so many independent values.
///
/// The mean over a whole passage of an error that hardly changes counts as one value; if it does
/// change, its mean varies less and the range is only too wide. Bar-Shalom, Li and Kirubarajan,
/// Estimation with Applications to Tracking and Navigation, section 5.4.2.
#[must_use]
pub fn honest_nees(independent: usize) -> RangeInclusive<f64> {
    const TAIL: f64 = 1e-5;
    let freedom = independent as f64;
    let chi_squared = ChiSquared::new(freedom).unwrap();
    chi_squared.inverse_cdf(TAIL) / freedom..=chi_squared.inverse_cdf(1.0 - TAIL) / freedom
}

/// Complaints about components whose mean NEES over all passages says that claims are not honest.
#[must_use]
pub fn dishonest(passages: &[Scores], components: &[Component]) -> Vec<String> {
    let range = honest_nees(passages.len());
    let of = |component: Component| {
        evaluation::mean(passages.iter().map(|scores| scores.of(component).nees))
    };
    let means = components.iter().map(|component| (component.name(), of(*component)));
    means
        .filter(|(_, nees)| !range.contains(nees))
        .map(|(name, nees)| format!("{name}: NEES {nees:.2}, not within {range:.2?}"))
        .collect()
}

/// How far a place is horizontally from where the IMU truly was at an instant, m; `None` if that is not within the truth.
#[must_use]
pub fn horizontal_error(truth: &[Truth], time: Time, place: &Geodetic) -> Option<f64> {
    let after = truth.partition_point(|truth| truth.time < time);
    let [a, b] = truth.get(after.checked_sub(1)?..=after)? else { return None };
    let share = (time - a.time).as_seconds() / (b.time - a.time).as_seconds();
    let [a, b] = [a, b].map(|truth| earth::ecef(&truth.position).0);
    let apart = earth::ecef(place).0 - (a + (b - a) * share);
    Some((earth::c_ne(place) * apart).xy().norm())
}
