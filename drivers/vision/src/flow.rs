//! Where points of one image are in the next: Lucas and Kanade over a pyramid of images (Bouguet 2001), by `kornia-imgproc`.

use kornia_image::{Image, ImageError, ImageSize};
use kornia_imgproc::filter::scharr_spatial_gradient_float;
use kornia_imgproc::optical_flow_pyr_lk::{
    PyrLKParams, PyrLKPrecomputed, calc_optical_flow_pyr_lk_with_precomputed,
};
use kornia_imgproc::pyramid::pyrdown_f32;

use crate::image::CameraImage;

/// A point of an image, px.
pub(crate) type Pixel = [f32; 2];

/// Halvings of the image: a point may jump by some 40 px from where it is looked for.
const HALVINGS: usize = 3;
/// Least gradient in all directions, mean of the squares over the window, of a range of one.
const MIN_EIGENVALUE: f32 = 1e-4;
/// Last step of the iteration, px.
const LAST_STEP: f32 = 0.01;
/// Most steps on each level.
const STEPS: usize = 20;

/// An image, halved some times, with the gradients of each.
pub(crate) struct Pyramid {
    levels: Vec<Image<f32, 1>>,
    across: Vec<Image<f32, 1>>,
    down: Vec<Image<f32, 1>>,
}

impl Pyramid {
    /// Of an image whose size is right.
    pub(crate) fn of(image: &CameraImage<'_>) -> Result<Self, ImageError> {
        let [width, height] = image.size.map(|side| side as usize);
        let grey = image.pixels.iter().map(|&pixel| f32::from(pixel) / 255.0).collect();
        let mut levels = vec![Image::new(ImageSize { width, height }, grey)?];
        for level in 0..HALVINGS {
            let above = &levels[level];
            let (width, height) = (above.width().div_ceil(2), above.height().div_ceil(2));
            let mut half = Image::from_size_val(ImageSize { width, height }, 0.0)?;
            pyrdown_f32(above, &mut half)?;
            levels.push(half);
        }
        let (mut across, mut down) = (Vec::new(), Vec::new());
        for level in &levels {
            let mut x = Image::from_size_val(level.size(), 0.0)?;
            let mut y = x.clone();
            scharr_spatial_gradient_float(level, &mut x, &mut y)?;
            across.push(x);
            down.push(y);
        }
        Ok(Pyramid { levels, across, down })
    }

    /// The lesser eigenvalue of the gradients' products about a point: how surely it is found again in every direction.
    pub(crate) fn texture(&self, x: usize, y: usize) -> f32 {
        const HALF: usize = 4;
        let (width, height) = (self.levels[0].width(), self.levels[0].height());
        if x < HALF || y < HALF || x + HALF >= width || y + HALF >= height {
            return 0.0;
        }
        let (across, down) = (self.across[0].as_slice(), self.down[0].as_slice());
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for row in y - HALF..=y + HALF {
            let span = row * width + x - HALF..=row * width + x + HALF;
            for (gx, gy) in across[span.clone()].iter().zip(&down[span]) {
                xx += gx * gx;
                xy += gx * gy;
                yy += gy * gy;
            }
        }
        let difference: f32 = xx - yy;
        (xx + yy - (difference * difference + 4.0 * xy * xy).sqrt()) / 2.0
    }
}

/// What became of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    pub(crate) at: Pixel,
    /// From where it was to where the way back leads, px.
    pub(crate) error: f32,
}

/// Where points of one image are in another, looked for at `seeds`; the way back begins at `back` of what was found. `None` for one that
/// is nowhere to be found. With them the pyramid of the other image.
pub(crate) fn carry(
    from: Pyramid,
    to: Pyramid,
    points: &[Pixel],
    seeds: &[Pixel],
    back: impl Fn(&Pixel) -> Pixel,
) -> (Vec<Option<Found>>, Pyramid) {
    let forward = PyrLKPrecomputed {
        prev_pyr: from.levels,
        next_pyr: to.levels,
        grad_x_pyr: from.across,
        grad_y_pyr: from.down,
    };
    let there = flow(&forward, points, seeds);
    let backward = PyrLKPrecomputed {
        prev_pyr: forward.next_pyr,
        next_pyr: forward.prev_pyr,
        grad_x_pyr: to.across,
        grad_y_pyr: to.down,
    };
    let arrived: Vec<Pixel> =
        there.iter().zip(seeds).map(|(at, seed)| at.unwrap_or(*seed)).collect();
    let seeds: Vec<Pixel> = arrived.iter().map(back).collect();
    let again = flow(&backward, &arrived, &seeds);
    let found = |i: usize| {
        let (at, back) = (there[i]?, again[i]?);
        let error = (back[0] - points[i][0]).hypot(back[1] - points[i][1]);
        error.is_finite().then_some(Found { at, error })
    };
    let pyramid = Pyramid {
        levels: backward.prev_pyr,
        across: backward.grad_x_pyr,
        down: backward.grad_y_pyr,
    };
    ((0..points.len()).map(found).collect(), pyramid)
}

/// Where points are in the next image.
fn flow(images: &PyrLKPrecomputed, points: &[Pixel], seeds: &[Pixel]) -> Vec<Option<Pixel>> {
    let settings = PyrLKParams {
        max_level: HALVINGS,
        max_iter: STEPS,
        epsilon: LAST_STEP,
        min_eigen_threshold: MIN_EIGENVALUE,
        use_initial_flow: true,
        ..PyrLKParams::default()
    };
    let result = calc_optical_flow_pyr_lk_with_precomputed(images, points, Some(seeds), &settings);
    // it fails for images of different sizes, of which there are none here
    let Ok(result) = result else { return vec![None; points.len()] };
    result
        .next_pts
        .iter()
        .zip(&result.status)
        .map(|(at, status)| (*status == 1).then_some(*at))
        .collect()
}
