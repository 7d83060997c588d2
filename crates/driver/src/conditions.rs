//! What is imposed at the openings of a run.

use crate::case::Case;
use crate::error::{DriverError, problem};
use crate::print::length;
use glam::DVec3;
use vaso_boundary::{
    Condition, Coupling, Integration, Interpolation, Profile, Signal, Source, Waveform, Windkessel,
};
use vaso_scene::Drive;

/// One opening as it will run.
#[derive(Clone, Debug)]
pub struct PlannedOpening {
    /// Name from the case.
    pub name: String,
    /// Cap of the vessel.
    pub opening: vaso_geometry::Opening,
    /// What is imposed.
    pub condition: Condition,
    /// How an outlet model takes up the flow.
    pub coupling: Coupling,
    /// How strongly backflow through an outlet model is damped; `None` for as much as usual.
    pub backflow_damping: Option<f64>,
}

/// Openings of the vessel with what the case says of them; `ramp` \[s\] is that of inlets which ask for none.
///
/// # Errors
/// One problem for each opening nothing is said of, for each condition that cannot be, and where nothing sets a pressure.
pub(crate) fn plan(case: &Case, ramp: f64) -> Result<Vec<PlannedOpening>, DriverError> {
    let scene = &case.scene;
    let mut problems = Vec::new();
    let mut planned = Vec::new();
    for (k, opening) in case.vessel.openings.iter().enumerate() {
        let Some(spec) = case.scene_opening[k].map(|s| &scene.openings[s]) else {
            let c: DVec3 = opening.center / case.vessel.unit.metres();
            problems.push(problem(
                scene,
                "opening",
                format!(
                    "nothing is said about the opening of the surface at [{:.3}, {:.3}, {:.3}] of radius {}",
                    c.x,
                    c.y,
                    c.z,
                    length(opening.radius)
                ),
                "one `[[opening]]` for each opening of the surface",
                format!("add one with near = [{:.3}, {:.3}, {:.3}]", c.x, c.y, c.z),
            ));
            continue;
        };
        let profile = |p: vaso_scene::Profile| match p {
            vaso_scene::Profile::Plug => Profile::Plug,
            vaso_scene::Profile::Parabolic => Profile::Parabolic,
            vaso_scene::Profile::Power { exponent } => Profile::Power { exponent },
            vaso_scene::Profile::FullyDeveloped => Profile::FullyDeveloped,
            vaso_scene::Profile::Womersley => Profile::Womersley,
        };
        let condition = match &spec.condition {
            vaso_scene::Condition::Velocity { profile: p, value } => {
                signal(value, 1.0, spec.ramp.unwrap_or(ramp))
                    .map(|mean| Condition::Velocity { profile: profile(*p), mean })
            }
            vaso_scene::Condition::Flow { profile: p, value } => {
                signal(value, 1.0 / opening.area, spec.ramp.unwrap_or(ramp))
                    .map(|mean| Condition::Velocity { profile: profile(*p), mean })
            }
            vaso_scene::Condition::Pressure { value } => {
                signal(value, 1.0, spec.ramp.unwrap_or(0.0)).map(|value| Condition::Pressure { value })
            }
            &vaso_scene::Condition::Resistance { resistance, distal_pressure } => {
                Ok(Condition::Resistance { resistance, distal_pressure })
            }
            &vaso_scene::Condition::Windkessel {
                proximal_resistance,
                distal_resistance,
                compliance,
                initial_pressure,
                distal_pressure,
                periodic_start: _,
            } => {
                let model =
                    Windkessel { proximal_resistance, compliance, distal_resistance, distal_pressure };
                Ok(Condition::Windkessel { model, initial_pressure })
            }
        };
        let is_sound = |c: Condition| c.validate().map_err(|e| e.to_string()).map(|()| c);
        match condition.and_then(is_sound) {
            Ok(condition) => {
                planned.push(PlannedOpening {
                    name: spec.name.clone(),
                    opening: opening.clone(),
                    condition,
                    coupling: coupling(spec.coupling),
                    backflow_damping: spec.backflow_damping,
                });
            }
            Err(text) => {
                let key = format!("opening.{}.condition", spec.name);
                problems.push(problem(scene, &key, text, "", "correct the keys of this condition"));
            }
        }
    }
    if problems.is_empty() && !planned.iter().any(|o| o.condition.sets_pressure()) {
        problems.push(problem(
            scene,
            "opening",
            "every opening prescribes its flow, so nothing sets the pressure and a mismatch of the flows would pile up",
            "at least one of condition \"pressure\", \"resistance\" or \"windkessel\"",
            "give the vessel an outlet",
        ));
    }
    if problems.is_empty() { Ok(planned) } else { Err(DriverError::Input { problems }) }
}

fn signal(drive: &Drive, scale: f64, ramp: f64) -> Result<Signal, String> {
    let source = match drive {
        Drive::Constant(value) => Source::Constant(value * scale),
        Drive::Waveform(table) => {
            let value = table.value.iter().map(|v| v * scale).collect();
            let interpolation = match table.interpolation {
                vaso_scene::Interpolation::Linear => Interpolation::Linear,
                vaso_scene::Interpolation::Monotone => Interpolation::Monotone,
                vaso_scene::Interpolation::Fourier { harmonics } => {
                    Interpolation::Fourier { harmonics: harmonics as usize }
                }
            };
            let wave = Waveform::new(table.time.clone(), value, table.period)
                .and_then(|wave| wave.interpolated(interpolation))
                .map_err(|e| format!("{}: {e}", table.file.display()))?;
            Source::Waveform(wave)
        }
    };
    Ok(Signal { source, ramp })
}

/// The window is that of the paper, with its modified Euler (Zhang, Fan, Wu, Zhang, Hu 2024).
fn coupling(asked: vaso_scene::Coupling) -> Coupling {
    match asked {
        vaso_scene::Coupling::Impedance => Coupling::Impedance,
        vaso_scene::Coupling::Window { duration } => {
            Coupling::Window { duration, integration: Integration::ModifiedEuler }
        }
    }
}
