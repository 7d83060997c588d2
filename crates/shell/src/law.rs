//! Formulas of one link and one pair: branch-free functions over lanes.
//!
//! Weights of links are computed once (`reference.rs`). Displacements are coded like coordinates, in supports, and changes of
//! the director in units, so that their differences are exact in mixed precision wherever the shell went.

use vaso_kernels::{FIELDS, Lanes, LinkLaw, Own, Pair, PairLaw, Real, Stored};

/// Unit of the fixed-point displacement, in supports: neighbours may move apart by 8 supports.
pub const DISPLACEMENT_UNIT: f64 = 1.0 / (1_u32 << 28) as f64;

/// Unit of the fixed-point change of a director, which is 2 at most.
pub const DIRECTOR_UNIT: f64 = 1.0 / (1_u32 << 29) as f64;

/// Sums `[0..6]` of `u_ij (x) w` and `[6..12]` of `n_ij (x) w`, row by row, with the differences own minus neighbour of what the
/// records hold: displacement, then change of the director. `w` are the weights of the gradient in the tangent plane \[1/m\].
pub struct Gradient;

impl<R: Real> LinkLaw<R, 2, 12> for Gradient {
    type Constants<L: Lanes<Elem = R>> = [L; 2];

    fn constants<L: Lanes<Elem = R>>(&self) -> [L; 2] {
        [L::constant(DISPLACEMENT_UNIT), L::constant(DIRECTOR_UNIT)]
    }

    #[inline(always)]
    fn link<L: Lanes<Elem = R>>(
        units: &[L; 2],
        own: &[L; FIELDS],
        other: &[L; FIELDS],
        _: &[L; FIELDS],
        w: &[L; 2],
        sums: &mut [L; 12],
    ) {
        for k in 0..6 {
            let difference = own[k].delta(other[k], units[k / 3]);
            sums[2 * k] = difference.fma(w[0], sums[2 * k]);
            sums[2 * k + 1] = difference.fma(w[1], sums[2 * k + 1]);
        }
    }
}

/// The first half of [`Gradient`]: what the last three fields of the records hold has no part in it.
pub struct Slope;

impl<R: Real> LinkLaw<R, 2, 6> for Slope {
    type Constants<L: Lanes<Elem = R>> = L;

    fn constants<L: Lanes<Elem = R>>(&self) -> L {
        L::constant(DISPLACEMENT_UNIT)
    }

    #[inline(always)]
    fn link<L: Lanes<Elem = R>>(
        unit: &L,
        own: &[L; FIELDS],
        other: &[L; FIELDS],
        _: &[L; FIELDS],
        w: &[L; 2],
        sums: &mut [L; 6],
    ) {
        for k in 0..3 {
            let difference = own[k].delta(other[k], *unit);
            sums[2 * k] = difference.fma(w[0], sums[2 * k]);
            sums[2 * k + 1] = difference.fma(w[1], sums[2 * k + 1]);
        }
    }
}

/// Sums `[0..3]` of `T_j w` and `[3..6]` of `M_j w` with the weights that particle `j` gives this one in its gradient; the first
/// record holds the two columns of `T` \[N/m\], the second those of `M` \[N\].
pub struct Divergence;

impl<R: Real> LinkLaw<R, 2, 6> for Divergence {
    type Constants<L: Lanes<Elem = R>> = ();
    const SECOND: bool = true;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn link<L: Lanes<Elem = R>>(
        (): &(),
        _: &[L; FIELDS],
        other: &[L; FIELDS],
        second: &[L; FIELDS],
        w: &[L; 2],
        sums: &mut [L; 6],
    ) {
        for k in 0..3 {
            sums[k] = other[k].fma(w[0], other[3 + k].fma(w[1], sums[k]));
            sums[3 + k] = second[k].fma(w[0], second[3 + k].fma(w[1], sums[3 + k]));
        }
    }
}

/// The first half of [`Divergence`].
pub struct Tension;

impl<R: Real> LinkLaw<R, 2, 3> for Tension {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn link<L: Lanes<Elem = R>>(
        (): &(),
        _: &[L; FIELDS],
        other: &[L; FIELDS],
        _: &[L; FIELDS],
        w: &[L; 2],
        sums: &mut [L; 3],
    ) {
        for k in 0..3 {
            sums[k] = other[k].fma(w[0], other[3 + k].fma(w[1], sums[k]));
        }
    }
}

/// What neighbours do beside the mean displacement gradient of both: sums `[0..3]` of `c e` and `[3..12]` of `c e (x) d`, row by
/// row, `e = u_ij - (G_i + G_j) d / 2`, lengths in supports; the gradients are spread over second record and scalar.
pub struct Hourglass;

impl<R: Real> PairLaw<R, 12> for Hourglass {
    type Constants<L: Lanes<Elem = R>> = [L; 2];
    const SECOND: bool = true;
    const STORED: Stored = Stored::Read;

    fn constants<L: Lanes<Elem = R>>(&self) -> [L; 2] {
        [L::constant(DISPLACEMENT_UNIT), L::constant(0.5)]
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(c: &[L; 2], own: &Own<L>, p: &Pair<L>, sums: &mut [L; 12]) {
        let e = jump(c, own, p);
        for k in 0..3 {
            let force = p.stored * e[k];
            sums[k] = sums[k] + force;
            sums[3 + 3 * k] = force.fma(p.d[0], sums[3 + 3 * k]);
            sums[4 + 3 * k] = force.fma(p.d[1], sums[4 + 3 * k]);
            sums[5 + 3 * k] = force.fma(p.d[2], sums[5 + 3 * k]);
        }
    }
}

/// Sum of `c |e|^2` of the same.
pub struct HourglassEnergy;

impl<R: Real> PairLaw<R, 1> for HourglassEnergy {
    type Constants<L: Lanes<Elem = R>> = [L; 2];
    const SECOND: bool = true;
    const STORED: Stored = Stored::Read;

    fn constants<L: Lanes<Elem = R>>(&self) -> [L; 2] {
        [L::constant(DISPLACEMENT_UNIT), L::constant(0.5)]
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(c: &[L; 2], own: &Own<L>, p: &Pair<L>, sums: &mut [L; 1]) {
        let e = jump(c, own, p);
        sums[0] = p.stored.fma(e[0].fma(e[0], e[1].fma(e[1], e[2] * e[2])), sums[0]);
    }
}

/// `u_ij - (G_i + G_j) d / 2` in supports.
#[inline(always)]
fn jump<L: Lanes>([unit, half]: &[L; 2], own: &Own<L>, p: &Pair<L>) -> [L; 3] {
    let (a, b, d) = (&own.second, &p.second, &p.d);
    let x = (a[0] + b[0]).fma(d[0], (a[1] + b[1]).fma(d[1], (a[2] + b[2]) * d[2]));
    let y = (a[3] + b[3]).fma(d[0], (a[4] + b[4]).fma(d[1], (a[5] + b[5]) * d[2]));
    let z = (a[6] + b[6]).fma(d[0], (a[7] + b[7]).fma(d[1], (own.scalar + p.scalar) * d[2]));
    [
        half.fnma(x, own.velocity[0].delta(p.velocity[0], *unit)),
        half.fnma(y, own.velocity[1].delta(p.velocity[1], *unit)),
        half.fnma(z, own.velocity[2].delta(p.velocity[2], *unit)),
    ]
}
