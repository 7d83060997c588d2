//! Neighbour rows: for every particle the padded list of those within one support.

use crate::frame::Frame;
use crate::grid::CellGrid;
use crate::isa::{Isa, LaneWork, dispatch};
use crate::lanes::{FIELDS, Lanes, Real, SearchLanes};
use glam::DVec3;
use rayon::prelude::*;

/// Particles a chunk: the unit of parallel work, fixed so that results cannot depend on threads.
pub const CHUNK: usize = 256;

/// Rows are padded to a multiple of this, the widest vector.
pub const PAD: usize = 16;

/// Fixed-point coordinates of sorted particles, one array an axis, for the search.
#[derive(Clone, Debug, Default)]
pub struct SearchSet {
    axis: [Vec<i32>; 3],
    n: usize,
}

impl SearchSet {
    /// Encodes `position` \[m\], which must be in the order of the grid that will be searched.
    pub fn fill(&mut self, frame: &Frame, position: &[DVec3]) {
        self.n = position.len();
        // Vectors are loaded whole, also at the end of a run.
        for axis in &mut self.axis {
            axis.resize(self.n + PAD, 0);
        }
        let [x, y, z] = &mut self.axis;
        (&mut x[..self.n], &mut y[..self.n], &mut z[..self.n], position)
            .into_par_iter()
            .with_min_len(4096)
            .for_each(|(x, y, z, p)| [*x, *y, *z] = frame.fixed(*p));
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.n
    }

    /// Whether there are no particles.
    pub fn is_empty(&self) -> bool {
        self.n == 0
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        4 * self.axis.iter().map(Vec::capacity).sum::<usize>()
    }

    /// Fixed-point coordinates of particle `i`.
    pub fn get(&self, i: usize) -> [i32; 3] {
        [self.axis[0][i], self.axis[1][i], self.axis[2][i]]
    }
}

/// Rows of [`CHUNK`] consecutive particles.
#[derive(Clone, Debug, Default)]
pub struct RowChunk {
    /// First entry of each row, one more than there are rows.
    pub(crate) start: Vec<u32>,
    /// Neighbours as element offsets into packed records (8 j); padding points at the null record.
    pub(crate) at: Vec<u32>,
    /// Offset of the null record, which no entry exceeds.
    pub(crate) null: u32,
    /// Neighbours without padding.
    n_pairs: usize,
}

impl RowChunk {
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.start.len() - 1
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether row `k` has no neighbour.
    pub fn is_row_empty(&self, k: usize) -> bool {
        self.start[k] == self.start[k + 1]
    }

    /// Whether no row has a neighbour.
    pub fn has_no_pairs(&self) -> bool {
        self.n_pairs == 0
    }

    /// Entries, padding included.
    pub fn n_entries(&self) -> usize {
        self.at.len()
    }
}

/// Neighbour rows of one body among the particles of another or of itself.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    chunks: Vec<RowChunk>,
    n_own: usize,
    n_other: usize,
}

impl Rows {
    /// Finds, for each particle of `own`, all of `other` closer than one support of `frame`.
    ///
    /// `position` \[m\] are those of `own`; `grid` has sorted `other`, with cells no smaller than the
    /// support. `itself` says that both bodies are the same, and leaves each particle out of its own
    /// row. Memory is reused from build to build.
    pub fn build(
        &mut self,
        isa: Isa,
        frame: &Frame,
        own: (&SearchSet, &[DVec3]),
        other: &SearchSet,
        grid: &CellGrid,
        itself: bool,
    ) {
        debug_assert!(grid.cell() >= frame.support() * (1.0 - 1e-12), "cells smaller than the support");
        let (set, position) = own;
        assert!(set.len() == position.len() && other.n < u32::MAX as usize / FIELDS);
        (self.n_own, self.n_other) = (set.len(), other.len());
        self.chunks.resize(self.n_own.div_ceil(CHUNK), RowChunk::default());
        let unit = frame.unit() as f32;
        self.chunks.par_iter_mut().enumerate().for_each(|(c, chunk)| {
            let first = c * CHUNK;
            let last = (first + CHUNK).min(set.len());
            dispatch::<f32, _>(isa, Search { chunk, first, last, set, position, other, grid, itself, unit });
        });
    }

    /// The chunks, in particle order.
    pub fn chunks(&self) -> &[RowChunk] {
        &self.chunks
    }

    /// Number of particles that have a row.
    pub fn n_own(&self) -> usize {
        self.n_own
    }

    /// Number of particles the rows may point at.
    pub fn n_other(&self) -> usize {
        self.n_other
    }

