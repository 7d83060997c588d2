//! Straight and bent pipes.

use std::f64::consts::TAU;

use glam::DVec3;

use super::rings::{Ring, tube};
use crate::surface::Surface;

/// Fewest points around a pipe.
const MIN_SEGMENTS: usize = 6;

/// A straight pipe from the origin along `axis`, closed by flat caps, in the unit of `radius` and `length`.
///
/// It has `segments` points around, at least 6, on circles of the given radius: the section is a regular
/// polygon inside the circle, so volume and area approach the circular ones from below, as
/// sin(2 pi/n)/(2 pi/n) and sin(pi/n)/(pi/n). An `axis` without length counts as +z.
pub fn pipe(radius: f64, length: f64, axis: DVec3, segments: usize) -> Surface {
    let segments = segments.max(MIN_SEGMENTS);
    let along = axis.try_normalize().unwrap_or(DVec3::Z);
    let first = along.any_orthonormal_vector();
    let axes = [first, along.cross(first)];
    let rows = rows(length, radius, segments);
    let rings: Vec<Ring> =
        (0..=rows).map(|i| Ring { center: length * i as f64 / rows as f64 * along, axes, radius }).collect();
    tube(&rings, segments)
}

/// A pipe bent to an arc in the x-z plane, closed by flat caps.
///
/// It starts at the origin along +z and turns towards +x by `angle` \[rad\] on a circle of `bend_radius`, which
/// must exceed `radius`. Lengths come out in the unit they are given in. By Pappus the volume is that of a
/// straight pipe of length `bend_radius * angle`.
pub fn bent_pipe(radius: f64, bend_radius: f64, angle: f64, segments: usize) -> Surface {
    let segments = segments.max(MIN_SEGMENTS);
    let rows = rows((bend_radius + radius) * angle, radius, segments);
    let rings: Vec<Ring> = (0..=rows)
        .map(|i| {
            let turned = angle * i as f64 / rows as f64;
            let outward = DVec3::new(-turned.cos(), 0.0, turned.sin());
            let along = DVec3::new(turned.sin(), 0.0, turned.cos());
            Ring { center: bend_radius * (DVec3::X + outward), axes: [outward, along.cross(outward)], radius }
        })
        .collect();
    tube(&rings, segments)
}

/// Rows of triangles along a wall so that they are about as long as wide.
fn rows(length: f64, radius: f64, segments: usize) -> usize {
    (length / (TAU * radius / segments as f64)).round().max(1.0) as usize
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::repair::edges::Edges;

    /// Area of the unit circle's inscribed polygon over that of the circle, and the same for lengths.
    fn polygon_factors(segments: usize) -> (f64, f64) {
        let n = segments as f64;
        ((TAU / n).sin() / (TAU / n), (PI / n).sin() / (PI / n))
    }

    #[test]
    fn pipe_has_the_volume_and_area_of_its_polygon() {
        let (r, l, n) = (0.003, 0.04, 48);
        for axis in [DVec3::Z, DVec3::new(0.3, -0.8, 0.5), DVec3::ZERO] {
            let s = pipe(r, l, axis, n);
            let (area, length) = polygon_factors(n);
            assert!(Edges::new(&s.triangles).is_closed_and_oriented());
            assert!((s.volume() / (PI * r * r * l * area) - 1.0).abs() < 1e-12);
            assert!((s.area() / (TAU * r * l * length + TAU * r * r * area) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn bent_pipe_obeys_pappus() {
        let s = bent_pipe(0.004, 0.025, PI, 96);
        assert!(Edges::new(&s.triangles).is_closed_and_oriented());
        let straight = PI * 0.004f64.powi(2) * 0.025 * PI;
        assert!((s.volume() / straight - 1.0).abs() < 2e-3, "{}", s.volume() / straight);
        let (low, high) = s.bounds();
        assert!((high.x - 0.054).abs() < 1e-6 && low.z.abs() < 1e-12);
    }

    #[test]
    fn triangles_are_well_shaped() {
        let s = pipe(1.0, 5.0, DVec3::Z, 40);
        for t in 0..s.triangles.len() {
            let [a, b, c] = s.triangle(t);
            let edges = [a.distance(b), b.distance(c), c.distance(a)];
            let longest = edges.into_iter().fold(0.0, f64::max);
            // 1 for equilateral triangles.
            let quality = 4.0 / 3f64.sqrt() * s.triangle_area(t) / longest.powi(2);
            assert!(quality > 0.4, "triangle {t} has quality {quality}");
        }
    }
}
