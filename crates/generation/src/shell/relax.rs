//! Relaxation of particles on a surface.
//!
//! As for a body in space: particles push each other apart until the sum of kernel gradients is even. Here
//! the kernel is that of a plane, steps are tangential and end on the nearest point of the surface. What lies
//! beyond a rim enters as a half plane, so that the rim is no free edge over which particles are pushed.

use crate::neighbors::{CHUNK, Neighbors};
use crate::random;
use crate::shell::{
    plane_kernel::PlaneKernel,
    sheet::{Foot, Sheet, same_sheet},
};
use glam::DVec3;
use rayon::prelude::*;

/// Step factor; a square lattice is stable up to 0.30 at h = 1.15 dp.
const ALPHA: f64 = 0.2;
/// Largest displacement in a step, in spacings.
const STEP_CAP: f64 = 0.2;
/// Half-width of the random start displacement, in spacings.
const JITTER: f64 = 0.05;
/// Distance every particle keeps from the rim, in spacings: half the distance between close-packed rows,
/// sqrt(sqrt(3)/2) / 2.
const GAP: f64 = 0.465;
/// Reach of the neighbour lists beyond the support, in spacings.
const SKIN: f64 = 0.3;
/// Mean displacement in a step at which the particles count as at rest, in spacings.
const AT_REST: f64 = 1e-3;
/// Steps over which the residual must fall, and by which share, to go on.
const PATIENCE: (usize, f64) = (50, 0.01);

/// What is relaxed: a sheet, and the kernel and area of its particles.
pub(crate) struct SheetRelaxation<'a> {
    pub(crate) sheet: &'a Sheet<'a>,
    pub(crate) kernel: PlaneKernel,
    /// Distance between particles \[m\].
    pub(crate) spacing: f64,
    /// Area of each particle \[m^2\].
    pub(crate) area: f64,
}

/// The particles with the lists made of them.
pub(crate) struct Listed {
    neighbors: Neighbors,
    /// Where the particles were when the lists were made.
    position: Vec<DVec3>,
    /// Whether the particle can feel a rim before the lists are made again.
    near_rim: Vec<bool>,
    reach: f64,
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

impl SheetRelaxation<'_> {
    /// Relaxes for at most `steps` steps and returns how many were made.
    ///
    /// `progress` is told the step and the mean displacement in spacings. The particles end in the order of
    /// the search grid.
    pub(crate) fn run(
        &self,
        particles: &mut Vec<Foot>,
        steps: usize,
        seed: u64,
        progress: &mut dyn FnMut(usize, f64),
    ) -> usize {
        let dp = self.spacing;
        particles.par_iter_mut().enumerate().for_each(|(i, foot)| {
            *foot = self.sheet.step(*foot, foot.point + JITTER * dp * random::unit_box(seed, i));
        });
        let skin = SKIN * dp;
        let mut listed = self.list(particles, skin);
        let mut next = particles.clone();
        let mut residuals = Vec::with_capacity(steps);
        for step in 1..=steps {
            let sums = self.step(&listed, particles, &mut next);
            std::mem::swap(particles, &mut next);
            let mean = sums.displacement / (particles.len() as f64 * dp);
            progress(step, mean);
            residuals.push(sums.residual);
            if mean < AT_REST || stagnant(&residuals) {
                return step;
            }
            if sums.drift > (0.5 * skin).powi(2) {
                listed.renew(self, particles);
            }
        }
        steps
    }

    /// Sorts the particles and lists the neighbours within the support and `skin` \[m\].
    pub(crate) fn list(&self, particles: &mut Vec<Foot>, skin: f64) -> Listed {
        let reach = self.kernel.support() + skin;
        let neighbors = Neighbors::new(self.sheet.bounds(), reach);
        let mut listed = Listed { neighbors, position: Vec::new(), near_rim: Vec::new(), reach };
        listed.renew(self, particles);
        listed
    }

