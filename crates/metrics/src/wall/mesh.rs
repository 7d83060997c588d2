//! The wall of a vessel as a mesh fine enough to show what the particles see.

use glam::DVec3;
use rayon::prelude::*;
use vaso_geometry::{Rim, SmoothNormals, Vessel};

/// Longest edge of the mesh \[spacings\]. Finer it would show nothing more; coarser it would miss what particles resolve.
const LONGEST_EDGE: f64 = 1.5;
/// Distance from a rim up to which it is told \[spacings\]: longer than any buffer.
const RIM_REACH: f64 = 10.0;
/// Rounds of splitting, each of which halves every edge that is too long.
const MOST_ROUNDS: usize = 16;

/// Triangles of the wall, caps left out, with points at their corners.
#[derive(Clone, Debug, PartialEq)]
pub struct WallMesh {
    /// Position of each point \[m\].
    pub position: Vec<DVec3>,
    /// Unit normal at each point, out of the lumen.
    pub normal: Vec<DVec3>,
    /// Area each point stands for: a third of its triangles \[m^2\].
    pub area: Vec<f64>,
    /// Distance of each point from the nearest rim of an opening, at most ten spacings \[m\]. Within a buffer, of four spacings,
    /// stresses are those of a flow that is imposed.
    pub rim_distance: Vec<f64>,
    /// Point numbers of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl WallMesh {
    /// The wall of `vessel`, its triangles split until no edge is longer than one and a half `spacing` \[m\].
    ///
    /// The shape is that of the surface: points in the middle of an edge stay on it. Their normals are interpolated.
    pub fn new(vessel: &Vessel, spacing: f64) -> Self {
        let surface = &vessel.surface;
        let is_wall = |t: usize| vessel.face_opening[t].is_none();
        let normals = SmoothNormals::new(surface, is_wall);
        let mut number = vec![u32::MAX; surface.vertices.len()];
        let mut mesh = Self {
            position: Vec::new(),
            normal: Vec::new(),
            area: Vec::new(),
            rim_distance: Vec::new(),
            triangles: Vec::new(),
        };
        for t in (0..surface.triangles.len()).filter(|&t| is_wall(t)) {
            let corners = surface.triangles[t].map(|v| {
                let number = &mut number[v as usize];
                if *number == u32::MAX {
                    let x = surface.vertices[v as usize];
                    *number = mesh.position.len() as u32;
                    mesh.position.push(x);
                    mesh.normal.push(normals.at(t, x));
                }
                *number
            });
            mesh.triangles.push(corners);
        }
        for _ in 0..MOST_ROUNDS {
            if !mesh.split(LONGEST_EDGE * spacing) {
                break;
            }
        }
        mesh.area = mesh.areas();
        let (rim, reach) = (Rim::new(vessel), RIM_REACH * spacing);
        mesh.rim_distance = (&mesh.position[..], &mesh.normal[..])
            .into_par_iter()
            .map(|(x, normal)| rim.query(*x, *normal, reach).map_or(reach, |nearest| nearest.distance))
            .collect();
        mesh
    }

    /// Splits every edge longer than `longest` \[m\] at its middle; tells whether there was one.
    fn split(&mut self, longest: f64) -> bool {
        let mut edges: Vec<[u32; 2]> =
            self.triangles.iter().flat_map(|t| sides(*t).map(undirected)).collect();
        edges.retain(|[a, b]| {
            self.position[*a as usize].distance_squared(self.position[*b as usize]) > longest * longest
        });
        edges.sort_unstable();
        edges.dedup();
        let first = self.position.len() as u32;
        for [a, b] in edges.iter().map(|edge| edge.map(|v| v as usize)) {
            self.position.push(0.5 * (self.position[a] + self.position[b]));
            let sum = self.normal[a] + self.normal[b];
            self.normal.push(sum.try_normalize().unwrap_or(self.normal[a]));
        }
        let middle =
            |side: [u32; 2]| edges.binary_search(&undirected(side)).ok().map(|place| first + place as u32);
        let mut triangles = Vec::with_capacity(self.triangles.len() + 2 * edges.len());
        for &triangle in &self.triangles {
            self.divide(triangle, sides(triangle).map(middle), &mut triangles);
        }
        self.triangles = triangles;
        !edges.is_empty()
    }

