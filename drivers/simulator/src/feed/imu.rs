//! Inertial measurement units.

use insd_base::can::CanFrame;
use insd_base::{Body, GpsTime, ImuSample, Time, Voyage};
use insd_wire::imu::can::Shipped;
use insd_wire::imu::kvh::{KvhMessage, KvhRest};
use insd_wire::imu::mip;
use insd_wire::imu::rotation::quaternion_of;
use insd_wire::imu::sbg::{ClockState, ImuShort, TimeReference, UtcStatus};
use insd_wire::imu::stdbin::{Navigation, Telegram};
use insd_wire::imu::stim::{StimDatagram, StimGroup};
use insd_wire::imu::xbus::{MtData2, Precision};
use insd_wire::imu::{DeviceTime, ImuMotion, ImuReading, Wrapping};

use nalgebra::Matrix3;

use super::config::{layout, mounting};
use super::line::Line;
use super::sensor::{Encoding, SensorFeed};

/// All is well, of an SBG unit.
const SBG_GOOD: u16 = 0x03FF;
/// The system keeps UTC, of an Exail unit.
const TIME_RECEIVED: u32 = 1 << 8;
/// All sensors valid, of a KVH unit.
const KVH_VALID: u8 = 0b0111_0111;
/// Least time from a sample to the first bit of its datagram, of a STIM unit, us.
const STIM_LATENCY: u64 = 300;

/// A sample in the axes of the device.
struct Sample {
    time: Time,
    count: u64,
    theta: [f64; 3],
    velocity: [f64; 3],
    period: f64,
}

pub(super) fn encode(voyage: &Voyage, sensor: &SensorFeed, line: &mut Line) {
    let rate = voyage.header.imu.rate;
    for stamped in &voyage.imu {
        let sample = in_device_axes(&stamped.message, sensor, rate);
        let latency = stim_latency(sensor.encoding, sample.count);
        let sent = Time::from_nanos(sample.time.as_nanos() + latency as i64 * 1000);
        if let Encoding::CanImu(table) = sensor.encoding {
            let frames = can(&sample, sensor, table);
            frames.iter().for_each(|frame| line.send_frame(sent, frame));
            continue;
        }
        line.send(sent, &bytes(&sample, sensor));
        let whole_second = sample.time.as_nanos() % 1_000_000_000 == 0;
        if sensor.encoding == Encoding::Sbg && whole_second {
            line.send(sample.time, &sbg_time(sample.time, sensor));
        }
    }
}

fn in_device_axes(sample: &ImuSample, sensor: &SensorFeed, rate: f64) -> Sample {
    let c_db = mounting(sensor.encoding).c_bd().unwrap_or_else(Matrix3::identity).transpose();
    let turned = |vector: Body| (c_db * vector.0).into();
    let index = (sample.time.as_seconds() * rate).round() as u64;
    Sample {
        time: sample.time,
        count: sensor.clock.count + index,
        theta: turned(sample.delta_theta),
        velocity: turned(sample.delta_velocity),
        period: 1.0 / rate,
    }
}

fn bytes(sample: &Sample, sensor: &SensorFeed) -> Vec<u8> {
    match sensor.encoding {
        Encoding::Stdbin => stdbin(sample, sensor),
        Encoding::Mip => mip(sample, sensor),
        Encoding::Xbus(precision) => xbus(sample, sensor, precision),
        Encoding::Kvh { stamped } => kvh(sample, sensor, stamped),
        Encoding::Stim => stim(sample),
        _ => sbg(sample, sensor),
    }
}

fn sbg(sample: &Sample, sensor: &SensorFeed) -> Vec<u8> {
    ImuShort {
        time_stamp: micros(sensor, sample.time),
        status: SBG_GOOD,
        accel: sample.velocity.map(|velocity| velocity / sample.period),
        gyro: sample.theta.map(|theta| theta / sample.period),
        temperature: 31.5,
    }
    .write()
}

