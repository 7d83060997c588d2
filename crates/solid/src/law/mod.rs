//! Formulas of one pair: branch-free functions over lanes for [`vaso_kernels::sweep`].
//!
//! All but those of `updated` use the separation `d` in the reference configuration, in supports H = 2h, so that `grad W = -s u^3 d` with
//! `s` = [`vaso_kernels::Wendland::gradient_scale`]; constant factors are applied once a particle, after the sums. The
//! record holds the displacement in its fields u v w, coded like a coordinate: differences are exact wherever the body went.

pub mod force;
pub mod hourglass;
pub mod moment;
pub mod strain;
pub mod updated;

use vaso_kernels::{Lanes, Own, Pair};

/// Unit of the fixed-point displacement, in supports: neighbours may move apart by 8 supports.
pub const DISPLACEMENT_UNIT: f64 = 1.0 / (1_u32 << 28) as f64;

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

/// `M d` of a matrix given row by row.
#[inline(always)]
fn mul<L: Lanes>(m: &[L; 9], d: [L; 3]) -> [L; 3] {
    [dot([m[0], m[1], m[2]], d), dot([m[3], m[4], m[5]], d), dot([m[6], m[7], m[8]], d)]
}

/// Difference of the displacements, own minus neighbour, in supports.
#[inline(always)]
fn displacement<L: Lanes>(unit: L, own: &Own<L>, p: &Pair<L>) -> [L; 3] {
    [
        own.velocity[0].delta(p.velocity[0], unit),
        own.velocity[1].delta(p.velocity[1], unit),
        own.velocity[2].delta(p.velocity[2], unit),
    ]
}

/// Sum of the matrices of both particles: eight entries in the second record, the last in the scalar of the first.
#[inline(always)]
fn matrices<L: Lanes>(own: &Own<L>, p: &Pair<L>) -> [L; 9] {
    let (a, b) = (&own.second, &p.second);
    [
        a[0] + b[0],
        a[1] + b[1],
        a[2] + b[2],
        a[3] + b[3],
        a[4] + b[4],
        a[5] + b[5],
        a[6] + b[6],
        a[7] + b[7],
        own.scalar + p.scalar,
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
