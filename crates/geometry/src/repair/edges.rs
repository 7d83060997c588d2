//! Which triangles meet at which edge.

/// Marks a missing neighbour.
pub(crate) const NONE: u32 = u32::MAX;

/// One side of one triangle, seen from its undirected edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// Smaller vertex number of the edge.
    low: u32,
    /// Larger vertex number of the edge.
    high: u32,
    /// The triangle.
    pub(crate) triangle: u32,
    /// The corner the side starts from; it ends at the next one.
    pub(crate) corner: u8,
    /// Whether the triangle runs from the smaller number to the larger.
    pub(crate) ascending: bool,
}

impl Side {
    /// Start and end vertex in the sense of the triangle.
    pub(crate) fn directed(&self) -> [u32; 2] {
        if self.ascending { [self.low, self.high] } else { [self.high, self.low] }
    }
}

/// All sides of all triangles, sorted by edge.
pub(crate) struct Edges(Vec<Side>);

impl Edges {
    pub(crate) fn new(triangles: &[[u32; 3]]) -> Edges {
        let mut sides = Vec::with_capacity(3 * triangles.len());
        for (triangle, corners) in triangles.iter().enumerate() {
            for corner in 0..3 {
                let (a, b) = (corners[corner], corners[(corner + 1) % 3]);
                sides.push(Side {
                    low: a.min(b),
                    high: a.max(b),
                    triangle: triangle as u32,
                    corner: corner as u8,
                    ascending: a < b,
                });
            }
        }
        sides.sort_unstable();
        Edges(sides)
    }

    /// The sides at each edge: one at a border, two inside a sheet, more where sheets meet.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &[Side]> {
        self.0.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high))
    }

    /// For every triangle and corner, the triangle across the side from that corner to the next, or
    /// [`NONE`] where that edge has not exactly two sides.
    pub(crate) fn neighbours(&self, n_triangles: usize) -> Vec<[u32; 3]> {
        let mut across = vec![[NONE; 3]; n_triangles];
        for group in self.groups() {
            if let [a, b] = group {
                across[a.triangle as usize][a.corner as usize] = b.triangle;
                across[b.triangle as usize][b.corner as usize] = a.triangle;
            }
        }
        across
    }

    /// Directed sides of the triangles along the border of the surface.
    pub(crate) fn border(&self) -> Vec<[u32; 2]> {
        self.groups().filter(|g| g.len() == 1).map(|g| g[0].directed()).collect()
    }

    /// Number of edges at which more than two triangles meet.
    pub(crate) fn non_manifold(&self) -> usize {
        self.groups().filter(|g| g.len() > 2).count()
    }

    /// Whether every edge has exactly two sides that run against each other.
    pub(crate) fn is_closed_and_oriented(&self) -> bool {
        self.groups().all(|g| matches!(g, [a, b] if a.ascending != b.ascending))
    }
}

/// Numbers the connected parts: triangles that share an edge, however many meet there, have one number.
///
/// Returns the number of each triangle, in the order of first appearance, and how many there are.
pub(crate) fn components(edges: &Edges, n_triangles: usize) -> (Vec<u32>, usize) {
    let mut parent: Vec<u32> = (0..n_triangles as u32).collect();
    fn root(parent: &mut [u32], mut t: u32) -> u32 {
        while parent[t as usize] != t {
            parent[t as usize] = parent[parent[t as usize] as usize];
            t = parent[t as usize];
        }
        t
    }
    for group in edges.groups() {
        for pair in group.windows(2) {
            let (a, b) = (root(&mut parent, pair[0].triangle), root(&mut parent, pair[1].triangle));
            parent[a.max(b) as usize] = a.min(b);
        }
    }
    let mut number = vec![NONE; n_triangles];
    let mut count = 0;
    for t in 0..n_triangles {
        // Roots are the smallest member, so a root is numbered before its members.
        let r = root(&mut parent, t as u32) as usize;
        if r == t {
            number[t] = count;
            count += 1;
        } else {
            number[t] = number[r];
        }
    }
    (number, count as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn border_of_a_square_and_its_parts() {
        let square = [[0, 1, 2], [0, 2, 3]];
        let edges = Edges::new(&square);
        let mut border = edges.border();
        border.sort_unstable();
        assert_eq!(border, vec![[0, 1], [1, 2], [2, 3], [3, 0]]);
        assert_eq!(edges.neighbours(2), vec![[NONE, NONE, 1], [0, NONE, NONE]]);
        assert!(!edges.is_closed_and_oriented());

        let apart = [[0, 1, 2], [4, 5, 6], [0, 2, 3]];
        assert_eq!(components(&Edges::new(&apart), 3), (vec![0, 1, 0], 2));
    }

    #[test]
    fn three_sheets_at_one_edge_are_not_manifold() {
        let fan = [[0, 1, 2], [0, 1, 3], [1, 0, 4]];
        let edges = Edges::new(&fan);
        assert_eq!(edges.non_manifold(), 1);
        assert_eq!(components(&edges, 3).1, 1);
    }
}
