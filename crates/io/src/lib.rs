#![doc = include_str!("../README.md")]

mod atomic;
mod error;
mod hdf5;
mod json;
pub mod schema;
mod series;
mod summary;

pub use error::IoError;
pub use series::{FieldInfo, Frame, FrameData, SeriesInfo, SeriesReader, SeriesWriter, read_series_info};
pub use summary::{
    CheckReport, EffectEntry, Numbers, OpeningEntry, OpeningSummary, ParticleCounts, ParticlesReport, Predicted,
    Quality, Stability, Status, StepCounts, Summary, SurfaceReport,
};
