//! Vessels that are hard, made from numbers.

use std::f64::consts::PI;

use glam::DVec3;
use vaso_driver::{Case, Plan};
use vaso_geometry::{Surface, shapes, write_stl};

use crate::cache;

/// Points around a tube.
const SEGMENTS: usize = 64;

/// A pipe along z from the origin, narrowed to `throat` \[m\] of its `radius` as a cosine over `length` \[m\] in its middle.
pub fn stenosis(radius: f64, throat: f64, length: f64, whole: f64) -> Surface {
    shapes::pipe(radius, whole, DVec3::Z, SEGMENTS).map(|v| {
        let x = (v.z - 0.5 * whole) / (0.5 * length);
        let depth = if x.abs() < 1.0 { 0.5 * (1.0 + (PI * x).cos()) } else { 0.0 };
        let factor = 1.0 - depth * (1.0 - throat / radius);
        DVec3::new(factor * v.x, factor * v.y, v.z)
    })
}

/// Two legs of a tube along z, `gap` \[m\] apart, joined by a half circle: up from the origin, and down beside it towards +x.
pub fn hairpin(radius: f64, gap: f64, leg: f64) -> Surface {
    let bend = radius + 0.5 * gap;
    let arc = PI * bend;
    shapes::pipe(radius, 2.0 * leg + arc, DVec3::Z, SEGMENTS).map(|v| {
        let angle = ((v.z - leg) / bend).clamp(0.0, PI);
        let up = v.z.min(leg);
        let down = (v.z - leg - arc).max(0.0);
        let outward = DVec3::new(-angle.cos(), 0.0, angle.sin());
        let center = DVec3::new(bend, 0.0, up - down) + bend * outward;
        // The side of the tube that looks to -x on the way up is the outer one of the bend.
        center - v.x * outward + v.y * DVec3::Y
    })
}

/// A case on a surface \[m\], from the text of its `case.toml` without `[geometry]`.
///
/// # Panics
/// When the case is wrong: these are the project's own.
pub fn case(surface: &Surface, text: &str) -> (Case, Plan) {
    try_case(surface, text).unwrap_or_else(|e| panic!("{e}"))
}

/// The same where it may be refused.
///
/// # Errors
/// When the case is refused.
///
/// # Panics
/// When no temporary file can be written.
pub fn try_case(surface: &Surface, text: &str) -> Result<(Case, Plan), vaso_driver::DriverError> {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    write_stl(&folder.path().join("vessel.stl"), &surface.map(|v| v * 1e3)).expect("it can be written");
    let file = folder.path().join("case.toml");
    let text = format!("[geometry]\nsurface = \"vessel.stl\"\nunit = \"mm\"\n{text}");
    std::fs::write(&file, text).expect("it can be written");
    let mut case = Case::load(&file, &[])?;
    case.cache = Some(cache());
    let plan = Plan::new(&case)?;
    Ok((case, plan))
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_geometry::{LengthUnit, prepare};

    #[test]
    fn a_hairpin_has_the_volume_of_its_tube_and_two_openings_side_by_side() {
        let surface = hairpin(2e-3, 0.8e-3, 12e-3);
        let vessel = prepare(surface, Some(LengthUnit::Metre)).expect("sound");
        let length = 24e-3 + PI * 2.4e-3;
        let ideal = PI * 4e-6 * length;
        assert!((vessel.surface.volume() / ideal - 1.0).abs() < 0.01, "{}", vessel.surface.volume() / ideal);
        assert_eq!(vessel.openings.len(), 2);
        assert!((vessel.openings[0].center.distance(vessel.openings[1].center) - 4.8e-3).abs() < 1e-5);
    }

    #[test]
    fn a_stenosis_has_its_throat() {
        let surface = stenosis(3e-3, 1.5e-3, 12e-3, 30e-3);
        let radius = |from: f64, to: f64| {
            let within = surface.vertices.iter().filter(|v| (from..to).contains(&v.z));
            within.map(|v| v.x.hypot(v.y)).fold(f64::INFINITY, f64::min)
        };
        assert!((radius(14e-3, 16e-3) / 1.5e-3 - 1.0).abs() < 0.01, "{}", radius(14e-3, 16e-3));
        assert!((radius(2e-3, 8e-3) / 3e-3 - 1.0).abs() < 1e-9, "wide before");
    }
}
