//! A ship along a quay: what moves, what is seen, what is measured.

use std::sync::Arc;

use insd_base::satellites::{
    Constellation, Measured, SatelliteId, SatelliteRange, SatelliteRanges, Transmitter,
};
use insd_base::{
    Body, CameraFrame, CameraModel, Geodetic, ImagePoint, ImuSpec, LeverArms, Message, Received,
    Source, Time, Triad, VisualOdometry, earth,
};
use insd_nav::camera::sight::{Eye, Pose};
use insd_nav::config::{CameraAid, OdometryModel};
use insd_nav::error_state::{ATTITUDE, Errors, POSITION, VELOCITY};
use insd_nav::initial::sensor_covariance;
use insd_nav::strapdown::{LocalGravity, integrate};
use insd_nav::timeline::Estimator;
use insd_nav::{Filter, Increment, InitialState, NavConfig, Nominal, Outcome};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector2, Vector3};
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// From sample to sample of the IMU, and from image to image, s.
const STEP: f64 = 0.05;
const IMAGE: u64 = 10;
const POINTS: usize = 300;
/// Noise of the IMU, rad and m/s per root of a second.
const ANGLE_WALK: f64 = 6e-5;
const VELOCITY_WALK: f64 = 1e-3;

/// What is out of the ordinary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Trouble {
    /// One point of a hundred is a mismatch, one track of ten a ship that passes.
    Usual,
    /// No image at all.
    Blind,
    /// Points anywhere.
    Noise,
    /// The first image again and again.
    Frozen,
    /// No points but the steps of a visual odometry, each map of which has ten of them.
    Odometry,
    /// The same, of an odometry that goes by a ship that passes, from five seconds on.
    Misled,
}

/// All of it.
pub(crate) struct Scene {
    truth: Nominal,
    filter: Filter,
    gravity: LocalGravity,
    model: CameraModel,
    /// How the camera sits otherwise than the filter is told.
    axes: Vector3<f64>,
    bias: [Vector3<f64>; 2],
    points: Vec<Vector3<f64>>,
    /// Which have been out of sight how often: a point that comes back is another track.
    visits: Vec<(bool, u64)>,
    trouble: Trouble,
    first: Option<CameraFrame>,
    /// The camera when its visual odometry told of it last, with its number of steps and the scale of its map.
    before: Option<(Time, Pose, u32)>,
    scale: f64,
    steps: u64,
    refused: u32,
    rng: Pcg64,
    /// Of what is seen: blind or not, the IMU measures the same.
    seen: Pcg64,
}

fn spec() -> ImuSpec {
    let triad = |bias_std: f64, random_walk: f64| Triad {
        bias_std,
        instability_std: bias_std * 0.02,
        instability_time: 1000.0,
        random_walk,
        scale_std: 1e-5,
    };
    let (gyro, accel) = (triad(1e-4, ANGLE_WALK), triad(5e-3, VELOCITY_WALK));
    ImuSpec { rate: 1.0 / STEP, gyro, accel }
}

fn model() -> CameraModel {
    let outward = Rotation3::from_euler_angles(0.0, 0.0, 1.0).into_inner();
    CameraModel {
        lever: Body::new(12.0, 3.0, -8.0),
        c_bc: outward * Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0),
        focal: Vector2::new(800.0, 800.0),
        centre: Vector2::new(640.0, 360.0),
        size: [1280, 720],
        pixel_std: 0.5,
    }
}

/// How she stands, body to ECEF: east, rolling and pitching a little.
fn attitude(c_en: &Matrix3<f64>, t: f64) -> UnitQuaternion<f64> {
    let roll = 0.02 * (0.8 * t).sin();
    let pitch = 0.01 * (0.7 * t + 1.0).sin();
    let heading = 1.5 + 0.05 * (0.1 * t).sin();
    UnitQuaternion::from_matrix(
        &(c_en * Rotation3::from_euler_angles(roll, pitch, heading).into_inner()),
    )
}

fn velocity(c_en: &Matrix3<f64>, t: f64) -> Vector3<f64> {
    c_en * Vector3::new(0.1 * (0.2 * t).sin(), 0.8, 0.05 * (0.9 * t).sin())
}

