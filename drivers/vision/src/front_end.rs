//! Images in, tracks out.

use insd_base::{CameraFrame, ImagePoint, Span, Time};
use kornia_image::ImageError;
use nalgebra::{Rotation3, Unit, Vector2, Vector3};
use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::corners::Grid;
use crate::flow::{Found, Pixel, Pyramid, carry};
use crate::image::{BadImage, CameraImage, Entrance, Entry, ImageCounts};
use crate::lens::CameraCalibration;
use crate::mask::ImageMask;
use crate::quality::ImageQuality;
use crate::two_view::{RayPair, TwoView};

/// How points are chosen and held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontEndConfig {
    /// Cells of the grid: rows and columns.
    pub grid: [usize; 2],
    /// Points of a cell.
    pub per_cell: usize,
    /// Contrast of a corner, grey levels.
    pub contrast: u8,
    /// Least distance between two points, px.
    pub spacing_px: f64,
    /// Farthest from where it was that the way back may lead, px.
    pub forward_backward_px: f64,
    /// Farthest from its epipolar plane that a point may be, px.
    pub epipolar_px: f64,
    /// After a longer gap between images all points are new.
    pub longest_gap: Span,
    /// Seed of the draws.
    pub seed: u64,
}

impl Default for FrontEndConfig {
    fn default() -> Self {
        FrontEndConfig {
            grid: [5, 8],
            per_cell: 5,
            contrast: 12,
            spacing_px: 8.0,
            forward_backward_px: 0.5,
            epipolar_px: 1.0,
            longest_gap: Span::from_nanos(1_000_000_000),
            seed: 1,
        }
    }
}

/// What is known of the camera from elsewhere when an image comes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hints {
    /// Turns a vector from camera axes at the last image that was used ([`FrontEnd::newest`]) to those now, by the gyros.
    pub rotation: Option<Rotation3<f64>>,
    /// The vertical, downwards, in camera axes.
    pub down: Option<Unit<Vector3<f64>>>,
}

/// Whether the eyes see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eyesight {
    /// They do.
    Sees,
    /// For two seconds there were too few points, or most were refused, or the picture stood still.
    Doubtful,
}

/// What became of the points of the image before, counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lost {
    /// Those that were looked for.
    pub sought: usize,
    /// Not found again, or out of the image.
    pub gone: usize,
    /// The way back led elsewhere.
    pub backward: usize,
    /// Did not move with the world.
    pub epipolar: usize,
    /// On water or the own ship, or upon another point.
    pub masked: usize,
}

impl Lost {
    /// Share of the points found again that the checks refused.
    #[must_use]
    pub fn refused_share(&self) -> f64 {
        let found = self.sought - self.gone;
        (self.backward + self.epipolar) as f64 / found.max(1) as f64
    }

    fn kept(&self) -> usize {
        self.sought - self.gone - self.backward - self.epipolar - self.masked
    }
}

/// A point that is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenTrack {
    /// Its number.
    pub id: u64,
    /// Where it is seen, with the lens' distortion, px.
    pub at: [f32; 2],
    /// Images that it is in so far.
    pub length: u32,
}

/// What was made of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracked {
    /// Its points, undistorted; none while the camera is doubtful.
    pub frame: CameraFrame,
    /// The same as seen in the image, doubtful or not.
    pub seen: Vec<SeenTrack>,
    /// What became of those of the image before.
    pub lost: Lost,
    /// Sharpness and exposure.
    pub quality: ImageQuality,
    /// Whether the camera is believed.
    pub sight: Eyesight,
}

/// Fewer points that go on, and the camera is doubtful.
const FEWEST: usize = 15;
/// A larger share of refused points, and it is doubtful.
const REFUSED: f64 = 0.5;
/// After so long.
const PATIENCE: f64 = 2.0;
/// A smaller image cannot be halved as often as it has to be, px.
const SMALLEST: u32 = 64;

/// Follows points from image to image.
pub struct FrontEnd {
    camera: CameraCalibration,
    config: FrontEndConfig,
    /// Where points may be.
    pub mask: ImageMask,
    entrance: Entrance,
    before: Option<Pyramid>,
    tracks: Vec<SeenTrack>,
    next_id: u64,
    motion: TwoView,
    newest: Option<Time>,
    doubtful_since: Option<Time>,
    rng: Pcg64,
}

