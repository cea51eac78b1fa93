//! The small generator of the delays by which nodes keep out of each other's way (splitmix64: Steele,
//! Lea and Flood, "Fast splittable pseudorandom number generators", 2014).

use insd_base::{Span, Time};

/// A seeded generator.
#[derive(Clone, Debug)]
pub(crate) struct Random(u64);

/// The longest delay before a claim that could collide, microseconds (ISO 11783-5: 0 to 255 times 0.6 ms).
const LONGEST_DELAY: u64 = 153_000;

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Random(seed)
    }

    /// Mixes in when something happened: two units that were copied have the same seed, but frames
    /// do not reach them at the same nanosecond of their clocks.
    pub(crate) fn stir(&mut self, now: Time) {
        self.0 ^= now.as_nanos() as u64;
        self.next();
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    /// A delay from 0 to 153 ms.
    pub(crate) fn delay(&mut self) -> Span {
        let microseconds = self.next() % (LONGEST_DELAY + 1);
        Span::from_nanos(microseconds as i64 * 1000)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_fill_their_range() {
        let mut random = Random::new(1);
        let delays: Vec<f64> = (0..2000).map(|_| random.delay().as_seconds()).collect();
        let (least, most) = delays
            .iter()
            .fold((1.0_f64, 0.0_f64), |(least, most), delay| (least.min(*delay), most.max(*delay)));
        assert!(least < 0.001 && (0.152..=0.153).contains(&most), "{least} {most}");
    }
}
