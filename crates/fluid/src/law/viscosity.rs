//! Viscous force, velocity gradient and corrected gradient sum, which read the same neighbours.

use super::{add_outer, add_scaled, dot, gradient_weight, sym_mul};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Number of sums between fluid particles.
pub const FLUID_SUMS: usize = 18;
/// Number of sums with wall particles.
pub const WALL_SUMS: usize = 17;

/// Fluid pairs; the second record is the correction matrix B.
///
/// Sums `[0..3]` of `V u^3 B_j d`, `[3..6]` of `f (v_i - v_j)` with `f = V u^3 e.(B_i + B_j)e` (Morris, Fox, Zhu
/// 1997, with the corrected gradient), `[6..15]` of `V u^3 (v_i - v_j) (x) d`, and `[15..18]` of `f d`: what a velocity that
/// changes linearly adds where neighbours stand unevenly.
pub struct FluidViscosity;

impl<R: Real> PairLaw<R, FLUID_SUMS> for FluidViscosity {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; FLUID_SUMS]) {
        let g = gradient_weight(p.u, p.volume);
        let b_j = sym_mul(&p.second, p.d);
        let b_i = sym_mul(&own.second, p.d);
        let factor = (dot(b_i, p.d) + dot(b_j, p.d)) * (p.r_inv * p.r_inv);
        let dv = [
            own.velocity[0] - p.velocity[0],
            own.velocity[1] - p.velocity[1],
            own.velocity[2] - p.velocity[2],
        ];
        let gd = [g * p.d[0], g * p.d[1], g * p.d[2]];
        add_scaled(sums, 0, g, b_j);
        let weighted = g * factor;
        add_scaled(sums, 3, weighted, dv);
        add_outer(sums, 6, dv, gd);
        add_scaled(sums, 15, weighted, p.d);
    }
}

/// Pairs with wall particles, whose velocity continues the parabola `v_w + a s + b s^2` through the fluid particle beyond
/// the wall: `v_a = v_w - min(d_a / d_i, 5) (v_i - v_w) + b d_a (d_a + d_i)`. Without `b` it is that of Morris, Fox, Zhu 1997.
///
/// The record's scalar is the depth `d_a` of the wall particle and the inverse distance `1 / d_i`
/// of the fluid particle; the own second record is the correction matrix. Sums with `f = V u^3 2 e.B_i e`: `[0..3]` of
/// `f (v_i - v_a)` without the part of `b`, `[3..12]` of `V u^3 (v_i - v_a) (x) d`, also without, `[12]` of `f d_a` and `[13]` of
/// `f d_a^2`, which that part needs, and `[14..17]` of `f d`.
pub struct WallViscosity;

/// Largest ratio of wall depth to fluid distance in the extrapolation: beyond, the explicit
/// viscous step would have to shrink.
pub(super) const MAX_EXTRAPOLATION: f64 = 5.0;

impl<R: Real> PairLaw<R, WALL_SUMS> for WallViscosity {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND_OWN: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; WALL_SUMS]) {
        let g = gradient_weight(p.u, p.volume);
        let two = L::constant(2.0);
        let ratio = (p.scalar * own.scalar).min(L::constant(MAX_EXTRAPOLATION));
        let factor = two * dot(sym_mul(&own.second, p.d), p.d) * (p.r_inv * p.r_inv);
        let dv = [
            own.velocity[0] - p.velocity[0],
            own.velocity[1] - p.velocity[1],
            own.velocity[2] - p.velocity[2],
        ];
        let weighted = g * factor;
        let depth = weighted * p.scalar;
        let g = g * (L::constant(1.0) + ratio);
        let gd = [g * p.d[0], g * p.d[1], g * p.d[2]];
        add_scaled(sums, 0, weighted * (L::constant(1.0) + ratio), dv);
        add_outer(sums, 3, dv, gd);
        sums[12] = sums[12] + depth;
        sums[13] = depth.fma(p.scalar, sums[13]);
        add_scaled(sums, 14, weighted, p.d);
    }
}
