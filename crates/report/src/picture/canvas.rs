//! Pixels, and their way into a PNG file.

use crate::ReportError;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// An image with transparency.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width \[pixels\].
    pub width: u32,
    /// Height \[pixels\].
    pub height: u32,
    /// Red, green, blue, opacity of each pixel, rows from the top.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// One colour all over.
    pub(super) fn filled(width: u32, height: u32, color: [u8; 4]) -> Self {
        let rgba = std::iter::repeat_n(color, width as usize * height as usize).flatten().collect();
        Self { width, height, rgba }
    }

    /// The image as the content of a PNG file.
    ///
    /// # Errors
    /// [`ReportError::Picture`] when the encoder refuses the size.
    pub fn to_png(&self) -> Result<Vec<u8>, ReportError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(&self.rgba)?;
            writer.finish()
        });
        match written {
            Ok(()) => Ok(bytes),
            Err(error) => Err(ReportError::Picture {
                width: self.width,
                height: self.height,
                message: error.to_string(),
            }),
        }
    }

    /// Lays `color` over a pixel with an opacity from 0 to 1; places outside are ignored.
    pub(super) fn blend(&mut self, x: i64, y: i64, color: [u8; 3], opacity: f64) {
        if x < 0 || y < 0 || x >= i64::from(self.width) || y >= i64::from(self.height) {
            return;
        }
        let start = 4 * (y as usize * self.width as usize + x as usize);
        let below = f64::from(self.rgba[start + 3]) / 255.0;
        let total = opacity + below * (1.0 - opacity);
        if total <= 0.0 {
            return;
        }
        for c in 0..3 {
            let under = f64::from(self.rgba[start + c]) * below * (1.0 - opacity);
            self.rgba[start + c] = ((f64::from(color[c]) * opacity + under) / total).round() as u8;
        }
        self.rgba[start + 3] = (255.0 * total).round() as u8;
    }

    /// Fills the rectangle from (x, y), `width` by `height` pixels.
    pub(super) fn rectangle(&mut self, x: i64, y: i64, width: i64, height: i64, color: [u8; 3]) {
        for (i, j) in (0..height).flat_map(|j| (0..width).map(move |i| (i, j))) {
            self.blend(x + i, y + j, color, 1.0);
        }
    }

    /// Lays another picture over this one with its upper left corner at (x, y).
    pub(super) fn overlay(&mut self, other: &Self, x: i64, y: i64) {
        for (k, pixel) in other.rgba.chunks_exact(4).enumerate() {
            let (i, j) = (k as u32 % other.width, k as u32 / other.width);
            let color = [pixel[0], pixel[1], pixel[2]];
            self.blend(x + i64::from(i), y + i64::from(j), color, f64::from(pixel[3]) / 255.0);
        }
    }

    /// Writes text with its upper left corner at (x, y); returns its width. Letters outside Latin-1 become
    /// question marks.
    pub(super) fn text(&mut self, x: i64, y: i64, text: &str, color: [u8; 3]) -> i64 {
        let mut pen = x;
        for letter in text.chars() {
            let raster = |c| get_raster(c, FontWeight::Regular, RasterHeight::Size32);
            if let Some(glyph) = raster(letter).or_else(|| raster('?')) {
                for (j, row) in glyph.rows().enumerate() {
                    for (i, &ink) in row.iter().enumerate() {
                        self.blend(pen + i as i64, y + j as i64, color, f64::from(ink) / 255.0);
                    }
                }
            }
            pen += LETTER.0;
        }
        pen - x
    }
}

/// Width and height of a letter \[pixels\].
pub(super) const LETTER: (i64, i64) =
    (get_raster_width(FontWeight::Regular, RasterHeight::Size32) as i64, RasterHeight::Size32.val() as i64);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn png_round_trip() {
        let mut picture = Picture::filled(7, 5, [10, 20, 30, 0]);
        picture.blend(3, 2, [200, 100, 50], 1.0);
        picture.blend(-1, 99, [1, 1, 1], 1.0);
        let bytes = picture.to_png().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut read = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut read).unwrap();
        assert!(read == picture.rgba, "pixels differ");
        assert_eq!(read[4 * (2 * 7 + 3)..][..4], [200, 100, 50, 255]);
        assert!(Picture { width: 0, height: 5, rgba: Vec::new() }.to_png().is_err());
    }

    #[test]
    fn half_a_cover_over_white_is_the_mean() {
        let mut picture = Picture::filled(1, 1, [255; 4]);
        picture.blend(0, 0, [0, 100, 255], 0.5);
        assert_eq!(picture.rgba, [128, 178, 255, 255]);
    }

    #[test]
    fn text_leaves_ink_and_advances() {
        let mut picture = Picture::filled(200, 40, [255; 4]);
        assert_eq!(picture.text(4, 4, "0.5 m/s", [0; 3]), 7 * LETTER.0);
        assert!(picture.rgba.chunks_exact(4).filter(|p| p[0] < 100).count() > 100);
    }
}
