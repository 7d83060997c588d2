//! Energy of the hourglass control, and the part of its force that goes through the deformation gradient.

use super::{DISPLACEMENT_UNIT, add_outer, displacement, dot, gradient_weight, matrices, mul};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Sums of `V u^3 G_j d (x) d`, row by row; the matrices are spread over second record and scalar.
pub struct NeighbourGradient;

impl<R: Real> PairLaw<R, 9> for NeighbourGradient {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND: bool = true;
    const SECOND_OWN: bool = false;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _: &Own<L>, p: &Pair<L>, sums: &mut [L; 9]) {
        let g = gradient_weight(p.u, p.volume);
        let s = &p.second;
        let gradient = mul(&[s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], p.scalar], p.d);
        add_outer(sums, 0, gradient, [g * p.d[0], g * p.d[1], g * p.d[2]]);
    }
}

/// Sum of `V u^3 |u_i - u_j - (G_i + G_j) d / 2|^2`, lengths in supports; matrices as above.
pub struct HourglassEnergy;

impl<R: Real> PairLaw<R, 1> for HourglassEnergy {
    type Constants<L: Lanes<Elem = R>> = [L; 2];
    const SECOND: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) -> [L; 2] {
        [L::constant(DISPLACEMENT_UNIT), L::constant(0.5)]
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>([unit, half]: &[L; 2], own: &Own<L>, p: &Pair<L>, sums: &mut [L; 1]) {
        let du = displacement(*unit, own, p);
        let mean = mul(&matrices(own, p), p.d);
        let rest = [half.fnma(mean[0], du[0]), half.fnma(mean[1], du[1]), half.fnma(mean[2], du[2])];
        sums[0] = gradient_weight(p.u, p.volume).fma(dot(rest, rest), sums[0]);
    }
}
