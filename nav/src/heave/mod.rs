//! Heave of the monitoring points, in real time and delayed.
//!
//! The vertical acceleration, integrated twice, is the ship's motion plus a parabola and a random walk.
//! Waves have periods of 3 to 25 s and no mean: a high-pass keeps them and stops the drift. In real time
//! it also shifts their phase, and the less, the more of the drift it lets through. What is best depends
//! on the sea and on the IMU; no setting is right for all.
//!
//! **Delayed.** A symmetric average of 240 s (`kernel`) shifts no phase. The displacement less this
//! average is the heave of two minutes ago, for periods up to 40 s. White noise of N (m/s)/sqrt(s) leaves
//! 8 N metres: less than a centimetre with a consumer's IMU. What is too slow to be heave, in periods of one to two
//! minutes, is watched; if there is more of it than the IMU's data sheet explains, sigma grows with it.
//!
//! **Real time.** A bank of high-passes (`bank`) gives twelve signals. Those weights of their sum that
//! make its error least follow from the covariance of their errors (Bates and Granger; `combine`), and
//! that is measured, some time later, against a symmetric average (`learner`). The filter so becomes
//! the Wiener filter of the sea and of the IMU as they are, as nearly as twelve signals can (Wiener,
//! Extrapolation, Interpolation and Smoothing of Stationary Time Series, chapter 3), and knows its own
//! error. Until the sea is known, and after a disturbance, a model of what the bank makes of waves, noise,
//! drift and gaps takes the place of what is measured (`model`).
//!
//! **Points.** Bank and averages are linear. They are run for four inputs: the twice integrated
//! acceleration z of the IMU, and the three components of the direction of down in body axes, d_b. The
//! displacement of a point at lever arm l is z - d_b . l. Weights and sigma are each point's own.
//!
//! **What is not heave.** A lasting list, trim, tide and draught are not. In a turn a point off the centre
//! line sinks or rises with the heel: nothing tells that at once from a long wave. It is given as heave,
//! swings over by up to half its size, and is gone after a minute and a half; sigma is larger meanwhile.
//!
//! **What the increments should be.** Free of every correction of the filter. A constant error of the
//! acceleration leaves nothing, a changing one does: after a step of 1 mg the heave is off by half a metre
//! some 15 s later, by a tenth after half a minute. An estimate of the accelerometers' bias is therefore
//! better held for long, or changed slowly, than followed.

mod bank;
mod combine;
mod history;
mod kernel;
mod kernels;
mod learner;
mod model;
mod point;
mod run;
mod step;
mod ticker;
mod times;

use insd_base::{Body, Heave, ImuSpec, Span, Time};
use nalgebra::Vector3;

use bank::Bank;
use kernels::Kernels;
use learner::Grade;
use point::Point;
use run::Run;
pub use step::VerticalStep;
pub use times::DELAY;

/// Longest gap in the IMU's data after which the filter goes on, s.
const LONGEST_GAP: f64 = 5.0;
/// Steps of more than this are no ship's, m/s^2.
const MOST_ACCELERATION: f64 = 500.0;
/// Least white noise that an IMU is believed to have, (m/s)/sqrt(s).
const LEAST_NOISE: f64 = 2e-5;

/// The filter of all monitoring points. Some 120 kB and 3 kB for each point, all of it copied by a clone.
#[derive(Clone, Debug, PartialEq)]
pub struct HeaveFilter {
    grade: Grade,
    bank: Bank,
    kernels: Kernels,
    points: Vec<Point>,
    run: Option<Run>,
}

impl HeaveFilter {
    /// A filter for the IMU, which is point 0, and further points at these lever arms from it, m.
    #[must_use]
    pub fn new(imu: &ImuSpec, points: &[Body]) -> Self {
        let accel = &imu.accel;
        let walk = accel.instability_std * (2.0 / accel.instability_time.max(1.0)).sqrt();
        let noise = accel.random_walk.max(LEAST_NOISE);
        let grade = Grade { noise, walk, constant: accel.bias_std };
        let here = Body::default();
        HeaveFilter {
            grade,
            bank: Bank::new(),
            kernels: Kernels::new(&grade),
            points: [here].iter().chain(points).map(|lever| Point::new(lever, grade)).collect(),
            run: None,
        }
    }

