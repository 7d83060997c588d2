//! Triangulation of a polygon by ear clipping.

use std::collections::BTreeSet;

use crate::polygon::{Point, cross, dot, sub};

/// Triangles of a counter-clockwise polygon by ear clipping, the ear with the shortest cut first.
///
/// A simple polygon of `n` vertices gives `n - 2` triangles. Where the polygon crosses itself no ear may be
/// left; then the shortest cut is taken all the same, so that the border is closed in any case.
///
/// The time grows with `n` log `n` and the product of `n` and the number of vertices with a turn to the right.
pub(crate) fn triangulate(polygon: &[Point]) -> Vec<[usize; 3]> {
    let n = polygon.len();
    let mut triangles = Vec::with_capacity(n.saturating_sub(2));
    if n < 3 {
        return triangles;
    }
    let mut clipper = Clipper::new(polygon);
    for _ in 3..n {
        let best = clipper.best();
        triangles.push(clipper.corners(best));
        clipper.cut_off(best);
    }
    let last = clipper.by_cut.iter().map(|&(_, v)| v).min().expect("three vertices are left");
    let [before, last, after] = clipper.corners(last);
    triangles.push([last, after, before]);
    triangles
}

/// A polygon that is being clipped.
struct Clipper<'a> {
    polygon: &'a [Point],
    /// Neighbours of each vertex among those left.
    before: Vec<usize>,
    after: Vec<usize>,
    left: Vec<bool>,
    /// All vertices left, by the squared length of their cut. Such lengths sort like the bits they are made of.
    by_cut: BTreeSet<(u64, usize)>,
    /// Those that may be ears: they turn to the left, and nothing is known to lie in their triangle.
    candidates: BTreeSet<(u64, usize)>,
    /// Vertices that turn to the right or did so: only they can lie in an ear.
    reflex: Vec<usize>,
    /// How many of `reflex` are known not to lie in the triangle of each vertex.
    seen: Vec<usize>,
    /// The vertices in whose triangle each vertex lies; they are candidates again when it no longer can.
    waiting: Vec<Vec<usize>>,
}

