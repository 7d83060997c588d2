//! Straight round pipes with any condition at their ends.

use std::fmt::Write;

use glam::{DQuat, DVec3};
use vaso_driver::deforming::Deforming;
use vaso_driver::{Case, Flow, Plan, world};
use vaso_fluid::Real;
use vaso_geometry::{shapes, write_stl};

use crate::cache;

/// Points around a pipe: its section is that of the circle but for 2e-4.
const SEGMENTS: usize = 180;

/// A pipe along an axis with a condition at each end.
#[derive(Clone, Debug)]
pub struct Pipe {
    /// Diameter \[m\].
    pub diameter: f64,
    /// Length \[m\].
    pub length: f64,
    /// Direction from the inlet to the outlet.
    pub axis: DVec3,
    /// Centre of the inlet \[m\].
    pub origin: DVec3,
    /// Metres of a unit of the surface file: 1e-3 or 1e-2, as `unit` names it.
    pub unit: (&'static str, f64),
    /// Spacings over the diameter.
    pub across: f64,
    /// Density \[kg/m^3\].
    pub density: f64,
    /// Viscosity \[Pa s\].
    pub viscosity: f64,
    /// Name of a law that the viscosity follows instead.
    pub law: Option<&'static str>,
    /// Keys of the inlet in `case.toml`.
    pub inlet: String,
    /// Keys of the outlet.
    pub outlet: String,
    /// End of the run \[s\].
    pub end_time: f64,
    /// Lines of the table `[run]` beside the end time, and tables after it.
    pub more: String,
    /// Two columns that `inlet` may name as the waveform `inflow.csv`.
    pub inflow: Vec<[f64; 2]>,
}

impl Pipe {
    /// The pipe of the published cases, 6.35 mm wide and five diameters long, filled with a fluid of 1050 kg/m^3 and
    /// 3.6 mPa s; its ends are to be given.
    pub fn published(across: f64) -> Self {
        Self {
            diameter: 6.35e-3,
            length: 31.75e-3,
            axis: DVec3::Z,
            origin: DVec3::ZERO,
            unit: ("mm", 1e-3),
            across,
            density: 1050.0,
            viscosity: 3.6e-3,
            law: None,
            inlet: String::new(),
            outlet: String::new(),
            end_time: 1.2,
            more: String::new(),
            inflow: Vec::new(),
        }
    }

    /// Radius \[m\].
    pub fn radius(&self) -> f64 {
        0.5 * self.diameter
    }

    /// Area of a section \[m^2\].
    pub fn area(&self) -> f64 {
        std::f64::consts::PI * self.radius().powi(2)
    }

    /// Spacing \[m\].
    pub fn spacing(&self) -> f64 {
        self.diameter / self.across
    }

    /// Value of the waveform at `t` \[s\], in straight lines between its rows; that of the last row after its end.
    pub fn inflow_at(&self, t: f64) -> f64 {
        let next = self.inflow.partition_point(|row| row[0] <= t);
        match (self.inflow.get(next.wrapping_sub(1)), self.inflow.get(next)) {
            (Some([t0, a]), Some([t1, b])) => a + (b - a) * (t - t0) / (t1 - t0),
            (Some([_, value]), None) | (None, Some([_, value])) => *value,
            (None, None) => 0.0,
        }
    }

    /// Distance behind the inlet and from the axis \[m\] of a point.
    pub fn place(&self, x: DVec3) -> (f64, f64) {
        let along = self.axis.normalize();
        let z = (x - self.origin).dot(along);
        (z, (x - self.origin - z * along).length())
    }

    /// Rotation from the z axis to the axis.
    pub fn turn(&self) -> DQuat {
        DQuat::from_rotation_arc(DVec3::Z, self.axis.normalize())
    }

    /// Case and plan.
    ///
    /// # Panics
    /// When the case is wrong: these are the project's own.
    pub fn plan(&self) -> (Case, Plan) {
        let folder = tempfile::tempdir().expect("a temporary folder can be had");
        let (name, metres) = self.unit;
        let surface = shapes::pipe(self.radius(), self.length, DVec3::Z, SEGMENTS);
        let turn = self.turn();
        write_stl(&folder.path().join("pipe.stl"), &surface.map(|v| (turn * v + self.origin) / metres))
            .expect("a temporary file can be written");
        let table = self.inflow.iter().fold(String::new(), |mut text, [t, value]| {
            writeln!(text, "{t},{value}").expect("a string can be written to");
            text
        });
        std::fs::write(folder.path().join("inflow.csv"), table).expect("a temporary file can be written");
        let near = |x: DVec3| format!("[{}, {}, {}]", x.x / metres, x.y / metres, x.z / metres);
        let end = self.origin + self.length * self.axis.normalize();
        let viscosity = match self.law {
            Some(law) => format!("{{ model = \"{law}\" }}"),
            None => format!("\"{} Pa s\"", self.viscosity),
        };
        let text = format!(
            "[geometry]\nsurface = \"pipe.stl\"\nunit = \"{name}\"\n\
             [particles]\nspacing = \"{} m\"\n\
             [blood]\ndensity = \"{} kg/m^3\"\nviscosity = {viscosity}\n\
             [[opening]]\nname = \"inlet\"\nnear = {}\n{}\n\
             [[opening]]\nname = \"outlet\"\nnear = {}\n{}\n\
             [run]\nend_time = \"{} s\"\n{}\n",
            self.spacing(),
            self.density,
            near(self.origin),
            self.inlet,
            near(end),
            self.outlet,
            self.end_time,
            self.more,
        );
        let file = folder.path().join("case.toml");
        std::fs::write(&file, text).expect("a temporary file can be written");
        let mut case = Case::load(&file, &[]).unwrap_or_else(|e| panic!("{e}"));
        case.cache = Some(cache());
        let plan = Plan::new(&case).unwrap_or_else(|e| panic!("{e}"));
        (case, plan)
    }

    /// The flow from rest, its case and its plan.
    ///
    /// # Panics
    /// When the case is wrong: these are the project's own.
    pub fn flow<R: Real>(&self) -> (Flow<R>, Case, Plan) {
        self.flow_in()
    }

    /// The same in a wall of kind `W`, where it deforms.
    ///
    /// # Panics
    /// When the case is wrong: these are the project's own.
    pub fn flow_in<R: Real, W: Deforming>(&self) -> (Flow<R, W>, Case, Plan) {
        let (case, plan) = self.plan();
        let bodies = world::Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
        let flow = world::build_flow_in(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
        (flow, case, plan)
    }
}
