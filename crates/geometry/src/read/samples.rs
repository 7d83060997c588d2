//! Files of a surface in every way the formats allow: for the tests of the readers and the corpus of the fuzzer.

use std::{fmt::Write as _, io::Write as _};

use base64::{Engine, engine::general_purpose::STANDARD};

use crate::Surface;

/// The same triangles by their corners, for formats without shared vertices.
pub(crate) fn corners(surface: &Surface) -> Vec<[glam::DVec3; 3]> {
    (0..surface.triangles.len()).map(|t| surface.triangle(t)).collect()
}

pub(crate) fn stl_binary(surface: &Surface, header: &[u8]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((surface.triangles.len() as u32).to_le_bytes());
    for triangle in corners(surface) {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flat_map(|v| v.as_vec3().to_array()).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

pub(crate) fn stl_text(surface: &Surface) -> String {
    let mut text = "solid pipe of facet normal\n".to_owned();
    for triangle in corners(surface) {
        text += "facet normal nan 0 0\n outer loop\n";
        for v in triangle {
            writeln!(text, "  vertex {:e} {:e} {:e}", v.x, v.y, v.z).expect("strings grow");
        }
        text += " endloop\nendfacet\n";
    }
    text + "endsolid pipe of facet normal\n"
}

/// Ways to store an array.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Storage {
    Ascii,
    Inline,
    AppendedBase64,
    AppendedRaw,
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Variant {
    pub(crate) storage: Storage,
    pub(crate) compressor: &'static str,
    pub(crate) wide_header: bool,
    pub(crate) big_endian: bool,
    pub(crate) double: bool,
    pub(crate) strips: bool,
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

    pub(crate) fn file(&self, surface: &Surface) -> Vec<u8> {
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
        let coordinates: Vec<f64> = surface.vertices.iter().flat_map(|v| v.to_array()).collect();
        let point_bytes = coordinates.iter().flat_map(|&x| {
            if self.double { self.word(x.to_bits(), 8) } else { self.word((x as f32).to_bits().into(), 4) }
        });
        let points = array(
            "Points",
            if self.double { "Float64" } else { "Float32" },
            list(&mut coordinates.iter().map(|x| format!("{x:e}"))),
            point_bytes.collect(),
        );
        let corners: Vec<u64> = surface.triangles.iter().flatten().map(|&v| v.into()).collect();
        let ends: Vec<u64> = (1..=surface.triangles.len() as u64).map(|i| 3 * i).collect();
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
            surface.vertices.len()
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
pub(crate) fn variants() -> Vec<Variant> {
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
