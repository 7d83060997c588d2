//! Ghost columns: what one layer of particles shows the fluid behind the face of the lumen.

use crate::ownership::Owners;
use glam::DVec3;
use rayon::prelude::*;
use vaso_particles::{WallLoad, WallView};

/// The place of the lumen face that a column of ghosts stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Foot {
    /// Point of the face \[m\].
    pub position: DVec3,
    /// Its velocity \[m/s\].
    pub velocity: DVec3,
    /// Unit normal, away from the lumen.
    pub normal: DVec3,
    /// Rate of the normal, across it \[1/s\].
    pub turning: DVec3,
    /// Area of the face \[m^2\].
    pub area: f64,
    /// Strain of the area since the reference configuration. Where it grows ghosts come nearer to the face, see
    /// [`GhostColumns`].
    pub area_strain: f64,
    /// Its rate \[1/s\].
    pub area_strain_rate: f64,
    /// Principal curvatures of the face \[1/m\], positive where normals spread: `1/R` and zero on a tube seen from inside.
    pub curvature: [f64; 2],
}

/// Ghosts on columns behind the lumen face, at the heights `z_k = (k + 1/2) dp` along the normals, of the volumes
/// `A dp (1 + k1 z)(1 + k2 z)`, `dp` being the spacing of the fluid. With whole heights, the first on the face, the kernel sum would be
/// more than twice that of a lattice.
///
/// A ghost at the height `z` moves with the face and its normal, and by `-z/2` times the area strain along the normal: half of what a
/// wall would that keeps its volume. With it the volume that a tube sweeps and the load it gets are right to second order in the
/// spacing, where both are too large by `0.104 H/R` without it, and too small by as much with all of it (`docs/theory/coupling.md`).
///
/// Which ghosts there are is decided once, where the columns stand in the beginning: those within the reach of the kernel, as far as no
/// other column has a better claim to the place. At a crease that is narrow outside of the lumen, such as a flow divider, columns of
/// both sides meet: there each point of the wall belongs to the face nearest to it, and what would stand in the lumen of the other
/// side is left out. The last ghost of such a column stands for less than a spacing.
pub struct GhostColumns {
    feet: Vec<Foot>,
    /// First ghost of each column, one more than there are columns.
    start: Vec<u32>,
    /// Column of each ghost.
    column: Vec<u32>,
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    depth: Vec<f64>,
    /// Length of its column that each ghost stands for \[m\].
    length: Vec<f64>,
    volume: Vec<f64>,
}

/// Share of the thinning of a wall that keeps its volume which ghosts follow.
const THINNING: f64 = 0.5;
/// Parts of a spacing that a column is cut off by.
const PARTS: u32 = 8;

impl GhostColumns {
    /// Columns on `feet` for a fluid of a `spacing` \[m\] whose kernel reaches as far as `support` \[m\].
    ///
    /// Feet should stand no farther apart than the particles of the fluid, which would see gaps between the columns.
    pub fn new(feet: Vec<Foot>, spacing: f64, support: f64) -> Self {
        let owners = Owners::new(&feet, spacing, support);
        // Ghosts in reach, whole spacings each.
        let ghosts = (support / spacing + 0.5).ceil() as u32 - 1;
        let part = spacing / f64::from(PARTS);
        let whole = |c: usize| {
            let stands = |k: &u32| {
                let z = (f64::from(*k) + 0.5) * part;
                feet[c].curvature.iter().all(|k| 1.0 + k * z > 0.0) && owners.owns(c, z)
            };
            (0..ghosts * PARTS).take_while(stands).count() as u32
        };
        let parts: Vec<u32> = (0..feet.len()).into_par_iter().map(whole).collect();
        let mut columns = Self {
            start: vec![0],
            column: Vec::new(),
            position: Vec::new(),
            velocity: Vec::new(),
            depth: Vec::new(),
            length: Vec::new(),
            volume: Vec::new(),
            feet: Vec::new(),
        };
        for (c, parts) in parts.into_iter().enumerate() {
            for k in 0..parts.div_ceil(PARTS) {
                let length = f64::from((parts - k * PARTS).min(PARTS)) * part;
                columns.column.push(c as u32);
                columns.length.push(length);
                columns.depth.push(f64::from(k) * spacing + 0.5 * length);
            }
            columns.start.push(columns.depth.len() as u32);
        }
        let n = columns.depth.len();
        columns.position.resize(n, DVec3::ZERO);
        columns.velocity.resize(n, DVec3::ZERO);
        columns.volume.resize(n, 0.0);
        columns.feet = feet;
        columns.stand();
        columns
    }

