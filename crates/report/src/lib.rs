#![doc = include_str!("../README.md")]

mod accuracy;
mod against;
mod chart;
mod color;
mod compare;
mod cycles;
mod drawing;
mod error;
mod histogram;
mod html;
mod limits;
pub mod picture;
mod report;
mod scale;
mod sections;
mod study;
mod vessel;
mod viewer;
mod wall;

pub use compare::{ComparedParticles, slab, write_comparison};
pub use drawing::{Drawing, Pen, Plane, sheet};
pub use error::ReportError;
pub use picture::render_vessel_png;
pub use report::{write_report, write_report_against};
pub use study::{work_precision, write_study};
