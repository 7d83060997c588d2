//! The wall as the fluid keeps it: reachable particles in cell order, packed, with their rows.

use glam::DVec3;
use vaso_kernels::{CellGrid, Frame, Isa, Real, Records, Rows, SearchSet};
use vaso_particles::WallView;

/// Wall particles within reach of the fluid.
pub struct WallSide<R> {
    position: Vec<DVec3>,
    grid: CellGrid,
    set: SearchSet,
    /// Velocity and depth, for the viscous law.
    pub(crate) kinematic: Records<R>,
    /// Velocity and pressure, for the momentum law.
    pub(crate) dynamic: Records<R>,
    /// Rows of the fluid among the wall.
    pub(crate) fluid_rows: Rows,
    /// Rows of the wall among the fluid.
    pub(crate) wall_rows: Rows,
}

impl<R: Real> WallSide<R> {
    /// Takes from `view` the particles that a fluid particle in the lumen can reach: those no
    /// deeper than the support.
    pub fn new(view: WallView, frame: &Frame, bounds: (DVec3, DVec3)) -> Self {
        let reachable: Vec<usize> =
            (0..view.position.len()).filter(|&a| view.depth[a] < frame.support()).collect();
        let unsorted: Vec<DVec3> = reachable.iter().map(|&a| view.position[a]).collect();
        let mut grid = CellGrid::new(bounds, frame.support());
        let mut order = Vec::new();
        grid.sort(&unsorted, &mut order);
        let source: Vec<usize> = order.iter().map(|&k| reachable[k as usize]).collect();
        let position: Vec<DVec3> = source.iter().map(|&a| view.position[a]).collect();
        let mut set = SearchSet::default();
        set.fill(frame, &position);
        let pack = |scalar: &dyn Fn(usize) -> f64| {
            let mut records = Records::default();
            records.resize(source.len());
            for (k, (record, &a)) in records.as_mut_slice().iter_mut().zip(&source).enumerate() {
                let (fixed, x) = (set.get(k), frame.in_supports(position[k]));
                let v = view.velocity[a];
                *record = [
                    R::coordinate(fixed[0], x[0]),
                    R::coordinate(fixed[1], x[1]),
                    R::coordinate(fixed[2], x[2]),
                    R::pack(view.volume[a]),
                    R::pack(v.x),
                    R::pack(v.y),
                    R::pack(v.z),
                    R::pack(scalar(a)),
                ];
            }
            records
        };
        let kinematic = pack(&|a| view.depth[a]);
        let dynamic = pack(&|_| 0.0);
        Self {
            position,
            grid,
            set,
            kinematic,
            dynamic,
            fluid_rows: Rows::default(),
            wall_rows: Rows::default(),
        }
    }

    /// Finds the rows of the fluid among the wall and of the wall among the fluid.
    pub fn build_rows(
        &mut self,
        isa: Isa,
        frame: &Frame,
        fluid: (&SearchSet, &[DVec3]),
        fluid_grid: &CellGrid,
    ) {
        self.fluid_rows.build(isa, frame, fluid, &self.set, &self.grid, false);
        self.wall_rows.build(isa, frame, (&self.set, &self.position), fluid.0, fluid_grid, false);
    }

    /// Number of wall particles within reach.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is no wall.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of::<DVec3>() * self.position.capacity()
            + self.kinematic.bytes()
            + self.dynamic.bytes()
            + self.fluid_rows.bytes()
            + self.wall_rows.bytes()
            + self.grid.bytes()
    }
}
