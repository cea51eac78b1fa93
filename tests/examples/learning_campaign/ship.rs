//! Ships of a campaign: a route of their own, and errors of their log, current and gyros that repeat, or none that do.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use insd_base::units::DEG_PER_HOUR;
use insd_base::{Time, Voyage};
use insd_simulator::{Scenario, ScenarioError, simulate};
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal, Uniform};
use rand_pcg::Pcg64;

const VOYAGE: &str = include_str!("voyage.toml");
/// Length of a voyage, s.
const LENGTH: f64 = 7200.0;
/// Period of the tide, s.
const MOON: f64 = 44_714.0;
/// Speed about which the shape of a log is told, m/s.
const MIDDLE: f64 = 6.0;

/// Whether errors repeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// They do.
    Repeating,
    /// Nothing repeats but what every filter knows of: scale factor and turn of the log, biases of the data sheet.
    Control,
}

/// A ship and her voyage.
pub(crate) struct Ship {
    pub(crate) voyage: Voyage,
    /// How her IMU warms up, degrees Celsius: begin, rise, its time constant, s, swing, its period, s.
    warmth: [f64; 5],
}

/// Errors that repeat.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    /// Scale of the log at [`MIDDLE`], its change by the m/s and by its square.
    log: [f64; 3],
    /// Turn of the log, rad, and its change by the m/s; slide, m.
    across: [f64; 3],
    /// Tide: amplitude, m/s, axes' ratio, phase and direction, rad.
    tide: [f64; 4],
    /// Biases of the gyros by the kelvin and its square, rad/s.
    gyro: [Vector3<f64>; 2],
    /// Scale of the yaw gyro, and its change by the sense of the turn.
    yaw: [f64; 2],
}

impl Ship {
    /// The ship of a seed.
    ///
    /// # Errors
    /// The scenario is none.
    pub(crate) fn drawn(kind: Kind, seed: u64) -> Result<Self, ScenarioError> {
        let own = seed + if kind == Kind::Control { 1000 } else { 0 };
        let mut dice = Dice(Pcg64::seed_from_u64(0x5ea5 ^ own << 8));
        let scenario = Scenario::from_toml(&scenario_text(&mut dice))?;
        let warmth = dice.warmth();
        let errors = if kind == Kind::Repeating { dice.errors() } else { Errors::default() };
        let mut ship = Ship { voyage: simulate(&scenario, own), warmth };
        ship.spoil(&errors);
        Ok(ship)
    }

    /// Temperature of her IMU, degrees Celsius.
    pub(crate) fn celsius(&self, time: Time) -> f64 {
        let t = time.as_seconds();
        let [begin, rise, constant, swing, period] = self.warmth;
        begin + rise * (1.0 - (-t / constant).exp()) + swing * (TAU * t / period).sin()
    }

    fn spoil(&mut self, errors: &Errors) {
        self.heat(errors);
        let turns = self.turns();
        let headings: Vec<f64> = self
            .voyage
            .truth
            .iter()
            .map(|own| own.attitude.map_or(0.0, |own| own.heading))
            .collect();
        for log in self.voyage.log.iter_mut().map(|log| &mut log.message) {
            // truth is written once a second
            let second = log.time.as_seconds().round().max(0.0) as usize;
            let (Some(turn), Some(heading)) = (turns.get(second), headings.get(second)) else {
                continue;
            };
            let water = errors.water(log.time.as_seconds());
            let (sin, cos) = heading.sin_cos();
            let (u, v) = (log.u.unwrap_or(0.0), log.v.unwrap_or(0.0));
            let through =
                [u - cos * water[0] - sin * water[1], v + sin * water[0] - cos * water[1]];
            let off = errors.of_log(through[0], *turn);
            (log.u, log.v) = (Some(through[0] + off[0]), Some(through[1] + off[1]));
        }
    }

    fn heat(&mut self, errors: &Errors) {
        let interval = 1.0 / self.voyage.header.imu.rate;
        let warmth: Vec<f64> =
            self.voyage.imu.iter().map(|own| self.celsius(own.message.time) - 30.0).collect();
        let samples = self.voyage.imu.iter_mut().map(|sample| &mut sample.message);
        for (sample, warmth) in samples.zip(warmth) {
            let turn = sample.delta_theta.0.z;
            let bias = (errors.gyro[0] + errors.gyro[1] * warmth) * warmth * interval;
            let scale = errors.yaw[0] * turn + errors.yaw[1] * turn.abs();
            sample.delta_theta.0 += bias + Vector3::z() * scale;
        }
    }

