//! Large rotations: cantilevers against Sze, Liu and Lo (2004), and a strip rolled up to a circle.

use crate::support;

use glam::DVec3;
use std::f64::consts::PI;
use support::{Body, Rows, plate};
use vaso_shell::{Isa, Material, Model, Numbers, Shell, Support};

/// A strip of width and thickness 1 and 0.1, clamped at x = 0, of `n` cells over its length; and its particles at the tip.
fn strip(length: f64, n: usize) -> (Body, Shell<f64>, Vec<u32>) {
    let step = length / n as f64;
    let across = (1.0 / step).round() as usize;
    let body = plate([length, 1.0], 0.1, [Rows::OnEnds(n + 1), Rows::Inside(across)]);
    let material = Material::new(1.2e6, 0.0, Model::Resultant).expect("in range");
    let numbers = Numbers { damping: 0.0, ..Numbers::new(1.0, step) };
    let mut shell = Shell::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body");
    shell.hold(&body.select(|x| x.x < 1e-9), Support::CLAMPED).expect("particles exist");
    let tip = body.select(|x| x.x > length - 1e-9);
    (body, shell, tip)
}

/// Mean displacement of particles.
fn mean(shell: &Shell<f64>, particles: &[u32]) -> DVec3 {
    let sum: DVec3 = particles.iter().map(|&p| shell.state.displacement[shell.place(p as usize)]).sum();
    sum / particles.len() as f64
}

/// Shear at the end of a cantilever: tip by 6.698 across and 3.286 back.
fn sheared(n: usize) -> [f64; 2] {
    let (_, mut shell, tip) = strip(10.0, n);
    let force = 4.0 / tip.len() as f64 * DVec3::Z;
    shell.add_forces(&tip, &vec![force; tip.len()]).expect("particles exist");
    let (steps, rest) = shell.settle(1e-4, 400_000).expect("not inside out");
    let u = mean(&shell, &tip);
    println!("cantilever of {n}: {:.4} {:.4} of 6.698 3.286, {steps} steps, residual {rest:.1e}", u.z, -u.x);
    [u.z / 6.698, -u.x / 3.286]
}

#[test]
fn a_cantilever_bends_far() {
    for ratio in sheared(40) {
        assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    }
}

/// A moment at the end of a strip of 12 rolls it up to a full circle: the tip is back at the clamp.
#[test]
fn a_strip_rolls_up_to_a_circle() {
    let (_, mut shell, tip) = strip(12.0, 36);
    let moment = 50.0 * PI / 3.0 / tip.len() as f64;
    // The upper side is shortened: the strip turns about -y.
    for _ in 0..8 {
        shell.add_moments(&tip, &vec![-moment / 8.0 * DVec3::Y; tip.len()]).expect("particles exist");
        shell.settle(1e-3, 20_000).expect("not inside out");
    }
    let (steps, rest) = shell.settle(1e-4, 400_000).expect("not inside out");
    let u = mean(&shell, &tip);
    let director = shell.state.director[shell.place(tip[0] as usize)];
    println!(
        "circle: {:.4} {:.4} of -12 0, director {director:.3}, {steps} steps, residual {rest:.1e}",
        u.x, u.z
    );
    assert!((u.x + 12.0).abs() < 0.03 * 12.0 && u.z.abs() < 0.03 * 12.0, "{u}");
    assert!(director.z > 0.98, "{director}");
}
