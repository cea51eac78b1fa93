//! The picture that a front end at work writes for those who look on.

use std::path::{Path, PathBuf};

use insd_capture::{CaptureFault, TimedImage};
use insd_vision::{CameraCalibration, Hints, Tracked};

use super::scene::Scene;

/// Time between two pictures, s of the camera.
const APART: f64 = 2.0;

/// Writes a picture now and then, over the one before.
pub(super) struct Album {
    path: PathBuf,
    scene: Scene,
    written: Option<f64>,
}

impl Album {
    /// Pictures at `path`.
    pub(super) fn new(path: &Path) -> Self {
        Album { path: path.to_owned(), scene: Scene::default(), written: None }
    }

    /// Takes in an image, and writes it if the last one is old enough. Whoever reads finds this picture or the one before, whole.
    ///
    /// # Errors
    /// The picture cannot be written.
    pub(super) fn add(
        &mut self,
        camera: &CameraCalibration,
        image: TimedImage,
        tracked: &Tracked,
        hints: &Hints,
    ) -> Result<(), CaptureFault> {
        let now = image.time.as_seconds();
        self.scene.add(image, tracked, hints);
        if self.written.is_some_and(|then| (0.0..APART).contains(&(now - then))) {
            return Ok(());
        }
        self.written = Some(now);
        self.scene.draw(camera).map_or(Ok(()), |sketch| sketch.replace(&self.path))
    }
}
