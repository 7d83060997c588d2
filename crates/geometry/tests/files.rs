//! Real and synthetic surfaces of the data folder, against the figures of its READMEs.

use std::path::{Path, PathBuf};

use glam::{DQuat, DVec3};
use vaso_geometry::{LengthUnit, Vessel, prepare, read_surface};

/// The folder of surfaces, or `None` (with a word) when the data are not there.
fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("VASO_DATA").map(|data| Path::new(&data).join("geometry"));
    if folder.is_none() {
        println!("skipped: VASO_DATA is not set");
    }
    folder
}

fn vessel(file: &Path, unit: LengthUnit) -> Vessel {
    let raw = read_surface(file).unwrap_or_else(|e| panic!("{e}"));
    prepare(raw, Some(unit)).unwrap_or_else(|e| panic!("{}: {e}", file.display()))
}

/// What a README says about one cap, in the unit of the file.
struct Cap {
    center: [f64; 3],
    normal: [f64; 3],
    area: f64,
}

const fn cap(center: [f64; 3], normal: [f64; 3], area: f64) -> Cap {
    Cap { center, normal, area }
}

/// Centre within 0.01 R, normal within 0.2 degrees, area within 0.5 %, largest first, nothing more and nothing less.
fn assert_openings(vessel: &Vessel, caps: &[Cap], what: &str) {
    assert_openings_to(vessel, caps, 0.005, what);
}

fn assert_openings_to(vessel: &Vessel, caps: &[Cap], area_tolerance: f64, what: &str) {
    let m = vessel.unit.metres();
    assert_eq!(vessel.openings.len(), caps.len(), "{what}: {:#?}", vessel.audit);
    let mut order: Vec<&Cap> = caps.iter().collect();
    order.sort_by(|a, b| b.area.total_cmp(&a.area));
    for (k, cap) in order.into_iter().enumerate() {
        let center = DVec3::from(cap.center) * m;
        let near = vessel.opening_near(center).expect("there are openings");
        let opening = &vessel.openings[near];
        // Equal areas may come in any order; others have theirs.
        assert!(near == k || (opening.area / vessel.openings[k].area - 1.0).abs() < 0.01, "{what}: order");
        let off = opening.center.distance(center) / opening.radius;
        assert!(off < 0.01, "{what}: opening {k} is off by {off} radii");
        let angle = opening.normal.angle_between(DVec3::from(cap.normal)).to_degrees();
        assert!(angle < 0.2, "{what}: normal of opening {k} is off by {angle} degrees");
        let area = opening.area / (cap.area * m * m) - 1.0;
        assert!(area.abs() < area_tolerance, "{what}: area of opening {k} is off by {area}");
        let faces = (0..vessel.surface.triangles.len())
            .filter(|&t| vessel.face_opening[t] == Some(near as u32))
            .map(|t| vessel.surface.triangle_area(t));
        assert!((faces.sum::<f64>() / opening.area - 1.0).abs() < 1e-3, "{what}: triangles of opening {k}");
        assert!((opening.radius - (opening.area / std::f64::consts::PI).sqrt()).abs() < 1e-12);
    }
}

fn assert_volume(vessel: &Vessel, volume: f64, tolerance: f64, what: &str) {
    let found = vessel.surface.volume() / vessel.unit.metres().powi(3);
    assert!((found / volume - 1.0).abs() < tolerance, "{what}: volume {found}, not {volume}");
    assert!(vessel.audit.watertight, "{what}: {:#?}", vessel.audit);
}

const CAROTID: [Cap; 3] = [
    cap([1.53284, 5.86492, -31.8504], [0.0, 0.0, -1.0], 30.917),
    cap([-2.96225, -0.454908, 22.2244], [-0.31623, 0.0, 0.94868], 14.79),
    cap([8.99225, 0.936548, 19.1242], [0.0, 0.0, 1.0], 7.2103),
];

#[test]
fn carotid_in_millimetres() {
    let Some(data) = data() else { return };
    let vessel = vessel(&data.join("carotid_bifurcation/carotid_lumen.stl"), LengthUnit::Millimetre);
    assert_volume(&vessel, 1866.83, 1e-5, "carotid");
    assert!((vessel.surface.area() * 1e6 / 1321.66 - 1.0).abs() < 1e-5);
    assert_openings(&vessel, &CAROTID, "carotid");
    assert_eq!(vessel.audit.repairs, Vec::<String>::new());
    assert_eq!((vessel.audit.triangles, vessel.audit.vertices), (15068, 7536));
}

