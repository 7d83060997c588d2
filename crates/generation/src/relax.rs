//! Physics-driven relaxation: particles push each other apart until the kernel gradient sum is even.
//!
//! The step of Zhu, Zhang, Yu and Hu (J. Hydrodyn. 33, 2021), with three changes. What lies beyond the
//! faces enters by closed forms, of layers of particles beyond a curved face, not by tabulated integrals
//! over an even medium. The step factor is fixed, not scaled by the largest residual, so that the
//! displacement really decays. And pairs that are much too close push harder than the kernel says: its
//! gradient falls off below 0.65 spacings, which would leave a few pairs stuck together.

use crate::faces::{Faces, LAYER};
use crate::neighbors::{CHUNK, Neighbors};
use crate::random;
use crate::region::Region;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::Wendland;

/// Step factor as a share of the one up to which lattices are stable, and its largest value.
const STABLE_SHARE: f64 = 0.7;
const MOST_ALPHA: f64 = 0.25;
/// Largest displacement in a step, in spacings.
const STEP_CAP: f64 = 0.1;
/// Half-width of the random start displacement, in spacings. A perfect lattice would stay as it is, and with
/// less than this the cubic one, which is no state of rest, takes longer to give way.
const JITTER: f64 = 0.2;
/// Distance every particle keeps from each face, in spacings.
const GAP: f64 = 0.5 * LAYER;
/// Distance below which pairs push harder, in spacings, by the fourth power of how much closer they are.
const CLOSE: f64 = 0.85;
/// Reach of the neighbour lists beyond the support, in spacings.
const SKIN: f64 = 0.3;
/// Mean displacement in a step at which the particles count as at rest, in spacings.
const AT_REST: f64 = 1e-3;
/// Steps within which the residual must fall, and by which share, to go on.
const PATIENCE: (usize, f64) = (50, 0.01);
/// Steps at the end that ask for the exact faces: bounding by them once and for all would push particles
/// into others where the table rounds off an edge.
const POLISH: usize = 20;

/// How a relaxation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Relaxed {
    /// Steps made.
    pub(crate) iterations: usize,
    /// Whether the particles came to rest, or to where the residual falls no more, within the steps allowed.
    pub(crate) converged: bool,
}

/// What is relaxed: a region, and the kernel and volume of its particles.
pub(crate) struct Relaxation<'a, R> {
    pub(crate) region: &'a R,
    pub(crate) kernel: Wendland,
    /// Distance between particles \[m\].
    pub(crate) spacing: f64,
    /// Volume of each particle \[m^3\].
    pub(crate) volume: f64,
}

/// Where the particles were when their neighbour lists were made.
struct Listed {
    neighbors: Neighbors,
    position: Vec<DVec3>,
    /// Whether the particle only pushes and stays where it is.
    fixed: Vec<bool>,
    /// Whether the particle cannot feel a face before the lists are made again.
    deep: Vec<bool>,
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
    /// Relaxes until the particles are at rest, for at most `steps` steps.
    ///
    /// `progress` is told the step and the mean displacement in spacings. The particles end in the
    /// order of the search grid, not in that of the start.
    pub(crate) fn run(
        &self,
        position: &mut Vec<DVec3>,
        steps: usize,
        seed: u64,
        progress: &mut dyn FnMut(usize, f64),
    ) -> Relaxed {
        self.run_among(position, &[], steps, seed, progress)
    }

    /// As [`Self::run`], for particles between others that push them but stay where they are.
    ///
    /// The fixed ones count with the same volume as the movable ones.
    pub(crate) fn run_among(
        &self,
        movable: &mut Vec<DVec3>,
        fixed: &[DVec3],
        steps: usize,
        seed: u64,
        progress: &mut dyn FnMut(usize, f64),
    ) -> Relaxed {
        let dp = self.spacing;
        movable.par_iter_mut().enumerate().for_each(|(i, x)| {
            *x += JITTER * dp * random::unit_box(seed, i);
            *x = self.bound(*x, |x| self.region.exact_faces(x));
        });
        let n_movable = movable.len();
        let is_fixed = |i| i >= n_movable;
        let mut position = std::mem::take(movable);
        position.extend_from_slice(fixed);
        let position = &mut position;
        let skin = SKIN * dp;
        let mut listed = Listed {
            neighbors: Neighbors::new(self.region.bounds(), self.kernel.support() + skin),
            position: Vec::new(),
            fixed: (0..position.len()).map(is_fixed).collect(),
            deep: Vec::new(),
        };
        self.list(&mut listed, position);
        let mut next = position.clone();
        let mut residuals = Vec::with_capacity(steps);
        let (mut last, mut converged) = (steps, false);
        for step in 1..=steps {
            let sums = self.step(&listed, position, &mut next, step + POLISH > last);
            std::mem::swap(position, &mut next);
            let mean = sums.displacement / (n_movable as f64 * dp);
            progress(step, mean);
            residuals.push(sums.residual);
            if !converged && (mean < AT_REST || stagnant(&residuals)) {
                (last, converged) = (last.min(step + POLISH), true);
            }
            if step == last {
                break;
            }
            if sums.drift > (0.5 * skin).powi(2) {
                self.list(&mut listed, position);
            }
        }
        let moved = position.iter().zip(&listed.fixed).filter(|(_, fixed)| !**fixed);
        movable.extend(moved.map(|(x, _)| *x));
        Relaxed { iterations: last, converged }
    }

