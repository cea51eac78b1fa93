//! What may be wrong, and what a unit of it does to the measurements.
//!
//! Each row of the effects is one fault of unit size that began at an onset. Rows that belong together, such as
//! the two components of a drift, make a [`FaultGroup`]: they are sized together.

use std::ops::Range;

use insd_base::Fault;
use nalgebra::{DMatrix, Matrix3, SMatrix, Vector2, Vector3};

use super::aid::DOCKING_AIDS;
use crate::error_state::{
    ACCEL_BIAS, ATTITUDE, Effects, GNSS_DELAY, GYRO_BIAS, GYRO_SCALE, RANGING_MARKS, VELOCITY,
    Weighed,
};

/// Sigmas from which on the gain of a log is seen.
const SHOWN: f64 = 3.0;

const GNSS_JUMP: usize = 0;
const GNSS_DRAG: usize = 3;
const GNSS_SLIDE: usize = 5;
const GNSS_CREEP: usize = 7;
const GNSS_VELOCITY: usize = 9;
const LOG_GAIN: usize = 12;
const LOG_OFFSET: usize = 14;
const LOG_FLOW: usize = 16;
const HEADING_OFFSET: usize = 18;
const HEADING_DRIFT: usize = 19;
const REFERENCE_JUMP: usize = 20;
const REFERENCE_DRAG: usize = 22;
const GYRO: usize = 24;
const ACCEL: usize = 27;
const SCALE: usize = 30;
const DELAY: usize = 33;
const TURN: usize = 34;
const SPARE_JUMP: usize = 37;
const SPARE_DRAG: usize = 39;
const PUSH: usize = 41;
/// How many there are of a ship without antennas that are a compass, and without docking aids.
pub const USUAL_ROWS: usize = 44;
const ANTENNAS_OFFSET: usize = 44;
const ANTENNAS_DRIFT: usize = 45;
/// With the former.
pub const ROWS_WITH_ANTENNAS: usize = 46;
const DOCKING_JUMP: usize = 46;
const DOCKING_DRIFT: usize = DOCKING_JUMP + DOCKING_AIDS;
const DOCKING_MARK: usize = DOCKING_DRIFT + DOCKING_AIDS;
/// With all.
pub const ROWS: usize = DOCKING_MARK + RANGING_MARKS;

/// What each fault adds to an innovation of itself, a row for each fault.
pub type Direct = DMatrix<f64>;

/// Faults that are sized together.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultGroup {
    /// What they are.
    pub fault: Fault,
    /// Their rows.
    pub rows: Range<usize>,
    /// How large together they must be to matter, in their unit.
    pub least: f64,
    /// How large each may be, 1-sigma.
    pub size: f64,
    /// Logarithm of how often they begin, 1/s.
    pub log_rate: f64,
}

const fn group(
    fault: Fault,
    start: usize,
    width: usize,
    [least, size]: [f64; 2],
    log_rate: f64,
) -> FaultGroup {
    FaultGroup { fault, rows: start..start + width, least, size, log_rate }
}

/// A receiver that is disturbed or deceived: once in a thousand hours.
const DISTURBED: f64 = -15.1;
/// A receiver that is only compared: twice as often, so that the one in use goes on to be used where it is not known
/// which of the two lies.
const SPARED: f64 = -14.4;
/// A log that fouls, or a compass: once in a hundred.
const FOULED: f64 = -12.8;
/// Antennas of which one is moved, or whole cycles are wrong: once in ten.
const MOVED: f64 = -10.0;
/// A docking aid, through whose beam anybody walks: the same.
const HIDDEN: f64 = -10.5;
/// A part that fails: once in some ten thousand.
const FAILED: f64 = -17.4;

/// Of [`ALL`], the one of gyros that have another bias.
pub const OF_GYROS: usize = 13;
/// The one of gyros that told a turn that was none.
pub const OF_FALSE_TURNS: usize = 14;
/// The one of accelerometers that told a push that was none, or none that was.
pub const OF_FALSE_PUSHES: usize = 20;
/// The one of the gyro about the vertical, alone.
pub const OF_ONE_GYRO: usize = 21;
/// How many groups there are.
pub const GROUPS: usize = 36;

