//! Surfaces with made defects: what is repaired, what is said, and that the result is the clean one.

use glam::DVec3;
use proptest::prelude::*;
use vaso_geometry::{GeometryError, LengthUnit, Rejection, SignedDistance, Surface, Vessel, prepare, shapes};

const RADIUS: f64 = 3e-3;
const LENGTH: f64 = 30e-3;

fn pipe() -> Surface {
    shapes::pipe(RADIUS, LENGTH, DVec3::Z, 48)
}

fn vessel(surface: Surface) -> Vessel {
    prepare(surface, Some(LengthUnit::Metre)).unwrap_or_else(|e| panic!("{e}"))
}

fn centroid(surface: &Surface, t: usize) -> DVec3 {
    surface.triangle(t).iter().sum::<DVec3>() / 3.0
}

fn without(surface: &Surface, gone: impl Fn(usize) -> bool) -> Surface {
    let kept = (0..surface.triangles.len()).filter(|&t| !gone(t)).map(|t| surface.triangles[t]).collect();
    Surface { vertices: surface.vertices.clone(), triangles: kept }
}

fn join(mut first: Surface, second: &Surface) -> Surface {
    let offset = first.vertices.len() as u32;
    first.vertices.extend(&second.vertices);
    first.triangles.extend(second.triangles.iter().map(|t| t.map(|v| v + offset)));
    first
}

fn assert_is_the_pipe(found: &Vessel, tolerance: f64) {
    let exact = pipe().volume();
    assert!((found.surface.volume() / exact - 1.0).abs() < tolerance, "{:#?}", found.audit);
    assert!(found.audit.watertight && found.audit.orientable && found.audit.non_manifold_edges == 0);
    assert_eq!((found.openings.len(), found.audit.components), (2, 1), "{:#?}", found.audit);
    for z in [0.0, LENGTH] {
        let end = DVec3::new(0.0, 0.0, z);
        let opening = &found.openings[found.opening_near(end).expect("two openings")];
        assert!(opening.center.distance(end) < 1e-9 && (opening.radius / RADIUS - 1.0).abs() < 3e-3);
    }
}

#[test]
fn holes_in_the_wall_are_filled_and_are_no_openings() {
    let whole = pipe();
    let near = |t: usize, place: DVec3, radius: f64| centroid(&whole, t).distance(place) < radius;
    let (one, two) = (DVec3::new(RADIUS, 0.0, 0.01), DVec3::new(0.0, -RADIUS, 0.022));
    let holed = without(&whole, |t| near(t, one, 0.9e-3) || near(t, two, 0.5e-3));
    let found = vessel(holed);
    assert_eq!((found.audit.boundary_loops, found.audit.holes_filled), (2, 2));
    assert!(found.audit.repairs.iter().all(|r| r.starts_with("filled a hole of radius")));
    assert_is_the_pipe(&found, 2e-3);
}

#[test]
fn holes_that_touch_at_a_vertex_are_filled() {
    let whole = pipe();
    // Two triangles that share a vertex and no edge.
    let first = (0..whole.triangles.len()).find(|&t| centroid(&whole, t).z > 0.01).expect("wall");
    let shares = |t: usize| whole.triangles[t].iter().filter(|v| whole.triangles[first].contains(v)).count();
    let second = (0..whole.triangles.len()).find(|&t| shares(t) == 1).expect("a neighbour");
    let found = vessel(without(&whole, |t| t == first || t == second));
    assert_eq!(found.audit.holes_filled, 2);
    assert_is_the_pipe(&found, 1e-9);
}

#[test]
fn open_ends_and_mixed_senses_at_once() {
    let whole = pipe();
    let mut open = without(&whole, |t| whole.triangle_normal(t).z.abs() > 0.5);
    open.triangles.iter_mut().step_by(3).for_each(|t| t.swap(0, 1));
    let found = vessel(open);
    assert_eq!((found.audit.boundary_loops, found.audit.holes_filled), (2, 0));
    assert_is_the_pipe(&found, 1e-9);
}

#[test]
fn one_open_end_beside_one_cap() {
    let whole = pipe();
    let found = vessel(without(&whole, |t| whole.triangle_normal(t).z > 0.5));
    assert_eq!((found.audit.boundary_loops, found.audit.flat_regions.len()), (1, 1));
    assert_is_the_pipe(&found, 1e-9);
}

