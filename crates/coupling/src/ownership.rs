//! Which column a place behind the wall belongs to, where columns of several faces meet.

use crate::columns::Foot;
use glam::DVec3;
use vaso_kernels::CellGrid;

/// How much nearer than its own another foot has to be to take a place over, in spacings of the fluid: what disorder of feet and normals
/// may do on a smooth face.
const NEARER: f64 = 0.1;
/// How far in the lumen of another face a place is lost, in spacings (`docs/theory/coupling.md`).
const IN_LUMEN: f64 = 0.1;

/// Feet by place.
pub(crate) struct Owners<'a> {
    feet: &'a [Foot],
    grid: CellGrid,
    order: Vec<u32>,
    spacing: f64,
}

impl<'a> Owners<'a> {
    pub(crate) fn new(feet: &'a [Foot], spacing: f64, support: f64) -> Self {
        let position: Vec<DVec3> = feet.iter().map(|foot| foot.position).collect();
        let low = position.iter().fold(DVec3::INFINITY, |a, b| a.min(*b)) - support;
        let high = position.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b)) + support;
        // Cells are no smaller than the farthest foot that may count.
        let mut grid = CellGrid::new((low, high), support + spacing);
        let mut order = Vec::new();
        grid.sort(&position, &mut order);
        Self { feet, grid, order, spacing }
    }

    /// Whether the place at the height `z` \[m\] of a column is its own.
    pub(crate) fn owns(&self, column: usize, z: f64) -> bool {
        let own = &self.feet[column];
        let x = own.position + z * own.normal;
        let others = self.grid.runs(x);
        let mut others = others.as_slice().iter().flat_map(|&(begin, end)| &self.order[begin..end]);
        !others.any(|&b| {
            let other = &self.feet[b as usize];
            let away = x - other.position;
            let distance = away.length();
            let is_nearer = distance < z - NEARER * self.spacing;
            let looks_here = other.normal.dot(own.normal) < 0.0 && distance < z + 0.5 * self.spacing;
            is_nearer || looks_here && other.normal.dot(away) < -IN_LUMEN * self.spacing
        })
    }
}
