//! Spheres onto pixels.

use super::canvas::Picture;
use super::view::View;
use crate::color::viridis;
use glam::DVec3;

/// Samples a pixel in each direction, to smooth edges.
const SAMPLES: usize = 2;
/// Radius of a sphere in spacings: closes the gaps of a lattice without hiding that it is made of particles.
const RADIUS: f64 = 0.78;
/// Direction to the light, from the upper left behind the eye.
const LIGHT: DVec3 = DVec3::new(-0.36, -0.48, 0.8);
/// How much a nearer neighbourhood darkens what lies behind it (eye-dome lighting: Boucheny, thesis, 2009).
const SHADE: f64 = 0.22;

/// A particle as it is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sphere {
    /// Centre \[pixels\], z toward the eye.
    pub(super) center: DVec3,
    /// Place in the colour map, 0 to 1.
    pub(super) value: f64,
}

/// What the eye meets at each sample.
struct Samples {
    width: usize,
    height: usize,
    /// Negative infinity where nothing is.
    depth: Vec<f64>,
    value: Vec<f64>,
    light: Vec<f64>,
}

/// Draws spheres of a radius that follows from `spacing` \[pixels\]. With `peak` the largest value along a line
/// of sight wins, else the nearest sphere.
pub(super) fn draw(view: &View, spheres: &[Sphere], spacing: f64, peak: bool) -> Picture {
    let mut samples = Samples::empty(view.width as usize * SAMPLES, view.height as usize * SAMPLES);
    let radius = (RADIUS * spacing * SAMPLES as f64).max(0.8);
    for sphere in spheres {
        samples.add(sphere.center * SAMPLES as f64, radius, sphere.value, peak);
    }
    if !peak {
        samples.shade(radius);
    }
    samples.to_picture(view.width, view.height)
}

impl Samples {
    fn empty(width: usize, height: usize) -> Self {
        let count = width * height;
        Self {
            width,
            height,
            depth: vec![f64::NEG_INFINITY; count],
            value: vec![0.0; count],
            light: vec![1.0; count],
        }
    }

    fn add(&mut self, center: DVec3, radius: f64, value: f64, peak: bool) {
        let first = |x: f64| (x - radius).floor().max(0.0) as usize;
        let last = |x: f64, limit: usize| ((x + radius).ceil().max(0.0) as usize).min(limit);
        for y in first(center.y)..last(center.y, self.height) {
            for x in first(center.x)..last(center.x, self.width) {
                let (dx, dy) = (x as f64 + 0.5 - center.x, y as f64 + 0.5 - center.y);
                let rest = radius * radius - dx * dx - dy * dy;
                if rest <= 0.0 {
                    continue;
                }
                let place = y * self.width + x;
                let depth = if peak { value } else { center.z + rest.sqrt() };
                if depth > self.depth[place] {
                    let normal = DVec3::new(dx, dy, rest.sqrt()) / radius;
                    self.depth[place] = depth;
                    self.value[place] = value;
                    self.light[place] = if peak { 1.0 } else { 0.72 + 0.28 * normal.dot(LIGHT).max(0.0) };
                }
            }
        }
    }

    /// Darkens what lies deeper than its surroundings.
    fn shade(&mut self, radius: f64) {
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
                self.light[place] * (-SHADE * deeper.sum::<f64>()).exp()
            })
            .collect();
        self.light = shaded;
    }

    fn depth_at(&self, x: i64, y: i64) -> Option<f64> {
        let inside = (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y);
        inside.then(|| self.depth[y as usize * self.width + x as usize])
    }

    fn to_picture(&self, width: u32, height: u32) -> Picture {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View::new(&[DVec3::ZERO, DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.5, 0.5, 0.0)], 0.05, 100, false)
    }

    fn pixel(picture: &Picture, x: u32, y: u32) -> [u8; 4] {
        let start = 4 * (y * picture.width + x) as usize;
        std::array::from_fn(|c| picture.rgba[start + c])
    }

    #[test]
    fn the_nearer_sphere_hides_the_farther_whatever_the_order() {
        let near = Sphere { center: DVec3::new(50.0, 25.0, 40.0), value: 1.0 };
        let far = Sphere { center: DVec3::new(50.0, 25.0, -40.0), value: 0.0 };
        let picture = draw(&view(), &[near, far], 8.0, false);
        assert_eq!(picture, draw(&view(), &[far, near], 8.0, false));
        let [r, g, b, a] = pixel(&picture, 50, 25);
        // The bright end of the map: red and green high, blue low.
        assert!(r > 150 && g > 150 && b < 80 && a == 255, "{r} {g} {b} {a}");
        assert_eq!(pixel(&picture, 5, 5)[3], 0);
    }

    #[test]
    fn the_peak_shows_through() {
        let near = Sphere { center: DVec3::new(50.0, 25.0, 40.0), value: 0.1 };
        let far = Sphere { center: DVec3::new(50.0, 25.0, -40.0), value: 0.9 };
        let picture = draw(&view(), &[near, far], 8.0, true);
        let expected = viridis(0.9).map(|c| c.round() as u8);
        assert_eq!(pixel(&picture, 50, 25)[..3], expected);
    }

    #[test]
    fn spheres_outside_the_picture_do_no_harm() {
        let outside = [-1e9, 1e9].map(|x| Sphere { center: DVec3::new(x, -x, 0.0), value: 0.5 });
        let picture = draw(&view(), &outside, 8.0, false);
        assert!(picture.rgba.iter().all(|&byte| byte == 0));
    }
}
