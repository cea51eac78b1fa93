//! A ship in a sea, an IMU with its errors, and the heave filter beside the truth.

use insd_base::{Body, Heave, HeaveQuality, ImuSpec, Time, Triad};
use insd_nav::heave::{HeaveFilter, VerticalStep};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use crate::sea::{Move, Sea};

/// A class of IMU.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grade {
    pub(crate) name: &'static str,
    pub(crate) accel: [f64; 5],
}

/// Accelerometers as the simulator has them: bias, in-run bias, micro-g; its time constant, s; random
/// walk, (m/s)/sqrt(h); scale factor, ppm.
pub(crate) const GRADES: [Grade; 3] = [
    Grade { name: "navigation", accel: [50.0, 10.0, 3600.0, 0.005_884, 50.0] },
    Grade { name: "tactical", accel: [500.0, 50.0, 1000.0, 0.029_42, 200.0] },
    Grade { name: "mems", accel: [1000.0, 50.0, 600.0, 0.058_84, 500.0] },
];

impl Grade {
    pub(crate) fn spec(&self, rate: f64) -> ImuSpec {
        let gyro = Triad::of_gyros([0.01, 0.003, 3600.0, 0.003, 10.0]);
        ImuSpec { rate, gyro, accel: Triad::of_accelerometers(self.accel) }
    }

    /// The errors of an accelerometer of this grade.
    pub(crate) fn accelerometer(&self, seed: u64) -> Accelerometer {
        Accelerometer::new(Triad::of_accelerometers(self.accel), seed)
    }
}

/// The point that is watched beside the IMU: 40 m ahead, 10 m to starboard, 5 m up.
pub(crate) const ABEAM: Body = Body(nalgebra::Vector3::new(40.0, 10.0, -5.0));

/// Errors of the vertical acceleration.
pub(crate) struct Accelerometer {
    rng: Pcg64,
    triad: Triad,
    constant: f64,
    slow: f64,
}

impl Accelerometer {
    fn new(triad: Triad, seed: u64) -> Self {
        let mut rng = Pcg64::seed_from_u64(seed ^ 0x5eed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut rng) };
        let (constant, slow) = (normal() * triad.bias_std, normal() * triad.instability_std);
        Accelerometer { rng, triad, constant, slow }
    }

    /// Error of the increment over the next `h` seconds, m/s.
    pub(crate) fn error(&mut self, h: f64) -> f64 {
        let mut normal = || -> f64 { StandardNormal.sample(&mut self.rng) };
        let kept = (-h / self.triad.instability_time).exp();
        self.slow =
            self.slow * kept + normal() * self.triad.instability_std * (1.0 - kept * kept).sqrt();
        (self.constant + self.slow) * h + normal() * self.triad.random_walk * h.sqrt()
    }
}

/// One instant of a trial.
pub(crate) struct Instant {
    pub(crate) t: f64,
    /// True displacement of the points, up, m.
    pub(crate) truth: Vec<f64>,
    pub(crate) heave: Vec<Heave>,
}

/// A trial: who sails where and with what.
pub(crate) struct Trial<'a> {
    pub(crate) grade: Grade,
    pub(crate) rate: f64,
    pub(crate) duration: f64,
    pub(crate) seed: u64,
    pub(crate) points: &'a [Body],
}

impl Trial<'_> {
    /// Runs it; `ship` tells the motion, `disturb` adds to the increment of the velocity and may work on
    /// the filter; what is true is put down every tenth of a second.
    pub(crate) fn run(
        &self,
        ship: impl Fn(f64) -> Move,
        mut disturb: impl FnMut(f64, &mut VerticalStep, &mut HeaveFilter) -> bool,
    ) -> Vec<Instant> {
        let spec = self.grade.spec(self.rate);
        let mut filter = HeaveFilter::new(&spec, self.points);
        let mut accel = self.grade.accelerometer(self.seed);
        let h = 1.0 / self.rate;
        let mut next = 1;
        let levers: Vec<Body> = [Body::default()].iter().chain(self.points).copied().collect();
        let mut before = ship(0.0);
        let mut record = Vec::new();
        for i in 1..=(self.duration * self.rate) as usize {
            let t = i as f64 * h;
            let now = ship(t);
            let mut step = VerticalStep {
                to: Time::from_seconds(t),
                duration: h,
                velocity: now.rate - before.rate + accel.error(h),
                down_b: now.down_b(),
            };
            before = now;
            if disturb(t, &mut step, &mut filter) {
                filter.advance(&step);
            }
            if t >= 0.1 * f64::from(next) - 1e-9 {
                next += 1;
                let down = now.down_b();
                let truth = levers.iter().map(|l| now.heave - down.dot(&l.0)).collect();
                let heave = (0..levers.len()).filter_map(|p| filter.heave(p)).collect();
                record.push(Instant { t, truth, heave });
            }
        }
        centre(&mut record);
        record
    }

    /// Runs it in a sea without anything that happens.
    pub(crate) fn in_sea(&self, sea: &Sea) -> Vec<Instant> {
        self.run(|t| sea.at(t), |_, _, _| true)
    }
}

