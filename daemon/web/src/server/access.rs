//! Who may ask, and who may change something.

use std::collections::HashMap;
use std::hint::black_box;
use std::net::{IpAddr, Ipv4Addr};
use std::sync::{Mutex, MutexGuard, PoisonError};

use axum::http::HeaderMap;
use axum::http::header::AUTHORIZATION;

use crate::config::MIN_TOKEN;

/// Wrong tokens after which a client is not listened to for a while.
const PATIENCE: u32 = 10;
/// Clients whose wrong tokens are counted each for itself.
const CLIENTS: usize = 256;

/// Who may ask, and who may change something.
#[derive(Debug)]
pub(super) struct Access {
    token: Option<String>,
    /// Why there is none.
    read_only: Option<String>,
    hosts: Vec<String>,
    failures: Mutex<HashMap<IpAddr, u32>>,
}

/// Why something may not be changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Denied {
    /// Nothing can be changed over the network.
    Disabled,
    /// No token was sent, or a wrong one.
    WrongToken,
    /// Too many wrong ones.
    TooMany,
}

impl Denied {
    /// The same in words.
    pub(super) fn as_str(self) -> &'static str {
        match self {
            Denied::Disabled => "nothing can be changed on the page",
            Denied::WrongToken => "no token, or a wrong one",
            Denied::TooMany => "too many wrong tokens",
        }
    }
}

impl Access {
    pub(super) fn new(token: Option<String>, hosts: &[String]) -> Self {
        let hosts = hosts.iter().map(|host| host.to_ascii_lowercase()).collect();
        // by a token that can be guessed nobody may change anything, and all may look
        let read_only = match token.as_ref().map(|token| token.chars().count()) {
            None => Some("no token is configured".to_owned()),
            Some(length) if length < MIN_TOKEN => {
                tracing::error!(
                    "the token has {length} characters, {MIN_TOKEN} is the least: the page is read only"
                );
                Some(format!("the token has {length} characters, {MIN_TOKEN} is the least"))
            }
            Some(_) => None,
        };
        let token = token.filter(|_| read_only.is_none());
        Access { token, read_only, hosts, failures: Mutex::default() }
    }

    /// Why nothing can be changed at all; `None` if it can.
    pub(super) fn read_only(&self) -> Option<&str> {
        self.read_only.as_deref()
    }

    /// Whether the page is asked for under a name that it may have. A bare address is always one: what
    /// DNS can be made to say is names.
    pub(super) fn knows_host(&self, host: &str) -> bool {
        let name = name_of(host).trim_end_matches('.').to_ascii_lowercase();
        let bare = name.trim_start_matches('[').trim_end_matches(']');
        name == "localhost" || bare.parse::<IpAddr>().is_ok() || self.hosts.contains(&name)
    }

    /// Whether a client may change something.
    pub(super) fn check(&self, headers: &HeaderMap, client: IpAddr) -> Result<(), Denied> {
        let token = self.token.as_deref().ok_or(Denied::Disabled)?;
        let mut failures = self.failures();
        let known = failures.len() < CLIENTS || failures.contains_key(&client);
        // those for whom there is no room are counted together
        let client = if known { client } else { Ipv4Addr::UNSPECIFIED.into() };
        if failures.get(&client).is_some_and(|count| *count >= PATIENCE) {
            return Err(Denied::TooMany);
        }
        if sent(headers).is_some_and(|sent| is_same(sent, token.as_bytes())) {
            return Ok(());
        }
        *failures.entry(client).or_default() += 1;
        Err(Denied::WrongToken)
    }

    /// Forgets one wrong token of each client.
    pub(super) fn forget(&self) {
        self.failures().retain(|_, count| {
            *count -= 1;
            *count > 0
        });
    }

    fn failures(&self) -> MutexGuard<'_, HashMap<IpAddr, u32>> {
        self.failures.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A host without its port.
fn name_of(host: &str) -> &str {
    match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        _ => host,
    }
}

fn sent(headers: &HeaderMap) -> Option<&[u8]> {
    headers.get(AUTHORIZATION)?.as_bytes().strip_prefix(b"Bearer ")
}

/// Compares in a time that depends on the length alone.
fn is_same(sent: &[u8], own: &[u8]) -> bool {
    let differing = sent.iter().zip(own).fold(0, |all, (a, b)| black_box(all | (a ^ b)));
    sent.len() == own.len() && differing == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_refused_unless_they_are_configured() {
        let access = Access::new(None, &["Bridge.Ship.example".to_owned()]);
        let good = ["localhost", "localhost:8470", "127.0.0.1:8470", "[::1]:8470", "192.0.2.7"];
        assert!(good.iter().all(|host| access.knows_host(host)));
        assert!(access.knows_host("bridge.ship.example:80"));
        let bad = ["evil.example", "localhost.evil.example", "127.0.0.1.evil.example:8470", ""];
        assert!(!bad.iter().any(|host| access.knows_host(host)));
    }

    #[test]
    fn who_guesses_is_not_listened_to_until_time_has_gone() {
        let access = Access::new(Some("0123456789abcdef".to_owned()), &[]);
        let client = IpAddr::from([192, 0, 2, 1]);
        let with = |token: &str| {
            let mut headers = HeaderMap::new();
            headers.insert(AUTHORIZATION, format!("Bearer {token}").parse().unwrap());
            headers
        };
        let right = with("0123456789abcdef");
        for wrong in ["", "0123456789abcdeF", "0123456789abcde", "0123456789abcdef0", "x"].repeat(2)
        {
            assert_eq!(access.check(&with(wrong), client), Err(Denied::WrongToken));
        }
        assert_eq!(access.check(&right, client), Err(Denied::TooMany));
        assert_eq!(access.check(&right, IpAddr::from([192, 0, 2, 2])), Ok(()));
        access.forget();
        assert_eq!(access.check(&right, client), Ok(()));
    }

    #[test]
    fn guesses_from_everywhere_take_no_memory_without_bound() {
        let access = Access::new(Some("0123456789abcdef".to_owned()), &[]);
        for number in 0..10_000_u32 {
            let _ = access.check(&HeaderMap::new(), IpAddr::from(number.to_be_bytes()));
        }
        assert!(access.failures().len() <= CLIENTS + 1);
    }
}
