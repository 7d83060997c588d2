//! What the fluid sees of ghost columns, against walls filled with volume.

use glam::DVec3;
use std::f64::consts::TAU;
use vaso_coupling::{Foot, GhostColumns};
use vaso_kernels::Wendland;
use vaso_particles::WallLoad;

const SPACING: f64 = 1e-3;
const H: f64 = 1.3 * SPACING;

/// Kernel sum and sum of kernel gradients \[1/m\] of some volumes at `x`.
fn sums(x: DVec3, volumes: impl Iterator<Item = (DVec3, f64)>) -> (f64, DVec3) {
    let kernel = Wendland::new(H);
    volumes.filter(|(y, _)| y.distance(x) < kernel.support()).fold((0.0, DVec3::ZERO), |(w, g), (y, v)| {
        let d = x - y;
        (w + v * kernel.value(d.length()), g + v * kernel.derivative(d.length()) * d.normalize())
    })
}

fn ghosts(columns: &GhostColumns) -> impl Iterator<Item = (DVec3, f64)> + '_ {
    let view = columns.view();
    view.position.iter().copied().zip(view.volume.iter().copied())
}

fn columns(feet: Vec<Foot>) -> GhostColumns {
    GhostColumns::new(feet, SPACING, 2.0 * H)
}

fn foot(position: DVec3, normal: DVec3, area: f64, curvature: [f64; 2]) -> Foot {
    Foot { position, normal, area, curvature, ..Foot::default() }
}

/// Feet `spacing` apart on the plane z = 0, the wall above it.
fn plane(spacing: f64, half: i32) -> Vec<Foot> {
    let sites = || (-half..half).map(move |k| spacing * (f64::from(k) + 0.5));
    let at = move |x: f64| sites().map(move |y| DVec3::new(x, y, 0.0));
    let sites = (-half..half).map(|k| spacing * (f64::from(k) + 0.5));
    sites.flat_map(at).map(|x| foot(x, DVec3::Z, spacing * spacing, [0.0; 2])).collect()
}

/// Feet on a tube of that radius \[m\] along z; the wall is outside of it, or inside for `side` -1.
fn tube(radius: f64, side: f64) -> Vec<Foot> {
    let around = (TAU * radius / SPACING).round() as usize;
    let mut feet = Vec::new();
    for k in -6..6 {
        for j in 0..around {
            // Rings turned by the golden section, so that no place is like another.
            let angle = TAU * (j as f64 / around as f64 + 0.618 * f64::from(k));
            let away = DVec3::new(angle.cos(), angle.sin(), 0.0);
            let x = radius * away + (f64::from(k) + 0.5) * SPACING * DVec3::Z;
            let mut curvature = [side / radius, 0.0];
            curvature.sort_by(|a, b| b.total_cmp(a));
            feet.push(foot(x, side * away, TAU * radius / around as f64 * SPACING, curvature));
        }
    }
    feet
}

/// The same sums over all of a wall at a distance \[m\] from its face, by shells as thin as a twelfth of a spacing: they have no steps
/// as a lattice cut by a round wall has. The first entry of the place is across the wall.
fn filled(radius: f64, side: f64, distance: f64) -> (f64, DVec3) {
    let step = SPACING / 12.0;
    let n = (2.0 * H / step).ceil() as i32;
    let sites = (0..n).flat_map(|i| (-n..n).flat_map(move |j| (-n..n).map(move |k| [i, j, k])));
    let places = sites.map(|site| site.map(|s| step * (f64::from(s) + 0.5)));
    let volumes = places.map(|[depth, y, z]| {
        if radius.is_infinite() {
            return (DVec3::new(depth, y, z), step.powi(3));
        }
        let (r, angle) = (radius + side * depth, y / radius);
        (DVec3::new(side * (r * angle.cos() - radius), r * angle.sin(), z), step.powi(3) * r / radius)
    });
    sums(-distance * DVec3::X, volumes)
}

/// Places at which sums are taken.
const PLACES: u32 = 500;

/// Means of kernel sum and gradient across the wall over places at a distance from it, over those of the filled wall.
fn shares(feet: Vec<Foot>, radius: f64, side: f64, distance: f64) -> [f64; 2] {
    let columns = columns(feet);
    let is_flat = radius.is_infinite();
    let mut found = [0.0; 2];
    for k in 0..PLACES {
        let (u, v) = (f64::from(k) * 0.754_877_7 % 1.0, f64::from(k) * 0.569_840_3 % 1.0);
        let (x, normal) = if is_flat {
            (DVec3::new(u * SPACING, v * SPACING, -distance), DVec3::Z)
        } else {
            let away = DVec3::new((TAU * u).cos(), (TAU * u).sin(), 0.0);
            ((radius - side * distance) * away + (v - 0.5) * SPACING * DVec3::Z, side * away)
        };
        let (w, g) = sums(x, ghosts(&columns));
        found = [found[0] + w, found[1] + g.dot(normal)];
    }
    let (w, g) = filled(radius, side, distance);
    let n = f64::from(PLACES);
    [found[0] / (n * w), found[1] / (n * g.x)]
}

