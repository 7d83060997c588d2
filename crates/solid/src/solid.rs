//! The solid body: what it is made of, what holds it and what acts on it.

use crate::energy::Ledger;
use crate::error::{SolidError, within};
use crate::face::Face;
use crate::formulation::Formulation;
use crate::load::{Impedance, Loads, Pressure, Tissue};
use crate::lumen::Lumen;
use crate::material::{Elastic, Fibres, Material};
use crate::numbers::Numbers;
use crate::reference::{Arrangement, Reference};
use crate::state::SolidState;
use crate::total::TotalLagrangian;
use crate::updated::UpdatedLagrangian;
use glam::DVec3;
use std::marker::PhantomData;
use vaso_kernels::{Isa, Real, Wendland};
use vaso_particles::{Columns, Memory, Visitor, WallLoad, visit};

/// Particles of a solid, in any order; all lists in the same.
#[derive(Clone, Copy, Debug, Default)]
pub struct Particles<'a> {
    /// Positions in the reference configuration \[m\].
    pub position: &'a [DVec3],
    /// Volumes \[m^3\].
    pub volume: &'a [f64],
    /// Distances behind the surface of the lumen \[m\]; empty for a body that no fluid touches.
    pub depth: &'a [f64],
    /// Circumferential and axial direction of the wall; only read by materials with fibres, otherwise it may be empty.
    pub directions: &'a [[DVec3; 2]],
    /// Shift \[m\] after which the body repeats, as a slab does.
    pub period: Option<DVec3>,
}

/// What the body shows to a fluid.
pub(crate) struct Shown {
    pub position: Vec<DVec3>,
    pub mean_velocity: Vec<DVec3>,
    pub acceleration: Vec<DVec3>,
    pub depth: Vec<f64>,
}

/// Elastic body of particles.
///
/// Its particles lie in cell order; [`SolidState::id`] and [`Solid::place`] lead from one order to the other. One step of the
/// fluid is: [`Self::set_load`], [`Self::advance`], then [`Self::wall_view`] and [`Self::wall_motion`].
pub struct Solid<R> {
    /// Columns of the particles. After a change by hand call [`Self::refresh`].
    pub state: SolidState,
    pub(crate) material: Material,
    pub(crate) numbers: Numbers,
    pub(crate) body: Box<dyn Formulation>,
    pub(crate) loads: Loads,
    /// Normals of the planes that particles slide on.
    pub(crate) planes: Vec<DVec3>,
    pub(crate) shown: Option<Shown>,
    pub(crate) ledger: Ledger,
    /// Whether accelerations belong to the state.
    pub(crate) ready: bool,
    /// `place[given] = sorted`.
    place: Vec<u32>,
    pub(crate) isa: Isa,
    precision: PhantomData<R>,
}

impl<R: Real> Solid<R> {
    /// Body at rest, free and without loads.
    ///
    /// # Errors
    /// [`SolidError::Count`] for lists of different lengths, [`SolidError::OutOfRange`] for numbers without a meaning,
    /// [`SolidError::Flat`] where the body is one particle thick.
    pub fn new(
        particles: &Particles,
        material: Material,
        numbers: Numbers,
        isa: Isa,
    ) -> Result<Self, SolidError> {
        numbers.check()?;
        let n = particles.position.len();
        let needs_directions = matches!(material, Material::HolzapfelGasserOgden(_));
        for (what, given, may_be_empty) in [
            ("volume", particles.volume.len(), false),
            ("depth", particles.depth.len(), true),
            ("directions", particles.directions.len(), !needs_directions),
        ] {
            if given != n && !(given == 0 && may_be_empty) {
                return Err(SolidError::Count { what, given, expected: n });
            }
        }
        for &volume in particles.volume {
            within("volume", volume, volume > 0.0, "above 0 m^3")?;
        }
        let kernel = Wendland::new(numbers.smoothing_length);
        let arrangement = Arrangement::new(particles.position, &kernel, particles.period, isa);
        let mut state = SolidState::at_rest(particles.position, particles.volume, numbers.density);
        visit::reorder(&mut state, &arrangement.order, &mut visit::Spare::default());
        let mut place = vec![0; n];
        for (new, &old) in arrangement.order.iter().enumerate() {
            place[old as usize] = new as u32;
        }
        let shown = (particles.depth.len() == n && n > 0).then(|| Shown {
            position: state.reference_position.to_vec(),
            mean_velocity: vec![DVec3::ZERO; n],
            acceleration: vec![DVec3::ZERO; n],
            depth: state.id.iter().map(|&id| particles.depth[id as usize]).collect(),
        });
        let make = Make { arrangement, kernel, state: &state, numbers: &numbers, isa };
        let body: Box<dyn Formulation> = match material {
            Material::SaintVenantKirchhoff(m) => make.elastic::<R, _>(m, Vec::new())?,
            Material::NeoHookean(m) => make.elastic::<R, _>(m, Vec::new())?,
            Material::HolzapfelGasserOgden(m) => {
                let directions = state.id.iter().map(|&id| particles.directions[id as usize]);
                let fibres = directions.map(|[circumferential, axial]| m.fibres(circumferential, axial));
                make.elastic::<R, _>(m, fibres.collect())?
            }
            Material::HypoElastic(m) => {
                Box::new(UpdatedLagrangian::<R>::new(m, n, kernel, particles.period, isa))
            }
        };
        Ok(Self {
            body,
            state,
            material,
            numbers,
            loads: Loads::default(),
            planes: Vec::new(),
            shown,
            ledger: Ledger::default(),
            ready: false,
            place,
            isa,
            precision: PhantomData,
        })
    }

