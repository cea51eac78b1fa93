//! What a caster is asked.

use super::config::Ntrip;

/// Who asks.
const AGENT: &str = concat!("NTRIP insd/", env!("CARGO_PKG_VERSION"));
const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

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
        let own = base64(format!("{user}:{password}").as_bytes());
        text.push_str(&format!("Authorization: Basic {own}\r\n"));
    }
    text.push_str("\r\n");
    text.into_bytes()
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let of = |at: usize| u32::from(chunk.get(at).copied().unwrap_or(0));
        let group = of(0) << 16 | of(1) << 8 | of(2);
        for at in 0..4 {
            let letter = ALPHABET[(group >> (18 - 6 * at) & 0x3F) as usize];
            text.push(if at <= chunk.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        let all = ["", "f", "fo", "foo", "foob", "fooba", "foobar"];
        let told = all.map(|text| base64(text.as_bytes()));
        assert_eq!(told, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
        assert_eq!(base64(&[0xFF, 0xFE, 0xFD, 0]), "//79AA==");
    }

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
