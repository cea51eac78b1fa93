//! What waits to be sent: by priority, in good time or not at all, and never half a fast packet.
//!
//! A fast packet that is begun is sent to its end, its frames in order; until then no other fast
//! packet begins, and only single frames of higher priority pass between. Once in a while it goes
//! first all the same, or a busy bus would part its frames for longer than its receivers wait.

use insd_base::can::CanFrame;
use insd_base::{Span, Time};

use crate::fast_packet::{self, Sequences};
use crate::{BusMessage, N2kId};

/// A message that has not begun within this is of no use.
const LIMIT: Span = Span::from_nanos(1_000_000_000);
/// The longest wait of a fast packet between its frames while others are sent.
const PATIENCE: Span = Span::from_nanos(50_000_000);
/// Replies that wait at once.
const MAX_REPLIES: usize = 32;
/// Other messages that wait at once.
const MAX_STREAM: usize = 64;
/// At most this many frames ...
const BURST: u32 = 8;
/// ... in this time.
const BURST_TIME: Span = Span::from_nanos(5_000_000);
/// The first pause after a refusal.
const FIRST_PAUSE: Span = Span::from_nanos(1_000_000);
/// The longest pause after refusals.
const LAST_PAUSE: Span = Span::from_nanos(20_000_000);

/// What becomes of a message that has to wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A claim: an answer that goes before all others, whatever its priority on the bus.
    Urgent,
    /// One of a stream: a newer of the same group and receiver takes its place.
    Stream,
    /// An answer: it stays, and another just like it is not queued.
    Reply,
}

/// What the queue has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QueueCounts {
    /// Frames sent.
    pub frames: u64,
    /// Messages sent to their last frame.
    pub messages: u64,
    /// Messages whose place a newer one took.
    pub replaced: u64,
    /// Answers not queued because the same one waited already.
    pub coalesced: u64,
    /// Messages dropped because they had waited too long.
    pub expired: u64,
    /// Messages dropped because too many waited.
    pub crowded: u64,
    /// Messages too long for their group.
    pub too_long: u64,
    /// Messages dropped, begun or not, because the link or the address was lost.
    pub cleared: u64,
    /// Frames that the link refused.
    pub refused: u64,
}

#[derive(Clone, Debug)]
struct Entry {
    message: BusMessage,
    kind: Kind,
    queued: Time,
    /// The place in line among those of the same priority.
    order: u64,
    progress: Option<Progress>,
}

/// How far a fast packet is.
#[derive(Clone, Copy, Debug)]
struct Progress {
    sequence: u8,
    next: u8,
    last_sent: Time,
}

/// The send queue of one node.
#[derive(Clone, Debug, Default)]
pub(crate) struct Queue {
    entries: Vec<Entry>,
    sequences: Sequences,
    next_order: u64,
    /// The order of the message whose frame has been handed out and is not yet known to be sent.
    offered: Option<u64>,
    pause: Span,
    paused_until: Time,
    burst_begun: Time,
    in_burst: u32,
    counts: QueueCounts,
}

impl Queue {
    /// Puts a message in line; false if it is not wanted there.
    pub(crate) fn push(&mut self, message: BusMessage, kind: Kind, now: Time) -> bool {
        let fast = fast_packet::is_fast(message.pgn);
        let limit = if fast { fast_packet::MAX_LENGTH } else { 8 };
        if message.data.len() > limit {
            self.counts.too_long += 1;
            return false;
        }
        match kind {
            Kind::Stream => self.push_stream(message, now),
            Kind::Reply | Kind::Urgent => self.push_reply(message, kind, now),
        }
        true
    }

    /// Messages of one instant are of one epoch and all wait; an older one of the same group and
    /// receiver gives its place, the oldest first.
    fn push_stream(&mut self, message: BusMessage, now: Time) {
        let offered = self.offered;
        let replaceable = self.entries.iter_mut().filter(|entry| {
            entry.kind == Kind::Stream
                && entry.queued < now
                && entry.is_waiting(offered)
                && (entry.message.pgn, entry.message.destination)
                    == (message.pgn, message.destination)
        });
        if let Some(entry) = replaceable.min_by_key(|entry| entry.order) {
            entry.message = message;
            entry.queued = now;
            self.counts.replaced += 1;
            return;
        }
        self.expire(now);
        if self.count(Kind::Stream) >= MAX_STREAM {
            self.drop_least();
        }
        self.append(message, Kind::Stream, now);
    }

    fn push_reply(&mut self, message: BusMessage, kind: Kind, now: Time) {
        let offered = self.offered;
        let same = |entry: &Entry| entry.is_waiting(offered) && entry.message == message;
        if self.entries.iter().any(same) {
            self.counts.coalesced += 1;
            return;
        }
        self.expire(now);
        if self.count(kind) >= MAX_REPLIES {
            self.counts.crowded += 1;
            return;
        }
        self.append(message, kind, now);
    }

    fn append(&mut self, message: BusMessage, kind: Kind, now: Time) {
        let order = self.next_order;
        self.next_order += 1;
        self.entries.push(Entry { message, kind, queued: now, order, progress: None });
    }

    fn count(&self, kind: Kind) -> usize {
        self.entries.iter().filter(|entry| entry.kind == kind).count()
    }

    /// Drops the message of a stream with the lowest priority, the oldest of them.
    fn drop_least(&mut self) {
        let offered = self.offered;
        let streams = self.entries.iter().enumerate();
        let waiting =
            streams.filter(|(_, entry)| entry.kind == Kind::Stream && entry.is_waiting(offered));
        let least =
            waiting.max_by_key(|(_, entry)| (entry.message.priority, u64::MAX - entry.order));
        if let Some(at) = least.map(|(at, _)| at) {
            self.entries.remove(at);
            self.counts.crowded += 1;
        }
    }

