//! Moment matrix of the reference configuration.

use super::gradient_weight;
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Sums of `V u^3 d (x) d` as xx yy zz xy xz yz.
pub struct Moment;

impl<R: Real> PairLaw<R, 6> for Moment {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _: &Own<L>, p: &Pair<L>, sums: &mut [L; 6]) {
        let g = gradient_weight(p.u, p.volume);
        let gd = [g * p.d[0], g * p.d[1], g * p.d[2]];
        sums[0] = gd[0].fma(p.d[0], sums[0]);
        sums[1] = gd[1].fma(p.d[1], sums[1]);
        sums[2] = gd[2].fma(p.d[2], sums[2]);
        sums[3] = gd[0].fma(p.d[1], sums[3]);
        sums[4] = gd[0].fma(p.d[2], sums[4]);
        sums[5] = gd[1].fma(p.d[2], sums[5]);
    }
}
