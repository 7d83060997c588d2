//! Continuity: velocity divergence between fluid particles.

use super::{dot, gradient_weight};
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Sum of `V u^3 (v_i - v_j) . d`.
pub struct Divergence;

impl<R: Real> PairLaw<R, 1> for Divergence {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; 1]) {
        let dv = [
            own.velocity[0] - p.velocity[0],
            own.velocity[1] - p.velocity[1],
            own.velocity[2] - p.velocity[2],
        ];
        sums[0] = gradient_weight(p.u, p.volume).fma(dot(dv, p.d), sums[0]);
    }
}

/// Number of sums of [`DivergenceBesideWall`] and [`CapDivergence`].
pub const PARTS: usize = 2;

/// [`Divergence`] beside a wall, whose normal is the own second record: sums `[0]` of `V u^3 (v_i - v_j) . d`, and `[1]` of the part
/// of that along the normal.
pub struct DivergenceBesideWall;

impl<R: Real> PairLaw<R, PARTS> for DivergenceBesideWall {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND_OWN: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), own: &Own<L>, p: &Pair<L>, sums: &mut [L; PARTS]) {
        add_parts(sums, gradient_weight(p.u, p.volume), own, p);
    }
}

/// Adds `w` times the jump of the velocity along the separation, and the part of both along the normal in the second record.
#[inline(always)]
fn add_parts<L: Lanes>(sums: &mut [L; PARTS], w: L, own: &Own<L>, p: &Pair<L>) {
    let dv =
        [own.velocity[0] - p.velocity[0], own.velocity[1] - p.velocity[1], own.velocity[2] - p.velocity[2]];
    let normal = [own.second[0], own.second[1], own.second[2]];
    sums[0] = w.fma(dot(dv, p.d), sums[0]);
    sums[1] = (w * dot(dv, normal)).fma(dot(p.d, normal), sums[1]);
}

/// Slope of the change to all neighbours at a depth of one support: in effect a step.
const STEEP: f64 = 1e3;

/// [`DivergenceBesideWall`] near caps; the scalar of both records is the depth behind the cap, in supports.
///
/// A particle nearer to the cap than a support looks only as far into the vessel as to the cap: in what is left, both sides
/// along the normal weigh the same, so that a velocity that does not change along it has no divergence. With all
/// neighbours, a flow that varies across the cap would.
pub struct CapDivergence {
    /// Supports over the length within which a neighbour fades out.
    pub sharpness: f64,
}

impl<R: Real> PairLaw<R, PARTS> for CapDivergence {
    type Constants<L: Lanes<Elem = R>> = L;
    const SECOND_OWN: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) -> L {
        L::constant(self.sharpness)
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(sharpness: &L, own: &Own<L>, p: &Pair<L>, sums: &mut [L; PARTS]) {
        let one = L::constant(1.0);
        let is_within = sharpness.fma(own.scalar + own.scalar - p.scalar, L::constant(0.5)).min(one);
        let is_deep = (own.scalar - one) * L::constant(STEEP);
        let share = is_within.max(is_deep.min(one)).max(L::zero());
        add_parts(sums, gradient_weight(p.u, p.volume) * share, own, p);
    }
}