#[test]
fn a_jagged_end_is_an_opening_still() {
    let whole = pipe();
    let edge = std::f64::consts::TAU * RADIUS / 48.0;
    // Besides the cap every second triangle of the last row of the wall is missing.
    let jagged = without(&whole, |t| {
        whole.triangle_normal(t).z > 0.5 || (t % 2 == 0 && centroid(&whole, t).z > LENGTH - 0.6 * edge)
    });
    let found = vessel(jagged);
    assert_eq!(found.openings.len(), 2, "{:#?}", found.audit);
    assert!(found.audit.watertight);
    let end = found.opening_near(DVec3::new(0.0, 0.0, LENGTH)).expect("an opening");
    assert!(found.openings[end].normal.z > 0.99 && (found.openings[end].radius / RADIUS - 1.0).abs() < 0.02);
}

#[test]
fn sealed_parts_go_and_vessels_stay() {
    let sphere = |center: DVec3, radius: f64| {
        // A bent pipe closed nearly to a ring has caps; a sphere must not, so it is made from a pipe by
        // projection onto a sphere.
        let middle = DVec3::new(0.0, 0.0, 1.0);
        shapes::pipe(1.0, 2.0, DVec3::Z, 24).map(|v| center + radius * (v - middle).normalize())
    };
    // Beside the vessel, large enough not to be debris, and inside it, like a cavity.
    for place in [DVec3::new(0.02, 0.0, 0.01), DVec3::new(0.0, 0.0, 0.015)] {
        let found = vessel(join(pipe(), &sphere(place, 1.5e-3)));
        assert_eq!(found.audit.repairs.len(), 1);
        assert!(found.audit.repairs[0].starts_with("dropped 1 component(s) without any opening"));
        assert_is_the_pipe(&found, 1e-9);
    }
    let two = vessel(join(pipe(), &pipe().map(|v| v + DVec3::new(0.02, 0.0, 0.0))));
    assert_eq!((two.openings.len(), two.audit.components), (4, 2));
    assert!(two.audit.repairs.is_empty());
}

#[test]
fn without_openings_the_candidates_are_listed() {
    // A cube: flat sides that meet at corners, yet each could be a cap; a cone: one cap.
    let cone = {
        let n = 64;
        let ring = (0..n).map(|i| {
            let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / f64::from(n)).sin_cos();
            DVec3::new(cos, sin, 0.0)
        });
        let mut vertices: Vec<DVec3> = ring.collect();
        vertices.extend([DVec3::new(0.0, 0.0, 0.3), DVec3::ZERO]);
        let (tip, foot) = (n as u32, n as u32 + 1);
        let sides = (0..n as u32).flat_map(|i| {
            let j = (i + 1) % n as u32;
            [[i, j, tip], [j, i, foot]]
        });
        Surface { vertices, triangles: sides.collect() }
    };
    let found = vessel(cone);
    // The side meets the base at 163 degrees: too flat for the wall of a vessel.
    assert_eq!(found.openings.len(), 0);
    assert_eq!(found.opening_near(DVec3::ZERO), None);
    let base = &found.audit.flat_regions[0];
    assert_eq!(base.rejected, Some(Rejection::NoCorner));
    assert!((base.area / std::f64::consts::PI - 1.0).abs() < 2e-3 && base.circularity > 0.99);
}

/// Every face of a regular tetrahedron passes for a cap: flat, round enough, at corners, with lumen behind.
#[test]
fn hundreds_of_caps_are_none() {
    let tetrahedra = |n: u32| {
        let corners =
            [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]].map(|v| DVec3::from(v.map(f64::from)));
        let mut heap = Surface::default();
        for i in 0..n {
            let shift = 4.0 * f64::from(i) * DVec3::X;
            heap.vertices.extend(corners.map(|v| v + shift));
            heap.triangles.extend([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]].map(|t| t.map(|v| v + 4 * i)));
        }
        vessel(heap)
    };
    assert_eq!(tetrahedra(60).openings.len(), 240);
    let many = tetrahedra(70);
    assert_eq!(many.openings.len(), 0);
    assert!(many.audit.flat_regions.iter().all(|r| r.rejected == Some(Rejection::TooManyLarger)));
}

#[test]
fn a_square_duct_of_few_triangles_has_two_openings() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let vertices =
        [0.0, 5.0].iter().flat_map(|&z| corners.map(|[x, y]| 1e-3 * DVec3::new(x, y, z))).collect();
    let mut triangles = vec![[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]];
    triangles.extend((0..4).flat_map(|i| {
        let j = (i + 1) % 4;
        [[i, j, j + 4], [i, j + 4, i + 4]]
    }));
    let found = vessel(Surface { vertices, triangles });
    assert_eq!(found.openings.len(), 2, "{:#?}", found.audit);
    assert!(found.openings.iter().all(|o| (o.area / 1e-6 - 1.0).abs() < 1e-12 && o.normal.z.abs() > 0.999));
}

