//! New points to track: corners (FAST, Rosten and Drummond 2006, by `kornia-imgproc`), spread over a grid.

use kornia_image::{Image, ImageError, ImageSize};
use kornia_imgproc::features::fast_detect_rows_u8_serial;

use crate::flow::{Pixel, Pyramid};
use crate::image::CameraImage;

/// How an image is cut into cells, and how many points each may have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) rows: usize,
    pub(crate) columns: usize,
    pub(crate) per_cell: usize,
    /// Least distance between two points, px.
    pub(crate) spacing: f32,
    /// Contrast of a corner to the ring about it, grey levels.
    pub(crate) contrast: u8,
}

/// Pixels in a row of the ring about a corner that are all brighter or all darker.
const ARC: usize = 9;
/// From the edge of the image, px.
const MARGIN: usize = 12;
/// Corners of a cell whose texture is looked at, for each that is wanted.
const CANDIDATES: usize = 8;

impl Grid {
    /// Corners for the cells that have too few of `taken`, the best of each first, where `allows` lets them be.
    pub(crate) fn fill(
        &self,
        image: &CameraImage<'_>,
        pyramid: &Pyramid,
        taken: &[Pixel],
        allows: impl Fn(&Pixel) -> bool,
    ) -> Result<Vec<Pixel>, ImageError> {
        let wanting = self.wanting(image.size, taken);
        let mut cells = self.candidates(image, &wanting)?;
        let mut all: Vec<Pixel> = taken.to_vec();
        for (cell, wants) in wanting.iter().enumerate() {
            let best = rank(&mut cells[cell], wants * CANDIDATES, pyramid);
            let mut new = 0;
            for at in best.into_iter().filter(|at| allows(at)) {
                if new < *wants && self.is_apart(&all, &at) {
                    all.push(at);
                    new += 1;
                }
            }
        }
        Ok(all.split_off(taken.len()))
    }

    /// Whether a point keeps its distance from all others.
    pub(crate) fn is_apart(&self, others: &[Pixel], at: &Pixel) -> bool {
        others.iter().all(|other| (other[0] - at[0]).hypot(other[1] - at[1]) >= self.spacing)
    }

    fn cell(&self, size: [u32; 2], at: [usize; 2]) -> usize {
        let [width, height] = size.map(|side| side as usize);
        let column = (at[0] * self.columns / width).min(self.columns - 1);
        let row = (at[1] * self.rows / height).min(self.rows - 1);
        row * self.columns + column
    }

    /// How many points each cell still wants.
    fn wanting(&self, size: [u32; 2], taken: &[Pixel]) -> Vec<usize> {
        let mut wanting = vec![self.per_cell; self.rows * self.columns];
        for at in taken {
            let cell = self.cell(size, at.map(|x| x.max(0.0) as usize));
            wanting[cell] = wanting[cell].saturating_sub(1);
        }
        wanting
    }

    /// All corners of the cells that want some, with their contrast.
    fn candidates(
        &self,
        image: &CameraImage<'_>,
        wanting: &[usize],
    ) -> Result<Vec<Vec<(Pixel, f32)>>, ImageError> {
        let [width, height] = image.size.map(|side| side as usize);
        let grey = Image::from_size_slice(ImageSize { width, height }, image.pixels)?;
        let mut cells = vec![Vec::new(); wanting.len()];
        for row in 0..self.rows {
            if wanting[row * self.columns..(row + 1) * self.columns].iter().all(|&wants| wants == 0)
            {
                continue;
            }
            let from = (row * height).div_ceil(self.rows).max(MARGIN);
            let to = ((row + 1) * height).div_ceil(self.rows).min(height.saturating_sub(MARGIN));
            let contrast = f32::from(self.contrast) / 255.0;
            let corners =
                fast_detect_rows_u8_serial(&grey, contrast, ARC, MARGIN, from..to.max(from));
            for ([y, x], response) in corners {
                cells[self.cell(image.size, [x, y])].push(([x as f32, y as f32], response));
            }
        }
        Ok(cells)
    }
}

/// The corners of most contrast, ordered by their texture, best first; without those that have none.
fn rank(corners: &mut Vec<(Pixel, f32)>, most: usize, pyramid: &Pyramid) -> Vec<Pixel> {
    corners.sort_by(|a, b| b.1.total_cmp(&a.1));
    corners.truncate(most);
    for (at, score) in corners.iter_mut() {
        *score = pyramid.texture(at[0] as usize, at[1] as usize);
    }
    corners.sort_by(|a, b| b.1.total_cmp(&a.1));
    corners.iter().map(|(at, _)| *at).collect()
}
