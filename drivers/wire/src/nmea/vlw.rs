//! VLW: distance run.

use super::kinds::Decimal;
use super::table::sentence;

/// In nautical miles.
const DISTANCE: Decimal = Decimal::magnitude(3, 9_999_999.0).of(1852.0).with(b'N');

sentence! {
    /// Distances run. Those over ground are absent before NMEA 3.0.
    approved Vlw "VLW", longest 63: Default;
    /// Total through the water, m.
    1 water: Option<f64> = DISTANCE, lenient;
    /// Since reset, through the water, m.
    3 water_trip: Option<f64> = DISTANCE, lenient;
    /// Total over ground, m.
    5 ground: Option<f64> = DISTANCE, later lenient;
    /// Since reset, over ground, m.
    7 ground_trip: Option<f64> = DISTANCE, too lenient;
}