#[test]
fn carotid_in_metres_and_inside_out() {
    let Some(data) = data() else { return };
    let raw = read_surface(&data.join("carotid_bifurcation/carotid_lumen_m.vtp")).expect("a valid file");
    assert!((raw.volume() / -1.865e-6 - 1.0).abs() < 1e-4);
    let vessel = prepare(raw, None).expect("a vessel");
    assert_eq!(vessel.unit, LengthUnit::Metre);
    assert!(vessel.audit.unit_guessed && vessel.audit.notices[0].contains("no unit given"));
    assert_volume(&vessel, 1.865e-6, 1e-4, "carotid in metres");
    assert_eq!(vessel.audit.repairs, vec!["reversed all triangles"]);
    let caps = [
        cap([0.00153306, 0.00586392, -0.0318504], [0.0, 0.0, -1.0], 3.0682e-5),
        cap([-0.00296085, -0.000453265, 0.0222249], [-0.31623, 0.0, 0.94868], 1.4654e-5),
        cap([0.00899288, 0.000938274, 0.0191242], [0.0, 0.0, 1.0], 7.1829e-6),
    ];
    assert_openings(&vessel, &caps, "carotid in metres");
}

#[test]
fn aorta_has_six_openings() {
    let Some(data) = data() else { return };
    let vessel = vessel(&data.join("aorta_arch_vmr0024/aorta_lumen.stl"), LengthUnit::Centimetre);
    assert_volume(&vessel, 65.0976, 1e-5, "aorta");
    let caps = [
        cap([-0.99097, 4.55483, 2.86329], [-0.099966, -0.16654, -0.98095], 5.9765),
        cap([-1.6126, -0.820754, 0.396201], [-0.032667, 0.072868, -0.99681], 2.67),
        cap([-1.07689, 1.08227, 9.58872], [0.56749, 0.42793, 0.70344], 0.51337),
        cap([-2.91904, 1.80104, 9.91123], [-0.14714, -0.18125, 0.97237], 0.39485),
        cap([-1.01479, 4.27462, 10.01], [0.64205, 0.41095, 0.64722], 0.26888),
        cap([-2.64414, 3.05343, 10.8116], [-0.098751, 0.048501, 0.99393], 0.22298),
    ];
    assert_openings(&vessel, &caps, "aorta");
}

#[test]
fn aorta_with_a_flat_facet_that_is_no_cap() {
    let Some(data) = data() else { return };
    let vessel = vessel(&data.join("aorta_arch_vmr0024/aorta_lumen_shrunk.stl"), LengthUnit::Centimetre);
    assert_volume(&vessel, 51.8453, 1e-5, "shrunk aorta");
    let caps = [
        cap([-0.996182, 4.55331, 2.86408], [-0.099966, -0.16654, -0.98095], 5.0106),
        cap([-1.61296, -0.820602, 0.396227], [-0.032666, 0.072869, -0.99681], 2.0457),
        cap([-1.07905, 1.08069, 9.59141], [0.56748, 0.42794, 0.70344], 0.249),
        cap([-2.92008, 1.80022, 9.91092], [-0.14714, -0.18126, 0.97236], 0.17159),
        cap([-1.01382, 4.27396, 10.0095], [0.64206, 0.41094, 0.64722], 0.090006),
        cap([-2.64454, 3.05345, 10.8116], [-0.098772, 0.048502, 0.99393], 0.067281),
    ];
    assert_openings(&vessel, &caps, "shrunk aorta");
    // The facet is seen, and turned down.
    let facet = DVec3::new(-0.932327, 3.30598, 3.23515) * 1e-2;
    let near = vessel.audit.flat_regions.iter().find(|r| r.center.distance(facet) < 5e-4);
    assert!(near.is_none_or(|region| region.rejected.is_some()));
}

#[test]
fn stenosed_tube_has_two_openings() {
    let Some(data) = data() else { return };
    let vessel = vessel(&data.join("stenosed_tube_sphinxsys/stenosed_tube.stl"), LengthUnit::Millimetre);
    assert_volume(&vessel, 2713.34, 1e-5, "stenosed tube");
    let caps = [cap([100.0, 0.0, 0.0], [1.0, 0.0, 0.0], 28.131), cap([0.0; 3], [-1.0, 0.0, 0.0], 28.131)];
    assert_openings(&vessel, &caps, "stenosed tube");
}

