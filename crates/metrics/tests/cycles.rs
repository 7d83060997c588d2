//! Indices of stresses whose integrals are known.

use glam::DVec3;
use std::f64::consts::{PI, TAU};
use std::path::Path;
use vaso_io::Archive;
use vaso_metrics::{PointIndices, ShearCycle, ShearCycles};

const PERIOD: f64 = 0.8;

/// Last of `cycles` cycles of a stress in the plane z = 0, given by its phase, at `n` samples a cycle.
fn last_cycle(stress: impl Fn(f64) -> DVec3, n: u32, cycles: u32) -> PointIndices {
    let mut sums = ShearCycles::new(vec![DVec3::Z], 0.0, PERIOD).expect("valid");
    let mut last = None;
    for k in 0..=cycles * n {
        let phase = f64::from(k) / f64::from(n);
        last = sums.add(PERIOD * phase, &[Some(stress(phase))]).expect("one value").or(last);
    }
    let cycle = last.expect("cycles have ended");
    assert_eq!(cycle.number, u64::from(cycles) - 1);
    cycle.point[0].expect("covered")
}

#[test]
fn constant_stress() {
    let p = last_cycle(|_| 2.0 * DVec3::Y, 7, 2);
    assert!((p.tawss - 2.0).abs() < 1e-14 && (p.mean - 2.0 * DVec3::Y).length() < 1e-14);
    assert!(p.osi.expect("stress") < 1e-14);
    assert!((p.rrt.expect("mean") - 0.5).abs() < 1e-14);
    assert!(p.ecap.expect("stress") < 1e-14 && p.transverse.expect("second cycle") < 1e-14);
    assert!((p.peak - 2.0).abs() < 1e-14);
}

/// A triangle wave is piecewise linear, so its mean magnitude of one half is exact, however few the samples.
#[test]
fn purely_oscillating_stress() {
    let triangle = |phase: f64| (4.0 * (phase.fract() - 0.5).abs() - 1.0) * DVec3::X;
    let p = last_cycle(triangle, 4, 3);
    assert!((p.tawss - 0.5).abs() < 1e-12, "{}", p.tawss);
    assert!((p.osi.expect("stress") - 0.5).abs() < 1e-12);
    assert_eq!(p.rrt, None, "no mean, no residence time rather than an infinite one");
    assert!((p.ecap.expect("stress") - 1.0).abs() < 1e-12);
    assert!((p.peak - 1.0).abs() < 1e-12);
}

/// The stress turns at constant magnitude about an offset m: TAWSS of a chord polygon, mean m. With m = 0 OSI is 0.5 and with
/// m across nothing it is 1/2 (1 - m/TAWSS).
#[test]
fn rotating_stress() {
    let turning = |phase: f64| DVec3::new((TAU * phase).cos(), (TAU * phase).sin(), 0.0);
    let p = last_cycle(turning, 100, 2);
    // Mean distance of a polygon of n chords from its centre: 1 - (pi/n)^2/3 + ...
    assert!((p.tawss - (1.0 - (PI / 100.0).powi(2) / 3.0)).abs() < 1e-6, "{}", p.tawss);
    assert!((p.osi.expect("stress") - 0.5).abs() < 1e-12);

    let p = last_cycle(|phase| turning(phase) + 3.0 * DVec3::X, 400, 2);
    // Mean of |3 + e^(i t)|: 3 (1 + 1/36 + 1/5184 + ...), by the series of the complete elliptic integral.
    let exact = 3.0 * (1.0 + 1.0 / 36.0 + 1.0 / 5184.0 + 1.0 / 186_624.0);
    assert!((p.tawss - exact).abs() < 1e-4, "{}", p.tawss);
    assert!((p.osi.expect("stress") - 0.5 * (1.0 - 3.0 / exact)).abs() < 1e-5);
    // Across the mean, |sin| has mean 2/pi.
    assert!((p.transverse.expect("second cycle") - 2.0 / PI).abs() < 1e-4, "{:?}", p.transverse);
    assert!((p.peak - 4.0).abs() < 1e-12);
    assert!((p.rrt.expect("mean") * (1.0 - 2.0 * p.osi.expect("stress")) * p.tawss - 1.0).abs() < 1e-12);
}

