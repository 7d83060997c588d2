//! Shells on surfaces whose area and curvature are known by formula.

use glam::DVec3;
use std::f64::consts::{PI, TAU};
use vaso_generation::{Allotment, GenerationError, ShellBody, ShellReference, ShellSettings, shell};
use vaso_geometry::{LengthUnit, SignedDistance, Surface, Vessel, prepare, shapes};

const RADIUS: f64 = 3.2e-3;
const LENGTH: f64 = 12e-3;
const SPACING: f64 = 0.4e-3;
const THICKNESS: f64 = 0.8e-3;
const SEGMENTS: usize = 96;

fn axis() -> DVec3 {
    DVec3::new(0.3, -0.8, 0.5).normalize()
}

fn vessel(surface: Surface) -> Vessel {
    prepare(surface, Some(LengthUnit::Millimetre)).expect("a closed shape is a vessel")
}

fn pipe() -> Vessel {
    vessel(shapes::pipe(RADIUS * 1e3, LENGTH * 1e3, axis(), SEGMENTS))
}

fn on_lumen() -> ShellSettings {
    ShellSettings { reference: ShellReference::Lumen, ..ShellSettings::new(SPACING, THICKNESS) }
}

fn generate(vessel: &Vessel, settings: &ShellSettings) -> ShellBody {
    shell(vessel, settings, &mut |_, _| {}).expect("the spacing suits the vessel")
}

/// Nearest-neighbour distance of each point in spacings, by brute force.
fn nearest(points: &[DVec3]) -> Vec<f64> {
    let nearest = |i: usize| {
        let others = (0..points.len()).filter(|&j| j != i);
        others.map(|j| points[i].distance(points[j])).fold(f64::INFINITY, f64::min) / SPACING
    };
    (0..points.len()).map(nearest).collect()
}

/// Mean and coefficient of variation.
fn statistics(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n;
    (mean, variance.sqrt() / mean)
}

#[test]
fn a_pipe_is_covered_evenly_and_in_full() {
    let vessel = pipe();
    let body = generate(&vessel, &on_lumen());
    let area = TAU * RADIUS * LENGTH * (PI / SEGMENTS as f64).sin() / (PI / SEGMENTS as f64);
    assert_eq!(body.position.len(), (area / (SPACING * SPACING)).ceil() as usize);
    assert!((body.area.iter().sum::<f64>() / area - 1.0).abs() < 1e-12);
    assert!(body.thickness.iter().all(|t| *t == THICKNESS));

    let q = &body.quality;
    assert_eq!(q.count, body.position.len());
    assert!(q.area_error.abs() < 1e-12 && q.surface_distance_max < 1e-12, "{q:?}");
    assert!(q.nearest_neighbor_min > 0.7 && q.nearest_neighbor_cv < 0.06, "{q:?}");
    assert!((q.kernel_sum_mean.expect("the pipe is long") - 1.0).abs() < 0.01, "{q:?}");
    assert!(q.kernel_sum_std.expect("the pipe is long") < 0.01, "{q:?}");
    let gaps = nearest(&body.position);
    assert!((gaps.iter().copied().fold(f64::INFINITY, f64::min) - q.nearest_neighbor_min).abs() < 1e-12);
    assert!((statistics(&gaps).1 - q.nearest_neighbor_cv).abs() < 1e-12);

    // The last row stands half a row from the rim, on either end.
    for from_end in [|z: f64| z, |z: f64| LENGTH - z] {
        let row: Vec<f64> = body.position.iter().map(|x| from_end(x.dot(axis())) / SPACING).collect();
        assert!(row.iter().all(|z| *z > 0.4), "beyond the rim");
        // Half way to the next row, which stands at one and a half.
        let last: Vec<f64> = row.into_iter().filter(|z| *z < 1.0).collect();
        assert!(last.len() as f64 > 0.9 * TAU * RADIUS / SPACING, "{} in the last row", last.len());
        assert!((statistics(&last).0 - 0.5).abs() < 0.05, "{}", statistics(&last).0);
    }
}