#[test]
fn a_guessed_unit_is_said_and_doubted_where_it_should_be() {
    for (scale, unit, doubted) in [
        (1.0, LengthUnit::Metre, false),
        (1e3, LengthUnit::Millimetre, false),
        (1e2, LengthUnit::Millimetre, true),
    ] {
        let found = prepare(pipe().map(|v| v * scale), None).expect("a vessel");
        assert_eq!((found.unit, found.audit.unit_guessed), (unit, true));
        let [notice] = &found.audit.notices[..] else { panic!("one notice: {:?}", found.audit.notices) };
        assert!(notice.starts_with("no unit given") && notice.contains("may as well") == doubted, "{notice}");
    }
    assert!(vessel(pipe()).audit.notices.is_empty());
}

#[test]
fn a_membrane_across_the_lumen_leaves_inside_inside() {
    // A ring of the wall closed by a disc: its border edges have three triangles.
    let mut surface = pipe();
    let ring: Vec<u32> = {
        let z = surface.vertices.iter().map(|v| v.z).filter(|z| *z > 0.01).fold(f64::INFINITY, f64::min);
        let mut on: Vec<u32> =
            (0..surface.vertices.len() as u32).filter(|&v| surface.vertices[v as usize].z == z).collect();
        on.sort_by(|&a, &b| {
            let angle = |v: u32| surface.vertices[v as usize].y.atan2(surface.vertices[v as usize].x);
            angle(a).total_cmp(&angle(b))
        });
        on
    };
    assert_eq!(ring.len(), 48);
    surface.triangles.extend(ring[1..].windows(2).map(|e| [ring[0], e[0], e[1]]));
    let found = vessel(surface);
    assert!(!found.audit.watertight && found.audit.non_manifold_edges == 48);
    assert!(found.audit.notices.iter().any(|n| n.contains("more than two triangles meet at 48 edges")));
    let distance = SignedDistance::closed(&found);
    for z in [0.002, 0.009, 0.012, 0.028] {
        assert!(distance.query(DVec3::new(1e-3, 0.5e-3, z)).distance < 0.0, "inside at {z}");
        assert!(distance.query(DVec3::new(4e-3, 0.5e-3, z)).distance > 0.0, "outside at {z}");
    }
    assert!(distance.query(DVec3::new(0.0, 0.0, -1e-3)).distance > 0.0);
}

#[test]
fn what_cannot_be_a_vessel_is_refused_by_name() {
    let refused = |surface: Surface| prepare(surface, Some(LengthUnit::Metre)).expect_err("no vessel");
    assert!(matches!(refused(Surface::default()), GeometryError::NoTriangles { read: 0 }));

    let mut nan = pipe();
    nan.vertices[7].y = f64::NAN;
    assert!(matches!(refused(nan), GeometryError::NotFinite { vertex: 7, .. }));

    let mut far = pipe();
    far.vertices[3].x = 1e40;
    assert!(matches!(refused(far), GeometryError::TooFar { vertex: 3, .. }));

    let mut range = pipe();
    range.triangles[5][2] = 1_000_000;
    assert!(matches!(refused(range), GeometryError::VertexRange { triangle: 5, vertex: 1_000_000, .. }));

    let line = Surface {
        vertices: vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X],
        triangles: vec![[0, 1, 2], [0, 0, 1]],
    };
    assert!(matches!(refused(line), GeometryError::NoTriangles { read: 2 }));

    let sheet = Surface {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    assert!(matches!(refused(sheet), GeometryError::NoVolume { .. }));
}

