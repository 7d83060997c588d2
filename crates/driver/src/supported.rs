//! What this version can run, and every effect it knows.

use crate::bodies::{shell_settings, shell_spacing, wall_shape, wall_spacing};
use crate::case::Case;
use crate::error::{DriverError, problem};
use crate::plan::PlannedOpening;
use crate::print::length;
use crate::shell::PlannedShell;
use crate::structure::PlannedWall;
use crate::timing;
use vaso_boundary::{Condition, Source};
use vaso_fluid::{Numbers, Rheology};
use vaso_generation::Ends;
use vaso_io::EffectEntry;

use vaso_scene::material::{Material, Viscosity};
use vaso_scene::{Blood, Field, Scene, Wall, Word};

/// Refuses, all at once, what a case asks for and this version does not have.
///
/// # Errors
/// One problem for each such request.
pub(crate) fn check(case: &Case) -> Result<(), DriverError> {
    let scene = &case.scene;
    let mut problems = Vec::new();
    let (thickness, ends) = wall_shape(scene);
    let reach = 2.0 * scene.numerics.smoothing_length;
    if matches!(scene.wall, Wall::Rigid) && thickness < reach * scene.particles.spacing {
        problems.push(problem(
            scene,
            "wall.thickness",
            format!("is thinner than the {reach} spacings that the blood sees of a rigid wall"),
            format!("at least {}", length(reach * scene.particles.spacing)),
            "make it thicker, or leave it out",
        ));
    }
    let mut refuse = |key: String, seen: &str, allowed: &str| {
        let message = format!("\"{seen}\" is not in this version");
        problems.push(problem(scene, &key, message, allowed, "take what is allowed, or remove it"));
    };
    let is_elastic = matches!(scene.wall, Wall::Solid(_) | Wall::Shell(_));
    let has_collar = match scene.wall {
        Wall::Rigid | Wall::Solid(_) => matches!(ends, Ends::Collar { .. }),
        Wall::RigidShell | Wall::Shell(_) => shell_settings(scene).collar > 0.0,
    };
    if !has_collar {
        let seen = if matches!(ends, Ends::Boxes) { "boxes" } else { "closest-cap" };
        refuse("wall.open_ends".into(), seen, "\"collar\"");
    }
    for field in &scene.output.fields {
        if !is_elastic && matches!(field, Field::Displacement | Field::VonMises) {
            refuse(
                "output.fields".into(),
                field.word(),
                "fields of blood and of the stress it has on the wall",
            );
        }
    }
    if let Wall::Solid(wall) | Wall::Shell(wall) = &scene.wall {
        let is_shell = matches!(scene.wall, Wall::Shell(_));
        let only_of_solids = match wall.material {
            Material::Hypoelastic(_) => Some("hypoelastic"),
            Material::HolzapfelGasserOgden(_) => Some("holzapfel-gasser-ogden"),
            Material::NeoHookean(_) | Material::SaintVenantKirchhoff(_) => None,
        };
        if let (true, Some(seen)) = (is_shell, only_of_solids) {
            refuse("wall.material".into(), seen, "for a shell \"neo-hookean\", \"saint-venant-kirchhoff\"");
        }
        let blood = scene.particles.spacing;
        let own = if is_shell { shell_spacing(scene) } else { wall_spacing(wall, blood) };
        if own > blood * (1.0 + 1e-9) {
            problems.push(problem(
                scene,
                "wall.spacing",
                "is wider than that of the blood, which would see gaps in the wall",
                format!("at most {}", length(blood)),
                "make it at most that, or leave it out",
            ));
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(DriverError::Input { problems }) }
}

/// Whether a field is wall shear stress or made of it.
pub(crate) fn is_shear(field: Field) -> bool {
    field == Field::Wss || field.is_of_a_cycle()
}

/// Shear rate at which the viscosity of a law stands for all in the numbers of a plan \[1/s\]: that of a large artery.
const TYPICAL_SHEAR_RATE: f64 = 100.0;

/// The blood of a plan.
pub(crate) struct PlannedBlood {
    /// Rest density \[kg/m^3\].
    pub(crate) density: f64,
    /// Viscosity; of a law of the shear rate that at 100/s \[Pa s\].
    pub(crate) viscosity: f64,
    /// Law of the shear rate; `None` for Newtonian blood.
    pub(crate) rheology: Option<Rheology>,
}

/// The blood of a scene.
///
/// # Errors
/// When there is none.
pub(crate) fn blood(scene: &Scene) -> Result<PlannedBlood, DriverError> {
    let Some(Blood { density, viscosity }) = scene.blood else {
        return Err(DriverError::input(problem(
            scene,
            "blood",
            "is missing, and this version moves no wall without it",
            "a table, which may be empty",
            "add `[blood]`",
        )));
    };
    let rheology = match viscosity {
        Viscosity::Newtonian { viscosity } => return Ok(PlannedBlood { density, viscosity, rheology: None }),
        Viscosity::CarreauYasuda {
            zero_shear_viscosity,
            infinite_shear_viscosity,
            relaxation_time,
            index,
            transition,
        } => Rheology::CarreauYasuda {
            zero_shear: zero_shear_viscosity,
            infinite_shear: infinite_shear_viscosity,
            relaxation_time,
            index,
            transition,
        },
        Viscosity::Casson { yield_stress, infinite_shear_viscosity } => {
            Rheology::Casson { yield_stress, infinite_shear: infinite_shear_viscosity }
        }
        Viscosity::PowerLaw { consistency, index } => Rheology::PowerLaw { consistency, index },
    };
    let viscosity = rheology.viscosity(TYPICAL_SHEAR_RATE);
    Ok(PlannedBlood { density, viscosity, rheology: Some(rheology) })
}

/// Every effect the program knows, with the reason it is on or off.
pub(crate) fn effects(
    scene: &Scene,
    numbers: &Numbers,
    openings: &[PlannedOpening],
    wall: Option<&PlannedWall>,
    shell: Option<&PlannedShell>,
) -> Vec<EffectEntry> {
    let named = |test: &dyn Fn(&Condition) -> bool| {
        let names: Vec<&str> =
            openings.iter().filter(|o| test(&o.condition)).map(|o| o.name.as_str()).collect();
        names.join(", ")
    };
    let inlets = named(&|c| matches!(c, Condition::Velocity { .. }));
    let outlets = named(&|c| matches!(c, Condition::Pressure { .. }));
    let resistances = named(&|c| matches!(c, Condition::Resistance { .. }));
    let windkessels = named(&|c| matches!(c, Condition::Windkessel { .. }));
    let tables = named(&|c| match c {
        Condition::Velocity { mean: signal, .. } | Condition::Pressure { value: signal } => {
            matches!(signal.source, Source::Waveform(_))
        }
        Condition::Resistance { .. } | Condition::Windkessel { .. } => false,
    });
    let on = |name: &str, reason: String| EffectEntry {
        name: name.into(),
        on: true,
        called_for: true,
        reason,
        seconds: None,
        bytes: None,
    };
    let is_thinning =
        scene.blood.as_ref().is_some_and(|b| !matches!(b.viscosity, Viscosity::Newtonian { .. }));
    let either = |name: &str, names: &str, none: &str| {
        let active = !names.is_empty();
        let reason = match active {
            false => none.into(),
            true if name.starts_with("metrics.") => names.into(),
            true => format!("at {names}"),
        };
        EffectEntry { name: name.into(), on: active, called_for: active, reason, seconds: None, bytes: None }
    };
    // What every flow calls for, and a case may leave out.
    let always = |name: &str, is_on: bool, why: &str, why_not: &str| EffectEntry {
        on: is_on,
        ..on(name, if is_on { why.into() } else { format!("{why_not}; called for: {why}") })
    };
    let model = match scene.wall {
        Wall::Rigid => "rigid",
        Wall::RigidShell => "rigid-shell",
        Wall::Solid(_) => "solid",
        Wall::Shell(_) => "shell",
    };
    let of_model = |name: &str, is_on: bool, reason: String| EffectEntry {
        on: is_on,
        called_for: is_on,
        ..on(name, if is_on { reason } else { format!("`wall.model` is \"{model}\"") })
    };
    let shear: Vec<&str> = scene.output.fields.iter().filter(|f| is_shear(**f)).map(|f| f.word()).collect();
    let shear = shear.join(", ");
    let has_period = timing::period(scene, openings).is_some();
    vec![
        on(
            "blood.pressure",
            "a scene with blood: momentum and continuity of a weakly compressible fluid".into(),
        ),
        on("blood.viscosity", "viscous forces between particles and at the wall".into()),
        EffectEntry {
            on: is_thinning,
            called_for: is_thinning,
            ..on(
                "blood.shear_thinning",
                if is_thinning {
                    "`blood.viscosity` is a law of the shear rate".into()
                } else {
                    "`blood.viscosity` is a constant".into()
                },
            )
        },
        always(
            "blood.density_blend",
            numbers.density_blend > 0.0,
            "holds the density of a closed stream against drift",
            "`numerics.density_blend` is 0",
        ),
        always(
            "blood.gradient_correction",
            numbers.gradient_correction,
            "kernel sums at a wall or in disorder are 1 to 3 % off without it",
            "`numerics.gradient_correction` is false",
        ),
        always(
            "blood.transport_velocity",
            numbers.transport_velocity,
            "keeps particles evenly spread along streamlines",
            "`numerics.transport_velocity` is false",
        ),
        of_model(
            "wall.rigid",
            matches!(scene.wall, Wall::Rigid),
            "`wall.model` is \"rigid\": four layers of fixed particles, three of them in reach".into(),
        ),
        of_model(
            "wall.rigid_shell",
            matches!(scene.wall, Wall::RigidShell),
            "`wall.model` is \"rigid-shell\": one layer of fixed particles, with ghosts behind it".into(),
        ),
        of_model("wall.solid", wall.is_some(), wall.map_or(String::new(), PlannedWall::reason)),
        of_model("wall.shell", shell.is_some(), shell.map_or(String::new(), PlannedShell::reason)),
        EffectEntry {
            on: wall.is_some() || shell.is_some(),
            called_for: wall.is_some() || shell.is_some(),
            ..on(
                "wall.coupling",
                if wall.is_some() || shell.is_some() {
                    "the wall gets the forces it has on the blood, and shows where it is".into()
                } else {
                    "the wall does not move".into()
                },
            )
        },
        either("opening.velocity", &inlets, "no opening prescribes a velocity or flow"),
        either("opening.pressure", &outlets, "no opening prescribes a pressure"),
        either("opening.resistance", &resistances, "no opening has a resistance"),
        either("opening.windkessel", &windkessels, "no opening has a Windkessel"),
        either("opening.waveform", &tables, "all openings are steady"),
        either("metrics.wall_shear", &shear, "`output.fields` names nothing of it"),
        either(
            "metrics.cycles",
            if has_period { "all openings, over each period" } else { "" },
            "nothing has a period",
        ),
        on(
            "metrics.energy",
            "what goes in through the openings against heat and motion: a check of the run".into(),
        ),
        either(
            "metrics.settling",
            match (scene.run.steady, scene.run.periodicity) {
                (Some(_), _) => "`run.steady` may end the run early",
                (None, Some(_)) => "`run.periodicity` may end the run early",
                (None, None) => "",
            },
            "neither `run.steady` nor `run.periodicity` is given",
        ),
        either(
            "probes",
            &scene.probes.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", "),
            "no `[[probe]]` in the case",
        ),
    ]
}
