//! What bytes become on a bad line.

use super::arrivals::share;

/// Bytes that look random.
#[must_use]
pub fn noise(seed: u64, length: usize) -> Vec<u8> {
    (0..length as u64).map(|index| (share(seed << 40 | index) * 256.0) as u8).collect()
}

/// What a receiver that is set to `ratio` times the sender's baud rate makes of bytes sent without a
/// pause: it waits for a start bit and samples eight bits at its own pace, whatever they are.
#[must_use]
pub fn at_wrong_baud(bytes: &[u8], ratio: f64) -> Vec<u8> {
    let mut levels = Vec::with_capacity(bytes.len() * 10);
    for byte in bytes {
        levels.push(false);
        levels.extend((0..8).map(|bit| byte >> bit & 1 == 1));
        levels.push(true);
    }
    let level = |at: f64| levels.get(at as usize).copied().unwrap_or(true);
    let (mut received, mut at) = (Vec::new(), 0);
    while at < levels.len() {
        if level(at as f64) {
            at += 1;
            continue;
        }
        let bits = (0..8).map(|bit| level(at as f64 + (1.5 + f64::from(bit)) / ratio));
        received.push(bits.rev().fold(0, |byte, bit| byte << 1 | u8::from(bit)));
        at += (9.5 / ratio).ceil() as usize;
    }
    received
}