    /// Takes the next step of the IMU. A step that does not follow the last comes after a gap: over a
    /// short one the motion is carried on, after a long one, or if time leaps back, all begins anew. What
    /// is already past is ignored.
    pub fn advance(&mut self, step: &VerticalStep) {
        let believable = step.velocity.abs() <= MOST_ACCELERATION * step.duration
            && step.down_b.iter().all(|d| d.is_finite());
        if !(believable && step.duration > 0.0) {
            return;
        }
        let begin = step.to - Span::from_seconds(step.duration);
        let since = |run: &Run| (begin - run.ticker.now()).as_seconds();
        let gap = self.run.as_ref().map_or(f64::INFINITY, since);
        let mut fresh = 1.0;
        if gap.abs() > LONGEST_GAP {
            self.start(begin, step.down_b);
        } else if gap > 0.5 * step.duration {
            self.bridge(gap, step);
        } else {
            fresh += gap.min(0.0) / step.duration;
        }
        if fresh > 0.0 {
            self.take(&VerticalStep { velocity: step.velocity * fresh, ..*step });
        }
    }

    /// Tells that the last `gap` seconds of steps were made up. What was missed of the motion is unknown;
    /// after more than five seconds the filter begins anew.
    pub fn interrupt(&mut self, gap: f64) {
        let Some(run) = &mut self.run else { return };
        if gap > LONGEST_GAP {
            let (now, down_b) = (run.ticker.now(), run.ticker.down_b);
            self.start(now, down_b);
        } else if missed_velocity(gap) > self.grade.noise {
            run.model.gap(&self.bank, missed_velocity(gap), gap);
        }
    }

    /// Makes up the steps of a gap: the acceleration is the mean of those on both sides.
    fn bridge(&mut self, gap: f64, next: &VerticalStep) {
        let before = self.run.as_ref().map_or(0.0, Run::acceleration);
        let velocity = 0.5 * gap * (before + next.velocity / next.duration);
        let to = next.to - Span::from_seconds(next.duration);
        self.take(&VerticalStep { to, duration: gap, velocity, down_b: next.down_b });
        self.interrupt(gap);
    }

    /// Begins at an instant, from nothing.
    fn start(&mut self, begin: Time, down_b: Vector3<f64>) {
        self.run = Some(Run::new(begin, down_b));
        self.points.iter_mut().for_each(Point::restart);
    }

    fn take(&mut self, step: &VerticalStep) {
        let (bank, kernels, points) = (&self.bank, &self.kernels, &mut self.points);
        let Some(run) = &mut self.run else { return };
        let mut ticker = run.ticker;
        ticker.take(step, |tick| run.tick(tick, bank, kernels, points));
        run.ticker = ticker;
    }
}

/// Heave.
impl HeaveFilter {
    /// Heave of a point at the end of the last step; point 0 is the IMU. `None` if there is no such point or
    /// the first tenth of a second is not over.
    #[must_use]
    pub fn heave(&self, point: usize) -> Option<Heave> {
        let point = self.points.get(point)?;
        let run = self.run.as_ref().filter(|run| run.has_ticked())?;
        let (raw, velocity, acceleration) = run.now();
        let (offset, slope) = point.offset(run.ticker.filled);
        Some(Heave {
            time: run.ticker.now(),
            heave: point.share.dot(&raw) + offset,
            rate: point.share.dot(&velocity) + slope,
            acceleration: point.share.dot(&acceleration),
            sigma: point.sigma,
            quality: point.quality,
            delayed: point.delayed,
        })
    }
}

/// What a gap of this length hides of the change of the velocity, 1-sigma, m/s: a ship's force goes on
/// nearly as it was for a time much shorter than a wave, and is anyone's guess beyond it.
fn missed_velocity(gap: f64) -> f64 {
    const WAVE: f64 = 2.0;
    const FORCE: f64 = 0.5;
    FORCE * gap * (gap / WAVE).powi(2).min(1.0)
}
