//! Fully developed flow through a section of any shape.

/// Solution of `w_xx + w_yy = -1` with w = 0 on a polygon, scaled to unit mean, on a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    origin: [f64; 2],
    step: f64,
    columns: usize,
    values: Vec<f64>,
    peak: f64,
}

/// Grid steps along the side of the square of equal area.
const RESOLUTION: f64 = 96.0;
/// Most grid points: a section a thousand times as long as wide gets a coarser grid.
const MOST: f64 = 4e5;
/// Nearest a wall counts, in steps; a grid point nearer to it is as good as on it.
const NEAREST: f64 = 1e-3;
/// Change per sweep, over the largest value, at which the sweeps end.
const CONVERGED: f64 = 1e-9;
/// Sweeps after which what is there is taken; a round section needs 300.
const SWEEPS: usize = 5000;

/// A grid point within the section: its place and the distances to the next points or the wall, in steps.
#[derive(Clone, Copy, Debug)]
struct Node {
    at: usize,
    /// West, east, south, north.
    arms: [f64; 4],
    /// Whether the arm ends at a grid point; else it ends at the wall.
    open: [bool; 4],
}

impl Section {
    /// Solves the flow within the closed rim `polygon` \[m\], by second-order differences with arms cut at the wall
    /// (Shortley and Weller 1938).
    pub fn new(polygon: &[[f64; 2]]) -> Self {
        let bounds = |axis: usize| {
            polygon
                .iter()
                .map(|p| p[axis])
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
        };
        let ((x0, x1), (y0, y1)) = (bounds(0), bounds(1));
        let step = (area(polygon).sqrt() / RESOLUTION).max(((x1 - x0) * (y1 - y0) / MOST).sqrt());
        // A margin of two points, and an offset that keeps the sides of a rectangle off the grid lines.
        let origin = [x0 - 2.37 * step, y0 - 2.37 * step];
        let size = |low: f64, high: f64| ((high - low) / step).ceil() as usize + 6;
        let (columns, rows) = (size(x0, x1), size(y0, y1));
        let nodes = nodes(polygon, origin, step, columns, rows);
        let narrow = columns.min(rows) as f64 - 5.0;
        let mut values = solve(&nodes, columns, columns * rows, narrow);
        let mean = nodes.iter().map(|n| values[n.at]).sum::<f64>() * step * step / area(polygon);
        values.iter_mut().for_each(|v| *v /= mean);
        let peak = nodes.iter().map(|n| values[n.at]).fold(0.0, f64::max);
        continue_beyond(&nodes, columns, &mut values);
        Self { origin, step, columns, values, peak }
    }

    /// Velocity over the mean at the in-plane point `at` \[m\], zero beyond the rim.
    pub fn at(&self, at: [f64; 2]) -> f64 {
        let [u, v] = [0, 1].map(|axis| (at[axis] - self.origin[axis]) / self.step);
        let rows = self.values.len() / self.columns;
        if !(u >= 0.0 && v >= 0.0 && u < (self.columns - 1) as f64 && v < (rows - 1) as f64) {
            return 0.0;
        }
        let (i, j) = (u as usize, v as usize);
        let (s, t) = (u - i as f64, v - j as f64);
        let k = j * self.columns + i;
        let south = self.values[k] * (1.0 - s) + self.values[k + 1] * s;
        let north = self.values[k + self.columns] * (1.0 - s) + self.values[k + self.columns + 1] * s;
        (south * (1.0 - t) + north * t).max(0.0)
    }

    /// Largest velocity over the mean.
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Distance from the middle as a part of the way to the rim, such that the flow is `1 - r^2` of its peak: the radius
    /// itself on a disc.
    pub fn radius(&self, at: [f64; 2]) -> f64 {
        (1.0 - self.at(at) / self.peak).max(0.0).sqrt()
    }
}

fn area(polygon: &[[f64; 2]]) -> f64 {
    let n = polygon.len();
    let twice = (0..n).map(|k| (polygon[k], polygon[(k + 1) % n])).map(|(a, b)| a[0] * b[1] - a[1] * b[0]);
    0.5 * twice.sum::<f64>().abs()
}

