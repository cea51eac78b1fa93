//! The ship's motion in the axes of her own small world: forward, north and east of the chart.
//!
//! Everything here is a closed formula of time. Only the position on the Earth is not; that is
//! found in [`crate::track`] by quadrature of the velocity.

mod jet;
mod path;
mod ramp;
mod seaway;
mod shift;
mod spectrum;

use insd_base::units::DEG;
use rand_pcg::Pcg64;

pub(crate) use jet::Jet;
pub(crate) use path::Path;
pub(crate) use ramp::length_for_slope;
use seaway::{Exposure, Seaway};
pub(crate) use seaway::{SeaMotion, Swing};
use shift::Shifts;

use crate::random::{Purpose, stream};
use crate::scenario::{Scenario, Sea, Ship};

/// Standard gravity for the heel in turns, m/s^2.
const GRAVITY: f64 = 9.81;

/// Displacement, velocity and attitude in chart axes `g` (chart north, chart east, down), at the IMU.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalMotion {
    /// Displacement from the guidance path, north, east, up, m.
    pub(crate) displacement: [f64; 3],
    /// Velocity north, east, down, m/s, as functions whose `rate` is the acceleration.
    pub(crate) velocity: [Jet; 3],
    /// Roll, rad (its second derivative is not complete).
    pub(crate) roll: Jet,
    /// Pitch, rad.
    pub(crate) pitch: Jet,
    /// Heading from chart north, rad, unwrapped.
    pub(crate) yaw: Jet,
}

/// The ship on her guidance path and in the sea.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    ship: Ship,
    path: Path,
    /// One for each stage of the path.
    seaways: Vec<Seaway>,
    exposure: Exposure,
    shifts: Shifts,
}

impl Motion {
    /// The motion of a scenario under a seed, which decides the phases of the waves.
    pub(crate) fn new(scenario: &Scenario, seed: u64) -> Self {
        let path = Path::new(&scenario.route, scenario.ship.course_lag_s);
        let seaways = match &scenario.sea {
            Some(sea) => seaways(&scenario.ship, sea, &path, seed),
            None => vec![Seaway::default(); path.stages().len()],
        };
        let points = scenario.sea.as_ref().map_or(&[][..], |sea| &sea.exposure);
        let shifts = scenario.sea.as_ref().map_or(&[][..], |sea| &sea.shifts);
        Motion {
            ship: scenario.ship,
            path,
            seaways,
            exposure: Exposure::new(points),
            shifts: Shifts::new(shifts),
        }
    }

    /// The guidance path.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Standard deviation of the sway about the berth at time `t`, s, of each horizontal axis, m.
    pub(crate) fn sway_std(&self, t: f64) -> f64 {
        let seaway = self.seaways.get(self.path.stage_index(t));
        seaway.map_or(0.0, Seaway::horizontal_std) * self.exposure.at(t).value
    }

    /// Surge and sway about the berth as seen at time `t`, s: in the moorings, in the waves.
    pub(crate) fn swings(&self, t: f64) -> [[Swing; 2]; 2] {
        let factor = self.exposure.at(t).value;
        let seaway = self.seaways.get(self.path.stage_index(t));
        let scaled = |swing: Swing| Swing { std: swing.std * factor, ..swing };
        let axes = |of: fn(&Seaway, usize) -> Swing| {
            [0, 1].map(|axis| seaway.map_or(Swing::default(), |sea| scaled(of(sea, axis))))
        };
        [axes(Seaway::mooring), axes(Seaway::waves)]
    }

    /// The motion at time `t`, s.
    #[cfg(test)]
    pub(crate) fn at(&self, t: f64) -> LocalMotion {
        self.with_sea(t, &self.sea(t))
    }

    /// The motion at time `t`, s, when that in the waves and moorings is `sea`.
    pub(crate) fn with_sea(&self, t: f64, sea: &SeaMotion) -> LocalMotion {
        let guidance = self.path.at(t);
        let (sin_h, cos_h) = guidance.heading.sin_cos();
        let north = sea.surge * cos_h - sea.sway * sin_h;
        let east = sea.surge * sin_h + sea.sway * cos_h;
        let (sin_c, cos_c) = guidance.course.sin_cos();
        let heel = guidance.speed * guidance.turn_rate * (-self.ship.heel_gain / GRAVITY);
        LocalMotion {
            displacement: [north.value, east.value, sea.heave.value],
            velocity: [
                guidance.speed * cos_c + derivative(north),
                guidance.speed * sin_c + derivative(east),
                -derivative(sea.heave),
            ],
            roll: sea.roll + heel,
            pitch: sea.pitch,
            yaw: guidance.heading + sea.yaw,
        }
    }

    /// The motion in waves and moorings at time `t`, s, with the shifts on the latter.
    pub(crate) fn sea(&self, t: f64) -> SeaMotion {
        self.shifts.added_to(self.swell(t), t)
    }

    fn swell(&self, t: f64) -> SeaMotion {
        let index = self.path.stage_index(t);
        let Some(seaway) = self.seaways.get(index) else { return SeaMotion::default() };
        let steady = seaway.at(t);
        let change = &self.path.stages()[index].change;
        let blended = match index.checked_sub(1).map(|before| &self.seaways[before]) {
            Some(before) if t < change.end() => {
                let (old, new) = change.blend(t);
                steady.blend(new, &before.at(t), old)
            }
            _ => steady,
        };
        blended.scaled(self.exposure.at(t))
    }
}

/// The derivative of a jet, with its own first derivative.
fn derivative(jet: Jet) -> Jet {
    Jet { value: jet.rate, rate: jet.accel, accel: 0.0 }
}

fn seaways(ship: &Ship, sea: &Sea, path: &Path, seed: u64) -> Vec<Seaway> {
    let waves = spectrum::sea_surface(
        sea.significant_height(),
        sea.peak_period(),
        sea.gamma,
        sea.spreading_deg * DEG,
        usize::from(sea.components),
        &mut stream(seed, Purpose::Sea),
    );
    let mut mooring: Pcg64 = stream(seed, Purpose::Mooring);
    let of_stage = |stage: &path::Stage| {
        let mut seaway = Seaway::new(ship, &waves, sea.from_deg * DEG, stage.steady);
        if stage.moored {
            seaway.add_mooring(sea, &mut mooring);
        }
        seaway
    };
    path.stages().iter().map(of_stage).collect()
}

#[cfg(test)]
mod tests;
