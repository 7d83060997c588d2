//! The cells of a series: what a frame adds to them, and reading them back.

use super::layout;
use crate::hdf5::{Outcome, Values, Write};
use std::ops::Range;
use std::sync::Arc;

/// Corners of all triangles of a surface, as point numbers.
pub(super) type Triangles = Arc<[[u32; 3]]>;

/// What the cells of a frame are, and what they add to the file.
#[derive(Debug, Clone)]
pub(super) enum Cells {
    /// One poly-vertex of all points: without a cell a surface mapper has nothing to draw. The range is what the shared list
    /// 0, 1, 2, ... must grow by.
    Particles(Range<i64>),
    /// Triangles, written with the first frame; the others point to them.
    Surface(Triangles),
}

impl Cells {
    /// Adds the cells of frame `index` with `count` points.
    pub(super) fn apply<W: Write>(&self, file: &W, index: i64, count: i64) -> Outcome<()> {
        match self {
            Self::Particles(connectivity) => {
                let connectivity: Vec<i64> = connectivity.clone().collect();
                part(file, count, layout::VERTICES, &[0, count], &connectivity, count)?;
                offsets(file, index, index)
            }
            Self::Surface(triangles) => {
                if index == 0 {
                    let connectivity: Vec<i64> = triangles.iter().flatten().map(|&v| v.into()).collect();
                    let ids = connectivity.len() as i64;
                    let ends: Vec<i64> = (0..=ids).step_by(3).collect();
                    part(file, count, layout::POLYGONS, &ends, &connectivity, ids)?;
                }
                offsets(file, 0, 0)
            }
        }
    }
}

/// Describes one part: `count` points, and cells of the one kind `used`, which begin and end at `ends` of `ids` connectivity
/// entries, of which `fresh` are not in the file yet.
fn part<W: Write>(file: &W, count: i64, used: &str, ends: &[i64], fresh: &[i64], ids: i64) -> Outcome<()> {
    let one = |path: &str, value: i64| file.extend(path, Values::I64(&[value]));
    one(layout::NUMBER_OF_POINTS, count)?;
    for kind in layout::CELLS {
        let is_used = kind == used;
        let (cells, ids, ends) = if is_used { (ends.len() as i64 - 1, ids, ends) } else { (0, 0, &[0][..]) };
        one(&layout::cells(kind, "NumberOfCells"), cells)?;
        one(&layout::cells(kind, "NumberOfConnectivityIds"), ids)?;
        file.extend(&layout::cells(kind, "Offsets"), Values::I64(ends))?;
    }
    file.extend(&layout::cells(used, "Connectivity"), Values::I64(fresh))
}

/// Says where the part of a frame and its vertices begin.
fn offsets<W: Write>(file: &W, part: i64, vertex_cell: i64) -> Outcome<()> {
    file.extend(layout::PART_OFFSETS, Values::I64(&[part]))?;
    file.extend(layout::NUMBER_OF_PARTS, Values::I64(&[1]))?;
    file.extend(layout::CELL_OFFSETS, Values::I64(&[vertex_cell, 0, 0, 0]))?;
    file.extend(layout::CONNECTIVITY_OFFSETS, Values::I64(&[0, 0, 0, 0]))
}
