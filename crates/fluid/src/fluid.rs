//! The fluid body of a run: its state, its neighbours and what is frozen for an advective step.

use crate::cap::CapZone;
use crate::frozen::{ChunkKind, Columns, ForContinuity, ForMomentum, Frozen};
use crate::moving::Moving;
use crate::numbers::Numbers;
use crate::state::FluidState;
use crate::wall::WallSide;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_kernels::{
    CHUNK, CellGrid, Frame, Isa, PairStore, Real, Records, RowChunk, Rows, SearchSet, Wendland,
};
use vaso_particles::{Memory, Selection, WallDistance, WallView, visit};

/// Weakly compressible fluid in a vessel.
///
/// One advective step is: [`Self::sort`], [`Self::search`], [`Self::summation`],
/// [`Self::viscosity`], then acoustic steps ([`Self::begin_acoustic`], [`Self::wall_pressure`],
/// [`Self::kick`], openings, [`Self::continuity`]), then [`Self::transport`] and [`Self::guard`].
pub struct Fluid<R> {
    /// Columns of the particles, in cell order after [`Self::sort`].
    pub state: FluidState,
    pub(crate) numbers: Numbers,
    pub(crate) kernel: Wendland,
    pub(crate) isa: Isa,
    pub(crate) frame: Frame,
    grid: CellGrid,
    order: Vec<u32>,
    spare: visit::Spare,
    /// Particles that the guard looks at.
    pub(crate) near_wall: Selection,
    set: SearchSet,
    pub(crate) rows: Rows,
    pub(crate) wall: WallSide<R>,
    /// What a wall needs that moves; nothing for one at rest.
    pub(crate) moving: Option<Box<Moving<R>>>,
    /// Records the momentum law reads.
    pub(crate) current: Records<R>,
    /// Records the continuity law reads: the same with the new velocity.
    pub(crate) next: Records<R>,
    /// Second records: correction matrices, then velocity gradients.
    pub(crate) second: Records<R>,
    pub(crate) offsets: PairStore<R>,
    pub(crate) frozen: Vec<Frozen<R>>,
    pub(crate) columns: Columns<R>,
    /// What the acoustic steps read of [`Self::frozen`], from [`Self::begin_acoustic`] on, and by which laws.
    pub(crate) for_momentum: Vec<ForMomentum<R>>,
    pub(crate) for_continuity: Vec<ForContinuity<R>>,
    pub(crate) kinds: Vec<ChunkKind>,
    /// Gradients of the components of the velocity, column by column \[1/s\].
    pub(crate) slope: Vec<DMat3>,
    /// One more than the place in the zone list, zero away from caps.
    pub(crate) zone_of: Vec<u32>,
    pub(crate) lattice_sum: f64,
    /// Volume of a vessel at rest, its buffers by the share with which their particles count \[m^3\]; from the first step on.
    pub(crate) capacity: Option<f64>,
    /// Time since the first of the acoustic steps \[s\].
    pub(crate) elapsed: f64,
    /// Part of a full advective step that the last one was.
    pub(crate) part: f64,
    wall_distance: Box<dyn WallDistance>,
    reach: f64,
}

impl<R: Real> Fluid<R> {
    /// Fluid `state` within `wall`, over `bounds` \[m\] that hold both for the whole run.
    pub fn new(
        state: FluidState,
        wall: WallView,
        wall_distance: Box<dyn WallDistance>,
        bounds: (DVec3, DVec3),
        numbers: Numbers,
        isa: Isa,
    ) -> Self {
        let kernel = Wendland::new(numbers.smoothing_length);
        let frame = Frame::new(bounds, kernel.support());
        Self {
            state,
            numbers,
            kernel,
            isa,
            frame,
            grid: CellGrid::new(bounds, kernel.support()),
            order: Vec::new(),
            spare: visit::Spare::default(),
            near_wall: Selection::default(),
            set: SearchSet::default(),
            rows: Rows::default(),
            wall: WallSide::new(wall, &frame, bounds),
            moving: None,
            current: Records::default(),
            next: Records::default(),
            second: Records::default(),
            offsets: PairStore::default(),
            frozen: Vec::new(),
            columns: Columns::default(),
            for_momentum: Vec::new(),
            for_continuity: Vec::new(),
            kinds: Vec::new(),
            slope: Vec::new(),
            zone_of: Vec::new(),
            lattice_sum: kernel.lattice_sum(numbers.spacing),
            capacity: None,
            elapsed: 0.0,
            part: 1.0,
            wall_distance,
            reach: kernel.support(),
        }
    }