impl FrontEnd {
    /// For a camera; `None` if its images are smaller than 64 px.
    #[must_use]
    pub fn new(camera: CameraCalibration, config: FrontEndConfig) -> Option<Self> {
        let large = camera.size.iter().all(|side| *side >= SMALLEST);
        let has_cells = config.grid.iter().all(|cells| *cells > 0);
        (large && has_cells).then(|| FrontEnd {
            camera,
            config,
            mask: ImageMask::default(),
            entrance: Entrance::new(camera.size),
            before: None,
            tracks: Vec::new(),
            next_id: 0,
            motion: TwoView::ahead(),
            newest: None,
            doubtful_since: None,
            rng: Pcg64::seed_from_u64(config.seed),
        })
    }

    /// When the last image that was used was exposed: the start of the rotation of the next hints.
    #[must_use]
    pub fn newest(&self) -> Option<Time> {
        self.newest
    }

    /// The images so far.
    #[must_use]
    pub fn counts(&self) -> &ImageCounts {
        &self.entrance.counts
    }

    /// How long the very same picture has been coming.
    #[must_use]
    pub fn frozen_for(&self, now: Time) -> Span {
        self.entrance.frozen_for(now)
    }

    /// The motion between the last two images, up to scale, by the points that were kept.
    #[must_use]
    pub fn motion(&self) -> &TwoView {
        &self.motion
    }

    /// Follows the points into an image, and looks for new ones where there are too few.
    ///
    /// # Errors
    /// The image is not usable, and nothing has changed but its count.
    pub fn take(&mut self, image: &CameraImage<'_>, hints: &Hints) -> Result<Tracked, BadImage> {
        let entry = self.entrance.admit(image, self.config.longest_gap)?;
        let quality = ImageQuality::of(image);
        if entry == Entry::Begins {
            self.begin_anew();
        }
        // the size was looked at, so that the pyramid cannot fail
        let pyramid = Pyramid::of(image).map_err(|_| BadImage::WrongSize)?;
        let (lost, pyramid) = self.follow(pyramid, hints);
        let filled = self.replenish(image, &pyramid, hints);
        self.before = Some(pyramid);
        filled.map_err(|_| BadImage::WrongSize)?;
        self.newest = Some(image.time);
        let sight = self.judge(image.time, &lost);
        let points = if sight == Eyesight::Sees { self.points() } else { Vec::new() };
        let frame = CameraFrame { time: image.time, points };
        Ok(Tracked { frame, seen: self.tracks.clone(), lost, quality, sight })
    }

    fn begin_anew(&mut self) {
        self.before = None;
        self.tracks.clear();
        self.motion = TwoView::ahead();
        self.doubtful_since = None;
    }

    /// Carries the tracks on and drops those that fail a check.
    fn follow(&mut self, pyramid: Pyramid, hints: &Hints) -> (Lost, Pyramid) {
        let mut lost = Lost { sought: self.tracks.len(), ..Lost::default() };
        let Some(before) = self.before.take() else { return (lost, pyramid) };
        let from: Vec<Pixel> = self.tracks.iter().map(|track| track.at).collect();
        let turn = hints.rotation.unwrap_or_default();
        let (ahead, back) =
            (|at: &Pixel| self.turned(at, &turn), |at: &Pixel| self.turned(at, &turn.inverse()));
        let seeds: Vec<Pixel> = from.iter().map(ahead).collect();
        let (found, pyramid) = carry(before, pyramid, &from, &seeds, back);
        let there: Vec<Option<Found>> =
            found.into_iter().map(|f| f.filter(|f| self.is_inside(&f.at))).collect();
        let limit = self.config.forward_backward_px as f32;
        let good: Vec<usize> =
            (0..from.len()).filter(|&i| there[i].is_some_and(|f| f.error < limit)).collect();
        lost.gone = there.iter().filter(|f| f.is_none()).count();
        lost.backward = lost.sought - lost.gone - good.len();
        let moved: Vec<(SeenTrack, Pixel)> =
            good.iter().filter_map(|&i| Some((self.tracks[i], there[i]?.at))).collect();
        let follows = self.follows_the_world(&moved, hints.rotation);
        lost.epipolar = follows.iter().filter(|good| !**good).count();
        let kept = moved.iter().zip(&follows).filter(|(_, good)| **good).map(|((track, at), _)| {
            SeenTrack { at: *at, length: track.length.saturating_add(1), ..*track }
        });
        self.tracks = self.allowed(kept.collect(), hints);
        lost.masked = good.len() - lost.epipolar - self.tracks.len();
        (lost, pyramid)
    }

