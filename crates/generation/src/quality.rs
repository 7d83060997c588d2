//! How good a set of particles is.

use crate::neighbors::{CHUNK, Neighbors};
use crate::region::Region;
use crate::relax::Relaxation;
use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Quality of the particles of one body; lengths in spacings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quality {
    /// Number of particles.
    pub count: usize,
    /// Of a relaxed body, the relative difference of `count spacing^3` from the volume of the region; the particle
    /// volume is the region volume over `count`, so the volumes used by a solver add up without this error. Of a
    /// multiblock body, that of the sum of the cells.
    pub volume_error: f64,
    /// Smallest distance between two particles, in spacings.
    pub nearest_neighbor_min: f64,
    /// Coefficient of variation of the distance to the nearest neighbour.
    pub nearest_neighbor_cv: f64,
    /// Mean of the kernel sum `sum V W`, own term included, over the particles more than a kernel
    /// support (2h) from every face, relative to the sum S0 of the cubic lattice of the same spacing,
    /// which is what a solver measures density against. `None` where no particle is that far inside,
    /// as in a wall.
    pub kernel_sum_mean: Option<f64>,
    /// Standard deviation of that kernel sum, relative to S0.
    pub kernel_sum_std: Option<f64>,
    /// Root mean square of `h |G|` over all particles, G the kernel gradient sum completed by what the
    /// faces cut off: beyond them particles are taken to stand in layers as they do inside.
    pub gradient_residual_rms: f64,
    /// Coefficient of variation of the particle volumes: zero up to rounding where all are equal, as of a relaxed body.
    pub volume_cv: f64,
    /// Particles outside their region: fluid outside the closed surface, wall inside the lumen.
    pub outside: usize,
    /// Wall-clock time of the generation \[s\], where the caller has measured it.
    pub seconds: Option<f64>,
    /// Relaxation steps made.
    pub iterations: usize,
    /// Whether the relaxation ended by itself: with the particles at rest (mean displacement in a step below
    /// a thousandth of the spacing), or with a residual that falls no more. Otherwise it was cut off at the
    /// most steps allowed.
    pub converged: bool,
}

/// What one particle adds to the report.
struct Sample {
    nearest: f64,
    residual: f64,
    /// Kernel sum, for particles deep inside.
    kernel_sum: Option<f64>,
}

impl Quality {
    /// Measures particles in the region of `relaxation`, of volume `region_volume` \[m^3\]; puts them and their
    /// volumes \[m^3\] in the order of the search grid. `outside` and `iterations` are left at zero, `converged`
    /// at false.
    pub(crate) fn measure<R: Region>(
        relaxation: &Relaxation<'_, R>,
        position: &mut Vec<DVec3>,
        volume: &mut Vec<f64>,
        region_volume: f64,
    ) -> Self {
        let Relaxation { region, kernel, spacing, .. } = *relaxation;
        let mut neighbors = Neighbors::new(region.bounds(), kernel.support());
        *volume = neighbors.rebuild(position).iter().map(|&k| volume[k as usize]).collect();
        let (position, volume) = (&*position, &*volume);
        let lattice_sum = kernel.lattice_sum(spacing);
        let sample = |i: usize, row: &[u32]| {
            let x = position[i];
            let distance = |&j: &u32| position[j as usize].distance(x);
            let faces = region.exact_faces(x);
            let deep = faces.clearance() > kernel.support();
            let push = |&j: &u32| {
                let d = x - position[j as usize];
                volume[j as usize] * kernel.derivative(d.length()) * d.normalize_or_zero()
            };
            let gradient = row.iter().map(push).sum::<DVec3>() + relaxation.missing_gradient(&faces);
            let weight = |j: &u32| volume[*j as usize] * kernel.value(distance(j));
            let sum = || volume[i] * kernel.value(0.0) + row.iter().map(weight).sum::<f64>();
            Sample {
                nearest: row.iter().map(distance).fold(kernel.support(), f64::min) / spacing,
                residual: kernel.h * gradient.length(),
                kernel_sum: deep.then(|| sum() / lattice_sum),
            }
        };
        let samples: Vec<Sample> = neighbors
            .chunks()
            .par_iter()
            .enumerate()
            .flat_map_iter(|(c, chunk)| {
                chunk.rows().enumerate().map(|(k, row)| sample(c * CHUNK + k, row)).collect::<Vec<_>>()
            })
            .collect();
        let nearest = Statistics::of(samples.iter().map(|s| s.nearest));
        let kernel_sum = Statistics::of(samples.iter().filter_map(|s| s.kernel_sum));
        let residual = Statistics::of(samples.iter().map(|s| s.residual * s.residual));
        let mean_volume = volume.iter().sum::<f64>() / volume.len() as f64;
        // About the mean, as the difference of squares leaves a spread where there is none.
        let spread =
            volume.iter().map(|v| (v / mean_volume - 1.0).powi(2)).sum::<f64>() / volume.len() as f64;
        let has_bulk = kernel_sum.n > 0;
        Self {
            count: position.len(),
            volume_error: position.len() as f64 * spacing.powi(3) / region_volume - 1.0,
            nearest_neighbor_min: nearest.least,
            nearest_neighbor_cv: nearest.deviation() / nearest.mean(),
            kernel_sum_mean: has_bulk.then(|| kernel_sum.mean()),
            kernel_sum_std: has_bulk.then(|| kernel_sum.deviation()),
            gradient_residual_rms: residual.mean().sqrt(),
            volume_cv: spread.sqrt(),
            outside: 0,
            seconds: None,
            iterations: 0,
            converged: false,
        }
    }
}

/// Running sums of a sample.
pub(crate) struct Statistics {
    pub(crate) n: usize,
    sum: f64,
    square: f64,
    pub(crate) least: f64,
}

impl Statistics {
    pub(crate) fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut s = Self { n: 0, sum: 0.0, square: 0.0, least: f64::INFINITY };
        for value in values {
            s.n += 1;
            s.sum += value;
            s.square += value * value;
            s.least = s.least.min(value);
        }
        s
    }

    pub(crate) fn mean(&self) -> f64 {
        self.sum / self.n as f64
    }

    pub(crate) fn deviation(&self) -> f64 {
        (self.square / self.n as f64 - self.mean().powi(2)).max(0.0).sqrt()
    }
}
