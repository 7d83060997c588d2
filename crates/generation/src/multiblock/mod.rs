//! Particles by blocks: cells of the vessel's own coordinates, as even as its sections allow.
//!
//! Every branch is cut across its centreline into sections, the sections into blocks, and the blocks into cells
//! by transfinite interpolation; a particle sits in each cell. Where three branches meet, their sections fold
//! until they lie in three half planes with one line in common, so that the branches fill the junction between
//! them. What cannot be filled that way is left to the relaxed lattice, and said.

mod blocks;
mod hexahedron;
mod junction;
mod layers;
mod limb;
mod outline;
mod section;
mod spread;
pub mod tfi;
mod topology;
mod winslow;
mod zone;

pub use outline::Outline;
pub use topology::Topology;

use crate::error::{self, GenerationError};
use crate::frame::Frame;
use crate::lumen::Lumen;
use crate::quality::Quality;
use crate::relax::Relaxation;
use crate::{Body, Settings, lattice};
use blocks::{Layer, Maker, Stretch};
use glam::DVec3;
use layers::Library;
use limb::{Hinge, Route};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use vaso_geometry::{BranchEnd, Centerlines, Curve, Opening, SignedDistance, Surface, Vessel};
use vaso_kernels::Wendland;
use zone::Zone;

/// Distances from the carina, in distances from the wall, at which blocks start at a junction without.
const CLEAR: f64 = 1.0;
/// Distance a cell keeps from the blocks of another limb, in spacings.
const APART: f64 = 0.4;
/// Fewest layers worth a block.
const FEWEST: usize = 2;

/// How blocks are laid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Arrangement of the blocks of a section.
    pub topology: Topology,
    /// Sweeps of elliptic smoothing of each section; without, blocks are filled from their six faces.
    pub smoothing_sweeps: usize,
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

/// A limb to be filled.
struct Limb<'a> {
    route: Route<'a>,
    /// Length along the route at which it starts \[m\].
    from: f64,
    hinge: Option<Hinge>,
    junctions: [Option<usize>; 2],
}

/// What a limb was filled with.
#[derive(Default)]
struct Filling {
    stretches: Vec<Stretch>,
    /// Whether its layers reach from end to end.
    is_whole: bool,
}

impl Filling {
    fn layers(&self) -> impl Iterator<Item = &Layer> {
        self.stretches.iter().flat_map(|s| &s.layers)
    }

    fn layers_mut(&mut self) -> impl Iterator<Item = &mut Layer> {
        self.stretches.iter_mut().flat_map(|s| &mut s.layers)
    }
}

/// Fills the lumen of `vessel` with cells and puts a particle at the centroid of each, with the volume of its
/// cell.
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
        library: Library::new(options.topology),
        report: Report::default(),
    };
    let (limbs, mut fillings) = work.fill();
    let mut report = work.report;
    let is_whole = !limbs.is_empty() && fillings.iter().all(|f| f.is_whole);
    if !is_whole {
        keep_apart(&limbs, &mut fillings, settings.spacing);
    }
    let cells = || fillings.iter().flat_map(Filling::layers).filter(|l| l.is_sound).flat_map(|l| &l.cells);
    let mut position: Vec<DVec3> = cells().map(|c| c.centroid).collect();
    let mut volume: Vec<f64> = cells().map(|c| c.volume).collect();
    report.cells = position.len();
    report.blocks = fillings.iter().flat_map(|f| &f.stretches).map(|s| s.blocks.len()).sum();
    report.missed_projections = fillings.iter().flat_map(|f| &f.stretches).map(|s| s.missed).sum();
    let mut iterations = 0;
    if !is_whole {
        let lumen = Lumen::new(vessel, settings.spacing, settings.smoothing_length());
        let zone = Zone { lumen: &lumen, blocks: tubes(&limbs, &fillings) };
        let left = vessel.surface.volume() - volume.iter().sum::<f64>();
        let (extra, steps) = fill_zone(&zone, left, &position, settings, progress)?;
        iterations = steps;
        report.lattice_particles = extra.len();
        report.lattice_share = left / vessel.surface.volume();
        volume.resize(position.len() + extra.len(), left / extra.len().max(1) as f64);
        position.extend(extra);
    }
    let lumen = Lumen::new(vessel, settings.spacing, settings.smoothing_length());
    report.pushed_particles = spread::spread(&lumen, settings.spacing, &mut position, &mut volume);
    let mean = volume.iter().sum::<f64>() / volume.len() as f64;
    report.smallest_cell = volume.iter().fold(f64::INFINITY, |a, b| a.min(*b)) / mean;
    let quality = quality(vessel, settings, &mut position, &mut volume, iterations);
    let outline = Outline::of(limbs.iter().zip(&fillings).map(|(l, f)| (&l.route, f.stretches.as_slice())));
    Ok(Multiblock {
        body: Body { position, volume, normal: Vec::new(), depth: Vec::new(), quality },
        report,
        outline,
    })
}

