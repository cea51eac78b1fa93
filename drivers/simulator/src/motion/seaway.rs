//! How the ship moves in the waves: linear responses of six degrees of freedom to each component.

use std::f64::consts::{PI, TAU};

use nalgebra::Complex;
use rand_pcg::Pcg64;

use insd_base::units::DEG;

use super::jet::Jet;
use super::ramp::Ramp;
use super::spectrum::Wave;
use crate::random::uniform;
use crate::scenario::{ExposurePoint, Sea, Ship};

/// Gravity for the dispersion of deep-water waves, m/s^2.
const GRAVITY: f64 = 9.81;
/// Share of the wave slope that excites roll; waves that the beam averages out excite less.
const ROLL_SLOPE: f64 = 0.7;
/// Yaw over wave slope in quartering seas.
const YAW_SLOPE: f64 = 0.4;
/// Components of each slow mooring motion, spread evenly in frequency over the band of the moorings.
const MOORING_COMPONENTS: usize = 10;

/// The six degrees of freedom in this order: surge, sway, heave (m, forward, starboard, up), roll,
/// pitch, yaw (rad, starboard down, bow up, bow to starboard).
const DEGREES: usize = 6;

/// Displacement from the mean path and turn from the mean heading, due to waves and moorings.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SeaMotion {
    /// Forward, m.
    pub(crate) surge: Jet,
    /// Starboard, m.
    pub(crate) sway: Jet,
    /// Up, m.
    pub(crate) heave: Jet,
    /// Starboard down, rad.
    pub(crate) roll: Jet,
    /// Bow up, rad.
    pub(crate) pitch: Jet,
    /// Bow to starboard, rad.
    pub(crate) yaw: Jet,
}

impl SeaMotion {
    /// Weighted sum of two motions.
    pub(crate) fn blend(&self, weight: Jet, other: &Self, other_weight: Jet) -> Self {
        self.combine(other, |a, b| a * weight + b * other_weight)
    }

    /// The motion at the fraction `x` of the way from `before` to `after`, `length` s later.
    pub(crate) fn between(before: &Self, after: &Self, length: f64, x: f64) -> Self {
        before.combine(after, |a, b| Jet::between(a, b, length, x))
    }

    fn combine(&self, other: &Self, of: impl Fn(Jet, Jet) -> Jet) -> Self {
        SeaMotion {
            surge: of(self.surge, other.surge),
            sway: of(self.sway, other.sway),
            heave: of(self.heave, other.heave),
            roll: of(self.roll, other.roll),
            pitch: of(self.pitch, other.pitch),
            yaw: of(self.yaw, other.yaw),
        }
    }

    /// The motion under a changing exposure.
    pub(crate) fn scaled(&self, factor: Jet) -> Self {
        self.combine(self, |motion, _| motion * factor)
    }
}

/// A sinusoid in all degrees of freedom: Re(response e^(i (omega t + phase))).
#[derive(Clone, Copy, Debug)]
struct Component {
    omega: f64,
    phase: f64,
    /// Factor of the cosine.
    cosine: [f64; DEGREES],
    /// Factor of the sine.
    sine: [f64; DEGREES],
    /// Whether it is slow motion in the moorings, not in a wave.
    is_mooring: bool,
}

/// The stationary motion of the ship on one heading at one speed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seaway(Vec<Component>);

/// Direction and speed for which a seaway holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heading {
    /// Heading of the hull, rad.
    pub(crate) heading: f64,
    /// Course, rad.
    pub(crate) course: f64,
    /// Speed, m/s.
    pub(crate) speed: f64,
}

/// What is known of a stationary oscillation of one axis without knowing its phases.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Swing {
    /// Standard deviation, m.
    pub(crate) std: f64,
    /// Mean angular frequency m1 / m0 of its spectrum, rad/s; 0 if it has no power.
    pub(crate) omega: f64,
}

impl Seaway {
    /// The response of `ship` to `waves` that come, on average, from `from`, rad.
    pub(crate) fn new(ship: &Ship, waves: &[Wave], from: f64, heading: Heading) -> Self {
        Seaway(waves.iter().map(|wave| respond(ship, wave, from, heading)).collect())
    }

    /// Adds slow surge, sway and yaw of a ship in her moorings.
    pub(crate) fn add_mooring(&mut self, sea: &Sea, rng: &mut Pcg64) {
        let (sway, yaw) = (sea.mooring_sway(), sea.mooring_yaw_deg() * DEG);
        for (degree, std) in [(0, sway), (1, sway), (5, yaw)] {
            let amplitude = std * (2.0 / MOORING_COMPONENTS as f64).sqrt();
            for band in 0..MOORING_COMPONENTS {
                let share = (band as f64 + uniform(rng, 0.0, 1.0)) / MOORING_COMPONENTS as f64;
                let [fast, slow] = sea.mooring_period_s.map(|period| TAU / period);
                let mut cosine = [0.0; DEGREES];
                cosine[degree] = amplitude;
                self.0.push(Component {
                    omega: slow + share * (fast - slow),
                    phase: uniform(rng, 0.0, TAU),
                    cosine,
                    sine: [0.0; DEGREES],
                    is_mooring: true,
                });
            }
        }
    }

    /// Standard deviation of the horizontal displacement, root mean square of surge and sway, m.
    pub(crate) fn horizontal_std(&self) -> f64 {
        let power = |c: &Component| -> f64 {
            (0..2).map(|d| c.cosine[d].powi(2) + c.sine[d].powi(2)).sum::<f64>() / 2.0
        };
        (self.0.iter().map(power).sum::<f64>() / 2.0).sqrt()
    }

