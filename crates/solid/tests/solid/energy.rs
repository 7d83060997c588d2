//! Balance of energy: nothing is lost without damping, all that is lost with it is counted.

use crate::support;

use glam::DVec3;
use support::{Body, lattice};
use vaso_solid::{Isa, Material, NeoHookean, Numbers, Real, Solid};

const SPACING: f64 = 1e-3;
const LENGTH: usize = 12;
const THICKNESS: usize = 4;

/// A clamped bar with the velocity of a swing; `jitter` disorders its lattice.
fn bar<R: Real>(numbers: Numbers, jitter: f64) -> Solid<R> {
    let body: Body =
        lattice(DVec3::new(-2.0 * SPACING, 0.0, 0.0), [LENGTH + 2, THICKNESS, THICKNESS], SPACING)
            .jittered(jitter, SPACING);
    let clamped = body.select(|x| x.x < 0.2 * SPACING);
    let material = Material::NeoHookean(NeoHookean::new(4e5, 0.45).expect("in range"));
    let mut solid = Solid::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body");
    for i in 0..solid.state.len() {
        let s = (solid.state.reference_position[i].x / (LENGTH as f64 * SPACING)).max(0.0);
        solid.state.velocity[i] = DVec3::new(0.0, 1.5 * s * s, 0.4 * s * s);
    }
    solid.clamp(&clamped).expect("particles exist");
    solid
}

fn numbers() -> Numbers {
    Numbers { damping: 0.0, ..Numbers::new(1120.0, SPACING) }
}

/// Swings until the tip has passed the middle upwards `periods` times; largest change of the energy, and the largest share of
/// the hourglass energy where the bar is bent most.
fn swing<R: Real>(mut solid: Solid<R>, periods: usize) -> (f64, f64) {
    let tip = (0..solid.state.len())
        .max_by(|&i, &j| solid.state.reference_position[i].x.total_cmp(&solid.state.reference_position[j].x))
        .expect("there are particles");
    solid.refresh().expect("at rest");
    let start = solid.energies().balance();
    let dt = 5.0 * solid.stable_step();
    let (mut passed, mut drift, mut share) = (0, 0.0_f64, 0.0_f64);
    let mut before = 0.0;
    while passed < periods {
        solid.advance(dt).expect("a gentle motion");
        let energies = solid.energies();
        drift = drift.max((energies.balance() / start - 1.0).abs());
        if energies.strain > 0.5 * start {
            share = share.max(energies.hourglass / energies.strain);
        }
        let y = solid.state.displacement[tip].y;
        passed += usize::from(before < 0.0 && y >= 0.0);
        before = y;
    }
    println!("{periods} periods: drift {drift:.2e}, hourglass / strain {share:.2e}");
    (drift, share)
}

#[test]
#[ignore = "a minute: a hundred periods of 224 particles"]
fn a_hundred_undamped_periods_keep_the_energy() {
    let (drift, share) = swing(bar::<f64>(numbers(), 0.0), 100);
    assert!(drift < 0.01, "{drift}");
    assert!(share < 0.02, "{share}");
}

/// A disordered set keeps the energy as well, in single precision too. In its four layers the hourglass control takes up to 2.5 %
/// of the strain energy, as it answers to the error of the gradients at the surface.
#[test]
fn disorder_and_mixed_precision_keep_the_energy() {
    let (drift, share) = swing(bar::<f32>(numbers(), 0.1), 10);
    assert!(drift < 0.01, "{drift}");
    assert!(share < 0.03, "{share}");
}

/// What pair damping and viscosity take is what is missing.
#[test]
fn damping_is_counted() {
    for (damping, viscosity) in [(0.25, 0.0), (0.0, 1.0)] {
        let numbers = Numbers { damping, viscosity, ..numbers() };
        let mut solid = bar::<f64>(numbers, 0.1);
        solid.refresh().expect("at rest");
        let start = solid.energies().kinetic;
        for _ in 0..200 {
            solid.advance(2e-5).expect("a gentle motion");
        }
        let end = solid.energies();
        println!(
            "damping {damping}, viscosity {viscosity}: {:.3} of the energy lost",
            end.dissipated / start
        );
        assert!(end.dissipated > 0.02 * start, "{} of {start}", end.dissipated);
        // Damping is evaluated half a step late, at the power of the velocity before the kick.
        assert!((end.balance() / start - 1.0).abs() < 0.02, "{}", end.balance() / start);
    }
}

/// Every other particle moved one way, the rest the other: the mean gradient sees nothing of it, the hourglass control does.
#[test]
fn a_checkerboard_decays() {
    let body = lattice(DVec3::ZERO, [8, 8, 8], SPACING);
    let pattern = |stiffness: f64| {
        let numbers = Numbers { hourglass: stiffness, ..Numbers::new(1120.0, SPACING) };
        let material = Material::NeoHookean(NeoHookean::new(4e5, 0.45).expect("in range"));
        let mut solid =
            Solid::<f64>::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body");
        let sign = |solid: &Solid<f64>, i: usize| {
            let site = (solid.state.reference_position[i] / SPACING).floor().as_i64vec3();
            if (site.x + site.y + site.z) % 2 == 0 { 1.0 } else { -1.0 }
        };
        for i in 0..512 {
            solid.state.displacement[i] = 0.02 * SPACING * sign(&solid, i) * DVec3::new(1.0, 0.5, -0.5);
        }
        solid.refresh().expect("not inverted");
        let amplitude = |solid: &Solid<f64>| {
            let sum: DVec3 = (0..512).map(|i| sign(solid, i) * solid.state.displacement[i]).sum();
            sum.length() / 512.0
        };
        let (start, mut top) = (amplitude(&solid), 0.0_f64);
        for step in 0..400 {
            solid.advance_in(solid.stable_step(), 1).expect("a gentle motion");
            if step >= 300 {
                top = top.max(amplitude(&solid));
            }
        }
        top / start
    };
    let (with, without) = (pattern(0.03), pattern(0.0));
    println!("left of the pattern: {with:.3}, without hourglass control {without:.3}");
    assert!(with < 0.05 && without > 2.0 * with, "{with} {without}");
}
