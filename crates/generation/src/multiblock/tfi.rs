//! Transfinite interpolation: the inside of a block from its border (Gordon and Hall 1973).

use std::ops::{Add, Mul, Sub};

/// A point of the plane or of space.
pub trait Point: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> {
    /// Distance to another point.
    fn to(self, other: Self) -> f64;
}

impl Point for glam::DVec2 {
    fn to(self, other: Self) -> f64 {
        self.distance(other)
    }
}

impl Point for glam::DVec3 {
    fn to(self, other: Self) -> f64 {
        self.distance(other)
    }
}

/// Nodes of a block, `(n[0] + 1) (n[1] + 1) (n[2] + 1)` of them, the first index running fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<P> {
    /// Cells along each direction; a face has one cell along the last, and a single layer of nodes.
    n: [usize; 3],
    node: Vec<P>,
}

impl<P: Point> Grid<P> {
    /// Nodes `node(i, j, k)` for every index.
    pub fn new(n: [usize; 3], mut node: impl FnMut(usize, usize, usize) -> P) -> Self {
        let mut all = Vec::with_capacity((n[0] + 1) * (n[1] + 1) * (n[2] + 1));
        for k in 0..=n[2] {
            for j in 0..=n[1] {
                for i in 0..=n[0] {
                    all.push(node(i, j, k));
                }
            }
        }
        Self { n, node: all }
    }

    /// Cells along each direction.
    pub fn cells(&self) -> [usize; 3] {
        self.n
    }

    /// The node at an index.
    pub fn at(&self, i: usize, j: usize, k: usize) -> P {
        self.node[self.index(i, j, k)]
    }

    /// All nodes.
    pub fn nodes(&self) -> &[P] {
        &self.node
    }

    pub(crate) fn set(&mut self, i: usize, j: usize, k: usize, p: P) {
        let index = self.index(i, j, k);
        self.node[index] = p;
    }

    fn index(&self, i: usize, j: usize, k: usize) -> usize {
        (k * (self.n[1] + 1) + j) * (self.n[0] + 1) + i
    }
}

/// Share of the length of a line of points at each of them, 0 to 1.
fn shares<P: Point>(line: impl Iterator<Item = P>) -> Vec<f64> {
    let mut shares = Vec::new();
    let (mut length, mut last) = (0.0, None::<P>);
    for p in line {
        length += last.map_or(0.0, |l| l.to(p));
        shares.push(length);
        last = Some(p);
    }
    let n = shares.len().saturating_sub(1);
    // A line that has shrunk to a point keeps its numbering.
    let share = |(k, s): (usize, f64)| if length > 0.0 { s / length } else { k as f64 / n.max(1) as f64 };
    shares.into_iter().enumerate().map(share).collect()
}

/// Nodes of a face with the given edges, from 0 to 1 in each direction: `bottom` and `top` have one number of
/// points, `left` and `right` another, and edges that meet share a corner.
///
/// Parameters are shares of arc length, between those of opposite edges where these differ.
///
/// # Panics
/// When opposite edges differ in their number of points.
pub fn face<P: Point>(bottom: &[P], top: &[P], left: &[P], right: &[P]) -> Grid<P> {
    assert!(bottom.len() == top.len() && left.len() == right.len(), "opposite edges have equal divisions");
    let (ni, nj) = (bottom.len() - 1, left.len() - 1);
    let [b, t, l, r] = [bottom, top, left, right].map(|edge| shares(edge.iter().copied()));
    Grid::new([ni, nj, 0], |i, j, _| {
        // The edges themselves are taken over bit by bit: blocks share them.
        match (i, j) {
            (_, 0) => return bottom[i],
            (_, j) if j == nj => return top[i],
            (0, _) => return left[j],
            (i, _) if i == ni => return right[j],
            _ => {}
        }
        // Where the line between the shares on bottom and top crosses that between left and right.
        let u = (b[i] + l[j] * (t[i] - b[i])) / (1.0 - (t[i] - b[i]) * (r[j] - l[j]));
        let v = l[j] + u * (r[j] - l[j]);
        let across = bottom[i] * (1.0 - v) + top[i] * v;
        let along = left[j] * (1.0 - u) + right[j] * u;
        let low = bottom[0] * (1.0 - u) + bottom[ni] * u;
        let high = top[0] * (1.0 - u) + top[ni] * u;
        across + along - (low * (1.0 - v) + high * v)
    })
}

