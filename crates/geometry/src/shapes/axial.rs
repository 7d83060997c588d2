//! Bodies of revolution: a tube whose radius is given along its axis.

use std::f64::consts::TAU;

use glam::DVec3;

use super::rings::{Ring, tube};
use crate::surface::Surface;

/// Fewest points around a tube.
const MIN_SEGMENTS: usize = 6;

/// A tube about the z axis, closed by flat caps, whose wall is the polyline `meridian` of places along the axis and radii
/// turned about it. Lengths come out in the unit they are given in.
///
/// Each piece of the meridian is divided so that triangles are about as long as wide, and its ends stay; a smooth wall
/// is given by as many points as it wants triangles along. Two points at the same place with different radii make a step. There
/// are `segments` points around, at least 6, on circles: as in [`pipe`](super::pipe()), sections are polygons inside them.
///
/// # Panics
/// When there are fewer than two points, a radius is not positive, or a place comes before the one given before it.
pub fn axial(meridian: &[(f64, f64)], segments: usize) -> Surface {
    assert!(meridian.len() > 1, "a meridian has two points at least");
    assert!(meridian.iter().all(|&(z, radius)| z.is_finite() && radius > 0.0), "radii must be positive");
    assert!(meridian.windows(2).all(|pair| pair[0].0 <= pair[1].0), "places must ascend");
    let segments = segments.max(MIN_SEGMENTS);
    let ring = |z: f64, radius: f64| Ring { center: z * DVec3::Z, axes: [DVec3::X, DVec3::Y], radius };
    let mut rings = vec![ring(meridian[0].0, meridian[0].1)];
    for pair in meridian.windows(2) {
        let [(z0, r0), (z1, r1)] = [pair[0], pair[1]];
        let width = 0.5 * (r0 + r1) * TAU / segments as f64;
        let rows = ((z1 - z0).hypot(r1 - r0) / width).round().max(1.0) as usize;
        rings.extend((1..=rows).map(|k| {
            let part = k as f64 / rows as f64;
            ring(z0 + (z1 - z0) * part, r0 + (r1 - r0) * part)
        }));
    }
    tube(&rings, segments)
}

/// The meridian of a tube of the given radius from `from` to `to`, with one change of its radius in the form of a cosine:
/// `change` at the place `middle`, nothing beyond half a `length` from it. A negative change is a stenosis, a positive one
/// an aneurysm. Within the change there are `points` points. For [`axial`].
///
/// # Panics
/// When the change reaches beyond the ends.
pub fn cosine_change(
    radius: f64,
    [from, to]: [f64; 2],
    middle: f64,
    length: f64,
    change: f64,
    points: usize,
) -> Vec<(f64, f64)> {
    let start = middle - 0.5 * length;
    assert!(from < start && start + length < to, "the change must lie within the tube");
    let within = (0..=points).map(|k| {
        let part = k as f64 / points as f64;
        (start + part * length, radius + 0.5 * change * (1.0 - (TAU * part).cos()))
    });
    std::iter::once((from, radius)).chain(within).chain(std::iter::once((to, radius))).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::{LengthUnit, prepare};

    #[test]
    fn a_cone_between_tubes_has_its_volume_and_area() {
        let (wide, narrow, n) = (6.0, 2.0, 60);
        let s = axial(
            &[(0.0, wide), (10.0, wide), (20.0, narrow), (30.0, narrow), (30.0, wide), (35.0, wide)],
            n,
        );
        let polygon = (TAU / n as f64).sin() / (TAU / n as f64);
        let cone = 10.0 / 3.0 * (wide * wide + wide * narrow + narrow * narrow);
        let volume = PI * polygon * (15.0 * wide * wide + cone + 10.0 * narrow * narrow);
        assert!((s.volume() / volume - 1.0).abs() < 1e-12, "{}", s.volume() / volume);
        let slant = 10f64.hypot(wide - narrow);
        let round = TAU * (15.0 * wide + 10.0 * narrow) + PI * (wide + narrow) * slant;
        let flat = PI * (3.0 * wide * wide - narrow * narrow);
        assert!((s.area() / (round + flat) - 1.0).abs() < 2e-3, "{}", s.area() / (round + flat));
    }

    #[test]
    fn a_step_is_no_opening() {
        let s = axial(&[(0.0, 2e-3), (10e-3, 2e-3), (10e-3, 6e-3), (20e-3, 6e-3)], 48);
        let vessel = prepare(s, Some(LengthUnit::Metre)).expect("a sound surface");
        assert!(vessel.audit.watertight && vessel.audit.repairs.is_empty(), "{:?}", vessel.audit);
        assert_eq!(vessel.openings.len(), 2);
    }

    /// The mean of (1 - cos)/2 is a half, of its square three eighths.
    #[test]
    fn a_cosine_stenosis_has_its_volume_and_its_throat() {
        let (r, change, n) = (2.0, -1.0, 64);
        let s = axial(&cosine_change(r, [-6.0, 10.0], 0.0, 8.0, change, 60), n);
        let polygon = (TAU / n as f64).sin() / (TAU / n as f64);
        let mean = r * r + r * change + 0.375 * change * change;
        let volume = PI * polygon * (8.0 * r * r + 8.0 * mean);
        assert!((s.volume() / volume - 1.0).abs() < 1e-3, "{}", s.volume() / volume);
        let throat = s.vertices.iter().filter(|v| v.z.abs() < 1e-9).map(|v| v.x.hypot(v.y));
        assert!((throat.fold(f64::INFINITY, f64::min) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn triangles_are_well_shaped() {
        let s = axial(&cosine_change(2.0, [-6.0, 10.0], 0.0, 8.0, -1.0, 40), 48);
        for t in 0..s.triangles.len() {
            let [a, b, c] = s.triangle(t);
            let longest = [a.distance(b), b.distance(c), c.distance(a)].into_iter().fold(0.0, f64::max);
            // 1 for equilateral triangles.
            let quality = 4.0 / 3f64.sqrt() * s.triangle_area(t) / longest.powi(2);
            assert!(quality > 0.35, "triangle {t} has quality {quality}");
        }
    }
}
