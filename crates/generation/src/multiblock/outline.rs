//! Lines that show how blocks lie.

use super::blocks::Stretch;
use super::limb::Route;
use super::tfi::Grid;
use crate::frame::Frame;
use glam::DVec3;

/// Lines to draw, each a row of points \[m\].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Edges of the blocks.
    pub edges: Vec<Vec<DVec3>>,
    /// Borders of the sections between layers, closed.
    pub sections: Vec<Vec<DVec3>>,
    /// Cells of the first section of each stretch: lines of nodes, both ways.
    pub faces: Vec<Vec<DVec3>>,
}

impl Outline {
    /// Lines of the stretches of all limbs.
    pub(super) fn of<'a>(limbs: impl Iterator<Item = (&'a Route<'a>, &'a [Stretch])>) -> Self {
        let mut outline = Self::default();
        for (route, stretches) in limbs {
            for stretch in stretches {
                for block in &stretch.blocks {
                    outline.add_block(block);
                }
                for layer in &stretch.layers {
                    outline.sections.extend(route.section(layer.arc[0]).map(|s| s.border().collect()));
                }
            }
        }
        outline
    }

    /// Moves lines made in a frame to where the vessel is.
    pub(super) fn restore(&mut self, frame: &Frame) {
        for line in [&mut self.edges, &mut self.sections, &mut self.faces].into_iter().flatten() {
            frame.restore_points(line, &mut []);
        }
    }

    fn add_block(&mut self, block: &Grid<DVec3>) {
        let n @ [ni, nj, nk] = block.cells();
        for axis in 0..3 {
            let (p, q) = ((axis + 1) % 3, (axis + 2) % 3);
            for (a, b) in [(0, 0), (n[p], 0), (0, n[q]), (n[p], n[q])] {
                let point = |m: usize| {
                    let mut index = [0; 3];
                    (index[axis], index[p], index[q]) = (m, a, b);
                    block.at(index[0], index[1], index[2])
                };
                self.edges.push((0..=n[axis]).map(point).collect());
            }
        }
        for k in [0, nk / 2] {
            self.faces.extend((0..=nj).map(|j| (0..=ni).map(|i| block.at(i, j, k)).collect()));
            self.faces.extend((0..=ni).map(|i| (0..=nj).map(|j| block.at(i, j, k)).collect()));
        }
    }
}
