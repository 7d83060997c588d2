//! The outer surface of a wall: that of the lumen moved outwards.

use glam::{DMat3, DVec3};
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use crate::{
    error::GeometryError,
    self_intersection::{IntersectionPlace, places, self_intersections},
    sets::Sets,
    surface::Surface,
    vessel::Vessel,
};

/// Longest way of a vertex, in offset distances: at sharp edges the exact one grows without limit.
const MITER_LIMIT: f64 = 2.0;
/// Eigenvalue, as part of their sum, below which the normals at a vertex do not span a direction.
const NOT_SPANNED: f64 = 0.01;

/// Edges shorter than this many median edges have both ends moved alike, as if they were one vertex: moved each
/// its own way they would pass each other, and the slivers along them have no normal worth the name.
const SLIVER: f64 = 0.1;

/// A surface moved outwards, and what is wrong with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Extruded {
    /// The moved surface \[m\], with the triangles of that of the vessel in their order.
    pub surface: Surface,
    /// Pairs of triangles that cut each other, sorted.
    pub intersections: Vec<[u32; 2]>,
    /// The connected places at which they lie, those with most pairs first.
    pub places: Vec<IntersectionPlace>,
    /// Triangles turned over: the distance exceeds a radius of curvature.
    pub flipped: usize,
    /// Vertices at edges so sharp that they were moved less far than the faces around them need.
    pub limited: usize,
}

impl Extruded {
    /// Whether the surface bounds a body: it neither cuts itself nor is a triangle turned over.
    pub fn is_sound(&self) -> bool {
        self.intersections.is_empty() && self.flipped == 0
    }
}

/// Moves the wall of `vessel` outwards by `distance` \[m\]; caps stay in their planes and grow with it.
///
/// A vertex moves by `distance` times the vector that has the projection one on the normals of the wall
/// triangles around it and zero on those of a cap, by least squares weighted with the angles at the vertex: so
/// faces, not vertices, end up at the distance. No more than two distances, though.
///
/// Where limbs are nearer than two distances, or a bend turns more tightly than one, the result cuts itself.
/// It is for looking at and for other programs; the walls vaso computes with are made without it.
///
/// # Errors
/// When `distance` is not a positive number.
pub fn extrude(vessel: &Vessel, distance: f64) -> Result<Extruded, GeometryError> {
    if !(distance > 0.0 && distance.is_finite()) {
        return Err(GeometryError::OffsetDistance { distance });
    }
    let ways = ways(vessel);
    let is_limited = |way: &&DVec3| way.length() > MITER_LIMIT;
    let limited = ways.iter().filter(is_limited).count();
    let moved = |(x, way): (&DVec3, &DVec3)| *x + distance * way.clamp_length_max(MITER_LIMIT);
    let surface = Surface {
        vertices: vessel.surface.vertices.iter().zip(&ways).map(moved).collect(),
        triangles: vessel.surface.triangles.clone(),
    };
    let is_flipped = |t: &usize| surface.area_vector(*t).dot(vessel.surface.area_vector(*t)) < 0.0;
    let flipped = (0..surface.triangles.len()).filter(is_flipped).count();
    let intersections = self_intersections(&surface);
    let places = places(&surface, &intersections);
    Ok(Extruded { surface, intersections, places, flipped, limited })
}

/// Normal equations of one vertex.
#[derive(Clone, Copy, Default)]
struct Incidence {
    /// Sum of `w n n^T`.
    matrix: DMat3,
    /// Sum of `w n` over the wall triangles, which is also the right-hand side.
    wall: DVec3,
    /// Sum of the weights.
    weight: f64,
}

