//! Numbers that are none: JSON has no NaN and writes null for it.

use serde::{Deserialize as _, Deserializer};

/// A number; NaN for null.
pub(super) fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Option::<f64>::deserialize(from).map(|number| number.unwrap_or(f64::NAN))
}
