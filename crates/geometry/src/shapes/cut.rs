//! Round ends of a tube, cut flat.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec3;

use crate::surface::Surface;

/// Vertices nearer to the plane than this share of an edge are moved onto it, so that no slivers are left.
const SNAP: f64 = 0.4;
/// How far from its axis a tube is cut, in radii.
const REACH: f64 = 1.5;

/// Where a straight, round tube ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// Centre of the end.
    pub(super) center: DVec3,
    /// Unit vector out of the tube.
    pub(super) along: DVec3,
    /// Radius there.
    pub(super) radius: f64,
}

impl End {
    /// Distance beyond the end, negative within the tube; nothing far from its axis.
    fn beyond(&self, x: DVec3) -> f64 {
        let from = x - self.center;
        let along = from.dot(self.along);
        let aside = (from - along * self.along).length();
        if aside < REACH * self.radius { along } else { f64::NEG_INFINITY }
    }

    /// The point of the border nearest to `x`.
    fn on_border(&self, x: DVec3) -> DVec3 {
        let aside = x - self.center;
        self.center + self.radius * (aside - aside.dot(self.along) * self.along).normalize_or_zero()
    }
}

/// Removes what lies beyond an end of a wall whose edges are about `edge` long; returns the border, counter-clockwise about
/// the axis outwards, its points at equal angles.
///
/// # Panics
/// When the wall has no single border there.
pub(super) fn cut(surface: &mut Surface, end: &End, edge: f64) -> Vec<u32> {
    let mut beyond: Vec<f64> = surface.vertices.iter().map(|&x| end.beyond(x)).collect();
    for (x, d) in surface.vertices.iter_mut().zip(&mut beyond).filter(|(_, d)| d.abs() < SNAP * edge) {
        (*x, *d) = (end.on_border(*x), 0.0);
    }
    let mut made = BTreeMap::new();
    let mut kept = Vec::with_capacity(surface.triangles.len());
    for triangle in std::mem::take(&mut surface.triangles) {
        let d = triangle.map(|v| beyond[v as usize]);
        if d.iter().all(|&d| d <= 0.0) && d.iter().any(|&d| d < 0.0) {
            kept.push(triangle);
            continue;
        }
        // What is left of the triangle, in order.
        let mut corners: Vec<u32> = Vec::with_capacity(4);
        for k in 0..3 {
            let (a, b) = (k, (k + 1) % 3);
            if d[a] <= 0.0 {
                corners.push(triangle[a]);
            }
            if d[a] * d[b] < 0.0 {
                let key = (triangle[a].min(triangle[b]), triangle[a].max(triangle[b]));
                corners.push(*made.entry(key).or_insert_with(|| {
                    let [x, y] = [triangle[a], triangle[b]].map(|v| surface.vertices[v as usize]);
                    surface.vertices.push(end.on_border(x.lerp(y, d[a] / (d[a] - d[b]))));
                    surface.vertices.len() as u32 - 1
                }));
            }
        }
        if d.iter().any(|&d| d < 0.0) {
            kept.extend((2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]));
        }
    }
    surface.triangles = kept;
    let border = border(surface, end);
    let axis = (surface.vertices[border[0] as usize] - end.center).normalize();
    let side = end.along.cross(axis);
    for (k, &v) in border.iter().enumerate() {
        let (sin, cos) = (TAU * k as f64 / border.len() as f64).sin_cos();
        surface.vertices[v as usize] = end.center + end.radius * (cos * axis + sin * side);
    }
    border
}

/// The open edges at an end as one row of vertices.
fn border(surface: &Surface, end: &End) -> Vec<u32> {
    let mut edges: BTreeMap<(u32, u32), ()> = BTreeMap::new();
    for &[a, b, c] in &surface.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if edges.remove(&(to, from)).is_none() {
                edges.insert((from, to), ());
            }
        }
    }
    // A cap runs along the border against the wall.
    let at_end = |v: u32| end.beyond(surface.vertices[v as usize]).abs() < 1e-9 * end.radius;
    let next: BTreeMap<u32, u32> =
        edges.into_keys().filter(|&(a, b)| at_end(a) && at_end(b)).map(|(from, to)| (to, from)).collect();
    let first = *next.keys().next().expect("the wall reaches its end");
    let mut row = vec![first];
    while let Some(&v) = next.get(&row[row.len() - 1]).filter(|&&v| v != first) {
        row.push(v);
        assert!(row.len() <= next.len(), "the border of an end is no ring");
    }
    assert!(row.len() == next.len(), "an end has more than one border");
    row
}

/// Drops vertices that no triangle has; `rows` are renumbered with them.
pub(super) fn drop_unused(surface: &mut Surface, rows: &mut [Vec<u32>]) {
    let mut number = vec![u32::MAX; surface.vertices.len()];
    let mut vertices = Vec::new();
    for v in surface.triangles.iter_mut().flatten().chain(rows.iter_mut().flatten()) {
        let old = *v as usize;
        if number[old] == u32::MAX {
            number[old] = vertices.len() as u32;
            vertices.push(surface.vertices[old]);
        }
        *v = number[old];
    }
    surface.vertices = vertices;
}
