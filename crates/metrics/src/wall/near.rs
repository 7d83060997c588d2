//! Fluid particles near the wall, sorted for the search.

use glam::DVec3;
use rayon::prelude::*;
use vaso_geometry::SignedDistance;
use vaso_kernels::CellGrid;
use vaso_particles::WallDistance;

/// Distance to the wall that is exact near it and cheap elsewhere.
///
/// Interpolated distances are off by a few hundredths of a spacing, which in the first layer of particles is as much in per
/// cent of the wall shear stress; exact ones for all particles would cost more than the fit.
pub struct NearWallDistance<'a> {
    /// Distance everywhere, to tell which particles are near \[m\].
    pub coarse: &'a dyn WallDistance,
    /// Exact distance to the wall.
    pub exact: &'a SignedDistance,
    /// Distance up to which it is to be exact \[m\].
    pub reach: f64,
}

impl WallDistance for NearWallDistance<'_> {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        let coarse = self.coarse.sample(x);
        if coarse.0.abs() > self.reach {
            return coarse;
        }
        let nearest = self.exact.query(x);
        (nearest.distance, nearest.normal)
    }
}

/// A fluid particle near the wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearParticle {
    /// Position \[m\].
    pub(crate) position: DVec3,
    /// Distance from the wall \[m\], positive.
    pub(crate) depth: f64,
    /// Normal of the wall where it is nearest, out of the lumen.
    pub(crate) normal: DVec3,
    /// Velocity \[m/s\].
    pub(crate) velocity: DVec3,
    /// Number in the columns of the fluid.
    pub(crate) number: u32,
}

/// The particles within reach of the wall, in the order of a cell grid.
pub(crate) struct NearWall {
    grid: CellGrid,
    /// Positions by themselves, as most are looked at and passed over.
    position: Vec<DVec3>,
    particle: Vec<NearParticle>,
}

impl NearWall {
    /// Particles nearer to the wall than `reach` \[m\], to be searched within `reach`.
    pub(crate) fn new(
        position: &[DVec3],
        velocity: &[DVec3],
        distance: &dyn WallDistance,
        bounds: (DVec3, DVec3),
        reach: f64,
    ) -> Self {
        let unsorted: Vec<NearParticle> = (0..position.len())
            .into_par_iter()
            .with_min_len(1024)
            .filter_map(|i| {
                let (phi, normal) = distance.sample(position[i]);
                // A gradient of zero is that of a distance clamped beyond its band.
                let near = phi < 0.0 && phi > -reach && normal != DVec3::ZERO;
                near.then(|| NearParticle {
                    position: position[i],
                    depth: -phi,
                    normal,
                    velocity: velocity[i],
                    number: i as u32,
                })
            })
            .collect();
        let mut grid = CellGrid::new((bounds.0 - reach, bounds.1 + reach), reach);
        let mut order = Vec::new();
        let places: Vec<DVec3> = unsorted.iter().map(|p| p.position).collect();
        grid.sort(&places, &mut order);
        let particle: Vec<NearParticle> = order.iter().map(|&old| unsorted[old as usize]).collect();
        Self { grid, position: particle.iter().map(|p| p.position).collect(), particle }
    }

    /// Particles nearer to `x` than `support` \[m\], which must not exceed the reach, each with its squared distance \[m^2\].
    #[inline]
    pub(crate) fn within(&self, x: DVec3, support: f64) -> impl Iterator<Item = (&NearParticle, f64)> {
        let runs = self.grid.runs(x).into_iter();
        runs.flat_map(|(begin, end)| self.position[begin..end].iter().zip(&self.particle[begin..end]))
            .filter_map(move |(position, particle)| {
                let squared = position.distance_squared(x);
                (squared < support * support).then_some((particle, squared))
            })
    }
}
