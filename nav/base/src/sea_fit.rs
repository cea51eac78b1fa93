//! How well the model of the sea fits that a ship is held by at her berth.

use std::fmt;

/// What a model of the sea did not foretell, beside what it claims to leave: the mean over the last minutes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenResidual {
    /// What is to be said of it.
    pub verdict: Residual,
    /// Variance over the claimed one.
    pub level: f64,
    /// The same of its slow part, which the claimed heading rests on.
    pub slow: f64,
    /// Its largest correlation with what was left before.
    pub correlation: f64,
    /// So long before, s.
    pub apart: f64,
}

/// What is to be said of what a model leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Residual {
    /// It is white, and no more than claimed.
    White,
    /// It is not white, but its slow part is no more than claimed.
    Coloured,
    /// Its slow part is more than claimed: the model does not hold.
    Loud,
}

impl Residual {
    /// Its name in files: `white`, `coloured`, `loud`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Residual::White => "white",
            Residual::Coloured => "coloured",
            Residual::Loud => "loud",
        }
    }
}

/// How well the model of the sea fits that a ship is held by at her berth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeaFit {
    /// Samples that the model looks back.
    pub order: usize,
    /// What it leaves; `None` while too little was seen to tell.
    pub seen: Option<SeenResidual>,
    /// How often it did not hold, so that what is known of any sea had to count again.
    pub fallbacks: u32,
}

impl fmt::Display for SeaFit {
    /// A sentence for people.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "of order {}: ", self.order)?;
        match self.seen {
            None => write!(f, "too little is seen to tell whether it fits")?,
            Some(seen) => write!(f, "{seen}")?,
        }
        match self.fallbacks {
            0 => Ok(()),
            times => {
                write!(f, "; begun anew {times} times, as its slow part was more than claimed")
            }
        }
    }
}

impl fmt::Display for SeenResidual {
    /// A sentence for people.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let SeenResidual { verdict, level, slow, correlation, apart } = *self;
        match verdict {
            Residual::White => {
                write!(f, "what it leaves is white, {level:.2} of the claimed variance")
            }
            Residual::Coloured => write!(
                f,
                "what it leaves is not white ({correlation:.2} after {apart:.0} s), its slow part {slow:.2} of the claimed"
            ),
            Residual::Loud => {
                write!(
                    f,
                    "it does not fit: the slow part of what it leaves is {slow:.1} of the claimed"
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_are_told_whether_it_holds() {
        let seen = SeenResidual {
            verdict: Residual::Coloured,
            level: 0.5,
            slow: 1.3,
            correlation: 0.71,
            apart: 8.0,
        };
        let fit = SeaFit { order: 8, seen: Some(seen), fallbacks: 0 };
        let told = "of order 8: what it leaves is not white (0.71 after 8 s), its slow part 1.30 of the claimed";
        assert_eq!(fit.to_string(), told);
        let anew = SeaFit { seen: None, fallbacks: 2, ..fit }.to_string();
        assert!(
            anew.contains("too little is seen") && anew.contains("begun anew 2 times"),
            "{anew}"
        );
    }
}
