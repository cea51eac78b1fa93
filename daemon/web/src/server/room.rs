//! How many connections there may be: of all, and of one address, so that nobody takes all of them.

use std::collections::HashMap;
use std::net::IpAddr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The places that there are.
#[derive(Debug)]
pub(super) struct Room {
    all: usize,
    each: usize,
    taken: Arc<Taken>,
}

/// How many places each address has.
#[derive(Debug, Default)]
struct Taken(Mutex<HashMap<IpAddr, usize>>);

/// A place, which is free again when this is dropped.
#[derive(Debug)]
pub(super) struct Place {
    host: IpAddr,
    taken: Arc<Taken>,
}

impl Room {
    /// So many places, and so many for one address.
    pub(super) fn new(all: usize, each: usize) -> Self {
        Room { all: all.max(1), each: each.max(1), taken: Arc::default() }
    }

    /// Takes a place.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub(super) fn enter(&self, host: IpAddr) -> Result<Place, &'static str> {
        let host = host.to_canonical();
        let mut taken = self.taken.lock();
        if taken.get(&host).is_some_and(|own| *own >= self.each) {
            return Err("it has as many connections as one address may have");
        }
        if taken.values().sum::<usize>() >= self.all {
            return Err("all connections are taken");
        }
        *taken.entry(host).or_default() += 1;
        Ok(Place { host, taken: Arc::clone(&self.taken) })
    }
}

impl Taken {
    fn lock(&self) -> MutexGuard<'_, HashMap<IpAddr, usize>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let mut taken = self.taken.lock();
        if let Some(own) = taken.get_mut(&self.host) {
            *own -= 1;
            if *own == 0 {
                taken.remove(&self.host);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_address_takes_its_share_and_no_more_and_gives_it_back() {
        let room = Room::new(5, 2);
        let host = |last: u8| IpAddr::from([10, 0, 0, last]);
        let mut places: Vec<Place> = (0..2).map(|_| room.enter(host(1)).unwrap()).collect();
        assert!(room.enter(host(1)).is_err());
        assert!(room.enter("::ffff:10.0.0.1".parse().unwrap()).is_err());
        places.extend([room.enter(host(2)).unwrap(), room.enter(host(2)).unwrap()]);
        places.push(room.enter(host(3)).unwrap());
        assert!(room.enter(host(4)).is_err(), "all are taken");
        places.clear();
        assert!(room.taken.lock().is_empty());
        assert!(room.enter(host(1)).is_ok());
    }
}
