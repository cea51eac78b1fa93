//! What a node does with group functions (126208): requests and commands of others.
//!
//! The answer to a request that is granted is the group itself; it is acknowledged only where the
//! group does not follow at once, and where something is wrong. A command is always acknowledged.
//! Nobody is told of an error who asked everybody.

use insd_base::{Span, Time};

use super::answers::Answer;
use super::pairs::{self, CLAIM, CLAIM_BITS, CONFIGURATION, LIST, PRODUCT, Width};
use super::pulse::PULSE;
use super::{Node, NodeEvent, Transmit};
use crate::groups::{
    Acknowledge, Command, Configuration, GroupFunction, GroupRequest, Heartbeat, INTERVAL_DEFAULT,
    INTERVAL_KEEP, IntervalError, OFFSET_KEEP, ParameterError, PgnError, PgnList, ProductInfo,
    answer_to, read_text,
};
use crate::pgn::Group;
use crate::{ADDRESS_CLAIM, Name};

/// Intervals that can be had, milliseconds: of the stream, and of the heartbeat.
const STREAM_INTERVALS: (u32, u32) = (50, 60_000);
const HEARTBEAT_INTERVALS: (u32, u32) = (1000, 60_000);
/// The longest offset, hundredths of a second.
const LONGEST_OFFSET: u16 = 6000;
/// Priorities of a command that leave it as it is, or set it back.
const PRIORITY_KEEP: [u8; 2] = [8, 15];
const PRIORITY_DEFAULT: u8 = 9;

/// What is wrong with a request or command.
struct Verdict {
    group: PgnError,
    interval: IntervalError,
    parameters: Vec<u8>,
}

impl Verdict {
    fn new(group: PgnError, interval: IntervalError, parameters: Vec<u8>) -> Self {
        Verdict { group, interval, parameters }
    }

    /// The group is refused as a whole, and so is each parameter.
    fn refused(group: PgnError, count: u8, each: ParameterError) -> Self {
        Verdict::new(group, IntervalError::None, vec![each as u8; usize::from(count)])
    }

    fn is_granted(&self) -> bool {
        self.group == PgnError::None
            && self.interval == IntervalError::None
            && self.parameters.iter().all(|code| *code == ParameterError::None as u8)
    }
}

/// An interval and an offset that are granted.
struct Wish {
    /// `None` leaves it.
    interval: Option<u32>,
    /// Time before the first; `None` was not told.
    offset: Option<Span>,
}

impl Wish {
    /// Whether it is more than to be sent the group once: a command in the form of a request.
    fn changes(&self) -> bool {
        self.interval.is_some() || self.offset.is_some()
    }
}

impl Node {
    /// Takes a group function.
    pub(super) fn function(
        &mut self,
        function: &GroupFunction,
        source: u8,
        addressed: bool,
        now: Time,
    ) {
        let pgn = function.pgn();
        let verdict = match function {
            GroupFunction::Acknowledge(_) => {
                self.requests.acknowledged += 1;
                return;
            }
            GroupFunction::Request(request) => self.request(request, source, now),
            GroupFunction::Command(command) if addressed && !self.config.commands => {
                Some(self.deny(pgn, command.count, source))
            }
            GroupFunction::Command(command) if addressed => {
                Some(self.command(command, source, now))
            }
            GroupFunction::Other { function: 3 | 5, .. } if addressed => {
                let known = self.knows(pgn);
                let error =
                    if known { PgnError::ReadWriteNotSupported } else { PgnError::NotSupported };
                Some(Verdict::refused(error, 0, ParameterError::None))
            }
            GroupFunction::Command(_) | GroupFunction::Other { .. } => None,
        };
        self.requests.functions += 1;
        let Some(verdict) = verdict else { return };
        self.requests.denied += u64::from(!verdict.is_granted());
        if addressed {
            self.acknowledge(pgn, verdict, answer_to(source), now);
        }
    }

    /// Refuses a command, as the node obeys none.
    fn deny(&mut self, pgn: u32, count: u8, source: u8) -> Verdict {
        let by = self.peer(source);
        self.tell(NodeEvent::CommandRefused { pgn, by });
        Verdict::refused(PgnError::Denied, count, ParameterError::Unable)
    }

