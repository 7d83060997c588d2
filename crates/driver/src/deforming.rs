//! What the driver asks of a wall that deforms, whatever it is made of.

use crate::case::Case;
use crate::error::DriverError;
use crate::plan::Plan;
use crate::results::{ShearColumns, ShearFields};
use crate::world::WallParticles;
use std::path::PathBuf;
use vaso_coupling::{Coupling, MovingWall};
use vaso_io::Summary;
use vaso_scene::Field;

/// A wall that deforms, as it is built, kept and told of. A flow is made for one kind of it and knows no other.
pub trait Deforming: MovingWall + Sized {
    /// The open `wall.vtkhdf`.
    type File;

    /// Whether that has triangles, which take the stress of the blood as well. Where it has particles, there is a `lumen.vtkhdf` for it.
    const HAS_TRIANGLES: bool;

    /// Name of its effect.
    const EFFECT: &'static str;

    /// The wall of a plan, of these particles; `None` for one at rest.
    ///
    /// # Errors
    /// When the particles do not make such a wall.
    fn build(case: &Case, plan: &Plan, particles: &WallParticles) -> Result<Option<Self>, DriverError>;

    /// Starts its series at `path`, or goes on with the frames up to the time `kept` \[s\]; `shear` is what triangles are to take of the
    /// stress of the blood.
    ///
    /// # Errors
    /// When it cannot be declared, or what is there is not such a series.
    fn create(
        &self,
        path: PathBuf,
        case: &Case,
        shear: Option<&ShearFields>,
        kept: Option<f64>,
    ) -> Result<Self::File, DriverError>;

    /// Appends where it stands at `time` \[s\], and the stress of the blood on it.
    ///
    /// # Errors
    /// When the file cannot be written.
    fn append(
        wall: &Coupling<Self>,
        file: &mut Self::File,
        time: f64,
        fields: &[Field],
        shear: Option<&ShearColumns>,
    ) -> Result<(), DriverError>;

    /// Says in the summary where it stands, and what went through it.
    fn summarize(wall: &mut Coupling<Self>, plan: &Plan, summary: &mut Summary);

    /// Bytes held.
    fn bytes(&mut self) -> usize;
}
