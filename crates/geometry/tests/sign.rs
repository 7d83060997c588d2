//! The side a point is on, against the solid angle of the whole surface summed without any tree.

use std::path::Path;

use glam::DVec3;
use vaso_geometry::{LengthUnit, SignedDistance, Surface, Vessel, prepare, read_surface, shapes};

/// Winding number at `x`, triangle by triangle.
fn winding(surface: &Surface, x: DVec3) -> f64 {
    let angle = |t: usize| {
        let [a, b, c] = surface.triangle(t).map(|p| p - x);
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        2.0 * a.dot(b.cross(c)).atan2(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
    };
    (0..surface.triangles.len()).map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// Parts of one from 0 to 1, spread evenly.
fn part(i: u32, k: f64) -> f64 {
    (f64::from(i) * k).fract()
}

/// Places all over the box, and places at small distances on both sides of the surface, which find every
/// feature: faces, edges, and vertices where slivers meet.
fn places(vessel: &Vessel, count: u32) -> Vec<DVec3> {
    let (low, high) = vessel.surface.bounds();
    let n = vessel.surface.triangles.len();
    let spread = (0..count).map(|i| {
        low + (high - low) * DVec3::new(part(i, 0.819_172_5), part(i, 0.671_043_6), part(i, 0.549_700_4))
    });
    let close = (0..count).map(|i| {
        let t = (part(i, 0.618_033_98) * n as f64) as usize;
        let [a, b, c] = vessel.surface.triangle(t);
        // Every third place starts at an edge, every fifth at a vertex.
        let u = if i % 5 == 0 { 0.0 } else { part(i, 0.754_877_6) };
        let v = if i % 3 == 0 || i % 5 == 0 { 0.0 } else { part(i, 0.569_840_2) * (1.0 - u) };
        let z = 2.0 * part(i, 0.324_717_9) - 1.0;
        let (sin, cos) = (std::f64::consts::TAU * part(i, 0.445_041_8)).sin_cos();
        let away = DVec3::new((1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z);
        let size = (high - low).length() * 10f64.powf(-2.0 - 4.0 * part(i, 0.280_776_4));
        a + u * (b - a) + v * (c - a) + size * away
    });
    spread.chain(close).collect()
}

fn assert_sides(vessel: &Vessel, count: u32, what: &str) {
    let distance = SignedDistance::closed(vessel);
    for x in places(vessel, count) {
        let inside = winding(&vessel.surface, x) > 0.5;
        let found = distance.query(x).distance;
        assert_eq!(found < 0.0, inside, "{what}: distance {found} at {x}");
    }
}

#[test]
fn made_surfaces() {
    let spec = shapes::BifurcationSpec { edge: 1e-3, ..Default::default() };
    for (what, surface) in [
        ("pipe", shapes::pipe(3e-3, 2e-2, DVec3::new(1.0, 2.0, 3.0), 24)),
        ("bend", shapes::bent_pipe(3e-3, 8e-3, 3.0, 24)),
        ("bifurcation", shapes::bifurcation(&spec)),
    ] {
        assert_sides(&prepare(surface, Some(LengthUnit::Metre)).expect("a clean surface"), 2000, what);
    }
}

#[test]
fn real_surfaces() {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        println!("skipped: VASO_DATA is not set");
        return;
    };
    let folder = Path::new(&data).join("geometry");
    for file in [
        "carotid_bifurcation/carotid_lumen.stl",
        "aorta_arch_vmr0024/aorta_lumen.stl",
        "aorta_arch_vmr0024/aorta_lumen_shrunk.stl",
        "stenosed_tube_sphinxsys/stenosed_tube.stl",
        "synthetic/carotid_open.stl",
        "synthetic/carotid_dirty.stl",
        "synthetic/t_junction.stl",
        "synthetic/straight_tube_coarse.stl",
        "defects/05_all_caps_open.stl",
    ] {
        let raw = read_surface(&folder.join(file)).expect("a valid file");
        let vessel = prepare(raw, Some(LengthUnit::Millimetre)).expect("a vessel");
        assert_sides(&vessel, 500, file);
    }
}
