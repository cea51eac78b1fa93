//! The navigator: strapdown mechanisation, error model, Kalman filter, aids, gates and the time line
//! on which late measurements are applied when they were valid.
//!
//! Pure: no I/O, no clock, no thread, no randomness. A [`Filter`] can only be built from an
//! [`InitialState`], which alignment makes.
//!
#![doc = include_str!("../README.md")]

pub mod aids;
pub mod angular_rate;
pub mod antenna;
pub mod berth;
pub mod bridging;
pub mod camera;
pub mod config;
mod correction;
pub mod dating;
pub mod declaration;
pub mod dimensions;
pub mod disturbance;
pub mod echo;
pub mod error_state;
pub mod filter;
pub mod floors;
pub mod gate;
pub mod heave;
pub mod increments;
pub mod initial;
pub mod judge;
pub mod leap;
pub mod method;
pub mod navigator;
pub mod noise;
pub mod nominal;
pub mod own_word;
pub mod pace;
pub mod propagation;
pub mod protection;
mod receiver_clock;
pub mod report;
pub mod sea_state;
pub mod sea_window;
pub mod separate_bias;
pub mod slip;
pub mod smoothing;
pub mod solution_sigma;
pub mod spikes;
pub mod spread;
pub mod strapdown;
pub mod sway;
pub mod symmetry;
pub mod thermal;
pub mod timeline;
pub mod trust;
pub mod wheels;

pub use config::NavConfig;
pub use filter::Filter;
pub use heave::{HeaveFilter, VerticalStep};
pub use increments::{Conditioned, Conditioner, Increment};
pub use initial::InitialState;
pub use navigator::Navigator;
pub use nominal::Nominal;
pub use report::{AidReport, Outcome, Report};
pub use sway::{Oscillator, Sway};
pub use timeline::{Estimator, Timeline};
