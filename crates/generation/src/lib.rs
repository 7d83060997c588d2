#![doc = include_str!("../README.md")]

mod ends;
mod error;
mod extended;
mod faces;
mod frame;
mod lattice;
mod lumen;
pub mod multiblock;
mod neighbors;
mod quality;
mod random;
mod region;
mod relax;
mod shell;
mod wall;

pub use ends::Ends;
pub use error::{GenerationError, Warning, warnings};
pub use lattice::Lattice;
pub use quality::Quality;
pub use shell::{Allotment, ShellBody, ShellQuality, ShellReference, ShellSettings, shell};
pub use wall::{WALL_LAYERS, Wall, rigid_wall, wall};

use frame::Frame;
use glam::DVec3;
use rayon::prelude::*;
use region::Region;
use relax::Relaxation;
use vaso_geometry::{SignedDistance, Vessel};
use vaso_kernels::Wendland;

/// How particles are made.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Distance between particles dp \[m\].
    pub spacing: f64,
    /// Smoothing length over spacing h/dp, 1 to 2.
    pub smoothing: f64,
    /// Lattice the relaxation starts from.
    pub lattice: Lattice,
    /// Most relaxation steps.
    pub steps: usize,
    /// Seed of the random start displacement.
    pub seed: u64,
}

impl Settings {
    /// The usual settings for a `spacing` \[m\]: cubic lattice, h = 1.3 dp, 200 steps.
    pub fn new(spacing: f64) -> Self {
        Self { spacing, smoothing: 1.3, lattice: Lattice::Cubic, steps: 200, seed: 0 }
    }

    /// Smoothing length h \[m\].
    fn smoothing_length(&self) -> f64 {
        self.smoothing * self.spacing
    }
}

/// Particles of one body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Positions \[m\], neighbours near each other in memory.
    pub position: Vec<DVec3>,
    /// Volume of each particle \[m^3\]: the same for all of a relaxed body, that of its cell in a
    /// multiblock one.
    pub volume: Vec<f64>,
    /// Of a wall: unit normal away from the lumen; empty for a fluid.
    pub normal: Vec<DVec3>,
    /// Of a wall: distance outside the lumen surface \[m\], beyond a cap that from the cap drawn out
    /// straight; empty for a fluid.
    pub depth: Vec<f64>,
    /// How good the set is.
    pub quality: Quality,
}

/// Fills the lumen of `vessel` with relaxed particles.
///
/// The volumes add up to that of the closed surface. `progress` is told the relaxation step and the
/// mean displacement in spacings.
///
/// # Errors
/// A setting out of range, or a spacing too coarse or too fine for the vessel.
pub fn fluid(
    vessel: &Vessel,
    settings: &Settings,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<Body, GenerationError> {
    error::check(vessel, settings)?;
    let volume = vessel.surface.volume();
    error::particle_count(volume, settings.spacing)?;
    let frame = Frame::of(vessel);
    let vessel = &frame.localize(vessel);
    let region = lumen::Lumen::new(vessel, settings.spacing, settings.smoothing_length());
    let mut body = fill(&region, volume, settings, progress)?;
    let closed = SignedDistance::closed(vessel);
    body.quality.outside = body.position.par_iter().filter(|x| closed.query(**x).distance >= 0.0).count();
    frame.restore(&mut body);
    Ok(body)
}

/// Fills a region of known volume with particles and relaxes them.
fn fill<R: Region>(
    region: &R,
    region_volume: f64,
    settings: &Settings,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<Body, GenerationError> {
    let &Settings { spacing, lattice, steps, seed, .. } = settings;
    let count = error::particle_count(region_volume, spacing)?;
    let mut position = lattice::deepest_sites(region, lattice, spacing, count)
        .ok_or(GenerationError::Empty { spacing, volume: region_volume })?;
    let kernel = Wendland::new(settings.smoothing_length());
    let volume = region_volume / count as f64;
    let relaxation = Relaxation { region, kernel, spacing, volume };
    let relaxed = relaxation.run(&mut position, steps, seed, progress);
    let mut volume = vec![volume; position.len()];
    let mut quality = Quality::measure(&relaxation, &mut position, &mut volume, region_volume);
    (quality.iterations, quality.converged) = (relaxed.iterations, relaxed.converged);
    Ok(Body { position, volume, normal: Vec::new(), depth: Vec::new(), quality })
}
