//! Displacement gradient, and the damping between pairs that reads the same neighbours.

use super::{DISPLACEMENT_UNIT, add_outer, add_scaled, displacement, dot, gradient_weight};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Number of sums of [`DisplacementGradient`].
pub const SUMS: usize = 9;
/// Number of sums of [`DampedGradient`].
pub const DAMPED_SUMS: usize = 12;

/// Sums of `V u^3 (u_i - u_j) (x) d`, row by row, displacements in supports.
pub struct DisplacementGradient;

impl<R: Real> PairLaw<R, SUMS> for DisplacementGradient {
    type Constants<L: Lanes<Elem = R>> = L;

    fn constants<L: Lanes<Elem = R>>(&self) -> L {
        L::constant(DISPLACEMENT_UNIT)
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(unit: &L, own: &Own<L>, p: &Pair<L>, sums: &mut [L; SUMS]) {
        let g = gradient_weight(p.u, p.volume);
        let gd = [g * p.d[0], g * p.d[1], g * p.d[2]];
        add_outer(sums, 0, displacement(*unit, own, p), gd);
    }
}

/// The same, and in `[9..12]` sums of `V u^3 (W/W_0) (x.v) x / r^2` with the present separation `x` in supports; the second
/// record holds the velocity \[m/s\].
///
/// A pair is damped along its present separation, so that a turning body is not damped and no moment comes about.
pub struct DampedGradient;

impl<R: Real> PairLaw<R, DAMPED_SUMS> for DampedGradient {
    type Constants<L: Lanes<Elem = R>> = L;
    const SECOND: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) -> L {
        L::constant(DISPLACEMENT_UNIT)
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(unit: &L, own: &Own<L>, p: &Pair<L>, sums: &mut [L; DAMPED_SUMS]) {
        let g = gradient_weight(p.u, p.volume);
        let gd = [g * p.d[0], g * p.d[1], g * p.d[2]];
        let du = displacement(*unit, own, p);
        add_outer(sums, 0, du, gd);
        let x = [p.d[0] + du[0], p.d[1] + du[1], p.d[2] + du[2]];
        let dv = [own.second[0] - p.second[0], own.second[1] - p.second[1], own.second[2] - p.second[2]];
        let u2 = p.u * p.u;
        let kernel = u2 * u2 * p.u.fnma(L::constant(4.0), L::constant(5.0));
        add_scaled(sums, 9, g * kernel * (p.r_inv * p.r_inv) * dot(x, dv), x);
    }
}
