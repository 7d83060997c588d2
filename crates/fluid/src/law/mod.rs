//! Pair laws: what two neighbours do to each other, as pure functions over lanes.
//!
//! All use the separation `d` in supports H = 2h, so that `grad W = -s u^3 d` with
//! `s` = [`vaso_kernels::Wendland::gradient_scale`] and `W = s' u^4 (5 - 4u)`; the constant factors
//! are applied once a particle, after the sums.

pub mod density;
pub mod moments;
pub mod moving;
pub mod near_wall;
pub mod offset;
pub mod pressure;
pub mod separation;
pub mod thinning;
pub mod viscosity;
pub mod wall_pressure;

use vaso_kernels::Lanes;

/// `u^3 V`: the common factor of every kernel gradient.
#[inline(always)]
fn gradient_weight<L: Lanes>(u: L, volume: L) -> L {
    u * u * u * volume
}

/// `a . b`.
#[inline(always)]
fn dot<L: Lanes>(a: [L; 3], b: [L; 3]) -> L {
    a[0].fma(b[0], a[1].fma(b[1], a[2] * b[2]))
}

/// `S d` of a symmetric matrix given as xx yy zz xy xz yz.
#[inline(always)]
fn sym_mul<L: Lanes>(s: &[L; 8], d: [L; 3]) -> [L; 3] {
    [
        s[0].fma(d[0], s[3].fma(d[1], s[4] * d[2])),
        s[3].fma(d[0], s[1].fma(d[1], s[5] * d[2])),
        s[4].fma(d[0], s[5].fma(d[1], s[2] * d[2])),
    ]
}

/// `sums[at..at + 3] += w v`.
#[inline(always)]
fn add_scaled<L: Lanes, const K: usize>(sums: &mut [L; K], at: usize, w: L, v: [L; 3]) {
    sums[at] = w.fma(v[0], sums[at]);
    sums[at + 1] = w.fma(v[1], sums[at + 1]);
    sums[at + 2] = w.fma(v[2], sums[at + 2]);
}

/// `sums[at..at + 9] += a (x) b`, row by row.
#[inline(always)]
fn add_outer<L: Lanes, const K: usize>(sums: &mut [L; K], at: usize, a: [L; 3], b: [L; 3]) {
    add_scaled(sums, at, a[0], b);
    add_scaled(sums, at + 3, a[1], b);
    add_scaled(sums, at + 6, a[2], b);
}
