//! An array that is followed from epoch to epoch.

use insd_base::satellites::CompassRefusal;
use insd_base::{GpsTime, SatelliteEpoch};
use nalgebra::Vector3;

use super::faults::Monitor;
use super::fit::{Freed, fitted, plain, swapped};
use super::hypotheses::{Hypothesis, MOST, weighed};
use super::level::is_possible;
use super::lines::LineBiases;
use super::model::Model;
use super::observe::{Observed, Place, observe};
use super::outcome::{CompassEpoch, CompassFix, CompassRejection};
use super::pose::CompassPose;
use super::prior::CompassPrior;
use super::search::{Candidates, Region, candidates};
use super::settings::{CompassArray, CompassSettings, CompassShape};
use super::solve::{Outcome, Start};
use super::told::told;
use crate::context::Context;
use crate::rtk::{PlacedEpoch, RtkFix, RtkSettings, RtkSolution};
use crate::single_point::SinglePoint;

/// After a pause of so many seconds all begins anew, but for line biases.
const LONGEST: f64 = 120.0;
/// After so many epochs in a row that do not fit it is searched for anew, and in wider places.
const PATIENCE: usize = 3;
/// Poses in which antennas are less than this share of a wavelength apart are one.
const ONE: f64 = 0.05;
/// Before an attitude is told for the first time antennas have to be known to this share of a wavelength, so that their integers hold.
const SHARP: f64 = 0.06;
/// Of the variance of residuals over that assumed an epoch is this share of what is remembered.
const LATELY: f64 = 0.1;
/// Where it has been larger than this for a while, clocks are looked at.
const SUSPICIOUS: f64 = 1.3;
/// Or, of the vector between two, so many measurements beyond the unknowns have left nothing else.
const ALONE: f64 = 40.0;
/// So many satellites find an attitude of which nothing is known: with five and four of 200 made-up starts one and five were wrong.
const ENOUGH: usize = 6;
/// So many measurements beyond the unknowns have to bear on what is believed.
const BORNE: f64 = 4.0;

/// Follows an array of antennas: attitude of a hull, or the vector between two antennas, epoch by epoch.
///
/// ```
/// use insd_gnss::{CompassArray, CompassPrior, CompassSettings, CompassTracker, Context};
/// # use insd_base::{GpsTime, SatelliteEpoch};
/// # use nalgebra::Vector3;
/// # let context = Context::default();
/// # let tag = GpsTime::from_week(2300, 0);
/// # let epoch = SatelliteEpoch { tag, signals: Vec::new(), leap_seconds: None, clock_reset: false };
/// let corner = |forward, starboard| Vector3::new(forward, starboard, 0.0);
/// let levers = vec![corner(0.05, -0.05), corner(0.05, 0.05), corner(-0.05, 0.05)];
/// let array = CompassArray::on_one_clock(levers);
/// let mut compass = CompassTracker::new(array, CompassSettings::default());
/// let epochs = [Some(&epoch), Some(&epoch), None];
/// match compass.take(&context, &epochs, &CompassPrior::default()).told {
///     Ok(fix) => println!("{:?}, wrong by {}", fix.attitude(), fix.doubt),
///     Err(why) => println!("unknown: {why}"),
/// }
/// ```
#[derive(Clone, Debug)]
pub struct CompassTracker {
    array: CompassArray,
    settings: CompassSettings,
    lines: LineBiases,
    hypotheses: Vec<Hypothesis>,
    before: Option<GpsTime>,
    place: Option<Vector3<f64>>,
    monitor: Monitor,
    /// Epochs in a row that did not fit.
    misfits: usize,
    /// Variance of the residuals over that assumed, lately.
    level: f64,
    /// An attitude has been told, and followed since.
    is_known: bool,
}

impl CompassTracker {
    /// An array of which nothing is known but how its antennas stand.
    #[must_use]
    pub fn new(array: CompassArray, settings: CompassSettings) -> Self {
        Self::with_lines(array, settings, LineBiases::default())
    }

    /// The same with line biases that have been found before.
    #[must_use]
    pub fn with_lines(array: CompassArray, settings: CompassSettings, lines: LineBiases) -> Self {
        let monitor = Monitor::new(array.antennas());
        Self {
            array,
            settings,
            lines,
            hypotheses: Vec::new(),
            before: None,
            place: None,
            monitor,
            misfits: 0,
            level: 1.0,
            is_known: false,
        }
    }

    /// Line biases as far as they are known.
    #[must_use]
    pub fn lines(&self) -> &LineBiases {
        &self.lines
    }