    /// Moves the columns to where `foot` says that each stands now.
    pub fn follow(&mut self, foot: impl Fn(usize) -> Foot + Sync) {
        self.feet.par_iter_mut().enumerate().with_min_len(1024).for_each(|(c, own)| *own = foot(c));
        self.stand();
    }

    fn stand(&mut self) {
        let feet = &self.feet;
        let fixed = (&self.column, &self.depth, &self.length);
        (&mut self.position, &mut self.velocity, &mut self.volume, fixed.0, fixed.1, fixed.2)
            .into_par_iter()
            .with_min_len(1024)
            .for_each(|(x, v, volume, c, &z, length)| {
                let foot = &feet[*c as usize];
                let height = z * (1.0 - THINNING * foot.area_strain);
                *x = foot.position + height * foot.normal;
                *v = foot.velocity + height * foot.turning
                    - THINNING * z * foot.area_strain_rate * foot.normal;
                // A wall that is bent beyond a centre of curvature has nothing there.
                let [s1, s2] = foot.curvature.map(|k| (1.0 + k * z).max(0.0));
                *volume = foot.area * length * s1 * s2;
            });
    }

    /// The ghosts as the fluid sees them, column by column.
    pub fn view(&self) -> WallView<'_> {
        WallView {
            position: &self.position,
            velocity: &self.velocity,
            depth: &self.depth,
            volume: &self.volume,
        }
    }

    /// Adds up the forces on the ghosts of each column \[N\]: what the fluid loses, all columns together get. `spread` \[J\] becomes
    /// the work that the forces of a column do on an area strain of one, with the foot where it is.
    ///
    /// # Panics
    /// If the load is not one of this view.
    pub fn gather(
        &self,
        load: &WallLoad,
        pressure_force: &mut [DVec3],
        viscous_force: &mut [DVec3],
        spread: &mut [f64],
    ) {
        assert!(load.pressure_force.len() == self.depth.len(), "the load of the ghosts");
        (pressure_force, viscous_force, spread).into_par_iter().enumerate().with_min_len(1024).for_each(
            |(c, (p, v, spread))| {
                let range = self.start[c] as usize..self.start[c + 1] as usize;
                *p = load.pressure_force[range.clone()].iter().sum();
                *v = load.viscous_force[range.clone()].iter().sum();
                let lever: DVec3 =
                    range.map(|k| self.depth[k] * (load.pressure_force[k] + load.viscous_force[k])).sum();
                *spread = -THINNING * self.feet[c].normal.dot(lever);
            },
        );
    }

    /// Column of each ghost.
    pub fn column(&self) -> &[u32] {
        &self.column
    }

    /// Feet of the columns, where they stand now.
    pub fn feet(&self) -> &[Foot] {
        &self.feet
    }

    /// Number of columns.
    pub fn len(&self) -> usize {
        self.feet.len()
    }

    /// Whether there are no columns.
    pub fn is_empty(&self) -> bool {
        self.feet.is_empty()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of::<Foot>() * self.feet.capacity()
            + 4 * (self.start.capacity() + self.column.capacity())
            + size_of::<DVec3>() * (self.position.capacity() + self.velocity.capacity())
            + 8 * (self.depth.capacity() + self.length.capacity() + self.volume.capacity())
    }
}
