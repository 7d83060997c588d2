//! Density re-initialisation and kernel-gradient correction: sums over the frozen configuration.

use crate::cap::CapZone;
use crate::fluid::{Fluid, numbered};
use crate::frozen;
use crate::law::moments::{Moments, SUMS};
use crate::level::in_buffer;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Store, Sym3, run_on, sweep};

impl<R: Real> Fluid<R> {
    /// Blends the density towards the kernel sum, `rho += omega (rho_sum - rho)` with
    /// `rho_sum = (sum m W + rho0 sum_wall V W) / S0`, and finds the correction matrices.
    ///
    /// Particles in a buffer keep the density of the continuity equation: their kernel sum lacks the
    /// side beyond the cap.
    pub fn summation(&mut self, zones: &[CapZone]) {
        let n = self.state.len();
        let rho0 = self.numbers.rest_density;
        self.next.resize(n);
        self.second.resize(n);
        self.fill_current(|state, i| {
            let mass = state.mass[i];
            [mass / (rho0 + state.density_change[i]), mass / rho0]
        });

        let held = self.sums_to_hold(zones);
        let omega = self.part * self.numbers.density_blend;
        let value = self.kernel.value_scale();
        let gradient = self.kernel.gradient_scale();
        let support = self.kernel.support();
        let s0 = self.lattice_sum;
        let corrects = self.numbers.gradient_correction;
        let mass = &self.state.mass;
        let (rows, wall) = (&self.rows, &self.wall);
        let (isa, frame, current) = (self.isa, &self.frame, &self.current);
        let fluid_gather =
            Gather { frame, own: current, other: current, own_second: None, other_second: None };
        let wall_gather =
            Gather { frame, own: current, other: &wall.kinematic, own_second: None, other_second: None };
        (
            self.frozen.par_chunks_mut(CHUNK),
            self.state.density_change.par_chunks_mut(CHUNK),
            self.zone_of.par_chunks(CHUNK),
            self.second.as_mut_slice().par_chunks_mut(CHUNK),
            rows.chunks(),
            wall.fluid_rows.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (frozen, density_change, zone_of, second, row, wall_row))| {
                let mut fluid = [[0.0; SUMS]; CHUNK];
                let mut walls = [[0.0; SUMS]; CHUNK];
                sweep(isa, &Moments, &fluid_gather, numbered(row, c), Store::None, &mut fluid);
                if !wall_row.has_no_pairs() {
                    sweep(isa, &WallMoments, &wall_gather, numbered(wall_row, c), Store::None, &mut walls);
                }
                run_on(
                    isa,
                    #[inline(always)]
                    || {
                        for k in 0..frozen.len() {
                            let i = c * CHUNK + k;
                            let (f, w) = (&fluid[k], &walls[k]);
                            // The self term has u = 1, so u^4 (5 - 4u) = 1.
                            let kernel_sum = value * (f[0] + mass[i] / rho0 + w[0]);
                            let summed = rho0 * (kernel_sum / s0 - 1.0);
                            if !in_buffer(zones, zone_of[k]) {
                                density_change[k] += omega * (summed - density_change[k]);
                            }
                            let moment =
                                Sym3(std::array::from_fn(|q| gradient * support * (f[4 + q] + w[4 + q])));
                            let frozen = &mut frozen[k];
                            let fluid_moment = Sym3(std::array::from_fn(|q| gradient * support * f[4 + q]));
                            let moments = frozen::Moments {
                                correction: if corrects { Sym3::correction(&moment) } else { Sym3::IDENTITY },
                                fluid_gradient: -gradient * DVec3::new(f[1], f[2], f[3]),
                                wall_gradient: -gradient * DVec3::new(w[1], w[2], w[3]),
                                wall_area: gradient * w[10],
                                along_wall: along_wall(&moment, &fluid_moment, frozen.wall_normal()),
                                fluid_moment,
                            };
                            frozen.set_moments(&moments);
                            second[k] = pack_sym(&moments.correction.0);
                        }
                    },
                );
            });
        if let Some(before) = held {
            self.hold_mean(before, zones);
        }
    }
}

/// Most that a divergence along the wall is multiplied by: in a corner little fluid is left to tell it from.
const MAX_ALONG_WALL: f64 = 3.0;

/// Moment along a wall of `normal` over that of the fluid alone.
#[inline(always)]
fn along_wall(Sym3(all): &Sym3, Sym3(fluid): &Sym3, normal: DVec3) -> f64 {
    if normal == DVec3::ZERO {
        return 1.0;
    }
    let along = |m: &[f64; 6]| m[0] + m[1] + m[2] - normal.dot(Sym3(*m).mul(normal));
    (along(all) / along(fluid).max(f64::MIN_POSITIVE)).clamp(1.0, MAX_ALONG_WALL)
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
