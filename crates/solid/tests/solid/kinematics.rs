//! What holds whatever the material does: exact strains, no stress by rotation, balance of forces.

use crate::support;

use glam::{DMat3, DVec3};
use support::{Body, lattice};
use vaso_solid::{Isa, Material, NeoHookean, Numbers, Real, SaintVenantKirchhoff, Solid};

const SPACING: f64 = 1e-3;
const DENSITY: f64 = 1120.0;

fn material() -> Material {
    Material::NeoHookean(NeoHookean::new(4e5, 0.45).expect("in range"))
}

fn block(jitter: f64) -> Body {
    lattice(DVec3::new(0.3, -0.2, 0.1), [12, 11, 10], SPACING).jittered(jitter, SPACING)
}

fn solid<R: Real>(body: &Body, material: Material, numbers: Numbers, isa: Isa) -> Solid<R> {
    Solid::new(&body.particles(), material, numbers, isa).expect("a sound body")
}

/// Moves the body by a linear map of its positions.
fn deform<R: Real>(solid: &mut Solid<R>, map: DMat3) {
    for i in 0..solid.state.len() {
        solid.state.displacement[i] = (map - DMat3::IDENTITY) * solid.state.reference_position[i];
    }
    solid.refresh().expect("not inverted");
}

fn largest(m: DMat3) -> f64 {
    m.to_cols_array().iter().fold(0.0, |top, x| top.max(x.abs()))
}

fn linear() -> DMat3 {
    DMat3::from_cols(DVec3::new(1.1, 0.05, -0.1), DVec3::new(0.2, 0.9, 0.0), DVec3::new(0.0, -0.1, 1.05))
}

#[test]
fn linear_displacements_are_exact_on_any_set() {
    for jitter in [0.0, 0.15] {
        let body = block(jitter);
        let numbers = Numbers::new(DENSITY, SPACING);
        let mut double = solid::<f64>(&body, material(), numbers, Isa::detect());
        deform(&mut double, linear());
        let mut mixed = solid::<f32>(&body, material(), numbers, Isa::detect());
        deform(&mut mixed, linear());
        for i in 0..body.position.len() {
            let error = largest(double.deformation_gradient(i) - linear());
            assert!(error < 1e-12, "double, jitter {jitter}, particle {i}: {error:e}");
            // Displacements of 0.05 m in parts of 2^-28 of a support, over a lever of a tenth of it, times the condition.
            let error = largest(mixed.deformation_gradient(i) - linear());
            assert!(error < 2e-6, "mixed, jitter {jitter}, particle {i}: {error:e}");
        }
    }
}

#[test]
fn constant_stress_is_in_balance_inside_a_lattice() {
    let body = block(0.0);
    let mut solid = solid::<f64>(&body, material(), Numbers::new(DENSITY, SPACING), Isa::detect());
    deform(&mut solid, linear());
    let (low, high) = (body.position[0], body.position[body.position.len() - 1]);
    let margin = 4.0 * solid.numbers().smoothing_length - SPACING;
    let inside = |x: DVec3| (x - low).min_element() > margin && (high - x).min_element() > margin;
    let top = solid.state.acceleration.iter().map(|a| a.length()).fold(0.0, f64::max);
    let mut n = 0;
    for i in 0..solid.state.len() {
        if inside(solid.state.reference_position[i]) {
            n += 1;
            assert!(solid.state.acceleration[i].length() < 1e-12 * top);
        }
    }
    assert!(n > 10, "{n} particles inside");
}

#[test]
fn a_quarter_turn_leaves_no_stress() {
    let quarter = DMat3::from_axis_angle(DVec3::new(2.0, -1.0, 3.0).normalize(), std::f64::consts::FRAC_PI_2);
    for jitter in [0.0, 0.15] {
        let numbers = Numbers::new(DENSITY, SPACING);
        for material in [
            material(),
            Material::SaintVenantKirchhoff(SaintVenantKirchhoff::new(4e5, 0.45).expect("in range")),
        ] {
            let mut solid = solid::<f64>(&block(jitter), material, numbers, Isa::detect());
            deform(&mut solid, quarter);
            let modulus = DENSITY * material.wave_speed(DENSITY).powi(2);
            for i in 0..solid.state.len() {
                assert!(solid.von_mises(i) < 1e-12 * modulus);
                let force = DENSITY * solid.state.acceleration[i].length();
                assert!(force < 1e-11 * modulus / SPACING, "{force:e}");
            }
        }
    }
}

