//! Pressure of a wall particle from the fluid around it (Adami, Hu, Adams 2012).

use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Rows of wall particles among the fluid: sums `[0]` of `V W p_f` and `[1]` of `V W`, both without
/// the kernel's constant factor.
pub struct WallPressure;

impl<R: Real> PairLaw<R, 2> for WallPressure {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _own: &Own<L>, p: &Pair<L>, sums: &mut [L; 2]) {
        let u2 = p.u * p.u;
        let weight = u2 * u2 * p.u.fnma(L::constant(4.0), L::constant(5.0)) * p.volume;
        sums[0] = weight.fma(p.scalar, sums[0]);
        sums[1] = sums[1] + weight;
    }
}
