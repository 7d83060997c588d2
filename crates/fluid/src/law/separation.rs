//! Particles that have come too close part, without moving their common centre.

use super::add_scaled;
use vaso_kernels::{Lanes, Own, Pair, PairLaw, Real};

/// Sums of `V max(0, r_0 - r) e`: what a pair lacks of the distance `r_0` \[supports\], along it.
///
/// Weighed by the volume of the neighbour, so that two particles of one mass move by the same, in opposite directions.
pub struct Separation {
    /// Distance below which particles part \[supports\].
    pub distance: f64,
}

impl<R: Real> PairLaw<R, 3> for Separation {
    type Constants<L: Lanes<Elem = R>> = L;

    fn constants<L: Lanes<Elem = R>>(&self) -> L {
        // u = 1 - r, so r_0 - r = u - (1 - r_0).
        L::constant(1.0 - self.distance)
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(threshold: &L, _own: &Own<L>, p: &Pair<L>, sums: &mut [L; 3]) {
        let lack = (p.u - *threshold).max(L::zero());
        add_scaled(sums, 0, p.volume * lack * p.r_inv, p.d);
    }
}
