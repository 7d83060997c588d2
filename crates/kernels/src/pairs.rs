//! The gather loop over neighbour rows, written once for all pair laws.
//!
//! A law is a branch-free function of one pair over lanes; the loop gathers records, hands the law
//! the geometry of the pair and sums up. Laws that need no `r_inv` or no second record pay for
//! none: what is not read is not computed.

use crate::frame::Frame;
use crate::isa::{Isa, LaneWork, dispatch};
use crate::lanes::{FIELDS, Lanes, Real, SearchLanes, add_lanes};
use crate::records::Records;
use crate::rows::{RowChunk, make_room};

/// Particle whose row is summed, the same value in all lanes.
#[derive(Clone, Copy)]
pub struct Own<L> {
    /// Fields u v w of its record.
    pub velocity: [L; 3],
    /// Last field of its record.
    pub scalar: L,
    /// Its second record, where the law asks for one.
    pub second: [L; FIELDS],
}

/// Neighbours of the particle, one a lane.
#[derive(Clone, Copy)]
pub struct Pair<L> {
    /// Separation own minus neighbour, in supports.
    pub d: [L; 3],
    /// Distance, in supports.
    pub r: L,
    /// Inverse distance, in 1/supports; finite also for coincident particles.
    pub r_inv: L,
    /// `max(0, 1 - r)`: the Wendland kernel is `s u^4 (5 - 4u)`, its gradient `-s' u^3 d`.
    pub u: L,
    /// Volume of the neighbour \[m^3\].
    pub volume: L,
    /// Fields u v w of its record.
    pub velocity: [L; 3],
    /// Last field of its record.
    pub scalar: L,
    /// Its second record, where the law asks for one.
    pub second: [L; FIELDS],
    /// Number stored for this pair by an earlier law.
    pub stored: L,
}

/// What a law does with the number stored per pair.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Stored {
    /// There is none.
    No,
    /// [`PairLaw::pair`] finds it in [`Pair::stored`].
    Read,
    /// [`PairLaw::store`] makes it.
    Write,
}

/// Contribution of a pair to `K` sums of its first particle.
pub trait PairLaw<R: Real, const K: usize>: Sync {
    /// Constants of the law in all lanes.
    type Constants<L: Lanes<Elem = R>>: Copy;
    /// Whether a second record of the neighbour is gathered, and that of the particle itself read.
    const SECOND: bool = false;
    /// Whether the second record of the particle itself is read.
    const SECOND_OWN: bool = Self::SECOND;
    /// Use of the number stored per pair.
    const STORED: Stored = Stored::No;

    /// Splats the constants; called once a chunk.
    fn constants<L: Lanes<Elem = R>>(&self) -> Self::Constants<L>;

    /// Adds the pair to the sums. Must be `#[inline(always)]`.
    fn pair<L: Lanes<Elem = R>>(c: &Self::Constants<L>, own: &Own<L>, pair: &Pair<L>, sums: &mut [L; K]);

    /// The number to store for the pair. Must be `#[inline(always)]`.
    #[inline(always)]
    fn store<L: Lanes<Elem = R>>(c: &Self::Constants<L>, own: &Own<L>, pair: &Pair<L>) -> L {
        let _ = (c, own, pair);
        L::zero()
    }
}

/// Number stored per pair, laid out like the rows, so that it streams beside them.
#[derive(Clone, Debug, Default)]
pub struct PairStore<R> {
    chunks: Vec<Vec<R>>,
}

impl<R: Real> PairStore<R> {
    /// Makes room for one number an entry of `rows`; contents are unspecified.
    pub fn resize_for(&mut self, rows: &[RowChunk]) {
        self.chunks.resize(rows.len(), Vec::new());
        for (store, row) in self.chunks.iter_mut().zip(rows) {
            make_room(store, row.n_entries().saturating_sub(store.len()));
            store.resize(row.n_entries(), R::default());
        }
    }

    /// Stores of the chunks.
    pub fn chunks(&self) -> &[Vec<R>] {
        &self.chunks
    }

    /// Stores of the chunks, to be written.
    pub fn chunks_mut(&mut self) -> &mut [Vec<R>] {
        &mut self.chunks
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.chunks.iter().map(|c| c.capacity() * size_of::<R>()).sum()
    }
}

/// Storage a sweep reads or writes per pair.
pub enum Store<'a, R> {
    /// None; the law has [`Stored::No`].
    None,
    /// Read by the law.
    Read(&'a [R]),
    /// Written by the law.
    Write(&'a mut [R]),
}

/// Records a sweep gathers from.
pub struct Gather<'a, R> {
    /// Frame the coordinates are encoded in.
    pub frame: &'a Frame,
    /// Records of the body whose rows are summed.
    pub own: &'a Records<R>,
    /// Records of the body the rows point at.
    pub other: &'a Records<R>,
    /// Second records of the own body; ignored unless the law asks for them.
    pub own_second: Option<&'a Records<R>>,
    /// Second records of the other body; ignored unless the law asks for them.
    pub other_second: Option<&'a Records<R>>,
}

/// Sums `law` over the rows of `chunk`, whose first particle is `first`; one result a row.
///
/// # Panics
/// If records, store and rows do not belong together.
pub fn sweep<R: Real, P: PairLaw<R, K>, const K: usize>(
    isa: Isa,
    law: &P,
    gather: &Gather<R>,
    rows: (&RowChunk, usize),
    store: Store<R>,
    sums: &mut [[f64; K]],
) {
    sweep_some(isa, law, gather, rows, store, |_| true, sums);
}

