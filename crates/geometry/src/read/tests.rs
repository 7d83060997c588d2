//! Readers against files made here in every way the formats allow, and against damaged ones.

use std::path::Path;

use proptest::prelude::*;

use super::{
    hostile::hostile,
    parse_surface,
    samples::{corners, stl_binary, stl_text, variants},
};
use crate::{error::GeometryError, shapes, surface::Surface};

fn read(bytes: &[u8]) -> Result<Surface, GeometryError> {
    parse_surface(bytes, Path::new("test"))
}

/// Single precision, so that every format can hold it exactly.
fn pipe() -> Surface {
    shapes::pipe(1.5, 4.0, glam::DVec3::new(0.2, 0.3, 1.0), 8).map(|v| v.as_vec3().as_dvec3())
}

#[test]
fn stl_binary_whatever_its_header_says() {
    for header in [&b""[..], b"solid made by hand", b"SOLID"] {
        assert_eq!(corners(&read(&stl_binary(&pipe(), header)).expect("a valid file")), corners(&pipe()));
    }
}

#[test]
fn stl_text_in_its_variants() {
    let text = stl_text(&pipe());
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
    let whole = stl_binary(&pipe(), b"");
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

    let damaged = stl_text(&pipe()).replacen("endloop", "endlop", 1);
    let error = read(damaged.as_bytes()).expect_err("a misspelt word");
    assert_eq!(error.to_string(), "line 7 of \"test\": expected endloop, found \"endlop\"");
}

#[test]
fn vtp_in_all_its_variants() {
    for variant in variants() {
        let surface = read(&variant.file(&pipe())).unwrap_or_else(|e| panic!("{variant:?}: {e}"));
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
    let text = String::from_utf8(variants()[0].file(&pipe())).expect("text");
    let named = text.replace("type=\"PolyData\"", "type=\"PolyData\" compressor=\"vtkLZMADataCompressor\"");
    assert_eq!(read(named.as_bytes()).expect("nothing is compressed"), pipe());
}

#[test]
fn vtp_pieces_join() {
    let one = String::from_utf8(variants()[0].file(&pipe())).expect("text");
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
    let mut files: Vec<Vec<u8>> = variants().iter().step_by(5).map(|variant| variant.file(&pipe())).collect();
    files.extend([stl_binary(&pipe(), b"solid"), stl_text(&pipe()).into_bytes()]);
    for file in files {
        for length in (0..file.len()).step_by(file.len() / 200) {
            if let Ok(surface) = read(&file[..length]) {
                assert!(surface.triangles.len() <= pipe().triangles.len());
            }
        }
    }
}

#[test]
fn files_made_to_exhaust_the_reader_are_refused_by_name() {
    let mut faults = Vec::new();
    for file in hostile(100_000) {
        let error = read(&file.bytes).expect_err(file.name).to_string();
        if !error.contains(file.error) || !error.contains("\"test\"") {
            faults.push(format!("{}: {error}", file.name));
        }
    }
    assert_eq!(faults, Vec::<String>::new());
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn mutated_files_never_panic(
        which in 0usize..194,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut file = match which {
            192 => stl_binary(&pipe(), b"solid"),
            193 => stl_text(&pipe()).into_bytes(),
            v => variants()[v].file(&pipe()),
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
