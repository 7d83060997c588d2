//! Neighbour lists with a skin, built in fixed chunks so that the order of sums never changes.

use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::CellGrid;

/// Particles per chunk: the unit of parallel work and of every partial sum.
pub(crate) const CHUNK: usize = 512;

/// Neighbours of every particle within a radius, the particle itself left out.
pub(crate) struct Neighbors {
    grid: CellGrid,
    radius: f64,
    order: Vec<u32>,
    chunk: Vec<Chunk>,
}

/// Rows of [`CHUNK`] successive particles.
#[derive(Default)]
pub(crate) struct Chunk {
    end: Vec<u32>,
    neighbor: Vec<u32>,
}

impl Chunk {
    /// The rows of this chunk in particle order.
    pub(crate) fn rows(&self) -> impl Iterator<Item = &[u32]> {
        let begin = std::iter::once(0).chain(self.end.iter().copied());
        begin.zip(&self.end).map(|(a, &b)| &self.neighbor[a as usize..b as usize])
    }
}

impl Neighbors {
    /// Lists over `bounds` \[m\] that hold all pairs closer than `radius` \[m\].
    pub(crate) fn new(bounds: (DVec3, DVec3), radius: f64) -> Self {
        Self { grid: CellGrid::new(bounds, radius), radius, order: Vec::new(), chunk: Vec::new() }
    }

    /// Puts the particles in cell order, lists their neighbours and returns the old number of each.
    pub(crate) fn rebuild(&mut self, position: &mut Vec<DVec3>) -> &[u32] {
        self.grid.sort(position, &mut self.order);
        *position = self.order.par_iter().map(|&old| position[old as usize]).collect();
        self.chunk.resize_with(position.len().div_ceil(CHUNK), Chunk::default);
        let (grid, position, limit) = (&self.grid, &*position, self.radius * self.radius);
        self.chunk.par_iter_mut().enumerate().for_each(|(c, chunk)| {
            chunk.end.clear();
            chunk.neighbor.clear();
            let first = c * CHUNK;
            for i in first..(first + CHUNK).min(position.len()) {
                let x = position[i];
                for &(a, b) in grid.runs(x).as_slice() {
                    for j in a..b {
                        if position[j].distance_squared(x) < limit && j != i {
                            chunk.neighbor.push(j as u32);
                        }
                    }
                }
                chunk.end.push(chunk.neighbor.len() as u32);
            }
        });
        &self.order
    }

    /// Row chunks; chunk `c` starts with particle `c * CHUNK`.
    pub(crate) fn chunks(&self) -> &[Chunk] {
        &self.chunk
    }
}
