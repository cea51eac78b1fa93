//! The digits of PASHR from what they mean: the other direction of [`Pashr::quality`] and
//! [`Pashr::status`].
//!
//! A dialect that cannot say something says less, never more. Read back with the same dialect a digit
//! means the same, or less.

use insd_base::{FixQuality, Mode};

use super::pashr::{Pashr, PashrDialect, PashrStatus};

impl Pashr {
    /// Sets the digit of the quality from the fix of the receiver and what the navigation does with it.
    /// A fix that is not in use aids nothing. Simulated and manual positions have no digit in any dialect,
    /// and dead reckoning one in Trimble's alone; elsewhere they count as none.
    pub fn set_quality(&mut self, fix: FixQuality, mode: Mode, dialect: PashrDialect) {
        self.quality_digit = Some(quality_digit(in_use(fix, mode), dialect));
    }

    /// Sets the digit of the status; none where the dialect states no meaning.
    pub fn set_status(&mut self, status: PashrStatus, dialect: PashrDialect) {
        self.status_digit = status_digit(status, dialect);
    }
}

impl PashrStatus {
    /// The status of a unit that does this: full only with GNSS.
    #[must_use]
    pub fn of(mode: Mode) -> Self {
        match mode {
            Mode::CoarseAlignment => PashrStatus::Levelling,
            Mode::FineAlignment | Mode::InMotionAlignment => PashrStatus::Degraded,
            Mode::DeadReckoning | Mode::Inertial => PashrStatus::Degraded,
            Mode::Aided => PashrStatus::Full,
            Mode::Standby | Mode::Fault => PashrStatus::Error,
        }
    }
}

/// The quality of the fix that aids the attitude.
fn in_use(fix: FixQuality, mode: Mode) -> FixQuality {
    match mode {
        Mode::Standby | Mode::Fault => FixQuality::Invalid,
        Mode::DeadReckoning | Mode::Inertial => FixQuality::Estimated,
        _ => fix,
    }
}

fn quality_digit(quality: FixQuality, dialect: PashrDialect) -> u8 {
    let measured = quality.is_measured() && quality != FixQuality::Simulated;
    match dialect {
        PashrDialect::Trimble if measured || quality == FixQuality::Estimated => quality.as_gga(),
        PashrDialect::Trimble => 0,
        PashrDialect::Sbg | PashrDialect::SbgWassp | PashrDialect::Novatel
            if quality == FixQuality::RtkFixed =>
        {
            2
        }
        _ => u8::from(measured),
    }
}

fn status_digit(status: PashrStatus, dialect: PashrDialect) -> Option<u8> {
    match (dialect, status) {
        (PashrDialect::Novatel, _) | (PashrDialect::Trimble, PashrStatus::Good) => None,
        (PashrDialect::Trimble, PashrStatus::GnssOnly | PashrStatus::Error) => Some(0),
        (PashrDialect::Trimble, PashrStatus::Levelling) => Some(1),
        (PashrDialect::Trimble, PashrStatus::Degraded) => Some(2),
        (PashrDialect::Trimble, PashrStatus::Aligned) => Some(3),
        (PashrDialect::Trimble, PashrStatus::Full) => Some(4),
        (_, PashrStatus::GnssOnly | PashrStatus::Error) => Some(1),
        _ => Some(0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIALECTS: [PashrDialect; 6] = [
        PashrDialect::Sbg,
        PashrDialect::SbgWassp,
        PashrDialect::Ixblue,
        PashrDialect::Novatel,
        PashrDialect::Trimble,
        PashrDialect::Applanix,
    ];

    /// What a reader understands of a quality that was set.
    fn told(fix: FixQuality, mode: Mode, dialect: PashrDialect) -> Option<FixQuality> {
        let mut pashr = Pashr::default();
        pashr.set_quality(fix, mode, dialect);
        pashr.quality(dialect)
    }

    #[test]
    fn what_every_digit_means_is_written_as_that_digit_or_one_of_the_same_meaning() {
        for dialect in DIALECTS {
            for digit in 0..=9 {
                let read = Pashr { quality_digit: Some(digit), ..Pashr::default() };
                let Some(meant) = read.quality(dialect) else { continue };
                assert_eq!(told(meant, Mode::Aided, dialect), Some(meant), "{dialect:?} {digit}");
            }
        }
    }

    #[test]
    fn what_every_status_digit_means_is_written_as_that_digit() {
        for dialect in DIALECTS {
            for digit in 0..=9 {
                let read = Pashr { status_digit: Some(digit), ..Pashr::default() };
                let Some(meant) = read.status(dialect) else { continue };
                let mut written = Pashr::default();
                written.set_status(meant, dialect);
                assert_eq!(written.status_digit, Some(digit), "{dialect:?}");
            }
        }
    }

    #[test]
    fn no_dialect_says_more_of_a_fix_than_is_true() {
        for dialect in DIALECTS {
            for digit in 0..=8 {
                let fix = FixQuality::from_gga(digit).unwrap();
                let read = told(fix, Mode::Aided, dialect).unwrap();
                let real = fix.is_measured() && fix != FixQuality::Simulated;
                assert_eq!(read.is_measured(), real, "{dialect:?} {fix:?}");
                assert!(read != FixQuality::RtkFixed || fix == FixQuality::RtkFixed);
            }
        }
    }

    #[test]
    fn a_fix_that_is_not_used_is_none_and_trimble_says_dead_reckoning() {
        for mode in [Mode::DeadReckoning, Mode::Inertial, Mode::Fault] {
            for dialect in DIALECTS {
                let dead_reckoning = dialect == PashrDialect::Trimble && mode != Mode::Fault;
                let expected =
                    if dead_reckoning { FixQuality::Estimated } else { FixQuality::Invalid };
                assert_eq!(told(FixQuality::RtkFixed, mode, dialect), Some(expected), "{mode:?}");
            }
        }
    }

    #[test]
    fn a_faulty_unit_is_never_good_and_one_that_levels_is_not_full() {
        for dialect in DIALECTS {
            let mut pashr = Pashr::default();
            pashr.set_status(PashrStatus::of(Mode::Fault), dialect);
            let bad = [None, Some(PashrStatus::Error), Some(PashrStatus::GnssOnly)];
            assert!(bad.contains(&pashr.status(dialect)), "{dialect:?}");
            pashr.set_status(PashrStatus::of(Mode::CoarseAlignment), dialect);
            assert_ne!(pashr.status(dialect), Some(PashrStatus::Full), "{dialect:?}");
        }
    }
}
