//! What a run writes: particle series, table of the openings, probes and the summary.

use crate::case::Case;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::ledger::Stage;
use crate::plan::Plan;
use glam::DVec3;
use rayon::prelude::*;
use vaso_fluid::{FluidState, Real};
use vaso_io::{
    Frame, Numbers, OpeningEntry, OpeningSummary, OutputDir, ParticleCounts, SeriesWriter, Stability, Status,
    StepCounts, Summary, SurfaceReport, Table,
};
use vaso_kernels::Wendland;
use vaso_scene::Field;

/// Mean of each opening over a time.
#[derive(Clone, Debug, Default)]
struct Means {
    time: f64,
    flow: Vec<f64>,
    pressure: Vec<f64>,
}

impl Means {
    fn new(n: usize) -> Self {
        Self { time: 0.0, flow: vec![0.0; n], pressure: vec![0.0; n] }
    }

    fn add<R: Real>(&mut self, flow: &Flow<R>, dt: f64) {
        self.time += dt;
        for (k, reading) in flow.readings.iter().enumerate() {
            self.flow[k] += dt * reading.flow;
            self.pressure[k] += dt * reading.pressure;
        }
    }

    fn mean(&self, sum: f64) -> f64 {
        if self.time > 0.0 { sum / self.time } else { 0.0 }
    }
}

/// Open result files of a run.
pub struct Results {
    folder: std::path::PathBuf,
    fluid: SeriesWriter,
    table: Table,
    probes: Option<Table>,
    next_frame: f64,
    next_row: f64,
    interval: Means,
    /// Second half of the run: what the summary calls mean.
    late: Means,
    late_start: Option<(f64, Vec<f64>)>,
    last_time: f64,
}

impl Results {
    /// Opens the files in `out`.
    ///
    /// # Errors
    /// When the folder cannot be written.
    pub fn create(out: &OutputDir, case: &Case, plan: &Plan) -> Result<Self, DriverError> {
        let mut header = vec!["time_s".to_owned()];
        for o in &plan.openings {
            header.push(format!("{}.flow_m3_s", o.name));
            header.push(format!("{}.pressure_pa", o.name));
        }
        let table = Table::create(out.file("openings.csv"), &header)?;
        let probes = if case.scene.probes.is_empty() {
            None
        } else {
            let mut header = vec!["time_s".to_owned()];
            for p in &case.scene.probes {
                header.extend(["pressure_pa", "u_m_s", "v_m_s", "w_m_s"].map(|q| format!("{}.{q}", p.name)));
            }
            Some(Table::create(out.file("probes.csv"), &header)?)
        };
        let n = plan.openings.len();
        Ok(Self {
            folder: out.path().to_owned(),
            fluid: SeriesWriter::create(out.file("fluid.vtkhdf")),
            table,
            probes,
            next_frame: 0.0,
            next_row: case.scene.output.table_every,
            interval: Means::new(n),
            late: Means::new(n),
            late_start: None,
            last_time: 0.0,
        })
    }

    /// The output folder.
    pub fn folder(&self) -> &std::path::Path {
        &self.folder
    }

