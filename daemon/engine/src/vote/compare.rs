//! How far two engines are apart, and how far they may be by what they claim.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Attitude, Mode, Motion, Solution, SolutionSigma, earth};

/// Differences within so many of their own standard deviations are no disagreement.
const SIGMAS: f64 = 4.0;
/// 1-sigma with which the times of two IMUs are told, s.
const TIMING: f64 = 0.005;
/// What counts for nothing beside what is claimed: angles, rad; velocities, m/s; lengths, m.
const ANGLE: f64 = 0.05 * DEG;
const SPEED: f64 = 0.1;
const LENGTH: f64 = 1.0;

/// What engines are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ComparedQuantity {
    /// Heading, rad.
    Heading,
    /// Roll, rad.
    Roll,
    /// Pitch, rad.
    Pitch,
    /// Velocity to the north, m/s.
    VelocityNorth,
    /// Velocity to the east, m/s.
    VelocityEast,
    /// Velocity down, m/s.
    VelocityDown,
    /// Position to the north, m.
    PositionNorth,
    /// Position to the east, m.
    PositionEast,
    /// Position down, m.
    PositionDown,
    /// How fast their IMUs turn, as they say themselves, rad/s.
    Turn,
}

impl ComparedQuantity {
    /// A word for tables and lines: `heading`, `velocity_north`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            ComparedQuantity::Heading => "heading",
            ComparedQuantity::Roll => "roll",
            ComparedQuantity::Pitch => "pitch",
            ComparedQuantity::VelocityNorth => "velocity_north",
            ComparedQuantity::VelocityEast => "velocity_east",
            ComparedQuantity::VelocityDown => "velocity_down",
            ComparedQuantity::PositionNorth => "position_north",
            ComparedQuantity::PositionEast => "position_east",
            ComparedQuantity::PositionDown => "position_down",
            ComparedQuantity::Turn => "turn",
        }
    }

    /// Whether it is of an angle, rad or rad/s; else it is in m/s or m.
    #[must_use]
    pub fn is_angle(self) -> bool {
        matches!(
            self,
            ComparedQuantity::Heading
                | ComparedQuantity::Roll
                | ComparedQuantity::Pitch
                | ComparedQuantity::Turn
        )
    }
}

/// How far two engines are apart in one quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Of what.
    pub quantity: ComparedQuantity,
    /// The second minus the first, SI.
    pub value: f64,
    /// What it may be by their claims, SI.
    pub limit: f64,
}

impl Difference {
    /// The difference over its limit: beyond 1 they disagree.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.value.abs() / self.limit
    }
}

/// What is known of how two IMUs sit to each other.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Apart {
    /// How well the axes of one are known to be those of the other, 1-sigma, rad.
    pub mounting_std: f64,
    /// Length of the lever from one to the other, m.
    pub distance: f64,
}

/// All differences of two motions of one point at one time. The limit of each is four standard deviations
/// of the difference, and a floor:
///
/// s^2 = s_1^2 + s_2^2 + m^2 + (0.005 s x rate)^2, with m of how the axes of the two IMUs are mounted, for
/// angles. That would be exact if the engines' errors were independent. They are not: a receiver's errors
/// are in both, and an IMU's in two that share it. What is shared is not in the difference, so that the
/// true s is smaller and the test errs on the side of silence. The gain in taking it out would be in the
/// position, where two engines that believe one receiver agree whatever is wrong with it.
///
/// Close to a pole the meridians of the two IMUs differ, by which the axes of their velocities do, as
/// [`Motion::at_point`] leaves them as they are: that is added, too.
///
/// A position that is not by satellites may be that of the first IMU for each of them: the way between
/// them is added.
///
/// Of an engine that is still aligning nothing but roll and pitch is compared, by twice the limit: its
/// heading may be one of several, and what hangs on it is not what it seems.
#[must_use]
pub fn differences(one: &Motion, other: &Motion, apart: &Apart) -> Vec<Difference> {
    let (a, b) = (&one.solution, &other.solution);
    let convergence = convergence(a, apart.distance);
    let angles = angles(a, b, apart.mounting_std, convergence);
    if !is_navigating(a, b) {
        return angles;
    }
    let acceleration = one.acceleration.unwrap_or_default().0;
    let (c_n, from, to) =
        (earth::c_ne(&a.position), earth::ecef(&a.position), earth::ecef(&b.position));
    let moved = c_n * (to.0 - from.0);
    let slipped = c_n * earth::c_ne(&b.position).tr_mul(&b.velocity.0) - a.velocity.0;
    let by_satellites = a.mode == Mode::Aided && b.mode == Mode::Aided;
    let way = if by_satellites { 0.0 } else { apart.distance };
    let meridians = convergence * a.velocity.0.xy().norm();
    let names = [
        (ComparedQuantity::VelocityNorth, ComparedQuantity::PositionNorth),
        (ComparedQuantity::VelocityEast, ComparedQuantity::PositionEast),
        (ComparedQuantity::VelocityDown, ComparedQuantity::PositionDown),
    ];
    let linear = names.into_iter().enumerate().flat_map(move |(axis, (speed, place))| {
        let spread = |sigmas: [f64; 2], rate: f64| sigmas[0].hypot(sigmas[1]).hypot(TIMING * rate);
        let sigmas = [a.sigma.velocity.0[axis], b.sigma.velocity.0[axis]];
        let by_speed = spread(sigmas, acceleration[axis]);
        let sigmas = [a.sigma.position.0[axis], b.sigma.position.0[axis]];
        let by_place = spread(sigmas, a.velocity.0[axis]);
        [
            Difference {
                quantity: speed,
                value: slipped[axis],
                limit: SIGMAS * by_speed + SPEED + meridians,
            },
            Difference {
                quantity: place,
                value: moved[axis],
                limit: SIGMAS * by_place + LENGTH + way,
            },
        ]
    });
    angles.into_iter().chain(linear).collect()
}

