//! From a heap of triangles to one oriented surface, with a word about every change.

pub(crate) mod clean;
pub(crate) mod edges;
pub(crate) mod flip;
pub(crate) mod loops;
pub(crate) mod orient;
pub(crate) mod weld;

use crate::surface::Surface;
use edges::{Edges, components};

/// A part smaller than this share of the area of the largest is debris.
const DEBRIS_AREA: f64 = 0.01;

/// What [`repair`] did and found.
#[derive(Debug, Default)]
pub(crate) struct Repaired {
    /// One sentence for each kind of change.
    pub(crate) repairs: Vec<String>,
    /// Edges whose triangles cannot agree on a sense.
    pub(crate) conflicts: usize,
}

/// Welds, cleans, orients, and drops debris.
pub(crate) fn repair(surface: &mut Surface) -> Repaired {
    let mut repairs = Vec::new();
    // That files repeat a vertex for each triangle is their format, not a defect: no word about it.
    weld::weld_exact(surface);
    let mut cleaned = clean::clean(surface);
    let welded = weld::weld_border(surface);
    if welded.count > 0 {
        let (n, within) = (welded.count, welded.tolerance);
        repairs.push(format!("joined {n} border vertices to others within {within:.3e} m"));
        cleaned += clean::clean(surface);
    }
    // Not before the border is welded: in a heap of loose triangles all of them lie loosely.
    cleaned.degenerate += clean::drop_loose_slivers(surface);
    if cleaned.degenerate > 0 {
        repairs.push(format!("dropped {} triangles without area", cleaned.degenerate));
    }
    if cleaned.duplicate > 0 {
        repairs.push(format!("dropped {} duplicate triangles", cleaned.duplicate));
    }
    let oriented = orient::orient(surface);
    let n = surface.triangles.len();
    if oriented.reversed == n && n > 0 {
        repairs.push("reversed all triangles".to_owned());
    } else if oriented.reversed > 0 {
        repairs.push(format!("reversed {} of {n} triangles", oriented.reversed));
    }
    let flipped = clean::flip_slivers(surface);
    if flipped > 0 {
        repairs.push(format!("exchanged the long side of {flipped} triangles without area"));
    }
    repairs.extend(drop_debris(surface));
    Repaired { repairs, conflicts: oriented.conflicts }
}

/// Drops connected parts much smaller than the largest.
fn drop_debris(surface: &mut Surface) -> Option<String> {
    let n = surface.triangles.len();
    let (part, count) = components(&Edges::new(&surface.triangles), n);
    let mut area = vec![0.0; count];
    for t in 0..n {
        area[part[t] as usize] += surface.triangle_area(t);
    }
    let limit = DEBRIS_AREA * area.iter().copied().fold(0.0, f64::max);
    let n_dropped = area.iter().filter(|&&a| a < limit).count();
    if n_dropped == 0 {
        return None;
    }
    let keep: Vec<bool> = part.iter().map(|&p| area[p as usize] >= limit).collect();
    let triangles = keep_triangles(surface, &keep);
    Some(format!(
        "dropped {n_dropped} floating component(s) of less than 1 % of the area ({triangles} triangles)"
    ))
}

/// Keeps the triangles marked in `keep` and the vertices they use; returns how many triangles went.
pub(crate) fn keep_triangles(surface: &mut Surface, keep: &[bool]) -> usize {
    let before = surface.triangles.len();
    let mut t = 0;
    surface.triangles.retain(|_| {
        t += 1;
        keep[t - 1]
    });
    surface.drop_unused_vertices();
    before - surface.triangles.len()
}