    fn expire(&mut self, now: Time) {
        let before = self.entries.len();
        let offered = self.offered;
        self.entries.retain(|entry| !entry.is_waiting(offered) || now - entry.queued <= LIMIT);
        self.counts.expired += (before - self.entries.len()) as u64;
    }

    /// The frame to be sent now; the same again until [`Queue::sent`] or [`Queue::refused`] is told.
    pub(crate) fn peek(&mut self, now: Time) -> Option<CanFrame> {
        if now < self.ready_at()? {
            return None;
        }
        let fresh = |entry: &Entry| entry.is_begun() || now - entry.queued <= LIMIT;
        if !self.offered.and_then(|order| self.entry(order)).is_some_and(fresh) {
            self.withdraw();
            self.expire(now);
            self.offered = self.choose(now);
        }
        let order = self.offered?;
        self.begin_if_fast(order, now);
        self.entry(order)?.frame()
    }

    /// Whose turn it is.
    fn choose(&self, now: Time) -> Option<u64> {
        let begun = self.entries.iter().find(|entry| entry.progress.is_some());
        let waited = |progress: &Progress| now - progress.last_sent >= PATIENCE;
        if let Some(entry) = begun.filter(|entry| entry.progress.as_ref().is_some_and(waited)) {
            return Some(entry.order);
        }
        let may_go = |entry: &&Entry| match begun {
            None => true,
            Some(begun) => {
                let passes = entry.rank() < begun.rank();
                entry.order == begun.order || passes && !fast_packet::is_fast(entry.message.pgn)
            }
        };
        let turns = self.entries.iter().filter(may_go);
        turns.min_by_key(|entry| (entry.rank(), entry.order)).map(|entry| entry.order)
    }

    /// Gives a fast packet its counter when its first frame is about to go.
    fn begin_if_fast(&mut self, order: u64, now: Time) {
        let Some(entry) = self.entries.iter_mut().find(|entry| entry.order == order) else {
            return;
        };
        if entry.progress.is_none() && fast_packet::is_fast(entry.message.pgn) {
            let sequence = self.sequences.next(entry.message.pgn);
            entry.progress = Some(Progress { sequence, next: 0, last_sent: now });
        }
    }

    /// The frame handed out last was sent.
    pub(crate) fn sent(&mut self, now: Time) {
        self.pause = Span::ZERO;
        if now - self.burst_begun >= BURST_TIME {
            self.burst_begun = now;
            self.in_burst = 0;
        }
        self.in_burst += 1;
        let Some(order) = self.offered.take() else { return };
        let Some(at) = self.entries.iter().position(|entry| entry.order == order) else { return };
        self.counts.frames += 1;
        let Some(entry) = self.entries.get_mut(at) else { return };
        if entry.advance(now) {
            self.entries.remove(at);
            self.counts.messages += 1;
        }
    }

    /// The link had no room for the frame handed out last: wait a while, longer each time.
    pub(crate) fn refused(&mut self, now: Time) {
        self.counts.refused += 1;
        let doubled = Span::from_nanos(self.pause.as_nanos() * 2);
        self.pause = doubled.clamp(FIRST_PAUSE, LAST_PAUSE);
        self.paused_until = now + self.pause;
        self.withdraw();
    }

    /// The frame handed out last was not sent after all.
    fn withdraw(&mut self) {
        let Some(order) = self.offered.take() else { return };
        let unsent = |entry: &&mut Entry| entry.order == order && !entry.is_begun();
        if let Some(entry) = self.entries.iter_mut().find(unsent)
            && entry.progress.take().is_some()
        {
            self.sequences.give_back(entry.message.pgn);
        }
    }

    /// When the next frame may go; `None` if there is none. May be in the past.
    pub(crate) fn ready_at(&self) -> Option<Time> {
        if self.entries.is_empty() {
            return None;
        }
        let burst_over = self.burst_begun + BURST_TIME;
        let next = if self.in_burst >= BURST { burst_over } else { self.paused_until };
        Some(next.max(self.paused_until))
    }

    /// Drops all, begun or not: the link or the address is gone.
    pub(crate) fn clear(&mut self) {
        self.counts.cleared += self.entries.len() as u64;
        self.entries.clear();
        self.offered = None;
    }

    /// Messages that wait or are under way.
    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }

    pub(crate) fn counts(&self) -> QueueCounts {
        self.counts
    }

    fn entry(&self, order: u64) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.order == order)
    }
}

impl Entry {
    /// Whether nothing of it has been sent or handed out.
    fn is_waiting(&self, offered: Option<u64>) -> bool {
        self.progress.is_none() && offered != Some(self.order)
    }

    /// The lower goes first.
    fn rank(&self) -> (bool, u8) {
        (self.kind != Kind::Urgent, self.message.priority)
    }

    /// Whether a frame of it has been sent and another is to follow.
    fn is_begun(&self) -> bool {
        self.progress.is_some_and(|progress| progress.next > 0)
    }

    fn frame(&self) -> Option<CanFrame> {
        let BusMessage { priority, pgn, source, destination, data } = &self.message;
        let id =
            N2kId { priority: *priority, pgn: *pgn, source: *source, destination: *destination };
        match self.progress {
            Some(progress) => fast_packet::frame(id, data, progress.sequence, progress.next),
            None => CanFrame::new(id.compose(), data),
        }
    }

    /// Goes on to the next frame; true if there is none.
    fn advance(&mut self, now: Time) -> bool {
        let Some(progress) = &mut self.progress else { return true };
        progress.next += 1;
        progress.last_sent = now;
        usize::from(progress.next) >= fast_packet::frames(self.message.data.len())
    }
}

#[cfg(test)]
mod tests;
