//! What a shell gets from its ghosts.

use glam::DVec3;
use std::f64::consts::TAU;
use vaso_coupling::{MovingWall, ShellWall};
use vaso_particles::WallLoad;
use vaso_shell::{Isa, Material, Model, Numbers, Particles, Shell, Support};

const SPACING: f64 = 1e-3;
const RADIUS: f64 = 6e-3;

/// A tube without supports.
fn tube() -> Shell<f64> {
    let around = (TAU * RADIUS / SPACING) as usize;
    let site = |k: usize| {
        let (ring, angle) = (k / around, TAU * (k % around) as f64 / around as f64);
        let away = DVec3::new(angle.cos(), angle.sin(), 0.0);
        (RADIUS * away + SPACING * ring as f64 * DVec3::Z, away)
    };
    let n = 12 * around;
    let (position, normal): (Vec<DVec3>, Vec<DVec3>) = (0..n).map(site).unzip();
    let (area, thickness) = (vec![TAU * RADIUS / around as f64 * SPACING; n], vec![0.5e-3; n]);
    let particles = Particles { position: &position, normal: &normal, area: &area, thickness: &thickness };
    let material = Material::new(1e6, 0.45, Model::Resultant).expect("in range");
    let numbers = Numbers { damping: 0.0, ..Numbers::new(1100.0, SPACING) };
    Shell::new(&particles, material, numbers, Isa::detect()).expect("a sound body")
}

/// Forces on the ghosts without any order.
fn forces(n: usize) -> Vec<DVec3> {
    let noise = |k: usize, axis: f64| (12.9898 * (k as f64 + 0.37 * axis)).sin();
    (0..n).map(|k| 1e-3 * DVec3::new(noise(k, 1.0), noise(k, 2.0), 0.5 + noise(k, 3.0))).collect()
}

#[test]
fn the_shell_gets_all_the_momentum_of_its_ghosts() {
    let mut shell = tube();
    let all: Vec<u32> = (0..shell.state.len() as u32).collect();
    shell.hold(&all, Support::CLAMPED).expect("particles exist");
    let mut wall = ShellWall::new(shell, SPACING, 2.6 * SPACING).expect("at rest");
    let force = forces(wall.view().position.len());
    let none = vec![DVec3::ZERO; force.len()];
    wall.load(&WallLoad { pressure_force: &force, viscous_force: &none, face_pressure: &[] })
        .expect("a load of the view");
    let (sum, size): (DVec3, f64) = (force.iter().sum(), force.iter().map(|f| f.length()).sum());
    assert!(sum.length() > 0.1 * size, "the forces have a resultant");
    // Nothing moves, so the supports bear it all.
    let imbalance = (wall.shell.reaction() + sum).length() / size;
    assert!(imbalance < 1e-12, "{imbalance:e}");
}

#[test]
fn forces_do_the_same_work_on_ghosts_as_on_the_shell() {
    let mut shell = tube();
    for i in 0..shell.state.len() {
        let x = shell.state.reference_position[i] / RADIUS;
        shell.state.velocity[i] = 0.1 * DVec3::new(x.x + 0.3 * x.z, x.y * x.z, (2.0 * x.x).sin());
    }
    let mut wall = ShellWall::new(shell, SPACING, 2.6 * SPACING).expect("at rest");
    let force = forces(wall.view().position.len());
    let none = vec![DVec3::ZERO; force.len()];
    let step = 1e-12;
    let pressure: Vec<f64> =
        (0..wall.shell.state.len()).map(|k| 1e3 * (2.0 + (3.7 * k as f64).sin())).collect();
    wall.load(&WallLoad { pressure_force: &force, viscous_force: &none, face_pressure: &pressure })
        .expect("a load of the view");
    wall.advance(step).expect("nothing breaks so soon");
    let on_ghosts = force.iter().zip(wall.view().velocity).map(|(f, v)| f.dot(*v));
    let on_facets = pressure.iter().enumerate().map(|(k, p)| {
        let facet = wall.facet(k);
        p * facet.area.dot(facet.velocity)
    });
    let parts: Vec<f64> = on_ghosts.chain(on_facets).collect();
    let (power, size): (f64, f64) = (parts.iter().sum(), parts.iter().map(|p| p.abs()).sum());
    let found = wall.shell.energies().load_work / step;
    assert!((found - power).abs() < 1e-5 * size, "{found} {power} of {size}");
}

/// A rigid motion strains nothing, and ghosts go along.
#[test]
fn ghosts_turn_with_the_shell() {
    let mut shell = tube();
    let spin = DVec3::new(0.3, -0.2, 0.5);
    for i in 0..shell.state.len() {
        shell.state.velocity[i] = DVec3::X + spin.cross(shell.state.reference_position[i]);
        shell.state.director_velocity[i] = spin.cross(shell.state.director[i]);
    }
    let mut wall = ShellWall::new(shell, SPACING, 2.6 * SPACING).expect("at rest");
    let still = vec![DVec3::ZERO; wall.view().position.len()];
    wall.load(&WallLoad { pressure_force: &still, viscous_force: &still, face_pressure: &[] })
        .expect("a load of the view");
    wall.advance(1e-9).expect("nothing breaks so soon");
    let view = wall.view();
    for (x, v) in view.position.iter().zip(view.velocity) {
        assert!((*v - DVec3::X - spin.cross(*x)).length() < 1e-6, "{v} at {x}");
    }
}