    /// Sorts the particles and makes their neighbour lists.
    fn list(&self, listed: &mut Listed, position: &mut Vec<DVec3>) {
        let order = listed.neighbors.rebuild(position);
        listed.fixed = order.iter().map(|&old| listed.fixed[old as usize]).collect();
        listed.position.clone_from(position);
        let depth = self.kernel.support() + SKIN * self.spacing;
        let is_deep = |x: &DVec3| self.region.faces(*x).clearance() > depth;
        position.par_iter().with_min_len(CHUNK).map(is_deep).collect_into_vec(&mut listed.deep);
    }

    /// Moves every particle once, from `position` to `next`.
    fn step(&self, listed: &Listed, position: &[DVec3], next: &mut [DVec3], exact: bool) -> Partial {
        let chunks = next.par_chunks_mut(CHUNK).zip(listed.neighbors.chunks());
        let partials: Vec<Partial> = chunks
            .enumerate()
            .map(|(c, (next, chunk))| {
                let mut sums = Partial::default();
                for (k, row) in chunk.rows().enumerate() {
                    let i = c * CHUNK + k;
                    let x = position[i];
                    if listed.fixed[i] {
                        next[k] = x;
                        continue;
                    }
                    let (moved, residual) = self.moved(x, row, position, listed.deep[i], exact);
                    next[k] = moved;
                    sums.displacement += moved.distance(x);
                    sums.residual += residual;
                    sums.drift = sums.drift.max(moved.distance_squared(listed.position[i]));
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

    /// Where a particle goes in one step, and its (h |G|)^2.
    fn moved(&self, x: DVec3, row: &[u32], position: &[DVec3], deep: bool, exact: bool) -> (DVec3, f64) {
        let faces = |x| if exact { self.near_faces(x) } else { self.region.faces(x) };
        let felt = if deep { Faces::new() } else { faces(x) };
        let (h, cap) = (self.kernel.h, STEP_CAP * self.spacing);
        let gradient = self.gradient_sum(x, row, position, CLOSE) + self.missing_gradient(&felt);
        let push = -2.0 * self.step_factor() * h * h * gradient;
        let moved = x + push * (cap / push.length()).min(1.0);
        // A step is shorter than the cap, so only particles nearer than that can come too close.
        let may_need_bounding = felt.clearance() < GAP * self.spacing + 1.5 * cap;
        let moved = if may_need_bounding { self.bound(moved, faces) } else { moved };
        (moved, h * h * gradient.length_squared())
    }

    /// Step factor alpha; its limit was found as 0.21, 0.268 and 0.357 for h of 1, 1.15 and 1.3 spacings.
    fn step_factor(&self) -> f64 {
        let limit = 0.21 + 0.49 * (self.kernel.h / self.spacing - 1.0);
        (STABLE_SHARE * limit).min(MOST_ALPHA)
    }

    /// Kernel gradient sum at `x` \[1/m\] over the particles of `row`; pairs nearer than `close` spacings
    /// count more, none for zero.
    pub(crate) fn gradient_sum(&self, x: DVec3, row: &[u32], position: &[DVec3], close: f64) -> DVec3 {
        let per_support = 1.0 / self.kernel.support();
        let close_squared = (close * self.spacing * per_support).powi(2);
        let mut sum = DVec3::ZERO;
        for &j in row {
            let d = (x - position[j as usize]) * per_support;
            let r_squared = d.length_squared();
            let u = (1.0 - r_squared.sqrt()).max(0.0);
            let mut weight = u * u * u;
            // Few pairs are so close: a branch costs less than a division for each.
            if r_squared < close_squared {
                weight *= (close_squared / r_squared.max(f64::MIN_POSITIVE)).powi(2);
            }
            sum += weight * d;
        }
        -self.volume * self.kernel.gradient_scale() * sum
    }

    /// What `gradient_sum` lacks of the particles beyond `faces` \[1/m\].
    pub(crate) fn missing_gradient(&self, faces: &Faces) -> DVec3 {
        faces.missing_gradient(&self.kernel, self.spacing)
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

    /// The faces at `x`, exact where the bounding may need them.
    fn near_faces(&self, x: DVec3) -> Faces {
        let faces = self.region.faces(x);
        if faces.clearance() < 2.0 * GAP * self.spacing { self.region.exact_faces(x) } else { faces }
    }
}

/// Whether the residual has stopped falling.
fn stagnant(residuals: &[f64]) -> bool {
    let (steps, share) = PATIENCE;
    let Some(earlier) = residuals.len().checked_sub(steps).filter(|n| *n > 0) else { return false };
    let least = |part: &[f64]| part.iter().copied().fold(f64::INFINITY, f64::min);
    least(&residuals[earlier..]) > (1.0 - share) * least(&residuals[..earlier])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::{Lattice, deepest_sites};

    /// A box of edges 12, 8 and 8 spacings of 1.
    struct Block;

    const HALF: DVec3 = DVec3::new(6.0, 4.0, 4.0);

    impl Region for Block {
        fn bounds(&self) -> (DVec3, DVec3) {
            (-HALF, HALF)
        }
        fn level(&self, x: DVec3) -> f64 {
            (x.abs() - HALF).max_element()
        }
        fn exact_level(&self, x: DVec3) -> f64 {
            self.level(x)
        }
        fn faces(&self, x: DVec3) -> Faces {
            let mut faces = Faces::new();
            let clearance = HALF - x.abs();
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                faces.push(clearance.dot(axis), axis * x.dot(axis).signum());
            }
            faces
        }
        fn exact_faces(&self, x: DVec3) -> Faces {
            self.faces(x)
        }
    }

    fn nearest(x: DVec3, others: &[DVec3]) -> f64 {
        others.iter().map(|y| y.distance(x)).filter(|r| *r > 0.0).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn stagnation_is_no_new_least_for_fifty_steps() {
        let falling: Vec<f64> = (0..200).map(|k| f64::powi(0.999, k)).collect();
        assert!(!stagnant(&falling));
        // A passing rise is none.
        let hump: Vec<f64> = (0..80).map(|k| if (30..60).contains(&k) { 2.0 } else { falling[k] }).collect();
        assert!(!stagnant(&hump));
        let mut level = falling[..60].to_vec();
        level.extend([falling[60]; 30]);
        assert!(!stagnant(&level));
        level.extend([falling[60]; 20]);
        assert!(stagnant(&level));
    }

    /// Half of a relaxed set is put back to the lattice and relaxed among the other half.
    #[test]
    fn particles_relaxed_among_fixed_ones_fit_in() {
        let relaxation = Relaxation { region: &Block, kernel: Wendland::new(1.3), spacing: 1.0, volume: 1.0 };
        let mut all = deepest_sites(&Block, Lattice::Cubic, 1.0, 768).expect("as many sites as cubes");
        relaxation.run(&mut all, 100, 0, &mut |_, _| {});
        let (fixed, mut movable): (Vec<DVec3>, Vec<DVec3>) = all.iter().partition(|x| x.x < 0.0);
        for (i, x) in movable.iter_mut().enumerate() {
            *x += 0.4 * random::unit_box(5, i);
        }
        let n = movable.len();
        let crowded = movable.iter().map(|x| nearest(*x, &fixed)).fold(f64::INFINITY, f64::min);
        relaxation.run_among(&mut movable, &fixed, 100, 1, &mut |_, _| {});
        assert_eq!(movable.len(), n);
        let together: Vec<DVec3> = fixed.iter().chain(&movable).copied().collect();
        let least = movable.iter().map(|x| nearest(*x, &together)).fold(f64::INFINITY, f64::min);
        assert!(crowded < 0.6 && least > 0.7, "{crowded} before, {least} after");
        assert!(movable.iter().all(|x| Block.level(*x) < -0.9 * GAP));
    }
}
