//! Which frames make one sample.

use insd_base::Time;

use super::bits;
use super::layout::{Field, FrameLayout, What};

/// A frame this much later than the first of its sample belongs to another, s, and in intervals.
const LATE: f64 = 0.05;
const LATE_INTERVALS: f64 = 2.0;
/// Parts of a sample.
const PARTS: usize = What::Fraction as usize + 1;

/// The frames of one sample as far as they have come.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// When the first came.
    pub(super) begun: Time,
    /// Index in the table of the last, and its bytes.
    last: (usize, [u8; 8]),
    /// Needed frames that have come.
    needed: usize,
    told: [Option<f64>; PARTS],
    /// Count of the device's clock.
    pub(super) ticks: Option<u64>,
    /// Number of the sample.
    pub(super) counter: Option<u64>,
    /// Whether the sample is complete, and has gone.
    pub(super) sent: bool,
}

impl Group {
    /// A sample that begins with this frame.
    pub(super) fn new(begun: Time) -> Self {
        Group {
            begun,
            last: (usize::MAX, [0; 8]),
            needed: 0,
            told: [None; PARTS],
            ticks: None,
            counter: None,
            sent: false,
        }
    }

    /// Whether a frame is the last one again, as a sender repeats it that missed its acknowledgement.
    pub(super) fn is_repetition(&self, index: usize, data: &[u8; 8]) -> bool {
        self.last == (index, *data) && (index > 0 || !self.sent)
    }

    /// Whether a frame belongs to this sample.
    pub(super) fn takes(
        &self,
        index: usize,
        frame: &FrameLayout,
        data: &[u8],
        at: Time,
        interval: f64,
    ) -> bool {
        let late = (at - self.begun).as_seconds() > LATE.max(LATE_INTERVALS * interval);
        let other = counter(frame, data).zip(self.counter).is_some_and(|(new, own)| new != own);
        index > self.last.0 && !late && !other
    }

    /// Enters a frame.
    pub(super) fn enter(&mut self, index: usize, frame: &FrameLayout, data: &[u8], all: &[u8; 8]) {
        self.last = (index, *all);
        self.needed += usize::from(frame.is_needed());
        for field in &frame.fields {
            let Some(bits) = bits::get(data, field) else { continue };
            match field.what {
                What::Time => self.ticks = Some(bits),
                What::Counter => self.counter = Some(bits),
                what => self.told[what as usize] = Some(value(data, field, bits)),
            }
        }
    }

    /// Whether nothing is missing of so many needed frames.
    pub(super) fn is_complete(&self, needed: usize) -> bool {
        self.needed == needed
    }

    /// Whether a needed frame has come.
    pub(super) fn is_begun(&self) -> bool {
        self.needed > 0
    }

    /// Parts of the sample; `None` if one was not told.
    pub(super) fn parts<const N: usize>(&self, what: [What; N]) -> Option<[f64; N]> {
        let told = what.map(|own| self.told[own as usize]);
        told.iter().all(Option::is_some).then(|| told.map(Option::unwrap_or_default))
    }
}

fn counter(frame: &FrameLayout, data: &[u8]) -> Option<u64> {
    let field = frame.fields.iter().find(|field| field.what == What::Counter)?;
    bits::get(data, field)
}

/// The value of a field; NaN where it is not available.
fn value(data: &[u8], field: &Field, bits: u64) -> f64 {
    if field.missing == Some(bits) {
        return f64::NAN;
    }
    let exponent = field.exponent.map_or(0.0, |start| f64::from(exponent(data, start)));
    (bits::signed(bits, field) * field.scale + field.offset) * (-exponent).exp2()
}

/// The byte of an exponent.
pub(super) fn exponent(data: &[u8], start: u8) -> u8 {
    bits::get(data, &Field::new(What::Counter, start, 8)).map_or(0, |bits| bits as u8)
}
