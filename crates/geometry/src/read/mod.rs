//! Surfaces from files.

mod stl;
mod vtk_array;
mod vtk_blocks;
mod vtp;
mod xml;

use std::path::Path;

use crate::{error::GeometryError, surface::Surface};

/// Reads a surface in the unit of its file, which is STL (binary or text) or VTP: the content decides, not the
/// name.
///
/// # Errors
/// When the file cannot be read, is none of these formats, is damaged, holds no triangle or a coordinate that
/// is not finite.
pub fn read_surface(path: &Path) -> Result<Surface, GeometryError> {
    let bytes =
        std::fs::read(path).map_err(|source| GeometryError::Read { path: path.to_owned(), source })?;
    parse_surface(&bytes, path)
}

/// Reads a surface from the bytes of a file; `path` is for messages only.
///
/// # Errors
/// As [`read_surface`].
pub fn parse_surface(bytes: &[u8], path: &Path) -> Result<Surface, GeometryError> {
    let mut surface = if vtp::is_vtp(bytes) { vtp::parse(bytes, path)? } else { stl::parse(bytes, path)? };
    if surface.triangles.is_empty() {
        return Err(GeometryError::EmptyFile { path: path.to_owned() });
    }
    surface.drop_unused_vertices();
    for (triangle, corners) in surface.triangles.iter().enumerate() {
        let coordinates = corners.iter().flat_map(|&v| surface.vertices[v as usize].to_array());
        if let Some(value) = coordinates.into_iter().find(|x| !x.is_finite()) {
            return Err(GeometryError::NotFiniteInFile { path: path.to_owned(), triangle, value });
        }
    }
    Ok(surface)
}

#[cfg(test)]
mod hostile;
#[cfg(test)]
mod samples;
#[cfg(test)]
mod tests;
