//! Wall shear stress of a run: sampled, averaged over short windows, summed over cycles.

use crate::case::Case;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::plan::Plan;
use glam::DVec3;
use vaso_boundary::BUFFER_LENGTH;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_geometry::SignedDistance;
use vaso_metrics::{
    BINS, CarriedWall, NearWallDistance, ShearCycle, ShearCycles, ShearSample, ShearWindow, Viscosity,
    WallMesh, WallMotion, WallPose, WallShear,
};
use vaso_particles::{Memory, WallDistance, WallView};

/// Samples in a window: they take the noise of single particles away before magnitudes are taken.
const SAMPLES: f64 = 10.0;
/// Advective steps from one sample to the next, at least: in fewer, particles have hardly moved, and their noise is the same.
const STEPS: u64 = 4;

/// Follows the wall shear stress on the vessel surface.
pub struct WallObserver {
    /// The surface it is told on.
    pub mesh: WallMesh,
    /// Mean of the last window \[Pa\], of a wall that deforms in the directions it had at rest; `None` before the first one is full.
    pub stress: Option<Vec<Option<DVec3>>>,
    /// Indices of the last whole cycle.
    pub cycle: Option<ShearCycle>,
    /// Points without a value in the last sample.
    pub missing: usize,
    /// Mean of the time-averaged stress over the wall, of each whole cycle with its number.
    means: Vec<(u64, f64)>,
    /// Area of each point \[m^2\], zero within the buffers: there the flow is imposed, and the stress says nothing of the vessel.
    pub counted: Vec<f64>,
    shear: WallShear,
    exact: SignedDistance,
    /// What goes with a wall that deforms.
    carried: Option<CarriedWall>,
    window: ShearWindow,
    length: f64,
    next_sample: f64,
    next_step: u64,
    next_window: f64,
    cycles: Option<ShearCycles>,
}

/// Distance to the wall as the fluid knows it.
struct Coarse<'a, R>(&'a vaso_fluid::Fluid<R>);

impl<R: Real> WallDistance for Coarse<'_, R> {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        self.0.distance(x)
    }
}

impl WallObserver {
    /// Windows are a hundredth of the period, or the time between frames where that is shorter or there is no period.
    ///
    /// `rest` is a wall that deforms where it was when the particles were made.
    pub(super) fn new(case: &Case, plan: &Plan, rest: Option<&WallView>) -> Result<Self, DriverError> {
        let spacing = plan.numbers.spacing;
        let mesh = mesh(case, plan);
        let exact = SignedDistance::wall(&case.vessel);
        let own = plan.wall.as_ref().map_or(spacing, |wall| wall.numbers.spacing);
        let carried = rest.map(|view| CarriedWall::new(&mesh, view, &exact, own));
        let shear = WallShear::new(mesh.position.clone(), mesh.normal.clone(), spacing)?;
        let every = case.scene.output.every;
        let length = plan.period.map_or(every, |period| every.min(period / BINS as f64));
        let cycles =
            plan.period.map(|period| ShearCycles::new(mesh.normal.clone(), 0.0, period)).transpose()?;
        Ok(Self {
            stress: None,
            cycle: None,
            missing: 0,
            means: Vec::new(),
            counted: counted_area(&mesh, BUFFER_LENGTH * spacing),
            exact,
            carried,
            window: ShearWindow::new(mesh.position.len()),
            length,
            next_sample: 0.0,
            next_step: 0,
            next_window: length,
            cycles,
            shear,
            mesh,
        })
    }

    /// Area of each point of the mesh of a run \[m^2\], zero within the buffers.
    pub fn counted(case: &Case, plan: &Plan) -> Vec<f64> {
        counted_area(&mesh(case, plan), BUFFER_LENGTH * plan.numbers.spacing)
    }

    /// Whether stresses are summed over cycles.
    pub(super) fn has_cycles(&self) -> bool {
        self.cycles.is_some()
    }

