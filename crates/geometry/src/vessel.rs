//! A vessel: a closed surface in metres with its openings.

use glam::DVec3;

use crate::{
    audit::{Audit, EdgeLengths},
    caps, close,
    error::GeometryError,
    opening::Opening,
    repair::{
        self,
        edges::{Edges, components},
    },
    self_intersection::{cut_triangles, places},
    surface::Surface,
    unit::LengthUnit,
};

/// Smallest enclosed volume, as part of the cubed diagonal of the bounding box.
const MIN_VOLUME: f64 = 1e-9;

/// Largest coordinate, in whatever unit. Products of four lengths must stay far from overflow.
const MAX_COORDINATE: f64 = 1e30;

/// Diagonals, in an unknown unit, that fit no vessel in millimetres well and some in other units.
const UNCLEAR_DIAGONAL: std::ops::Range<f64> = 1.0..5.0;

/// A vessel ready to be filled: closed, outward, in metres, with its openings known.
#[derive(Debug, Clone)]
pub struct Vessel {
    /// The closed surface of the lumen \[m\], normals outwards.
    pub surface: Surface,
    /// For each triangle the opening it belongs to, `None` for the wall.
    pub face_opening: Vec<Option<u32>>,
    /// The openings, largest area first.
    pub openings: Vec<Opening>,
    /// What was found and changed on the way.
    pub audit: Audit,
    /// Unit of the coordinates before they became metres.
    pub unit: LengthUnit,
}

impl Vessel {
    /// Number of the opening whose cap is nearest to a point \[m\]; `None` when there are no openings.
    pub fn opening_near(&self, point: DVec3) -> Option<usize> {
        let distance = |k: &usize| self.openings[*k].distance(point);
        (0..self.openings.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Area of the wall, caps left out \[m^2\].
    pub fn wall_area(&self) -> f64 {
        let wall = (0..self.face_opening.len()).filter(|&t| self.face_opening[t].is_none());
        wall.map(|t| self.surface.triangle_area(t)).sum()
    }
}

/// Turns triangles as read into a vessel: welds and orients them, drops debris, closes open ends and holes,
/// finds the caps, and scales to metres.
///
/// Without a `unit` it is guessed by [`LengthUnit::guess`], with a notice in the audit. Every change is
/// listed in [`Audit::repairs`]. Fewer than two openings are no error here: [`Audit::flat_regions`] then says
/// which flat parts were considered.
///
/// # Errors
/// When a vertex is not finite or absurdly far away, a triangle names a vertex that is not there, no triangle has an area, or the
/// surface encloses no volume.
pub fn prepare(raw: Surface, unit: Option<LengthUnit>) -> Result<Vessel, GeometryError> {
    validate(&raw)?;
    let mut audit =
        Audit { triangles_read: raw.triangles.len(), unit_guessed: unit.is_none(), ..Audit::default() };
    let diagonal = raw.diagonal();
    let unit = unit.unwrap_or_else(|| {
        let guess = LengthUnit::guess(diagonal);
        let across = diagonal * guess.metres() * 1e3;
        let doubt = if UNCLEAR_DIAGONAL.contains(&diagonal) { "; it may as well be in metres or centimetres" } else { "" };
        audit.notices.push(format!(
            "no unit given: took \"{guess}\", which makes the vessel {across:.4} mm across its bounding box{doubt}"
        ));
        guess
    });
    let mut surface = raw.map(|v| v * unit.metres());
    let repaired = repair::repair(&mut surface);
    if surface.triangles.is_empty() {
        return Err(GeometryError::NoTriangles { read: audit.triangles_read });
    }
    audit.repairs = repaired.repairs;
    audit.orientable = repaired.conflicts == 0;
    if !audit.orientable {
        let n = repaired.conflicts;
        audit.notices.push(format!(
            "{n} edges whose triangles cannot agree on a side; inside and outside are told by the winding number"
        ));
    }

    let mut face_opening: Vec<Option<u32>> = vec![None; surface.triangles.len()];
    let mut openings = Vec::new();
    for closed in close::close_loops(&mut surface) {
        audit.boundary_loops += 1;
        let label = closed.opening.as_ref().map(|_| openings.len() as u32);
        face_opening.resize(closed.triangles.end, label);
        let (radius, at) = (closed.radius * 1e3, closed.center * 1e3);
        match closed.opening {
            Some(opening) => {
                audit.repairs.push(format!("closed an open end of radius {radius:.4} mm at {at:.4} mm"));
                openings.push(opening);
            }
            None => {
                audit.holes_filled += 1;
                audit.repairs.push(format!("filled a hole of radius {radius:.4} mm at {at:.4} mm"));
            }
        }
    }
    let taken: Vec<bool> = face_opening.iter().map(Option::is_some).collect();
    let (caps, flat_regions) = caps::find(&surface, &taken);
    audit.flat_regions = flat_regions;
    for cap in caps {
        for t in cap.triangles {
            face_opening[t] = Some(openings.len() as u32);
        }
        openings.push(cap.opening);
    }

    let mut vessel = Vessel { surface, face_opening, openings, audit, unit };
    vessel.drop_sealed_components();
    vessel.sort_openings();
    vessel.find_axes();
    vessel.measure();
    let (volume_m3, diagonal_m) = (vessel.surface.volume(), vessel.surface.diagonal());
    if volume_m3 <= MIN_VOLUME * diagonal_m.powi(3) {
        return Err(GeometryError::NoVolume { volume_m3, diagonal_m, unit });
    }
    Ok(vessel)
}

fn validate(raw: &Surface) -> Result<(), GeometryError> {
    if raw.triangles.is_empty() {
        return Err(GeometryError::NoTriangles { read: 0 });
    }
    if let Some(vertex) = raw.vertices.iter().position(|v| !v.is_finite()) {
        return Err(GeometryError::NotFinite { vertex, position: raw.vertices[vertex] });
    }
    if let Some(vertex) = raw.vertices.iter().position(|v| v.abs().max_element() > MAX_COORDINATE) {
        let position = raw.vertices[vertex];
        return Err(GeometryError::TooFar { vertex, position, limit: MAX_COORDINATE });
    }
    let vertices = raw.vertices.len();
    for (triangle, corners) in raw.triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
            return Err(GeometryError::VertexRange { triangle, vertex, vertices });
        }
    }
    Ok(())
}

