//! A section of the lumen, and the map of the unit disc onto it.

use super::tfi::{self, Grid};
use super::topology::{Node, Projection, Wireframe};
use super::winslow;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use vaso_geometry::SignedDistance;

/// Rays that find the border; a multiple of four, so that some run along the hinge.
const RAYS: usize = 96;
const QUARTER: usize = RAYS / 4;
/// Most by which the border may be farther on one ray than on the next: beyond, it is another branch.
const JUMP: f64 = 1.5;
/// Most by which a projected point may be off the border found by rays, in distances between the two.
const MISS: f64 = 0.25;

/// A plane through `origin`, or two half planes that meet in the line through it along `y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub(super) origin: DVec3,
    /// Unit vector along the hinge.
    pub(super) y: DVec3,
    /// Unit vectors across the hinge, in the half planes of positive and negative first coordinate.
    pub(super) right: DVec3,
    pub(super) left: DVec3,
    /// How far the halves are held to be the halves of the disc: 1 at a junction, 0 on a plane.
    pub(super) bend: f64,
    /// How far the centre may leave the hinge: 0 where there is one, 1 where there is none.
    pub(super) freedom: f64,
}

impl Plane {
    /// The point with coordinates `p` \[m\].
    pub(super) fn place(&self, p: DVec2) -> DVec3 {
        let side = if p.x < 0.0 { self.left } else { self.right };
        self.origin + p.x.abs() * side + p.y * self.y
    }
}

/// The part of a plane that lies in one branch of the lumen.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Section {
    pub(super) plane: Plane,
    /// Centre of the disc, in the plane \[m\].
    center: DVec2,
    /// Distance from the centre to the wall \[m\], by ray.
    radius: Vec<f64>,
    /// Angle on the disc of each ray \[rad\], and of the first again a turn later.
    turn: Vec<f64>,
    /// Area \[m^2\].
    pub(super) area: f64,
}

impl Section {
    /// The section in `plane`, which reaches no farther than `reach` \[m\]; `None` where it is not closed or
    /// not seen whole from its centre.
    pub(super) fn cut(plane: Plane, wall: &SignedDistance, reach: f64) -> Option<Self> {
        let radii = |center: DVec2| -> Option<Vec<f64>> {
            // A ray can slip through between triangles; one beside it, or in a plane beside, does not.
            let ray = |k: usize, aside: f64, before: f64| {
                let from = plane.place(center) + before * reach * plane.right.cross(plane.y);
                let to = plane.place(center + direction(k) + aside * direction(k).perp());
                wall.cast(from, (to - plane.place(center)).normalize(), reach)
            };
            const TRIES: [(f64, f64); 5] = [(0.0, 0.0), (1e-5, 0.0), (-1e-5, 0.0), (0.0, 1e-5), (0.0, -1e-5)];
            (0..RAYS).map(|k| TRIES.iter().find_map(|&(aside, before)| ray(k, aside, before))).collect()
        };
        let radius = radii(DVec2::ZERO)?;
        let along = 0.5 * (radius[QUARTER] - radius[3 * QUARTER]);
        let centroid = centroid(&radius);
        let center = DVec2::new(plane.freedom * centroid.x, along + plane.freedom * (centroid.y - along));
        let radius = radii(center)?;
        let next = |k: usize| radius[(k + 1) % RAYS];
        let jump = (0..RAYS).map(|k| (next(k) / radius[k]).max(radius[k] / next(k))).fold(1.0, f64::max);
        if jump > JUMP {
            return None;
        }
        let sector = |k: usize| {
            let (a, b) = (radius[k % RAYS], next(k % RAYS));
            (a * a + a * b + b * b) / 6.0 * (TAU / RAYS as f64)
        };
        let area = (0..RAYS).map(sector).sum();
        let turn = turns(sector, area, plane.bend);
        Some(Self { plane, center, radius, turn, area })
    }

