//! How the ship stands to a quay: distances, speeds, angle, and when she touches it.
//!
//! With g the gradient of a point's distance d along north, east and down, l its lever from the IMU, P the covariance of the
//! motion at the point ([`Motion::at_point`]) and s_w the 1-sigma of the angular rate about each axis:
//! ```text
//! closing speed   v = -g . v_point
//! var d   = g' P_rr g + b_r^2 + s_q^2
//! var v   = g' P_vv g + b_v^2 + |(C_nb' g) x l|^2 s_w^2
//! cov d,v = -g' P_rv g
//! time    t = d / v,  var t = (var d + t^2 var v - 2 t cov d,v) / v^2
//! ```
//! b is what the solution claims beyond its covariance, of which no more is known than its size along each axis: it is added as
//! if all of it lay along g. s_q is how well the line, its fenders and the points of the ship are known. The rate enters the speed at the end of
//! a lever ([`Motion::at_point`] takes it as known), and its noise is that of the gyros. The angle of the ship to the quay is
//! heading less the bearing of the line, and as sure as the heading. Tests: `sigmas_cover_the_errors_of_ships_that_are_drawn_from_the_covariance`,
//! `what_is_told_of_a_ship_alongside_is_what_a_ruler_says`.

use insd_base::units::wrap_pi;
use insd_base::{Body, Estimate, Integrity, Mode, Motion, MotionCovariance, Protection};
use nalgebra::{Matrix3, Vector3};

use super::config::DockingConfig;
use super::hull::Hull;
use super::quay::{Beside, Quay, QuayAxes};
use super::types::{
    BerthChoice, Contact, Docking, DockingDoubt, DockingPoint, DockingSide, DockingState, HullPart,
    NotDocking,
};

/// Within this of the line a berth is told of, m: there a plane is one to millimetres, and a laser ends long before.
pub(super) const REACH: f64 = 2000.0;
/// A hull all of which is so far behind the line is not at the quay but has its land on the wrong side, m.
const ASHORE: f64 = -5.0;
/// Slower than this nothing comes nearer, m/s.
const STILL: f64 = 0.01;
/// A speed is one towards the quay if it is so many of its sigmas.
const SURE: f64 = 2.0;
/// A contact that is further off in time is none, s.
const SOON: f64 = 3600.0;

/// A point of the hull as it is seen from the quay.
struct Seen {
    beside: Beside,
    distance: Estimate,
    closing: Estimate,
    /// From the first point of the line to the second.
    along: Estimate,
    /// Of distance and closing speed.
    covariance: f64,
    height: Estimate,
}

/// A ship at a quay.
struct View<'a> {
    motion: &'a Motion,
    axes: &'a QuayAxes,
    quay: &'a Quay,
    /// 1-sigma of the angular rate about each axis, rad/s.
    rate_sigma: f64,
}

/// What is told of the berth of this index and axes.
pub(super) fn look(
    motion: &Motion,
    config: &DockingConfig,
    hull: &Hull,
    axes: &QuayAxes,
    (berth, choice): (usize, BerthChoice),
) -> Docking {
    let (time, which) = (motion.solution.time, (berth, choice));
    let Some(quay) = config.berths.get(berth) else {
        return Docking::not_valid(time, which, NotDocking::NoSolution);
    };
    if let Some(why) = refused(motion) {
        return Docking::not_valid(time, which, why);
    }
    if axes.range(&motion.solution.position) > REACH {
        return Docking::not_valid(time, which, NotDocking::Away);
    }
    let view = View { motion, axes, quay, rate_sigma: config.rate_sigma };
    view.docking(config, hull, which)
}

