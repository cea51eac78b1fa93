//! 126208: one node asks another for a group, commands the values of its fields, or answers.

use insd_base::Span;

use super::requests::short;
use crate::bytes::{Bytes, pgn_bytes};
use crate::pgn::{Group, Short};

/// An interval that says: leave it.
pub const INTERVAL_KEEP: u32 = 0xFFFF_FFFF;
/// An interval that says: go back to the default.
pub const INTERVAL_DEFAULT: u32 = 0xFFFF_FFFE;
/// An offset that says: leave it.
pub const OFFSET_KEEP: u16 = 0xFFFF;

/// Function 0: send this group, so often, if its fields have these values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroupRequest {
    /// The group.
    pub pgn: u32,
    /// Time between two messages, milliseconds; 0 is never, and see [`INTERVAL_KEEP`].
    pub interval: u32,
    /// Time before the first, hundredths of a second.
    pub offset: u16,
    /// Number of pairs of field and value.
    pub count: u8,
    /// The pairs. How long a value is depends on the field.
    pub pairs: Vec<u8>,
}

/// Function 1: set these fields of the group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Command {
    /// The group.
    pub pgn: u32,
    /// The priority it shall have: 8 leaves it, 9 is the default.
    pub priority: u8,
    /// Number of pairs of field and value.
    pub count: u8,
    /// The pairs. How long a value is depends on the field.
    pub pairs: Vec<u8>,
}

/// Function 2: what becomes of a request or command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Acknowledge {
    /// The group.
    pub pgn: u32,
    /// What is wrong with the group, a [`PgnError`].
    pub error: u8,
    /// What is wrong with interval or priority, an [`IntervalError`].
    pub interval: u8,
    /// What is wrong with each parameter, [`ParameterError`]s.
    pub parameters: Vec<u8>,
}

/// Codes for the group as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PgnError {
    /// Nothing is wrong.
    None = 0,
    /// There is no such group here.
    NotSupported = 1,
    /// It has no contents now.
    NotAvailable = 2,
    /// The sender may not do this.
    Denied = 3,
    /// The group cannot be asked or commanded so.
    RequestNotSupported = 4,
    /// The fields of the group can be neither read nor written one by one.
    ReadWriteNotSupported = 6,
}

/// Codes for interval and priority.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntervalError {
    /// Nothing is wrong.
    None = 0,
    /// No such interval or priority here.
    NotSupported = 1,
    /// The interval is too short.
    TooShort = 2,
}

/// Codes for a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterError {
    /// Nothing is wrong.
    None = 0,
    /// The group has no such field, or its value is cut off.
    NoSuchField = 1,
    /// It could not be looked at.
    Unable = 2,
    /// The value is out of the field's range, or not the value there is.
    OutOfRange = 3,
    /// This field cannot be asked or commanded.
    NotSupported = 5,
}

/// The contents of group 126208.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GroupFunction {
    /// Function 0.
    Request(GroupRequest),
    /// Function 1.
    Command(Command),
    /// Function 2.
    Acknowledge(Acknowledge),
    /// Another function: 3 and 5 read and write fields, 4 and 6 reply to these.
    Other {
        /// Which.
        function: u8,
        /// The group.
        pgn: u32,
    },
}

impl GroupFunction {
    /// The group that it is about.
    #[must_use]
    pub fn pgn(&self) -> u32 {
        match self {
            GroupFunction::Request(GroupRequest { pgn, .. })
            | GroupFunction::Command(Command { pgn, .. })
            | GroupFunction::Acknowledge(Acknowledge { pgn, .. })
            | GroupFunction::Other { pgn, .. } => *pgn,
        }
    }
}

impl Group for GroupFunction {
    const PGN: u32 = 126_208;
    const PRIORITY: u8 = 3;
    const INTERVAL: Option<Span> = None;

    fn read(data: &[u8]) -> Result<Self, Short> {
        let mut bytes = Bytes(data);
        let (Some(function), Some(pgn)) = (bytes.byte(), bytes.pgn()) else {
            return Err(short(data, 4));
        };
        let (read, least) = match function {
            0 => (request(pgn, bytes), 11),
            1 => (command(pgn, bytes), 6),
            2 => (acknowledge(pgn, bytes), 6),
            function => (Some(GroupFunction::Other { function, pgn }), 4),
        };
        read.ok_or_else(|| short(data, least))
    }

