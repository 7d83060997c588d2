//! A carotid bifurcation from a handful of diameters and angles.
//!
//! The wall is that of an implicit union of three tubes ([`Junction`]). Its triangles start from a template: the
//! tubes meet at three seams, half rings between two common poles, and from the ring of two seams each branch
//! runs in rows to its flat end. Exchanging diagonals and moving vertices along the wall evens them out.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{
    even::even_out,
    implicit::Implicit,
    junction::{Branch, Junction},
    rings::{add_vertices, fill_disc, stitch_alternating},
};
use crate::surface::Surface;

/// Fewest points around a branch; a multiple of 4, so that half rings have a middle.
const MIN_SEGMENTS: usize = 16;
/// Distance from the crossing at which the external artery has its own radius, in radii of the common one.
const FUNNEL: f64 = 3.0;
/// Dimensions of a carotid bifurcation: the common carotid artery splits in a plane into the internal one, with
/// a sinus (bulb) at its root, and the external one. Lengths in any one unit.
///
/// The form is that of the glass model of Bharadvaj, Mabon and Giddens, "Steady flow in a model of the human
/// carotid bifurcation. Part I: flow visualization", J. Biomech. 15 (1982) 349-362, whose branches part at 25
/// degrees each. The diameters of the default are means of 92 people by computed tomography, those up to 40
/// years of age ("Imaging-anatomic measurements of carotid artery bifurcation", West Indian Med. J. (2015),
/// article 2441): common artery 6.82 mm, internal artery 7.14 mm at its root, 7.57 mm in the sinus and 4.90 mm
/// beyond, external artery 4.32 mm. The lengths are chosen. The default is in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BifurcationSpec {
    /// Radius of the common artery.
    pub common_radius: f64,
    /// Radius of the internal artery where the sinus begins.
    pub sinus_entry_radius: f64,
    /// Largest radius of the sinus.
    pub sinus_radius: f64,
    /// Radius of the internal artery beyond the sinus.
    pub internal_radius: f64,
    /// Radius of the external artery, beyond a funnel of three radii of the common one.
    pub external_radius: f64,
    /// Angle between the axes of the common and the internal artery \[rad\].
    pub internal_angle: f64,
    /// Angle between the axes of the common and the external artery \[rad\].
    pub external_angle: f64,
    /// Distance from the crossing of the axes to the widest place of the sinus.
    pub sinus_distance: f64,
    /// Distance from the crossing of the axes to the end of the sinus.
    pub sinus_length: f64,
    /// Length of the common artery up to the crossing of the axes.
    pub common_length: f64,
    /// Length of the internal artery from there.
    pub internal_length: f64,
    /// Length of the external artery from there.
    pub external_length: f64,
    /// Width over which the branches blend into each other where they meet at an angle.
    pub blend: f64,
    /// Edge length of the triangles.
    pub edge: f64,
}

impl Default for BifurcationSpec {
    fn default() -> Self {
        BifurcationSpec {
            common_radius: 3.41e-3,
            sinus_entry_radius: 3.57e-3,
            sinus_radius: 3.785e-3,
            internal_radius: 2.45e-3,
            external_radius: 2.16e-3,
            internal_angle: 25f64.to_radians(),
            external_angle: 25f64.to_radians(),
            sinus_distance: 6e-3,
            sinus_length: 16e-3,
            common_length: 25e-3,
            internal_length: 32e-3,
            external_length: 28e-3,
            blend: 3e-3,
            edge: 0.5e-3,
        }
    }
}

/// The surface of a carotid bifurcation, closed by flat round caps at right angles to each branch.
///
/// The axes cross at the origin; the common artery lies along -z, the internal one leans towards +x and the
/// external one towards -x. Every branch has the same number of triangles around it, whose edges are about
/// [`edge`](BifurcationSpec::edge) long on the common artery.
///
/// # Panics
/// When a length is not positive, an angle not between 0 and 90 degrees, or a branch so short that the
/// junction reaches its end.
pub fn bifurcation(spec: &BifurcationSpec) -> Surface {
    let junction = junction(spec);
    let around = TAU * spec.common_radius / spec.edge;
    let segments = ((around / 4.0).round() as usize * 4).max(MIN_SEGMENTS);
    let mut surface = Surface::default();
    let seams = seams(&junction, segments, &mut surface);
    let mut fixed = Vec::new();
    let mut caps = Vec::new();
    for k in 0..3 {
        // The seam to the next branch, and back along the seam to the one before.
        let (next, before) = (&seams[k], &seams[(k + 2) % 3]);
        let first: Vec<u32> =
            next.iter().copied().chain(before[1..before.len() - 1].iter().rev().copied()).collect();
        let last = wall(&junction.branches[k], &junction, &first, &mut surface);
        fixed.extend(&last);
        caps.push((last, junction.branches[k].length * junction.branches[k].along));
    }
    even_out(&junction, &fixed, &mut surface);
    for (border, center) in caps {
        fill_disc(&mut surface, &border, center);
    }
    surface
}

