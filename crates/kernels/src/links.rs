//! The gather loop over links: pairs whose weights were computed once and are kept.
//!
//! Where neighbours never change, what a law needs of the geometry of a pair can be stored, in any form. The loop then
//! streams the stored numbers beside the rows and gathers nothing but the quantities themselves.

use crate::frame::Frame;
use crate::isa::{Isa, LaneWork, dispatch};
use crate::lanes::{FIELDS, Lanes, Real, SearchLanes, add_lanes};
use crate::pairs::{Gather, Own, Pair, PairLaw, PairStore, Store, Stored, sweep};
use crate::records::Records;
use crate::rows::{CHUNK, RowChunk, Rows};
use glam::DVec3;

/// Contribution of a link with `S` stored numbers to `K` sums of its first particle.
pub trait LinkLaw<R: Real, const S: usize, const K: usize>: Sync {
    /// Constants of the law in all lanes.
    type Constants<L: Lanes<Elem = R>>: Copy;
    /// Whether a second record of the neighbour is gathered.
    const SECOND: bool = false;

    /// Splats the constants; called once a chunk.
    fn constants<L: Lanes<Elem = R>>(&self) -> Self::Constants<L>;

    /// Adds the link to the sums: `own` and `other` are records, `second` that of the neighbour where the law asks for one,
    /// `stored` the numbers of the link. Must be `#[inline(always)]`.
    fn link<L: Lanes<Elem = R>>(
        c: &Self::Constants<L>,
        own: &[L; FIELDS],
        other: &[L; FIELDS],
        second: &[L; FIELDS],
        stored: &[L; S],
        sums: &mut [L; K],
    );
}

/// `S` numbers a link, laid out like the rows; padding holds zeros.
#[derive(Clone, Debug, Default)]
pub struct LinkStore<R, const S: usize> {
    /// One number after the other, each for all entries of the chunk.
    chunks: Vec<Vec<R>>,
}

impl<R: Real, const S: usize> LinkStore<R, S> {
    /// Stores what `numbers` tells of each link, by chunk, row and neighbour.
    ///
    /// Particles are told as the index of the own one and the index among those the rows point at.
    pub fn new(isa: Isa, rows: &Rows, numbers: impl Fn(usize, usize) -> [f64; S]) -> Self {
        let chunks = rows.chunks().iter().zip(lane_order::<R>(isa, rows)).enumerate();
        let chunks = chunks.map(|(c, (row, entries))| {
            let n = row.n_entries();
            let mut chunk = vec![R::default(); S * n];
            for k in 0..row.len() {
                for m in row.start[k] as usize..row.start[k + 1] as usize {
                    if let Some(j) = entries[m] {
                        for (s, x) in numbers(c * CHUNK + k, j).into_iter().enumerate() {
                            chunk[s * n + m] = R::pack(x);
                        }
                    }
                }
            }
            chunk
        });
        Self { chunks: chunks.collect() }
    }

    /// Stores of the chunks.
    pub fn chunks(&self) -> &[Vec<R>] {
        &self.chunks
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.chunks.iter().map(|c| c.capacity() * size_of::<R>()).sum()
    }
}

/// Writes the number that the scalar of the neighbour holds.
struct Number;

impl<R: Real> PairLaw<R, 1> for Number {
    type Constants<L: Lanes<Elem = R>> = ();
    const STORED: Stored = Stored::Write;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _: &Own<L>, _: &Pair<L>, _: &mut [L; 1]) {}

    #[inline(always)]
    fn store<L: Lanes<Elem = R>>((): &(), _: &Own<L>, pair: &Pair<L>) -> L {
        pair.scalar
    }
}

/// Neighbour behind each entry as the lanes see it, which need not be the order of the rows; none for padding.
///
/// It is found by the lanes themselves: the order depends on the instruction set and the precision.
fn lane_order<R: Real>(isa: Isa, rows: &Rows) -> Vec<Vec<Option<usize>>> {
    let n = rows.n_other();
    assert!(n < 1 << 24, "numbers of particles are exact in single precision up to 2^24, not {n}");
    let frame = Frame::new((DVec3::ZERO, DVec3::ONE), 1.0);
    let mut records = Records::<R>::default();
    records.resize(n);
    records.fill(|i| {
        let mut record = [R::coordinate(0, 0.0); FIELDS];
        record[7] = R::pack((i + 1) as f64);
        record
    });
    let mut store = PairStore::default();
    store.resize_for(rows.chunks());
    let gather =
        Gather { frame: &frame, own: &records, other: &records, own_second: None, other_second: None };
    for (c, (row, store)) in rows.chunks().iter().zip(store.chunks_mut()).enumerate() {
        sweep(isa, &Number, &gather, (row, c * CHUNK), Store::Write(store), &mut [[0.0]; CHUNK]);
    }
    let number = |x: &R| (x.widen() as usize).checked_sub(1);
    store.chunks().iter().map(|chunk| chunk.iter().map(number).collect()).collect()
}

/// Sums `law` over the links of `chunk`, whose first particle is `first`; one result a row. `second` is ignored unless the
/// law asks for it.
///
/// # Panics
/// If records, store and rows do not belong together.
pub fn sweep_links<R: Real, P: LinkLaw<R, S, K>, const S: usize, const K: usize>(
    isa: Isa,
    law: &P,
    (records, second): (&Records<R>, Option<&Records<R>>),
    (chunk, first): (&RowChunk, usize),
    stored: &[R],
    sums: &mut [[f64; K]],
) {
    let n = chunk.len();
    assert!(sums.len() >= n && records.len() >= first + n, "rows of other particles");
    // Rows are made by `Rows` alone, whose offsets go up to that of the null record and no further.
    assert!(chunk.null as usize <= records.len() * FIELDS, "rows of other records");
    assert!(!P::SECOND || second.is_some_and(|s| s.len() == records.len()), "second records");
    assert!(stored.len() == S * chunk.at.len(), "the store does not fit the rows");
    let second = second.unwrap_or(records);
    dispatch(isa, Sweep { law, records, second, chunk, first, stored, sums });
}

