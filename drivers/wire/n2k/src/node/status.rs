//! How a node is, and what it has done.

use super::Node;
use super::claim::ContestCounts;
use super::queue::QueueCounts;
use crate::{AssemblerCounts, Name};

/// How far a node is with its address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeState {
    /// There is no bus.
    Down,
    /// It has claimed an address, or is about to, and waits for objections.
    Claiming,
    /// It has an address.
    Held,
    /// It has none and is quiet.
    CannotClaim,
}

impl NodeState {
    /// Its word: `down`, `claiming`, `held`, `cannot_claim`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            NodeState::Down => "down",
            NodeState::Claiming => "claiming",
            NodeState::Held => "held",
            NodeState::CannotClaim => "cannot_claim",
        }
    }
}

/// How a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NodeStatus {
    /// How far it is with its address.
    pub state: NodeState,
    /// The address it holds.
    pub address: Option<u8>,
    /// Its NAME.
    pub name: Name,
    /// Messages that wait to be sent.
    pub waiting: usize,
}

/// Requests heard and answers given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RequestCounts {
    /// ISO requests to this node or to everybody.
    pub requests: u64,
    /// Requests that were answered together with an earlier one.
    pub joined: u64,
    /// Answers given.
    pub answers: u64,
    /// Refusals sent.
    pub refusals: u64,
    /// Refusals and acknowledgements not sent because there were too many.
    pub rationed: u64,
    /// Refusals heard of something this node asked for.
    pub refused: u64,
    /// Group functions to this node or to everybody: requests, commands and others.
    pub functions: u64,
    /// Group functions of which something was not granted.
    pub denied: u64,
    /// Acknowledgements of group functions heard.
    pub acknowledged: u64,
    /// Commanded addresses for this node.
    pub commanded: u64,
    /// Messages handed in while there was no address.
    pub without_address: u64,
    /// Messages handed in of a group that is not in the transmit table.
    pub not_in_table: u64,
}

/// What a node has done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NodeCounts {
    /// Contests for its address.
    pub contests: ContestCounts,
    /// Requests and answers.
    pub requests: RequestCounts,
    /// What was sent.
    pub queue: QueueCounts,
    /// What was heard.
    pub assembler: AssemblerCounts,
}

impl Node {
    /// How the node is.
    #[must_use]
    pub fn status(&self) -> NodeStatus {
        let address = self.address();
        let state = if self.claim.is_down() {
            NodeState::Down
        } else if self.claim.is_claiming() {
            NodeState::Claiming
        } else if address.is_some() {
            NodeState::Held
        } else {
            NodeState::CannotClaim
        };
        NodeStatus { state, address, name: self.config.name, waiting: self.queue.len() }
    }

    /// What the node has done since it was made.
    #[must_use]
    pub fn counts(&self) -> NodeCounts {
        NodeCounts {
            contests: self.claim.counts,
            requests: self.requests,
            queue: self.queue.counts(),
            assembler: self.assembler.counts(),
        }
    }
}
