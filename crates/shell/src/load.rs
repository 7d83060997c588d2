//! Loads and springs: what acts on a shell from outside.

use crate::forces::{Forces, across};
use crate::state::ShellState;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real, sum_in_order};

/// Pressure on particles, which follows their area.
pub(crate) struct Pressure {
    /// Loaded area of each particle in the reference configuration \[m^2\], 0 where there is no load.
    pub(crate) area: Vec<f64>,
    /// Pressure \[Pa\], towards the side of the director.
    pub(crate) value: f64,
}

/// Springs and dashpots between particles and what surrounds the vessel; empty where there are none.
#[derive(Default)]
pub(crate) struct Tissue {
    /// Stiffness of each particle's \[N/m\].
    pub(crate) stiffness: Vec<f64>,
    /// Damping of each particle's \[N s/m\].
    pub(crate) damping: Vec<f64>,
}

/// Particles that answer the fluid implicitly; empty where none does.
#[derive(Default)]
pub(crate) struct Impedance {
    /// Share of the impedance times area that is taken implicitly \[N s/m\].
    pub(crate) coefficient: Vec<f64>,
    /// Velocity at the start of the step of the fluid \[m/s\].
    start: Vec<DVec3>,
}

/// All loads of a shell.
#[derive(Default)]
pub(crate) struct Loads {
    /// Acceleration of all particles \[m/s^2\].
    pub(crate) gravity: DVec3,
    /// Force of the fluid \[N\], empty before there is one.
    pub(crate) fluid: Vec<DVec3>,
    /// Dead forces \[N\] on places in the state.
    pub(crate) forces: Vec<(u32, DVec3)>,
    /// Dead moments \[N m\] on places in the state.
    pub(crate) moments: Vec<(u32, DVec3)>,
    pub(crate) pressures: Vec<Pressure>,
    pub(crate) tissue: Tissue,
    pub(crate) impedance: Impedance,
    /// Acceleration by all of them \[m/s^2\], empty where there are none.
    pub(crate) acceleration: Vec<DVec3>,
    /// Acceleration of the directors by moments \[1/s^2\], empty where there are none.
    pub(crate) turning: Vec<DVec3>,
}

impl Loads {
    /// Whether the loads change while the shell moves.
    pub(crate) fn follow(&self) -> bool {
        !self.pressures.is_empty() || !self.tissue.stiffness.is_empty() || !self.moments.is_empty()
    }

    fn act(&self) -> bool {
        self.follow() || !self.fluid.is_empty() || !self.forces.is_empty() || self.gravity != DVec3::ZERO
    }

    /// Computes the accelerations where the shell is now.
    pub(crate) fn update<R: Real>(&mut self, state: &ShellState, forces: &Forces<R>) {
        if !self.act() {
            self.acceleration.clear();
            self.turning.clear();
            return;
        }
        let Self { gravity, fluid, forces: dead, pressures, tissue, acceleration, .. } = self;
        let (mass, displacement, springs) = (&state.mass, &state.displacement, &tissue.stiffness);
        acceleration.resize(state.len(), DVec3::ZERO);
        acceleration.par_iter_mut().enumerate().with_min_len(1024).for_each(|(i, a)| {
            let mut force = fluid.get(i).copied().unwrap_or_default();
            if !pressures.is_empty() {
                let by_area: f64 = pressures.iter().map(|p| p.value * p.area[i]).sum();
                force += by_area * forces.area_vector(i);
            }
            if let Some(stiffness) = springs.get(i) {
                force -= *stiffness * displacement[i];
            }
            *a = *gravity + force / mass[i];
        });
        for &(i, force) in &*dead {
            acceleration[i as usize] += force / mass[i as usize];
        }
        self.turning.clear();
        if !self.moments.is_empty() {
            self.turning.resize(state.len(), DVec3::ZERO);
            for &(i, moment) in &self.moments {
                let i = i as usize;
                // The power moment . omega is that of moment x n at the rate omega x n of the director.
                self.turning[i] += moment.cross(state.director[i]) / state.rotary_inertia[i];
            }
        }
    }

    /// Acceleration of particle `i` \[m/s^2\].
    #[inline(always)]
    pub(crate) fn on(&self, i: usize) -> DVec3 {
        self.acceleration.get(i).copied().unwrap_or_default()
    }

    /// Acceleration of the director of particle `i` \[1/s^2\].
    #[inline(always)]
    pub(crate) fn on_director(&self, i: usize) -> DVec3 {
        self.turning.get(i).copied().unwrap_or_default()
    }

    /// Lets the dashpots slow the shell over `dt` \[s\], implicitly; returns the energy taken \[J\].
    pub(crate) fn damp(&self, state: &mut ShellState, dt: f64) -> f64 {
        let damping = &self.tissue.damping;
        if damping.is_empty() {
            return 0.0;
        }
        let taken = (state.velocity.par_chunks_mut(CHUNK), state.mass.par_chunks(CHUNK))
            .into_par_iter()
            .zip(damping.par_chunks(CHUNK))
            .map(|((velocity, mass), damping)| {
                let of = |((v, mass), damping): ((&mut DVec3, &f64), &f64)| {
                    let before = *v;
                    *v = before / (1.0 + dt * damping / mass);
                    0.5 * mass * (before.length_squared() - v.length_squared())
                };
                velocity.iter_mut().zip(mass).zip(damping).map(of).sum::<f64>()
            });
        sum_in_order(taken)
    }

    /// Notes the velocities that the fluid has answered with its force.
    pub(crate) fn note_start(&mut self, state: &ShellState) {
        if !self.impedance.coefficient.is_empty() {
            self.impedance.start.clear();
            self.impedance.start.extend_from_slice(&state.velocity);
        }
    }

    /// Draws velocities to those the fluid has answered, at the end of a sub-step `dt` \[s\].
    ///
    /// In the plane, too: the pressure of an uneven fluid pushes along the wall as well, and a thin wall has as little mass for that.
    pub(crate) fn resist(&self, state: &mut ShellState, dt: f64) {
        let Impedance { coefficient, start } = &self.impedance;
        let columns = (&mut state.velocity[..], &state.mass[..], start, coefficient);
        columns.into_par_iter().with_min_len(1024).for_each(|(v, mass, start, coefficient)| {
            let weight = dt * coefficient / mass;
            *v += weight / (1.0 + weight) * (*start - *v);
        });
    }

    /// Largest stiffness over mass of a spring \[1/s^2\].
    pub(crate) fn largest_rate(&self, state: &ShellState) -> f64 {
        let columns = self.tissue.stiffness.iter().zip(&state.mass[..]);
        columns.map(|(stiffness, mass)| stiffness / mass).fold(0.0, f64::max)
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        let vectors = self.fluid.capacity()
            + self.acceleration.capacity()
            + self.turning.capacity()
            + self.impedance.start.capacity();
        let numbers = self.pressures.iter().map(|p| p.area.capacity()).sum::<usize>()
            + self.tissue.stiffness.capacity()
            + self.tissue.damping.capacity()
            + self.impedance.coefficient.capacity();
        size_of::<DVec3>() * vectors + size_of::<f64>() * numbers
    }
}

/// Rate of the director after a support and the constraint on its length have had their say.
#[inline(always)]
pub(crate) fn turning(w: DVec3, hold: crate::support::Hold, director: DVec3) -> DVec3 {
    across(hold.of(w), director)
}
