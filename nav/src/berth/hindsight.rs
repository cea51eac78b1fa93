//! How far off the estimate was some time ago, seen from its error of now, on a ship that does not move but for the sea.

use insd_base::earth;
use nalgebra::{Matrix2, Matrix2x3, Matrix3, Vector2};

use crate::Filter;
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ATTITUDE, Errors, GYRO_BIAS, GYRO_DRIFT, Jacobian, POSITION, VELOCITY,
};

/// Terms of the exponential that carries an error back: over a minute the next is below a millionth of the first.
const TERMS: usize = 6;

/// Two rows, north and east, over the errors that an inertial navigator moves by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows {
    position: Matrix2x3<f64>,
    velocity: Matrix2x3<f64>,
    attitude: Matrix2x3<f64>,
    gyro: Matrix2x3<f64>,
    accel: Matrix2x3<f64>,
}

/// The error equations of a ship that does not move ([`crate::propagation`]; her specific force f is -g),
///
/// dr' = dv,   dv' = -(g/R) dr_level - 2 omega x dv - f x phi - C db_a,   phi' = -omega x phi - C db_g,
///
/// and the estimate that they start from. Of a motion of the sea an error of the heading turns everything alike, dr by
/// phi_D k x d and dv by phi_D k x v ([`crate::aids::berth`]); what is left beside that goes by these equations.
pub(super) struct Hindsight {
    force: Matrix3<f64>,
    rate: Matrix3<f64>,
    c_eb: Matrix3<f64>,
    c_ne: Matrix3<f64>,
    stiffness: Matrix3<f64>,
    velocity: Vector2<f64>,
}

impl Hindsight {
    pub(super) fn of(filter: &Filter) -> Self {
        let view = filter.view();
        let down = view.c_ne.row(2).transpose();
        let gravity = earth::normal_gravity(view.geodetic.latitude, view.geodetic.height);
        let level = Matrix3::identity() - down * down.transpose();
        Hindsight {
            force: (down * -gravity).cross_matrix(),
            rate: earth::rate_e().cross_matrix(),
            c_eb: view.c_eb,
            c_ne: view.c_ne,
            stiffness: level * (gravity / filter.nominal().position.norm()),
            velocity: view.v_n().xy(),
        }
    }

    /// From forward and starboard to north and east.
    pub(super) fn ship_axes(&self) -> Matrix2<f64> {
        let forward = (self.c_ne * self.c_eb.column(0)).xy().normalize();
        Matrix2::new(forward.x, -forward.y, forward.y, forward.x)
    }

    /// -phi_D k x d as rows over the attitude.
    pub(super) fn turn(&self, d: &Vector2<f64>) -> Matrix2x3<f64> {
        Vector2::new(d.y, -d.x) * self.c_ne.row(2)
    }

    /// The error of the displacement at any time before now, less the turn of it all; the displacement is `d` now.
    pub(super) fn unturned(&self, d: &Vector2<f64>) -> Unturned {
        let (turn, turn_velocity) = (self.turn(d), self.turn(&self.velocity));
        let to_level = |block: Matrix2x3<f64>| -> Matrix2<f64> {
            (block * self.c_ne.transpose()).fixed_columns::<2>(0).into_owned()
        };
        let mut power = Rows { position: self.level(), ..Rows::none() };
        let powers = std::array::from_fn(|_| {
            let this = power;
            power = self.rate_of(&power);
            let turned = to_level(this.position) * turn + to_level(this.velocity) * turn_velocity;
            Rows { attitude: this.attitude + turned, ..this }
        });
        Unturned { powers }
    }

    /// Derivatives by time of the error of the velocity, north and east: m/s, m/s^2, and so on, if an error is never
    /// corrected.
    pub(super) fn derivatives<const N: usize>(&self, error: &Errors) -> [Vector2<f64>; N] {
        let mut rows = Rows { velocity: self.level(), ..Rows::none() };
        std::array::from_fn(|_| {
            let now = rows.times(error);
            rows = self.rate_of(&rows);
            now
        })
    }

