//! The bodies of one run, built from a plan: particles (from the cache where they are known), wall, openings.

use crate::case::Case;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::plan::Plan;
use glam::DVec3;
use std::time::Instant;
use vaso_boundary::Openings;
use vaso_fluid::{Fluid, FluidState, Real};
use vaso_generation::{Body, Lattice, Quality, Settings, multiblock};
use vaso_geometry::{DistanceGrid, SignedDistance};
use vaso_io::{Archive, Cache, CacheKey, KeyBuilder};
use vaso_particles::{WallDistance, WallView};
use vaso_scene::{Generator, Scene};

/// Generated particles of a case.
pub struct Bodies {
    /// Blood.
    pub fluid: Body,
    /// Wall.
    pub wall: Body,
    /// What of a block layout had to be left to the lattice.
    pub notices: Vec<String>,
    /// Whether they came from the cache.
    pub cached: bool,
    /// Time it took \[s\], per body, or to read the cache.
    pub seconds: [f64; 2],
}

/// Generation settings a scene asks for.
pub fn generation_settings(scene: &Scene) -> Settings {
    let lattice = match scene.particles.generator {
        Generator::RelaxedLattice(vaso_scene::Lattice::BodyCentred) => Lattice::Bcc,
        _ => Lattice::Cubic,
    };
    Settings {
        spacing: scene.particles.spacing,
        smoothing: scene.numerics.smoothing_length,
        lattice,
        steps: scene.particles.relaxation_steps as usize,
        seed: scene.numerics.seed,
    }
}

/// How a scene wants blocks laid; `None` where it wants none.
fn blocks(scene: &Scene) -> Option<multiblock::Options> {
    let Generator::Multiblock(topology) = scene.particles.generator else { return None };
    let topology = match topology {
        vaso_scene::Topology::Single => multiblock::Topology::Single,
        vaso_scene::Topology::NineBlock => multiblock::Topology::NineBlock,
        vaso_scene::Topology::OGrid => multiblock::Topology::OGrid,
    };
    Some(multiblock::Options { topology, ..multiblock::Options::default() })
}

/// Layout version of cached particles; to be raised whenever generation changes its results.
const CACHE_VERSION: u32 = 3;
const CACHE_KIND: &str = "particles";

impl Bodies {
    /// Particles of the case: read from `.vaso-cache` beside it, or generated and put there.
    ///
    /// `progress` hears the body, the step and the mean displacement in spacings.
    ///
    /// # Errors
    /// When the spacing does not fit the vessel. A cache that cannot be read or written is passed over.
    pub fn make(case: &Case, mut progress: impl FnMut(&str, usize, f64)) -> Result<Self, DriverError> {
        let settings = generation_settings(&case.scene);
        let cache = Cache::new(case.scene.directory.join(".vaso-cache"));
        let key = key(case, &settings);
        let start = Instant::now();
        if let Some((fluid, wall)) = cache.load(&key, CACHE_KIND, CACHE_VERSION).and_then(|a| unpack(&a)) {
            return Ok(Self {
                fluid,
                wall,
                notices: Vec::new(),
                cached: true,
                seconds: [start.elapsed().as_secs_f64(), 0.0],
            });
        }
        let wrong = |source| DriverError::Generation { file: case.scene.file.clone(), source };
        let mut fluid_progress = |step, moved| progress("fluid", step, moved);
        let (fluid, notices) = match blocks(&case.scene) {
            None => {
                let body =
                    vaso_generation::fluid(&case.vessel, &settings, &mut fluid_progress).map_err(wrong)?;
                (body, Vec::new())
            }
            Some(options) => {
                let made = multiblock::fluid(&case.vessel, &settings, &options, &mut fluid_progress);
                let made = made.map_err(wrong)?;
                (made.body, made.report.unblocked_junctions)
            }
        };
        let fluid_seconds = start.elapsed().as_secs_f64();
        let wall = vaso_generation::rigid_wall(&case.vessel, &settings, &mut |step, moved| {
            progress("wall", step, moved)
        })
        .map_err(wrong)?;
        let seconds = [fluid_seconds, start.elapsed().as_secs_f64() - fluid_seconds];
        // A read-only folder costs the cache, not the run.
        let _ = cache.store(&key, &pack(&fluid, &wall));
        Ok(Self { fluid, wall, notices, cached: false, seconds })
    }
}

