//! One arrival as a record of a block.

use insd_base::{
    AlertOrder, Arrival, BusEvent, CanFrame, CanId, Closed, Input, Order, PortId, PortState, Pulse,
    Sent, Span, Stamp, StorageFaults, Time, UtcTime,
};

use super::varint::{put, put_signed, take, take_signed};

/// Set in the first byte of a record that tells a new difference of the two clocks.
const CLOCK: u8 = 0x10;

/// The kinds of records, the low four bits of the first byte.
mod kind {
    pub(super) const BYTES: u8 = 0;
    pub(super) const PULSE: u8 = 1;
    pub(super) const OPEN: u8 = 2;
    pub(super) const ABSENT: u8 = 3;
    pub(super) const LOST: u8 = 4;
    pub(super) const SILENT: u8 = 5;
    pub(super) const SPEAKING: u8 = 6;
    pub(super) const OVERRUN: u8 = 7;
    pub(super) const ENDED: u8 = 8;
    pub(super) const CAN: u8 = 9;
    pub(super) const BUS: u8 = 10;
    pub(super) const TICK: u8 = 11;
    pub(super) const ORDER: u8 = 12;
    /// All that came later: what it is stands in the number behind the clocks.
    pub(super) const MORE: u8 = 13;
    pub(super) const GAP: u8 = 15;
}

/// The kinds of records of [`kind::MORE`].
mod more {
    pub(super) const SENT: u64 = 0;
    pub(super) const REFUSED: u64 = 1;
    pub(super) const STORAGE: u64 = 2;
}

/// What a block holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Record {
    /// Something arrived.
    Arrival(Arrival),
    /// So many arrivals were not recorded here.
    Gap(u64),
}

/// The clocks as the record before left them. Each block begins anew, at zero, so that it can be read
/// without any other.
#[derive(Clone, Copy, Debug, Default)]
struct Clocks {
    /// Monotonic clock, ns.
    monotonic: i64,
    /// System clock minus monotonic clock, ns. All differences wrap, so that every pair is exact.
    offset: i64,
}

/// Encodes the records of a block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Encoder {
    clocks: Clocks,
}

impl Encoder {
    /// Appends a gap.
    pub(crate) fn gap(bytes: &mut Vec<u8>, dropped: u64) {
        bytes.push(kind::GAP);
        put(bytes, dropped);
    }

    /// Appends an arrival.
    pub(crate) fn arrival(&mut self, bytes: &mut Vec<u8>, arrival: &Arrival) {
        let monotonic = arrival.stamp.monotonic.as_nanos();
        let offset = arrival.stamp.system.as_nanos().wrapping_sub(monotonic);
        let clock = if offset == self.clocks.offset { 0 } else { CLOCK };
        bytes.push(kind_of(&arrival.input) | clock);
        put(bytes, u64::from(arrival.port.0));
        put_signed(bytes, monotonic.wrapping_sub(self.clocks.monotonic));
        if clock != 0 {
            put_signed(bytes, offset.wrapping_sub(self.clocks.offset));
        }
        self.clocks = Clocks { monotonic, offset };
        match &arrival.input {
            Input::Bytes(payload) => put_bytes(bytes, payload),
            Input::Can(frame) => put_frame(bytes, frame),
            Input::Bus(event) => put_event(bytes, *event),
            Input::Pulse(pulse) => {
                put_signed(bytes, pulse.time.as_nanos().wrapping_sub(monotonic));
                put(bytes, u64::from(pulse.sequence));
            }
            Input::State(state) => put_state(bytes, state),
            Input::Order(order) => put_order(bytes, order),
            Input::Sent(sent) => put_sent(bytes, sent),
            Input::Storage(faults) => {
                put(bytes, more::STORAGE);
                let all = [faults.recording, faults.state, faults.fleet].map(u64::from);
                put(bytes, all[0] | all[1] << 1 | all[2] << 2);
            }
            Input::Tick => {}
        }
    }
}

fn kind_of(input: &Input) -> u8 {
    match input {
        Input::Bytes(_) => kind::BYTES,
        Input::Can(_) => kind::CAN,
        Input::Bus(_) => kind::BUS,
        Input::Pulse(_) => kind::PULSE,
        Input::Tick => kind::TICK,
        Input::Order(_) => kind::ORDER,
        Input::Sent(_) | Input::Storage(_) => kind::MORE,
        Input::State(state) => match state {
            PortState::Open { .. } => kind::OPEN,
            PortState::Absent { .. } => kind::ABSENT,
            PortState::Lost { .. } => kind::LOST,
            PortState::Silent { .. } => kind::SILENT,
            PortState::Speaking => kind::SPEAKING,
            PortState::Overrun { .. } => kind::OVERRUN,
            PortState::Ended => kind::ENDED,
            PortState::Refused { .. } => kind::MORE,
        },
    }
}

