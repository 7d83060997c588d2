//! How good the particles of a shell are.

use crate::quality::Statistics;
use crate::shell::{
    relax::{Listed, SheetRelaxation},
    sheet::{Foot, same_sheet},
};
use serde::{Deserialize, Serialize};

/// Quality of the particles of a shell, measured on the lumen surface; lengths in spacings.
///
/// Neighbours are those on the same sheet: the other side of a thin gap does not count.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShellQuality {
    /// Number of particles.
    pub count: usize,
    /// Relative difference of the sum of the particle areas on the lumen surface from the area of the wall.
    pub area_error: f64,
    /// Smallest distance between two particles, in spacings.
    pub nearest_neighbor_min: f64,
    /// Coefficient of variation of the distance to the nearest neighbour.
    pub nearest_neighbor_cv: f64,
    /// Mean of the kernel sum `sum A W` of the plane kernel, own term included, over the particles more than
    /// a kernel support (2h) from every rim, relative to that of the square lattice of the same spacing.
    /// `None` where no particle is that far from a rim.
    pub kernel_sum_mean: Option<f64>,
    /// Standard deviation of that kernel sum, relative to that of the square lattice.
    pub kernel_sum_std: Option<f64>,
    /// Root mean square of `h |G|` over all particles, G the tangential kernel gradient sum completed by
    /// what a rim cuts off.
    pub gradient_residual_rms: f64,
    /// Largest distance of a particle, or of its foot for a mid-surface, from the lumen surface over the
    /// diagonal of its box.
    pub surface_distance_max: f64,
    /// Particles of a mid-surface where the wall is thinner than asked for, since it would fold onto itself.
    pub folded: usize,
    /// Wall-clock time of the generation \[s\], where the caller has measured it.
    pub seconds: Option<f64>,
    /// Relaxation steps made.
    pub iterations: usize,
}

/// What one particle adds to the report.
struct Sample {
    nearest: f64,
    residual: f64,
    /// Kernel sum, for particles far from the rims.
    kernel_sum: Option<f64>,
}

impl ShellQuality {
    /// Measures relaxed particles on a sheet of area `area` \[m^2\]; `folded` and `iterations` are left at
    /// zero.
    pub(crate) fn measure(
        relaxation: &SheetRelaxation<'_>,
        listed: &Listed,
        particles: &[Foot],
        area: f64,
    ) -> Self {
        let SheetRelaxation { sheet, kernel, spacing, area: share } = *relaxation;
        let lattice_sum = kernel.lattice_sum(spacing);
        let samples = listed.map(|i, row| {
            let own = &particles[i];
            let seen = || {
                let others = row.iter().map(|&j| &particles[j as usize]);
                others.filter(|o| same_sheet(own.normal, o.normal)).map(|o| o.point.distance(own.point))
            };
            let sum = || kernel.value(0.0) + seen().map(|r| kernel.value(r)).sum::<f64>();
            Sample {
                nearest: seen().fold(kernel.support(), f64::min) / spacing,
                residual: kernel.h() * relaxation.residual(own, row, particles, listed.near_rim(i)).length(),
                kernel_sum: (!listed.near_rim(i)).then(|| share * sum() / lattice_sum),
            }
        });
        let nearest = Statistics::of(samples.iter().map(|s| s.nearest));
        let kernel_sum = Statistics::of(samples.iter().filter_map(|s| s.kernel_sum));
        let residual = Statistics::of(samples.iter().map(|s| s.residual * s.residual));
        let points: Vec<_> = particles.iter().map(|foot| foot.point).collect();
        let (low, high) = sheet.bounds();
        Self {
            count: particles.len(),
            area_error: particles.iter().map(|_| share).sum::<f64>() / area - 1.0,
            nearest_neighbor_min: nearest.least,
            nearest_neighbor_cv: nearest.deviation() / nearest.mean(),
            kernel_sum_mean: (kernel_sum.n > 0).then(|| kernel_sum.mean()),
            kernel_sum_std: (kernel_sum.n > 0).then(|| kernel_sum.deviation()),
            gradient_residual_rms: residual.mean().sqrt(),
            surface_distance_max: sheet.largest_distance(&points) / low.distance(high),
            folded: 0,
            seconds: None,
            iterations: 0,
        }
    }
}
