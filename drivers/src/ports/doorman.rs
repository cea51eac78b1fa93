//! Remembers who was not let in, and when that is to be told: once at first, then the count of each minute.

use std::net::IpAddr;

use insd_base::{Closed, PortState, Span, Time};

/// Time between two reports of one host.
const MINUTE: Span = Span::from_nanos(60_000_000_000);

/// A host that has not come for so long is told as at first when it comes again.
const FORGET: Span = Span::from_nanos(600_000_000_000);

/// Hosts that are told each for itself; all others are told together.
const HOSTS: usize = 32;

/// Who was not let in.
#[derive(Clone, Debug, Default)]
pub(super) struct Doorman(Vec<Visitor>);

#[derive(Clone, Debug)]
struct Visitor {
    /// `None`: those for whom there was no room in the list.
    host: Option<IpAddr>,
    why: Closed,
    /// Visits that were not told yet.
    untold: u64,
    told: Time,
}

impl Doorman {
    /// Somebody is turned away; gives what there is to tell at once.
    pub(super) fn refuse(&mut self, host: IpAddr, why: Closed, now: Time) -> Option<PortState> {
        let host = Some(host.to_canonical());
        if let Some(known) = self.find(host, why) {
            known.untold += 1;
            return known.due(now);
        }
        let host = host.filter(|_| self.0.len() < HOSTS);
        if host.is_none()
            && let Some(others) = self.find(None, why)
        {
            others.untold += 1;
            return others.due(now);
        }
        self.0.push(Visitor { host, why, untold: 0, told: now });
        self.0.last().map(|visitor| visitor.state(1))
    }

    /// What has become due to tell; to be called until there is nothing.
    pub(super) fn next(&mut self, now: Time) -> Option<PortState> {
        self.0.retain(|visitor| visitor.untold > 0 || now - visitor.told < FORGET);
        self.0.iter_mut().find_map(|visitor| visitor.due(now))
    }

    /// When something will be due; `None` if nothing waits to be told.
    pub(super) fn due_at(&self) -> Option<Time> {
        self.0
            .iter()
            .filter(|visitor| visitor.untold > 0)
            .map(|visitor| visitor.told + MINUTE)
            .min()
    }

    fn find(&mut self, host: Option<IpAddr>, why: Closed) -> Option<&mut Visitor> {
        self.0.iter_mut().find(|visitor| visitor.host == host && visitor.why == why)
    }
}

impl Visitor {
    fn due(&mut self, now: Time) -> Option<PortState> {
        if self.untold == 0 || now - self.told < MINUTE {
            return None;
        }
        self.told = now;
        let count = std::mem::take(&mut self.untold);
        Some(self.state(count))
    }

    fn state(&self, count: u64) -> PortState {
        let host = self.host.map_or_else(|| "other hosts".to_owned(), |host| host.to_string());
        PortState::Refused { host, why: self.why, count }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(seconds: f64) -> Time {
        Time::from_seconds(seconds)
    }

    fn counts(states: impl IntoIterator<Item = PortState>) -> Vec<(String, u64)> {
        let told = states.into_iter().filter_map(|state| match state {
            PortState::Refused { host, count, .. } => Some((host, count)),
            _ => None,
        });
        told.collect()
    }

    #[test]
    fn a_host_is_told_at_once_and_then_once_a_minute_with_every_visit_counted() {
        let (mut doorman, host) = (Doorman::default(), IpAddr::from([10, 0, 0, 9]));
        let told = (0..1500).filter_map(|tenth| {
            doorman.refuse(host, Closed::NotListed, at(f64::from(tenth) * 0.1))
        });
        let own = "10.0.0.9".to_owned();
        assert_eq!(counts(told), [(own.clone(), 1), (own.clone(), 600), (own.clone(), 600)]);
        assert_eq!(doorman.due_at(), Some(at(180.0)));
        assert_eq!(counts(doorman.next(at(180.0))), [(own, 299)]);
        assert_eq!(doorman.next(at(180.0)), None);
    }

    #[test]
    fn a_thousand_hosts_take_little_memory_and_few_lines() {
        let mut doorman = Doorman::default();
        let host = |number: u16| IpAddr::from([10, 0, (number >> 8) as u8, number as u8]);
        let told: Vec<PortState> = (0..1000)
            .filter_map(|number| doorman.refuse(host(number), Closed::Full, at(1.0)))
            .collect();
        assert_eq!((told.len(), doorman.0.len()), (HOSTS + 1, HOSTS + 1));
        let more = counts(std::iter::from_fn(|| doorman.next(at(61.0))));
        assert_eq!(more, [("other hosts".to_owned(), 1000 - HOSTS as u64 - 1)]);
        assert_eq!(counts(doorman.next(at(700.0))), []);
        assert_eq!(counts(doorman.refuse(host(999), Closed::Full, at(700.0))).len(), 1);
    }
}
