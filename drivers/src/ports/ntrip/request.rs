//! What a caster is asked.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::config::Ntrip;

/// Who asks.
const AGENT: &str = concat!("NTRIP insd/", env!("CARGO_PKG_VERSION"));

/// The request for a stream: RTCM 10410.0 (NTRIP 1) or 10410.1 (NTRIP 2).
pub(super) fn request(config: &Ntrip, password: &str) -> Vec<u8> {
    let (mount, address) = (&config.mount, &config.address);
    let mut text = match config.version {
        1 => format!("GET /{mount} HTTP/1.0\r\nUser-Agent: {AGENT}\r\n"),
        _ => format!(
            "GET /{mount} HTTP/1.1\r\nHost: {address}\r\nNtrip-Version: Ntrip/2.0\r\n\
             User-Agent: {AGENT}\r\nConnection: close\r\n"
        ),
    };
    if let Some(user) = &config.user {
        let own = STANDARD.encode(format!("{user}:{password}"));
        text.push_str(&format!("Authorization: Basic {own}\r\n"));
    }
    text.push_str("\r\n");
    text.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_version_asks_in_its_own_words() {
        let own = Ntrip {
            user: Some("ship".to_owned()),
            ..Ntrip::new("caster:2101".to_owned(), "BASE".to_owned())
        };
        let second = String::from_utf8(request(&own, "sea")).unwrap();
        assert!(second.starts_with("GET /BASE HTTP/1.1\r\nHost: caster:2101\r\n"), "{second}");
        assert!(second.contains("Ntrip-Version: Ntrip/2.0\r\n"), "{second}");
        assert!(second.ends_with("Authorization: Basic c2hpcDpzZWE=\r\n\r\n"), "{second}");
        let first = Ntrip { version: 1, user: None, ..own };
        let first = String::from_utf8(request(&first, "")).unwrap();
        assert!(first.starts_with("GET /BASE HTTP/1.0\r\nUser-Agent: NTRIP "), "{first}");
        assert!(!first.contains("Authorization") && first.ends_with("\r\n\r\n"), "{first}");
    }
}
