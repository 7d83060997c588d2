//! Continuity: velocity divergence between fluid particles.

use super::{dot, gradient_weight};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Sum of `V u^3 (v_i - v_j) . d`.
pub struct Divergence;

impl<R: Real> PairLaw<R, 1> for Divergence {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; 1]) {
        let dv = [
            own.velocity[0] - p.velocity[0],
            own.velocity[1] - p.velocity[1],
            own.velocity[2] - p.velocity[2],
        ];
        sums[0] = gradient_weight(p.u, p.volume).fma(dot(dv, p.d), sums[0]);
    }
}
