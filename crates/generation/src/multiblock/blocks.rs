//! From the sections of a limb to cells.

use super::hexahedron::{Cell, cell};
use super::layers::Layers;
use super::limb::Route;
use super::tfi::{self, Grid};
use super::topology::{Node, Wireframe};
use glam::DVec3;
use rayon::prelude::*;
use vaso_geometry::SignedDistance;

/// Volumes of a cell outside which its layer is given up: least, in those the wireframe has on the disc, and
/// most, in cubes of the spacing.
const LEAST: f64 = 0.15;
const MOST: f64 = 2.5;
/// Middles of wall faces farther from the wall than this, in spacings, are left where they are: they face
/// something else.
const BULGE: f64 = 0.3;

/// A layer of cells across a limb.
pub(super) struct Layer {
    /// Lengths along the route between which it lies \[m\].
    pub(super) arc: [f64; 2],
    pub(super) cells: Vec<Cell>,
    /// Whether all cells are the right way round and of a sensible volume.
    pub(super) is_sound: bool,
}

/// What blocks are made with.
#[derive(Clone, Copy)]
pub(super) struct Maker<'a> {
    pub(super) wall: &'a SignedDistance,
    /// Distance between particles \[m\].
    pub(super) spacing: f64,
    /// Sweeps of elliptic smoothing; without, blocks are filled from their six faces.
    pub(super) sweeps: usize,
}

/// Blocks of a stretch of limb with one wireframe.
pub(super) struct Stretch {
    pub(super) layers: Vec<Layer>,
    /// Nodes of each block \[m\].
    pub(super) blocks: Vec<Grid<DVec3>>,
    /// Points of the wall that projection missed.
    pub(super) missed: usize,
}

impl Maker<'_> {
    /// Blocks between the sections of `layers`; `None` where a section between stations is not whole.
    pub(super) fn stretch(&self, route: &Route<'_>, layers: &Layers) -> Option<Stretch> {
        let section = |arc: &f64| Some(route.section(*arc)?.nodes(&layers.frame, self.wall, self.sweeps));
        let sections: Vec<_> = layers.arc.par_iter().map(section).collect::<Option<_>>()?;
        let missed = sections.iter().map(|s| s.1).sum();
        let n_layers = layers.arc.len() - 1;
        let blocks: Vec<Grid<DVec3>> = (0..layers.frame.patches.len())
            .map(|p| {
                let [ni, nj, _] = sections[0].0[p].cells();
                let mut block = Grid::new([ni, nj, n_layers], |i, j, k| sections[k].0[p].at(i, j, 0));
                if self.sweeps == 0 {
                    tfi::volume(&mut block);
                }
                block
            })
            .collect();
        let layer = |k: usize| {
            let cells: Vec<Cell> = blocks
                .iter()
                .zip(faces_on_wall(&layers.frame))
                .flat_map(|(b, on_wall)| self.cells(b, on_wall, k))
                .collect();
            let cube = self.spacing.powi(3);
            let sound = LEAST * layers.frame.smallest * cube..MOST * cube;
            let is_sound = cells.iter().all(|c| c.least > 0.0 && sound.contains(&c.volume));
            Layer { arc: [layers.arc[k], layers.arc[k + 1]], cells, is_sound }
        };
        let layers = (0..n_layers).into_par_iter().map(layer).collect();
        Some(Stretch { layers, blocks, missed })
    }

    /// Cells of one layer of a block.
    fn cells(&self, block: &Grid<DVec3>, on_wall: [bool; 4], k: usize) -> Vec<Cell> {
        let [ni, nj, _] = block.cells();
        let mut cells = Vec::with_capacity(ni * nj);
        for j in 0..nj {
            for i in 0..ni {
                let corner =
                    std::array::from_fn(|c| block.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)));
                let is_border = [i == 0, i + 1 == ni, j == 0, j + 1 == nj];
                let mut middle = [None; 6];
                for side in 0..4 {
                    if is_border[side] && on_wall[side] {
                        middle[side] = self.bulge(&corner, side);
                    }
                }
                cells.push(cell(&corner, &middle));
            }
        }
        cells
    }

    /// Tip over the middle of a face on the wall that gives the cell the volume between face and wall.
    ///
    /// The wall stands over the face as a paraboloid, which holds two thirds of base times height, and a
    /// pyramid one third: so the tip is twice as far from the face as the wall.
    fn bulge(&self, corner: &[DVec3; 8], side: usize) -> Option<DVec3> {
        let bit = 1 << (side / 2);
        let is_upper = side % 2 == 1;
        let middle = (0..8).filter(|c| (c & bit != 0) == is_upper).map(|c| corner[c]).sum::<DVec3>() / 4.0;
        let nearest = self.wall.query(middle);
        (nearest.distance.abs() < BULGE * self.spacing).then_some(2.0 * nearest.point - middle)
    }
}

/// For each patch which of its sides lie on the wall: left, right, bottom, top, as the faces of a cell.
fn faces_on_wall(frame: &Wireframe) -> impl Iterator<Item = [bool; 4]> + '_ {
    frame.patches.iter().map(|patch| {
        let on = |edge: usize| patch.edges[edge].iter().all(|node| matches!(node, Node::Wall(_)));
        [on(2), on(3), on(0), on(1)]
    })
}
