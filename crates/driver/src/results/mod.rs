//! What a run writes: particle series, table of the openings, probes and the summary.

use crate::case::Case;
use crate::deforming::Deforming;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::ledger::Stage;
use crate::observe::Observers;
use crate::plan::Plan;
use frames::interpolate;
use glam::DVec3;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_io::{EndReason, OutputDir, SeriesWriter, Table};

mod account;
mod frames;
mod shell;
mod solid;
mod summary;
mod wall;

pub use frames::append_frame;
use wall::WallFile;

pub use summary::{numbers, opening_entry, surface_report};

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

    fn add<R: Real, W: MovingWall>(&mut self, flow: &Flow<R, W>, dt: f64) {
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

/// Open result files of a run, `F` that of a wall that deforms.
pub struct Results<F> {
    folder: std::path::PathBuf,
    fluid: SeriesWriter,
    wall: Option<WallFile>,
    /// Series of a wall that deforms.
    deforming: Option<F>,
    table: Table,
    probes: Option<Table>,
    next_frame: f64,
    next_row: f64,
    interval: Means,
    /// Second half of the run: what the summary calls mean.
    late: Means,
    late_start: Option<(f64, Vec<f64>)>,
    last_time: f64,
    /// What is read off the flow.
    pub observers: Observers,
}

impl<F> Results<F> {
    /// Opens the files in `out`.
    ///
    /// # Errors
    /// When the folder cannot be written.
    pub fn create<R: Real, W: Deforming<File = F>>(
        out: &OutputDir,
        case: &Case,
        plan: &Plan,
        flow: &Flow<R, W>,
    ) -> Result<Self, DriverError> {
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
        let observers = Observers::new(case, plan)?;
        let fields = &case.scene.output.fields;
        let wall = observers.wall.as_ref().map(|w| WallFile::create(out.file("wall.vtkhdf"), w, fields));
        Ok(Self {
            wall: wall.transpose()?,
            deforming: flow
                .wall
                .as_ref()
                .map(|wall| wall.wall.create(out.file("wall.vtkhdf"), case))
                .transpose()?,
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
            observers,
        })
    }

    /// The output folder.
    pub fn folder(&self) -> &std::path::Path {
        &self.folder
    }

    /// Takes the state after a step: adds to means, writes rows and frames that are due. Tells why the run may end now, if it may.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn after_step<R: Real, W: Deforming<File = F>>(
        &mut self,
        flow: &mut Flow<R, W>,
        case: &Case,
        plan: &Plan,
    ) -> Result<Option<(EndReason, String)>, DriverError> {
        let settled = self.observers.after_step(flow)?;
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
        // The last frame is written once what is summed over cycles has come to its end.
        let is_last = settled.is_some() || flow.time >= plan.end_time;
        if flow.time >= self.next_frame && !is_last {
            self.write_frame(flow, case)?;
            while self.next_frame <= flow.time {
                self.next_frame += case.scene.output.every;
            }
        }
        flow.ledger.add(Stage::Output, start.elapsed());
        Ok(settled)
    }

    fn write_row<R: Real, W: MovingWall>(
        &mut self,
        flow: &Flow<R, W>,
        case: &Case,
    ) -> Result<(), DriverError> {
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

    /// Ends what is summed over cycles, and writes the last frame.
    ///
    /// # Errors
    /// As [`Self::after_step`].
    pub fn finish<R: Real, W: Deforming<File = F>>(
        &mut self,
        flow: &Flow<R, W>,
        case: &Case,
    ) -> Result<(), DriverError> {
        self.observers.finish(flow)?;
        self.write_frame(flow, case)
    }

    /// Writes a frame of the fluid and of the wall, unless this time has one.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_frame<R: Real, W: Deforming<File = F>>(
        &mut self,
        flow: &Flow<R, W>,
        case: &Case,
    ) -> Result<(), DriverError> {
        if let (Some(file), Some(wall)) = (&mut self.wall, &self.observers.wall) {
            file.append(flow.time, wall)?;
        }
        if self.fluid.last_time() == Some(flow.time) {
            return Ok(());
        }
        if let (Some(file), Some(wall)) = (&mut self.deforming, &flow.wall) {
            W::append(wall, file, flow.time, &case.scene.output.fields)?;
        }
        Ok(append_frame(&mut self.fluid, flow, &case.scene.output.fields)?)
    }
}

fn outflows<R: Real, W: MovingWall>(flow: &Flow<R, W>) -> Vec<f64> {
    flow.openings.ports().iter().map(|p| p.counters.outflow_volume).collect()
}
