//! Vessels of persons between a measured inflow and Windkessels: the published carotid and aorta.

use std::fmt::Write;
use std::path::Path;

use vaso_boundary::{Windkessel, mean_split};
use vaso_driver::{Case as Setup, Plan, world};

use super::measure::{Series, fly_on};
use super::{Case, Outcome, Tolerance, Unit};
use crate::{cache, data};

/// The carotid.
pub const CAROTID: Case = Case {
    name: "carotid",
    title: "Carotid of a person between an inflow and two Windkessels",
    setup: "Published case 05, rigid: 1060 kg/m^3, 3.5 mPa s, plug with the published inflow (period 0.7568 s), outlets of R_p 5.90e8, \
            C 8.83e-10, R_d 2.65e9 and 2.87e8, 1.81e-9, 1.29e9 from their periodic start; 0.4 mm, two beats, means of the second.",
    reference: "What any solver has to reach: both outlets at the mean inflow times the resistances in parallel, the split by them; \
                32.7 : 67.3 %, 92.6 mmHg and 11.64 ml/s as published with the case.",
    remark: "The pressure drop along the branches, about 1 mmHg, is taken for nothing in the reference. Volume is counted by the \
             particles that came in and went out.",
    quick: None,
    full: || run(&CAROTID_SPEC),
};

/// The aorta.
pub const AORTA: Case = Case {
    name: "aorta",
    title: "Aorta of a person with five Windkessels",
    setup: "Published thoracic aorta (VMR 0024), rigid: 1060 kg/m^3, 3.5 mPa s, parabola with the published inflow (period 0.66 s, peak \
            30 l/min), five outlets with R_p, C, R_d as published from their periodic start; 1.2 mm, two beats, means of the second.",
    reference: "As for the carotid; 8.7, 8.7, 10.3, 9.0, 63.3 %, 101.8 mmHg and 7.36 l/min as published.",
    remark: "The narrowest outlet is 4.4 spacings wide. The peak Reynolds number is 6700: the jet of late systole is not turbulent \
             here, and would be in truth. Volume is counted by the particles that came in and went out.",
    quick: None,
    full: || run(&AORTA_SPEC),
};

