//! A wall whose motion is given, whatever the fluid does.

use crate::wall::{CouplingError, Facet, MovingWall, NO_FACET};
use glam::DVec3;
use rayon::prelude::*;
use vaso_particles::{Memory, WallLoad, WallView};

/// Wall that follows a motion: position \[m\] and velocity \[m/s\] of the point that is at `x` in the beginning, at time `t` \[s\].
pub struct Prescribed<F> {
    origin: Vec<DVec3>,
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    depth: Vec<f64>,
    volume: Vec<f64>,
    motion: F,
    time: f64,
    /// Strain across the wall per strain of its area that the motion has: 1 unless set, where it keeps the volume of the wall.
    pub thinning: f64,
    /// Work that the fluid has done on the wall so far \[J\].
    pub work: f64,
    force: Vec<DVec3>,
}

impl<F: Fn(DVec3, f64) -> (DVec3, DVec3) + Sync> Prescribed<F> {
    /// Wall at `position` \[m\] of particles with the depths \[m\] and volumes \[m^3\] given.
    ///
    /// # Panics
    /// If the lists differ in length.
    pub fn new(position: Vec<DVec3>, depth: Vec<f64>, volume: Vec<f64>, motion: F) -> Self {
        assert!(depth.len() == position.len() && volume.len() == position.len(), "an entry a particle");
        let n = position.len();
        let mut wall = Self {
            origin: position.clone(),
            position,
            velocity: vec![DVec3::ZERO; n],
            depth,
            volume,
            motion,
            time: 0.0,
            thinning: 1.0,
            work: 0.0,
            force: vec![DVec3::ZERO; n],
        };
        wall.follow();
        wall
    }

    fn follow(&mut self) {
        let (motion, t) = (&self.motion, self.time);
        (&mut self.position, &mut self.velocity, &self.origin)
            .into_par_iter()
            .with_min_len(1024)
            .for_each(|(x, v, origin)| (*x, *v) = motion(*origin, t));
    }
}

impl<F: Fn(DVec3, f64) -> (DVec3, DVec3) + Sync> MovingWall for Prescribed<F> {
    /// A motion that is given has to keep the volume of the wall.
    fn thinning(&self) -> f64 {
        self.thinning
    }

    fn view(&self) -> WallView<'_> {
        WallView {
            position: &self.position,
            velocity: &self.velocity,
            depth: &self.depth,
            volume: &self.volume,
        }
    }

    /// None: it goes where it is told whatever the pressure.
    fn facet_of(&self) -> Vec<u32> {
        vec![NO_FACET; self.origin.len()]
    }

    fn facet(&self, _: usize) -> Facet {
        Facet::default()
    }

    fn load(&mut self, load: &WallLoad) -> Result<(), CouplingError> {
        let both = load.pressure_force.iter().zip(load.viscous_force);
        self.force.clear();
        self.force.extend(both.map(|(p, v)| *p + *v));
        Ok(())
    }

    fn advance(&mut self, dt: f64) -> Result<usize, CouplingError> {
        self.time += dt;
        let before = self.position.clone();
        self.follow();
        let moved = self.position.iter().zip(&before).map(|(x, old)| *x - *old);
        self.work += self.force.iter().zip(moved).map(|(force, u)| force.dot(u)).sum::<f64>();
        Ok(1)
    }

    fn remember(&mut self, memory: &mut dyn Memory) {
        let Self {
            origin: _,
            position: _,
            velocity: _,
            depth: _,
            volume: _,
            motion: _,
            time,
            work,
            force: _,
            thinning: _,
        } = self;
        memory.fields("wall.time_s", &mut [time]);
        memory.fields("wall.work_j", &mut [work]);
    }

    fn resume(&mut self) -> Result<(), CouplingError> {
        self.follow();
        Ok(())
    }
}
