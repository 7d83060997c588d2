//! The bodies of particles a case calls for: found in the cache, or made and put there.

use crate::case::Case;
use crate::error::DriverError;
use crate::kept::{self, Kept};
use std::time::Instant;
use vaso_generation::{
    Body, Ends, GenerationError, Lattice, Settings, ShellBody, ShellReference, ShellSettings, WALL_LAYERS,
    Wall, multiblock, shell, wall,
};
use vaso_geometry::Vessel;
use vaso_io::{Cache, CacheKey};
use vaso_scene::material::ElasticWall;
use vaso_scene::{Generator, OpenEnds, Scene};

/// The fluid with what became of its blocks, where it has any.
#[derive(Clone, Debug, PartialEq)]
pub struct FluidBody {
    /// The particles.
    pub body: Body,
    /// What became of the blocks; `None` for a relaxed lattice.
    pub blocks: Option<multiblock::Report>,
}

/// A body with what it took.
#[derive(Clone, Debug)]
pub struct Made<T> {
    /// The particles.
    pub body: T,
    /// Time it took to make them \[s\], now or when they were put into the cache.
    pub seconds: f64,
    /// Whether they came from the cache.
    pub cached: bool,
    key: CacheKey,
}

/// Makes the bodies of a case.
///
/// `progress` hears the body, the step and the mean displacement in spacings.
pub struct Maker<'a, P> {
    case: &'a Case,
    settings: Settings,
    progress: P,
}

impl<'a, P: FnMut(&str, usize, f64)> Maker<'a, P> {
    /// A maker for `case`.
    pub fn new(case: &'a Case, progress: P) -> Self {
        Self { case, settings: settings(&case.scene), progress }
    }

    /// The fluid, by the generator of the case.
    ///
    /// # Errors
    /// When the spacing does not fit the vessel.
    pub fn fluid(&mut self) -> Result<Made<FluidBody>, DriverError> {
        let particles = &self.case.scene.particles;
        let (generator, sweeps) = (particles.generator, particles.smoothing_sweeps);
        let (settings, progress) = (&self.settings, &mut self.progress);
        obtain(self.case, fluid_key(self.case), |vessel| {
            fluid(vessel, settings, generator, sweeps, &mut |step, moved| progress("fluid", step, moved))
        })
    }

    /// The wall of several layers.
    ///
    /// # Errors
    /// When spacing or thickness do not fit the vessel.
    pub fn wall(&mut self) -> Result<Made<Wall>, DriverError> {
        let (thickness, ends) = wall_shape(&self.case.scene);
        let (settings, progress) = (&wall_settings(&self.case.scene), &mut self.progress);
        let key = kept::key::<Wall>(self.case).relaxed(settings).number(thickness).ends(ends).finish();
        obtain(self.case, key, |vessel| {
            wall(vessel, settings, thickness, ends, &mut |step, moved| progress("wall", step, moved))
        })
    }

    /// The wall of one layer.
    ///
    /// # Errors
    /// When the spacing does not fit the vessel, or it has no wall.
    pub fn shell(&mut self) -> Result<Made<ShellBody>, DriverError> {
        let settings = shell_settings(&self.case.scene);
        let progress = &mut self.progress;
        let key = kept::key::<ShellBody>(self.case).shell(&settings).finish();
        obtain(self.case, key, |vessel| {
            shell(vessel, &settings, &mut |step, moved| progress("shell", step, moved))
        })
    }

    /// Puts a body into the cache of the case, if there is one and it did not come from there.
    pub fn keep<T: Kept>(&self, made: &Made<T>) {
        if let (Some(folder), false) = (&self.case.cache, made.cached) {
            // A read-only folder costs the cache, not the run.
            let _ = Cache::new(folder).store(&made.key, &kept::pack(&made.body, made.seconds));
        }
    }
}

