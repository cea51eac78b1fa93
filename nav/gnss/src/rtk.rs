//! Real-time kinematic positioning: a rover against a base to centimetres, by phases whose ambiguities are known to be integers.
//!
//! Equations: Teunissen and Montenbruck (ed.), "Springer Handbook of Global Navigation Satellite Systems", 2017, 21.2 (double differences), 23 (integers).
//! What each step rests on, and what it does with real receivers: docs/rtk.md.

mod arcs;
mod belief;
mod codes;
mod continuous;
mod difference;
mod double;
mod float;
mod instant;
mod link;
mod outcome;
mod pairing;
mod prior;
mod resolve;
mod settings;
mod tracker;

pub use difference::PlacedEpoch;
pub use double::{DifferencedRows, DoubleDifferences, PairAmbiguity};
pub use link::RtkLink;
pub use outcome::{RtkFix, RtkRefusal, RtkSolution, RtkWithdrawal};
pub use pairing::SignalPair;
pub(crate) use pairing::pairs;
pub use prior::RoverPrior;
pub use settings::RtkSettings;
pub use tracker::RtkTracker;
