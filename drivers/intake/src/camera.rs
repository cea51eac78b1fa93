//! What the front end of a camera tells, on its way to the navigator: images put together of their sentences, and times of its clock tied to ours.

use insd_base::{ImagePoint, Time, VisualOdometry};
use insd_wire::nmea::{PinsdStep, PinsdTracks, TrackedPoint};
use nalgebra::{UnitQuaternion, Vector2, Vector3};

use crate::clock::{ClockMap, MapChange, Observed};
use crate::event::Refusal;

/// What comes sooner after the one before, ns of the front end's clock, is no image of a camera on a ship: thirty in a second are more than are used.
const SOONEST: i64 = 30_000_000;
/// After so many in a row from the past the clock was set back for good.
const BEHIND: u32 = 20;
/// What the rate of a computer's clock may be off by, ratio.
const DRIFT: f64 = 1e-4;

/// Times of one kind of message, ns of the front end's clock.
#[derive(Clone, Copy, Debug, Default)]
struct Own {
    last: Option<i64>,
    behind: u32,
}

/// An image of which not all may have come.
#[derive(Clone, Debug)]
struct Partial {
    own: i64,
    of: u32,
    heard: u128,
    points: Vec<ImagePoint>,
}

impl Partial {
    fn is_whole(&self) -> bool {
        self.heard.count_ones() == self.of
    }

    fn add(&mut self, told: &PinsdTracks) {
        let bit = 1_u128 << told.part.min(127);
        if self.heard & bit == 0 {
            self.heard |= bit;
            self.points.extend(told.points().iter().map(point));
        }
    }
}

fn point(own: &TrackedPoint) -> ImagePoint {
    ImagePoint { track: u64::from(own.track), at: Vector2::from(own.at) }
}

/// An image that is over.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SeenImage {
    /// When it was taken, if that is known yet.
    pub(crate) time: Option<Time>,
    pub(crate) points: Vec<ImagePoint>,
    /// Whether none of its sentences is missing.
    pub(crate) is_whole: bool,
}

/// The front end of one camera.
#[derive(Clone, Debug)]
pub(crate) struct CameraIntake {
    clock: ClockMap,
    images: Own,
    steps: Own,
    partial: Option<Partial>,
    /// By how much the front end's clock was found to have stepped, and it was not told yet, s.
    stepped: Option<f64>,
}

impl Default for CameraIntake {
    fn default() -> Self {
        CameraIntake {
            clock: ClockMap::new(Observed::Receipts, DRIFT),
            images: Own::default(),
            steps: Own::default(),
            partial: None,
            stepped: None,
        }
    }
}

impl CameraIntake {
    /// Takes a sentence with points; gives the images that are over.
    ///
    /// # Errors
    /// Why it is no part of an image that is news.
    pub(crate) fn part(
        &mut self,
        told: &PinsdTracks,
        received: Time,
    ) -> (Vec<SeenImage>, Result<(), Refusal>) {
        let own = nanoseconds(told.time);
        let mut over = Vec::new();
        if self.partial.as_ref().is_none_or(|partial| partial.own != own) {
            over.extend(self.partial.take().map(|partial| self.finished(partial)));
            if let Err(reason) = self.hear(own, received, |camera| &mut camera.images) {
                return (over, Err(reason));
            }
            let (of, points) = (told.of, Vec::new());
            self.partial = Some(Partial { own, of, heard: 0, points });
        }
        if let Some(partial) = &mut self.partial {
            partial.add(told);
        }
        let whole = self.partial.take_if(|partial| partial.is_whole());
        over.extend(whole.map(|partial| self.finished(partial)));
        (over, Ok(()))
    }

    fn finished(&self, partial: Partial) -> SeenImage {
        let is_whole = partial.is_whole();
        SeenImage { time: self.clock.map(partial.own), points: partial.points, is_whole }
    }

    /// Takes a step.
    ///
    /// # Errors
    /// Why it is none, or no news.
    pub(crate) fn step(
        &mut self,
        told: &PinsdStep,
        received: Time,
    ) -> Result<VisualOdometry, Refusal> {
        let (time, since) = told.time.zip(told.since).ok_or(Refusal::Malformed)?;
        let (own, since) = (nanoseconds(time), nanoseconds(since));
        let map = told.map.ok_or(Refusal::Malformed)?;
        let [turn, way] = [told.turn, told.way].map(three);
        let stds = told.turn_std.zip(told.way_std).filter(|(turn, way)| *turn > 0.0 && *way > 0.0);
        let (rotation_std, translation_std) = stds.ok_or(Refusal::Malformed)?;
        let (turn, translation) = turn.zip(way).ok_or(Refusal::Malformed)?;
        if since >= own {
            return Err(Refusal::Malformed);
        }
        self.hear(own, received, |camera| &mut camera.steps)?;
        let times = self.clock.map(own).zip(self.clock.map(since));
        let (time, since) = times.ok_or(Refusal::NoTime)?;
        let rotation = UnitQuaternion::new(turn);
        Ok(VisualOdometry {
            time,
            since,
            map,
            rotation,
            translation,
            rotation_std,
            translation_std,
        })
    }

    /// By how much the front end's clock has stepped, s, once.
    pub(crate) fn take_step(&mut self) -> Option<f64> {
        self.stepped.take()
    }

    /// Takes note of a time of the front end's clock.
    fn hear(
        &mut self,
        own: i64,
        received: Time,
        of: impl Fn(&mut Self) -> &mut Own,
    ) -> Result<(), Refusal> {
        let times = of(self);
        let passed = times.last.map(|last| own - last);
        match passed {
            Some(0) => return Err(Refusal::Repeated),
            Some(passed) if passed < 0 && times.behind < BEHIND => {
                times.behind += 1;
                return Err(Refusal::TimeDoubted);
            }
            Some(passed) if passed < 0 => {
                self.stepped = Some(passed as f64 * 1e-9);
                self.clock.forget_offset();
                (self.images, self.steps) = (Own::default(), Own::default());
            }
            Some(passed) if passed < SOONEST => return Err(Refusal::TimeDoubted),
            _ => {}
        }
        *of(self) = Own { last: Some(own), behind: 0 };
        if let MapChange::Stepped { by } = self.clock.observe(own, received) {
            self.stepped = Some(by);
        }
        Ok(())
    }
}

fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e3).round() as i64 * 1_000_000
}

fn three(own: [Option<f64>; 3]) -> Option<Vector3<f64>> {
    let [x, y, z] = own;
    Some(Vector3::new(x?, y?, z?))
}
