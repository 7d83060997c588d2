//! Shells on the particles the generator makes.

use glam::DVec3;
use vaso_generation::{ShellSettings, shell};
use vaso_geometry::{LengthUnit, prepare, shapes};
use vaso_shell::{Isa, Material, Model, Numbers, Particles, Real, Shell, Support};

const SPACING: f64 = 0.4e-3;
const RADIUS: f64 = 6.0 * SPACING;
const YOUNG: f64 = 1e6;
const POISSON: f64 = 0.45;

/// Radial displacements of the middle of a tube of `thickness` \[m\] that is held at its ends and inflated by 0.1 %, by
/// `p R^2 (1 - nu^2) / (E t)`: mean and standard deviation. Where the clamps keep the tube narrow it is stretched, and its middle,
/// which bears the same axial force, shortened: that strain counts with Poisson's ratio.
fn inflated<R: Real>(thickness: f64) -> (f64, f64) {
    let lumen = RADIUS - 0.5 * thickness;
    let length = 32.0 * SPACING;
    let surface = shapes::pipe(lumen * 1e3, length * 1e3, DVec3::Z, 192);
    let vessel = prepare(surface, Some(LengthUnit::Millimetre)).expect("a closed shape is a vessel");
    let body =
        shell(&vessel, &ShellSettings::new(SPACING, thickness), &mut |_, _| {}).expect("it suits the vessel");
    let particles = Particles {
        position: &body.position,
        normal: &body.normal,
        area: &body.area,
        thickness: &body.thickness,
    };
    let material = Material::new(YOUNG, POISSON, Model::Resultant).expect("in range");
    let numbers = Numbers { damping: 0.0, ..Numbers::new(1100.0, SPACING) };
    let mut wall = Shell::<R>::new(&particles, material, numbers, Isa::detect()).expect("a sound body");
    let all: Vec<u32> = (0..body.position.len() as u32).collect();
    let clamped: Vec<u32> = all.iter().copied().filter(|&i| body.clamped[i as usize]).collect();
    wall.hold(&clamped, Support::CLAMPED).expect("particles exist");
    let pressure = 1e-3 * YOUNG * thickness / (RADIUS * (1.0 - POISSON * POISSON));
    wall.add_pressure(&all, &body.area, pressure).expect("particles exist");
    let (steps, rest) = wall.settle(1e-3, 100_000).expect("a gentle load");
    let low = body.position.iter().map(|x| x.z).fold(f64::INFINITY, f64::min);
    let height = |i: usize| body.position[i].z - low - 0.5 * length;
    let middle: Vec<usize> = (0..all.len()).filter(|&i| height(i).abs() < 5.0 * SPACING).collect();
    let moved = |i: usize| wall.state.displacement[wall.place(i)];
    let slope = |of: &dyn Fn(usize) -> f64| middle.iter().map(|&i| height(i) * of(i)).sum::<f64>();
    let shortened = POISSON * slope(&|i| moved(i).z) / slope(&height) / 1e-3;
    let hoop = |&i: &usize| {
        let x = body.position[i];
        moved(i).dot(DVec3::new(x.x, x.y, 0.0).normalize()) / (1e-3 * RADIUS) + shortened
    };
    let ratios: Vec<f64> = middle.iter().map(hoop).collect();
    let n = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / n;
    let deviation = (ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / n).sqrt();
    println!(
        "t/dp {:.2}, {}: {mean:.4} (axial {shortened:.4}), scatter {:.2} %, {steps} steps, residual {rest:.1e}",
        thickness / SPACING,
        R::PRECISION,
        100.0 * deviation
    );
    (mean, deviation)
}

#[test]
fn a_relaxed_tube_is_inflated_as_in_theory() {
    let (mean, deviation) = inflated::<f64>(0.5 * SPACING);
    assert!((mean - 1.0).abs() < 0.02, "{mean}");
    assert!(deviation < 0.05, "{deviation}");
    let (mixed, _) = inflated::<f32>(0.5 * SPACING);
    assert!((mixed / mean - 1.0).abs() < 1e-3, "{mixed} {mean}");
}

#[test]
#[ignore = "thin and thick walls, for the table of the theory"]
fn other_thicknesses() {
    for ratio in [0.1, 0.25, 1.0, 2.0] {
        let (mean, _) = inflated::<f64>(ratio * SPACING);
        assert!((mean - 1.0).abs() < 0.05, "{mean}");
    }
}
