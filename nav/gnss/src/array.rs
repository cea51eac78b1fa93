//! Several antennas of one hull, each with a receiver: followed from epoch to epoch, as one antenna in their middle where they stand close together on one clock, and as a compass.

mod mean;

use insd_base::satellites::{
    AntennaSignal, CompassFault, CompassPhases, CompassReading, CompassRefusal,
};
use insd_base::{SatelliteEpoch, Time};
use nalgebra::{Matrix3, Vector3};

use crate::compass::{
    CompassArray, CompassEpoch, CompassPrior, CompassSettings, CompassShape, CompassTracker,
};
use crate::context::Context;
use crate::ranging::{Guess, Ranged, Ranging};
use crate::turns::Turns;
use mean::MeanAntenna;

/// Antennas that stand closer together than this are one to ranges, m: what is known of the hull's attitude does not matter.
const CLOSE: f64 = 2.0;

/// What is assumed of the noise of phases is worth so many residuals, and those of so many epochs are remembered.
const ASSUMED: f64 = 100.0;
const REMEMBERED: f64 = 300.0;

/// Antennas of a hull with a receiver each.
#[derive(Clone, Debug)]
pub struct ArrayRanging {
    levers: Vec<Vector3<f64>>,
    /// Those whose ranges are used: the first one, and those beside it on its clock.
    middle: Vec<usize>,
    antennas: Vec<Ranging>,
    mean: MeanAntenna,
    compass: CompassTracker,
    /// The hull's axes at the epoch before.
    axes: Option<Matrix3<f64>>,
    run: u32,
    is_told: bool,
    faulty: Vec<usize>,
    scatter: Scatter,
}

/// How noisy phases are beside what is assumed of them.
#[derive(Clone, Copy, Debug, Default)]
struct Scatter {
    /// Sum of weighed squares of residuals.
    squares: f64,
    /// Of how many.
    count: f64,
}

impl Scatter {
    /// Takes an epoch's, with its degrees of freedom: under few satellites that is next to nothing. Gives the variance over that assumed.
    fn hear(&mut self, (squares, count): (f64, usize)) -> f64 {
        let kept = 1.0 - 1.0 / REMEMBERED;
        self.squares = self.squares * kept + squares;
        self.count = self.count * kept + count as f64;
        (self.squares + ASSUMED) / (self.count + ASSUMED)
    }
}

/// What is made of the epochs of all antennas.
#[derive(Clone, Debug, PartialEq)]
pub struct ArrayRanged {
    /// As if one antenna had heard it; `None` where none of those whose ranges are used did.
    pub ranged: Option<Ranged>,
    /// What they tell as a compass; one antenna alone is none.
    pub compass: Option<CompassTold>,
}

/// What antennas tell as a compass, at an instant that is told with the ranges.
#[derive(Clone, Debug, PartialEq)]
pub struct CompassTold {
    run: u32,
    told: Result<CompassPhases, CompassRefusal>,
    faults: Vec<CompassFault>,
}

impl CompassTold {
    /// What goes to a filter and to those who look on, sampled at an instant of the ship's time line.
    #[must_use]
    pub fn at(self, time: Time) -> CompassReading {
        let CompassTold { run, told, faults } = self;
        CompassReading { time, run, told, faults }
    }
}

impl ArrayRanging {
    /// Antennas at these lever arms from the IMU, body axes, m, on these clocks. The first is the one whose lever arm ranges are told for.
    #[must_use]
    pub fn new(levers: &[Vector3<f64>], clocks: &[usize]) -> Self {
        let shape = CompassShape::Body(levers.to_vec());
        let array = CompassArray { shape, clocks: clocks.to_vec() };
        let is_close = levers.iter().all(|lever| (lever - levers[0]).norm() < CLOSE);
        let shares = |antenna: &usize| clocks.get(*antenna) == clocks.first() && is_close;
        let middle = (0..levers.len()).filter(|own| *own == 0 || shares(own)).collect();
        Self {
            levers: levers.to_vec(),
            middle,
            antennas: vec![Ranging::default(); levers.len()],
            mean: MeanAntenna::default(),
            compass: CompassTracker::new(array, CompassSettings::default()),
            axes: None,
            run: 0,
            is_told: false,
            faulty: Vec::new(),
            scatter: Scatter::default(),
        }
    }

    /// Takes the epochs of one instant; `None` of an antenna that was not heard.
    pub fn take(
        &mut self,
        context: &Context,
        epochs: &[Option<&SatelliteEpoch>],
        antenna: Option<Vector3<f64>>,
        turns: &Turns,
    ) -> ArrayRanged {
        let guess = Guess { antenna, turned: turns.so_far() };
        let mut heard = Vec::with_capacity(self.middle.len());
        for own in &self.middle {
            let Some(epoch) = epochs.get(*own).copied().flatten() else { continue };
            heard.push((*own, self.antennas[*own].take(context, epoch, guess)));
        }
        let ranged = self.mean.of(&self.levers, &self.faulty, heard);
        let is_compass = self.levers.len() > 1;
        let compass = is_compass.then(|| self.as_compass(context, epochs, (antenna, turns)));
        ArrayRanged { ranged, compass }
    }

    fn as_compass(
        &mut self,
        context: &Context,
        epochs: &[Option<&SatelliteEpoch>],
        (antenna, turns): (Option<Vector3<f64>>, &Turns),
    ) -> CompassTold {
        let now = turns.axes();
        let turn = self.axes.replace(now).map(|before| before.transpose() * now);
        let prior = CompassPrior { antenna, velocity: None, attitude: turns.level(), turn };
        let CompassEpoch { told, faults, .. } = self.compass.take(context, epochs, &prior);
        self.faulty = faults.iter().filter_map(unusable).collect();
        let phases = told.map(|fix| {
            let (attitude, covariance) = fix.attitude().unwrap_or_default();
            CompassPhases {
                attitude,
                covariance,
                signals: as_noisy(fix.signals, self.scatter.hear(fix.chi_square)),
            }
        });
        // what is lost for an epoch is found where it was, or at other integers
        if phases.is_ok() && !self.is_told {
            self.run += 1;
        }
        self.is_told = phases.is_ok();
        CompassTold { run: self.run, told: phases, faults }
    }
}

/// Phases as noisy as they have shown to be.
fn as_noisy(mut signals: Vec<AntennaSignal>, level: f64) -> Vec<AntennaSignal> {
    let phases = signals.iter_mut().flat_map(|signal| &mut signal.phases);
    phases.for_each(|phase| phase.variance *= level);
    signals
}

fn unusable(fault: &CompassFault) -> Option<usize> {
    match fault {
        CompassFault::Broken { antenna }
        | CompassFault::OwnClock { antenna, .. }
        | CompassFault::Incoherent { antenna } => Some(*antenna),
        CompassFault::Swapped { .. } => None,
    }
}
