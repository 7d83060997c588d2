//! Caps that are part of the surface: flat regions that end a tube.

use std::collections::VecDeque;

use glam::DVec3;

use crate::{
    audit::{FlatRegion, Rejection},
    close::MIN_CAP_AREA,
    corner::Corner,
    opening::Opening,
    polygon,
    repair::{
        edges::{Edges, NONE},
        loops,
    },
    surface::Surface,
    winding::WindingTree,
};

/// Largest angle between the normals of the triangles of a cap and of its seed \[degrees\].
const FLAT_DEGREES: f64 = 2.0;
/// The same to the mean plane of the cap, which a few facets at its rim may leave.
const RIM_DEGREES: f64 = 10.0;
/// Largest distance of the vertices of a cap from its plane, as part of the diagonal of the surface.
const FLAT_DISTANCE: f64 = 1e-3;
/// Within this part of the diagonal a triangle counts as lying in the plane whatever its normal: the normals
/// of slivers are rounding errors of their single-precision coordinates.
const EXACT_DISTANCE: f64 = 1e-6;
/// Smallest 4 pi A / P^2 of a cap: an ellipse of 1 : 3 has 0.6.
const MIN_CIRCULARITY: f64 = 0.6;
/// Number of places tested on each side of a cap, and how many may fail.
const SAMPLES: usize = 16;
const MAX_FAILED_SAMPLES: usize = 2;

/// Most regions looked at for a tube behind them, the largest: in a heap of parts that overlap every look visits every
/// triangle. Vessels have some hundred ends at most.
const MAX_TUBES: usize = 256;
/// Number of flat regions listed that are no caps: the largest.
const MAX_LISTED: usize = 16;

/// A cap found on the surface.
pub(crate) struct Cap {
    pub(crate) opening: Opening,
    pub(crate) triangles: Vec<usize>,
}

/// Finds the caps among the triangles not yet taken, and lists the flat regions considered.
pub(crate) fn find(surface: &Surface, taken: &[bool]) -> (Vec<Cap>, Vec<FlatRegion>) {
    let n = surface.triangles.len();
    let across = Edges::new(&surface.triangles).neighbours(n);
    let corners: Vec<[DVec3; 3]> = (0..n).map(|t| surface.triangle(t)).collect();
    let tree = WindingTree::new(&corners);
    let min_area = MIN_CAP_AREA * surface.area();
    let mut finder = Finder {
        surface,
        across,
        diagonal: surface.diagonal(),
        done: taken.to_vec(),
        seen: vec![0; n],
        flood: 0,
    };
    let mut seeds: Vec<usize> = (0..n).collect();
    seeds.sort_by(|&a, &b| surface.triangle_area(b).total_cmp(&surface.triangle_area(a)));
    let mut judged = Vec::new();
    for seed in seeds {
        if finder.done[seed] {
            continue;
        }
        let triangles = finder.grow(seed);
        triangles.iter().for_each(|&t| finder.done[t] = true);
        let area: f64 = triangles.iter().map(|&t| surface.triangle_area(t)).sum();
        if area < min_area {
            continue;
        }
        judged.extend(finder.judge(&triangles).map(|(opening, region)| (opening, region, triangles)));
    }
    let mut areas: Vec<f64> =
        judged.iter().filter(|(_, r, _)| r.rejected.is_none()).map(|(_, r, _)| r.area).collect();
    areas.sort_by(|a, b| b.total_cmp(a));
    let least = areas.get(MAX_TUBES).copied().unwrap_or(0.0);
    let (mut caps, mut regions) = (Vec::new(), Vec::new());
    for (opening, mut region, triangles) in judged {
        if region.rejected.is_none() {
            region.rejected = if region.area <= least {
                Some(Rejection::TooManyLarger)
            } else if !ends_a_tube(&opening, &tree) {
                Some(Rejection::NoTubeBehind)
            } else {
                None
            };
        }
        if region.rejected.is_none() {
            caps.push(Cap { opening, triangles });
        }
        if region.rejected != Some(Rejection::NotRound) {
            regions.push(region);
        }
    }
    regions.sort_by(|a, b| b.area.total_cmp(&a.area));
    regions.truncate(caps.len() + MAX_LISTED);
    (caps, regions)
}

struct Finder<'a> {
    surface: &'a Surface,
    across: Vec<[u32; 3]>,
    diagonal: f64,
    /// Triangles that belong to an opening already, or to a region that was judged.
    done: Vec<bool>,
    /// For each triangle the number of the last flood that reached it.
    seen: Vec<u32>,
    flood: u32,
}

