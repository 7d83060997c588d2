//! What a particle does by itself, for many at once: one particle a lane, in double precision whatever the pairs have.

use crate::isa::{Isa, LaneWork, dispatch};
use crate::lanes::{Lanes, SearchLanes};
use std::marker::PhantomData;

/// Particles of a block of columns: the least multiple of all numbers of lanes, so that blocks are read from memory one number after the other.
pub const BLOCK: usize = 16;

/// One number of each particle of a block.
pub type BlockColumn = [f64; BLOCK];

/// Work on the particles of a block, written over lanes.
pub trait PointLaw {
    /// Reads and writes some particles. Must be `#[inline(always)]`, and branch on nothing that differs between them.
    fn point<L: Lanes<Elem = f64>>(&self, points: &mut Points<'_, L>);
}

/// Some particles of a block: as many as there are lanes.
pub struct Points<'a, L> {
    fixed: &'a [BlockColumn],
    own: &'a [BlockColumn],
    out: &'a mut [BlockColumn],
    first: usize,
    lanes: PhantomData<L>,
}

impl<L: Lanes<Elem = f64>> Points<'_, L> {
    /// Number `column` of those that never change.
    #[inline(always)]
    pub fn fixed(&self, column: usize) -> L {
        // SAFETY: `first + L::N` is at most `BLOCK`, see `Sweep::run`.
        unsafe { L::load(self.fixed[column].as_ptr().add(self.first)) }
    }

    /// Number `column` of those that are read.
    #[inline(always)]
    pub fn own(&self, column: usize) -> L {
        // SAFETY: as above.
        unsafe { L::load(self.own[column].as_ptr().add(self.first)) }
    }

    /// Writes number `column`.
    #[inline(always)]
    pub fn put(&mut self, column: usize, value: L) {
        // SAFETY: as above.
        unsafe { value.store(self.out[column].as_mut_ptr().add(self.first)) }
    }
}

/// Runs `law` over the first `n` particles of a block, and over what fills up the last lanes.
///
/// # Panics
/// If there are more particles than a block has, or the law asks for a column that is not there.
pub fn sweep_points<P: PointLaw>(
    isa: Isa,
    law: &P,
    n: usize,
    fixed: &[BlockColumn],
    own: &[BlockColumn],
    out: &mut [BlockColumn],
) {
    assert!(n <= BLOCK, "the particles of one block");
    dispatch::<f64, _>(isa, Sweep { law, n, fixed, own, out });
}

struct Sweep<'a, P> {
    law: &'a P,
    n: usize,
    fixed: &'a [BlockColumn],
    own: &'a [BlockColumn],
    out: &'a mut [BlockColumn],
}

impl<P: PointLaw> LaneWork<f64> for Sweep<'_, P> {
    #[inline(always)]
    fn run<L: Lanes<Elem = f64>, S: SearchLanes>(self) {
        // Lanes divide 16 and with it a block, so that the last of them ends in it.
        let mut first = 0;
        while first < self.n {
            let (fixed, own, out) = (self.fixed, self.own, &mut *self.out);
            self.law.point(&mut Points::<L> { fixed, own, out, first, lanes: PhantomData });
            first += L::N;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Scaled;

    impl PointLaw for Scaled {
        #[inline(always)]
        fn point<L: Lanes<Elem = f64>>(&self, points: &mut Points<'_, L>) {
            points.put(0, points.fixed(0).fma(points.own(1), points.own(0)));
        }
    }

    #[test]
    fn each_particle_gets_its_own() {
        let column = |of: &dyn Fn(usize) -> f64| -> BlockColumn { std::array::from_fn(of) };
        let fixed = [column(&|k| k as f64)];
        let own = [column(&|k| 0.5 * k as f64), column(&|_| 2.0)];
        for isa in Isa::available() {
            for n in [1, 7, 8, 15, 16] {
                let mut out = [[-1.0; BLOCK]];
                sweep_points(isa, &Scaled, n, &fixed, &own, &mut out);
                assert!((0..n).all(|k| out[0][k] == 2.5 * k as f64), "{} {n}", isa.name());
                assert!(out[0][n.next_multiple_of(8)..].iter().all(|x| *x == -1.0));
            }
        }
    }
}
