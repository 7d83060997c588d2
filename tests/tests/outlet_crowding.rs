//! Particles that have come close to each other behind an outlet move apart again, though no flow carries them on.

use glam::DVec3;
use vaso_driver::Flow;

/// Smallest distance between particles up to three spacings behind the outlet at z = 31.75 mm, in spacings.
fn smallest_distance(flow: &Flow<f64>, spacing: f64) -> f64 {
    let near: Vec<DVec3> =
        flow.fluid.state.position.iter().copied().filter(|x| x.z > 31.75e-3 - 3.0 * spacing).collect();
    let mut smallest = f64::INFINITY;
    for (k, a) in near.iter().enumerate() {
        for b in &near[..k] {
            smallest = f64::min(smallest, a.distance(*b));
        }
    }
    smallest / spacing
}

#[test]
fn a_crowd_behind_an_outlet_spreads_without_a_flow() {
    let still = [("particles.spacing", "0.635 mm"), ("opening.inlet.value", "0 m/s")];
    let case = vaso_tests::case("pipe", &[&still[..], &[("numerics.sound_speed", "2 m/s")]].concat());
    let (mut flow, plan) = vaso_tests::flow::<f64>(&case);
    let spacing = plan.numbers.spacing;
    // Layers near 1.5 and 0.5 spacings are pushed together.
    for x in flow.fluid.state.position.iter_mut() {
        let depth = (31.75e-3 - x.z) / spacing;
        if depth < 2.0 {
            x.z = 31.75e-3 - spacing * (1.0 + 0.45 * (depth - 1.0));
        }
    }
    let before = smallest_distance(&flow, spacing);
    for _ in 0..60 {
        flow.step(f64::INFINITY).expect("fluid at rest is stable");
    }
    let after = smallest_distance(&flow, spacing);
    let removed: u64 = flow.openings.ports().iter().map(|p| p.counters.deleted).sum();
    println!(
        "smallest distance {before:.2} spacings, 60 steps later {after:.2}, {removed} particles removed"
    );
    assert!(before < 0.5, "the crowd is one: {before}");
    assert!(after > 0.65, "{after}");
    // Pairs part about their common centre: no layer of 78 particles is carried out through the cap.
    assert!(removed < 8, "{removed} left a vessel at rest");
}
