//! What the eye meets at each sample, and how samples become pixels.

use super::canvas::Picture;
use super::view::View;
use crate::color::viridis;
use glam::DVec3;

/// Samples a pixel in each direction, to smooth edges.
pub(super) const SAMPLES: usize = 2;
/// Direction to the light, from the upper left behind the eye.
const LIGHT: DVec3 = DVec3::new(-0.36, -0.48, 0.8);
/// Brightness of a surface by its unit normal to the side of the eye: little less away from the light, as colours have to stay
/// readable.
pub(super) fn brightness(normal: DVec3) -> f64 {
    0.72 + 0.28 * normal.dot(LIGHT).max(0.0)
}

/// What the eye meets at each sample.
pub(super) struct Samples {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Negative infinity where nothing is.
    depth: Vec<f64>,
    value: Vec<f64>,
    light: Vec<f64>,
}

impl Samples {
    /// Nothing, over a whole picture.
    pub(super) fn empty(view: &View) -> Self {
        let (width, height) = (view.width as usize * SAMPLES, view.height as usize * SAMPLES);
        let count = width * height;
        Self {
            width,
            height,
            depth: vec![f64::NEG_INFINITY; count],
            value: vec![0.0; count],
            light: vec![1.0; count],
        }
    }

    /// Puts something at a sample, unless what is there is nearer to the eye.
    pub(super) fn put(&mut self, x: usize, y: usize, depth: f64, value: f64, light: f64) {
        let place = y * self.width + x;
        if depth > self.depth[place] {
            self.depth[place] = depth;
            self.value[place] = value;
            self.light[place] = light;
        }
    }

    /// Darkens what lies deeper than its surroundings within about `radius` samples, by `strength` for each of eight directions
    /// (eye-dome lighting: Boucheny, thesis, 2009).
    pub(super) fn shade(&mut self, radius: f64, strength: f64) {
        let reach = (1.6 * radius).ceil().max(1.0) as i64;
        let around: [(i64, i64); 8] = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)]
            .map(|(i, j)| (i * reach, j * reach));
        let shaded: Vec<f64> = (0..self.depth.len())
            .map(|place| {
                let here = self.depth[place];
                if here == f64::NEG_INFINITY {
                    return 1.0;
                }
                let (x, y) = ((place % self.width) as i64, (place / self.width) as i64);
                let deeper = around.iter().filter_map(|&(i, j)| self.depth_at(x + i, y + j)).map(|near| {
                    // One limb in front of another shades no more than a few particles do.
                    ((near - here) / (4.0 * radius)).clamp(0.0, 1.0)
                });
                self.light[place] * (-strength * deeper.sum::<f64>()).exp()
            })
            .collect();
        self.light = shaded;
    }

    fn depth_at(&self, x: i64, y: i64) -> Option<f64> {
        let inside = (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y);
        inside.then(|| self.depth[y as usize * self.width + x as usize])
    }

    /// Means over the samples of each pixel.
    pub(super) fn to_picture(&self, width: u32, height: u32) -> Picture {
        let mut picture = Picture::filled(width, height, [0; 4]);
        for (k, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
            let (x, y) = (k % width as usize * SAMPLES, k / width as usize * SAMPLES);
            let places = (0..SAMPLES * SAMPLES).map(|s| (y + s / SAMPLES) * self.width + x + s % SAMPLES);
            let (mut sum, mut covered) = ([0.0; 3], 0.0);
            for place in places.filter(|&place| self.depth[place] > f64::NEG_INFINITY) {
                let color = viridis(self.value[place]);
                for c in 0..3 {
                    sum[c] += color[c] * self.light[place];
                }
                covered += 1.0;
            }
            if covered > 0.0 {
                for c in 0..3 {
                    pixel[c] = (sum[c] / covered).round().clamp(0.0, 255.0) as u8;
                }
                pixel[3] = (255.0 * covered / (SAMPLES * SAMPLES) as f64).round() as u8;
            }
        }
        picture
    }
}
