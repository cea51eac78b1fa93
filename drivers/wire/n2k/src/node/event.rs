//! What happened to a node that its owner may want to know, remember or tell.

use insd_base::Span;

use crate::Name;

/// Another node, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Peer {
    /// Its address.
    pub address: u8,
    /// Its NAME, if it has claimed that address.
    pub name: Option<Name>,
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NodeEvent {
    /// The node has an address and may send. Worth remembering.
    Claimed {
        /// Which.
        address: u8,
    },
    /// The node lost its address to another and claims the next.
    Lost {
        /// Which.
        address: u8,
        /// To whom.
        to: Name,
    },
    /// The node gave up its address because another with no right to it did not.
    GaveWay {
        /// Which.
        address: u8,
        /// To whom.
        to: Name,
    },
    /// Alarm: another node has the same NAME, such as a unit with a copied configuration.
    SameName {
        /// Where it sits.
        address: u8,
    },
    /// Another node sends from this node's address without having claimed it.
    AddressUsed {
        /// Which.
        address: u8,
    },
    /// No address is free: the node is quiet.
    NoneFree,
    /// A command was refused, as the node obeys none.
    CommandRefused {
        /// The group about which it was.
        pgn: u32,
        /// By whom.
        by: Peer,
    },
    /// The node was commanded to take another address, and claims it.
    Commanded {
        /// Which.
        address: u8,
        /// By whom.
        by: Peer,
    },
    /// A group shall be sent at another interval.
    IntervalChanged {
        /// Which.
        pgn: u32,
        /// Time from one message to the next; `None` is never.
        interval: Option<Span>,
        /// Time before the first, if it was told.
        offset: Option<Span>,
        /// Who wants it.
        by: Peer,
    },
    /// A group is sent with another priority.
    PriorityChanged {
        /// Which.
        pgn: u32,
        /// 0 to 7.
        priority: u8,
        /// Who wants it.
        by: Peer,
    },
    /// The texts of the installer have changed. Worth remembering.
    InstallationChanged {
        /// What they are.
        installation: [String; 2],
        /// Who wants it.
        by: Peer,
    },
    /// The instances in the node's NAME have changed. Worth remembering.
    NameChanged {
        /// The new NAME.
        name: Name,
        /// Who wants it.
        by: Peer,
    },
}