    /// Rate of turn of each second, the mean of eleven, rad/s.
    fn turns(&self) -> Vec<f64> {
        let heading = |i: usize| self.voyage.truth[i].attitude.map_or(0.0, |own| own.heading);
        let last = self.voyage.truth.len().saturating_sub(1);
        let of = |i: usize| {
            let (from, to) = (i.saturating_sub(5), (i + 5).min(last));
            insd_base::units::wrap_pi(heading(to) - heading(from)) / (to - from).max(1) as f64
        };
        (0..=last).map(of).collect()
    }
}

impl Errors {
    /// What a log tells too much, forward and starboard, m/s.
    fn of_log(&self, u: f64, turn: f64) -> [f64; 2] {
        let beyond = u - MIDDLE;
        let [k, by_speed, by_square] = self.log;
        let [m, m_by_speed, slide] = self.across;
        let along = u * (k + by_speed * beyond + by_square * beyond * beyond);
        [along, u * (m + m_by_speed * beyond) + slide * turn]
    }

    /// The tide towards north and east, m/s.
    fn water(&self, t: f64) -> [f64; 2] {
        let [amplitude, ratio, phase, direction] = self.tide;
        let angle = TAU * t / MOON + phase;
        let (along, across) = (amplitude * angle.cos(), amplitude * ratio * angle.sin());
        let (sin, cos) = direction.sin_cos();
        [cos * along - sin * across, sin * along + cos * across]
    }
}

struct Dice(Pcg64);

impl Dice {
    fn normal(&mut self, std: f64) -> f64 {
        let drawn: f64 = StandardNormal.sample(&mut self.0);
        std * drawn
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        Uniform::new(low, high).map_or(low, |range| range.sample(&mut self.0))
    }

    /// Either sign.
    fn sized(&mut self, low: f64, high: f64) -> f64 {
        let size = self.between(low, high);
        if self.between(-1.0, 1.0) < 0.0 { -size } else { size }
    }

    fn warmth(&mut self) -> [f64; 5] {
        [
            self.between(12.0, 26.0),
            self.between(8.0, 18.0),
            self.between(900.0, 2400.0),
            self.between(0.5, 3.0),
            self.between(1500.0, 4000.0),
        ]
    }

    fn errors(&mut self) -> Errors {
        let mut three = |std: f64| Vector3::from_fn(|_, _| self.normal(std));
        let gyro = [three(2.0 * DEG_PER_HOUR), three(0.1 * DEG_PER_HOUR)];
        Errors {
            gyro,
            log: [self.normal(0.02), self.sized(0.003, 0.01), self.normal(0.0005)],
            across: [self.normal(0.01), self.normal(0.001), self.sized(2.0, 6.0)],
            tide: [
                self.between(0.1, 0.4),
                self.between(-0.4, 0.4),
                self.between(0.0, TAU),
                self.between(0.0, TAU),
            ],
            yaw: [self.normal(0.003), self.normal(0.0015)],
        }
    }
}

/// The scenario with the current and the legs of a ship.
fn scenario_text(dice: &mut Dice) -> String {
    let mut text = VOYAGE.replace("CURRENT_STD", &format!("{:.3}", dice.between(0.03, 0.12)));
    text = text.replace("CURRENT_TIME", &format!("{:.0}", dice.between(5400.0, 14_400.0)));
    let (mut at, mut heading) = (0.0, dice.between(0.0, 360.0));
    while at < LENGTH {
        let lasts = dice.between(260.0, 500.0).round();
        heading = (heading + dice.sized(40.0, 140.0)).rem_euclid(360.0);
        let (speed, rate) = (dice.between(7.0, 16.0), dice.between(0.6, 1.2));
        let _ = write!(
            text,
            "[[route.legs]]\nheading_deg = {heading:.0}.0\nspeed_kn = {speed:.1}\nduration_s = {lasts:.1}\nturn_rate_deg_s = {rate:.2}\n"
        );
        at += lasts;
    }
    text
}