/// Puts the branches together, after a look at the numbers.
fn junction(spec: &BifurcationSpec) -> Junction {
    let BifurcationSpec { common_radius, sinus_entry_radius, sinus_radius, internal_radius, .. } = *spec;
    let BifurcationSpec { external_radius, internal_angle, external_angle, sinus_distance, .. } = *spec;
    let lengths = [
        common_radius,
        sinus_entry_radius,
        sinus_radius,
        internal_radius,
        external_radius,
        sinus_distance,
        spec.sinus_length - sinus_distance,
        spec.common_length,
        spec.internal_length,
        spec.external_length,
        spec.blend,
        spec.edge,
    ];
    assert!(lengths.iter().all(|&l| l > 0.0 && l.is_finite()), "lengths must be positive and grow: {spec:?}");
    let right_angle = 0.25 * TAU;
    for angle in [internal_angle, external_angle] {
        assert!(angle > 0.0 && angle < right_angle, "angles must lie between 0 and 90 degrees: {spec:?}");
    }
    let sinus =
        vec![(0.0, sinus_entry_radius), (sinus_distance, sinus_radius), (spec.sinus_length, internal_radius)];
    // As wide as the common artery at the crossing: a thin tube alone would leave a dent beside its root.
    let funnel = vec![(0.0, common_radius), (FUNNEL * common_radius, external_radius)];
    let lean = |angle: f64| DVec3::new(angle.sin(), 0.0, angle.cos());
    let branches = [
        Branch { along: DVec3::NEG_Z, length: spec.common_length, radii: vec![(0.0, common_radius)] },
        Branch { along: lean(internal_angle), length: spec.internal_length, radii: sinus },
        Branch { along: lean(-external_angle), length: spec.external_length, radii: funnel },
    ];
    let junction = Junction { branches, blend: spec.blend };
    for branch in &junction.branches {
        let [first, second] = branch.across();
        for i in 0..16 {
            let (sin, cos) = (f64::from(i) * TAU / 16.0).sin_cos();
            let radius = branch.radius(branch.length);
            let rim = branch.length * branch.along + radius * (cos * first + sin * second);
            let gap = junction.field(rim).abs();
            assert!(gap < 1e-9 * radius, "the junction reaches the end of a branch: {spec:?}");
        }
    }
    junction
}

/// The three seams along which the branches meet, as vertex numbers: half rings from the pole on the +y side of
/// the wall to that on the -y side. Seam k lies between branch k and the next.
fn seams(junction: &Junction, segments: usize, surface: &mut Surface) -> [Vec<u32>; 3] {
    let half = segments / 2;
    let pole = |y: DVec3| junction.hit(DVec3::ZERO, y);
    let poles = add_vertices(surface, [pole(DVec3::Y), pole(DVec3::NEG_Y)].into_iter());
    [0, 1, 2].map(|k| {
        let middle = (junction.branches[k].along + junction.branches[(k + 1) % 3].along).normalize();
        let at = |part: f64| {
            let (sin, cos) = (0.5 * TAU * part).sin_cos();
            junction.hit(DVec3::ZERO, cos * DVec3::Y + sin * middle)
        };
        // The seam over the flow divider is long: equal angles would space its points unequally.
        let fine: Vec<DVec3> = (0..=8 * half).map(|i| at(i as f64 / (8 * half) as f64)).collect();
        let mut length = vec![0.0];
        for pair in fine.windows(2) {
            length.push(length[length.len() - 1] + pair[0].distance(pair[1]));
        }
        let places = (1..half).map(|i| {
            let wanted = length[8 * half] * i as f64 / half as f64;
            let after = length.partition_point(|&l| l < wanted).clamp(1, 8 * half);
            let part = (wanted - length[after - 1]) / (length[after] - length[after - 1]);
            at((after as f64 - 1.0 + part) / (8 * half) as f64)
        });
        let inner = add_vertices(surface, places);
        [&poles[..1], &inner, &poles[1..]].concat()
    })
}

