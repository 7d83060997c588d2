//! Readers against files made here in every way the formats allow, and against damaged ones.

use std::{fmt::Write as _, io::Write as _, path::Path};

use base64::{Engine, engine::general_purpose::STANDARD};
use proptest::prelude::*;

use super::parse;
use crate::{error::GeometryError, shapes, surface::Surface};

fn read(bytes: &[u8]) -> Result<Surface, GeometryError> {
    parse(bytes, Path::new("test"))
}

/// Single precision, so that every format can hold it exactly.
fn pipe() -> Surface {
    shapes::pipe(1.5, 4.0, glam::DVec3::new(0.2, 0.3, 1.0), 8).map(|v| v.as_vec3().as_dvec3())
}

/// The same triangles by their corners, for formats without shared vertices.
fn corners(surface: &Surface) -> Vec<[glam::DVec3; 3]> {
    (0..surface.triangles.len()).map(|t| surface.triangle(t)).collect()
}

fn stl_binary(header: &[u8]) -> Vec<u8> {
    let pipe = pipe();
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((pipe.triangles.len() as u32).to_le_bytes());
    for triangle in corners(&pipe) {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flat_map(|v| v.as_vec3().to_array()).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

fn stl_text() -> String {
    let mut text = "solid pipe of facet normal\n".to_owned();
    for triangle in corners(&pipe()) {
        text += "facet normal nan 0 0\n outer loop\n";
        for v in triangle {
            writeln!(text, "  vertex {:e} {:e} {:e}", v.x, v.y, v.z).expect("strings grow");
        }
        text += " endloop\nendfacet\n";
    }
    text + "endsolid pipe of facet normal\n"
}

#[test]
fn stl_binary_whatever_its_header_says() {
    for header in [&b""[..], b"solid made by hand", b"SOLID"] {
        assert_eq!(corners(&read(&stl_binary(header)).expect("a valid file")), corners(&pipe()));
    }
}

#[test]
fn stl_text_in_its_variants() {
    let text = stl_text();
    let upper = text.to_uppercase();
    let marked = format!("\u{feff}{text}");
    let dos = text.replace('\n', "\r\n").replace(' ', "\t");
    for variant in [&text, &upper, &marked, &dos] {
        assert_eq!(corners(&read(variant.as_bytes()).expect("a valid file")), corners(&pipe()));
    }
    let twice = read((text.clone() + &text).as_bytes()).expect("two solids in a file");
    assert_eq!(twice.triangles.len(), 2 * pipe().triangles.len());
    let mut latin = b"solid caf\xe9\n".to_vec();
    latin.extend(&text.as_bytes()[text.find('\n').expect("lines")..]);
    assert_eq!(corners(&read(&latin).expect("a name in another encoding")), corners(&pipe()));
}

#[test]
fn stl_defects_have_their_names() {
    let whole = stl_binary(b"");
    assert!(matches!(
        read(&whole[..whole.len() - 70]),
        Err(GeometryError::StlLength { found, expected, .. }) if expected == found + 70
    ));
    assert!(matches!(read(&[0; 84]), Err(GeometryError::EmptyFile { .. })));
    assert!(matches!(read(b""), Err(GeometryError::UnknownFormat { .. })));
    assert!(matches!(read(b"solid nothing\nendsolid\n"), Err(GeometryError::EmptyFile { .. })));

    let mut nan = whole.clone();
    nan[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(matches!(read(&nan), Err(GeometryError::NotFiniteInFile { triangle: 1, .. })));

    let damaged = stl_text().replacen("endloop", "endlop", 1);
    let error = read(damaged.as_bytes()).expect_err("a misspelt word");
    assert_eq!(error.to_string(), "line 7 of \"test\": expected endloop, found \"endlop\"");
}

/// Ways to store an array.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Storage {
    Ascii,
    Inline,
    AppendedBase64,
    AppendedRaw,
}

#[derive(Debug, Clone, Copy)]
struct Variant {
    storage: Storage,
    compressor: &'static str,
    wide_header: bool,
    big_endian: bool,
    double: bool,
    strips: bool,
}

/// Blocks small enough that arrays take several.
const BLOCK: usize = 256;

impl Variant {
    fn word(&self, value: u64, bytes: usize) -> Vec<u8> {
        let mut word = value.to_le_bytes()[..bytes].to_vec();
        if self.big_endian {
            word.reverse();
        }
        word
    }

    fn count(&self, value: usize) -> Vec<u8> {
        self.word(value as u64, if self.wide_header { 8 } else { 4 })
    }

    /// Header and data of an array.
    fn pack(&self, data: &[u8]) -> (Vec<u8>, Vec<u8>) {
        if self.compressor.is_empty() {
            return (self.count(data.len()), data.to_vec());
        }
        let blocks: Vec<Vec<u8>> = data.chunks(BLOCK).map(|block| self.compress(block)).collect();
        let mut header = self.count(blocks.len());
        header.extend(self.count(BLOCK));
        header.extend(self.count(data.len() % BLOCK));
        header.extend(blocks.iter().flat_map(|b| self.count(b.len())));
        (header, blocks.concat())
    }

    fn compress(&self, block: &[u8]) -> Vec<u8> {
        if self.compressor == "vtkLZ4DataCompressor" {
            return lz4_flex::block::compress(block);
        }
        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
        encoder.write_all(block).expect("vectors grow");
        encoder.finish().expect("vectors grow")
    }

    fn file(&self) -> Vec<u8> {
        let pipe = pipe();
        let mut appended = Vec::new();
        let mut array = |name: &str, kind: &str, text: String, data: Vec<u8>| {
            let (header, data) = self.pack(&data);
            let start = format!("<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"3\"");
            let both = STANDARD.encode(&header) + &STANDARD.encode(&data);
            match self.storage {
                Storage::Ascii => format!("{start} format=\"ascii\">\n{text}\n</DataArray>\n"),
                Storage::Inline => format!("{start} format=\"binary\">\n  {both}\n</DataArray>\n"),
                Storage::AppendedBase64 | Storage::AppendedRaw => {
                    let offset = appended.len();
                    if self.storage == Storage::AppendedRaw {
                        appended.extend([header, data].concat());
                    } else {
                        appended.extend(both.into_bytes());
                    }
                    format!("{start} format=\"appended\" offset=\"{offset}\"/>\n")
                }
            }
        };
        let list = |numbers: &mut dyn Iterator<Item = String>| numbers.collect::<Vec<_>>().join(" ");
        let coordinates: Vec<f64> = pipe.vertices.iter().flat_map(|v| v.to_array()).collect();
        let point_bytes = coordinates.iter().flat_map(|&x| {
            if self.double { self.word(x.to_bits(), 8) } else { self.word((x as f32).to_bits().into(), 4) }
        });
        let points = array(
            "Points",
            if self.double { "Float64" } else { "Float32" },
            list(&mut coordinates.iter().map(|x| format!("{x:e}"))),
            point_bytes.collect(),
        );
        let corners: Vec<u64> = pipe.triangles.iter().flatten().map(|&v| v.into()).collect();
        let ends: Vec<u64> = (1..=pipe.triangles.len() as u64).map(|i| 3 * i).collect();
        let mut indices = |name: &str, values: &[u64]| {
            let bytes = values.iter().flat_map(|&v| self.word(v, 8)).collect();
            array(name, "Int64", list(&mut values.iter().map(u64::to_string)), bytes)
        };
        let cells = indices("connectivity", &corners) + &indices("offsets", &ends);
        let section = if self.strips { "Strips" } else { "Polys" };
        let order = if self.big_endian { "BigEndian" } else { "LittleEndian" };
        let width = if self.wide_header { "UInt64" } else { "UInt32" };
        let compressor = if self.compressor.is_empty() {
            String::new()
        } else {
            format!(" compressor=\"{}\"", self.compressor)
        };
        let mut bytes = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{order}\" \
             header_type=\"{width}\"{compressor}>\n<PolyData><Piece NumberOfPoints=\"{}\">\n\
             <Points>{points}</Points>\n<{section}>{cells}</{section}></Piece></PolyData>\n",
            pipe.vertices.len()
        )
        .into_bytes();
        if !appended.is_empty() {
            let kind = if self.storage == Storage::AppendedRaw { "raw" } else { "base64" };
            bytes.extend(format!("<AppendedData encoding=\"{kind}\">\n_").into_bytes());
            bytes.extend(appended);
            bytes.extend(b"\n</AppendedData>\n");
        }
        bytes.extend(b"</VTKFile>\n");
        bytes
    }
}

/// Every way to write the pipe.
fn variants() -> Vec<Variant> {
    let mut all = Vec::new();
    for storage in [Storage::Ascii, Storage::Inline, Storage::AppendedBase64, Storage::AppendedRaw] {
        for compressor in ["", "vtkZLibDataCompressor", "vtkLZ4DataCompressor"] {
            for bits in 0..16 {
                let flag = |k: u32| bits >> k & 1 == 1;
                let (wide_header, big_endian, double, strips) = (flag(0), flag(1), flag(2), flag(3));
                all.push(Variant { storage, compressor, wide_header, big_endian, double, strips });
            }
        }
    }
    all
}

#[test]
fn vtp_in_all_its_variants() {
    for variant in variants() {
        let surface = read(&variant.file()).unwrap_or_else(|e| panic!("{variant:?}: {e}"));
        assert_eq!(surface, pipe(), "{variant:?}");
    }
}

#[test]
fn vtp_polygons_and_strips_become_triangles() {
    let file = |section: &str| {
        format!(
            "<VTKFile type=\"PolyData\"><PolyData><Piece><Points><DataArray type=\"Float32\">\
             0 0 0  1 0 0  1 1 0  0 1 0</DataArray></Points><{section}>\
             <DataArray type=\"Int32\" Name=\"connectivity\">0 1 2 3</DataArray>\
             <DataArray type=\"Int32\" Name=\"offsets\">4</DataArray></{section}></Piece></PolyData></VTKFile>"
        )
    };
    let fan = read(file("Polys").as_bytes()).expect("a polygon");
    assert_eq!(fan.triangles, vec![[0, 1, 2], [0, 2, 3]]);
    let strip = read(file("Strips").as_bytes()).expect("a strip");
    assert_eq!(strip.triangles, vec![[0, 1, 2], [2, 1, 3]]);
    let beyond = file("Polys").replace("0 1 2 3<", "0 1 2 4<");
    let error = read(beyond.as_bytes()).expect_err("a point that is not there");
    assert_eq!(error.to_string(), "array \"Polys/connectivity\" of \"test\": cell 0 names point 4 of 4");
}

#[test]
fn a_compressor_does_not_matter_to_text() {
    let text = String::from_utf8(variants()[0].file()).expect("text");
    let named = text.replace("type=\"PolyData\"", "type=\"PolyData\" compressor=\"vtkLZMADataCompressor\"");
    assert_eq!(read(named.as_bytes()).expect("nothing is compressed"), pipe());
}

#[test]
fn vtp_pieces_join() {
    let one = String::from_utf8(variants()[0].file()).expect("text");
    let (start, end) = (one.find("<Piece").expect("a piece"), one.find("</PolyData>").expect("its end"));
    let piece = one[start..end].to_owned();
    let two = read((one[..end].to_owned() + &piece + &one[end..]).as_bytes()).expect("two pieces");
    assert_eq!(two.triangles.len(), 2 * pipe().triangles.len());
    assert_eq!(
        two.triangles[pipe().triangles.len()],
        pipe().triangles[0].map(|v| v + pipe().vertices.len() as u32)
    );
}

#[test]
fn vtp_that_cannot_be_read_says_why() {
    let lzma = "<VTKFile type=\"PolyData\" compressor=\"vtkLZMADataCompressor\"><DataArray format=\"binary\"/></VTKFile>";
    assert!(read(lzma.as_bytes()).expect_err("lzma").to_string().contains("save it again with zlib"));
    let grid = "<VTKFile type=\"UnstructuredGrid\"/>";
    assert!(read(grid.as_bytes()).expect_err("a grid").to_string().contains("UnstructuredGrid"));
    assert!(matches!(read(b"<VTKFile type=\"PolyData\"/>"), Err(GeometryError::EmptyFile { .. })));
    assert!(matches!(read(b"<?xml version=\"1.0\"?><VTKFile type"), Err(GeometryError::Vtp { .. })));
}

#[test]
fn truncated_files_are_errors_or_parts_but_never_panics() {
    let mut files: Vec<Vec<u8>> = variants().iter().step_by(5).map(Variant::file).collect();
    files.extend([stl_binary(b"solid"), stl_text().into_bytes()]);
    for file in files {
        for length in (0..file.len()).step_by(file.len() / 200) {
            if let Ok(surface) = read(&file[..length]) {
                assert!(surface.triangles.len() <= pipe().triangles.len());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn mutated_files_never_panic(
        which in 0usize..194,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut file = match which {
            192 => stl_binary(b"solid"),
            193 => stl_text().into_bytes(),
            v => variants()[v].file(),
        };
        for (place, byte) in changes {
            let at = place.index(file.len());
            file[at] = byte;
        }
        if let Ok(surface) = read(&file) {
            let vertices = surface.vertices.len();
            prop_assert!(surface.vertices.iter().all(|v| v.is_finite()));
            prop_assert!(surface.triangles.iter().flatten().all(|&v| (v as usize) < vertices));
            // Whatever was read must get through the repair as well, or be refused by it.
            let _ = crate::prepare(surface, None);
        }
    }
}
