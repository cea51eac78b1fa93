//! A ship that is sailed inside the tests: turns and speeds up evenly, rolls a little.

use insd_base::units::{DEG, DEG_PER_HOUR, DEG_PER_SQRT_HOUR, MICRO_G};
use insd_base::{Body, FixQuality, Geodetic, GnssFix, LogVelocity, Source, Span, Triad};

use super::*;

/// Samples per second.
const RATE: f64 = 100.0;

#[derive(Clone, Copy, Debug)]
pub(super) struct Ship {
    pub(super) place: Geodetic,
    /// At the start, rad.
    pub(super) heading: f64,
    /// Rate of turn, rad/s.
    pub(super) turn: f64,
    /// At the start, m/s.
    pub(super) speed: f64,
    /// Acceleration ahead, m/s^2.
    pub(super) thrust: f64,
    /// Amplitude of roll, rad, with a period of 9 s.
    pub(super) roll: f64,
}

impl Ship {
    pub(super) fn at(latitude: f64) -> Self {
        Ship {
            place: Geodetic::from_degrees(latitude, 139.0, 20.0),
            heading: 0.0,
            turn: 0.0,
            speed: 6.0,
            thrust: 0.0,
            roll: 2.0 * DEG,
        }
    }

    pub(super) fn attitude(&self, t: f64) -> Attitude {
        let roll = self.roll * (t * 0.7).sin();
        Attitude { roll, pitch: 0.3 * roll, heading: self.heading + self.turn * t }
    }

    pub(super) fn velocity(&self, t: f64) -> Vector3<f64> {
        let heading = self.heading + self.turn * t;
        Vector3::new(heading.cos(), heading.sin(), 0.0) * (self.speed + self.thrust * t)
    }

    /// Angular rate against inertial space, body axes, rad/s, by differences.
    fn body_rotation(&self, from: f64, to: f64, place: &Geodetic) -> Vector3<f64> {
        let q = |t: f64| UnitQuaternion::from_matrix(&self.attitude(t).c_nb());
        let v = self.velocity(0.5 * (from + to));
        let w = earth::rate_n(place.latitude) + earth::transport_rate(place, &v);
        (q(from).inverse() * UnitQuaternion::new(w * (to - from)) * q(to)).scaled_axis()
    }

    /// The increment of a step; moves the place along.
    pub(super) fn increment(&self, step: usize, place: &mut Geodetic) -> Increment {
        let h = 1.0 / RATE;
        let (from, to) = (step as f64 * h, (step + 1) as f64 * h);
        let v = self.velocity(0.5 * (from + to));
        let earth_rate = earth::rate_n(place.latitude);
        let coriolis = (earth_rate * 2.0 + earth::transport_rate(place, &v)).cross(&v);
        let gravity = Vector3::z() * earth::normal_gravity(place.latitude, place.height);
        let change = self.velocity(to) - self.velocity(from);
        let force = change + (coriolis - gravity) * h;
        let middle = self.attitude(0.5 * (from + to)).c_nb();
        let rotation = self.body_rotation(from, to, place);
        let (meridian, prime) = earth::radii(place.latitude);
        let increment = Increment {
            from: Time::from_seconds(from),
            to: Time::from_seconds(to),
            rotation,
            velocity: middle.transpose() * force,
            end_rate: self.body_rotation(to - 1e-4, to + 1e-4, place) / 2e-4,
            end_rate_variance: 0.0,
            angular_acceleration: Vector3::zeros(),
            rate_noise: Vector3::zeros(),
            force_noise: Vector3::zeros(),
            bridged: None,
            celsius: None,
        };
        place.latitude += v.x * h / (meridian + place.height);
        place.longitude += v.y * h / ((prime + place.height) * place.latitude.cos());
        increment
    }
}

pub(in crate::in_motion) fn good_imu() -> ImuSpec {
    imu(0.01, 0.003, 0.003, 50.0, 10.0, 0.006, 1e-5)
}

pub(super) fn mems_imu() -> ImuSpec {
    imu(30.0, 5.0, 0.2, 2000.0, 100.0, 0.06, 1e-3)
}

