//! A drawing of a vessel with its openings and their names.

use glam::DVec3;
use std::collections::BTreeMap;
use vaso_geometry::Vessel;
use vaso_report::{Drawing, Pen, Plane, sheet};

/// Planes that cut the wall into the rings drawn.
const RINGS: usize = 48;
/// Width of the picture \[pixels\].
const WIDTH: u32 = 1200;
const WALL: Pen = Pen { color: [150, 150, 150], width: 0.8 };
const INLET: [u8; 3] = [200, 40, 40];
const OUTLET: [u8; 3] = [30, 90, 170];

/// The vessel from the front and from the side, as an SVG file; `names` are those of its openings, the inlet first.
pub(super) fn draw(vessel: &Vessel, names: &[String], label: &str) -> String {
    let planes = Plane::facing(&vessel.surface.vertices);
    let rings = rings(vessel, planes[0].right);
    let drawings = planes.map(|plane| {
        let mut drawing = Drawing::new(plane);
        for ring in &rings {
            drawing.line(ring, WALL);
        }
        for (k, (opening, name)) in vessel.openings.iter().zip(names).enumerate() {
            let color = if k == 0 { INLET } else { OUTLET };
            let place = |[x, y]: &[f64; 2]| opening.center + *x * opening.axes[0] + *y * opening.axes[1];
            let mut border: Vec<DVec3> = opening.polygon.iter().map(place).collect();
            border.extend(border.first().copied());
            drawing.line(&border, Pen { color, width: 2.5 });
            drawing.label(opening.center, &format!("{name} ({:.2} mm)", opening.radius * 1e3), color);
        }
        drawing
    });
    let panels = [("front: openings with their radii", &drawings[0]), ("side", &drawings[1])];
    sheet(&panels, 2, WIDTH, label, true)
}

/// Lines in which planes across `axis` cut the wall.
fn rings(vessel: &Vessel, axis: DVec3) -> Vec<Vec<DVec3>> {
    let surface = &vessel.surface;
    let height: Vec<f64> = surface.vertices.iter().map(|x| x.dot(axis)).collect();
    let low = height.iter().copied().fold(f64::INFINITY, f64::min);
    let high = height.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut lines = Vec::new();
    for k in 0..RINGS {
        let level = low + (high - low) * (k as f64 + 0.5) / RINGS as f64;
        // Edges that cross the plane, each with those it shares a triangle with.
        let mut beside: BTreeMap<[u32; 2], Vec<[u32; 2]>> = BTreeMap::new();
        for (triangle, _) in
            surface.triangles.iter().zip(&vessel.face_opening).filter(|(_, cap)| cap.is_none())
        {
            let edges = [[0, 1], [1, 2], [2, 0]].map(|[i, j]| [triangle[i], triangle[j]]);
            let crossing = |[a, b]: &[u32; 2]| (height[*a as usize] < level) != (height[*b as usize] < level);
            let crossed: Vec<[u32; 2]> =
                edges.iter().filter(|e| crossing(e)).map(|&[a, b]| [a.min(b), a.max(b)]).collect();
            if let [a, b] = crossed[..] {
                beside.entry(a).or_default().push(b);
                beside.entry(b).or_default().push(a);
            }
        }
        let at = |[a, b]: [u32; 2]| {
            let (a, b) = (a as usize, b as usize);
            let share = (level - height[a]) / (height[b] - height[a]);
            surface.vertices[a].lerp(surface.vertices[b], share)
        };
        lines.extend(chains(beside).into_iter().map(|chain| chain.into_iter().map(at).collect()));
    }
    lines
}

/// Walks along neighbours until none is left: open chains from their ends, closed ones all around.
fn chains<K: Ord + Copy>(mut beside: BTreeMap<K, Vec<K>>) -> Vec<Vec<K>> {
    let mut chains = Vec::new();
    let ends: Vec<K> = beside.iter().filter(|(_, next)| next.len() == 1).map(|(key, _)| *key).collect();
    let all: Vec<K> = beside.keys().copied().collect();
    for start in ends.into_iter().chain(all) {
        let mut chain = vec![start];
        let mut here = start;
        while let Some(next) = beside.get_mut(&here).and_then(Vec::pop) {
            if let Some(back) = beside.get_mut(&next)
                && let Some(found) = back.iter().position(|key| *key == here)
            {
                back.swap_remove(found);
            }
            chain.push(next);
            here = next;
        }
        if chain.len() > 1 {
            chains.push(chain);
        }
    }
    chains
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_geometry::{LengthUnit, prepare, shapes};

    #[test]
    fn a_pipe_is_cut_into_closed_rings() {
        let pipe = shapes::pipe(3e-3, 60e-3, DVec3::Z, 24);
        let vessel = prepare(pipe, Some(LengthUnit::Metre)).expect("a pipe");
        let rings = rings(&vessel, DVec3::Z);
        assert_eq!(rings.len(), RINGS);
        assert!(rings.iter().all(|ring| ring.first() == ring.last() && ring.len() > 24));
        let svg = draw(&vessel, &["inlet".into(), "outlet".into()], "a pipe");
        assert!(svg.contains("inlet (3.0") || svg.contains("inlet (2.9"), "{svg}");
    }
}
