//! Surfaces and waveforms of the shipped cases, made by the project itself.

mod surfaces;
mod waveforms;

use std::path::Path;

pub use surfaces::{CaseSurface, surfaces};
use vaso_geometry::{GeometryError, write_stl};
pub use waveforms::{CaseWaveform, waveforms};

/// What is in the way of writing a file of a case.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// A surface cannot be written.
    #[error(transparent)]
    Surface(#[from] GeometryError),
    /// A waveform cannot be written.
    #[error("`{file}` cannot be written")]
    Waveform {
        /// Path in the folder `cases`.
        file: &'static str,
        /// Why not.
        source: std::io::Error,
    },
}

/// Writes all surfaces and waveforms below the folder `cases`.
///
/// # Errors
/// When a file cannot be written.
pub fn write(cases: &Path) -> Result<(), WriteError> {
    for made in surfaces() {
        write_stl(&cases.join(made.file), &made.surface)?;
    }
    for made in waveforms() {
        std::fs::write(cases.join(made.file), made.text())
            .map_err(|source| WriteError::Waveform { file: made.file, source })?;
    }
    Ok(())
}
