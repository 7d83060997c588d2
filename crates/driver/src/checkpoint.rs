//! Checkpoint of a flow: everything its next step depends on.

use crate::flow::Flow;
use std::path::Path;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_io::{Archive, IoError};
use vaso_particles::Columns;

/// Kind of the archive.
pub const KIND: &str = "checkpoint";
/// Layout version.
pub const VERSION: u32 = 1;

/// Writes `checkpoint.h5` into `folder`, whole or not at all.
///
/// # Errors
/// When the disk or the folder refuses; an older checkpoint then stays.
pub fn write<R: Real, W: MovingWall + Columns>(folder: &Path, flow: &mut Flow<R, W>) -> Result<(), IoError> {
    let mut archive = Archive::new(KIND, VERSION);
    archive.put_columns("fluid", &mut flow.fluid.state);
    if let Some(wall) = &mut flow.wall {
        archive.put_columns("wall", &mut wall.wall);
    }
    archive.put_floats("fluid.capacity_m3", flow.fluid.capacity().as_slice());
    archive.put_floats("time_s", &[flow.time]);
    archive.put_integers("steps", &[flow.advective_steps, flow.acoustic_steps, flow.particle_substeps]);
    let counters = flow.openings.ports().iter().map(|p| p.counters);
    archive.put_integers(
        "openings.counts",
        &counters.clone().flat_map(|c| [c.injected, c.deleted, c.strays]).collect::<Vec<_>>(),
    );
    archive.put_floats("openings.outflow_volume_m3", &counters.map(|c| c.outflow_volume).collect::<Vec<_>>());
    archive.put_floats(
        "openings.damped_energy_j",
        &flow.openings.ports().iter().map(|p| p.counters.damped_energy).collect::<Vec<_>>(),
    );
    // Openings without a model stand as zeros.
    let outlets = flow.openings.states().into_iter().flat_map(|s| s.outlet.unwrap_or_default().to_array());
    archive.put_floats("openings.outlets", &outlets.collect::<Vec<_>>());
    archive.put_integers("openings.next_id", &[flow.openings.next_id()]);
    archive.write(&folder.join("checkpoint.h5"))
}
