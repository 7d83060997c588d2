//! Surfaces from files.

mod stl;

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
    parse(&bytes, path)
}

/// Reads a surface from the bytes of a file; `path` is for messages only.
pub(crate) fn parse(bytes: &[u8], path: &Path) -> Result<Surface, GeometryError> {
    stl::parse(bytes, path)
}