    fn acknowledge(&mut self, pgn: u32, verdict: Verdict, to: u8, now: Time) {
        if !self.courtesy.take(now) {
            self.requests.rationed += 1;
            return;
        }
        let Verdict { group, interval, parameters } = verdict;
        let (error, interval) = (group as u8, interval as u8);
        let acknowledge = Acknowledge { pgn, error, interval, parameters };
        self.reply(&GroupFunction::Acknowledge(acknowledge), to, now);
    }

    fn knows(&self, pgn: u32) -> bool {
        let own = [ADDRESS_CLAIM, PgnList::PGN, Heartbeat::PGN, ProductInfo::PGN];
        own.contains(&pgn) || pgn == Configuration::PGN || self.entry(pgn).is_some()
    }

    /// Grants or refuses a request; `None` if the group itself is the answer.
    fn request(&mut self, request: &GroupRequest, source: u8, now: Time) -> Option<Verdict> {
        match request.pgn {
            Heartbeat::PGN => self.request_heartbeat(request, source, now),
            ADDRESS_CLAIM => {
                let fields = claim_fields(self.config.name);
                let masked = |field: u8, value: &[u8]| {
                    let bits = CLAIM_BITS.get(usize::from(field) - 1).copied().unwrap_or(8);
                    let kept = crate::bytes::little_endian(value) & ((1 << bits) - 1);
                    let kept = kept.to_le_bytes();
                    pairs::equals(&fields, field, kept.get(..value.len()).unwrap_or(value))
                };
                let verdict = match_fields(request, &CLAIM, masked);
                self.grant(verdict, &[Answer::Claim], now)
            }
            ProductInfo::PGN => {
                let fields = self.config.product.fields();
                let equals = |field: u8, value: &[u8]| pairs::equals(&fields, field, value);
                let verdict = match_fields(request, &PRODUCT, equals);
                self.grant(verdict, &[Answer::Product], now)
            }
            Configuration::PGN => {
                let fields = self.config.configuration().fields();
                let equals = |field: u8, value: &[u8]| pairs::equals(&fields, field, value);
                let verdict = match_fields(request, &CONFIGURATION, equals);
                self.grant(verdict, &[Answer::Configuration], now)
            }
            PgnList::PGN => self.request_list(request, source, now),
            pgn => match self.entry(pgn).copied() {
                Some(entry) => self.request_stream(entry, request, source, now),
                None => Some(Verdict::refused(
                    PgnError::NotSupported,
                    request.count,
                    ParameterError::None,
                )),
            },
        }
    }

    /// Gives the answers if all is well; otherwise the verdict.
    fn grant(&mut self, verdict: Verdict, answers: &[Answer], now: Time) -> Option<Verdict> {
        if !verdict.is_granted() {
            return Some(verdict);
        }
        for answer in answers {
            self.owe(*answer, now);
        }
        None
    }

    fn request_list(&mut self, request: &GroupRequest, source: u8, now: Time) -> Option<Verdict> {
        let mut wanted = None;
        let verdict = match_fields(request, &LIST, |_, value| {
            wanted = value.first().copied();
            if wanted.is_some_and(|list| list <= 1) {
                ParameterError::None
            } else {
                ParameterError::OutOfRange
            }
        });
        let to = answer_to(source);
        let both = [Answer::Sends(to), Answer::Reads(to)];
        let answers = match wanted {
            Some(0) => &both[..1],
            Some(_) => &both[1..],
            None => &both[..],
        };
        self.grant(verdict, answers, now)
    }

    fn request_heartbeat(
        &mut self,
        request: &GroupRequest,
        source: u8,
        now: Time,
    ) -> Option<Verdict> {
        let off = (request.interval == 0).then_some(IntervalError::NotSupported);
        let wish = match off.map_or_else(|| wish(request, HEARTBEAT_INTERVALS), Err) {
            Ok(wish) => wish,
            Err(verdict) => return Some(with_interval(request, verdict)),
        };
        if request.count > 0 {
            return Some(no_fields(request));
        }
        if wish.changes() && !self.config.commands {
            return Some(self.deny(request.pgn, request.count, source));
        }
        let interval = match wish.interval {
            None => self.pulse.interval(),
            Some(INTERVAL_DEFAULT) => PULSE,
            Some(interval) => milliseconds(interval),
        };
        let first = now + wish.offset.unwrap_or(interval);
        if wish.interval.is_some() || wish.offset.is_some() {
            self.pulse.set(interval, first);
            let (pgn, by) = (Heartbeat::PGN, self.peer(source));
            let (interval, offset) = (Some(interval), wish.offset);
            self.tell(NodeEvent::IntervalChanged { pgn, interval, offset, by });
        }
        self.owe(Answer::Heartbeat, now);
        None
    }