/// [`sweep`] over the rows that `takes` is true of; the sums of the others stay as they are.
///
/// # Panics
/// If records, store and rows do not belong together.
pub fn sweep_some<R: Real, P: PairLaw<R, K>, const K: usize>(
    isa: Isa,
    law: &P,
    gather: &Gather<R>,
    (chunk, first): (&RowChunk, usize),
    store: Store<R>,
    takes: impl Fn(usize) -> bool,
    sums: &mut [[f64; K]],
) {
    let n = chunk.len();
    assert!(sums.len() >= n && gather.own.len() >= first + n, "rows of other particles");
    let largest = gather.other.len() * FIELDS;
    // Rows are made by `Rows` alone, whose offsets go up to that of the null record and no further.
    assert!(chunk.null as usize <= largest, "rows of other records");
    assert!(!P::SECOND_OWN || gather.own_second.is_some_and(|s| s.len() >= first + n), "own second records");
    let second_fits = |s: &Records<R>| s.len() == gather.other.len();
    assert!(!P::SECOND || gather.other_second.is_some_and(second_fits), "other second records");
    let (read, write) = match (P::STORED, store) {
        (Stored::No, Store::None) => (std::ptr::null(), std::ptr::null_mut()),
        (Stored::Read, Store::Read(s)) if s.len() == chunk.at.len() => (s.as_ptr(), std::ptr::null_mut()),
        (Stored::Write, Store::Write(s)) if s.len() == chunk.at.len() => (std::ptr::null(), s.as_mut_ptr()),
        _ => panic!("the store does not fit the law or the rows"),
    };
    dispatch(isa, Sweep { law, gather, chunk, first, read, write, takes, sums });
}

struct Sweep<'a, R, P, F, const K: usize> {
    law: &'a P,
    gather: &'a Gather<'a, R>,
    chunk: &'a RowChunk,
    first: usize,
    read: *const R,
    write: *mut R,
    takes: F,
    sums: &'a mut [[f64; K]],
}

/// Entries of the index stream to fetch ahead (2 KiB), and of what is stored beside it: the hardware does not keep up between gathers.
const AHEAD: usize = 512;

impl<R: Real, P: PairLaw<R, K>, F: Fn(usize) -> bool, const K: usize> LaneWork<R> for Sweep<'_, R, P, F, K> {
    #[inline(always)]
    fn run<L: Lanes<Elem = R>, S: SearchLanes>(self) {
        let constants = self.law.constants::<L>();
        let unit = L::constant(self.gather.frame.unit());
        let (own_base, other_base) = (self.gather.own.base(), self.gather.other.base());
        let own_second = self.gather.own_second.map_or(own_base, Records::base);
        let other_second = self.gather.other_second.map_or(other_base, Records::base);
        let tiny = L::constant(1e-24);
        for (k, sums) in self.sums.iter_mut().enumerate().take(self.chunk.len()) {
            if !(self.takes)(k) {
                continue;
            }
            let (begin, end) = (self.chunk.start[k] as usize, self.chunk.start[k + 1] as usize);
            if begin == end {
                *sums = [0.0; K];
                continue;
            }
            let i = FIELDS * (self.first + k);
            // SAFETY: `sweep` has checked that the record exists.
            let record: [L; FIELDS] = std::array::from_fn(|f| L::splat(unsafe { *own_base.add(i + f) }));
            let second: [L; FIELDS] = if P::SECOND_OWN {
                // SAFETY: as above.
                std::array::from_fn(|f| L::splat(unsafe { *own_second.add(i + f) }))
            } else {
                [L::zero(); FIELDS]
            };
            let own = Own { velocity: [record[4], record[5], record[6]], scalar: record[7], second };
            let mut total = [L::zero(); K];
            let mut m = begin;
            while m < end {
                // SAFETY: rows are padded to a multiple of `L::N`; every entry is the offset of a
                // record of `other` or of its null record; the store is as long as the rows.
                unsafe {
                    let at = self.chunk.at.as_ptr().add(m);
                    if m % 16 == 0 {
                        L::prefetch(at.wrapping_add(AHEAD));
                        if P::STORED == Stored::Read {
                            L::prefetch(self.read.wrapping_add(m + AHEAD).cast());
                        }
                    }
                    let other = L::records(other_base, at);
                    let d = [
                        record[0].delta(other[0], unit),
                        record[1].delta(other[1], unit),
                        record[2].delta(other[2], unit),
                    ];
                    let r2 = d[0].fma(d[0], d[1].fma(d[1], d[2].fma(d[2], tiny)));
                    let r_inv = r2.rsqrt();
                    let r = r2 * r_inv;
                    let pair = Pair {
                        d,
                        r,
                        r_inv,
                        u: (L::constant(1.0) - r).max(L::zero()),
                        volume: other[3],
                        velocity: [other[4], other[5], other[6]],
                        scalar: other[7],
                        second: if P::SECOND { L::records(other_second, at) } else { [L::zero(); FIELDS] },
                        stored: if P::STORED == Stored::Read { L::load(self.read.add(m)) } else { L::zero() },
                    };
                    P::pair(&constants, &own, &pair, &mut total);
                    if P::STORED == Stored::Write {
                        P::store(&constants, &own, &pair).store(self.write.add(m));
                    }
                }
                m += L::N;
            }
            add_lanes(&total, sums);
        }
    }
}
