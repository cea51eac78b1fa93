//! A count that starts again, made endless.

use insd_wire::imu::Wrapping;

/// Counts of at most this many values go on over their end every few seconds.
const SHORT: u64 = 1 << 16;
/// The furthest back a short count steps: datagrams that changed places.
const OVERTAKEN: u64 = 3;

/// Follows a wrapping count.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwrap {
    last: Option<(Wrapping, i64)>,
}

impl Unwrap {
    /// The endless count. A short count (a sample number) goes on by up to a cycle, apart from steps
    /// back by at most three; a long one (a clock) may step by half a cycle either way. A count that
    /// starts again elsewhere than before is another one, and starts anew.
    pub fn follow(&mut self, count: Wrapping) -> i64 {
        let modulus = count.modulus.max(1);
        let value = count.value % modulus;
        let same = self.last.filter(|(before, _)| before.modulus == modulus);
        let endless = match same {
            None => signed(value),
            Some((Wrapping { value: before, .. }, endless)) => {
                let ahead =
                    if value < before { modulus - (before - value) } else { value - before };
                let behind = modulus - ahead;
                let back = if modulus <= SHORT { behind <= OVERTAKEN } else { behind < ahead };
                endless.saturating_add(if back { -signed(behind) } else { signed(ahead) })
            }
        };
        self.last = Some((Wrapping { value, modulus }, endless));
        endless
    }

    /// Adds whole cycles that passed unseen, as told by another clock.
    pub fn skip(&mut self, counts: i64) {
        if let Some((_, endless)) = &mut self.last {
            *endless = endless.saturating_add(counts);
        }
    }
}

fn signed(count: u64) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_of_64_bits_is_followed_both_ways() {
        let mut unwrap = Unwrap::default();
        let values = [1_000, u64::MAX / 4, 3_000];
        let endless = values.map(|value| unwrap.follow(Wrapping { value, modulus: u64::MAX }));
        assert_eq!(endless, [1_000, (u64::MAX / 4) as i64, 3_000]);
    }

    #[test]
    fn a_clock_that_goes_over_at_another_end_from_now_on_is_followed() {
        let mut unwrap = Unwrap::default();
        unwrap.follow(Wrapping { value: 4_000_000_000, modulus: 1 << 32 });
        let day = 864_000_000;
        let first = unwrap.follow(Wrapping { value: 5_000, modulus: day });
        let next = unwrap.follow(Wrapping { value: 5_100, modulus: day });
        assert_eq!(next - first, 100);
    }

    #[test]
    fn a_count_goes_on_over_its_end_and_small_steps_back_are_steps_back() {
        let mut unwrap = Unwrap::default();
        let values = [250, 255, 0, 3, 2, 130, 1];
        let endless = values.map(|value| unwrap.follow(Wrapping { value, modulus: 256 }));
        assert_eq!(endless, [250, 255, 256, 259, 258, 386, 513]);
        unwrap.skip(256);
        assert_eq!(unwrap.follow(Wrapping { value: 2, modulus: 256 }), 770);
    }

    #[test]
    fn a_clock_that_is_set_to_the_time_of_day_starts_anew() {
        let mut unwrap = Unwrap::default();
        unwrap.follow(Wrapping { value: 3_000_000_000, modulus: 1 << 32 });
        assert_eq!(unwrap.follow(Wrapping { value: 5, modulus: 864_000_000 }), 5);
        assert_eq!(unwrap.follow(Wrapping { value: 863_999_999, modulus: 864_000_000 }), -1);
    }
}
