//! What can be said about a flow before it runs: top speed, pressure range, size and cost.

use crate::case::Case;
use crate::plan::PlannedOpening;
use crate::shell::PlannedShell;
use crate::start;
use crate::structure::PlannedWall;
use std::f64::consts::PI;
use vaso_boundary::{Condition, Windkessel, mean_split};
use vaso_fluid::Numbers;
use vaso_geometry::{Opening, Vessel};
use vaso_io::{ParticleCounts, Predicted};
use vaso_scene::Precision;

/// Expected range of a flow.
#[derive(Clone, Debug)]
pub struct Flow {
    /// Largest speed expected anywhere \[m/s\].
    pub top_speed: f64,
    /// Where that speed is expected.
    pub top_speed_reason: String,
    /// Largest pressure difference the equation of state must carry \[Pa\].
    pub pressure_range: f64,
    /// What causes it.
    pub pressure_reason: String,
    /// Peak Reynolds number at the largest inlet.
    pub reynolds_peak: f64,
    /// Radius of the largest inlet \[m\].
    pub inlet_radius: f64,
    /// Radius of the smallest opening \[m\].
    pub smallest_radius: f64,
}

impl Flow {
    /// Estimates the flow through `vessel`.
    ///
    /// Outlets are taken to share the inflow by area with a parabolic peak of twice the mean; the
    /// narrowest section before the first outlet carries all of it. A fixed `reference_pressure` \[Pa\]
    /// widens the range the equation of state must carry.
    pub fn new(
        vessel: &Vessel,
        openings: &[PlannedOpening],
        density: f64,
        viscosity: f64,
        ramp: f64,
        reference_pressure: Option<f64>,
    ) -> Self {
        let mut inflow = 0.0;
        let mut top_speed: f64 = 0.0;
        let mut reason = String::from("no inflow");
        let mut inlet: Option<(f64, f64)> = None;
        let mut outlet_area = 0.0;
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        for port in openings {
            match &port.condition {
                Condition::Velocity { profile, mean } => {
                    let peak = mean.peak();
                    inflow += peak * port.opening.area;
                    if profile.peak() * peak > top_speed {
                        top_speed = profile.peak() * peak;
                        reason = format!("the profile at `{}`", port.name);
                    }
                    if inlet.is_none_or(|(radius, _)| port.opening.radius > radius) {
                        inlet = Some((port.opening.radius, peak));
                    }
                }
                // The level of outlet models is that of the reference pressure.
                Condition::Resistance { .. } | Condition::Windkessel { .. } => {
                    outlet_area += port.opening.area;
                }
                Condition::Pressure { value } => {
                    outlet_area += port.opening.area;
                    let (low, high) = value.range();
                    (lowest, highest) = (lowest.min(low), highest.max(high));
                }
            }
        }
        // Beside a pressure that is given, that of a model counts in full.
        let is_relative = reference_pressure.is_none() && lowest > highest;
        let is_driven = lowest <= highest;
        if !is_relative {
            for (_, start) in openings.iter().filter_map(|o| o.condition.model()) {
                (lowest, highest) = (lowest.min(start), highest.max(start));
            }
            if let Some([low, high]) = behind_outlets(openings, inflow, is_driven) {
                (lowest, highest) = (lowest.min(low), highest.max(high));
            }
        }
        if let Some(p) = reference_pressure {
            (lowest, highest) = (lowest.min(p), highest.max(p));
        }
        let imposed = if highest > lowest { highest - lowest } else { 0.0 };
        let smallest_radius = openings.iter().map(|o| o.opening.radius).fold(f64::INFINITY, f64::min);
        let length = length(vessel);
        let inlet_radius = inlet.map_or(smallest_radius, |i| i.0);
        if outlet_area > 0.0 && PARABOLIC * inflow / outlet_area > top_speed {
            top_speed = PARABOLIC * inflow / outlet_area;
            reason = "the outlets sharing the inflow by area".to_owned();
        }
        // Mean section of the whole vessel: a throat shows in it only if it is long, so the run watches the Mach number.
        let narrowest = vessel.narrowest_section().unwrap_or(f64::INFINITY);
        if PARABOLIC * inflow / narrowest > top_speed {
            top_speed = PARABOLIC * inflow / narrowest;
            reason = format!("the narrowest section of {:.2} mm^2", narrowest * 1e6);
        }
        // A flow driven by pressure alone cannot be faster than Bernoulli, nor than Poiseuille.
        if inlet.is_none() {
            let bernoulli = (2.0 * imposed / density).sqrt();
            let poiseuille = imposed * smallest_radius * smallest_radius / (4.0 * viscosity * length);
            top_speed = bernoulli.min(poiseuille);
            reason = "the pressure difference between the openings".to_owned();
        }
        let mean = top_speed / PARABOLIC;
        let friction = 8.0 * viscosity * mean * length / (smallest_radius * smallest_radius);
        let inertia = if ramp > 0.0 { density * length * mean * PI / (2.0 * ramp) } else { 0.0 };
        let dynamic = 0.5 * density * top_speed * top_speed;
        let parts = [
            (imposed, "the imposed pressures"),
            (friction, "friction along the vessel"),
            (inertia, "the start of the inflow"),
            (dynamic, "the dynamic pressure"),
        ];
        let cause = parts.iter().max_by(|a, b| a.0.total_cmp(&b.0)).map_or("", |p| p.1);
        let reynolds_peak = inlet.map_or(density * mean * 2.0 * smallest_radius / viscosity, |(r, u)| {
            density * u * 2.0 * r / viscosity
        });
        Self {
            top_speed,
            top_speed_reason: reason,
            pressure_range: imposed + friction.max(inertia) + dynamic,
            pressure_reason: format!("mostly {cause}"),
            reynolds_peak,
            inlet_radius,
            smallest_radius,
        }
    }
}