fn put_state(bytes: &mut Vec<u8>, state: &PortState) {
    match state {
        PortState::Open { what: text }
        | PortState::Absent { reason: text }
        | PortState::Lost { reason: text } => put_bytes(bytes, text.as_bytes()),
        PortState::Silent { span } => put_signed(bytes, span.as_nanos()),
        PortState::Overrun { bytes: dropped } => put(bytes, *dropped),
        PortState::Refused { host, why, count } => {
            put(bytes, more::REFUSED);
            put_bytes(bytes, host.as_bytes());
            put(
                bytes,
                match why {
                    Closed::NotListed => 0,
                    Closed::HostFull => 1,
                    Closed::Full => 2,
                },
            );
            put(bytes, *count);
        }
        PortState::Speaking | PortState::Ended => {}
    }
}

fn put_sent(bytes: &mut Vec<u8>, sent: &Sent) {
    put(bytes, more::SENT);
    put_bytes(bytes, sent.host.as_bytes());
    put(bytes, u64::from(sent.may_command));
    put_bytes(bytes, &sent.bytes);
}

/// The identifier with its kind in the lowest bit, then the data.
fn put_frame(bytes: &mut Vec<u8>, frame: &CanFrame) {
    let id = match frame.id() {
        CanId::Standard(id) => u64::from(id) << 1,
        CanId::Extended(id) => u64::from(id) << 1 | 1,
    };
    put(bytes, id);
    put_bytes(bytes, frame.data());
}

/// The kind of the event, then its number, if it has one.
fn put_event(bytes: &mut Vec<u8>, event: BusEvent) {
    let (kind, number) = match event {
        BusEvent::Active => (0, 0),
        BusEvent::Warning => (1, 0),
        BusEvent::Passive => (2, 0),
        BusEvent::BusOff => (3, 0),
        BusEvent::Restarted => (4, 0),
        BusEvent::Error { class } => (5, class),
        BusEvent::Dropped { frames } => (6, frames),
    };
    put(bytes, kind);
    put(bytes, u64::from(number));
}

/// The kind of the order, then what it holds.
fn put_order(bytes: &mut Vec<u8>, order: &Order) {
    match order {
        Order::Alert { identifier, command } => {
            put(bytes, 0);
            put(bytes, u64::from(*identifier));
            put(bytes, u64::from(*command == AlertOrder::Silence));
        }
        Order::Configuration(text) => {
            put(bytes, 1);
            put_bytes(bytes, text.as_bytes());
        }
        Order::Checkpoint { age, state } => {
            put(bytes, 2);
            put_signed(bytes, age.as_nanos());
            put_bytes(bytes, state);
        }
        Order::StoredState(text) => {
            put(bytes, 3);
            put_bytes(bytes, text.as_bytes());
        }
        // no berth has an empty name
        Order::Berth(name) => {
            put(bytes, 4);
            put_bytes(bytes, name.as_deref().unwrap_or_default().as_bytes());
        }
        Order::LearntModel(text) => {
            put(bytes, 5);
            put_bytes(bytes, text.as_bytes());
        }
        Order::UseLearnt(is_wanted) => {
            put(bytes, 6);
            put(bytes, u64::from(*is_wanted));
        }
    }
}

fn put_bytes(bytes: &mut Vec<u8>, payload: &[u8]) {
    put(bytes, payload.len() as u64);
    bytes.extend_from_slice(payload);
}

/// The records of a block, all `count` of them; `None` if the bytes are anything else.
pub(crate) fn decode(mut bytes: &[u8], count: u32) -> Option<Vec<Record>> {
    // no record is shorter than two bytes: a false count reserves nothing
    let count = usize::try_from(count).ok().filter(|count| *count <= bytes.len() / 2)?;
    let mut records = Vec::with_capacity(count);
    let mut clocks = Clocks::default();
    for _ in 0..count {
        records.push(record(&mut bytes, &mut clocks)?);
    }
    bytes.is_empty().then_some(records)
}

fn record(bytes: &mut &[u8], clocks: &mut Clocks) -> Option<Record> {
    let (first, rest) = bytes.split_first()?;
    *bytes = rest;
    if *first == kind::GAP {
        return take(bytes).map(Record::Gap);
    }
    let port = PortId(u16::try_from(take(bytes)?).ok()?);
    clocks.monotonic = clocks.monotonic.wrapping_add(take_signed(bytes)?);
    if first & CLOCK != 0 {
        clocks.offset = clocks.offset.wrapping_add(take_signed(bytes)?);
    }
    let monotonic = Time::from_nanos(clocks.monotonic);
    let system = UtcTime::from_nanos(clocks.monotonic.wrapping_add(clocks.offset));
    let input = input(first & !CLOCK, bytes, clocks.monotonic)?;
    Some(Record::Arrival(Arrival { stamp: Stamp { monotonic, system }, port, input }))
}