    /// Neighbour pairs, each direction counted.
    pub fn n_pairs(&self) -> usize {
        self.chunks.iter().map(|c| c.n_pairs).sum()
    }

    /// Neighbours of particle `i`, in the order of the search.
    pub fn row(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        let chunk = &self.chunks[i / CHUNK];
        let k = i % CHUNK;
        let null = FIELDS * self.n_other;
        chunk.at[chunk.start[k] as usize..chunk.start[k + 1] as usize]
            .iter()
            .map(|&at| at as usize)
            .filter(move |&at| at != null)
            .map(|at| at / FIELDS)
    }

    /// Lets entry `j` of all rows point at `to[j]` instead, out of `n_other` particles.
    ///
    /// Rows are found among particles in cell order; this way images of a periodic body can be kept behind the others.
    ///
    /// # Panics
    /// If `to` has another length than the particles searched, or points beyond `n_other`.
    pub fn redirect(&mut self, to: &[u32], n_other: usize) {
        assert!(to.len() == self.n_other && n_other < u32::MAX as usize / FIELDS, "an entry a particle");
        assert!(to.iter().all(|&j| (j as usize) < n_other), "entries beyond the particles");
        let (old_null, new_null) = (FIELDS * self.n_other, FIELDS * n_other);
        self.n_other = n_other;
        self.chunks.par_iter_mut().for_each(|chunk| {
            chunk.null = new_null as u32;
            for at in &mut chunk.at {
                let old = *at as usize;
                *at = if old == old_null { new_null as u32 } else { FIELDS as u32 * to[old / FIELDS] };
            }
        });
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.chunks.iter().map(|c| 4 * (c.start.capacity() + c.at.capacity())).sum()
    }
}

/// Room for `more` entries. Lists that double when they are full would hold a third of nothing, and lists of neighbours are most of all memory;
/// an eighth more is room for what a flow changes.
pub(crate) fn make_room<T>(list: &mut Vec<T>, more: usize) {
    if list.capacity() - list.len() < more {
        list.reserve_exact(more.max(list.len() / 8));
    }
}

struct Search<'a> {
    chunk: &'a mut RowChunk,
    first: usize,
    last: usize,
    set: &'a SearchSet,
    position: &'a [DVec3],
    other: &'a SearchSet,
    grid: &'a CellGrid,
    itself: bool,
    unit: f32,
}

impl<R: Real> LaneWork<R> for Search<'_> {
    #[inline(always)]
    fn run<L: Lanes<Elem = R>, S: SearchLanes>(self) {
        let RowChunk { start, at, null: largest, n_pairs } = self.chunk;
        let [x, y, z] = &self.other.axis;
        let null = (FIELDS * self.other.n) as u32;
        start.clear();
        at.clear();
        *n_pairs = 0;
        *largest = null;
        // Neighbours in the order share a slice, and with it the runs to search.
        let mut slice = [usize::MAX; 3];
        let mut runs = self.grid.runs_around([0; 3]);
        let mut candidates = 0;
        for i in self.first..self.last {
            start.push(at.len() as u32);
            let own = self.set.get(i);
            let here = self.grid.coordinates(self.position[i]);
            if here != slice {
                slice = here;
                runs = self.grid.runs_around(here);
                candidates = runs.as_slice().iter().map(|&(begin, end)| end - begin).sum();
            }
            // Room for all candidates, and for one store of a full vector behind them.
            make_room(at, candidates + 2 * PAD);
            let (out, mut len) = (at.as_mut_ptr(), at.len());
            for &(begin, end) in runs.as_slice() {
                debug_assert!(end <= self.other.n);
                let mut j = begin;
                while j < end {
                    let tail = (end - j).min(S::N);
                    // SAFETY: the axes hold `PAD >= S::N` entries behind the last particle.
                    let mut mask = unsafe {
                        S::within(own, x.as_ptr().add(j), y.as_ptr().add(j), z.as_ptr().add(j), self.unit)
                    };
                    if tail < S::N {
                        mask &= (1 << tail) - 1;
                    }
                    if self.itself && i.wrapping_sub(j) < S::N {
                        mask &= !(1 << (i - j));
                    }
                    // SAFETY: the reserve above leaves room for what is found and 16 entries more.
                    len += unsafe { S::compress(mask, j as u32, out.add(len)) };
                    j += S::N;
                }
            }
            // SAFETY: so many entries have been written, within the reserve.
            unsafe { at.set_len(len) };
            let row = at.len() - start[i - self.first] as usize;
            *n_pairs += row;
            at.resize(at.len() + row.next_multiple_of(PAD) - row, null);
        }
        start.push(at.len() as u32);
    }
}