    /// Points of the border in space \[m\], counter-clockwise about the direction `x` cross `y`.
    pub(super) fn border(&self) -> impl Iterator<Item = DVec3> + '_ {
        (0..RAYS).map(|k| self.plane.place(self.center + self.radius[k] * direction(k)))
    }

    pub(super) fn center(&self) -> DVec3 {
        self.plane.place(self.center)
    }

    /// Where the disc's `p` lies in the plane \[m\].
    ///
    /// Sectors of the disc become sectors of their share of the area, so that equal areas of the disc are
    /// equal areas of the section, whatever its form.
    fn point(&self, p: DVec2) -> DVec2 {
        let turn = self.turn[0] + (p.to_angle() - self.turn[0]).rem_euclid(TAU);
        let k = (self.turn.partition_point(|t| *t <= turn) - 1).min(RAYS - 1);
        let part = (turn - self.turn[k]) / (self.turn[k + 1] - self.turn[k]);
        let radius = self.radius[k] * (1.0 - part) + self.radius[(k + 1) % RAYS] * part;
        self.center + p.length() * radius * DVec2::from_angle(TAU * (k as f64 + part) / RAYS as f64)
    }

    /// Where a point of the wireframe meets the wall, in the plane \[m\], and whether it had to be placed by the
    /// rays instead.
    fn project(&self, projection: &Projection, wall: &SignedDistance) -> (DVec2, bool) {
        let (at, mut from) = (self.point(projection.at), self.point(projection.from));
        if at.x * from.x < 0.0 && self.plane.right != -self.plane.left {
            from = self.center;
        }
        let (start, end) = (self.plane.place(from), self.plane.place(at));
        let distance = start.distance(end);
        match wall.cast(start, (end - start) / distance, (1.0 + MISS) * distance) {
            Some(hit) if hit > (1.0 - MISS) * distance => (from + hit / distance * (at - from), false),
            _ => (at, true),
        }
    }

    /// Nodes of the blocks of `frame` in space \[m\], and how many points of the wall were not found by
    /// projection. With `sweeps` the inner nodes are smoothed.
    pub(super) fn nodes(
        &self,
        frame: &Wireframe,
        wall: &SignedDistance,
        sweeps: usize,
    ) -> (Vec<Grid<DVec3>>, usize) {
        let border: Vec<(DVec2, bool)> = frame.wall.iter().map(|w| self.project(w, wall)).collect();
        let place = |node: &Node| match *node {
            Node::Inner(p) => self.point(p),
            Node::Wall(k) => border[k].0,
        };
        let patch = |edges: &[Vec<Node>; 4]| {
            let [b, t, l, r] = &edges.each_ref().map(|e| e.iter().map(place).collect::<Vec<_>>());
            let mut face = tfi::face(b, t, l, r);
            winslow::smooth(&mut face, sweeps);
            Grid::new(face.cells(), |i, j, k| self.plane.place(face.at(i, j, k)))
        };
        let faces = frame.patches.iter().map(|p| patch(&p.edges)).collect();
        (faces, border.iter().filter(|b| b.1).count())
    }

    /// Volume between this section and the `next`, and that of the thinnest sector \[m^3\].
    pub(super) fn volume_to(&self, next: &Self) -> (f64, f64) {
        let (a, b): (Vec<DVec3>, Vec<DVec3>) = (self.border().collect(), next.border().collect());
        let (o, q) = (self.center(), next.center());
        let tetrahedron = |p: [DVec3; 4]| (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
        let sector = |k: usize| {
            let m = (k + 1) % RAYS;
            tetrahedron([o, a[k], a[m], q])
                + tetrahedron([a[k], a[m], q, b[m]])
                + tetrahedron([a[k], q, b[k], b[m]])
        };
        let sectors = (0..RAYS).map(sector);
        sectors.fold((0.0, f64::INFINITY), |(sum, least), v| (sum + v, least.min(v)))
    }
}

/// Unit vector of a ray.
fn direction(k: usize) -> DVec2 {
    // Along the hinge exactly, or the ray would lie in one of the halves.
    match k {
        k if k == QUARTER => DVec2::Y,
        k if k == 3 * QUARTER => DVec2::NEG_Y,
        k => DVec2::from_angle(TAU * k as f64 / RAYS as f64),
    }
}

fn centroid(radius: &[f64]) -> DVec2 {
    let area: f64 = radius.iter().map(|r| r * r / 2.0).sum();
    let moment: DVec2 = radius.iter().enumerate().map(|(k, r)| r * r * r / 3.0 * direction(k)).sum();
    moment / area
}

/// Angle on the disc of each ray by the area before it; for a `bend` of one the halves on either side of the
/// hinge are halves of the disc.
fn turns(sector: impl Fn(usize) -> f64, area: f64, bend: f64) -> Vec<f64> {
    let mut whole = vec![0.0];
    for k in 0..RAYS {
        whole.push(whole[k] + TAU * sector(k) / area);
    }
    // The turn that leaves the rays where they are on average.
    let angle = |k: usize| TAU * k as f64 / RAYS as f64;
    let shift = (0..RAYS).map(|k| angle(k) - whole[k]).sum::<f64>() / RAYS as f64;
    // From the hinge below, through the right half, to the hinge above, and on through the left one.
    let half = |start: usize| (start..start + RAYS / 2).map(|k| sector(k % RAYS)).sum::<f64>();
    let (right, left) = (half(3 * QUARTER), half(QUARTER));
    let mut halves = vec![0.0; RAYS + 1];
    let mut at = FRAC_PI_2;
    for k in QUARTER..QUARTER + RAYS {
        let index = k % RAYS;
        halves[index] = if k < RAYS { at } else { at - TAU };
        at += PI * sector(index) / if k < 3 * QUARTER { left } else { right };
    }
    halves[RAYS] = halves[0] + TAU;
    (0..=RAYS).map(|k| (1.0 - bend) * (whole[k] + shift) + bend * halves[k]).collect()
}
