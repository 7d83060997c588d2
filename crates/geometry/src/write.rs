//! Binary STL out.

use std::{
    fs::File,
    io::{BufWriter, Write},
    path::Path,
};

use stl_io::{Normal, Triangle, Vertex};

use crate::{error::GeometryError, surface::Surface};

/// Writes a surface as binary STL: single precision, coordinates as they are, no unit.
///
/// # Errors
/// When the file cannot be created or written.
pub fn write_stl(path: &Path, surface: &Surface) -> Result<(), GeometryError> {
    let single = |v: glam::DVec3| v.as_vec3().to_array();
    let triangles: Vec<Triangle> = (0..surface.triangles.len())
        .map(|t| Triangle {
            normal: Normal::new(single(surface.triangle_normal(t))),
            vertices: surface.triangle(t).map(|p| Vertex::new(single(p))),
        })
        .collect();
    let write = || {
        let mut file = BufWriter::new(File::create(path)?);
        stl_io::write_stl(&mut file, triangles.iter())?;
        file.flush()
    };
    write().map_err(|source| GeometryError::Write { path: path.to_owned(), source })
}
