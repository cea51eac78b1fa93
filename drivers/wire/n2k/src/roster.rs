//! Who sits at which address, learnt from address claims heard (group 60928).

use std::collections::BTreeMap;

use crate::{BusMessage, NULL_ADDRESS, Name};

/// Group of an address claim.
pub const ADDRESS_CLAIM: u32 = 60_928;
/// The last address that a node can have.
pub const LAST_ADDRESS: u8 = 251;

/// The nodes of a bus. At most one per address.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Roster {
    names: BTreeMap<u8, Name>,
}

/// What a claim changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RosterChange {
    /// Who claimed.
    pub name: Name,
    /// Where it was before.
    pub from: Option<u8>,
    /// Where it is now; `None` if it could not claim an address.
    pub to: Option<u8>,
    /// Who was there before.
    pub ousted: Option<Name>,
}

impl Roster {
    /// Learns from a message; anything but a claim is passed over. The last claim stands: who lost an
    /// address unjustly claims it again. `None` if nothing changed.
    pub fn learn(&mut self, message: &BusMessage) -> Option<RosterChange> {
        let name = claimed(message)?;
        let to = (message.source <= LAST_ADDRESS).then_some(message.source);
        let known = to.is_some() || message.source == NULL_ADDRESS;
        let from = self.address_of(name);
        if !known || from == to {
            return None;
        }
        if let Some(from) = from {
            self.names.remove(&from);
        }
        let ousted = to.and_then(|address| self.names.insert(address, name));
        Some(RosterChange { name, from, to, ousted })
    }

    /// Who sits at this address.
    #[must_use]
    pub fn name_at(&self, address: u8) -> Option<Name> {
        self.names.get(&address).copied()
    }

    /// Where this node sits.
    #[must_use]
    pub fn address_of(&self, name: Name) -> Option<u8> {
        self.names.iter().find(|(_, at)| **at == name).map(|(address, _)| *address)
    }

    /// All addresses and who sits there, in order of addresses.
    pub fn iter(&self) -> impl Iterator<Item = (u8, Name)> + '_ {
        self.names.iter().map(|(address, name)| (*address, *name))
    }

    /// Forgets who sat at this address: somebody else has taken it, and nobody objected.
    pub(crate) fn vacate(&mut self, address: u8) {
        self.names.remove(&address);
    }

    /// Forgets all, as when the bus may have changed while nobody listened.
    pub fn clear(&mut self) {
        self.names.clear();
    }
}

/// The NAME in a message, if it is a claim.
pub(crate) fn claimed(message: &BusMessage) -> Option<Name> {
    let bytes = message.data.first_chunk::<8>().filter(|_| message.pgn == ADDRESS_CLAIM)?;
    Some(Name::from_bytes(*bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(source: u8, name: u64) -> BusMessage {
        let data = name.to_le_bytes().to_vec();
        BusMessage { priority: 6, pgn: ADDRESS_CLAIM, source, destination: 255, data }
    }

    #[test]
    fn a_claim_tells_who_sits_where() {
        let mut roster = Roster::default();
        let change = roster.learn(&claim(5, 77)).unwrap();
        assert_eq!((change.from, change.to, change.ousted), (None, Some(5), None));
        assert_eq!(roster.learn(&claim(5, 77)), None);
        assert_eq!(roster.name_at(5), Some(Name::new(77)));
        assert_eq!(roster.address_of(Name::new(77)), Some(5));
    }

    #[test]
    fn a_node_that_moves_leaves_its_place_and_may_oust_another() {
        let mut roster = Roster::default();
        roster.learn(&claim(5, 77));
        roster.learn(&claim(6, 88));
        let change = roster.learn(&claim(6, 77)).unwrap();
        assert_eq!((change.from, change.to), (Some(5), Some(6)));
        assert_eq!(change.ousted, Some(Name::new(88)));
        assert_eq!(roster.iter().collect::<Vec<_>>(), [(6, Name::new(77))]);
    }

    #[test]
    fn a_node_that_cannot_claim_is_nowhere() {
        let mut roster = Roster::default();
        roster.learn(&claim(5, 77));
        assert_eq!(roster.learn(&claim(254, 77)).unwrap().to, None);
        assert_eq!(roster.name_at(5), None);
        assert_eq!(roster.learn(&claim(253, 77)), None);
        assert_eq!(roster.learn(&BusMessage { data: vec![1, 2], ..claim(5, 77) }), None);
    }
}
