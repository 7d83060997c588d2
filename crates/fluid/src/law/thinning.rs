//! Viscous force between particles of different viscosity.

use super::{add_scaled, dot, gradient_weight, sym_mul};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Number of sums.
pub const SUMS: usize = 3;

/// Fluid pairs; the record's scalar is the fluidity 1/eta, the second record the correction matrix B.
///
/// Sums `V u^3 eta_ij e.(B_i + B_j)e (v_i - v_j)` with the harmonic mean eta_ij of the viscosities (Morris, Fox,
/// Zhu 1997, with the corrected gradient).
pub struct ThinningViscosity;

impl<R: Real> PairLaw<R, SUMS> for ThinningViscosity {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; SUMS]) {
        let b = dot(sym_mul(&own.second, p.d), p.d) + dot(sym_mul(&p.second, p.d), p.d);
        // The null record that pads a row has no fluidity, the own one keeps the root finite.
        let root = (own.scalar + p.scalar).rsqrt();
        let eta = L::constant(2.0) * root * root;
        let factor = gradient_weight(p.u, p.volume) * eta * b * (p.r_inv * p.r_inv);
        let dv = [
            own.velocity[0] - p.velocity[0],
            own.velocity[1] - p.velocity[1],
            own.velocity[2] - p.velocity[2],
        ];
        add_scaled(sums, 0, factor, dv);
    }
}
