//! The runs of the hard cases in vessels that are hard by their shape.

use vaso_driver::{Flow, world};
use vaso_geometry::SignedDistance;

use super::flows::port;
use super::ride::{ride, voids};
use super::vessels;
use crate::validation::measure::Series;
use crate::validation::{Outcome, Tolerance, Unit};

/// Mean pressure \[Pa\] that drives the flow through the leg on the way up of a hairpin.
fn leg_pressure(gap: f64, outcome: &mut Outcome) -> f64 {
    let (radius, leg) = (2e-3, 14e-3);
    let surface = vessels::hairpin(radius, gap, leg);
    let across = 2.0 * radius + gap;
    let text = format!(
        "[particles]\nspacing = \"0.5 mm\"\n[blood]\nviscosity = \"20 mPa s\"\n\
         [[opening]]\nname = \"inlet\"\nnear = [0, 0, 0]\ncondition = \"velocity\"\nvalue = \"0.1 m/s\"\nramp = \"10 ms\"\n\
         [[opening]]\nname = \"outlet\"\nnear = [{}, 0, 0]\ncondition = \"pressure\"\nvalue = \"0 Pa\"\n\
         [run]\nend_time = \"0.12 s\"\n",
        1e3 * across
    );
    let (case, plan) = vessels::case(&surface, &text);
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow: Flow<f32> = world::build_flow(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    // Between the heights of a quarter and of three quarters of the leg, at x of the first leg.
    let (low, high) = (0.25 * leg, 0.75 * leg);
    let mut drops = Series::default();
    let shown = ride(&mut flow, plan.end_time, |flow| {
        if flow.time < 0.08 {
            return;
        }
        let state = &flow.fluid.state;
        let mean = |z: f64| {
            let near = (0..state.len())
                .filter(|&i| state.position[i].x < radius && (state.position[i].z - z).abs() < 0.5 * radius);
            let (sum, n) = near.fold((0.0, 0.0), |(s, n), i| (s + flow.fluid.pressure(i), n + 1.0));
            sum / n
        };
        drops.add(flow.time, mean(low) - mean(high));
    })
    .unwrap_or_else(|e| panic!("{e}"));
    shown.invariants(&format!("gap of {:.1} mm", 1e3 * gap), 0.05, outcome);
    drops.mean()
}

pub(super) fn hairpin() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let (near, far) = (leg_pressure(0.8e-3, &mut outcome), leg_pressure(4e-3, &mut outcome));
    outcome.figure(
        "pressure along a leg beside another, over one alone",
        near / far - 1.0,
        Unit::Part,
        Tolerance::Asked(0.05),
    );
    Some(outcome)
}

pub(super) fn stenosis() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let (radius, throat, whole) = (3e-3, 1.5e-3, 30e-3);
    let surface = vessels::stenosis(radius, throat, 12e-3, whole);
    // Reynolds number 500 in the throat: 0.55 m/s there, a quarter of it before.
    let text = "[particles]\nspacing = \"0.375 mm\"\n[blood]\n\
                [[opening]]\nname = \"inlet\"\nnear = [0, 0, 0]\ncondition = \"velocity\"\nvalue = \"0.1376 m/s\"\nramp = \"20 ms\"\n\
                [[opening]]\nname = \"outlet\"\nnear = [0, 0, 30]\ncondition = \"pressure\"\nvalue = \"0 Pa\"\n\
                [run]\nend_time = \"60 ms\"\n";
    let (case, plan) = vessels::case(&surface, text);
    let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow: Flow<f32> = world::build_flow(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let (inlet, outlet) = (port(&plan, "inlet"), port(&plan, "outlet"));
    let mut difference = Series::default();
    let shown = ride(&mut flow, plan.end_time, |flow| {
        difference.add(flow.time, flow.readings[inlet].flow + flow.readings[outlet].flow);
    })
    .unwrap_or_else(|e| panic!("{e}"));
    shown.invariants("", 0.02, &mut outcome);
    let inflow = 0.1376 * std::f64::consts::PI * radius * radius;
    outcome.figure(
        "outflow less inflow over the last third",
        difference.from(0.04).mean() / inflow,
        Unit::Part,
        Tolerance::Asked(0.03),
    );
    let wall = SignedDistance::closed(&case.vessel);
    let empty = voids(&wall, &flow.fluid.state.position, plan.numbers.spacing);
    outcome.figure("share of places without blood", empty, Unit::Part, Tolerance::Asked(0.005));
    Some(outcome)
}

pub(super) fn divider() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let case = crate::case(
        "carotid",
        &[("particles.spacing", "0.7 mm"), ("opening.cca.ramp", "0 s"), ("run.end_time", "50 ms")],
    );
    let (mut flow, plan) = crate::flow::<f32>(&case);
    let shown = ride(&mut flow, plan.end_time, |_| {}).unwrap_or_else(|e| panic!("{e}"));
    shown.invariants("", 0.05, &mut outcome);
    let wall = SignedDistance::wall(&case.vessel);
    let deepest =
        flow.fluid.state.position.iter().map(|x| wall.query(*x).distance).fold(f64::NEG_INFINITY, f64::max);
    outcome.figure(
        "deepest particle beyond the surface, in spacings",
        (deepest / plan.numbers.spacing).max(0.0),
        Unit::Number,
        Tolerance::Asked(0.1),
    );
    Some(outcome)
}

pub(super) fn tiny_outlet() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let at = |spacing: &str| {
        let file = crate::root().join("cases/carotid");
        let set = [("particles.spacing".to_owned(), spacing.to_owned())];
        vaso_driver::Case::load(&file, &set).and_then(|mut case| {
            case.cache = None;
            let plan = vaso_driver::Plan::new(&case)?;
            let bodies = world::Bodies::make(&case, |_, _, _| {})?;
            Ok((plan, bodies))
        })
    };
    let told = match at("1.1 mm") {
        Ok((plan, _)) => plan.warnings.iter().any(|w| w.contains("`eca`")),
        Err(_) => false,
    };
    outcome.figure(
        "a spacing of 1.1 mm runs with a word about it",
        f64::from(u8::from(told)),
        Unit::Number,
        Tolerance::AtLeast(1.0),
    );
    let refused = match at("3 mm") {
        Ok(_) => false,
        Err(error) => error.exit_code() == 2 && error.to_string().contains("particles.spacing"),
    };
    outcome.figure(
        "a spacing of 3 mm is refused by its key",
        f64::from(u8::from(refused)),
        Unit::Number,
        Tolerance::AtLeast(1.0),
    );
    Some(outcome)
}