/// For each vertex the way it goes per unit of distance.
fn ways(vessel: &Vessel) -> Vec<DVec3> {
    let surface = &vessel.surface;
    let mut incidence = vec![Incidence { matrix: DMat3::ZERO, ..Default::default() }; surface.vertices.len()];
    let root = join_short_edges(surface, SLIVER * vessel.audit.edge_length.median);
    for (t, corners) in surface.triangles.iter().enumerate() {
        let corners = corners.map(|v| root[v as usize]);
        if corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0] {
            continue;
        }
        let normal = surface.triangle_normal(t);
        let p = surface.triangle(t);
        for k in 0..3 {
            let (u, v) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            let angle = u.cross(v).length().atan2(u.dot(v));
            let at = &mut incidence[corners[k]];
            at.matrix += angle * DMat3::from_cols(normal.x * normal, normal.y * normal, normal.z * normal);
            at.weight += angle;
            if vessel.face_opening[t].is_none() {
                at.wall += angle * normal;
            }
        }
    }
    let ways: Vec<DVec3> = incidence.iter().map(Incidence::solve).collect();
    root.iter().map(|&v| ways[v]).collect()
}

/// For each vertex the lowest that it is joined to by edges shorter than `length` \[m\].
fn join_short_edges(surface: &Surface, length: f64) -> Vec<usize> {
    let mut sets = Sets::new(surface.vertices.len());
    for &[a, b, c] in &surface.triangles {
        for (a, b) in [(a, b), (b, c), (c, a)].map(|(a, b)| (a as usize, b as usize)) {
            if surface.vertices[a].distance(surface.vertices[b]) < length {
                sets.join(a, b);
            }
        }
    }
    (0..surface.vertices.len()).map(|v| sets.lowest(v)).collect()
}

impl Incidence {
    /// The least-squares solution nearest to the mean normal of the wall.
    fn solve(&self) -> DVec3 {
        let Some(start) = self.wall.try_normalize() else { return DVec3::ZERO };
        let columns = self.matrix.to_cols_array();
        let eigen = SymmetricEigen::new(Matrix3::from_column_slice(&columns));
        let rest = self.wall - self.matrix * start;
        let rest = Vector3::from(rest.to_array());
        let mut way = Vector3::from(start.to_array());
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value > NOT_SPANNED * self.weight {
                way += vector * (vector.dot(&rest) / value);
            }
        }
        DVec3::new(way.x, way.y, way.z)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::{prepare, shapes, unit::LengthUnit};

    fn vessel(surface: Surface) -> Vessel {
        prepare(surface, Some(LengthUnit::Metre)).expect("a closed shape is a vessel")
    }

    /// Around a regular polygon of apothem a stands one of apothem a + t, of the area n tan(pi/n) (a + t)^2.
    #[test]
    fn a_pipe_becomes_the_pipe_around_it() {
        let (radius, length, n, t) = (0.003, 0.02, 32, 0.0012);
        for axis in [DVec3::Z, DVec3::new(0.3, -0.8, 0.5).normalize()] {
            let vessel = vessel(shapes::pipe(radius, length, axis, n));
            let outer = extrude(&vessel, t).expect("a positive distance");
            assert!(outer.is_sound() && outer.places.is_empty() && outer.limited == 0);
            let half = PI / n as f64;
            let apothem = radius * half.cos() + t;
            let section = n as f64 * half.tan() * apothem * apothem;
            assert!((outer.surface.volume() / (section * length) - 1.0).abs() < 1e-9);
            let around = 2.0 * n as f64 * half.tan() * apothem * length;
            assert!((outer.surface.area() / (around + 2.0 * section) - 1.0).abs() < 1e-9);
            for (x, y) in vessel.surface.vertices.iter().zip(&outer.surface.vertices) {
                assert!((*y - *x).dot(axis).abs() < 1e-9 * t, "{x} left the plane of its section");
            }
        }
    }