    /// Where a point at infinity goes when the camera turns; where it was if it leaves what the lens shows.
    fn turned(&self, at: &Pixel, rotation: &Rotation3<f64>) -> Pixel {
        let ray = self.camera.ray(&Vector2::new(f64::from(at[0]), f64::from(at[1])));
        let pixel = ray.and_then(|ray| self.camera.pixel(&(rotation * ray)));
        pixel.map_or(*at, |pixel| [pixel.x as f32, pixel.y as f32])
    }

    fn is_inside(&self, at: &Pixel) -> bool {
        let within = |x: f32, side: u32| x >= 1.0 && x < side as f32 - 2.0;
        within(at[0], self.camera.size[0]) && within(at[1], self.camera.size[1])
    }

    /// Which of the points move as points at rest do; the motion that most agree on is kept.
    fn follows_the_world(
        &mut self,
        moved: &[(SeenTrack, Pixel)],
        rotation: Option<Rotation3<f64>>,
    ) -> Vec<bool> {
        let ray = |at: &Pixel| self.camera.ray(&Vector2::new(f64::from(at[0]), f64::from(at[1])));
        let pairs: Vec<Option<RayPair>> = moved
            .iter()
            .map(|(track, at)| Some(RayPair { from: ray(&track.at)?, to: ray(at)? }))
            .collect();
        let known: Vec<RayPair> = pairs.iter().flatten().copied().collect();
        let limit = self.config.epipolar_px / self.camera.focal.mean();
        let rough = match rotation {
            Some(rotation) => TwoView::by_two_points(&known, rotation, limit, &mut self.rng),
            None => TwoView::by_five_points(&known, &self.motion, limit, &mut self.rng),
        };
        // too few to tell anything: nobody bears them out
        let Some(rough) = rough else { return vec![false; moved.len()] };
        let view = rough.refined(&known, limit / 3.0, rotation.is_some()).facing(&known);
        self.motion = view;
        pairs.iter().map(|pair| pair.is_some_and(|pair| view.error(&pair).abs() <= limit)).collect()
    }

    /// Those that are where points may be, the older ones of those that have run into each other.
    fn allowed(&self, mut tracks: Vec<SeenTrack>, hints: &Hints) -> Vec<SeenTrack> {
        tracks.sort_by_key(|track| (std::cmp::Reverse(track.length), track.id));
        let mut kept: Vec<SeenTrack> = Vec::with_capacity(tracks.len());
        let nearest = self.config.spacing_px as f32 / 2.0;
        for track in tracks {
            let apart = |other: &SeenTrack| {
                (other.at[0] - track.at[0]).hypot(other.at[1] - track.at[1]) >= nearest
            };
            if self.allows(&track.at, hints) && kept.iter().all(apart) {
                kept.push(track);
            }
        }
        kept
    }

    fn allows(&self, at: &Pixel, hints: &Hints) -> bool {
        let at = Vector2::new(f64::from(at[0]), f64::from(at[1]));
        self.mask.allows(&self.camera, hints.down.as_ref(), &at)
    }

    fn replenish(
        &mut self,
        image: &CameraImage<'_>,
        pyramid: &Pyramid,
        hints: &Hints,
    ) -> Result<(), ImageError> {
        let FrontEndConfig { grid: [rows, columns], per_cell, contrast, spacing_px, .. } =
            self.config;
        let grid = Grid { rows, columns, per_cell, spacing: spacing_px as f32, contrast };
        let taken: Vec<Pixel> = self.tracks.iter().map(|track| track.at).collect();
        let new = grid.fill(image, pyramid, &taken, |at| self.allows(at, hints))?;
        let room = (rows * columns * per_cell).saturating_sub(taken.len());
        for at in new.into_iter().take(room) {
            self.tracks.push(SeenTrack { id: self.next_id, at, length: 1 });
            self.next_id += 1;
        }
        Ok(())
    }

    fn judge(&mut self, now: Time, lost: &Lost) -> Eyesight {
        let poor = lost.kept() < FEWEST || lost.refused_share() > REFUSED;
        if !poor {
            self.doubtful_since = None;
            return Eyesight::Sees;
        }
        let since = *self.doubtful_since.get_or_insert(now);
        if (now - since).as_seconds() < PATIENCE { Eyesight::Sees } else { Eyesight::Doubtful }
    }

    fn points(&self) -> Vec<ImagePoint> {
        let point = |track: &SeenTrack| {
            let seen = Vector2::new(f64::from(track.at[0]), f64::from(track.at[1]));
            Some(ImagePoint { track: track.id, at: self.camera.undistort(&seen)? })
        };
        self.tracks.iter().filter_map(point).collect()
    }
}
