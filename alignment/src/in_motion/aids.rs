//! What measurements say to the eight states: pure functions from an estimate and a measurement to an
//! innovation. All of them are linear in (s, c), lever arms and log included, because the hull's
//! vectors are known in the computed frame: north-east components are R(dpsi) times those.

use insd_base::units::wrap_pi;
use insd_base::{Geodetic, earth};
use insd_estimation::Innovation;
use nalgebra::{Matrix2, Matrix3, SMatrix, Vector2, Vector3};

use super::belief::{Belief, CONSIDERED, STATES, considered as k, innovation, state as x};
use super::mast::Mast;
use super::motion::{HorizontalMotion, Local, across, rotation};

type ByConsidered = SMatrix<f64, 2, CONSIDERED>;

/// An estimate with what every aid needs of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    /// The estimate.
    pub motion: HorizontalMotion,
    /// Around it.
    pub local: Local,
    /// Rotation from body axes to the computed frame.
    pub c_pb: Matrix3<f64>,
    /// R(assumed heading): turns considered hull errors into north and east.
    pub hull: Matrix2<f64>,
    /// Angular rate with respect to the Earth, body axes, rad/s.
    pub rate: Vector3<f64>,
    /// Variance of the noise of that rate, (rad/s)^2.
    pub rate_variance: f64,
    /// Velocity downwards, m/s, and its variance.
    pub down: (f64, f64),
    /// Whether she has been seen to make way.
    pub makes_way: bool,
}

/// A quantity from a GNSS receiver, its sigma split into white and slow parts, north and east.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split<T> {
    /// Measured.
    pub value: T,
    /// 1-sigma of the white part.
    pub white: Vector2<f64>,
    /// 1-sigma of the slow part.
    pub slow: Vector2<f64>,
}

/// A log's velocity, body axes, m/s; a missing starboard component is taken as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedReading {
    /// Forward.
    pub u: f64,
    /// Starboard.
    pub v: Option<f64>,
    /// Down.
    pub w: Option<f64>,
    /// 1-sigma of each component given.
    pub std: f64,
    /// Through the water rather than over the sea bed.
    pub water: bool,
}

/// Leeway of a ship whose log does not tell it, 1-sigma, m/s.
const LEEWAY: f64 = 0.5;
/// All a ship at her berth does is roll, and every roll gives the antenna the same velocity beside that of the ship: what a
/// lever arm of which little is known makes of that is as new as one in so many.
const ALIKE: f64 = 100.0;
/// A log's direction says something of the heading beyond this many sigmas of speed.
const MOVING: f64 = 3.0;

impl Scene {
    /// From an estimate and the gyros' rate against inertial space, body axes, rad/s.
    #[must_use]
    pub fn new(
        motion: &HorizontalMotion,
        measured_rate: &Vector3<f64>,
        rate_variance: f64,
        down: (f64, f64),
    ) -> Self {
        let local = Local::new(motion);
        let c_pb = motion.c_pb();
        let earth_rate = earth::rate_n(motion.place.latitude);
        let level = motion.turn().transpose() * earth_rate.xy();
        let earth_p = Vector3::new(level.x, level.y, earth_rate.z);
        let bow = Vector2::new(c_pb[(0, 0)], c_pb[(1, 0)]);
        Scene {
            motion: *motion,
            local,
            c_pb,
            hull: rotation(&bow.try_normalize(1e-6).unwrap_or_else(Vector2::x)),
            rate: measured_rate - c_pb.transpose() * earth_p,
            rate_variance,
            down,
            makes_way: true,
        }
    }

    /// Velocity of a lever arm's end about the IMU, computed frame, m/s.
    #[must_use]
    pub fn swing(&self, lever: &Vector3<f64>) -> Vector3<f64> {
        self.c_pb * self.rate.cross(lever)
    }

    /// Variance of the noise that a lever arm turns from rate to velocity, (m/s)^2: noise in what is taken for the motion of
    /// the hull.
    #[must_use]
    pub fn swing_noise(&self, lever: &Vector3<f64>) -> f64 {
        self.rate_variance * lever.norm_squared()
    }

    /// Where the foot of a mast of unit length is from below its top, computed frame.
    #[must_use]
    pub fn mast(&self) -> Vector2<f64> {
        Vector2::new(self.c_pb[(0, 2)], self.c_pb[(1, 2)])
    }