#[test]
fn a_stl_written_and_read_is_the_same_vessel() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("pipe.stl");
    vaso_geometry::write_stl(&path, &pipe()).expect("space on the disk");
    let back = vaso_geometry::read_surface(&path).expect("a valid file");
    assert_is_the_pipe(&vessel(back), 1e-6);
    let nowhere = folder.path().join("no/such/folder.stl");
    assert!(matches!(
        vaso_geometry::write_stl(&nowhere, &pipe()),
        Err(GeometryError::Write { path, .. }) if path == nowhere
    ));
    assert!(matches!(vaso_geometry::read_surface(&nowhere), Err(GeometryError::Read { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    /// Heaps of triangles on few vertices have every defect at once.
    #[test]
    fn heaps_of_triangles_are_refused_or_become_vessels(
        places in prop::collection::vec([-2i8..3, -2i8..3, -2i8..3], 4..20),
        picks in prop::collection::vec([any::<u8>(), any::<u8>(), any::<u8>()], 1..60),
    ) {
        let vertices: Vec<DVec3> = places.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
        let triangles = picks.iter().map(|p| p.map(|v| u32::from(v) % vertices.len() as u32)).collect();
        if let Ok(found) = prepare(Surface { vertices, triangles }, Some(LengthUnit::Metre)) {
            prop_assert!(found.surface.volume() > 0.0);
            prop_assert_eq!(found.face_opening.len(), found.surface.triangles.len());
            prop_assert_eq!(found.audit.triangles, found.surface.triangles.len());
            let known = found.openings.len() as u32;
            prop_assert!(found.face_opening.iter().flatten().all(|&k| k < known));
            for distance in [SignedDistance::closed(&found), SignedDistance::wall(&found)] {
                let nearest = distance.query(DVec3::new(0.3, 0.2, 0.1));
                prop_assert!(nearest.distance.abs() < 10.0 || nearest.distance == f64::INFINITY);
                prop_assert!(nearest.normal.is_finite());
            }
        }
    }

}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    /// A pipe from which any triangles are gone and turned round still has no wrong side.
    #[test]
    fn a_pipe_with_holes_keeps_its_inside(
        gone in prop::collection::vec(any::<prop::sample::Index>(), 0..12),
        turned in prop::collection::vec(any::<prop::sample::Index>(), 0..200),
    ) {
        let mut damaged = pipe();
        for place in turned {
            let t = place.index(damaged.triangles.len());
            damaged.triangles[t].swap(1, 2);
        }
        for place in gone {
            let t = place.index(damaged.triangles.len());
            damaged.triangles.remove(t);
        }
        let found = vessel(damaged);
        let relative = found.surface.volume() / pipe().volume();
        prop_assert!((relative - 1.0).abs() < 1e-2, "volume is {} of the whole, {:#?}", relative, found.audit);
        prop_assert_eq!(found.openings.len(), 2);
        let distance = SignedDistance::closed(&found);
        for i in 0..20 {
            let z = LENGTH * (f64::from(i) + 0.5) / 20.0;
            prop_assert!(distance.query(DVec3::new(0.5e-3, 0.0, z)).distance < 0.0);
            prop_assert!(distance.query(DVec3::new(0.0, 4e-3, z)).distance > 0.0);
        }
    }
}

#[test]
fn a_surface_that_cuts_itself_says_where() {
    let mut surface = pipe();
    // A point of the wall half way along, pushed through the far side.
    let half = |v: &DVec3| (v.z - 0.015).abs() + (v.x - 0.004).abs();
    let (k, _) =
        surface.vertices.iter().enumerate().min_by(|a, b| half(a.1).total_cmp(&half(b.1))).expect("a wall");
    surface.vertices[k].x = -0.006;
    let far = DVec3::new(-RADIUS, surface.vertices[k].y, surface.vertices[k].z);
    let found = vessel(surface);
    assert_eq!(found.audit.self_intersections, 1, "{:?}", found.audit.notices);
    let [notice] = &found.audit.notices[..] else { panic!("one notice: {:?}", found.audit.notices) };
    assert!(notice.starts_with("the surface cuts itself at 1 place, most around ["), "{notice}");
    let place = notice.split(['[', ']']).nth(1).expect("a place");
    let place: Vec<f64> = place.split(", ").map(|x| 1e-3 * x.parse::<f64>().expect("a number")).collect();
    assert!(DVec3::from_slice(&place).distance(far) < 0.1 * RADIUS, "{notice}");
    assert_eq!(found.openings.len(), 2);
}

#[test]
fn two_vessels_in_one_file_are_told_of() {
    let mut surface = pipe();
    let other = pipe().map(|v| v + DVec3::new(0.0, 0.02, 0.0));
    let first = surface.vertices.len() as u32;
    surface.vertices.extend(other.vertices);
    surface.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
    let found = vessel(surface);
    assert_eq!((found.audit.components, found.audit.self_intersections, found.openings.len()), (2, 0, 4));
    let [notice] = &found.audit.notices[..] else { panic!("one notice: {:?}", found.audit.notices) };
    assert!(notice.contains("in 2 separate parts"), "{notice}");
}
