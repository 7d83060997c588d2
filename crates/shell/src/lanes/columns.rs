//! Columns of a block of particles: what sections are made of, and what is found of them.

use crate::reference::Base;
use crate::section::{Layer, Motion};
use glam::DVec3;
use vaso_kernels::{BLOCK, BlockColumn};

/// Columns that never change: base vectors, gradient of the director, dual base, director, thickness and factors of a damping of one of
/// each particle, then [`LAYER`] of each layer.
pub(super) const G: usize = 0;
pub(super) const N: usize = 6;
pub(super) const DUAL: usize = 12;
pub(super) const DIRECTOR: usize = 21;
pub(super) const THICKNESS: usize = 24;
pub(super) const VISCOUS: usize = 25;
pub(super) const LAYERS: usize = 28;
/// Height, weight, and the inverse of the shifted base but for its last column, which is that of the director, row by row.
pub(super) const LAYER: usize = 8;

/// Columns that are read: gradients of displacement and director, director, derivative of the hourglass energy by the deformation
/// gradient, and the strain of the step before.
pub(super) const U: usize = 0;
pub(super) const DN: usize = 6;
pub(super) const PRESENT: usize = 12;
pub(super) const HOURGLASS: usize = 15;
pub(super) const BEFORE: usize = 24;
/// Number of them.
pub(crate) const OWN: usize = 32;

/// Columns that are written: derivatives by the gradients of position and director and by the director, the strain, and the power
/// of the damping by area.
pub(super) const T: usize = 0;
pub(super) const M: usize = 6;
pub(super) const Q: usize = 12;
pub(super) const STRAIN: usize = 15;
pub(super) const POWER: usize = 23;
/// Number of them.
pub(crate) const OUT: usize = 24;

/// Number of columns that never change, with `layers` points through the thickness.
pub(crate) fn fixed_columns(layers: usize) -> usize {
    LAYERS + layers * LAYER
}

#[inline(always)]
fn put(columns: &mut [BlockColumn], first: usize, k: usize, v: DVec3) {
    for (a, x) in v.to_array().into_iter().enumerate() {
        columns[first + a][k] = x;
    }
}

#[inline(always)]
fn get(columns: &[BlockColumn], first: usize, k: usize) -> DVec3 {
    DVec3::new(columns[first][k], columns[first + 1][k], columns[first + 2][k])
}

/// Writes what never changes of particle `k` of a block.
pub(crate) fn fix(
    columns: &mut [BlockColumn],
    k: usize,
    base: &Base,
    thickness: f64,
    viscous: [f64; 3],
    layers: &[Layer],
) {
    for a in 0..2 {
        put(columns, G + 3 * a, k, base.g[a]);
        put(columns, N + 3 * a, k, base.n[a]);
    }
    for a in 0..3 {
        put(columns, DUAL + 3 * a, k, base.dual[a]);
        columns[VISCOUS + a][k] = viscous[a];
    }
    put(columns, DIRECTOR, k, base.director);
    columns[THICKNESS][k] = thickness;
    for (layer, columns) in layers.iter().zip(columns[LAYERS..].chunks_mut(LAYER)) {
        for (column, x) in columns.iter_mut().zip(layer.numbers()) {
            column[k] = x;
        }
    }
}

/// Writes what is read of particle `k`: its motion, its director, and the sums of the hourglass control times their factor.
#[inline(always)]
pub(crate) fn show(
    columns: &mut [BlockColumn],
    k: usize,
    motion: &Motion,
    director: DVec3,
    hourglass: [f64; 9],
) {
    for a in 0..2 {
        put(columns, U + 3 * a, k, motion.u[a]);
        put(columns, DN + 3 * a, k, motion.n[a]);
    }
    put(columns, PRESENT, k, director);
    for (a, x) in hourglass.into_iter().enumerate() {
        columns[HOURGLASS + a][k] = x;
    }
}

/// The strain of the step before among what is read.
pub(crate) fn before(columns: &mut [BlockColumn]) -> &mut [BlockColumn] {
    &mut columns[BEFORE..OWN]
}

/// The strain among what was written.
pub(crate) fn strains(columns: &[BlockColumn]) -> &[BlockColumn] {
    &columns[STRAIN..POWER]
}

/// What was written of particle `k`: derivatives by the gradients of position and director, by the director, and the power of the damping by area
/// \[W/m^2\].
#[inline(always)]
pub(crate) fn found(columns: &[BlockColumn], k: usize) -> ([DVec3; 2], [DVec3; 2], DVec3, f64) {
    let pair = |first: usize| [get(columns, first, k), get(columns, first + 3, k)];
    (pair(T), pair(M), get(columns, Q, k), columns[POWER][k])
}

/// Columns of zeros.
pub(crate) fn blank<const K: usize>() -> [BlockColumn; K] {
    [[0.0; BLOCK]; K]
}
