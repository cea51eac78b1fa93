//! What a camera saw, in words and numbers.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use insd_vision::{Eyesight, ImageCounts, ImageQuality, Lost, Tracked};

/// Sums over images.
#[derive(Debug, Default)]
pub(super) struct Summary {
    points: Vec<usize>,
    /// Images that each track was in.
    lengths: BTreeMap<u64, u32>,
    lost: Lost,
    quality: Vec<ImageQuality>,
    doubtful: usize,
}

impl Summary {
    pub(super) fn add(&mut self, tracked: &Tracked) {
        self.points.push(tracked.seen.len());
        self.lengths.extend(tracked.seen.iter().map(|track| (track.id, track.length)));
        let (all, new) = (&mut self.lost, &tracked.lost);
        all.sought += new.sought;
        all.gone += new.gone;
        all.backward += new.backward;
        all.epipolar += new.epipolar;
        all.masked += new.masked;
        self.quality.push(tracked.quality);
        self.doubtful += usize::from(tracked.sight == Eyesight::Doubtful);
    }

    /// A few lines.
    pub(super) fn text(&self, counts: &ImageCounts, dropped: u64) -> String {
        let mut text = images(counts, dropped);
        if self.points.is_empty() {
            return text + "nothing seen\n";
        }
        let longest = self.lengths.values().max().copied().unwrap_or_default();
        let (points, length) = (median(&self.points), self.length());
        let lost = &self.lost;
        let share = |count: usize| 100.0 * count as f64 / lost.sought.max(1) as f64;
        let refused = 100.0 * lost.refused_share();
        // writing into a text does not fail
        let _ = writeln!(
            text,
            "tracks    {points} in an image, in {length} images each (medians over all points), the longest in {longest}"
        );
        let _ = writeln!(
            text,
            "lost      {:.1} % of the points of the image before were not found again, {:.1} % were on water, own ship or each other",
            share(lost.gone),
            share(lost.masked)
        );
        let _ = writeln!(
            text,
            "refused   {refused:.1} % of those found again: {} the way back led elsewhere, {} did not move with the world",
            lost.backward, lost.epipolar
        );
        text + &self.light()
    }

    /// Images that the track of a point is in, median over all points of all images.
    fn length(&self) -> u32 {
        let mut lengths: Vec<u32> = self.lengths.values().copied().collect();
        lengths.sort_unstable();
        let points: u64 = lengths.iter().map(|length| u64::from(*length)).sum();
        let mut before = 0;
        let reaches_half = |length: &u32| {
            before += u64::from(*length);
            2 * before >= points
        };
        lengths.into_iter().find(reaches_half).unwrap_or_default()
    }

    fn light(&self) -> String {
        let of = |measure: fn(&ImageQuality) -> f64| {
            median_of(self.quality.iter().map(measure).collect())
        };
        let count = |is: fn(&ImageQuality) -> bool| {
            self.quality.iter().filter(|quality| is(quality)).count()
        };
        let images = self.quality.len();
        format!(
            "sharpness {:.0} (variance of the Laplacian, median); {} of {images} images blurred\n\
             exposure  mean {:.0}, saturated {:.2} %, black {:.2} % (medians); {} badly exposed, {} by night\n\
             doubtful  {} of {images} images\n",
            of(|quality| quality.sharpness),
            count(ImageQuality::is_blurred),
            of(|quality| quality.mean),
            100.0 * of(|quality| quality.saturated),
            100.0 * of(|quality| quality.black),
            count(ImageQuality::is_badly_exposed),
            count(ImageQuality::is_night),
            self.doubtful,
        )
    }
}

fn images(counts: &ImageCounts, dropped: u64) -> String {
    let mut text = format!("images    {} used", counts.used);
    for (reason, count) in &counts.refused {
        let _ = write!(text, ", {count} {}", reason.text());
    }
    if counts.clock_set_back > 0 {
        let _ = write!(text, ", clock set back {} times", counts.clock_set_back);
    }
    if dropped > 0 {
        let _ = write!(text, ", {dropped} dropped for want of time");
    }
    text + "\n"
}

fn median(values: &[usize]) -> usize {
    let mut sorted = values.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}

fn median_of(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_track_counts_by_its_points() {
        // ten points of ten tracks that were lost at once, and thirty of one that was not
        let lengths = (0..10).map(|id| (id, 1)).chain([(10, 30)]).collect();
        assert_eq!(Summary { lengths, ..Summary::default() }.length(), 30);
    }

    #[test]
    fn nothing_seen_is_told() {
        let text = Summary::default().text(&ImageCounts::default(), 3);
        assert_eq!(text, "images    0 used, 3 dropped for want of time\nnothing seen\n");
    }
}
