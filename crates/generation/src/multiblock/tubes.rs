//! The space that blocks fill, as closed tubes around the sections of their limbs.

use super::fill::{Filling, Limb};
use glam::DVec3;
use vaso_geometry::{SignedDistance, Surface};

/// Distance a cell keeps from the blocks of another limb, in spacings.
const APART: f64 = 0.4;

/// Gives up layers that reach into the blocks of another limb.
pub(super) fn keep_apart(limbs: &[Limb<'_>], fillings: &mut [Filling], spacing: f64) {
    for k in 0..limbs.len() {
        if limbs[k].hinge.is_some() {
            continue;
        }
        let others = (0..limbs.len()).filter(|&m| m != k);
        let mut surface = Surface { vertices: Vec::new(), triangles: Vec::new() };
        for m in others {
            add_tubes(&mut surface, &limbs[m], &fillings[m]);
        }
        if surface.triangles.is_empty() {
            continue;
        }
        let distance = SignedDistance::of(&surface);
        for layer in fillings[k].layers_mut() {
            layer.is_sound &=
                layer.cells.iter().all(|c| distance.query(c.centroid).distance > APART * spacing);
        }
    }
}

/// Distance to all blocks; `None` where there are none.
pub(super) fn tubes(limbs: &[Limb<'_>], fillings: &[Filling]) -> Option<SignedDistance> {
    let mut surface = Surface { vertices: Vec::new(), triangles: Vec::new() };
    for (limb, filling) in limbs.iter().zip(fillings) {
        add_tubes(&mut surface, limb, filling);
    }
    (!surface.triangles.is_empty()).then(|| SignedDistance::of(&surface))
}

/// Adds the closed tubes that the sound layers of a limb fill.
fn add_tubes(surface: &mut Surface, limb: &Limb<'_>, filling: &Filling) {
    let mut arcs: Vec<Vec<f64>> = Vec::new();
    let mut end = f64::NAN;
    for layer in filling.layers().filter(|l| l.is_sound) {
        if layer.arc[0] != end {
            arcs.push(vec![layer.arc[0]]);
        }
        end = layer.arc[1];
        if let Some(open) = arcs.last_mut() {
            open.push(end);
        }
    }
    for arcs in arcs {
        let sections: Option<Vec<_>> = arcs.iter().map(|arc| limb.route.section(*arc)).collect();
        // Layers exist only between sections that do.
        let Some(sections) = sections else { continue };
        let rings: Vec<Vec<DVec3>> = sections.iter().map(|s| s.border().collect()).collect();
        add_tube(surface, &rings, [sections[0].center(), sections[sections.len() - 1].center()]);
    }
}

/// A closed tube through rings of equally many points, counter-clockwise about its direction, with the middle
/// of each end.
fn add_tube(surface: &mut Surface, rings: &[Vec<DVec3>], ends: [DVec3; 2]) {
    let first = surface.vertices.len() as u32;
    let n = rings[0].len() as u32;
    surface.vertices.extend(rings.iter().flatten());
    let index = |ring: u32, k: u32| first + ring * n + k % n;
    let last = rings.len() as u32 - 1;
    for ring in 0..last {
        for k in 0..n {
            let [a, b, c, d] =
                [index(ring, k), index(ring, k + 1), index(ring + 1, k), index(ring + 1, k + 1)];
            surface.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    let middle = surface.vertices.len() as u32;
    surface.vertices.extend(ends);
    for k in 0..n {
        surface.triangles.push([middle, index(0, k + 1), index(0, k)]);
        surface.triangles.push([middle + 1, index(last, k), index(last, k + 1)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tube_is_closed_and_points_outwards() {
        let ring = |z: f64| -> Vec<DVec3> {
            (0..4).map(|k| DVec3::new([1.0, 0.0, -1.0, 0.0][k], [0.0, 1.0, 0.0, -1.0][k], z)).collect()
        };
        let mut surface = Surface { vertices: Vec::new(), triangles: Vec::new() };
        add_tube(&mut surface, &[ring(0.0), ring(1.0), ring(3.0)], [DVec3::ZERO, 3.0 * DVec3::Z]);
        add_tube(&mut surface, &[ring(5.0), ring(6.0)], [5.0 * DVec3::Z, 6.0 * DVec3::Z]);
        assert!((surface.volume() - 2.0 * 4.0).abs() < 1e-12);
        let distance = SignedDistance::of(&surface);
        assert!((distance.query(DVec3::new(0.0, 0.0, 4.0)).distance - 1.0).abs() < 1e-12);
        assert!(distance.query(DVec3::new(0.1, 0.1, 1.5)).distance < 0.0);
    }
}