    /// The numbers of the body.
    pub fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    /// Changes the damping between pairs, for a start that comes to rest quickly; a body without damping keeps none.
    ///
    /// # Errors
    /// [`SolidError::OutOfRange`] outside of 0 to 2.
    pub fn set_damping(&mut self, damping: f64) -> Result<(), SolidError> {
        let numbers = Numbers { damping, ..self.numbers };
        numbers.check()?;
        self.numbers = numbers;
        Ok(())
    }

    /// The material of the body.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Place in the columns of the particle that was given as number `particle`.
    pub fn place(&self, particle: usize) -> usize {
        self.place[particle] as usize
    }

    pub(crate) fn places(&self, what: &'static str, particles: &[u32]) -> Result<Vec<u32>, SolidError> {
        let len = self.place.len();
        let find = |&p: &u32| {
            let particle = p as usize;
            self.place.get(particle).copied().ok_or(SolidError::NoSuchParticle { what, particle, len })
        };
        particles.iter().map(find).collect()
    }

    /// Holds particles where they are; to clamp a body hold those within 2h of the end.
    ///
    /// # Errors
    /// [`SolidError::NoSuchParticle`].
    pub fn clamp(&mut self, particles: &[u32]) -> Result<(), SolidError> {
        for i in self.places("clamp", particles)? {
            self.state.support[i as usize] = SolidState::CLAMPED;
            self.state.velocity[i as usize] = DVec3::ZERO;
        }
        Ok(())
    }

    /// Lets particles slide on planes of this normal: their displacement along it stays what it is.
    ///
    /// # Errors
    /// [`SolidError::NoSuchParticle`]; [`SolidError::OutOfRange`] for a normal without length.
    pub fn slide(&mut self, particles: &[u32], normal: DVec3) -> Result<(), SolidError> {
        let length = normal.length();
        within("normal", length, length > 0.0, "a vector with a length")?;
        let plane = self.planes.len() as i32;
        self.planes.push(normal / length);
        for i in self.places("slide", particles)? {
            let v = self.state.velocity[i as usize];
            self.state.support[i as usize] = plane;
            self.state.velocity[i as usize] = held(v, plane, &self.planes);
        }
        Ok(())
    }

    /// Ties a face to the tissue around: a traction `-stiffness u - damping v` (Moireau et al. 2012; 1e6 to 1e7 Pa/m and 1e3
    /// to 1e5 Pa s/m are usual).
    ///
    /// # Errors
    /// [`SolidError::NoSuchParticle`]; [`SolidError::OutOfRange`] for numbers below zero.
    pub fn add_tissue(&mut self, face: &Face, stiffness: f64, damping: f64) -> Result<(), SolidError> {
        within("stiffness", stiffness, stiffness >= 0.0, "0 Pa/m or more")?;
        within("damping", damping, damping >= 0.0, "0 Pa s/m or more")?;
        let at = self.places("tissue", &face.particles)?;
        self.loads.tissue.extend(at.into_iter().zip(&face.area).map(|(at, area)| {
            let area = area.length();
            Tissue { at, stiffness: stiffness * area, damping: damping * area }
        }));
        self.ready = false;
        Ok(())
    }

    /// Puts a pressure \[Pa\] on a face, which follows it; returns the number to change it by. A negative pressure on the inner
    /// face takes the pressure away at which the reference configuration is unloaded.
    ///
    /// # Errors
    /// [`SolidError::NoSuchParticle`]; [`SolidError::OutOfRange`] for a pressure that is not finite.
    pub fn add_pressure(&mut self, face: &Face, pressure: f64) -> Result<usize, SolidError> {
        within("pressure", pressure, true, "any finite number")?;
        let at = self.places("pressure", &face.particles)?;
        self.loads.pressures.push(Pressure { at, area: face.area.clone(), value: pressure });
        self.ready = false;
        Ok(self.loads.pressures.len() - 1)
    }

