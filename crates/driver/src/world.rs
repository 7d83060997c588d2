//! The bodies of one run, built from a plan: particles (from the cache where they are known), wall, openings.

use crate::bodies::Maker;
use crate::case::Case;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::plan::Plan;
use glam::DVec3;
use vaso_boundary::Openings;
use vaso_fluid::{Fluid, FluidState, Real};
use vaso_generation::Body;
use vaso_geometry::{DistanceGrid, SignedDistance};
use vaso_particles::{WallDistance, WallView};
use vaso_solid::Solid;

/// Particles of a flow and its wall.
pub struct Bodies {
    /// Blood.
    pub fluid: Body,
    /// Wall.
    pub wall: Body,
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
        let (fluid, wall) = (maker.fluid()?, maker.wall()?);
        maker.keep(&fluid);
        maker.keep(&wall);
        Ok(Self {
            notices: fluid.body.warnings(),
            cached: fluid.cached && wall.cached,
            seconds: [fluid.seconds, wall.seconds],
            fluid: fluid.body.body,
            wall: wall.body.body,
        })
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

/// Puts the bodies together: fluid at rest in its wall, with the openings of the plan.
///
/// # Errors
/// When the particles of the wall do not make a solid.
pub fn build_flow<R: Real>(case: &Case, plan: &Plan, bodies: Bodies) -> Result<Flow<R>, DriverError> {
    let spacing = plan.numbers.spacing;
    let Bodies { fluid, wall, .. } = bodies;
    let solid = plan.wall.as_ref().map(|planned| planned.build(case, plan, &wall)).transpose()?;
    // A wall that moves may come out of these bounds: then cells at the border hold more than their share.
    let low = wall.position.iter().fold(DVec3::INFINITY, |a, b| a.min(*b)) - spacing;
    let high = wall.position.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b)) + spacing;
    let exact = SignedDistance::wall(&case.vessel);
    let distance = DistanceGrid::build(&exact, (low, high), CELL * spacing, BAND * spacing);
    let velocity = vec![DVec3::ZERO; wall.position.len()];
    let at_rest =
        WallView { position: &wall.position, velocity: &velocity, depth: &wall.depth, volume: &wall.volume };
    let view = solid.as_ref().map_or(at_rest, Solid::wall_view);
    let state = FluidState::at_rest(fluid.position, &fluid.volume, plan.numbers.rest_density);
    let body =
        Fluid::new(state, view, Box::new(RigidDistance(distance)), (low, high), plan.numbers, plan.isa);
    let ports = plan.openings.iter().map(|o| (o.opening.clone(), o.condition.clone())).collect();
    let mut openings = Openings::new(ports, &plan.numbers, plan.reference_pressure);
    for (k, planned) in plan.openings.iter().enumerate() {
        openings.set_coupling(k, planned.coupling);
        if let Some(strength) = planned.backflow_damping {
            openings.set_backflow_damping(k, strength);
        }
    }
    let flow = Flow::new(body, openings, case.scene.numerics.allow_mach);
    Ok(match solid {
        None => flow,
        Some(solid) => flow.with_wall(solid),
    })
}
