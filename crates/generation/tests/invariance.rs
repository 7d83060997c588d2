//! The same vessel turned, moved and in other units, read back from the file formats that round it.

use glam::{DQuat, DVec3};
use std::path::{Path, PathBuf};
use vaso_generation::{Body, Quality, Settings, fluid, rigid_wall};
use vaso_geometry::{LengthUnit, Surface, prepare, read_surface, shapes, write_stl};

/// A vessel file in millimetres of the data folder, `None` when there is none.
fn data(file: &str) -> Option<Surface> {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        eprintln!("skipped: VASO_DATA is not set");
        return None;
    };
    Some(read_surface(&PathBuf::from(data).join("geometry").join(file)).expect("the file is there"))
}

fn generate(surface: &Surface, unit: LengthUnit, folder: &Path, settings: &Settings) -> [Body; 2] {
    let file = folder.join("vessel.stl");
    write_stl(&file, surface).expect("the folder is there");
    let read = read_surface(&file).expect("what was written can be read");
    let vessel = prepare(read, Some(unit)).expect("the vessel is usable");
    let blood = fluid(&vessel, settings, &mut |_, _| {}).expect("the spacing suits");
    [blood, rigid_wall(&vessel, settings, &mut |_, _| {}).expect("the spacing suits")]
}

/// How far the figures of two sets may differ.
struct Tolerance {
    nearest_neighbor_min: f64,
    nearest_neighbor_cv: f64,
    kernel_sum_mean: f64,
    gradient_residual_rms: f64,
}

/// The file rounds a coordinate of a metre to 3e-8 m, which is 5e-5 of the spacing; of two neighbours both
/// may move.
const ROUNDING: Tolerance = Tolerance {
    nearest_neighbor_min: 1e-4,
    nearest_neighbor_cv: 5e-5,
    kernel_sum_mean: 5e-5,
    gradient_residual_rms: 5e-5,
};

/// While the lattice gives way, a difference in the last digit grows until some particles take other places:
/// what is an average stays the same, the extreme is that of another sample.
const RELAXED: Tolerance = Tolerance {
    nearest_neighbor_min: 0.08,
    nearest_neighbor_cv: 3e-4,
    kernel_sum_mean: 1e-4,
    gradient_residual_rms: 1.5e-3,
};

fn hold_alike(name: &str, a: &Quality, b: &Quality, tolerance: &Tolerance) {
    assert_eq!((a.count, a.outside), (b.count, b.outside), "{name}: {a:?} {b:?}");
    // A wall is nowhere deeper than a support, so it has no such sum.
    let sum = |q: &Quality| q.kernel_sum_mean.unwrap_or(0.0);
    for (x, y, bound) in [
        (a.nearest_neighbor_min, b.nearest_neighbor_min, tolerance.nearest_neighbor_min),
        (a.nearest_neighbor_cv, b.nearest_neighbor_cv, tolerance.nearest_neighbor_cv),
        (sum(a), sum(b), tolerance.kernel_sum_mean),
        (a.gradient_residual_rms, b.gradient_residual_rms, tolerance.gradient_residual_rms),
    ] {
        assert!((x - y).abs() < bound, "{name}: {x} and {y}, {a:?} {b:?}");
    }
}

/// Compares fluid and wall of a surface in millimetres with those of copies turned, moved by a metre, in
/// metres and in centimetres.
fn hold_invariant(surface: &Surface, steps: usize, tolerance: &Tolerance) {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let settings = Settings { steps, ..Settings::new(0.6e-3) };
    let turn = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 2.0);
    let metre = DVec3::new(600.0, -500.0, 624.5);
    let first = generate(surface, LengthUnit::Millimetre, folder.path(), &settings);
    for (name, copy, unit) in [
        ("turned and moved", surface.map(|v| turn * v + metre), LengthUnit::Millimetre),
        ("turned, in metres", surface.map(|v| turn.inverse() * v * 1e-3), LengthUnit::Metre),
        ("in centimetres", surface.map(|v| v * 0.1), LengthUnit::Centimetre),
    ] {
        let second = generate(&copy, unit, folder.path(), &settings);
        for (a, b) in first.iter().zip(&second) {
            hold_alike(name, &a.quality, &b.quality, tolerance);
        }
    }
}

#[test]
fn a_bend_gets_the_same_particles_wherever_it_is() {
    hold_invariant(&shapes::bent_pipe(3.0, 9.0, 1.2, 48), 10, &ROUNDING);
}

#[test]
fn carotids_get_the_same_particles_wherever_they_are() {
    for file in ["synthetic/carotid.stl", "carotid_bifurcation/carotid_lumen.stl"] {
        let Some(surface) = data(file) else { return };
        hold_invariant(&surface, 10, &ROUNDING);
    }
}

#[test]
#[ignore = "relaxes sixteen sets to the end: a minute"]
fn carotids_get_equally_good_particles_wherever_they_are() {
    for file in ["synthetic/carotid.stl", "carotid_bifurcation/carotid_lumen.stl"] {
        let Some(surface) = data(file) else { return };
        hold_invariant(&surface, 200, &RELAXED);
    }
}

#[test]
fn another_seed_gives_another_set_of_the_same_quality() {
    let pipe = shapes::bent_pipe(3.0, 9.0, 0.8, 48);
    let vessel = prepare(pipe, Some(LengthUnit::Millimetre)).expect("a closed bend is a vessel");
    let make = |seed| {
        let settings = Settings { seed, ..Settings::new(0.6e-3) };
        fluid(&vessel, &settings, &mut |_, _| {}).expect("the spacing suits")
    };
    let (first, same, other) = (make(1), make(1), make(2));
    assert_eq!(first, same);
    let place =
        |body: &Body| body.position.iter().map(|x| x.to_array().map(f64::to_bits)).collect::<Vec<_>>();
    let (mut a, mut b) = (place(&first), place(&other));
    a.sort_unstable();
    b.sort_unstable();
    assert!(a.iter().zip(&b).all(|(x, y)| x != y), "some particles are where they were");
    // A bend this short holds few particles, and few of them deep inside.
    let tolerance = Tolerance { nearest_neighbor_cv: 4e-3, kernel_sum_mean: 2e-3, ..RELAXED };
    hold_alike("seeds", &first.quality, &other.quality, &tolerance);
}
