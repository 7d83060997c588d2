//! The defect set of the data folder: one clean carotid, and what exporters, tools and copies did to it. Each row of its
//! README with what comes out and what is said about it.

use std::path::{Path, PathBuf};

use glam::DVec3;
use vaso_geometry::{GeometryError, LengthUnit, SignedDistance, Vessel, prepare, read_surface};

/// The folder of the set, or `None` (with a word) when the data are not there.
fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("VASO_DATA").map(|data| Path::new(&data).join("geometry/defects"));
    if folder.is_none() {
        println!("skipped: VASO_DATA is not set");
    }
    folder
}

/// A file that becomes the clean vessel, in millimetres.
struct Row {
    name: &'static str,
    /// Triangles in the file.
    triangles: usize,
    /// What is said to have been changed.
    repairs: &'static [&'static str],
    /// Boundary loops of the triangles as they are.
    loops: usize,
    /// Largest part by which volume and area may differ from those of the clean file.
    tolerance: f64,
}

/// Rounding of sums in another order.
const SAME: f64 = 1e-12;
/// Caps of other triangles: the borders of the file are plane to its single precision, so about 1e-6 of the size.
const OTHER_CAPS: f64 = 1e-5;

const ACCEPTED: [Row; 9] = [
    Row { name: "00_base.stl", triangles: 3314, repairs: &[], loops: 0, tolerance: SAME },
    Row {
        name: "01_reversed_normals.stl",
        triangles: 3314,
        repairs: &["reversed all triangles"],
        loops: 0,
        tolerance: SAME,
    },
    Row {
        name: "02_mixed_winding.stl",
        triangles: 3314,
        // A fifth of them.
        repairs: &["reversed 662 of 3314 triangles"],
        loops: 0,
        tolerance: SAME,
    },
    Row {
        name: "04_open_inlet.stl",
        triangles: 3288,
        repairs: &["closed an open end of radius 3.1294 mm at [1.6558, 6.0437, -31.8496] mm"],
        loops: 1,
        tolerance: OTHER_CAPS,
    },
    Row {
        name: "05_all_caps_open.stl",
        triangles: 3261,
        repairs: &[
            "closed an open end of radius 1.5055 mm at [8.9560, 0.9905, 19.1214] mm",
            "closed an open end of radius 2.1622 mm at [-2.9508, -0.5463, 22.2279] mm",
            "closed an open end of radius 3.1294 mm at [1.6558, 6.0437, -31.8496] mm",
        ],
        loops: 3,
        tolerance: OTHER_CAPS,
    },
    Row {
        name: "06_duplicate_triangles.stl",
        triangles: 3354,
        repairs: &["dropped 40 duplicate triangles"],
        loops: 0,
        tolerance: SAME,
    },
    Row {
        name: "07_zero_area_slivers.stl",
        triangles: 3344,
        repairs: &["dropped 30 triangles without area"],
        loops: 0,
        tolerance: SAME,
    },
    Row {
        name: "08_floating_component.stl",
        triangles: 3634,
        repairs: &["dropped 1 floating component(s) of less than 1 % of the area (320 triangles)"],
        loops: 0,
        tolerance: SAME,
    },
    Row {
        name: "18_binary_starting_with_solid.stl",
        triangles: 3314,
        repairs: &[],
        loops: 0,
        tolerance: SAME,
    },
];

/// Files with a test of their own below.
const OTHERS: [&str; 3] = ["13_metres.stl", "19_truncated.stl", "20_empty.stl"];

/// Centre, outward normal and area of the caps by the README of the carotid [mm]; the set has fewer triangles, and so a
/// little less area.
const CAPS: [([f64; 3], [f64; 3], f64); 3] = [
    ([1.53284, 5.86492, -31.8504], [0.0, 0.0, -1.0], 30.917),
    ([-2.96225, -0.454908, 22.2244], [-0.31623, 0.0, 0.94868], 14.79),
    ([8.99225, 0.936548, 19.1242], [0.0, 0.0, 1.0], 7.2103),
];

