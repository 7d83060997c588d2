//! Energy of the hourglass control.

use super::{DISPLACEMENT_UNIT, displacement, dot, gradient_weight, mul};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Sum of `V u^3 |u_i - u_j - G_i d|^2`, lengths in supports; the matrices are spread over second record and scalar.
pub struct HourglassEnergy;

impl<R: Real> PairLaw<R, 1> for HourglassEnergy {
    type Constants<L: Lanes<Elem = R>> = L;
    const SECOND_OWN: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) -> L {
        L::constant(DISPLACEMENT_UNIT)
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(unit: &L, own: &Own<L>, p: &Pair<L>, sums: &mut [L; 1]) {
        let du = displacement(*unit, own, p);
        let s = &own.second;
        let linear = mul(&[s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], own.scalar], p.d);
        let rest = [du[0] - linear[0], du[1] - linear[1], du[2] - linear[2]];
        sums[0] = gradient_weight(p.u, p.volume).fma(dot(rest, rest), sums[0]);
    }
}
