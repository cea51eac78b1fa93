//! Pictures in files: PNG of any kind, and PGM (`P5`, 8 bits), to grey.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use png::{ColorType, Transformations};

use crate::fault::CaptureFault;

/// A grey picture, 8 bits, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GreyImage {
    /// Width and height, px.
    pub size: [u32; 2],
    /// `width * height` bytes.
    pub pixels: Vec<u8>,
}

/// The longest side of a picture that is read, px.
const LONGEST: u32 = 16_384;

/// Reads a picture; colours become their luminance (ITU-R BT.601).
///
/// # Errors
/// The file cannot be read or is no picture.
pub fn read_image(path: &Path) -> Result<GreyImage, CaptureFault> {
    let is_pgm = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("pgm"));
    if is_pgm {
        let bytes =
            std::fs::read(path).map_err(|fault| CaptureFault::io(&path.display(), fault))?;
        return pgm(&bytes).ok_or_else(|| {
            CaptureFault::picture(&path.display(), &"no PGM of kind P5 with 8 bits")
        });
    }
    let file = File::open(path).map_err(|fault| CaptureFault::io(&path.display(), fault))?;
    png(file).map_err(|reason| CaptureFault::picture(&path.display(), &reason))
}

fn png(file: File) -> Result<GreyImage, String> {
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|fault| fault.to_string())?;
    let (width, height) = (reader.info().width, reader.info().height);
    if width.max(height) > LONGEST {
        return Err(format!("{width} x {height} px: larger than {LONGEST}"));
    }
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("too large")?];
    let info = reader.next_frame(&mut bytes).map_err(|fault| fault.to_string())?;
    bytes.truncate(info.buffer_size());
    let channels = match info.color_type {
        ColorType::Grayscale => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb => 3,
        ColorType::Rgba => 4,
        ColorType::Indexed => return Err("colours by a table".to_owned()),
    };
    let pixels = bytes.chunks_exact(channels).map(grey).collect();
    Ok(GreyImage { size: [width, height], pixels })
}

fn grey(pixel: &[u8]) -> u8 {
    match pixel {
        [red, green, blue, ..] => {
            let sum = 299 * u32::from(*red) + 587 * u32::from(*green) + 114 * u32::from(*blue);
            ((sum + 500) / 1000) as u8
        }
        [grey, ..] => *grey,
        [] => 0,
    }
}

/// `P5 width height 255` and one white space, with comments from `#` to the end of a line; then the pixels.
fn pgm(bytes: &[u8]) -> Option<GreyImage> {
    let mut rest = bytes.strip_prefix(b"P5")?;
    let mut fields = [0_u32; 3];
    for field in &mut fields {
        loop {
            match rest.first()? {
                b'#' => rest = &rest[rest.iter().position(|byte| *byte == b'\n')?..],
                byte if byte.is_ascii_whitespace() => rest = &rest[1..],
                _ => break,
            }
        }
        let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        *field = std::str::from_utf8(&rest[..digits]).ok()?.parse().ok()?;
        rest = &rest[digits..];
    }
    let [width, height, most] = fields;
    if width.max(height) > LONGEST || most != 255 || !rest.first()?.is_ascii_whitespace() {
        return None;
    }
    let count = width as usize * height as usize;
    Some(GreyImage { size: [width, height], pixels: rest[1..].get(..count)?.to_vec() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pgm_with_a_comment_is_read() {
        let read = pgm(b"P5 # a camera\n3 2\n255\nabcdef").unwrap();
        assert_eq!(read, GreyImage { size: [3, 2], pixels: b"abcdef".to_vec() });
    }

    #[test]
    fn a_pgm_that_is_cut_off_is_none() {
        for length in 0..17 {
            assert_eq!(pgm(&b"P5 3 2 255\nabcdef"[..length.min(16)]), None);
        }
        assert_eq!(pgm(b"P5 3 2 65535\nabcdefabcdef"), None);
    }

    #[test]
    fn colours_become_their_luminance() {
        assert_eq!([grey(&[255, 0, 0]), grey(&[0, 255, 0, 9]), grey(&[7, 255])], [76, 150, 7]);
    }
}