/// Where the line `axis = value` crosses the polygon, in order along the other axis.
fn crossings(polygon: &[[f64; 2]], axis: usize, value: f64) -> Vec<f64> {
    let n = polygon.len();
    let mut found: Vec<f64> = (0..n)
        .map(|k| (polygon[k], polygon[(k + 1) % n]))
        .filter(|(a, b)| (a[axis] > value) != (b[axis] > value))
        .map(|(a, b)| a[1 - axis] + (b[1 - axis] - a[1 - axis]) * (value - a[axis]) / (b[axis] - a[axis]))
        .collect();
    found.sort_unstable_by(f64::total_cmp);
    found
}

/// The grid points within the polygon, row by row.
fn nodes(polygon: &[[f64; 2]], origin: [f64; 2], step: f64, columns: usize, rows: usize) -> Vec<Node> {
    let line = |axis: usize, k: usize| {
        let cuts = crossings(polygon, 1 - axis, origin[1 - axis] + step * k as f64);
        cuts.iter().map(|c| (c - origin[axis]) / step).collect::<Vec<f64>>()
    };
    let along_rows: Vec<Vec<f64>> = (0..rows).map(|j| line(0, j)).collect();
    let along_columns: Vec<Vec<f64>> = (0..columns).map(|i| line(1, i)).collect();
    // The arms to both sides of a point on a line, if it lies within.
    let arms = |cuts: &[f64], at: f64| {
        let above = cuts.partition_point(|&c| c <= at);
        (above % 2 == 1).then(|| [at - cuts[above - 1], cuts[above] - at])
    };
    let mut found = Vec::new();
    for j in 0..rows {
        for i in 0..columns {
            let (Some([west, east]), Some([south, north])) =
                (arms(&along_rows[j], i as f64), arms(&along_columns[i], j as f64))
            else {
                continue;
            };
            let walls = [west, east, south, north];
            let open = walls.map(|wall| wall > 1.0);
            found.push(Node { at: j * columns + i, arms: walls.map(|wall| wall.clamp(NEAREST, 1.0)), open });
        }
    }
    found
}

/// The point beside `node`: west, east, south, north.
fn beside(node: &Node, columns: usize) -> [usize; 4] {
    [node.at - 1, node.at + 1, node.at - columns, node.at + columns]
}

/// Successive over-relaxation; `narrow` is the number of steps across the section.
fn solve(nodes: &[Node], columns: usize, count: usize, narrow: f64) -> Vec<f64> {
    let relaxation = 2.0 / (1.0 + (std::f64::consts::PI / narrow).sin());
    let mut values = vec![0.0; count];
    for _ in 0..SWEEPS {
        let (mut change, mut largest): (f64, f64) = (0.0, 0.0);
        for node in nodes {
            let next = beside(node, columns);
            let [w, e, s, n] = node.arms;
            let weights =
                [1.0 / (w * (w + e)), 1.0 / (e * (w + e)), 1.0 / (s * (s + n)), 1.0 / (n * (s + n))];
            let drawn: f64 = (0..4).filter(|&d| node.open[d]).map(|d| weights[d] * values[next[d]]).sum();
            let settled = (0.5 + drawn) / (0.5 * (2.0 / (w * e) + 2.0 / (s * n)));
            let step = relaxation * (settled - values[node.at]);
            values[node.at] += step;
            change = change.max(step.abs());
            largest = largest.max(values[node.at].abs());
        }
        if change <= CONVERGED * largest {
            break;
        }
    }
    values
}

