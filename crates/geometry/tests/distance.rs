//! Signed distance and its lattice against formulas.

use std::f64::consts::PI;

use glam::DVec3;
use vaso_geometry::{DistanceGrid, LengthUnit, SignedDistance, Vessel, prepare, shapes};

const RADIUS: f64 = 3e-3;
const LENGTH: f64 = 20e-3;
const SEGMENTS: usize = 96;

fn pipe() -> Vessel {
    prepare(shapes::pipe(RADIUS, LENGTH, DVec3::Z, SEGMENTS), Some(LengthUnit::Metre)).expect("a clean pipe")
}

/// Places spread evenly over a box, the same every time (Kronecker sequence).
fn places(low: DVec3, high: DVec3, count: u32) -> impl Iterator<Item = DVec3> {
    let step = DVec3::new(0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_2);
    (1..=count).map(move |i| low + (high - low) * (f64::from(i) * step).fract())
}

/// Distance to a finite cylinder about the z axis, negative inside.
fn cylinder(x: DVec3) -> f64 {
    let side = x.truncate().length() - RADIUS;
    let end = (x.z - 0.5 * LENGTH).abs() - 0.5 * LENGTH;
    side.max(end).min(0.0) + side.max(0.0).hypot(end.max(0.0))
}

/// Largest distance of the polygon from its circle.
fn sagitta() -> f64 {
    RADIUS * (1.0 - (PI / SEGMENTS as f64).cos())
}

#[test]
fn distance_to_a_closed_pipe() {
    let vessel = pipe();
    let distance = SignedDistance::closed(&vessel);
    for x in places(DVec3::new(-6e-3, -6e-3, -5e-3), DVec3::new(6e-3, 6e-3, 25e-3), 20_000) {
        let (found, exact) = (distance.query(x), cylinder(x));
        assert!(
            (found.distance - exact).abs() <= sagitta() + 1e-12,
            "at {x}: {} not {exact}",
            found.distance
        );
        assert!((x.distance(found.point) - found.distance.abs()).abs() < 1e-15);
        let along = found.point + found.distance * found.normal;
        assert!(along.distance(x) < 1e-12, "the gradient at {x} does not lead back");
        assert!((found.normal.length() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn on_the_surface_the_normal_is_that_of_the_face() {
    let vessel = pipe();
    let distance = SignedDistance::closed(&vessel);
    for t in 0..vessel.surface.triangles.len() {
        let middle = vessel.surface.triangle(t).iter().sum::<DVec3>() / 3.0;
        let nearest = distance.query(middle);
        assert!(nearest.distance.abs() < 1e-15);
        assert!(nearest.normal.dot(vessel.surface.triangle_normal(t)) > 0.999_999);
        assert_eq!(nearest.triangle, t as u32);
    }
}

#[test]
fn wall_distance_goes_on_beyond_the_caps() {
    let vessel = pipe();
    let wall = SignedDistance::wall(&vessel);
    // Straight in front of the opening: inside, with the distance to its rim.
    let before = wall.query(DVec3::new(1e-3, 0.0, -1e-3));
    assert!((before.distance + 2e-3f64.hypot(1e-3)).abs() < sagitta());
    // Beside it: outside.
    let beside = wall.query(DVec3::new(0.0, 3.5e-3, -1e-3));
    assert!((beside.distance - 0.5e-3f64.hypot(1e-3)).abs() < sagitta());
    // At the cap centre the wall is a radius away, though the cap is right there.
    let center = wall.query(vessel.openings[0].center);
    assert!((center.distance + RADIUS).abs() <= sagitta() + 1e-12);
    assert_eq!(vessel.face_opening[before.triangle as usize], None);
}

#[test]
fn grid_agrees_with_the_exact_distance_within_its_band() {
    let vessel = pipe();
    let distance = SignedDistance::closed(&vessel);
    let (spacing, band) = (0.2e-3, 1.5e-3);
    let margin = DVec3::splat(2e-3);
    let (low, high) = vessel.surface.bounds();
    let grid = DistanceGrid::build(&distance, (low - margin, high + margin), spacing, band);
    let mut inside_band = 0;
    for x in places(low - margin, high + margin, 50_000) {
        let exact = distance.query(x);
        let (phi, gradient) = grid.sample(x);
        if exact.distance.abs() > band + spacing {
            assert_eq!((phi, gradient), (band.copysign(exact.distance), DVec3::ZERO), "far away at {x}");
            continue;
        }
        // Distance has slope one, so interpolation errs by a diagonal of a cell at the very most; near the
        // smooth wall by spacing^2 / (8 r), plus the facets.
        let rim = (x.z.min(LENGTH - x.z).abs()) < 2.0 * band || exact.distance < -0.7 * RADIUS;
        let allowed =
            if rim { 3f64.sqrt() * spacing } else { spacing * spacing / (2.0 * RADIUS) + sagitta() };
        let clamped = exact.distance.clamp(-band, band);
        assert!((phi - clamped).abs() <= allowed, "{phi} not {clamped} at {x}");
        if exact.distance.abs() < band - spacing && !rim {
            inside_band += 1;
            assert!(gradient.dot(exact.normal) > 0.98, "gradient {gradient} not {} at {x}", exact.normal);
        }
    }
    assert!(inside_band > 5_000);
}

#[test]
fn grid_is_the_same_for_any_number_of_threads() {
    let vessel = pipe();
    let distance = SignedDistance::closed(&vessel);
    let build = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        pool.install(|| DistanceGrid::build(&distance, vessel.surface.bounds(), 0.5e-3, 1e-3))
    };
    let (one, three) = (build(1), build(3));
    let (low, high) = vessel.surface.bounds();
    for x in places(low, high, 2_000) {
        assert_eq!(one.sample(x), three.sample(x));
    }
}

#[test]
fn samples_outside_the_bounds_are_those_of_the_border() {
    let vessel = pipe();
    let distance = SignedDistance::closed(&vessel);
    let (low, high) = vessel.surface.bounds();
    let margin = DVec3::splat(3e-3);
    let grid = DistanceGrid::build(&distance, (low - margin, high + margin), 0.5e-3, 1e-3);
    assert_eq!(grid.sample(DVec3::splat(1.0)), (1e-3, DVec3::ZERO));
    assert_eq!(grid.sample(DVec3::splat(-1.0)), (1e-3, DVec3::ZERO));
    assert_eq!(grid.sample(DVec3::new(0.0, 0.0, 10e-3)), (-1e-3, DVec3::ZERO));
}