    /// Takes the state after a step: adds to means, writes rows and frames that are due.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn after_step<R: Real>(
        &mut self,
        flow: &mut Flow<R>,
        case: &Case,
        plan: &Plan,
    ) -> Result<(), DriverError> {
        let dt = flow.time - self.last_time;
        self.last_time = flow.time;
        self.interval.add(flow, dt);
        if flow.time > 0.5 * plan.end_time {
            self.late_start.get_or_insert_with(|| (flow.time, outflows(flow)));
            self.late.add(flow, dt);
        }
        let start = std::time::Instant::now();
        if flow.time >= self.next_row {
            self.write_row(flow, case)?;
            while self.next_row <= flow.time {
                self.next_row += case.scene.output.table_every;
            }
        }
        if flow.time >= self.next_frame {
            self.write_frame(flow, case)?;
            while self.next_frame <= flow.time {
                self.next_frame += case.scene.output.every;
            }
        }
        flow.ledger.add(Stage::Output, start.elapsed());
        Ok(())
    }

    fn write_row<R: Real>(&mut self, flow: &Flow<R>, case: &Case) -> Result<(), DriverError> {
        let mut row = vec![flow.time];
        for k in 0..self.interval.flow.len() {
            row.push(self.interval.mean(self.interval.flow[k]));
            row.push(self.interval.mean(self.interval.pressure[k]));
        }
        self.table.append(&row)?;
        self.interval = Means::new(self.interval.flow.len());
        if let Some(probes) = &mut self.probes {
            let mut row = vec![flow.time];
            for probe in &case.scene.probes {
                let at = DVec3::from_array(probe.at) * case.vessel.unit.metres();
                let (pressure, v) = interpolate(flow, at);
                row.extend([pressure, v.x, v.y, v.z]);
            }
            probes.append(&row)?;
        }
        Ok(())
    }

    /// Writes a frame of the fluid, unless this time has one.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_frame<R: Real>(&mut self, flow: &Flow<R>, case: &Case) -> Result<(), DriverError> {
        if self.fluid.last_time() == Some(flow.time) {
            return Ok(());
        }
        Ok(append_frame(&mut self.fluid, flow, &case.scene.output.fields)?)
    }

    /// The summary of a run that ends now.
    pub fn summary<R: Real>(
        &self,
        flow: &mut Flow<R>,
        case: &Case,
        plan: &Plan,
        n_wall: usize,
        wall_clock: f64,
    ) -> Summary {
        let openings = plan.openings.iter().enumerate().map(|(k, o)| OpeningSummary {
            opening: opening_entry(&o.name, &o.opening),
            mean_flow_m3_s: self.late.mean(self.late.flow[k]),
            mean_pressure_pa: self.late.mean(self.late.pressure[k]),
        });
        let loop_seconds = flow.ledger.total() - flow.ledger.seconds(Stage::Output);
        Summary {
            vaso_version: env!("CARGO_PKG_VERSION").into(),
            status: Status::Completed,
            case: case.scene.title.clone(),
            message: None,
            time_s: flow.time,
            wall_clock_s: wall_clock,
            threads: rayon::current_num_threads() as u64,
            particles: ParticleCounts { fluid: flow.fluid.state.len() as u64, wall: n_wall as u64, shell: 0 },
            steps: StepCounts { advection: flow.advective_steps, acoustic: flow.acoustic_steps, solid: 0 },
            particle_substeps_per_s: flow.particle_substeps as f64 / loop_seconds.max(f64::MIN_POSITIVE),
            spacing_m: plan.numbers.spacing,
            sound_speed_m_s: plan.numbers.sound_speed,
            precision: R::PRECISION.into(),
            stability: Stability {
                max_density_error: flow.watch.max_density_error,
                max_mach: flow.watch.max_mach,
                escaped_particles: flow.watch.escaped,
                non_finite: flow.watch.non_finite,
                mass_balance_error: self.mass_balance(flow),
                // Needs the energy ledger, which this version does not keep; `null` in the file.
                energy_growth: f64::NAN,
            },
            openings: openings.collect(),
            effects: costed_effects(flow, plan),
            surface: Some(surface_report(&case.vessel)),
            numbers: Some(numbers(plan)),
            warnings: plan.warnings.clone(),
        }
    }

    /// Inflow minus outflow over the inflow, by the volumes that crossed the caps in the second half.
    fn mass_balance<R: Real>(&self, flow: &Flow<R>) -> f64 {
        let Some((_, before)) = &self.late_start else { return f64::NAN };
        let change: Vec<f64> = outflows(flow).iter().zip(before).map(|(now, then)| now - then).collect();
        let inflow: f64 = change.iter().map(|c| (-c).max(0.0)).sum();
        if inflow > 0.0 { change.iter().sum::<f64>().abs() / inflow } else { f64::NAN }
    }
}

fn outflows<R: Real>(flow: &Flow<R>) -> Vec<f64> {
    flow.openings.ports().iter().map(|p| p.counters.outflow_volume).collect()
}

/// Appends the state of the fluid to a series.
///
/// # Errors
/// As [`SeriesWriter::append`].
pub fn append_frame<R: Real>(
    series: &mut SeriesWriter,
    flow: &Flow<R>,
    fields: &[Field],
) -> Result<(), vaso_io::IoError> {
    let state: &FluidState = &flow.fluid.state;
    let reference = flow.openings.reference_pressure(flow.time);
    let rho0 = flow.fluid.numbers().rest_density;
    let pressure: Vec<f64> =
        (0..state.len()).into_par_iter().map(|i| reference + flow.fluid.pressure(i)).collect();
    let density: Vec<f64> = state.density_change.par_iter().map(|d| rho0 + d).collect();
    let mut frame =
        Frame { time: flow.time, position: &state.position, ids: Some(&state.id), ..Frame::default() };
    for field in fields {
        match field {
            Field::Velocity => frame.vectors.push(("Velocity", &state.velocity)),
            Field::Pressure => frame.scalars.push(("Pressure", &pressure)),
            Field::Density => frame.scalars.push(("Density", &density)),
            // `supported::check` has refused the fields of walls that move.
            _ => {}
        }
    }
    series.append(&frame)
}

