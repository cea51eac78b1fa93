//! Which berth is told of: the one that somebody chose, else the nearest.

use insd_base::{Geodetic, Motion, Span, Time};

use super::approach::{self, REACH};
use super::config::{DockingConfig, DockingLimits};
use super::quay::QuayAxes;
use super::types::{BerthChoice, Docking, DockingPoint, DockingState, NotDocking};

/// Another berth is proposed where it is nearer than so much of the one before.
const NEARER: f64 = 0.8;
/// A motion that is older is not the present.
const OLD: Span = Span::from_nanos(500_000_000);
/// A part that comes nearer more slowly than this lies still, m/s: she ranges at her lines.
const RANGING: f64 = 0.03;

/// Keeps which berth is told of.
#[derive(Clone, Debug, Default)]
pub struct BerthDesk {
    config: DockingConfig,
    axes: Vec<QuayAxes>,
    chosen: Option<usize>,
    nearest: Option<usize>,
}

impl BerthDesk {
    /// A desk that knows these berths; the one chosen at the start is chosen.
    #[must_use]
    pub fn new(config: DockingConfig) -> Self {
        let axes = config.berths.iter().map(QuayAxes::of).collect();
        let mut desk = BerthDesk { config, axes, chosen: None, nearest: None };
        if let Some(name) = desk.config.chosen.clone() {
            desk.choose(Some(&name));
        }
        desk
    }

    /// What it was told.
    #[must_use]
    pub fn config(&self) -> &DockingConfig {
        &self.config
    }

    /// Chooses the berth of a name, or again the nearest; whether there is such a berth.
    pub fn choose(&mut self, name: Option<&str>) -> bool {
        let found = name.map(|name| self.config.berths.iter().position(|own| own.name == name));
        match found {
            Some(None) => false,
            other => {
                self.chosen = other.flatten();
                true
            }
        }
    }

    /// Name of the berth that somebody chose.
    #[must_use]
    pub fn chosen(&self) -> Option<&str> {
        self.chosen.and_then(|index| self.config.berths.get(index)).map(|own| own.name.as_str())
    }

    /// The berths of another configuration: what was chosen stays so, if it is still there.
    pub fn inherit(&mut self, before: &BerthDesk) {
        if let Some(name) = before.chosen() {
            self.choose(Some(name));
        }
    }

    /// Takes note of where she is: the nearest within reach is proposed. It stays so until another is clearly nearer.
    pub fn note(&mut self, place: &Geodetic) {
        let ranges: Vec<f64> = self.axes.iter().map(|axes| axes.range(place)).collect();
        let range = |index: usize| ranges.get(index).copied().unwrap_or(f64::INFINITY);
        let within = (0..ranges.len()).filter(|index| range(*index) <= REACH);
        let best = within.min_by(|one, other| range(*one).total_cmp(&range(*other)));
        let holds = |own: &usize| {
            range(*own) <= REACH && best.is_none_or(|best| range(best) > NEARER * range(*own))
        };
        self.nearest = self.nearest.filter(holds).or(best);
    }

    /// The berth that is told of, and how it came to be that one.
    #[must_use]
    pub fn berth(&self) -> Option<(usize, BerthChoice)> {
        let chosen = self.chosen.map(|index| (index, BerthChoice::Chosen));
        chosen.or(self.nearest.map(|index| (index, BerthChoice::Nearest)))
    }

    /// How she stands to it at an instant; `None` where no berth is chosen or near, or nothing is known of her hull.
    #[must_use]
    pub fn look(&self, motion: Option<&Motion>, now: Time) -> Option<Docking> {
        let (berth, hull) = (self.berth()?, self.config.hull.as_ref()?);
        let is_new = |motion: &&Motion| (now - motion.solution.time).as_nanos() <= OLD.as_nanos();
        let Some(motion) = motion.filter(is_new) else {
            return Some(Docking::not_valid(now, berth, NotDocking::NoSolution));
        };
        Some(approach::look(motion, &self.config, hull, self.axes.get(berth.0)?, berth))
    }

    /// Corners of the hull in the plan of the berth that is told of: along the line from its first point, and from it over the
    /// water, m. For a drawing; without an outline bow and stern.
    #[must_use]
    pub fn plan(&self, motion: &Motion) -> Vec<[f64; 2]> {
        let axes = self.berth().and_then(|(berth, _)| self.axes.get(berth));
        let Some((axes, hull)) = axes.zip(self.config.hull.as_ref()) else { return Vec::new() };
        let corners: Vec<_> = hull.corners().map(|(_, lever)| lever).collect();
        let levers = if corners.is_empty() { vec![hull.bow, hull.stern] } else { corners };
        let place = |lever| motion.at_point(lever).solution.position;
        levers.iter().map(|lever| axes.plan(&place(lever))).collect()
    }
}

impl DockingLimits {
    /// Whether the first contact would be too hard. Of a berth that nobody chose nothing is warned of: she may pass it.
    #[must_use]
    pub fn is_too_fast(&self, docking: &Docking) -> bool {
        let contact = docking.contact.filter(|_| docking.is_watched());
        self.contact_speed.zip(contact).is_some_and(|(limit, own)| own.speed.value > limit)
    }

    /// Whether a part is too near and still comes nearer.
    #[must_use]
    pub fn is_too_near(&self, docking: &Docking) -> bool {
        let is_near = |limit: f64, point: &DockingPoint| {
            point.distance.value < limit
                && point.closing.value > RANGING.max(2.0 * point.closing.sigma)
        };
        let points = || docking.points.iter().flatten();
        docking.is_watched()
            && self.distance.is_some_and(|limit| points().any(|own| is_near(limit, own)))
    }
}

impl Docking {
    fn is_watched(&self) -> bool {
        self.choice == BerthChoice::Chosen && !matches!(self.state, DockingState::NotValid(_))
    }
}
