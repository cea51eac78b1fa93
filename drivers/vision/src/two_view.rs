//! How a camera moved between two images, up to scale, and which points did not move with the world.

use nalgebra::{Matrix5, Rotation3, SMatrix, Unit, Vector3, Vector5};
use rand::{Rng, RngExt};

/// A point of the world in two images: directions in camera axes, `z` of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayPair {
    /// In the earlier image.
    pub from: Vector3<f64>,
    /// In the later one.
    pub to: Vector3<f64>,
}

/// The motion between two images: `x_to = rotation x_from + s direction`, `s` unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoView {
    /// Turns a vector from camera axes of the earlier image to those of the later one.
    pub rotation: Rotation3<f64>,
    /// From the later camera to the earlier one, camera axes of the later image; of either sign until [`Self::facing`] tells.
    pub direction: Unit<Vector3<f64>>,
}

/// Pairs that are drawn to find a direction.
const DRAWS: usize = 60;
/// Points that are drawn to find rotation and direction.
const FIVE: usize = 5;
/// Steps of a refinement.
const STEPS: usize = 4;
/// Of a numeric derivative, rad.
const NUDGE: f64 = 1e-6;
/// Keeps a direction that points do not tell, of the sum of squares, rad^-2 of one point at the error limit.
const DAMPING: f64 = 1e-9;
/// Holds a rotation that is known, likewise.
const HELD: f64 = 1e6;

impl TwoView {
    /// No rotation, a direction along the optical axis.
    #[must_use]
    pub fn ahead() -> Self {
        TwoView { rotation: Rotation3::identity(), direction: -Vector3::z_axis() }
    }

    /// How far a pair is from the epipolar plane: Sampson's distance on the plane `z = 1`, signed (Hartley and Zisserman 2004, eq. 11.9).
    #[must_use]
    pub fn error(&self, pair: &RayPair) -> f64 {
        let turned = self.rotation * pair.from;
        let line_to = self.direction.cross(&turned);
        let line_from = self.rotation.inverse() * pair.to.cross(&self.direction);
        let slope = line_to.xy().norm_squared() + line_from.xy().norm_squared();
        if slope < f64::MIN_POSITIVE { 0.0 } else { pair.to.dot(&line_to) / slope.sqrt() }
    }

    /// Which pairs are within `limit` of their epipolar planes.
    #[must_use]
    pub fn within(&self, pairs: &[RayPair], limit: f64) -> Vec<bool> {
        pairs.iter().map(|pair| self.error(pair).abs() <= limit).collect()
    }

    /// The direction by two points, with the rotation known: of all pairs drawn the one that most agree with, to `limit`.
    pub fn by_two_points(
        pairs: &[RayPair],
        rotation: Rotation3<f64>,
        limit: f64,
        rng: &mut impl Rng,
    ) -> Option<Self> {
        let normal = |pair: &RayPair| (rotation * pair.from).cross(&pair.to);
        let draw = |rng: &mut _| {
            let [a, b] = drawn::<2>(pairs, rng)?;
            let direction = Unit::try_new(normal(&a).cross(&normal(&b)), 1e-15)?;
            Some(TwoView { rotation, direction })
        };
        best(pairs, limit, rng, draw)
    }

