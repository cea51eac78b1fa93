//! What leaves a node: frames that its address allows, whole fast packets in order, and not too many.

use std::collections::VecDeque;

use insd_base::can::CanFrame;
use insd_base::{Span, Time};
use insd_n2k::node::{Node, NodeState};
use insd_n2k::{N2kId, NULL_ADDRESS, fast_packet};

/// Frames that may leave within 5 ms, and the same again as bursts need not begin with the window.
const MOST_IN_WINDOW: usize = 16;
const WINDOW: Span = Span::from_nanos(5_000_000);
/// Claims that may leave at once and in each second of the last ten: 32 and 4 of contests, and 20 that
/// were asked for; one more of each at the edges.
const MOST_CLAIMS: usize = 34 + 10 * (4 + 20 + 1);
const CLAIM_WINDOW: Span = Span::from_nanos(10_000_000_000);

/// A fast packet under way.
#[derive(Clone, Copy, Debug)]
struct Begun {
    id: N2kId,
    sequence: u8,
    next: u8,
    frames: usize,
}

/// Looks at each frame.
#[derive(Debug, Default)]
pub(crate) struct Leaving {
    begun: Option<Begun>,
    /// What the queue has dropped, as far as is known.
    cleared: u64,
    times: VecDeque<Time>,
    claims: VecDeque<Time>,
    /// Frames that left.
    pub(crate) frames: u64,
    /// Fast packets that left whole.
    pub(crate) whole: u64,
}

impl Leaving {
    /// A frame is handed out, and has not left yet.
    pub(crate) fn look(&mut self, node: &Node, frame: &CanFrame) {
        let id = N2kId::parse(frame.id()).unwrap();
        let state = node.status().state;
        let manages = [59_904, 60_928].contains(&id.pgn);
        assert!(state == NodeState::Held || manages, "{id:?} while {state:?}");
        assert_ne!(state, NodeState::Down);
        let from_null = id.source == NULL_ADDRESS && manages;
        assert!(from_null || node.address().is_none_or(|own| own == id.source), "{id:?}");
        self.learn_of_drops(node);
    }

    /// Another bus, on which nothing was claimed yet.
    pub(crate) fn forget_claims(&mut self) {
        self.claims.clear();
    }

    /// Whether the queue has dropped all, and with it a message that was begun.
    fn learn_of_drops(&mut self, node: &Node) -> bool {
        let cleared = node.counts().queue.cleared;
        let dropped = std::mem::replace(&mut self.cleared, cleared) != cleared;
        self.begun = self.begun.filter(|_| !dropped);
        dropped
    }

    /// The frame has left. Who loses its address meanwhile does not go on with a message.
    pub(crate) fn left(&mut self, node: &Node, frame: &CanFrame, now: Time) {
        let dropped = self.learn_of_drops(node);
        self.frames += 1;
        let id = N2kId::parse(frame.id()).unwrap();
        count(&mut self.times, now, WINDOW, MOST_IN_WINDOW);
        if id.pgn == 60_928 {
            count(&mut self.claims, now, CLAIM_WINDOW, MOST_CLAIMS);
        }
        if fast_packet::is_fast(id.pgn) && !dropped {
            self.follow(id, frame.data());
        }
    }

    fn follow(&mut self, id: N2kId, data: &[u8]) {
        assert_eq!(data.len(), 8, "{id:?}");
        let (sequence, index) = (data[0] >> 5, data[0] & 31);
        let mut begun = match self.begun.take() {
            None => {
                assert_eq!(index, 0, "{id:?} {data:?}: without a beginning");
                let length = usize::from(data[1]);
                assert!(length <= fast_packet::MAX_LENGTH);
                Begun { id, sequence, next: 0, frames: fast_packet::frames(length) }
            }
            Some(begun) => begun,
        };
        let is_next = (begun.id, begun.sequence, begun.next) == (id, sequence, index);
        assert!(is_next, "{id:?} {data:?} where {begun:?} goes on");
        begun.next += 1;
        let ended = usize::from(begun.next) == begun.frames;
        self.whole += u64::from(ended);
        self.begun = Some(begun).filter(|_| !ended);
    }
}

/// Adds an instant to those within a window, which are bounded.
fn count(times: &mut VecDeque<Time>, now: Time, window: Span, most: usize) {
    while times.front().is_some_and(|first| now - *first >= window) {
        times.pop_front();
    }
    times.push_back(now);
    assert!(times.len() <= most, "{} frames", times.len());
}
