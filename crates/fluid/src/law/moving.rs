//! What a wall that moves adds: its motion as the fluid near it sees it, its pressure, and the forces it gets.

use super::{add_scaled, dot, gradient_weight, sym_mul};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// `V u^4 (5 - 4u)`: the kernel times the volume of the neighbour, without its constant factor.
#[inline(always)]
fn kernel_weight<L: Lanes>(u: L, volume: L) -> L {
    let u2 = u * u;
    u2 * u2 * u.fnma(L::constant(4.0), L::constant(5.0)) * volume
}

/// Number of sums of [`WallVelocity`].
pub const VELOCITY_SUMS: usize = 5;

/// Fluid among the wall, whose normal is the own second record: sums `[0]` of `V u^3 (v_a . n) (d . n)`, what the motion of the wall adds
/// to the divergence, `[1]` of `V W` and
/// `[2..5]` of `V W v_a`, of which the wall near a particle has its velocity.
pub struct WallVelocity;

impl<R: Real> PairLaw<R, VELOCITY_SUMS> for WallVelocity {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND_OWN: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; VELOCITY_SUMS]) {
        let weight = kernel_weight(p.u, p.volume);
        let normal = [own.second[0], own.second[1], own.second[2]];
        sums[0] = (gradient_weight(p.u, p.volume) * dot(p.velocity, normal)).fma(dot(p.d, normal), sums[0]);
        sums[1] = sums[1] + weight;
        add_scaled(sums, 2, weight, p.velocity);
    }
}

/// Number of sums of [`SurfaceDisplacement`].
pub const DISPLACEMENT_SUMS: usize = 9;

/// Fluid among the wall, whose records hold displacements for velocities and the depth `s` in supports for the scalar: normal
/// equations of `u ~ u_0 + u_1 s`, so that `u_0` is the displacement of the lumen surface and not of the particles behind it.
///
/// With `w = V W` the sums are `w`, `w s`, `w s^2`, and of `u` times `w` in `[3..6]` and times `w s` in `[6..9]`.
pub struct SurfaceDisplacement;

impl<R: Real> PairLaw<R, DISPLACEMENT_SUMS> for SurfaceDisplacement {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _own: &Own<L>, p: &Pair<L>, sums: &mut [L; DISPLACEMENT_SUMS]) {
        let weight = kernel_weight(p.u, p.volume);
        let first = weight * p.scalar;
        sums[0] = sums[0] + weight;
        sums[1] = sums[1] + first;
        sums[2] = first.fma(p.scalar, sums[2]);
        add_scaled(sums, 3, weight, p.velocity);
        add_scaled(sums, 6, first, p.velocity);
    }
}

/// Determinant of the normal equations over the product of their diagonal, below which the displacement is not continued: that
/// of depths spread by about a tenth of their mean.
const LEAST_SPREAD: f64 = 0.01;

/// The displacement `u_0` of the surface by the sums of [`SurfaceDisplacement`]: the mean one where all particles are about equally
/// deep, zero where there are none.
pub fn surface_displacement(sums: &[f64; DISPLACEMENT_SUMS]) -> [f64; 3] {
    let [s0, s1, s2, ..] = *sums;
    let determinant = s0 * s2 - s1 * s1;
    std::array::from_fn(|k| {
        if determinant > LEAST_SPREAD * s0 * s2 {
            (s2 * sums[3 + k] - s1 * sums[6 + k]) / determinant
        } else if s0 > 0.0 {
            sums[3 + k] / s0
        } else {
            0.0
        }
    })
}

/// Number of sums of [`WallContact`].
pub const CONTACT_SUMS: usize = 14;

/// Wall among the fluid: its pressure, as [`WallPressure`](super::wall_pressure::WallPressure) with the moment that an acceleration needs,
/// and what [`WallPressureForce`](super::pressure::WallPressureForce) and the own pressure of the particles do to them, with the other sign.
/// The scalar of the wall is a pressure `p_0` near that of the fluid, which keeps differences exact; that of the fluid is its pressure and the
/// first of its vector that of the dissipation `q`; the second record is the correction matrix of the fluid.
///
/// With `w = V_i u^3 B_i d` the sums are `[0]` of `V W (p_i - p_0)`, `[1]` of `V W`, `[2..5]` of `V W d`, `[5..8]` of `w`, `[8..11]` of
/// `(p_i - p_0) w` and `[11..14]` of `q_i w`.
pub struct WallContact;

