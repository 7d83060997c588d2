//! What a narrowing does to the blood on its axis, where there is a law.

use crate::cache;
use std::path::Path;
use vaso_driver::{Case, Flow, Plan, world};

/// Places along the axis of the shipped stenosis \[m\]: before, in and behind the throat.
const PLACES: [f64; 3] = [-6e-3, 0.0, 1e-3];

/// Without friction `p + rho u^2 / 2` is the same all along a streamline (Bernoulli), and friction can only take from it. Dissipation that
/// takes the curvature of a profile for a jump made it rise by half.
#[test]
fn blood_on_the_axis_of_a_narrowing_gains_no_energy() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cases/stenosis/case.toml");
    // Six across the throat: what is wrong shows more than at eight, in a third of the time.
    let spacing = 1e-3 / 3.0;
    let settings = [("particles.spacing".to_owned(), format!("{spacing} m"))];
    let mut case = Case::load(&file, &settings).unwrap_or_else(|e| panic!("{e}"));
    case.cache = Some(cache());
    let plan = Plan::new(&case).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow: Flow<f32> = world::build_flow(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let (from, end) = (0.2, 0.26);
    let mut sums = [[0.0; 3]; PLACES.len()];
    while flow.time < end {
        flow.step(end).unwrap_or_else(|e| panic!("{e}"));
        if flow.time < from {
            continue;
        }
        let state = &flow.fluid.state;
        for i in 0..state.len() {
            let x = state.position[i];
            for (sum, z) in sums.iter_mut().zip(PLACES) {
                if (x.z - z).abs() < 0.4e-3 && x.x.hypot(x.y) < 0.4e-3 {
                    sum[0] += 1.0;
                    sum[1] += state.pressure[i];
                    sum[2] += state.velocity[i].z;
                }
            }
        }
    }
    let density = plan.numbers.rest_density;
    let [before, throat, behind] = sums.map(|[n, p, u]| {
        let (p, u) = (p / n, u / n);
        println!("{p:.1} Pa and {u:.3} m/s: {:.1} Pa", p + 0.5 * density * u * u);
        p + 0.5 * density * u * u
    });
    // A twentieth is what the means over a cylinder of this width and time may be off by.
    assert!(throat < 1.05 * before && behind < 1.05 * before, "{before} {throat} {behind}");
    assert_eq!(flow.watch.escaped, 0);
}
