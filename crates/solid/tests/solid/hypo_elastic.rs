//! The updated-Lagrangian body through the same interface as the others.

use crate::support;

use glam::DVec3;
use support::lattice;
use vaso_particles::{Columns, visit};
use vaso_solid::{HypoElastic, Isa, Material, NeoHookean, Numbers, Real, Solid};

const SPACING: f64 = 1e-3;

/// A clamped bar that sags under a sudden weight; the sag of its end over time.
fn sag<R: Real>(material: Material) -> (Vec<f64>, Solid<R>) {
    let body = lattice(DVec3::new(-3.0 * SPACING, 0.0, 0.0), [15, 6, 6], SPACING);
    let numbers = Numbers::new(1000.0, SPACING);
    let mut solid = Solid::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body");
    solid.clamp(&body.select(|x| x.x < 0.0)).expect("particles exist");
    solid.set_gravity(DVec3::new(0.0, 0.0, -100.0));
    let tip = solid.place(body.position.len() - 1);
    let mut curve = Vec::new();
    for _ in 0..60 {
        solid.advance(5e-5).expect("a gentle load");
        curve.push(solid.state.displacement[tip].z);
    }
    (curve, solid)
}

/// At small strains both formulations are the same elasticity.
#[test]
fn it_bends_like_the_total_lagrangian_body() {
    let (young, poisson) = (4e5, 0.3);
    let (ours, mut solid) =
        sag::<f64>(Material::HypoElastic(HypoElastic::new(young, poisson).expect("in range")));
    let (theirs, _) = sag::<f64>(Material::NeoHookean(NeoHookean::new(young, poisson).expect("in range")));
    let lowest = |curve: &[f64]| curve.iter().copied().fold(0.0, f64::min);
    let ratio = lowest(&ours) / lowest(&theirs);
    println!("largest sag {:.3e} m, by the total-Lagrangian {ratio:.3}", lowest(&ours));
    assert!((ratio - 1.0).abs() < 0.15, "{ratio}");
    let energies = solid.energies();
    println!("{energies:?}, balance {:.2e}", energies.balance());
    // Stress and density are columns of the body: what is not remembered could not be restored.
    assert!(visit::bytes(&mut solid) > visit::bytes(&mut solid.state));
    assert_eq!(visit::first_non_finite(&mut solid), None);
    let mut names = 0;
    struct Count<'a>(&'a mut i32);
    impl vaso_particles::Visitor for Count<'_> {
        fn scalar(&mut self, _: &mut vaso_particles::ScalarColumn) {
            *self.0 += 1;
        }
        fn vector(&mut self, _: &mut vaso_particles::VectorColumn) {
            *self.0 += 1;
        }
        fn integer(&mut self, _: &mut vaso_particles::Column<u64>) {}
        fn label(&mut self, _: &mut vaso_particles::Column<i32>) {}
    }
    solid.visit(&mut Count(&mut names));
    assert_eq!(names, 12);
}

/// A free block that spins stays what it is, but for the stress that holds it together.
#[test]
fn a_spinning_block_keeps_its_energy() {
    let body = lattice(DVec3::splat(-4.0 * SPACING), [8, 8, 8], SPACING);
    let numbers = Numbers { damping: 0.0, ..Numbers::new(1000.0, SPACING) };
    let material = Material::HypoElastic(HypoElastic::new(4e5, 0.4).expect("in range"));
    let mut solid =
        Solid::<f64>::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body");
    let omega = DVec3::new(0.0, 0.0, 100.0);
    for i in 0..solid.state.len() {
        solid.state.velocity[i] = omega.cross(solid.state.reference_position[i]);
    }
    solid.refresh().expect("at rest");
    let start = solid.energies().balance();
    let turn = std::f64::consts::TAU / 100.0;
    for _ in 0..100 {
        solid.advance(0.01 * turn).expect("a slow spin");
    }
    let end = solid.energies();
    println!(
        "after a turn: {:+.2e} of the energy, {:.2e} of it elastic",
        end.balance() / start - 1.0,
        end.strain / start
    );
    assert!((end.balance() / start - 1.0).abs() < 0.01, "{}", end.balance() / start);
}
