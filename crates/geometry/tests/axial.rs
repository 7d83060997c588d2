//! Axial directions of walls by their centrelines.

use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use vaso_geometry::{Centerlines, LengthUnit, Surface, Vessel, prepare, shapes};

/// Angle between two lines \[deg\].
fn between(a: DVec3, b: DVec3) -> f64 {
    a.dot(b).abs().min(1.0).acos().to_degrees()
}

/// Middles of the triangles of the wall, their normals and axial directions, and the numbers of the triangles.
struct Axial {
    vessel: Vessel,
    triangles: Vec<usize>,
    points: Vec<DVec3>,
    directions: Vec<DVec3>,
}

fn axial(surface: Surface) -> Axial {
    let vessel = prepare(surface, Some(LengthUnit::Metre)).expect("it is a vessel");
    let lines = Centerlines::trace(&vessel).expect("there are openings");
    let radius = vessel.openings.iter().map(|o| o.radius).fold(f64::INFINITY, f64::min);
    let triangles: Vec<usize> =
        (0..vessel.face_opening.len()).filter(|&t| vessel.face_opening[t].is_none()).collect();
    let middle = |&t: &usize| vessel.surface.triangle(t).into_iter().sum::<DVec3>() / 3.0;
    let points: Vec<DVec3> = triangles.iter().map(middle).collect();
    let normals: Vec<DVec3> = triangles.iter().map(|&t| vessel.surface.triangle_normal(t)).collect();
    let directions = lines.axial_directions(&points, &normals, 0.1 * radius);
    for (direction, normal) in directions.iter().zip(&normals) {
        assert!((direction.length() - 1.0).abs() < 1e-12 && direction.dot(*normal).abs() < 1e-12);
    }
    Axial { vessel, triangles, points, directions }
}

#[test]
fn on_a_bend_it_is_that_of_the_arc() {
    let (radius, bend) = (3e-3, 12e-3);
    let Axial { points, directions, .. } = axial(shapes::bent_pipe(radius, bend, FRAC_PI_2, 48));
    let exact = |x: DVec3| DVec3::Y.cross(x - bend * DVec3::X).normalize();
    // Within a diameter of the ends the centrelines are on one side only.
    let is_inner = |x: &DVec3| {
        let turned = x.z.atan2(bend - x.x) * bend;
        2.0 * radius < turned && turned < FRAC_PI_2 * bend - 2.0 * radius
    };
    let angles: Vec<f64> = points
        .iter()
        .zip(&directions)
        .filter(|(x, _)| is_inner(x))
        .map(|(x, d)| between(*d, exact(*x)))
        .collect();
    let largest = angles.iter().copied().fold(0.0, f64::max);
    println!("{} triangles, {largest:.2} degrees off at most", angles.len());
    assert!(angles.len() > 500 && largest < 3.0, "{largest}");
    let at_ends = points.iter().zip(&directions).map(|(x, d)| between(*d, exact(*x))).fold(0.0, f64::max);
    assert!(at_ends < 15.0, "{at_ends}");
}

/// From triangle to triangle the lines turn little, carina and the flanks between the branches included, and far from where the branches part they
/// follow each branch.
#[test]
fn where_branches_part_it_goes_over_from_one_to_the_other() {
    let Axial { vessel, triangles, points, directions } =
        axial(shapes::bifurcation(&shapes::BifurcationSpec::default()));
    let mut edges: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let mut turns: Vec<(f64, DVec3)> = Vec::new();
    for (k, &t) in triangles.iter().enumerate() {
        let [a, b, c] = vessel.surface.triangles[t];
        for [p, q] in [[a, b], [b, c], [c, a]] {
            if let Some(&other) = edges.get(&[p.min(q), p.max(q)]) {
                turns.push((between(directions[k], directions[other]), points[k]));
            }
            edges.insert([p.min(q), p.max(q)], k);
        }
    }
    turns.sort_by(|a, b| a.0.total_cmp(&b.0));
    let share = |angle: f64| turns.iter().filter(|t| t.0 > angle).count() as f64 / turns.len() as f64;
    let worst = turns[turns.len() - 1];
    println!(
        "{} pairs: {:.4} turn by more than 10 degrees, {:.4} by more than 30; {worst:?}",
        turns.len(),
        share(10.0),
        share(30.0)
    );
    assert!(turns.len() > 3000 && share(10.0) < 0.02 && share(30.0) < 0.005);
    for opening in &vessel.openings {
        let near = points
            .iter()
            .zip(&directions)
            .filter(|(x, _)| (x.distance(opening.center)) < 1.5 * opening.radius);
        let angles: Vec<f64> = near.map(|(_, d)| between(*d, opening.normal)).collect();
        let mean = angles.iter().sum::<f64>() / angles.len() as f64;
        println!("{mean:.2} degrees off the normal of an opening of {:.1} mm", 1e3 * opening.radius);
        assert!(mean < 5.0, "{mean}");
    }
}