fn is_navigating(a: &Solution, b: &Solution) -> bool {
    a.mode.is_navigating() && b.mode.is_navigating()
}

/// How much the meridians of two places differ at most that are so far apart, m; rad.
fn convergence(at: &Solution, distance: f64) -> f64 {
    let from_axis = earth::ecef(&at.position).0.xy().norm();
    (distance / from_axis.max(1.0)).min(std::f64::consts::PI)
}

fn angles(a: &Solution, b: &Solution, mounting: f64, convergence: f64) -> Vec<Difference> {
    // near a pole the meridians of two places differ
    let c_n = earth::c_ne(&a.position) * earth::c_ne(&b.position).transpose();
    let turned = Attitude::from_c_nb(&(c_n * b.attitude.c_nb()));
    let own = &a.attitude;
    let limit = |one: f64, other: f64, rate: f64| {
        SIGMAS * one.hypot(other).hypot(mounting).hypot(TIMING * rate) + ANGLE
    };
    let rate = &a.rate.0;
    let tilts = [
        (ComparedQuantity::Roll, turned.roll - own.roll, a.sigma.roll, b.sigma.roll, rate.x),
        (ComparedQuantity::Pitch, turned.pitch - own.pitch, a.sigma.pitch, b.sigma.pitch, rate.y),
    ];
    let turn = a.rate_of_turn();
    let by_heading = turned.heading - own.heading;
    let heading = (ComparedQuantity::Heading, by_heading, a.sigma.heading, b.sigma.heading, turn);
    let both = is_navigating(a, b);
    let (share, heading) = if both { (1.0, Some(heading)) } else { (2.0, None) };
    let difference = |(quantity, value, one, other, rate)| Difference {
        quantity,
        value: wrap_pi(value),
        limit: share * limit(one, other, rate)
            + if quantity == ComparedQuantity::Heading { convergence } else { 0.0 },
    };
    heading.into_iter().chain(tilts).map(difference).collect()
}

/// How far two motions are apart, in each component.
pub(super) fn distance(one: &Motion, other: &Motion, apart: &Apart) -> SolutionSigma {
    let mut all = SolutionSigma::default();
    for Difference { quantity, value, .. } in differences(one, other, apart) {
        let component = match quantity {
            ComparedQuantity::Heading => &mut all.heading,
            ComparedQuantity::Roll => &mut all.roll,
            ComparedQuantity::Pitch => &mut all.pitch,
            ComparedQuantity::VelocityNorth => &mut all.velocity.0.x,
            ComparedQuantity::VelocityEast => &mut all.velocity.0.y,
            ComparedQuantity::VelocityDown => &mut all.velocity.0.z,
            ComparedQuantity::PositionNorth => &mut all.position.0.x,
            ComparedQuantity::PositionEast => &mut all.position.0.y,
            ComparedQuantity::PositionDown => &mut all.position.0.z,
            ComparedQuantity::Turn => continue,
        };
        *component = value.abs();
    }
    all
}

/// How much less certain one is than another: the greatest ratio of their sigmas, beside which the floors
/// count too.
pub(super) fn vagueness(own: &Solution, other: &Solution) -> f64 {
    let (a, b) = (&own.sigma, &other.sigma);
    let angles = [(a.heading, b.heading), (a.roll, b.roll), (a.pitch, b.pitch)];
    let ratio = |(one, other): (f64, f64), floor: f64| (one + floor) / (other + floor);
    let by_angle = angles.into_iter().map(|pair| ratio(pair, ANGLE));
    let pairs = |one: &insd_base::Ned, other: &insd_base::Ned, floor: f64| {
        (one.0.norm() + floor) / (other.0.norm() + floor)
    };
    let by_speed = pairs(&a.velocity, &b.velocity, SPEED);
    let by_place = pairs(&a.position, &b.position, LENGTH);
    by_angle.fold(by_speed.max(by_place), f64::max)
}