impl<'a> Clipper<'a> {
    fn new(polygon: &'a [Point]) -> Clipper<'a> {
        let n = polygon.len();
        let mut clipper = Clipper {
            polygon,
            before: (0..n).map(|v| (v + n - 1) % n).collect(),
            after: (0..n).map(|v| (v + 1) % n).collect(),
            left: vec![true; n],
            by_cut: BTreeSet::new(),
            candidates: BTreeSet::new(),
            reflex: Vec::new(),
            seen: vec![0; n],
            waiting: vec![Vec::new(); n],
        };
        clipper.reflex = (0..n).filter(|&v| clipper.is_reflex(v)).collect();
        clipper.by_cut = (0..n).map(|v| clipper.key(v)).collect();
        let convex = (0..n).filter(|&v| !clipper.is_reflex(v));
        clipper.candidates = convex.map(|v| clipper.key(v)).collect();
        clipper
    }

    fn corners(&self, v: usize) -> [usize; 3] {
        [self.before[v], v, self.after[v]]
    }

    fn is_reflex(&self, v: usize) -> bool {
        let [a, b, c] = self.corners(v).map(|v| self.polygon[v]);
        cross(sub(b, a), sub(c, b)) <= 0.0
    }

    /// Sorts by the squared length of the cut, then by number.
    fn key(&self, v: usize) -> (u64, usize) {
        let [a, _, c] = self.corners(v).map(|v| self.polygon[v]);
        (dot(sub(c, a), sub(c, a)).to_bits(), v)
    }

    /// The ear with the shortest cut; without an ear the shortest cut.
    fn best(&mut self) -> usize {
        while let Some(&(_, v)) = self.candidates.first() {
            match self.blocker(v) {
                None => return v,
                Some(blocker) => {
                    self.waiting[blocker].push(v);
                    self.candidates.pop_first();
                }
            }
        }
        self.by_cut.first().expect("more than three vertices are left").1
    }

    /// A vertex that lies in the triangle of `v`.
    fn blocker(&mut self, v: usize) -> Option<usize> {
        while let Some(&other) = self.reflex.get(self.seen[v]) {
            if self.left[other] && self.is_reflex(other) && blocks(self.polygon, self.corners(v), other) {
                return Some(other);
            }
            self.seen[v] += 1;
        }
        None
    }

    fn cut_off(&mut self, v: usize) {
        let [before, _, after] = self.corners(v);
        let neighbours = [before, after];
        let were_reflex = neighbours.map(|v| self.is_reflex(v));
        for v in [before, v, after] {
            let key = self.key(v);
            self.by_cut.remove(&key);
            self.candidates.remove(&key);
        }
        self.left[v] = false;
        (self.after[before], self.before[after]) = (after, before);
        self.wake(v);
        for (v, was_reflex) in neighbours.into_iter().zip(were_reflex) {
            self.by_cut.insert(self.key(v));
            self.seen[v] = 0;
            match (was_reflex, self.is_reflex(v)) {
                // Only in a polygon that crosses itself.
                (false, true) => self.reflex.push(v),
                (true, true) => {}
                (true, false) => {
                    self.candidates.insert(self.key(v));
                    self.wake(v);
                }
                (false, false) => {
                    self.candidates.insert(self.key(v));
                }
            }
        }
    }

    /// Makes candidates of those that waited for a vertex that is no longer in their way.
    fn wake(&mut self, v: usize) {
        for waiting in std::mem::take(&mut self.waiting[v]) {
            if self.left[waiting] && !self.is_reflex(waiting) {
                self.candidates.insert(self.key(waiting));
            }
        }
    }
}

/// Whether vertex `v` lies in or on the triangle `ear`, its own corners aside.
fn blocks(polygon: &[Point], ear: [usize; 3], v: usize) -> bool {
    let p = polygon[v];
    // A vertex of the same position (a loop that touches itself) does not block either.
    !ear.contains(&v)
        && ear.iter().all(|&e| polygon[e] != p)
        && (0..3).all(|k| {
            let (a, b) = (polygon[ear[k]], polygon[ear[(k + 1) % 3]]);
            cross(sub(b, a), sub(p, a)) >= 0.0
        })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::polygon::area;

    /// The same, with everything computed anew for each ear.
    fn plainly(polygon: &[Point]) -> Vec<[usize; 3]> {
        let mut left: Vec<usize> = (0..polygon.len()).collect();
        let mut triangles = Vec::new();
        while left.len() > 3 {
            let n = left.len();
            let corner = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
            let turn = |i: usize| {
                let [a, b, c] = corner(i).map(|v| polygon[v]);
                cross(sub(b, a), sub(c, b))
            };
            let cut = |i: usize| {
                let [a, _, c] = corner(i).map(|v| polygon[v]);
                dot(sub(c, a), sub(c, a))
            };
            let reflex: Vec<usize> = (0..n).filter(|&i| turn(i) <= 0.0).map(|i| left[i]).collect();
            let is_ear = |i: usize| turn(i) > 0.0 && !reflex.iter().any(|&v| blocks(polygon, corner(i), v));
            let mut order: Vec<usize> = (0..n).collect();
            order.sort_by(|&i, &j| cut(i).total_cmp(&cut(j)));
            let best = order.iter().copied().find(|&i| is_ear(i)).unwrap_or(order[0]);
            triangles.push(corner(best));
            left.remove(best);
        }
        triangles.extend(<[usize; 3]>::try_from(left));
        triangles
    }

    /// Radii around the origin: a polygon that does not cross itself.
    fn star(radii: &[f64]) -> Vec<Point> {
        let place = |(i, radius): (usize, &f64)| {
            let (sin, cos) = (i as f64 * std::f64::consts::TAU / radii.len() as f64).sin_cos();
            [radius * cos, radius * sin]
        };
        radii.iter().enumerate().map(place).collect()
    }

    #[test]
    fn ears_tile_the_polygon() {
        let l_shape = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        for polygon in [&l_shape[..], &star(&[1.0, 0.3].repeat(20))] {
            let triangles = triangulate(polygon);
            assert_eq!(triangles.len(), polygon.len() - 2);
            let areas = triangles.iter().map(|t| area(&t.map(|v| polygon[v])));
            assert!(areas.clone().all(|a| a > 0.0));
            assert!((areas.sum::<f64>() - area(polygon)).abs() < 1e-14);
        }
    }

    #[test]
    fn fewer_than_three_vertices_have_no_triangle() {
        assert!(triangulate(&[]).is_empty() && triangulate(&[[0.0; 2], [1.0; 2]]).is_empty());
    }

    /// An open end of very many edges took minutes when every ear looked at all vertices.
    #[test]
    fn a_polygon_of_many_vertices_is_quick() {
        let n = 10_000;
        let teeth: Vec<f64> = (0..n).map(|i| if i % 2 == 0 { 1.0 } else { 0.999 }).collect();
        for radii in [vec![1.0; n], teeth] {
            assert_eq!(triangulate(&star(&radii)).len(), n - 2);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) })]

        #[test]
        fn the_order_is_that_of_the_plain_method(
            radii in prop::collection::vec(0.1f64..1.0, 3..60),
            places in prop::collection::vec([0i8..12, 0i8..12], 3..40),
        ) {
            let crossing: Vec<Point> = places.iter().map(|p| p.map(f64::from)).collect();
            for polygon in [star(&radii), crossing] {
                prop_assert_eq!(triangulate(&polygon), plainly(&polygon));
            }
        }
    }
}
