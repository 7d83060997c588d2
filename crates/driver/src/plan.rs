//! From a case to a plan: which effects run, with which numbers, why, and at what expected cost.

use crate::calls;
use crate::case::Case;
use crate::conditions;
pub use crate::conditions::PlannedOpening;
use crate::error::DriverError;
use crate::estimate;
use crate::machine;
use crate::print::length;
use crate::shell::PlannedShell;
use crate::structure::PlannedWall;
use crate::{start, supported, timing};
use vaso_boundary::Condition;
use vaso_fluid::{Isa, Numbers};
use vaso_io::{EffectEntry, Predicted};
use vaso_scene::Precision;

/// What will run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Numbers of the fluid.
    pub numbers: Numbers,
    /// Why the sound speed is what it is.
    pub sound_speed_reason: String,
    /// Openings with their conditions, largest first.
    pub openings: Vec<PlannedOpening>,
    /// The wall, where it is a solid.
    pub wall: Option<PlannedWall>,
    /// The wall, where it is a shell that deforms.
    pub shell: Option<PlannedShell>,
    /// Pressure the equation of state is relative to \[Pa\]; `None` follows the first pressure outlet, or else the
    /// outlet models.
    pub reference_pressure: Option<f64>,
    /// Arithmetic of the pair loops.
    pub precision: Precision,
    /// Instruction set of the pair loops.
    pub isa: Isa,
    /// Time over which inlets are ramped \[s\].
    pub ramp: f64,
    /// End of the run \[s\].
    pub end_time: f64,
    /// Period of the pulse \[s\]; `None` for a flow that has none.
    pub period: Option<f64>,
    /// Time in which a flow without a period settles \[s\].
    pub settling_time: f64,
    /// Whether wall shear stress is asked for.
    pub wall_metrics: bool,
    /// Peak Reynolds number at the inlet.
    pub reynolds_peak: f64,
    /// Womersley number at the inlet, for pulsatile flow.
    pub womersley: Option<f64>,
    /// Radial strain expected of a wall that deforms \[-\].
    pub radial_strain: Option<f64>,
    /// Viscosity; of a law of the shear rate that at a rate typical of arteries \[Pa s\].
    pub viscosity: f64,
    /// Every effect the program knows.
    pub effects: Vec<EffectEntry>,
    /// Expected cost, on the machine on which its constants were fitted; see [`Self::expected`].
    pub predicted: Predicted,
    /// Advice.
    pub warnings: Vec<String>,
}

/// Density change allowed for the pressure range in the equation of state.
const DENSITY_CHANGE: f64 = 0.01;
/// Share of the kernel sum in the density where a wall deforms. The default settles within some thirty advective steps, in which an elastic
/// wall would give way by what the unevenness of the particles adds to the sum: a pulse wave lost an eighth of its speed and a tenth of its
/// height in fifteen diameters.
const BLEND_BESIDE_ELASTIC_WALLS: f64 = 0.003;

impl Plan {
    /// Whether the wall deforms.
    pub fn deforms(&self) -> bool {
        self.wall.is_some() || self.shell.is_some()
    }

    /// Expected cost on this machine, which is measured for that once.
    pub fn expected(&self) -> Predicted {
        let wall_clock_s = self.predicted.wall_clock_s * machine::slowness();
        Predicted { wall_clock_s, ..self.predicted }
    }

