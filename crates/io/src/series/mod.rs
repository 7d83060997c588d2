//! Time series of particles, and of a surface of triangles, in the VTKHDF format.
//!
//! One file holds all frames of one body and opens by itself in ParaView and in VTK's `vtkHDFReader`
//! (VTKHDF 2.0, PolyData with steps; VTK 9.3 or newer). Coordinates and fields are stored in single
//! precision; times, ids and offsets in eight bytes. The number of particles may change from frame to
//! frame. An array that repeats the frame before bit for bit is not stored again: the frame points to the
//! rows already there. Read a frame through its offsets, never by adding up counts.
//!
//! The public file is complete and closed at every moment; see [`SeriesWriter`] for how.

mod cells;
mod layout;
mod plan;
mod read;
mod surface;
mod write;

pub use read::{FieldInfo, SeriesInfo, SeriesReader, read_series_info};
pub use surface::{SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter};
pub use write::SeriesWriter;

use glam::DVec3;

/// The state of one body at one time, borrowed from the simulation.
#[derive(Debug, Clone, Default)]
pub struct Frame<'a> {
    /// Simulated time \[s\]; larger than that of the frame before.
    pub time: f64,
    /// Particle positions \[m\].
    pub position: &'a [DVec3],
    /// Fields of one number a particle, by name.
    pub scalars: Vec<(&'a str, &'a [f64])>,
    /// Fields of one vector a particle, by name.
    pub vectors: Vec<(&'a str, &'a [DVec3])>,
    /// Identity of each particle, stored as the field `Id`; `None` for a body without identities.
    pub ids: Option<&'a [u64]>,
}

/// A frame read back; the numbers went through single precision.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrameData {
    /// Simulated time \[s\].
    pub time: f64,
    /// Particle positions \[m\].
    pub position: Vec<DVec3>,
    /// Fields of one number a particle, in order of name.
    pub scalars: Vec<(String, Vec<f64>)>,
    /// Fields of one vector a particle, in order of name.
    pub vectors: Vec<(String, Vec<DVec3>)>,
    /// Identity of each particle, if stored.
    pub ids: Option<Vec<u64>>,
}

impl FrameData {
    /// The scalar field of that name.
    pub fn scalar(&self, name: &str) -> Option<&[f64]> {
        self.scalars.iter().find(|(field, _)| field == name).map(|(_, values)| values.as_slice())
    }

    /// The vector field of that name.
    pub fn vector(&self, name: &str) -> Option<&[DVec3]> {
        self.vectors.iter().find(|(field, _)| field == name).map(|(_, values)| values.as_slice())
    }

    /// The same frame as a view, to be written elsewhere.
    pub fn view(&self) -> Frame<'_> {
        Frame {
            time: self.time,
            position: &self.position,
            scalars: self.scalars.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect(),
            vectors: self.vectors.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect(),
            ids: self.ids.as_deref(),
        }
    }
}