    fn write(&self) -> Vec<u8> {
        let head = |function: u8| {
            let mut data = vec![function];
            data.extend(pgn_bytes(self.pgn()));
            data
        };
        match self {
            GroupFunction::Request(request) => {
                let mut data = head(0);
                data.extend(request.interval.to_le_bytes());
                data.extend(request.offset.to_le_bytes());
                data.push(request.count);
                data.extend(&request.pairs);
                data
            }
            GroupFunction::Command(command) => {
                let mut data = head(1);
                data.extend([command.priority | 0xF0, command.count]);
                data.extend(&command.pairs);
                data
            }
            GroupFunction::Acknowledge(acknowledge) => {
                let mut data = head(2);
                data.push(acknowledge.error & 15 | acknowledge.interval << 4);
                data.push(acknowledge.parameters.len() as u8);
                let pair = |pair: &[u8]| match pair {
                    [first, second] => first & 15 | second << 4,
                    [last] => last & 15 | 0xF0,
                    _ => 0xFF,
                };
                data.extend(acknowledge.parameters.chunks(2).map(pair));
                data
            }
            GroupFunction::Other { function, .. } => head(*function),
        }
    }
}

fn request(pgn: u32, mut bytes: Bytes<'_>) -> Option<GroupFunction> {
    let interval = bytes.number(4)? as u32;
    let (offset, count) = (bytes.word()?, bytes.byte()?);
    let pairs = bytes.0.to_vec();
    Some(GroupFunction::Request(GroupRequest { pgn, interval, offset, count, pairs }))
}

fn command(pgn: u32, mut bytes: Bytes<'_>) -> Option<GroupFunction> {
    let (priority, count) = (bytes.byte()? & 15, bytes.byte()?);
    let pairs = bytes.0.to_vec();
    Some(GroupFunction::Command(Command { pgn, priority, count, pairs }))
}

/// Devices send fewer or more codes than they say: there are as many as there are.
fn acknowledge(pgn: u32, mut bytes: Bytes<'_>) -> Option<GroupFunction> {
    let (errors, count) = (bytes.byte()?, bytes.byte()?);
    let codes = bytes.0.iter().flat_map(|pair| [pair & 15, pair >> 4]);
    let parameters = codes.take(usize::from(count)).collect();
    let (error, interval) = (errors & 15, errors >> 4);
    Some(GroupFunction::Acknowledge(Acknowledge { pgn, error, interval, parameters }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trip(data: &[u8]) -> GroupFunction {
        let function = GroupFunction::read(data).unwrap();
        assert_eq!(function.write(), data);
        function
    }

    #[test]
    fn recorded_requests_are_read_and_written() {
        // canboat's sample scx20-setting-tool-pgn-130578to130846-off.raw: 130578 never again
        let off = [0x00, 0x12, 0xFE, 0x01, 0, 0, 0, 0, 0xFF, 0xFF, 0];
        let expected = GroupRequest {
            pgn: 130_578,
            interval: 0,
            offset: OFFSET_KEEP,
            count: 0,
            pairs: Vec::new(),
        };
        assert_eq!(round_trip(&off), GroupFunction::Request(expected));
        // canboat's sample navico-diagnostics-130852.raw
        let once = [0, 0x24, 0xFF, 1, 255, 255, 255, 255, 255, 255, 2, 1, 0x13, 1, 3, 4];
        let GroupFunction::Request(request) = round_trip(&once) else { panic!() };
        assert_eq!((request.pgn, request.interval, request.count), (130_852, INTERVAL_KEEP, 2));
        assert_eq!(request.pairs, [1, 0x13, 1, 3, 4]);
    }

    #[test]
    fn a_recorded_command_and_its_acknowledgement_are_read_and_written() {
        // canboat's sample dirona-actisense-serial.raw
        let GroupFunction::Command(command) = round_trip(&[1, 0x0D, 0xF2, 1, 0xF8, 1, 6, 0]) else {
            panic!()
        };
        assert_eq!((command.pgn, command.priority, command.count), (127_501, 8, 1));
        assert_eq!(command.pairs, [6, 0]);
        let answer = round_trip(&[2, 0x0D, 0xF2, 1, 0x00, 1, 0xF0]);
        let expected = Acknowledge { pgn: 127_501, error: 0, interval: 0, parameters: vec![0] };
        assert_eq!(answer, GroupFunction::Acknowledge(expected));
        let GroupFunction::Acknowledge(refusal) = round_trip(&[2, 8, 0xFF, 1, 3, 5, 0, 3, 0xF0])
        else {
            panic!()
        };
        assert_eq!((refusal.error, refusal.parameters), (3, vec![0, 0, 3, 0, 0]));
    }

    #[test]
    fn other_functions_and_cut_contents_are_told_apart() {
        let read = GroupFunction::read(&[3, 1, 2, 0, 9, 9]).unwrap();
        assert_eq!(read, GroupFunction::Other { function: 3, pgn: 0x201 });
        for (data, least) in [(&[0, 1][..], 4), (&[0, 1, 2, 3, 4], 11), (&[1, 1, 2, 3, 4], 6)] {
            assert_eq!(GroupFunction::read(data).unwrap_err().least, least);
        }
    }
}
