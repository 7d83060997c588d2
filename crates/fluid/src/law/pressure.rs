//! Momentum: pressure of the low-dissipation Riemann state (Zhang, Hu, Adams 2017).

use super::{add_scaled, dot, gradient_weight};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real, Stored};

/// Number of sums between fluid particles.
pub const FLUID_SUMS: usize = 7;
/// Number of sums with wall particles.
pub const WALL_SUMS: usize = 3;

/// Fluid pairs; the record's scalar is the pressure, the stored number the offset of
/// [`super::offset::Offset`].
///
/// Sums `[0..3]` of `V u^3 p_j d`, `[3..6]` of `V u^3 q d` with the dissipative pressure
/// `q = min(eta a / c, 1) rho0 c a` of the approach velocity `a`, and `[6]` of
/// `V u^3 r (p_i - p_j)`, the density diffusion.
///
/// `BESIDE_CAP` is for chunks with particles near caps, whose mark stands at [`CAP_MARK`] in the second record: a pair of two of them has the
/// limiter [`AT_CAPS`]. Where there are none the result is the same, and the second records need not be read.
pub struct FluidPressure<const BESIDE_CAP: bool> {
    /// Limiter `eta` of the dissipation away from caps.
    pub limiter: f64,
    /// Sound speed \[m/s\].
    pub sound_speed: f64,
    /// Rest density \[kg/m^3\].
    pub rest_density: f64,
}

/// Limiter with which nearly all of the acoustic jump is dissipated, at walls, which sound comes back from.
pub const FULL: f64 = 100.0;

/// The same at caps, where sound may be a thousand times as fast as the blood: with 100, a layer at an oblique cap is driven to four times the
/// mean velocity.
pub const AT_CAPS: f64 = 300.0;

/// Where the second record of a particle has 1 near a cap, and 0 elsewhere.
pub const CAP_MARK: usize = 3;

/// Constants of [`FluidPressure`] in lanes.
#[derive(Clone, Copy)]
pub struct Dissipation<L> {
    limiter_over_speed: L,
    more_at_caps: L,
    impedance: L,
}

impl<R: Real, const BESIDE_CAP: bool> PairLaw<R, FLUID_SUMS> for FluidPressure<BESIDE_CAP> {
    type Constants<L: Lanes<Elem = R>> = Dissipation<L>;
    const STORED: Stored = Stored::Read;
    const SECOND: bool = BESIDE_CAP;

    fn constants<L: Lanes<Elem = R>>(&self) -> Dissipation<L> {
        Dissipation {
            limiter_over_speed: L::constant(self.limiter / self.sound_speed),
            more_at_caps: L::constant((AT_CAPS - self.limiter) / self.sound_speed),
            impedance: L::constant(self.rest_density * self.sound_speed),
        }
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(c: &Dissipation<L>, own: &Own<L>, p: &Pair<L>, sums: &mut [L; FLUID_SUMS]) {
        let g = gradient_weight(p.u, p.volume);
        let dv = [
            own.velocity[0] - p.velocity[0],
            own.velocity[1] - p.velocity[1],
            own.velocity[2] - p.velocity[2],
        ];
        let limiter = if BESIDE_CAP {
            (own.second[CAP_MARK] * p.second[CAP_MARK]).fma(c.more_at_caps, c.limiter_over_speed)
        } else {
            c.limiter_over_speed
        };
        let approach = dot(dv, p.d).fnma(p.r_inv, p.stored).max(L::zero());
        let beta = (approach * limiter).min(L::constant(1.0));
        let dissipative = beta * approach * c.impedance;
        add_scaled(sums, 0, g * p.scalar, p.d);
        add_scaled(sums, 3, g * dissipative, p.d);
        sums[6] = (g * p.r).fma(own.scalar - p.scalar, sums[6]);
    }
}

/// Pairs with wall particles that carry a pressure of their own; sums of `V u^3 p_a d`.
pub struct WallPressureForce;

impl<R: Real> PairLaw<R, WALL_SUMS> for WallPressureForce {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _own: &Own<L>, p: &Pair<L>, sums: &mut [L; WALL_SUMS]) {
        add_scaled(sums, 0, gradient_weight(p.u, p.volume) * p.scalar, p.d);
    }
}
