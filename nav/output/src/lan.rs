//! The messages of a port as datagrams of IEC 61162-450, the ship's network.
//!
//! A sentence goes to the group of its talker, unless another is configured for its kind of message.
//! Before each stands a TAG block: who sends (s), the count of this sender's lines (n, 1 to 999 and
//! again, over all groups), and if asked for the time of validity (c). The lines of a message that has
//! several share a TAG group (g, numbered 1 to 99 and again).
//!
//! Sentences of one epoch and one group share datagrams of at most [`MAX_DATAGRAM`] bytes. A TAG group
//! stays in one datagram; a message too long for one is told in several TAG groups. Binary telegrams
//! have no place in such a datagram: they are not sent, and counted.
//!
//! That numbers of TAG groups have two digits at most is from general knowledge; the standard was not
//! seen.

use insd_base::{Span, Time, UtcTime};
use insd_wire::nmea::{
    DATAGRAM_HEADER, MAX_DATAGRAM, NmeaLine, Sfi, TagBlock, TagGroup, Tagged, Talker,
    TransmissionGroup, datagram,
};

use crate::messages::{Content, MessageKind};
use crate::port::{Port, PortMessage};

/// Greatest count of lines.
const MAX_LINE: u16 = 999;

/// Greatest number of a TAG group.
const MAX_GROUP: u32 = 99;

/// Bytes that a place in a TAG group takes at most: a datagram has room for less than 100 lines.
const GROUP_ROOM: usize = "g:99-99-99,".len();

/// Most sets of messages that have a slot of their own at one time.
const MAX_SLOTS: usize = 1024;

/// How a port speaks on the ship's network.
#[derive(Clone, Debug, PartialEq)]
pub struct LanConfig {
    /// Who sends.
    pub source: Sfi,
    /// Messages that do not go where their talker belongs.
    pub groups: Vec<(MessageKind, TransmissionGroup)>,
    /// Whether the time of validity goes with each sentence, once UTC is known.
    pub time: bool,
    /// Whether each sentence has a datagram of its own, for receivers that read no more of one.
    pub single: bool,
}

/// A datagram on its way to the network.
#[derive(Clone, Debug, PartialEq)]
pub struct Datagram {
    /// Where it goes.
    pub group: TransmissionGroup,
    /// A number for the group and the set of messages that are in it: a newer datagram of one slot
    /// replaces one that waits, as it has all that the other has.
    pub slot: u16,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Time of validity of what it says, that of its oldest message.
    pub valid: Time,
    /// Time to the next message of one of its kinds, that of the most frequent.
    pub period: Span,
}

/// Turns the messages of one port into datagrams.
#[derive(Clone, Debug)]
pub struct Lan {
    config: LanConfig,
    counts: Counts,
    slots: Slots,
    unsent: u64,
}

/// Numbers given last.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    line: u16,
    group: u32,
}

/// A message with the group it goes to, and its lines.
struct Addressed<'a> {
    group: TransmissionGroup,
    message: &'a PortMessage,
    lines: &'a [NmeaLine],
}

/// Lines of a message that stay in one datagram.
struct Piece<'a> {
    message: &'a PortMessage,
    /// Which piece of its message it is.
    part: u16,
    lines: Vec<Tagged<'a>>,
}

/// Pieces that share a datagram.
struct Bundle<'a> {
    lines: Vec<Tagged<'a>>,
    bytes: Vec<u8>,
    parts: Vec<(u16, u16)>,
    valid: Time,
    period: Span,
}

impl Lan {
    /// A sender that has sent nothing yet.
    #[must_use]
    pub fn new(config: LanConfig) -> Self {
        Lan { config, counts: Counts::default(), slots: Slots::default(), unsent: 0 }
    }

    /// All groups that the messages of a port can go to, in the order of their numbers. Binary
    /// messages count as a maker's own.
    #[must_use]
    pub fn groups(&self, port: &Port) -> Vec<TransmissionGroup> {
        let group = |(kind, talker): (MessageKind, Option<Talker>)| {
            let usual = talker.map_or(TransmissionGroup::Prop, TransmissionGroup::of_talker);
            self.configured(kind).unwrap_or(usual)
        };
        let mut groups: Vec<TransmissionGroup> = port.talkers().map(group).collect();
        groups.sort_by_key(|group| group.number());
        groups.dedup();
        groups
    }

    /// The datagrams of the messages of one epoch, whose instant this is in UTC. Groups follow each
    /// other in the order of their first messages.
    pub fn datagrams(&mut self, messages: &[PortMessage], utc: Option<UtcTime>) -> Vec<Datagram> {
        let mut datagrams = Vec::new();
        let source = self.config.source;
        let time = utc.filter(|_| self.config.time);
        let block = TagBlock { source: Some(source.as_str()), time, ..TagBlock::default() };
        for (group, messages) in by_group(self.addressed(messages)) {
            let mut pieces = Vec::new();
            for message in messages {
                pieces.extend(self.counts.pieces(&message, block, self.config.single));
            }
            for bundle in bundles(pieces, self.config.single) {
                let slot = self.slots.number((group, bundle.parts));
                let Bundle { bytes, valid, period, .. } = bundle;
                datagrams.push(Datagram { group, slot, bytes, valid, period });
            }
        }
        datagrams
    }

    /// Binary messages that were not sent.
    #[must_use]
    pub fn unsent(&self) -> u64 {
        self.unsent
    }

    fn configured(&self, kind: MessageKind) -> Option<TransmissionGroup> {
        self.config.groups.iter().find(|(own, _)| *own == kind).map(|(_, group)| *group)
    }

