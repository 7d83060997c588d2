//! Packed particle records, what the pair loops gather.

use crate::lanes::{FIELDS, Real};
use rayon::prelude::*;

/// One record of eight fields a particle, and a null record behind the last.
///
/// The usual fields are `x y z volume | u v w scalar`; 32 bytes in mixed precision, half a cache
/// line. Padding of neighbour rows points at the null record, whose zero volume adds nothing.
#[derive(Clone, Debug)]
pub struct Records<R> {
    data: Vec<[R; FIELDS]>,
}

impl<R: Real> Default for Records<R> {
    fn default() -> Self {
        Self { data: vec![[R::default(); FIELDS]] }
    }
}

impl<R: Real> Records<R> {
    /// Makes room for `n` particles; contents are unspecified but for the null record.
    pub fn resize(&mut self, n: usize) {
        self.data.resize(n + 1, [R::default(); FIELDS]);
        self.data[n] = [R::default(); FIELDS];
    }

    /// Number of particles, the null record not counted.
    pub fn len(&self) -> usize {
        self.data.len() - 1
    }

    /// Whether there are no particles.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Writes the record of every particle in parallel.
    pub fn fill(&mut self, record: impl Fn(usize) -> [R; FIELDS] + Sync) {
        let n = self.len();
        self.data[..n].par_iter_mut().enumerate().with_min_len(1024).for_each(|(i, r)| *r = record(i));
    }

    /// The records, without the null record.
    pub fn as_mut_slice(&mut self) -> &mut [[R; FIELDS]] {
        let n = self.len();
        &mut self.data[..n]
    }

    /// The records, without the null record.
    pub fn as_slice(&self) -> &[[R; FIELDS]] {
        &self.data[..self.len()]
    }

    pub(crate) fn base(&self) -> *const R {
        self.data.as_ptr().cast()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.data.capacity() * size_of::<[R; FIELDS]>()
    }
}
