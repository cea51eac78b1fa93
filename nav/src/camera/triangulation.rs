//! Where a point is that was seen from several places.
//!
//! A first guess is the point nearest to all rays; then inverse depth in the first camera is improved by Gauss-Newton steps, in which one that lies
//! far off counts less (Mourikis and Roumeliotis 2007, appendix; Montiel, Civera and Davison, Unified Inverse Depth Parametrization, RSS 2006).

use insd_base::CameraModel;
use nalgebra::{Matrix3, Vector2, Vector3};

use super::sight::projection;

/// Steps at most.
const STEPS: usize = 8;
/// Smallest change of the direction, tangents, that is worth another step.
const SETTLED: f64 = 1e-7;
/// A point is not nearer, m, and not farther than so many times the way between the places it was seen from.
const NEAREST: f64 = 1.0;
const FARTHEST: f64 = 300.0;
/// Rays from two of the places differ by as much at least, rad.
const PARALLAX: f64 = 0.3 * std::f64::consts::PI / 180.0;
/// What is so many times farther off than most is a mismatch, and than so many sigmas.
const FAR: f64 = 4.0;
const SIGMAS: f64 = 6.0;
/// Fewer places than these tell nothing that can be tested.
pub const FEWEST: usize = 4;

/// A camera in one place: centre, ECEF, m; ECEF to camera axes; what it saw, px.
pub type Placed = (Vector3<f64>, Matrix3<f64>, Vector2<f64>);

/// A point, and who saw it well.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangulated {
    /// ECEF, m.
    pub point: Vector3<f64>,
    /// Which of the places bear it out, in their order.
    pub by: Vec<usize>,
    /// Largest angle between two rays, rad.
    pub parallax: f64,
}

/// Why a point is not anywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfound {
    /// It was seen from too few places, or from places too near to each other.
    Untold,
    /// Nothing at rest is seen so.
    Contradictory,
}

/// Triangulates.
///
/// # Errors
/// Why that cannot be done well.
pub fn triangulate(model: &CameraModel, seen: &[Placed]) -> Result<Triangulated, Unfound> {
    let mut by: Vec<usize> = (0..seen.len()).collect();
    // where as many contradict as agree nobody knows which are right
    while by.len() >= FEWEST && 2 * by.len() > seen.len() {
        let own: Vec<Placed> = by.iter().map(|index| seen[*index]).collect();
        let guess = first_guess(model, &own).ok_or(Unfound::Untold)?;
        let found = improved(model, &own, guess).ok_or(Unfound::Contradictory)?;
        let Some(worst) = mismatch(model, &own, &found) else {
            let parallax = parallax(model, &own);
            let is_sound = is_sound(&own, &found, parallax);
            return is_sound
                .then_some(Triangulated { point: found, by, parallax })
                .ok_or(Unfound::Untold);
        };
        by.remove(worst);
    }
    Err(if by.len() < seen.len() { Unfound::Contradictory } else { Unfound::Untold })
}

/// The point nearest to all rays: sum (I - d d^T) f = sum (I - d d^T) c.
fn first_guess(model: &CameraModel, seen: &[Placed]) -> Option<Vector3<f64>> {
    let origin = seen.first()?.0;
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (centre, c_ce, at) in seen {
        let ray = c_ce.tr_mul(&model.ray(at)).normalize();
        let across = Matrix3::identity() - ray * ray.transpose();
        normal += across;
        right += across * (centre - origin);
    }
    let found = normal.lu().solve(&right)?;
    let (_, c_ce, at) = seen.first()?;
    let depth = (c_ce * found).z;
    // rays that part meet behind the camera: far away as well
    let far = || c_ce.tr_mul(&model.ray(at)) * 100.0;
    Some(origin + if depth > NEAREST { found } else { far() })
}

/// Gauss-Newton of direction and inverse depth in the first camera.
fn improved(model: &CameraModel, seen: &[Placed], guess: Vector3<f64>) -> Option<Vector3<f64>> {
    let (anchor, c_ce, _) = *seen.first()?;
    let h = c_ce * (guess - anchor);
    let mut x = Vector3::new(h.x / h.z, h.y / h.z, 1.0 / h.z);
    for _ in 0..STEPS {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (centre, own, at) in seen {
            let turn = own * c_ce.transpose();
            let shift = own * (anchor - centre);
            let h = turn * Vector3::new(x.x, x.y, 1.0) + shift * x.z;
            let expected = model.project(&h)?;
            let mut by = turn;
            by.set_column(2, &shift);
            let by_x = projection(model, &h) * by;
            let off = at - expected;
            let weight = 1.0 / (1.0 + off.norm_squared() / (SIGMAS * model.pixel_std).powi(2));
            normal += by_x.tr_mul(&by_x) * weight;
            right += by_x.tr_mul(&off) * weight;
        }
        // a little damping: of what is far away the depth is not told at all
        let damped = normal + Matrix3::from_diagonal(&(normal.diagonal() * 1e-9));
        let step = damped.cholesky()?.solve(&right);
        x += step;
        if step.xy().norm() < SETTLED && step.z.abs() < SETTLED * x.z.abs().max(1e-3) {
            break;
        }
    }
    x.z = x.z.max(1e-6);
    let point = anchor + c_ce.tr_mul(&Vector3::new(x.x, x.y, 1.0)) / x.z;
    point.iter().all(|x| x.is_finite()).then_some(point)
}

