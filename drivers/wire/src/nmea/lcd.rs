//! LCD: how strong and how clean the signals of a Loran chain are. Shown and not used.

use super::kinds::Decimal;
use super::table::sentence;

/// A relative number from 0 to 999, as the receiver scales it.
const RELATIVE: Decimal = Decimal::magnitude(0, 999.0).width(3);

sentence! {
    /// Signals of Loran.
    approved Lcd "LCD", longest 64: Default;
    /// Group repetition interval of the chain, s.
    1 interval: Option<f64> = Decimal::magnitude(0, 9999.0).width(4).of(1e-5);
    /// Strength of the master over the noise.
    2 master_snr: Option<f64> = RELATIVE, lenient;
    /// Its envelope against its cycle.
    3 master_ecd: Option<f64> = RELATIVE, lenient;
    /// Strength of the first secondary.
    4 first_snr: Option<f64> = RELATIVE, lenient;
    /// Its envelope.
    5 first_ecd: Option<f64> = RELATIVE, lenient;
    /// Strength of the second.
    6 second_snr: Option<f64> = RELATIVE, lenient;
    /// Its envelope.
    7 second_ecd: Option<f64> = RELATIVE, lenient;
    /// Strength of the third.
    8 third_snr: Option<f64> = RELATIVE, lenient;
    /// Its envelope.
    9 third_ecd: Option<f64> = RELATIVE, lenient;
    /// Strength of the fourth.
    10 fourth_snr: Option<f64> = RELATIVE, lenient;
    /// Its envelope.
    11 fourth_ecd: Option<f64> = RELATIVE, lenient;
    /// Strength of the fifth.
    12 fifth_snr: Option<f64> = RELATIVE, lenient;
    /// Its envelope.
    13 fifth_ecd: Option<f64> = RELATIVE, lenient;
}
