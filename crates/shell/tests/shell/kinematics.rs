//! Rigid motions, momentum, and forces as derivatives of the energy.

use crate::support;

use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};
use support::{Body, Rows, cylinder, noise, tube};
use vaso_shell::{Isa, Material, Model, Numbers, Real, Shell};

const SPACING: f64 = 1e-3;
const MODELS: [Model; 4] = [
    Model::Resultant,
    Model::NeoHookean { points: 1 },
    Model::NeoHookean { points: 3 },
    Model::NeoHookean { points: 5 },
];

fn shell<R: Real>(body: &Body, model: Model) -> Shell<R> {
    let numbers = Numbers { damping: 0.0, ..Numbers::new(1100.0, SPACING) };
    let material = Material::new(1e6, 0.45, model).expect("in range");
    Shell::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body")
}

/// A tube and half a tube with free edges, disordered by 0.15 spacings.
fn bodies(thickness: f64) -> [Body; 2] {
    let radius = 6.0 * SPACING;
    let size = (radius, 12.0 * SPACING, thickness);
    let around = (TAU * 6.0).round() as usize;
    let half = (Rows::Inside(around / 2), Rows::Inside(12));
    [tube(size, around, 12, 0.15), cylinder(size, (0.0, PI), half, 0.15)]
}

/// Forces \[N\] and couples \[N m\] on positions and directors.
fn forces<R: Real>(shell: &Shell<R>) -> (Vec<DVec3>, Vec<DVec3>) {
    let s = &shell.state;
    let force = |i: usize| s.mass[i] * s.acceleration[i];
    let couple = |i: usize| s.rotary_inertia[i] * s.director_acceleration[i];
    ((0..s.len()).map(force).collect(), (0..s.len()).map(couple).collect())
}

fn largest(v: &[DVec3]) -> f64 {
    v.iter().map(|v| v.length()).fold(0.0, f64::max)
}

/// Moves particles and directors by a linear map about the origin of the axis.
fn deform<R: Real>(shell: &mut Shell<R>, map: impl Fn(DVec3) -> DVec3, turn: DMat3) {
    for i in 0..shell.state.len() {
        let x = shell.state.reference_position[i];
        shell.state.displacement[i] = map(x) - x;
        shell.state.director[i] = turn * shell.state.reference_director[i];
    }
    shell.refresh().expect("not inside out");
}

/// Force and couple of a rigid rotation by 60 degrees, by those of an inflation of 1 %.
fn rotated<R: Real>(body: &Body, model: Model) -> [f64; 2] {
    let mut shell = shell::<R>(body, model);
    deform(&mut shell, |x| DVec3::new(1.01 * x.x, 1.01 * x.y, x.z), DMat3::IDENTITY);
    let (inflation, _) = forces(&shell);
    let scale = largest(&inflation);
    let turn = DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), PI / 3.0);
    deform(&mut shell, |x| turn * x, turn);
    let (force, couple) = forces(&shell);
    [largest(&force) / scale, largest(&couple) / (scale * SPACING)]
}

#[test]
fn a_rigid_rotation_of_a_curved_shell_makes_no_force() {
    let (mut double, mut mixed) = (0.0_f64, 0.0_f64);
    for body in bodies(0.5e-3) {
        for model in MODELS {
            double = rotated::<f64>(&body, model).into_iter().fold(double, f64::max);
            mixed = rotated::<f32>(&body, model).into_iter().fold(mixed, f64::max);
        }
    }
    println!("rotation by inflation: {double:.1e}, in mixed precision {mixed:.1e}");
    assert!(double < 1e-10, "{double:e}");
    // Weights and differences are rounded to 6e-8, strains of order one cancel, and 1 % is the scale.
    assert!(mixed < 1e-4, "{mixed:e}");
}

/// Some large smooth deformation with noise on top.
fn distort<R: Real>(shell: &mut Shell<R>) {
    let mut next = noise();
    for i in 0..shell.state.len() {
        let x = shell.state.reference_position[i];
        let wave = DVec3::new((300.0 * x.y).sin(), (250.0 * x.z).cos(), (200.0 * x.x).sin());
        let noise = DVec3::new(next(), next(), next());
        shell.state.displacement[i] = SPACING * (0.5 * wave + 0.05 * noise);
        let turn = 0.2 * wave + 0.05 * DVec3::new(next(), next(), next());
        shell.state.director[i] = (shell.state.reference_director[i] + turn).normalize();
    }
    shell.refresh().expect("not inside out");
}

