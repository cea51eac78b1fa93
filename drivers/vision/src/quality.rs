//! What can be told of an image without looking at what it shows: sharpness and exposure.

use crate::image::CameraImage;

/// Measures of one image.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImageQuality {
    /// Variance of the Laplacian (4 neighbours), grey levels squared: small where nothing is sharp.
    pub sharpness: f64,
    /// Share of pixels of 250 and above.
    pub saturated: f64,
    /// Share of pixels of 5 and below.
    pub black: f64,
    /// Mean grey level.
    pub mean: f64,
}

/// A Laplacian of less variance is blur, or a picture of nothing, grey levels squared.
const BLUR: f64 = 15.0;
/// A darker mean is night.
const NIGHT: f64 = 30.0;
/// A larger share of lost pixels is a wrong exposure.
const LOST: f64 = 0.5;

impl ImageQuality {
    /// Of an image whose size is right; images of fewer than 3 x 3 pixels have no sharpness.
    #[must_use]
    pub fn of(image: &CameraImage<'_>) -> Self {
        let [width, height] = image.size.map(|side| side as usize);
        let mut levels = [0_u64; 256];
        for &pixel in image.pixels {
            levels[usize::from(pixel)] += 1;
        }
        let share = |range: std::ops::RangeInclusive<usize>| {
            levels[range].iter().sum::<u64>() as f64 / image.pixels.len().max(1) as f64
        };
        let sum: u64 = levels.iter().zip(0_u64..).map(|(count, level)| count * level).sum();
        ImageQuality {
            sharpness: laplacian_variance(image.pixels, width, height),
            saturated: share(250..=255),
            black: share(0..=5),
            mean: sum as f64 / image.pixels.len().max(1) as f64,
        }
    }

    /// Whether nothing is sharp.
    #[must_use]
    pub fn is_blurred(&self) -> bool {
        self.sharpness < BLUR
    }

    /// Whether it is night.
    #[must_use]
    pub fn is_night(&self) -> bool {
        self.mean < NIGHT
    }

    /// Whether most of the image is lost in white or black.
    #[must_use]
    pub fn is_badly_exposed(&self) -> bool {
        self.saturated.max(self.black) > LOST
    }
}

fn laplacian_variance(pixels: &[u8], width: usize, height: usize) -> f64 {
    if width < 3 || height < 3 || pixels.len() < width * height {
        return 0.0;
    }
    let (mut sum, mut squares) = (0_i64, 0_i64);
    let rows = pixels.chunks_exact(width);
    for ((above, row), below) in rows.clone().zip(rows.clone().skip(1)).zip(rows.skip(2)) {
        // a row's sums fit 32 bits up to 2000 px, which lets them be vectorised; longer ones are cut
        for at in (1..width - 1).step_by(1024) {
            let end = (at + 1024).min(width - 1);
            let (part, part_squares) = row_sums(above, row, below, at, end);
            sum += i64::from(part);
            squares += i64::from(part_squares);
        }
    }
    let count = ((width - 2) * (height - 2)) as f64;
    let mean = sum as f64 / count;
    squares as f64 / count - mean * mean
}

fn row_sums(above: &[u8], row: &[u8], below: &[u8], from: usize, to: usize) -> (i32, i32) {
    let centre = &row[from..to];
    let (left, right) = (&row[from - 1..to - 1], &row[from + 1..to + 1]);
    let (up, down) = (&above[from..to], &below[from..to]);
    let laplacian = |i: usize| {
        i32::from(left[i]) + i32::from(right[i]) + i32::from(up[i]) + i32::from(down[i])
            - 4 * i32::from(centre[i])
    };
    (0..centre.len()).fold((0, 0), |(sum, squares), i| {
        let value = laplacian(i);
        (sum + value, squares + value * value)
    })
}

#[cfg(test)]
mod tests {
    use insd_base::Time;

    use super::*;

    fn of(pixels: &[u8], size: [u32; 2]) -> ImageQuality {
        ImageQuality::of(&CameraImage { time: Time::START, size, pixels })
    }

    #[test]
    fn a_plain_image_is_blurred_and_an_edge_is_not() {
        let plain = vec![100; 64 * 64];
        assert!(of(&plain, [64, 64]).is_blurred());
        let edges: Vec<u8> =
            (0..64 * 64).map(|i| if (i / 4) % 2 == 0 { 50 } else { 200 }).collect();
        assert!(!of(&edges, [64, 64]).is_blurred());
    }

    #[test]
    fn night_and_glare_are_told_apart() {
        let night = of(&[8; 4096], [64, 64]);
        let glare = of(&[255; 4096], [64, 64]);
        assert!(night.is_night() && !night.is_badly_exposed());
        assert!(!glare.is_night() && glare.is_badly_exposed());
    }

    #[test]
    fn the_laplacian_of_one_bright_pixel_is_the_one_of_the_formula() {
        let mut pixels = vec![0; 25];
        pixels[12] = 10;
        // -40 once and 10 four times, of nine
        let mean = 0.0;
        let expected = (1600.0 + 400.0) / 9.0 - mean;
        assert!((of(&pixels, [5, 5]).sharpness - expected).abs() < 1e-9);
    }
}
