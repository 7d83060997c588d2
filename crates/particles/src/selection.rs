//! Particles chosen by a rule.

use rayon::prelude::*;

/// Finds the particles that a rule chooses, in parallel, and lists them in their order. Its memory is used again by the next search.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    marks: Vec<bool>,
    chosen: Vec<u32>,
}

impl Selection {
    /// Those of the first `n` particles that `is_chosen` says yes to, in rising order.
    pub fn find(&mut self, n: usize, is_chosen: impl Fn(usize) -> bool + Sync) -> &[u32] {
        self.marks.resize(n, false);
        self.marks.par_iter_mut().enumerate().with_min_len(4096).for_each(|(i, mark)| *mark = is_chosen(i));
        self.chosen.clear();
        self.chosen.extend((0..n as u32).filter(|&i| self.marks[i as usize]));
        &self.chosen
    }

    /// What [`Self::find`] has found last.
    pub fn chosen(&self) -> &[u32] {
        &self.chosen
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.marks.capacity() + 4 * self.chosen.capacity()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chosen_come_in_order_and_the_last_search_is_forgotten() {
        let mut selection = Selection::default();
        assert_eq!(selection.find(20_000, |i| i % 9_000 == 5), [5, 9_005, 18_005]);
        assert_eq!(selection.find(7, |i| i > 4), [5, 6]);
        assert_eq!(selection.chosen(), [5, 6]);
        assert!(selection.find(0, |_| true).is_empty());
    }
}