    pub(super) fn remember(&mut self, memory: &mut dyn Memory) {
        let Self {
            mesh,
            stress,
            cycle,
            missing,
            means,
            counted: _,
            shear: _,
            exact: _,
            // Made anew from the wall at rest.
            carried: _,
            window,
            length: _,
            next_sample,
            next_step,
            next_window,
            cycles,
        } = self;
        let n = mesh.position.len();
        remember_stress(stress, n, memory);
        let [mut has_cycle, mut n_missing] = [u64::from(cycle.is_some()), *missing as u64];
        memory.counts("shear.counts", &mut [&mut has_cycle, &mut n_missing, next_step]);
        *missing = n_missing as usize;
        memory.fields("shear.next_s", &mut [next_sample, next_window]);
        *cycle = (has_cycle != 0).then(|| cycle.take().unwrap_or_else(|| ShearCycle::empty(n)));
        if let Some(cycle) = cycle {
            cycle.remember("shear.cycle", memory);
        }
        let (mut numbers, mut values): (Vec<u64>, Vec<f64>) = means.iter().copied().unzip();
        memory.integers("shear.mean_numbers", &mut numbers);
        memory.numbers("shear.means", &mut values);
        *means = numbers.into_iter().zip(values).collect();
        window.remember("shear.window", memory);
        if let Some(cycles) = cycles {
            cycles.remember("shear.sums", memory);
        }
    }

    /// Mean over the wall outside the buffers of the time-averaged stress of a cycle \[Pa\], where it is whole.
    pub fn mean_tawss(&self, cycle: u64) -> Option<f64> {
        self.means.iter().find(|(number, _)| *number == cycle).map(|(_, mean)| *mean)
    }

    /// Takes the state after a step; gives the change of the time-averaged stress when a cycle ended that is not the first.
    pub(super) fn add<R: Real, W: MovingWall>(
        &mut self,
        flow: &Flow<R, W>,
    ) -> Result<Option<f64>, DriverError> {
        if flow.time < self.next_sample || flow.advective_steps < self.next_step {
            return Ok(None);
        }
        self.next_step = flow.advective_steps + STEPS;
        self.next_sample = flow.time + self.length / SAMPLES;
        let (fluid, state) = (&flow.fluid, &flow.fluid.state);
        let numbers = fluid.numbers();
        let law = |rate: f64| numbers.rheology.map_or(numbers.viscosity, |law| law.viscosity(rate));
        let viscosity = match numbers.rheology {
            None => Viscosity::Constant(numbers.viscosity),
            Some(_) => Viscosity::ShearRate(&law),
        };
        let sample = match self.pose(flow) {
            None => {
                let coarse = Coarse(fluid);
                let distance =
                    NearWallDistance { coarse: &coarse, exact: &self.exact, reach: self.shear.reach() };
                self.shear.evaluate(&state.position, &state.velocity, &distance, viscosity)?
            }
            Some((carried, pose)) => self.along(fluid, carried, pose, viscosity)?,
        };
        self.missing = sample.missing();
        self.window.add(flow.time, &sample.stress)?;
        if flow.time < self.next_window {
            return Ok(None);
        }
        while self.next_window <= flow.time {
            self.next_window += self.length;
        }
        self.close_window()
    }

    /// Where a wall that deforms stands now.
    pub fn pose<R: Real, W: MovingWall>(&self, flow: &Flow<R, W>) -> Option<(&CarriedWall, WallPose)> {
        let (carried, wall) = self.carried.as_ref().zip(flow.wall.as_ref())?;
        Some((carried, carried.pose(&wall.view())))
    }

