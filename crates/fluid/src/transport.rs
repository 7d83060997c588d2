//! End of an advective step: the transport-velocity shift and the guard at the wall.

use crate::cap::CapZone;
use crate::fluid::{Fluid, numbered};
use crate::frozen::widen;
use crate::law::separation::Separation;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, sweep};

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

/// Spacings over the distance from the wall within which particles are looked at.
const NEAR: f64 = 2.0;

/// Distance \[spacings\] below which particles near caps are parted. A relaxed set has none nearer than 0.75, a flow hardly any
/// below.
const CROWDED: f64 = 0.7;
/// Share of what a pair lacks of that distance by which it parts in an advective step.
const PARTING: f64 = 0.5;

impl<R: Real> Fluid<R> {
    /// Shifts particles against their kernel-gradient residual (Adami, Hu, Adams 2013; Lind et al.
    /// 2012), which keeps them evenly spread. Each takes on the velocity of its new place, by its gradient (Lind et al. 2012):
    /// carried along, velocities would mix across the flow as if it were more viscous.
    ///
    /// Near caps only the part along the cap is taken: the missing support beyond it would push particles out. Where blood goes in
    /// and out slowly nothing else parts particles that have come close along the normal, so pairs that are too close are moved
    /// apart there ([`Separation`]). Both move by the same, so no volume is carried along.
    ///
    /// Of a step that ended early it takes only a part, see [`Self::note_part`].
    pub fn transport(&mut self, zones: &[CapZone]) {
        let (numbers, part) = (self.numbers, self.part);
        let h2 = numbers.smoothing_length * numbers.smoothing_length;
        let limit = part * numbers.shift_limit * numbers.spacing;
        let support = self.kernel.support();
        let law = Separation { distance: CROWDED * numbers.spacing / support };
        let (isa, zone_of, next) = (self.isa, &self.zone_of, &self.next);
        let slope = &self.slope;
        let gather =
            Gather { frame: &self.frame, own: next, other: next, own_second: None, other_second: None };
        (
            self.state.position.par_chunks_mut(CHUNK),
            self.state.velocity.par_chunks_mut(CHUNK),
            self.columns.support.par_chunks(CHUNK),
            self.rows.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (position, velocity, support_sums, row))| {
                let mut crowd = [[0.0; 3]; CHUNK];
                if (0..position.len()).any(|k| zone_of[c * CHUNK + k] != 0) {
                    sweep(isa, &law, &gather, numbered(row, c), Store::None, &mut crowd);
                }
                for (k, x) in position.iter_mut().enumerate() {
                    let mut residual = 0.5 * widen(support_sums[k]);
                    let mut parting = DVec3::ZERO;
                    if let Some(zone) = zone_of[c * CHUNK + k].checked_sub(1) {
                        let normal = zones[zone as usize].normal;
                        residual -= residual.dot(normal) * normal;
                        let volume = next.as_slice()[c * CHUNK + k][3].widen();
                        parting = 0.5 * part * PARTING * support / volume * DVec3::from_array(crowd[k]);
                    }
                    let chi = (400.0 * h2 * residual.length_squared()).min(1.0);
                    let shift = -2.0 * part * numbers.shift_strength * h2 * chi * residual;
                    let way = shift.clamp_length_max(limit);
                    *x += way + parting;
                    if zone_of[c * CHUNK + k] == 0 {
                        velocity[k] += slope[c * CHUNK + k].transpose() * way;
                    }
                }
            });
    }

    /// Notes which part of a full advective step this one was: shift and blend of the density keep their pace in time where a step
    /// ends early.
    pub fn note_part(&mut self, part: f64) {
        self.part = part;
    }

    /// Puts particles that touch the wall back into the lumen and stops their motion towards it.
    pub fn guard(&mut self) -> Guarded {
        let spacing = self.numbers.spacing;
        let mut found = std::mem::take(&mut self.near_wall);
        let distance = |this: &Self, i: usize| {
            let moved = this.moving.as_ref().map_or(DVec3::ZERO, |m| m.displacement[i]);
            this.distance(this.state.position[i] - moved)
        };
        let this = &*self;
        found.find(this.state.len(), |i| {
            // An advective step takes no particle much further than a quarter of a smoothing length. What has come from farther inside
            // all the same stands beyond the wall when the next step measures its distance, and is found at the end of that.
            this.columns.inverse_distance[i].widen() * spacing > NEAR
                && distance(this, i).0 > -PENETRATION * spacing
        });
        let mut guarded = Guarded::default();
        // From the end, so that those lost can be removed in this order.
        for i in found.chosen().iter().rev().map(|&i| i as usize) {
            let (phi, gradient) = distance(self, i);
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
        self.near_wall = found;
        guarded
    }
}