/// tau = (2, sin t, 0): across the mean, mean |sin t| = 2/pi; unknown in the first cycle.
#[test]
fn transverse_stress_needs_a_cycle_before() {
    let swaying = |phase: f64| DVec3::new(2.0, (TAU * phase).sin(), 0.0);
    assert_eq!(last_cycle(swaying, 200, 1).transverse, None);
    let p = last_cycle(swaying, 200, 2);
    assert!((p.transverse.expect("second cycle") - 2.0 / PI).abs() < 1e-4);
}

/// Cycles end between samples: the halves before and after belong to different cycles, exactly so for a straight line.
#[test]
fn samples_need_not_meet_the_ends_of_cycles() {
    let mut sums = ShearCycles::new(vec![DVec3::Z], 0.0, 1.0).expect("valid");
    let mut ended: Vec<ShearCycle> = Vec::new();
    for k in 0..10 {
        let time = 0.3 * f64::from(k);
        ended.extend(sums.add(time, &[Some(time * DVec3::X)]).expect("one value"));
    }
    let means: Vec<f64> = ended.iter().map(|c| c.point[0].expect("covered").tawss).collect();
    assert_eq!(means.len(), 2);
    assert!((means[0] - 0.5).abs() < 1e-12 && (means[1] - 1.5).abs() < 1e-12, "{means:?}");
    assert!((ended[1].point[0].expect("covered").peak - 2.0).abs() < 1e-12);
    let change = ended[1].change_from(&ended[0], &[1.0]).expect("values");
    assert!((change - 1.0 / 1.5).abs() < 1e-12);
}

#[test]
fn points_without_values_get_no_indices() {
    let mut sums = ShearCycles::new(vec![DVec3::Z; 2], 0.0, 1.0).expect("valid");
    let mut ended = None;
    for k in 0..=20 {
        // The second point is lost for three samples, so that four of twenty intervals do not count.
        let second = (!(5..8).contains(&k)).then_some(DVec3::X);
        ended = sums.add(0.05 * f64::from(k), &[Some(DVec3::X), second]).expect("two values").or(ended);
    }
    let cycle = ended.expect("a cycle has ended");
    assert!(cycle.point[0].is_some() && cycle.point[1].is_none());
    let [tawss, ..] = cycle.fields();
    assert!((tawss[0] - 1.0).abs() < 1e-12 && tawss[1].is_nan());
    assert!((cycle.mean_tawss(&[1.0, 5.0]).expect("a value") - 1.0).abs() < 1e-12);
}

#[test]
fn what_is_shown_is_all_of_the_state() {
    let stress = |k: i32| {
        let phase = f64::from(k) / 17.0;
        [Some(DVec3::new(phase.sin(), (1.7 * phase).cos(), 0.0)), (k % 5 > 0).then_some(DVec3::Y)]
    };
    let new = || ShearCycles::new(vec![DVec3::Z; 2], 0.1, 0.4).expect("valid");
    let mut whole = new();
    for k in 0..100 {
        whole.add(0.01 * f64::from(k), &stress(k)).expect("two values");
    }
    let mut archive = Archive::new("sums", 1);
    archive.remember(|memory| whole.remember("shear", memory));
    let mut resumed = new();
    archive.recall(Path::new("sums"), |memory| resumed.remember("shear", memory)).expect("two points");
    for k in 100..200 {
        let time = 0.01 * f64::from(k);
        let (a, b) = (whole.add(time, &stress(k)), resumed.add(time, &stress(k)));
        assert_eq!(a, b, "at sample {k}");
        if let Ok(Some(mut cycle)) = a {
            archive.remember(|memory| cycle.remember("cycle", memory));
            let mut other = ShearCycle::empty(2);
            archive.recall(Path::new("sums"), |memory| other.remember("cycle", memory)).expect("two points");
            assert_eq!(other, cycle);
        }
    }
}
