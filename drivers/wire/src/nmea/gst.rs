//! GST: what the receiver thinks of its own errors.

use super::civil::TimeOfDay;
use super::kinds::{Clock, Decimal, Turn};
use super::table::sentence;

const SIGMA: Decimal = Decimal::magnitude(3, 999_999.0);

sentence! {
    /// Error statistics of a position.
    ///
    /// An inertial system has no residuals: its field 2 is empty (sbgECom). The time must be good; any other
    /// field that is bad (a negative orientation, for instance) is left out.
    approved Gst "GST", longest 75: Default;
    /// UTC of the position.
    1 time: Option<TimeOfDay> = Clock(2);
    /// Root mean square of the range residuals, m.
    2 range_rms: Option<f64> = Decimal::magnitude(2, 999_999.0), lenient;
    /// 1-sigma along the semi-major axis of the error ellipse, m.
    3 major_std: Option<f64> = SIGMA, lenient;
    /// 1-sigma along the semi-minor axis, m.
    4 minor_std: Option<f64> = SIGMA, lenient;
    /// Orientation of the semi-major axis, rad, clockwise from true north.
    5 orientation: Option<f64> = Turn::of(2).short(), lenient;
    /// 1-sigma of the latitude, m.
    6 latitude_std: Option<f64> = SIGMA, lenient;
    /// 1-sigma of the longitude, m.
    7 longitude_std: Option<f64> = SIGMA, lenient;
    /// 1-sigma of the altitude, m.
    8 altitude_std: Option<f64> = SIGMA, lenient;
}
