//! Whether bytes were read at the right baud rate.

use std::fmt;
use std::sync::Arc;

use insd_base::{Span, Time};

/// What bytes say of the baud rate at which they were read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaudJudgement {
    /// It is the right one: frames with good checksums, for example.
    Fits,
    /// Too few bytes to tell.
    Unsure,
    /// It is not the right one.
    Wrong,
}

/// Judges the bytes of a port: given by the caller, who knows the protocol.
#[derive(Clone)]
pub struct BaudJudge(Arc<Judging>);

type Judging = dyn Fn(&[u8]) -> BaudJudgement + Send + Sync;

/// Bytes that are kept for judging.
const KEPT: usize = 16 * 1024;

/// How long bytes may fit no more before the rate is searched again.
const PATIENCE: Span = Span::from_nanos(10_000_000_000);

/// How often bytes are judged after that.
const LATER: Span = Span::from_nanos(1_000_000_000);

impl BaudJudge {
    /// A judge that is this function. It is called with all bytes heard at one rate, the oldest of
    /// very many left out.
    pub fn new(judge: impl Fn(&[u8]) -> BaudJudgement + Send + Sync + 'static) -> Self {
        BaudJudge(Arc::new(judge))
    }

    pub(super) fn judge(&self, bytes: &[u8]) -> BaudJudgement {
        (self.0)(bytes)
    }
}

impl fmt::Debug for BaudJudge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Judge")
    }
}

/// Leaves out the oldest of very many bytes.
pub(super) fn forget_oldest(heard: &mut Vec<u8>) {
    let excess = heard.len().saturating_sub(KEPT);
    heard.drain(..excess);
}

/// Goes on judging after a rate was found: somebody may set the device to another.
#[derive(Debug)]
pub(super) struct Doubt {
    judge: BaudJudge,
    heard: Vec<u8>,
    /// When bytes last fitted.
    fitted: Time,
    judged: Time,
}

impl Doubt {
    /// A rate was found just now.
    pub(super) fn new(judge: BaudJudge, now: Time) -> Self {
        Doubt { judge, heard: Vec::new(), fitted: now, judged: now }
    }

    /// Bytes came. Gives the reason to search again, when they have not fitted for long.
    pub(super) fn hear(&mut self, now: Time, bytes: &[u8]) -> Option<String> {
        if self.heard.is_empty() && now - self.judged > PATIENCE {
            // the line was silent: that is no sign of a wrong rate
            self.fitted = now;
        }
        self.heard.extend_from_slice(bytes);
        forget_oldest(&mut self.heard);
        if now - self.judged < LATER {
            return None;
        }
        self.judged = now;
        if self.judge.judge(&self.heard) == BaudJudgement::Fits {
            self.fitted = now;
            self.heard.clear();
        }
        let span = now - self.fitted;
        (span > PATIENCE).then(|| format!("nothing readable for {:.0} s", span.as_seconds()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn doubt() -> Doubt {
        let judge = |bytes: &[u8]| {
            if bytes.contains(&b'$') { BaudJudgement::Fits } else { BaudJudgement::Unsure }
        };
        Doubt::new(BaudJudge::new(judge), Time::START)
    }

    fn second(seconds: i64) -> Time {
        Time::from_seconds(seconds as f64)
    }

    #[test]
    fn a_rate_is_doubted_after_ten_seconds_of_junk_and_not_before() {
        let mut doubt = doubt();
        assert_eq!(doubt.hear(second(5), b"$"), None);
        assert!((6..=15).all(|at| doubt.hear(second(at), b"junk").is_none()));
        assert_eq!(doubt.hear(second(16), b"junk").unwrap(), "nothing readable for 11 s");
    }

    #[test]
    fn silence_does_not_make_a_rate_doubtful() {
        let mut doubt = doubt();
        assert_eq!(doubt.hear(second(1), b"$"), None);
        assert_eq!(doubt.hear(second(1000), b"half a fra"), None);
    }
}