impl<R: Real> PairLaw<R, CONTACT_SUMS> for WallContact {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND: bool = true;
    const SECOND_OWN: bool = false;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; CONTACT_SUMS]) {
        let pressure = p.scalar - own.scalar;
        let weight = kernel_weight(p.u, p.volume);
        sums[0] = weight.fma(pressure, sums[0]);
        sums[1] = sums[1] + weight;
        add_scaled(sums, 2, weight, p.d);
        let weight = gradient_weight(p.u, p.volume);
        let along = sym_mul(&p.second, p.d);
        add_scaled(sums, 5, weight, along);
        add_scaled(sums, 8, weight * pressure, along);
        add_scaled(sums, 11, weight * p.velocity[0], along);
    }
}

/// Wall among the fluid: the part of [`WallViscosity`](super::viscosity::WallViscosity) along the straight line, with the other
/// sign. The scalar of the wall is its depth, that of the fluid its inverse distance; volumes of the fluid are times its
/// viscosity, and the second record is its correction matrix.
pub struct DragOnWall;

impl<R: Real> PairLaw<R, 3> for DragOnWall {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND: bool = true;
    const SECOND_OWN: bool = false;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; 3]) {
        let ratio = (own.scalar * p.scalar).min(L::constant(super::viscosity::MAX_EXTRAPOLATION));
        let dv = [
            p.velocity[0] - own.velocity[0],
            p.velocity[1] - own.velocity[1],
            p.velocity[2] - own.velocity[2],
        ];
        add_scaled(sums, 0, drag_weight(p) * (L::constant(1.0) + ratio), dv);
    }
}

/// The same of the parabola: the records of the fluid hold its `b` for the velocity and its distance for the scalar.
pub struct BendOnWall;

impl<R: Real> PairLaw<R, 3> for BendOnWall {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND: bool = true;
    const SECOND_OWN: bool = false;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; 3]) {
        add_scaled(sums, 0, drag_weight(p) * own.scalar * (p.scalar + own.scalar), p.velocity);
    }
}

/// What the viscous force takes off for a velocity that changes linearly: the records of the fluid hold the gradient of one
/// component of the velocity for the velocity. The first sum is of `f grad v . d`, with the `f` of the others; two more stay zero.
pub struct LeanOnWall;

impl<R: Real> PairLaw<R, 3> for LeanOnWall {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND: bool = true;
    const SECOND_OWN: bool = false;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _own: &Own<L>, p: &Pair<L>, sums: &mut [L; 3]) {
        sums[0] = drag_weight(p).fma(dot(p.velocity, p.d), sums[0]);
    }
}

/// `2 V u^3 e.B e`, the weight of the viscous force.
#[inline(always)]
fn drag_weight<L: Lanes>(p: &Pair<L>) -> L {
    let along = L::constant(2.0) * dot(sym_mul(&p.second, p.d), p.d) * (p.r_inv * p.r_inv);
    gradient_weight(p.u, p.volume) * along
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surface_moves_as_the_line_through_the_wall_says() {
        let mut sums = [0.0; DISPLACEMENT_SUMS];
        for (w, s) in [(1.0, 0.2), (0.7, 0.5), (0.1, 0.9)] {
            sums[0] += w;
            sums[1] += w * s;
            sums[2] += w * s * s;
            for k in 0..3 {
                let u = 0.3 * k as f64 - 0.1 * s;
                sums[3 + k] += w * u;
                sums[6 + k] += w * s * u;
            }
        }
        for (k, u) in surface_displacement(&sums).into_iter().enumerate() {
            assert!((u - 0.3 * k as f64).abs() < 1e-12, "{u}");
        }
    }

    #[test]
    fn one_layer_moves_as_it_does() {
        let sums = [2.0, 0.4, 0.08, 1.0, 0.0, -1.0, 0.2, 0.0, -0.2];
        assert_eq!(surface_displacement(&sums), [0.5, 0.0, -0.5]);
        assert_eq!(surface_displacement(&[0.0; DISPLACEMENT_SUMS]), [0.0; 3]);
    }
}