impl Scene {
    pub(crate) fn new(seed: u64, trouble: Trouble) -> Self {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut draw = |std: f64| {
            let one = |_, _| -> f64 { StandardNormal.sample(&mut rng) };
            Vector3::from_fn(one) * std
        };
        let place = Geodetic::from_degrees(35.0, 139.0, 20.0);
        let c_en = earth::c_ne(&place).transpose();
        let mut truth = Nominal::at(&place, &Vector3::zeros(), &Matrix3::identity());
        (truth.attitude, truth.velocity) = (attitude(&c_en, 0.0), velocity(&c_en, 0.0));
        let model = model();
        let lever_arms = LeverArms { gnss: Body::new(0.0, 0.0, -5.0), ..LeverArms::default() };
        let mut config = NavConfig::new(spec(), lever_arms);
        let has_steps = matches!(trouble, Trouble::Odometry | Trouble::Misled);
        let odometry = has_steps.then(OdometryModel::default);
        config.camera = Some(CameraAid { delay_std: 0.005, odometry, ..CameraAid::new(model) });
        let mut covariance = sensor_covariance(&config);
        let mut estimate = truth;
        let known = [
            (POSITION, Vector3::new(1.0, 1.0, 1.0)),
            (VELOCITY, Vector3::new(0.03, 0.03, 0.03)),
            (ATTITUDE, Vector3::new(0.001, 0.001, 0.005)),
        ];
        for (block, std) in known {
            let own = c_en * Matrix3::from_diagonal(&std.component_mul(&std)) * c_en.transpose();
            block.renew(&mut covariance, &own);
            let mut error = Errors::none();
            error.set(block, &(c_en * draw(1.0).component_mul(&std)));
            estimate.inject(&error);
        }
        let axes = draw(CameraAid::new(model).axes_std);
        let bias = [draw(spec().gyro.bias_std), draw(spec().accel.bias_std)];
        let initial = InitialState::new(Time::START, estimate, covariance, Vector3::zeros());
        let mut filter = Filter::new(&config, &initial);
        filter.begin_navigation();
        let mut points = Vec::new();
        for _ in 0..POINTS {
            let ahead = rng.random_range(-100.0..200.0);
            let (across, up) = (rng.random_range(30.0..90.0), rng.random_range(-15.0..30.0));
            points.push(truth.position + c_en * Vector3::new(-across, ahead, -up));
        }
        Scene {
            gravity: LocalGravity::around(&truth.position, &place),
            truth,
            filter,
            model,
            axes,
            bias,
            visits: vec![(false, 0); POINTS],
            points,
            trouble,
            first: None,
            before: None,
            scale: 1.0,
            steps: 0,
            refused: 0,
            rng,
            seen: Pcg64::seed_from_u64(1000 + seed),
        }
    }

    pub(crate) fn filter(&self) -> &Filter {
        &self.filter
    }

    pub(crate) fn truth(&self) -> &Nominal {
        &self.truth
    }

    pub(crate) fn axes(&self) -> Vector3<f64> {
        self.axes
    }

    /// Images that were refused.
    pub(crate) fn refused(&self) -> u32 {
        self.refused
    }

    pub(crate) fn be_blind(&mut self) {
        self.trouble = Trouble::Blind;
    }

    /// By how much the estimate is off, ECEF, m.
    pub(crate) fn off(&self) -> Vector3<f64> {
        self.truth.position - self.filter.nominal().position
    }

    /// The first range of a receiver: from then on ranges tell the place, and this one next to nothing of it.
    pub(crate) fn hear_range(&mut self) {
        let time = Time::from_seconds(self.steps as f64 * STEP);
        let position = self.truth.position * 4.0;
        let transmitter = Transmitter { position, velocity: Vector3::zeros() };
        let value = transmitter.range(&self.truth.position);
        let range = SatelliteRange {
            satellite: SatelliteId { constellation: Constellation::Gps, number: 1 },
            transmitter,
            offset: Vector3::zeros(),
            elevation: 1.5,
            code: Some(Measured { value, variance: 1e8 }),
            rate: None,
            phase: None,
            slow_std: 1.0,
            by_ionosphere: 1.0,
            multipath_std: 0.5,
        };
        let told = SatelliteRanges {
            time,
            clock: Some((0.0, 0.0)),
            ranges: vec![range],
            displacement: None,
            heard: Vec::new(),
        };
        let message = Message::Ranges(Arc::new(told));
        self.filter.apply(&Received { receipt: time, source: Source::Gnss(0), message });
        self.filter.settle();
    }

    /// Sails on for so long, s.
    pub(crate) fn sail(&mut self, duration: f64) {
        for _ in 0..(duration / STEP).round() as u64 {
            self.step();
        }
        self.filter.settle();
    }

