//! Force by stress and hourglass control.

use super::{DISPLACEMENT_UNIT, add_scaled, displacement, gradient_weight, matrices, mul};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Sums of `V u^3 [(Q_i + Q_j) d + k (u_i - u_j)]`, displacements in supports; the matrices `Q` \[Pa\] are spread over second
/// record and scalar.
///
/// With `Q = P B - k G / 2` the bracket is the stress and, times `k`, what `u_i - u_j` is beside the mean gradient. It changes
/// its sign when the particles change places, bit by bit.
pub struct Force {
    /// Hourglass modulus `k` \[Pa\].
    pub hourglass: f64,
}

impl<R: Real> PairLaw<R, 3> for Force {
    type Constants<L: Lanes<Elem = R>> = [L; 2];
    const SECOND: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) -> [L; 2] {
        [L::constant(DISPLACEMENT_UNIT), L::constant(self.hourglass)]
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>([unit, k]: &[L; 2], own: &Own<L>, p: &Pair<L>, sums: &mut [L; 3]) {
        let du = displacement(*unit, own, p);
        let q = mul(&matrices(own, p), p.d);
        let f = [k.fma(du[0], q[0]), k.fma(du[1], q[1]), k.fma(du[2], q[2])];
        add_scaled(sums, 0, gradient_weight(p.u, p.volume), f);
    }
}
