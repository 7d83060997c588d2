//! The loop nest of a flow: advective step around acoustic steps, and those of a wall that moves within them.

use crate::diverged::{Breakdown, Diverged};
use crate::ledger::{Ledger, Stage};
use vaso_boundary::{Openings, Reading};
use vaso_coupling::{Coupling, CouplingError, MovingWall};
use vaso_fluid::{Fluid, Real};
use vaso_particles::{Memory, NonFinite, visit};
use vaso_solid::Solid;

/// What the guards saw so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Watch {
    /// Largest density deviation, the start included, relative.
    pub max_density_error: f64,
    /// Largest speed over sound speed.
    pub max_mach: f64,
    /// Particles that left through the wall.
    pub escaped: u64,
    /// Particles put back at the wall.
    pub returned: u64,
    /// Values that were not finite.
    pub non_finite: u64,
}

/// A flow in time, in a rigid wall or one of kind `W`.
pub struct Flow<R, W = Solid<R>> {
    /// The blood.
    pub fluid: Fluid<R>,
    /// The wall, where it moves.
    pub wall: Option<Coupling<W>>,
    /// Its openings.
    pub openings: Openings,
    /// Simulated time \[s\].
    pub time: f64,
    /// Advective steps taken.
    pub advective_steps: u64,
    /// Acoustic steps taken.
    pub acoustic_steps: u64,
    /// Sum over acoustic steps of the number of fluid particles.
    pub particle_substeps: u64,
    /// What the guards saw.
    pub watch: Watch,
    /// Time per stage.
    pub ledger: Ledger,
    /// Speeds beyond a fifth of the sound speed are let pass.
    pub allow_mach: bool,
    /// Mean state of the openings after the last step.
    pub readings: Vec<Reading>,
}

/// Mach number at which a run stops, unless it is allowed.
const MAX_MACH: f64 = 0.2;

/// The longest step of no more than `most` that goes into what is `left`, all in seconds.
///
/// What is left over in the end would be a step of its own, of any length. Walls take the rate of their strain, which they know to single
/// precision, from its change in a step: after one that is too short they are damped by rounding errors, and with all the weight of the
/// next step.
fn evenly(left: f64, most: f64) -> f64 {
    left / (left / most).ceil().max(1.0)
}

/// Stage that a velocity which is not finite after a kick comes from: that which wrote the first of what it is made of. The first kick of
/// a step reads what the stages before have found, any that `is_later` what the last acoustic step has.
fn broken_in<R: Real>(fluid: &Fluid<R>, is_later: bool) -> Stage {
    let n = fluid.state.len();
    if !fluid.top_density_error().is_finite() {
        if is_later { Stage::Continuity } else { Stage::Summation }
    } else if (0..n).any(|i| !fluid.viscous_acceleration(i).is_finite()) {
        if fluid.numbers().rheology.is_some() { Stage::ShearThinning } else { Stage::Viscosity }
    } else {
        Stage::Momentum
    }
}

impl<R: Real, W: MovingWall> Flow<R, W> {
    /// Flow that starts from the state of `fluid`, in a rigid wall.
    pub fn new(mut fluid: Fluid<R>, mut openings: Openings, allow_mach: bool) -> Self {
        openings.start(&mut fluid.state);
        let readings = vec![Reading::default(); openings.ports().len()];
        Self {
            fluid,
            wall: None,
            openings,
            time: 0.0,
            advective_steps: 0,
            acoustic_steps: 0,
            particle_substeps: 0,
            watch: Watch::default(),
            ledger: Ledger::default(),
            allow_mach,
            readings,
        }
    }

    /// The same flow with a wall that moves; it has to be where that of the fluid is.
    #[must_use]
    pub fn with_wall(mut self, wall: W) -> Self {
        self.wall = Some(Coupling::new(wall, &mut self.fluid));
        self
    }

    /// Shows all that the next step depends on, and what was summed so far. What has been read takes effect with [`Self::resume`].
    pub fn remember(&mut self, memory: &mut dyn Memory) {
        let Self {
            fluid,
            wall,
            openings,
            time,
            advective_steps,
            acoustic_steps,
            particle_substeps,
            watch,
            ledger,
            allow_mach: _,
            // Read anew in every step.
            readings: _,
        } = self;
        fluid.remember(memory);
        openings.remember(memory);
        if let Some(wall) = wall {
            wall.remember(memory);
        }
        memory.fields("time_s", &mut [time]);
        memory.counts("steps", &mut [advective_steps, acoustic_steps, particle_substeps]);
        let Watch { max_density_error, max_mach, escaped, returned, non_finite } = watch;
        memory.fields("watch.largest", &mut [max_density_error, max_mach]);
        memory.counts("watch.counts", &mut [escaped, returned, non_finite]);
        ledger.remember(memory);
    }

    /// Goes on from what [`Self::remember`] has read.
    ///
    /// # Errors
    /// When what has been read is no state of the wall.
    pub fn resume(&mut self) -> Result<(), CouplingError> {
        self.wall.as_mut().map_or(Ok(()), |wall| wall.wall.resume())
    }

