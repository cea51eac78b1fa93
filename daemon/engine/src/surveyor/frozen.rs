//! Receivers, logs and compasses that stand still: they tell the same while the ship has moved.
//!
//! Equal numbers alone mean little: a ship at her berth is where she was. So a run of them counts when the
//! solution has moved, since it began, by more than the sensor's digits and errors explain. Of a log, a compass and the velocity
//! of a receiver it counts, too, when it is many times longer than any before while GNSS or a log has her under way: noise ends them.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{
    ExternalReference, Frozen, GnssFix, LogVelocity, Mode, Party, Rejection, Solution, earth,
};
use nalgebra::{Vector2, Vector3};

/// A sensor is believed again after so many different numbers in a row.
const FORGIVEN: u32 = 10;
/// How many equal numbers make a run, and by how much the solution must have moved since: position, m, and
/// besides so many seconds of way, as a receiver may repeat its last fix; velocities, m/s; heading, rad.
const FIXES: u32 = 4;
const PLACE: f64 = 15.0;
const REPEATED: f64 = 1.5;
const VELOCITIES: u32 = 10;
const SPEED: f64 = 0.8;
const FEW: u32 = 4;
const LOGS: u32 = 20;
const WAY: f64 = 0.6;
const HEADINGS: u32 = 20;
const TURN: f64 = 2.0 * DEG;
/// Times the longest run before, after so many of them, at a speed of more than this, m/s.
const LONGER: u32 = 5;
const RUNS: u32 = 50;
const UNDER_WAY: f64 = 1.0;

/// What the solution was when a run began counts for so many of its sigmas less, and anew when it has become so much surer: after
/// an outage it comes to where she is, which is no way of hers.
const SURELY: f64 = 3.0;
const SURER: f64 = 0.5;

/// What the solution is.
#[derive(Clone, Copy, Debug)]
struct Seen {
    value: Vector3<f64>,
    /// 1-sigma.
    std: f64,
}

impl Seen {
    fn position(solution: &Solution) -> Self {
        let std = solution.sigma.position.0.xy().norm();
        Seen { value: earth::ecef(&solution.position).0, std }
    }

    fn velocity(solution: &Solution) -> Self {
        Seen { value: solution.velocity.0, std: solution.sigma.velocity.0.xy().norm() }
    }

    fn heading(solution: &Solution) -> Self {
        let value = Vector3::new(solution.attitude.heading, 0.0, 0.0);
        Seen { value, std: solution.sigma.heading }
    }
}

/// A run of equal numbers.
#[derive(Clone, Copy, Debug)]
struct Run<const N: usize> {
    told: [f64; N],
    count: u32,
    /// The solution when it began.
    begun: Option<Seen>,
    differing: u32,
    /// Length of the run before; how many there were under way, and the longest of them.
    ended: u32,
    runs: u32,
    longest: u32,
    frozen: bool,
}

impl<const N: usize> Default for Run<N> {
    fn default() -> Self {
        Run {
            told: [f64::NAN; N],
            count: 0,
            begun: None,
            differing: 0,
            ended: 0,
            runs: 0,
            longest: 0,
            frozen: false,
        }
    }
}

impl<const N: usize> Run<N> {
    /// Takes what is told, and what the solution is like; `apart` says how far that is from another.
    fn see(
        &mut self,
        told: [f64; N],
        now: Option<Seen>,
        [enough, moved]: [f64; 2],
        apart: impl Fn(&Vector3<f64>, &Vector3<f64>) -> f64,
    ) {
        if told != self.told {
            let differing = self.differing.saturating_add(1);
            let frozen = self.frozen && differing < FORGIVEN;
            let ended = self.count;
            *self = Run { told, count: 1, begun: now, differing, frozen, ended, ..*self };
            return;
        }
        (self.count, self.differing) = (self.count.saturating_add(1), 0);
        let is_surer = |begun: &Seen| now.is_some_and(|now| now.std < SURER * begun.std);
        self.begun = self.begun.filter(|begun| !is_surer(begun)).or(now);
        let has_moved = self.begun.zip(now).is_some_and(|(begun, now)| {
            apart(&begun.value, &now.value) > moved + SURELY * begun.std
        });
        self.frozen |= f64::from(self.count) >= enough && has_moved;
    }