/// Moves the inner nodes of a block to the Boolean sum of its six faces; the faces stay.
pub fn volume<P: Point>(grid: &mut Grid<P>) {
    let n @ [ni, nj, nk] = grid.n;
    // Shares along each direction, the mean over the four edges.
    let parameter: [Vec<f64>; 3] = std::array::from_fn(|axis| {
        let (p, q) = ((axis + 1) % 3, (axis + 2) % 3);
        let edges = [(0, 0), (n[p], 0), (0, n[q]), (n[p], n[q])].map(|(a, b)| {
            shares((0..=n[axis]).map(|m| {
                let mut index = [0; 3];
                (index[axis], index[p], index[q]) = (m, a, b);
                grid.at(index[0], index[1], index[2])
            }))
        });
        (0..=n[axis]).map(|m| edges.iter().map(|e| e[m]).sum::<f64>() / 4.0).collect()
    });
    for k in 1..nk {
        for j in 1..nj {
            for i in 1..ni {
                let weight = |axis: usize, m: usize| [1.0 - parameter[axis][m], parameter[axis][m]];
                let (u, v, w) = (weight(0, i), weight(1, j), weight(2, k));
                let ends = |n: usize| [0, n];
                let mut sum = (grid.at(0, j, k) * u[0]) + (grid.at(ni, j, k) * u[1]);
                for b in 0..2 {
                    sum = sum + grid.at(i, ends(nj)[b], k) * v[b] + grid.at(i, j, ends(nk)[b]) * w[b];
                    for a in 0..2 {
                        sum = sum
                            - grid.at(ends(ni)[a], ends(nj)[b], k) * (u[a] * v[b])
                            - grid.at(ends(ni)[a], j, ends(nk)[b]) * (u[a] * w[b])
                            - grid.at(i, ends(nj)[a], ends(nk)[b]) * (v[a] * w[b]);
                        for c in 0..2 {
                            let corner = grid.at(ends(ni)[a], ends(nj)[b], ends(nk)[c]);
                            sum = sum + corner * (u[a] * v[b] * w[c]);
                        }
                    }
                }
                grid.set(i, j, k, sum);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};

    const N: [usize; 3] = [7, 5, 6];

    fn part(k: usize, n: usize) -> f64 {
        k as f64 / n as f64
    }

    /// A block from the map, and again from its faces alone.
    fn worst(map: impl Fn(f64, f64, f64) -> DVec3) -> f64 {
        let exact = Grid::new(N, |i, j, k| map(part(i, N[0]), part(j, N[1]), part(k, N[2])));
        let mut block = exact.clone();
        for k in 1..N[2] {
            for j in 1..N[1] {
                for i in 1..N[0] {
                    block.set(i, j, k, DVec3::splat(1e3));
                }
            }
        }
        volume(&mut block);
        let pairs = block.nodes().iter().zip(exact.nodes());
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    }

    #[test]
    fn a_trilinear_block_comes_back() {
        let corner =
            |k: usize| DVec3::new(f64::from(k as u8).sin(), 2.0 * f64::from(k as u8).cos(), k as f64);
        let error = worst(|u, v, w| {
            (0..8)
                .map(|c| {
                    let weight = |bit: usize, x: f64| if c >> bit & 1 == 1 { x } else { 1.0 - x };
                    weight(0, u) * weight(1, v) * weight(2, w) * corner(c)
                })
                .sum()
        });
        assert!(error < 1e-12, "{error}");
    }

    #[test]
    fn a_polar_block_comes_back() {
        let error = worst(|u, v, w| {
            let (angle, radius) = (0.3 + 1.4 * u, 1.0 + v);
            DVec3::new(radius * angle.cos(), radius * angle.sin(), 2.0 * w)
        });
        assert!(error < 1e-12, "{error}");
    }

    #[test]
    fn a_polar_face_with_uneven_radii_comes_back() {
        let (ni, nj) = (9, 6);
        let map = |i: usize, j: usize| {
            let (angle, radius) = (0.2 + 1.1 * part(i, ni), 1.0 + part(j, nj).powi(2));
            DVec2::new(radius * angle.cos(), radius * angle.sin())
        };
        let edge = |n: usize, point: &dyn Fn(usize) -> DVec2| (0..=n).map(point).collect::<Vec<_>>();
        let grid = face(
            &edge(ni, &|i| map(i, 0)),
            &edge(ni, &|i| map(i, nj)),
            &edge(nj, &|j| map(0, j)),
            &edge(nj, &|j| map(ni, j)),
        );
        let inner = (0..=ni).flat_map(|i| (0..=nj).map(move |j| (i, j)));
        let error = inner.map(|(i, j)| grid.at(i, j, 0).distance(map(i, j))).fold(0.0, f64::max);
        assert!(error < 1e-12, "{error}");
    }
}
