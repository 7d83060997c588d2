//! Kernel sums of the frozen configuration: number density, gradient and moment matrix.

use super::{add_scaled, gradient_weight};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Number of sums.
pub const SUMS: usize = 11;

/// Sums `[0]` of `w u^4 (5 - 4u)` with the record's scalar as weight `w` (mass over rest density),
/// `[1..4]` of `V u^3 d`, `[4..10]` of `V u^3 d (x) d` and `[10]` of `V u^3 r`.
pub struct Moments;

impl<R: Real> PairLaw<R, SUMS> for Moments {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _own: &Own<L>, p: &Pair<L>, sums: &mut [L; SUMS]) {
        let u2 = p.u * p.u;
        let value = u2 * u2 * p.u.fnma(L::constant(4.0), L::constant(5.0));
        let g = gradient_weight(p.u, p.volume);
        let gd = [g * p.d[0], g * p.d[1], g * p.d[2]];
        sums[0] = p.scalar.fma(value, sums[0]);
        add_scaled(sums, 1, g, p.d);
        sums[4] = gd[0].fma(p.d[0], sums[4]);
        sums[5] = gd[1].fma(p.d[1], sums[5]);
        sums[6] = gd[2].fma(p.d[2], sums[6]);
        sums[7] = gd[0].fma(p.d[1], sums[7]);
        sums[8] = gd[0].fma(p.d[2], sums[8]);
        sums[9] = gd[1].fma(p.d[2], sums[9]);
        sums[10] = g.fma(p.r, sums[10]);
    }
}
