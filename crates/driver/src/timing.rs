//! Times a flow has of its own: its period, and what it takes to settle.

use crate::estimate;
use crate::plan::PlannedOpening;
use std::f64::consts::PI;
use vaso_boundary::{Condition, Signal, Source};
use vaso_geometry::Vessel;
use vaso_scene::Scene;

/// Square of the first zero of J0: flow in a pipe settles like `exp(-BESSEL nu t / R^2)` (Szymanski 1932).
const BESSEL: f64 = 5.783;
/// Part of a period within which two are the same.
const ALIKE: f64 = 1e-9;

/// Period of the case \[s\]: the one it gives, or else that of its waveforms; `None` where there is none, or they differ.
pub(crate) fn period(scene: &Scene, openings: &[PlannedOpening]) -> Option<f64> {
    if scene.run.period.is_some() {
        return scene.run.period;
    }
    let mut periods = openings.iter().filter_map(|o| match signal(&o.condition)? {
        Signal { source: Source::Waveform(wave), .. } => wave.period(),
        _ => None,
    });
    let first = periods.next()?;
    periods.all(|other| (other - first).abs() < ALIKE * first).then_some(first)
}

/// Time in which a flow that does not pulsate settles \[s\]: the shorter of what friction takes to shape the profile of the largest
/// inlet, and of what the blood takes to go through.
pub(crate) fn settling(
    vessel: &Vessel,
    openings: &[PlannedOpening],
    flow: &estimate::Flow,
    kinematic_viscosity: f64,
) -> f64 {
    let friction = flow.inlet_radius.powi(2) / (BESSEL * kinematic_viscosity);
    let inflow: f64 = openings
        .iter()
        .filter_map(|o| match &o.condition {
            Condition::Velocity { mean, .. } => Some(mean.peak() * o.opening.area),
            _ => None,
        })
        .sum();
    // Driven by pressure alone, half the top speed fills the narrowest opening.
    let narrow = 0.5 * flow.top_speed * PI * flow.smallest_radius.powi(2);
    let transit = vessel.surface.volume() / if inflow > 0.0 { inflow } else { narrow };
    friction.min(transit)
}

fn signal(condition: &Condition) -> Option<&Signal> {
    match condition {
        Condition::Velocity { mean, .. } => Some(mean),
        Condition::Pressure { value } => Some(value),
        Condition::Resistance { .. } | Condition::Windkessel { .. } => None,
    }
}