    fn request_stream(
        &mut self,
        entry: Transmit,
        request: &GroupRequest,
        source: u8,
        now: Time,
    ) -> Option<Verdict> {
        let wish = match wish(request, STREAM_INTERVALS) {
            Ok(wish) => wish,
            Err(verdict) => return Some(with_interval(request, verdict)),
        };
        if request.count > 0 {
            return Some(no_fields(request));
        }
        if wish.changes() && !self.config.commands {
            return Some(self.deny(request.pgn, request.count, source));
        }
        let pgn = entry.pgn;
        let (interval, enabled) = match wish.interval {
            None => (entry.interval, entry.enabled),
            Some(0) => (entry.interval, false),
            Some(INTERVAL_DEFAULT) => {
                let default = self.default(pgn).unwrap_or(entry);
                (default.interval, default.enabled)
            }
            Some(interval) => (milliseconds(interval), true),
        };
        let changed = (interval, enabled) != (entry.interval, entry.enabled);
        if changed || wish.offset.is_some() {
            self.change(pgn, |entry| (entry.interval, entry.enabled) = (interval, enabled));
            let (interval, by) = (enabled.then_some(interval), self.peer(source));
            let offset = wish.offset;
            self.tell(NodeEvent::IntervalChanged { pgn, interval, offset, by });
        }
        if self.is_live(pgn, now) {
            self.owe(Answer::Stream(pgn), now);
            return None;
        }
        let once = wish.interval.is_none();
        let error = if once { PgnError::NotAvailable } else { PgnError::None };
        Some(Verdict::refused(error, 0, ParameterError::None))
    }

    fn default(&self, pgn: u32) -> Option<Transmit> {
        self.defaults.iter().find(|entry| entry.pgn == pgn).copied()
    }

    fn change(&mut self, pgn: u32, change: impl Fn(&mut Transmit)) {
        self.config.transmit.iter_mut().filter(|entry| entry.pgn == pgn).for_each(change);
    }

    fn command(&mut self, command: &Command, source: u8, now: Time) -> Verdict {
        let keeps = PRIORITY_KEEP.contains(&command.priority);
        let fixed = if keeps || command.priority == PRIORITY_DEFAULT {
            IntervalError::None
        } else {
            IntervalError::NotSupported
        };
        match command.pgn {
            Configuration::PGN => {
                let parameters = self.command_installation(command, source);
                Verdict::new(PgnError::None, fixed, parameters)
            }
            ADDRESS_CLAIM => {
                let parameters = self.command_instances(command, source);
                self.run_steps(now);
                Verdict::new(PgnError::None, fixed, parameters)
            }
            pgn => match self.entry(pgn).copied() {
                Some(entry) => self.command_priority(entry, command, source),
                None => {
                    let known = self.knows(pgn);
                    let (error, each) = if known {
                        (PgnError::RequestNotSupported, ParameterError::NotSupported)
                    } else {
                        (PgnError::NotSupported, ParameterError::None)
                    };
                    Verdict::refused(error, command.count, each)
                }
            },
        }
    }

    fn command_priority(&mut self, entry: Transmit, command: &Command, source: u8) -> Verdict {
        let wanted = match command.priority {
            priority if PRIORITY_KEEP.contains(&priority) => Some(entry.priority),
            PRIORITY_DEFAULT => self.default(entry.pgn).map(|default| default.priority),
            priority => Some(priority).filter(|priority| *priority <= 7),
        };
        let (pgn, count) = (entry.pgn, command.count);
        if let Some(priority) = wanted.filter(|priority| *priority != entry.priority) {
            self.change(pgn, |entry| entry.priority = priority);
            let by = self.peer(source);
            self.tell(NodeEvent::PriorityChanged { pgn, priority, by });
        }
        let error =
            if wanted.is_some() { IntervalError::None } else { IntervalError::NotSupported };
        let refused = vec![ParameterError::NotSupported as u8; usize::from(count)];
        Verdict::new(PgnError::None, error, refused)
    }