/// Why nothing may be told of a motion.
fn refused(motion: &Motion) -> Option<NotDocking> {
    let own = &motion.solution;
    let is_finite = [&own.position.latitude, &own.position.longitude, &own.attitude.heading]
        .into_iter()
        .chain(own.velocity.0.iter())
        .chain(motion.covariance.iter().flat_map(MotionCovariance::iter))
        .all(|part| part.is_finite());
    match (own.mode, own.judgement.integrity) {
        (Mode::Fault, _) => Some(NotDocking::Fault),
        (_, Integrity::Contradiction) => Some(NotDocking::Contradiction),
        (mode, _) if !mode.is_navigating() => Some(NotDocking::NotNavigating),
        _ if !is_finite => Some(NotDocking::NoSolution),
        _ if motion.covariance.is_none() => Some(NotDocking::NotNavigating),
        _ => None,
    }
}

impl View<'_> {
    fn docking(&self, config: &DockingConfig, hull: &Hull, which: (usize, BerthChoice)) -> Docking {
        let time = self.motion.solution.time;
        let (ahead, side, angle) = self.lie();
        let nearest = |part: HullPart| {
            let seen = hull.sides(part).into_iter().filter_map(|lever| self.seen(&lever));
            seen.min_by(|one, other| one.distance.value.total_cmp(&other.distance.value))
        };
        let parts = HullPart::ALL.map(nearest);
        if let Some(why) = self.behind(&parts) {
            return Docking::not_valid(time, which, why);
        }
        let corners = hull.corners();
        let corners =
            corners.filter_map(|(part, lever)| self.seen(&lever).map(|seen| (part, seen)));
        let told = HullPart::ALL.iter().zip(&parts);
        let contacts = told
            .filter_map(|(part, seen)| Some(self.contact(*part, seen.as_ref()?)))
            .chain(corners.map(|(part, seen)| self.contact(part, &seen)));
        let first = contacts
            .flatten()
            .min_by(|one, other| one.seconds.value.total_cmp(&other.seconds.value));
        let points = parts.map(|seen| seen.map(|seen| self.point(&seen, ahead)));
        let state = self.state(config, &points);
        let (berth, choice) = which;
        let (side, angle) = (Some(side), Some(angle));
        Docking { time, berth, choice, state, points, side, angle, contact: first }
    }

    /// Why nothing is told of a hull that is behind the line, or of which nothing finite is known.
    fn behind(&self, parts: &[Option<Seen>; 3]) -> Option<NotDocking> {
        let all = || parts.iter().flatten();
        let is_beside = |seen: &Seen| (0.0..=self.axes.length).contains(&seen.beside.place);
        if all().any(|seen| seen.distance.value >= ASHORE) {
            None
        } else if all().next().is_none() {
            Some(NotDocking::NoSolution)
        } else if all().any(is_beside) {
            Some(NotDocking::Ashore)
        } else {
            Some(NotDocking::Behind)
        }
    }

    /// Whether ahead is from the first point of the line to the second, as 1 or -1; which side lies to the quay; and the angle
    /// to it.
    fn lie(&self) -> (f64, DockingSide, Estimate) {
        let solution = &self.motion.solution;
        let along = self.axes.beside(&solution.position).along;
        let off = solution.attitude.heading - along.y.atan2(along.x);
        let goes_along = off.cos() >= 0.0;
        let turned = wrap_pi(if goes_along { off } else { off + std::f64::consts::PI });
        // the quay is on the other hand than the water
        let (side, bow_in) = if goes_along == self.axes.has_water_right() {
            (DockingSide::Port, -turned)
        } else {
            (DockingSide::Starboard, turned)
        };
        let angle = Estimate { value: bow_in, sigma: solution.sigma.heading };
        (if goes_along { 1.0 } else { -1.0 }, side, angle)
    }

    /// A point of the hull; `None` where nothing finite comes of it.
    fn seen(&self, lever: &Body) -> Option<Seen> {
        let there = self.motion.at_point(lever);
        let own = &there.solution;
        let beside = self.axes.beside(&own.position);
        let covariance = there.covariance?;
        let part = |row: usize, column: usize| block(&covariance, row, column);
        let g = beside.gradient;
        let c_nb = self.motion.solution.attitude.c_nb();
        let along_arm = |unit: &Vector3<f64>| {
            let by_rate = (c_nb.transpose() * unit).cross(&lever.0) * self.rate_sigma;
            let beyond = beyond(&own.sigma.velocity.0, &part(3, 3), unit);
            (quadratic(unit, &part(3, 3)) + by_rate.norm_squared() + beyond * beyond).sqrt()
        };
        let far = beyond(&own.sigma.position.0, &part(0, 0), &g);
        let sigma = (quadratic(&g, &part(0, 0)) + far * far).sqrt().hypot(self.quay.sigma);
        let seen = Seen {
            beside,
            distance: Estimate { value: beside.distance, sigma },
            closing: Estimate { value: -g.dot(&own.velocity.0), sigma: along_arm(&g) },
            along: Estimate {
                value: beside.along.dot(&own.velocity.0),
                sigma: along_arm(&beside.along),
            },
            covariance: -g.dot(&(part(0, 3) * g)),
            height: Estimate { value: own.position.height, sigma: own.sigma.position.0.z },
        };
        let all = [seen.distance, seen.closing, seen.along, seen.height];
        all.iter().all(|own| own.value.is_finite() && own.sigma.is_finite()).then_some(seen)
    }

    fn point(&self, seen: &Seen, ahead: f64) -> DockingPoint {
        let along = Estimate { value: ahead * seen.along.value, ..seen.along };
        let above = self
            .quay
            .height
            .map(|edge| Estimate { value: seen.height.value - edge, sigma: seen.height.sigma });
        let hidden = self.motion.solution.hidden.horizontal * seen.beside.gradient.norm();
        DockingPoint {
            distance: seen.distance,
            level: Protection::along(seen.distance.sigma) + hidden,
            closing: seen.closing,
            along,
            place: seen.beside.place,
            above,
        }
    }

    /// When a point touches, and how fast, if it surely comes nearer and meets the quay between its ends.
    fn contact(&self, part: HullPart, seen: &Seen) -> Option<Contact> {
        let speed = seen.closing;
        if speed.value <= STILL.max(SURE * speed.sigma) {
            return None;
        }
        let seconds = seen.distance.value.max(0.0) / speed.value;
        let place = seen.beside.place + seconds * seen.along.value;
        if seconds > SOON || !(0.0..=self.axes.length).contains(&place) {
            return None;
        }
        let variance = seen.distance.sigma.powi(2) + (seconds * speed.sigma).powi(2)
            - 2.0 * seconds * seen.covariance;
        let sigma = variance.max(0.0).sqrt() / speed.value;
        Some(Contact { part, speed, seconds: Estimate { value: seconds, sigma } })
    }

    fn state(&self, config: &DockingConfig, points: &[Option<DockingPoint>; 3]) -> DockingState {
        let level = points.iter().flatten().map(|point| point.level).reduce(f64::max);
        let is_beyond = |limit: f64| level.is_some_and(|level| level > limit);
        if self.motion.solution.judgement.integrity == Integrity::Unproven {
            DockingState::Doubtful(DockingDoubt::Unproven)
        } else if config.limits.level.is_some_and(is_beyond) {
            DockingState::Doubtful(DockingDoubt::Level)
        } else {
            DockingState::Valid
        }
    }
}

/// Three rows and columns of a covariance.
fn block(covariance: &MotionCovariance, row: usize, column: usize) -> Matrix3<f64> {
    covariance.fixed_view::<3, 3>(row, column).into_owned()
}

/// Variance along a direction.
fn quadratic(direction: &Vector3<f64>, covariance: &Matrix3<f64>) -> f64 {
    direction.dot(&(covariance * direction)).max(0.0)
}

/// What is claimed beyond a covariance, along a direction.
fn beyond(claimed: &Vector3<f64>, covariance: &Matrix3<f64>, direction: &Vector3<f64>) -> f64 {
    let size =
        claimed.zip_map(&covariance.diagonal(), |all, own| (all * all - own).max(0.0).sqrt());
    size.dot(&direction.abs())
}
