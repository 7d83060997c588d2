//! Surfaces: files to triangles, and triangles to a vessel.

use std::path::Path;

use glam::DVec3;
use vaso_geometry::{LengthUnit, SignedDistance, Surface, parse_surface};

/// Reads bytes as an STL file, unless they look like VTP, which has a target of its own.
pub fn stl(data: &[u8]) {
    if !data.trim_ascii_start().starts_with(b"<") {
        surface(data);
    }
}

/// Reads bytes as a VTP file.
pub fn vtp(data: &[u8]) {
    surface(data);
}

fn surface(data: &[u8]) {
    match parse_surface(data, Path::new("input")) {
        Ok(surface) => {
            assert!(!surface.triangles.is_empty());
            let vertices = surface.vertices.len();
            assert!(surface.vertices.iter().all(|vertex| vertex.is_finite()));
            assert!(surface.triangles.iter().flatten().all(|&vertex| (vertex as usize) < vertices));
        }
        Err(error) => assert!(error.to_string().contains("\"input\"")),
    }
}

/// Triangles to a vessel.
///
/// One byte chooses the unit and one the number of vertices; then come the vertices, three little-endian `f32` each,
/// and triangles of three bytes each, the numbers of their vertices.
pub fn prepare(data: &[u8]) {
    let [unit, count, rest @ ..] = data else { return };
    let Some((places, numbers)) = rest.split_at_checked(12 * usize::from(*count)) else { return };
    let float = |bytes: &[u8]| f64::from(f32::from_le_bytes(bytes.try_into().expect("chunks of four bytes")));
    let vertices: Vec<DVec3> = places
        .chunks_exact(12)
        .map(|place| DVec3::new(float(&place[..4]), float(&place[4..8]), float(&place[8..])))
        .collect();
    let triangles = numbers.chunks_exact(3).map(|corners| [0, 1, 2].map(|k| u32::from(corners[k]))).collect();
    let unit = LengthUnit::ALL.get(usize::from(*unit)).map(|(unit, _)| *unit);
    let Ok(vessel) = vaso_geometry::prepare(Surface { vertices, triangles }, unit) else { return };
    let volume = vessel.surface.volume();
    assert!(volume > 0.0 && volume.is_finite());
    assert_eq!(vessel.face_opening.len(), vessel.surface.triangles.len());
    assert_eq!(vessel.audit.triangles, vessel.surface.triangles.len());
    let openings = vessel.openings.len() as u32;
    assert!(vessel.face_opening.iter().flatten().all(|&opening| opening < openings));
    assert!(vessel.openings.iter().all(|opening| opening.area > 0.0 && opening.normal.is_finite()));
    let (low, high) = vessel.surface.bounds();
    let nearest = SignedDistance::closed(&vessel).query(0.3 * low + 0.7 * high);
    assert!(nearest.distance.is_finite() && nearest.normal.is_finite());
}
