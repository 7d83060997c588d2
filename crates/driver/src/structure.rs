//! The wall that deforms: its numbers with their reasons, and the solid made from its particles.

use crate::bodies;
use crate::case::Case;
use crate::error::{DriverError, problem};
use crate::fibers;
use crate::plan::Plan;
use crate::pulse::PulseWave;
use glam::DVec3;
use vaso_boundary::BUFFER_LENGTH;
use vaso_fluid::Real;
use vaso_generation::Body;
use vaso_geometry::{Opening, Vessel};
use vaso_scene::Wall;
use vaso_scene::material::{Damping, ElasticWall, Elasticity, Ends, Material as SceneMaterial};

use vaso_solid::{
    Face, HolzapfelGasserOgden, HypoElastic, Material, NeoHookean, Numbers, Particles, SaintVenantKirchhoff,
    Solid, SolidError,
};

/// A wall of several layers that will deform.
#[derive(Clone, Debug)]
pub struct PlannedWall {
    /// Numbers of the solid.
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
    /// Share of the impedance of the blood that the inner face takes implicitly, where it is too light to do without.
    pub implicit_impedance: Option<f64>,
}

/// Damping between pairs of a wall in motion, and of one that has to come to rest.
const DAMPING: f64 = 0.05;
const QUASI_STATIC_DAMPING: f64 = 0.5;
/// Mass of the wall over that of a layer of the blood, by area, below which the face answers the blood implicitly, and the share of it. A solid wall as
/// thick as a spacing and half as dense as the blood was driven apart.
const LIGHT: f64 = 0.8;
const IMPLICIT_SHARE: f64 = 0.5;
/// Layers that a wall needs to bend.
const LAYERS_TO_BEND: f64 = 8.0;
/// How far beyond the outer face of the wall something counts as belonging to an opening, in spacings.
const LATERAL: f64 = 2.0;

impl PlannedWall {
    /// The wall of a case; `None` unless it is a solid. `pressure_range` \[Pa\] is how far the blood's pressure is from the reference at most.
    ///
    /// # Errors
    /// When its numbers have no meaning.
    pub(crate) fn new(
        case: &Case,
        reference_pressure: f64,
        pressure_range: f64,
    ) -> Result<Option<Self>, DriverError> {
        let scene = &case.scene;
        let (Wall::Solid(wall), Some(blood)) = (&scene.wall, &scene.blood) else { return Ok(None) };
        let wrong =
            |e: SolidError| DriverError::input(problem(scene, "wall", e.to_string(), "", "change its keys"));
        let material = material(wall).map_err(wrong)?;
        let mut numbers = Numbers::new(wall.density, bodies::wall_spacing(wall, scene.particles.spacing));
        numbers.damping = match wall.damping {
            Damping::None => 0.0,
            Damping::Material => DAMPING,
            Damping::QuasiStatic => QUASI_STATIC_DAMPING,
        };
        let carried_pressure = reference_pressure - wall.unloaded_pressure;
        let radius = 2.0 * case.vessel.surface.volume() / case.vessel.wall_area();
        let load = (carried_pressure + pressure_range, radius, wall.thickness);
        Ok(Some(Self {
            numbers,
            material,
            thickness: wall.thickness,
            pulse: PulseWave::new(&case.vessel, plane_modulus(wall, load) * wall.thickness, blood.density),
            carried_pressure,
            implicit_impedance: implicit_impedance(wall, blood.density * scene.particles.spacing),
        }))
    }

    /// Number of layers.
    pub fn layers(&self) -> f64 {
        self.thickness / self.numbers.spacing
    }