    /// Variance of what a mast of unknown length moves the antenna by, m^2.
    #[must_use]
    pub fn leaning(&self, mast: &Mast, belief: &Belief) -> f64 {
        let is_alike = mast.is_held() && !self.makes_way;
        let lasts = if is_alike { ALIKE } else { 1.0 };
        mast.swung(&self.mast(), &self.hull) * belief.prior[k::LEVER] * lasts
    }

    /// Variance of the velocity that an unknown lever arm gives the antenna as the ship rolls and
    /// pitches, (m/s)^2.
    #[must_use]
    pub fn rocking(&self, belief: &Belief) -> f64 {
        let lasts = if self.makes_way { 1.0 } else { ALIKE };
        self.rate.xy().norm_squared() * belief.prior[k::LEVER] * lasts
    }

    /// Position of the IMU less the estimated one, north and east, m.
    fn offset(&self, place: &Geodetic) -> Vector2<f64> {
        let (meridian, prime) = self.local.radii;
        let here = &self.motion.place;
        Vector2::new(
            (place.latitude - here.latitude) * meridian,
            wrap_pi(place.longitude - here.longitude) * prime * here.latitude.cos(),
        )
    }
}

/// GNSS position at the antenna: z = dr + (R(dpsi) C_pb l and its tilt) + v tau + slow + white. What an
/// unknown height of the antenna does as the ship leans counts as noise, of the variance `leaning`, m^2
/// ([`Scene::leaning`]).
#[must_use]
pub fn gnss_position(
    scene: &Scene,
    fix: &Split<Geodetic>,
    lever: &Vector3<f64>,
    leaning: f64,
) -> Innovation {
    let (arm, mut h) = scene.motion.carried(&(scene.c_pb * lever));
    h.fixed_view_mut::<2, 2>(0, x::POSITION).fill_with_identity();
    let mut hc = ByConsidered::zeros();
    hc.fixed_view_mut::<2, 2>(0, k::LEVER).copy_from(&scene.hull);
    hc.set_column(k::DELAY, &-scene.motion.velocity);
    set_slow(&mut hc, k::SLOW_POSITION, &fix.slow);
    let white = fix.white.component_mul(&fix.white);
    let noise = Matrix2::from_diagonal(&white.add_scalar(leaning));
    innovation(&(scene.offset(&fix.value) - arm), &h, &hc, &noise)
}

/// GNSS velocity at the antenna: z = dv + (R(dpsi) C_pb (omega x l) and its tilt) - a tau + slow +
/// white. `acceleration` of the antenna in the computed frame, m/s^2: as long as its direction is not
/// known, the delay counts as noise.
#[must_use]
pub fn gnss_velocity(
    scene: &Scene,
    fix: &Split<Vector2<f64>>,
    lever: &Vector3<f64>,
    acceleration: &Vector2<f64>,
    belief: &Belief,
) -> Innovation {
    let (swing, mut h) = scene.motion.carried(&scene.swing(lever));
    h.fixed_view_mut::<2, 2>(0, x::VELOCITY).fill_with_identity();
    let late = scene.motion.turn() * acceleration;
    let unsure = 0.5 * acceleration.norm_squared() * belief.pair(x::SINE).sum();
    let delay = belief.prior[k::DELAY] + belief.prior[k::VELOCITY_DELAY];
    let yaw = scene.rate.z;
    let mut hc = ByConsidered::zeros();
    let turned = Matrix2::new(0.0, -yaw, yaw, 0.0) * scene.hull;
    hc.fixed_view_mut::<2, 2>(0, k::LEVER).copy_from(&turned);
    hc.set_column(k::DELAY, &-late);
    hc.set_column(k::VELOCITY_DELAY, &-late);
    set_slow(&mut hc, k::SLOW_VELOCITY, &fix.slow);
    let noise = scene.swing_noise(lever) + scene.rocking(belief) + unsure * delay;
    let white = fix.white.component_mul(&fix.white);
    let z = fix.value - scene.motion.velocity - swing;
    innovation(&z, &h, &hc, &Matrix2::from_diagonal(&white.add_scalar(noise)))
}