    fn draw(&mut self, std: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut self.rng) }) * std
    }

    fn step(&mut self) {
        let at = |step: u64| step as f64 * STEP;
        let place = self.truth.geodetic();
        let c_en = earth::c_ne(&Geodetic::from_degrees(35.0, 139.0, 20.0)).transpose();
        let (from, to) = (at(self.steps), at(self.steps + 1));
        let (before, after) = (attitude(&c_en, from), attitude(&c_en, to));
        let turned = UnitQuaternion::new(earth::rate_e() * STEP);
        let rotation = (before.inverse() * turned * after).scaled_axis();
        let change = velocity(&c_en, to) - self.truth.velocity;
        let weight = earth::gravity_e(&place) - 2.0 * earth::rate_e().cross(&self.truth.velocity);
        let middle = before * UnitQuaternion::new(rotation * 0.5);
        let force = middle.inverse() * (change - weight * STEP);
        let rate = rotation / STEP;
        let mut increment = Increment {
            from: Time::from_seconds(from),
            to: Time::from_seconds(to),
            rotation,
            velocity: force,
            end_rate: rate,
            end_rate_variance: 1e-8,
            angular_acceleration: Vector3::zeros(),
            rate_noise: Vector3::zeros(),
            force_noise: Vector3::zeros(),
            bridged: None,
            celsius: None,
        };
        integrate(&mut self.truth, &self.gravity, &increment);
        increment.rotation += self.bias[0] * STEP + self.draw(ANGLE_WALK * STEP.sqrt());
        increment.velocity += self.bias[1] * STEP + self.draw(VELOCITY_WALK * STEP.sqrt());
        self.filter.advance(&increment);
        self.steps += 1;
        if self.steps.is_multiple_of(IMAGE) {
            self.look(Time::from_seconds(to), rate);
        }
    }

    /// Another image.
    fn look(&mut self, time: Time, rate: Vector3<f64>) {
        if self.trouble == Trouble::Blind {
            return;
        }
        let message = match self.trouble {
            Trouble::Odometry | Trouble::Misled => match self.moved(time, rate) {
                Some(step) => Message::Odometry(step),
                None => return,
            },
            Trouble::Frozen => {
                let seen = self.image(time, rate);
                let first = self.first.get_or_insert(seen).clone();
                Message::Camera(Arc::new(CameraFrame { time, ..first }))
            }
            _ => Message::Camera(Arc::new(self.image(time, rate))),
        };
        let received = Received { receipt: time, source: Source::Camera(0), message };
        let report = self.filter.apply(&received);
        let is_refused = |outcome: Outcome| matches!(outcome, Outcome::Rejected(_));
        self.refused += u32::from(report.aids.iter().any(|aid| is_refused(aid.outcome)));
    }

    fn pose(&self, rate: Vector3<f64>) -> Pose {
        Pose {
            position: self.truth.position,
            attitude: self.truth.attitude,
            velocity: self.truth.velocity,
            rate: self.truth.attitude * rate,
        }
    }

    /// How the camera has moved since the last step, as a visual odometry has it.
    fn moved(&mut self, time: Time, rate: Vector3<f64>) -> Option<VisualOdometry> {
        let eye = Eye::new(&self.model, &self.axes, 0.0);
        let (now, count) = (self.pose(rate), self.before.map_or(0, |(.., count)| count));
        let (since, before, _) = self.before.replace((time, now, count + 1))?;
        if count % 10 == 0 {
            let one: f64 = StandardNormal.sample(&mut self.seen);
            self.scale = 1.0 + OdometryModel::default().scale_std * one.clamp(-2.0, 2.0);
        }
        let ((c_1, r_1), (c_2, r_2)) = (eye.placed(&before), eye.placed(&now));
        let is_misled = self.trouble == Trouble::Misled && time > Time::from_seconds(5.0);
        let passing = self.truth.velocity * if is_misled { 1.5 } else { 0.0 };
        let way = r_1 * (c_2 - c_1 - passing * (time - since).as_seconds());
        let (rotation_std, std) = (3e-4, 0.01 + 0.02 * way.norm());
        let mut noise = |std: f64| {
            Vector3::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut self.seen) }) * std
        };
        let turn = UnitQuaternion::from_matrix(&(r_1 * r_2.transpose()));
        Some(VisualOdometry {
            time,
            since,
            map: count / 10,
            rotation: turn * UnitQuaternion::new(noise(rotation_std)),
            translation: (way + noise(std)) * self.scale,
            rotation_std,
            translation_std: std * self.scale,
        })
    }

    fn image(&mut self, time: Time, rate: Vector3<f64>) -> CameraFrame {
        let eye = Eye::new(&self.model, &self.axes, 0.0);
        let pose = self.pose(rate);
        let way = self.truth.velocity.normalize();
        let across = (way + way.cross(&self.truth.position.normalize())).normalize();
        let mut points = Vec::new();
        for index in 0..POINTS {
            // every tenth is aboard a ship that passes, not in the direction of one's own way: that is like being nearer
            let passing = if index % 10 == 0 { 1.5 * time.as_seconds() } else { 0.0 };
            let point = self.points[index] + across * passing;
            let at = eye.sight(&pose, &point).map(|sight| sight.at);
            let at = at.filter(|at| self.model.sees(at) && points.len() < 40);
            let (was_seen, visits) = self.visits[index];
            self.visits[index] = (at.is_some(), visits + u64::from(at.is_some() && !was_seen));
            let Some(at) = at else { continue };
            let is_mismatch = self.trouble == Trouble::Noise || self.seen.random_bool(0.01);
            let at = if is_mismatch {
                let within = |size: u32| 0.0..f64::from(size);
                Vector2::new(
                    self.seen.random_range(within(self.model.size[0])),
                    self.seen.random_range(within(self.model.size[1])),
                )
            } else {
                at + Vector2::from_fn(|_, _| -> f64 { StandardNormal.sample(&mut self.seen) })
                    * self.model.pixel_std
            };
            let track = index as u64 + 1000 * self.visits[index].1;
            points.push(ImagePoint { track, at });
        }
        CameraFrame { time, points }
    }
}
