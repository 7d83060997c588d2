//! The bodies of one run, built from a plan: particles (from the cache where they are known), wall, openings.

use crate::bodies::Maker;
use crate::case::Case;
use crate::deforming::Deforming;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::plan::Plan;
use crate::shell;
use glam::DVec3;
use vaso_boundary::Openings;
use vaso_fluid::{Fluid, FluidState, Real};
use vaso_generation::{Body, ShellBody};
use vaso_geometry::{DistanceGrid, SignedDistance};
use vaso_io::{KeyBuilder, ParticleCounts};
use vaso_particles::{WallDistance, WallView};
use vaso_scene::Wall;

/// Particles of a wall.
#[derive(Clone, Debug)]
pub enum WallParticles {
    /// Several layers of them.
    Layers(Body),
    /// One layer.
    Shell(ShellBody),
}

impl WallParticles {
    /// Number of particles.
    pub fn len(&self) -> usize {
        match self {
            Self::Layers(body) => body.position.len(),
            Self::Shell(body) => body.position.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Digest of all that a flow sees of them.
    pub(crate) fn digest(&self) -> String {
        let vectors = |key, vectors: &[DVec3]| {
            vectors.iter().fold(key, |key: KeyBuilder, v| key.numbers(&v.to_array()))
        };
        let key = match self {
            Self::Layers(Body { position, volume, depth, normal, quality: _ }) => {
                let key = vectors(KeyBuilder::new("layers"), position).numbers(volume).numbers(depth);
                vectors(key, normal)
            }
            Self::Shell(body) => {
                let key = vectors(KeyBuilder::new("shell"), &body.position);
                let key = vectors(key, &body.normal).numbers(&body.area).numbers(&body.thickness);
                key.numbers(body.curvature.as_flattened())
            }
        };
        key.finish().to_string()
    }

    /// The layers, where it has several.
    pub fn layers(&self) -> Option<&Body> {
        if let Self::Layers(body) = self { Some(body) } else { None }
    }
}

/// Particles of a flow and its wall.
pub struct Bodies {
    /// Blood.
    pub fluid: Body,
    /// Wall.
    pub wall: WallParticles,
    /// What of a block layout had to be left to the lattice.
    pub notices: Vec<String>,
    /// Whether they came from the cache.
    pub cached: bool,
    /// Time it took to make each \[s\], now or when it was put into the cache.
    pub seconds: [f64; 2],
}

impl Bodies {
    /// Particles of the case: read from `.vaso-cache` beside it, or generated and put there.
    ///
    /// `progress` hears the body, the step and the mean displacement in spacings.
    ///
    /// # Errors
    /// When the spacing does not fit the vessel. A cache that cannot be read or written is passed over.
    pub fn make(case: &Case, progress: impl FnMut(&str, usize, f64)) -> Result<Self, DriverError> {
        let mut maker = Maker::new(case, progress);
        let fluid = maker.fluid()?;
        let (wall, is_cached, seconds) = match case.scene.wall {
            Wall::Rigid | Wall::Solid(_) => {
                let wall = maker.wall()?;
                maker.keep(&wall);
                (WallParticles::Layers(wall.body.body), wall.cached, wall.seconds)
            }
            Wall::RigidShell | Wall::Shell(_) => {
                let shell = maker.shell()?;
                maker.keep(&shell);
                (WallParticles::Shell(shell.body), shell.cached, shell.seconds)
            }
        };
        maker.keep(&fluid);
        Ok(Self {
            notices: fluid.body.warnings(),
            cached: fluid.cached && is_cached,
            seconds: [fluid.seconds, seconds],
            fluid: fluid.body.body,
            wall,
        })
    }

    /// How many there are.
    pub fn counts(&self) -> ParticleCounts {
        let (fluid, n) = (self.fluid.position.len() as u64, self.wall.len() as u64);
        match self.wall {
            WallParticles::Layers(_) => ParticleCounts { fluid, wall: n, shell: 0 },
            WallParticles::Shell(_) => ParticleCounts { fluid, wall: 0, shell: n },
        }
    }
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

/// Cell of the distance grid, in spacings. A straight line between nodes misses a round wall by `cell^2 / 12 R`: with cells of a
/// spacing 2.7 % of the distance of the first layer at D/20, and ten per cent of the drag on it.
const CELL: f64 = 0.5;

/// [`build_flow_in`] a wall that is rigid or a solid.
///
/// # Errors
/// When the particles of the wall do not make a solid.
pub fn build_flow<R: Real>(case: &Case, plan: &Plan, bodies: Bodies) -> Result<Flow<R>, DriverError> {
    build_flow_in(case, plan, bodies)
}

/// Puts the bodies together: fluid at rest in its wall, with the openings of the plan. `W` is the kind of wall that deforms; one at
/// rest has none, whatever `W` is.
///
/// # Errors
/// When the particles of the wall do not make one that deforms.
pub fn build_flow_in<R: Real, W: Deforming>(
    case: &Case,
    plan: &Plan,
    bodies: Bodies,
) -> Result<Flow<R, W>, DriverError> {
    let Bodies { fluid, wall, .. } = bodies;
    let deforming = W::build(case, plan, &wall)?;
    let state = FluidState::at_rest(fluid.position, &fluid.volume, plan.numbers.rest_density);
    let body = match (&deforming, &wall) {
        (Some(deforming), _) => between(case, plan, state, &deforming.view()),
        (None, WallParticles::Shell(shell)) => {
            between(case, plan, state, &shell::rigid_columns(case, plan, shell).view())
        }
        (None, WallParticles::Layers(layers)) => {
            let velocity = vec![DVec3::ZERO; layers.position.len()];
            let Body { position, depth, volume, .. } = layers;
            between(case, plan, state, &WallView { position, velocity: &velocity, depth, volume })
        }
    };
    let ports = plan.openings.iter().map(|o| (o.opening.clone(), o.condition.clone())).collect();
    let mut openings = Openings::new(ports, &plan.numbers, plan.reference_pressure);
    for (k, planned) in plan.openings.iter().enumerate() {
        openings.set_coupling(k, planned.coupling);
        if let Some(strength) = planned.backflow_damping {
            openings.set_backflow_damping(k, strength);
        }
    }
    let flow = Flow::new(body, openings, case.scene.numerics.allow_mach);
    Ok(match deforming {
        None => flow,
        Some(wall) => flow.with_wall(wall),
    })
}

/// The fluid within a wall, as `view` shows it.
fn between<R: Real>(case: &Case, plan: &Plan, state: FluidState, view: &WallView) -> Fluid<R> {
    let spacing = plan.numbers.spacing;
    // A wall that moves may come out of these bounds: then cells at the border hold more than their share.
    let low = view.position.iter().fold(DVec3::INFINITY, |a, b| a.min(*b)) - spacing;
    let high = view.position.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b)) + spacing;
    let exact = SignedDistance::wall(&case.vessel);
    let distance = DistanceGrid::build(&exact, (low, high), CELL * spacing, BAND * spacing);
    Fluid::new(state, *view, Box::new(RigidDistance(distance)), (low, high), plan.numbers, plan.isa)
}