    /// Moves every particle once, from `particles` to `next`.
    fn step(&self, listed: &Listed, particles: &[Foot], next: &mut [Foot]) -> Partial {
        let chunks = next.par_chunks_mut(CHUNK).zip(listed.neighbors.chunks());
        let partials: Vec<Partial> = chunks
            .enumerate()
            .map(|(c, (next, chunk))| {
                let mut sums = Partial::default();
                for (k, row) in chunk.rows().enumerate() {
                    let i = c * CHUNK + k;
                    let (moved, residual) = self.moved(&particles[i], row, particles, listed.near_rim[i]);
                    next[k] = moved;
                    sums.displacement += moved.point.distance(particles[i].point);
                    sums.residual += residual;
                    sums.drift = sums.drift.max(moved.point.distance_squared(listed.position[i]));
                }
                sums
            })
            .collect();
        partials.iter().fold(Partial::default(), |a, b| Partial {
            displacement: a.displacement + b.displacement,
            residual: a.residual + b.residual,
            drift: a.drift.max(b.drift),
        })
    }

    /// Where a particle moves to, and its squared residual before.
    fn moved(&self, foot: &Foot, row: &[u32], particles: &[Foot], near_rim: bool) -> (Foot, f64) {
        let (h, cap) = (self.kernel.h(), STEP_CAP * self.spacing);
        let gradient = self.residual(foot, row, particles, near_rim);
        let push = -2.0 * ALPHA * h * h * gradient;
        let mut moved = self.sheet.step(*foot, foot.point + push * (cap / push.length()).min(1.0));
        if near_rim {
            let gap = GAP * self.spacing;
            if let Some(rim) = self.sheet.rim(&moved, gap) {
                let back = moved.point - (gap - rim.distance) * rim.off;
                moved = self.sheet.step(moved, back);
            }
        }
        (moved, h * h * gradient.length_squared())
    }

    /// Tangential kernel gradient sum at a particle over those of `row` it sees, completed by what a rim
    /// cuts off \[1/m\].
    pub(crate) fn residual(&self, foot: &Foot, row: &[u32], particles: &[Foot], near_rim: bool) -> DVec3 {
        let per_support = 1.0 / self.kernel.support();
        let mut sum = DVec3::ZERO;
        for &j in row {
            let other = &particles[j as usize];
            if same_sheet(foot.normal, other.normal) {
                let d = (foot.point - other.point) * per_support;
                let u = (1.0 - d.length()).max(0.0);
                sum += u * u * u * d;
            }
        }
        let mut gradient = -self.area * self.kernel.gradient_scale() * sum;
        if near_rim && let Some(rim) = self.sheet.rim(foot, self.kernel.support()) {
            gradient += self.kernel.half_plane_gradient(rim.distance) * rim.off;
        }
        gradient.reject_from_normalized(foot.normal)
    }
}

impl Listed {
    /// Sorts the particles and makes the lists again.
    fn renew(&mut self, relaxation: &SheetRelaxation<'_>, particles: &mut Vec<Foot>) {
        let mut position: Vec<DVec3> = particles.iter().map(|foot| foot.point).collect();
        let order = self.neighbors.rebuild(&mut position);
        *particles = order.iter().map(|&old| particles[old as usize]).collect();
        let feels = |foot: &Foot| relaxation.sheet.rim(foot, self.reach).is_some();
        self.near_rim = particles.par_iter().with_min_len(CHUNK).map(feels).collect();
        self.position = position;
    }

    /// Whether particle `i` may feel a rim.
    pub(crate) fn near_rim(&self, i: usize) -> bool {
        self.near_rim[i]
    }

    /// For every particle what `f` says of its number and its neighbours, in order.
    pub(crate) fn map<T: Send>(&self, f: impl Fn(usize, &[u32]) -> T + Sync) -> Vec<T> {
        let chunks = self.neighbors.chunks().par_iter().enumerate();
        chunks
            .flat_map_iter(|(c, chunk)| {
                chunk.rows().enumerate().map(|(k, row)| f(c * CHUNK + k, row)).collect::<Vec<_>>()
            })
            .collect()
    }
}

/// Whether the residual has stopped falling.
fn stagnant(residuals: &[f64]) -> bool {
    let (steps, share) = PATIENCE;
    let n = residuals.len();
    n > steps && (residuals[n - 1] - residuals[n - 1 - steps]).abs() < share * residuals[n - 1 - steps]
}