/// Half a spacing from the wall. On a plane columns are a cubic lattice, which has 0.91 of the kernel sum of a filled wall there; so
/// should they on a tube.
#[test]
fn columns_stand_for_the_wall_they_replace() {
    let flat = shares(plane(SPACING, 6), f64::INFINITY, 1.0, 0.5 * SPACING);
    println!("plane: {flat:.4?} of a filled wall");
    let lattice = plane(SPACING, 6)
        .iter()
        .flat_map(|f| [0.5, 1.5, 2.5].map(|z| f.position + z * SPACING * DVec3::Z))
        .collect::<Vec<_>>();
    let x = DVec3::new(0.2, 0.3, -0.5) * SPACING;
    let expected = sums(x, lattice.into_iter().map(|y| (y, SPACING.powi(3))));
    let found = sums(x, ghosts(&columns(plane(SPACING, 6))));
    assert!(
        (found.0 - expected.0).abs() < 1e-12 && (found.1 - expected.1).length() < 1e-12 * expected.1.length()
    );
    for (radius, side) in [(5.0, 1.0), (10.0, 1.0), (20.0, 1.0), (5.0, -1.0), (10.0, -1.0), (20.0, -1.0)] {
        let curved = shares(tube(radius * SPACING, side), radius * SPACING, side, 0.5 * SPACING);
        let [w, g] = [curved[0] / flat[0], curved[1] / flat[1]];
        println!("R/dp {radius}, side {side}: kernel {w:.4}, gradient {g:.4} of a plane");
        let bound = 0.12 / radius;
        assert!((w - 1.0).abs() < bound && (g - 1.0).abs() < bound, "R/dp {radius}, side {side}: {w} {g}");
    }
}

/// A shell finer than the fluid has more columns of less volume.
#[test]
fn a_finer_shell_shows_the_same_wall() {
    let [w, g] = shares(plane(0.5 * SPACING, 12), f64::INFINITY, 1.0, 0.5 * SPACING);
    let flat = shares(plane(SPACING, 6), f64::INFINITY, 1.0, 0.5 * SPACING);
    assert!((w / flat[0] - 1.0).abs() < 0.01 && (g / flat[1] - 1.0).abs() < 0.01, "{w} {g} {flat:?}");
}

/// A flow divider: the wall is a wedge with its edge along y, the fluid on both sides.
#[test]
fn in_a_wedge_each_place_belongs_to_one_face() {
    for degrees in [10.0_f64, 30.0, 60.0] {
        let half = (0.5 * degrees).to_radians();
        let mut feet = Vec::new();
        for side in [-1.0, 1.0] {
            let along = DVec3::new(half.cos(), 0.0, side * half.sin());
            // Into the wedge.
            let normal = DVec3::new(half.sin(), 0.0, -side * half.cos());
            for i in 0..16 {
                for j in -6..6 {
                    let x = SPACING * ((f64::from(i) + 0.5) * along + (f64::from(j) + 0.5) * DVec3::Y);
                    feet.push(foot(x, normal, SPACING * SPACING, [0.0; 2]));
                }
            }
        }
        let columns = columns(feet);
        let is_wall = |y: DVec3| y.z.abs() < y.x * half.tan();
        let outside = |y: DVec3| y.z.abs() * half.cos() - y.x * half.sin();
        let farthest = ghosts(&columns).map(|(y, _)| outside(y)).fold(f64::NEG_INFINITY, f64::max);
        println!("{degrees} degrees: ghosts at most {:.3} spacings in the lumen", farthest / SPACING);
        assert!(farthest < 0.15 * SPACING, "{degrees} degrees: {farthest}");
        // Behind the middle of the faces, where the wedge is filled as far as the kernel reaches.
        let within =
            |y: DVec3| is_wall(y) && (4.0..10.0).contains(&(y.x / SPACING)) && y.y.abs() < 4.0 * SPACING;
        let volume: f64 = ghosts(&columns).filter(|(y, _)| within(*y)).map(|(_, v)| v).sum();
        let thickness = (2.0 * 7.0 * half.tan()).min(2.0 * 2.6 / half.cos());
        let expected = 6.0 * 8.0 * thickness * SPACING.powi(3);
        println!("{degrees} degrees: {:.3} of the volume", volume / expected);
        assert!((volume / expected - 1.0).abs() < 0.25, "{degrees} degrees: {}", volume / expected);
    }
}

#[test]
fn forces_on_ghosts_are_forces_on_columns() {
    let columns = columns(tube(5.0 * SPACING, 1.0));
    let n = columns.view().position.len();
    let force: Vec<DVec3> = (0..n).map(|k| DVec3::new(1.0, k as f64, (k as f64).sin())).collect();
    let (mut pressure, mut viscous) = (vec![DVec3::ONE; columns.len()], vec![DVec3::ONE; columns.len()]);
    let mut spread = vec![0.0; columns.len()];
    columns.gather(
        &WallLoad { pressure_force: &force, viscous_force: &vec![DVec3::ZERO; n], face_pressure: &[] },
        &mut pressure,
        &mut viscous,
        &mut spread,
    );
    let (total, given): (DVec3, DVec3) = (pressure.iter().sum(), force.iter().sum());
    assert!((total - given).length() < 1e-12 * given.length());
    assert!(viscous.iter().all(|v| *v == DVec3::ZERO));
}