    fn command_installation(&mut self, command: &Command, source: u8) -> Vec<u8> {
        let mut texts = self.config.installation.clone();
        let codes = pairs::judge(command.count, &command.pairs, &CONFIGURATION, |field, value| {
            let place = texts.get_mut(usize::from(field) - 1);
            let Some(place) = place else { return ParameterError::NotSupported };
            let Some(text) = read_text(value) else { return ParameterError::OutOfRange };
            *place = text;
            ParameterError::None
        });
        if texts != self.config.installation {
            self.config.installation.clone_from(&texts);
            let by = self.peer(source);
            self.tell(NodeEvent::InstallationChanged { installation: texts, by });
        }
        codes
    }

    fn command_instances(&mut self, command: &Command, source: u8) -> Vec<u8> {
        let mut parts = self.config.name.parts();
        let codes = pairs::judge(command.count, &command.pairs, &CLAIM, |field, value| {
            let place = match field {
                3 => &mut parts.instance_lower,
                4 => &mut parts.instance_upper,
                8 => &mut parts.system_instance,
                _ => return ParameterError::NotSupported,
            };
            let bits = CLAIM_BITS.get(usize::from(field) - 1).copied().unwrap_or(8);
            let Some(number) = pairs::small(value, bits) else {
                return ParameterError::OutOfRange;
            };
            *place = number;
            ParameterError::None
        });
        if let Some(name) = parts.name().filter(|name| *name != self.config.name) {
            self.config.name = name;
            self.claim.rename(name);
            let by = self.peer(source);
            self.tell(NodeEvent::NameChanged { name, by });
        }
        codes
    }
}

/// The fields of a NAME, as they stand in a group function.
fn claim_fields(name: Name) -> Vec<Vec<u8>> {
    let mut rest = name.bits();
    let field = |(bits, width): (&u32, &Width)| {
        let value = rest & ((1 << bits) - 1);
        rest >>= bits;
        let length = if let Width::Bytes(length) = width { *length } else { 1 };
        value.to_le_bytes().into_iter().take(length).collect()
    };
    CLAIM_BITS.iter().zip(&CLAIM).map(field).collect()
}

/// What is wrong with a request of a group that is sent on request only.
fn match_fields(
    request: &GroupRequest,
    widths: &[Width],
    verdict: impl FnMut(u8, &[u8]) -> ParameterError,
) -> Verdict {
    let interval = matches!(request.interval, 0 | INTERVAL_KEEP | INTERVAL_DEFAULT);
    let offset = matches!(request.offset, 0 | OFFSET_KEEP);
    let error = if interval && offset { IntervalError::None } else { IntervalError::NotSupported };
    let parameters = pairs::judge(request.count, &request.pairs, widths, verdict);
    Verdict::new(PgnError::None, error, parameters)
}

/// The interval and offset of a request, if they are within the limits.
fn wish(request: &GroupRequest, limits: (u32, u32)) -> Result<Wish, IntervalError> {
    let interval = match request.interval {
        INTERVAL_KEEP => None,
        0 | INTERVAL_DEFAULT => Some(request.interval),
        interval if interval < limits.0 => return Err(IntervalError::TooShort),
        interval if interval > limits.1 => return Err(IntervalError::NotSupported),
        interval => Some(interval),
    };
    let offset = match request.offset {
        0 | OFFSET_KEEP => None,
        offset if offset > LONGEST_OFFSET => return Err(IntervalError::NotSupported),
        offset => Some(milliseconds(u32::from(offset) * 10)),
    };
    Ok(Wish { interval, offset })
}

fn with_interval(request: &GroupRequest, interval: IntervalError) -> Verdict {
    let unseen = vec![ParameterError::Unable as u8; usize::from(request.count)];
    Verdict::new(PgnError::None, interval, unseen)
}

/// Contents that change all the time cannot be asked for by their values.
fn no_fields(request: &GroupRequest) -> Verdict {
    Verdict::refused(PgnError::RequestNotSupported, request.count, ParameterError::NotSupported)
}

fn milliseconds(count: u32) -> Span {
    Span::from_nanos(i64::from(count) * 1_000_000)
}