/// Adds the wall of a branch from its ring at the junction to its flat, round end; returns the ring there.
fn wall(branch: &Branch, junction: &Junction, first: &[u32], surface: &mut Surface) -> Vec<u32> {
    let segments = first.len();
    let [up, side] = branch.across();
    // Place along the axis and angle around it of each point of the ring at the junction.
    let starts: Vec<(f64, f64)> = first
        .iter()
        .enumerate()
        .map(|(j, &v)| {
            let x = surface.vertices[v as usize];
            let even = j as f64 / segments as f64 * TAU;
            let angle = x.dot(side).atan2(x.dot(up));
            // The whole turns that bring the angle next to that of an even spacing.
            (x.dot(branch.along), angle + TAU * ((even - angle) / TAU).round())
        })
        .collect();
    let mean_start = starts.iter().map(|s| s.0).sum::<f64>() / segments as f64;
    let edge = TAU * branch.radius(branch.length) / segments as f64;
    let rows = ((branch.length - mean_start) / edge).round().max(2.0) as usize;
    let mut ring = first.to_vec();
    for row in 1..=rows {
        let part = row as f64 / rows as f64;
        let places = starts.iter().enumerate().map(|(j, &(start, angle))| {
            let even = j as f64 / segments as f64 * TAU;
            let (sin, cos) = (angle + (even - angle) * part).sin_cos();
            let out = cos * up + sin * side;
            let s = start + (branch.length - start) * part;
            if row == rows {
                s * branch.along + branch.radius(branch.length) * out
            } else {
                junction.hit(s * branch.along, out)
            }
        });
        let places: Vec<DVec3> = places.collect();
        let next = add_vertices(surface, places.into_iter());
        stitch_alternating(surface, &ring, &next, row);
        ring = next;
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LengthUnit, prepare};

    fn spec() -> BifurcationSpec {
        BifurcationSpec { edge: 0.6e-3, ..BifurcationSpec::default() }
    }

    #[test]
    fn caps_are_round_flat_and_where_the_spec_says() {
        let spec = spec();
        let surface = bifurcation(&spec);
        let vessel = prepare(surface.clone(), Some(LengthUnit::Metre)).expect("a clean surface");
        assert!(vessel.audit.watertight && vessel.audit.repairs.is_empty(), "{:?}", vessel.audit);
        assert_eq!(vessel.surface, surface);
        let lean = |angle: f64| DVec3::new(angle.sin(), 0.0, angle.cos());
        let ends = [
            (DVec3::NEG_Z, spec.common_length, spec.common_radius),
            (lean(spec.internal_angle), spec.internal_length, spec.internal_radius),
            (lean(-spec.external_angle), spec.external_length, spec.external_radius),
        ];
        assert_eq!(vessel.openings.len(), 3);
        for (opening, (along, length, radius)) in vessel.openings.iter().zip(ends) {
            assert!(opening.center.distance(length * along) < 1e-9);
            assert!(opening.normal.distance(along) < 1e-9);
            // A polygon of n corners on the circle.
            let n = opening.polygon.len() as f64;
            let polygon = (0.5 * n * (TAU / n).sin() / (0.5 * TAU)).sqrt();
            assert!((opening.radius / (radius * polygon) - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn triangles_are_well_shaped_and_of_the_size_asked_for() {
        let spec = spec();
        let surface = bifurcation(&spec);
        let (mut worst, mut sum, mut longest_edge) = (1.0_f64, 0.0, 0.0_f64);
        for t in 0..surface.triangles.len() {
            let [a, b, c] = surface.triangle(t);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            longest_edge = longest_edge.max(longest);
            // 1 for equilateral triangles, 0.58 for half a square.
            let quality = 4.0 / 3f64.sqrt() * surface.triangle_area(t) / longest.powi(2);
            worst = worst.min(quality);
            sum += quality;
        }
        let mean = sum / surface.triangles.len() as f64;
        assert!(worst > 0.3 && mean > 0.75, "worst {worst}, mean {mean}");
        assert!(longest_edge < 2.5 * spec.edge, "longest edge {longest_edge}");
    }

    #[test]
    fn neighbouring_triangles_meet_smoothly_off_the_rims() {
        let surface = bifurcation(&spec());
        let vessel = prepare(surface, Some(LengthUnit::Metre)).expect("a clean surface");
        let edges = crate::repair::edges::Edges::new(&vessel.surface.triangles);
        for group in edges.groups() {
            let [a, b] = [group[0].triangle as usize, group[1].triangle as usize];
            if vessel.face_opening[a].is_some() || vessel.face_opening[b].is_some() {
                continue;
            }
            let normals = [a, b].map(|t| vessel.surface.triangle_normal(t));
            let angle = normals[0].angle_between(normals[1]).to_degrees();
            assert!(angle < 45.0, "{angle} degrees at {}", vessel.surface.triangle(a)[0]);
        }
    }

    #[test]
    fn sinus_is_the_widest_place_of_the_internal_artery() {
        let spec = spec();
        let junction = junction(&spec);
        let internal = &junction.branches[1];
        let outside = internal.along.cross(DVec3::Y) * -1.0;
        for (s, radius) in
            [(spec.sinus_distance, spec.sinus_radius), (spec.sinus_length, spec.internal_radius)]
        {
            let hit = junction.hit(s * internal.along, outside);
            assert!((hit.distance(s * internal.along) / radius - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    #[should_panic(expected = "reaches the end")]
    fn a_branch_too_short_is_refused() {
        bifurcation(&BifurcationSpec { external_length: 5e-3, ..BifurcationSpec::default() });
    }
}
