//! The same input gives the same bits for any number of threads.

use crate::{case, flow};
use vaso_fluid::Real;

/// Positions, velocities and densities after some steps with inflow and outflow, as bits.
fn bits<R: Real>(threads: usize) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
    pool.install(|| {
        let case = case("pipe", &[("particles.spacing", "0.7 mm"), ("opening.inlet.ramp", "5 ms")]);
        let (mut flow, _) = flow::<R>(&case);
        while flow.time < 0.1 {
            flow.step(0.1).unwrap_or_else(|e| panic!("{e}"));
        }
        let injected: u64 = flow.openings.ports().iter().map(|p| p.counters.injected).sum();
        let deleted: u64 = flow.openings.ports().iter().map(|p| p.counters.deleted).sum();
        assert!(injected > 0 && deleted > 0, "particles must have come ({injected}) and gone ({deleted})");
        let state = &flow.fluid.state;
        let vectors = state.position.iter().chain(state.velocity.iter()).flat_map(|v| v.to_array());
        let all = vectors.chain(state.density_change.iter().copied()).map(f64::to_bits);
        all.chain(state.id.iter().copied()).collect()
    })
}

#[test]
fn threads_do_not_change_a_bit_in_mixed_precision() {
    let one = bits::<f32>(1);
    for threads in [2, 4] {
        assert!(one == bits::<f32>(threads), "{threads} threads differ from one");
    }
}

#[test]
fn threads_do_not_change_a_bit_in_double_precision() {
    assert!(bits::<f64>(1) == bits::<f64>(2), "two threads differ from one");
}