    /// Takes an epoch of each antenna, those of one instant together; `None` of one that was not heard.
    pub fn take(
        &mut self,
        context: &Context,
        epochs: &[Option<&SatelliteEpoch>],
        prior: &CompassPrior,
    ) -> CompassEpoch {
        let tag = epochs.iter().flatten().next().map(|epoch| epoch.tag);
        let mut epoch = CompassEpoch {
            tag,
            told: Err(CompassRefusal::Array),
            hypotheses: 0,
            faults: Vec::new(),
            rejected: Vec::new(),
        };
        if self.array.is_usable() && epochs.len() == self.array.antennas() {
            epoch.told = Err(CompassRefusal::NoPlace);
            if let Some(place) = self.placed(context, epochs, prior)
                && let Some(mut observed) = observe(context, &self.settings, epochs, place)
            {
                self.monitor.hear(&observed);
                observed.commons = self.monitor.of_use(&observed.commons);
                epoch.rejected.append(&mut observed.rejected);
                let heard = (context, epochs, place.at);
                epoch.told = self.found(heard, &observed, prior, &mut epoch.rejected);
            }
        }
        epoch.hypotheses = self.hypotheses.len();
        epoch.faults = self.monitor.faults();
        epoch
    }

    /// About where the antennas are.
    fn placed(
        &mut self,
        context: &Context,
        epochs: &[Option<&SatelliteEpoch>],
        prior: &CompassPrior,
    ) -> Option<Place> {
        let by_codes = || {
            let mut points = epochs.iter().flatten();
            points.find_map(|epoch| SinglePoint::solve(context, epoch, self.place).ok())
        };
        let at = prior.antenna.or_else(|| by_codes().map(|point| point.position));
        let at = at.filter(|at| at.iter().all(|x| x.is_finite())).or(self.place)?;
        self.place = Some(at);
        let velocity = prior.velocity.filter(|v| v.iter().all(|x| x.is_finite()));
        Some(Place { at, velocity: velocity.unwrap_or_else(Vector3::zeros) })
    }

    fn found(
        &mut self,
        heard: (&Context, &[Option<&SatelliteEpoch>], Vector3<f64>),
        observed: &Observed,
        prior: &CompassPrior,
        rejected: &mut Vec<CompassRejection>,
    ) -> Result<CompassFix, CompassRefusal> {
        let signals = observed.commons.len();
        if signals < 2 {
            return Err(CompassRefusal::TooFew { signals });
        }
        let array = self.monitor.effective(&self.array);
        let model = Model { array: &array, commons: &observed.commons };
        let elapsed = self.before.map_or(f64::INFINITY, |own| observed.tag.since(own).as_seconds());
        self.before = Some(observed.tag);
        if !(elapsed > 0.0 && elapsed < LONGEST) || self.misfits >= PATIENCE {
            self.hypotheses.clear();
        }
        self.is_known &= !self.hypotheses.is_empty();
        let mut all = self.followed(&model, elapsed, prior);
        if all.is_empty() {
            let lasted = if elapsed.is_finite() { elapsed.max(0.0) } else { 0.0 };
            self.lines.advance(lasted, self.settings.line_walk);
            all = self.searched(&model, heard, observed, prior)?;
        }
        let shortest = model.shortest();
        let doubt = weighed(&mut all, &array.shape, ONE * shortest);
        self.hypotheses = all;
        let (outcome, freed) = self.judged(doubt, shortest, model.satellites())?;
        let commons = freed.commons(model.commons);
        let told = told(&Model { commons: &commons, ..model }, &outcome, observed);
        rejected.extend(told.rejected);
        Ok(CompassFix { doubt, ..told.fix })
    }

    /// What becomes of each hypothesis.
    fn followed(
        &mut self,
        model: &Model<'_>,
        elapsed: f64,
        prior: &CompassPrior,
    ) -> Vec<Hypothesis> {
        let before = std::mem::take(&mut self.hypotheses);
        let is_alone = before.len() == 1;
        let follow = |own: &Hypothesis| {
            let turn = prior.turn.as_ref();
            let mut start = own.predicted(&self.settings, model.shape(), (elapsed, turn));
            if is_alone {
                start.helped(prior);
            }
            let found = fitted(model, &start, self.level > SUSPICIOUS)?;
            is_possible(&found.0, prior).then(|| own.followed(found, elapsed, prior))
        };
        before.iter().filter_map(follow).collect()
    }

