//! `particles.json` and `compare.json`: what was made, how good it is and what it cost.

use crate::check::{OpeningEntry, SurfaceReport};
use crate::json;
use crate::summary::ParticleCounts;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// `particles.json`: the outcome of `vaso particles`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ParticlesReport {
    /// Version of the program.
    pub vaso_version: String,
    /// Title of the case.
    pub case: String,
    /// Generator of the fluid, as `--compare` names it: `relaxed-lattice`, `multiblock`.
    pub generator: String,
    /// Particle spacing \[m\].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// Seed of everything random.
    #[serde(default)]
    pub seed: u64,
    /// The geometry audit.
    pub surface: SurfaceReport,
    /// Openings, largest first.
    pub openings: Vec<OpeningEntry>,
    /// Particles of each body.
    pub particles: ParticleCounts,
    /// Quality by body name (`fluid`, `wall`, `shell`).
    pub quality: BTreeMap<String, Quality>,
    /// What became of the blocks, where there are any.
    #[serde(default)]
    pub blocks: Option<Blocks>,
    /// The wall, where one was made.
    #[serde(default)]
    pub wall: Option<WallReport>,
    /// The shell, where one was made.
    #[serde(default)]
    pub shell: Option<ShellReport>,
    /// The outer surface, where it was asked for.
    #[serde(default)]
    pub extrusion: Option<Extrusion>,
    /// Advice.
    #[serde(default)]
    pub warnings: Vec<String>,
}

/// Quality of one generated body; lengths in particle spacings.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Quality {
    /// Number of particles.
    pub count: u64,
    /// Sum of particle volumes over the volume they stand for, minus one \[-\]; of a shell the same of areas.
    #[serde(deserialize_with = "json::number")]
    pub volume_error: f64,
    /// Smallest distance between two particles \[spacings\].
    #[serde(deserialize_with = "json::number")]
    pub nearest_neighbor_min: f64,
    /// Standard deviation over mean of the distance to the nearest particle \[-\].
    #[serde(deserialize_with = "json::number")]
    pub nearest_neighbor_cv: f64,
    /// Mean of the kernel sum over particles with full support \[-\]; `None` where no particle has it.
    pub kernel_sum_mean: Option<f64>,
    /// Standard deviation of the kernel sum \[-\].
    pub kernel_sum_std: Option<f64>,
    /// Root mean square of the kernel gradient sum, times the smoothing length \[-\].
    #[serde(deserialize_with = "json::number")]
    pub gradient_residual_rms: f64,
    /// Standard deviation over mean of the particle volumes \[-\].
    #[serde(deserialize_with = "json::number")]
    pub volume_cv: f64,
    /// Particles on the wrong side of the surface.
    pub outside: u64,
    /// Wall time of the generation \[s\], also where its result was found in the cache.
    pub seconds: Option<f64>,
    /// Relaxation iterations.
    pub iterations: u64,
    /// Whether the relaxation ended by itself; `None` where there is nothing to tell.
    #[serde(default)]
    pub converged: Option<bool>,
}

/// What became of the blocks of a vessel.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Blocks {
    /// Arrangement in a section: `single`, `nine-block` or `o-grid`.
    pub topology: String,
    /// Sweeps of elliptic smoothing.
    pub smoothing_sweeps: u64,
    /// Blocks.
    pub blocks: u64,
    /// Cells, of which each is a particle.
    pub cells: u64,
    /// Smallest cell volume over the mean \[-\].
    #[serde(deserialize_with = "json::number")]
    pub smallest_cell: f64,
    /// Points of the wall that projection missed and that were placed by the rays of their section.
    pub missed_projections: u64,
    /// Particles moved off the centroid of their cell because another was too close.
    pub pushed_particles: u64,
    /// Junctions filled by blocks.
    pub blocked_junctions: u64,
    /// Junctions left to the lattice, and why.
    pub unblocked_junctions: Vec<String>,
    /// Particles of the lattice between blocks.
    pub lattice_particles: u64,
    /// Share of the volume that the lattice fills \[-\].
    #[serde(deserialize_with = "json::number")]
    pub lattice_share: f64,
}

/// A wall of several layers.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct WallReport {
    /// Thickness \[m\].
    #[serde(deserialize_with = "json::number")]
    pub thickness_m: f64,
    /// Where it ends at the openings: `closest-cap`, `boxes` or `collar`.
    pub open_ends: String,
    /// Particles of the rings held at the openings.
    pub clamped: u64,
    /// Share of the wall that belongs to two parts of the vessel at once \[-\].
    #[serde(deserialize_with = "json::number")]
    pub shared: f64,
}