    /// Stress along a wall that deforms, in the directions it had at rest: what a piece of tissue feels over a cycle.
    fn along<R: Real>(
        &self,
        fluid: &vaso_fluid::Fluid<R>,
        carried: &CarriedWall,
        pose: WallPose,
        viscosity: Viscosity,
    ) -> Result<ShearSample, DriverError> {
        let exact = carried.distance(&pose);
        let went = pose.position.iter().zip(&self.mesh.position).map(|(x, rest)| x.distance_squared(*rest));
        // The distance the fluid knows is that of the wall at rest.
        let reach = self.shear.wide_reach() + went.fold(0.0, f64::max).sqrt();
        let coarse = Coarse(fluid);
        let distance = NearWallDistance { coarse: &coarse, exact: &exact, reach };
        let WallPose { position, normal, rotation, velocity, gradient } = pose;
        let shear = WallShear::new(position, normal, fluid.numbers().spacing)?;
        let state = &fluid.state;
        let motion = WallMotion { velocity: &velocity, gradient: &gradient };
        let mut sample =
            shear.evaluate_moving(&state.position, &state.velocity, &distance, viscosity, motion)?;
        for (stress, turn) in sample.stress.iter_mut().zip(&rotation) {
            *stress = stress.map(|stress| turn.transpose() * stress);
        }
        Ok(sample)
    }

    fn close_window(&mut self) -> Result<Option<f64>, DriverError> {
        let Some((time, stress)) = self.window.take() else { return Ok(None) };
        let change = self.put(time, &stress)?;
        self.stress = Some(stress);
        Ok(change)
    }

    /// Adds a mean to the sums of the cycle.
    fn put(&mut self, time: f64, stress: &[Option<DVec3>]) -> Result<Option<f64>, DriverError> {
        let Some(cycles) = &mut self.cycles else { return Ok(None) };
        let Some(ended) = cycles.add(time, stress)? else { return Ok(None) };
        let change = self.cycle.as_ref().and_then(|before| ended.change_from(before, &self.counted));
        self.means.extend(ended.mean_tawss(&self.counted).map(|mean| (ended.number, mean)));
        self.cycle = Some(ended);
        Ok(change)
    }

    /// Closes the window that is going on and takes its mean to hold until `time` \[s\]: means stand for the middles of windows,
    /// and the last cycle ends half a window later. One with less than half of its samples is left out: its mean is as noisy as
    /// they are few.
    pub(super) fn finish(&mut self, time: f64) -> Result<Option<f64>, DriverError> {
        let is_short = self.stress.is_some() && (self.window.samples as f64) < 0.5 * SAMPLES;
        let change = if is_short { None } else { self.close_window()? };
        let Some(stress) = self.stress.take() else { return Ok(change) };
        let last = self.put(time, &stress)?;
        self.stress = Some(stress);
        Ok(last.or(change))
    }
}

/// Stress of `n` points: none at all before the first window is full, not a number where a point has none.
fn remember_stress(stress: &mut Option<Vec<Option<DVec3>>>, n: usize, memory: &mut dyn Memory) {
    let told = stress.take().unwrap_or_default();
    let mut vectors: Vec<DVec3> = told.into_iter().map(|s| s.unwrap_or(DVec3::NAN)).collect();
    memory.vectors("shear.stress", &mut vectors);
    if !(vectors.is_empty() || vectors.len() == n) {
        memory.refuse("shear.stress", format!("it has {} points, {n} are needed", vectors.len()));
        vectors.clear();
    }
    let some = |vector: DVec3| Some(vector).filter(|v| !v.is_nan());
    *stress = (!vectors.is_empty()).then(|| vectors.into_iter().map(some).collect());
}

/// The mesh that stress is told on. A shell is told on triangles of its own spacing, and the stress on it on the same.
fn mesh(case: &Case, plan: &Plan) -> WallMesh {
    let own = plan.shell.as_ref().map_or(plan.numbers.spacing, |shell| shell.numbers.spacing);
    WallMesh::new(&case.vessel, own)
}

/// Area of each point of the mesh \[m^2\], zero up to `length` \[m\] from an opening.
fn counted_area(mesh: &WallMesh, length: f64) -> Vec<f64> {
    let area = mesh.area.iter().zip(&mesh.rim_distance);
    area.map(|(area, rim)| if *rim > length { *area } else { 0.0 }).collect()
}
