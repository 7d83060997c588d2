//! Walls of one layer: the shell that deforms, with its numbers and their reasons, and the one at rest.

use crate::bodies;
use crate::case::Case;
use crate::error::{DriverError, problem};
use crate::plan::Plan;
use crate::pulse::PulseWave;
use crate::structure;
use vaso_coupling::{Foot, GhostColumns, ShellWall};
use vaso_fluid::Real;
use vaso_generation::ShellBody;
use vaso_scene::Wall;
use vaso_scene::material::{Damping, ElasticWall, Elasticity, Ends, Material as SceneMaterial};
use vaso_shell::{Material, Model, Numbers, Particles, Shell, ShellError, Support};

/// A wall of one layer that will deform.
#[derive(Clone, Debug)]
pub struct PlannedShell {
    /// Numbers of the shell.
    pub numbers: Numbers,
    /// What it is made of.
    pub material: Material,
    /// Thickness \[m\].
    pub thickness: f64,
    /// Pulse wave expected.
    pub pulse: PulseWave,
    /// Pressure of the blood beyond that at which the wall is unloaded, as far as the equation of state does not carry it
    /// \[Pa\].
    pub carried_pressure: f64,
    /// Share of the impedance of the blood that it takes implicitly, where it is too light to do without.
    pub implicit_impedance: Option<f64>,
}

/// Damping of a shell in motion, and of one that has to come to rest.
const DAMPING: f64 = 0.05;
const QUASI_STATIC_DAMPING: f64 = 0.5;
/// Points through the thickness of a neo-Hookean shell.
const POINTS: usize = 3;
/// Thickness over the radius of the narrowest opening above which stresses of a shell are doubtful.
const THICK: f64 = 0.2;

impl PlannedShell {
    /// The wall of a case; `None` unless it is a shell that deforms.
    ///
    /// # Errors
    /// When its numbers have no meaning.
    pub(crate) fn new(case: &Case, reference_pressure: f64) -> Result<Option<Self>, DriverError> {
        let scene = &case.scene;
        let (Wall::Shell(wall), Some(blood)) = (&scene.wall, &scene.blood) else { return Ok(None) };
        let wrong =
            |e: ShellError| DriverError::input(problem(scene, "wall", e.to_string(), "", "change its keys"));
        let material = material(wall).map_err(wrong)?;
        let mut numbers = Numbers::new(wall.density, bodies::shell_spacing(scene));
        numbers.damping = match wall.damping {
            Damping::None => 0.0,
            Damping::Material => DAMPING,
            Damping::QuasiStatic => QUASI_STATIC_DAMPING,
        };
        Ok(Some(Self {
            numbers,
            material,
            thickness: wall.thickness,
            pulse: PulseWave::new(&case.vessel, material.plate() * wall.thickness, blood.density),
            carried_pressure: reference_pressure - wall.unloaded_pressure,
            implicit_impedance: structure::implicit_impedance(wall, blood.density * scene.particles.spacing),
        }))
    }

    /// What is doubtful about it.
    pub(crate) fn warnings(&self, case: &Case) -> Vec<String> {
        let share = self.thickness / narrowest(case);
        let mut warnings = Vec::new();
        if share > THICK {
            warnings.push(format!(
                "the wall is {share:.2} times as thick as the narrowest opening is wide in radius; the stress of a shell is \
                 wrong by about half of that: take `wall.model` = \"solid\""
            ));
        }
        warnings
    }

    /// Why the effect is on.
    pub(crate) fn reason(&self) -> String {
        let light = match self.implicit_impedance {
            Some(share) => {
                format!("; it takes {share} of the impedance of the blood implicitly, being light")
            }
            None => String::new(),
        };
        let law = match self.material.model() {
            Model::Resultant => "linear resultants, for strains below 5 %".to_owned(),
            Model::NeoHookean { points } => format!("neo-Hookean at {points} points through the thickness"),
        };
        format!(
            "`wall.model` is \"shell\": one layer of {:.3} mm, {:.2} spacings thick; {law}{light}",
            1e3 * self.numbers.spacing,
            self.thickness / self.numbers.spacing
        )
    }

