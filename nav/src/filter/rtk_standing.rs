//! How far places against a base are believed, by whether they agree with inertial navigation.

use insd_base::Time;
use insd_base::satellites::{RtkSilence, RtkTurn};

/// So many in a row that contradict the ship are no outliers.
const CONTRADICTIONS: u8 = 3;
/// So many in a row that agree are believed again.
const AGREEING: u8 = 10;

/// How far places against a base are believed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RtkStanding {
    /// When one was used last.
    pub(super) used: Option<Time>,
    /// 1-sigma of what the base's coordinates are off by, level and down, m, once a place has been used.
    pub(super) base_std: Option<[f64; 2]>,
    /// Whether somebody on board answers for where the base is, as of that place.
    pub(super) is_base_surveyed: bool,
    /// In a row that contradict the ship, or agree while that is not believed.
    refuted: u8,
    agreeing: u8,
    pub(super) is_contradicted: bool,
    /// Why the last epoch gave none.
    pub(super) silence: Option<RtkSilence>,
}

impl RtkStanding {
    /// Takes note of whether a place agrees; tells whether it may be used, and what is new of how far RTK is believed.
    pub(super) fn hear(&mut self, agrees: bool) -> (bool, Option<RtkTurn>) {
        self.refuted = if agrees { 0 } else { self.refuted.saturating_add(1) };
        self.agreeing = if agrees { self.agreeing.saturating_add(1) } else { 0 };
        let turn = if self.is_contradicted {
            (self.agreeing >= AGREEING).then_some(RtkTurn::Agrees)
        } else {
            (self.refuted >= CONTRADICTIONS).then_some(RtkTurn::Contradicted)
        };
        if turn.is_some() {
            self.is_contradicted = !self.is_contradicted;
        }
        (agrees && !self.is_contradicted, turn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heard(standing: &mut RtkStanding, agrees: bool, times: u8) -> Vec<(bool, Option<RtkTurn>)> {
        (0..times).map(|_| standing.hear(agrees)).collect()
    }

    #[test]
    fn an_outlier_is_not_used_and_changes_nothing() {
        let mut standing = RtkStanding::default();
        assert_eq!(heard(&mut standing, false, 2), [(false, None); 2]);
        assert_eq!(standing.hear(true), (true, None));
    }

    #[test]
    fn who_contradicts_three_times_is_believed_again_after_ten_that_agree() {
        let mut standing = RtkStanding::default();
        let turns = heard(&mut standing, false, 3);
        assert_eq!(turns[2], (false, Some(RtkTurn::Contradicted)));
        assert_eq!(heard(&mut standing, true, 9), [(false, None); 9]);
        assert_eq!(standing.hear(false), (false, None));
        let again = heard(&mut standing, true, 10);
        assert_eq!(again[9], (true, Some(RtkTurn::Agrees)));
    }
}
