//! The ship on her time line: aligning with a bank of filters, then navigating with the one left.

use insd_alignment::bank::Kinematics;
use insd_alignment::{Bank, Level};
use insd_base::units::DEG;
use insd_base::{Mode, Received, Solution, Time};
use insd_nav::{Estimator, Filter, Increment, NavConfig, Report};

/// Heading sigma at the equator at which a moored ship counts as aligned; it grows with sec(lat).
const ALIGNED: f64 = 0.1 * DEG;

/// Heading sigma below which a ship can be steered by it for the first time.
const STEERABLE: f64 = 1.0 * DEG;

/// What runs on the time line.
#[derive(Clone, Debug)]
pub(crate) enum Ship {
    /// Several headings are possible.
    Aligning(Bank),
    /// One is known, `aligned` once well enough to steer by.
    Navigating { filter: Box<Filter>, aligned: bool },
}

impl Ship {
    pub(crate) fn aligning(config: &NavConfig, level: &Level, kinematics: &Kinematics) -> Self {
        Ship::Aligning(Bank::new(config, level, kinematics))
    }

    fn moored(&self) -> bool {
        match self {
            Ship::Aligning(bank) => bank.is_moored(),
            Ship::Navigating { filter, .. } => filter.is_moored(),
        }
    }

    fn with_mode(&self, solution: Solution) -> Solution {
        let aligned = ALIGNED / solution.position.latitude.cos().max(1e-3);
        let mode = match self {
            _ if self.moored() && solution.sigma.heading > aligned => Mode::FineAlignment,
            Ship::Aligning(_) => Mode::InMotionAlignment,
            Ship::Navigating { aligned: false, .. } if solution.mode == Mode::Aided => {
                Mode::InMotionAlignment
            }
            Ship::Navigating { .. } => solution.mode,
        };
        Solution { mode, ..solution }
    }

    fn inner(&self) -> &dyn Solver {
        match self {
            Ship::Aligning(bank) => bank,
            Ship::Navigating { filter, .. } => filter.as_ref(),
        }
    }
}

/// The part of an [`Estimator`] that only reads.
trait Solver {
    fn now(&self) -> Solution;
    fn at(&self, increment: &Increment, at: Time) -> Solution;
}

impl<E: Estimator> Solver for E {
    fn now(&self) -> Solution {
        self.solution()
    }

    fn at(&self, increment: &Increment, at: Time) -> Solution {
        self.solution_at(increment, at)
    }
}

impl Estimator for Ship {
    fn advance(&mut self, increment: &Increment) {
        match self {
            Ship::Aligning(bank) => bank.advance(increment),
            Ship::Navigating { filter, .. } => filter.advance(increment),
        }
    }

    fn apply(&mut self, received: &Received) -> Report {
        match self {
            Ship::Aligning(bank) => {
                let report = bank.apply(received);
                if let Some(filter) = bank.winner() {
                    let mut navigator = Box::new(filter.clone());
                    navigator.begin_navigation();
                    *self = Ship::Navigating { filter: navigator, aligned: false };
                }
                report
            }
            Ship::Navigating { filter, aligned } => {
                let report = filter.apply(received);
                *aligned = *aligned || filter.heading_std() < STEERABLE;
                report
            }
        }
    }

    fn solution(&self) -> Solution {
        self.with_mode(self.inner().now())
    }

    fn solution_at(&self, increment: &Increment, at: Time) -> Solution {
        self.with_mode(self.inner().at(increment, at))
    }
}
