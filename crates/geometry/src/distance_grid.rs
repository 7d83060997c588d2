//! Signed distance on a lattice near the surface, for loops that ask millions of times.

use glam::{DVec3, UVec3};
use rayon::prelude::*;

use crate::distance::SignedDistance;

/// Cells of a block along each axis; its nodes are one more, so that a cell never reaches into two blocks.
const CELLS: usize = 8;
const NODES: usize = CELLS + 1;
const BLOCK: usize = NODES * NODES * NODES;

/// A cache of signed distance on a cubic lattice within a band around the surface.
///
/// Blocks of 8 x 8 x 8 cells are stored only where the surface is near, so memory grows with the area of the
/// surface and not with the volume of the box.
pub struct DistanceGrid {
    origin: DVec3,
    spacing: f64,
    band: f64,
    /// Reciprocal of the spacing.
    nodes_per_length: f64,
    /// Upper limit of a place in nodes: below the last node, so that its cell is a cell of the last block.
    last: DVec3,
    /// Blocks along each axis.
    blocks: UVec3,
    /// For each block its first value in `values`, or the side of a far one.
    table: Vec<Slot>,
    values: Vec<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Slot {
    Inside,
    Outside,
    Near(u32),
}

impl DistanceGrid {
    /// Samples `distance` on a lattice of the given spacing \[m\] over `bounds` \[m\], exactly within `band` \[m\] of
    /// the surface; farther away only the side is kept.
    ///
    /// Of a wall without its caps ([`SignedDistance::wall`]) the side changes at a distance in front of each
    /// opening; values interpolated across that place mean nothing, so keep the bounds to the vessel there.
    ///
    /// # Panics
    /// When `spacing` or `band` is not positive and finite, `bounds` are not finite, or the spacing is so small
    /// that the bounds hold more than 2^32 blocks.
    pub fn build(distance: &SignedDistance, bounds: (DVec3, DVec3), spacing: f64, band: f64) -> DistanceGrid {
        assert!(spacing > 0.0 && spacing.is_finite(), "spacing must be positive, not {spacing}");
        assert!(band > 0.0 && band.is_finite(), "band must be positive, not {band}");
        assert!(bounds.0.is_finite() && bounds.1.is_finite(), "bounds must be finite, not {bounds:?}");
        let block_size = CELLS as f64 * spacing;
        let blocks = ((bounds.1 - bounds.0) / block_size).ceil().max(DVec3::ONE);
        let n_blocks = blocks.element_product();
        assert!(n_blocks <= f64::from(u32::MAX), "a spacing of {spacing} is too small for {bounds:?}");
        let (blocks, n_blocks) = (blocks.as_uvec3(), n_blocks as usize);
        let mut grid = DistanceGrid {
            origin: bounds.0,
            spacing,
            band,
            nodes_per_length: spacing.recip(),
            last: (blocks * CELLS as u32).as_dvec3() - 1e-9,
            blocks,
            table: Vec::new(),
            values: Vec::new(),
        };

        // A block can hold a point of the band only if its centre is nearer than the band and half a diagonal.
        let reach = band + 0.5 * 3f64.sqrt() * block_size;
        let centers: Vec<(f64, u32)> = (0..n_blocks)
            .into_par_iter()
            .map(|b| {
                let nearest = distance.query(grid.block_origin(b) + 0.5 * block_size);
                (nearest.distance, nearest.triangle)
            })
            .collect();
        let near: Vec<usize> = (0..n_blocks).filter(|&b| centers[b].0.abs() <= reach).collect();
        let mut values = vec![0.0; near.len() * BLOCK];
        values.par_chunks_mut(BLOCK).zip(&near).for_each(|(block, &b)| {
            grid.fill(block, grid.block_origin(b), distance, centers[b].1);
        });
        let mut table: Vec<Slot> =
            centers.iter().map(|c| if c.0 < 0.0 { Slot::Inside } else { Slot::Outside }).collect();
        for (k, &b) in near.iter().enumerate() {
            table[b] = Slot::Near(k as u32);
        }
        grid.table = table;
        grid.values = values;
        grid
    }