struct Sweep<'a, R, P, const S: usize, const K: usize> {
    law: &'a P,
    records: &'a Records<R>,
    second: &'a Records<R>,
    chunk: &'a RowChunk,
    first: usize,
    stored: &'a [R],
    sums: &'a mut [[f64; K]],
}

impl<R: Real, P: LinkLaw<R, S, K>, const S: usize, const K: usize> LaneWork<R> for Sweep<'_, R, P, S, K> {
    #[inline(always)]
    fn run<L: Lanes<Elem = R>, Search: SearchLanes>(self) {
        let constants = self.law.constants::<L>();
        let (base, second_base) = (self.records.base(), self.second.base());
        let (stored_base, n_entries) = (self.stored.as_ptr(), self.chunk.at.len());
        for (k, sums) in self.sums.iter_mut().enumerate().take(self.chunk.len()) {
            let (begin, end) = (self.chunk.start[k] as usize, self.chunk.start[k + 1] as usize);
            let i = FIELDS * (self.first + k);
            // SAFETY: `sweep_links` has checked that the record exists.
            let own: [L; FIELDS] = std::array::from_fn(|f| L::splat(unsafe { *base.add(i + f) }));
            let mut total = [L::zero(); K];
            let mut m = begin;
            while m < end {
                // SAFETY: rows are padded to a multiple of `L::N`; every entry is the offset of a record or of the null
                // record; there are `S` stored numbers an entry, which `sweep_links` has checked.
                unsafe {
                    let at = self.chunk.at.as_ptr().add(m);
                    let other = L::records(base, at);
                    let second = if P::SECOND { L::records(second_base, at) } else { [L::zero(); FIELDS] };
                    let stored: [L; S] = std::array::from_fn(|s| L::load(stored_base.add(s * n_entries + m)));
                    P::link(&constants, &own, &other, &second, &stored, &mut total);
                }
                m += L::N;
            }
            add_lanes(&total, sums);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CellGrid, SearchSet};

    /// Sums of a stored number times the difference of two numbers.
    struct Difference;

    impl<R: Real> LinkLaw<R, 2, 2> for Difference {
        type Constants<L: Lanes<Elem = R>> = ();
        const SECOND: bool = true;

        fn constants<L: Lanes<Elem = R>>(&self) {}

        #[inline(always)]
        fn link<L: Lanes<Elem = R>>(
            (): &(),
            own: &[L; FIELDS],
            other: &[L; FIELDS],
            second: &[L; FIELDS],
            stored: &[L; 2],
            sums: &mut [L; 2],
        ) {
            sums[0] = stored[0].fma(other[3] - own[3], sums[0]);
            sums[1] = stored[1].fma(second[2], sums[1]);
        }
    }

    fn numbers_meet_their_neighbours<R: Real>(tolerance: f64) {
        let position: Vec<DVec3> = (0..400)
            .map(|k| DVec3::new(f64::from(k % 20), f64::from(k / 20), 0.1 * f64::from(k % 7)))
            .collect();
        let bounds = (DVec3::ZERO, DVec3::new(19.0, 19.0, 0.7));
        let (frame, mut grid) = (Frame::new(bounds, 2.3), CellGrid::new(bounds, 2.3));
        let mut order = Vec::new();
        grid.sort(&position, &mut order);
        let sorted: Vec<DVec3> = order.iter().map(|&k| position[k as usize]).collect();
        let mut set = SearchSet::default();
        set.fill(&frame, &sorted);
        let value = |i: usize| 1.0 + (i as f64).sin();
        let weight = |i: usize, j: usize| ((3 * i + 7 * j) as f64).cos();
        let (mut records, mut second) = (Records::<R>::default(), Records::<R>::default());
        records.resize(400);
        second.resize(400);
        records.fill(|i| [R::pack(value(i)); FIELDS]);
        second.fill(|i| [R::pack(value(2 * i)); FIELDS]);
        for isa in Isa::available() {
            let mut rows = Rows::default();
            rows.build(isa, &frame, (&set, &sorted), &set, &grid, true);
            let store = LinkStore::<R, 2>::new(isa, &rows, |i, j| [weight(i, j), weight(j, i)]);
            for (c, row) in rows.chunks().iter().enumerate() {
                let mut sums = [[0.0; 2]; CHUNK];
                let (chunk, stored) = ((row, c * CHUNK), &store.chunks()[c]);
                sweep_links(isa, &Difference, (&records, Some(&second)), chunk, stored, &mut sums);
                for (k, sums) in sums.iter().enumerate().take(row.len()) {
                    let i = c * CHUNK + k;
                    let exact: [f64; 2] = [
                        rows.row(i).map(|j| weight(i, j) * (value(j) - value(i))).sum(),
                        rows.row(i).map(|j| weight(j, i) * value(2 * j)).sum(),
                    ];
                    assert!((sums[0] - exact[0]).abs() < tolerance, "{} {sums:?} {exact:?}", isa.name());
                    assert!((sums[1] - exact[1]).abs() < tolerance, "{} {sums:?} {exact:?}", isa.name());
                }
            }
        }
    }

    #[test]
    fn stored_numbers_meet_their_neighbours_on_all_lanes() {
        numbers_meet_their_neighbours::<f64>(1e-13);
        numbers_meet_their_neighbours::<f32>(1e-5);
    }
}
