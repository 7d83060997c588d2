//! Files made to exhaust a reader: for its tests, and for the fuzzer, which measures time and memory.

use std::io::Write as _;

/// A file and a part of the error it must end in.
pub(crate) struct Hostile {
    pub(crate) name: &'static str,
    pub(crate) bytes: Vec<u8>,
    pub(crate) error: &'static str,
}

/// The files; those that get their size from repetition have about `n` bytes or some multiple of it.
pub(crate) fn hostile(n: usize) -> Vec<Hostile> {
    let one = |name, error, bytes: Vec<u8>| Hostile { name, bytes, error };
    let mut all = vec![
        one("count_beyond_length", "4294967295 triangles need 214748364834 bytes, the file has 134", {
            [&[0; 80][..], &[255; 4], &[0; 50]].concat()
        }),
        one("long_word", "expected normal", format!("solid\nfacet {}", "x".repeat(n)).into()),
        one("endless_facets", "expected facet or endsolid", {
            let facet =
                "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop endfacet ";
            format!("solid\n{}", facet.repeat(n / 80)).into()
        }),
        one("long_number", "not finite", {
            let number = "9".repeat(n);
            format!("solid\nfacet normal 0 0 0 outer loop vertex {number} 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet endsolid").into()
        }),
    ];
    all.extend(xml(n));
    all.extend(arrays(n));
    all.extend(bombs(n));
    all
}

/// The XML itself is the weapon.
fn xml(n: usize) -> Vec<Hostile> {
    let file = |name, error, inside: String| Hostile {
        name,
        bytes: format!("<VTKFile type=\"PolyData\">{inside}</VTKFile>").into(),
        error,
    };
    let attributes = |from: &str| (0..n / 8).map(|i| format!(" {from}{i}='{i}'")).collect::<String>();
    let namespaces = (0..n / 16).map(|i| format!("<a xmlns:n{i}='{i}'>"));
    let empty = "zero triangles";
    vec![
        file(
            "depth",
            if n / 3 > 1 << 16 { "more than 65536 tags" } else { "damaged XML" },
            "<a>".repeat(n / 3),
        ),
        file("tags", if n / 4 > 1 << 16 { "more than 65536 tags" } else { empty }, "<a/>".repeat(n / 4)),
        file("brackets", "is longer than 4096 bytes", "<".repeat(n)),
        file("attributes", "is longer than 4096 bytes", format!("<a b='>'{}/>", attributes("c"))),
        file(
            "short_tags_of_attributes",
            if n > 500_000 { "equals signs" } else { empty },
            format!("<a{}'/>", attributes("c")[..2000.min(n / 2)].trim_end_matches('\''))
                .repeat(n / 2000 + 1),
        ),
        file("namespaces", "declare a namespace", namespaces.collect()),
        file("references", empty, "&#65;".repeat(n / 5)),
        file("equals_signs", if n > 1 << 16 { "equals signs" } else { empty }, "=".repeat(n)),
        file("carriage_returns", empty, "\r".repeat(n)),
        file(
            "pieces",
            if n / 8 > 1 << 16 { "more than 65536 tags" } else { empty },
            "<Piece/>".repeat(n / 8),
        ),
        file(
            "comments",
            if n / 7 > 1 << 16 { "more than 65536 tags" } else { empty },
            "<!---->".repeat(n / 7),
        ),
        file(
            "sections",
            if n / 14 > 1 << 16 { "more than 65536 tags" } else { empty },
            "<![CDATA[1]]>0".repeat(n / 14),
        ),
        Hostile {
            name: "entities",
            bytes: {
                let levels =
                    (1..10).map(|i| format!("<!ENTITY e{i} \"{}\">", format!("&e{};", i - 1).repeat(10)));
                let levels: String = levels.collect();
                format!("<!DOCTYPE a [<!ENTITY e0 \"0\">{levels}]><VTKFile type=\"PolyData\">&e9;</VTKFile>")
                    .into()
            },
            error: "DTD",
        },
    ]
}