    /// The numbers of the run.
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// Part of a full advective step that the last one was, see [`Self::note_part`].
    pub fn part(&self) -> f64 {
        self.part
    }

    /// Neighbour pairs of the last search: among the fluid, of the fluid with the wall, of the wall with the fluid.
    pub fn n_pairs(&self) -> [usize; 3] {
        [self.rows.n_pairs(), self.wall.fluid_rows.n_pairs(), self.wall.wall_rows.n_pairs()]
    }

    /// Number of wall particles within reach.
    pub fn n_wall(&self) -> usize {
        self.wall.len()
    }

    /// Bytes held for neighbour rows, records and what is frozen.
    pub fn bytes(&mut self) -> usize {
        visit::bytes(&mut self.state)
            + self.rows.bytes()
            + self.wall.bytes()
            + self.moving_bytes()
            + self.current.bytes()
            + self.next.bytes()
            + self.second.bytes()
            + self.offsets.bytes()
            + self.grid.bytes()
            + self.spare.bytes()
            + self.near_wall.bytes()
            + self.set.bytes()
            + self.columns.bytes()
            + self.frozen.capacity() * size_of::<Frozen<R>>()
            + self.for_momentum.capacity() * size_of::<ForMomentum<R>>()
            + self.for_continuity.capacity() * size_of::<ForContinuity<R>>()
            + self.slope.capacity() * size_of::<DMat3>()
            + 4 * (self.zone_of.capacity() + self.order.capacity())
    }

    /// Shows all that the fluid carries from one advective step to the next: everything else is found anew in each.
    pub fn remember(&mut self, memory: &mut dyn Memory) {
        let Self {
            state,
            capacity,
            numbers: _,
            kernel: _,
            isa: _,
            frame: _,
            grid: _,
            order: _,
            spare: _,
            near_wall: _,
            set: _,
            rows: _,
            wall: _,
            moving: _,
            current: _,
            next: _,
            second: _,
            offsets: _,
            frozen: _,
            columns: _,
            for_momentum: _,
            for_continuity: _,
            kinds: _,
            slope: _,
            zone_of: _,
            lattice_sum: _,
            elapsed: _,
            part,
            wall_distance: _,
            reach: _,
        } = self;
        memory.columns("fluid", state);
        memory.optional("fluid.capacity_m3", capacity);
        memory.fields("fluid.part", &mut [part]);
    }

    /// Puts the particles in cell order.
    pub fn sort(&mut self) {
        self.grid.sort(&self.state.position, &mut self.order);
        visit::reorder(&mut self.state, &self.order, &mut self.spare);
    }

