//! Material of the benches: a jittered lattice as dense as blood in a vessel, and the page of the speed.

pub mod speed;

use glam::DVec3;
use rustix::time::{ClockId, clock_gettime};
use vaso_kernels::{CellGrid, Frame, Isa, Real, Records, Rows, SearchSet, Wendland};

/// Spacing of the lattice \[m\].
pub const SPACING: f64 = 1e-3;

/// Processor time of the program so far \[s\].
pub fn processor() -> f64 {
    let t = clock_gettime(ClockId::ProcessCPUTime);
    t.tv_sec as f64 + 1e-9 * t.tv_nsec as f64
}

/// A cube of particles, sorted by cell.
pub struct Cube {
    /// Positions \[m\].
    pub position: Vec<DVec3>,
    /// Frame of the pair loops.
    pub frame: Frame,
    /// Search coordinates.
    pub set: SearchSet,
    /// Cells.
    pub grid: CellGrid,
}

impl Cube {
    /// Cube of `n` particles an edge, each moved by up to 0.15 spacings along each axis.
    pub fn new(n: usize) -> Self {
        let mut state = 3_u64;
        let mut next = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let unsorted: Vec<DVec3> = (0..n * n * n)
            .map(|k| {
                let site = DVec3::new((k % n) as f64, (k / n % n) as f64, (k / n / n) as f64);
                SPACING * (site + 0.3 * DVec3::new(next(), next(), next()))
            })
            .collect();
        let bounds = (DVec3::ZERO, DVec3::splat(n as f64 * SPACING));
        let support = Wendland::new(1.3 * SPACING).support();
        let frame = Frame::new(bounds, support);
        let mut grid = CellGrid::new(bounds, support);
        let mut order = Vec::new();
        grid.sort(&unsorted, &mut order);
        let position: Vec<DVec3> = order.iter().map(|&o| unsorted[o as usize]).collect();
        let mut set = SearchSet::default();
        set.fill(&frame, &position);
        Self { position, frame, set, grid }
    }

    /// Neighbour rows of the cube.
    pub fn rows(&self, isa: Isa) -> Rows {
        let mut rows = Rows::default();
        self.build(isa, &mut rows);
        rows
    }

    /// Builds the rows again in place.
    pub fn build(&self, isa: Isa, rows: &mut Rows) {
        rows.build(isa, &self.frame, (&self.set, &self.position), &self.set, &self.grid, true);
    }

    /// Packed records: a Taylor-Green velocity and a pressure that goes with it.
    pub fn records<R: Real>(&self) -> Records<R> {
        let mut records = Records::default();
        records.resize(self.position.len());
        let wave = 2.0 * std::f64::consts::PI / (20.0 * SPACING);
        records.fill(|i| {
            let (p, fixed) = (self.position[i], self.set.get(i));
            let x = self.frame.in_supports(p);
            let (sx, cx) = (wave * p.x).sin_cos();
            let (sy, cy) = (wave * p.y).sin_cos();
            [
                R::coordinate(fixed[0], x[0]),
                R::coordinate(fixed[1], x[1]),
                R::coordinate(fixed[2], x[2]),
                R::pack(SPACING.powi(3)),
                R::pack(0.1 * sx * cy),
                R::pack(-0.1 * cx * sy),
                R::pack(0.0),
                R::pack(2.5 * (cx * cx + cy * cy)),
            ]
        });
        records
    }

    /// Second records: correction matrices a little off unity.
    pub fn matrices<R: Real>(&self) -> Records<R> {
        let mut records = Records::default();
        records.resize(self.position.len());
        records.fill(|i| {
            let e = 1e-3 * ((i % 17) as f64 - 8.0);
            [1.0 + e, 1.0 - e, 1.0, e, -e, 0.5 * e, 0.0, 0.0].map(R::pack)
        });
        records
    }
}