fn can(sample: &Sample, sensor: &SensorFeed, table: Option<Shipped>) -> Vec<CanFrame> {
    let Some(layout) = layout(sensor.encoding) else { return Vec::new() };
    let nanos = sensor.clock.nanos(sample.time);
    let (tick, status) = match table {
        Some(Shipped::Xsens | Shipped::XsensIncrements) => (100_000, 0),
        _ => (1000, SBG_GOOD),
    };
    let wrapping = |value: u64, bits: u32| {
        let modulus = 1 << bits;
        Wrapping { value: value % modulus, modulus }
    };
    let ticks = wrapping(nanos / tick, 32);
    let reading = ImuReading {
        device_time: Some(DeviceTime { ticks, tick: tick as f64 * 1e-9 }),
        counter: Some(wrapping(sample.count, 16)),
        temperature: Some(31.5),
        status: status.into(),
        ..ImuReading::bare(increments(sample))
    };
    layout.layout().write(&reading, sample.period)
}

fn sbg_time(time: Time, sensor: &SensorFeed) -> Vec<u8> {
    TimeReference {
        time_stamp: micros(sensor, time),
        has_pps: true,
        clock: ClockState::Valid,
        accurate: true,
        utc_status: UtcStatus::Initialized,
        civil: sensor.calendar.civil(time),
        gps_tow: GpsTime::to_week(sensor.calendar.gps(time)).1,
        bias_std: None,
        scale_std: None,
        residual: None,
    }
    .write()
}

fn stdbin(sample: &Sample, sensor: &SensorFeed) -> Vec<u8> {
    let civil = sensor.calendar.civil(sample.time);
    let date = (civil.date.year, civil.date.month, civil.date.day);
    Telegram {
        version: 3,
        validity: (civil.time.as_nanos() / 100_000) as u32,
        counter: sample.count as u32,
        navigation: Navigation {
            date: Some(date),
            user_status: Some([TIME_RECEIVED]),
            raw_acceleration: Some(sample.velocity.map(|velocity| velocity / sample.period)),
            raw_rotation: Some(sample.theta.map(|theta| theta / sample.period)),
            ..Navigation::default()
        },
        ..Telegram::default()
    }
    .write()
}

fn mip(sample: &Sample, sensor: &SensorFeed) -> Vec<u8> {
    mip::Packet {
        reference_nanos: Some(sensor.clock.nanos(sample.time)),
        delta_theta: Some(sample.theta),
        delta_velocity: Some(sample.velocity),
        ..mip::Packet::default()
    }
    .write()
}

fn xbus(sample: &Sample, sensor: &SensorFeed, precision: Precision) -> Vec<u8> {
    MtData2 {
        counter: Some(sample.count as u16),
        fine_time: Some((sensor.clock.nanos(sample.time) / 100_000) as u32),
        delta_q: Some(quaternion_of(sample.theta)),
        delta_v: Some(sample.velocity),
        ..MtData2::default()
    }
    .write(precision)
}

fn kvh(sample: &Sample, sensor: &SensorFeed, stamped: bool) -> Vec<u8> {
    let format = super::config::kvh().format(sample.period);
    let (rotation, linear) = format.numbers(&increments(sample));
    let (time, temperature) = (micros(sensor, sample.time), 31);
    let rest = if stamped { KvhRest::B { time, temperature } } else { KvhRest::A { temperature } };
    let sequence = (sample.count % 128) as u8;
    KvhMessage { rotation, linear, status: KVH_VALID, sequence, rest }.write()
}

fn stim(sample: &Sample) -> Vec<u8> {
    let format = super::config::stim().format(sample.period);
    let counts = format.and_then(|format| format.counts(&increments(sample)));
    let (rotation, linear) = counts.unwrap_or_default();
    StimDatagram {
        rate: StimGroup { counts: rotation, status: 0 },
        acceleration: Some(StimGroup { counts: linear, status: 0 }),
        counter: sample.count as u8,
        latency: stim_latency(Encoding::Stim, sample.count) as u16,
        ..StimDatagram::default()
    }
    .write()
}

/// A STIM unit tells how long each of its datagrams took, us; the others do not.
fn stim_latency(encoding: Encoding, count: u64) -> u64 {
    if encoding == Encoding::Stim { STIM_LATENCY + count % 7 * 50 } else { 0 }
}

fn increments(sample: &Sample) -> ImuMotion {
    ImuMotion::Increments { delta_theta: sample.theta, delta_velocity: sample.velocity }
}

fn micros(sensor: &SensorFeed, time: Time) -> u32 {
    (sensor.clock.nanos(time) / 1000) as u32
}