/// All groups.
pub const ALL: [FaultGroup; GROUPS] = [
    group(Fault::Jump, GNSS_JUMP, 3, [3.0, 1e3], DISTURBED),
    group(Fault::Height, GNSS_JUMP + 2, 1, [3.0, 1e3], DISTURBED),
    group(Fault::Drag, GNSS_DRAG, 2, [0.03, 3.0], DISTURBED),
    group(Fault::Slide, GNSS_SLIDE, 2, [0.03, 3.0], DISTURBED),
    group(Fault::Creep, GNSS_CREEP, 2, [3e-4, 0.02], DISTURBED),
    group(Fault::Velocity, GNSS_VELOCITY, 3, [0.15, 10.0], DISTURBED),
    group(Fault::LogGain, LOG_GAIN, 2, [0.03, 1.0], FOULED),
    group(Fault::LogOffset, LOG_OFFSET, 2, [0.15, 3.0], FOULED),
    group(Fault::LogFlow, LOG_FLOW, 2, [0.15, 2.0], FOULED),
    group(Fault::HeadingOffset, HEADING_OFFSET, 1, [0.01, 1.0], FOULED),
    group(Fault::HeadingDrift, HEADING_DRIFT, 1, [1e-5, 3e-4], FOULED),
    group(Fault::ReferenceJump, REFERENCE_JUMP, 2, [3.0, 1e3], DISTURBED),
    group(Fault::ReferenceDrag, REFERENCE_DRAG, 2, [0.05, 3.0], DISTURBED),
    group(Fault::GyroBias, GYRO, 3, [2e-5, 0.02], FAILED),
    group(Fault::GyroBias, TURN, 3, [1e-3, 0.5], FAILED),
    group(Fault::AccelBias, ACCEL, 3, [5e-3, 1.0], FAILED),
    group(Fault::GyroScale, SCALE, 3, [0.05, 1.0], FAILED),
    group(Fault::Delay, DELAY, 1, [0.1, 2.0], DISTURBED),
    group(Fault::SpareJump, SPARE_JUMP, 2, [5.0, 1e3], SPARED),
    group(Fault::SpareDrag, SPARE_DRAG, 2, [0.05, 3.0], SPARED),
    group(Fault::AccelBias, PUSH, 3, [0.3, 10.0], FAILED),
    // alone: that the others tell well that they have none is no reason against it
    group(Fault::GyroBias, GYRO + 2, 1, [2e-5, 0.02], FAILED),
    group(Fault::AntennasOffset, ANTENNAS_OFFSET, 1, [0.01, 1.0], MOVED),
    group(Fault::AntennasDrift, ANTENNAS_DRIFT, 1, [1e-5, 3e-3], MOVED),
    docking_jump(0),
    docking_jump(1),
    docking_jump(2),
    docking_jump(3),
    docking_drift(0),
    docking_drift(1),
    docking_drift(2),
    docking_drift(3),
    docking_mark(0),
    docking_mark(1),
    docking_mark(2),
    docking_mark(3),
];

const fn docking_jump(number: u8) -> FaultGroup {
    let row = DOCKING_JUMP + number as usize;
    group(Fault::DockingJump(number), row, 1, [0.1, 5.0], HIDDEN)
}

const fn docking_drift(number: u8) -> FaultGroup {
    let row = DOCKING_DRIFT + number as usize;
    group(Fault::DockingDrift(number), row, 1, [0.003, 0.3], HIDDEN)
}

const fn docking_mark(place: u8) -> FaultGroup {
    let row = DOCKING_MARK + place as usize;
    group(Fault::DockingMark(place), row, 1, [0.1, 5.0], FOULED)
}

