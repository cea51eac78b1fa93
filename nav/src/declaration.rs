//! What is declared of an error state, and what follows from it.

use insd_base::Triad;
use insd_estimation::{Covariance, Key};

use crate::config::NavConfig;
use crate::nominal::Nominal;

/// Everything that the navigator knows of a block of error states.
///
/// Its part of the transition and of the process noise, of the initial covariance, of the correction of the estimate and
/// of its name in what is kept follow from this; a state is added by a row in [`crate::error_state`], a field of
/// [`Nominal`], and the aids that depend on it.
#[derive(Clone, Copy, Debug)]
pub struct Declaration {
    /// Its key.
    pub key: Key,
    /// Number of states.
    pub width: usize,
    /// Name in reports.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// StateAxes it is resolved in.
    pub axes: StateAxes,
    /// When it is carried.
    pub carried: Carried,
    /// 1-sigma of each component before anything is known of it.
    pub first: fn(&NavConfig) -> f64,
    /// How it goes on by itself.
    pub process: fn(&NavConfig, &Regime) -> Process,
    /// What an error of it corrects.
    pub(crate) correction: Correction,
}

/// The axes of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StateAxes {
    /// Earth-centred, Earth-fixed.
    Ecef,
    /// Forward, starboard, down.
    Body,
    /// North, east, down, or the first two of them.
    Ned,
    /// North and east as the computed heading has them.
    ComputedNed,
    /// A number.
    Scalar,
}

impl StateAxes {
    /// In files: `ecef`, `body`, `ned`, `computed_ned`, `scalar`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            StateAxes::Ecef => "ecef",
            StateAxes::Body => "body",
            StateAxes::Ned => "ned",
            StateAxes::ComputedNed => "computed_ned",
            StateAxes::Scalar => "scalar",
        }
    }
}

/// When a block is carried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carried {
    /// Always.
    Always,
    /// From the first word of a log on.
    WithLog,
    /// From the first word of a log on, where what repeats of its errors is learnt.
    WithLearning,
    /// From the time on when the IMU is otherwise warm than at the beginning.
    WithTemperature,
    /// From the first heading of a reference on.
    WithHeading,
    /// From the first position of a reference on that tells of an error which stays.
    WithPosition,
    /// From the first ranges of satellites on.
    WithRanges,
    /// From the first epoch of several antennas on.
    WithAntennas,
    /// From the first heading on that several antennas tell to who does not follow their phases.
    WithAntennaHeading,
    /// From the first reading of a docking aid on, while any is heard.
    WithRanging,
    /// From the first image or step of a camera on, while it is heard.
    WithCamera,
    /// From the first image of a camera whose points are tracked on, while it is heard.
    WithTracks,
    /// From the first step of a visual odometry on, while it is heard.
    WithOdometry,
    /// While the ship is held at her berth.
    AtBerth,
}

/// What the error models depend on at the moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regime {
    /// GNSS positions come from fixed carrier ambiguities.
    pub rtk: bool,
    /// How much warmer the IMU is than when it was first felt, K.
    pub warmer: f64,
}

/// How a block goes on by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Process {
    /// As the mechanisation has it.
    Mechanised,
    /// It stays.
    Constant,
    /// Random walk of a density, in its unit per root of a second.
    Walk(f64),
    /// First-order Gauss-Markov process.
    Markov {
        /// Steady 1-sigma.
        std: f64,
        /// Time constant, s.
        time: f64,
    },
    /// Oscillators, carried where the berth is looked at ([`crate::sway`]).
    Swaying,
    /// A clock and its drift, carried where ranges are looked at ([`crate::receiver_clock`]).
    Clock,
}

/// What an error of a block does to the estimate.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Correction {
    /// It is added to this.
    Adds(fn(&mut Nominal) -> &mut [f64]),
    /// It turns the attitude.
    Turns,
    /// It is added to this, pairs of north and east, which has turned with the heading before.
    AddsTurned(fn(&mut Nominal) -> &mut [f64]),
}

impl Process {
    /// The in-run bias of a triad.
    pub(crate) fn in_run(triad: &Triad) -> Self {
        Process::Markov { std: triad.instability_std, time: triad.instability_time }
    }

    /// What is told in units of its own sigma.
    pub(crate) fn of_sigmas(time: f64) -> Self {
        Process::Markov { std: 1.0, time }
    }
}

impl Declaration {
    /// What the estimate has of it, but for the attitude.
    pub(crate) fn value(self, nominal: &mut Nominal) -> &mut [f64] {
        match self.correction {
            Correction::Adds(field) | Correction::AddsTurned(field) => field(nominal),
            Correction::Turns => &mut [],
        }
    }

    /// Whether the estimate of it turns with that of the heading.
    pub(crate) fn turns_with_heading(&self) -> bool {
        matches!(self.correction, Correction::AddsTurned(_))
    }

    /// A block of this kind joins with its first sigma, if it is not there.
    pub fn join(&self, p: &mut Covariance, config: &NavConfig) {
        p.join_diagonal(self.key, self.width, (self.first)(config).powi(2));
    }
}
