//! Updated-Lagrangian laws: the separation `d` is that of the present configuration, and the record holds the velocity.

use super::{add_outer, add_scaled, dot, gradient_weight};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Number of sums of [`VelocityGradient`].
pub const GRADIENT_SUMS: usize = 15;

/// Sums `[0..9]` of `V u^3 (v_i - v_j) (x) d`, row by row, and `[9..15]` of `V u^3 d (x) d` as xx xy xz yy yz zz.
pub struct VelocityGradient;

impl<R: Real> PairLaw<R, GRADIENT_SUMS> for VelocityGradient {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; GRADIENT_SUMS]) {
        let g = gradient_weight(p.u, p.volume);
        let gd = [g * p.d[0], g * p.d[1], g * p.d[2]];
        let dv = difference(own, p);
        add_outer(sums, 0, dv, gd);
        add_scaled(sums, 9, gd[0], p.d);
        sums[12] = gd[1].fma(p.d[1], sums[12]);
        sums[13] = gd[1].fma(p.d[2], sums[13]);
        sums[14] = gd[2].fma(p.d[2], sums[14]);
    }
}

/// Momentum of the updated-Lagrangian solid.
///
/// The record holds mass for volume; the second record `sigma / rho^2` as xx yy zz xy xz yz and the artificial stress. Sums of
/// `m u^3 [(tau_i + tau_j) d + (W / W(dp))^4 (R_i + R_j) d + D (W/W_0) (d.v) d / r^2]`.
pub struct Momentum {
    /// Kernel at one spacing, by its value at zero.
    pub at_spacing: f64,
    /// Factor `D` of the damping between pairs.
    pub damping: f64,
}

impl<R: Real> PairLaw<R, 3> for Momentum {
    type Constants<L: Lanes<Elem = R>> = [L; 2];
    const SECOND: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) -> [L; 2] {
        [L::constant(1.0 / self.at_spacing), L::constant(self.damping)]
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>([inverse, damping]: &[L; 2], own: &Own<L>, p: &Pair<L>, sums: &mut [L; 3]) {
        let (a, b) = (&own.second, &p.second);
        let t = [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]];
        let u2 = p.u * p.u;
        let kernel = u2 * u2 * p.u.fnma(L::constant(4.0), L::constant(5.0));
        let near = kernel * *inverse;
        let near2 = near * near;
        let closing = dot(p.d, difference(own, p)) * (p.r_inv * p.r_inv);
        let along = (near2 * near2).fma(a[6] + b[6], *damping * kernel * closing);
        let d = p.d;
        let f = [
            (t[0] + along).fma(d[0], t[3].fma(d[1], t[4] * d[2])),
            t[3].fma(d[0], (t[1] + along).fma(d[1], t[5] * d[2])),
            t[4].fma(d[0], t[5].fma(d[1], (t[2] + along) * d[2])),
        ];
        add_scaled(sums, 0, gradient_weight(p.u, p.volume), f);
    }
}

/// Difference of the velocities, own minus neighbour.
#[inline(always)]
fn difference<L: Lanes>(own: &Own<L>, p: &Pair<L>) -> [L; 3] {
    [own.velocity[0] - p.velocity[0], own.velocity[1] - p.velocity[1], own.velocity[2] - p.velocity[2]]
}