    /// The motion in the waves of one horizontal axis: 0 surge, 1 sway.
    pub(crate) fn waves(&self, axis: usize) -> Swing {
        self.swing(axis, |component| !component.is_mooring)
    }

    /// The slow motion in the moorings of one horizontal axis: 0 surge, 1 sway.
    pub(crate) fn mooring(&self, axis: usize) -> Swing {
        self.swing(axis, |component| component.is_mooring)
    }

    fn swing(&self, axis: usize, of_kind: impl Fn(&Component) -> bool) -> Swing {
        let power = |c: &Component| (c.cosine[axis].powi(2) + c.sine[axis].powi(2)) / 2.0;
        let chosen = self.0.iter().filter(|component| of_kind(component));
        let (m0, m1) = chosen.fold((0.0, 0.0), |(m0, m1), component| {
            (m0 + power(component), m1 + power(component) * component.omega.abs())
        });
        Swing { std: m0.sqrt(), omega: if m0 > 0.0 { m1 / m0 } else { 0.0 } }
    }

    /// The motion at time `t`, s.
    pub(crate) fn at(&self, t: f64) -> SeaMotion {
        let mut value = [0.0; DEGREES];
        let mut rate = [0.0; DEGREES];
        let mut accel = [0.0; DEGREES];
        for component in &self.0 {
            let (s, c) = (component.omega * t + component.phase).sin_cos();
            let (ws, wc) = (component.omega * s, component.omega * c);
            let omega_sq = component.omega * component.omega;
            for d in 0..DEGREES {
                let now = component.cosine[d] * c + component.sine[d] * s;
                value[d] += now;
                rate[d] += component.sine[d] * wc - component.cosine[d] * ws;
                accel[d] -= omega_sq * now;
            }
        }
        let jet = |d: usize| Jet { value: value[d], rate: rate[d], accel: accel[d] };
        SeaMotion {
            surge: jet(0),
            sway: jet(1),
            heave: jet(2),
            roll: jet(3),
            pitch: jet(4),
            yaw: jet(5),
        }
    }
}

/// The response to one wave of elevation a cos(phi) at the ship, phi = omega_e t + phase.
///
/// With mu the direction of propagation relative to the heading (0 = following), k = omega^2/g and
/// the frequency of encounter omega_e = omega - k V cos(mu_course):
///
/// - surge and sway follow the water particles, a sin(phi) along the direction of propagation;
/// - heave follows the elevation, pitch and yaw the slope k a sin(phi);
/// - all of these times W, the average of the wave over the hull:
///   W = exp(-k T/2) exp(-((k L cos(mu)/2)^2 + (k B sin(mu)/2)^2) / 6),
///   the Smith effect for draught T and, to second order, the sinc of a box of length L and beam B
///   (the shape of Jensen, Mansour and Olsen, Ocean Engineering 31 (2004), without its zeros);
/// - roll is a second-order resonance driven by the slope across the beam,
///   1 / (1 - r^2 + 2 i zeta r), r = omega_e / omega_roll
///   (Faltinsen, Sea Loads on Ships and Offshore Structures, chapter 3).
fn respond(ship: &Ship, wave: &Wave, from: f64, to: Heading) -> Component {
    let propagation = from + wave.direction + PI;
    let k = wave.omega * wave.omega / GRAVITY;
    let encounter = wave.omega - k * to.speed * (propagation - to.course).cos();
    let (sin_mu, cos_mu) = (propagation - to.heading).sin_cos();
    let along = k * ship.length_m * cos_mu / 2.0;
    let across = k * ship.beam_m * sin_mu / 2.0;
    let hull = (-k * ship.draught_m / 2.0 - (along * along + across * across) / 6.0).exp();

    let elevation = Complex::new(wave.amplitude, 0.0);
    let in_sine = elevation * Complex::new(0.0, -1.0);
    let r = encounter * ship.roll_period_s / TAU;
    let resonance = 1.0 / Complex::new(1.0 - r * r, 2.0 * ship.roll_damping * r);
    let roll_hull = (-k * ship.draught_m / 2.0 - across * across / 6.0).exp();
    let response = [
        in_sine * (cos_mu * hull),
        in_sine * (sin_mu * hull),
        elevation * hull,
        -in_sine * (k * sin_mu * ROLL_SLOPE * roll_hull) * resonance,
        in_sine * (k * cos_mu * hull),
        in_sine * (k * sin_mu * cos_mu * YAW_SLOPE * hull),
    ];
    Component {
        omega: encounter,
        phase: wave.phase,
        cosine: response.map(|z| z.re),
        sine: response.map(|z| -z.im),
        is_mooring: false,
    }
}

/// The exposure to the sea as a smooth function of time.
#[derive(Clone, Debug)]
pub(crate) struct Exposure {
    first: f64,
    changes: Vec<Ramp>,
}

impl Exposure {
    /// From points in order of time; 1 if there are none.
    pub(crate) fn new(points: &[ExposurePoint]) -> Self {
        let change = |pair: &[ExposurePoint]| Ramp {
            start: pair[0].at_s,
            length: pair[1].at_s - pair[0].at_s,
            height: pair[1].factor - pair[0].factor,
        };
        Exposure {
            first: points.first().map_or(1.0, |point| point.factor),
            changes: points.windows(2).map(change).collect(),
        }
    }

    /// The factor at time `t`, s.
    pub(crate) fn at(&self, t: f64) -> Jet {
        self.changes.iter().map(|ramp| ramp.at(t)).fold(Jet::constant(self.first), |a, b| a + b)
    }
}
