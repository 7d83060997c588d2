//! Tubes under pressure against Lame and against the radial equation of finite elasticity.

use crate::support;

use glam::{DMat3, DVec3};
use std::f64::consts::TAU;
use support::{Body, rings};
use vaso_solid::material::Elastic;
use vaso_solid::{Face, Isa, Material, NeoHookean, Numbers, Particles, Solid};

/// Inner radius and thickness of an artery \[m\].
const INNER: f64 = 3e-3;
const THICKNESS: f64 = 6e-4;
const YOUNG: f64 = 4e5;

/// Displacement of every particle along its radius, by the answer at that radius; slab of one spacing, which repeats.
fn inflation(layers: usize, material: NeoHookean, pressure: f64, answer: impl Fn(f64) -> f64) -> Vec<f64> {
    let spacing = THICKNESS / layers as f64;
    let body = rings(INNER, INNER + THICKNESS, layers);
    let period = Some(DVec3::new(0.0, 0.0, spacing));
    let particles = Particles { period, ..body.particles() };
    let numbers = Numbers::new(1120.0, spacing);
    let mut solid = Solid::<f64>::new(&particles, Material::NeoHookean(material), numbers, Isa::detect())
        .expect("four layers");
    solid.add_pressure(&lumen(&body, spacing), pressure).expect("particles exist");
    let (_, residual) = solid.settle(1e-4, 100_000).expect("a gentle pressure");
    assert!(residual <= 1e-4, "at rest: {residual:e}");
    (0..solid.state.len())
        .map(|i| {
            let x = solid.state.reference_position[i];
            solid.state.displacement[i].dot(x.normalize()) / answer(x.length())
        })
        .collect()
}

/// The inner layer, with the area of the surface before it.
fn lumen(body: &Body, spacing: f64) -> Face {
    let inner = body.select(|x| x.length() < INNER + spacing);
    let normals: Vec<DVec3> = inner.iter().map(|&i| -body.position[i as usize].normalize()).collect();
    let area = TAU * INNER * spacing / inner.len() as f64;
    Face::new(inner.clone(), &normals, &vec![area; inner.len()]).expect("one normal each")
}

fn mean_and_scatter(ratios: &[f64]) -> (f64, f64) {
    let n = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / n;
    (mean, (ratios.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / n).sqrt())
}

/// Lame in plane strain, at a tenth of the usual pressure.
#[test]
fn four_layers_inflate_as_lame_says() {
    let (a, b, pressure) = (INNER, INNER + THICKNESS, 533.3);
    for (poisson, layers, bound) in [(0.45, 4, 0.02), (0.49, 4, 0.02), (0.45, 2, 0.05)] {
        let answer = |r: f64| {
            (1.0 + poisson) / YOUNG * pressure * a * a / (b * b - a * a)
                * ((1.0 - 2.0 * poisson) * r + b * b / r)
        };
        let material = NeoHookean::new(YOUNG, poisson).expect("in range");
        let (mean, scatter) = mean_and_scatter(&inflation(layers, material, pressure, answer));
        println!("nu {poisson}, {layers} layers: u / u_Lame {mean:.4}, scatter {scatter:.4}");
        assert!((mean - 1.0).abs() < bound, "nu {poisson}, {layers} layers: {mean}");
        assert!(scatter < bound);
    }
}

/// Present radius as a function of the reference radius by the radial equation `dP_r/dR = (P_t - P_r) / R`, found by shooting.
fn finite_inflation(material: &NeoHookean, pressure: f64) -> impl Fn(f64) -> f64 {
    let (a, b, n) = (INNER, INNER + THICKNESS, 400);
    let material = *material;
    let piola = move |radial: f64, hoop: f64| {
        let p = material.stress(&DMat3::from_diagonal(DVec3::new(radial, hoop, 1.0)), &[DVec3::ZERO; 2]);
        (p.x_axis.x, p.y_axis.y)
    };
    // Radial stretch that carries the radial stress.
    let radial_of = move |stress: f64, hoop: f64| {
        let mut stretch = 1.0 / hoop;
        for _ in 0..30 {
            let slope = (piola(stretch + 1e-6, hoop).0 - piola(stretch - 1e-6, hoop).0) / 2e-6;
            stretch -= (piola(stretch, hoop).0 - stress) / slope;
        }
        stretch
    };
    let shoot = move |inner: f64| {
        let step = (b - a) / f64::from(n);
        let (mut r, mut stress) = (inner, -pressure * inner / a);
        let mut radii = vec![r];
        let rates = |reference: f64, r: f64, stress: f64| {
            let hoop = r / reference;
            let radial = radial_of(stress, hoop);
            (radial, (piola(radial, hoop).1 - stress) / reference)
        };
        for k in 0..n {
            let reference = a + f64::from(k) * step;
            let (r1, s1) = rates(reference, r, stress);
            let (r2, s2) = rates(reference + 0.5 * step, r + 0.5 * step * r1, stress + 0.5 * step * s1);
            r += step * r2;
            stress += step * s2;
            radii.push(r);
        }
        (stress, radii)
    };
    let (mut low, mut high) = (a, 1.5 * a);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        // Too little inflation leaves pressure on the outside.
        if shoot(middle).0 < 0.0 { low = middle } else { high = middle }
    }
    let radii = shoot(low).1;
    move |reference: f64| {
        let s = (reference - a) / (b - a) * f64::from(n);
        let k = (s.floor() as usize).min(radii.len() - 2);
        radii[k] + (s - k as f64) * (radii[k + 1] - radii[k]) - reference
    }
}

/// The full pressure of 40 mmHg, which follows the surface.
#[test]
fn a_neo_hookean_tube_inflates_as_finite_elasticity_says() {
    let pressure = 5333.0;
    // Nearly incompressible: 0.228 mm at the inner surface by the closed form for an incompressible tube.
    let nearly = finite_inflation(&NeoHookean::new(YOUNG, 0.4999).expect("in range"), pressure)(INNER);
    assert!((nearly - 2.28e-4).abs() < 0.02 * 2.28e-4, "{nearly:e}");
    for poisson in [0.45, 0.49] {
        let material = NeoHookean::new(YOUNG, poisson).expect("in range");
        let answer = finite_inflation(&material, pressure);
        let (mean, scatter) = mean_and_scatter(&inflation(4, material, pressure, answer));
        println!("nu {poisson}: u / u_finite {mean:.4}, scatter {scatter:.4}");
        assert!((mean - 1.0).abs() < 0.03 && scatter < 0.03, "nu {poisson}: {mean} {scatter}");
    }
}