/// The numbers lie.
fn arrays(n: usize) -> Vec<Hostile> {
    let points = |attributes: &str, bytes: &[u8]| {
        let piece = format!(
            "<Piece {attributes}><Points><DataArray type=\"Float32\" format=\"appended\" offset=\"0\"/></Points></Piece>"
        );
        appended("header_type=\"UInt64\"", &piece, bytes)
    };
    let one_point = [&12u64.to_le_bytes()[..], &[0; 12]].concat();
    let cells = |offsets: &str| {
        format!(
            "<VTKFile type=\"PolyData\"><Piece><Points><DataArray type=\"Float32\">0 0 0</DataArray></Points><Polys>\
             <DataArray type=\"Int64\" Name=\"connectivity\">0 0 0</DataArray>\
             <DataArray type=\"Int64\" Name=\"offsets\">{offsets}</DataArray></Polys></Piece></VTKFile>"
        )
        .into_bytes()
    };
    let same_place =
        "<Piece><Points><DataArray type=\"UInt8\" format=\"appended\" offset=\"0\"/></Points></Piece>";
    let n_points = n as u64 / 3 * 3;
    let shared = [&n_points.to_le_bytes()[..], &vec![0; n_points as usize]].concat();
    let pieces = same_place.repeat((n / 80 + 20).min(2000));
    let one = |name, error, bytes| Hostile { name, bytes, error };
    vec![
        one("length", "1152921504606846976 bytes announced, 0 left", points("", &(1u64 << 60).to_le_bytes())),
        one(
            "points",
            "holds 3 values, but `NumberOfPoints` = \"1000000000000\" asks for 3000000000000",
            points("NumberOfPoints=\"1000000000000\"", &one_point),
        ),
        one(
            "points_overflow",
            "asks for 18446744073709551615",
            points("NumberOfPoints=\"18446744073709551615\"", &one_point),
        ),
        one(
            "points_negative",
            "`NumberOfPoints` = \"-1\" is no count",
            points("NumberOfPoints=\"-1\"", &one_point),
        ),
        one(
            "cell_end",
            "holds 3 values, but the end of the last cell asks for 1099511627776",
            cells("1099511627776"),
        ),
        one("cells_backwards", "cell 1 runs from 3 to 1", cells("3 1 3")),
        one("cell_negative", "-3 is no index", cells("-3")),
        one("same_place", "more than 16 times", appended("header_type=\"UInt64\"", &pieces, &shared)),
        one("same_place_base64", "more than 16 times", {
            use base64::{Engine, engine::general_purpose::STANDARD};
            let text = STANDARD.encode(shared);
            let file = appended("header_type=\"UInt64\"", &pieces, text.as_bytes());
            String::from_utf8(file).expect("text").replace("encoding=\"raw\"", "encoding=\"base64\"").into()
        }),
        one("offset", "offset \"18446744073709551615\" is not within", {
            let piece = same_place.replace("\"0\"", "\"18446744073709551615\"");
            appended("", &piece, &[])
        }),
        one("number_of_components", "`NumberOfComponents` = \"4000000000\"", {
            let piece = same_place.replace("offset", "NumberOfComponents=\"4000000000\" offset");
            appended("", &piece, &[0; 4])
        }),
    ]
}

/// Few bytes that unpack to many.
fn bombs(n: usize) -> Vec<Hostile> {
    let zlib = |data: &[u8]| {
        let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
        encoder.write_all(data).expect("vectors grow");
        encoder.finish().expect("vectors grow")
    };
    let points =
        "<Piece><Points><DataArray type=\"UInt8\" format=\"appended\" offset=\"0\"/></Points></Piece>";
    let file = |compressor: &str, header: &[u32], blocks: &[u8]| {
        let header: Vec<u8> = header.iter().flat_map(|count| count.to_le_bytes()).collect();
        appended(&format!("compressor=\"{compressor}\""), points, &[&header, blocks].concat())
    };
    let (by_zlib, by_lz4) = ("vtkZLibDataCompressor", "vtkLZ4DataCompressor");
    let size = 300 * n as u32;
    let zeros = vec![0; size as usize];
    let (small, smaller) = (zlib(&zeros), lz4_flex::block::compress(&zeros));
    let one = |name, error, bytes| Hostile { name, bytes, error };
    vec![
        one("zlib_bomb", "more than 16 times", file(by_zlib, &[1, size, 0, small.len() as u32], &small)),
        one(
            "zlib_bomb_in_secret",
            "unpacks to more than 30 bytes",
            file(by_zlib, &[1, 30, 0, small.len() as u32], &small),
        ),
        one("lz4_bomb", "more than 16 times", file(by_lz4, &[1, size, 0, smaller.len() as u32], &smaller)),
        one(
            "lz4_bomb_in_secret",
            "block 0 is damaged",
            file(by_lz4, &[1, 30, 0, smaller.len() as u32], &smaller),
        ),
        one("zlib_claim", "cannot unpack to 4294967295", file(by_zlib, &[1, u32::MAX, 0, 2], &[0; 2])),
        one("lz4_claim", "cannot unpack to 4294967295", file(by_lz4, &[1, u32::MAX, 0, 2], &[0; 2])),
        one(
            "blocks",
            "a header of 4294967295 compressed blocks: 17179869180 bytes announced",
            file(by_zlib, &[u32::MAX, 1, 0], &[0; 9]),
        ),
        one("empty_blocks", "block 0 is damaged", file(by_zlib, &[n as u32, 0, 0], &vec![0; 4 * n])),
    ]
}

fn appended(attributes: &str, inside: &str, bytes: &[u8]) -> Vec<u8> {
    let head = format!("<VTKFile type=\"PolyData\" {attributes}>{inside}<AppendedData encoding=\"raw\">_");
    [head.as_bytes(), bytes].concat()
}