/// The effects at an onset: gyros and accelerometers have another bias or scale factor from then on, or have
/// told a turn or a push that was none, and the receiver has another delay. So many faults may be.
#[must_use]
pub fn at_onset(rows: usize) -> Effects {
    let mut effects = Effects::none(rows.max(USUAL_ROWS));
    for (start, block) in [
        (GYRO, GYRO_BIAS),
        (ACCEL, ACCEL_BIAS),
        (SCALE, GYRO_SCALE),
        (TURN, ATTITUDE),
        (PUSH, VELOCITY),
    ] {
        effects.set(start, block, &Matrix3::identity());
    }
    effects.set(DELAY, GNSS_DELAY, &SMatrix::<f64, 1, 1>::identity());
    effects
}

/// Of nothing that is measured, so many rows.
#[must_use]
pub fn untouched(rows: usize) -> Direct {
    Direct::zeros(USUAL_ROWS, rows)
}

fn put<const M: usize, const W: usize>(
    direct: &mut Direct,
    row: usize,
    value: &SMatrix<f64, W, M>,
) {
    direct.fixed_view_mut::<W, M>(row, 0).copy_from(value);
}

/// Of a GNSS position, `age` seconds after the onset.
#[must_use]
pub fn of_gnss_position(age: f64) -> Direct {
    let mut direct = untouched(3);
    let flat = SMatrix::<f64, 2, 3>::identity();
    put(&mut direct, GNSS_JUMP, &Matrix3::identity());
    put(&mut direct, GNSS_DRAG, &(flat * age));
    put(&mut direct, GNSS_SLIDE, &(flat * age));
    put(&mut direct, GNSS_CREEP, &(flat * (0.5 * age * age)));
    direct
}

/// Of a GNSS velocity.
#[must_use]
pub fn of_gnss_velocity(age: f64) -> Direct {
    let mut direct = untouched(3);
    let flat = SMatrix::<f64, 2, 3>::identity();
    put(&mut direct, GNSS_DRAG, &flat);
    put(&mut direct, GNSS_CREEP, &(flat * age));
    put(&mut direct, GNSS_VELOCITY, &Matrix3::identity());
    direct
}

/// Of all three components of a log that should say `through`, body axes, m/s; `c_nb` from body to NED axes.
#[must_use]
pub fn of_log(through: &Vector3<f64>, c_nb: &Matrix3<f64>) -> Direct {
    let mut direct = untouched(3);
    let (u, v) = (through.x, through.y);
    put(&mut direct, LOG_GAIN, &SMatrix::<f64, 2, 3>::new(u, v, 0.0, -v, u, 0.0));
    put(&mut direct, LOG_OFFSET, &SMatrix::<f64, 2, 3>::identity());
    put(&mut direct, LOG_FLOW, &c_nb.fixed_rows::<2>(0).into_owned());
    direct
}

/// An axis along which a log measures, by what is told of its faults: level, in the body's axes and towards north and east.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Forward and starboard.
    pub body: Vector2<f64>,
    /// North and east.
    pub level: Vector2<f64>,
}

/// The axis of a row of a log, and the level one to the right of it; zero of what is no log.
#[must_use]
pub fn axes_of_log(direct: &Direct, row: usize) -> [Axis; 2] {
    let [body, level] =
        [LOG_OFFSET, LOG_FLOW].map(|at| Vector2::new(direct[(at, row)], direct[(at + 1, row)]));
    let right = |axis: Vector2<f64>| Vector2::new(-axis.y, axis.x);
    [Axis { body, level }, Axis { body: right(body), level: right(level) }]
}

/// What the log should say along the two, m/s.
#[must_use]
pub fn told_by_log(direct: &Direct, row: usize) -> [f64; 2] {
    [direct[(LOG_GAIN, row)], -direct[(LOG_GAIN + 1, row)]]
}

/// Whether a log that is off by a gain, along and across, would be seen to be by what it says at this moment: of a ship that lies still
/// nobody sees it.
#[must_use]
pub fn would_show(direct: &Direct, gain: &Vector2<f64>, weighed: &Weighed) -> bool {
    let lie = Direct::from_fn(1, direct.ncols(), |_, row| {
        let [through, across] = told_by_log(direct, row);
        gain.x * through - gain.y * across
    });
    weighed.whiten(lie).norm_squared() > SHOWN * SHOWN * weighed.rows() as f64
}

