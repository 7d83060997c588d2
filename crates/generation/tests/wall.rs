//! Walls of any thickness around pipes, and what becomes of their ends.

use glam::DVec3;
use std::f64::consts::PI;
use vaso_generation::{Ends, Settings, Wall, wall};
use vaso_geometry::{LengthUnit, SignedDistance, Surface, Vessel, prepare, shapes};

const RADIUS: f64 = 2e-3;
const LENGTH: f64 = 8e-3;
const SPACING: f64 = 0.4e-3;

fn vessel(surface: Surface) -> Vessel {
    prepare(surface, Some(LengthUnit::Millimetre)).expect("a closed shape is a vessel")
}

fn pipe(length: f64) -> Surface {
    shapes::pipe(RADIUS * 1e3, length * 1e3, DVec3::Z, 96)
}

/// The pipe along z from the origin and a shorter one beside it, `gap` \[m\] away, from half of its length on.
fn side_by_side(gap: f64) -> (Vessel, f64) {
    let mut pipes = pipe(LENGTH);
    let shift = 2.0 * RADIUS + gap;
    let other = pipe(0.5 * LENGTH).map(|x| x + 1e3 * DVec3::new(shift, 0.0, 0.5 * LENGTH));
    let first = pipes.vertices.len() as u32;
    pipes.vertices.extend(other.vertices);
    pipes.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
    (vessel(pipes), shift)
}

fn generate(vessel: &Vessel, thickness: f64, ends: Ends) -> Wall {
    wall(vessel, &Settings::new(SPACING), thickness, ends, &mut |_, _| {}).expect("the pipe is wide enough")
}

#[test]
fn a_wall_is_as_thick_as_asked_and_ends_with_the_pipe() {
    let vessel = vessel(pipe(LENGTH));
    for layers in [2.5, 5.0] {
        let thickness = layers * SPACING;
        let made = generate(&vessel, thickness, Ends::ClosestCap);
        let (mut inner, mut outer) = (f64::INFINITY, 0.0_f64);
        for (x, depth) in made.body.position.iter().zip(&made.body.depth) {
            assert!((0.0..=LENGTH).contains(&x.z), "{x} stands beyond a cap");
            let r = x.truncate().length();
            assert!((depth - (r - RADIUS)).abs() < 5e-6, "depth {depth} at {r}");
            (inner, outer) = (inner.min(*depth), outer.max(*depth));
        }
        assert!(inner > 0.4 * SPACING && outer < thickness - 0.4 * SPACING, "{inner} to {outer}");
        assert!(inner < 0.55 * SPACING && outer > thickness - 0.55 * SPACING, "{inner} to {outer}");
        // Relaxed as one with the layer before the caps: the ends are cut, so a row more or less may fall on
        // either side of the plane.
        let ring = PI * ((RADIUS + thickness).powi(2) - RADIUS.powi(2)) * LENGTH;
        let filled = made.body.position.len() as f64 * SPACING.powi(3) / ring;
        assert!((filled - 1.0).abs() < SPACING / LENGTH, "{layers} layers: {filled}");
        let q = &made.body.quality;
        assert_eq!(q.count, made.body.position.len());
        assert!(q.nearest_neighbor_min > 0.65 && q.nearest_neighbor_cv < 0.06, "{q:?}");
        assert_eq!(made.shared, 0.0);
        assert!(made.warning().is_none());
        for (x, clamped) in made.body.position.iter().zip(&made.clamped) {
            assert_eq!(*clamped, x.z.min(LENGTH - x.z) < 4.0 * SPACING);
        }
    }
}

#[test]
fn on_a_pipe_boxes_and_the_closest_cap_leave_the_same() {
    let vessel = vessel(pipe(LENGTH));
    let by_cap = generate(&vessel, 1.6e-3, Ends::ClosestCap);
    assert_eq!(by_cap, generate(&vessel, 1.6e-3, Ends::Boxes));
}

#[test]
fn a_collar_is_as_long_as_asked() {
    let length = 1.5 * SPACING;
    let made = generate(&vessel(pipe(LENGTH)), 1.6e-3, Ends::Collar { length });
    let along = |x: &DVec3| (-x.z).max(x.z - LENGTH);
    let beyond = made.body.position.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
    assert!(beyond < length && beyond > length - 0.7 * SPACING, "{beyond}");
    assert!(made.body.position.iter().all(|x| x.truncate().length() > 0.99 * RADIUS));
}

