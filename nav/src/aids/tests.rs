//! Measurement matrices against perturbed predictions, driven from one table.

use insd_base::satellites::{
    AntennaPhase, AntennaSignal, ArcPhase, LineBias, Measured, SatelliteRange, Transmitter,
};
use insd_base::units::DEG;
use insd_base::{
    Attitude, Body, Geodetic, LogReference, RangingBeam, RangingLine, RangingReading,
    RangingTarget, SignalCode, Time,
};
use insd_estimation::Place;
use nalgebra::{Vector2, Vector3, Vector4};

use super::satellite_range::Sighted;
use super::*;
use crate::error_state::{ANTENNA_AXES, ANTENNA_LINES, ATTITUDE, Innovation};
use crate::error_state::{all_states, no_errors};

const MEASURED_RATE: Vector3<f64> = Vector3::new(0.02, -0.05, 0.03);

/// Where a reference has her.
fn there() -> Geodetic {
    Geodetic::from_degrees(52.000_01, 179.900_02, 0.0)
}

fn estimate() -> Nominal {
    let attitude = Attitude { roll: 0.2, pitch: -0.1, heading: 2.2 };
    let place = Geodetic::from_degrees(52.0, 179.9, 25.0);
    let mut nominal = Nominal::at(&place, &Vector3::new(5.0, -3.0, 0.4), &attitude.c_nb());
    nominal.gnss_position_error = Vector3::new(0.3, -0.4, 0.5);
    nominal.gnss_velocity_error = Vector3::new(-0.3, 0.1, 0.2);
    nominal.gnss_velocity_delay = 0.04;
    nominal.gnss_delay = -0.02;
    nominal.current = Vector2::new(0.4, -0.6);
    nominal.berth_offset = Vector2::new(0.3, -0.2);
    nominal.sway = Vector4::new(-0.1, 0.4, 0.2, 0.1);
    nominal.log_scale = 0.01;
    nominal.log_misalignment = Vector2::new(0.02, -0.03);
    nominal.log_by_speed = Vector2::new(0.004, -0.003);
    nominal.log_by_turn = Vector2::new(-4.0, -6.0);
    nominal.sea_level = 24.0;
    nominal.heading_error = 0.4;
    nominal.position_error = Vector2::new(0.7, -1.1);
    nominal.antenna_heading_error = -0.6;
    nominal.antenna_heading_offset = 0.01;
    nominal.receiver_clock = Vector2::new(120.0, 0.3);
    nominal.system_offsets = Vector3::new(5.0, -3.0, 2.0);
    nominal.range_errors[7] = 0.6;
    nominal.reflections[7] = -0.3;
    nominal.ionosphere = 0.2;
    nominal.phase_constants[7] = 1.5;
    nominal.ranging_errors[3] = 0.7;
    nominal.ranging_errors[4] = -0.9;
    nominal.ranging_errors[5] = 0.4;
    nominal
}

/// Innovation as a list of rows, whatever its size.
type Rows = Vec<(f64, Vec<f64>)>;

fn rows(innovation: &Innovation) -> Rows {
    let h = innovation.h.to_matrix(&all_states());
    let row = |i: usize| (innovation.z[i], h.row(i).iter().copied().collect());
    (0..innovation.rows()).map(row).collect()
}

const LEVER: Vector3<f64> = Vector3::new(-6.0, -0.8, -14.0);

/// A satellite of Galileo over the estimate, and its antenna.
fn sighted(view: &View) -> (satellite_range::Antenna, SatelliteRange) {
    let over = estimate().position.normalize() * 2.9e7 + Vector3::new(4e6, 5e6, -3e6);
    let measured = Measured { value: 2.4e7, variance: 0.1 };
    let range = SatelliteRange {
        satellite: "E11".parse().unwrap(),
        offset: Vector3::new(0.4, -0.7, 0.2),
        transmitter: Transmitter { position: over, velocity: Vector3::new(1200.0, -900.0, 2100.0) },
        elevation: 1.0,
        code: Some(measured),
        rate: Some(Measured { value: 300.0, variance: 0.01 }),
        phase: Some(ArcPhase { phase: measured, arc: 3 }),
        slow_std: 1.7,
        by_ionosphere: 4.2,
        multipath_std: 0.4,
    };
    let lever = LEVER + view.nominal.gnss_lever;
    (satellite_range::Antenna::of(view, &lever, &Vector3::new(5.0, -3.0, 0.4)), range)
}

