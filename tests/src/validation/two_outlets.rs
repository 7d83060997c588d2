//! A bifurcation between two Windkessels.

use vaso_boundary::{Windkessel, mean_split};
use vaso_driver::{Case as Setup, Plan, world};
use vaso_geometry::shapes::{BifurcationSpec, bifurcation};
use vaso_geometry::write_stl;

use super::measure::{Series, fly_on};
use super::{Case, Outcome, Tolerance, Unit};
use crate::cache;

/// The case of the page.
pub const CASE: Case = Case {
    name: "two-outlets",
    title: "Bifurcation with two Windkessels",
    setup: "The carotid bifurcation of cases/carotid at 0.6 mm, 6 ml/s from a ramp of 50 ms on, outlets of 5.90e8 + 2.65e9 and \
            2.87e8 + 1.29e9 Pa s/m^3 (published case 05) with time constants of 20 ms, 0.4 s; means of the last 0.15 s. The \
            level of 8.4 kPa stays out of the equation of state.",
    reference: "Steady state: both outlets at Q / sum of 1/(R_p + R_d) but for the pressures along the branches; the split \
                follows from the resistances.",
    remark: "The pressure drops along the branches, some 30 Pa, are taken for nothing in the reference: 0.4 % of the level.",
    quick: Some(run),
    full: run,
};

const INFLOW: f64 = 6e-6;

fn run() -> Option<Outcome> {
    let mut outcome = Outcome::new();
    let spec = BifurcationSpec::default();
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    write_stl(&folder.path().join("lumen.stl"), &bifurcation(&spec).map(|v| v * 1e3))
        .expect("a temporary file can be written");
    let model = |proximal: f64, distal: f64| Windkessel {
        proximal_resistance: proximal,
        compliance: 0.02 / distal,
        distal_resistance: distal,
        distal_pressure: 0.0,
    };
    let models = [("ica", 2.87e8, 1.29e9), ("eca", 5.90e8, 2.65e9)].map(|(n, p, d)| (n, model(p, d)));
    let ends = [(spec.internal_angle, spec.internal_length), (-spec.external_angle, spec.external_length)]
        .map(|(angle, length)| [1e3 * length * angle.sin(), 0.0, 1e3 * length * angle.cos()]);
    let mut text = format!(
        "[geometry]\nsurface = \"lumen.stl\"\nunit = \"mm\"\n[particles]\nspacing = \"0.6 mm\"\n[blood]\n\
         [[opening]]\nname = \"cca\"\nnear = [0, 0, {}]\ncondition = \"flow\"\nvalue = \"{INFLOW} m^3/s\"\n\
         ramp = \"50 ms\"\n",
        -1e3 * spec.common_length
    );
    for ((name, model), near) in models.iter().zip(ends) {
        text += &format!(
            "[[opening]]\nname = \"{name}\"\nnear = {near:?}\ncondition = \"windkessel\"\n\
             proximal_resistance = \"{} Pa s/m^3\"\ndistal_resistance = \"{} Pa s/m^3\"\ncompliance = \"{} m^3/Pa\"\n",
            model.proximal_resistance, model.distal_resistance, model.compliance
        );
    }
    text += "[run]\nend_time = \"0.4 s\"\n";
    let file = folder.path().join("case.toml");
    std::fs::write(&file, text).expect("a temporary file can be written");
    let mut setup = Setup::load(&file, &[]).unwrap_or_else(|e| panic!("{e}"));
    setup.cache = Some(cache());
    let plan = Plan::new(&setup).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(&setup, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let mut flow = world::build_flow(&setup, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    let place = |name: &str| plan.openings.iter().position(|o| o.name == name).expect("it is in the case");
    let at = models.map(|(name, _)| place(name));
    let mut pressures = [const { Series { points: Vec::new() } }; 2];
    let mut flows = pressures.clone();
    let flown = fly_on(&mut flow, plan.end_time, |flow| {
        for k in 0..2 {
            pressures[k].add(flow.time, flow.readings[at[k]].pressure);
            flows[k].add(flow.time, flow.readings[at[k]].flow);
        }
    });
    outcome.cost(&flown);
    let (level, shares) = mean_split(&models.map(|m| m.1), INFLOW).expect("sound models");
    let late = |series: &[Series; 2]| [0, 1].map(|k| series[k].from(0.25).mean());
    let (p, q) = (late(&pressures), late(&flows));
    let split = q[0] / (q[0] + q[1]);
    outcome.figure("share of the internal branch", split - shares[0], Unit::Part, Tolerance::Asked(0.015));
    for k in 0..2 {
        let name = models[k].0;
        outcome.figure(format!("{name}: pressure"), p[k] / level - 1.0, Unit::Part, Tolerance::Asked(0.015));
        let own = models[k].1.total_resistance() * q[k];
        outcome.figure(
            format!("{name}: pressure over (R_p + R_d) times its flow"),
            p[k] / own - 1.0,
            Unit::Part,
            Tolerance::Asked(0.01),
        );
    }
    outcome.figure("outflow less inflow", (q[0] + q[1]) / INFLOW - 1.0, Unit::Part, Tolerance::Asked(0.005));
    outcome.figure("largest density deviation", flown.density, Unit::Part, Tolerance::Asked(0.02));
    outcome.figure("particles lost", flown.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
    Some(outcome)
}
