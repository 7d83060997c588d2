//! What was found and changed on the way from triangles to a vessel.

use std::fmt;

use glam::DVec3;

/// The record of [`prepare`](crate::prepare).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Audit {
    /// Triangles given.
    pub triangles_read: usize,
    /// Triangles of the prepared surface, those that close openings and holes included.
    pub triangles: usize,
    /// Vertices of the prepared surface.
    pub vertices: usize,
    /// Whether the prepared surface is closed: two triangles of opposite sense at each edge.
    pub watertight: bool,
    /// Whether neighbouring triangles could be made to agree everywhere.
    pub orientable: bool,
    /// Connected parts of the prepared surface.
    pub components: usize,
    /// Closed loops of border edges found after repair, before they were closed.
    pub boundary_loops: usize,
    /// Of these loops, those closed as holes in the wall, not as openings.
    pub holes_filled: usize,
    /// Edges of the prepared surface at which more than two triangles meet.
    pub non_manifold_edges: usize,
    /// Connected places at which the prepared surface cuts itself.
    pub self_intersections: usize,
    /// Lengths of the edges of the prepared surface.
    pub edge_length: EdgeLengths,
    /// Whether the unit was guessed.
    pub unit_guessed: bool,
    /// What was changed, a sentence each, such as "reversed all triangles".
    pub repairs: Vec<String>,
    /// What was not changed but deserves a look, a sentence each.
    pub notices: Vec<String>,
    /// Flat, roundish regions of the surface, largest first: the caps, and up to 16 others with the reason
    /// why they are none. Caps closed from boundary loops are not listed.
    pub flat_regions: Vec<FlatRegion>,
}

/// Smallest, median and largest length of edges \[m\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EdgeLengths {
    /// Smallest \[m\].
    pub min: f64,
    /// Median \[m\].
    pub median: f64,
    /// Largest \[m\].
    pub max: f64,
}

/// A flat part of the surface that was considered as a cap.
#[derive(Debug, Clone, PartialEq)]
pub struct FlatRegion {
    /// Centre of area \[m\].
    pub center: DVec3,
    /// Outward unit normal.
    pub normal: DVec3,
    /// Area A \[m^2\].
    pub area: f64,
    /// 4 pi A / P^2 with the perimeter P: 1 for a circle.
    pub circularity: f64,
    /// Mean angle between the normal of the region and those of the triangles around it \[rad\].
    pub border_angle: f64,
    /// Why it is no cap; `None` for a cap.
    pub rejected: Option<Rejection>,
}

/// Why a flat region is not taken for a cap.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Rejection {
    /// The border is long for the area, as that of a strip of wall.
    NotRound,
    /// The wall goes on nearly in the plane of the region, or folds back onto it.
    NoCorner,
    /// The lumen behind is not a tube that ends here.
    NoTubeBehind,
    /// The region has holes, or several borders.
    SeveralBorders,
    /// There are hundreds of larger regions that could be caps: this is no vessel.
    TooManyLarger,
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Rejection::NotRound => "its border is too long for its area",
            Rejection::NoCorner => "it does not meet the wall at a corner of 45 to 135 degrees all around",
            Rejection::NoTubeBehind => "there is no tube behind it that ends in it",
            Rejection::SeveralBorders => "it has more than one border",
            Rejection::TooManyLarger => "hundreds of larger regions could be caps as well",
        })
    }
}
