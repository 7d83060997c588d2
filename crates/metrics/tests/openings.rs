//! Openings whose flow, pressure and power are known.

use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};
use std::path::Path;
use vaso_io::Archive;
use vaso_metrics::{
    Change, Criterion, EnergyBalance, EnergySample, MetricsError, OpeningCycle, OpeningCycles, OpeningSample,
    Verdict, dissipation, kinetic_power,
};

fn sample(flow: f64, pressure: f64) -> OpeningSample {
    OpeningSample { flow, pressure, kinetic_power: 0.0 }
}

fn names() -> Vec<String> {
    ["in", "left", "right"].map(str::to_owned).to_vec()
}

/// Inlet 1 + sin, outlets a third and two thirds of it, in mL/s; pressures around 100, 90 and 80 mmHg.
fn bifurcation(phase: f64) -> [OpeningSample; 3] {
    let flow = 1e-6 * (1.0 + (TAU * phase).sin());
    let pulse = 1000.0 * (TAU * phase).cos();
    [
        sample(-flow, 13_332.0 + pulse),
        sample(flow / 3.0, 11_999.0 + 0.5 * pulse),
        sample(2.0 * flow / 3.0, 10_666.0),
    ]
}

fn cycles(n: u32, signal: impl Fn(f64) -> [OpeningSample; 3], start: f64, total: u32) -> Vec<OpeningCycle> {
    let mut sums = OpeningCycles::new(names(), 0.0, 0.9).expect("valid");
    (0..=n * total)
        .filter_map(|k| {
            let phase = start + f64::from(k) / f64::from(n);
            sums.add(0.9 * phase, &signal(phase)).expect("three samples")
        })
        .collect()
}

#[test]
fn means_ratios_and_split_of_a_bifurcation() {
    let found = cycles(1000, bifurcation, 0.0, 1);
    assert_eq!(found.len(), 1);
    let cycle = &found[0];
    let inlet = cycle.opening("in").expect("there is one");
    let [left, right] = ["left", "right"].map(|name| cycle.opening(name).expect("there is one"));
    let flow = cycle.flow(inlet);
    assert!((flow.mean + 1e-6).abs() < 1e-12);
    // A bin of a hundredth flattens a sine by (pi/100)^2/6, and no bin is centred on the peak.
    assert!((flow.min + 2e-6).abs() < 2e-9 && flow.max.abs() < 2e-9, "{flow:?}");
    assert!((cycle.flow(left).pulsatility_index().expect("flow") - 2.0).abs() < 2e-3);
    assert!((flow.pulsatility_index().expect("flow") - 2.0).abs() < 2e-3);
    assert!((flow.resistive_index().expect("flow") - 1.0).abs() < 1e-3, "it stops for a moment");
    assert!((cycle.pressure_drop(inlet, right).mean - 2666.0).abs() < 1e-6);
    assert!((cycle.pressure_drop(inlet, left).max - 1833.0).abs() < 1.0);
    let reserve = cycle.fractional_flow_reserve(inlet, left).expect("positive pressure");
    assert!((reserve - 11_999.0 / 13_332.0).abs() < 1e-9);
    let split = cycle.flow_split();
    assert_eq!(split[inlet], None);
    assert!((split[left].expect("an outlet") - 1.0 / 3.0).abs() < 1e-12);
    assert!(cycle.mass_balance_error().expect("an inlet") < 1e-12);
    assert_eq!(
        cycle.opening("top"),
        Err(MetricsError::UnknownOpening { name: "top".into(), known: "in\", \"left\", \"right".into() })
    );
}

/// p = 100 + 20 t, Q = 3 - 2 t over a cycle of one: int p Q = 300 - 70 - 40/3, by one sample at each end.
#[test]
fn work_of_straight_lines_is_exact() {
    let mut sums = OpeningCycles::new(vec!["a".into()], 0.0, 1.0).expect("valid");
    sums.add(0.0, &[OpeningSample { flow: 3.0, pressure: 100.0, kinetic_power: 1.0 }]).expect("one sample");
    let end = OpeningSample { flow: 1.0, pressure: 120.0, kinetic_power: 3.0 };
    let cycle = sums.add(1.0, &[end]).expect("one sample").expect("a cycle has ended");
    assert!((cycle.pressure_work[0] - (300.0 - 70.0 - 40.0 / 3.0)).abs() < 1e-10);
    assert!((cycle.kinetic_energy[0] - 2.0).abs() < 1e-12);
    assert!((cycle.flow(0).mean - 2.0).abs() < 1e-12 && (cycle.pressure(0).mean - 110.0).abs() < 1e-10);
}

