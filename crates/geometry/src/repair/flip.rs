//! The diagonal of two neighbouring triangles exchanged for the other one.

use std::collections::BTreeSet;

use super::edges::{Edges, NONE};

/// A round of exchanges, in which no triangle takes part twice.
pub(crate) struct Flips {
    /// The neighbours before any exchange.
    across: Vec<[u32; 3]>,
    /// Triangles whose neighbours are no longer those.
    touched: Vec<bool>,
    /// All edges there are now, the smaller number first.
    edges: BTreeSet<[u32; 2]>,
}

impl Flips {
    /// A round on these triangles. Those that meet at an edge must run the same way round.
    pub(crate) fn new(triangles: &[[u32; 3]]) -> Flips {
        let all = Edges::new(triangles);
        Flips {
            across: all.neighbours(triangles.len()),
            touched: vec![false; triangles.len()],
            edges: all.groups().map(|group| edge(group[0].directed())).collect(),
        }
    }

    /// The triangle across the side from corner `k` of triangle `t` to the next; `None` at a border and where either
    /// has taken part in an exchange, or has a neighbour that has.
    pub(crate) fn across(&self, t: usize, k: usize) -> Option<usize> {
        let other = self.across[t][k];
        let free = other != NONE && !self.touched[t] && !self.touched[other as usize];
        free.then_some(other as usize)
    }

    /// Exchanges the side of triangle `t` from corner `k` to the next for the other diagonal of the quadrilateral it
    /// forms with the triangle across.
    ///
    /// False when nothing was done: where there is no triangle across, or the other diagonal is an edge already and
    /// would get four sides.
    pub(crate) fn flip(&mut self, triangles: &mut [[u32; 3]], t: usize, k: usize) -> bool {
        let Some(other) = self.across(t, k) else { return false };
        let [a, b, apex] = [0, 1, 2].map(|i| triangles[t][(k + i) % 3]);
        let Some(&far) = triangles[other].iter().find(|&&v| v != a && v != b) else { return false };
        if far == apex || self.edges.contains(&edge([apex, far])) {
            return false;
        }
        for changed in [t, other] {
            self.touched[changed] = true;
            for near in self.across[changed].into_iter().filter(|&n| n != NONE) {
                self.touched[near as usize] = true;
            }
        }
        self.edges.remove(&edge([a, b]));
        self.edges.insert(edge([apex, far]));
        triangles[t] = [a, far, apex];
        triangles[other] = [far, b, apex];
        true
    }
}

fn edge([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagonal_is_exchanged_once() {
        let mut square = vec![[0, 1, 2], [0, 2, 3]];
        let mut flips = Flips::new(&square);
        assert!(flips.flip(&mut square, 0, 2));
        assert_eq!(square, vec![[2, 3, 1], [3, 0, 1]]);
        assert!(!flips.flip(&mut square, 0, 1), "both have taken part");
        assert!(Flips::new(&square).flip(&mut square, 0, 1));
    }

    #[test]
    fn an_edge_that_is_there_is_not_made_again() {
        // Three sides of a tetrahedron: the other diagonal of any two of them is the edge of the third.
        let mut cone = vec![[0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let before = cone.clone();
        assert!(!Flips::new(&before).flip(&mut cone, 0, 1));
        assert_eq!(cone, before);
    }
}