    /// While she is under way the lengths of the runs tell, too.
    fn compare(&mut self, way: Way, enough: u32) {
        match way {
            Way::Unsure => {}
            Way::LiesStill => self.count = self.count.min(1),
            Way::Going if self.count == 1 => {
                self.runs = self.runs.saturating_add(1);
                if !self.frozen {
                    self.longest = self.longest.max(self.ended);
                }
            }
            Way::Going => {
                let is_long = self.count > enough.max(LONGER * self.longest);
                self.frozen |= self.runs >= RUNS && is_long;
            }
        }
    }
}

/// Whether she goes, and whether somebody else than gyros and accelerometers says so.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    LiesStill,
    Going,
    Unsure,
}

impl Way {
    fn of(solution: Option<&Solution>) -> Self {
        let moving = solution.filter(|solution| solution.velocity.0.xy().norm() > UNDER_WAY);
        match moving.map(|solution| solution.mode) {
            None => Way::LiesStill,
            Some(Mode::Aided | Mode::DeadReckoning) => Way::Going,
            Some(_) => Way::Unsure,
        }
    }
}

/// All that may stand still.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StandingStill {
    position: Run<2>,
    velocity: Run<2>,
    log: Run<2>,
    heading: Run<1>,
    known: [bool; 3],
}