    /// Plans a case.
    ///
    /// # Errors
    /// When the case asks for what this version does not have, or its openings cannot drive a flow.
    pub fn new(case: &Case) -> Result<Self, DriverError> {
        supported::check(case)?;
        let scene = &case.scene;
        let supported::PlannedBlood { density, viscosity, rheology } = supported::blood(scene)?;
        let ramp_default = scene.run.period.map_or(DEFAULT_RAMP, |period| DEFAULT_RAMP.max(0.1 * period));
        let mut openings = conditions::plan(case, ramp_default)?;
        start::periodic(case, &mut openings)?;
        let period = timing::period(scene, &openings);
        let ramp = openings.iter().filter_map(|o| inlet_ramp(&o.condition)).fold(0.0, f64::max);

        // Where walls deform the reference has to stay what it is: see the decision on the uniform pressure.
        let reference_pressure = match &scene.wall {
            vaso_scene::Wall::Solid(wall) | vaso_scene::Wall::Shell(wall) => {
                Some(scene.numerics.reference_pressure.unwrap_or(wall.unloaded_pressure))
            }
            _ => scene.numerics.reference_pressure,
        };
        let flow = estimate::Flow::new(&case.vessel, &openings, density, viscosity, ramp, reference_pressure);
        let wall = PlannedWall::new(case, reference_pressure.unwrap_or(0.0), flow.pressure_range)?;
        let shell = PlannedShell::new(case, reference_pressure.unwrap_or(0.0))?;
        let by_speed = scene.numerics.sound_speed_factor * flow.top_speed;
        let by_pressure = (flow.pressure_range / (DENSITY_CHANGE * density)).sqrt();
        let pulse = wall.as_ref().map(|w| w.pulse).or(shell.as_ref().map(|s| s.pulse));
        let decisive = pulse.filter(|p| p.sound_speed() >= by_speed.max(by_pressure));
        let (sound_speed, sound_speed_reason) = match (scene.numerics.sound_speed, decisive) {
            (Some(given), _) => (given, "given in the case".to_owned()),
            (None, Some(pulse)) => (pulse.sound_speed(), pulse.reason()),
            (None, None) if by_speed >= by_pressure => (
                by_speed,
                format!(
                    "{} times the expected top speed of {:.3} m/s ({})",
                    scene.numerics.sound_speed_factor, flow.top_speed, flow.top_speed_reason
                ),
            ),
            (None, None) => (
                by_pressure,
                format!(
                    "keeps the density within {:.0} % over a pressure range of {:.0} Pa ({})",
                    100.0 * DENSITY_CHANGE,
                    flow.pressure_range,
                    flow.pressure_reason
                ),
            ),
        };
        let spacing = scene.particles.spacing;
        let across = 2.0 * flow.smallest_radius / spacing;
        let mut numbers = Numbers::new(density, viscosity, flow.top_speed, spacing);
        numbers.sound_speed = sound_speed;
        if let Some(law) = rheology {
            numbers.rheology = rheology;
            numbers.viscosity = law.extremes()[0];
        }
        numbers.smoothing_length = scene.numerics.smoothing_length * spacing;
        if wall.is_some() || shell.is_some() {
            numbers.density_blend = BLEND_BESIDE_ELASTIC_WALLS;
        }
        if let Some(share) = scene.numerics.density_blend {
            numbers.density_blend = share;
        }
        numbers.gradient_correction = scene.numerics.gradient_correction;
        numbers.transport_velocity = scene.numerics.transport_velocity;
        numbers.hold_mass = scene.numerics.hold_mass;

        let mut warnings = case.vessel.audit.notices.clone();
        let settings = crate::bodies::settings(scene);
        warnings.extend(vaso_generation::warnings(&case.vessel, &settings).iter().map(|w| told(case, w)));
        warnings.extend(wall.iter().flat_map(PlannedWall::warnings));
        warnings.extend(shell.iter().flat_map(|shell| shell.warnings(case)));
        if across < 12.0 {
            warnings.push(format!(
                "{across:.1} particles lie across the narrowest opening; flow patterns want 12, wall shear stress 20"
            ));
        }
        if flow.reynolds_peak > 2300.0 {
            warnings.push(format!(
                "the peak Reynolds number is {:.0}: the flow may be turbulent, and there is no turbulence model",
                flow.reynolds_peak
            ));
        }
        let precision = scene.numerics.precision;
        let isa = Isa::detect();
        let radial_strain = pulse.map(|p| flow.pressure_range / (2.0 * density * p.mean * p.mean));
        let walls = (wall.as_ref(), shell.as_ref(), radial_strain.unwrap_or(0.0));
        let predicted = estimate::cost(case, &numbers, walls, precision, scene.run.end_time);
        let womersley = scene
            .run
            .period
            .map(|t| flow.inlet_radius * (std::f64::consts::TAU * density / (t * viscosity)).sqrt());
        let mut effects = supported::effects(scene, &numbers, &openings, wall.as_ref(), shell.as_ref());
        let is_thinning = rheology.is_some();
        let called = calls::Scene { openings: &openings, womersley, radial_strain, is_thinning };
        warnings.extend(called.judge(&mut effects));
        Ok(Self {
            numbers,
            sound_speed_reason,
            reference_pressure,
            precision,
            isa,
            ramp,
            end_time: scene.run.end_time,
            period,
            settling_time: timing::settling(&case.vessel, &openings, &flow, viscosity / density),
            wall_metrics: scene.output.fields.iter().any(|f| supported::is_shear(*f)),
            reynolds_peak: flow.reynolds_peak,
            womersley,
            radial_strain,
            viscosity,
            effects,
            wall,
            shell,
            predicted,
            warnings,
            openings,
        })
    }
}

/// A warning of the generator, with the opening by its name.
fn told(case: &Case, warning: &vaso_generation::Warning) -> String {
    match *warning {
        vaso_generation::Warning::Unresolved { opening, radius, spacing, needed } => format!(
            "`{}` has only {:.1} spacings across its radius of {}; its flow needs a spacing of {} or less",
            case.opening_name(opening),
            radius / spacing,
            length(radius),
            length(needed)
        ),
        _ => warning.to_string(),
    }
}

/// Ramp of an inlet that asks for none \[s\].
const DEFAULT_RAMP: f64 = 0.05;

fn inlet_ramp(condition: &Condition) -> Option<f64> {
    match condition {
        Condition::Velocity { mean, .. } => Some(mean.ramp),
        _ => None,
    }
}
