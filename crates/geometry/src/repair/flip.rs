//! The diagonal of two neighbouring triangles exchanged for the other one.

use super::edges::NONE;

/// Exchanges the side of triangle `t` from corner `k` to the next for the other diagonal of the quadrilateral it
/// forms with the triangle across.
///
/// Both triangles must run the same way round. `across` are the neighbours before any exchange; the triangles
/// whose neighbours are no longer those are marked in `touched` and left alone until `across` is made anew.
/// False when nothing was done: at a border, at a touched triangle, or where the other diagonal is an edge
/// already and would get four sides.
pub(crate) fn flip(
    triangles: &mut [[u32; 3]],
    t: usize,
    k: usize,
    across: &[[u32; 3]],
    touched: &mut [bool],
) -> bool {
    let other = across[t][k];
    if other == NONE || touched[t] || touched[other as usize] {
        return false;
    }
    let [a, b, apex] = [0, 1, 2].map(|i| triangles[t][(k + i) % 3]);
    let Some(&far) = triangles[other as usize].iter().find(|&&v| v != a && v != b) else {
        return false;
    };
    if far == apex || triangles.iter().any(|t| t.contains(&apex) && t.contains(&far)) {
        return false;
    }
    for changed in [t, other as usize] {
        touched[changed] = true;
        for near in across[changed].into_iter().filter(|&n| n != NONE) {
            touched[near as usize] = true;
        }
    }
    triangles[t] = [a, far, apex];
    triangles[other as usize] = [far, b, apex];
    true
}
