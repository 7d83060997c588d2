//! Outlet models alone against published results.

use std::f64::consts::{PI, TAU};
use vaso_boundary::{Integration, OutletState, Waveform, Windkessel, mean_split};

fn data(path: &str) -> Option<String> {
    let Ok(folder) = std::env::var("VASO_DATA") else {
        println!("skipped: VASO_DATA is not set");
        return None;
    };
    Some(std::fs::read_to_string(format!("{folder}/{path}")).expect("the data holds the file"))
}

/// Rows of a table with one line of names.
fn rows(text: &str) -> Vec<Vec<f64>> {
    let row = |line: &str| line.split(',').map(|v| v.trim().parse().expect("a number")).collect();
    text.lines().skip(1).map(row).collect()
}

fn waveform(text: &str) -> Waveform {
    let rows = rows(text);
    let (time, value): (Vec<f64>, Vec<f64>) = rows.iter().map(|r| (r[0], r[1])).unzip();
    let period = time[time.len() - 1] - time[0];
    Waveform::new(time, value, Some(period)).expect("a valid table")
}

/// Eight cycles of the svFSI pipe from rest, cgs units.
#[test]
fn the_svfsi_pipe_outlet_fills_from_empty() {
    let Some(text) = data("reference/analytic/rcr_exact_svfsi_pipe.csv") else { return };
    let model = Windkessel {
        proximal_resistance: 121.0,
        compliance: 1.5e-4,
        distal_resistance: 1212.0,
        distal_pressure: 0.0,
    };
    let flow = |t: f64| 20.0 * PI * (1.0 - (TAU * t).cos());
    let mut state = OutletState::default();
    let (mut t, mut worst, mut peak): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for row in &rows(&text)[1..] {
        // Ten steps a row: an acoustic step is shorter still.
        let dt = (row[0] - t) / 10.0;
        for k in 1..=10 {
            state = model.advance(&state, flow(t + dt * f64::from(k)), dt, Integration::Exponential);
        }
        t = row[0];
        worst = worst.max((state.pressure - row[1]).abs());
        peak = peak.max(row[1]);
    }
    assert!(worst < 1e-6 * peak, "{} of the peak", worst / peak);
}

#[test]
fn the_common_carotid_benchmark_has_its_periodic_cycle() {
    let Some(text) = data("waveforms/cca_boileau2015.csv") else { return };
    let model = Windkessel {
        proximal_resistance: 2.4875e8,
        compliance: 1.7529e-10,
        distal_resistance: 1.8697e9,
        distal_pressure: 0.0,
    };
    let cycle = model.periodic(&waveform(&text)).expect("periodic");
    assert!((cycle.diastolic / 10_081.0 - 1.0).abs() < 1e-4, "{cycle:?}");
    assert!((cycle.systolic / 17_951.0 - 1.0).abs() < 1e-4, "{cycle:?}");
    assert!((cycle.mean / 13_769.9 - 1.0).abs() < 1e-4, "{cycle:?}");
}

/// The two outlets of the published carotid and the five of the aorta: split and mean pressure.
#[test]
fn published_vessels_have_their_split_and_mean_pressure() {
    let outlet = |(proximal_resistance, compliance, distal_resistance)| Windkessel {
        proximal_resistance,
        compliance,
        distal_resistance,
        distal_pressure: 0.0,
    };
    let carotid = [(5.90e8, 8.83e-10, 2.65e9), (2.87e8, 1.81e-9, 1.29e9)].map(outlet);
    let (pressure, shares) = mean_split(&carotid, 11.64e-6).expect("valid");
    assert!((pressure / 133.322 - 92.6).abs() < 0.1, "{pressure} Pa");
    assert!((shares[0] - 0.327).abs() < 1e-3 && (shares[1] - 0.673).abs() < 1e-3, "{shares:?}");
    let aorta = [
        (7.13e7, 8.26e-10, 1.20e9),
        (7.13e7, 8.26e-10, 1.20e9),
        (6.02e7, 9.79e-10, 1.01e9),
        (6.89e7, 8.55e-10, 1.16e9),
        (9.80e6, 6.02e-9, 1.65e8),
    ]
    .map(outlet);
    let (pressure, shares) = mean_split(&aorta, 7.36e-3 / 60.0).expect("valid");
    assert!((pressure / 133.322 - 101.8).abs() < 0.2, "{pressure} Pa");
    for (share, published) in shares.iter().zip([0.087, 0.087, 0.103, 0.090, 0.633]) {
        assert!((share - published).abs() < 1e-3, "{shares:?}");
    }
}
