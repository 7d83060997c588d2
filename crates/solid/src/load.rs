//! Loads and springs: what acts on a solid from outside.

use crate::formulation::Formulation;
use crate::lumen::Lumen;
use crate::state::SolidState;
use glam::DVec3;
use rayon::prelude::*;

/// Pressure on a face, which follows it.
pub(crate) struct Pressure {
    /// Places of the particles in the state.
    pub(crate) at: Vec<u32>,
    /// Areas in the reference configuration \[m^2\].
    pub(crate) area: Vec<DVec3>,
    /// Pressure \[Pa\].
    pub(crate) value: f64,
}

/// Spring and dashpot between one particle and what surrounds the vessel.
pub(crate) struct Tissue {
    /// Place in the state.
    pub(crate) at: u32,
    /// Stiffness \[N/m\].
    pub(crate) stiffness: f64,
    /// Damping \[N s/m\].
    pub(crate) damping: f64,
}

/// Part of a face that answers the fluid implicitly.
pub(crate) struct Impedance {
    /// Place in the state.
    pub(crate) at: u32,
    /// Share of the impedance times area that is taken implicitly \[N s/m\].
    pub(crate) coefficient: f64,
    /// Velocity at the start of the step of the fluid \[m/s\].
    pub(crate) start: DVec3,
}

/// All loads of a solid.
#[derive(Default)]
pub(crate) struct Loads {
    /// Acceleration of all particles \[m/s^2\].
    pub(crate) gravity: DVec3,
    /// Force of the fluid \[N\], empty before there is one.
    pub(crate) fluid: Vec<DVec3>,
    pub(crate) pressures: Vec<Pressure>,
    /// Face under the pressure of the fluid.
    pub(crate) lumen: Option<Lumen>,
    pub(crate) tissue: Vec<Tissue>,
    pub(crate) impedance: Vec<Impedance>,
    /// Acceleration by all of them \[m/s^2\], empty where there are none.
    pub(crate) acceleration: Vec<DVec3>,
}

impl Loads {
    /// Whether the loads change while the body moves.
    pub(crate) fn follow(&self) -> bool {
        !self.pressures.is_empty() || !self.tissue.is_empty() || self.lumen.is_some()
    }

    /// Whether there are any.
    pub(crate) fn act(&self) -> bool {
        self.follow() || !self.fluid.is_empty() || self.gravity != DVec3::ZERO
    }

    /// Computes the accelerations where the body is now.
    pub(crate) fn update(&mut self, state: &SolidState, body: &dyn Formulation) {
        if !self.act() {
            self.acceleration.clear();
            return;
        }
        let (gravity, fluid, mass) = (self.gravity, &self.fluid, &state.mass);
        self.acceleration.resize(state.len(), DVec3::ZERO);
        self.acceleration.par_iter_mut().enumerate().with_min_len(1024).for_each(|(i, a)| {
            *a = gravity + fluid.get(i).map_or(DVec3::ZERO, |force| *force / mass[i]);
        });
        for pressure in &self.pressures {
            for (&i, &area) in pressure.at.iter().zip(&pressure.area) {
                let i = i as usize;
                // Nanson: n da = J F^-T N dA.
                let present = crate::material::cofactor(&body.deformation(i)) * area;
                self.acceleration[i] -= (pressure.value / mass[i]) * present;
            }
        }
        if let Some(lumen) = &mut self.lumen {
            lumen.push(body, mass, &mut self.acceleration);
        }
        for tissue in &self.tissue {
            let i = tissue.at as usize;
            self.acceleration[i] -= (tissue.stiffness / mass[i]) * state.displacement[i];
        }
    }

    /// Lets the dashpots slow the body over `dt` \[s\], implicitly; returns the energy taken \[J\].
    pub(crate) fn damp(&self, state: &mut SolidState, dt: f64) -> f64 {
        let mut taken = 0.0;
        for tissue in self.tissue.iter().filter(|t| t.damping > 0.0) {
            let i = tissue.at as usize;
            let mass = state.mass[i];
            let before = state.velocity[i];
            let after = before / (1.0 + dt * tissue.damping / mass);
            taken += 0.5 * mass * (before.length_squared() - after.length_squared());
            state.velocity[i] = after;
        }
        taken
    }

    /// Notes the velocities that the fluid has answered with its force.
    pub(crate) fn note_start(&mut self, state: &SolidState) {
        for part in &mut self.impedance {
            part.start = state.velocity[part.at as usize];
        }
    }

    /// Draws velocities to those the fluid has answered, at the end of a sub-step `dt` \[s\].
    ///
    /// In the plane of the face, too: the pressure of an uneven fluid pushes along the wall as well, and a thin wall has as little mass
    /// for that.
    pub(crate) fn resist(&self, state: &mut SolidState, dt: f64) {
        for part in &self.impedance {
            let i = part.at as usize;
            let weight = dt * part.coefficient / state.mass[i];
            let lag = part.start - state.velocity[i];
            state.velocity[i] += weight / (1.0 + weight) * lag;
        }
    }

    /// Largest stiffness over mass of a spring \[1/s^2\].
    pub(crate) fn largest_rate(&self, state: &SolidState) -> f64 {
        self.tissue.iter().map(|t| t.stiffness / state.mass[t.at as usize]).fold(0.0, f64::max)
    }
}
