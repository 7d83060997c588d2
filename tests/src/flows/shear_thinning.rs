//! Blood whose viscosity follows the shear rate, in a pipe, against the developed flow of its law.

use crate::shear_thinning::Developed;
use crate::{case, flow};
use vaso_fluid::Rheology;

const DIAMETER: f64 = 6.35e-3;
const LENGTH: f64 = 31.75e-3;
/// Way the blood goes on the mean in a run \[m\]: the flow develops within the pipe.
const WAY: f64 = 0.024;

/// For blood of a mean velocity \[m/s\], slow enough for the law to matter:
/// root mean square of the velocity less that of the law between three and four diameters from the inlet, of the peak.
fn error(viscosity: &str, across: f64, mean_velocity: f64) -> f64 {
    let spacing = format!("{} mm", 1e3 * DIAMETER / across);
    let mean = format!("{mean_velocity} m/s");
    let end = format!("{} s", WAY / mean_velocity);
    let overrides = [
        ("particles.spacing", spacing.as_str()),
        ("blood.viscosity", viscosity),
        ("opening.inlet.value", &mean),
        ("run.end_time", &end),
    ];
    let (mut flow, plan) = flow::<f32>(&case("pipe", &overrides));
    let law: Rheology = plan.numbers.rheology.expect("the viscosity is a law");
    let exact = Developed::new(&law, 0.5 * DIAMETER, mean_velocity);
    let newtonian = 2.0 * mean_velocity;
    let (mut sum, mut n, mut parabola) = (0.0, 0.0_f64, 0.0);
    while flow.time < plan.end_time {
        flow.step(plan.end_time).unwrap_or_else(|e| panic!("{e}"));
        if flow.time < 0.8 * plan.end_time {
            continue;
        }
        let state = &flow.fluid.state;
        for (x, v) in state.position.iter().zip(state.velocity.iter()) {
            if (0.6..0.8).contains(&(x.z / LENGTH)) {
                let r = x.x.hypot(x.y);
                sum += (v.z - exact.velocity(r)).powi(2);
                parabola += (newtonian * (1.0 - (2.0 * r / DIAMETER).powi(2)) - exact.velocity(r)).powi(2);
                n += 1.0;
            }
        }
    }
    let [error, off] = [sum, parabola].map(|s| (s / n).sqrt() / exact.peak());
    println!("{viscosity} at {across}: {error:.4} of the peak; a parabola is {off:.4} off");
    assert!(off > 1.5 * error, "the law makes no difference");
    error
}

#[test]
fn carreau_yasuda_blood_has_its_profile() {
    assert!(error("{ model = \"carreau-yasuda\" }", 12.0, 0.02) < 0.02);
}

#[test]
#[ignore = "a minute on two cores; `just validate-long` runs it"]
fn casson_blood_has_its_profile() {
    assert!(error("{ model = \"casson\" }", 12.0, 0.01) < 0.02);
}
