//! Ways through the lumen that keep away from the wall.

use crate::distance::SignedDistance;
use crate::section::neighbour_steps;
use crate::vessel::Vessel;
use glam::DVec3;
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Grid points the lumen is given at most.
const MOST_POINTS: f64 = 3e5;
/// Grid points across the radius of the smallest opening, where that many can be had.
const POINTS_ACROSS: f64 = 5.0;

/// Points of a grid inside the lumen, and from each the cheapest way to a root.
pub(super) struct Ways {
    low: DVec3,
    spacing: f64,
    n: [usize; 3],
    /// For each grid point the next on its way to the root; itself at the root, `u32::MAX` outside.
    next: Vec<u32>,
}

impl Ways {
    /// Ways to `root`, the price of a step being its length over the square of the distance from the wall.
    ///
    /// `None` when the grid is too coarse to find the root.
    pub(super) fn to(vessel: &Vessel, wall: &SignedDistance, root: DVec3) -> Option<Self> {
        let smallest = vessel.openings.iter().map(|o| o.radius).fold(f64::INFINITY, f64::min);
        let spacing = (smallest / POINTS_ACROSS).max((vessel.surface.volume() / MOST_POINTS).cbrt());
        let (low, high) = vessel.surface.bounds();
        let n: [usize; 3] = ((high - low) / spacing).to_array().map(|e| e.ceil() as usize + 1);
        let mut ways = Self { low, spacing, n, next: Vec::new() };
        let closed = SignedDistance::closed(vessel);
        let clearance: Vec<f32> = (0..n.iter().product())
            .into_par_iter()
            .map(|k| {
                let x = ways.point(k);
                if closed.query(x).distance < 0.0 { wall.query(x).distance.abs() as f32 } else { 0.0 }
            })
            .collect();
        ways.next = vec![u32::MAX; clearance.len()];
        ways.search(&clearance, root)?;
        Some(ways)
    }

    fn point(&self, k: usize) -> DVec3 {
        let [i, j, l] = self.index(k);
        self.low + self.spacing * DVec3::new(i as f64, j as f64, l as f64)
    }

    fn index(&self, k: usize) -> [usize; 3] {
        [k % self.n[0], k / self.n[0] % self.n[1], k / (self.n[0] * self.n[1])]
    }

    /// The reached grid point, or before the search the inside one, nearest to `x`.
    fn nearest(&self, x: DVec3, is_taken: impl Fn(usize) -> bool + Sync) -> Option<usize> {
        let total = self.n.iter().product();
        (0..total)
            .into_par_iter()
            .filter(|&k| is_taken(k))
            .map(|k| (self.point(k).distance_squared(x), k))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(_, k)| k)
    }

    fn search(&mut self, clearance: &[f32], root: DVec3) -> Option<()> {
        let start = self.nearest(root, |k| clearance[k] > 0.0)?;
        let widest = clearance.iter().fold(0.0_f32, |a, b| a.max(*b));
        let steps = neighbour_steps();
        // Prices as whole numbers, which makes their order exact.
        let price = |a: usize, b: usize, length: u64| {
            let ratio = f64::from(2.0 * widest)
                / f64::from(clearance[a] + clearance[b]).max(1e-3 * f64::from(widest));
            (length as f64 * ratio * ratio) as u64
        };
        let mut spent = vec![u64::MAX; clearance.len()];
        (spent[start], self.next[start]) = (0, start as u32);
        let mut front = BinaryHeap::from([Reverse((0, start))]);
        while let Some(Reverse((reached, k))) = front.pop() {
            if reached > spent[k] {
                continue;
            }
            let here = self.index(k);
            for &(step, length) in &steps {
                let there: [i64; 3] = std::array::from_fn(|a| here[a] as i64 + step[a]);
                if (0..3).any(|a| there[a] < 0 || there[a] >= self.n[a] as i64) {
                    continue;
                }
                let to = (there[2] as usize * self.n[1] + there[1] as usize) * self.n[0] + there[0] as usize;
                if clearance[to] <= 0.0 {
                    continue;
                }
                let total = reached + price(k, to, length);
                if total < spent[to] {
                    (spent[to], self.next[to]) = (total, k as u32);
                    front.push(Reverse((total, to)));
                }
            }
        }
        Some(())
    }

    /// Grid points from the root to the one nearest to `x`; `None` when no point has a way.
    pub(super) fn way_to(&self, x: DVec3) -> Option<Vec<DVec3>> {
        let mut k = self.nearest(x, |k| self.next[k] != u32::MAX)?;
        let mut way = vec![self.point(k)];
        while self.next[k] as usize != k {
            k = self.next[k] as usize;
            way.push(self.point(k));
        }
        way.reverse();
        Some(way)
    }
}