fn key(case: &Case, settings: &Settings) -> CacheKey {
    let surface = &case.vessel.surface;
    let mut builder = KeyBuilder::new(CACHE_KIND)
        .integer(u64::from(CACHE_VERSION))
        .number(settings.spacing)
        .number(settings.smoothing)
        .text(match settings.lattice {
            Lattice::Bcc => "bcc",
            _ => "cubic",
        })
        .integer(settings.steps as u64)
        .integer(settings.seed)
        .text(
            &blocks(&case.scene)
                .map_or(String::new(), |b| format!("{:?} {}", b.topology, b.smoothing_sweeps)),
        );
    for v in &surface.vertices {
        builder = builder.numbers(&v.to_array());
    }
    for t in &surface.triangles {
        builder = t.iter().fold(builder, |b, &i| b.integer(u64::from(i)));
    }
    for opening in &case.vessel.openings {
        builder = builder.numbers(&opening.center.to_array()).numbers(&opening.normal.to_array());
    }
    builder.finish()
}

fn pack(fluid: &Body, wall: &Body) -> Archive {
    let mut archive = Archive::new(CACHE_KIND, CACHE_VERSION);
    for (name, body) in [("fluid", fluid), ("wall", wall)] {
        archive.put_vectors(&format!("{name}.position"), &body.position);
        archive.put_vectors(&format!("{name}.normal"), &body.normal);
        archive.put_floats(&format!("{name}.depth"), &body.depth);
        archive.put_floats(&format!("{name}.volume"), &body.volume);
        let q = &body.quality;
        let nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
        archive.put_floats(
            &format!("{name}.numbers"),
            &[
                q.volume_error,
                q.nearest_neighbor_min,
                q.nearest_neighbor_cv,
                nan(q.kernel_sum_mean),
                nan(q.kernel_sum_std),
                q.gradient_residual_rms,
                q.volume_cv,
            ],
        );
        archive.put_integers(
            &format!("{name}.counts"),
            &[q.count as u64, q.outside as u64, q.iterations as u64, u64::from(q.converged)],
        );
    }
    archive
}

fn unpack(archive: &Archive) -> Option<(Body, Body)> {
    let body = |name: &str| {
        let [volume_error, nn_min, nn_cv, sum_mean, sum_std, residual, volume_cv] =
            *archive.floats(&format!("{name}.numbers"))?.first_chunk::<7>()?;
        let [count, outside, iterations, converged] =
            *archive.integers(&format!("{name}.counts"))?.first_chunk::<4>()?;
        let some = |x: f64| (!x.is_nan()).then_some(x);
        Some(Body {
            position: archive.vectors(&format!("{name}.position"))?,
            volume: archive.floats(&format!("{name}.volume"))?.to_vec(),
            normal: archive.vectors(&format!("{name}.normal"))?,
            depth: archive.floats(&format!("{name}.depth"))?.to_vec(),
            quality: Quality {
                count: count as usize,
                volume_error,
                nearest_neighbor_min: nn_min,
                nearest_neighbor_cv: nn_cv,
                kernel_sum_mean: some(sum_mean),
                kernel_sum_std: some(sum_std),
                gradient_residual_rms: residual,
                volume_cv,
                outside: outside as usize,
                seconds: None,
                iterations: iterations as usize,
                converged: converged != 0,
            },
        })
    };
    Some((body("fluid")?, body("wall")?))
}

/// Signed distance to the wall of a rigid vessel, from the narrow-band grid.
struct RigidDistance(DistanceGrid);

impl WallDistance for RigidDistance {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        self.0.sample(x)
    }
}

/// Band of the distance grid around the wall, in spacings: the support, and what a stray may move.
const BAND: f64 = 5.0;

/// Puts the bodies together: fluid at rest in a rigid wall, with the openings of the plan.
pub fn build_flow<R: Real>(case: &Case, plan: &Plan, bodies: Bodies) -> Flow<R> {
    let spacing = plan.numbers.spacing;
    let Bodies { fluid, wall, .. } = bodies;
    let low = wall.position.iter().fold(DVec3::INFINITY, |a, b| a.min(*b)) - spacing;
    let high = wall.position.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b)) + spacing;
    let distance =
        DistanceGrid::build(&SignedDistance::wall(&case.vessel), (low, high), spacing, BAND * spacing);
    let velocity = vec![DVec3::ZERO; wall.position.len()];
    let view =
        WallView { position: &wall.position, velocity: &velocity, depth: &wall.depth, volume: &wall.volume };
    let state = FluidState::at_rest(fluid.position, &fluid.volume, plan.numbers.rest_density);
    let body =
        Fluid::new(state, view, Box::new(RigidDistance(distance)), (low, high), plan.numbers, plan.isa);
    let ports = plan.openings.iter().map(|o| (o.opening.clone(), o.condition.clone())).collect();
    let openings = Openings::new(ports, &plan.numbers, plan.reference_pressure);
    Flow::new(body, openings, case.scene.numerics.allow_mach)
}