    /// What is doubtful about it.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let layers = self.layers();
        let mut warnings = Vec::new();
        if layers < bodies::LAYERS_TO_INFLATE * (1.0 - 1e-9) {
            warnings.push(format!(
                "the wall has {layers:.1} layers; four are needed to inflate it within some per cent, eight to bend it; make \
                 `wall.spacing` smaller"
            ));
        }
        warnings
    }

    /// Why the effect is on, with what the layers are good for.
    pub(crate) fn reason(&self) -> String {
        let layers = self.layers();
        let good_for = match layers {
            l if l < bodies::LAYERS_TO_INFLATE * (1.0 - 1e-9) => "fewer than the four that inflation needs",
            l if l < LAYERS_TO_BEND * (1.0 - 1e-9) => "enough to inflate it; bending wants eight",
            _ => "enough to inflate and to bend it",
        };
        let light = match self.implicit_impedance {
            Some(share) => {
                format!("; it takes {share} of the impedance of the blood implicitly, being light")
            }
            None => String::new(),
        };
        format!(
            "`wall.model` is \"solid\": {layers:.1} layers of {:.3} mm, {good_for}{light}",
            1e3 * self.numbers.spacing
        )
    }

    /// The solid of the particles `body`, held and loaded as the case says.
    ///
    /// # Errors
    /// When the particles do not make a solid.
    pub(crate) fn build<R: Real>(
        &self,
        case: &Case,
        plan: &Plan,
        body: &Body,
    ) -> Result<Solid<R>, DriverError> {
        let Wall::Solid(wall) = &case.scene.wall else {
            return Err(DriverError::input("a wall that is planned as a solid is one"));
        };
        let directions = match self.material {
            Material::HolzapfelGasserOgden(_) => fibers::directions(case, body)?,
            _ => Vec::new(),
        };
        self.solid(case, plan, wall, body, &directions).map_err(|e| {
            DriverError::input(problem(&case.scene, "wall", e.to_string(), "", "change its keys"))
        })
    }

    fn solid<R: Real>(
        &self,
        case: &Case,
        plan: &Plan,
        wall: &ElasticWall,
        body: &Body,
        directions: &[[DVec3; 2]],
    ) -> Result<Solid<R>, SolidError> {
        let particles = Particles {
            position: &body.position,
            volume: &body.volume,
            depth: &body.depth,
            directions,
            ..Particles::default()
        };
        let mut solid = Solid::new(&particles, self.material, self.numbers, plan.isa)?;
        hold(&mut solid, case, wall.ends, body, self.thickness)?;
        let inner = face(case, body, Side::Inner, self)?;
        let outer = face(case, body, Side::Outer, self)?;
        solid.bear(&inner, bodies::support(&case.scene))?;
        if self.carried_pressure != 0.0 {
            solid.add_pressure(&inner, self.carried_pressure)?;
        }
        if wall.external_pressure != 0.0 {
            solid.add_pressure(&outer, wall.external_pressure)?;
        }
        if let Some(tissue) = wall.support {
            solid.add_tissue(&outer, tissue.stiffness, tissue.damping)?;
        }
        if let Some(share) = self.implicit_impedance {
            let impedance = plan.numbers.rest_density * plan.numbers.sound_speed;
            solid.add_impedance(&inner, impedance, share)?;
        }
        Ok(solid)
    }
}

/// Holds the ring at each opening: as long as the buffer, in which the section must not change, and what stands beyond the cap.
fn hold<R: Real>(
    solid: &mut Solid<R>,
    case: &Case,
    ends: Ends,
    body: &Body,
    thickness: f64,
) -> Result<(), SolidError> {
    for opening in &case.vessel.openings {
        let held = ring(case, opening, thickness, &body.position, &body.normal);
        match ends {
            Ends::Clamped => solid.clamp(&held)?,
            Ends::Sliding => solid.slide(&held, opening.normal)?,
            Ends::Free => {}
        }
    }
    Ok(())
}

/// Particles of the ring at `opening`, of a wall of `thickness` \[m\] at `position` with `normal` away from the lumen.
pub(crate) fn ring(
    case: &Case,
    opening: &Opening,
    thickness: f64,
    position: &[DVec3],
    normal: &[DVec3],
) -> Vec<u32> {
    let spacing = case.scene.particles.spacing;
    let length = (BUFFER_LENGTH * spacing).max(bodies::support(&case.scene));
    let lateral = thickness + LATERAL * spacing;
    let is_held = |&i: &u32| {
        let x = position[i as usize];
        let away = (x - opening.center).reject_from_normalized(opening.normal);
        opening.depth(x).abs() < length && opening.lateral(x) < lateral && away.dot(normal[i as usize]) > 0.0
    };
    (0..position.len() as u32).filter(is_held).collect()
}

