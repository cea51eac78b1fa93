//! What the IMU has turned and gained over an interval.

use insd_base::Time;
use nalgebra::{UnitQuaternion, Vector3};

/// Compensated increments over an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increment {
    /// Start of the interval.
    pub from: Time,
    /// End of the interval.
    pub to: Time,
    /// Rotation vector of the body over the interval, rad (coning compensated).
    pub rotation: Vector3<f64>,
    /// Specific-force integral, m/s (sculling compensated, without the half-angle rotation term).
    pub velocity: Vector3<f64>,
    /// Angular rate at the end of the interval, rad/s, as far as its noise lets it be known
    /// ([`crate::angular_rate`]).
    pub end_rate: Vector3<f64>,
    /// Variance of each component of that, (rad/s)^2.
    pub end_rate_variance: f64,
    /// Change of the angular rate, rad/s^2.
    pub angular_acceleration: Vector3<f64>,
    /// Noise density of the rate beyond the stated random walk, body axes, rad^2/s: of vibration, or of
    /// what bridging a gap gets wrong.
    pub rate_noise: Vector3<f64>,
    /// Noise density of the force beyond the stated random walk, body axes, m^2/s^3.
    pub force_noise: Vector3<f64>,
    /// Length of the gap that it is a part of, s, if it was made up over missing samples.
    pub bridged: Option<f64>,
    /// Temperature of the IMU, degrees Celsius, if it is told.
    pub celsius: Option<f64>,
}

impl Increment {
    /// Length of the interval, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        (self.to - self.from).as_seconds()
    }

    /// It and the one that follows as one, for whoever may go in longer steps; neither is a part of a gap.
    ///
    /// The rotations one after the other, and the velocity that turned by half of both is the sum of what each was turned by
    /// half its own, to the order that [`crate::strapdown::integrate`] keeps. Noise is that of both, by their lengths.
    #[must_use]
    pub fn then(&self, next: &Increment) -> Increment {
        let [first, second] = [self, next].map(|part| UnitQuaternion::new(part.rotation * 0.5));
        let turn = first * first * second * second;
        let rotation = turn.scaled_axis();
        let [own_sum, next_sum] =
            [self, next].map(|part| part.velocity + second_order(&part.rotation, &part.velocity));
        let sum = first * own_sum + first * first * (second * next_sum);
        let velocity = UnitQuaternion::new(rotation * -0.5) * sum;
        let (own, rest) = (self.duration(), next.duration());
        let share = own / (own + rest);
        Increment {
            from: self.from,
            rotation,
            velocity: velocity - second_order(&rotation, &velocity),
            rate_noise: self.rate_noise * share + next.rate_noise * (1.0 - share),
            force_noise: self.force_noise * share + next.force_noise * (1.0 - share),
            ..*next
        }
    }

    /// The part up to an instant inside the interval, and the rest.
    ///
    /// What the rotation over a gap gets wrong counts at its end: what it does to the velocity on the way
    /// is part of what is known of that, and a measurement inside must not take the one for the other.
    #[must_use]
    pub fn split(&self, at: Time) -> (Increment, Increment) {
        let share = (at - self.from).as_seconds() / self.duration();
        let remaining = (self.to - at).as_seconds();
        let (before, after) = match self.bridged {
            Some(_) => (Vector3::zeros(), self.rate_noise / (1.0 - share)),
            None => (self.rate_noise, self.rate_noise),
        };
        let head = Increment {
            to: at,
            rotation: self.rotation * share,
            velocity: self.velocity * share,
            end_rate: self.end_rate - self.angular_acceleration * remaining,
            rate_noise: before,
            ..*self
        };
        let tail = Increment {
            from: at,
            rotation: self.rotation * (1.0 - share),
            velocity: self.velocity * (1.0 - share),
            rate_noise: after,
            ..*self
        };
        (head, tail)
    }
}

/// By what an increment of velocity that is turned by half the rotation of its interval differs from what it is turned by on the
/// way, to the next order: theta x (theta x dv) / 24.
pub(crate) fn second_order(rotation: &Vector3<f64>, velocity: &Vector3<f64>) -> Vector3<f64> {
    rotation.cross(&rotation.cross(velocity)) / 24.0
}