    /// Finds neighbours among the sorted particles and measures the distance to the wall.
    ///
    /// `zones` lists the particles near caps, in any order.
    pub fn search(&mut self, zones: &[CapZone]) {
        let n = self.state.len();
        self.set.fill(&self.frame, &self.state.position);
        self.rows.build(
            self.isa,
            &self.frame,
            (&self.set, &self.state.position),
            &self.set,
            &self.grid,
            true,
        );
        self.wall.build_rows(self.isa, &self.frame, (&self.set, &self.state.position), &self.grid);
        self.zone_of.clear();
        self.zone_of.resize(n, 0);
        for (k, zone) in zones.iter().enumerate() {
            self.zone_of[zone.particle as usize] = k as u32 + 1;
        }
        self.frozen.resize(n, Frozen::new(DVec3::ZERO, None, self.reach));
        self.columns.resize(n);
        if self.moving.is_some() {
            self.see_wall();
        }
        let floor = 0.05 * self.numbers.spacing;
        let (distance, reach, rows) = (&self.wall_distance, self.reach, &self.wall.fluid_rows);
        let (position, zone_of) = (&self.state.position, &self.zone_of);
        let displacement = self.moving.as_ref().map(|m| m.displacement.as_slice());
        (
            self.frozen.par_chunks_mut(CHUNK),
            self.columns.inverse_distance.par_chunks_mut(CHUNK),
            rows.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (frozen, inverse_distance, row))| {
                for (k, (frozen, inverse)) in frozen.iter_mut().zip(inverse_distance).enumerate() {
                    let i = c * CHUNK + k;
                    let zone = zone_of[i].checked_sub(1).map(|zone| &zones[zone as usize]);
                    let mut normal = DVec3::ZERO;
                    *inverse = R::default();
                    if !row.is_row_empty(k) {
                        let moved = displacement.map_or(DVec3::ZERO, |u| u[i]);
                        let (phi, gradient) = distance.sample(position[i] - moved);
                        *inverse = R::pack(1.0 / (-phi).clamp(floor, reach));
                        normal = zone.map_or(-gradient, |zone| zone.upright(-gradient, reach));
                    }
                    *frozen = Frozen::new(normal, zone, reach);
                }
            });
    }

    /// Signed distance to the wall \[m\] and its gradient, where the wall was when the distance was measured.
    pub fn distance(&self, x: DVec3) -> (f64, DVec3) {
        self.wall_distance.sample(x)
    }

    /// Fills the records that most loops read with the volumes and the scalars of `last`, for a particle each.
    pub(crate) fn fill_current(&mut self, last: impl Fn(&FluidState, usize) -> [f64; 2] + Sync) {
        let (state, frame, set) = (&self.state, &self.frame, &self.set);
        self.current.resize(state.len());
        self.current.fill(|i| {
            let (fixed, x, v) = (set.get(i), frame.in_supports(state.position[i]), state.velocity[i]);
            let [volume, scalar] = last(state, i);
            [
                R::coordinate(fixed[0], x[0]),
                R::coordinate(fixed[1], x[1]),
                R::coordinate(fixed[2], x[2]),
                R::pack(volume),
                R::pack(v.x),
                R::pack(v.y),
                R::pack(v.z),
                R::pack(scalar),
            ]
        });
    }

    /// Acceleration of particle `i` by viscosity \[m/s^2\], as [`Self::viscosity`] has found it.
    pub fn viscous_acceleration(&self, i: usize) -> DVec3 {
        self.columns.acceleration(i)
    }

    /// Pressure of particle `i` \[Pa\] relative to the reference pressure, the mean over the last advective step.
    pub fn pressure(&self, i: usize) -> f64 {
        self.state.pressure[i]
    }

    /// Pressure of particle `i` \[Pa\] relative to the reference pressure, as its density is at this acoustic step.
    pub fn acoustic_pressure(&self, i: usize) -> f64 {
        self.numbers.pressure(self.state.density_change[i])
    }

    /// Missing kernel support `sum V (B_i + B_j) grad W` of particle `i` \[1/m\]: a boundary
    /// pressure `p_b` on the missing side accelerates it by `p_b / rho` times this.
    pub fn missing_support(&self, i: usize) -> DVec3 {
        self.columns.support(i)
    }

    /// Gives particle `i` a new velocity \[m/s\] after the kick of an acoustic step, with which it drifts to the end of it.
    pub fn set_velocity(&mut self, i: usize, velocity: DVec3) {
        self.state.velocity[i] = velocity;
        let record = &mut self.next.as_mut_slice()[i];
        record[4] = R::pack(velocity.x);
        record[5] = R::pack(velocity.y);
        record[6] = R::pack(velocity.z);
    }
}

/// First particle of a chunk.
pub(crate) fn first_of(chunk: usize) -> usize {
    chunk * CHUNK
}

/// Top of a value over particles, in chunks of fixed size so that threads cannot change it.
pub(crate) fn maximum(n: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|c| (first_of(c)..n.min(first_of(c + 1))).map(&value).fold(0.0, propagating_max))
        .reduce(|| 0.0, propagating_max)
}

/// Maximum that keeps a NaN, so that a broken run shows.
pub(crate) fn propagating_max(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// A chunk of rows with its first particle, as sweeps take it.
pub(crate) fn numbered(chunk: &RowChunk, c: usize) -> (&RowChunk, usize) {
    (chunk, first_of(c))
}