    /// The shell of the particles `body` with its ghost columns, held and loaded as the case says.
    ///
    /// # Errors
    /// When the particles do not make a shell.
    pub(crate) fn build<R: Real>(
        &self,
        case: &Case,
        plan: &Plan,
        body: &ShellBody,
    ) -> Result<ShellWall<R>, DriverError> {
        let Wall::Shell(wall) = &case.scene.wall else {
            return Err(DriverError::input("a wall that is planned as a shell is one"));
        };
        self.shell(case, plan, wall, body)
            .and_then(|shell| ShellWall::new(shell, plan.numbers.spacing, bodies::support(&case.scene)))
            .map_err(|e| {
                DriverError::input(problem(&case.scene, "wall", e.to_string(), "", "change its keys"))
            })
    }

    fn shell<R: Real>(
        &self,
        case: &Case,
        plan: &Plan,
        wall: &ElasticWall,
        body: &ShellBody,
    ) -> Result<Shell<R>, ShellError> {
        let particles = Particles {
            position: &body.position,
            normal: &body.normal,
            area: &body.area,
            thickness: &body.thickness,
        };
        let mut shell = Shell::new(&particles, self.material, self.numbers, plan.isa)?;
        hold(&mut shell, case, wall.ends, body, self.thickness)?;
        let all: Vec<u32> = (0..body.position.len() as u32).collect();
        if self.carried_pressure != 0.0 {
            shell.add_pressure(&all, &face_areas(body, -0.5), self.carried_pressure)?;
        }
        if wall.external_pressure != 0.0 {
            shell.add_pressure(&all, &face_areas(body, 0.5), -wall.external_pressure)?;
        }
        if let Some(tissue) = wall.support {
            shell.add_tissue(&all, tissue.stiffness, tissue.damping)?;
        }
        if let Some(share) = self.implicit_impedance {
            shell.add_impedance(&all, plan.numbers.rest_density * plan.numbers.sound_speed, share)?;
        }
        Ok(shell)
    }
}

/// Areas \[m^2\] of the face at a height of `share` thicknesses over the mid-surface, by Steiner's formula.
fn face_areas(body: &ShellBody, share: f64) -> Vec<f64> {
    let columns = body.area.iter().zip(&body.thickness).zip(&body.curvature);
    columns.map(|((area, t), [k1, k2])| area * (1.0 + share * t * k1) * (1.0 + share * t * k2)).collect()
}

/// Holds the ring at each opening, as that of a solid.
fn hold<R: Real>(
    shell: &mut Shell<R>,
    case: &Case,
    ends: Ends,
    body: &ShellBody,
    thickness: f64,
) -> Result<(), ShellError> {
    for opening in &case.vessel.openings {
        let held = structure::ring(case, opening, thickness, &body.position, &body.normal);
        match ends {
            Ends::Clamped => shell.hold(&held, Support::CLAMPED)?,
            Ends::Sliding => shell.hold(&held, Support::sliding(opening.normal))?,
            Ends::Free => {}
        }
    }
    Ok(())
}

/// Ghost columns of a shell at rest, whose particles stand on the face of the lumen.
pub(crate) fn rigid_columns(case: &Case, plan: &Plan, body: &ShellBody) -> GhostColumns {
    let foot = |i: usize| Foot {
        position: body.position[i],
        normal: body.normal[i],
        area: body.area[i],
        curvature: body.curvature[i],
        ..Foot::default()
    };
    let feet = (0..body.position.len()).map(foot).collect();
    GhostColumns::new(feet, plan.numbers.spacing, bodies::support(&case.scene))
}

fn narrowest(case: &Case) -> f64 {
    case.vessel.openings.iter().map(|o| o.radius).fold(f64::INFINITY, f64::min)
}

fn material(wall: &ElasticWall) -> Result<Material, ShellError> {
    match wall.material {
        SceneMaterial::NeoHookean(Elasticity { young_modulus, poisson_ratio }) => {
            Material::new(young_modulus, poisson_ratio, Model::NeoHookean { points: POINTS })
        }
        SceneMaterial::SaintVenantKirchhoff(Elasticity { young_modulus, poisson_ratio }) => {
            Material::new(young_modulus, poisson_ratio, Model::Resultant)
        }
        // Refused before.
        SceneMaterial::Hypoelastic(_) | SceneMaterial::HolzapfelGasserOgden(_) => {
            Err(ShellError::Count { what: "material", given: 0, expected: 1 })
        }
    }
}