/// An outlet: its name, a point near it in the unit of the surface, R_p, C, R_d \[Pa s/m^3, m^3/Pa\].
type OutletSpec = (&'static str, [f64; 3], [f64; 3]);

/// A vessel of the outside data.
pub(super) struct Spec {
    surface: &'static str,
    unit: &'static str,
    spacing: f64,
    inlet: ([f64; 3], &'static str, &'static str),
    period: f64,
    /// Mean inflow as published \[m^3/s\], and how near to it the second beat has to be.
    inflow: (f64, f64),
    outlets: &'static [OutletSpec],
    /// Tolerance of the splits, absolute, and of the pressures.
    asked: [f64; 2],
    /// Tolerance of volume in less volume out.
    balance: Tolerance,
}

pub(super) const CAROTID_SPEC: Spec = Spec {
    surface: "geometry/carotid_bifurcation/carotid_lumen.stl",
    unit: "mm",
    spacing: 0.4e-3,
    inlet: ([1.53, 5.86, -31.85], "plug", "waveforms/carotid_inlet_velocity_sphinxsys.csv"),
    period: 0.7568,
    inflow: (11.64e-6, 0.005),
    outlets: &[
        ("eca", [8.99, 0.94, 19.12], [5.90e8, 8.83e-10, 2.65e9]),
        ("ica", [-2.96, -0.45, 22.22], [2.87e8, 1.81e-9, 1.29e9]),
    ],
    asked: [0.015, 0.015],
    balance: Tolerance::Asked(0.002),
};

pub(super) const AORTA_SPEC: Spec = Spec {
    surface: "geometry/aorta_arch_vmr0024/aorta_lumen.stl",
    unit: "cm",
    spacing: 1.2e-3,
    inlet: ([-0.991, 4.555, 2.863], "parabolic", "waveforms/aorta_vmr0024_inlet_velocity_sphinxsys.csv"),
    period: 0.66,
    inflow: (7.36e-3 / 60.0, 0.03),
    outlets: &[
        ("outlet-1", [-1.015, 4.275, 10.01], [7.13e7, 8.26e-10, 1.20e9]),
        ("outlet-2", [-2.644, 3.053, 10.812], [7.13e7, 8.26e-10, 1.20e9]),
        ("outlet-3", [-2.919, 1.801, 9.911], [6.02e7, 9.79e-10, 1.01e9]),
        ("outlet-4", [-1.077, 1.082, 9.589], [6.89e7, 8.55e-10, 1.16e9]),
        ("outlet-5", [-1.613, -0.821, 0.396], [9.80e6, 6.02e-9, 1.65e8]),
    ],
    asked: [0.03, 0.03],
    balance: Tolerance::Held(0.01),
};

/// The case of that text, planned, with its particles.
pub(super) fn prepare(text: &str) -> (Setup, Plan, world::Bodies) {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    let file = folder.path().join("case.toml");
    std::fs::write(&file, text).expect("a temporary file can be written");
    let mut setup = Setup::load(&file, &[]).unwrap_or_else(|e| panic!("{e}"));
    setup.cache = Some(cache());
    let plan = Plan::new(&setup).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(&setup, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    (setup, plan, bodies)
}

impl Spec {
    /// The case of this many beats, but for the wall.
    pub(super) fn text(&self, data: &Path, beats: f64) -> String {
        let (near, profile, waveform) = self.inlet;
        let mut text = format!(
            "[geometry]\nsurface = {:?}\nunit = \"{}\"\n[particles]\nspacing = \"{} m\"\n\
         [blood]\ndensity = \"1060 kg/m^3\"\nviscosity = \"3.5 mPa s\"\n\
         [[opening]]\nname = \"inlet\"\nnear = {near:?}\ncondition = \"velocity\"\nprofile = \"{profile}\"\nwaveform = {:?}\n",
            data.join(self.surface),
            self.unit,
            self.spacing,
            data.join(waveform),
        );
        for (name, near, [proximal, compliance, distal]) in self.outlets {
            write!(
                text,
                "[[opening]]\nname = \"{name}\"\nnear = {near:?}\ncondition = \"windkessel\"\n\
             proximal_resistance = \"{proximal} Pa s/m^3\"\ncompliance = \"{compliance} m^3/Pa\"\n\
             distal_resistance = \"{distal} Pa s/m^3\"\nperiodic_start = true\n"
            )
            .expect("a string can be written to");
        }
        write!(text, "[run]\nperiod = \"{} s\"\ncycles = {beats}\n", self.period)
            .expect("a string can be written to");
        text
    }
}

const MMHG: f64 = 133.322;

fn run(spec: &Spec) -> Option<Outcome> {
    let data = data()?;
    let mut outcome = Outcome::new();
    let text = spec.text(&data, 2.0);
    let (setup, plan, bodies) = prepare(&text);
    let mut flow = world::build_flow::<f32>(&setup, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));

    let place = |name: &str| plan.openings.iter().position(|o| o.name == name).expect("it is in the case");
    let inlet = place("inlet");
    let outlets: Vec<usize> = spec.outlets.iter().map(|o| place(o.0)).collect();
    let volumes = |flow: &vaso_driver::Flow<f32>| -> Vec<f64> {
        flow.openings.ports().iter().map(|p| p.counters.outflow_volume).collect()
    };
    fly_on(&mut flow, spec.period, |_| {});
    let before = volumes(&flow);
    let mut pressure = vec![Series::default(); outlets.len()];
    let flown = fly_on(&mut flow, 2.0 * spec.period, |flow| {
        for (series, &k) in pressure.iter_mut().zip(&outlets) {
            series.add(flow.time, flow.readings[k].pressure);
        }
    });
    outcome.cost(&flown);
    let through: Vec<f64> = volumes(&flow).iter().zip(&before).map(|(b, a)| (b - a) / spec.period).collect();

    let models: Vec<Windkessel> = spec.outlets.iter().map(|o| model(o.2)).collect();
    let (published, tolerance) = spec.inflow;
    let (level, shares) = mean_split(&models, published).expect("sound models");
    let total: f64 = outlets.iter().map(|&k| through[k]).sum();
    let inflow = -through[inlet];
    outcome.figure("inflow", inflow / published - 1.0, Unit::Part, Tolerance::Asked(tolerance));
    for (k, share) in shares.iter().enumerate() {
        let name = spec.outlets[k].0;
        let error = through[outlets[k]] / total - share;
        outcome.figure(
            format!("{name}: share of the outflow, less {:.1} %", 100.0 * share),
            error,
            Unit::Part,
            Tolerance::Asked(spec.asked[0]),
        );
        let mean = pressure[k].mean();
        outcome.figure(
            format!("{name}: mean pressure, {:.1} mmHg", mean / MMHG),
            mean / level - 1.0,
            Unit::Part,
            Tolerance::Asked(spec.asked[1]),
        );
    }
    outcome.figure(
        "volume in less volume out over the second beat",
        1.0 - total / inflow,
        Unit::Part,
        spec.balance,
    );
    outcome.figure("largest density deviation", flown.density, Unit::Part, Tolerance::Held(0.05));
    outcome.figure("particles lost", flown.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
    Some(outcome)
}

fn model([proximal_resistance, compliance, distal_resistance]: [f64; 3]) -> Windkessel {
    Windkessel { proximal_resistance, compliance, distal_resistance, distal_pressure: 0.0 }
}