/// The phase of an antenna whose line is the fifth.
fn compared(view: &View) -> Rows {
    let signal = SignalCode { band: 1, attribute: b'C' };
    let satellite = "G03".parse().unwrap();
    let phase = AntennaPhase {
        lever: Vector3::new(1.0, 0.2, -0.1),
        phase: 0.01,
        variance: 1e-6,
        line: Some(LineBias::new(1, satellite, signal, signal)),
        clock: None,
    };
    let gradient = Vector3::new(0.3, -0.5, 0.7).normalize();
    let told = AntennaSignal { satellite, signal, wavelength: 0.19, gradient, phases: vec![phase] };
    let (z, turned) = antenna_phases::beyond(view, (&told, &phase), Some(4));
    let mut h = vec![0.0; all_states().states()];
    let place = |key| all_states().start(key).unwrap();
    h[place(ATTITUDE.key())..][..3].copy_from_slice(turned.as_slice());
    h[place(ANTENNA_AXES.key())..][..3]
        .copy_from_slice((view.c_eb.transpose() * turned).as_slice());
    h[place(ANTENNA_LINES.key()) + 4] = 1.0;
    vec![(z, h)]
}

/// A named aid and its rows.
type Entry = (&'static str, fn(&View) -> Rows);

fn ranging_table() -> Vec<Entry> {
    vec![
        ("antenna_heading", |view| rows(&antenna_heading::innovation(view, 2.25, 0.02))),
        ("ranging_across", |view| ranging_rows(view, by_quay(RangingBeam::Across))),
        ("ranging_ashore", |view| ranging_rows(view, by_quay(RangingBeam::Ashore(40.0)))),
        ("ranging_aboard", |view| {
            let direction = Body::new(0.3, -0.93, 0.2);
            ranging_rows(view, by_quay(RangingBeam::Aboard(direction)))
        }),
        ("ranging_point", |view| {
            let place = Geodetic::from_degrees(52.000_1, 179.900_4, 60.0);
            ranging_rows(view, RangingTarget::Point { place, std: [0.3, 0.6] })
        }),
    ]
}

fn table() -> Vec<Entry> {
    let position = |view: &View| {
        let fix = gnss_position::PositionFix {
            position: Geodetic::from_degrees(52.000_01, 179.900_02, 40.0),
            white: Vector3::repeat(0.5),
            slow: Vector3::new(0.8, 0.8, 1.4),
            velocity: Vector3::new(5.0, -3.0, 0.4),
        };
        rows(&gnss_position::innovation(view, &fix, &(LEVER + view.nominal.gnss_lever)))
    };
    let velocity = |view: &View| {
        let fix = gnss_velocity::VelocityFix {
            velocity: Vector3::new(4.0, -3.0, 0.2),
            white: Vector3::repeat(0.03),
            slow: Vector3::repeat(0.01),
            acceleration: Vector3::new(0.3, -0.2, 0.5),
        };
        rows(&gnss_velocity::innovation(view, &fix, &(LEVER + view.nominal.gnss_lever)))
    };
    vec![
        ("gnss_position", position),
        ("gnss_velocity", velocity),
        ("log_bottom", |view| log_rows(view, LogReference::Bottom)),
        ("log_water", |view| log_rows(view, LogReference::Water)),
        ("berth", |view| rows(&berth::innovation(view, &berth_of_the_swaying_ship(), 0.1))),
        ("sea_level", |view| {
            let half = 10.0 * view.v_n().z;
            let mean = view.geodetic.height + half;
            rows(&sea_level::innovation(view, mean, 20.0, 0.3))
        }),
        ("satellite_code", |view| {
            let (antenna, range) = sighted(view);
            rows(
                &satellite_range::code(view, &antenna, Sighted { range: &range, slot: 7 }).unwrap(),
            )
        }),
        ("satellite_phase", |view| {
            let (antenna, range) = sighted(view);
            rows(
                &satellite_range::phase(view, &antenna, Sighted { range: &range, slot: 7 })
                    .unwrap(),
            )
        }),
        ("satellite_rate", |view| {
            let (antenna, range) = sighted(view);
            let lever = LEVER + view.nominal.gnss_lever;
            rows(&satellite_range::rate(view, &antenna, &range, &lever).unwrap())
        }),
        ("antenna_phases", compared),
        ("reference_heading", |view| rows(&reference_heading::innovation(view, 2.0, DEG))),
        ("reference_velocity", |view| {
            rows(&reference_velocity::innovation(view, &Vector2::new(5.0, -3.0), 0.1))
        }),
        ("reference_position", |view| rows(&reference_position::innovation(view, &there(), 0.3))),
        ("reference_position with an error that stays", |view| {
            rows(&reference_position::with_lasting_error(view, &there(), 15.0, 100.0))
        }),
    ]
}

/// The berth from which the estimate is as far away as its swaying says: a turn about the berth is
/// then without effect.
fn berth_of_the_swaying_ship() -> Geodetic {
    let nominal = estimate();
    let away = nominal.berth_offset + nominal.swaying();
    let here = nominal.geodetic();
    let c_en = earth::c_ne(&here).transpose();
    let place = nominal.position - c_en * Vector3::new(away.x, away.y, 0.0);
    Geodetic { height: here.height, ..earth::geodetic(&insd_base::Ecef(place)) }
}

fn log_rows(view: &View, reference: LogReference) -> Rows {
    let prediction = log_velocity::predict(view, reference, &Vector3::new(9.0, -1.0, 9.0), 0.02);
    rows(&log_velocity::complete(&prediction, &Vector3::new(5.0, 0.5, 0.1), 0.03))
}

/// A quay on her port side, 40 m off and 20 degrees from parallel to her.
fn by_quay(beam: RangingBeam) -> RangingTarget {
    let c_en = earth::c_ne(&estimate().geodetic()).transpose();
    let at = |ahead: f64| {
        let heading = 2.2 + 0.35;
        let (across, along) = (heading - 0.5 * std::f64::consts::PI, heading);
        let way = Vector3::new(across.cos(), across.sin(), 0.0) * 40.0
            + Vector3::new(along.cos(), along.sin(), 0.0) * ahead;
        earth::geodetic(&insd_base::Ecef(estimate().position + c_en * way))
    };
    let ends = [at(-60.0), at(90.0)];
    RangingTarget::Line(RangingLine { ends, water_right: true, std: 0.4, beam })
}

fn ranging_rows(view: &View, target: RangingTarget) -> Rows {
    let lever = Body::new(-6.0, -8.0, 4.0);
    let reading =
        RangingReading { time: Time::START, mark: 9, target, lever, distance: 30.0, std: 0.03 };
    let prediction = ranging::predict(view, &reading, 1).unwrap();
    rows(&ranging::innovation(&prediction, &reading, 1, 0.0))
}

fn view_moved_by(state: usize, amount: f64) -> View {
    let mut error = no_errors();
    let layout = all_states();
    let is_there = |place: &&Place| (place.start..place.start + place.width).contains(&state);
    if let Some(place) = layout.places().iter().find(is_there) {
        let own = |i: usize| if place.start + i == state { amount } else { 0.0 };
        error.fill(place.key, (0..place.width).map(own));
    }
    let mut nominal = estimate();
    nominal.inject(&error);
    View::new(&nominal, &MEASURED_RATE, 0.0)
}

/// A step large enough against rounding, of ranges of 20 000 km, too, and small enough against curvature.
fn step_of(name: &str, state: usize) -> f64 {
    match state {
        0..3 if name.starts_with("ranging") => 0.01,
        0..3 => 1.0,
        _ if name.starts_with("satellite") || name.starts_with("ranging") => 1e-3,
        _ => 1e-5,
    }
}

#[test]
fn every_measurement_matrix_agrees_with_perturbed_predictions() {
    for (name, rows_of) in table().into_iter().chain(ranging_table()) {
        let here = rows_of(&view_moved_by(0, 0.0));
        for state in 0..all_states().states() {
            let step = step_of(name, state);
            let ahead = rows_of(&view_moved_by(state, step));
            let behind = rows_of(&view_moved_by(state, -step));
            for (row, (_, h)) in here.iter().enumerate() {
                // moving the estimate by +x lowers the innovation by H x
                let slope = -(ahead[row].0 - behind[row].0) / (2.0 * step);
                let tolerance = 2e-5 * (1.0 + h[state].abs());
                assert!(
                    (slope - h[state]).abs() < tolerance,
                    "{name} row {row} state {state}: slope {slope}, matrix {}",
                    h[state],
                );
            }
        }
    }
}
