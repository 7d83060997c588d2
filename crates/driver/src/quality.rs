//! Quality of particles as JSON and people have it.

use crate::bodies::FluidBody;
use vaso_generation::ShellBody;
use vaso_io::{Blocks, Quality};
use vaso_scene::{Generator, Particles, Word};

/// Name of a generator as the case has it.
pub fn generator_name(generator: Generator) -> &'static str {
    match generator {
        Generator::RelaxedLattice(_) => "relaxed-lattice",
        Generator::Multiblock(_) => "multiblock",
    }
}

/// Quality of a fluid or wall that took `seconds` \[s\].
pub fn entry(q: &vaso_generation::Quality, seconds: f64) -> Quality {
    Quality {
        count: q.count as u64,
        volume_error: q.volume_error,
        nearest_neighbor_min: q.nearest_neighbor_min,
        nearest_neighbor_cv: q.nearest_neighbor_cv,
        kernel_sum_mean: q.kernel_sum_mean,
        kernel_sum_std: q.kernel_sum_std,
        gradient_residual_rms: q.gradient_residual_rms,
        volume_cv: q.volume_cv,
        outside: q.outside as u64,
        seconds: Some(seconds),
        iterations: q.iterations as u64,
        converged: (q.iterations > 0).then_some(q.converged),
    }
}

/// Quality of a shell that took `seconds` \[s\]; kernel sums are those in its surface.
pub(crate) fn shell_entry(shell: &ShellBody, seconds: f64) -> Quality {
    let q = &shell.quality;
    let volume: Vec<f64> = shell.area.iter().zip(&shell.thickness).map(|(a, t)| a * t).collect();
    let mean = volume.iter().sum::<f64>() / volume.len() as f64;
    let variance = volume.iter().map(|v| (v / mean - 1.0).powi(2)).sum::<f64>() / volume.len() as f64;
    Quality {
        count: q.count as u64,
        volume_error: q.area_error,
        nearest_neighbor_min: q.nearest_neighbor_min,
        nearest_neighbor_cv: q.nearest_neighbor_cv,
        kernel_sum_mean: q.kernel_sum_mean,
        kernel_sum_std: q.kernel_sum_std,
        gradient_residual_rms: q.gradient_residual_rms,
        volume_cv: variance.sqrt(),
        outside: 0,
        seconds: Some(seconds),
        iterations: q.iterations as u64,
        converged: None,
    }
}

/// What became of the blocks of a fluid; `None` where there are none.
pub(crate) fn blocks(fluid: &FluidBody, particles: &Particles) -> Option<Blocks> {
    let Generator::Multiblock(topology) = particles.generator else { return None };
    let report = fluid.blocks.as_ref()?;
    Some(Blocks {
        topology: topology.word().into(),
        smoothing_sweeps: particles.smoothing_sweeps as u64,
        blocks: report.blocks as u64,
        cells: report.cells as u64,
        smallest_cell: report.smallest_cell,
        missed_projections: report.missed_projections as u64,
        pushed_particles: report.pushed_particles as u64,
        blocked_junctions: report.blocked_junctions as u64,
        unblocked_junctions: report.unblocked_junctions.clone(),
        lattice_particles: report.lattice_particles as u64,
        lattice_share: report.lattice_share,
    })
}

/// The quality of a body in a line.
pub(crate) fn line(body: &str, q: &Quality) -> String {
    format!(
        "{body:<8} {} particles · nearest neighbour {:.3} min, {:.4} variation · volume error {:.2e} · {} outside · \
         {} steps · {:.1} s",
        q.count,
        q.nearest_neighbor_min,
        q.nearest_neighbor_cv,
        q.volume_error,
        q.outside,
        q.iterations,
        q.seconds.unwrap_or(f64::NAN)
    )
}

/// The blocks in a line.
pub(crate) fn blocks_line(blocks: &Blocks) -> String {
    format!(
        "blocks   {} of {} · {} cells, the smallest {:.2} of the mean · {} junctions by blocks, {} by the lattice, which \
         fills {:.1} %",
        blocks.blocks,
        blocks.topology,
        blocks.cells,
        blocks.smallest_cell,
        blocks.blocked_junctions,
        blocks.unblocked_junctions.len(),
        100.0 * blocks.lattice_share
    )
}