fn input(kind: u8, bytes: &mut &[u8], monotonic: i64) -> Option<Input> {
    let state = match kind {
        kind::BYTES => return take_bytes(bytes).map(|taken| Input::Bytes(taken.to_vec())),
        kind::CAN => return take_frame(bytes).map(Input::Can),
        kind::BUS => return take_event(bytes).map(Input::Bus),
        kind::PULSE => {
            let time = Time::from_nanos(monotonic.wrapping_add(take_signed(bytes)?));
            let sequence = u32::try_from(take(bytes)?).ok()?;
            return Some(Input::Pulse(Pulse { time, sequence }));
        }
        kind::OPEN => PortState::Open { what: take_text(bytes)? },
        kind::ABSENT => PortState::Absent { reason: take_text(bytes)? },
        kind::LOST => PortState::Lost { reason: take_text(bytes)? },
        kind::SILENT => PortState::Silent { span: Span::from_nanos(take_signed(bytes)?) },
        kind::SPEAKING => PortState::Speaking,
        kind::OVERRUN => PortState::Overrun { bytes: take(bytes)? },
        kind::ENDED => PortState::Ended,
        kind::TICK => return Some(Input::Tick),
        kind::ORDER => return take_order(bytes).map(Input::Order),
        kind::MORE => return take_more(bytes),
        _ => return None,
    };
    Some(Input::State(state))
}

fn take_more(bytes: &mut &[u8]) -> Option<Input> {
    Some(match take(bytes)? {
        more::SENT => {
            let host = take_text(bytes)?;
            let may_command = take_flag(bytes)?;
            Input::Sent(Sent { host, may_command, bytes: take_bytes(bytes)?.to_vec() })
        }
        more::REFUSED => {
            let host = take_text(bytes)?;
            let why = match take(bytes)? {
                0 => Closed::NotListed,
                1 => Closed::HostFull,
                2 => Closed::Full,
                _ => return None,
            };
            Input::State(PortState::Refused { host, why, count: take(bytes)? })
        }
        more::STORAGE => {
            let faults = take(bytes)?;
            let [recording, state, fleet] = [1, 2, 4].map(|bit| faults & bit != 0);
            (faults <= 7).then_some(Input::Storage(StorageFaults { recording, state, fleet }))?
        }
        _ => return None,
    })
}

fn take_flag(bytes: &mut &[u8]) -> Option<bool> {
    match take(bytes)? {
        0 => Some(false),
        1 => Some(true),
        _ => None,
    }
}

fn take_frame(bytes: &mut &[u8]) -> Option<CanFrame> {
    let number = take(bytes)?;
    let id = if number & 1 == 0 {
        CanId::Standard(u16::try_from(number >> 1).ok()?)
    } else {
        CanId::Extended(u32::try_from(number >> 1).ok()?)
    };
    CanFrame::new(id, take_bytes(bytes)?)
}

fn take_event(bytes: &mut &[u8]) -> Option<BusEvent> {
    let kind = take(bytes)?;
    let number = u32::try_from(take(bytes)?).ok()?;
    Some(match kind {
        0 => BusEvent::Active,
        1 => BusEvent::Warning,
        2 => BusEvent::Passive,
        3 => BusEvent::BusOff,
        4 => BusEvent::Restarted,
        5 => BusEvent::Error { class: number },
        6 => BusEvent::Dropped { frames: number },
        _ => return None,
    })
}

fn take_order(bytes: &mut &[u8]) -> Option<Order> {
    Some(match take(bytes)? {
        0 => {
            let identifier = u32::try_from(take(bytes)?).ok()?;
            let command = match take(bytes)? {
                0 => AlertOrder::Acknowledge,
                1 => AlertOrder::Silence,
                _ => return None,
            };
            Order::Alert { identifier, command }
        }
        1 => Order::Configuration(take_text(bytes)?),
        2 => {
            let age = Span::from_nanos(take_signed(bytes)?);
            Order::Checkpoint { age, state: take_bytes(bytes)?.to_vec() }
        }
        3 => Order::StoredState(take_text(bytes)?),
        4 => Order::Berth(Some(take_text(bytes)?).filter(|name| !name.is_empty())),
        5 => Order::LearntModel(take_text(bytes)?),
        6 => match take(bytes)? {
            0 => Order::UseLearnt(false),
            1 => Order::UseLearnt(true),
            _ => return None,
        },
        _ => return None,
    })
}

fn take_bytes<'a>(bytes: &mut &'a [u8]) -> Option<&'a [u8]> {
    let length = usize::try_from(take(bytes)?).ok()?;
    let (taken, rest) = bytes.split_at_checked(length)?;
    *bytes = rest;
    Some(taken)
}

fn take_text(bytes: &mut &[u8]) -> Option<String> {
    String::from_utf8(take_bytes(bytes)?.to_vec()).ok()
}