/// Sums of forces and of moments of an arbitrary state, by the sums of their sizes.
fn unbalanced<R: Real>(body: &Body, model: Model) -> [f64; 2] {
    let mut shell = shell::<R>(body, model);
    distort(&mut shell);
    let (force, couple) = forces(&shell);
    let moment = |i: usize| {
        let arm = shell.state.position(i).cross(force[i]);
        arm + shell.state.director[i].cross(couple[i])
    };
    let moments: Vec<DVec3> = (0..force.len()).map(moment).collect();
    let share = |v: &[DVec3]| v.iter().sum::<DVec3>().length() / v.iter().map(|v| v.length()).sum::<f64>();
    [share(&force), share(&moments)]
}

#[test]
fn momentum_is_kept_to_rounding() {
    for body in bodies(0.5e-3) {
        for model in MODELS {
            let double = unbalanced::<f64>(&body, model);
            assert!(double[0] < 1e-13 && double[1] < 1e-13, "{model:?}: {double:?}");
            let mixed = unbalanced::<f32>(&body, model);
            assert!(mixed[0] < 1e-6 && mixed[1] < 1e-6, "{model:?}: {mixed:?}");
        }
    }
}

/// Central differences of the energy along one direction of all particles.
#[test]
fn forces_are_the_derivative_of_the_energy() {
    for model in MODELS {
        let [_, body] = bodies(0.8e-3);
        let mut shell = shell::<f64>(&body, model);
        distort(&mut shell);
        let (force, couple) = forces(&shell);
        let mut next = noise();
        let mut direction = || DVec3::new(next(), next(), next());
        let n = shell.state.len();
        let (u, d) = (shell.state.displacement.to_vec(), shell.state.director.to_vec());
        let moved: Vec<DVec3> = (0..n).map(|_| SPACING * direction()).collect();
        let turned: Vec<DVec3> = (0..n)
            .map(|i| {
                let w = direction();
                w - w.dot(d[i]) * d[i]
            })
            .collect();
        let mut energy = |e: f64| {
            for i in 0..n {
                shell.state.displacement[i] = u[i] + e * moved[i];
                shell.state.director[i] = (d[i] + e * turned[i]).normalize();
            }
            shell.refresh().expect("not inside out");
            let energies = shell.energies();
            energies.strain() + energies.hourglass
        };
        let e = 1e-5;
        let numeric = -(energy(e) - energy(-e)) / (2.0 * e);
        let exact: f64 = (0..n).map(|i| force[i].dot(moved[i]) + couple[i].dot(turned[i])).sum();
        let size: f64 = (0..n).map(|i| (force[i].dot(moved[i])).abs()).sum();
        assert!((numeric - exact).abs() < 1e-7 * size, "{model:?}: {numeric:e} {exact:e} of {size:e}");
    }
}

/// A body of two sheets face to face, nearer than the kernel reaches: they do not see each other.
#[test]
fn walls_across_a_gap_do_not_touch() {
    let sheet = |z: f64, normal: f64| {
        let mut body = support::plate([8e-3, 8e-3], 0.5e-3, [Rows::Inside(8); 2]);
        body.position.iter_mut().for_each(|x| x.z = z);
        body.normal.iter_mut().for_each(|n| *n *= normal);
        body
    };
    let (mut both, other) = (sheet(0.0, -1.0), sheet(1e-3, 1.0));
    both.position.extend(&other.position);
    both.normal.extend(&other.normal);
    both.area.extend(&other.area);
    both.thickness.extend(&other.thickness);
    let mut shell = shell::<f64>(&both, Model::Resultant);
    for i in 0..shell.state.len() {
        if shell.state.reference_position[i].z > 0.5e-3 {
            shell.state.displacement[i] = DVec3::new(1e-4, 0.0, 2e-4);
        }
    }
    shell.refresh().expect("not inside out");
    let scale = 1e6 * 0.5e-3 * SPACING;
    assert!(largest(&forces(&shell).0) < 1e-12 * scale);
}