/// Takes the mean displacement of each point away: heave has none.
pub(crate) fn centre(record: &mut [Instant]) {
    let count = record.len() as f64;
    let points = record.first().map_or(0, |instant| instant.truth.len());
    for point in 0..points {
        let mean = record.iter().map(|instant| instant.truth[point]).sum::<f64>() / count;
        record.iter_mut().for_each(|instant| instant.truth[point] -= mean);
    }
}

/// Errors of one kind of heave.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Errors {
    pub(crate) rms: f64,
    pub(crate) p95: f64,
    pub(crate) worst: f64,
    /// Share within two sigmas.
    pub(crate) covered: f64,
    /// Share of settled heave.
    pub(crate) settled: f64,
    pub(crate) count: usize,
}

impl Errors {
    fn of(samples: &[(f64, f64, HeaveQuality)]) -> Self {
        let n = samples.len().max(1) as f64;
        let mut sizes: Vec<f64> = samples.iter().map(|(error, _, _)| error.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let share = |keep: &dyn Fn(&(f64, f64, HeaveQuality)) -> bool| {
            samples.iter().filter(|sample| keep(sample)).count() as f64 / n
        };
        let mean = |of: &dyn Fn(&(f64, f64, HeaveQuality)) -> f64| {
            (samples.iter().map(of).sum::<f64>() / n).sqrt()
        };
        Errors {
            rms: mean(&|s| s.0 * s.0),
            p95: sizes.get(sizes.len() * 95 / 100).copied().unwrap_or(0.0),
            worst: sizes.last().copied().unwrap_or(0.0),
            covered: share(&|s| s.0.abs() <= 2.0 * s.1),
            settled: share(&|s| s.2 == HeaveQuality::Settled),
            count: samples.len(),
        }
    }

    /// The errors of several trials together.
    pub(crate) fn mean(of: &[Self]) -> Self {
        let n = of.len().max(1) as f64;
        let mean = |part: &dyn Fn(&Self) -> f64| of.iter().map(part).sum::<f64>() / n;
        Errors {
            rms: mean(&|e| e.rms * e.rms).sqrt(),
            p95: mean(&|e| e.p95),
            worst: of.iter().map(|e| e.worst).fold(0.0, f64::max),
            covered: mean(&|e| e.covered),
            settled: mean(&|e| e.settled),
            count: of.iter().map(|e| e.count).sum(),
        }
    }

    /// Of the heave in real time, from `from` to `to`, s.
    pub(crate) fn real_time(record: &[Instant], point: usize, from: f64, to: f64) -> Self {
        let inside = record.iter().filter(|i| i.t >= from && i.t < to && i.heave.len() > point);
        let samples: Vec<_> = inside
            .map(|i| {
                let heave = &i.heave[point];
                (heave.heave - i.truth[point], heave.sigma, heave.quality)
            })
            .collect();
        Errors::of(&samples)
    }

    /// Of the delayed heave of the instants from `from` to `to`, s.
    pub(crate) fn delayed(record: &[Instant], point: usize, from: f64, to: f64) -> Self {
        let sample = |i: &Instant| {
            let delayed = i.heave.get(point)?.delayed?;
            let t = delayed.time.as_seconds();
            let truth = &record[record.partition_point(|instant| instant.t < t - 1e-6)];
            let error = delayed.heave - truth.truth[point];
            (t >= from && t < to).then_some((error, delayed.sigma, delayed.quality))
        };
        Errors::of(&record.iter().filter_map(sample).collect::<Vec<_>>())
    }
}

/// Root mean square of the true heave of a point.
pub(crate) fn rms(record: &[Instant], point: usize) -> f64 {
    let sum = record.iter().map(|i| i.truth[point] * i.truth[point]).sum::<f64>();
    (sum / record.len() as f64).sqrt()
}
