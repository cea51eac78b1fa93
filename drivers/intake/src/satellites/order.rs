//! Epochs in their order, each once.

use insd_base::GpsTime;

/// So many epochs in a row that follow each other, behind the newest one, are a clock that went back.
const PATIENCE: u8 = 5;

/// Tells a repeated epoch, or one that comes behind its time, from a clock that was set back.
#[derive(Clone, Copy, Debug, Default)]
pub struct EpochOrder {
    newest: Option<GpsTime>,
    /// The last that came behind its time, and how many have in a row.
    behind: Option<(GpsTime, u8)>,
}

impl EpochOrder {
    /// Whether an epoch with this tag is the next one. Tags that stay behind the newest are believed when five in a row follow each other.
    pub fn admit(&mut self, tag: GpsTime) -> bool {
        if self.newest.is_some_and(|newest| tag <= newest) {
            let follows = self.behind.filter(|(last, _)| tag > *last);
            let count = follows.map_or(1, |(_, count)| count + 1);
            if count < PATIENCE {
                self.behind = Some((tag, count));
                return false;
            }
        }
        self.newest = Some(tag);
        self.behind = None;
        true
    }

    /// The newest one.
    #[must_use]
    pub fn newest(&self) -> Option<GpsTime> {
        self.newest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn admitted(tags: &[i64]) -> Vec<i64> {
        let mut order = EpochOrder::default();
        tags.iter().copied().filter(|tag| order.admit(GpsTime::from_nanos(*tag))).collect()
    }

    #[test]
    fn an_epoch_that_comes_again_or_late_is_left_out() {
        assert_eq!(admitted(&[1, 1, 2, 2, 3, 3, 4, 1, 5]), [1, 2, 3, 4, 5]);
        assert_eq!(admitted(&[5, 1, 6, 2, 7, 3, 8, 4, 9]), [5, 6, 7, 8, 9]);
    }

    #[test]
    fn a_clock_that_was_set_back_is_believed_when_five_epochs_agree() {
        assert_eq!(admitted(&[100, 1, 2, 3, 4, 5, 6]), [100, 5, 6]);
    }
}
