//! Interpolations of tables.

use super::*;
use std::f64::consts::TAU;

#[test]
fn an_open_period_is_closed_to_its_start() {
    let wave = Waveform::new(vec![0.0, 0.5], vec![1.0, 3.0], Some(1.0)).expect("valid");
    for (t, expected) in [(0.0, 1.0), (0.25, 2.0), (0.5, 3.0), (0.75, 2.0), (1.25, 2.0), (7.5, 3.0)] {
        assert!((wave.at(t) - expected).abs() < 1e-12, "at {t}: {}", wave.at(t));
    }
}

/// Fourteen uneven rows of a beat with a rest at its end.
fn beat() -> Waveform {
    let time = vec![0.0, 0.05, 0.08, 0.11, 0.16, 0.2, 0.26, 0.31, 0.35, 0.4, 0.5, 0.6, 0.7, 0.8];
    let value = vec![1.0, 1.4, 4.0, 7.0, 6.0, 4.5, 3.0, 0.5, -0.5, 1.2, 1.1, 1.0, 1.0, 1.0];
    Waveform::new(time, value, Some(0.8)).expect("valid")
}

fn mean_of_samples(wave: &Waveform) -> f64 {
    let n = 100_000;
    (0..n).map(|j| wave.at(0.8 * (f64::from(j) + 0.5) / f64::from(n))).sum::<f64>() / f64::from(n)
}

#[test]
fn every_interpolation_has_the_mean_it_says() {
    for by in [Interpolation::Linear, Interpolation::Monotone, Interpolation::Fourier { harmonics: 6 }] {
        let wave = beat().interpolated(by).expect("possible");
        assert!((wave.mean() - mean_of_samples(&wave)).abs() < 1e-6, "{by:?}");
    }
}

#[test]
fn the_cubic_is_smooth_passes_the_rows_and_does_not_overshoot() {
    let table = beat();
    let wave = beat().interpolated(Interpolation::Monotone).expect("possible");
    for (k, &t) in table.time.iter().enumerate() {
        assert!((wave.at(t) - table.value[k]).abs() < 1e-12);
        // A jump of the slope would show as a jump of the first differences, which are of order dt otherwise.
        let dt = 1e-6;
        let kink = (wave.at(t + dt) - 2.0 * wave.at(t) + wave.at(t - dt)) / dt;
        assert!(kink.abs() < 0.05, "slope jumps by {kink} at {t} s");
    }
    let steps = (0..8000).map(|j| wave.at(1e-4 * f64::from(j)));
    assert!(steps.clone().all(|v| (-0.5..=7.0).contains(&v)));
    // The rest at the end stays a rest.
    assert!((0..100).all(|j| (wave.at(0.6 + 0.002 * f64::from(j)) - 1.0).abs() < 1e-12));
}

#[test]
fn even_samples_of_a_band_limited_wave_give_it_back() {
    let f = |t: f64| 1.0 + (TAU * t / 0.8).sin() + 0.3 * (3.0 * TAU * t / 0.8).cos();
    let time: Vec<f64> = (0..=20).map(|j| 0.2 + 0.04 * f64::from(j)).collect();
    let value = time.iter().map(|&t| f(t)).collect();
    let table = Waveform::new(time, value, Some(0.8)).expect("valid");
    let wave = table.interpolated(Interpolation::Fourier { harmonics: 8 }).expect("possible");
    for j in 0..50 {
        let t = 0.037 * f64::from(j);
        assert!((wave.at(t) - f(t)).abs() < 1e-12, "at {t}");
    }
    assert!(matches!(
        wave.interpolated(Interpolation::Fourier { harmonics: 11 }),
        Err(WaveformError::TooManyHarmonics { rows: 20, most: 10, .. })
    ));
}

#[test]
fn a_table_that_does_not_close_says_by_how_much() {
    let open = Waveform::new(vec![0.0, 0.5, 1.0], vec![1.0, 2.0, 1.5], Some(1.0)).expect("valid");
    assert_eq!((open.closing_jump(), beat().closing_jump()), (0.5, 0.0));
}

#[test]
fn without_a_period_the_ends_hold() {
    let wave = Waveform::new(vec![0.1, 0.2], vec![1.0, 2.0], None).expect("valid");
    assert_eq!((wave.at(0.0), wave.at(5.0)), (1.0, 2.0));
}

#[test]
fn bad_tables_are_named() {
    assert!(matches!(Waveform::new(vec![], vec![], None), Err(WaveformError::Empty { .. })));
    assert!(matches!(
        Waveform::new(vec![0.0, 1.0, 1.0], vec![0.0; 3], None),
        Err(WaveformError::Unsorted { row: 3, .. })
    ));
    assert!(matches!(
        Waveform::new(vec![0.0, 2.0], vec![0.0; 2], Some(1.0)),
        Err(WaveformError::LongerThanPeriod { .. })
    ));
}