impl StandingStill {
    /// Sees a fix beside the newest solution.
    pub(super) fn hear_fix(&mut self, fix: &GnssFix, solution: Option<&Solution>) {
        let speed = solution.map_or(0.0, |solution| solution.velocity.0.xy().norm());
        if let Some(place) = fix.position {
            let now = solution.map(Seen::position);
            let moved = PLACE + REPEATED * speed;
            let told = [place.latitude, place.longitude];
            self.position.see(told, now, [f64::from(FIXES), moved], |a, b| (a - b).norm());
        }
        if let Some(velocity) = fix.velocity {
            let now = solution.map(Seen::velocity);
            let told = [velocity.0.x, velocity.0.y];
            let apart = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).xy().norm();
            self.velocity.see(told, now, [f64::from(VELOCITIES), SPEED], apart);
            self.velocity.compare(Way::of(solution), FEW);
        }
    }

    /// The same of a log, `at_log` what it should tell.
    pub(super) fn hear_log(
        &mut self,
        log: &LogVelocity,
        at_log: Option<Vector3<f64>>,
        solution: Option<&Solution>,
    ) {
        let told = [log.u, log.v].map(Option::unwrap_or_default);
        let apart = |a: &Vector3<f64>, b: &Vector3<f64>| {
            let way: Vector2<f64> = (a - b).xy();
            if log.v.is_some() { way.norm() } else { way.x.abs() }
        };
        let now = at_log
            .zip(solution)
            .map(|(value, solution)| Seen { value, ..Seen::velocity(solution) });
        self.log.see(told, now, [f64::from(LOGS), WAY], apart);
        self.log.compare(Way::of(solution), LOGS);
    }

    /// The same of a heading.
    pub(super) fn hear_heading(
        &mut self,
        reference: &ExternalReference,
        solution: Option<&Solution>,
    ) {
        let Some(heading) = reference.heading else { return };
        let now = solution.map(Seen::heading);
        let apart = |a: &Vector3<f64>, b: &Vector3<f64>| wrap_pi(a.x - b.x).abs();
        self.heading.see([heading], now, [f64::from(HEADINGS), TURN], apart);
        self.heading.compare(Way::of(solution), HEADINGS);
    }

    /// Who stands still and did not when this was asked last.
    pub(super) fn begun(&mut self) -> Option<Party> {
        let now =
            [self.position.frozen || self.velocity.frozen, self.log.frozen, self.heading.frozen];
        let before = std::mem::replace(&mut self.known, now);
        let parties = [Party::Gnss, Party::Log, Party::Heading];
        let mut all = parties.into_iter().zip(now.into_iter().zip(before));
        all.find(|(_, (now, before))| *now && !before).map(|(party, _)| party)
    }

    /// What stands still.
    pub(super) fn all(&self) -> impl Iterator<Item = Frozen> {
        let all = [
            (self.position.frozen, Frozen::Position),
            (self.velocity.frozen, Frozen::Velocity),
            (self.log.frozen, Frozen::Log),
            (self.heading.frozen, Frozen::Heading),
        ];
        all.into_iter().filter(|(is_frozen, _)| *is_frozen).map(|(_, what)| what)
    }

    /// A fix without what stands still: nothing is left of one whose position does.
    pub(super) fn fix(
        &self,
        fix: &GnssFix,
    ) -> (Option<GnssFix>, Option<(&'static str, Rejection)>) {
        if self.position.frozen {
            return (None, Some(("gnss_position", Rejection::Frozen)));
        }
        if self.velocity.frozen && fix.velocity.is_some() {
            let left = GnssFix { velocity: None, velocity_std: None, ..*fix };
            return (Some(left), Some(("gnss_velocity", Rejection::Frozen)));
        }
        (Some(*fix), None)
    }

    pub(super) fn is_fix_frozen(&self) -> bool {
        self.position.frozen
    }

    /// Another receiver is heard from now on.
    pub(super) fn forget_receiver(&mut self) {
        (self.position, self.velocity) = (Run::default(), Run::default());
    }

    pub(super) fn is_log_frozen(&self) -> bool {
        self.log.frozen
    }

    pub(super) fn is_heading_frozen(&self) -> bool {
        self.heading.frozen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn way(run: &mut Run<1>, told: impl Fn(u32) -> f64, moved: impl Fn(u32) -> f64, count: u32) {
        for k in 0..count {
            let now = Some(Seen { value: Vector3::new(moved(k), 0.0, 0.0), std: 0.1 });
            run.see([told(k)], now, [20.0, 1.0], |a, b| (a - b).norm());
        }
    }

    #[test]
    fn equal_numbers_count_only_when_she_has_moved() {
        let mut run = Run::default();
        way(&mut run, |_| 5.0, |k| 0.3 * (f64::from(k) * 0.7).sin(), 500);
        assert!(!run.frozen, "she lies still");
        way(&mut run, |_| 5.0, |k| f64::from(k) * 0.1, 40);
        assert!(run.frozen);
        way(&mut run, f64::from, |k| f64::from(k) * 0.1, 9);
        assert!(run.frozen, "nine numbers are not enough");
        way(&mut run, |k| f64::from(k) + 100.0, |k| f64::from(k) * 0.1, 2);
        assert!(!run.frozen);
    }

    #[test]
    fn numbers_that_change_are_not_frozen_however_far_she_goes() {
        let mut run = Run::default();
        way(&mut run, |k| f64::from(k / 3), f64::from, 300);
        assert!(!run.frozen);
    }

    /// A frozen log has the receiver doubted before it is found out, and is what she goes by then.
    #[test]
    fn a_run_goes_on_while_the_receiver_is_in_doubt() {
        let mut run = Run::default();
        let mut see = |told: f64, way: Way| {
            run.see([told], None, [20.0, 1.0], |a, b| (a - b).norm());
            run.compare(way, 20);
            run.frozen
        };
        assert!(!(0..100).any(|k| see(f64::from(k), Way::Going)));
        assert!(!(0..100).any(|_| see(7.0, Way::LiesStill)), "at rest all numbers are equal");
        assert!(!(0..15).any(|_| see(5.0, Way::Going)));
        assert!(!(0..5).any(|_| see(5.0, Way::Unsure)), "nobody else says that she goes");
        assert!((0..5).any(|_| see(5.0, Way::Going)));
    }

    /// The first is of her own drifting, the second where she is heard to be again.
    #[test]
    fn a_solution_that_comes_back_to_where_she_lies_is_no_way_of_hers() {
        let mut run = Run::default();
        let mut see = |value: f64, std: f64| {
            let now = Some(Seen { value: Vector3::new(value, 0.0, 0.0), std });
            run.see([5.0], now, [20.0, 1.0], |a, b| (a - b).norm());
            run.frozen
        };
        assert!(!(0..30).any(|k| see(200.0 + f64::from(k), 100.0)));
        assert!(!(0..30).any(|_| see(0.0, 0.1)));
        assert!((0..30).any(|k| see(0.1 * f64::from(k), 0.1)), "then she goes");
    }
}
