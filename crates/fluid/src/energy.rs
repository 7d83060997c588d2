//! Energy of the blood, and what friction takes from it.

use crate::fluid::{Fluid, first_of};
use rayon::prelude::*;
use std::ops::Add;
use vaso_kernels::{CHUNK, Real, sum_in_order};

/// Energy of a part of the blood at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy \[J\].
    pub kinetic: f64,
    /// Power that the viscous forces of the current advective step take from the motion \[W\].
    pub friction: f64,
}

impl Add for Energy {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { kinetic: self.kinetic + other.kinetic, friction: self.friction + other.friction }
    }
}

impl<R: Real> Fluid<R> {
    /// Energy of the particles that `counts` says yes to; needs [`Self::viscosity`] before it, in the same order of particles.
    ///
    /// Friction is the work of the forces that act, `- sum m v . a`: with a wall at rest no part of it is estimated.
    pub fn energy(&self, counts: impl Fn(usize) -> bool + Sync) -> Energy {
        let state = &self.state;
        let n = state.len();
        let of_chunk = |c: usize| {
            let particles = (first_of(c)..n.min(first_of(c + 1))).filter(|&i| counts(i));
            particles.fold(Energy::default(), |sum, i| {
                let (m, v) = (state.mass[i], state.velocity[i]);
                let kinetic = 0.5 * m * v.length_squared();
                sum + Energy { kinetic, friction: -m * v.dot(self.columns.acceleration(i)) }
            })
        };
        sum_in_order((0..n.div_ceil(CHUNK)).into_par_iter().map(of_chunk))
    }
}
