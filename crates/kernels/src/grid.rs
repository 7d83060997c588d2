//! Cell grid over a box: particles are put in cell order by a counting sort.

use glam::DVec3;
use rayon::prelude::*;

/// Uniform grid of cubic cells, numbered row-major with x fastest.
///
/// Three neighbouring cells of one row are contiguous in particle order, so a search around a
/// cell reads nine runs of memory.
#[derive(Clone, Debug)]
pub struct CellGrid {
    origin: DVec3,
    cell: f64,
    n_cells: [usize; 3],
    /// First particle of each cell, one entry more than there are cells.
    start: Vec<u32>,
    key: Vec<u32>,
    cursor: Vec<u32>,
}

impl CellGrid {
    /// Grid over `bounds` (lower and upper corner) \[m\] with cells of edge `cell` \[m\], which is the search radius.
    ///
    /// Particles outside the bounds are counted to the nearest border cell.
    pub fn new(bounds: (DVec3, DVec3), cell: f64) -> Self {
        let extent = (bounds.1 - bounds.0).max(DVec3::splat(cell));
        let n_cells = extent.to_array().map(|e| (e / cell).floor() as usize + 1);
        let total = n_cells.iter().product::<usize>();
        Self {
            origin: bounds.0,
            cell,
            n_cells,
            start: vec![0; total + 1],
            key: Vec::new(),
            cursor: Vec::new(),
        }
    }

    /// Edge of a cell \[m\].
    pub fn cell(&self) -> f64 {
        self.cell
    }

    /// Lower corner of the box \[m\].
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Bytes held by the grid.
    pub fn bytes(&self) -> usize {
        4 * (self.start.capacity() + self.key.capacity() + self.cursor.capacity())
    }

    /// Place of the cell of `x` along each axis.
    #[inline(always)]
    pub(crate) fn coordinates(&self, x: DVec3) -> [usize; 3] {
        let q = ((x - self.origin) / self.cell).to_array();
        // `as` cuts off towards zero and takes what lies below to zero.
        std::array::from_fn(|k| (q[k] as usize).min(self.n_cells[k] - 1))
    }

    fn index(&self, x: DVec3) -> u32 {
        let [i, j, k] = self.coordinates(x);
        ((k * self.n_cells[1] + j) * self.n_cells[0] + i) as u32
    }

    /// Sorts particles by cell; afterwards `order[new] = old`, stable within a cell.
    ///
    /// The runs given by [`Self::runs`] refer to the sorted order: the caller permutes its data.
    pub fn sort(&mut self, position: &[DVec3], order: &mut Vec<u32>) {
        let mut key = std::mem::take(&mut self.key);
        key.resize(position.len(), 0);
        key.par_iter_mut().zip(position).with_min_len(4096).for_each(|(k, x)| *k = self.index(*x));
        self.start.fill(0);
        for &k in &key {
            self.start[k as usize + 1] += 1;
        }
        let mut sum = 0;
        for s in &mut self.start {
            sum += *s;
            *s = sum;
        }
        self.cursor.clear();
        self.cursor.extend_from_slice(&self.start);
        order.resize(position.len(), 0);
        for (old, &k) in key.iter().enumerate() {
            let slot = &mut self.cursor[k as usize];
            order[*slot as usize] = old as u32;
            *slot += 1;
        }
        self.key = key;
    }

    /// Runs of sorted particles in the 27 cells around `x`; empty ones are left out.
    #[inline(always)]
    pub fn runs(&self, x: DVec3) -> Runs {
        self.runs_around(self.coordinates(x))
    }

    /// Runs around a cell given by its place along each axis.
    #[inline(always)]
    pub(crate) fn runs_around(&self, [i, j, k]: [usize; 3]) -> Runs {
        let [nx, ny, nz] = self.n_cells;
        let (i0, i1) = (i.saturating_sub(1), (i + 1).min(nx - 1));
        let (j0, j1) = (j.saturating_sub(1), (j + 1).min(ny - 1));
        let (k0, k1) = (k.saturating_sub(1), (k + 1).min(nz - 1));
        let mut runs = Runs { run: [(0, 0); 9], n: 0 };
        for k in k0..=k1 {
            for j in j0..=j1 {
                let row = (k * ny + j) * nx;
                let (begin, end) = (self.start[row + i0], self.start[row + i1 + 1]);
                if begin < end {
                    runs.run[runs.n] = (begin as usize, end as usize);
                    runs.n += 1;
                }
            }
        }
        runs
    }
}

/// Runs (begin, end) of sorted particles around a point, at most nine.
#[derive(Clone, Copy, Debug)]
pub struct Runs {
    run: [(usize, usize); 9],
    n: usize,
}

impl Runs {
    /// The runs, in memory order.
    #[inline(always)]
    pub fn as_slice(&self) -> &[(usize, usize)] {
        &self.run[..self.n]
    }
}

impl IntoIterator for Runs {
    type Item = (usize, usize);
    type IntoIter = std::iter::Take<std::array::IntoIter<(usize, usize), 9>>;

    fn into_iter(self) -> Self::IntoIter {
        self.run.into_iter().take(self.n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cloud(n: usize) -> Vec<DVec3> {
        let mut state = 7_u64;
        let mut next = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..n).map(|_| DVec3::new(next() * 3.0, next() * 2.0, next())).collect()
    }

    #[test]
    fn runs_hold_every_particle_within_one_cell() {
        let points = cloud(2000);
        let mut grid = CellGrid::new((DVec3::ZERO, DVec3::new(3.0, 2.0, 1.0)), 0.25);
        let mut order = Vec::new();
        grid.sort(&points, &mut order);
        let sorted: Vec<DVec3> = order.iter().map(|&o| points[o as usize]).collect();
        for &x in points.iter().step_by(37) {
            let direct = sorted.iter().filter(|y| y.distance(x) < 0.25).count();
            let found = grid
                .runs(x)
                .into_iter()
                .flat_map(|(a, b)| &sorted[a..b])
                .filter(|y| y.distance(x) < 0.25)
                .count();
            assert_eq!(direct, found);
        }
        let mut seen = order.clone();
        seen.sort_unstable();
        assert!(seen.iter().enumerate().all(|(i, &o)| i == o as usize), "order is a permutation");
    }
}
