//! The shell: what it is made of, what holds it and what acts on it.

use crate::energy::Ledger;
use crate::error::{ShellError, within};
use crate::forces::Forces;
use crate::frequency::highest_frequency;
use crate::load::{Impedance, Loads, Pressure, Tissue, turning};
use crate::material::Material;
use crate::numbers::Numbers;
use crate::reference::{Arrangement, Ordered, Reference};
use crate::state::ShellState;
use crate::support::{Support, numbered};
use glam::DVec3;
use vaso_kernels::{Isa, Real};
use vaso_particles::{Column, Columns, Visitor, WallLoad, visit};

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
            damping_time: state.thickness.iter().map(|t| numbers.damping_time(&material, *t)).fold(0.0, f64::max),
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

    /// The material of the shell.
    pub fn material(&self) -> &Material {
        &self.forces.material
    }

    /// Place in the columns of the particle that was given as number `particle`.
    pub fn place(&self, particle: usize) -> usize {
        self.place[particle] as usize
    }

    fn places(&self, what: &'static str, particles: &[u32]) -> Result<Vec<u32>, ShellError> {
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

    /// Ties particles to the tissue around: a traction `-stiffness u - damping v` (Moireau et al. 2012; 1e6 to 1e7 Pa/m and 1e3
    /// to 1e5 Pa s/m are usual).
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::OutOfRange`] for numbers below zero.
    pub fn add_tissue(&mut self, particles: &[u32], stiffness: f64, damping: f64) -> Result<(), ShellError> {
        within("stiffness", stiffness, stiffness >= 0.0, "0 Pa/m or more")?;
        within("damping", damping, damping >= 0.0, "0 Pa s/m or more")?;
        let at = self.places("tissue", particles)?;
        let area = &self.state.area;
        self.loads.tissue.extend(at.into_iter().map(|at| Tissue {
            at,
            stiffness: stiffness * area[at as usize],
            damping: damping * area[at as usize],
        }));
        self.ready = false;
        Ok(())
    }

    /// Puts a pressure \[Pa\] on particles, towards the side of their directors, which follows their area; returns the number to
    /// change it by. `areas` \[m^2\] are those that are loaded: of the lumen, which is narrower than the mid-surface, by the
    /// factors of [`Self::lumen_area`]. A negative pressure takes away the one at which the reference configuration is unloaded.
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::Count`] unless there is one area a particle; [`ShellError::OutOfRange`] for a
    /// pressure that is not finite.
    pub fn add_pressure(
        &mut self,
        particles: &[u32],
        areas: &[f64],
        pressure: f64,
    ) -> Result<usize, ShellError> {
        within("pressure", pressure, true, "any finite number")?;
        let at = self.places("pressure", particles)?;
        if areas.len() != at.len() {
            return Err(ShellError::Count { what: "areas", given: areas.len(), expected: at.len() });
        }
        self.loads.pressures.push(Pressure { at, area: areas.to_vec(), value: pressure });
        self.ready = false;
        Ok(self.loads.pressures.len() - 1)
    }

    /// Changes the pressure \[Pa\] that [`Self::add_pressure`] gave `number`.
    ///
    /// # Panics
    /// If there is no such pressure.
    pub fn set_pressure(&mut self, number: usize, pressure: f64) {
        self.loads.pressures[number].value = pressure;
        self.ready = false;
    }

    /// Adds dead forces \[N\], one a particle.
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::Count`] unless there is one force a particle.
    pub fn add_forces(&mut self, particles: &[u32], forces: &[DVec3]) -> Result<(), ShellError> {
        let at = self.places("forces", particles)?;
        if forces.len() != at.len() {
            return Err(ShellError::Count { what: "forces", given: forces.len(), expected: at.len() });
        }
        self.loads.forces.extend(at.into_iter().zip(forces.iter().copied()));
        self.ready = false;
        Ok(())
    }

    /// Adds dead moments \[N m\] about axes fixed in space, one a particle.
    ///
    /// # Errors
    /// As [`Self::add_forces`].
    pub fn add_moments(&mut self, particles: &[u32], moments: &[DVec3]) -> Result<(), ShellError> {
        let at = self.places("moments", particles)?;
        if moments.len() != at.len() {
            return Err(ShellError::Count { what: "moments", given: moments.len(), expected: at.len() });
        }
        self.loads.moments.extend(at.into_iter().zip(moments.iter().copied()));
        self.ready = false;
        Ok(())
    }

    /// Lets particles answer the fluid before it implicitly: for walls so thin that the force of a step of the fluid would turn
    /// their velocity around, `thickness < 0.6` spacings of the fluid.
    ///
    /// `impedance` \[Pa s/m\] is density times sound speed of the fluid, `share` (0.5 to 1) how much of it is taken implicitly. It
    /// acts like a mass `share * impedance * dt` by area in one step, and dissipates nothing.
    ///
    /// # Errors
    /// [`ShellError::NoSuchParticle`]; [`ShellError::OutOfRange`] for numbers without a meaning.
    pub fn add_impedance(&mut self, particles: &[u32], impedance: f64, share: f64) -> Result<(), ShellError> {
        within("impedance", impedance, impedance >= 0.0, "0 Pa s/m or more")?;
        within("share", share, (0.5..=1.0).contains(&share), "0.5 to 1")?;
        let at = self.places("impedance", particles)?;
        let area = &self.state.area;
        self.loads.impedance.extend(at.into_iter().map(|at| Impedance {
            at,
            coefficient: share * impedance * area[at as usize],
            start: DVec3::ZERO,
        }));
        Ok(())
    }

    /// Acceleration of all particles \[m/s^2\].
    pub fn set_gravity(&mut self, gravity: DVec3) {
        self.loads.gravity = gravity;
        self.ready = false;
    }

    /// Takes the forces of the fluid, which hold until the next ones.
    ///
    /// # Errors
    /// [`ShellError::Count`] unless there is one force a particle.
    pub fn set_load(&mut self, load: &WallLoad) -> Result<(), ShellError> {
        let expected = self.state.len();
        for (what, given) in
            [("pressure_force", load.pressure_force.len()), ("viscous_force", load.viscous_force.len())]
        {
            if given != expected {
                return Err(ShellError::Count { what, given, expected });
            }
        }
        let both = load.pressure_force.iter().zip(load.viscous_force);
        self.loads.fluid.clear();
        self.loads.fluid.extend(both.map(|(p, v)| *p + *v));
        self.loads.update(&self.state, &self.forces);
        Ok(())
    }

    /// Bytes held.
    pub fn bytes(&mut self) -> usize {
        let vectors = 3 * self.shown.position.capacity()
            + self.loads.fluid.capacity()
            + self.loads.acceleration.capacity()
            + self.loads.turning.capacity();
        let numbers = self.shown.depth.capacity() + self.shown.volume.capacity();
        visit::bytes(self)
            + self.forces.bytes()
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