/// The short pipe opens beside the wall of the long one. Boxes cut a piece out of that wall.
#[test]
fn a_limb_that_passes_an_opening_keeps_its_wall() {
    let (vessel, shift) = side_by_side(3.0 * SPACING);
    let thickness = 3.0 * SPACING;
    // The part of the long pipe's wall just before the end of the short pipe, on the side of the latter.
    let passing = |made: &Wall| {
        let is_there = |x: &&DVec3| {
            let r = x.truncate().length();
            (RADIUS..RADIUS + thickness).contains(&r)
                && (x.x > 0.9 * r)
                && (x.z > 0.5 * LENGTH - 4.0 * SPACING && x.z < 0.5 * LENGTH - 1.0 * SPACING)
        };
        made.body.position.iter().filter(is_there).count()
    };
    let expected =
        (0.9_f64.acos()) * ((RADIUS + thickness).powi(2) - RADIUS.powi(2)) * 3.0 * SPACING / SPACING.powi(3);
    let kept = passing(&generate(&vessel, thickness, Ends::ClosestCap)) as f64;
    assert!(kept > 0.8 * expected, "{kept} of {expected:.0}");
    let by_boxes = generate(&vessel, thickness, Ends::Boxes);
    assert!((passing(&by_boxes) as f64) < 0.2 * expected);
    // Neither leaves anything in front of the opening.
    for made in [&by_boxes, &generate(&vessel, thickness, Ends::ClosestCap)] {
        let in_front = |x: &&DVec3| {
            (x.truncate() - DVec3::new(shift, 0.0, 0.0).truncate()).length() < RADIUS && x.z < 0.5 * LENGTH
        };
        assert_eq!(made.body.position.iter().filter(in_front).count(), 0);
    }
}

/// Two equal pipes side by side: the share of points near both, by a fine grid over the section.
#[test]
fn the_share_of_a_common_wall_is_that_of_the_section() {
    let (gap, thickness) = (2.0 * SPACING, 3.0 * SPACING);
    let mut pipes = pipe(LENGTH);
    let shift = 2.0 * RADIUS + gap;
    let other = pipes.map(|x| x + 1e3 * shift * DVec3::X);
    let first = pipes.vertices.len() as u32;
    pipes.vertices.extend(other.vertices);
    pipes.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
    let vessel = vessel(pipes);
    let made = generate(&vessel, thickness, Ends::ClosestCap);
    assert!(made.warning().is_some());

    let (mut shared, mut all) = (0, 0);
    let cell = 0.02 * SPACING;
    let n = |extent: f64| (extent / cell).ceil() as i32;
    for i in n(-RADIUS - thickness)..n(shift + RADIUS + thickness) {
        for j in 0..n(RADIUS + thickness) {
            let x = DVec3::new(f64::from(i) * cell, f64::from(j) * cell, 0.0);
            let (a, b) = (x, x - shift * DVec3::X);
            let (near, far) = if a.length() < b.length() { (a, b) } else { (b, a) };
            if near.length() > RADIUS && near.length() < RADIUS + thickness {
                all += 1;
                // Some place of the far wall within reach looks against the normal of the near one.
                let faces = |turn: f64| {
                    let normal =
                        DVec3::from((glam::DVec2::from_angle(turn).rotate(far.truncate().normalize()), 0.0));
                    far.distance(RADIUS * normal) < thickness
                        && normal.dot(near.normalize()) < -0.3
                        && (far - RADIUS * normal).dot(normal) > 0.0
                };
                shared += i32::from((-60..=60).any(|k| faces(0.02 * f64::from(k))));
            }
        }
    }
    let expected = f64::from(shared) / f64::from(all);
    assert!(expected > 0.05);
    assert!((made.shared / expected - 1.0).abs() < 0.1, "{} instead of {expected}", made.shared);
    let closed = SignedDistance::closed(&vessel);
    assert!(made.body.position.iter().all(|x| closed.query(*x).distance > 0.0), "wall stands in a lumen");
}

#[test]
fn the_same_bits_on_one_and_two_threads() {
    let vessel = vessel(pipe(LENGTH));
    let settings = Settings { steps: 20, ..Settings::new(SPACING) };
    let generate = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let made = || wall(&vessel, &settings, 1e-3, Ends::ClosestCap, &mut |_, _| {});
        pool.install(made).expect("the pipe is wide enough")
    };
    assert_eq!(generate(1), generate(2));
}

#[test]
fn thicknesses_that_cannot_work_are_refused() {
    let vessel = vessel(pipe(LENGTH));
    let refusal = |thickness, ends| {
        let made = wall(&vessel, &Settings::new(SPACING), thickness, ends, &mut |_, _| {});
        made.expect_err("cannot work").to_string()
    };
    assert!(refusal(0.9 * SPACING, Ends::ClosestCap).contains("a thinner wall is a shell"));
    assert!(refusal(f64::NAN, Ends::Boxes).starts_with("`thickness` is NaN"));
    assert!(refusal(4.0 * SPACING, Ends::Collar { length: -1.0 }).starts_with("`collar` is -1"));
}