    /// Puts the parts of a triangle whose sides have the given middles into `out`.
    fn divide(&self, triangle: [u32; 3], middle: [Option<u32>; 3], out: &mut Vec<[u32; 3]>) {
        let turned = |k: usize| [triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]];
        match middle {
            [None, None, None] => out.push(triangle),
            [Some(ab), Some(bc), Some(ca)] => {
                let [a, b, c] = triangle;
                out.extend([[a, ab, ca], [ab, b, bc], [bc, c, ca], [ab, bc, ca]]);
            }
            [Some(m), None, None] => self.halve(turned(0), m, out),
            [None, Some(m), None] => self.halve(turned(1), m, out),
            [None, None, Some(m)] => self.halve(turned(2), m, out),
            [None, Some(m), Some(n)] => self.cut_corner(turned(0), m, n, out),
            [Some(n), None, Some(m)] => self.cut_corner(turned(1), m, n, out),
            [Some(m), Some(n), None] => self.cut_corner(turned(2), m, n, out),
        }
    }

    /// Triangle a b c with the middle m of its side a b.
    fn halve(&self, [a, b, c]: [u32; 3], m: u32, out: &mut Vec<[u32; 3]>) {
        out.extend([[a, m, c], [m, b, c]]);
    }

    /// Triangle a b c with the middles m of its side b c and n of c a.
    fn cut_corner(&self, [a, b, c]: [u32; 3], m: u32, n: u32, out: &mut Vec<[u32; 3]>) {
        let length = |p: u32, q: u32| self.position[p as usize].distance_squared(self.position[q as usize]);
        out.push([n, m, c]);
        if length(a, m) <= length(b, n) {
            out.extend([[a, b, m], [a, m, n]]);
        } else {
            out.extend([[a, b, n], [b, m, n]]);
        }
    }

    fn areas(&self) -> Vec<f64> {
        let mut area = vec![0.0; self.position.len()];
        for t in &self.triangles {
            let [a, b, c] = t.map(|v| self.position[v as usize]);
            let third = (b - a).cross(c - a).length() / 6.0;
            for &v in t {
                area[v as usize] += third;
            }
        }
        area
    }
}

fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn undirected([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_geometry::{LengthUnit, prepare, shapes};

    #[test]
    fn a_refined_wall_keeps_its_area_and_its_edges_short() {
        let pipe = shapes::pipe(2.0, 8.0, DVec3::new(1.0, 2.0, 3.0), 24);
        let vessel = prepare(pipe, Some(LengthUnit::Millimetre)).expect("a pipe");
        let spacing = 0.2e-3;
        let mesh = WallMesh::new(&vessel, spacing);
        let longest = mesh.triangles.iter().flat_map(|t| sides(*t)).fold(0.0_f64, |longest, [a, b]| {
            longest.max(mesh.position[a as usize].distance(mesh.position[b as usize]))
        });
        assert!(longest <= 1.5 * spacing && longest > 0.75 * spacing, "{longest}");
        assert!((mesh.area.iter().sum::<f64>() / vessel.wall_area() - 1.0).abs() < 1e-12);
        assert!(mesh.normal.iter().all(|n| (n.length() - 1.0).abs() < 1e-12));
        let axis = DVec3::new(1.0, 2.0, 3.0).normalize();
        for (x, rim) in mesh.position.iter().zip(&mesh.rim_distance) {
            let z = x.dot(axis);
            let exact = z.min(8e-3 - z).min(10.0 * spacing);
            assert!((rim - exact).abs() < 1e-6, "{rim} at {z}");
        }
    }

    /// A closed border and no hole inside: each edge has two triangles, but for those at the two rims.
    #[test]
    fn splitting_leaves_no_gap() {
        let vessel = prepare(shapes::pipe(2.0, 8.0, DVec3::Z, 24), Some(LengthUnit::Metre)).expect("a pipe");
        let mesh = WallMesh::new(&vessel, 0.35);
        let mut edges: Vec<[u32; 2]> = mesh.triangles.iter().flat_map(|t| sides(*t)).collect();
        edges.sort_unstable();
        let single = edges.iter().filter(|[a, b]| edges.binary_search(&[*b, *a]).is_err());
        assert!(single.clone().all(|[a, b]| {
            let [p, q] = [*a, *b].map(|v| mesh.position[v as usize].z);
            (p - q).abs() < 1e-12 && (p.abs() < 1e-12 || (p - 8.0).abs() < 1e-12)
        }));
        assert_eq!(single.count() % 24, 0);
        let length = edges.len();
        edges.dedup();
        assert_eq!(edges.len(), length, "every side is used once in each direction");
    }
}