/// Share of the impedance that a wall takes implicitly in blood of which a layer, one spacing thick, has a `mass` \[kg/m^2\], where the wall is light
/// beside it.
pub(crate) fn implicit_impedance(wall: &ElasticWall, mass: f64) -> Option<f64> {
    (wall.density * wall.thickness < LIGHT * mass).then_some(IMPLICIT_SHARE)
}

#[derive(Clone, Copy, PartialEq)]
enum Side {
    Inner,
    Outer,
}

/// A face of the wall: its outermost layer, with the area of the surface it stands for.
fn face(case: &Case, body: &Body, side: Side, wall: &PlannedWall) -> Result<Face, SolidError> {
    let (spacing, thickness) = (wall.numbers.spacing, wall.thickness);
    let particles: Vec<u32> = (0..body.position.len() as u32)
        .filter(|&i| match side {
            Side::Inner => body.depth[i as usize] < spacing,
            Side::Outer => body.depth[i as usize] > thickness - spacing,
        })
        .collect();
    let sign = if side == Side::Inner { -1.0 } else { 1.0 };
    let normals: Vec<DVec3> = particles.iter().map(|&i| sign * body.normal[i as usize]).collect();
    let volumes: Vec<f64> = particles.iter().map(|&i| body.volume[i as usize]).collect();
    let inner = inner_area(&case.vessel, bodies::support(&case.scene));
    let total = match side {
        Side::Inner => inner,
        // A tube of thickness t has that much more area outside, with R = 2V/A.
        Side::Outer => {
            inner * (1.0 + thickness * case.vessel.wall_area() / (2.0 * case.vessel.surface.volume()))
        }
    };
    Ok(Face::by_volume(particles, &normals, &volumes)?.with_total(total))
}

/// Area of the lumen surface with the collars beyond its openings \[m^2\].
fn inner_area(vessel: &Vessel, collar: f64) -> f64 {
    let collars = vessel.openings.iter().map(|o| std::f64::consts::TAU * o.radius * collar);
    vessel.wall_area() + collars.sum::<f64>()
}

/// `E / (1 - nu^2)` \[Pa\] of the wall, of one with fibres under its load: pressure, radius and thickness.
fn plane_modulus(wall: &ElasticWall, (pressure, radius, thickness): (f64, f64, f64)) -> f64 {
    match wall.material {
        SceneMaterial::NeoHookean(e)
        | SceneMaterial::SaintVenantKirchhoff(e)
        | SceneMaterial::Hypoelastic(e) => e.young_modulus / (1.0 - e.poisson_ratio * e.poisson_ratio),
        SceneMaterial::HolzapfelGasserOgden(fibers) => {
            fibers::plane_modulus(&fibers, pressure, radius, thickness)
        }
    }
}

fn material(wall: &ElasticWall) -> Result<Material, SolidError> {
    Ok(match wall.material {
        SceneMaterial::NeoHookean(Elasticity { young_modulus, poisson_ratio }) => {
            Material::NeoHookean(NeoHookean::new(young_modulus, poisson_ratio)?)
        }
        SceneMaterial::SaintVenantKirchhoff(Elasticity { young_modulus, poisson_ratio }) => {
            Material::SaintVenantKirchhoff(SaintVenantKirchhoff::new(young_modulus, poisson_ratio)?)
        }
        SceneMaterial::Hypoelastic(Elasticity { young_modulus, poisson_ratio }) => {
            Material::HypoElastic(HypoElastic::new(young_modulus, poisson_ratio)?)
        }
        SceneMaterial::HolzapfelGasserOgden(f) => {
            let bulk =
                2.0 * f.matrix_modulus * (1.0 + f.poisson_ratio) / (3.0 * (1.0 - 2.0 * f.poisson_ratio));
            Material::HolzapfelGasserOgden(HolzapfelGasserOgden::new(
                f.matrix_modulus,
                f.fiber_modulus,
                f.fiber_exponent,
                f.fiber_dispersion,
                f.fiber_angle,
                bulk,
            )?)
        }
    })
}
