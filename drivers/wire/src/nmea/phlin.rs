//! PHLIN and PHSPD: how far and how fast the waves move a point of the ship, by Octans, Phins and the
//! units that speak like them.
//!
//! ```text
//! $PHLIN,x.xxx,y.yyy,z.zzz*hh   surge, sway, heave, m
//! $PHSPD,x.xxx,y.yyy,z.zzz*hh   their rates, m/s
//! ```
//! Signs: surge forward, sway to **port**, heave **up**.
//!
//! From the makers' manuals (Octans in Reson SeaBat 8101, SBG Systems `nmeaMessages.md`), and the layout
//! verified against records of Phins units. That PHSPD has the signs of PHLIN is taken from their common
//! axes X1, X2, X3 and not verified against a device.

use super::decimal::Form;
use super::fault::Fault;
use super::frame::Frame;
use super::line::Line;
use super::parts::{negated, read_within};

const METRES: Form = Form { decimals: 3, width: 1, limit: 999.999 };

/// Surge, sway and heave.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Phlin {
    /// Surge, m, forward positive.
    pub surge: Option<f64>,
    /// Sway, m, to **starboard** positive; the sentence has it the other way.
    pub sway: Option<f64>,
    /// Heave, m, up positive.
    pub heave: Option<f64>,
}

/// Rates of surge, sway and heave.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Phspd {
    /// Rate of surge, m/s, forward positive.
    pub surge: Option<f64>,
    /// Rate of sway, m/s, to **starboard** positive; the sentence has it the other way.
    pub sway: Option<f64>,
    /// Rate of heave, m/s, up positive.
    pub heave: Option<f64>,
}

impl Phlin {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PHLIN";

    /// Greatest length, bytes with CR LF, for less than 100 m either way.
    pub const LONGEST: usize = 35;

    /// Writes the sentence, to 1 mm.
    #[must_use]
    pub fn write(&self) -> Line {
        write(Self::ADDRESS, [self.surge, self.sway, self.heave])
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let [surge, sway, heave] = read(frame, Self::ADDRESS)?;
        Ok(Phlin { surge, sway, heave })
    }
}

impl Phspd {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PHSPD";

    /// Greatest length, bytes with CR LF, for less than 100 m/s either way.
    pub const LONGEST: usize = 35;

    /// Writes the sentence, to 1 mm/s.
    #[must_use]
    pub fn write(&self) -> Line {
        write(Self::ADDRESS, [self.surge, self.sway, self.heave])
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let [surge, sway, heave] = read(frame, Self::ADDRESS)?;
        Ok(Phspd { surge, sway, heave })
    }
}

fn write(address: &str, [surge, sway, heave]: [Option<f64>; 3]) -> Line {
    Line::compose_own(address, |line| {
        [surge, negated(sway), heave].into_iter().for_each(|value| line.number(value, METRES));
    })
}

fn read(frame: &Frame<'_>, address: &str) -> Result<[Option<f64>; 3], Fault> {
    let mut fields = frame.fields_of_own(address)?;
    let surge = read_within(&mut fields, METRES.limit)?;
    let sway = negated(read_within(&mut fields, METRES.limit)?);
    Ok([surge, sway, read_within(&mut fields, METRES.limit)?])
}
