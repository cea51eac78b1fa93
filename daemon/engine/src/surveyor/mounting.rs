//! Whether the IMU sits as configured: by which way is down, and by which way she goes.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Finding, Solution, Time};
use nalgebra::{Vector2, Vector3};

/// No ship lists like this on the mean, rad.
const LIST: f64 = 25.0 * DEG;
/// Time constant of the mean of down in the axes of the IMU, and how long it must have been seen, s.
const SWELL: f64 = 20.0;
const SEEN: f64 = 20.0;
/// Course and heading are compared above this speed, m/s, below this rate of turn, rad/s, and with a
/// heading so sure, rad.
const UNDER_WAY: f64 = 2.5;
const STEADY: f64 = 0.5 * DEG;
const SURE: f64 = 10.0 * DEG;
/// They must have been compared for so long, s, and the mean forgets with twice that.
const COMPARED: f64 = 120.0;
/// Drift that wind and current do not explain, rad, and share of the time that it must hold for.
const SIDEWAYS: f64 = 60.0 * DEG;
const ALWAYS: f64 = 0.9;

/// Means of what an IMU that is mounted otherwise gets wrong.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mounting {
    last: Option<Time>,
    /// Down in the axes of the ship as configured, and for how long it was seen, s.
    down: Vector3<f64>,
    seen: f64,
    /// Course less heading as a direction, and for how long it was seen, s.
    drift: Vector2<f64>,
    compared: f64,
}

impl Mounting {
    /// Looks at a solution.
    pub(super) fn see(&mut self, solution: &Solution) {
        let elapsed = self.last.map_or(0.0, |last| (solution.time - last).as_seconds());
        self.last = Some(solution.time);
        let elapsed = elapsed.clamp(0.0, 1.0);
        let down = solution.attitude.c_nb().transpose() * Vector3::z();
        if self.seen == 0.0 {
            self.down = down;
        }
        self.down += (down - self.down) * (elapsed / SWELL);
        self.seen += elapsed;
        self.compare(solution, elapsed);
    }

    fn compare(&mut self, solution: &Solution, elapsed: f64) {
        let v = solution.velocity.0;
        let steady = solution.rate.0.z.abs() < STEADY;
        let sure = solution.sigma.heading < SURE && solution.sigma.velocity.0.xy().norm() < 1.0;
        if v.xy().norm() < UNDER_WAY || !steady || !sure {
            return;
        }
        let drift = wrap_pi(v.y.atan2(v.x) - solution.attitude.heading);
        let weight = elapsed / self.compared.clamp(1.0, 2.0 * COMPARED);
        self.drift += (Vector2::new(drift.cos(), drift.sin()) - self.drift) * weight;
        self.compared += elapsed;
    }

    /// How it seems to sit, if otherwise than configured.
    pub(super) fn finding(&self) -> Option<Finding> {
        let lean = self.down.normalize().z.clamp(-1.0, 1.0).acos();
        if self.seen >= SEEN && lean > LIST {
            let (roll, pitch) =
                (self.down.y.atan2(self.down.z), -self.down.x.clamp(-1.0, 1.0).asin());
            return Some(Finding::MountingTilted { roll, pitch });
        }
        let turn = self.drift.y.atan2(self.drift.x);
        let persists = self.compared >= COMPARED && self.drift.norm() > ALWAYS;
        (persists && turn.abs() > SIDEWAYS).then_some(Finding::MountingTurned { turn })
    }
}
