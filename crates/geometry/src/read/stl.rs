//! STL, binary and text.
//!
//! Binary files are decoded by `stl_io`, after the length has been held against the header. Text is read here:
//! `stl_io` takes neither capital letters nor a byte order mark, drops all solids but the first, and cannot say
//! in which line a file is damaged.

use std::{io::Cursor, path::Path};

use glam::DVec3;

use crate::{error::GeometryError, surface::Surface};

const HEADER: usize = 84;
const RECORD: u64 = 50;
/// Each triangle brings three vertices, whose numbers have 32 bits, with one left as a mark.
const MAX_TRIANGLES: u32 = (u32::MAX - 1) / 3;

/// Reads an STL file.
pub(super) fn parse(bytes: &[u8], path: &Path) -> Result<Surface, GeometryError> {
    match binary_count(bytes) {
        Some(count) if bytes.len() as u64 == length(count) => binary(bytes, count, path),
        announced => match text(bytes) {
            Some(text) => ascii(&text, path),
            None => Err(damaged(announced, bytes, path)),
        },
    }
}

/// The number of triangles a binary header announces; `None` for a file too short to have a header.
fn binary_count(bytes: &[u8]) -> Option<u32> {
    let field = bytes.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes([field[0], field[1], field[2], field[3]]))
}

/// Bytes a binary file of so many triangles has.
fn length(count: u32) -> u64 {
    HEADER as u64 + RECORD * u64::from(count)
}

fn damaged(announced: Option<u32>, bytes: &[u8], path: &Path) -> GeometryError {
    match announced {
        Some(count) => GeometryError::StlLength {
            path: path.to_owned(),
            count,
            expected: length(count),
            found: bytes.len() as u64,
        },
        None => GeometryError::UnknownFormat { path: path.to_owned() },
    }
}

fn binary(bytes: &[u8], count: u32, path: &Path) -> Result<Surface, GeometryError> {
    if count > MAX_TRIANGLES {
        return Err(too_many(count.into(), path));
    }
    let mut bytes = bytes.to_vec();
    // The length has decided; a header that starts with "solid" must not decide otherwise.
    bytes[..HEADER - 4].fill(0);
    let failed = |source| GeometryError::Read { path: path.to_owned(), source };
    let mut file = Cursor::new(bytes);
    // The file is as long as the count says, so it may be trusted.
    let mut surface = Surface {
        vertices: Vec::with_capacity(3 * count as usize),
        triangles: Vec::with_capacity(count as usize),
    };
    for triangle in stl_io::create_stl_reader(&mut file).map_err(failed)? {
        let corners = triangle.map_err(failed)?.vertices;
        push_triangle(&mut surface, corners.map(|v| DVec3::from_array(v.0.map(f64::from))));
    }
    Ok(surface)
}

fn too_many(count: u64, path: &Path) -> GeometryError {
    GeometryError::TooManyTriangles { path: path.to_owned(), count, limit: MAX_TRIANGLES.into() }
}

/// Adds a triangle with vertices of its own; equal ones become one in the repair.
fn push_triangle(surface: &mut Surface, corners: [DVec3; 3]) {
    let first = surface.vertices.len() as u32;
    surface.vertices.extend(corners);
    surface.triangles.push([first, first + 1, first + 2]);
}

/// The file as text without a byte order mark, if it begins like a text STL.
///
/// Names of solids may be in any encoding, so what is no UTF-8 is replaced, not refused.
fn text(bytes: &[u8]) -> Option<String> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = bytes.trim_ascii_start();
    let is_solid = start.get(..5)?.eq_ignore_ascii_case(b"solid");
    // A zero byte is never part of a text, but is part of every binary header in practice.
    (is_solid && !bytes.contains(&0)).then(|| String::from_utf8_lossy(bytes).into_owned())
}

/// Words of a text with their line, counted from 1.
struct Words<'a> {
    path: &'a Path,
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    rest: std::str::SplitWhitespace<'a>,
    line: usize,
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a str> {
        loop {
            if let Some(word) = self.rest.next() {
                return Some(word);
            }
            let (number, line) = self.lines.next()?;
            self.line = number + 1;
            self.rest = line.split_whitespace();
        }
    }

    fn skip_line(&mut self) {
        self.rest = "".split_whitespace();
    }

    fn expected<T>(&self, expected: &'static str, found: Option<&str>) -> Result<T, GeometryError> {
        // A damaged file may hold a "word" of megabytes.
        let found = found.unwrap_or_default().chars().take(40).collect();
        Err(GeometryError::StlText { path: self.path.to_owned(), line: self.line, expected, found })
    }

    fn keyword(&mut self, expected: &'static str) -> Result<(), GeometryError> {
        match self.next() {
            Some(word) if word.eq_ignore_ascii_case(expected) => Ok(()),
            found => self.expected(expected, found),
        }
    }

    fn number(&mut self) -> Result<f64, GeometryError> {
        let word = self.next();
        match word.and_then(|w| w.parse().ok()) {
            Some(number) => Ok(number),
            None => self.expected("a number", word),
        }
    }

    fn vector(&mut self) -> Result<DVec3, GeometryError> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }
}

fn ascii(text: &str, path: &Path) -> Result<Surface, GeometryError> {
    let mut words = Words { path, lines: text.lines().enumerate(), rest: "".split_whitespace(), line: 0 };
    let mut surface = Surface::default();
    while let Some(word) = words.next() {
        if !word.eq_ignore_ascii_case("solid") {
            return words.expected("solid", Some(word));
        }
        // The rest of the line is the name, whatever words it is made of.
        words.skip_line();
        facets(&mut words, &mut surface)?;
    }
    Ok(surface)
}

/// Reads the facets of a solid up to and with its `endsolid`.
fn facets(words: &mut Words, surface: &mut Surface) -> Result<(), GeometryError> {
    loop {
        match words.next() {
            Some(word) if word.eq_ignore_ascii_case("endsolid") => {
                words.skip_line();
                return Ok(());
            }
            Some(word) if word.eq_ignore_ascii_case("facet") => {}
            found => return words.expected("facet or endsolid", found),
        }
        words.keyword("normal")?;
        // Normals are not trusted, and exporters write "nan" for triangles without area.
        words.vector()?;
        words.keyword("outer")?;
        words.keyword("loop")?;
        let mut corners = [DVec3::ZERO; 3];
        for corner in &mut corners {
            words.keyword("vertex")?;
            *corner = words.vector()?;
        }
        words.keyword("endloop")?;
        words.keyword("endfacet")?;
        if surface.triangles.len() >= MAX_TRIANGLES as usize {
            return Err(too_many(surface.triangles.len() as u64 + 1, words.path));
        }
        push_triangle(surface, corners);
    }
}
