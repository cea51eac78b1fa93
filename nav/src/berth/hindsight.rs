//! How far off the estimate was some time ago, seen from its error of now, on a ship that does not move but for the sea.

use insd_base::earth;
use nalgebra::{Matrix2, Matrix2x3, Matrix3, Vector2};

use crate::Filter;
use crate::error_state::{
    ACCEL_BIAS, ACCEL_DRIFT, ATTITUDE, Errors, GYRO_BIAS, GYRO_DRIFT, Jacobian, POSITION, VELOCITY,
};

/// Terms of the exponential that carries an error back: over a minute the next is below a millionth of the first.
const TERMS: u32 = 6;

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

    /// -phi_D k x d as rows over the attitude.
    pub(super) fn turn(&self, d: &Vector2<f64>) -> Matrix2x3<f64> {
        Vector2::new(d.y, -d.x) * self.c_ne.row(2)
    }

    /// Rows of the error of the displacement `ages` seconds ago, less the turn of it all; the displacement is `d` now.
    pub(super) fn unturned(
        &self,
        d: &Vector2<f64>,
        ages: impl IntoIterator<Item = f64>,
    ) -> Vec<Rows> {
        let now = Rows { position: self.level(), ..Rows::none() };
        let (turn, turn_velocity) = (self.turn(d), self.turn(&self.velocity));
        let ago = |age: f64| {
            let mut rows = self.before(&now, age);
            let to_level = |block: Matrix2x3<f64>| -> Matrix2<f64> {
                (block * self.c_ne.transpose()).fixed_columns::<2>(0).into_owned()
            };
            rows.attitude += to_level(rows.position) * turn;
            rows.attitude += to_level(rows.velocity) * turn_velocity;
            rows
        };
        ages.into_iter().map(ago).collect()
    }

    /// Rows over the error of now of what `rows` say of the error `age` seconds ago: rows e^(-F age).
    fn before(&self, rows: &Rows, age: f64) -> Rows {
        let (mut sum, mut term) = (*rows, *rows);
        for n in 1..TERMS {
            let scale = Matrix2::from_diagonal_element(-age / f64::from(n));
            term = self.rate_of(&term).under(&scale);
            sum = sum.plus(&term);
        }
        sum
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
    fn level(&self) -> Matrix2x3<f64> {
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
        Rows {
            position: self.position + other.position,
            velocity: self.velocity + other.velocity,
            attitude: self.attitude + other.attitude,
            gyro: self.gyro + other.gyro,
            accel: self.accel + other.accel,
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

    /// Puts them into a measurement matrix.
    pub(super) fn fill(&self, h: &mut Jacobian) {
        h.set(POSITION, &self.position);
        h.set(VELOCITY, &self.velocity);
        h.set(ATTITUDE, &self.attitude);
        [GYRO_BIAS, GYRO_DRIFT].iter().for_each(|block| h.set(*block, &self.gyro));
        [ACCEL_BIAS, ACCEL_DRIFT].iter().for_each(|block| h.set(*block, &self.accel));
    }
}
