//! What ends the program early, and the exit code that tells scripts why.

use std::path::{Path, PathBuf};
use vaso_generation::GenerationError;

/// Everything that can stop a command.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DriverError {
    /// The case file or an override.
    #[error(transparent)]
    Scene(#[from] vaso_scene::SceneError),
    /// The surface.
    #[error("{}: {source}", file.display())]
    Geometry {
        /// The surface file.
        file: PathBuf,
        /// What is wrong with it.
        source: vaso_geometry::GeometryError,
    },
    /// The particles.
    #[error("{file}: `{key}`: {source}", file = file.display())]
    Generation {
        /// The case file, or the bare surface.
        file: PathBuf,
        /// Key of the case that decides about it.
        key: &'static str,
        /// Why there are none.
        source: GenerationError,
    },
    /// Case and surface do not go together, or ask for what this version does not have.
    #[error("{}", problems.join("\n"))]
    Input {
        /// One text a problem: file, key, value, what is allowed, what to do.
        problems: Vec<String>,
    },
    /// Files of results.
    #[error(transparent)]
    Io(#[from] vaso_io::IoError),
    /// The report.
    #[error(transparent)]
    Report(#[from] vaso_report::ReportError),
    /// What is read off the flow.
    #[error(transparent)]
    Metrics(#[from] vaso_metrics::MetricsError),
    /// The run broke down.
    #[error(transparent)]
    Diverged(#[from] crate::flow::Diverged),
    /// The user stopped the run.
    #[error(
        "interrupted at {time:.6e} s; results up to there and a checkpoint are in {0}: go on with `vaso resume {0}`",
        out.display()
    )]
    Interrupted {
        /// Simulated time \[s\].
        time: f64,
        /// The output folder.
        out: PathBuf,
    },
}

impl DriverError {
    /// One problem with the input.
    pub fn input(problem: impl Into<String>) -> Self {
        Self::Input { problems: vec![problem.into()] }
    }

    /// Why there are no particles, with the key of the case that decides about it.
    pub(crate) fn generation(file: &Path, source: GenerationError) -> Self {
        let key = match &source {
            GenerationError::Setting { key: "thickness", .. } => "wall.thickness",
            GenerationError::Setting { key: "smoothing", .. } => "numerics.smoothing_length",
            GenerationError::NoWall { .. } => "geometry.surface",
            _ => "particles.spacing",
        };
        Self::Generation { file: file.to_owned(), key, source }
    }

    /// Exit code: 1 the run broke down, 2 the input is wrong, 130 interrupted.
    pub fn exit_code(&self) -> u8 {
        use vaso_io::IoError;
        match self {
            Self::Scene(_) | Self::Geometry { .. } | Self::Generation { .. } | Self::Input { .. } => 2,
            Self::Io(IoError::Finished { .. } | IoError::Foreign { .. } | IoError::Exists { .. }) => 2,
            Self::Io(_) | Self::Report(_) | Self::Metrics(_) | Self::Diverged(_) => 1,
            Self::Interrupted { .. } => 130,
        }
    }
}