fn load(folder: &Path, name: &str, unit: Option<LengthUnit>) -> Vessel {
    let raw = read_surface(&folder.join(name)).unwrap_or_else(|e| panic!("{e}"));
    prepare(raw, unit).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn assert_closed_with_three_caps(vessel: &Vessel, name: &str) {
    let audit = &vessel.audit;
    assert!(audit.watertight && audit.orientable, "{name}: {audit:#?}");
    assert_eq!((audit.components, audit.non_manifold_edges, audit.holes_filled), (1, 0, 0), "{name}");
    assert_eq!(vessel.openings.len(), 3, "{name}: {audit:#?}");
    for (opening, (center, normal, area)) in vessel.openings.iter().zip(CAPS) {
        let center = DVec3::from(center) * 1e-3;
        assert!(opening.center.distance(center) < 0.02 * opening.radius, "{name}: {opening:?}");
        assert!(opening.normal.angle_between(DVec3::from(normal)).to_degrees() < 0.2, "{name}");
        assert!((opening.area * 1e6 / area - 1.0).abs() < 0.02, "{name}: {}", opening.area);
    }
}

#[test]
fn the_set_is_tested_to_the_last_file() {
    let Some(folder) = folder() else { return };
    let mut tested: Vec<&str> = ACCEPTED.iter().map(|row| row.name).chain(OTHERS).collect();
    tested.sort_unstable();
    let readme = std::fs::read_to_string(folder.join("README.md")).expect("the set has a README");
    let listed: Vec<&str> =
        readme.lines().filter_map(|line| line.strip_prefix("| ")?.split(' ').next()).skip(1).collect();
    assert_eq!(listed, tested, "files of the README, and those tested here");
}

#[test]
fn repaired_files_become_the_clean_vessel() {
    let Some(folder) = folder() else { return };
    let base = load(&folder, "00_base.stl", Some(LengthUnit::Millimetre));
    // Figures of the README.
    assert!((base.surface.volume() * 1e9 / 1865.28 - 1.0).abs() < 1e-5);
    assert!((base.surface.area() * 1e6 / 1321.72 - 1.0).abs() < 1e-5);
    for row in ACCEPTED {
        let name = row.name;
        let vessel = load(&folder, name, Some(LengthUnit::Millimetre));
        assert_eq!(vessel.audit.repairs, row.repairs, "{name}");
        assert_eq!(vessel.audit.notices, Vec::<String>::new(), "{name}");
        assert_eq!(
            (vessel.audit.triangles_read, vessel.audit.boundary_loops),
            (row.triangles, row.loops),
            "{name}"
        );
        // Open ends are closed with as many triangles as they had: both fill the border without a vertex inside.
        assert_eq!((vessel.audit.triangles, vessel.audit.vertices), (3314, 1659), "{name}");
        assert_closed_with_three_caps(&vessel, name);
        let volume = vessel.surface.volume() / base.surface.volume() - 1.0;
        let area = vessel.surface.area() / base.surface.area() - 1.0;
        assert!(volume.abs() < row.tolerance && area.abs() < row.tolerance, "{name}: {volume:e}, {area:e}");
        assert!((vessel.wall_area() / base.wall_area() - 1.0).abs() < SAME, "{name}: area of the wall");
        let normals = (0..vessel.surface.triangles.len()).map(|t| vessel.surface.triangle_normal(t).length());
        assert!(normals.into_iter().all(|length| (length - 1.0).abs() < 1e-12), "{name}: unit normals");
    }
}

#[test]
fn normals_of_repaired_files_point_out_of_the_lumen() {
    let Some(folder) = folder() else { return };
    for name in ["01_reversed_normals.stl", "02_mixed_winding.stl", "07_zero_area_slivers.stl"] {
        let vessel = load(&folder, name, Some(LengthUnit::Millimetre));
        let distance = SignedDistance::closed(&vessel);
        for t in (0..vessel.surface.triangles.len()).step_by(37) {
            let middle = vessel.surface.triangle(t).iter().sum::<DVec3>() / 3.0;
            let step = 1e-5 * vessel.surface.triangle_normal(t);
            assert!(distance.query(middle + step).distance > 0.0, "{name}: before triangle {t}");
            assert!(distance.query(middle - step).distance < 0.0, "{name}: behind triangle {t}");
        }
    }
}

#[test]
fn metres_are_guessed_with_a_notice() {
    let Some(folder) = folder() else { return };
    let vessel = load(&folder, "13_metres.stl", None);
    assert_eq!((vessel.unit, vessel.audit.unit_guessed), (LengthUnit::Metre, true));
    let notice = "no unit given: took \"m\", which makes the vessel 58.7337 mm across its bounding box";
    assert_eq!(vessel.audit.notices, [notice]);
    assert_closed_with_three_caps(&vessel, "metres");
    let base = load(&folder, "00_base.stl", None);
    assert_eq!(base.unit, LengthUnit::Millimetre);
    // Both files round their coordinates to single precision, each in its own unit.
    assert!((vessel.openings[0].area / base.openings[0].area - 1.0).abs() < 1e-6);
    assert!((vessel.surface.volume() / base.surface.volume() - 1.0).abs() < 1e-6);
    let given = load(&folder, "13_metres.stl", Some(LengthUnit::Metre));
    assert_eq!((given.surface, given.audit.notices.len()), (vessel.surface, 0));
}

#[test]
fn damaged_files_are_refused_by_name() {
    let Some(folder) = folder() else { return };
    let refused = |name: &str| read_surface(&folder.join(name)).expect_err("a damaged file was accepted");
    let cut = refused("19_truncated.stl");
    assert!(matches!(cut, GeometryError::StlLength { count: 3314, expected: 165_784, found: 82_892, .. }));
    let path = folder.join("19_truncated.stl");
    assert_eq!(
        cut.to_string(),
        format!(
            "the count in the header of \"{}\" does not fit the length: 3314 triangles need 165784 bytes, the file \
             has 82892; export or copy the file again",
            path.display()
        )
    );
    let empty = refused("20_empty.stl");
    assert!(matches!(empty, GeometryError::EmptyFile { .. }));
    assert_eq!(
        empty.to_string(),
        format!(
            "\"{}\" has zero triangles; export the surface, not its points or lines",
            folder.join("20_empty.stl").display()
        )
    );
}
