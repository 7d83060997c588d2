//! Density re-initialisation and kernel-gradient correction: sums over the frozen configuration.

use crate::cap::CapZone;
use crate::fluid::{Fluid, numbered};
use crate::law::density::CapMean;
use crate::law::moments::{Moments, SUMS};
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, Sym3, sweep};

impl<R: Real> Fluid<R> {
    /// Blends the density towards the kernel sum, `rho += omega (rho_sum - rho)` with
    /// `rho_sum = (sum m W + rho0 sum_wall V W) / S0`, and finds the correction matrices.
    ///
    /// Particles in a buffer keep the density of the continuity equation: their kernel sum lacks the
    /// side beyond the cap. It is blended with the mean of that around them instead, see [`Self::smooth_buffers`].
    pub fn summation(&mut self, zones: &[CapZone]) {
        let n = self.state.len();
        let rho0 = self.numbers.rest_density;
        self.current.resize(n);
        self.next.resize(n);
        self.second.resize(n);
        let mut current = std::mem::take(&mut self.current);
        current.fill(|i| {
            let mass = self.state.mass[i];
            self.record(i, mass / (rho0 + self.state.density_change[i]), mass / rho0)
        });

        self.current = current;
        self.smooth_buffers(zones);
        let current = std::mem::take(&mut self.current);
        let value = self.kernel.value_scale();
        let gradient = self.kernel.gradient_scale();
        let support = self.kernel.support();
        let (blend, s0) = (self.numbers.density_blend, self.lattice_sum);
        let (mass, zone_of) = (&self.state.mass, &self.zone_of);
        let (rows, wall) = (&self.rows, &self.wall);
        let (isa, frame) = (self.isa, &self.frame);
        let fluid_gather =
            Gather { frame, own: &current, other: &current, own_second: None, other_second: None };
        let wall_gather =
            Gather { frame, own: &current, other: &wall.kinematic, own_second: None, other_second: None };
        (
            self.frozen.par_chunks_mut(CHUNK),
            self.state.density_change.par_chunks_mut(CHUNK),
            self.second.as_mut_slice().par_chunks_mut(CHUNK),
            rows.chunks(),
            wall.fluid_rows.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (frozen, density_change, second, row, wall_row))| {
                let mut fluid = [[0.0; SUMS]; CHUNK];
                let mut walls = [[0.0; SUMS]; CHUNK];
                sweep(isa, &Moments, &fluid_gather, numbered(row, c), Store::None, &mut fluid);
                if !wall_row.has_no_pairs() {
                    sweep(isa, &WallMoments, &wall_gather, numbered(wall_row, c), Store::None, &mut walls);
                }
                for k in 0..frozen.len() {
                    let i = c * CHUNK + k;
                    let (f, w) = (&fluid[k], &walls[k]);
                    // The self term has u = 1, so u^4 (5 - 4u) = 1.
                    let kernel_sum = value * (f[0] + mass[i] / rho0 + w[0]);
                    let summed = rho0 * (kernel_sum / s0 - 1.0);
                    let in_buffer = match zone_of[i] {
                        0 => false,
                        z => zones[z as usize - 1].in_buffer,
                    };
                    if !in_buffer {
                        density_change[k] += blend * (summed - density_change[k]);
                    }
                    let moment = Sym3(std::array::from_fn(|q| gradient * support * (f[4 + q] + w[4 + q])));
                    let frozen = &mut frozen[k];
                    frozen.correction = Sym3::correction(&moment);
                    frozen.fluid_gradient = -gradient * DVec3::new(f[1], f[2], f[3]);
                    frozen.wall_gradient = -gradient * DVec3::new(w[1], w[2], w[3]);
                    frozen.wall_area = gradient * w[10];
                    second[k] = pack_sym(&frozen.correction.0);
                }
            });
        self.current = current;
    }

    /// Blends the density of particles in a buffer towards its kernel mean over an even part of the support.
    ///
    /// Neither the kernel sum nor the flow that comes after holds the grain of the density there. Where blood goes in and out slowly,
    /// particles that were put in close to others would raise it until the buffer swings.
    fn smooth_buffers(&mut self, zones: &[CapZone]) {
        if zones.is_empty() {
            return;
        }
        let mut marked = std::mem::take(&mut self.next);
        let (current, frozen, state) = (&self.current, &self.frozen, &self.state);
        marked.fill(|i| {
            let mut record = current.as_slice()[i];
            record[4] = R::pack(state.density_change[i]);
            record[7] = R::pack(frozen[i].cap_depth);
            record
        });
        let law = CapMean { sharpness: self.kernel.support() / self.numbers.spacing };
        let gather =
            Gather { frame: &self.frame, own: &marked, other: &marked, own_second: None, other_second: None };
        let (isa, zone_of, blend) = (self.isa, &self.zone_of, self.numbers.density_blend);
        (self.state.density_change.par_chunks_mut(CHUNK), self.rows.chunks())
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (density_change, row))| {
                let in_buffer = |k: usize| {
                    zone_of[c * CHUNK + k].checked_sub(1).is_some_and(|zone| zones[zone as usize].in_buffer)
                };
                if !(0..density_change.len()).any(in_buffer) {
                    return;
                }
                let mut sums = [[0.0; 2]; CHUNK];
                sweep(isa, &law, &gather, numbered(row, c), Store::None, &mut sums);
                for k in (0..density_change.len()).filter(|&k| in_buffer(k)) {
                    // The self term has u = 1, so u^4 (5 - 4u) = 1.
                    let own = marked.as_slice()[c * CHUNK + k][3].widen();
                    let [weight, sum] = sums[k];
                    let mean = (sum + own * density_change[k]) / (weight + own);
                    density_change[k] += blend * (mean - density_change[k]);
                }
            });
        self.next = marked;
    }
}

/// [`Moments`] with the neighbour's volume as weight: the scalar of a wall record is not a volume.
struct WallMoments;

impl<R: Real> vaso_kernels::PairLaw<R, SUMS> for WallMoments {
    type Constants<L: vaso_kernels::Lanes<Elem = R>> = ();

    fn constants<L: vaso_kernels::Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: vaso_kernels::Lanes<Elem = R>>(
        (): &(),
        own: &vaso_kernels::Own<L>,
        pair: &vaso_kernels::Pair<L>,
        sums: &mut [L; SUMS],
    ) {
        let by_volume = vaso_kernels::Pair { scalar: pair.volume, ..*pair };
        <Moments as vaso_kernels::PairLaw<R, SUMS>>::pair(&(), own, &by_volume, sums);
    }
}

/// Second record of a symmetric matrix.
pub(crate) fn pack_sym<R: Real>(s: &[f64; 6]) -> [R; 8] {
    let p = R::pack;
    [p(s[0]), p(s[1]), p(s[2]), p(s[3]), p(s[4]), p(s[5]), p(0.0), p(0.0)]
}
