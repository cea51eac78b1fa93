//! A picture with lines drawn over it.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use crate::fault::CaptureFault;

/// A picture in colours.
#[derive(Clone, Debug)]
pub struct Sketch {
    size: [u32; 2],
    /// Red, green, blue.
    pixels: Vec<[u8; 3]>,
}

impl Sketch {
    /// Upon a grey image of `width * height` bytes; what is missing is black.
    #[must_use]
    pub fn over(size: [u32; 2], grey: &[u8]) -> Self {
        let count = size[0] as usize * size[1] as usize;
        let levels = grey.iter().copied().chain(std::iter::repeat(0));
        Sketch { size, pixels: levels.take(count).map(|level| [level; 3]).collect() }
    }

    /// A straight line between two points, px; what lies outside is left out.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], colour: [u8; 3]) {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let longest = f64::from(self.size[0].max(self.size[1])) * 4.0;
        let steps = dx.abs().max(dy.abs()).ceil();
        if !steps.is_finite() || steps > longest {
            return;
        }
        for step in 0..=steps as u32 {
            let share = f64::from(step) / steps.max(1.0);
            self.dot(from[0] + share * dx, from[1] + share * dy, colour);
        }
    }

    /// A small cross at a point, px.
    pub fn cross(&mut self, at: [f64; 2], colour: [u8; 3]) {
        for [dx, dy] in [[2.0, 0.0], [0.0, 2.0]] {
            self.line([at[0] - dx, at[1] - dy], [at[0] + dx, at[1] + dy], colour);
        }
    }

    fn dot(&mut self, x: f64, y: f64, colour: [u8; 3]) {
        let [width, height] = self.size.map(f64::from);
        let (x, y) = (x.round(), y.round());
        if (0.0..width).contains(&x) && (0.0..height).contains(&y) {
            self.pixels[y as usize * self.size[0] as usize + x as usize] = colour;
        }
    }

    /// Writes a PNG over another one: who reads finds one or the other, whole.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn replace(&self, path: &Path) -> Result<(), CaptureFault> {
        let beside = path.with_extension("part");
        self.write(&beside)?;
        std::fs::rename(&beside, path).map_err(|fault| CaptureFault::io(&path.display(), fault))
    }

    /// Writes a PNG.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), CaptureFault> {
        let file = File::create(path).map_err(|fault| CaptureFault::io(&path.display(), fault))?;
        let mut encoder = png::Encoder::new(BufWriter::new(file), self.size[0], self.size[1]);
        encoder.set_color(png::ColorType::Rgb);
        let bytes = self.pixels.as_flattened();
        encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(bytes))
            .map_err(|fault| CaptureFault::picture(&path.display(), &fault))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image_file::read_image;

    #[test]
    fn a_sketch_is_read_back_as_it_was_drawn() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let mut sketch = Sketch::over([8, 4], &[10; 32]);
        sketch.line([-3.0, 1.0], [20.0, 1.0], [255, 255, 255]);
        sketch.line([0.0, f64::NAN], [1.0, 1.0], [255, 255, 255]);
        sketch.replace(&path).unwrap();
        let read = read_image(&path).unwrap();
        assert_eq!(
            (read.size, &read.pixels[..8], &read.pixels[8..16]),
            ([8, 4], &[10; 8][..], &[255; 8][..])
        );
    }
}
