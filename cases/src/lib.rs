//! Surfaces of the shipped cases, made by the project itself.

use glam::DVec3;
use std::path::Path;
use vaso_geometry::shapes::{BifurcationSpec, bifurcation, pipe};
use vaso_geometry::{GeometryError, Surface, write_stl};

/// A surface file of a case, in millimetres.
pub struct CaseSurface {
    /// Path in the folder `cases`.
    pub file: &'static str,
    /// The surface \[mm\].
    pub surface: Surface,
}

/// All surfaces the cases ship.
pub fn surfaces() -> Vec<CaseSurface> {
    let millimetres = |surface: Surface| surface.map(|v| v * 1e3);
    vec![
        CaseSurface {
            file: "carotid/carotid.stl",
            surface: millimetres(bifurcation(&BifurcationSpec::default())),
        },
        CaseSurface { file: "pipe/pipe.stl", surface: millimetres(pipe(3.175e-3, 31.75e-3, DVec3::Z, 96)) },
    ]
}

/// Writes all surfaces below the folder `cases`.
///
/// # Errors
/// When a file cannot be written.
pub fn write(cases: &Path) -> Result<(), GeometryError> {
    surfaces().iter().try_for_each(|s| write_stl(&cases.join(s.file), &s.surface))
}

#[cfg(test)]
mod tests {
    use super::*;
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
            for (x, y) in a.openings.iter().zip(&b.openings) {
                assert!(x.center.distance(y.center) < 1e-7 && (x.area / y.area - 1.0).abs() < 1e-4);
            }
        }
    }
}
