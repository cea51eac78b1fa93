//! Velocity logs.

use insd_base::units::DEG;
use insd_base::{Attitude, LogReference, LogVelocity, Time, Voyage};
use insd_wire::log::LogFrame;
use insd_wire::log::pd0::{
    BottomTrack, Coordinates, Ensemble, FixedLeader, Geometry, Transformation, VariableLeader,
    WaterLayer,
};
use insd_wire::log::pd6::Pd6;
use insd_wire::nmea::{NortekBottomTrack, Talker, Vbw, VbwVelocity};
use nalgebra::{Matrix3, Vector3};

use super::config::mounting;
use super::line::Line;
use super::sensor::{Encoding, SensorFeed};

/// How the beams of the Doppler log stand.
const JANUS: Geometry = Geometry { angle: 30.0 * DEG, convex: true, up: false };
/// Steps of the angles in which an instrument tells its attitude, rad.
const ANGLE: f64 = 0.01 * DEG;

pub(super) fn encode(voyage: &Voyage, sensor: &SensorFeed, line: &mut Line) {
    for (number, stamped) in (0..).zip(&voyage.log) {
        let log = &stamped.message;
        let attitude = attitude(voyage, log.time);
        match sensor.encoding {
            Encoding::Pd0(frame) => {
                line.send(log.time, &ensemble(log, frame, sensor, attitude, number).write());
            }
            Encoding::Pd6(frame) => line.send(log.time, &pd6(log, frame, sensor).write()),
            Encoding::Nortek => line.send(log.time, nortek(log, sensor).write().as_bytes()),
            _ => line.send(log.time, vbw(log).write(Talker::VD).as_bytes()),
        }
    }
}

/// The true attitude nearest to an instant, in the steps of the instrument.
fn attitude(voyage: &Voyage, time: Time) -> Attitude {
    let after = voyage.truth.partition_point(|truth| truth.time < time);
    let truth = voyage.truth.get(after).or(voyage.truth.last());
    let own = truth.and_then(|truth| truth.attitude).unwrap_or_default();
    let stepped = |angle: f64| (angle / ANGLE).round() * ANGLE;
    Attitude { roll: stepped(own.roll), pitch: stepped(own.pitch), heading: stepped(own.heading) }
}

fn vector(log: &LogVelocity) -> Vector3<f64> {
    Vector3::new(log.u.unwrap_or(0.0), log.v.unwrap_or(0.0), log.w.unwrap_or(0.0))
}

fn in_device_axes(log: &LogVelocity, sensor: &SensorFeed) -> Vector3<f64> {
    mounting(sensor.encoding).c_bd().unwrap_or_else(Matrix3::identity).transpose() * vector(log)
}

fn vbw(log: &LogVelocity) -> Vbw {
    let own = VbwVelocity { longitudinal: log.u, transverse: log.v, valid: true };
    match log.reference {
        LogReference::Bottom => Vbw { ground: own, ..Vbw::default() },
        LogReference::Water => Vbw { water: own, ..Vbw::default() },
    }
}

fn pd6(log: &LogVelocity, frame: LogFrame, sensor: &SensorFeed) -> Pd6 {
    let velocity = match frame {
        LogFrame::Ship => [log.v, log.u, log.w.map(|down| -down), None],
        _ => {
            let own = in_device_axes(log, sensor);
            [Some(own.x), Some(own.y), Some(own.z), Some(0.0)]
        }
    };
    Pd6::Velocity { reference: log.reference, frame, velocity }
}

fn nortek(log: &LogVelocity, sensor: &SensorFeed) -> NortekBottomTrack {
    NortekBottomTrack {
        time: sensor.calendar.civil(log.time).to_utc(),
        trigger_to_echo: Some(0.0),
        echo_to_output: Some(sensor.latency),
        velocity: in_device_axes(log, sensor).data.0[0].map(Some),
        figure_of_merit: log.std,
        distances: [Some(40.0); 4],
        ..NortekBottomTrack::default()
    }
}

fn ensemble(
    log: &LogVelocity,
    frame: LogFrame,
    sensor: &SensorFeed,
    attitude: Attitude,
    number: u32,
) -> Ensemble {
    let velocity = wire_velocity(log, frame, sensor, &attitude);
    let over_ground = log.reference == LogReference::Bottom;
    let water = WaterLayer { velocity, percent_good: [100; 4], ..WaterLayer::default() };
    let bottom = if over_ground {
        BottomTrack { velocity, ..BottomTrack::default() }
    } else {
        BottomTrack { velocity: [None; 4], water, ..BottomTrack::default() }
    };
    Ensemble {
        fixed: fixed_leader(frame),
        variable: VariableLeader {
            number,
            clock: None,
            self_test: 0,
            sound: 1500.0,
            depth: 4.0,
            heading: attitude.heading,
            pitch: attitude.pitch,
            roll: attitude.roll,
            salinity: 35.0,
            temperature: 12.0,
        },
        bottom: Some(bottom),
    }
}

fn fixed_leader(frame: LogFrame) -> FixedLeader {
    let coordinates = match frame {
        LogFrame::Beam => Coordinates::Beam,
        LogFrame::Instrument => Coordinates::Instrument,
        LogFrame::Ship => Coordinates::Ship,
        LogFrame::Earth => Coordinates::Earth,
    };
    FixedLeader {
        firmware: [51, 40],
        frequency: Some(300e3),
        geometry: Some(JANUS),
        beams: 4,
        cells: 0,
        transformation: Transformation {
            coordinates,
            tilts: frame == LogFrame::Earth,
            three_beams: false,
            mapped: false,
        },
        heading_alignment: 0.0,
        heading_bias: 0.0,
    }
}

/// The velocity of the bottom or the water past the instrument, as PD0 has it.
fn wire_velocity(
    log: &LogVelocity,
    frame: LogFrame,
    sensor: &SensorFeed,
    attitude: &Attitude,
) -> [Option<f64>; 4] {
    let past = -in_device_axes(log, sensor);
    let [x, y, z] = match frame {
        LogFrame::Beam => return beams(&past).map(Some),
        LogFrame::Instrument => past.into(),
        LogFrame::Ship => [-log.v.unwrap_or(0.0), -log.u.unwrap_or(0.0), log.w.unwrap_or(0.0)],
        LogFrame::Earth => {
            let v_n = attitude.c_nb() * vector(log);
            [-v_n.y, -v_n.x, v_n.z]
        }
    };
    [Some(x), Some(y), Some(z), Some(0.0)]
}

/// Components along the beams, positive towards the transducer: beams 1 to 4 lean to -x, x, y, -y.
fn beams(past: &Vector3<f64>) -> [f64; 4] {
    let (sin, cos) = JANUS.angle.sin_cos();
    let leaning = [[-1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
    leaning.map(|[x, y]| cos * past.z - sin * (x * past.x + y * past.y))
}
