//! Disjoint sets of numbers that are joined pair by pair.

/// The numbers from zero on, each first a set by itself.
pub(crate) struct Sets {
    parent: Vec<usize>,
}

impl Sets {
    pub(crate) fn new(n: usize) -> Self {
        Self { parent: (0..n).collect() }
    }

    /// Makes one set of those of `a` and `b`.
    pub(crate) fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.lowest(a), self.lowest(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// The lowest number of the set of `k`.
    pub(crate) fn lowest(&mut self, mut k: usize) -> usize {
        while self.parent[k] != k {
            self.parent[k] = self.parent[self.parent[k]];
            k = self.parent[k];
        }
        k
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_named_by_their_lowest() {
        let mut sets = Sets::new(7);
        for (a, b) in [(5, 6), (2, 5), (3, 4), (6, 3)] {
            sets.join(a, b);
        }
        let lowest: Vec<usize> = (0..7).map(|k| sets.lowest(k)).collect();
        assert_eq!(lowest, [0, 1, 2, 2, 2, 2, 2]);
    }
}
