//! PTNTHTM: heading, pitch and roll, as compasses of True North send them and gpsd takes them.
//!
//! ```text
//! $PTNTHTM,h.hh,a,p.pp,a,r.rr,a,,*hh
//!          1    2 3    4 5    6 78
//! 1 heading, deg true
//! 2 its status: N normal, M and O warning (low, high), L, P, C and V alarm
//! 3 pitch, deg; 4 its status
//! 5 roll, deg; 6 its status
//! 7 magnetic dip, 8 horizontal field: a magnetic compass has them, and we do not
//! ```
//! From the documentation of gpsd, the only reader we know: its releases 3.22 to 3.27 publish heading, pitch and
//! roll of this sentence at once. The signs are not stated; pitch is bow up and roll starboard down, as the
//! same reader hands them on from PASHR and XDR. Not verified against a device, which may send counts in place
//! of degrees.

use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::frame::Frame;
use super::line::{Composer, NmeaLine};
use super::parts::{degrees, heading};

const HEADING: Form = Form { decimals: 2, width: 1, limit: 360.0 };
const PITCH: Form = Form { decimals: 2, width: 1, limit: 90.0 };
const ROLL: Form = Form { decimals: 2, width: 1, limit: 180.0 };

const NORMAL: u8 = b'N';
const WARNING: u8 = b'M';
const ALARM: u8 = b'L';

/// Attitude.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Ptnthtm {
    /// Heading, rad, clockwise from true north.
    pub heading: Option<f64>,
    /// Whether the heading is told with a warning.
    pub is_warned: bool,
    /// Pitch, rad, bow up positive.
    pub pitch: Option<f64>,
    /// Roll, rad, starboard down positive.
    pub roll: Option<f64>,
}

impl Ptnthtm {
    /// All before the first comma.
    pub const ADDRESS: &'static str = "PTNTHTM";

    /// Greatest length, bytes with CR LF.
    pub const LONGEST: usize = 43;

    /// Writes the sentence, to 0.01 deg. What is not known has the status of an alarm.
    #[must_use]
    pub fn write(&self) -> NmeaLine {
        NmeaLine::compose_own(Self::ADDRESS, |line| {
            let good = if self.is_warned { WARNING } else { NORMAL };
            let told = |filled| if filled { good } else { ALARM };
            let filled = line.filled(|line| heading(line, self.heading, HEADING));
            line.letter(told(filled));
            tilt(line, self.pitch, PITCH);
            tilt(line, self.roll, ROLL);
            line.empty();
            line.empty();
        })
    }

    /// Reads the sentence. What has the status of an alarm is not known.
    ///
    /// # Errors
    /// The first [`NmeaFault`] of its fields.
    pub fn read(frame: &Frame<'_>) -> Result<Self, NmeaFault> {
        let mut fields = frame.fields_of_own(Self::ADDRESS)?;
        let (heading, is_warned) = angle(&mut fields, 0.0..=360.0)?;
        let (pitch, _) = angle(&mut fields, -PITCH.limit..=PITCH.limit)?;
        let (roll, _) = angle(&mut fields, -ROLL.limit..=ROLL.limit)?;
        Ok(Ptnthtm { heading, is_warned, pitch, roll })
    }
}

fn tilt(line: &mut Composer, angle: Option<f64>, form: Form) {
    let filled = line.filled(|line| degrees(line, angle, form));
    line.letter(if filled { NORMAL } else { ALARM });
}

/// An angle, rad, unless its status is an alarm, and whether that is a warning.
fn angle(
    fields: &mut Fields<'_>,
    range: std::ops::RangeInclusive<f64>,
) -> Result<(Option<f64>, bool), NmeaFault> {
    let angle = fields.number_in(range)?.map(f64::to_radians);
    let status = fields.letter()?;
    let is_warned = matches!(status, Some(WARNING | b'O'));
    let is_told = is_warned || status == Some(NORMAL);
    Ok((angle.filter(|_| is_told), is_warned && angle.is_some()))
}