/// A swirl with strain everywhere and velocities that damp.
fn stir<R: Real>(solid: &mut Solid<R>) {
    for i in 0..solid.state.len() {
        let x = (solid.state.reference_position[i] - DVec3::new(0.3, -0.2, 0.1)) / (10.0 * SPACING);
        let swirl = DVec3::new((3.0 * x.y).sin(), (2.0 * x.z + x.x).cos(), (4.0 * x.x * x.y).sin());
        solid.state.displacement[i] = 0.3 * SPACING * swirl;
        solid.state.velocity[i] = DVec3::new(swirl.z, -swirl.x, swirl.y);
    }
    solid.refresh().expect("not inverted");
}

#[test]
fn action_equals_reaction() {
    let mut solid = solid::<f64>(&block(0.15), material(), Numbers::new(DENSITY, SPACING), Isa::detect());
    stir(&mut solid);
    let center = solid.state.reference_position[0];
    let (mut force, mut moment, mut forces, mut moments) = (DVec3::ZERO, DVec3::ZERO, 0.0, 0.0);
    for i in 0..solid.state.len() {
        let f = solid.state.mass[i] * solid.state.acceleration[i];
        let m = (solid.state.position(i) - center).cross(f);
        force += f;
        moment += m;
        forces += f.length();
        moments += m.length();
    }
    assert!(force.length() < 1e-12 * forces, "{:e}", force.length() / forces);
    assert!(moment.length() < 1e-11 * moments, "{:e}", moment.length() / moments);
}

/// All loops by all instruction sets, against the scalar one in double precision.
#[test]
fn vectors_agree_with_the_scalar_reference() {
    let numbers = Numbers::new(DENSITY, SPACING);
    let body = block(0.15);
    let mut reference = solid::<f64>(&body, material(), numbers, Isa::scalar());
    stir(&mut reference);
    let scale = reference.state.acceleration.iter().map(|a| a.length()).fold(0.0, f64::max);
    let energy = reference.energies();
    let against = |name: &str, acceleration: &[DVec3], bound: f64| {
        for (a, b) in acceleration.iter().zip(reference.state.acceleration.iter()) {
            assert!((*a - *b).length() < bound * scale, "{name}: {a} {b}");
        }
    };
    for isa in Isa::available() {
        let mut double = solid::<f64>(&body, material(), numbers, isa);
        stir(&mut double);
        against(isa.name(), &double.state.acceleration, 1e-11);
        let mut mixed = solid::<f32>(&body, material(), numbers, isa);
        stir(&mut mixed);
        against(isa.name(), &mixed.state.acceleration, 2e-5);
        let e = mixed.energies();
        assert!((e.hourglass / energy.hourglass - 1.0).abs() < 1e-4, "{} {}", e.hourglass, energy.hourglass);
    }
}

/// The force is the derivative of strain and hourglass energy.
#[test]
fn forces_are_the_derivative_of_the_energy() {
    let numbers = Numbers { damping: 0.0, hourglass: 0.1, ..Numbers::new(DENSITY, SPACING) };
    let body = lattice(DVec3::ZERO, [5, 5, 5], SPACING).jittered(0.1, SPACING);
    let mut solid = solid::<f64>(&body, material(), numbers, Isa::detect());
    stir(&mut solid);
    let acceleration = solid.state.acceleration.to_vec();
    let scale = acceleration.iter().map(|a| a.length()).fold(0.0, f64::max) * solid.state.mass[0];
    for i in (0..125).step_by(11) {
        for axis in 0..3 {
            let e = 1e-5 * SPACING;
            let mut energy = |step: f64| {
                solid.state.displacement[i][axis] += step;
                solid.refresh().expect("not inverted");
                let energies = solid.energies();
                solid.state.displacement[i][axis] -= step;
                energies.strain + energies.hourglass
            };
            let numeric = -(energy(e) - energy(-e)) / (2.0 * e);
            let force = solid.state.mass[i] * acceleration[i][axis];
            assert!(
                (numeric - force).abs() < 1e-6 * scale,
                "particle {i}, axis {axis}: {numeric:e} {force:e}"
            );
        }
    }
}