/// Velocity of a log: R(dpsi) C_pb (u - omega x l) is the velocity over the sea bed, or through the
/// water: z = R(dpsi^) u_p - v^ = dv - (its derivative by s, c, tilt) - current + k v - m (down x v).
///
/// With less speed than noise the direction of u_p is that of the noise and its dependence on (s, c)
/// is counted as noise too.
#[must_use]
pub fn log_velocity(
    scene: &Scene,
    reading: &SpeedReading,
    lever: &Vector3<f64>,
    belief: &Belief,
) -> Innovation {
    let c = &scene.c_pb;
    let v = reading.v.unwrap_or(0.0);
    // the down component that fits the vertical channel where the log gives none
    let fitting = || (scene.down.0 - c[(2, 0)] * reading.u - c[(2, 1)] * v) / c[(2, 2)].max(0.5);
    let u = Vector3::new(reading.u, v, reading.w.unwrap_or_else(fitting));
    let at_imu = c * (u - scene.rate.cross(lever));
    let (seen, by_state) = scene.motion.carried(&at_imu);
    let mut variance = reading.std.powi(2) + scene.swing_noise(lever);
    if reading.v.is_none() {
        variance += LEEWAY * LEEWAY;
    }
    if reading.w.is_none() {
        variance += scene.mast().norm_squared() * scene.down.1;
    }
    let mut h = -by_state;
    if at_imu.xy().norm() < MOVING * variance.sqrt() {
        h.fixed_columns_mut::<2>(x::SINE).fill(0.0);
        variance += 0.5 * at_imu.xy().norm_squared() * belief.pair(x::SINE).sum();
    }
    h.fixed_view_mut::<2, 2>(0, x::VELOCITY).fill_with_identity();
    let through = scene.motion.velocity;
    let mut hc = ByConsidered::zeros();
    hc.set_column(k::LOG_SCALE, &through);
    hc.set_column(k::LOG_TURN, &-across(&through));
    if reading.water {
        hc.fixed_view_mut::<2, 2>(0, k::CURRENT).fill_diagonal(-1.0);
    }
    innovation(&(seen - through), &h, &hc, &Matrix2::from_diagonal_element(variance))
}

/// A position of the IMU from an external reference with 1-sigma, m.
#[must_use]
pub fn reference_position(scene: &Scene, place: &Geodetic, std: f64) -> Innovation {
    plain(x::POSITION, &scene.offset(place), std)
}

/// A velocity north and east from an external reference with 1-sigma, m/s.
#[must_use]
pub fn reference_velocity(scene: &Scene, velocity: &Vector2<f64>, std: f64) -> Innovation {
    plain(x::VELOCITY, &(velocity - scene.motion.velocity), std)
}

/// A true heading, rad, with 1-sigma: a point on the circle of (s, c), unsure along it by sigma and
/// across it by the bulge of the arc.
#[must_use]
pub fn reference_heading(scene: &Scene, heading: f64, std: f64) -> Innovation {
    let assumed = scene.hull[(1, 0)].atan2(scene.hull[(0, 0)]);
    let (sin, cos) = (heading - assumed).sin_cos();
    let along = Vector2::new(cos, sin);
    let outwards = Vector2::new(sin, -cos);
    let bulge = std.powi(4).max(1e-8);
    let mut h = SMatrix::<f64, 2, STATES>::zeros();
    h.fixed_view_mut::<2, 2>(0, x::SINE).fill_with_identity();
    let z = Vector2::new(sin - scene.motion.sine, 1.0 - cos - scene.motion.versine);
    let noise = along * along.transpose() * (std * std) + outwards * outwards.transpose() * bulge;
    innovation(&z, &h, &ByConsidered::zeros(), &noise)
}

fn plain(at: usize, z: &Vector2<f64>, std: f64) -> Innovation {
    let mut h = SMatrix::<f64, 2, STATES>::zeros();
    h.fixed_view_mut::<2, 2>(0, at).fill_with_identity();
    innovation(z, &h, &ByConsidered::zeros(), &Matrix2::from_diagonal_element(std * std))
}

fn set_slow(hc: &mut ByConsidered, at: usize, slow: &Vector2<f64>) {
    hc.fixed_view_mut::<2, 2>(0, at).copy_from(&Matrix2::from_diagonal(slow));
}
