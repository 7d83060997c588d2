//! The outer surface of the wall as an STL file.

use crate::error::DriverError;
use std::path::{Path, PathBuf};
use vaso_geometry::{Extruded, Vessel, extrude, write_stl};
use vaso_io::{Extrusion, IntersectionEntry};

/// An outer surface that is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct ExtrusionRequest {
    /// Where it goes.
    pub file: PathBuf,
    /// How far out it lies \[m\].
    pub distance: f64,
}

impl ExtrusionRequest {
    /// Refuses a place that does not exist, before any work is done.
    ///
    /// # Errors
    /// When the folder of the file is not there.
    pub(crate) fn check(&self) -> Result<(), DriverError> {
        match self.file.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
            Some(folder) => Err(DriverError::input(format!(
                "--extrude: \"{}\" lies in \"{}\", which is no folder; make it first",
                self.file.display(),
                folder.display()
            ))),
            None => Ok(()),
        }
    }

    /// Moves the wall of `vessel` outwards, without writing anything yet.
    ///
    /// # Errors
    /// When the distance is not a positive number.
    pub(crate) fn make(&self, vessel: &Vessel) -> Result<Extruded, DriverError> {
        extrude(vessel, self.distance).map_err(|source| self.failed(source))
    }

    /// Writes the surface in the unit of that of the vessel, so that both lie on each other, and says what is wrong
    /// with it.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn write(&self, vessel: &Vessel, extruded: &Extruded) -> Result<Extrusion, DriverError> {
        let metres = vessel.unit.metres();
        write_stl(&self.file, &extruded.surface.map(|x| x / metres)).map_err(|source| self.failed(source))?;
        Ok(self.report(extruded))
    }

    fn failed(&self, source: vaso_geometry::GeometryError) -> DriverError {
        DriverError::Geometry { file: self.file.clone(), source }
    }

    fn report(&self, extruded: &Extruded) -> Extrusion {
        let place = |p: &vaso_geometry::IntersectionPlace| IntersectionEntry {
            center_m: p.center.to_array(),
            radius_m: p.radius,
            pairs: p.pairs as u64,
        };
        Extrusion {
            file: self.file.display().to_string(),
            distance_m: self.distance,
            volume_m3: extruded.surface.volume(),
            sound: extruded.is_sound(),
            intersections: extruded.intersections.len() as u64,
            places: extruded.places.iter().map(place).collect(),
            flipped_triangles: extruded.flipped as u64,
            limited_vertices: extruded.limited as u64,
        }
    }
}

/// The report in lines; `metres` is the unit of the surface \[m\], `unit` its symbol.
pub(crate) fn lines(extrusion: &Extrusion, file: &Path, metres: f64, unit: &str) -> String {
    let Extrusion { distance_m, intersections, flipped_triangles, limited_vertices, .. } = extrusion;
    let mut text = format!("outer    {} · {:.3} mm out of the wall · ", file.display(), 1e3 * distance_m);
    if extrusion.sound {
        text += "does not cut itself";
    } else {
        text += &format!(
            "{intersections} pairs of triangles cut each other, {flipped_triangles} are turned over"
        );
    }
    if *limited_vertices > 0 {
        text += &format!(" · {limited_vertices} vertices at sharp edges moved less");
    }
    for place in &extrusion.places {
        let [x, y, z] = place.center_m.map(|c| c / metres);
        text += &format!(
            "\n         cuts itself near [{x:.3}, {y:.3}, {z:.3}] {unit}, {} pairs within {:.3} {unit}",
            place.pairs,
            place.radius_m / metres
        );
    }
    text
}
