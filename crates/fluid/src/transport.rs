//! End of an advective step: the transport-velocity shift and the guard at the wall.

use crate::cap::CapZone;
use crate::fluid::Fluid;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Real};

/// What the guard had to do in a step.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Guarded {
    /// Particles found at or behind the wall and put back.
    pub returned: usize,
    /// Particles more than two spacings outside, in falling order, to be removed and reported.
    pub lost: Vec<usize>,
}

/// Distance from the wall \[spacings\] at which a particle counts as penetrating.
const PENETRATION: f64 = 0.05;
/// Distance from the wall \[spacings\] it is put back to.
const PUT_BACK: f64 = 0.25;
/// Distance outside \[spacings\] from which a particle is lost.
const LOST: f64 = 2.0;

impl<R: Real> Fluid<R> {
    /// Shifts particles against their kernel-gradient residual (Adami, Hu, Adams 2013; Lind et al.
    /// 2012), which keeps them evenly spread; velocities stay. Near caps only the part along the cap
    /// is taken: the missing support beyond it would push particles out.
    pub fn transport(&mut self, zones: &[CapZone]) {
        let numbers = &self.numbers;
        let h2 = numbers.smoothing_length * numbers.smoothing_length;
        let limit = numbers.shift_limit * numbers.spacing;
        let (frozen, zone_of) = (&self.frozen, &self.zone_of);
        self.state.position.par_iter_mut().enumerate().with_min_len(1024).for_each(|(i, x)| {
            let mut residual = 0.5 * frozen[i].support;
            if zone_of[i] != 0 {
                let normal = zones[zone_of[i] as usize - 1].normal;
                residual -= residual.dot(normal) * normal;
            }
            let chi = (400.0 * h2 * residual.length_squared()).min(1.0);
            let shift = -2.0 * numbers.shift_strength * h2 * chi * residual;
            *x += shift.clamp_length_max(limit);
        });
    }

    /// Puts particles that touch the wall back into the lumen and stops their motion towards it.
    pub fn guard(&mut self) -> Guarded {
        let spacing = self.numbers.spacing;
        let mut found: Vec<(usize, f64, DVec3)> = (0..self.state.len())
            .into_par_iter()
            .with_min_len(CHUNK)
            .filter(|&i| self.frozen[i].inverse_distance > 0.0)
            .filter_map(|i| {
                let moved = self.moving.as_ref().map_or(DVec3::ZERO, |m| m.displacement[i]);
                let (phi, gradient) = self.distance(self.state.position[i] - moved);
                (phi > -PENETRATION * spacing).then_some((i, phi, gradient))
            })
            .collect();
        found.sort_by_key(|f| std::cmp::Reverse(f.0));
        let mut guarded = Guarded::default();
        for (i, phi, gradient) in found {
            if phi > LOST * spacing {
                guarded.lost.push(i);
                continue;
            }
            self.state.position[i] -= (phi + PUT_BACK * spacing) * gradient;
            let wall = self.moving.as_ref().map_or(DVec3::ZERO, |m| m.velocity[i]);
            let outward = (self.state.velocity[i] - wall).dot(gradient).max(0.0);
            self.state.velocity[i] -= outward * gradient;
            guarded.returned += 1;
        }
        guarded
    }
}