#[test]
fn particles_within_four_spacings_of_a_cap_are_clamped() {
    let body = generate(&pipe(), &on_lumen());
    for (x, clamped) in body.position.iter().zip(&body.clamped) {
        let z = x.dot(axis());
        assert_eq!(*clamped, z.min(LENGTH - z) < 4.0 * SPACING, "at z {z}");
    }
}

#[test]
fn a_cylinder_curves_one_way_only() {
    let body = generate(&pipe(), &on_lumen());
    for ((x, normal), k) in body.position.iter().zip(&body.normal).zip(&body.curvature) {
        let radial = (x - x.dot(axis()) * axis()).normalize();
        assert!(normal.distance(radial) < 2e-3, "{normal} instead of {radial}");
        // The facets of the pipe are an eighth of a percent off the circle.
        assert!((k[0] * RADIUS - 1.0).abs() < 0.01 && (k[1] * RADIUS).abs() < 0.01, "{k:?}");
    }
}

/// A ball from meridians and parallels \[mm\].
fn ball(radius: f64, n: usize) -> Surface {
    let point = |i: usize, j: usize| {
        let (polar, turn) = (PI * i as f64 / n as f64, PI * j as f64 / n as f64);
        radius * DVec3::new(polar.sin() * turn.cos(), polar.sin() * turn.sin(), polar.cos())
    };
    let mut surface = Surface::default();
    for i in 0..n {
        for j in 0..2 * n {
            let first = surface.vertices.len() as u32;
            surface.vertices.extend([point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
            surface.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    surface
}

#[test]
fn a_ball_curves_alike_both_ways() {
    let radius = 4e-3;
    let body = generate(&vessel(ball(radius * 1e3, 48)), &on_lumen());
    assert!(body.quality.nearest_neighbor_cv < 0.06, "{:?}", body.quality);
    assert!(!body.clamped.contains(&true), "a ball has no openings");
    for (i, k) in body.curvature.iter().enumerate() {
        assert!(k.iter().all(|k| (k * radius - 1.0).abs() < 0.02), "{k:?}");
        assert!((body.mean_curvature(i) * radius - 1.0).abs() < 0.01, "{k:?}");
    }
}

/// Steiner's formula on a tube: half a thickness further out, areas are longer by that over the radius.
#[test]
fn the_mid_surface_lies_half_a_thickness_outside() {
    let vessel = pipe();
    let body = generate(&vessel, &ShellSettings::new(SPACING, THICKNESS));
    let stretch = 1.0 + 0.5 * THICKNESS / RADIUS;
    let wall = vessel.wall_area();
    assert!((body.area.iter().sum::<f64>() / (wall * stretch) - 1.0).abs() < 1e-3);
    assert_eq!(body.quality.folded, 0);
    for (x, k) in body.position.iter().zip(&body.curvature) {
        let r = (x - x.dot(axis()) * axis()).length();
        assert!((r - RADIUS - 0.5 * THICKNESS).abs() < 5e-6, "r {r}");
        assert!((k[0] * (RADIUS + 0.5 * THICKNESS) - 1.0).abs() < 0.01, "{k:?}");
    }
}

/// Two pipes side by side, a quarter of a spacing apart: each is as even as if the other were not there.
#[test]
fn walls_across_a_thin_gap_do_not_see_each_other() {
    let mut pipes = shapes::pipe(2.0, 12.0, DVec3::Z, 96);
    let shift = 4.0e-3 + 0.25 * SPACING;
    let other = pipes.map(|x| x + 1e3 * shift * DVec3::X);
    let first = pipes.vertices.len() as u32;
    pipes.vertices.extend(other.vertices);
    pipes.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
    let vessel = vessel(pipes);
    assert_eq!(vessel.openings.len(), 4);
    let body = generate(&vessel, &on_lumen());
    let (left, right): (Vec<DVec3>, Vec<DVec3>) = body.position.iter().partition(|x| x.x < 0.5 * shift);
    for pipe in [&left, &right] {
        let gaps = nearest(pipe);
        assert!(gaps.iter().all(|gap| *gap > 0.7), "{gaps:?}");
        assert!(statistics(&gaps).1 < 0.05, "{}", statistics(&gaps).1);
    }
    // Placed without regard to each other, most have another within 0.6 spacings where the walls face each
    // other, nearer than any two on one wall.
    let is_facing = |x: &DVec3| (x.x - 0.5 * shift).abs() < SPACING && x.y.abs() < SPACING;
    let near = |pipe: &[DVec3], others: &[DVec3]| {
        let facing: Vec<DVec3> = pipe.iter().copied().filter(is_facing).collect();
        let is_near = |x: &&DVec3| others.iter().any(|y| y.distance(**x) < 0.6 * SPACING);
        (facing.iter().filter(is_near).count(), facing.len())
    };
    let (near, facing) = near(&left, &right);
    assert!(facing > 40 && 2 * near > facing, "{near} of {facing}");
}

/// A duct of square section \[mm\] with `n` points on each side, open at its ends.
fn duct(width: f64, length: f64, n: usize) -> Surface {
    let side = |k: usize| width * (k as f64 / n as f64);
    let ring: Vec<DVec3> = (0..4 * n)
        .map(|k| match (k / n, side(k % n)) {
            (0, s) => DVec3::new(s, 0.0, 0.0),
            (1, s) => DVec3::new(width, s, 0.0),
            (2, s) => DVec3::new(width - s, width, 0.0),
            (_, s) => DVec3::new(0.0, width - s, 0.0),
        })
        .collect();
    let rows = (length / side(1)).round() as u32;
    let around = ring.len() as u32;
    let mut surface = Surface::default();
    for i in 0..=rows {
        let along = length * f64::from(i) / f64::from(rows) * DVec3::Z;
        surface.vertices.extend(ring.iter().map(|x| *x + along));
    }
    for (i, k) in (0..rows).flat_map(|i| (0..around).map(move |k| (i, k))) {
        let (a, b) = (i * around + k, i * around + (k + 1) % around);
        surface.triangles.extend([[a, b, b + around], [a, b + around, a + around]]);
    }
    surface
}

/// Both sides of an edge push each other, or particles would gather along it.
#[test]
fn a_crease_at_right_angles_is_no_border() {
    for n in [2, 16] {
        let vessel = vessel(duct(4.0, 12.0, n));
        assert_eq!(vessel.openings.len(), 2);
        let q = generate(&vessel, &on_lumen()).quality;
        assert!(q.nearest_neighbor_min > 0.65 && q.nearest_neighbor_cv < 0.06, "{n} points: {q:?}");
    }
}

#[test]
fn a_collar_continues_the_wall() {
    let collar = 3.0 * SPACING;
    let body = generate(&pipe(), &ShellSettings { collar, ..on_lumen() });
    let area = TAU * RADIUS * (LENGTH + 2.0 * collar) * (PI / SEGMENTS as f64).sin() / (PI / SEGMENTS as f64);
    assert_eq!(body.position.len(), (area / (SPACING * SPACING)).ceil() as usize);
    let along: Vec<f64> = body.position.iter().map(|x| x.dot(axis())).collect();
    assert!(along.iter().all(|z| -collar < *z && *z < LENGTH + collar));
    assert!(along.iter().any(|z| *z < -0.8 * collar) && along.iter().any(|z| *z > LENGTH + 0.8 * collar));
    assert!(body.quality.nearest_neighbor_cv < 0.06, "{:?}", body.quality);
}

/// Triangles of a hundredth and of a hundred times the area of a particle.
#[test]
fn the_number_does_not_depend_on_the_triangles() {
    for segments in [12, 24, 480] {
        for allotment in [Allotment::Cumulative, Allotment::LargestRemainder] {
            let vessel = vessel(shapes::pipe(2.0, 4.0, axis(), segments));
            let body = generate(&vessel, &ShellSettings { allotment, steps: 60, ..on_lumen() });
            let expected = (vessel.wall_area() / (SPACING * SPACING)).ceil() as usize;
            assert_eq!(body.position.len(), expected, "{segments} segments, {allotment:?}");
            assert!((body.area.iter().sum::<f64>() / vessel.wall_area() - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn the_same_bits_on_one_and_two_threads() {
    let (vessel, settings) = (pipe(), ShellSettings { steps: 40, ..ShellSettings::new(SPACING, THICKNESS) });
    let generate = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| generate(&vessel, &settings))
    };
    assert_eq!(generate(1), generate(2));
}

#[test]
fn the_shell_of_a_bend_stays_on_its_surface() {
    let vessel = vessel(shapes::bent_pipe(2.0, 3.0, PI, 64));
    let body = generate(&vessel, &on_lumen());
    let closed = SignedDistance::closed(&vessel);
    let diagonal = vessel.surface.diagonal();
    assert!(body.position.iter().all(|x| closed.query(*x).distance.abs() < 1e-9 * diagonal));
    assert!(body.quality.nearest_neighbor_min > 0.65 && body.quality.nearest_neighbor_cv < 0.06);
}

/// Inside a tight bend half a thickness reaches beyond the centre of curvature, elsewhere it does not.
#[test]
fn folds_of_the_mid_surface_are_counted() {
    let vessel = vessel(shapes::bent_pipe(2.0, 2.6, PI, 64));
    let folded = |thickness| generate(&vessel, &ShellSettings::new(SPACING, thickness)).quality.folded;
    assert_eq!(folded(0.4e-3), 0);
    let thick = folded(1.6e-3);
    assert!(thick > 10 && thick < 200, "{thick}");
}

/// A metre off, a coordinate has lost three digits to the shift, which must not change the set by more than
/// its chance arrangement.
#[test]
fn a_shift_by_a_metre_changes_nothing() {
    let pipe = shapes::pipe(2.0, 8.0, axis(), 64);
    let near = generate(&vessel(pipe.clone()), &on_lumen()).quality;
    let far = generate(&vessel(pipe.map(|x| x + DVec3::splat(1e3))), &on_lumen()).quality;
    assert_eq!(near.count, far.count);
    assert!(far.area_error.abs() < 1e-9 && far.surface_distance_max < 1e-9, "{far:?}");
    assert!((near.nearest_neighbor_cv - far.nearest_neighbor_cv).abs() < 5e-3, "{near:?} {far:?}");
    assert!((near.nearest_neighbor_min - far.nearest_neighbor_min).abs() < 0.05, "{near:?} {far:?}");
}

#[test]
fn settings_that_cannot_work_are_refused() {
    let vessel = pipe();
    let refusal = |settings| shell(&vessel, &settings, &mut |_, _| {}).expect_err("cannot work").to_string();
    // Six flat sides, each taken for a cap like the ends.
    let no_wall = self::vessel(shapes::pipe(2.0, 4.0, axis(), 6));
    let error = shell(&no_wall, &on_lumen(), &mut |_, _| {}).expect_err("no wall");
    assert!(matches!(error, GenerationError::NoWall { openings: 8 }), "{error}");
    assert!(refusal(ShellSettings::new(SPACING, 0.0)).starts_with("`thickness` is 0"));
    assert!(refusal(ShellSettings { collar: -1.0, ..on_lumen() }).starts_with("`collar` is -1"));
    assert!(refusal(ShellSettings { smoothing: 0.5, ..on_lumen() }).starts_with("`smoothing` is 0.5"));
    let fine = shell(&vessel, &ShellSettings::new(1e-8, THICKNESS), &mut |_, _| {}).expect_err("1e12");
    assert!(matches!(fine, GenerationError::TooFine { .. }), "{fine}");
}