    /// Writes the distances at the nodes of a block.
    fn fill(&self, block: &mut [f64], corner: DVec3, distance: &SignedDistance, near: u32) {
        // Each node starts from the answer of the one before it, which is one spacing away.
        let mut guess = near;
        let mut last = 0.0_f64;
        for (node, value) in block.iter_mut().enumerate() {
            // Distance changes by no more than the way gone, so nodes beyond the band need no query as long
            // as the last one left enough of it. Not so in front of an open end, where the side may change.
            last = last.signum() * (last.abs() - self.spacing);
            if !distance.is_continuous() || last.abs() <= self.band + self.spacing {
                let nearest = distance.query_from(corner + self.spacing * snake(node), guess);
                (guess, last) = (nearest.triangle, nearest.distance);
            }
            *value = last;
        }
        unsnake(block);
    }

    /// Signed distance phi \[m\] and its unit gradient at `x`, by trilinear interpolation.
    ///
    /// Beyond the band phi is `+band` or `-band` and the gradient zero. Outside the bounds the values are
    /// those of the nearest point of the bounds.
    #[inline]
    pub fn sample(&self, x: DVec3) -> (f64, DVec3) {
        let at = ((x - self.origin) * self.nodes_per_length).max(DVec3::ZERO).min(self.last);
        let cell = at.as_uvec3();
        let f = at - cell.as_dvec3();
        let block = cell >> CELLS.ilog2();
        let number = (block.z * self.blocks.y + block.y) * self.blocks.x + block.x;
        let first = match self.table[number as usize] {
            Slot::Near(k) => k as usize * BLOCK,
            Slot::Inside => return (-self.band, DVec3::ZERO),
            Slot::Outside => return (self.band, DVec3::ZERO),
        };
        let local = cell - block * CELLS as u32;
        let node = first + (local.z as usize * NODES + local.y as usize) * NODES + local.x as usize;
        // One check of the range for all eight corners.
        let Some(v) = self.values[node..].first_chunk::<{ NODES * NODES + NODES + 2 }>() else {
            unreachable!("the last cell of a block ends at its last node")
        };
        let edge = |k: usize| (v[k], v[k + 1] - v[k]);
        let [(a, da), (b, db), (c, dc), (d, dd)] =
            [edge(0), edge(NODES), edge(NODES * NODES), edge(NODES * NODES + NODES)];
        let (low, high) = (a + f.x * da, b + f.x * db);
        let (low_up, high_up) = (c + f.x * dc, d + f.x * dd);
        let (bottom, top) = (low + f.y * (high - low), low_up + f.y * (high_up - low_up));
        let phi = bottom + f.z * (top - bottom);
        if phi.abs() >= self.band {
            return (self.band.copysign(phi), DVec3::ZERO);
        }
        let (dx_bottom, dx_top) = (da + f.y * (db - da), dc + f.y * (dd - dc));
        let gradient = DVec3::new(
            dx_bottom + f.z * (dx_top - dx_bottom),
            (high - low) + f.z * ((high_up - low_up) - (high - low)),
            top - bottom,
        );
        (phi, gradient.normalize_or_zero())
    }

    /// Distance between neighbouring nodes \[m\].
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Distance from the surface up to which values are kept \[m\].
    pub fn band(&self) -> f64 {
        self.band
    }

    /// Memory the values take \[bytes\].
    pub fn bytes(&self) -> usize {
        size_of_val(&self.values[..]) + size_of_val(&self.table[..])
    }

    fn block_origin(&self, block: usize) -> DVec3 {
        let [nx, ny] = [self.blocks.x as usize, self.blocks.y as usize];
        let corner = DVec3::new((block % nx) as f64, (block / nx % ny) as f64, (block / nx / ny) as f64);
        self.origin + CELLS as f64 * self.spacing * corner
    }
}

/// Place of a node in its block \[spacings\] when rows are walked to and fro, each step to a neighbour.
fn snake(node: usize) -> DVec3 {
    let (x, y, z) = (node % NODES, node / NODES % NODES, node / NODES / NODES);
    let row = node / NODES;
    let y = if z.is_multiple_of(2) { y } else { NODES - 1 - y };
    let x = if row.is_multiple_of(2) { x } else { NODES - 1 - x };
    DVec3::new(x as f64, y as f64, z as f64)
}

/// Puts the values of a block walked by [`snake`] into the order of the axes.
fn unsnake(block: &mut [f64]) {
    for (row, values) in block.chunks_mut(NODES).enumerate() {
        if row % 2 == 1 {
            values.reverse();
        }
    }
    for layer in block.chunks_mut(NODES * NODES).skip(1).step_by(2) {
        for y in 0..NODES / 2 {
            let (front, back) = layer.split_at_mut((NODES - 1 - y) * NODES);
            front[y * NODES..(y + 1) * NODES].swap_with_slice(&mut back[..NODES]);
        }
    }
}
