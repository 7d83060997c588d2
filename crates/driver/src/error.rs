//! What ends the program early, and the exit code that tells scripts why.

use crate::case::Case;
use crate::diverged::Diverged;
use crate::print::length;
use std::path::{Path, PathBuf};
use vaso_generation::GenerationError;
use vaso_scene::{Problem, Scene};

/// File of the state that a run broke down in, in the output folder.
pub const POST_MORTEM: &str = "failure.vtkhdf";

/// Everything that can stop a command.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DriverError {
    /// The case file or an override.
    #[error(transparent)]
    Scene(#[from] vaso_scene::SceneError),
    /// The surface.
    #[error("{}", located(file, source))]
    Geometry {
        /// The surface file.
        file: PathBuf,
        /// What is wrong with it.
        source: vaso_geometry::GeometryError,
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
    #[error(
        "{diverged}\n  last good snapshot: {}\n  the state it broke down in: {}\n  to change: {}",
        last.map_or("none".to_owned(), |t| format!("{} at {t:.6} s", out.join("fluid.vtkhdf").display())),
        if *post_mortem { out.join(POST_MORTEM).display().to_string() } else { "could not be written".to_owned() },
        diverged.advice()
    )]
    Diverged {
        /// Why, and where in the run.
        diverged: Box<Diverged>,
        /// The output folder.
        out: PathBuf,
        /// Time of the last good snapshot \[s\], if there is one.
        last: Option<f64>,
        /// Whether the state it broke down in could be written, as [`POST_MORTEM`].
        post_mortem: bool,
    },
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

    /// Why there are no particles, at the key of the case that decides about it.
    pub(crate) fn generation(case: &Case, source: &GenerationError) -> Self {
        let key = match source {
            GenerationError::Setting { key: "thickness", .. } => "wall.thickness",
            GenerationError::Setting { key: "smoothing", .. } => "numerics.smoothing_length",
            GenerationError::NoWall { .. } => "geometry.surface",
            _ => "particles.spacing",
        };
        let (message, allowed, advice) = match *source {
            GenerationError::TooCoarse { opening, radius, needed, .. } => (
                format!("leaves no ring of particles in opening `{}`", case.opening_name(opening)),
                format!("at most its radius of {}", length(radius)),
                format!("for a flow take {} or less, or close that opening", length(needed)),
            ),
            _ => (source.to_string(), String::new(), String::new()),
        };
        Self::input(problem(&case.scene, key, message, allowed, advice))
    }

    /// Exit code: 1 the run broke down, 2 the input is wrong, 130 interrupted.
    pub fn exit_code(&self) -> u8 {
        use vaso_io::IoError;
        match self {
            Self::Scene(_) | Self::Geometry { .. } | Self::Input { .. } => 2,
            Self::Io(
                IoError::Finished { .. }
                | IoError::Resumable { .. }
                | IoError::Foreign { .. }
                | IoError::Exists { .. },
            ) => 2,
            Self::Io(_) | Self::Report(_) | Self::Metrics(_) | Self::Diverged { .. } => 1,
            Self::Interrupted { .. } => 130,
        }
    }
}

/// What is wrong with a key, where that shows only with the surface at hand or for this version: told as the case reader tells
/// what it finds, with the place. Texts may be empty.
pub(crate) fn problem(
    scene: &Scene,
    key: &str,
    message: impl Into<String>,
    allowed: impl Into<String>,
    advice: impl Into<String>,
) -> String {
    Problem { allowed: allowed.into(), advice: advice.into(), ..scene.problem(key, message) }.to_string()
}

/// What is wrong with a surface, with its path in front where the text does not name it.
fn located(file: &Path, source: &vaso_geometry::GeometryError) -> String {
    let (path, text) = (file.display().to_string(), source.to_string());
    if text.contains(&path) { text } else { format!("{path}: {text}") }
}
