//! The wall as the fluid keeps it: reachable particles in cell order, packed, with their rows.

use glam::DVec3;
use vaso_kernels::{CellGrid, Frame, Isa, Real, Records, Rows, SearchSet};
use vaso_particles::{Selection, WallView};

/// How the particles of a view have been put in cell order; its memory is used again.
#[derive(Default)]
pub(crate) struct Arrangement {
    reachable: Selection,
    unsorted: Vec<DVec3>,
    order: Vec<u32>,
    /// Place in the view of each particle kept.
    pub(crate) source: Vec<u32>,
}

impl Arrangement {
    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        let lists = self.order.capacity() + self.source.capacity();
        self.reachable.bytes() + size_of::<DVec3>() * self.unsorted.capacity() + 4 * lists
    }
}

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
        let mut wall = Self {
            position: Vec::new(),
            grid: CellGrid::new(bounds, frame.support()),
            set: SearchSet::default(),
            kinematic: Records::default(),
            dynamic: Records::default(),
            fluid_rows: Rows::default(),
            wall_rows: Rows::default(),
        };
        wall.arrange(&view, frame, &mut Arrangement::default());
        wall
    }

    /// Takes the wall anew, as [`Self::new`].
    pub(crate) fn arrange(&mut self, view: &WallView, frame: &Frame, arrangement: &mut Arrangement) {
        let Arrangement { reachable, unsorted, order, source } = arrangement;
        let reachable = reachable.find(view.position.len(), |a| view.depth[a] < frame.support());
        unsorted.clear();
        unsorted.extend(reachable.iter().map(|&a| view.position[a as usize]));
        self.grid.sort(unsorted, order);
        source.clear();
        source.extend(order.iter().map(|&k| reachable[k as usize]));
        self.position.clear();
        self.position.extend(source.iter().map(|&a| view.position[a as usize]));
        self.set.fill(frame, &self.position);
        let (position, set) = (&self.position, &self.set);
        let pack = |records: &mut Records<R>, scalar: &(dyn Fn(usize) -> f64 + Sync)| {
            records.resize(source.len());
            records.fill(|k| {
                let a = source[k] as usize;
                let (fixed, x) = (set.get(k), frame.in_supports(position[k]));
                let v = view.velocity[a];
                [
                    R::coordinate(fixed[0], x[0]),
                    R::coordinate(fixed[1], x[1]),
                    R::coordinate(fixed[2], x[2]),
                    R::pack(view.volume[a]),
                    R::pack(v.x),
                    R::pack(v.y),
                    R::pack(v.z),
                    R::pack(scalar(a)),
                ]
            });
        };
        pack(&mut self.kinematic, &|a| view.depth[a]);
        pack(&mut self.dynamic, &|_| 0.0);
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
            + self.set.bytes()
    }
}