/// Caps, volume and area of the synthetic set, from its `ground_truth.json` [mm].
#[test]
fn synthetic_set_against_its_ground_truth() {
    let Some(data) = data() else { return };
    let carotid = [
        cap([0.0, 0.0, -24.0], [0.0, 0.0, -1.0], 32.03987),
        cap([10.98825, 0.0, 23.56392], [0.422618, 0.0, 0.906308], 15.80426),
        cap([-10.9887, 0.0, 23.56371], [-0.422618, 0.0, 0.906308], 11.22543),
    ];
    let tube = |area| [cap([0.0; 3], [0.0, 0.0, -1.0], area), cap([0.0, 0.0, 40.0], [0.0, 0.0, 1.0], area)];
    let bend = [
        cap([25.0, 0.0, 0.0], [0.0, -1.0, 0.0], 50.18478),
        cap([-25.0, 0.0, 0.0], [0.0, -1.0, 0.0], 50.18478),
    ];
    let stenosis = [
        cap([0.0, 0.0, -24.0], [0.0, 0.0, -1.0], 28.22894),
        cap([0.0, 0.0, 60.0], [0.0, 0.0, 1.0], 28.22894),
    ];
    let junction = [
        cap([-22.0, 0.0, 0.0], [-1.0, 0.0, 0.0], 28.11962),
        cap([22.0, 0.0, 0.0], [1.0, 0.0, 0.0], 28.13883),
        cap([0.0, 0.0, 20.0], [0.0, 0.0, 1.0], 19.49715),
    ];
    let truth: [(&str, f64, f64, &[Cap]); 11] = [
        ("carotid.stl", 1648.478859, 1230.744220, &carotid),
        ("carotid_binary.vtp", 1648.478859, 1230.744220, &carotid),
        ("carotid_open.stl", 1648.478859, 1230.744220, &carotid),
        ("carotid_dirty.stl", 1648.478859, 1230.744220, &carotid),
        ("straight_tube.stl", 1130.166058, 810.355966, &tube(28.254152)),
        ("straight_tube_open.stl", 1130.166058, 810.355966, &tube(28.254152)),
        ("straight_tube_ascii.stl", 1127.746301, 809.831364, &tube(28.193658)),
        ("straight_tube_ascii.vtp", 1130.166058, 810.355966, &tube(28.254152)),
        ("straight_tube_coarse.stl", 1102.128273, 804.253246, &tube(27.553207)),
        ("curved_tube_180.stl", 3941.302914, 2073.435184, &bend),
        ("stenosis_75.stl", 2233.441926, 1588.953194, &stenosis),
    ];
    for (name, volume, area, caps) in
        truth.into_iter().chain([("t_junction.stl", 1575.10496, 1157.072333, &junction[..])])
    {
        let vessel = vessel(&data.join("synthetic").join(name), LengthUnit::Millimetre);
        assert_volume(&vessel, volume, 1e-5, name);
        assert!((vessel.surface.area() * 1e6 / area - 1.0).abs() < 1e-5, "{name}: area");
        assert_openings_to(&vessel, caps, 0.005, name);
    }
}

#[test]
fn turned_and_moved_vessels_have_the_same_openings() {
    let Some(data) = data() else { return };
    let turn = DQuat::from_axis_angle(DVec3::new(0.3, -0.8, 0.5).normalize(), 0.7);
    for (file, unit) in [
        ("carotid_bifurcation/carotid_lumen.stl", LengthUnit::Millimetre),
        ("aorta_arch_vmr0024/aorta_lumen.stl", LengthUnit::Centimetre),
        ("aorta_arch_vmr0024/aorta_lumen_shrunk.stl", LengthUnit::Centimetre),
        ("synthetic/carotid_open.stl", LengthUnit::Millimetre),
    ] {
        let raw = read_surface(&data.join(file)).expect("a valid file");
        let shift = DVec3::new(1.0, -2.0, 0.5) * 500.0;
        let here = prepare(raw.clone(), Some(unit)).expect("a vessel");
        let there = prepare(raw.map(|v| turn * v + shift), Some(unit)).expect("a vessel");
        assert_eq!(here.openings.len(), there.openings.len());
        for (a, b) in here.openings.iter().zip(&there.openings) {
            let moved = turn * a.center + shift * unit.metres();
            assert!(moved.distance(b.center) < 1e-9, "{file}: centre");
            assert!((turn * a.normal).distance(b.normal) < 1e-9, "{file}: normal");
            assert!((a.area / b.area - 1.0).abs() < 1e-9, "{file}: area");
        }
        assert_eq!(here.face_opening, there.face_opening, "{file}");
    }
}