    /// The messages that have lines.
    fn addressed<'a>(&mut self, messages: &'a [PortMessage]) -> Vec<Addressed<'a>> {
        let mut addressed = Vec::new();
        for message in messages {
            match &message.content {
                Content::Binary(_) => self.unsent += 1,
                Content::Lines(lines) => addressed.extend(lines.first().map(|first| {
                    let usual = TransmissionGroup::of_address(address(first));
                    let group = self.configured(message.kind).unwrap_or(usual);
                    Addressed { group, message, lines }
                })),
            }
        }
        addressed
    }
}

/// Letters of a line up to its first field.
fn address(line: &NmeaLine) -> &str {
    let line = line.as_str();
    line.get(1..).and_then(|line| line.split([',', '*']).next()).unwrap_or_default()
}

/// The messages of each group, groups in the order of their first messages.
fn by_group(messages: Vec<Addressed<'_>>) -> Vec<(TransmissionGroup, Vec<Addressed<'_>>)> {
    let mut groups: Vec<(TransmissionGroup, Vec<Addressed<'_>>)> = Vec::new();
    for message in messages {
        match groups.iter_mut().find(|(group, _)| *group == message.group) {
            Some((_, own)) => own.push(message),
            None => groups.push((message.group, vec![message])),
        }
    }
    groups
}

impl Counts {
    /// The lines of a message with their TAG blocks, in as few pieces as fit into datagrams, or each
    /// in a piece of its own.
    fn pieces<'a>(
        &mut self,
        message: &Addressed<'a>,
        block: TagBlock<'a>,
        single: bool,
    ) -> Vec<Piece<'a>> {
        let mut chunks: Vec<Vec<Tagged<'a>>> = Vec::new();
        let mut free = 0;
        for line in message.lines {
            self.line = self.line % MAX_LINE + 1;
            let tagged = (TagBlock { line: Some(self.line), ..block }, line);
            let length = tagged.0.write().len() + GROUP_ROOM + line.as_bytes().len();
            match chunks.last_mut().filter(|_| length <= free) {
                Some(chunk) => chunk.push(tagged),
                None => {
                    chunks.push(vec![tagged]);
                    free = MAX_DATAGRAM - DATAGRAM_HEADER.len();
                }
            }
            free = free.saturating_sub(length);
        }
        chunks.iter_mut().for_each(|chunk| self.join(chunk));
        if single {
            chunks = chunks.into_iter().flatten().map(|tagged| vec![tagged]).collect();
        }
        let message = message.message;
        (0..).zip(chunks).map(|(part, lines)| Piece { message, part, lines }).collect()
    }

    /// Makes several lines a TAG group.
    fn join(&mut self, chunk: &mut [Tagged<'_>]) {
        let Some(lines) = u16::try_from(chunk.len()).ok().filter(|lines| *lines > 1) else {
            return;
        };
        self.group = self.group % MAX_GROUP + 1;
        for (line, (block, _)) in (1..).zip(chunk) {
            block.group = Some(TagGroup { line, lines, id: self.group });
        }
    }
}

/// As few datagrams as the pieces need in their order, or one for each.
fn bundles(pieces: Vec<Piece<'_>>, single: bool) -> Vec<Bundle<'_>> {
    let mut bundles: Vec<Bundle<'_>> = Vec::new();
    for piece in pieces {
        let grown = bundles.last().filter(|_| !single).and_then(|last| last.with(&piece));
        match (grown, bundles.last_mut()) {
            (Some(grown), Some(last)) => *last = grown,
            _ => bundles.extend(Bundle::empty(&piece).with(&piece)),
        }
    }
    bundles
}

impl<'a> Bundle<'a> {
    fn empty(piece: &Piece<'a>) -> Self {
        let PortMessage { valid, period, .. } = *piece.message;
        Bundle { lines: Vec::new(), bytes: Vec::new(), parts: Vec::new(), valid, period }
    }

    /// The datagram with a piece more, if it fits.
    fn with(&self, piece: &Piece<'a>) -> Option<Self> {
        let lines = [self.lines.as_slice(), piece.lines.as_slice()].concat();
        let parts = [self.parts.as_slice(), &[(piece.message.slot, piece.part)]].concat();
        Some(Bundle {
            bytes: datagram(&lines)?,
            lines,
            parts,
            valid: self.valid.min(piece.message.valid),
            period: self.period.min(piece.message.period),
        })
    }
}

/// Group, and which pieces of which slots of the port's messages.
type Parts = (TransmissionGroup, Vec<(u16, u16)>);

/// Numbers of the sets of messages that share a datagram. If there are too many, the set that was not
/// seen for longest gives its number away.
#[derive(Clone, Debug, Default)]
struct Slots {
    known: Vec<(Parts, u64)>,
    uses: u64,
}

impl Slots {
    fn number(&mut self, parts: Parts) -> u16 {
        self.uses += 1;
        let place = match self.known.iter().position(|(known, _)| *known == parts) {
            Some(place) => place,
            None if self.known.len() < MAX_SLOTS => self.known.len(),
            None => {
                let oldest = self.known.iter().enumerate().min_by_key(|(_, (_, used))| *used);
                oldest.map_or(0, |(place, _)| place)
            }
        };
        let used = (parts, self.uses);
        match self.known.get_mut(place) {
            Some(known) => *known = used,
            None => self.known.push(used),
        }
        u16::try_from(place).unwrap_or(u16::MAX)
    }
}
