//! Tracks as a front end makes them: a point is tracked while it is in view, and is another when it comes again.

use insd_base::ImagePoint;
use nalgebra::{Vector2, Vector3};
use rand_pcg::Pcg64;

use super::quay::Quay;
use super::subject::{Subject, fixed, ship, water};
use super::trouble::{Trouble, anywhere};
use super::view::View;
use crate::random::{Purpose, normal, stream, uniform};
use crate::scenario::Camera;

/// How far off a mismatch is at most, each axis, px.
const MISMATCH: f64 = 40.0;

/// A track.
#[derive(Clone, Copy, Debug)]
struct Tracked {
    id: u64,
    subject: Subject,
}

/// What is tracked.
#[derive(Debug)]
pub(super) struct Tracker<'a> {
    camera: &'a Camera,
    quay: &'a Quay,
    tracked: Vec<Tracked>,
    next: u64,
    /// The last image.
    last: Vec<ImagePoint>,
    /// Where the waves go, from the edge of the quay, rad.
    waves: f64,
    choice: Pcg64,
    pixels: Pcg64,
}

impl<'a> Tracker<'a> {
    /// A tracker before its first image.
    pub(super) fn new(camera: &'a Camera, quay: &'a Quay, seed: u64) -> Self {
        let mut choice = stream(seed, Purpose::CameraTracks);
        let waves = uniform(&mut choice, 0.0, std::f64::consts::TAU);
        let pixels = stream(seed, Purpose::CameraPixels);
        let (tracked, last) = (Vec::new(), Vec::new());
        Tracker { camera, quay, tracked, next: 1, last, waves, choice, pixels }
    }

    /// The points of the next image, at time `t`, s.
    pub(super) fn image(&mut self, t: f64, view: &View, trouble: &Trouble<'_>) -> Vec<ImagePoint> {
        if trouble.is_frozen {
            // what comes after is another scene
            self.tracked.clear();
            return self.last.clone();
        }
        if trouble.is_blinded {
            self.tracked.clear();
            self.last.clear();
            return Vec::new();
        }
        self.lose(t, view, trouble);
        self.find(t, view, trouble);
        let tracked = std::mem::take(&mut self.tracked);
        self.last = tracked.iter().filter_map(|own| self.point(own, t, view, trouble)).collect();
        self.tracked = tracked;
        self.last.clone()
    }

    /// The tracks of points at rest in the last image, and where those are, ECEF, m.
    pub(super) fn at_rest(&self) -> impl Iterator<Item = (u64, Vector3<f64>)> + '_ {
        self.tracked.iter().filter_map(|own| match own.subject {
            Subject::Fixed(number) => Some((own.id, self.quay.axes.ecef(&self.quay.point(number)))),
            _ => None,
        })
    }

    /// Ends the tracks of what has left the view, and of some others.
    fn lose(&mut self, t: f64, view: &View, trouble: &Trouble<'_>) {
        let (quay, rng, interval) = (self.quay, &mut self.choice, 1.0 / self.camera.rate_hz);
        self.tracked.retain(|own| {
            let rate = self.camera.lost_per_s + own.subject.fading();
            let is_kept = uniform(rng, 0.0, 1.0) < (-rate * interval).exp();
            is_kept
                && own.subject.is_there(view, quay, trouble)
                && own.subject.place(t, view, quay, rng).is_some()
        });
    }

    /// Begins as many tracks as there is room for.
    fn find(&mut self, t: f64, view: &View, trouble: &Trouble<'_>) {
        let most = self.camera.tracks as usize;
        let share = |of: f64| (of * most as f64).round() as usize;
        let is = |kind: fn(&Subject) -> bool| move |own: &&Tracked| kind(&own.subject);
        let count = |kind: fn(&Subject) -> bool| self.tracked.iter().filter(is(kind)).count();
        let drops = count(|own| matches!(own, Subject::Drop(_)));
        let on_ship = count(|own| matches!(own, Subject::Ship(_)));
        let rng = &mut self.choice;
        let mut found: Vec<Subject> =
            (drops..share(trouble.drops)).map(|_| Subject::Drop(anywhere(view, rng))).collect();
        found.extend((on_ship..share(trouble.on_ship)).filter_map(|_| ship(t, view, trouble, rng)));
        let room = most.saturating_sub(self.tracked.len() + found.len());
        if trouble.is_noise {
            found.extend((0..room).map(|_| Subject::Noise));
        } else if trouble.is_water {
            found.extend((0..room).filter_map(|_| water(t, view, self.waves, rng)));
        } else if room > 0 {
            found.extend(fixed(room, &taken(&self.tracked), view, self.quay, rng));
        }
        // drops and ships that have come are where something else was tracked
        let crowd = (self.tracked.len() + found.len()).saturating_sub(most);
        self.crowd_out(crowd);
        for subject in found {
            self.tracked.push(Tracked { id: self.next, subject });
            self.next += 1;
        }
    }

    /// Ends the first so many tracks of points of the quay.
    fn crowd_out(&mut self, mut count: usize) {
        self.tracked.retain(|own| {
            let goes = count > 0 && matches!(own.subject, Subject::Fixed(_));
            count -= usize::from(goes);
            !goes
        });
    }

    /// A track's point in the image as it is found, with its noise, or a mismatch.
    fn point(
        &mut self,
        own: &Tracked,
        t: f64,
        view: &View,
        trouble: &Trouble<'_>,
    ) -> Option<ImagePoint> {
        let rng = &mut self.pixels;
        let true_place = own.subject.place(t, view, self.quay, rng)?;
        let blur = if own.subject.is_on_lens() { 1.0 } else { trouble.blur() };
        let std = self.camera.pixel_std * blur;
        let noise = Vector2::new(normal(rng), normal(rng)) * std;
        let is_mismatch = uniform(rng, 0.0, 1.0) < self.camera.mismatched;
        let off =
            Vector2::new(uniform(rng, -MISMATCH, MISMATCH), uniform(rng, -MISMATCH, MISMATCH));
        let at = true_place + if is_mismatch { off } else { noise };
        view.is_within(&at).then_some(ImagePoint { track: own.id, at })
    }
}

/// Numbers of the points of the quay that are tracked, in order.
fn taken(tracked: &[Tracked]) -> Vec<usize> {
    let number = |own: &Tracked| match own.subject {
        Subject::Fixed(number) => Some(number),
        _ => None,
    };
    let mut taken: Vec<usize> = tracked.iter().filter_map(number).collect();
    taken.sort_unstable();
    taken
}