/// A wall of one layer.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ShellReport {
    /// Thickness \[m\].
    #[serde(deserialize_with = "json::number")]
    pub thickness_m: f64,
    /// Surface the particles stand on: `lumen` or `mid-surface`.
    pub reference: String,
    /// Where it ends at the openings: `closest-cap` or `collar`.
    pub open_ends: String,
    /// Sum of the areas of the particles where they stand \[m^2\].
    #[serde(deserialize_with = "json::number")]
    pub area_m2: f64,
    /// Area of the wall of the lumen, caps left out \[m^2\].
    #[serde(deserialize_with = "json::number")]
    pub wall_area_m2: f64,
    /// Largest distance from the lumen surface, of a mid-surface that of the feet, over the diagonal of its box \[-\].
    #[serde(deserialize_with = "json::number")]
    pub surface_distance_max: f64,
    /// Particles of a mid-surface where the wall folds onto itself.
    pub folded: u64,
    /// Particles of the rings held at the openings.
    pub clamped: u64,
}

/// The outer surface of the wall, and where it cuts itself.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Extrusion {
    /// The STL file, in the unit of the surface.
    pub file: String,
    /// How far the surface was moved outwards \[m\].
    #[serde(deserialize_with = "json::number")]
    pub distance_m: f64,
    /// Enclosed volume \[m^3\].
    #[serde(deserialize_with = "json::number")]
    pub volume_m3: f64,
    /// Whether it neither cuts itself nor has triangles turned over.
    pub sound: bool,
    /// Pairs of triangles that cut each other.
    pub intersections: u64,
    /// The connected places at which they lie, those with most pairs first.
    pub places: Vec<IntersectionEntry>,
    /// Triangles turned over: the distance exceeds a radius of curvature.
    pub flipped_triangles: u64,
    /// Vertices at edges so sharp that they were moved less far than the faces around them need.
    pub limited_vertices: u64,
}

/// A place at which a surface cuts itself.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct IntersectionEntry {
    /// Mean of the centres of the triangles \[m\].
    #[serde(deserialize_with = "json::vector")]
    pub center_m: [f64; 3],
    /// Largest distance of such a centre from the mean \[m\].
    #[serde(deserialize_with = "json::number")]
    pub radius_m: f64,
    /// Pairs of triangles that cut each other here.
    pub pairs: u64,
}

/// `compare.json`: generators of fluid particles side by side.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct CompareReport {
    /// Version of the program.
    pub vaso_version: String,
    /// Title of the case.
    pub case: String,
    /// Particle spacing \[m\].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// Worker threads the seconds were taken with.
    pub threads: u64,
    /// The geometry audit.
    pub surface: SurfaceReport,
    /// The generators in the order they were asked for.
    pub generators: Vec<ComparedGenerator>,
}

/// One generator of a comparison.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ComparedGenerator {
    /// As it was asked for, such as `multiblock:o-grid`.
    pub name: String,
    /// Quality and cost.
    pub quality: Quality,
    /// What became of the blocks, where there are any.
    pub blocks: Option<Blocks>,
    /// Distances to the nearest neighbour \[spacings\].
    pub nearest_neighbor: Histogram,
    /// Particle volumes \[cubed spacings\].
    pub volume: Histogram,
}

/// How often values fall into bins of one width.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Histogram {
    /// Lower end of the first bin.
    #[serde(deserialize_with = "json::number")]
    pub low: f64,
    /// Width of a bin.
    #[serde(deserialize_with = "json::number")]
    pub width: f64,
    /// Values in each bin; the first and the last also count what lies beyond them.
    pub counts: Vec<u64>,
}

impl Histogram {
    /// Counts `values` into `bins` bins between `low` and `high`.
    ///
    /// # Panics
    /// When there is no bin or `low` is not below `high`.
    pub fn of(values: impl IntoIterator<Item = f64>, low: f64, high: f64, bins: usize) -> Self {
        assert!(bins > 0 && low < high, "{bins} bins from {low} to {high}");
        let width = (high - low) / bins as f64;
        let mut counts = vec![0; bins];
        for value in values {
            // The cast saturates, so what lies below counts to the first bin.
            counts[(((value - low) / width) as usize).min(bins - 1)] += 1;
        }
        Self { low, width, counts }
    }
}

json::file!(ParticlesReport);
json::file!(CompareReport);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn histograms_count_everything() {
        let histogram = Histogram::of([-1.0, 0.0, 0.24, 0.25, 0.99, 1.0, 7.0], 0.0, 1.0, 4);
        assert_eq!(histogram, Histogram { low: 0.0, width: 0.25, counts: vec![3, 1, 0, 3] });
    }
}
