//! The shell: what it is made of, what holds it and what acts on it.

use crate::energy::Ledger;
use crate::error::{ShellError, within};
use crate::forces::Forces;
use crate::frequency::highest_frequency;
use crate::load::{Loads, turning};
use crate::material::{Material, Model};
use crate::numbers::Numbers;
use crate::reference::{Arrangement, Ordered, Reference};
use crate::section::Layer;
use crate::state::ShellState;
use crate::support::{Support, numbered};
use glam::DVec3;
use vaso_kernels::{Isa, Real};
use vaso_particles::{Column, Columns, Memory, Visitor, visit};

/// Particles of a shell, in any order; all lists in the same.
#[derive(Clone, Copy, Debug, Default)]
pub struct Particles<'a> {
    /// Positions of the mid-surface in the reference configuration \[m\].
    pub position: &'a [DVec3],
    /// Normals there, away from the lumen; their length does not matter.
    pub normal: &'a [DVec3],
    /// Areas \[m^2\].
    pub area: &'a [f64],
    /// Thicknesses \[m\].
    pub thickness: &'a [f64],
}

/// What the shell shows to a fluid.
pub(crate) struct Shown {
    pub position: Vec<DVec3>,
    pub mean_velocity: Vec<DVec3>,
    pub acceleration: Vec<DVec3>,
    pub depth: Vec<f64>,
    pub volume: Vec<f64>,
}

/// Elastic shell of one layer of particles.
///
/// Its particles lie in cell order; [`ShellState::id`] and [`Shell::place`] lead from one order to the other. One step of the
/// fluid is: [`Self::set_load`], [`Self::advance`], then [`Self::wall_view`] and [`Self::wall_motion`].
pub struct Shell<R> {
    /// Columns of the particles. After a change by hand call [`Self::refresh`].
    pub state: ShellState,
    pub(crate) numbers: Numbers,
    pub(crate) forces: Forces<R>,
    pub(crate) loads: Loads,
    pub(crate) supports: Vec<Support>,
    pub(crate) shown: Shown,
    pub(crate) ledger: Ledger,
    /// Whether accelerations belong to the state.
    pub(crate) ready: bool,
    /// Highest frequency at rest \[rad/s\].
    pub(crate) frequency: f64,
    /// How much damping shortens the step \[s\].
    pub(crate) damping_time: f64,
    /// `place[given] = sorted`.
    place: Vec<u32>,
}

impl<R: Real> Shell<R> {
    /// Shell at rest, free and without loads.
    ///
    /// # Errors
    /// [`ShellError::Count`] for lists of different lengths, [`ShellError::OutOfRange`] for numbers without a meaning,
    /// [`ShellError::Lonely`] where neighbours do not span a surface.
    pub fn new(
        particles: &Particles,
        material: Material,
        numbers: Numbers,
        isa: Isa,
    ) -> Result<Self, ShellError> {
        numbers.check()?;
        let n = particles.position.len();
        for (what, given) in [
            ("normal", particles.normal.len()),
            ("area", particles.area.len()),
            ("thickness", particles.thickness.len()),
        ] {
            if given != n {
                return Err(ShellError::Count { what, given, expected: n });
            }
        }
        for i in 0..n {
            within("area", particles.area[i], particles.area[i] > 0.0, "above 0 m^2")?;
            within("thickness", particles.thickness[i], particles.thickness[i] > 0.0, "above 0 m")?;
            let length = particles.normal[i].length();
            within("normal", length, length > 0.0, "a vector with a length")?;
        }
        let arrangement = Arrangement::new(particles.position, 2.0 * numbers.smoothing_length, isa);
        let mut place = vec![0; n];
        for (new, &old) in arrangement.order.iter().enumerate() {
            place[old as usize] = new as u32;
        }
        let state = at_rest(particles, &numbers, &arrangement.order);
        let ordered = Ordered {
            position: &state.reference_position,
            director: &state.director,
            area: &state.area,
            thickness: &state.thickness,
            id: &state.id,
        };
        let reference = Reference::<R>::new(arrangement, &ordered, &numbers, isa)?;
        if let Model::NeoHookean { .. } = material.model() {
            unfolded(&reference, &state)?;
        }
        let mut forces = Forces::new(material, reference, &state.thickness, &numbers, isa);
        let frequency = highest_frequency(&mut forces, &state, &numbers)?;
        let shown = Shown {
            position: state.reference_position.to_vec(),
            mean_velocity: vec![DVec3::ZERO; n],
            acceleration: vec![DVec3::ZERO; n],
            depth: state.thickness.iter().map(|t| 0.5 * t).collect(),
            volume: state.thickness.iter().zip(state.area.iter()).map(|(t, a)| t * a).collect(),
        };
        Ok(Self {
            frequency,
            damping_time: state
                .thickness
                .iter()
                .map(|t| numbers.damping_time(&material, *t))
                .fold(0.0, f64::max),
            forces,
            state,
            numbers,
            loads: Loads::default(),
            supports: Vec::new(),
            shown,
            ledger: Ledger::default(),
            ready: false,
            place,
        })
    }

    /// The numbers of the shell.
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// Changes the damping, for a start that comes to rest quickly; a shell without damping keeps none.
    ///
    /// # Errors
    /// [`ShellError::OutOfRange`] outside of 0 to 1.
    pub fn set_damping(&mut self, damping: f64) -> Result<(), ShellError> {
        let numbers = Numbers { damping, ..self.numbers };
        numbers.check()?;
        self.numbers = numbers;
        Ok(())
    }

