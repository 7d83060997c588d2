//! A tube with fibres under pressure, through the whole way from its case: where they lie is found from its centreline.

use super::tube::{innermost, means, pressure};
use crate::pipe::Pipe;
use glam::{DMat3, DVec3};
use vaso_driver::Flow;
use vaso_solid::HolzapfelGasserOgden;
use vaso_solid::material::Elastic;

/// Inner radius, thickness, length between the rings that are held \[m\].
const RADIUS: f64 = 5e-3;
const THICKNESS: f64 = 2e-3;
const LENGTH: f64 = 40e-3;
/// Pressure \[Pa\], and constants of the wall, SI.
const PRESSURE: f64 = 3e3;
const MATRIX: f64 = 20e3;
const FIBERS: f64 = 20e3;
const EXPONENT: f64 = 5.0;
const ANGLE: f64 = 30.0;
const POISSON: f64 = 0.45;

/// Radial displacement of the inner face of an endless tube in plane strain, by shooting: `dP_r/dR = (P_c - P_r) / R` from the pressure
/// inside, until nothing is left outside.
fn exact(pressure: f64, fibers: f64) -> f64 {
    let bulk = 2.0 * MATRIX * (1.0 + POISSON) / (3.0 * (1.0 - 2.0 * POISSON));
    let law =
        HolzapfelGasserOgden::new(MATRIX, fibers, EXPONENT, 0.0, ANGLE.to_radians(), bulk).expect("valid");
    // Axes: radial, circumferential, axial.
    let families = law.fibres(DVec3::Y, DVec3::Z);
    let stress = |radial: f64, around: f64| {
        let p = law.stress(&DMat3::from_diagonal(DVec3::new(radial, around, 1.0)), &families);
        [p.x_axis.x, p.y_axis.y]
    };
    // Radial stretch of a radial stress, which grows with it.
    let stretch = |wanted: f64, around: f64| {
        let (mut low, mut high) = (0.2, 2.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if stress(middle, around)[0] < wanted { low = middle } else { high = middle }
        }
        low
    };
    // Stress that is left at the outer face of a tube whose inner face has moved by `u`.
    let left = |u: f64| {
        let n = 400;
        let step = THICKNESS / f64::from(n);
        let mut r = RADIUS + u;
        let mut p = -pressure * r / RADIUS;
        let rates = |at: f64, r: f64, p: f64| {
            let radial = stretch(p, r / at);
            (radial, (stress(radial, r / at)[1] - p) / at)
        };
        for k in 0..n {
            let at = RADIUS + f64::from(k) * step;
            let (dr, dp) = rates(at, r, p);
            let (dr, dp) = rates(at + 0.5 * step, r + 0.5 * step * dr, p + 0.5 * step * dp);
            r += step * dr;
            p += step * dp;
        }
        p
    };
    let (mut low, mut high) = (0.0, RADIUS);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if left(middle) < 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Mean radial displacement in the middle fifth of the tube \[m\], continued from the middle of the innermost layer to the face with the volume kept, and the mean
/// pressure there.
fn middle(flow: &Flow<f32>, pipe: &Pipe) -> [f64; 2] {
    let layer = innermost(flow, pipe);
    let moved: f64 = layer.iter().map(|[r, u]| u * r / RADIUS).sum();
    [moved / layer.len() as f64, pressure(flow, pipe)]
}

#[test]
#[ignore = "two minutes on two cores; `just validate-walls` runs it"]
fn fibres_hold_a_tube_as_theory_says() {
    let wall = format!(
        "[wall]\nmodel = \"solid\"\nmaterial = \"holzapfel-gasser-ogden\"\nmatrix_modulus = \"{MATRIX} Pa\"\n\
         fiber_modulus = \"{FIBERS} Pa\"\nfiber_exponent = {EXPONENT}\nfiber_angle = \"{ANGLE} deg\"\npoisson_ratio = {POISSON}\n\
         thickness = \"{THICKNESS} m\"\ndensity = \"1000 kg/m^3\"\ndamping = \"quasi-static\"\n"
    );
    let end = format!("condition = \"pressure\"\nvalue = \"{PRESSURE} Pa\"\nramp = \"20 ms\"");
    let spacing = 2.0 * RADIUS / 10.0;
    // Slow sound is enough for a state at rest, and a thick liquid comes to it soon.
    let pipe = Pipe {
        diameter: 2.0 * RADIUS,
        length: LENGTH + 8.0 * spacing,
        density: 1000.0,
        viscosity: 0.3,
        inlet: end.clone(),
        outlet: end,
        more: format!("[numerics]\nsound_speed = \"20 m/s\"\n{wall}"),
        ..Pipe::published(10.0)
    };
    let (mut flow, _, _) = pipe.flow::<f32>();
    let [displacement, pressure] = means(&mut flow, [60e-3, 90e-3], |flow| middle(flow, &pipe));
    let (with, without) = (exact(pressure, FIBERS), exact(pressure, 0.0));
    println!(
        "{:.1} um under {pressure:.0} Pa, exact {:.1} um, without fibres {:.1} um",
        1e6 * displacement,
        1e6 * with,
        1e6 * without
    );
    assert!((pressure / PRESSURE - 1.0).abs() < 0.02, "{pressure}");
    // The fibres take a good part of the load, or this would test the matrix.
    assert!(with < 0.7 * without);
    assert!((displacement / with - 1.0).abs() < 0.02, "{}", displacement / with);
}
