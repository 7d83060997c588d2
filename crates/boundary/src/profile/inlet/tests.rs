//! Profiles over discs and ellipses, point by point.

use super::*;
use crate::waveform::{Interpolation, Waveform};
use glam::DVec3;
use vaso_geometry::{LengthUnit, prepare, shapes};

const RADIUS: f64 = 3e-3;

fn disc() -> Opening {
    let pipe = prepare(shapes::pipe(RADIUS, 0.02, DVec3::Z, 256), Some(LengthUnit::Metre)).expect("a pipe");
    pipe.openings[0].clone()
}

fn ellipse() -> Opening {
    let stretch = |o: &Opening| {
        let polygon = o.polygon.iter().map(|p| [p[0], p[1] / 1.5]).collect();
        Opening { polygon, area: o.area / 1.5, radius: o.radius / 1.5f64.sqrt(), ..o.clone() }
    };
    stretch(&disc())
}

fn numbers() -> Numbers {
    Numbers::new(1060.0, 3.5e-3, 0.4, 3e-4)
}

/// Mean over the cap of what an inlet imposes, on a grid of `n` points across.
fn mean(opening: &Opening, n: i32, value: impl Fn([f64; 2]) -> f64) -> f64 {
    let cell = |k: i32| RADIUS * (2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0);
    let points = (0..n * n).map(|k| [cell(k % n), cell(k / n)]);
    let within: Vec<[f64; 2]> = points
        .filter(|&[x, y]| {
            let at = opening.center + x * opening.axes[0] + y * opening.axes[1];
            opening.lateral(at) < 0.0
        })
        .collect();
    within.iter().map(|&at| value(at)).sum::<f64>() / within.len() as f64
}

#[test]
fn steady_profiles_have_unit_mean_on_any_cap() {
    let steady = Signal::constant(1.0);
    for opening in [disc(), ellipse()] {
        for profile in [
            Profile::Plug,
            Profile::Parabolic,
            Profile::Power { exponent: 1.0 },
            Profile::Power { exponent: 9.0 },
            Profile::FullyDeveloped,
            Profile::Womersley,
        ] {
            let inlet = Inlet::new(profile, &steady, &opening, &numbers());
            let mean = mean(&opening, 300, |at| inlet.steady(at));
            assert!((mean - 1.0).abs() < 2e-3, "{profile:?}: {mean}");
        }
    }
}

#[test]
fn the_parabola_is_the_fully_developed_flow_of_a_disc() {
    let steady = Signal::constant(1.0);
    let [parabolic, developed, power] =
        [Profile::Parabolic, Profile::FullyDeveloped, Profile::Power { exponent: 2.0 }]
            .map(|p| Inlet::new(p, &steady, &disc(), &numbers()));
    for r in [0.0, 0.3, 0.7, 0.99] {
        let (at, exact) = ([0.6 * r * RADIUS, 0.8 * r * RADIUS], 2.0 * (1.0 - r * r));
        assert!((parabolic.steady(at) - exact).abs() < 1e-3, "{r}");
        assert!((power.steady(at) - parabolic.steady(at)).abs() < 1e-12, "{r}");
        assert!((developed.steady(at) - exact).abs() < 0.01, "{r}: {}", developed.steady(at));
    }
}

/// Rows of G cos(w t) - driven flow through a rigid pipe, from the table of the project's data.
#[test]
fn womersley_profiles_are_those_of_the_table() {
    let Ok(data) = std::env::var("VASO_DATA") else {
        println!("skipped: VASO_DATA is not set");
        return;
    };
    // Amplitude and phase of the mean velocity over G / (rho w), from the README of the table.
    for (alpha, amplitude, degrees) in [(4.0, 0.7062, -65.6f64), (8.0, 0.8384, -78.9)] {
        let text = std::fs::read_to_string(format!("{data}/reference/analytic/womersley_alpha{alpha}.csv"))
            .expect("the table is there");
        let opening = disc();
        let numbers = numbers();
        let frequency = (alpha / opening.radius).powi(2) * numbers.viscosity / numbers.rest_density;
        let period = TAU / frequency;
        let time: Vec<f64> = (0..64).map(|k| period * f64::from(k) / 64.0).collect();
        let flow = |t: f64| amplitude * (frequency * t + degrees.to_radians()).cos();
        let value = time.iter().map(|&t| flow(t)).collect();
        let wave = Waveform::new(time, value, Some(period)).expect("valid");
        let wave = wave.interpolated(Interpolation::Fourier { harmonics: 4 }).expect("possible");
        let signal = Signal { source: Source::Waveform(wave), ramp: 0.0 };
        let inlet = Inlet::new(Profile::Womersley, &signal, &opening, &numbers);
        let mut worst: f64 = 0.0;
        for line in text.lines().skip(1) {
            let row: Vec<f64> = line.split(',').map(|v| v.parse().expect("a number")).collect();
            for (k, exact) in row[1..].iter().enumerate() {
                let at = [row[0] * opening.radius, 0.0];
                let u = inlet.velocity(at, &signal, period * k as f64 / 8.0);
                worst = worst.max((u - exact).abs());
            }
        }
        assert!(worst < 0.01, "alpha {alpha}: {worst}");
    }
}

#[test]
fn the_discrete_flow_is_the_asked_one_at_every_moment() {
    let time = vec![0.0, 0.05, 0.1, 0.16, 0.2, 0.26, 0.31, 0.4, 0.6];
    let value = vec![0.1, 0.12, 0.5, 0.45, 0.3, 0.1, -0.08, 0.12, 0.1];
    let wave = Waveform::new(time, value, Some(0.8)).expect("valid");
    let signal = Signal { source: Source::Waveform(wave), ramp: 0.1 };
    let opening = ellipse();
    let mut inlet = Inlet::new(Profile::Womersley, &signal, &opening, &numbers());
    assert!(inlet.n_waves() > 4);
    // Particles as coarse as ten across, each with the same volume.
    let coarse = 10;
    let n = inlet.n_waves();
    let part = |k: usize, imaginary: bool| {
        mean(&opening, coarse, |at| {
            let w = inlet.waves(at).nth(k).expect("a harmonic");
            if imaginary { w.im } else { w.re }
        })
    };
    let carried: Vec<Complex64> = (0..n).map(|k| Complex64::new(part(k, false), part(k, true))).collect();
    let steady = mean(&opening, coarse, |at| inlet.steady(at));
    inlet.scale(steady, &carried, 1.0, 1.0);
    for k in 0..40 {
        let t = 0.031 * f64::from(k);
        let flow = mean(&opening, coarse, |at| inlet.velocity(at, &signal, t));
        assert!((flow - signal.at(t)).abs() < 1e-12, "at {t}: {flow} {}", signal.at(t));
    }
}
