//! TRK and VO: what the front end of a camera tells, points that it follows or how it moved.
//!
//! Both have times of the front end's own clock. They go through networks and files and not through the lines of the standard, so that they may be longer than its 82 bytes.

use crate::nmea::decimal::Form;
use crate::nmea::fault::NmeaFault;
use crate::nmea::fields::Fields;
use crate::nmea::kinds::{Decimal, Three, Whole};
use crate::nmea::line::Composer;
use crate::nmea::table::sentence;

/// Most points of one sentence.
pub const TRACKED: usize = 6;
/// Most sentences of one image.
pub const TRACK_SENTENCES: u32 = 70;
/// Numbers of tracks are smaller.
pub const TRACK_NUMBERS: u32 = 10_000_000;

const SECONDS: Form = Form { decimals: 3, width: 1, limit: 999_999.999 };
const PIXELS: Form = Form { decimals: 2, width: 1, limit: 99_999.99 };
const OWN_CLOCK: Decimal = Decimal::magnitude(3, 999_999.999);

/// A point in an image: its track, and where it is, px.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct TrackedPoint {
    /// The same number as long as it is seen without a break, below [`TRACK_NUMBERS`].
    pub track: u32,
    /// Right and down, without the distortion of the lens.
    pub at: [f64; 2],
}

/// Some points of an image. All sentences of one image have its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinsdTracks {
    /// When it was taken by the clock of the front end, s.
    pub time: f64,
    /// Which of its sentences, from 1.
    pub part: u32,
    /// Of how many.
    pub of: u32,
    points: [TrackedPoint; TRACKED],
    count: usize,
}

impl PinsdTracks {
    /// The word in the first field.
    pub const NAME: &'static str = "TRK";
    /// Bytes of the longest one.
    pub const LONGEST: usize = 200;

    /// The sentences of an image; it may have no points. What is beyond [`TRACK_SENTENCES`] is left out.
    #[must_use]
    pub fn of_image(time: f64, points: &[TrackedPoint]) -> Vec<PinsdTracks> {
        let most = TRACKED * TRACK_SENTENCES as usize;
        let points = &points[..points.len().min(most)];
        let of = points.len().div_ceil(TRACKED).max(1);
        let part = |index: usize| {
            let from = (TRACKED * index).min(points.len());
            let own = &points[from..points.len().min(from + TRACKED)];
            let mut all = [TrackedPoint::default(); TRACKED];
            all[..own.len()].copy_from_slice(own);
            let [part, of] = [index + 1, of].map(|own| u32::try_from(own).unwrap_or(u32::MAX));
            PinsdTracks { time, part, of, points: all, count: own.len() }
        };
        (0..of).map(part).collect()
    }

    /// Its points.
    #[must_use]
    pub fn points(&self) -> &[TrackedPoint] {
        &self.points[..self.count]
    }

    pub(super) fn write_fields(&self, line: &mut Composer) {
        line.number(Some(self.time), SECONDS);
        line.whole(Some(self.part), 1, TRACK_SENTENCES);
        line.whole(Some(self.of), 1, TRACK_SENTENCES);
        for point in self.points() {
            line.whole(Some(point.track), 1, TRACK_NUMBERS - 1);
            point.at.iter().for_each(|own| line.number(Some(*own), PIXELS));
        }
    }

    /// What has no time or number is none; a sentence that ends within a point is torn.
    pub(super) fn read_fields(fields: &mut Fields<'_>) -> Result<Self, NmeaFault> {
        let time = needed(fields, |own| own.number_in(0.0..=SECONDS.limit))?;
        let part = needed(fields, |own| own.whole(TRACK_SENTENCES))?;
        let of = needed(fields, |own| own.whole(TRACK_SENTENCES))?;
        if part == 0 || part > of {
            return Err(fields.malformed());
        }
        let mut told = PinsdTracks { time, part, of, points: Default::default(), count: 0 };
        while fields.has_more() {
            let track = needed(fields, |own| own.whole(TRACK_NUMBERS - 1))?;
            let mut pixel = || needed(fields, |own| own.number_in(-PIXELS.limit..=PIXELS.limit));
            let at = [pixel()?, pixel()?];
            let Some(place) = told.points.get_mut(told.count) else {
                return Err(fields.malformed());
            };
            *place = TrackedPoint { track, at };
            told.count += 1;
        }
        Ok(told)
    }
}

