//! Tubes: inflation against theory, and stability whatever the thickness.

use crate::support;

use glam::DVec3;
use std::f64::consts::TAU;
use support::tube;
use vaso_shell::{Height, Isa, Material, Model, Numbers, Shell, Support};

const SPACING: f64 = 1e-3;
const YOUNG: f64 = 1e6;
const POISSON: f64 = 0.45;
const AROUND: usize = 50;
const ALONG: usize = 24;

fn radius() -> f64 {
    AROUND as f64 * SPACING / TAU
}

/// A tube under the pressure `strain E' t / R`, with clamped ends or, in plane strain, as a piece of a long one.
fn pressed(
    thickness: f64,
    model: Model,
    jitter: f64,
    strain: f64,
    damping: f64,
    clamped: bool,
) -> Shell<f64> {
    let body = tube((radius(), ALONG as f64 * SPACING, thickness), AROUND, ALONG, jitter);
    let material = Material::new(YOUNG, POISSON, model).expect("in range");
    let numbers = Numbers { damping, ..Numbers::new(1100.0, SPACING) };
    let mut shell = Shell::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body");
    let end = 2.4 * SPACING;
    let ends = body.select(|x| x.z < end || x.z > ALONG as f64 * SPACING - end);
    let (held, support) =
        if clamped { (ends, Support::CLAMPED) } else { (body.all(), Support::sliding(DVec3::Z)) };
    shell.hold(&held, support).expect("particles exist");
    let pressure = strain * YOUNG / (1.0 - POISSON * POISSON) * thickness / radius();
    shell.add_pressure(&body.all(), &body.area, pressure).expect("particles exist");
    shell
}

/// Particles of the columns in the middle third.
fn middle(shell: &Shell<f64>) -> Vec<usize> {
    let half = 0.5 * ALONG as f64 * SPACING;
    let near = |i: &usize| (shell.state.reference_position[*i].z - half).abs() < 4.0 * SPACING;
    (0..shell.state.len()).filter(near).collect()
}

/// Mean circumferential strain of the middle.
fn hoop(shell: &Shell<f64>) -> f64 {
    let at = middle(shell);
    let radial = |&i: &usize| {
        let x = shell.state.reference_position[i];
        shell.state.displacement[i].dot(DVec3::new(x.x, x.y, 0.0).normalize())
    };
    at.iter().map(radial).sum::<f64>() / (at.len() as f64 * radius())
}

/// Stretch at which a long neo-Hookean tube in plane strain bears `p R / t`: `S_11 = p R / t`, as the loaded area grows with the
/// stretch.
fn stretch(load: f64) -> f64 {
    let shear = 0.5 * YOUNG / (1.0 + POISSON);
    let lame = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    let stress = |stretch: f64| {
        let j2 = stretch * stretch;
        let across = (shear + 0.5 * lame) / (shear + 0.5 * lame * j2);
        shear + (0.5 * lame * (j2 * across - 1.0) - shear) / j2
    };
    let (mut low, mut high) = (1.0, 1.5);
    while high - low > 1e-12 {
        let mean: f64 = 0.5 * (low + high);
        if stress(mean) < load { low = mean } else { high = mean }
    }
    low
}

/// Strains of 6, 13 and 20 % with three points through the thickness.
#[test]
fn a_neo_hookean_tube_follows_its_law() {
    for strain in [0.05, 0.1, 0.15] {
        let mut shell = pressed(0.5e-3, Model::NeoHookean { points: 3 }, 0.0, strain, 0.0, false);
        let (steps, rest) = shell.settle(1e-3, 100_000).expect("not inside out");
        let load = strain * YOUNG / (1.0 - POISSON * POISSON);
        let (found, expected) = (hoop(&shell), stretch(load) - 1.0);
        println!("pR/E't {strain}: {found:.4} of {expected:.4}, {steps} steps, {rest:.1e}");
        assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
        // Thin-walled equilibrium of the present: sigma = p r / t.
        let i = middle(&shell)[7];
        let sigma = load * 0.5e-3 * (1.0 + found) / shell.thickness(i);
        let principal = shell.principal_stresses(i, Height::Middle)[0];
        println!("stress {principal:.4e} of {sigma:.4e}");
        assert!((principal / sigma - 1.0).abs() < 0.02, "{principal} {sigma}");
    }
}

/// A sudden pressure with damping 0.25 and the usual step, from a twentieth of a spacing to four.
#[test]
fn tubes_of_any_thickness_are_stable() {
    for ratio in [0.05, 0.1, 0.3, 0.5, 0.85, 2.0, 4.0] {
        let mut shell = pressed(ratio * SPACING, Model::Resultant, 0.05, 0.01, 0.25, true);
        let period = TAU * radius() * (1100.0 * (1.0 - POISSON * POISSON) / YOUNG).sqrt();
        let mut peak = 0.0_f64;
        for _ in 0..25 {
            shell.advance(period).expect("stable");
            peak = peak.max(hoop(&shell));
        }
        let (found, energies) = (hoop(&shell), shell.energies());
        println!("t/dp {ratio}: strain {found:.5}, peak {peak:.5}");
        // Thin walls go on swinging slowly in zigzags, which are not damped: the strain is bounded, and the energy counted.
        assert!(peak < 0.02 && (0.7..1.4).contains(&(found / 0.01)), "{found}");
        assert!(energies.balance().abs() < 0.02 * energies.load_work, "{energies:?}");
    }
}
