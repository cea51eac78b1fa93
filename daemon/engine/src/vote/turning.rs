//! Two IMUs on one hull turn alike, look by look. What makes them turn apart of a sudden shows long before headings
//! are apart by more than is claimed, and often who of the two it was: whose own rate jumped as it never does.
//!
//! How far they are apart ordinarily is learned: biases, axes that are not quite parallel, times that are not quite
//! right, a hull that twists.

use insd_base::Time;
use insd_base::units::DEG;
use nalgebra::Vector3;

use super::compare::{ComparedQuantity, Difference};

/// Rates that are apart by less are no matter, rad/s, look by look and over a second or so; so are so many sigmas of what is
/// usual, and this share of a rate beyond so many sigmas of what is usual.
const FLOORS: [f64; 2] = [0.15 * DEG, 0.05 * DEG];
const SIGMAS: f64 = 8.0;
const SCALE: f64 = 0.03;
const FAST: f64 = 2.0;
/// Sigmas of the mounting.
const ASKEW: f64 = 4.0;
/// Share of a look in the mean over a second or so, and looks in a row that make a difference, in both.
const SHARE: f64 = 0.1;
const IN_A_ROW: [u32; 2] = [2, 5];
/// Looks that make up what is usual, and how many it takes before anything is told.
const USUAL: f64 = 600.0;
const LEAST: f64 = 100.0;
/// Who jumped has made this share of the difference, by so many times what he does ordinarily; the other less than that.
const OWN: f64 = 0.7;
const OTHER: f64 = 0.3;
const UNUSUAL: f64 = 5.0;
/// Looks over which a jump is seen.
const BACK: usize = 2;

/// What the two say at a look.
type Rates = [Option<Vector3<f64>>; 2];

/// What is found at a look.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// By how much the second turns faster, about the axis where that is the most beside what it may be.
    pub(super) apart: Option<Difference>,
    /// Whether they have begun to turn apart.
    pub(super) is_sudden: bool,
    /// Who jumped: 0 or 1.
    pub(super) jumped: Option<usize>,
}

/// What is known of two.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Turning {
    /// How they are apart ordinarily, rad/s.
    mean: Vector3<f64>,
    windows: [Window; 2],
    /// Mean square of the rate itself.
    rate: f64,
    /// Mean square of what each changes by over [`BACK`] looks, ordinarily.
    restless: [Vector3<f64>; 2],
    looks: f64,
    past: [Rates; BACK],
    /// Since when they are apart, the sum of how far at each look since, rad/s, and how many looks.
    excess: Option<(Time, Vector3<f64>, f64)>,
}

/// What is left of how far they are apart, over some looks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Window {
    off: Vector3<f64>,
    square: Vector3<f64>,
    /// Looks in a row at which they were apart.
    apart: u32,
}

impl Window {
    /// What they may be apart by.
    fn limit(&self, floor: f64, askew: f64) -> Vector3<f64> {
        self.square.map(|square| floor.max(SIGMAS * square.sqrt()) + askew)
    }
}

impl Turning {
    /// Looks at both; `mounting` is how well their axes are known to be parallel, 1-sigma, rad.
    pub(super) fn look(&mut self, now: Time, rates: Rates, mounting: f64) -> Found {
        let before = self.past[0];
        self.past.rotate_left(1);
        self.past[BACK - 1] = rates;
        let [Some(one), Some(other)] = rates else {
            self.windows.iter_mut().for_each(|window| window.apart = 0);
            return Found::default();
        };
        let off = other - one - self.mean;
        let rate = one.norm().max(other.norm());
        let askew = (ASKEW * mounting + SCALE) * (rate - FAST * self.rate.sqrt()).max(0.0);
        let is_known = self.looks >= LEAST;
        self.windows[0].off = off;
        self.windows[1].off += (off - self.windows[1].off) * SHARE;
        let mut found = Found::default();
        let changes = change(&rates, &before);
        for (i, window) in self.windows.iter_mut().enumerate() {
            let limit = window.limit(FLOORS[i], askew);
            let axis = window.off.abs().component_div(&limit).imax();
            let (value, limit) = (window.off[axis], limit[axis]);
            let own = Difference { quantity: ComparedQuantity::Turn, value, limit };
            let own = Some(own).filter(|_| is_known);
            let is_apart = own.is_some_and(|own| own.share() > 1.0);
            window.apart = if is_apart { window.apart + 1 } else { 0 };
            found.apart = own
                .filter(|own| found.apart.is_none_or(|it| own.share() > it.share()))
                .or(found.apart);
            if window.apart != IN_A_ROW[i] {
                continue;
            }
            found.is_sudden = true;
            let changes = changes.filter(|_| i == 0).map(|both| both.map(|change| change[axis]));
            found.jumped = changes.and_then(|both| who_jumped(&self.restless, both, axis, value));
        }
        self.sum_up(now, off, found.is_sudden);
        if self.windows.iter().all(|window| window.apart == 0) {
            self.learn(other - one, rate, askew, changes);
        }
        found
    }

    /// Since when they turn apart, and by how much the second turns faster since, rad/s, body axes.
    pub(super) fn excess(&self) -> Option<(Time, Vector3<f64>)> {
        self.excess.map(|(since, sum, looks)| (since, sum / looks))
    }