/// The place where the point was seen farthest off, if that is a mismatch.
fn mismatch(model: &CameraModel, seen: &[Placed], point: &Vector3<f64>) -> Option<usize> {
    let off = |(centre, c_ce, at): &Placed| {
        let expected = model.project(&(c_ce * (point - centre)));
        expected.map_or(f64::INFINITY, |expected| (at - expected).norm())
    };
    let all: Vec<f64> = seen.iter().map(off).collect();
    let mut sorted = all.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted[sorted.len() / 2];
    let (worst, far) = all.iter().enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    (*far > SIGMAS * model.pixel_std && *far > FAR * usual).then_some(worst)
}

fn parallax(model: &CameraModel, seen: &[Placed]) -> f64 {
    let rays: Vec<Vector3<f64>> =
        seen.iter().map(|(_, c_ce, at)| c_ce.tr_mul(&model.ray(at))).collect();
    let first = rays.first().copied().unwrap_or_default();
    rays.iter().map(|ray| ray.angle(&first)).fold(0.0, f64::max)
}

fn is_sound(seen: &[Placed], point: &Vector3<f64>, parallax: f64) -> bool {
    let origin = seen.first().map_or_else(Vector3::zeros, |(centre, ..)| *centre);
    let way = seen.iter().map(|(centre, ..)| (centre - origin).norm()).fold(0.0, f64::max);
    let depths = seen.iter().map(|(centre, c_ce, _)| (c_ce * (point - centre)).z);
    let is_before = depths.into_iter().all(|depth| depth > NEAREST && depth < FARTHEST * way);
    parallax > PARALLAX && is_before
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::sight::Eye;
    use crate::camera::sight::tests::{model, pose};

    fn seen(offsets: &[(f64, f64)], way: f64) -> (Vector3<f64>, Vec<Placed>) {
        let eye = Eye::new(&model(), &Vector3::zeros(), 0.0);
        let (centre, c_ce) = eye.placed(&pose());
        let point = centre + c_ce.tr_mul(&Vector3::new(2.0, -1.0, 25.0));
        let place = |(index, (across, down)): (usize, &(f64, f64))| {
            let mut moved = pose();
            moved.position += pose().attitude * Vector3::new(way * index as f64, 0.0, 0.0);
            let (centre, c_ce) = eye.placed(&moved);
            let at = eye.sight(&moved, &point).unwrap().at + Vector2::new(*across, *down);
            (centre, c_ce, at)
        };
        (point, offsets.iter().enumerate().map(place).collect())
    }

    #[test]
    fn a_point_seen_without_error_is_found() {
        let (point, seen) = seen(&[(0.0, 0.0); 6], 0.5);
        let found = triangulate(&model(), &seen).unwrap();
        assert!((found.point - point).norm() < 1e-6, "{}", (found.point - point).norm());
        assert_eq!(found.by.len(), 6);
    }

    #[test]
    fn a_mismatch_is_left_out() {
        let mut offsets = [(0.2, -0.3); 8];
        offsets[5] = (60.0, -25.0);
        let (point, seen) = seen(&offsets, 0.5);
        let found = triangulate(&model(), &seen).unwrap();
        assert!(!found.by.contains(&5) && found.by.len() == 7, "{:?}", found.by);
        assert!((found.point - point).norm() < 0.5);
    }

    #[test]
    fn what_was_seen_from_one_place_is_not_anywhere() {
        let (_, seen) = seen(&[(0.0, 0.0); 6], 0.001);
        assert_eq!(triangulate(&model(), &seen), Err(Unfound::Untold));
    }

    #[test]
    fn what_moves_anyhow_is_not_found() {
        let offsets = [(0.0, 0.0), (90.0, 0.0), (0.0, -70.0), (50.0, 90.0), (-80.0, 40.0)];
        assert!(triangulate(&model(), &seen(&offsets, 0.5).1).is_err());
    }
}