    /// Hypotheses of an epoch that stands for itself.
    fn searched(
        &mut self,
        model: &Model<'_>,
        (context, epochs, at): (&Context, &[Option<&SatelliteEpoch>], Vector3<f64>),
        observed: &Observed,
        prior: &CompassPrior,
    ) -> Result<Vec<Hypothesis>, CompassRefusal> {
        let is_lost = self.misfits >= PATIENCE;
        let region = Region::of(prior, is_lost);
        let Candidates { poses, is_complete } = match model.shape() {
            CompassShape::Baseline { length: None } => by_codes(context, epochs, &at, observed),
            _ => candidates(model, &self.lines, &region, MOST)?,
        };
        if !is_complete && !is_lost {
            return Err(CompassRefusal::Ambiguous { hypotheses: poses.len(), doubt: 1.0 });
        }
        let solved = |pose: &CompassPose, is_mended: bool| {
            let (pose, lines) = (*pose, self.lines.clone());
            let start = Start { pose, covariance: region.covariance(), lines };
            let own = if is_mended { fitted(model, &start, false) } else { plain(model, &start) };
            let own = own.filter(|(outcome, _)| is_possible(outcome, prior))?;
            Some(Hypothesis::new(own, prior))
        };
        let all: Vec<_> = poses.iter().filter_map(|pose| solved(pose, false)).collect();
        let best = all.iter().map(|own| own.outcome.times()).fold(f64::INFINITY, f64::min);
        if is_lost && best > 1.0 {
            // an array with two antennas exchanged would fit nearly without one of them
            let sound = Region::of(prior, false);
            let pairs = swapped(model, &self.lines, (&sound, prior), best);
            self.monitor.fits_swapped(&pairs);
            if pairs.is_empty() {
                return Ok(poses.iter().filter_map(|pose| solved(pose, true)).collect());
            }
        }
        if is_complete || best > 1.0 {
            return Ok(all);
        }
        Err(CompassRefusal::Ambiguous { hypotheses: all.len(), doubt: 1.0 })
    }

    /// The likeliest, if it fits and nothing else does.
    fn judged(
        &mut self,
        doubt: f64,
        shortest: f64,
        satellites: usize,
    ) -> Result<(Outcome, Freed), CompassRefusal> {
        let Some(best) = self.hypotheses.first() else {
            self.misfits += 1;
            return Err(CompassRefusal::Geometry);
        };
        let (level, limit) = (best.outcome.level(), self.settings.level);
        // what is told for the first time has to fit with nearly all satellites
        let is_doubtful = !self.is_known && best.outcome.times() > 1.0;
        if level > limit || is_doubtful {
            self.misfits += 1;
            // what never fitted is not followed
            if best.is_new {
                self.hypotheses.clear();
            }
            return Err(CompassRefusal::Residuals { level, limit });
        }
        self.misfits = 0;
        // a vector on one satellite system and clocks of its own is never as sharp in one epoch
        let is_pair = matches!(self.array.shape, CompassShape::Baseline { .. });
        let is_alone = is_pair && self.hypotheses.len() == 1 && best.count > ALONE;
        let is_sharp = best.outcome.unsure(&self.array.shape) < SHARP * shortest;
        let is_sharp = is_sharp || is_alone || self.is_known;
        // fewer do not tell a hull that may stand anyhow; what is predicted well enough for rounding they do
        let is_many = satellites >= ENOUGH || best.outcome.success > 1.0 - self.settings.risk;
        let is_enough = self.is_known || is_pair || is_many;
        if doubt > self.settings.risk || best.count < BORNE || !is_sharp || !is_enough {
            let hypotheses = self.hypotheses.len();
            return Err(CompassRefusal::Ambiguous { hypotheses, doubt });
        }
        self.is_known = true;
        self.level += LATELY * (level - self.level);
        self.monitor.fitted(best.freed);
        self.lines = best.outcome.lines.clone();
        Ok((best.outcome.clone(), best.freed))
    }
}

/// The vector between two antennas as a rover against a base has it, if its integers are sure.
fn by_codes(
    context: &Context,
    epochs: &[Option<&SatelliteEpoch>],
    at: &Vector3<f64>,
    observed: &Observed,
) -> Candidates {
    let none = Candidates { poses: Vec::new(), is_complete: true };
    let [Some(first), Some(second)] = epochs else { return none };
    let base = PlacedEpoch { epoch: first, position: *at };
    let settings = RtkSettings::default();
    let solved = RtkSolution::single_epoch(context, &settings, second, &base, None);
    let fixed = solved.ok().and_then(|solution| solution.fixed.ok());
    let pose = |fix: RtkFix| CompassPose::Baseline(observed.c_ne * (fix.position - at));
    Candidates { poses: fixed.map(pose).into_iter().collect(), ..none }
}