    /// From ECEF axes to north and east.
    pub(super) fn level(&self) -> Matrix2x3<f64> {
        self.c_ne.fixed_rows::<2>(0).into_owned()
    }

    /// rows F.
    fn rate_of(&self, rows: &Rows) -> Rows {
        Rows {
            position: -rows.velocity * self.stiffness,
            velocity: rows.position - rows.velocity * self.rate * 2.0,
            attitude: -rows.velocity * self.force - rows.attitude * self.rate,
            gyro: -rows.attitude * self.c_eb,
            accel: -rows.velocity * self.c_eb,
        }
    }
}

/// The error of a displacement before now, by the powers of F: e^(-F age).
pub(super) struct Unturned {
    powers: [Rows; TERMS],
}

impl Unturned {
    /// As rows over the error of now, so many seconds ago.
    pub(super) fn rows(&self, age: f64) -> Rows {
        let terms = self.powers.iter().zip(series(age));
        terms.fold(Rows::none(), |sum, (power, factor)| sum.plus_scaled(power, factor))
    }

    /// Of this error of now, so many seconds ago, north and east, m.
    pub(super) fn of(&self, error: &Errors) -> impl Fn(f64) -> Vector2<f64> + use<> {
        let powers = self.powers.map(|power| power.times(error));
        move |age| powers.iter().zip(series(age)).map(|(power, factor)| power * factor).sum()
    }
}

/// (-age)^n / n!, n = 0, 1, ..
fn series(age: f64) -> [f64; TERMS] {
    let mut term = 1.0;
    std::array::from_fn(|n| {
        let this = term;
        term *= -age / (n + 1) as f64;
        this
    })
}

impl Rows {
    fn none() -> Self {
        let none = Matrix2x3::zeros();
        Rows { position: none, velocity: none, attitude: none, gyro: none, accel: none }
    }

    /// A times these rows.
    pub(super) fn under(&self, a: &Matrix2<f64>) -> Self {
        Rows {
            position: a * self.position,
            velocity: a * self.velocity,
            attitude: a * self.attitude,
            gyro: a * self.gyro,
            accel: a * self.accel,
        }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        self.plus_scaled(other, 1.0)
    }

    fn plus_scaled(&self, other: &Self, factor: f64) -> Self {
        Rows {
            position: self.position + other.position * factor,
            velocity: self.velocity + other.velocity * factor,
            attitude: self.attitude + other.attitude * factor,
            gyro: self.gyro + other.gyro * factor,
            accel: self.accel + other.accel * factor,
        }
    }

    /// What they make of an error.
    pub(super) fn times(&self, error: &Errors) -> Vector2<f64> {
        self.position * error.of(POSITION)
            + self.velocity * error.of(VELOCITY)
            + self.attitude * error.of(ATTITUDE)
            + self.gyro * (error.of(GYRO_BIAS) + error.of(GYRO_DRIFT))
            + self.accel * (error.of(ACCEL_BIAS) + error.of(ACCEL_DRIFT))
    }

    /// Over position, velocity, attitude, what is wrong with the gyros, and with the accelerometers.
    pub(super) fn blocks(&self) -> [&Matrix2x3<f64>; 5] {
        [&self.position, &self.velocity, &self.attitude, &self.gyro, &self.accel]
    }

    /// Puts them into a measurement matrix.
    pub(super) fn fill(&self, h: &mut Jacobian) {
        h.set(POSITION, &self.position);
        h.set(VELOCITY, &self.velocity);
        h.set(ATTITUDE, &self.attitude);
        [GYRO_BIAS, GYRO_DRIFT].iter().for_each(|block| h.set(*block, &self.gyro));
        [ACCEL_BIAS, ACCEL_DRIFT].iter().for_each(|block| h.set(*block, &self.accel));
    }
}