    /// They are no longer held to turn apart.
    pub(super) fn agree(&mut self) {
        self.excess = None;
    }

    fn sum_up(&mut self, now: Time, off: Vector3<f64>, is_sudden: bool) {
        if let Some((_, sum, looks)) = &mut self.excess {
            *sum += off;
            *looks += 1.0;
        } else if is_sudden {
            self.excess = Some((now, off, 1.0));
        }
    }

    fn learn(
        &mut self,
        apart: Vector3<f64>,
        rate: f64,
        askew: f64,
        changes: Option<[Vector3<f64>; 2]>,
    ) {
        self.looks += 1.0;
        let weight = 1.0 / self.looks.min(USUAL);
        self.rate += (rate * rate - self.rate) * weight;
        let most = self.windows[0].limit(FLOORS[0], askew);
        self.mean += clamped(&(apart - self.mean), &most) * weight;
        for (window, floor) in self.windows.iter_mut().zip(FLOORS) {
            let off = clamped(&window.off, &window.limit(floor, askew));
            window.square += (off.component_mul(&off) - window.square) * weight;
        }
        for (usual, change) in self.restless.iter_mut().zip(changes.iter().flatten()) {
            *usual += (change.component_mul(change) - *usual) * weight;
        }
    }
}

fn who_jumped(
    restless: &[Vector3<f64>; 2],
    changes: [f64; 2],
    axis: usize,
    off: f64,
) -> Option<usize> {
    let share = changes.map(|change| (change / off).abs());
    let is_guilty = |own: usize| {
        let usual = restless[own][axis].sqrt();
        share[own] > OWN && share[1 - own] < OTHER && changes[own].abs() > UNUSUAL * usual
    };
    (0..2).find(|own| is_guilty(*own))
}

/// What each has changed by.
fn change(now: &Rates, before: &Rates) -> Option<[Vector3<f64>; 2]> {
    let of = |own: usize| Some(now[own]? - before[own]?);
    Some([of(0)?, of(1)?])
}

fn clamped(off: &Vector3<f64>, most: &Vector3<f64>) -> Vector3<f64> {
    off.zip_map(most, |off, most| off.clamp(-most, most))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is found at each look of two IMUs on a rolling hull, the second 0.3 deg askew, with noise of their own; `wrong` adds to
    /// what the first says from the 300th look on, rad/s.
    fn looks(wrong: impl Fn(f64, Vector3<f64>) -> Vector3<f64>) -> (Turning, Vec<Found>) {
        let mut turning = Turning::default();
        let mut found = Vec::new();
        for look in 0..400_u32 {
            let t = f64::from(look) * 0.1;
            let wave = |i: usize, k: f64| (t * t * (3.1 + k) + t * (7.7 + i as f64)).sin();
            let noise = |k: f64| Vector3::from_fn(|i, _| wave(i, k));
            let (roll, pitch) = ((0.7 * t).cos() * 2.8 * DEG, (0.9 * t).sin() * 0.9 * DEG);
            let hull = Vector3::new(roll, pitch, 0.05 * DEG * (0.3 * t).sin());
            let askew = nalgebra::Rotation3::new(Vector3::new(0.0, 0.0, 0.3 * DEG));
            let one = hull + noise(0.0) * 0.01 * DEG;
            let one = if look < 300 { one } else { wrong(t - 30.0, one) };
            let other = askew * hull + noise(5.0) * 0.01 * DEG;
            let now = Time::from_seconds(t);
            found.push(turning.look(now, [Some(one), Some(other)], 0.1 * DEG));
        }
        (turning, found)
    }

    fn sudden(found: &[Found]) -> Option<usize> {
        found.iter().position(|own| own.is_sudden)
    }

    #[test]
    fn who_jumps_is_found_at_the_next_look() {
        for rate in [1.0, -0.6] {
            let (turning, found) = looks(|_, own| own + Vector3::new(0.0, 0.0, rate * DEG));
            assert_eq!(sudden(&found), Some(301));
            assert_eq!(found[301].jumped, Some(0));
            let (since, excess) = turning.excess().unwrap();
            assert_eq!(since, Time::from_seconds(30.1));
            assert!((excess.z + rate * DEG).abs() < 0.02 * DEG, "{}", excess.z / DEG);
        }
    }

    #[test]
    fn a_slow_turn_apart_is_found_within_a_second_and_names_nobody() {
        let (turning, found) = looks(|_, own| own + Vector3::new(0.0, 0.0, 0.12 * DEG));
        assert!(sudden(&found).is_some_and(|at| (304..312).contains(&at)), "{:?}", sudden(&found));
        assert!(found.iter().all(|own| own.jumped.is_none()));
        assert!(turning.excess().is_some_and(|(_, excess)| (excess.z / DEG + 0.12).abs() < 0.02));
    }

    #[test]
    fn gyros_that_stand_still_do_not_make_the_others_wrong() {
        let (_, found) = looks(|_, _| Vector3::zeros());
        assert!(sudden(&found).is_some());
        assert!(found.iter().all(|own| own.jumped.is_none()));
    }

    #[test]
    fn what_is_usual_is_no_difference() {
        assert_eq!(sudden(&looks(|_, own| own).1), None);
    }
}