/// Measures the particles, which it puts in the order of the search grid.
fn quality(
    vessel: &Vessel,
    settings: &Settings,
    position: &mut Vec<DVec3>,
    volume: &mut Vec<f64>,
    iterations: usize,
) -> Quality {
    let region = Lumen::new(vessel, settings.spacing, settings.smoothing_length());
    let kernel = Wendland::new(settings.smoothing * settings.spacing);
    let mean = volume.iter().sum::<f64>() / volume.len() as f64;
    let spread = (volume.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / volume.len() as f64).sqrt() / mean;
    let relaxation = Relaxation { region: &region, kernel, spacing: settings.spacing, volume: mean };
    let mut order = position.clone();
    let mut quality = Quality::measure(&relaxation, &mut order, vessel.surface.volume());
    let closed = SignedDistance::closed(vessel);
    quality.outside = position.par_iter().filter(|x| closed.query(**x).distance >= 0.0).count();
    quality.volume_error = volume.iter().sum::<f64>() / vessel.surface.volume() - 1.0;
    quality.volume_cv = spread;
    quality.iterations = iterations;
    quality
}

/// Fills what blocks left over, `volume` \[m^3\], with particles relaxed among theirs.
fn fill_zone(
    zone: &Zone<'_>,
    volume: f64,
    blocks: &[DVec3],
    settings: &Settings,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<(Vec<DVec3>, usize), GenerationError> {
    let &Settings { spacing, smoothing, lattice, steps, seed } = settings;
    let count = (volume / spacing.powi(3)).round().max(0.0) as usize;
    if count == 0 {
        return Ok((Vec::new(), 0));
    }
    let mut position = lattice::deepest_sites(zone, lattice, spacing, count)
        .ok_or(GenerationError::Empty { spacing, volume })?;
    let kernel = Wendland::new(smoothing * spacing);
    // Blocks deeper than this below their surface are out of reach.
    let reach = 2.0 * kernel.support();
    let fixed: Vec<DVec3> = blocks.par_iter().copied().filter(|x| zone.outside_blocks(*x) > -reach).collect();
    let relaxation = Relaxation { region: zone, kernel, spacing, volume: volume / count as f64 };
    let made = relaxation.run_among(&mut position, &fixed, steps, seed, progress);
    Ok((position, made.iterations))
}

/// Gives up layers that reach into the blocks of another limb.
fn keep_apart(limbs: &[Limb<'_>], fillings: &mut [Filling], spacing: f64) {
    for k in 0..limbs.len() {
        if limbs[k].hinge.is_some() {
            continue;
        }
        let others = (0..limbs.len()).filter(|&m| m != k);
        let mut surface = Surface { vertices: Vec::new(), triangles: Vec::new() };
        for m in others {
            add_tubes(&mut surface, &limbs[m], &fillings[m]);
        }
        if surface.triangles.is_empty() {
            continue;
        }
        let distance = SignedDistance::of(&surface);
        for layer in fillings[k].layers_mut() {
            layer.is_sound &=
                layer.cells.iter().all(|c| distance.query(c.centroid).distance > APART * spacing);
        }
    }
}

/// Distance to all blocks; `None` where there are none.
fn tubes(limbs: &[Limb<'_>], fillings: &[Filling]) -> Option<SignedDistance> {
    let mut surface = Surface { vertices: Vec::new(), triangles: Vec::new() };
    for (limb, filling) in limbs.iter().zip(fillings) {
        add_tubes(&mut surface, limb, filling);
    }
    (!surface.triangles.is_empty()).then(|| SignedDistance::of(&surface))
}

/// Adds the closed tubes that the sound layers of a limb fill.
fn add_tubes(surface: &mut Surface, limb: &Limb<'_>, filling: &Filling) {
    let mut arcs: Vec<Vec<f64>> = Vec::new();
    let mut end = f64::NAN;
    for layer in filling.layers().filter(|l| l.is_sound) {
        if layer.arc[0] != end {
            arcs.push(vec![layer.arc[0]]);
        }
        end = layer.arc[1];
        if let Some(open) = arcs.last_mut() {
            open.push(end);
        }
    }
    for arcs in arcs {
        let sections: Option<Vec<_>> = arcs.iter().map(|arc| limb.route.section(*arc)).collect();
        // Layers exist only between sections that do.
        let Some(sections) = sections else { continue };
        let rings: Vec<Vec<DVec3>> = sections.iter().map(|s| s.border().collect()).collect();
        zone::add_tube(surface, &rings, [sections[0].center(), sections[sections.len() - 1].center()]);
    }
}

/// The laying of blocks.
struct Work<'a> {
    vessel: &'a Vessel,
    frame: &'a Frame,
    lines: &'a Centerlines,
    maker: Maker<'a>,
    library: Library,
    report: Report,
}

/// Half of a branch, or the whole, from a junction outwards.
struct Outward {
    curve: Curve,
    opening: Option<usize>,
    /// Junction at the other end of the branch.
    beyond: Option<usize>,
}

impl<'a> Work<'a> {
    /// Limbs and what they are filled with.
    fn fill(&mut self) -> (Vec<Limb<'a>>, Vec<Filling>) {
        let (mut limbs, mut fillings) = (Vec::new(), Vec::new());
        for branch in &self.lines.branches {
            if let (BranchEnd::Opening(a), BranchEnd::Opening(b)) = (branch.start, branch.end) {
                let openings = [Some(&self.vessel.openings[a]), Some(&self.vessel.openings[b])];
                let route = Route::new(&branch.curve, self.maker.spacing, None, openings, self.maker.wall);
                let limb = Limb { route, from: 0.0, hinge: None, junctions: [None; 2] };
                fillings.push(self.fill_limb(&limb));
                limbs.push(limb);
            }
        }
        for number in 0..self.lines.junctions.len() {
            let outward = self.outward(number);
            let blocked = self.blocked(number, &outward);
            let filled = match blocked {
                Ok(filled) => {
                    self.report.blocked_junctions += 1;
                    filled
                }
                Err(reason) => {
                    let at = 1e3 * self.frame.place(self.lines.junctions[number].carina);
                    self.report.unblocked_junctions.push(format!(
                        "the junction at ({:.1}, {:.1}, {:.1}) mm is filled by the lattice: {reason}",
                        at.x, at.y, at.z
                    ));
                    self.unblocked(number, &outward)
                }
            };
            for (limb, filling) in filled {
                limbs.push(limb);
                fillings.push(filling);
            }
        }
        (limbs, fillings)
    }

    /// The three limbs of a junction: parent, first and second daughter.
    fn outward(&self, number: usize) -> [Outward; 3] {
        let junction = &self.lines.junctions[number];
        let [a, b] = junction.daughters;
        [junction.parent, a, b].map(|branch| {
            let branch = &self.lines.branches[branch];
            let is_start = branch.start == BranchEnd::Junction(number);
            let whole = if is_start { branch.curve.clone() } else { branch.curve.reversed() };
            let far = if is_start { branch.end } else { branch.start };
            match far {
                BranchEnd::Opening(k) => Outward { curve: whole, opening: Some(k), beyond: None },
                BranchEnd::Junction(k) => {
                    // Two junctions share a branch: each gets half of it, up to a plane in the middle.
                    let half = whole.stretch(0.0, 0.5 * whole.length(), whole.points().len().div_ceil(2));
                    Outward { curve: half, opening: None, beyond: Some(k) }
                }
            }
        })
    }

    fn limb(
        &self,
        number: usize,
        outward: &Outward,
        curve: &Curve,
        hinge: Option<Hinge>,
        from: f64,
    ) -> Limb<'a> {
        let opening: Option<&'a Opening> = outward.opening.map(|k| &self.vessel.openings[k]);
        let route = Route::new(curve, self.maker.spacing, hinge, [None, opening], self.maker.wall);
        Limb { route, from, hinge, junctions: [Some(number), outward.beyond] }
    }

    /// Limbs that fill a junction, or why they do not.
    fn blocked(&mut self, number: usize, outward: &[Outward; 3]) -> Result<Vec<(Limb<'a>, Filling)>, String> {
        let curves = outward.each_ref().map(|o| &o.curve);
        let starts = junction::starts(&self.lines.junctions[number], curves, self.maker.wall)?;
        let mut filled = Vec::with_capacity(3);
        for (start, outward) in starts.iter().zip(outward) {
            let limb = self.limb(number, outward, &start.curve, Some(start.hinge), 0.0);
            let filling = self.fill_limb(&limb);
            let mut reached = 0.0;
            for layer in filling.layers().filter(|l| l.is_sound) {
                if layer.arc[0] <= reached {
                    reached = layer.arc[1];
                }
            }
            if reached < start.hinge.length {
                return Err("its sections cross or its cells turn over".into());
            }
            filled.push((limb, filling));
        }
        Ok(filled)
    }

    /// Limbs that keep clear of a junction.
    fn unblocked(&mut self, number: usize, outward: &[Outward; 3]) -> Vec<(Limb<'a>, Filling)> {
        let mut filled = Vec::new();
        for outward in outward {
            let curve = &outward.curve;
            let from = CLEAR * self.maker.wall.query(curve.at(0.5 * curve.length())).distance.abs();
            if from < 0.8 * curve.length() {
                let limb = self.limb(number, outward, curve, None, from);
                let filling = self.fill_limb(&limb);
                filled.push((limb, Filling { is_whole: false, ..filling }));
            }
        }
        filled
    }

    fn fill_limb(&mut self, limb: &Limb<'_>) -> Filling {
        let spacing = self.maker.spacing;
        let runs = limb::runs(&limb.route, limb.from, limb.route.length(), spacing);
        let even_until = limb.hinge.map_or(0.0, |h| h.length);
        let mut filling = Filling { stretches: Vec::new(), is_whole: runs.len() == 1 };
        for run in &runs {
            let layers = self.library.layers(run, spacing, even_until);
            if layers.iter().map(|l| l.arc.len() - 1).sum::<usize>() < FEWEST {
                filling.is_whole = false;
                continue;
            }
            for layers in &layers {
                match self.maker.stretch(&limb.route, layers) {
                    Some(stretch) => filling.stretches.push(stretch),
                    None => filling.is_whole = false,
                }
            }
        }
        let is_sound = filling.layers().all(|l| l.is_sound);
        filling.is_whole &= is_sound;
        let ends = runs.first().zip(runs.last()).map(|(a, b)| [a.arc[0], b.arc[b.arc.len() - 1]]);
        filling.is_whole &= ends == Some([limb.from, limb.route.length()]);
        filling
    }
}