    /// The material of the shell.
    pub fn material(&self) -> &Material {
        &self.forces.material
    }

    /// Place in the columns of the particle that was given as number `particle`.
    pub fn place(&self, particle: usize) -> usize {
        self.place[particle] as usize
    }

    pub(crate) fn places(&self, what: &'static str, particles: &[u32]) -> Result<Vec<u32>, ShellError> {
        let len = self.place.len();
        let find = |&p: &u32| {
            let particle = p as usize;
            self.place.get(particle).copied().ok_or(ShellError::NoSuchParticle { what, particle, len })
        };
        particles.iter().map(find).collect()
    }

    /// Holds particles; the last support given to a particle is the one that counts.
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::OutOfRange`] for a direction without length.
    pub fn hold(&mut self, particles: &[u32], support: Support) -> Result<(), ShellError> {
        let (displacement, director) = (support.displacement.unit(), support.director.unit());
        let (Some(displacement), Some(director)) = (displacement, director) else {
            let allowed = "a vector with a length";
            return Err(ShellError::OutOfRange { key: "direction", value: 0.0, allowed });
        };
        let number = self.supports.len() as i32;
        self.supports.push(Support { displacement, director });
        for i in self.places("support", particles)? {
            let i = i as usize;
            self.state.support[i] = number;
            self.state.velocity[i] = displacement.of(self.state.velocity[i]);
            let (w, n) = (self.state.director_velocity[i], self.state.director[i]);
            self.state.director_velocity[i] = turning(w, director, n);
        }
        Ok(())
    }

    /// What holds particle `i` of the columns.
    pub fn support(&self, i: usize) -> Support {
        numbered(self.state.support[i], &self.supports)
    }

    /// Shows all that the shell carries from step to step, under `name`. What has been read takes effect with [`Self::resume`].
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        memory.columns(name, self);
        let Self {
            state,
            loads,
            ledger,
            place,
            numbers: _,
            forces: _,
            supports: _,
            shown: _,
            ready: _,
            frequency: _,
            damping_time: _,
        } = self;
        let (seen, needed) = (state.len(), place.len());
        if seen != needed {
            memory.refuse(name, format!("it has {seen} particles, the shell {needed}"));
        }
        let Ledger { dissipation, load_work } = ledger;
        memory.fields(&format!("{name}.energies_j"), &mut [dissipation, load_work]);
        // Empty before the first load.
        memory.vectors(&format!("{name}.load_n"), &mut loads.fluid);
    }

    /// Bytes held.
    pub fn bytes(&mut self) -> usize {
        let vectors = 3 * self.shown.position.capacity();
        let numbers = self.shown.depth.capacity() + self.shown.volume.capacity();
        visit::bytes(self)
            + self.forces.bytes()
            + self.loads.bytes()
            + vectors * size_of::<DVec3>()
            + numbers * size_of::<f64>()
            + 4 * self.place.capacity()
    }
}

/// All that a shell has to remember; accelerations and strains follow from it by [`Shell::refresh`].
impl<R: Real> Columns for Shell<R> {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        self.state.visit(visitor);
    }
}

/// Whether the layers of all particles have a volume.
fn unfolded<R>(reference: &Reference<R>, state: &ShellState) -> Result<(), ShellError> {
    for (i, base) in reference.base.iter().enumerate() {
        let thickness = state.thickness[i];
        let at = |zeta: f64| Layer::at(base, zeta).volume();
        let volume = at(0.5 * thickness).min(at(-0.5 * thickness)) / at(0.0);
        if volume <= 0.0 {
            let (particle, position) = (state.id[i], state.reference_position[i]);
            return Err(ShellError::Folded { particle, position, thickness, volume });
        }
    }
    Ok(())
}

fn at_rest(particles: &Particles, numbers: &Numbers, order: &[u32]) -> ShellState {
    let n = order.len();
    let vectors = |of: &[DVec3]| order.iter().map(|&k| of[k as usize]).collect::<Vec<_>>();
    let scalars = |of: &[f64]| order.iter().map(|&k| of[k as usize]).collect::<Vec<_>>();
    let zero = || vec![DVec3::ZERO; n];
    let director: Vec<DVec3> = vectors(particles.normal).iter().map(|n| n.normalize()).collect();
    let (area, thickness) = (scalars(particles.area), scalars(particles.thickness));
    let by_area = |of: &dyn Fn(f64) -> f64| -> Vec<f64> {
        area.iter().zip(&thickness).map(|(a, t)| numbers.density * a * of(*t)).collect()
    };
    let (mass, rotary_inertia) = (by_area(&|t| t), by_area(&|t| numbers.rotary(t)));
    ShellState {
        reference_position: Column::with("reference_position", "m", vectors(particles.position)),
        displacement: Column::with("displacement", "m", zero()),
        velocity: Column::with("velocity", "m/s", zero()),
        acceleration: Column::with("acceleration", "m/s^2", zero()),
        reference_director: Column::with("reference_director", "", director.clone()),
        director: Column::with("director", "", director),
        director_velocity: Column::with("director_velocity", "1/s", zero()),
        director_acceleration: Column::with("director_acceleration", "1/s^2", zero()),
        mass: Column::with("mass", "kg", mass),
        rotary_inertia: Column::with("rotary_inertia", "kg m^2", rotary_inertia),
        area: Column::with("area", "m^2", area),
        thickness: Column::with("thickness", "m", thickness),
        id: Column::with("id", "", order.iter().map(|&k| u64::from(k)).collect()),
        support: Column::with("support", "", vec![ShellState::FREE; n]),
    }
}
