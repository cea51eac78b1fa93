//! Line biases that are new and clocks that are free, up to whole wavelengths, by all phases that have them: the middle of what is left of them on a circle of one
//! wavelength, which asks for no integer.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::lines::LineBiases;
use super::model::Model;
use super::pose::CompassPose;
use super::signal::{Common, Heard};

/// Which lines are not known beforehand.
pub(super) struct Loose {
    /// New ones, by their places.
    pub(super) fresh: Vec<bool>,
    /// Clocks that are free.
    pub(super) clocks: usize,
}

/// The middle of phases on a circle.
#[derive(Default)]
struct Middle {
    sin: f64,
    cos: f64,
    wavelength: f64,
}

impl Middle {
    fn add(&mut self, value: f64, wavelength: f64, weight: f64) {
        let (sin, cos) = (value / wavelength * TAU).sin_cos();
        self.sin += weight * sin;
        self.cos += weight * cos;
        self.wavelength = wavelength;
    }

    /// m, at most half a wavelength from nought.
    fn value(&self) -> f64 {
        self.sin.atan2(self.cos) / TAU * self.wavelength
    }
}

/// Takes in lines that are new, and sets all that are loose to the middle of what is left of phases in this pose.
pub(super) fn align(model: &Model<'_>, pose: &CompassPose, lines: &mut LineBiases) -> Loose {
    let fresh = lines.join(&model.keys());
    let clocks = model.clocks(lines);
    let offsets = model.offsets(pose);
    let mut free = 0;
    let mut is_aligned = vec![false; clocks.len()];
    for antenna in 0..offsets.len() {
        for (clock, aligned) in clocks.iter().zip(&mut is_aligned) {
            let known: Vec<usize> =
                clock.places.iter().copied().filter(|place| !fresh[*place]).collect();
            let of_antenna = |place: &usize| lines.keys[*place].antenna == antenna;
            if *aligned || !known.iter().any(of_antenna) {
                continue;
            }
            let is_of = |own: &Heard| lines.place(&own.line).is_some_and(|p| known.contains(&p));
            let chosen = |own: &Heard, against: &Heard| is_of(own) && !is_of(against);
            if let Some(by) = middle(model, antenna, &offsets, lines, &chosen) {
                known.iter().for_each(|place| lines.mean[*place] += by);
                lines.shake(&known);
                *aligned = true;
                free += 1;
            }
        }
        for (place, is_fresh) in fresh.iter().enumerate() {
            let key = lines.keys[place];
            if *is_fresh && key.antenna == antenna {
                let chosen = |own: &Heard, _: &Heard| own.line == key;
                let by = middle(model, antenna, &offsets, lines, &chosen);
                lines.mean[place] += by.unwrap_or(0.0);
            }
        }
    }
    Loose { fresh, clocks: free }
}

/// What is left in the middle of an antenna's phases that are chosen, each against the first antenna that has it.
fn middle(
    model: &Model<'_>,
    antenna: usize,
    offsets: &[Vector3<f64>],
    lines: &LineBiases,
    chosen: &dyn Fn(&Heard, &Heard) -> bool,
) -> Option<f64> {
    let mut middle = Middle::default();
    for common in model.commons {
        let against = &common.heard[0];
        let own = common.heard[1..].iter().find(|own| own.antenna == antenna);
        let Some(own) = own.filter(|own| chosen(own, against)) else { continue };
        let left = model.difference(common, (own, against), offsets, lines);
        middle.add(left, common.wavelength, 1.0 / (own.variance + against.variance));
    }
    (middle.wavelength > 0.0).then(|| middle.value())
}

/// How well phases agree with a pose whatever the integers are, 0 to 1: of each line that is new the length of the mean of its phases on a circle, of those known
/// their part along it.
pub(super) struct Coherence<'a> {
    model: Model<'a>,
    lines: LineBiases,
    fresh: Vec<bool>,
    clocked: Vec<Option<usize>>,
    slots: usize,
}

impl<'a> Coherence<'a> {
    pub(super) fn new(model: Model<'a>, lines: &LineBiases) -> Self {
        let mut lines = lines.clone();
        let fresh = lines.join(&model.keys());
        let clocks = model.clocks(&lines);
        let clock_of = |place: usize| clocks.iter().position(|own| own.places.contains(&place));
        let clocked = (0..fresh.len()).map(clock_of).collect();
        let slots = fresh.len() + clocks.len() + 1;
        Self { model, lines, fresh, clocked, slots }
    }

    /// Where the phases of a line are summed, and whether only their part along the circle's origin counts.
    fn slot(&self, own: &Heard) -> (usize, bool) {
        let known = self.fresh.len();
        match self.lines.place(&own.line) {
            None => (self.slots - 1, true),
            Some(place) if self.fresh[place] => (place, false),
            Some(place) => {
                self.clocked[place].map_or((self.slots - 1, true), |clock| (known + clock, false))
            }
        }
    }

    /// All differences, ready for many poses.
    pub(super) fn prepared(&self) -> Prepared {
        let flat = vec![Vector3::zeros(); self.model.array.antennas()];
        let row = |common: &Common, own: &Heard| {
            let against = &common.heard[0];
            let left = self.model.difference(common, (own, against), &flat, &self.lines);
            let (slot, is_known) = self.slot(own);
            Row {
                cycles: (left / common.wavelength).fract(),
                direction: common.line_of_sight / common.wavelength,
                antennas: (own.antenna, against.antenna),
                weight: 1.0 / (own.variance + against.variance).sqrt(),
                slot,
                is_known,
            }
        };
        let of = |common: &'a Common| common.heard[1..].iter().map(move |own| row(common, own));
        let rows: Vec<Row> = self.model.commons.iter().flat_map(of).collect();
        let sum = rows.iter().map(|row| row.weight).sum();
        Prepared { rows, slots: self.slots, sum }
    }
}

struct Row {
    cycles: f64,
    direction: Vector3<f64>,
    antennas: (usize, usize),
    weight: f64,
    slot: usize,
    is_known: bool,
}

/// Differences of an epoch for poses to be tried on.
pub(super) struct Prepared {
    rows: Vec<Row>,
    slots: usize,
    sum: f64,
}

impl Prepared {
    /// By where the antennas stand.
    pub(super) fn score(&self, offsets: &[Vector3<f64>]) -> f64 {
        let mut sums = vec![(0.0, 0.0); self.slots];
        let mut known = 0.0;
        for row in &self.rows {
            let apart = offsets[row.antennas.0] - offsets[row.antennas.1];
            let (sin, cos) = ((row.cycles + row.direction.dot(&apart)) * TAU).sin_cos();
            if row.is_known {
                known += row.weight * cos;
            } else {
                sums[row.slot].0 += row.weight * sin;
                sums[row.slot].1 += row.weight * cos;
            }
        }
        let free: f64 = sums.iter().map(|(sin, cos)| f64::hypot(*sin, *cos)).sum();
        (known + free) / self.sum.max(f64::MIN_POSITIVE)
    }
}
