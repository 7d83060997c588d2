//! Flows against formulas, other programs and measurements: the cases of `docs/validation.md`.
//!
//! Each case has a full run, whose figures are kept in `tests/validation/results.json`, and most have a quick one at coarse
//! spacing, which the tests make.

pub mod backflow;
pub mod common_carotid;
pub mod elastic_patients;
pub mod ends;
pub mod frames;
pub mod lumped;
pub mod measure;
pub mod nozzle;
pub mod outlets;
pub mod page;
pub mod patients;
pub mod poiseuille;
pub mod published_carotid;
pub mod start_up;
pub mod thinning;
pub mod two_outlets;
pub mod womersley;

use serde::{Deserialize, Serialize};

/// A flow with a reference.
pub struct Case {
    /// Name by which the generator is asked for it.
    pub name: &'static str,
    /// What flows.
    pub title: &'static str,
    /// How it is set up and measured.
    pub setup: &'static str,
    /// What it is compared with, and its source.
    pub reference: &'static str,
    /// What a reader of the figures has to know; where one misses what is asked, the cause.
    pub remark: &'static str,
    /// The run of the tests, at most half a minute on two cores; `None` where there is nothing so short that shows anything.
    pub quick: Option<Run>,
    /// The run of the page.
    pub full: Run,
}

/// Runs a case; `None` where the outside data it needs are missing.
pub type Run = fn() -> Option<Outcome>;

/// What a run came to.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Outcome {
    /// What was compared.
    pub figures: Vec<Figure>,
    /// Fluid particles of the largest flow.
    pub particles: usize,
    /// Time of all flows of the case \[s\], generation of particles left out.
    pub seconds: f64,
    /// Threads they had.
    pub threads: usize,
    /// What has changed since, where it was run before the scheme was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run_before: Option<String>,
}

impl Outcome {
    /// An outcome without flows so far.
    pub fn new() -> Self {
        Self {
            figures: Vec::new(),
            particles: 0,
            seconds: 0.0,
            threads: rayon::current_num_threads(),
            run_before: None,
        }
    }

    /// Adds a figure.
    pub fn figure(&mut self, what: impl Into<String>, error: f64, unit: Unit, tolerance: Tolerance) {
        self.figures.push(Figure { what: what.into(), error, unit, tolerance });
    }

    /// Adds the cost of a flow.
    pub fn cost(&mut self, flown: &measure::Flown) {
        self.particles = self.particles.max(flown.particles);
        self.seconds += flown.seconds;
    }
}

impl Default for Outcome {
    fn default() -> Self {
        Self::new()
    }
}

/// One error against a reference.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Figure {
    /// What was compared, and over what the error is told.
    pub what: String,
    /// Our error, with its sign where it has one.
    pub error: f64,
    /// What it is in.
    pub unit: Unit,
    /// What is asked of it.
    pub tolerance: Tolerance,
}

impl Figure {
    /// Whether it is within what the tests hold it to.
    pub fn holds(&self) -> bool {
        let bound = match self.tolerance {
            Tolerance::Asked(bound) | Tolerance::Held(bound) => bound,
            Tolerance::AtLeast(bound) | Tolerance::TooLow { held: bound, .. } => return self.error >= bound,
            Tolerance::Missed { held, .. } => held,
        };
        self.error.abs() <= bound
    }
}

/// Unit of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// A part of something, shown in per cent.
    Part,
    /// An angle \[degree\].
    Degree,
    /// A number as it is: a count, an order.
    Number,
}

/// What is asked of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tolerance {
    /// At most this is asked for.
    Asked(f64),
    /// At least this is asked for.
    AtLeast(f64),
    /// Less than what is asked for at least; the tests hold it at a little less than was measured.
    TooLow {
        /// What is asked for.
        asked: f64,
        /// What the tests hold.
        held: f64,
    },
    /// Nothing is asked for at this resolution; the tests hold it at this, a little more than was measured.
    Held(f64),
    /// More than what is asked for; the tests hold it at a little more than was measured.
    Missed {
        /// What is asked for.
        asked: f64,
        /// What the tests hold.
        held: f64,
    },
}

/// All cases, in the order of the page.
pub const CASES: &[Case] = &[
    lumped::CASE,
    poiseuille::CASE,
    poiseuille::LONG,
    ends::CASE,
    start_up::CASE,
    womersley::CASE,
    frames::CASE,
    outlets::RESISTANCE,
    outlets::WINDKESSEL,
    outlets::SVFSI,
    two_outlets::CASE,
    outlets::STIFF,
    backflow::CASE,
    thinning::CASE,
    nozzle::CASE,
    common_carotid::CASE,
    patients::CAROTID,
    patients::AORTA,
    elastic_patients::CAROTID,
    elastic_patients::CAROTID_SOLID,
    elastic_patients::AORTA,
    published_carotid::CASE,
];

/// The case of a name.
pub fn case(name: &str) -> Option<&'static Case> {
    CASES.iter().find(|c| c.name == name)
}