    /// Takes one advective step, no further than to `until` \[s\].
    ///
    /// # Errors
    /// When a value is not finite, the flow too fast, the vessel empty or the wall broken; the state is then that of
    /// the step in which it showed.
    pub fn step(&mut self, until: f64) -> Result<(), Diverged> {
        let Self { fluid, openings, ledger, wall, .. } = self;
        self.advective_steps += 1;
        if self.advective_steps > 1 {
            ledger.time(Stage::Exchange, || openings.exchange(&mut fluid.state, self.time));
        }
        if fluid.state.is_empty() {
            return Err(self.diverged(Breakdown::Empty, Stage::Exchange, self.time));
        }
        ledger.time(Stage::Exchange, || {
            fluid.sort();
            openings.locate(&fluid.state, fluid.part());
        });
        if let Some(wall) = wall {
            ledger.time(Stage::Coupling, || wall.show(fluid));
        }
        ledger.time(Stage::Rows, || fluid.search(openings.zones()));
        ledger.time(Stage::Summation, || fluid.summation(openings.zones()));
        ledger.time(Stage::Viscosity, || fluid.viscosity());
        if fluid.numbers().rheology.is_some() {
            ledger.time(Stage::ShearThinning, || fluid.shear_thinning());
        }
        if let Some(wall) = wall {
            ledger.time(Stage::Coupling, || wall.take_drag(fluid));
        }
        ledger.time(Stage::Viscosity, || fluid.offsets());
        let full = fluid.advective_step();
        let ahead = until - self.time;
        let duration = if ahead < 2.0 * full { evenly(ahead, full) } else { full };
        let reach = fluid.numbers().reach();

        let (mut elapsed, mut travelled) = (0.0, 0.0);
        let mut dt = evenly(duration, fluid.numbers().acoustic_step(fluid.top_speed()));
        ledger.time(Stage::Momentum, || fluid.begin_acoustic(dt));
        loop {
            ledger.time(Stage::WallPressure, || fluid.wall_pressure());
            let inner = ledger.time(Stage::Momentum, || fluid.kick(dt));
            let end = self.time + elapsed + dt;
            if !inner.is_finite() {
                let stage = broken_in(fluid, elapsed > 0.0);
                return Err(self.non_finite(stage, end));
            }
            let near = ledger.time(Stage::Openings, || openings.apply(fluid, end, dt));
            if !near.is_finite() {
                return Err(self.non_finite(Stage::Openings, end));
            }
            if let Some(wall) = wall {
                ledger.time(Stage::Coupling, || wall.take_pressure(fluid));
                if let Err(error) = ledger.time(Stage::Wall, || wall.advance(dt)) {
                    return Err(self.diverged(Breakdown::Wall(error), Stage::Wall, end));
                }
                ledger.time(Stage::Coupling, || wall.show_velocity(fluid, dt));
            }
            elapsed += dt;
            self.acoustic_steps += 1;
            self.particle_substeps += fluid.state.len() as u64;
            // A remainder below rounding is no step of its own.
            let left = duration - elapsed;
            let top = inner.max(near);
            travelled += dt * top;
            let next = evenly(left, fluid.numbers().acoustic_step(top));
            // What has sped up meanwhile goes no further with the neighbours it has than what was fast before.
            let goes_on = left > 1e-9 * duration && travelled < reach;
            ledger.time(Stage::Continuity, || fluid.continuity(dt, goes_on.then_some(next)));
            if !goes_on {
                break;
            }
            dt = next;
        }
        self.time = if until - (self.time + elapsed) < 1e-9 * duration { until } else { self.time + elapsed };
        fluid.note_part(elapsed / full);
        if fluid.numbers().transport_velocity {
            ledger.time(Stage::Transport, || fluid.transport(openings.zones()));
        }
        let readings = &mut self.readings;
        ledger.time(Stage::Guard, || openings.measure_into(&fluid.state, self.time, readings));
        self.guard()
    }

    /// That the step under way cannot be ended.
    fn diverged(&self, breakdown: Breakdown, stage: Stage, time: f64) -> Diverged {
        Diverged { breakdown, stage, step: self.advective_steps, time }
    }

    /// The same, by the first value that is not finite.
    fn non_finite(&mut self, stage: Stage, time: f64) -> Diverged {
        self.watch.non_finite += 1;
        let state = &mut self.fluid.state;
        let bad = visit::first_non_finite(state);
        let breakdown = match bad {
            Some(NonFinite { column, unit, particle: i }) => {
                Breakdown::NonFinite { column, unit, id: state.id[i], position: state.position[i] }
            }
            // Only the square of a speed is beyond all numbers.
            None => self.too_fast(),
        };
        self.diverged(breakdown, stage, time)
    }

    /// That the fastest particle is too fast; that there is none where all have left.
    fn too_fast(&self) -> Breakdown {
        let state = &self.fluid.state;
        let speed = |i: &usize| state.velocity[*i].length();
        let fastest = (0..state.len()).max_by(|a, b| speed(a).total_cmp(&speed(b)));
        let Some(i) = fastest else { return Breakdown::Empty };
        let sound_speed = self.fluid.numbers().sound_speed;
        Breakdown::TooFast { id: state.id[i], position: state.position[i], speed: speed(&i), sound_speed }
    }

    /// Puts back what touches the wall, drops what has left through it, and checks the state.
    fn guard(&mut self) -> Result<(), Diverged> {
        let start = std::time::Instant::now();
        let fluid = &mut self.fluid;
        let sound_speed = fluid.numbers().sound_speed;
        let speed = fluid.top_speed();
        let density = fluid.top_density_error();
        if !(speed.is_finite() && density.is_finite()) {
            let stage = if density.is_finite() { Stage::Transport } else { Stage::Continuity };
            return Err(self.non_finite(stage, self.time));
        }
        self.watch.max_mach = self.watch.max_mach.max(speed / sound_speed);
        self.watch.max_density_error = self.watch.max_density_error.max(density);
        let guarded = fluid.guard();
        self.watch.returned += guarded.returned as u64;
        self.watch.escaped += guarded.lost.len() as u64;
        for &i in &guarded.lost {
            visit::swap_remove(&mut fluid.state, i);
        }
        self.ledger.add(Stage::Guard, start.elapsed());
        if speed > MAX_MACH * sound_speed && !self.allow_mach {
            return Err(self.diverged(self.too_fast(), Stage::Guard, self.time));
        }
        Ok(())
    }
}
