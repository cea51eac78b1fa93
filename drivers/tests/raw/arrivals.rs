//! Arrivals of all kinds, and ways to write and read them.

use std::path::Path;

use insd_base::{
    AlertOrder, Arrival, BusEvent, CanFrame, CanId, Closed, Input, Order, PortId, PortState, Pulse,
    Sent, Span, Stamp, StorageFaults, Time, UtcTime,
};
use insd_drivers::raw::{RawFault, RawHeader, RawReader, RawWriter, RecordingConfig};
use proptest::collection::vec;
use proptest::prelude::*;

/// Any arrival, with clocks that may do anything.
pub(crate) fn any_arrival() -> impl Strategy<Value = Arrival> {
    (stamp(), any::<u16>(), input()).prop_map(|(stamp, port, input)| Arrival {
        stamp,
        port: PortId(port),
        input,
    })
}

fn stamp() -> impl Strategy<Value = Stamp> {
    let typical = (0_i64..10_000_000_000, 0_i64..3).prop_map(|(monotonic, step)| {
        (monotonic, 1_795_000_000_000_000_000 + monotonic + step * 1_000_000_000)
    });
    prop_oneof![4 => typical, 1 => any::<(i64, i64)>()].prop_map(|(monotonic, system)| Stamp {
        monotonic: Time::from_nanos(monotonic),
        system: UtcTime::from_nanos(system),
    })
}

fn input() -> impl Strategy<Value = Input> {
    prop_oneof![
        4 => vec(any::<u8>(), 0..60).prop_map(Input::Bytes),
        2 => (any::<bool>(), any::<u32>(), vec(any::<u8>(), 0..9)).prop_map(frame),
        1 => (0_usize..7, any::<u32>()).prop_map(event),
        1 => vec(0_u8..2, 0..3000).prop_map(Input::Bytes),
        1 => any::<(i64, u32)>().prop_map(|(time, sequence)| {
            Input::Pulse(Pulse { time: Time::from_nanos(time), sequence })
        }),
        1 => state().prop_map(Input::State),
        1 => Just(Input::Tick),
        1 => order().prop_map(Input::Order),
        1 => (".{0,20}", any::<bool>(), vec(any::<u8>(), 0..60))
            .prop_map(|(host, may_command, bytes)| Input::Sent(Sent { host, may_command, bytes })),
        1 => any::<[bool; 3]>().prop_map(|[recording, state, fleet]| {
            Input::Storage(StorageFaults { recording, state, fleet })
        }),
    ]
}

fn order() -> impl Strategy<Value = Order> {
    let command = prop_oneof![Just(AlertOrder::Acknowledge), Just(AlertOrder::Silence)];
    prop_oneof![
        (any::<u32>(), command)
            .prop_map(|(identifier, command)| Order::Alert { identifier, command }),
        ".{0,40}".prop_map(Order::Configuration),
        (any::<i64>(), vec(any::<u8>(), 0..60))
            .prop_map(|(age, state)| Order::Checkpoint { age: Span::from_nanos(age), state }),
        ".{0,40}".prop_map(Order::StoredState),
        proptest::option::of(".{1,40}").prop_map(Order::Berth),
        ".{0,40}".prop_map(Order::LearntModel),
        any::<bool>().prop_map(Order::UseLearnt),
    ]
}

fn frame((standard, number, data): (bool, u32, Vec<u8>)) -> Input {
    let id = if standard {
        CanId::Standard(number as u16 & CanId::MAX_STANDARD)
    } else {
        CanId::Extended(number & CanId::MAX_EXTENDED)
    };
    Input::Can(CanFrame::new(id, &data).unwrap())
}

fn event((kind, number): (usize, u32)) -> Input {
    Input::Bus(
        [
            BusEvent::Active,
            BusEvent::Warning,
            BusEvent::Passive,
            BusEvent::BusOff,
            BusEvent::Restarted,
            BusEvent::Error { class: number },
            BusEvent::Dropped { frames: number },
        ][kind],
    )
}

fn state() -> impl Strategy<Value = PortState> {
    prop_oneof![
        ".{0,40}".prop_map(|what| PortState::Open { what }),
        ".{0,40}".prop_map(|reason| PortState::Absent { reason }),
        ".{0,40}".prop_map(|reason| PortState::Lost { reason }),
        any::<i64>().prop_map(|nanos| PortState::Silent { span: Span::from_nanos(nanos) }),
        Just(PortState::Speaking),
        any::<u64>().prop_map(|bytes| PortState::Overrun { bytes }),
        Just(PortState::Ended),
        (".{0,20}", 0_usize..3, any::<u64>()).prop_map(|(host, why, count)| {
            let why = [Closed::NotListed, Closed::HostFull, Closed::Full][why];
            PortState::Refused { host, why, count }
        }),
    ]
}

/// Few arrivals of few bytes, a few for each block.
pub(crate) fn few_blocks() -> impl Strategy<Value = Vec<Vec<Arrival>>> {
    let small = any_arrival().prop_filter("small", |arrival| match &arrival.input {
        Input::Bytes(bytes) => bytes.len() < 60,
        _ => true,
    });
    vec(vec(small, 1..5), 1..5)
}

/// Blocks of ten plain arrivals.
pub(crate) fn blocks(count: u16) -> Vec<Vec<Arrival>> {
    let arrival = |index: u16| Arrival {
        stamp: Stamp {
            monotonic: Time::from_nanos(i64::from(index) * 1_000_000),
            system: UtcTime::from_nanos(1_795_000_000_000_000_000),
        },
        port: PortId(index),
        input: Input::Bytes(vec![index as u8; 100]),
    };
    (0..count).map(|block| (0..10).map(|index| arrival(block * 10 + index)).collect()).collect()
}

/// One file without limits.
pub(crate) fn one_file() -> RecordingConfig {
    RecordingConfig {
        name: "ship".to_owned(),
        rotate_bytes: u64::MAX,
        rotate_span: Span::from_nanos(i64::MAX),
        quota_bytes: None,
    }
}

/// What the tests tell of themselves.
pub(crate) fn header() -> RawHeader {
    RawHeader { program: "insd 0.1.0".to_owned(), config: "[port.imu]\nbaud = 921600\n".to_owned() }
}

/// Records blocks: what stands together is flushed together, or more often if it is older than a
/// second.
pub(crate) fn record(folder: &Path, config: &RecordingConfig, blocks: &[Vec<Arrival>]) {
    let mut writer = RawWriter::create(folder, config.clone(), header()).unwrap();
    for block in blocks {
        block.iter().for_each(|arrival| writer.record(arrival).unwrap());
        writer.flush().unwrap();
    }
}

/// What a reader gives, arrivals and faults apart.
pub(crate) fn read(reader: RawReader) -> (Vec<Arrival>, Vec<RawFault>) {
    let mut arrivals = Vec::new();
    let mut faults = Vec::new();
    for item in reader {
        match item {
            Ok(arrival) => arrivals.push(arrival),
            Err(fault) => faults.push(fault),
        }
    }
    (arrivals, faults)
}
