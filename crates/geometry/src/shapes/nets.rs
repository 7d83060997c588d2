//! Triangles on an implicit wall, by surface nets: a point in each cell of a grid that the wall passes, a quadrilateral
//! across each edge of the grid that it cuts (Gibson 1998).

use glam::{DVec3, IVec3, UVec3};
use rayon::prelude::*;

use super::implicit::Implicit;
use crate::surface::Surface;

/// The wall within a box, of triangles about `edge` long; open where it leaves the box.
pub(super) fn surface_net(wall: &impl Implicit, [low, high]: [DVec3; 2], edge: f64) -> Surface {
    let count = ((high - low) / edge).ceil().as_uvec3() + UVec3::ONE;
    let [nx, ny, nz] = count.to_array().map(|n| n as usize);
    let place =
        |i: usize| low + edge * DVec3::new((i % nx) as f64, (i / nx % ny) as f64, (i / (nx * ny)) as f64);
    let field: Vec<f64> = (0..nx * ny * nz).into_par_iter().map(|i| wall.field(place(i))).collect();
    let step = [1, nx, nx * ny];
    let mut surface = Surface::default();
    let mut point_of = vec![u32::MAX; field.len()];
    for i in 0..field.len() {
        let at = IVec3::new((i % nx) as i32, (i / nx % ny) as i32, (i / (nx * ny)) as i32);
        if (at + 1).cmpge(count.as_ivec3()).any() {
            continue;
        }
        let corner =
            |k: usize| i + (0..3).filter(|axis| k >> axis & 1 == 1).map(|axis| step[axis]).sum::<usize>();
        let mut crossings = (DVec3::ZERO, 0);
        for (a, b) in CELL_EDGES {
            let (a, b) = (corner(a), corner(b));
            if (field[a] < 0.0) != (field[b] < 0.0) {
                crossings.0 += place(a).lerp(place(b), field[a] / (field[a] - field[b]));
                crossings.1 += 1;
            }
        }
        if crossings.1 > 0 {
            point_of[i] = surface.vertices.len() as u32;
            surface.vertices.push(wall.project(crossings.0 / f64::from(crossings.1)));
        }
    }
    for i in 0..field.len() {
        for axis in 0..3 {
            let Some(&next) = field.get(i + step[axis]) else { continue };
            if (field[i] < 0.0) == (next < 0.0) {
                continue;
            }
            let (u, v) = (step[(axis + 1) % 3], step[(axis + 2) % 3]);
            let around = [u + v, v, 0, u].map(|back| i.checked_sub(back).map_or(u32::MAX, |c| point_of[c]));
            if around.contains(&u32::MAX) {
                continue;
            }
            let [a, b, c, d] = around;
            // Outward is towards the end of the edge where the field is positive.
            let [a, b, c, d] = if field[i] < 0.0 { [a, b, c, d] } else { [d, c, b, a] };
            let length = |a: u32, b: u32| surface.vertices[a as usize].distance(surface.vertices[b as usize]);
            if length(a, c) <= length(b, d) {
                surface.triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                surface.triangles.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    surface
}

/// The edges of a cell, by corners whose bits are steps along the axes.
const CELL_EDGES: [(usize, usize); 12] =
    [(0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)];