/// A transient that decays by a factor of ten a cycle: changes do so too, and the criterion stops at the cycle in which they
/// pass one per cent.
#[test]
fn a_decaying_transient_becomes_periodic() {
    let decaying = |phase: f64| {
        let mut now = bifurcation(phase);
        now[2].pressure += 2000.0 * ((TAU * phase).sin() + 10.0_f64.powf(-phase));
        now
    };
    let found = cycles(500, decaying, 0.0, 5);
    assert_eq!(found.len(), 5);
    let changes: Vec<Change> = found.windows(2).map(|pair| Change::between(&pair[0], &pair[1])).collect();
    for pair in changes.windows(2) {
        // The peak-to-peak value itself decays from 1.1 to one of its last.
        let ratio = pair[0].pressure[2] / pair[1].pressure[2];
        assert!((8.0..10.5).contains(&ratio), "{ratio}");
        assert!(pair[0].flow.iter().all(|change| *change < 1e-9));
    }
    // rms of 0.9 * 10^-t over a cycle is 0.9 sqrt((1 - 10^-2) / (2 ln 10)) = 0.417, over a range of 2: 0.21, 0.021, 0.0021.
    let criterion = Criterion::default();
    let verdicts: Vec<Verdict> =
        (1..5).map(|k| criterion.judge(k as u64 + 1, Some(&changes[k - 1]), Some(0.0))).collect();
    assert_eq!(verdicts, [Verdict::GoOn, Verdict::GoOn, Verdict::Periodic, Verdict::Periodic]);
    assert_eq!(criterion.judge(1, None, None), Verdict::GoOn);
    assert_eq!(criterion.judge(4, Some(&changes[2]), Some(0.05)), Verdict::GoOn, "the wall still changes");
    assert_eq!(criterion.judge(20, Some(&changes[0]), None), Verdict::GaveUp);
}

#[test]
fn a_cycle_sampled_in_part_is_not_told() {
    let found = cycles(100, bifurcation, 0.5, 2);
    let numbers: Vec<u64> = found.iter().map(|cycle| cycle.number).collect();
    assert_eq!(numbers, [1]);
}

#[test]
fn the_state_goes_through_a_checkpoint() {
    let mut whole = OpeningCycles::new(names(), 0.0, 0.9).expect("valid");
    let at = |k: u32| (0.9 * f64::from(k) / 130.0, bifurcation(f64::from(k) / 130.0));
    for k in 0..200 {
        whole.add(at(k).0, &at(k).1).expect("three samples");
    }
    let mut archive = Archive::new("sums", 1);
    archive.remember(|memory| whole.remember("cycles", memory));
    let mut resumed = OpeningCycles::new(names(), 0.0, 0.9).expect("valid");
    archive
        .recall(Path::new("sums"), |memory| resumed.remember("cycles", memory))
        .expect("the same openings");
    assert_eq!(resumed, whole);
    for k in 200..300 {
        let (a, b) = (whole.add(at(k).0, &at(k).1), resumed.add(at(k).0, &at(k).1));
        assert_eq!(a, b);
        if let Ok(Some(mut cycle)) = a {
            archive.remember(|memory| cycle.remember("cycle", memory));
            let mut other = OpeningCycle::empty(&names());
            archive
                .recall(Path::new("sums"), |memory| other.remember("cycle", memory))
                .expect("three openings");
            assert_eq!(other, cycle);
        }
    }
    let more = ["in", "left", "right", "side"].map(str::to_owned).to_vec();
    let mut more = OpeningCycles::new(more, 0.0, 0.9).expect("valid");
    let error = archive.recall(Path::new("sums"), |memory| more.remember("cycles", memory)).unwrap_err();
    assert!(error.to_string().contains("`cycles.3.last`"), "{error}");
}

/// Poiseuille: the pressure drop times the flow is what friction turns into heat.
#[test]
fn a_pipe_flow_dissipates_what_its_pressure_brings() {
    let (radius, length, mu, gradient, density) = (2e-3, 0.05, 3.5e-3, 50.0, 1060.0);
    let rings = 2000;
    // Rings of the pipe: the velocity gradient is -G r / 2 mu across the radius.
    let ring = |i: usize| {
        let r = radius * (i as f64 + 0.5) / rings as f64;
        let shear = DMat3::from_cols(-gradient * r / (2.0 * mu) * DVec3::Z, DVec3::ZERO, DVec3::ZERO);
        (TAU * r * radius / rings as f64 * length, shear, mu)
    };
    let heat = dissipation(rings, ring);
    let flow = PI * gradient * radius.powi(4) / (8.0 * mu);
    assert!((heat / (gradient * length * flow) - 1.0).abs() < 1e-6);
    // A parabola carries twice the kinetic energy of a plug: in at one end, out at the other.
    let area = PI * radius * radius;
    let kinetic = kinetic_power(density, flow, area, 2.0);
    assert!((kinetic / (density * (flow / area).powi(2) * flow) - 1.0).abs() < 1e-12);
    let inflow_power = gradient * length * flow;
    let mut balance = EnergyBalance::default();
    for k in 0..5 {
        let now = EnergySample { inflow_power, dissipation: heat, kinetic_energy: 1e-6 };
        balance.add(0.1 * f64::from(k), now);
    }
    assert!(balance.relative_residual().expect("flow").abs() < 1e-6);
    assert!((balance.throughput - 0.4 * inflow_power).abs() < 1e-12 * inflow_power);
}

/// Without friction all that enters becomes motion; what is neither shows as residual.
#[test]
fn the_balance_counts_motion() {
    let mut balance = EnergyBalance::default();
    for k in 0..=10 {
        let t = 0.1 * f64::from(k);
        // Power 2 t from rest: energy t^2, of which the flow shows nine tenths.
        balance.add(t, EnergySample { inflow_power: 2.0 * t, dissipation: 0.0, kinetic_energy: 0.9 * t * t });
    }
    assert!((balance.inflow - 1.0).abs() < 1e-12);
    assert!((balance.relative_residual().expect("flow") - 0.1).abs() < 1e-12);
    assert_eq!(EnergyBalance::default().relative_residual(), None);
}