/// Pressures \[Pa\] that the inflow leads to at the caps of the outlet models: those of their periodic cycles, each under its share of an
/// inflow that repeats; else that of all of them together under a `peak` \[m^3/s\] that stays. `None` where there are no models, or the
/// pressure would rise for ever.
fn behind_outlets(openings: &[PlannedOpening], peak: f64, is_driven: bool) -> Option<[f64; 2]> {
    let models: Vec<Windkessel> = openings.iter().filter_map(|o| o.condition.model().map(|m| m.0)).collect();
    let steady = || mean_split(&models, peak).map(|(pressure, _)| [pressure; 2]).ok();
    let Some(inflow) = start::inflow(openings).filter(|_| !is_driven) else { return steady() };
    let (_, shares) = mean_split(&models, inflow.mean()).ok()?;
    let cycles: Result<Vec<_>, _> =
        models.iter().zip(shares).map(|(model, share)| model.periodic(&inflow.scaled(share))).collect();
    let Ok(cycles) = cycles else { return steady() };
    let ends = cycles.iter().map(|cycle| [cycle.diastolic, cycle.systolic]);
    ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// Length of a vessel \[m\]: from an opening to the point of its surface farthest away. Unlike a box along the axes it is the same
/// however the vessel is turned.
fn length(vessel: &Vessel) -> f64 {
    let from = |opening: &Opening| {
        vessel.surface.vertices.iter().map(|v| v.distance_squared(opening.center)).fold(0.0, f64::max)
    };
    vessel.openings.iter().map(from).fold(0.0, f64::max).sqrt()
}

/// Peak over mean of a developed profile.
const PARABOLIC: f64 = 2.0;
/// Time a core takes in mixed precision for an acoustic step of a fluid particle, for an advective step of one, and for an acoustic step
/// of a particle of a wall at rest \[s\]: of the first twenty seconds of the shipped cases on two threads.
const ACOUSTIC: f64 = 0.200e-6;
const ADVECTIVE: f64 = 0.87e-6;
const WALL_AT_REST: f64 = 0.013e-6;
/// What an advective step of a particle takes longer where the viscosity follows the shear rate, and where the stress on the wall is taken in
/// each of them for the measures of a cycle \[s\].
const SHEAR_THINNING: f64 = 0.19e-6;
const WALL_SHEAR: f64 = 0.35e-6;
/// Share of the threads that is at work.
const EFFICIENCY: f64 = 0.87;
/// How much longer all of it takes in double precision.
const DOUBLE: f64 = 1.5;
/// Time a particle of a solid takes a core for one sub-step, and for what it and the blood show each other in an acoustic step \[s\]: of the
/// same runs.
const SUBSTEP_SOLID: f64 = 0.25e-6;
const STEP_SOLID: f64 = 0.16e-6;
/// The same of a shell, whatever its material.
const SUBSTEP_SHELL: f64 = 0.27e-6;
const STEP_SHELL: f64 = 0.375e-6;
/// Time \[s\] for which threads wait for each other in a sub-step, however few particles there are.
const WAITING: f64 = 0.08e-3;
/// Time a particle of any body takes a core to be made \[s\]: of the same runs.
const GENERATION: f64 = 0.22e-3;
/// Bytes a fluid particle takes, rows included.
const BYTES_MIXED: f64 = 2000.0;
const BYTES_DOUBLE: f64 = 2800.0;
/// Bytes a particle of a wall takes, rows included.
const BYTES_WALL: f64 = 400.0;
/// Bytes of a column over those of a particle of a wall: its ghosts are rows and records as well.
const BYTES_SHELL: f64 = 4.0;

/// Expected particles, memory and time of a run, with a wall that is a solid, a shell or at rest, and widens by a radial strain, by which there
/// is more blood than at the start.
pub fn cost(
    case: &Case,
    numbers: &Numbers,
    (solid, shell, radial_strain): (Option<&PlannedWall>, Option<&PlannedShell>, f64),
    precision: Precision,
    end_time: f64,
) -> Predicted {
    let spacing = numbers.spacing;
    let fluid = case.vessel.surface.volume() / spacing.powi(3);
    let layer = solid.map_or(vaso_generation::WALL_LAYERS * spacing, |s| s.thickness);
    let wall_spacing = solid.map_or(spacing, |s| s.numbers.spacing);
    // A curved wall has more volume outside than a flat one: 1 + t / 2R, with R = 2V/A of a tube.
    let area = case.vessel.wall_area();
    let radius = 2.0 * case.vessel.surface.volume() / area;
    let collars: f64 =
        case.vessel.openings.iter().map(|o| 2.0 * PI * o.radius * 2.0 * numbers.smoothing_length).sum();
    let layers = (area + collars) * layer * (1.0 + 0.5 * layer / radius) / wall_spacing.powi(3);
    let one_layer = match &case.scene.wall {
        vaso_scene::Wall::Rigid | vaso_scene::Wall::Solid(_) => 0.0,
        vaso_scene::Wall::RigidShell | vaso_scene::Wall::Shell(_) => {
            (area + collars) / crate::bodies::shell_spacing(&case.scene).powi(2)
        }
    };
    let wall = if one_layer > 0.0 { 0.0 } else { layers };
    let step = numbers.acoustic_step(0.5 * numbers.reference_speed);
    let (slower, bytes) = match precision {
        Precision::Mixed => (1.0, BYTES_MIXED),
        Precision::Double => (DOUBLE, BYTES_DOUBLE),
    };
    // Acoustic steps are as many as an advective one needs, a whole number.
    let per_advective = (numbers.advective_step(numbers.reference_speed, 0.0) / step).ceil().max(1.0);
    let at_rest = if solid.is_some() || shell.is_some() { 0.0 } else { wall };
    let thinning = if numbers.rheology.is_some() { SHEAR_THINNING } else { 0.0 };
    let shear = if case.scene.output.fields.iter().any(|f| f.is_of_a_cycle()) { WALL_SHEAR } else { 0.0 };
    let advective = ADVECTIVE + thinning + shear;
    let fluid_time = slower
        * (end_time / step)
        * (fluid * (1.0 + radial_strain).powi(2) * (ACOUSTIC + advective / per_advective)
            + at_rest * WALL_AT_REST);
    let threads = rayon::current_num_threads() as f64;
    let waiting = if threads > 1.0 { WAITING * threads } else { 0.0 };
    let solid_time = solid.map_or(0.0, |s| {
        let own = s.numbers.stable_step(s.material.wave_speed(s.numbers.density), 0.0);
        let substep = wall * SUBSTEP_SOLID + waiting;
        (end_time / step) * ((step / own).ceil() * substep + wall * STEP_SOLID)
    });
    let shell_time = shell.map_or(0.0, |s| {
        let own = s.numbers.expected_step(&s.material, s.thickness);
        let substep = one_layer * SUBSTEP_SHELL + waiting;
        (end_time / step) * ((step / own).ceil() * substep + one_layer * STEP_SHELL)
    });
    let at_work = if threads > 1.0 { EFFICIENCY * threads } else { threads };
    Predicted {
        particles: ParticleCounts {
            fluid: fluid.round() as u64,
            wall: wall.round() as u64,
            shell: one_layer.round() as u64,
        },
        memory_bytes: (fluid * bytes + (wall + BYTES_SHELL * one_layer) * BYTES_WALL) as u64,
        wall_clock_s: (fluid_time + solid_time + shell_time + (fluid + wall + one_layer) * GENERATION)
            / at_work,
    }
}