    /// Changes the pressure \[Pa\] on the face that [`Self::add_pressure`] gave `number`.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn set_pressure(&mut self, number: usize, pressure: f64) {
        self.loads.pressures[number].value = pressure;
        self.ready = false;
    }

    /// Lets a face answer the fluid before it implicitly: for walls so thin that the force of a step of the fluid would turn
    /// their velocity around, `thickness < 0.4 rho_0 / rho_s` spacings of the fluid.
    ///
    /// `impedance` \[Pa s/m\] is density times sound speed of the fluid, `share` (0.5 to 1) how much of it is taken implicitly. It
    /// acts like a mass `share * impedance * dt` by area in one step, and dissipates nothing.
    ///
    /// # Errors
    /// [`SolidError::NoSuchParticle`]; [`SolidError::OutOfRange`] for numbers without a meaning.
    pub fn add_impedance(&mut self, face: &Face, impedance: f64, share: f64) -> Result<(), SolidError> {
        within("impedance", impedance, impedance >= 0.0, "0 Pa s/m or more")?;
        within("share", share, (0.5..=1.0).contains(&share), "0.5 to 1")?;
        let at = self.places("impedance", &face.particles)?;
        self.loads.impedance.extend(at.into_iter().zip(&face.area).map(|(at, area)| Impedance {
            at,
            coefficient: share * impedance * area.length(),
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
    /// [`SolidError::Count`] unless there is one force a particle, and one pressure a particle of the face of [`Self::bear`].
    pub fn set_load(&mut self, load: &WallLoad) -> Result<(), SolidError> {
        let expected = self.state.len();
        for (what, given) in
            [("pressure_force", load.pressure_force.len()), ("viscous_force", load.viscous_force.len())]
        {
            if given != expected {
                return Err(SolidError::Count { what, given, expected });
            }
        }
        if let Some(lumen) = &mut self.loads.lumen {
            let (given, expected) = (load.face_pressure.len(), lumen.len());
            if given != expected {
                return Err(SolidError::Count { what: "face_pressure", given, expected });
            }
            lumen.set_pressure(load.face_pressure);
        }
        let both = load.pressure_force.iter().zip(load.viscous_force);
        self.loads.fluid.clear();
        self.loads.fluid.extend(both.map(|(p, v)| *p + *v));
        self.loads.update(&self.state, &*self.body);
        Ok(())
    }

    /// Shows all that the body carries from step to step, under `name`. What has been read takes effect with [`Self::resume`].
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        memory.columns(name, self);
        // The formulation shows what it carries as columns.
        let Self {
            state,
            loads,
            ledger,
            place,
            material: _,
            numbers: _,
            body: _,
            planes: _,
            shown: _,
            ready: _,
            isa: _,
            precision: _,
        } = self;
        let (seen, needed) = (state.len(), place.len());
        if seen != needed {
            memory.refuse(name, format!("it has {seen} particles, the body {needed}"));
        }
        let Ledger { dissipation, load_work } = ledger;
        memory.fields(&format!("{name}.energies_j"), &mut [dissipation, load_work]);
        // Empty before the first load.
        memory.vectors(&format!("{name}.load_n"), &mut loads.fluid);
        if let Some(lumen) = &mut loads.lumen {
            memory.fixed_numbers(&format!("{name}.face_pressure_pa"), lumen.pressure_mut());
        }
    }

    /// Neighbour pairs, each direction counted.
    pub fn n_pairs(&self) -> usize {
        self.body.n_pairs()
    }

    /// Bytes held.
    pub fn bytes(&mut self) -> usize {
        let vectors = self.shown.as_ref().map_or(0, |s| 3 * s.position.capacity())
            + self.loads.fluid.capacity()
            + self.loads.acceleration.capacity();
        let lumen = self.loads.lumen.as_ref().map_or(0, Lumen::bytes);
        let working = self.body.bytes() + vectors * size_of::<DVec3>() + 4 * self.place.capacity() + lumen;
        visit::bytes(self) + working
    }
}

/// All that a body has to remember; accelerations and strains follow from it by [`Solid::refresh`].
impl<R: Real> Columns for Solid<R> {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        self.state.visit(visitor);
        self.body.visit(visitor);
    }
}

/// What a formulation is made from.
struct Make<'a> {
    arrangement: Arrangement,
    kernel: Wendland,
    state: &'a SolidState,
    numbers: &'a Numbers,
    isa: Isa,
}

impl Make<'_> {
    fn elastic<R: Real, E: Elastic>(
        self,
        material: E,
        fibres: Vec<Fibres>,
    ) -> Result<Box<dyn Formulation>, SolidError> {
        let Self { arrangement, kernel, state, numbers, isa } = self;
        let reference = Reference::<R>::new(arrangement, kernel, &state.volume, &state.id, isa)?;
        Ok(Box::new(TotalLagrangian::new(material, reference, fibres, numbers, isa)))
    }
}

/// What a support leaves of a velocity.
#[inline(always)]
pub(crate) fn held(v: DVec3, support: i32, planes: &[DVec3]) -> DVec3 {
    match support {
        SolidState::FREE => v,
        SolidState::CLAMPED => DVec3::ZERO,
        plane => {
            let n = planes[plane as usize];
            v - v.dot(n) * n
        }
    }
}
