//! The mesh of a wall that deforms: its points, carried along by the particles of the wall.

use crate::wall::anchors::Anchors;
use crate::wall::mesh::WallMesh;
use crate::wall::shear::outer;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_geometry::{SignedDistance, Surface};
use vaso_particles::WallView;

/// A mesh that goes where the particles of a wall go.
#[derive(Clone, Debug)]
pub struct CarriedWall {
    anchors: Anchors,
    /// Normals at rest.
    normal: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Inverse of the edges and the normal of each triangle at rest.
    inverse: Vec<DMat3>,
    /// Triangles at each point, and where those of a point begin.
    around: Vec<u32>,
    start: Vec<u32>,
}

/// Where a wall stands, and how it moves.
#[derive(Clone, Debug, PartialEq)]
pub struct WallPose {
    /// Points \[m\].
    pub position: Vec<DVec3>,
    /// Unit normal at each, out of the lumen.
    pub normal: Vec<DVec3>,
    /// Turning of the wall at each since it was at rest: the rotation of its deformation gradient.
    pub rotation: Vec<DMat3>,
    /// Velocity of each \[m/s\].
    pub velocity: Vec<DVec3>,
    /// Derivative of the velocity along the wall, `G[i][j] = d v_i / d x_j`, and across it the rate of the normal \[1/s\].
    pub gradient: Vec<DMat3>,
}

impl CarriedWall {
    /// `mesh`, carried by the particles that `view` shows where they were when it was taken, at a `spacing` \[m\]; `distance` is that to its
    /// surface.
    pub fn new(mesh: &WallMesh, view: &WallView, distance: &SignedDistance, spacing: f64) -> Self {
        let triangles = mesh.triangles.clone();
        let inverse = triangles
            .iter()
            .map(|t| {
                let frame = frame(&mesh.position, t);
                // A triangle without area tells nothing, and counts for nothing.
                if frame.determinant() > 0.0 { frame.inverse() } else { DMat3::ZERO }
            })
            .collect();
        let (start, around) = incidence(mesh.position.len(), &triangles);
        Self {
            anchors: Anchors::new(&mesh.position, &mesh.normal, view, distance, spacing),
            normal: mesh.normal.clone(),
            triangles,
            inverse,
            around,
            start,
        }
    }

    /// Where the mesh stands with the particles at those of `view`, which are as many and in the same order.
    pub fn pose(&self, view: &WallView) -> WallPose {
        let position = self.anchors.places(view.position);
        let velocity = self.anchors.means(view.velocity);
        let local: Vec<(DMat3, DMat3, f64)> = (&self.triangles, &self.inverse)
            .into_par_iter()
            .with_min_len(1024)
            .map(|(t, inverse)| {
                let now = frame(&position, t);
                let area = now.determinant();
                if area <= 0.0 || *inverse == DMat3::ZERO {
                    return (DMat3::ZERO, DMat3::ZERO, 0.0);
                }
                let [a, b, c] = t.map(|v| velocity[v as usize]);
                let along = DMat3::from_cols(b - a, c - a, DVec3::ZERO) * now.inverse();
                // Across the wall the turning of its normal: facets that meet at an angle then agree where all turn alike.
                let tilt = along.transpose() * now.z_axis;
                (area * (now * *inverse), area * (along - outer(tilt, now.z_axis)), area)
            })
            .collect();
        let at = |k: usize| {
            let around = &self.around[self.start[k] as usize..self.start[k + 1] as usize];
            let (mut gradient, mut rate, mut area) = (DMat3::ZERO, DMat3::ZERO, 0.0);
            for &t in around {
                let (g, r, a) = local[t as usize];
                (gradient, rate, area) = (gradient + g, rate + r, area + a);
            }
            if area > 0.0 {
                (rotation(gradient * area.recip()), rate * area.recip())
            } else {
                (DMat3::IDENTITY, DMat3::ZERO)
            }
        };
        let (rotation, gradient): (Vec<DMat3>, Vec<DMat3>) =
            (0..position.len()).into_par_iter().with_min_len(1024).map(at).unzip();
        let normal = self.normal.iter().zip(&rotation).map(|(n, turn)| (*turn * *n).normalize()).collect();
        WallPose { position, normal, rotation, velocity, gradient }
    }

    /// Exact distance to the wall as it stands in `pose`.
    pub fn distance(&self, pose: &WallPose) -> SignedDistance {
        SignedDistance::sheet(&Surface { vertices: pose.position.clone(), triangles: self.triangles.clone() })
    }
}

/// Two edges of a triangle and its unit normal; their determinant is twice its area.
fn frame(position: &[DVec3], t: &[u32; 3]) -> DMat3 {
    let [a, b, c] = t.map(|v| position[v as usize]);
    let (u, v) = (b - a, c - a);
    DMat3::from_cols(u, v, u.cross(v).normalize_or_zero())
}

/// Triangles at each point: where those of each point begin, one more than there are points, and the triangles in this order.
fn incidence(n: usize, triangles: &[[u32; 3]]) -> (Vec<u32>, Vec<u32>) {
    let mut start = vec![0_u32; n + 1];
    triangles.iter().flatten().for_each(|&v| start[v as usize + 1] += 1);
    for k in 0..n {
        start[k + 1] += start[k];
    }
    let mut next = start.clone();
    let mut around = vec![0; 3 * triangles.len()];
    for (number, t) in triangles.iter().enumerate() {
        for &v in t {
            around[next[v as usize] as usize] = number as u32;
            next[v as usize] += 1;
        }
    }
    (start, around)
}

/// Rotation of a deformation gradient by Newton's iteration for the polar decomposition (Higham 1986); none where it turns the inside out.
fn rotation(gradient: DMat3) -> DMat3 {
    if gradient.determinant() <= 0.0 {
        return DMat3::IDENTITY;
    }
    let mut turn = gradient;
    for _ in 0..20 {
        let next = (turn + turn.inverse().transpose()) * 0.5;
        let is_there = next.abs_diff_eq(turn, 1e-14);
        turn = next;
        if is_there {
            break;
        }
    }
    turn
}
