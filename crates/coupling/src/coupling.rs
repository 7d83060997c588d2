//! A wall with what lies between it and the fluid, and the stages of a flow that belong to both.

use crate::wall::{CouplingError, Facet, MovingWall, NO_FACET};
use glam::DVec3;
use rayon::prelude::*;
use vaso_fluid::{Contact, Fluid, Real};
use vaso_kernels::{CHUNK, sum_in_order};
use vaso_particles::{Memory, WallLoad, WallView};

/// A wall that moves, with the forces of the fluid on it.
///
/// An advective step calls [`Self::show`] before the search and [`Self::take_drag`] after the viscosity; each acoustic step
/// [`Self::take_pressure`], [`Self::advance`] and [`Self::show_velocity`] between the conditions at the openings and the
/// continuity.
pub struct Coupling<W> {
    /// The wall.
    pub wall: W,
    /// Sub-steps the wall has taken.
    pub substeps: u64,
    /// Acoustic steps it has been taken along for.
    pub steps: u64,
    /// Work that the fluid has done on it \[J\].
    pub work: f64,
    contact: Vec<Contact>,
    /// Particles of the view by facet, and where those of each facet begin, one more than there are facets.
    behind: Vec<u32>,
    start: Vec<u32>,
    /// Particles of the view without a facet.
    bare: Vec<u32>,
    pressure_force: Vec<DVec3>,
    viscous_force: Vec<DVec3>,
    face_pressure: Vec<f64>,
    /// Facets before an acoustic step.
    facets: Vec<Facet>,
    /// Acceleration \[m/s^2\], without what rings.
    acceleration: Vec<DVec3>,
    /// Velocity before an acoustic step \[m/s\].
    before: Vec<DVec3>,
}

/// Time of the filter of the acceleration, in acoustic steps. The pressure behind the lumen surface answers the acceleration, and
/// acts back on it one step later: unfiltered that rings. A filter of first order is passive at every frequency, which the mean over
/// an advective step is not.
const FILTER: f64 = 3.0;

/// Share of a facet that has to be wetted for all of it to bear the pressure, by the kernel sum of what is behind it: less is found where a
/// wall goes on beyond the end of the fluid, or stands in a crease.
const WETTED: f64 = 0.5;

impl<W: MovingWall> Coupling<W> {
    /// Lets the wall of `fluid` move, as `wall` does; it has to be where it was when the distance of the fluid was measured.
    pub fn new<R: Real>(wall: W, fluid: &mut Fluid<R>) -> Self {
        let view = wall.view();
        fluid.release_wall(&view, wall.thinning());
        let n = view.position.len();
        let zero = || vec![DVec3::ZERO; n];
        let (start, behind, bare) = by_facet(&wall.facet_of());
        Self {
            contact: vec![Contact::default(); n],
            face_pressure: vec![0.0; start.len() - 1],
            facets: Vec::new(),
            start,
            behind,
            bare,
            pressure_force: zero(),
            viscous_force: zero(),
            acceleration: zero(),
            substeps: 0,
            steps: 0,
            work: 0.0,
            before: Vec::new(),
            wall,
        }
    }

    /// Shows the fluid where the wall is, before the search of an advective step.
    pub fn show<R: Real>(&mut self, fluid: &mut Fluid<R>) {
        fluid.take_wall(&self.wall.view(), &self.acceleration);
    }

    /// Takes the viscous force, which holds for the advective step; after the viscosity of the fluid.
    pub fn take_drag<R: Real>(&mut self, fluid: &mut Fluid<R>) {
        fluid.viscous_force_on_wall(&mut self.viscous_force);
    }

    /// Takes the pressure of the kick.
    pub fn take_pressure<R: Real>(&mut self, fluid: &mut Fluid<R>) {
        fluid.pressure_on_wall(&mut self.contact);
        let Self { contact, start, behind, bare, pressure_force, face_pressure, facets, wall, .. } = self;
        (&mut *pressure_force, &*contact)
            .into_par_iter()
            .with_min_len(4096)
            .for_each(|(force, contact)| *force = contact.force);
        for &a in &*bare {
            pressure_force[a as usize] += 2.0 * contact[a as usize].level;
        }
        let wall = &*wall;
        (0..face_pressure.len())
            .into_par_iter()
            .with_min_len(256)
            .map(|number| wall.facet(number))
            .collect_into_vec(facets);
        face_pressure.par_iter_mut().zip(&*facets).enumerate().with_min_len(256).for_each(
            |(number, (pressure, facet))| {
                let whole = facet.area;
                let (mut area, mut level) = (0.0, 0.0);
                for &a in &behind[start[number] as usize..start[number + 1] as usize] {
                    let contact = &contact[a as usize];
                    area += contact.area.dot(whole);
                    level += contact.level.dot(whole);
                }
                let bound = WETTED * 0.5 * whole.length_squared();
                *pressure = if area > 0.0 { level / area.max(bound) } else { 0.0 };
            },
        );
    }

