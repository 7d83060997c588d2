//! Particles by blocks: cells of the vessel's own coordinates, as even as its sections allow.
//!
//! Every branch is cut across its centreline into sections, the sections into blocks, and the blocks into cells
//! by transfinite interpolation; a particle sits in each cell. Where three branches meet, their sections fold
//! until they lie in three half planes with one line in common, so that the branches fill the junction between
//! them. What cannot be filled that way is left to the relaxed lattice, and said.

mod blocks;
mod fill;
mod hexahedron;
mod junction;
mod layers;
mod limb;
mod nodes;
mod outline;
mod section;
mod spread;
pub mod tfi;
mod topology;
mod tubes;
mod winslow;
mod zone;

pub use outline::Outline;
pub use topology::Topology;

use crate::error::{self, GenerationError};
use crate::frame::Frame;
use crate::lumen::Lumen;
use crate::quality::Quality;
use crate::relax::Relaxation;
use crate::{Body, Settings};
use blocks::Maker;
use fill::{Filling, Work};
use glam::DVec3;
use layers::Library;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use vaso_geometry::{Centerlines, SignedDistance, Vessel};
use vaso_kernels::Wendland;
use zone::Zone;

/// How far outside the surface a particle may be by rounding, in spacings: nodes lie on it.
const ROUNDING: f64 = 1e-6;

/// Where the particles of a cell are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// One in the centroid of each cell, with its volume. None is on the wall.
    #[default]
    Centers,
    /// One at each node, with an eighth of each cell around it; nodes of neighbouring blocks are merged.
    Nodes,
}

/// How blocks are laid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Arrangement of the blocks of a section.
    pub topology: Topology,
    /// Sweeps of elliptic smoothing of each section; without, blocks are filled from their six faces.
    pub smoothing_sweeps: usize,
    /// Where the particles are.
    pub place: Place,
}

/// What became of the blocks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Cells, of which each is a particle.
    pub cells: usize,
    /// Blocks.
    pub blocks: usize,
    /// Smallest cell volume over the mean.
    pub smallest_cell: f64,
    /// Points of the wall that projection missed and that were placed by the rays of their section.
    pub missed_projections: usize,
    /// Particles that were too close to another and moved off their cell's centroid.
    pub pushed_particles: usize,
    /// Junctions filled by blocks.
    pub blocked_junctions: usize,
    /// Junctions left to the lattice, and why.
    pub unblocked_junctions: Vec<String>,
    /// Particles of the lattice between blocks.
    pub lattice_particles: usize,
    /// Share of the volume that the lattice fills.
    pub lattice_share: f64,
}

/// Particles by blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct Multiblock {
    /// The particles.
    pub body: Body,
    /// How they came about.
    pub report: Report,
    /// Lines to draw.
    pub outline: Outline,
}

/// Fills the lumen of `vessel` with cells, and puts particles in their centroids or at their nodes.
///
/// `progress` hears of the relaxation of what blocks leave over, as with [`crate::fluid`].
///
/// # Errors
/// As for [`crate::fluid`].
pub fn fluid(
    vessel: &Vessel,
    settings: &Settings,
    options: &Options,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<Multiblock, GenerationError> {
    error::check(vessel, settings)?;
    error::particle_count(vessel.surface.volume(), settings.spacing)?;
    let frame = Frame::of(vessel);
    let vessel = &frame.localize(vessel);
    let wall = SignedDistance::wall(vessel);
    let maker = Maker { wall: &wall, spacing: settings.spacing, sweeps: options.smoothing_sweeps };
    let lines = Centerlines::trace(vessel).unwrap_or_default();
    let mut work = Work {
        vessel,
        frame: &frame,
        lines: &lines,
        maker,
        wireframes: Library::new(options.topology),
        report: Report::default(),
    };
    let (limbs, mut fillings) = work.fill();
    let mut report = work.report;
    let is_whole = !limbs.is_empty() && fillings.iter().all(|f| f.is_whole);
    if !is_whole {
        tubes::keep_apart(&limbs, &mut fillings, settings.spacing);
    }
    let cells = || fillings.iter().flat_map(Filling::layers).filter(|l| l.is_sound).flat_map(|l| &l.cells);
    report.cells = cells().count();
    let (mut position, mut volume): (Vec<DVec3>, Vec<f64>) = match options.place {
        Place::Centers => cells().map(|c| (c.centroid, c.volume)).unzip(),
        Place::Nodes => nodes::merged(&fillings, settings.spacing),
    };
    report.blocks = fillings.iter().flat_map(|f| &f.stretches).map(|s| s.blocks.len()).sum();
    report.missed_projections = fillings.iter().flat_map(|f| &f.stretches).map(|s| s.missed).sum();
    let lumen = Lumen::new(vessel, settings.spacing, settings.smoothing_length());
    let mut iterations = 0;
    if !is_whole {
        let zone = Zone { lumen: &lumen, blocks: tubes::tubes(&limbs, &fillings) };
        let left = vessel.surface.volume() - volume.iter().sum::<f64>();
        let (extra, steps) = zone::fill(&zone, left, &position, settings, progress)?;
        iterations = steps;
        report.lattice_particles = extra.len();
        report.lattice_share = left / vessel.surface.volume();
        volume.resize(position.len() + extra.len(), left / extra.len().max(1) as f64);
        position.extend(extra);
    }
    if options.place == Place::Centers {
        report.pushed_particles = spread::spread(&lumen, settings.spacing, &mut position, &mut volume);
    }
    let mean = volume.iter().sum::<f64>() / volume.len() as f64;
    report.smallest_cell = volume.iter().fold(f64::INFINITY, |a, b| a.min(*b)) / mean;
    let quality = quality(vessel, &lumen, settings, &mut position, &mut volume, iterations);
    let mut outline =
        Outline::of(limbs.iter().zip(&fillings).map(|(l, f)| (&l.route, f.stretches.as_slice())));
    outline.restore(&frame);
    let mut body = Body { position, volume, normal: Vec::new(), depth: Vec::new(), quality };
    frame.restore(&mut body);
    Ok(Multiblock { body, report, outline })
}

/// Measures the particles, which it puts in the order of the search grid.
fn quality(
    vessel: &Vessel,
    lumen: &Lumen<'_>,
    settings: &Settings,
    position: &mut Vec<DVec3>,
    volume: &mut Vec<f64>,
    iterations: usize,
) -> Quality {
    let kernel = Wendland::new(settings.smoothing * settings.spacing);
    let relaxation =
        Relaxation { region: lumen, kernel, spacing: settings.spacing, volume: settings.spacing.powi(3) };
    let mut quality = Quality::measure(&relaxation, position, volume, vessel.surface.volume());
    let (closed, outside) = (SignedDistance::closed(vessel), ROUNDING * settings.spacing);
    quality.outside = position.par_iter().filter(|x| closed.query(**x).distance >= outside).count();
    quality.volume_error = volume.iter().sum::<f64>() / vessel.surface.volume() - 1.0;
    quality.iterations = iterations;
    quality
}
