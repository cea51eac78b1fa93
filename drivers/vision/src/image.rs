//! One image as it comes, and what may be wrong with it.

use std::collections::BTreeMap;

use insd_base::{Span, Time};

/// An image: grey, 8 bits, row by row from the top.
#[derive(Clone, Copy, Debug)]
pub struct CameraImage<'a> {
    /// When it was exposed, as far as the camera's clock is right.
    pub time: Time,
    /// Width and height as it says, px.
    pub size: [u32; 2],
    /// `width * height` bytes.
    pub pixels: &'a [u8],
}

/// Why an image was not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BadImage {
    /// Fewer or more bytes than its size.
    Torn,
    /// Not of the size of the calibration.
    WrongSize,
    /// Its time is that of the image before.
    TimeStoodStill,
    /// Its time is before that of the image before.
    TimeBackwards,
    /// The very pixels of the image before: no camera sees the same twice.
    Repeated,
}

impl BadImage {
    /// In words.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            BadImage::Torn => "torn",
            BadImage::WrongSize => "wrong size",
            BadImage::TimeStoodStill => "time stood still",
            BadImage::TimeBackwards => "time went backwards",
            BadImage::Repeated => "repeated",
        }
    }
}

/// How many images came, and how many were refused for what.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ImageCounts {
    /// Images that were used.
    pub used: u64,
    /// Images that were not, by reason.
    pub refused: BTreeMap<BadImage, u64>,
    /// How often a camera's clock was set back for good, and a new row of images began.
    pub clock_set_back: u64,
}

impl ImageCounts {
    /// Images that were refused for any reason.
    #[must_use]
    pub fn refused_total(&self) -> u64 {
        self.refused.values().sum()
    }
}

/// Looks at images before anything is made of them.
#[derive(Clone, Debug)]
pub(crate) struct Entrance {
    size: [u32; 2],
    last: Option<Time>,
    /// The newest pixels that were let in.
    pixels: Vec<u8>,
    /// Images in a row that came from before the last one.
    in_the_past: u32,
    repeated_since: Option<Time>,
    pub(crate) counts: ImageCounts,
}

/// So many images in a row from the past: the camera's clock was set back, and nobody else is late.
const SET_BACK: u32 = 20;

/// What is to be done with an image that is let in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Entry {
    /// It goes on where the last one was.
    Follows,
    /// It is the first one of a new row.
    Begins,
}

impl Entrance {
    pub(crate) fn new(size: [u32; 2]) -> Self {
        let (pixels, counts) = (Vec::new(), ImageCounts::default());
        Entrance { size, last: None, pixels, in_the_past: 0, repeated_since: None, counts }
    }

    /// Whether an image may go on; counted.
    pub(crate) fn admit(
        &mut self,
        image: &CameraImage<'_>,
        longest_gap: Span,
    ) -> Result<Entry, BadImage> {
        let verdict = self.judge(image, longest_gap);
        match verdict {
            Ok(_) => self.counts.used += 1,
            Err(reason) => *self.counts.refused.entry(reason).or_default() += 1,
        }
        verdict
    }

    /// How long the same pixels have been coming.
    pub(crate) fn frozen_for(&self, now: Time) -> Span {
        self.repeated_since.map_or(Span::ZERO, |since| now - since)
    }

    fn judge(&mut self, image: &CameraImage<'_>, longest_gap: Span) -> Result<Entry, BadImage> {
        if image.size != self.size {
            return Err(BadImage::WrongSize);
        }
        if image.pixels.len() as u64 != u64::from(image.size[0]) * u64::from(image.size[1]) {
            return Err(BadImage::Torn);
        }
        let entry = self.place(image.time, longest_gap)?;
        if self.last.is_some() && self.pixels == image.pixels {
            self.repeated_since = self.repeated_since.or(self.last);
            return Err(BadImage::Repeated);
        }
        self.repeated_since = None;
        self.last = Some(image.time);
        self.pixels.clear();
        self.pixels.extend_from_slice(image.pixels);
        Ok(entry)
    }

    fn place(&mut self, time: Time, longest_gap: Span) -> Result<Entry, BadImage> {
        let Some(last) = self.last else { return Ok(Entry::Begins) };
        if time <= last {
            self.in_the_past += 1;
            if self.in_the_past < SET_BACK || time == last {
                return Err(if time == last {
                    BadImage::TimeStoodStill
                } else {
                    BadImage::TimeBackwards
                });
            }
            self.counts.clock_set_back += 1;
        }
        let follows = self.in_the_past < SET_BACK && time - last <= longest_gap;
        self.in_the_past = 0;
        Ok(if follows { Entry::Follows } else { Entry::Begins })
    }
}
