//! One run of the filter, from a start to the next long gap: tick by tick.

use std::collections::VecDeque;

use insd_base::{Span, Time};
use nalgebra::Vector3;

use super::bank::{Bank, Chain, Kick};
use super::history::{History, Raw, ticks};
use super::kernels::Kernels;
use super::model::Model;
use super::point::{Moment, Outputs, Point, Second};
use super::ticker::{Tick, Ticker};
use super::times::{DELAY, LESSON, TICK};

/// Ticks in a second.
const SECOND: usize = 10;
/// Time after which the bank has forgotten with what velocity it started, s.
const CALM: f64 = 200.0;
/// The integral is given a new origin when it exceeds this, m.
const FAR: f64 = 1e5;

/// How the raw displacements move at the last tick.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Track {
    displacement: Raw,
    velocity: Raw,
    /// Change of the velocity over the last tick and over the one before.
    changes: [Raw; 2],
}

/// What is begun anew after a long gap.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub(super) ticker: Ticker,
    pub(super) model: Model,
    ticks: usize,
    track: Track,
    chains: [Chain; 4],
    history: History,
    /// The bank's signals of the last seconds, the oldest first.
    past: VecDeque<Outputs>,
}

impl Run {
    /// Begins at an instant with this direction of down in body axes.
    pub(super) fn new(begin: Time, down_b: Vector3<f64>) -> Self {
        let track = Track {
            displacement: raw(0.0, &down_b),
            velocity: Raw::zeros(),
            changes: [Raw::zeros(); 2],
        };
        Run {
            ticker: Ticker::new(begin, down_b),
            model: Model::new(),
            ticks: 0,
            track,
            chains: [Chain::default(); 4],
            history: History::new(2.0 * DELAY),
            past: VecDeque::with_capacity(LESSON + 1),
        }
    }

    /// Takes one tick.
    pub(super) fn tick(
        &mut self,
        tick: &Tick,
        bank: &Bank,
        kernels: &Kernels,
        points: &mut [Point],
    ) {
        let outputs = self.step(tick, bank);
        self.model.advance(bank);
        self.history.push(self.track.displacement);
        let phase = self.ticks % SECOND;
        if phase == 0 {
            self.remember(&outputs);
        }
        let moment = Moment {
            model: &self.model,
            outputs: &outputs,
            raw: &self.track.displacement,
            share: phase as f64 / SECOND as f64,
            first: self.ticks == 0,
        };
        if phase == 0 {
            let news = self.news(kernels);
            points.iter_mut().for_each(|point| point.second(&moment, &news));
        }
        points.iter_mut().for_each(|point| point.tick(&moment));
        self.ticks += 1;
        self.delay(tick.time, kernels, points);
        if self.track.displacement.x.abs() > FAR {
            self.rebase(points);
        }
    }

    /// Moves the raw displacements on, and the bank with them.
    fn step(&mut self, tick: &Tick, bank: &Bank) -> Outputs {
        let Track { displacement, velocity, changes } = &mut self.track;
        let up = displacement.x + velocity.x * TICK + tick.up.displacement;
        let moved = raw(up, &tick.down_b);
        let mut now = (moved - *displacement) / TICK;
        now.x = velocity.x + tick.up.velocity;
        let change = now - *velocity;
        *displacement = moved;
        *velocity = now;
        *changes = [change, changes[0]];
        let kick = |i: usize| {
            let at_once = Kick { velocity: change[i], displacement: change[i] * TICK };
            if i == 0 { tick.up } else { at_once }
        };
        let mut outputs = Outputs::zeros();
        for (i, chain) in self.chains.iter_mut().enumerate() {
            outputs.set_column(i, &bank.step(chain, kick(i)));
        }
        outputs
    }

    fn remember(&mut self, outputs: &Outputs) {
        if self.past.len() > LESSON {
            self.past.pop_front();
        }
        self.past.push_back(*outputs);
    }

    /// What the turn of a second brings.
    fn news(&self, kernels: &Kernels) -> Second<'_> {
        let ago = ticks(LESSON as f64);
        let average = self.history.average(&kernels.lesson, ago);
        let then = self.history.back(ago).zip(average).map(|(then, average)| then - average);
        let calm = self.model.age() > CALM + LESSON as f64;
        let past = self.past.front().zip(then).filter(|_| calm);
        let slow = self.history.average(&kernels.slow, ticks(DELAY));
        Second { past, lag: LESSON, slow }
    }

    fn delay(&self, time: Time, kernels: &Kernels, points: &mut [Point]) {
        let ago = ticks(DELAY);
        let average = self.history.average(&kernels.delayed, ago);
        if let Some((then, average)) = self.history.back(ago).zip(average) {
            let (time, heave) = (time - Span::from_seconds(DELAY), then - average);
            points.iter_mut().for_each(|p| p.take_delayed(time, &heave, &kernels.expected));
        }
    }

    /// Takes a straight line away from the integral, which would else lose its last digits.
    fn rebase(&mut self, points: &mut [Point]) {
        let (displacement, velocity) = (self.track.displacement.x, self.track.velocity.x);
        self.history.rebase(displacement, velocity);
        points.iter_mut().for_each(|point| point.rebase(displacement, velocity));
        self.track.displacement.x = 0.0;
        self.track.velocity.x = 0.0;
    }

    pub(super) fn has_ticked(&self) -> bool {
        self.ticks > 0
    }

    /// Upward acceleration of the IMU over the last tick, m/s^2.
    pub(super) fn acceleration(&self) -> f64 {
        self.track.changes[0].x / TICK
    }

    /// The raw displacements, their velocities and accelerations now. The displacements follow the IMU;
    /// the direction of down changes along a parabola through the last three ticks.
    pub(super) fn now(&self) -> (Raw, Raw, Raw) {
        let Ticker { filled, up, down_b, .. } = &self.ticker;
        let Track { displacement, velocity, changes: [last, before] } = &self.track;
        let integral = displacement.x + velocity.x * filled + up.displacement;
        let bend = last / TICK;
        let mut rate = velocity + bend * (0.5 * TICK + filled);
        rate.x = velocity.x + up.velocity;
        let mut acceleration = bend;
        let slope = (last.x - before.x) / (TICK * TICK);
        acceleration.x = last.x / TICK + slope * (0.5 * TICK + filled);
        (raw(integral, down_b), rate, acceleration)
    }
}

fn raw(integral: f64, down_b: &Vector3<f64>) -> Raw {
    Raw::new(integral, down_b.x, down_b.y, down_b.z)
}
