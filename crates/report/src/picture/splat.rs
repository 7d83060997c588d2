//! Spheres onto pixels.

use super::canvas::Picture;
use super::samples::{SAMPLES, Samples, brightness};
use super::view::View;
use glam::DVec3;

/// Radius of a sphere in spacings: closes the gaps of a lattice without hiding that it is made of particles.
const RADIUS: f64 = 0.78;

/// How much nearer particles darken those behind them.
const SHADE: f64 = 0.22;

/// A particle as it is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sphere {
    /// Centre \[pixels\], z toward the eye.
    pub(super) center: DVec3,
    /// Place in the colour map, 0 to 1.
    pub(super) value: f64,
}

/// Draws spheres of a radius that follows from `spacing` \[pixels\]. With `peak` the largest value along a line
/// of sight wins, else the nearest sphere.
pub(super) fn draw(view: &View, spheres: &[Sphere], spacing: f64, peak: bool) -> Picture {
    let mut samples = Samples::empty(view);
    let radius = (RADIUS * spacing * SAMPLES as f64).max(0.8);
    for sphere in spheres {
        add(&mut samples, sphere.center * SAMPLES as f64, radius, sphere.value, peak);
    }
    if !peak {
        samples.shade(radius, SHADE);
    }
    samples.to_picture(view.width, view.height)
}

fn add(samples: &mut Samples, center: DVec3, radius: f64, value: f64, peak: bool) {
    let first = |x: f64| (x - radius).floor().max(0.0) as usize;
    let last = |x: f64, limit: usize| ((x + radius).ceil().max(0.0) as usize).min(limit);
    for y in first(center.y)..last(center.y, samples.height) {
        for x in first(center.x)..last(center.x, samples.width) {
            let (dx, dy) = (x as f64 + 0.5 - center.x, y as f64 + 0.5 - center.y);
            let rest = radius * radius - dx * dx - dy * dy;
            if rest <= 0.0 {
                continue;
            }
            if peak {
                samples.put(x, y, value, value, 1.0);
            } else {
                let normal = DVec3::new(dx, dy, rest.sqrt()) / radius;
                samples.put(x, y, center.z + rest.sqrt(), value, brightness(normal));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::viridis;
    use crate::picture::view::Eye;

    fn view() -> View {
        let corners = [DVec3::ZERO, DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.5, 0.5, 0.0)];
        View::new(&corners, 0.05, 100, Eye::Front)
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