/// Of a heading.
#[must_use]
pub fn of_heading(age: f64) -> Direct {
    let mut direct = untouched(1);
    direct[HEADING_OFFSET] = 1.0;
    direct[HEADING_DRIFT] = age;
    direct
}

/// Of the position of another reference, north and east.
#[must_use]
pub fn of_reference_position(age: f64) -> Direct {
    let mut direct = untouched(2);
    let flat = SMatrix::<f64, 2, 2>::identity();
    put(&mut direct, REFERENCE_JUMP, &flat);
    put(&mut direct, REFERENCE_DRAG, &(flat * age));
    direct
}

/// Of its velocity, north and east.
#[must_use]
pub fn of_reference_velocity() -> Direct {
    let mut direct = untouched(2);
    put(&mut direct, REFERENCE_DRAG, &SMatrix::<f64, 2, 2>::identity());
    direct
}

/// Of the position of a receiver that is compared, north and east.
#[must_use]
pub fn of_spare_position(age: f64) -> Direct {
    let mut direct = untouched(2);
    let flat = SMatrix::<f64, 2, 2>::identity();
    put(&mut direct, SPARE_JUMP, &flat);
    put(&mut direct, SPARE_DRAG, &(flat * age));
    direct
}

/// Of its velocity, north and east.
#[must_use]
pub fn of_spare_velocity() -> Direct {
    let mut direct = untouched(2);
    put(&mut direct, SPARE_DRAG, &SMatrix::<f64, 2, 2>::identity());
    direct
}

/// Of a heading by several antennas.
#[must_use]
pub fn of_antennas(age: f64) -> Direct {
    let mut direct = Direct::zeros(ROWS_WITH_ANTENNAS, 1);
    direct[ANTENNAS_OFFSET] = 1.0;
    direct[ANTENNAS_DRIFT] = age;
    direct
}

/// Of a distance of a docking aid, by its number, that measures to a line or point, by its place among the states.
#[must_use]
pub fn of_docking(number: usize, place: usize, age: f64) -> Direct {
    let mut direct = Direct::zeros(ROWS, 1);
    direct[DOCKING_JUMP + number] = 1.0;
    direct[DOCKING_DRIFT + number] = age;
    direct[DOCKING_MARK + place] = 1.0;
    direct
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error_state::{Covariance, Innovation, Jacobian, all_states};

    #[test]
    fn a_log_that_is_reversed_would_show_under_way_and_not_at_the_berth() {
        let noise = Matrix3::from_diagonal_element(0.05 * 0.05);
        let innovation = Innovation::new(&Vector3::zeros(), Jacobian::none(3), &noise);
        let weighed = innovation.weigh(&Covariance::zeros(&all_states())).unwrap();
        let shows = |speed: f64| {
            let direct = of_log(&Vector3::new(speed, 0.0, 0.0), &Matrix3::identity());
            would_show(&direct, &Vector2::new(-2.0, 0.0), &weighed)
        };
        assert!(shows(2.0) && !shows(0.05));
    }

    #[test]
    fn every_row_belongs_to_a_group() {
        let mut rows: Vec<usize> = ALL.iter().flat_map(|group| group.rows.clone()).collect();
        rows.sort_unstable();
        rows.dedup();
        assert_eq!(rows, (0..ROWS).collect::<Vec<_>>());
        assert!(ALL.iter().all(|group| group.rows.len() <= 3));
        assert_eq!(ALL[OF_GYROS].rows.start, GYRO);
        assert_eq!(ALL[OF_FALSE_TURNS].rows.start, TURN);
        assert_eq!(ALL[OF_FALSE_PUSHES].rows.start, PUSH);
        assert_eq!(ALL[OF_ONE_GYRO].rows, GYRO + 2..GYRO + 3);
    }
}
