#![doc = include_str!("../README.md")]

mod archive;
mod atomic;
mod cache;
mod check;
mod cycles;
mod error;
mod generated;
mod hdf5;
mod json;
mod output;
pub mod particles;
pub mod schema;
mod series;
mod shell;
mod solid;
mod study;
mod summary;
mod table;
mod wall;

pub use archive::Archive;
pub use atomic::write as write_whole;
pub use cache::{Cache, CacheKey, KeyBuilder};
pub use check::{CheckReport, EffectEntry, Numbers, OpeningEntry, Predicted, SurfaceReport};
pub use cycles::{
    CycleSummary, EndReason, EnergySummary, OpeningCycleSummary, PeriodicitySummary, PressureDropSummary,
};
pub use error::IoError;
pub use generated::{
    Blocks, CompareReport, ComparedGenerator, Extrusion, Histogram, IntersectionEntry, ParticlesReport,
    Quality, ShellReport, WallReport,
};
pub use output::{OutputDir, wall_surface};
pub use series::{
    FieldInfo, Frame, FrameData, SeriesInfo, SeriesReader, SeriesWriter, SurfaceField, SurfaceFrame,
    SurfaceMesh, SurfaceSeriesWriter, read_series_info,
};
pub use shell::ShellSummary;
pub use solid::SolidSummary;
pub use study::{ErrorEntry, GoalEntry, NamedValue, PriceEntry, StudyReport, StudyRun, StudyStatus};
pub use summary::{OpeningSummary, ParticleCounts, Stability, Status, StepCounts, Summary};
pub use table::{Table, TableData, read_table};
pub use wall::{Distribution, LOW_TAWSS, WallSummary};