impl Vessel {
    /// Drops closed parts that no blood can enter, provided another part has an opening.
    fn drop_sealed_components(&mut self) {
        let n = self.surface.triangles.len();
        let (part, count) = components(&Edges::new(&self.surface.triangles), n);
        let mut has_opening = vec![false; count];
        for t in 0..n {
            has_opening[part[t] as usize] |= self.face_opening[t].is_some();
        }
        let sealed = has_opening.iter().filter(|&&open| !open).count();
        self.audit.components = count;
        if sealed == 0 || sealed == count {
            return;
        }
        let keep: Vec<bool> = part.iter().map(|&p| has_opening[p as usize]).collect();
        self.face_opening = (0..n).filter(|&t| keep[t]).map(|t| self.face_opening[t]).collect();
        let triangles = repair::keep_triangles(&mut self.surface, &keep);
        self.audit.components = count - sealed;
        self.audit
            .repairs
            .push(format!("dropped {sealed} component(s) without any opening ({triangles} triangles)"));
    }

    /// Puts the largest opening first.
    fn sort_openings(&mut self) {
        let mut order: Vec<usize> = (0..self.openings.len()).collect();
        order.sort_by(|&a, &b| self.openings[b].area.total_cmp(&self.openings[a].area));
        let mut rank = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            rank[old] = new as u32;
        }
        self.openings = order.iter().map(|&k| self.openings[k].clone()).collect();
        for label in self.face_opening.iter_mut().flatten() {
            *label = rank[*label as usize];
        }
    }

    /// Says where the surface cuts itself: what it encloses there is not what was meant.
    fn look_for_cuts(&mut self) {
        let places = places(&self.surface, &cut_triangles(&self.surface));
        let Some(largest) = places.first() else { return };
        let (n, at, radius) = (places.len(), largest.center * 1e3, largest.radius * 1e3);
        self.audit.self_intersections = n;
        self.audit.notices.push(format!(
            "the surface cuts itself at {n} {}, most around {at:.4} mm within {radius:.4} mm; inside and outside are told by the winding number \
             there, and the volume counts twice what lies in both sheets; mend it where it was made",
            if n == 1 { "place" } else { "places" }
        ));
    }

    /// Fills in the counts of the finished surface.
    fn measure(&mut self) {
        let edges = Edges::new(&self.surface.triangles);
        let mut lengths: Vec<f64> = edges
            .groups()
            .map(|g| {
                let [a, b] = g[0].directed().map(|v| self.surface.vertices[v as usize]);
                a.distance(b)
            })
            .collect();
        lengths.sort_unstable_by(f64::total_cmp);
        if let (Some(&min), Some(&max)) = (lengths.first(), lengths.last()) {
            self.audit.edge_length = EdgeLengths { min, median: lengths[lengths.len() / 2], max };
        }
        self.look_for_cuts();
        if self.audit.components > 1 {
            let n = self.audit.components;
            self.audit.notices.push(format!(
                "the surface is in {n} separate parts that have openings; no blood goes from one to another"
            ));
        }
        self.audit.triangles = self.surface.triangles.len();
        self.audit.vertices = self.surface.vertices.len();
        self.audit.watertight = edges.is_closed_and_oriented();
        self.audit.non_manifold_edges = edges.non_manifold();
        if self.audit.non_manifold_edges > 0 {
            let n = self.audit.non_manifold_edges;
            self.audit.notices.push(format!(
                "more than two triangles meet at {n} edges; inside and outside are told by the winding number"
            ));
        }
    }
}