/// Fills the lumen of `vessel` by a generator.
///
/// # Errors
/// As for [`vaso_generation::fluid`].
pub fn fluid(
    vessel: &Vessel,
    settings: &Settings,
    generator: Generator,
    smoothing_sweeps: usize,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<FluidBody, GenerationError> {
    match generator {
        Generator::RelaxedLattice(start) => {
            let settings = Settings { lattice: lattice(start), ..settings.clone() };
            Ok(FluidBody { body: vaso_generation::fluid(vessel, &settings, progress)?, blocks: None })
        }
        Generator::Multiblock(arrangement) => {
            let options = multiblock::Options {
                topology: topology(arrangement),
                smoothing_sweeps,
                ..multiblock::Options::default()
            };
            let made = multiblock::fluid(vessel, settings, &options, progress)?;
            Ok(FluidBody { body: made.body, blocks: Some(made.report) })
        }
    }
}

/// Settings of fluid and wall that a scene asks for.
pub fn settings(scene: &Scene) -> Settings {
    Settings {
        spacing: scene.particles.spacing,
        smoothing: scene.numerics.smoothing_length,
        lattice: match scene.particles.generator {
            Generator::RelaxedLattice(start) => lattice(start),
            Generator::Multiblock(_) => Lattice::Cubic,
        },
        steps: scene.particles.relaxation_steps as usize,
        seed: scene.numerics.seed,
    }
}

/// Settings of the wall of several layers that a scene asks for: a deformable one may have particles of its own spacing.
pub fn wall_settings(scene: &Scene) -> Settings {
    let usual = settings(scene);
    match &scene.wall {
        vaso_scene::Wall::Solid(wall) => Settings { spacing: wall_spacing(wall, usual.spacing), ..usual },
        _ => usual,
    }
}

/// Layers that a wall needs to be inflated.
pub(crate) const LAYERS_TO_INFLATE: f64 = 4.0;

/// Spacing \[m\] of a deformable wall in blood of a `spacing` \[m\].
pub(crate) fn wall_spacing(wall: &ElasticWall, spacing: f64) -> f64 {
    wall.spacing.unwrap_or_else(|| spacing.min(wall.thickness / LAYERS_TO_INFLATE))
}

/// Relaxation steps of a shell over those of the case: it starts from random places on its triangles, not from a lattice.
const SHELL_STEPS: f64 = 2.5;

/// Spacing \[m\] of the wall of one layer: that of the blood, unless the case gives another.
pub(crate) fn shell_spacing(scene: &Scene) -> f64 {
    let given = if let vaso_scene::Wall::Shell(wall) = &scene.wall { wall.spacing } else { None };
    given.unwrap_or(scene.particles.spacing)
}

/// Settings of the shell that a scene asks for.
pub fn shell_settings(scene: &Scene) -> ShellSettings {
    let spacing = shell_spacing(scene);
    let is_wall = matches!(scene.wall, vaso_scene::Wall::RigidShell | vaso_scene::Wall::Shell(_));
    // Blood near a cap has to see a wall all around.
    let usual_ends = if is_wall && scene.blood.is_some() { OpenEnds::Collar } else { OpenEnds::ClosestCap };
    let usual = ShellSettings::new(spacing, scene.wall_body.thickness.unwrap_or(spacing));
    ShellSettings {
        reference: match scene.wall {
            vaso_scene::Wall::Shell(_) => ShellReference::MidSurface,
            _ => ShellReference::Lumen,
        },
        collar: match scene.wall_body.open_ends.unwrap_or(usual_ends) {
            OpenEnds::Collar => support(scene),
            OpenEnds::ClosestCap | OpenEnds::Boxes => 0.0,
        },
        steps: (SHELL_STEPS * f64::from(scene.particles.relaxation_steps)) as usize,
        seed: scene.numerics.seed,
        ..usual
    }
}

/// Thickness \[m\] and ends of the wall that a scene asks for.
pub fn wall_shape(scene: &Scene) -> (f64, Ends) {
    let thickness = scene.wall_body.thickness.unwrap_or(WALL_LAYERS * scene.particles.spacing);
    let usual = match scene.wall {
        vaso_scene::Wall::Rigid | vaso_scene::Wall::RigidShell => OpenEnds::Collar,
        // Blood near a cap has to see a wall all around.
        vaso_scene::Wall::Solid(_) if scene.blood.is_some() => OpenEnds::Collar,
        _ => OpenEnds::ClosestCap,
    };
    let ends = match scene.wall_body.open_ends.unwrap_or(usual) {
        OpenEnds::ClosestCap => Ends::ClosestCap,
        OpenEnds::Boxes => Ends::Boxes,
        OpenEnds::Collar => Ends::Collar { length: support(scene) },
    };
    (thickness, ends)
}

/// Support radius of the kernel 2h \[m\].
pub(crate) fn support(scene: &Scene) -> f64 {
    2.0 * scene.numerics.smoothing_length * scene.particles.spacing
}

fn lattice(start: vaso_scene::Lattice) -> Lattice {
    match start {
        vaso_scene::Lattice::Cubic => Lattice::Cubic,
        vaso_scene::Lattice::BodyCentred => Lattice::Bcc,
    }
}

fn topology(arrangement: vaso_scene::Topology) -> multiblock::Topology {
    match arrangement {
        vaso_scene::Topology::Single => multiblock::Topology::Single,
        vaso_scene::Topology::NineBlock => multiblock::Topology::NineBlock,
        vaso_scene::Topology::OGrid => multiblock::Topology::OGrid,
    }
}

fn fluid_key(case: &Case) -> CacheKey {
    let particles = &case.scene.particles;
    kept::key::<FluidBody>(case)
        .relaxed(&settings(&case.scene))
        .generator(particles.generator, particles.smoothing_sweeps)
        .finish()
}

/// What the fluid of a case had to put up with, as far as the cache knows it: nothing is made.
pub fn remembered_warnings(case: &Case) -> Vec<String> {
    let found = case.cache.as_ref().and_then(|folder| kept::load::<FluidBody>(folder, &fluid_key(case)));
    found.map_or(Vec::new(), |(fluid, _)| fluid.warnings())
}

impl FluidBody {
    /// What had to be left to the lattice.
    pub fn warnings(&self) -> Vec<String> {
        self.blocks.as_ref().map_or(Vec::new(), |blocks| blocks.unblocked_junctions.clone())
    }
}

fn obtain<T: Kept>(
    case: &Case,
    key: CacheKey,
    make: impl FnOnce(&Vessel) -> Result<T, GenerationError>,
) -> Result<Made<T>, DriverError> {
    if let Some((body, seconds)) = case.cache.as_ref().and_then(|folder| kept::load(folder, &key)) {
        return Ok(Made { body, seconds, cached: true, key });
    }
    let start = Instant::now();
    let body = make(&case.vessel).map_err(|source| DriverError::generation(case, &source))?;
    Ok(Made { body, seconds: start.elapsed().as_secs_f64(), cached: false, key })
}