/// A field that must not be empty.
fn needed<'a, T>(
    fields: &mut Fields<'a>,
    read: impl Fn(&mut Fields<'a>) -> Result<Option<T>, NmeaFault>,
) -> Result<T, NmeaFault> {
    read(fields)?.ok_or_else(|| fields.malformed())
}

sentence! {
    /// How a camera moved from one image to another: `x_since = Exp(turn) x_now + way`, camera axes.
    part PinsdStep "PINSD" "VO", longest 133;
    /// When the later image was taken by the clock of the front end, s.
    1 time: Option<f64> = OWN_CLOCK;
    /// When the earlier one was, s.
    2 since: Option<f64> = OWN_CLOCK;
    /// Another number is another scale, with no link to the one before.
    3 map: Option<u32> = Whole::of(1, 999_999);
    /// Rotation vector that turns from axes of the later image to those of the earlier one, rad.
    4 turn: [Option<f64>; 3] = Three(Decimal::signed(5, 180.0).degrees());
    /// From the earlier to the later, axes of the earlier, in units of the map.
    7 way: [Option<f64>; 3] = Three(Decimal::signed(5, 9_999.999));
    /// 1-sigma of each component of the turn, rad.
    10 turn_std: Option<f64> = Decimal::magnitude(5, 180.0).degrees();
    /// 1-sigma of each component of the way, in units of the map.
    11 way_std: Option<f64> = Decimal::magnitude(5, 9_999.999);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nmea::{Pinsd, Sentence};

    fn image(count: u32) -> Vec<TrackedPoint> {
        (0..count)
            .map(|track| TrackedPoint { track, at: [f64::from(track) + 0.25, -0.5] })
            .collect()
    }

    fn back(told: PinsdTracks) -> PinsdTracks {
        let line = Pinsd::Tracks(told).write();
        let read = Sentence::read(line.as_bytes());
        let Ok((None, Sentence::Pinsd(Pinsd::Tracks(read)))) = read else { panic!("{line:?}") };
        read
    }

    #[test]
    fn an_image_is_told_in_as_many_sentences_as_it_needs_and_one_without_points_in_one() {
        for (count, sentences) in [(0, 1), (6, 1), (7, 2), (200, 34), (9_999, 70)] {
            let told = PinsdTracks::of_image(12.345, &image(count));
            assert_eq!(told.len(), sentences, "{count}");
            let read: Vec<TrackedPoint> =
                told.iter().flat_map(|own| back(*own).points().to_vec()).collect();
            let most = TRACKED * TRACK_SENTENCES as usize;
            assert_eq!(read, image(count)[..most.min(count as usize)]);
            assert!(told.iter().all(|own| back(*own).of as usize == sentences));
        }
    }

    #[test]
    fn the_longest_is_as_long_as_is_stated() {
        let point = TrackedPoint { track: TRACK_NUMBERS - 1, at: [-99_999.99; 2] };
        let all = PinsdTracks::of_image(999_999.999, &[point; TRACKED * 10]);
        let line = Pinsd::Tracks(all[9]).write();
        assert_eq!(line.as_bytes().len(), PinsdTracks::LONGEST, "{line:?}");
        let step = PinsdStep {
            time: Some(999_999.999),
            since: Some(999_999.999),
            map: Some(999_999),
            turn: [Some(-179.12345_f64.to_radians()); 3],
            way: [Some(-9_999.0); 3],
            turn_std: Some(179.0_f64.to_radians()),
            way_std: Some(9_999.0),
        };
        let line = Pinsd::Step(step).write();
        assert_eq!(line.as_bytes().len(), PinsdStep::LONGEST, "{line:?}");
    }

    #[test]
    fn a_sentence_that_ends_within_a_point_or_counts_wrongly_is_malformed() {
        for fields in ["1.0,1,1,5,10.0", "1.0,2,1", "1.0,0,1", "1.0,1,99", ",1,1", "1.0,1,1,5,,2"] {
            let text = format!("PINSD,TRK,{fields}");
            let sum = text.bytes().fold(0, |sum, byte| sum ^ byte);
            assert!(Sentence::read(format!("${text}*{sum:02X}\r\n").as_bytes()).is_err(), "{text}");
        }
    }
}
