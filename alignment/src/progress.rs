//! Whether a heading still gets better.

/// Compares the 1-sigma with what it was a while ago.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Progress {
    /// So long, s, it has to become better by this share.
    within: f64,
    share: f64,
    /// The time, s, and the 1-sigma that the next are compared with.
    before: (f64, f64),
}

impl Progress {
    /// Begins at a time, s, with a 1-sigma, rad.
    pub(crate) fn begin((within, share): (f64, f64), seconds: f64, sigma: f64) -> Self {
        Progress { within, share, before: (seconds, sigma) }
    }

    /// Hears of the 1-sigma at a time; returns whether it has not become better by the share in the while that is over.
    pub(crate) fn stalls(&mut self, seconds: f64, sigma: f64) -> bool {
        let (then, before) = self.before;
        if seconds - then < self.within {
            return false;
        }
        self.before = (seconds, sigma);
        sigma > before * (1.0 - self.share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_gets_better_by_the_share_goes_on_and_what_does_not_stalls_when_the_while_is_over() {
        let mut progress = Progress::begin((10.0, 0.2), 0.0, 1.0);
        assert!(!progress.stalls(9.0, 1.0) && !progress.stalls(10.0, 0.7));
        assert!(!progress.stalls(19.0, 0.7) && progress.stalls(20.0, 0.6));
    }
}
