//! The codes in a page against the series it was made from, and the room they take.

use super::body::Body;
use super::{bodies, codes, markup};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;
use serde_json::Value;
use std::path::Path;
use vaso_io::{
    Frame, SeriesReader, SeriesWriter, Summary, SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter,
};

const SPACING: f64 = 1e-3;
const FRAMES: usize = 6;

/// A sheet of `side` by `side` points in m whose middle has no stress, with an index that comes with the fourth frame.
fn wall(out: &Path, side: u32, moves: bool) {
    let point = |k: u32| DVec3::new(f64::from(k % side), f64::from(k / side), 0.0) * SPACING;
    let points: Vec<DVec3> = (0..side * side).map(point).collect();
    let quads = (0..side - 1).flat_map(|j| (0..side - 1).map(move |i| j * side + i));
    let triangles: Vec<[u32; 3]> =
        quads.flat_map(|a| [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]]).collect();
    let field =
        |name, components| SurfaceField { name, components, unit: "Pa", definition: "", citation: "" };
    let fields = [field("WSS", 3), field("TAWSS", 1), field("OSI", 1), field("Normal", 3)];
    let mesh = SurfaceMesh { points: &points, triangles: &triangles };
    let mut series = SurfaceSeriesWriter::create(out.join("wall.vtkhdf"), mesh, &fields).unwrap();
    for k in 0..FRAMES {
        let mut stress: Vec<DVec3> =
            points.iter().map(|x| DVec3::X * (1.0 + k as f64 + x.y / SPACING)).collect();
        stress[points.len() / 2] = DVec3::NAN;
        let mean: Vec<f64> = points.iter().map(|x| x.x).collect();
        let moved: Vec<DVec3> = points.iter().map(|x| *x + DVec3::Z * 1e-4 * k as f64).collect();
        series
            .append(&SurfaceFrame {
                time: 0.1 * k as f64,
                points: moves.then_some(&moved[..]),
                scalars: if k == 3 { vec![("TAWSS", &mean)] } else { Vec::new() },
                vectors: vec![("WSS", &stress)],
            })
            .unwrap();
    }
}

/// Particles of a block in m above the sheet: one leaves and one comes each frame.
fn blood(out: &Path, side: u64) {
    let mut series = SeriesWriter::create(out.join("fluid.vtkhdf"));
    for k in 0..FRAMES as u64 {
        let ids: Vec<u64> = (k..k + side * side * side).collect();
        let place = |id: &u64| [id % side, id / side % side, id / side / side].map(|x| x as f64);
        let position: Vec<DVec3> = ids.iter().map(|id| DVec3::from(place(id)) * SPACING).collect();
        let velocity: Vec<DVec3> = position.iter().map(|x| DVec3::Y * x.z).collect();
        let pressure = vec![100.0 + k as f64; ids.len()];
        series
            .append(&Frame {
                time: 0.1 * k as f64,
                position: &position,
                scalars: vec![("Pressure", &pressure)],
                vectors: vec![("Velocity", &velocity)],
                ids: Some(&ids),
            })
            .unwrap();
    }
}

/// The table of contents and the codes of a page.
fn unpacked(html: &str) -> (Value, Vec<u16>) {
    let element = |id: &str| {
        let after = html.split_once(&format!("id=\"{id}\">")).unwrap().1;
        after.split_once("</script>").unwrap().0
    };
    let bytes = STANDARD.decode(element("viewer-codes")).unwrap();
    let codes = bytes.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
    (serde_json::from_str(element("viewer-scene")).unwrap(), codes)
}

fn bytes(bodies: &[Body]) -> usize {
    bodies.iter().map(Body::bytes).sum()
}

