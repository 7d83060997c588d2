//! Triangles of a wall made even: diagonals exchanged, vertices moved along the wall.

use std::f64::consts::TAU;

use glam::DVec3;
use rayon::prelude::*;

use super::implicit::Implicit;
use crate::{repair::flip::Flips, surface::Surface};

/// Rounds of exchanging and moving, and the passes of each.
const ROUNDS: usize = 6;
const FLIP_PASSES: usize = 4;
const SMOOTHING_PASSES: usize = 6;

/// Makes the triangles of the wall as even as their number around the branches allows; the vertices in `fixed`
/// stay where they are.
pub(super) fn even_out(wall: &impl Implicit, fixed: &[u32], surface: &mut Surface) {
    for _ in 0..ROUNDS {
        flip_to_delaunay(surface);
        smooth(wall, fixed, surface);
    }
    flip_to_delaunay(surface);
}

/// Exchanges sides until, with few exceptions, the angles opposite of each add up to less than half a turn:
/// among all triangles between the same points those have the largest smallest angles.
fn flip_to_delaunay(surface: &mut Surface) {
    for _ in 0..FLIP_PASSES {
        let mut flips = Flips::new(&surface.triangles);
        for t in 0..surface.triangles.len() {
            for k in 0..3 {
                let Some(other) = flips.across(t, k) else { continue };
                let [a, b, apex] = [0, 1, 2].map(|i| surface.triangles[t][(k + i) % 3]);
                let far = surface.triangles[other].into_iter().find(|&v| v != a && v != b);
                let angle = |v: u32| {
                    let [v, a, b] = [v, a, b].map(|v| surface.vertices[v as usize]);
                    (a - v).angle_between(b - v)
                };
                // A little more than half a turn, so that rounding does not exchange to and fro.
                if far.is_some_and(|far| angle(apex) + angle(far) > 0.5 * TAU + 1e-6) {
                    flips.flip(&mut surface.triangles, t, k);
                }
            }
        }
    }
}

/// Moves the vertices towards the middle of their neighbours, staying on the wall; those in `fixed` stay put.
fn smooth(wall: &impl Implicit, fixed: &[u32], surface: &mut Surface) {
    let n = surface.vertices.len();
    let mut is_fixed = vec![false; n];
    fixed.iter().for_each(|&v| is_fixed[v as usize] = true);
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); n];
    for &[a, b, c] in &surface.triangles {
        // Each triangle adds the next corner; the one before comes from the triangle across that edge.
        for (from, to) in [(a, b), (b, c), (c, a)] {
            neighbours[from as usize].push(to);
        }
    }
    for _ in 0..SMOOTHING_PASSES {
        surface.vertices = (0..n)
            .into_par_iter()
            .map(|v| {
                let here = surface.vertices[v];
                if is_fixed[v] {
                    return here;
                }
                let around: DVec3 = neighbours[v].iter().map(|&w| surface.vertices[w as usize]).sum();
                wall.project(here.lerp(around / neighbours[v].len() as f64, 0.5))
            })
            .collect();
    }
}
