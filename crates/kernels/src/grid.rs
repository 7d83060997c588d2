//! Cell grid over a box: particles are put in cell order by a counting sort.

use glam::DVec3;
use rayon::prelude::*;

/// Slices of a cell along x.
const SLICES: usize = 4;

/// Uniform grid of cubic cells in four slices along x, numbered row-major with x fastest.
///
/// Neighbouring slices of one row are contiguous in particle order, so a search reads nine runs of memory, each a little longer than the
/// sphere around a particle is wide: three quarters of the three cells that it would be without slices.
#[derive(Clone, Debug)]
pub struct CellGrid {
    origin: DVec3,
    cell: f64,
    /// Slices and cells over lengths \[1/m\].
    per_length: DVec3,
    /// Slices along x, cells along y and z.
    n_cells: [usize; 3],
    /// First particle of each slice, one entry more than there are slices.
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
        let per_length = DVec3::new(SLICES as f64, 1.0, 1.0) / cell;
        let n_cells = (extent * per_length).to_array().map(|e| e.floor() as usize + 1);
        let total = n_cells.iter().product::<usize>();
        Self {
            origin: bounds.0,
            cell,
            per_length,
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

    /// Place of the slice of `x` along x, and of its cell along y and z.
    #[inline(always)]
    pub(crate) fn coordinates(&self, x: DVec3) -> [usize; 3] {
        let q = ((x - self.origin) * self.per_length).to_array();
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

    /// Runs of sorted particles that hold all within one edge of a cell from `x`; empty ones are left out.
    #[inline(always)]
    pub fn runs(&self, x: DVec3) -> Runs {
        self.runs_around(self.coordinates(x))
    }

    /// Runs around a slice given by its place along each axis.
    ///
    /// Rows at the corners could be cut shorter, by what the sphere around the particle leaves of them: that depends on the particle, and
    /// branches which differ from one to the next cost more than it saves.
    #[inline(always)]
    pub(crate) fn runs_around(&self, [i, j, k]: [usize; 3]) -> Runs {
        let [nx, ny, nz] = self.n_cells;
        let (i0, i1) = (i.saturating_sub(SLICES), (i + SLICES).min(nx - 1));
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
        runs_hold_all(&points, (DVec3::ZERO, DVec3::new(3.0, 2.0, 1.0)));
        // Also where some lie beyond the bounds.
        runs_hold_all(&points, (DVec3::splat(0.3), DVec3::new(2.5, 1.7, 0.6)));
    }

    fn runs_hold_all(points: &[DVec3], bounds: (DVec3, DVec3)) {
        let mut grid = CellGrid::new(bounds, 0.25);
        let mut order = Vec::new();
        grid.sort(points, &mut order);
        let sorted: Vec<DVec3> = order.iter().map(|&o| points[o as usize]).collect();
        for &x in points.iter().step_by(7) {
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
