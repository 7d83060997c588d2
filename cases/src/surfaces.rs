//! The surface of each shipped case.

use std::f64::consts::PI;

use glam::DVec3;
use vaso_geometry::Surface;
use vaso_geometry::shapes::{
    ArchSpec, BifurcationSpec, aortic_arch, axial, bent_pipe, bifurcation, cosine_change, pipe,
};

/// A surface file of a case, in millimetres.
pub struct CaseSurface {
    /// Path in the folder `cases`.
    pub file: &'static str,
    /// The surface \[mm\].
    pub surface: Surface,
}

/// All surfaces the cases ship.
pub fn surfaces() -> Vec<CaseSurface> {
    let mm = |file, surface: Surface| CaseSurface { file, surface: surface.map(|v| v * 1e3) };
    vec![
        mm("aneurysm/aneurysm.stl", aneurysm()),
        mm("aorta/aorta.stl", aortic_arch(&ArchSpec::default())),
        mm("carotid/carotid.stl", bifurcation(&BifurcationSpec::default())),
        mm("common-carotid/common-carotid.stl", pipe(3e-3, 126e-3, DVec3::Z, 40)),
        mm("curved-tube/curved-tube.stl", bent_pipe(2e-3, 16e-3, PI, 48)),
        mm("elastic-stenosis/stenosis.stl", wide_stenosis()),
        mm("elastic-tube/tube.stl", pipe(3e-3, 36e-3, DVec3::Z, 64)),
        mm("fda-nozzle/nozzle.stl", nozzle()),
        mm("pipe/pipe.stl", pipe(3.175e-3, 31.75e-3, DVec3::Z, 96)),
        mm("stenosis/stenosis.stl", stenosis()),
        mm("womersley/pipe.stl", pipe(5e-3, 30e-3, DVec3::Z, 96)),
    ]
}

/// A tube of 4 mm with a stenosis of half its diameter, three quarters of its area, two diameters long.
fn stenosis() -> Surface {
    axial(&cosine_change(2e-3, [-10e-3, 26e-3], 0.0, 8e-3, -1e-3, 40), 64)
}

/// The same of a tube of 6 mm, with more of it behind.
fn wide_stenosis() -> Surface {
    axial(&cosine_change(3e-3, [-15e-3, 45e-3], 0.0, 12e-3, -1.5e-3, 40), 64)
}

/// An aorta of 20 mm with a spindle of 50 mm, 80 mm long.
fn aneurysm() -> Surface {
    axial(&cosine_change(10e-3, [-70e-3, 70e-3], 0.0, 80e-3, 15e-3, 60), 64)
}

/// The benchmark nozzle of the Food and Drug Administration, with the sudden expansion at the origin: 12 mm wide, a cone of
/// 22.685 mm, a throat of 4 mm and 40 mm (Hariharan et al. 2011).
fn nozzle() -> Surface {
    let meridian = [(-76.0, 6.0), (-62.685, 6.0), (-40.0, 2.0), (0.0, 2.0), (0.0, 6.0), (40.0, 6.0)];
    axial(&meridian.map(|(z, radius)| (1e-3 * z, 1e-3 * radius)), 48)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use vaso_geometry::{LengthUnit, prepare, read_surface};

    /// What is shipped is what the generator makes. Libraries round trigonometry differently, so the
    /// files are compared as geometry, not byte by byte.
    #[test]
    fn shipped_surfaces_are_those_the_generator_makes() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        for made in surfaces() {
            let shipped = read_surface(&folder.join(made.file)).expect("shipped surfaces can be read");
            let unit = Some(LengthUnit::Millimetre);
            let (a, b) =
                (prepare(shipped, unit).expect("sound"), prepare(made.surface, unit).expect("sound"));
            assert_eq!(a.surface.triangles.len(), b.surface.triangles.len(), "{}", made.file);
            let difference = (a.surface.volume() / b.surface.volume() - 1.0).abs();
            assert!(difference < 1e-5, "{}: volumes differ by {difference:e}", made.file);
            assert_eq!(a.openings.len(), b.openings.len(), "{}", made.file);
            // Openings come by their size, and those of a pipe are equal but for rounding.
            for x in &a.openings {
                let same = b.openings.iter().find(|y| x.center.distance(y.center) < 1e-7);
                let same = same.unwrap_or_else(|| panic!("{}: no opening at {}", made.file, x.center));
                assert!((x.area / same.area - 1.0).abs() < 1e-4, "{}", made.file);
            }
        }
    }
}
