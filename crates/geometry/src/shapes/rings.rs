//! Closed surfaces from a row of rings: a tube wall and round caps.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::surface::Surface;

/// A circle of points around a centre.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ring {
    /// Centre.
    pub(crate) center: DVec3,
    /// Two unit axes of the plane; the first cross the second points along the tube.
    pub(crate) axes: [DVec3; 2],
    /// Radius.
    pub(crate) radius: f64,
}

impl Ring {
    fn point(&self, part: f64, radius: f64) -> DVec3 {
        let angle = part * TAU;
        self.center + radius * (angle.cos() * self.axes[0] + angle.sin() * self.axes[1])
    }
}

/// The closed tube through rings of `segments` points each, with a flat cap on the first and the last.
pub(crate) fn tube(rings: &[Ring], segments: usize) -> Surface {
    let mut surface = Surface::default();
    let mut numbers: Vec<Vec<u32>> = Vec::new();
    for ring in rings {
        let places = (0..segments).map(|i| ring.point(i as f64 / segments as f64, ring.radius));
        numbers.push(add_vertices(&mut surface, places));
    }
    for (row, pair) in numbers.windows(2).enumerate() {
        stitch_alternating(&mut surface, &pair[0], &pair[1], row);
    }
    if let ([first, ..], [.., last]) = (rings, rings) {
        let border: Vec<u32> = numbers[0].iter().rev().copied().collect();
        fill_disc(&mut surface, &border, first.center);
        let border = numbers[rings.len() - 1].clone();
        fill_disc(&mut surface, &border, last.center);
    }
    surface
}

/// Appends vertices; returns their numbers.
pub(crate) fn add_vertices(surface: &mut Surface, places: impl Iterator<Item = DVec3>) -> Vec<u32> {
    let first = surface.vertices.len() as u32;
    surface.vertices.extend(places);
    (first..surface.vertices.len() as u32).collect()
}

/// Triangles between two rings of equally many points, diagonals alternating like a zigzag so that the
/// surface has no handedness. `row` says where the alternation starts.
pub(crate) fn stitch_alternating(surface: &mut Surface, low: &[u32], high: &[u32], row: usize) {
    let n = low.len();
    for i in 0..n {
        let j = (i + 1) % n;
        let (a, b, c, d) = (low[i], low[j], high[j], high[i]);
        if (i + row).is_multiple_of(2) {
            surface.triangles.extend([[a, b, c], [a, c, d]]);
        } else {
            surface.triangles.extend([[a, b, d], [b, c, d]]);
        }
    }
}

/// Fills a flat, convex border with rings of ever fewer points down to the centre: triangles of about the size
/// of the border edges. The border runs counter-clockwise about the outward normal.
pub(crate) fn fill_disc(surface: &mut Surface, border: &[u32], center: DVec3) {
    let mut outer = border.to_vec();
    let mut places: Vec<DVec3> = border.iter().map(|&v| surface.vertices[v as usize] - center).collect();
    // With 6 k points on ring k counted from the centre all edges have about the same length.
    let n_rings = (border.len() as f64 / 6.0).round().max(1.0) as usize;
    for k in (1..n_rings).rev() {
        let count = (border.len() * k).div_ceil(n_rings).max(3);
        let shrunk = resample(&places, count).into_iter().map(|p| center + p * (k as f64 / n_rings as f64));
        let inner = add_vertices(surface, shrunk);
        stitch_by_angle(surface, &outer, &inner);
        places = resample(&places, count);
        outer = inner;
    }
    let middle = add_vertices(surface, std::iter::once(center))[0];
    for i in 0..outer.len() {
        surface.triangles.push([outer[i], outer[(i + 1) % outer.len()], middle]);
    }
}

/// `count` points at equal parts of a closed row of points.
fn resample(points: &[DVec3], count: usize) -> Vec<DVec3> {
    let n = points.len();
    (0..count)
        .map(|i| {
            let at = i as f64 * n as f64 / count as f64;
            let (k, part) = (at as usize % n, at.fract());
            let (a, b) = (points[k], points[(k + 1) % n]);
            // Between two points of a circle the chord lies inside; the length is interpolated instead.
            let chord = a.lerp(b, part);
            chord.normalize_or_zero() * (a.length() * (1.0 - part) + b.length() * part)
        })
        .collect()
}

/// Triangles between two rings of different count, both starting at the same angle.
fn stitch_by_angle(surface: &mut Surface, outer: &[u32], inner: &[u32]) {
    let (n, m) = (outer.len(), inner.len());
    let (mut i, mut j) = (0, 0);
    while i < n || j < m {
        let (a, b) = (outer[i % n], inner[j % m]);
        // Advance on the ring whose next point comes first: (i + 1/2)/n against (j + 1/2)/m.
        if j == m || (i < n && (2 * i + 1) * m <= (2 * j + 1) * n) {
            surface.triangles.push([a, outer[(i + 1) % n], b]);
            i += 1;
        } else {
            surface.triangles.push([a, inner[(j + 1) % m], b]);
            j += 1;
        }
    }
}
