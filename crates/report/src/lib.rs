#![doc = include_str!("../README.md")]

mod chart;
mod color;
mod error;
mod html;
mod limits;
pub mod picture;
mod report;
mod scale;
mod sections;
mod vessel;

pub use error::ReportError;
pub use picture::render_vessel_png;
pub use report::write_report;