    /// Moves the wall by an acoustic step `dt` \[s\] under what has been taken.
    ///
    /// # Errors
    /// When the wall breaks down.
    pub fn advance(&mut self, dt: f64) -> Result<(), CouplingError> {
        let (pressure_force, viscous_force) = (&self.pressure_force, &self.viscous_force);
        let load = WallLoad { pressure_force, viscous_force, face_pressure: &self.face_pressure };
        self.wall.load(&load)?;
        self.before.clear();
        self.before.extend_from_slice(self.wall.view().velocity);
        self.substeps += self.wall.advance(dt)? as u64;
        self.steps += 1;
        let wall = &self.wall;
        let after = wall.view().velocity;
        let share = 1.0 / (1.0 + FILTER);
        (&mut self.acceleration, &self.before, after)
            .into_par_iter()
            .with_min_len(4096)
            .for_each(|(a, old, new)| *a += share * ((*new - *old) / dt - *a));
        // Forces are constant over the step, velocities about linear.
        let (before, facets, face_pressure) = (&self.before, &self.facets, &self.face_pressure);
        let power = total(after.len(), |i| (before[i] + after[i]).dot(pressure_force[i] + viscous_force[i]))
            + total(facets.len(), |number| {
                let (old, new) = (&facets[number], wall.facet(number));
                face_pressure[number] * 0.5 * (old.area + new.area).dot(old.velocity + new.velocity)
            });
        self.work += 0.5 * dt * power;
        Ok(())
    }

    /// Shows the fluid the velocity of the wall at the end of an acoustic step `dt` \[s\].
    pub fn show_velocity<R: Real>(&self, fluid: &mut Fluid<R>, dt: f64) {
        fluid.set_wall_velocity(self.wall.view().velocity, &self.acceleration, dt);
    }

    /// Shows all that lies between wall and fluid from one advective step to the next, the wall itself included. What has been read takes
    /// effect with [`MovingWall::resume`] of the wall.
    pub fn remember(&mut self, memory: &mut dyn Memory) {
        // Forces are taken anew before they act, and the velocity before a step is noted in each.
        let Self {
            wall,
            substeps,
            steps,
            work,
            contact: _,
            behind: _,
            start: _,
            bare: _,
            pressure_force: _,
            viscous_force: _,
            face_pressure: _,
            facets: _,
            acceleration,
            before: _,
        } = self;
        wall.remember(memory);
        memory.counts("coupling.steps", &mut [substeps, steps]);
        memory.fields("coupling.work_j", &mut [work]);
        memory.fixed_vectors("coupling.acceleration", acceleration);
    }

    /// Forces of the fluid on the particles of the wall \[N\] in the last step: by pressure, and by viscosity.
    pub fn load(&self) -> WallLoad<'_> {
        WallLoad {
            pressure_force: &self.pressure_force,
            viscous_force: &self.viscous_force,
            face_pressure: &self.face_pressure,
        }
    }

    /// Particles of the wall.
    pub fn view(&self) -> WallView<'_> {
        self.wall.view()
    }

    /// Bytes held beside the wall itself.
    pub fn bytes(&self) -> usize {
        let vectors = self.pressure_force.capacity()
            + self.viscous_force.capacity()
            + self.acceleration.capacity()
            + self.before.capacity();
        let facets = size_of::<Facet>() * self.facets.capacity() + 8 * self.face_pressure.capacity();
        let lists = self.behind.capacity() + self.start.capacity() + self.bare.capacity();
        size_of::<DVec3>() * vectors + size_of::<Contact>() * self.contact.capacity() + facets + 4 * lists
    }
}

/// Sum of the terms of `n` particles, in pieces of fixed length.
fn total(n: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    let piece = |c: usize| (c * CHUNK..n.min((c + 1) * CHUNK)).map(&term).sum::<f64>();
    sum_in_order((0..n.div_ceil(CHUNK)).into_par_iter().map(piece))
}

/// Particles by facet: where those of each facet begin, the particles in this order, and those without a facet.
fn by_facet(facet_of: &[u32]) -> (Vec<u32>, Vec<u32>, Vec<u32>) {
    let n = facet_of.iter().filter(|&&f| f != NO_FACET).max().map_or(0, |&f| f as usize + 1);
    let mut behind: Vec<u32> = (0..facet_of.len() as u32).collect();
    behind.sort_by_key(|&a| facet_of[a as usize]);
    let start = (0..=n)
        .map(|f| behind.partition_point(|&a| (facet_of[a as usize] as usize) < f) as u32)
        .collect::<Vec<_>>();
    let bare = behind.split_off(start[n] as usize);
    (start, behind, bare)
}
