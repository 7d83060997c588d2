//! What can go wrong between a surface file and a vessel.

use std::path::PathBuf;

use crate::unit::LengthUnit;

/// Why a surface could not be read, repaired or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// The file cannot be opened or read.
    #[error("cannot read surface \"{}\": {source}; check the path, and that the file may be read", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The file cannot be created or written.
    #[error("cannot write surface \"{}\": {source}; name another place", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The content is neither STL nor VTP.
    #[error("\"{}\" is neither STL nor VTP by its content; save the surface in one of these formats", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// A binary STL whose length contradicts its header: cut off, or not an STL at all.
    #[error(
        "the count in the header of \"{}\" does not fit the length: {count} triangles need {expected} bytes, the file has {found}; export or copy the file again",
        path.display()
    )]
    StlLength {
        /// The file.
        path: PathBuf,
        /// Triangles the header announces.
        count: u32,
        /// Bytes such a file has, 84 + 50 for each triangle.
        expected: u64,
        /// Bytes the file has.
        found: u64,
    },
    /// More triangles than vertices can be numbered for.
    #[error(
        "\"{}\" has {count} triangles or more, beyond the limit of {limit}; coarsen the surface",
        path.display()
    )]
    TooManyTriangles {
        /// The file.
        path: PathBuf,
        /// Triangles announced, or read so far.
        count: u64,
        /// Most triangles taken.
        limit: u64,
    },
    /// A word of an ASCII STL is not the one the format asks for.
    #[error("line {line} of \"{}\": expected {expected}, found \"{found}\"", path.display())]
    StlText {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// What should stand there.
        expected: &'static str,
        /// What stands there; empty at the end of the file.
        found: String,
    },
    /// The XML of a VTP file is damaged or lacks an element.
    #[error("\"{}\" is no usable VTP file: {reason}; export it again", path.display())]
    Vtp {
        /// The file.
        path: PathBuf,
        /// What is missing or damaged.
        reason: String,
    },
    /// A data array of a VTP file cannot be decoded.
    #[error("array \"{array}\" of \"{}\": {reason}", path.display())]
    VtpArray {
        /// The file.
        path: PathBuf,
        /// Name of the array.
        array: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A VTP file is compressed in a way this reader does not know.
    #[error(
        "\"{}\" is compressed with \"{compressor}\", which is not supported; save it again with zlib, lz4 or no compression",
        path.display()
    )]
    VtpCompressor {
        /// The file.
        path: PathBuf,
        /// Class name of the compressor.
        compressor: String,
    },
    /// The file holds no triangle.
    #[error("\"{}\" has zero triangles; export the surface, not its points or lines", path.display())]
    EmptyFile {
        /// The file.
        path: PathBuf,
    },
    /// A coordinate of the file is not a finite number.
    #[error(
        "triangle {triangle} of \"{}\" has a coordinate that is not finite ({value}); mend or remove it where the surface was made",
        path.display()
    )]
    NotFiniteInFile {
        /// The file.
        path: PathBuf,
        /// Triangle, counted from 0.
        triangle: usize,
        /// The coordinate.
        value: f64,
    },
    /// A vertex of a surface is not finite.
    #[error("vertex {vertex} of the surface is not finite: {position}")]
    NotFinite {
        /// Vertex, counted from 0.
        vertex: usize,
        /// Its position.
        position: glam::DVec3,
    },
    /// A vertex of a surface is beyond all reason, so that areas and volumes would lose their meaning.
    #[error(
        "vertex {vertex} of the surface is at {position}, beyond the limit of {limit:e}; the file is damaged"
    )]
    TooFar {
        /// Vertex, counted from 0.
        vertex: usize,
        /// Its position.
        position: glam::DVec3,
        /// Largest coordinate taken.
        limit: f64,
    },
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} names vertex {vertex}, but there are only {vertices} vertices")]
    VertexRange {
        /// Triangle, counted from 0.
        triangle: usize,
        /// The vertex number it holds.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A surface has no triangles, or none that spans an area.
    #[error(
        "the surface has no triangle with an area ({read} triangles were given); nothing can be built from it"
    )]
    NoTriangles {
        /// Triangles given.
        read: usize,
    },
    /// The surface encloses no volume.
    #[error(
        "the surface encloses no volume: {volume_m3:e} m^3 within a box of diagonal {diagonal_m:e} m (unit \"{unit}\"); is it a flat sheet, or one half of a vessel?"
    )]
    NoVolume {
        /// Volume after repair \[m^3\].
        volume_m3: f64,
        /// Diagonal of the bounding box \[m\].
        diagonal_m: f64,
        /// Unit of the coordinates.
        unit: LengthUnit,
    },
    /// A surface cannot be moved outwards by this.
    #[error("the offset distance is {distance} m, allowed is a number above 0")]
    OffsetDistance {
        /// The distance \[m\].
        distance: f64,
    },
}