impl Finder<'_> {
    /// The flat region around a triangle: first by the plane of the seed, then by the mean plane of what
    /// that found, which the seed's own rounding errors do not tilt.
    ///
    /// Seeds are taken by falling area, so a cap is found from its largest triangle. Each triangle is judged
    /// once: one that belongs to a flat part of the wall does not belong to a cap.
    fn grow(&mut self, seed: usize) -> Vec<usize> {
        let normal = self.surface.triangle_normal(seed);
        if normal == DVec3::ZERO {
            return vec![seed];
        }
        let rough = self.flood(seed, normal, self.surface.triangle(seed)[0], FLAT_DEGREES);
        let area_vector: DVec3 = rough.iter().map(|&t| self.surface.area_vector(t)).sum();
        let (mut weight, mut moment) = (0.0, DVec3::ZERO);
        for &t in &rough {
            let area = self.surface.triangle_area(t);
            weight += area;
            moment += area * self.surface.triangle(t).iter().sum::<DVec3>() / 3.0;
        }
        match area_vector.try_normalize() {
            Some(mean) => self.flood(seed, mean, moment / weight, RIM_DEGREES),
            None => rough,
        }
    }

    fn flood(&mut self, seed: usize, normal: DVec3, place: DVec3, degrees: f64) -> Vec<usize> {
        self.flood += 1;
        self.seen[seed] = self.flood;
        let mut region = vec![seed];
        let mut front = VecDeque::from([seed]);
        while let Some(t) = front.pop_front() {
            for next in self.across[t].into_iter().filter(|&n| n != NONE).map(|n| n as usize) {
                if self.seen[next] < self.flood
                    && !self.done[next]
                    && self.lies_in(next, normal, place, degrees)
                {
                    self.seen[next] = self.flood;
                    region.push(next);
                    front.push_back(next);
                }
            }
        }
        region
    }

    /// Whether a triangle lies in a plane, up to the tolerances of a cap.
    fn lies_in(&self, t: usize, normal: DVec3, place: DVec3, degrees: f64) -> bool {
        let corners = self.surface.triangle(t);
        let off = corners.iter().map(|&p| (p - place).dot(normal).abs()).fold(0.0, f64::max);
        off <= EXACT_DISTANCE * self.diagonal
            || (off <= FLAT_DISTANCE * self.diagonal
                && self.surface.triangle_normal(t).dot(normal) >= degrees.to_radians().cos())
    }

    /// Measures a region and decides whether it can be a cap by itself. `None` when it has no border at all.
    fn judge(&self, triangles: &[usize]) -> Option<(Opening, FlatRegion)> {
        let own: Vec<[u32; 3]> = triangles.iter().map(|&t| self.surface.triangles[t]).collect();
        let edges = Edges::new(&own);
        let mut loops = loops::chain(&edges.border());
        let one_border = loops.len() == 1;
        loops.sort_by_key(Vec::len);
        let points: Vec<DVec3> = loops.pop()?.iter().map(|&v| self.surface.vertices[v as usize]).collect();
        let opening = Opening::from_loop(&points)?;
        let circularity =
            4.0 * std::f64::consts::PI * opening.area / polygon::perimeter(&opening.polygon).powi(2);
        let corner = self.corner(triangles, &edges, opening.normal);
        let rejected = if circularity < MIN_CIRCULARITY {
            Some(Rejection::NotRound)
        } else if !one_border {
            Some(Rejection::SeveralBorders)
        } else if !corner.is_rim() {
            Some(Rejection::NoCorner)
        } else {
            None
        };
        let region = FlatRegion {
            center: opening.center,
            normal: opening.normal,
            area: opening.area,
            circularity,
            border_angle: corner.mean,
            rejected,
        };
        Some((opening, region))
    }

    /// The corner between a region and the triangles just outside it.
    fn corner(&self, triangles: &[usize], edges: &Edges, normal: DVec3) -> Corner {
        let mut border = Vec::new();
        for group in edges.groups() {
            let [side] = group else { continue };
            let t = triangles[side.triangle as usize];
            let outside = self.across[t][side.corner as usize];
            if outside != NONE {
                let [a, b] = side.directed().map(|v| self.surface.vertices[v as usize]);
                border.push((a.distance(b), self.surface.triangle_normal(outside as usize)));
            }
        }
        Corner::between(normal, &border)
    }
}

/// Whether the lumen lies behind a cap and nothing in front of it, half a radius away from its plane.
fn ends_a_tube(opening: &Opening, tree: &WindingTree) -> bool {
    let half = 0.5 * opening.radius;
    let failed = (0..SAMPLES)
        .filter(|&i| {
            let angle = i as f64 * std::f64::consts::TAU / SAMPLES as f64;
            let lateral = half * (angle.cos() * opening.axes[0] + angle.sin() * opening.axes[1]);
            let behind = opening.center + lateral - half * opening.normal;
            let before = opening.center + lateral + half * opening.normal;
            !tree.contains(behind) || tree.contains(before)
        })
        .count();
    failed <= MAX_FAILED_SAMPLES
}
