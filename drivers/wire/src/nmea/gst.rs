//! GST: what the receiver thinks of its own errors.
//!
//! ```text
//! $GPGST,hhmmss.ss,x.x,x.x,x.x,x.x,x.x,x.x,x.x*hh
//!        1         2   3   4   5   6   7   8
//! 1    UTC of the position
//! 2    root mean square of the range residuals, m
//! 3, 4 1-sigma along the semi-major and the semi-minor axis of the error ellipse, m
//! 5    orientation of the semi-major axis, deg true
//! 6..8 1-sigma of latitude, longitude and altitude, m
//! ```
//! An inertial system has no residuals: its field 2 is empty (sbgECom). The time must be good; any other
//! field that is bad (a negative orientation, for instance) is left out.

use super::civil::TimeOfDay;
use super::decimal::Form;
use super::fault::Fault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Line, Talker};

const SIGMA: Form = Form { decimals: 3, width: 1, limit: 999_999.0 };
const RESIDUAL: Form = Form { decimals: 2, ..SIGMA };

/// Error statistics of a position.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Gst {
    /// UTC of the position.
    pub time: Option<TimeOfDay>,
    /// Root mean square of the range residuals, m.
    pub range_rms: Option<f64>,
    /// 1-sigma along the semi-major axis, m.
    pub major_std: Option<f64>,
    /// 1-sigma along the semi-minor axis, m.
    pub minor_std: Option<f64>,
    /// Orientation of the semi-major axis, rad, clockwise from true north.
    pub orientation: Option<f64>,
    /// 1-sigma of the latitude, m.
    pub latitude_std: Option<f64>,
    /// 1-sigma of the longitude, m.
    pub longitude_std: Option<f64>,
    /// 1-sigma of the altitude, m.
    pub altitude_std: Option<f64>,
}

impl Gst {
    /// The three letters after the talker.
    pub const FORMATTER: &'static str = "GST";

    /// Bytes of the longest sentence with a ship's values, CR LF included.
    pub const LONGEST: usize = 75;

    /// Writes the sentence: time truncated to 0.01 s, sigmas to 1 mm, the residuals to 1 cm, the
    /// orientation to 0.01 deg without zeros at its end.
    #[must_use]
    pub fn write(&self, talker: Talker) -> Line {
        Line::compose(talker, Self::FORMATTER, |line| {
            line.time_of_day(self.time);
            line.magnitude(self.range_rms, RESIDUAL);
            line.magnitude(self.major_std, SIGMA);
            line.magnitude(self.minor_std, SIGMA);
            line.degrees(self.orientation, self.orientation.map_or(0, decimals_of));
            for sigma in [self.latitude_std, self.longitude_std, self.altitude_std] {
                line.magnitude(sigma, SIGMA);
            }
        })
    }

    /// Reads the sentence.
    ///
    /// # Errors
    /// The first [`Fault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, Fault> {
        let mut fields = frame.fields_of(Self::FORMATTER)?;
        let range = 0.0..=SIGMA.limit;
        let sigma = |fields: &mut Fields<'_>| fields.number_in(range.clone());
        Ok(Gst {
            time: fields.time_of_day()?,
            range_rms: fields.optional(sigma)?,
            major_std: fields.optional(sigma)?,
            minor_std: fields.optional(sigma)?,
            orientation: fields.optional(Fields::degrees)?,
            latitude_std: fields.optional(sigma)?,
            longitude_std: fields.optional(sigma)?,
            altitude_std: fields.optional(sigma)?,
        })
    }
}

/// Decimals of degrees, at most 2, that an angle needs to be written to 0.01 deg.
fn decimals_of(angle: f64) -> u8 {
    let hundredths = (angle.to_degrees() * 100.0).round();
    match (hundredths % 100.0 == 0.0, hundredths % 10.0 == 0.0) {
        (true, _) => 0,
        (_, true) => 1,
        _ => 2,
    }
}