/// Kernel mean (Shepard) of pressure \[Pa\] and velocity \[m/s\] at a point; NaN where no fluid is near.
fn interpolate<R: Real>(flow: &Flow<R>, at: DVec3) -> (f64, DVec3) {
    let state = &flow.fluid.state;
    let kernel = Wendland::new(flow.fluid.numbers().smoothing_length);
    let (mut weight, mut pressure, mut velocity) = (0.0, 0.0, DVec3::ZERO);
    for i in 0..state.len() {
        let r = state.position[i].distance(at);
        if r < kernel.support() {
            let w = state.mass[i] * kernel.value(r);
            weight += w;
            pressure += w * flow.fluid.pressure(i);
            velocity += w * state.velocity[i];
        }
    }
    (flow.openings.reference_pressure(flow.time) + pressure / weight, velocity / weight)
}

/// Geometry of an opening as JSON has it.
pub fn opening_entry(name: &str, o: &vaso_geometry::Opening) -> OpeningEntry {
    OpeningEntry {
        name: name.into(),
        center_m: o.center.to_array(),
        normal: o.normal.to_array(),
        area_m2: o.area,
        radius_m: o.radius,
    }
}

/// Geometry audit as JSON has it.
pub fn surface_report(vessel: &vaso_geometry::Vessel) -> SurfaceReport {
    SurfaceReport {
        triangles: vessel.surface.triangles.len() as u64,
        volume_m3: vessel.surface.volume(),
        area_m2: vessel.surface.area(),
        watertight: vessel.audit.watertight,
        components: vessel.audit.components as u64,
        repairs: vessel.audit.repairs.clone(),
        unit: vessel.unit.symbol().into(),
    }
}

/// Numbers of a plan as JSON has them.
pub fn numbers(plan: &Plan) -> Numbers {
    Numbers {
        reynolds_peak: Some(plan.reynolds_peak),
        womersley: plan.womersley,
        radial_strain: None,
        sound_speed_m_s: Some(plan.numbers.sound_speed),
    }
}

/// Effects of the plan with the time of the stages they are made of.
fn costed_effects<R: Real>(flow: &mut Flow<R>, plan: &Plan) -> Vec<vaso_io::EffectEntry> {
    let bytes = flow.fluid.bytes();
    let spent = |stages: &[Stage]| stages.iter().map(|&s| flow.ledger.seconds(s)).sum::<f64>();
    plan.effects
        .iter()
        .map(|effect| {
            let stages: &[Stage] = match effect.name.as_str() {
                "blood.pressure" => &[Stage::Rows, Stage::Momentum, Stage::Continuity],
                "blood.viscosity" => &[Stage::Viscosity],
                "blood.shear_thinning" => &[Stage::ShearThinning],
                // One sweep finds both the density sum and the correction matrices.
                "blood.density_blend" => &[Stage::Summation],
                "blood.transport_velocity" => &[Stage::Transport],
                "wall.rigid" => &[Stage::WallPressure],
                "opening.velocity" | "opening.pressure" | "opening.resistance" | "opening.windkessel" => {
                    &[Stage::Exchange, Stage::Openings]
                }
                _ => &[],
            };
            let shared = if effect.name.starts_with("opening.") {
                let both = plan
                    .effects
                    .iter()
                    .filter(|e| e.on && OPENING_EFFECTS.contains(&e.name.as_str()))
                    .count();
                both.max(1) as f64
            } else {
                1.0
            };
            let mut entry = effect.clone();
            if effect.on && !stages.is_empty() {
                entry.seconds = Some(spent(stages) / shared);
            }
            if effect.name == "blood.pressure" {
                entry.bytes = Some(bytes as u64);
            }
            entry
        })
        .collect()
}

/// Effects that share the stages of the buffers.
const OPENING_EFFECTS: [&str; 2] = ["opening.velocity", "opening.pressure"];