    /// Limbs 1.2 mm apart and a bend that leaves 0.6 mm inside.
    #[test]
    fn a_hairpin_cuts_itself_when_the_wall_is_too_thick() {
        let hairpin = vessel(shapes::bent_pipe(0.002, 0.0026, PI, 48));
        let thin = extrude(&hairpin, 0.3e-3).expect("a positive distance");
        assert!(thin.is_sound(), "{:?}", thin.places);
        let thick = extrude(&hairpin, 0.8e-3).expect("a positive distance");
        assert!(!thick.is_sound() && thick.flipped > 0);
        let inside = DVec3::new(0.0026, 0.0, 0.0);
        let place = &thick.places[0];
        assert!(place.center.distance(inside) < 0.0015, "{place:?}");
    }

    /// Two pipes a millimetre apart meet where each wall is thicker than half of it.
    #[test]
    fn limbs_side_by_side_meet_in_the_middle() {
        let mut pipes = shapes::pipe(0.002, 0.01, DVec3::Z, 48);
        let other = pipes.map(|x| x + 0.005 * DVec3::X);
        let first = pipes.vertices.len() as u32;
        pipes.vertices.extend(other.vertices);
        pipes.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
        let pipes = vessel(pipes);
        assert!(extrude(&pipes, 0.45e-3).expect("a positive distance").is_sound());
        let thick = extrude(&pipes, 0.55e-3).expect("a positive distance");
        assert!(!thick.intersections.is_empty() && thick.flipped == 0);
        let half = thick.surface.triangles.len() / 2;
        assert!(thick.intersections.iter().all(|[a, b]| (*a as usize) < half && *b as usize >= half));
        for place in &thick.places {
            assert!((place.center.x - 0.0025).abs() < 0.2e-3, "{place:?}");
        }
    }

    /// Three triangles about a corner of a wall triangle, a hundredth of its size and out of its plane.
    #[test]
    fn slivers_move_as_one() {
        let mut pipe = shapes::pipe(0.002, 0.01, DVec3::Z, 48);
        let t = (0..pipe.triangles.len())
            .find(|&t| {
                let [a, b, c] = pipe.triangle(t);
                ((a + b + c).z / 3.0 - 0.005).abs() < 0.2e-3 && pipe.triangle_normal(t).z.abs() < 0.5
            })
            .expect("a pipe has a middle");
        let [a, b, c] = pipe.triangle(t);
        let near = a + 0.01 * (b - a) + 0.01 * (c - a) + 4e-6 * pipe.triangle_normal(t);
        let [a, b, c] = pipe.triangles[t];
        let v = pipe.vertices.len() as u32;
        pipe.vertices.push(near);
        pipe.triangles[t] = [a, b, v];
        pipe.triangles.extend([[b, c, v], [c, a, v]]);
        let outer = extrude(&vessel(pipe), 0.3e-3).expect("a positive distance");
        assert!(outer.is_sound(), "{} flipped, {:?}", outer.flipped, outer.places);
    }

    #[test]
    fn a_spike_is_cut_short() {
        let mut pipe = shapes::pipe(0.002, 0.01, DVec3::Z, 48);
        let spike = pipe
            .vertices
            .iter()
            .position(|x| (x.z - 0.005).abs() < 0.2e-3 && x.truncate().length() > 0.0019)
            .expect("a pipe has a middle");
        pipe.vertices[spike] *= DVec3::new(1.5, 1.5, 1.0);
        let pipe = vessel(pipe);
        let outer = extrude(&pipe, 0.2e-3).expect("a positive distance");
        assert!(outer.limited > 0);
        for (x, y) in pipe.surface.vertices.iter().zip(&outer.surface.vertices) {
            assert!(x.distance(*y) < 2.0001 * 0.2e-3);
        }
    }

    #[test]
    fn distances_that_make_no_sense_are_refused() {
        let pipe = vessel(shapes::pipe(0.002, 0.01, DVec3::Z, 48));
        for distance in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
            let error = extrude(&pipe, distance).expect_err("no distance").to_string();
            assert!(error.starts_with("the offset distance is"), "{error}");
        }
    }
}
