//! VTP: the PolyData of VTK's XML files, as VMTK, SimVascular and ParaView write them.

use std::path::Path;

use glam::DVec3;
use roxmltree::Node;

use super::{
    vtk_array::{Budget, Expected, Numbers, Scalar, from_bytes, from_text},
    vtk_blocks::{Compression, Encoding, Source},
    xml,
};
use crate::{error::GeometryError, surface::Surface};

/// How far into a file its root element is looked for.
const ROOT_WITHIN: usize = 4096;

/// Whether the content looks like a VTK XML file.
pub(super) fn is_vtp(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    start.starts_with(b"<") && find(&bytes[..bytes.len().min(ROOT_WITHIN)], b"<VTKFile").is_some()
}

fn find(bytes: &[u8], pattern: &[u8]) -> Option<usize> {
    bytes.windows(pattern.len()).position(|w| w == pattern)
}

/// Reads a VTP file: polygons (as fans) and strips of all its pieces.
pub(super) fn parse(bytes: &[u8], path: &Path) -> Result<Surface, GeometryError> {
    let unusable = |reason: String| GeometryError::Vtp { path: path.to_owned(), reason };
    // Appended data may be raw bytes, which are no XML: the part before them is closed by hand.
    let at = find(bytes, b"<AppendedData");
    let head = std::str::from_utf8(&bytes[..at.unwrap_or(bytes.len())])
        .map_err(|e| unusable(format!("its text is not UTF-8: {e}")))?;
    let mut head = head.strip_prefix('\u{feff}').unwrap_or(head).to_owned();
    let appended = at.map(|at| Appended::new(&bytes[at..])).transpose().map_err(unusable)?;
    if at.is_some() {
        head.push_str("</VTKFile>");
    }
    let document = xml::parse(&head).map_err(unusable)?;
    let root = document.root_element();
    if root.attribute("type") != Some("PolyData") {
        let found = root.attribute("type").unwrap_or_default();
        return Err(unusable(format!("it holds \"{found}\", not \"PolyData\"; extract the surface first")));
    }
    let budget = Budget::new(bytes.len());
    let mut file = File { path, encoding: encoding(root, path)?, appended, budget };
    let mut surface = Surface::default();
    for piece in root.descendants().filter(|n| n.has_tag_name("Piece")) {
        file.add_piece(piece, &mut surface)?;
    }
    Ok(surface)
}

fn encoding(root: Node, path: &Path) -> Result<Encoding, GeometryError> {
    let compression = match root.attribute("compressor") {
        None | Some("") => Compression::None,
        Some("vtkZLibDataCompressor") => Compression::Zlib,
        Some("vtkLZ4DataCompressor") => Compression::Lz4,
        // Files of plain text name a compressor as well.
        Some(_) if !root.descendants().any(is_packed) => Compression::None,
        Some(other) => {
            let compressor = other.to_owned();
            return Err(GeometryError::VtpCompressor { path: path.to_owned(), compressor });
        }
    };
    Ok(Encoding {
        big_endian: root.attribute("byte_order") == Some("BigEndian"),
        header_bytes: if root.attribute("header_type") == Some("UInt64") { 8 } else { 4 },
        compression,
    })
}

/// Whether an element is an array stored other than as text.
fn is_packed(node: Node) -> bool {
    node.has_tag_name("DataArray") && matches!(node.attribute("format"), Some("binary" | "appended"))
}

/// The section of data behind all XML.
struct Appended<'a> {
    data: &'a [u8],
    is_base64: bool,
}

impl<'a> Appended<'a> {
    /// `bytes` start with the tag; the data start behind the first underscore after it.
    fn new(bytes: &'a [u8]) -> Result<Appended<'a>, String> {
        let cut = "the file ends within its \"AppendedData\" tag";
        let end = find(bytes, b">").ok_or(cut)?;
        let start = end + find(&bytes[end..], b"_").ok_or(cut)? + 1;
        Ok(Appended { data: &bytes[start..], is_base64: find(&bytes[..end], b"base64").is_some() })
    }
}

struct File<'a> {
    path: &'a Path,
    encoding: Encoding,
    appended: Option<Appended<'a>>,
    budget: Budget,
}

