//! What carries a point of the lumen surface: particles of the wall behind it, with their weights.

use crate::wall::fit::{TERMS, first_row_of_inverse};
use glam::DVec3;
use rayon::prelude::*;
use vaso_geometry::SignedDistance;
use vaso_kernels::CellGrid;
use vaso_particles::WallView;

/// How far along the wall from a point its particles are \[spacings of the wall\].
const REACH: f64 = 2.0;
/// How deep behind it \[spacings\].
const DEPTH: f64 = 2.6;
/// How often the reach is doubled where there is none.
const DOUBLINGS: usize = 3;
/// Smallest cosine between the normals in front of a particle and at the point for both to be of one sheet of the wall.
const SAME_SHEET: f64 = 0.5;
/// Difference between the depth of a particle and its distance from the surface up to which it lies behind that: beyond an opening it does
/// not \[spacings\].
const BESIDE: f64 = 0.1;
/// Least spread of the depths, as a share of their mean square, for a slope: with less of it particles lie in one layer.
const SPREAD: f64 = 0.05;

/// Weights of wall particles that carry points: displacements that are linear in space come out exactly.
#[derive(Clone, Debug)]
pub(super) struct Anchors {
    /// Each point less what its particles make of it at rest \[m\].
    offset: Vec<DVec3>,
    /// Where the particles of each point begin, one more than there are points.
    start: Vec<u32>,
    particle: Vec<u32>,
    weight: Vec<f64>,
}

/// A particle of the wall and the place of the surface in front of it.
struct Foot {
    place: DVec3,
    normal: DVec3,
    /// \[spacings\].
    depth: f64,
    position: DVec3,
    particle: u32,
}

impl Anchors {
    /// Particles for points at `position` with unit `normal` out of the lumen, of the wall `view` shows behind the surface of
    /// `distance`, at a `spacing` \[m\].
    pub(super) fn new(
        position: &[DVec3],
        normal: &[DVec3],
        view: &WallView,
        distance: &SignedDistance,
        spacing: f64,
    ) -> Self {
        let feet = feet(view, distance, spacing);
        let chosen: Vec<Vec<(u32, f64)>> = (0..=DOUBLINGS).map(|k| REACH * spacing * f64::from(1 << k)).fold(
            vec![Vec::new(); position.len()],
            |mut chosen, reach| {
                if chosen.iter().any(Vec::is_empty) && !feet.is_empty() {
                    choose(&mut chosen, position, normal, &feet, reach);
                }
                chosen
            },
        );
        let mut start = vec![0];
        let (mut particle, mut weight) = (Vec::new(), Vec::new());
        for near in chosen {
            particle.extend(near.iter().map(|(a, _)| *a));
            weight.extend(near.iter().map(|(_, w)| *w));
            start.push(particle.len() as u32);
        }
        let mut anchors = Self { offset: vec![DVec3::ZERO; position.len()], start, particle, weight };
        let carried = anchors.means(view.position);
        anchors.offset = position.iter().zip(carried).map(|(x, mean)| *x - mean).collect();
        anchors
    }

    /// Where the points are, with the particles at `position` \[m\].
    pub(super) fn places(&self, position: &[DVec3]) -> Vec<DVec3> {
        let mut places = self.means(position);
        places.iter_mut().zip(&self.offset).for_each(|(place, offset)| *place += *offset);
        places
    }

    /// Weighted sums of a quantity of the particles.
    pub(super) fn means(&self, of: &[DVec3]) -> Vec<DVec3> {
        let mean = |k: usize| {
            let row = self.start[k] as usize..self.start[k + 1] as usize;
            self.particle[row.clone()].iter().zip(&self.weight[row]).map(|(&a, w)| *w * of[a as usize]).sum()
        };
        (0..self.offset.len()).into_par_iter().with_min_len(1024).map(mean).collect()
    }
}

/// The particles near the surface, each with its foot on it.
fn feet(view: &WallView, distance: &SignedDistance, spacing: f64) -> Vec<Foot> {
    let foot = |a: usize| {
        let depth = view.depth[a];
        if depth > DEPTH * spacing {
            return None;
        }
        let nearest = distance.query(view.position[a]);
        let is_behind = (nearest.distance - depth).abs() <= BESIDE * spacing;
        is_behind.then_some(Foot {
            place: nearest.point,
            normal: nearest.normal,
            depth: depth / spacing,
            position: view.position[a],
            particle: a as u32,
        })
    };
    (0..view.position.len()).into_par_iter().with_min_len(1024).filter_map(foot).collect()
}

/// Chooses the particles of all points that have none yet from those whose feet lie within `reach` \[m\].
fn choose(chosen: &mut [Vec<(u32, f64)>], position: &[DVec3], normal: &[DVec3], feet: &[Foot], reach: f64) {
    let places: Vec<DVec3> = feet.iter().map(|foot| foot.place).collect();
    let low = places.iter().fold(DVec3::INFINITY, |a, b| a.min(*b));
    let high = places.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b));
    let mut grid = CellGrid::new((low, high), reach);
    let mut order = Vec::new();
    grid.sort(&places, &mut order);
    let columns = (chosen, position, normal).into_par_iter().with_min_len(256);
    columns.filter(|(near, _, _)| near.is_empty()).for_each(|(near, x, n)| {
        let runs = grid.runs(*x);
        let feet =
            runs.as_slice().iter().flat_map(|&(begin, end)| &order[begin..end]).map(|&k| &feet[k as usize]);
        let within: Vec<(&Foot, f64)> = feet
            .filter(|foot| foot.normal.dot(*n) > SAME_SHEET)
            .map(|foot| (foot, 1.0 - foot.place.distance_squared(*x) / (reach * reach)))
            .filter(|(_, rest)| *rest > 0.0)
            .map(|(foot, rest)| (foot, rest * rest))
            .collect();
        *near = linear(&within, *x, reach).unwrap_or_else(|| constant(&within));
    });
}

/// Weights of the value at `x` of a linear function through values at `near`, by least squares with their weights; none where the particles
/// lie in one layer.
fn linear(near: &[(&Foot, f64)], x: DVec3, scale: f64) -> Option<Vec<(u32, f64)>> {
    let sum = |of: &dyn Fn(&Foot) -> f64| near.iter().map(|(foot, w)| w * of(foot)).sum::<f64>();
    let (one, first, second) = (sum(&|_| 1.0), sum(&|f| f.depth), sum(&|f| f.depth * f.depth));
    if one * second - first * first <= SPREAD * one * second {
        return None;
    }
    let terms = |foot: &Foot| {
        let place = (foot.position - x) / scale;
        [1.0, place.x, place.y, place.z]
    };
    let mut matrix = [[0.0; TERMS]; TERMS];
    for (foot, w) in near {
        let p = terms(foot);
        for (row, a) in matrix.iter_mut().zip(p) {
            row.iter_mut().zip(p).for_each(|(sum, b)| *sum += w * a * b);
        }
    }
    let row = first_row_of_inverse(matrix)?;
    let share = |foot: &Foot| terms(foot).iter().zip(row).map(|(p, r)| p * r).sum::<f64>();
    Some(near.iter().map(|(foot, w)| (foot.particle, w * share(foot))).collect())
}

/// Weights of the mean.
fn constant(near: &[(&Foot, f64)]) -> Vec<(u32, f64)> {
    let total: f64 = near.iter().map(|(_, w)| w).sum();
    near.iter().map(|(foot, w)| (foot.particle, w / total)).collect()
}