#[test]
fn what_is_unpacked_is_what_the_series_holds() {
    let out = tempfile::tempdir().unwrap();
    wall(out.path(), 8, false);
    blood(out.path(), 8);
    let (scene, codes) =
        unpacked(&markup(&bodies(out.path(), SPACING, 1_000_000).unwrap(), &Summary::default()));
    let number = |value: &Value| value.as_f64().unwrap();
    let place = |value: &Value| value.as_u64().unwrap() as usize;

    let shown = &scene["bodies"][0];
    let frame = SeriesReader::open(&out.path().join("wall.vtkhdf")).unwrap().frame(4).unwrap();
    assert!((number(&shown["times"][4]) - 0.4).abs() < 1e-12);
    let at = place(&shown["places"][4][0]);
    for (i, x) in frame.position.iter().enumerate() {
        for k in 0..3 {
            let back =
                number(&shown["low"][k]) + number(&shown["step"][k]) * f64::from(codes[at + 3 * i + k]);
            assert!((back - x[k]).abs() <= 7e-3 / codes::STEPS, "{back} for {}", x[k]);
        }
    }
    // The sheet does not move, so all frames share their positions; triangles are there as they were.
    assert!(shown["places"].as_array().unwrap().iter().all(|p| p == &shown["places"][0]));
    assert_eq!(place(&shown["triangles"][1]), 98);
    assert_eq!(codes[place(&shown["triangles"][0])..][..3], [0, 1, 8]);

    let names: Vec<&str> =
        shown["fields"].as_array().unwrap().iter().map(|f| f["name"].as_str().unwrap()).collect();
    assert_eq!(
        names,
        ["WSS", "TAWSS", "Pressure"],
        "what has no value anywhere, and normals, colour nothing"
    );
    let stress = &shown["fields"][0];
    let at = place(&stress["values"][4]);
    for (i, v) in frame.vector("WSS").unwrap().iter().enumerate() {
        let code = codes[at + i];
        assert_eq!(v.is_nan(), code == codes::MISSING);
        let back = number(&stress["low"]) + number(&stress["step"]) * f64::from(code);
        assert!(v.is_nan() || (back - v.length()).abs() <= 12.0 / codes::STEPS, "{back} for {v}");
    }
    // The index is missing up to the third frame and then stays: two states for six frames.
    let index: Vec<usize> = shown["fields"][1]["values"].as_array().unwrap().iter().map(place).collect();
    assert!(index[0] == index[2] && index[3] == index[5] && index[2] != index[3], "{index:?}");
    assert_eq!(codes[index[0]], codes::MISSING);
    // The pressure of the blood above it is the same everywhere.
    let pressure = &shown["fields"][2];
    let code = codes[place(&pressure["values"][2]) + 20];
    assert!((number(&pressure["low"]) + number(&pressure["step"]) * f64::from(code) - 102.0).abs() < 1e-3);
    assert_eq!(scene["bodies"][1]["places"][0][1], 512);
}

#[test]
fn the_room_is_kept_whatever_a_run_holds() {
    let out = tempfile::tempdir().unwrap();
    wall(out.path(), 60, true);
    blood(out.path(), 24);
    let words = |bodies: &[Body]| bodies.iter().map(|b| b.extent.clone()).collect::<Vec<_>>().join("\n");
    let all = bodies(out.path(), SPACING, 10_000_000).unwrap();
    assert!(words(&all).contains("all 6 saved steps"), "{}", words(&all));
    let mut last = bytes(&all);
    for room in [1_000_000, 300_000, 150_000, 60_000, 20_000, 1000, 0] {
        let some = bodies(out.path(), SPACING, room).unwrap();
        assert!(bytes(&some) <= room && bytes(&some) <= last, "{} of {room}", bytes(&some));
        last = bytes(&some);
        if room == 300_000 {
            assert!(words(&some).contains(" of 6 saved steps"), "{}", words(&some));
            assert!(words(&some).contains(" of 13\u{202f}824 particles"), "{}", words(&some));
        }
    }
    assert_eq!(last, 0);
    assert_eq!(markup(&[], &Summary::default()), "");
}

#[test]
fn a_surface_of_too_many_points_is_thinned_and_says_so() {
    let out = tempfile::tempdir().unwrap();
    wall(out.path(), 300, false);
    let shown = bodies(out.path(), SPACING, 4_000_000).unwrap();
    assert!(shown[0].extent.contains("thinned from 90\u{202f}000 points"), "{}", shown[0].extent);
    let points = |body: &Body| body.position.states[0].len();
    assert!((20_000..=60_000).contains(&points(&shown[0])), "{}", points(&shown[0]));
    // Where there is room for few frames, points are given up for more of them.
    let less = bodies(out.path(), SPACING, 500_000).unwrap();
    assert!(points(&less[0]) <= 15_000 && less[0].times.len() > 3, "{}", less[0].extent);
}

#[test]
fn names_cannot_leave_the_table() {
    let out = tempfile::tempdir().unwrap();
    wall(out.path(), 4, false);
    let mut summary = Summary::default();
    let mut opening = vaso_io::OpeningSummary::default();
    opening.opening.name = "</script><script>alert(1)".into();
    summary.openings = vec![opening];
    let html = markup(&bodies(out.path(), SPACING, 100_000).unwrap(), &summary);
    assert_eq!(html.matches("<script").count(), 3);
    assert_eq!(unpacked(&html).0["openings"][0]["name"], "</script><script>alert(1)");
}