    /// Rotation and direction by five points each, from `start` on by least squares: for turns of some degrees.
    pub fn by_five_points(
        pairs: &[RayPair],
        start: &TwoView,
        limit: f64,
        rng: &mut impl Rng,
    ) -> Option<Self> {
        let axes = [start.direction, Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
        let mut count = 0;
        let draw = |rng: &mut _| {
            let five = drawn::<FIVE>(pairs, rng)?;
            count += 1;
            let direction = axes[count % axes.len()];
            Some(TwoView { direction, ..*start }.refined(&five, limit, false))
        };
        best(pairs, limit, rng, draw)
    }

    /// Rotation and direction that make the errors of all pairs least, those beyond `limit` with less weight (Cauchy). A rotation that
    /// is `known` is held: were it not, a ship that passes before a wall would look like a camera that turns.
    #[must_use]
    pub fn refined(mut self, pairs: &[RayPair], limit: f64, known: bool) -> Self {
        for _ in 0..STEPS {
            let Some(step) = self.step(pairs, limit, known) else { break };
            self = self.moved(&step);
        }
        self
    }

    /// With the sign of the direction for which most pairs lie before both cameras.
    #[must_use]
    pub fn facing(mut self, pairs: &[RayPair]) -> Self {
        let side = |pair: &RayPair| {
            // depths by least squares: z_to to = z_from turned + direction
            let turned = self.rotation * pair.from;
            let across = turned.cross(&pair.to);
            -self.direction.cross(&turned).dot(&across).signum()
        };
        if pairs.iter().map(side).sum::<f64>() < 0.0 {
            self.direction = -self.direction;
        }
        self
    }

    /// One step of Gauss and Newton: rotation vector, and two angles of the direction.
    fn step(&self, pairs: &[RayPair], limit: f64, known: bool) -> Option<Vector5<f64>> {
        let nudged: [TwoView; 5] = std::array::from_fn(|i| self.moved(&Vector5::ith(i, NUDGE)));
        let mut normal: Matrix5<f64> = SMatrix::identity() * (DAMPING * pairs.len() as f64);
        for axis in 0..3 {
            normal[(axis, axis)] += if known { HELD * pairs.len() as f64 } else { 0.0 };
        }
        let mut right = Vector5::zeros();
        for pair in pairs {
            let error = self.error(pair);
            let slope = Vector5::from_fn(|i, _| (nudged[i].error(pair) - error) / NUDGE);
            let weight = 1.0 / (1.0 + (error / limit).powi(2));
            normal += slope * slope.transpose() * weight;
            right -= slope * (error * weight);
        }
        normal.cholesky().map(|normal| normal.solve(&right)).filter(|step| step.norm() < 0.5)
    }

    fn moved(&self, step: &Vector5<f64>) -> Self {
        let rotation = Rotation3::new(step.fixed_rows::<3>(0).into_owned()) * self.rotation;
        let across = self.direction.cross(&least_axis(&self.direction)).normalize();
        let along = self.direction.cross(&across);
        let direction =
            Unit::new_normalize(self.direction.into_inner() + across * step[3] + along * step[4]);
        TwoView { rotation, direction }
    }
}

/// The axis that a direction has least of.
fn least_axis(direction: &Vector3<f64>) -> Vector3<f64> {
    Vector3::ith(direction.iamin(), 1.0)
}

/// Different pairs, by chance.
fn drawn<const N: usize>(pairs: &[RayPair], rng: &mut impl Rng) -> Option<[RayPair; N]> {
    if pairs.len() < N {
        return None;
    }
    let mut chosen = [usize::MAX; N];
    for i in 0..N {
        let mut index = rng.random_range(0..pairs.len());
        while chosen[..i].contains(&index) {
            index = (index + 1) % pairs.len();
        }
        chosen[i] = index;
    }
    Some(chosen.map(|index| pairs[index]))
}

/// The draw for which the truncated squares of all errors are least (MSAC, Torr and Zisserman 2000).
fn best<R: Rng>(
    pairs: &[RayPair],
    limit: f64,
    rng: &mut R,
    mut draw: impl FnMut(&mut R) -> Option<TwoView>,
) -> Option<TwoView> {
    let cost = |view: &TwoView| -> f64 {
        pairs.iter().map(|pair| (view.error(pair) / limit).powi(2).min(1.0)).sum()
    };
    let views = (0..DRAWS).filter_map(|_| draw(rng)).map(|view| (cost(&view), view));
    views.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, view)| view)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    use super::*;

    const LIMIT: f64 = 0.002;

    fn truth() -> TwoView {
        let rotation = Rotation3::from_euler_angles(0.02, -0.03, 0.01);
        TwoView { rotation, direction: Unit::new_normalize(Vector3::new(0.3, -0.1, -1.0)) }
    }

    /// Points 5 to 40 m ahead, of which every fourth moves by itself.
    fn pairs(count: usize, rng: &mut Pcg64) -> Vec<RayPair> {
        let view = truth();
        let pair = |i: usize, rng: &mut Pcg64| {
            let z = rng.random_range(5.0..40.0);
            let [x, y] = [0.6, 0.4].map(|side: f64| z * rng.random_range(-side..side));
            let from = Vector3::new(x, y, z);
            let wild = if i % 4 == 3 { Vector3::new(0.0, 0.1 * z, 0.0) } else { Vector3::zeros() };
            let to = view.rotation * from + view.direction.into_inner() + wild;
            RayPair { from: from / from.z, to: to / to.z }
        };
        (0..count).map(|i| pair(i, rng)).collect()
    }

    #[test]
    fn two_points_tell_the_direction_and_who_does_not_follow() {
        let mut rng = Pcg64::seed_from_u64(1);
        let pairs = pairs(120, &mut rng);
        let view = TwoView::by_two_points(&pairs, truth().rotation, LIMIT, &mut rng).unwrap();
        assert!(view.facing(&pairs).direction.angle(&truth().direction) < 1e-3);
        let within = view.within(&pairs, LIMIT);
        let wrong = within.iter().enumerate().filter(|(i, good)| (i % 4 == 3) == **good).count();
        assert!(wrong <= 4, "{wrong}");
    }

    #[test]
    fn five_points_tell_the_rotation_too() {
        let mut rng = Pcg64::seed_from_u64(2);
        let pairs = pairs(120, &mut rng);
        let view = TwoView::by_five_points(&pairs, &TwoView::ahead(), LIMIT, &mut rng).unwrap();
        let view = view.refined(&pairs, LIMIT / 10.0, false).facing(&pairs);
        assert!(view.rotation.angle_to(&truth().rotation) < 1e-3, "{view:?}");
        assert!(view.direction.angle(&truth().direction) < 2e-2, "{view:?}");
    }

    #[test]
    fn a_camera_that_stands_still_refuses_nobody() {
        let mut rng = Pcg64::seed_from_u64(3);
        let still: Vec<RayPair> = pairs(60, &mut rng)
            .iter()
            .map(|pair| RayPair { from: pair.from, to: pair.from })
            .collect();
        let view = TwoView::by_five_points(&still, &TwoView::ahead(), LIMIT, &mut rng).unwrap();
        assert!(view.within(&still, LIMIT).iter().all(|within| *within));
    }

    #[test]
    fn fewer_points_than_are_drawn_tell_nothing() {
        let mut rng = Pcg64::seed_from_u64(4);
        let one = pairs(1, &mut rng);
        assert_eq!(TwoView::by_two_points(&one, Rotation3::identity(), LIMIT, &mut rng), None);
    }
}