/// Gives the points just beyond the wall the value that makes the interpolation vanish on it.
fn continue_beyond(nodes: &[Node], columns: usize, values: &mut [f64]) {
    let mut sums = vec![(0.0, 0u32); values.len()];
    let mut add = |at: usize, value: f64| {
        sums[at].0 += value;
        sums[at].1 += 1;
    };
    for node in nodes {
        let next = beside(node, columns);
        for d in (0..4).filter(|&d| !node.open[d]) {
            add(next[d], -values[node.at] * (1.0 - node.arms[d]) / node.arms[d]);
        }
    }
    let mut inside = vec![false; values.len()];
    for node in nodes {
        inside[node.at] = true;
    }
    for (k, &(sum, n)) in sums.iter().enumerate() {
        // A point may be beyond one wall and within another part of the section.
        if n > 0 && !inside[k] {
            values[k] = sum / f64::from(n);
        }
    }
    // Points that only have a corner in common with the section follow from the other three of their cell.
    let known: Vec<bool> = sums.iter().zip(&inside).map(|((_, n), inside)| *n > 0 || *inside).collect();
    let mut corners = Vec::new();
    for node in nodes {
        let [west, east, south, north] = beside(node, columns);
        for (side, level, corner) in [
            (west, south, south - 1),
            (east, south, south + 1),
            (west, north, north - 1),
            (east, north, north + 1),
        ] {
            if !known[corner] {
                corners.push((corner, values[side] + values[level] - values[node.at]));
            }
        }
    }
    for (corner, value) in corners {
        values[corner] = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn ellipse(a: f64, b: f64) -> Vec<[f64; 2]> {
        (0..360).map(|k| TAU * f64::from(k) / 360.0).map(|phi| [a * phi.cos(), b * phi.sin()]).collect()
    }

    #[test]
    fn ellipses_have_their_paraboloid() {
        for (a, b) in [(3e-3, 3e-3), (3e-3, 1.5e-3), (1e-2, 1e-3)] {
            let section = Section::new(&ellipse(a, b));
            for k in 0..500 {
                let (r, phi) = (f64::from(k) / 500.0, 2.4 * f64::from(k));
                let at = [a * r * phi.cos(), b * r * phi.sin()];
                let exact = 2.0 * (1.0 - r * r);
                assert!((section.at(at) - exact).abs() < 0.01, "{a} {b} at {r}: {} {exact}", section.at(at));
                assert!((section.radius(at) - r).abs() < 0.05, "{a} {b}: {} {r}", section.radius(at));
            }
            assert_eq!(section.at([1.01 * a + 1e-4, 0.0]), 0.0);
        }
    }

    #[test]
    fn a_rectangle_has_its_series() {
        let (a, b) = (2e-3, 1e-3);
        let section = Section::new(&[[-a, -b], [a, -b], [a, b], [-a, b]]);
        // White (2006), eq 3-48, up to a factor that the mean removes.
        let series = |x: f64, y: f64| -> f64 {
            (0..40)
                .map(|m| f64::from(2 * m + 1))
                .map(|i| {
                    let k = i * PI / (2.0 * a);
                    let sign = if (i as i64 / 2) % 2 == 0 { 1.0 } else { -1.0 };
                    sign * (1.0 - (k * y).cosh() / (k * b).cosh()) * (k * x).cos() / (i * i * i)
                })
                .sum()
        };
        let n = 200;
        let cell = |k: i32, half: f64| half * (2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0);
        let mean = (0..n * n).map(|k| series(cell(k % n, a), cell(k / n, b))).sum::<f64>() / f64::from(n * n);
        for k in (0..n * n).step_by(7) {
            let at = [cell(k % n, a), cell(k / n, b)];
            let exact = series(at[0], at[1]) / mean;
            assert!((section.at(at) - exact).abs() < 0.01, "{at:?}: {} {exact}", section.at(at));
        }
        assert!(
            (Section::new(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).peak() - 2.0962).abs() < 2e-3
        );
    }

    #[test]
    fn a_turned_section_has_the_same_flow() {
        let (c, s) = (0.6, 0.8);
        let shape = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.5], [1.0, 3.0], [0.0, 3.0]];
        let turn = |[x, y]: [f64; 2]| [c * x - s * y, s * x + c * y];
        let (straight, turned) = (Section::new(&shape), Section::new(&shape.map(turn)));
        for at in [[0.5, 0.5], [2.0, 0.5], [0.3, 2.5], [0.9, 1.4], [2.9, 0.2]] {
            let [a, b] = [straight.at(at), turned.at(turn(at))];
            assert!((a - b).abs() < 0.015 * straight.peak(), "{at:?}: {a} {b}");
        }
    }
}