fn imu(
    gyro: f64,
    drift: f64,
    angle_walk: f64,
    accel: f64,
    accel_drift: f64,
    speed_walk: f64,
    scale: f64,
) -> ImuSpec {
    let triad = |bias: f64, instability: f64, random_walk: f64| Triad {
        bias_std: bias,
        instability_std: instability,
        instability_time: 3600.0,
        random_walk,
        scale_std: scale,
    };
    ImuSpec {
        rate: RATE,
        gyro: triad(gyro * DEG_PER_HOUR, drift * DEG_PER_HOUR, angle_walk * DEG_PER_SQRT_HOUR),
        accel: triad(accel * MICRO_G, accel_drift * MICRO_G, speed_walk / 60.0),
    }
}

/// Normal deviates from a seed: SplitMix64 and a sum of twelve uniform ones.
pub(super) struct Dice(u64);

impl Dice {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }

    fn vector(&mut self, std: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| std * self.normal())
    }
}

/// Sigmas of GNSS velocity, m/s, and position, m, white and slow in the shares of the model.
const VELOCITY_STD: f64 = 0.03;
const POSITION_STD: f64 = 0.9;
/// Sigma of the log, m/s.
const LOG_STD: f64 = 0.05;
const LEVER: Vector3<f64> = Vector3::new(-6.0, -0.8, -14.0);

/// A ship, her sensors and the filter.
pub(super) struct Run {
    ship: Ship,
    config: NavConfig,
    pub(super) filter: EightState,
    place: Geodetic,
    dice: Dice,
    biases: (Vector3<f64>, Vector3<f64>),
    slow: (Vector3<f64>, Vector3<f64>),
    step: usize,
    /// Interval of the fixes, s.
    pub(super) gnss: Option<f64>,
    log: Option<LogReference>,
    current: Vector3<f64>,
    /// By which the receiver's positions are off to the north, m.
    pub(super) jump: f64,
    /// How many times her speed the log tells.
    pub(super) log_gain: f64,
}

impl Run {
    pub(super) fn new(ship: &Ship, imu: &ImuSpec, seed: u64) -> Self {
        let arms = LeverArms { gnss: Body(LEVER), log: Body(Vector3::new(9.0, -1.0, 9.0)) };
        let mut config = NavConfig::new(*imu, arms);
        config.gnss.delay_std = 1e-6;
        config.gnss.velocity_delay_std = 1e-3;
        let mut dice = Dice(seed);
        let biases = (dice.vector(imu.gyro.bias_std), dice.vector(imu.accel.bias_std));
        let slow = (dice.vector(POSITION_STD * 0.85), dice.vector(VELOCITY_STD * 0.32));
        let first = ship.increment(0, &mut ship.place.clone());
        let force = first.velocity * RATE + biases.1 + dice.vector(0.05);
        let level = Level { time: Time::START, force, rate: first.end_rate };
        let kinematics = Kinematics {
            position: ship.place,
            position_std: 20.0,
            velocity: ship.velocity(0.0) + dice.vector(0.1),
            velocity_std: 0.5,
            acceleration: (ship.velocity(0.1) - ship.velocity(0.0)) / 0.1,
            moored: false,
            gnss_position: true,
            gnss_velocity: true,
        };
        Run {
            filter: EightState::new(&config, &level, &kinematics),
            ship: *ship,
            config,
            place: ship.place,
            dice,
            biases,
            slow,
            step: 0,
            gnss: Some(1.0),
            log: None,
            current: Vector3::zeros(),
            jump: 0.0,
            log_gain: 1.0,
        }
    }

    /// With nothing known of the velocity at the start.
    pub(super) fn without_course(mut self) -> Self {
        self.filter.motion.velocity = Vector2::zeros();
        self.filter.belief.renew_pair(x::VELOCITY, 10.0_f64.powi(2));
        self
    }

    /// With a log over the bottom, once a second.
    pub(super) fn with_log(mut self) -> Self {
        self.log = Some(LogReference::Bottom);
        self
    }

