//! What can stop a report.

use std::path::PathBuf;
use vaso_io::IoError;

/// A failure to make a report or a picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A file of the run could not be read, or the report could not be written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// The series to be drawn has no frame yet.
    #[error("{path:?} has no frame to draw; let the run reach its first output time")]
    NoFrame {
        /// The series.
        path: PathBuf,
    },
    /// The series lacks what the picture is to show.
    #[error("{path:?} has no field `{field}`; it has {present}")]
    NoField {
        /// The series.
        path: PathBuf,
        /// The field asked for.
        field: String,
        /// The fields it has.
        present: String,
    },
    /// The picture could not be encoded.
    #[error("cannot encode a picture of {width} by {height} pixels: {message}")]
    Picture {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// The encoder's words.
        message: String,
    },
}
