//! Physics-driven relaxation: particles push each other apart until the kernel gradient sum is even.
//!
//! The step of Zhu, Zhang, Yu and Hu (J. Hydrodyn. 33, 2021), with two changes. What lies beyond the
//! faces enters by the closed form of a half space, not by tabulated integrals; and the step factor is
//! fixed, not scaled by the largest residual, so that the displacement really decays.

use crate::faces::Faces;
use crate::neighbors::{CHUNK, Neighbors};
use crate::random;
use crate::region::Region;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::Wendland;

/// Step factor; lattices are stable up to 0.36 at h = 1.3 dp and 0.21 at h = dp.
const ALPHA: f64 = 0.2;
/// Largest displacement in a step, in spacings.
const STEP_CAP: f64 = 0.1;
/// Half-width of the random start displacement, in spacings: a perfect lattice would stay as it is.
const JITTER: f64 = 0.05;
/// Distance every particle keeps from each face, in spacings.
const GAP: f64 = 0.5;
/// Reach of the neighbour lists beyond the support, in spacings.
const SKIN: f64 = 0.3;
/// Mean displacement in a step at which the particles count as at rest, in spacings.
const AT_REST: f64 = 1e-3;
/// Steps over which the residual must fall, and by which share, to go on.
const PATIENCE: (usize, f64) = (50, 0.01);

/// What is relaxed: a region, and the kernel and volume of its particles.
pub(crate) struct Relaxation<'a, R> {
    pub(crate) region: &'a R,
    pub(crate) kernel: Wendland,
    /// Distance between particles \[m\].
    pub(crate) spacing: f64,
    /// Volume of each particle \[m^3\].
    pub(crate) volume: f64,
}

/// Sums over a chunk of particles, added up in chunk order.
#[derive(Clone, Copy, Default)]
struct Partial {
    displacement: f64,
    /// Sum of (h |G|)^2.
    residual: f64,
    /// Largest squared distance from where the neighbour lists were made.
    drift: f64,
}

impl<R: Region> Relaxation<'_, R> {
    /// Relaxes for at most `steps` steps and returns how many were made.
    ///
    /// `progress` is told the step and the mean displacement in spacings. The particles end in the
    /// order of the search grid, not in that of the start.
    pub(crate) fn run(
        &self,
        position: &mut Vec<DVec3>,
        steps: usize,
        seed: u64,
        progress: &mut dyn FnMut(usize, f64),
    ) -> usize {
        let dp = self.spacing;
        position.par_iter_mut().enumerate().for_each(|(i, x)| {
            *x += JITTER * dp * random::unit_box(seed, i);
            *x = self.bound(*x, |x| self.region.faces(x));
        });
        let skin = SKIN * dp;
        let mut neighbors = Neighbors::new(self.region.bounds(), self.kernel.support() + skin);
        neighbors.rebuild(position);
        let mut listed = position.clone();
        let mut next = position.clone();
        let mut residuals = Vec::with_capacity(steps);
        let n = position.len() as f64;
        for step in 1..=steps {
            let sums = self.step(&neighbors, position, &listed, &mut next);
            std::mem::swap(position, &mut next);
            let mean = sums.displacement / (n * dp);
            progress(step, mean);
            residuals.push(sums.residual);
            if mean < AT_REST || stagnant(&residuals) {
                return step;
            }
            if sums.drift > (0.5 * skin).powi(2) {
                neighbors.rebuild(position);
                listed.clone_from(position);
            }
        }
        steps
    }

    /// Moves every particle once, from `position` to `next`.
    fn step(
        &self,
        neighbors: &Neighbors,
        position: &[DVec3],
        listed: &[DVec3],
        next: &mut [DVec3],
    ) -> Partial {
        let cap = STEP_CAP * self.spacing;
        let h = self.kernel.h;
        let partials: Vec<Partial> = next
            .par_chunks_mut(CHUNK)
            .zip(neighbors.chunks())
            .enumerate()
            .map(|(c, (next, chunk))| {
                let mut sums = Partial::default();
                for (k, row) in chunk.rows().enumerate() {
                    let i = c * CHUNK + k;
                    let x = position[i];
                    let gradient = self.residual(x, row, position, &self.region.faces(x));
                    let push = -2.0 * ALPHA * h * h * gradient;
                    let moved = x + push * (cap / push.length()).min(1.0);
                    next[k] = self.bound(moved, |x| self.region.faces(x));
                    sums.displacement += next[k].distance(x);
                    sums.residual += h * h * gradient.length_squared();
                    sums.drift = sums.drift.max(next[k].distance_squared(listed[i]));
                }
                sums
            })
            .collect();
        partials.into_iter().fold(Partial::default(), |a, b| Partial {
            displacement: a.displacement + b.displacement,
            residual: a.residual + b.residual,
            drift: a.drift.max(b.drift),
        })
    }

    /// Kernel gradient sum at `x` with what lies beyond the faces \[1/m\]; zero where all is even.
    pub(crate) fn residual(&self, x: DVec3, row: &[u32], position: &[DVec3], faces: &Faces) -> DVec3 {
        let per_support = 1.0 / self.kernel.support();
        let mut sum = DVec3::ZERO;
        for &j in row {
            let d = (x - position[j as usize]) * per_support;
            let u = (1.0 - d.length()).max(0.0);
            sum += (u * u * u) * d;
        }
        -self.volume * self.kernel.gradient_scale() * sum + faces.missing_gradient(&self.kernel)
    }

    /// Moves `x` away from the faces it is too close to; twice, for the corners.
    fn bound(&self, x: DVec3, faces: impl Fn(DVec3) -> Faces) -> DVec3 {
        let gap = GAP * self.spacing;
        let near = faces(x);
        if near.clearance() >= gap {
            return x;
        }
        let x = near.push_inside(x, gap);
        faces(x).push_inside(x, gap)
    }

    /// Bounds all particles by the exact faces.
    pub(crate) fn bound_exactly(&self, position: &mut [DVec3]) {
        let reach = 2.0 * GAP * self.spacing;
        position.par_iter_mut().for_each(|x| {
            if self.region.faces(*x).clearance() < reach {
                *x = self.bound(*x, |x| self.region.exact_faces(x));
            }
        });
    }
}

/// Whether the residual has stopped falling.
fn stagnant(residuals: &[f64]) -> bool {
    let (steps, share) = PATIENCE;
    let n = residuals.len();
    n > steps && (residuals[n - 1] - residuals[n - 1 - steps]).abs() < share * residuals[n - 1 - steps]
}