impl File<'_> {
    fn add_piece(&mut self, piece: Node, surface: &mut Surface) -> Result<(), GeometryError> {
        let first = surface.vertices.len();
        let Some(points) = child(piece, "Points").and_then(|p| child(p, "DataArray")) else {
            return Ok(());
        };
        let coordinates = self.points(piece, points).map_err(|r| self.array_error("Points", r))?;
        surface.vertices.reserve(coordinates.len() / 3);
        surface.vertices.extend(coordinates.chunks_exact(3).map(DVec3::from_slice));
        let n_points = surface.vertices.len() - first;
        // Vertex numbers are 32 bits wide, and the marker value must stay free.
        if surface.vertices.len() >= u32::MAX as usize {
            return Err(self.array_error("Points", format!("{} points are too many", surface.vertices.len())));
        }
        for (section, split) in [("Polys", fan as fn(&[u32], &mut Vec<[u32; 3]>)), ("Strips", strip)] {
            let Some(cells) = child(piece, section) else { continue };
            let n_cells = count(piece, &format!("NumberOf{section}"), 1)
                .map_err(|r| self.array_error(&format!("{section}/offsets"), r))?;
            let offsets = self.indices(cells, section, "offsets", n_cells)?;
            let last = offsets.last().copied().unwrap_or(0);
            let asked = Expected { count: last as u64, by: "the end of the last cell".to_owned() };
            let connectivity = self.indices(cells, section, "connectivity", Some(asked))?;
            surface.triangles.reserve(connectivity.len().saturating_sub(offsets.len().saturating_mul(2)));
            let mut start = 0;
            for (cell, &end) in offsets.iter().enumerate() {
                let Some(corners) = connectivity.get(start..end) else {
                    let reason = format!(
                        "cell {cell} runs from {start} to {end}, but there are {} entries",
                        connectivity.len()
                    );
                    return Err(self.array_error(&format!("{section}/offsets"), reason));
                };
                if let Some(bad) = corners.iter().find(|&&v| v >= n_points) {
                    let reason = format!("cell {cell} names point {bad} of {n_points}");
                    return Err(self.array_error(&format!("{section}/connectivity"), reason));
                }
                let corners: Vec<u32> = corners.iter().map(|&v| (first + v) as u32).collect();
                split(&corners, &mut surface.triangles);
                start = end;
            }
        }
        Ok(())
    }

    fn points(&mut self, piece: Node, array: Node) -> Result<Vec<f64>, String> {
        let components = array.attribute("NumberOfComponents").unwrap_or("3");
        if components != "3" {
            return Err(format!("`NumberOfComponents` = \"{components}\", but a point has 3 coordinates"));
        }
        let expected = count(piece, "NumberOfPoints", 3)?;
        let coordinates = self.numbers(array, expected).map(Numbers::floats)?;
        if coordinates.len() % 3 != 0 {
            return Err(format!("{} coordinates are no whole number of points", coordinates.len()));
        }
        Ok(coordinates)
    }

    /// An index array of a section; empty when the section has none, as writers do for no cells.
    fn indices(
        &mut self,
        cells: Node,
        section: &str,
        name: &str,
        expected: Option<Expected>,
    ) -> Result<Vec<usize>, GeometryError> {
        let array =
            cells.children().find(|n| n.has_tag_name("DataArray") && n.attribute("Name") == Some(name));
        let Some(array) = array else { return Ok(Vec::new()) };
        self.numbers(array, expected)
            .and_then(Numbers::indices)
            .map_err(|reason| self.array_error(&format!("{section}/{name}"), reason))
    }

    fn array_error(&self, array: &str, reason: String) -> GeometryError {
        GeometryError::VtpArray { path: self.path.to_owned(), array: array.to_owned(), reason }
    }

    /// Decodes a data array in whatever way it is stored.
    fn numbers(&mut self, array: Node, expected: Option<Expected>) -> Result<Numbers, String> {
        let scalar = Scalar::named(array.attribute("type").unwrap_or_default())?;
        let text = array.text().unwrap_or_default();
        let expected = expected.as_ref();
        let format = array.attribute("format").unwrap_or("ascii");
        let mut source = match format {
            "ascii" => return from_text(text, scalar, expected, &mut self.budget),
            "binary" => Source::base64(text.as_bytes()),
            "appended" => {
                let appended = self.appended.as_ref().ok_or("the file has no appended data")?;
                let offset = array.attribute("offset").unwrap_or_default();
                let data = offset.parse().ok().and_then(|at: usize| appended.data.get(at..));
                let data = data.ok_or_else(|| {
                    format!("offset \"{offset}\" is not within the {} bytes appended", appended.data.len())
                })?;
                if appended.is_base64 { Source::base64(data) } else { Source::Raw(data) }
            }
            other => return Err(format!("unknown format \"{other}\"")),
        };
        // Writers leave an empty array inline without even a header.
        if format == "binary" && source.is_empty() {
            return from_text("", scalar, expected, &mut self.budget);
        }
        from_bytes(&mut source, self.encoding, scalar, expected, &mut self.budget)
    }
}

/// The number of values that an attribute of a piece asks for, some for each of what it counts.
fn count(piece: Node, attribute: &str, values_each: u64) -> Result<Option<Expected>, String> {
    let Some(text) = piece.attribute(attribute) else { return Ok(None) };
    let count: u64 = text.trim().parse().map_err(|_| format!("`{attribute}` = \"{text}\" is no count"))?;
    let by = format!("`{attribute}` = \"{text}\"");
    Ok(Some(Expected { count: count.saturating_mul(values_each), by }))
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|n| n.has_tag_name(name))
}

/// Triangles of a convex polygon around its first corner.
fn fan(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    if let [first, rest @ ..] = corners {
        triangles.extend(rest.windows(2).map(|edge| [*first, edge[0], edge[1]]));
    }
}

/// Triangles of a strip: each corner forms one with the two before it, in alternating sense.
fn strip(corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    for (i, w) in corners.windows(3).enumerate() {
        triangles.push(if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] });
    }
}