    /// With a log through the water, in a current north and east, m/s.
    pub(super) fn with_water_log(mut self, north: f64, east: f64) -> Self {
        self.log = Some(LogReference::Water);
        self.current = Vector3::new(north, east, 0.0);
        self
    }

    pub(super) fn now(&self) -> f64 {
        self.step as f64 / RATE
    }

    pub(super) fn truth(&self) -> Attitude {
        self.ship.attitude(self.now())
    }

    pub(super) fn true_velocity(&self) -> Vector3<f64> {
        self.ship.velocity(self.now())
    }

    pub(super) fn true_place(&self) -> Geodetic {
        self.place
    }

    pub(super) fn config(&self) -> &NavConfig {
        &self.config
    }

    pub(super) fn sail(&mut self, seconds: f64) {
        for _ in 0..(seconds * RATE).round() as usize {
            let mut increment = self.ship.increment(self.step, &mut self.place);
            let h = increment.duration();
            let imu = self.config.imu;
            let root = h.sqrt();
            increment.rotation += self.biases.0 * h + self.dice.vector(imu.gyro.random_walk * root);
            increment.velocity +=
                self.biases.1 * h + self.dice.vector(imu.accel.random_walk * root);
            increment.end_rate += self.biases.0;
            increment.end_rate_variance = rate_variance(&imu);
            self.filter.advance(&increment);
            self.step += 1;
            if self.gnss.is_some_and(|every| self.is_due(every)) {
                self.fix();
            }
            if self.log.is_some() && self.is_due(1.0) {
                self.read_log();
            }
        }
    }

    fn is_due(&self, every: f64) -> bool {
        self.step.is_multiple_of((every * RATE) as usize)
    }

    /// Velocity about the IMU of a point of the hull, body axes.
    fn swing(&self, lever: &Vector3<f64>) -> Vector3<f64> {
        let t = self.now();
        let c = |t: f64| self.ship.attitude(t).c_nb();
        self.truth().c_nb().transpose() * (c(t + 1e-3) - c(t - 1e-3)) * lever / 2e-3
    }

    fn fix(&mut self) {
        let c_nb = self.truth().c_nb();
        let (meridian, prime) = earth::radii(self.place.latitude);
        let model = self.config.gnss;
        let white = |std: f64, slow: f64| std * (1.0 - slow).sqrt();
        let off = c_nb * LEVER
            + self.slow.0
            + Vector3::x() * self.jump
            + self.dice.vector(white(POSITION_STD, model.position_slow_share));
        let position = Geodetic {
            latitude: self.place.latitude + off.x / meridian,
            longitude: self.place.longitude + off.y / (prime * self.place.latitude.cos()),
            height: self.place.height - off.z,
        };
        let velocity = self.true_velocity()
            + c_nb * self.swing(&LEVER)
            + self.slow.1
            + self.dice.vector(white(VELOCITY_STD, model.velocity_slow_share));
        let fix = GnssFix {
            time: Time::from_seconds(self.now()),
            position: Some(position),
            velocity: Some(Ned(velocity)),
            position_std: Some(Ned(Vector3::repeat(POSITION_STD))),
            velocity_std: Some(Ned(Vector3::repeat(VELOCITY_STD))),
            hdop: Some(1.0),
            satellites: Some(12),
            quality: FixQuality::Differential,
            lever: None,
            redated: 0.0,
            rank: 0,
        };
        self.filter.gnss(&fix, Source::Gnss(0));
    }

    fn read_log(&mut self) {
        let Some(reference) = self.log else { return };
        let lever = self.config.lever_arms.log.0;
        let through = self.true_velocity() - self.current;
        let u = (self.truth().c_nb().transpose() * through + self.swing(&lever)) * self.log_gain
            + self.dice.vector(LOG_STD);
        let reading = LogVelocity {
            time: Time::START + Span::from_seconds(self.now()),
            u: Some(u.x),
            v: Some(u.y),
            w: Some(u.z),
            std: Some(LOG_STD),
            reference,
        };
        self.filter.log(&reading, Source::Log(0));
    }
}
